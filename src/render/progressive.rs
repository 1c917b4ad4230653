//! A picture that appears coarse and is refined in place.

use embedded_graphics::Pixel;
use embedded_graphics::draw_target::DrawTarget;
use embedded_graphics::geometry::{Point, Size};
use embedded_graphics::primitives::{PointsIter, Rectangle};

use super::frame::{Budget, Progress};
use super::picture::{Picture, PixelSource};
use super::quantize::Quantizer;
use crate::camera::Resolution;
use crate::color::Color;
use crate::scalar::Scalar;

/// The state of a picture that is drawn coarse to fine: a position, a few words, no borrow of anything.
///
/// The first pass traces every fourth pixel of every fourth row and fills blocks of 4×4 pixels with
/// their colours, which takes a sixteenth of the time of the whole picture. The second fills blocks of
/// 2×2, the third single pixels; each traces only what was not traced before, and overwrites only what
/// it refines. So each pixel is traced once, no frame buffer is needed, and at the end the
/// picture has the bits of [`Picture`]. Blocks end at the edges of the picture, and dither shows in them.
///
/// Like a [`Frame`](super::Frame) it may be stopped after any instalment, resumed, dropped, or rewound when
/// the scene has changed.
///
/// ```
/// # use embedded_graphics::{mock_display::MockDisplay, pixelcolor::Rgb888, prelude::*};
/// # let mut pools: scanray::ScenePools = scanray::ScenePools::new();
/// # #[cfg(feature = "parser")]
/// # pools.parse(include_bytes!("../../scenes/default.txt")).unwrap();
/// # let tracer = scanray::Tracer::new(pools.as_scene());
/// # let tracer = tracer.with_resolution(scanray::Resolution { width: 16, height: 12 });
/// # let mut display = MockDisplay::<Rgb888>::new();
/// # display.set_allow_overdraw(true);
/// # fn the_scene_has_changed() -> bool { false }
/// use scanray::{render::{Budget, Progress, Progressive}, Color, Picture};
///
/// let picture = Picture::new(&tracer);
/// let mut progressive = Progressive::of(&picture);
/// let mut row = [Color::BLACK; 160];
/// while progressive.draw(&picture, &mut display, &mut row, Budget::Rays(500))? != Progress::Done {
///     if the_scene_has_changed() {
///         break;
///     }
/// }
/// # Ok::<(), core::convert::Infallible>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Progressive {
    resolution: Resolution,
    /// Binary logarithm of the side of the blocks of the first pass.
    coarsest: u8,
    /// The same of the pass under way: 2, 1 or 0.
    log2_block: u8,
    /// The next pixel to trace; in the row `height` all of the last pass are.
    x: u16,
    y: u16,
    /// Column of the first pixel of the stretch under way.
    start: u16,
}

impl Progressive {
    /// A picture whose first pass has a quarter of its columns and rows.
    pub fn of<P: PixelSource, Q: Quantizer>(picture: &Picture<P, Q>) -> Self {
        Self::from_blocks(picture.resolution(), 2)
    }

    /// A picture whose first pass has half of its columns and rows.
    pub fn from_half<P: PixelSource, Q: Quantizer>(picture: &Picture<P, Q>) -> Self {
        Self::from_blocks(picture.resolution(), 1)
    }

    fn from_blocks(resolution: Resolution, coarsest: u8) -> Self {
        let mut progressive = Self {
            resolution,
            coarsest,
            log2_block: coarsest,
            x: 0,
            y: 0,
            start: 0,
        };
        progressive.begin_row(0);
        progressive
    }

    /// The same picture from its beginning: to draw again after the camera or the scene has changed.
    #[must_use]
    pub fn rewound(self) -> Self {
        Self::from_blocks(self.resolution, self.coarsest)
    }

    /// Side of the blocks that the pass under way fills, in pixels: 4, 2, or 1, which also stands when
    /// everything is drawn.
    pub fn block(&self) -> u16 {
        1 << self.log2_block
    }

    /// How far it is.
    pub fn progress(&self) -> Progress {
        if self.is_done() {
            return Progress::Done;
        }
        let Resolution { width, height } = self.resolution;
        let cells = |columns: u16, rows: u16, log2_side: u8| {
            let along = |pixels: u16| (u32::from(pixels) + (1 << log2_side) - 1) >> log2_side;
            along(columns) * along(rows)
        };
        // Of this pass what lies in the rows above and to the left, and everything of the passes before,
        // whose cells have twice the side.
        let mut pixels = cells(width, self.y, self.log2_block) + cells(self.x, 1, self.log2_block);
        if self.log2_block < self.coarsest {
            let known = self.log2_block + 1;
            pixels += cells(width, height, known) - cells(width, self.y, known);
            if !self.is_new_row() {
                pixels -= cells(self.x, 1, known);
            }
        }
        Progress::SoFar {
            pixels,
            of: u32::from(width) * u32::from(height),
        }
    }

    fn is_done(&self) -> bool {
        self.log2_block == 0 && self.y >= self.resolution.height
    }

    /// Whether no pixel of the row was traced in a pass before.
    fn is_new_row(&self) -> bool {
        self.log2_block == self.coarsest || self.y >> self.log2_block & 1 != 0
    }

    /// Column of the first pixel of a row, and binary logarithm of the columns from one to the next.
    fn columns(&self) -> (u16, u8) {
        if self.is_new_row() {
            (0, self.log2_block)
        } else {
            (self.block(), self.log2_block + 1)
        }
    }

    /// Goes to the first pixel of a row, or of the next that has any, which may be in the next pass.
    fn begin_row(&mut self, y: u16) {
        let Resolution { width, height } = self.resolution;
        self.y = y;
        while !self.is_done() {
            if self.y >= height {
                self.log2_block -= 1;
                self.y = 0;
            }
            self.x = self.columns().0;
            if self.x < width {
                break;
            }
            self.y = self.y.saturating_add(self.block());
        }
        self.start = self.x;
    }

    /// The part of the block of a pixel that lies in the picture, `columns` blocks wide.
    fn blocks(&self, x: u16, columns: u16) -> Rectangle {
        let Resolution { width, height } = self.resolution;
        let rest = |start: u16, length: u16, end: u16| u32::from(length.min(end - start));
        Rectangle::new(
            Point::new(x.into(), self.y.into()),
            Size::new(
                rest(x, columns.saturating_mul(self.block()), width),
                rest(self.y, self.block(), height),
            ),
        )
    }

    /// Draws on a display until the picture is done or the budget is spent. See
    /// [`Progressive::draw_pass`].
    ///
    /// # Errors
    ///
    /// The display's own.
    pub fn draw<P: PixelSource, Q: Quantizer, D: DrawTarget<Color = Q::Color>>(
        &mut self,
        picture: &Picture<P, Q>,
        display: &mut D,
        buffer: &mut [Color<P::Scalar>],
        budget: Budget,
    ) -> Result<Progress, D::Error> {
        let mut budget = budget;
        while self.draw_stretch(picture, display, buffer, &mut budget)? {}
        Ok(self.progress())
    }

    /// Draws on a display until the pass under way is done or the budget is spent.
    ///
    /// A row of blocks of which none was drawn before takes one [`DrawTarget::fill_contiguous`]. Where
    /// every other block is refined, each takes one, and single pixels take one
    /// [`DrawTarget::draw_iter`] together. `buffer` keeps the colours of the stretch of a row under way,
    /// so give the same one each time: one for each column is best (for each fourth in the first pass),
    /// and an empty one stands for one of a single pixel. A budget of 0 draws nothing.
    ///
    /// # Errors
    ///
    /// The display's own, unchanged. The stretch that it refused counts as not yet drawn: calling again
    /// traces and sends it again.
    pub fn draw_pass<P: PixelSource, Q: Quantizer, D: DrawTarget<Color = Q::Color>>(
        &mut self,
        picture: &Picture<P, Q>,
        display: &mut D,
        buffer: &mut [Color<P::Scalar>],
        budget: Budget,
    ) -> Result<Progress, D::Error> {
        let mut budget = budget;
        let pass = self.log2_block;
        while self.draw_stretch(picture, display, buffer, &mut budget)? && self.log2_block == pass {
        }
        Ok(self.progress())
    }

    /// Draws a stretch of a row; tells whether it is complete and there is more to draw.
    fn draw_stretch<P: PixelSource, Q: Quantizer, D: DrawTarget<Color = Q::Color>>(
        &mut self,
        picture: &Picture<P, Q>,
        display: &mut D,
        buffer: &mut [Color<P::Scalar>],
        budget: &mut Budget,
    ) -> Result<bool, D::Error> {
        let mut pixel = [Color::BLACK];
        let buffer = if buffer.is_empty() {
            &mut pixel
        } else {
            buffer
        };
        if self.is_done() {
            return Ok(false);
        }
        let (_, log2_step) = self.columns();
        let pixels_before = |x: u16, start: u16| {
            (usize::from(x.saturating_sub(start)) + (1 << log2_step) - 1) >> log2_step
        };
        let length = buffer
            .len()
            .min(pixels_before(self.resolution.width, self.start));
        if pixels_before(self.x, self.start) >= length {
            // A shorter buffer than that of the last call: what that one held is lost.
            self.x = self.start;
        }

        let scanline = picture.scanline(self.y);
        let traced = pixels_before(self.x, self.start);
        for color in buffer.iter_mut().take(length).skip(traced) {
            if budget.is_spent() {
                return Ok(false);
            }
            let (linear, rays) = picture.linear_pixel(&scanline, self.x);
            *color = linear;
            budget.charge(rays);
            self.x = self.x.saturating_add(1 << log2_step);
        }

        let colors = buffer.get(..length).unwrap_or(&[]);
        if let Err(error) = self.send::<_, Q, _>(display, colors) {
            self.x = self.start;
            return Err(error);
        }
        if self.x >= self.resolution.width {
            self.begin_row(self.y.saturating_add(self.block()));
        } else {
            self.start = self.x;
        }
        Ok(!self.is_done())
    }

    /// Sends the colours of the stretch under way.
    fn send<T: Scalar, Q: Quantizer, D: DrawTarget<Color = Q::Color>>(
        &self,
        display: &mut D,
        colors: &[Color<T>],
    ) -> Result<(), D::Error> {
        let (_, log2_step) = self.columns();
        let columns = (0_u16..).map(|index| self.start + (index << log2_step));
        if self.is_new_row() {
            // The blocks touch: row by row of pixels, each color as often as a block is wide.
            let area = self.blocks(self.start, colors.len() as u16);
            let quantized = area.points().map(|point| {
                let (x, y) = (point.x as u16, point.y as u16);
                let index = usize::from((x - self.start) >> log2_step);
                let color = colors.get(index).copied().unwrap_or(Color::BLACK);
                Q::quantize(color, x, y)
            });
            return display.fill_contiguous(&area, quantized);
        }
        if self.log2_block == 0 {
            let pixels = colors.iter().zip(columns).map(|(color, x)| {
                let place = Point::new(x.into(), self.y.into());
                Pixel(place, Q::quantize(*color, x, self.y))
            });
            return display.draw_iter(pixels);
        }
        for (color, x) in colors.iter().zip(columns) {
            let area = self.blocks(x, 1);
            let quantized = area
                .points()
                .map(|point| Q::quantize(*color, point.x as u16, point.y as u16));
            display.fill_contiguous(&area, quantized)?;
        }
        Ok(())
    }
}
