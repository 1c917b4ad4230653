//! A whole picture, as embedded-graphics sees it.

use core::fmt;
use core::marker::PhantomData;
use core::ops::Range;

use embedded_graphics::Drawable;
use embedded_graphics::draw_target::DrawTarget;
use embedded_graphics::geometry::{Dimensions, Point, Size};
use embedded_graphics::primitives::Rectangle;

use super::quantize::{DisplayColor, Dithered, Exact, Quantizer, ThroughRgb888};
use crate::camera::Resolution;
use crate::color::Color;
use crate::scalar::Scalar;
use crate::tracer::{RayCount, Scanline, Tracer};

/// Whatever gives each pixel its linear colour, independently of all others.
///
/// [`Tracer`] is one, whatever its stages and stack; everything in this module draws from any.
pub trait PixelSource {
    /// Number type of the colours.
    type Scalar: Scalar;
    /// What the pixels of a row have in common.
    type Scanline;

    /// Size of the picture.
    fn resolution(&self) -> Resolution;

    /// What the pixels of row `y` have in common.
    fn scanline(&self, y: u16) -> Self::Scanline;

    /// Colour of the pixel in column `x` of a row, and the number of rays it took.
    fn pixel_on(&self, scanline: &Self::Scanline, x: u16) -> (Color<Self::Scalar>, u32);
}

impl<T: Scalar, const STAGES: u64, const STACK: usize> PixelSource
    for Tracer<'_, T, STAGES, STACK>
{
    type Scalar = T;
    type Scanline = Scanline<T>;

    fn resolution(&self) -> Resolution {
        Tracer::resolution(self)
    }

    #[inline(always)]
    fn scanline(&self, y: u16) -> Scanline<T> {
        Tracer::scanline(self, y)
    }

    #[inline(always)]
    fn pixel_on(&self, scanline: &Scanline<T>, x: u16) -> (Color<T>, u32) {
        let mut rays = RayCount::default();
        let color = self.pixel_observed(scanline, x, &mut rays);
        (color, rays.0)
    }
}

impl<P: PixelSource> PixelSource for &P {
    type Scalar = P::Scalar;
    type Scanline = P::Scanline;

    fn resolution(&self) -> Resolution {
        (**self).resolution()
    }

    #[inline(always)]
    fn scanline(&self, y: u16) -> Self::Scanline {
        (**self).scanline(y)
    }

    #[inline(always)]
    fn pixel_on(&self, scanline: &Self::Scanline, x: u16) -> (Color<Self::Scalar>, u32) {
        (**self).pixel_on(scanline, x)
    }
}

/// The picture of a tracer in the colours of a display.
///
/// It is a [`Drawable`]: `Picture::new(&tracer).draw(&mut display)` draws row by row, each row with one
/// [`DrawTarget::fill_contiguous`], without a buffer. Rows and pixels can also be had one by one, and
/// [`Frame`](super::Frame) draws in instalments; all give the same bits.
///
/// What reaches the display's bus is the driver's choice. A driver with a `fill_contiguous` of its own, such as mipidsi
/// (ILI9341, ST7789 …), sends one address window a row and then nothing but pixels, two bytes each in
/// RGB565. One without it, such as ssd1306 in its buffered mode or embedded-graphics' `Framebuffer`, gets single pixels, keeps
/// them in a buffer of its own and sends that when it is flushed.
pub struct Picture<P, Q> {
    source: P,
    quantizer: PhantomData<Q>,
}

impl<P: Clone, Q> Clone for Picture<P, Q> {
    fn clone(&self) -> Self {
        Self {
            source: self.source.clone(),
            quantizer: PhantomData,
        }
    }
}

impl<P: Copy, Q> Copy for Picture<P, Q> {}

impl<P: fmt::Debug, Q> fmt::Debug for Picture<P, Q> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Picture")
            .field("source", &self.source)
            .finish_non_exhaustive()
    }
}

impl<P: PixelSource, C: DisplayColor> Picture<P, Exact<C>> {
    /// The picture in a colour of embedded-graphics, which the display decides.
    pub const fn new(source: P) -> Self {
        Self::quantized(source)
    }

    /// The same picture with ordered dither.
    pub fn dithered(self) -> Picture<P, Dithered<C>> {
        Picture::quantized(self.source)
    }
}

impl<P: PixelSource, C: From<embedded_graphics::pixelcolor::Rgb888>> Picture<P, ThroughRgb888<C>>
where
    ThroughRgb888<C>: Quantizer,
{
    /// The picture in a colour that embedded-graphics does not know but that can be made from RGB888.
    pub const fn converted(source: P) -> Self {
        Self::quantized(source)
    }
}

impl<P: PixelSource, Q: Quantizer> Picture<P, Q> {
    const fn quantized(source: P) -> Self {
        Self {
            source,
            quantizer: PhantomData,
        }
    }

    /// Size in pixels.
    pub fn resolution(&self) -> Resolution {
        self.source.resolution()
    }

    /// A pixel.
    pub fn pixel(&self, x: u16, y: u16) -> Q::Color {
        self.quantized_pixel(&self.source.scanline(y), x, y).0
    }

    /// Draws the part of row `y` that starts at column `x` and is as long as the buffer; returns the
    /// number of rays it took.
    pub fn row(&self, x: u16, y: u16, buffer: &mut [Q::Color]) -> u32 {
        let scanline = self.source.scanline(y);
        let mut rays = 0_u32;
        for (x, pixel) in (x..=u16::MAX).zip(buffer) {
            let (color, cost) = self.quantized_pixel(&scanline, x, y);
            *pixel = color;
            rays = rays.saturating_add(cost);
        }
        rays
    }

    #[inline(always)]
    pub(super) fn scanline(&self, y: u16) -> P::Scanline {
        self.source.scanline(y)
    }

    /// A pixel of a row and the number of rays it took.
    #[inline(always)]
    pub(super) fn quantized_pixel(
        &self,
        scanline: &P::Scanline,
        x: u16,
        y: u16,
    ) -> (Q::Color, u32) {
        let (color, rays) = self.source.pixel_on(scanline, x);
        (Q::quantize(color, x, y), rays)
    }

    /// The linear colour of a pixel of a row and the number of rays it took.
    #[inline(always)]
    pub(super) fn linear_pixel(&self, scanline: &P::Scanline, x: u16) -> (Color<P::Scalar>, u32) {
        self.source.pixel_on(scanline, x)
    }
}

/// The columns and rows of a picture inside an area, which may be anywhere and of any size:
/// `Rectangle::intersection` overflows at the ends of its range.
pub(super) fn visible_part(resolution: Resolution, area: Rectangle) -> (Range<u16>, Range<u16>) {
    let part = |start: i32, length: u32, of: u16| {
        let inside = |edge: i64| edge.clamp(0, i64::from(of)) as u16;
        inside(i64::from(start))..inside(i64::from(start) + i64::from(length))
    };
    (
        part(area.top_left.x, area.size.width, resolution.width),
        part(area.top_left.y, area.size.height, resolution.height),
    )
}

impl<P: PixelSource, Q: Quantizer> Dimensions for Picture<P, Q> {
    fn bounding_box(&self) -> Rectangle {
        let Resolution { width, height } = self.resolution();
        Rectangle::new(
            Point::zero(),
            Size::new(u32::from(width), u32::from(height)),
        )
    }
}

impl<P: PixelSource, Q: Quantizer> Drawable for Picture<P, Q> {
    type Color = Q::Color;
    type Output = ();

    /// Draws the part of the picture that lies on the target.
    ///
    /// # Errors
    ///
    /// The target's own.
    fn draw<D: DrawTarget<Color = Q::Color>>(&self, target: &mut D) -> Result<(), D::Error> {
        let (columns, rows) = visible_part(self.resolution(), target.bounding_box());
        if columns.is_empty() {
            return Ok(());
        }
        for y in rows {
            let scanline = self.source.scanline(y);
            let row = Rectangle::new(
                Point::new(i32::from(columns.start), i32::from(y)),
                Size::new(u32::from(columns.end - columns.start), 1),
            );
            let colors = columns
                .clone()
                .map(|x| self.quantized_pixel(&scanline, x, y).0);
            target.fill_contiguous(&row, colors)?;
        }
        Ok(())
    }
}
