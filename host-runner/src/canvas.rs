//! A display in memory: the [`DrawTarget`] that pictures are drawn on before they become files.

use std::convert::Infallible;
use std::fmt;

use embedded_graphics::Pixel;
use embedded_graphics::pixelcolor::Rgb888;
use embedded_graphics::prelude::*;
use embedded_graphics::primitives::Rectangle;
use rayon::prelude::*;
use scanray::{Color, render::DisplayColor};

/// Rows of a picture in the colours of a display.
///
/// Its pixels keep their coordinates in the whole picture. Bands of rows can be drawn independently. Of which kind the
/// colours are is known to the bands alone, so that the rest is compiled once.
pub(crate) struct Canvas {
    width: usize,
    /// The pixels of some rows each.
    bands: Vec<Box<dyn Pixels>>,
}

/// Pixels in the colours of a display.
trait Pixels: Send {
    /// Three bytes for each.
    fn to_rgb888(&self) -> Vec<u8>;
}

impl<C: PixelColor + Into<Rgb888> + Send> Pixels for Vec<C> {
    fn to_rgb888(&self) -> Vec<u8> {
        let mut bytes = vec![0; 3 * self.len()];
        for (bytes, color) in bytes.chunks_exact_mut(3).zip(self) {
            let color: Rgb888 = (*color).into();
            bytes.copy_from_slice(&[color.r(), color.g(), color.b()]);
        }
        bytes
    }
}

impl fmt::Debug for Canvas {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Canvas")
            .field("width", &self.width)
            .finish_non_exhaustive()
    }
}

/// Draws a band of a width from a row on, of so many rows.
pub(crate) type DrawBand<'a> = dyn Fn([usize; 3]) -> DrawnBand + Sync + 'a;

/// What is kept of a band.
pub(crate) struct DrawnBand(Box<dyn Pixels>);

/// Some rows of a canvas, and a display of their own.
#[derive(Debug)]
pub(crate) struct Band<'c, C> {
    area: Rectangle,
    pixels: &'c mut [C],
}

impl Canvas {
    /// Draws rows, `top` being the first, in bands of as many rows each, the last of perhaps fewer. Rayon's threads
    /// share the work.
    pub(crate) fn draw(
        [width, top, rows]: [u16; 3],
        band_rows: usize,
        draw: &DrawBand<'_>,
    ) -> Self {
        let [width, top, rows] = [width, top, rows].map(usize::from);
        let band = |index: usize| {
            let first = index * band_rows;
            let rows = band_rows.min(rows - first);
            draw([width, top + first, rows]).0
        };
        // Left to itself rayon hands out quarters of a picture, one of which may take longer than the others.
        let bands = (0..rows.div_ceil(band_rows))
            .into_par_iter()
            .with_max_len(1);
        Self {
            width,
            bands: bands.map(band).collect(),
        }
    }

    /// The pixels of each row, three bytes each: what the display would show.
    pub(crate) fn into_rows_rgb888(self) -> impl Iterator<Item = Vec<u8>> {
        let width = self.width;
        self.bands.into_iter().flat_map(move |band| {
            let bytes = band.to_rgb888();
            let rows: Vec<Vec<u8>> = bytes.chunks(3 * width).map(<[u8]>::to_vec).collect();
            rows
        })
    }
}

impl<C: DisplayColor + Into<Rgb888> + Send + 'static> Band<'_, C> {
    /// Draws a band, which is black before.
    pub(crate) fn drawn(
        [width, top, rows]: [usize; 3],
        draw: impl FnOnce(&mut Band<'_, C>),
    ) -> DrawnBand {
        let mut pixels = vec![C::from_linear(Color::<f32>::BLACK, 0.5); width * rows];
        draw(&mut Band::new(width, top, &mut pixels));
        DrawnBand(Box::new(pixels))
    }
}

impl<'c, C> Band<'c, C> {
    fn new(width: usize, top: usize, pixels: &'c mut [C]) -> Self {
        // No picture has more than 65,535 rows or columns.
        let size = Size::new(width as u32, (pixels.len() / width) as u32);
        Self {
            area: Rectangle::new(Point::new(0, top as i32), size),
            pixels,
        }
    }

    /// The pixels of a row, from a place inside the area on.
    fn row_from(&mut self, place: Point) -> &mut [C] {
        let width = self.area.size.width as usize;
        let row = (place.y - self.area.top_left.y) as usize;
        let (start, end) = (row * width + place.x as usize, (row + 1) * width);
        &mut self.pixels[start..end]
    }
}

impl<C: Copy> Band<'_, C> {
    fn draw_pixel(&mut self, place: Point, color: C) {
        if self.area.contains(place) {
            self.row_from(place)[0] = color;
        }
    }
}

impl<C> Dimensions for Band<'_, C> {
    fn bounding_box(&self) -> Rectangle {
        self.area
    }
}

impl<C: PixelColor> DrawTarget for Band<'_, C> {
    type Color = C;
    type Error = Infallible;

    fn draw_iter<I>(&mut self, pixels: I) -> Result<(), Infallible>
    where
        I: IntoIterator<Item = Pixel<C>>,
    {
        for Pixel(place, color) in pixels {
            self.draw_pixel(place, color);
        }
        Ok(())
    }

    fn fill_contiguous<I>(&mut self, area: &Rectangle, colors: I) -> Result<(), Infallible>
    where
        I: IntoIterator<Item = C>,
    {
        if area.intersection(&self.area) != *area {
            // What lies outside is left out, but its colours are there.
            for (place, color) in area.points().zip(colors) {
                self.draw_pixel(place, color);
            }
            return Ok(());
        }
        let mut colors = colors.into_iter();
        for y in area.rows() {
            let row = self.row_from(Point::new(area.top_left.x, y));
            for (pixel, color) in row
                .iter_mut()
                .zip(colors.by_ref().take(area.size.width as usize))
            {
                *pixel = color;
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use embedded_graphics::pixelcolor::{BinaryColor, Gray2, Gray4, Gray8, Rgb555, Rgb565, Rgb666};
    use embedded_graphics::primitives::PrimitiveStyle;

    /// The bytes of a picture that one band draws with `draw`.
    fn drawn<C: DisplayColor + Into<Rgb888> + Send + Sync + 'static>(
        area: [u16; 3],
        draw: impl Fn(&mut Band<'_, C>) + Sync,
    ) -> Vec<Vec<u8>> {
        let canvas = Canvas::draw(area, area[2].into(), &|area| Band::drawn(area, &draw));
        canvas.into_rows_rgb888().collect()
    }

    /// What `level` of `levels` is in 8 bits.
    fn expanded(level: u8, levels: u16) -> u8 {
        ((u16::from(level) * 255 + levels / 2) / levels) as u8
    }

    #[test]
    fn expands_every_level_to_the_nearest_of_8_bits() {
        for level in 0..=255_u8 {
            let [gray] = [Gray8::new(level)].map(Into::<Rgb888>::into);
            assert_eq!(gray, Rgb888::new(level, level, level));
            let (five, six) = (level % 32, level % 64);
            let [r5, r6] = [expanded(five, 31), expanded(six, 63)];
            let color: Rgb888 = Rgb565::new(five, six, five).into();
            assert_eq!(color, Rgb888::new(r5, r6, r5));
            let color: Rgb888 = Rgb555::new(five, 0, 31).into();
            assert_eq!(color, Rgb888::new(r5, 0, 255));
            let color: Rgb888 = Rgb666::new(0, six, 63).into();
            assert_eq!(color, Rgb888::new(0, r6, 255));
            let color: Rgb888 = Gray4::new(level % 16).into();
            assert_eq!(color.g(), expanded(level % 16, 15));
            let color: Rgb888 = Gray2::new(level % 4).into();
            assert_eq!(color.b(), expanded(level % 4, 3));
        }
        assert_eq!(Rgb888::from(BinaryColor::On), Rgb888::WHITE);
        assert_eq!(Rgb888::from(BinaryColor::Off), Rgb888::BLACK);
    }

    #[test]
    fn keeps_the_coordinates_of_the_picture() {
        let rows = drawn([3, 5, 2], |band: &mut Band<'_, Gray8>| {
            let pixel = |x, y, level| Pixel(Point::new(x, y), Gray8::new(level));
            let outside = [
                pixel(0, 4, 9),
                pixel(-1, 5, 9),
                pixel(3, 5, 9),
                pixel(0, 7, 9),
            ];
            band.draw_iter(outside).unwrap();
            band.draw_iter([pixel(0, 5, 1), pixel(2, 6, 2)]).unwrap();
        });
        assert_eq!(
            rows,
            [[1, 1, 1, 0, 0, 0, 0, 0, 0], [0, 0, 0, 0, 0, 0, 2, 2, 2]]
        );
    }

    #[test]
    fn fills_areas_inside_and_across_its_border() {
        let colors = || (1..=6).map(Gray8::new);
        let firsts = |rows: Vec<Vec<u8>>| -> Vec<Vec<u8>> {
            let first = |row: Vec<u8>| row.into_iter().step_by(3).collect();
            rows.into_iter().map(first).collect()
        };
        let inside = drawn([4, 10, 3], |band: &mut Band<'_, Gray8>| {
            let area = Rectangle::new(Point::new(1, 11), Size::new(3, 2));
            band.fill_contiguous(&area, colors()).unwrap();
        });
        assert_eq!(firsts(inside), [[0, 0, 0, 0], [0, 1, 2, 3], [0, 4, 5, 6]]);
        let across = drawn([4, 10, 3], |band: &mut Band<'_, Gray8>| {
            let area = Rectangle::new(Point::new(-1, 9), Size::new(3, 2));
            band.fill_contiguous(&area, colors()).unwrap();
        });
        assert_eq!(firsts(across), [[5, 6, 0, 0], [0, 0, 0, 0], [0, 0, 0, 0]]);
        // A stream that ends early leaves the rest as it was.
        let short = drawn([4, 0, 1], |band: &mut Band<'_, Gray8>| {
            let area = band.bounding_box();
            band.fill_contiguous(&area, colors().take(2)).unwrap();
        });
        assert_eq!(firsts(short), [[1, 2, 0, 0]]);
    }

    #[test]
    fn takes_the_drawings_of_embedded_graphics() {
        let rows = drawn([4, 0, 4], |band: &mut Band<'_, BinaryColor>| {
            Rectangle::new(Point::new(-2, 2), Size::new(4, 9))
                .into_styled(PrimitiveStyle::with_fill(BinaryColor::On))
                .draw(band)
                .unwrap();
        });
        let white: usize = rows.iter().flatten().filter(|byte| **byte == 255).count();
        assert_eq!(white, 3 * 4);
    }
}
