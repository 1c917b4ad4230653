//! A frame that is drawn in instalments.

use embedded_graphics::draw_target::DrawTarget;
use embedded_graphics::geometry::{Point, Size};
use embedded_graphics::primitives::Rectangle;

use super::picture::{Picture, PixelSource, visible_part};
use super::quantize::Quantizer;
use crate::color::Color;

/// How much may be drawn before control returns to the caller.
///
/// A pixel that is begun is finished, so that a budget of rays may be exceeded by what one pixel casts
/// ([`Tracer::max_rays_per_pixel`](crate::Tracer::max_rays_per_pixel) at most, far fewer as a rule).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Budget {
    /// Rays of all kinds: the closest measure of time.
    Rays(u32),
    /// Pixels.
    Pixels(u32),
    /// Until the frame is done.
    Unlimited,
}

impl Budget {
    pub(super) fn is_spent(&self) -> bool {
        matches!(self, Self::Rays(0) | Self::Pixels(0))
    }

    pub(super) fn charge(&mut self, rays: u32) {
        match self {
            Self::Rays(left) => *left = left.saturating_sub(rays),
            Self::Pixels(left) => *left = left.saturating_sub(1),
            Self::Unlimited => {}
        }
    }
}

/// How far a frame is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Progress {
    /// The budget is spent: call again to go on.
    SoFar {
        /// Pixels traced.
        pixels: u32,
        /// Pixels of the whole frame.
        of: u32,
    },
    /// Everything is drawn.
    Done,
}

/// The state of a frame under way: an area and a position, a few words, no borrow of anything.
///
/// Because a pixel depends on nothing but scene, settings and coordinates, a frame may be stopped after
/// any instalment, resumed, dropped or aimed anew; the picture has the same bits whatever the budgets.
/// That makes it fit a bare loop, a loop fed by interrupts or an async task:
///
/// ```
/// # use embedded_graphics::{mock_display::MockDisplay, pixelcolor::Rgb888, prelude::*};
/// # let mut pools: scanray::ScenePools = scanray::ScenePools::new();
/// # #[cfg(feature = "parser")]
/// # pools.parse(include_bytes!("../../scenes/default.txt")).unwrap();
/// # let tracer = scanray::Tracer::new(pools.as_scene());
/// # let tracer = tracer.with_resolution(scanray::Resolution { width: 16, height: 12 });
/// # let mut display = MockDisplay::new();
/// # fn feed_watchdog() {}
/// use scanray::{render::{Budget, Frame, Progress}, Picture};
///
/// let picture = Picture::new(&tracer);
/// let mut frame = Frame::of(&picture);
/// let mut row = [Rgb888::BLACK; 160];
/// while frame.draw(&picture, &mut display, &mut row, Budget::Rays(500))? != Progress::Done {
///     feed_watchdog();
/// }
/// # Ok::<(), core::convert::Infallible>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Frame {
    left: u16,
    top: u16,
    width: u16,
    height: u16,
    /// The next pixel to trace, relative to the area; `y == height` when all are.
    x: u16,
    y: u16,
    /// Column of the first pixel of the stretch under way, relative to the area.
    start: u16,
}

impl Frame {
    /// A frame of a whole picture.
    pub fn of<P: PixelSource, Q: Quantizer>(picture: &Picture<P, Q>) -> Self {
        let resolution = picture.resolution();
        Self {
            left: 0,
            top: 0,
            width: resolution.width,
            height: resolution.height,
            x: 0,
            y: 0,
            start: 0,
        }
        .rewound()
    }

    /// A frame of the part of a picture inside `area`, which may be empty.
    pub fn of_area<P: PixelSource, Q: Quantizer>(picture: &Picture<P, Q>, area: Rectangle) -> Self {
        let (columns, rows) = visible_part(picture.resolution(), area);
        Self {
            left: columns.start,
            top: rows.start,
            width: columns.end - columns.start,
            height: rows.end - rows.start,
            x: 0,
            y: 0,
            start: 0,
        }
        .rewound()
    }

    /// The same frame from its beginning: to draw again after the camera or the scene has changed.
    #[must_use]
    pub fn rewound(self) -> Self {
        Self {
            x: 0,
            start: 0,
            // Without columns there is nothing to draw in any row.
            y: if self.width == 0 { self.height } else { 0 },
            ..self
        }
    }

    /// The part of the picture it draws.
    pub fn area(&self) -> Rectangle {
        self.rectangle(0, 0, self.width, self.height)
    }

    /// How far it is.
    pub fn progress(&self) -> Progress {
        if self.y >= self.height {
            Progress::Done
        } else {
            let width = u32::from(self.width);
            Progress::SoFar {
                pixels: u32::from(self.y) * width + u32::from(self.x),
                of: u32::from(self.height) * width,
            }
        }
    }

    fn rectangle(&self, x: u16, y: u16, width: u16, height: u16) -> Rectangle {
        Rectangle::new(
            Point::new(
                i32::from(self.left) + i32::from(x),
                i32::from(self.top) + i32::from(y),
            ),
            Size::new(u32::from(width), u32::from(height)),
        )
    }

    /// Traces into `buffer` until it holds a whole stretch of a row, which is returned with the place it
    /// belongs to, or until the budget is spent, which gives `None` and is told from the end by
    /// [`Frame::progress`].
    ///
    /// A stretch is as long as the buffer or, if that is shorter, the rest of the row. Give the same
    /// buffer until the stretch is complete; then another one may be filled while the first is sent. The
    /// buffer must not be empty: nothing is then traced.
    pub fn trace<'b, P: PixelSource, Q: Quantizer>(
        &mut self,
        picture: &Picture<P, Q>,
        buffer: &'b mut [Q::Color],
        budget: &mut Budget,
    ) -> Option<(Rectangle, &'b [Q::Color])> {
        if self.y >= self.height || buffer.is_empty() {
            return None;
        }
        let start = self.start;
        let length = buffer.len().min(usize::from(self.width - start)) as u16;
        let end = start + length;
        if self.x >= end {
            // A shorter buffer than that of the last call: what that one held is lost.
            self.x = start;
        }
        let y = self.top.saturating_add(self.y);
        let scanline = picture.scanline(y);
        for pixel in buffer
            .iter_mut()
            .take(usize::from(length))
            .skip(usize::from(self.x - start))
        {
            if budget.is_spent() {
                return None;
            }
            let x = self.left.saturating_add(self.x);
            let (color, rays) = picture.quantized_pixel(&scanline, x, y);
            *pixel = color;
            budget.charge(rays);
            self.x += 1;
        }
        let stretch = self.rectangle(start, self.y, length, 1);
        if end >= self.width {
            self.x = 0;
            self.y += 1;
        }
        self.start = self.x;
        let colors = buffer.get(..usize::from(length))?;
        Some((stretch, colors))
    }

    /// Draws on a display until the frame is done or the budget is spent, one
    /// [`DrawTarget::fill_contiguous`] for each stretch of a row that is complete. `buffer` keeps the
    /// stretch under way, so give the same one each time; a row long is best, and an empty one stands for
    /// one of a single pixel. A budget of 0 draws nothing.
    ///
    /// # Errors
    ///
    /// The display's own, unchanged. The stretch that it refused counts as not yet drawn: calling again
    /// traces and sends it again.
    pub fn draw<P: PixelSource, Q: Quantizer, D: DrawTarget<Color = Q::Color>>(
        &mut self,
        picture: &Picture<P, Q>,
        display: &mut D,
        buffer: &mut [Q::Color],
        budget: Budget,
    ) -> Result<Progress, D::Error> {
        let mut budget = budget;
        if buffer.is_empty() {
            let mut pixel = [Q::quantize(Color::<P::Scalar>::BLACK, 0, 0)];
            return self.draw(picture, display, &mut pixel, budget);
        }
        while let Some((stretch, colors)) = self.trace(picture, buffer, &mut budget) {
            if let Err(error) = display.fill_contiguous(&stretch, colors.iter().copied()) {
                self.x = (stretch.top_left.x - i32::from(self.left)) as u16;
                self.start = self.x;
                self.y = (stretch.top_left.y - i32::from(self.top)) as u16;
                return Err(error);
            }
        }
        Ok(self.progress())
    }
}
