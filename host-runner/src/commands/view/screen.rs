//! The picture under way, as a display that can be looked at while it is drawn on.

use std::convert::Infallible;
use std::marker::PhantomData;

use embedded_graphics::Pixel;
use embedded_graphics::pixelcolor::Rgb888;
use embedded_graphics::prelude::*;
use scanray::Resolution;

use crate::memory::{Shortage, room};

/// Pixels as a display shows them, black at first.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Pixels {
    pub(super) width: usize,
    pub(super) height: usize,
    /// Rows from top to bottom.
    pub(super) rgb: Vec<[u8; 3]>,
}

/// Pixels that pictures in a display's colours can be drawn on.
#[derive(Debug)]
pub(super) struct Screen<'p, C> {
    pixels: &'p mut Pixels,
    color: PhantomData<C>,
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

impl<'p, C> Screen<'p, C> {
    pub(super) fn new(pixels: &'p mut Pixels) -> Self {
        Self {
            pixels,
            color: PhantomData,
        }
    }

    pub(super) fn pixels(&self) -> &Pixels {
        self.pixels
    }
}

impl<C> OriginDimensions for Screen<'_, C> {
    fn size(&self) -> Size {
        Size::new(self.pixels.width as u32, self.pixels.height as u32)
    }
}

impl<C: PixelColor + Into<Rgb888>> DrawTarget for Screen<'_, C> {
    type Color = C;
    type Error = Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<C>>>(&mut self, pixels: I) -> Result<(), Infallible> {
        let area = self.bounding_box();
        for Pixel(place, color) in pixels {
            if area.contains(place) {
                let color: Rgb888 = color.into();
                let index = place.y as usize * self.pixels.width + place.x as usize;
                self.pixels.rgb[index] = [color.r(), color.g(), color.b()];
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
