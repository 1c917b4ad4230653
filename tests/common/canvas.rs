//! A display that records what is drawn on it, and how.

use std::convert::Infallible;

use embedded_graphics::Pixel;
use embedded_graphics::draw_target::DrawTarget;
use embedded_graphics::geometry::{Dimensions, Point, Size};
use embedded_graphics::pixelcolor::PixelColor;
use embedded_graphics::primitives::Rectangle;

/// A display without memory limits that keeps every call.
#[derive(Clone, Debug)]
pub(crate) struct Canvas<C> {
    area: Rectangle,
    pixels: Vec<Option<C>>,
    /// The area of every `fill_contiguous`, in order.
    pub(crate) fills: Vec<Rectangle>,
    /// Calls that are not `fill_contiguous`.
    pub(crate) other_calls: usize,
    /// Pixels that were drawn more than once.
    pub(crate) overdrawn: usize,
}

impl<C: PixelColor> Canvas<C> {
    pub(crate) fn new(width: u16, height: u16) -> Self {
        Self::with_area(Rectangle::new(
            Point::zero(),
            Size::new(width.into(), height.into()),
        ))
    }

    /// A display whose upper left corner is not (0, 0).
    pub(crate) fn with_area(area: Rectangle) -> Self {
        Self {
            area,
            pixels: vec![None; (area.size.width * area.size.height) as usize],
            fills: Vec::new(),
            other_calls: 0,
            overdrawn: 0,
        }
    }

    /// What was drawn at a place.
    pub(crate) fn get(&self, x: i32, y: i32) -> Option<C> {
        self.pixels[self.index(Point::new(x, y))?]
    }

    /// How many pixels were drawn.
    pub(crate) fn drawn(&self) -> usize {
        self.pixels.iter().flatten().count()
    }

    fn index(&self, point: Point) -> Option<usize> {
        let Point { x, y } = point - self.area.top_left;
        self.area
            .contains(point)
            .then_some(y as usize * self.area.size.width as usize + x as usize)
    }

    fn set(&mut self, point: Point, color: C) {
        if let Some(index) = self.index(point)
            && self.pixels[index].replace(color).is_some()
        {
            self.overdrawn += 1;
        }
    }
}

impl<C: PixelColor> Dimensions for Canvas<C> {
    fn bounding_box(&self) -> Rectangle {
        self.area
    }
}

impl<C: PixelColor> DrawTarget for Canvas<C> {
    type Color = C;
    type Error = Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<C>>>(&mut self, pixels: I) -> Result<(), Infallible> {
        self.other_calls += 1;
        for Pixel(point, color) in pixels {
            self.set(point, color);
        }
        Ok(())
    }

    fn fill_contiguous<I: IntoIterator<Item = C>>(
        &mut self,
        area: &Rectangle,
        colors: I,
    ) -> Result<(), Infallible> {
        self.fills.push(*area);
        let mut colors = colors.into_iter();
        for y in area.rows() {
            for x in area.columns() {
                match colors.next() {
                    Some(color) => self.set(Point::new(x, y), color),
                    None => panic!("fewer colours than pixels in {area:?}"),
                }
            }
        }
        assert!(
            colors.next().is_none(),
            "more colours than pixels in {area:?}"
        );
        Ok(())
    }

    fn fill_solid(&mut self, area: &Rectangle, color: C) -> Result<(), Infallible> {
        self.other_calls += 1;
        for point in area
            .rows()
            .flat_map(|y| area.columns().map(move |x| (x, y)))
        {
            self.set(point.into(), color);
        }
        Ok(())
    }

    fn clear(&mut self, color: C) -> Result<(), Infallible> {
        let area = self.area;
        self.fill_solid(&area, color)
    }
}

/// What a [`FailingDisplay`] fails with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct BusError {
    pub(crate) call: usize,
}

/// A display whose bus fails at one of its calls, before anything of it is drawn.
#[derive(Clone, Debug)]
pub(crate) struct FailingDisplay<C> {
    pub(crate) canvas: Canvas<C>,
    pub(crate) calls: usize,
    pub(crate) fails_at: usize,
}

impl<C: PixelColor> FailingDisplay<C> {
    pub(crate) fn new(canvas: Canvas<C>, fails_at: usize) -> Self {
        Self {
            canvas,
            calls: 0,
            fails_at,
        }
    }

    fn call(&mut self) -> Result<(), BusError> {
        let call = self.calls;
        self.calls += 1;
        if call == self.fails_at {
            Err(BusError { call })
        } else {
            Ok(())
        }
    }
}

impl<C: PixelColor> Dimensions for FailingDisplay<C> {
    fn bounding_box(&self) -> Rectangle {
        self.canvas.bounding_box()
    }
}

impl<C: PixelColor> DrawTarget for FailingDisplay<C> {
    type Color = C;
    type Error = BusError;

    fn draw_iter<I: IntoIterator<Item = Pixel<C>>>(&mut self, pixels: I) -> Result<(), BusError> {
        self.call()?;
        let Ok(()) = self.canvas.draw_iter(pixels);
        Ok(())
    }

    fn fill_contiguous<I: IntoIterator<Item = C>>(
        &mut self,
        area: &Rectangle,
        colors: I,
    ) -> Result<(), BusError> {
        self.call()?;
        let Ok(()) = self.canvas.fill_contiguous(area, colors);
        Ok(())
    }
}
