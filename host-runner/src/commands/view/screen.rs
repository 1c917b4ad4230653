//! The picture under way, as a display that can be looked at while it is drawn on.

use std::convert::Infallible;

use embedded_graphics::Pixel;
use embedded_graphics::pixelcolor::Rgb888;
use embedded_graphics::prelude::*;
use scanray::{
    Color, Resolution, Scalar,
    render::{DisplayColor, Quantizer},
};

use crate::picture_memory::{Shortage, room};

/// Pixels as a display shows them, black at first.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Pixels {
    pub(super) width: usize,
    pub(super) height: usize,
    /// Rows from top to bottom.
    pub(super) rgb: Vec<[u8; 3]>,
}

/// Pixels that linear colours can be drawn on, and how a display shows them.
#[derive(Debug)]
pub(super) struct Screen<'p> {
    pixels: &'p mut Pixels,
    shown: Shown,
}

/// What a display shows of a linear colour at a place.
pub(super) type Shown = fn(Linear, u16, u16) -> [u8; 3];

/// [`Shown`] for a scalar and a way to a display's colour.
pub(super) fn shown<T: Scalar, Q: Quantizer<Color: Into<Rgb888>>>(
    Linear(linear): Linear,
    x: u16,
    y: u16,
) -> [u8; 3] {
    // As `f64` a number of either scalar is itself.
    let [r, g, b] = linear.map(T::from_f64);
    let color: Rgb888 = Q::quantize(Color::new(r, g, b), x, y).into();
    [color.r(), color.g(), color.b()]
}

/// A linear colour on its way to a [`Screen`]: drawing is compiled once, not once more for each kind of display.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Linear([f64; 3]);

impl PixelColor for Linear {
    type Raw = ();
}

impl DisplayColor for Linear {
    const LEVEL: f32 = 0.0;

    fn from_linear<T: Scalar>(color: Color<T>, _: T) -> Self {
        Linear([color.r, color.g, color.b].map(T::to_f64))
    }
}

impl Pixels {
    /// # Errors
    ///
    /// A [`Shortage`] of memory.
    pub(super) fn new(resolution: Resolution) -> Result<Self, Shortage> {
        let [width, height] = [resolution.width, resolution.height].map(usize::from);
        let what = format_args!("a picture of {width}x{height} pixels");
        let mut rgb = room(width * height, what, "give a smaller --size")?;
        rgb.resize(width * height, [0; 3]);
        Ok(Self { width, height, rgb })
    }

    /// The same picture in a smaller size: each pixel is the mean of those that it covers.
    ///
    /// # Errors
    ///
    /// A [`Shortage`] of memory.
    pub(super) fn averaged(&self, resolution: Resolution) -> Result<Self, Shortage> {
        let mut smaller = Self::new(resolution)?;
        let covered = |index: usize, of: usize, length: usize| {
            let start = index * length / of;
            start..((index + 1) * length / of).max(start + 1)
        };
        for y in 0..smaller.height {
            for x in 0..smaller.width {
                let (mut sum, mut count) = ([0_usize; 3], 0);
                for row in covered(y, smaller.height, self.height) {
                    for column in covered(x, smaller.width, self.width) {
                        let pixel = self.rgb[row * self.width + column];
                        sum = [0, 1, 2].map(|i| sum[i] + usize::from(pixel[i]));
                        count += 1;
                    }
                }
                smaller.rgb[y * smaller.width + x] =
                    sum.map(|sum| ((sum + count / 2) / count) as u8);
            }
        }
        Ok(smaller)
    }

    /// A pixel; none outside.
    pub(super) fn get(&self, x: usize, y: usize) -> Option<[u8; 3]> {
        (x < self.width && y < self.height).then(|| self.rgb[y * self.width + x])
    }
}

impl<'p> Screen<'p> {
    pub(super) fn new(pixels: &'p mut Pixels, shown: Shown) -> Self {
        Self { pixels, shown }
    }

    pub(super) fn pixels(&self) -> &Pixels {
        self.pixels
    }
}

impl OriginDimensions for Screen<'_> {
    fn size(&self) -> Size {
        Size::new(self.pixels.width as u32, self.pixels.height as u32)
    }
}

impl DrawTarget for Screen<'_> {
    type Color = Linear;
    type Error = Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<Linear>>>(
        &mut self,
        pixels: I,
    ) -> Result<(), Infallible> {
        let area = self.bounding_box();
        for Pixel(place, color) in pixels {
            if area.contains(place) {
                let index = place.y as usize * self.pixels.width + place.x as usize;
                self.pixels.rgb[index] = (self.shown)(color, place.x as u16, place.y as u16);
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn averages_cover_every_pixel_once() {
        let mut pixels = Pixels::new(Resolution {
            width: 5,
            height: 2,
        })
        .unwrap();
        for (i, pixel) in pixels.rgb.iter_mut().enumerate() {
            *pixel = [10 * i as u8, 0, 255];
        }
        let smaller = pixels.averaged(Resolution {
            width: 2,
            height: 1,
        });
        let smaller = smaller.unwrap();
        // Columns 0 and 1, then 2 to 4, of both rows.
        assert_eq!(smaller.rgb, [[30, 0, 255], [55, 0, 255]]);
        let same = pixels.averaged(Resolution {
            width: 5,
            height: 2,
        });
        assert_eq!(same.as_ref(), Ok(&pixels));
        assert_eq!(pixels.get(4, 1), Some([90, 0, 255]));
        assert_eq!((pixels.get(5, 1), pixels.get(4, 2)), (None, None));
    }
}
