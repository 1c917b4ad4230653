//! A display that keeps nothing but the hash of what it was shown.

use core::convert::Infallible;

use board::{console, crc32::Crc32};
use embedded_graphics::{
    pixelcolor::{Rgb888, RgbColor},
    prelude::*,
    primitives::Rectangle,
};

/// Takes rows from top to bottom, as a picture draws them, and nothing else.
#[derive(Debug)]
pub struct Hash {
    size: Size,
    /// The pixel that has to come next.
    next: Point,
    is_in_order: bool,
    crc: Crc32,
}

impl Hash {
    /// A display of this size.
    pub const fn new(size: Size) -> Self {
        Self {
            size,
            next: Point::new(0, 0),
            is_in_order: true,
            crc: Crc32::new(),
        }
    }

    /// Prints the picture's hash, or that pixels came out of order or are missing.
    pub fn print(&self) {
        if self.is_in_order && self.next == Point::new(0, self.size.height as i32) {
            console::hexadecimal("crc32 ", self.crc.value());
        } else {
            console::text("not a whole picture in order\n");
        }
    }
}

impl OriginDimensions for Hash {
    fn size(&self) -> Size {
        self.size
    }
}

impl DrawTarget for Hash {
    type Color = Rgb888;
    type Error = Infallible;

    fn draw_iter<I>(&mut self, pixels: I) -> Result<(), Infallible>
    where
        I: IntoIterator<Item = Pixel<Rgb888>>,
    {
        for Pixel(point, color) in pixels {
            self.is_in_order &= point == self.next;
            self.next.x += 1;
            if self.next.x == self.size.width as i32 {
                self.next = Point::new(0, self.next.y + 1);
            }
            for byte in [color.r(), color.g(), color.b()] {
                self.crc.byte(byte);
            }
        }
        Ok(())
    }

    fn fill_contiguous<I>(&mut self, area: &Rectangle, colors: I) -> Result<(), Infallible>
    where
        I: IntoIterator<Item = Rgb888>,
    {
        self.draw_iter(
            area.points()
                .zip(colors)
                .map(|(point, color)| Pixel(point, color)),
        )
    }
}
