//! Pictures of differences, with a legend.

use std::convert::Infallible;

use colorous::{Gradient, MAGMA, TURBO};
use embedded_graphics::mono_font::MonoTextStyle;
use embedded_graphics::mono_font::ascii::FONT_6X10;
use embedded_graphics::pixelcolor::Rgb888;
use embedded_graphics::prelude::*;
use embedded_graphics::primitives::{PrimitiveStyle, Rectangle};
use embedded_graphics::text::{Baseline, Text};

use super::{Comparison, level_differences};
use crate::image::Image;

/// Height of the legend below the picture.
const LEGEND_HEIGHT: usize = 14;

/// Width of a colour of the legend and its label.
const ENTRY_WIDTH: usize = 62;

/// What the colours of differences in levels stand for.
pub fn level_legend() -> [(String, [u8; 3]); 8] {
    std::array::from_fn(|class| {
        let label = match (1 << class, (2 << class) - 1) {
            (1, _) => "1 of 255".to_owned(),
            (first, last) => format!("{first}-{last}"),
        };
        (label, color(TURBO, (class + 1) as f64 / 8.0))
    })
}

/// The differences in levels: where there is none the picture itself, grey and dark; elsewhere a colour
/// for each power of 2.
pub fn level_map(reference: &Image, test: &Image) -> Image {
    let legend = level_legend();
    let rows = reference.rgb888.chunks_exact(3);
    let pixels = rows.zip(level_differences(reference, test));
    let pixels = pixels.flat_map(|(pixel, difference)| {
        match difference.into_iter().max().and_then(u8::checked_ilog2) {
            Some(class) => legend[class as usize].1,
            None => {
                let sum: u16 = pixel.iter().map(|value| u16::from(*value)).sum();
                [(sum / 9) as u8; 3]
            }
        }
    });
    Image {
        rgb888: pixels.collect(),
        ..*reference
    }
}

/// The same with its legend.
pub fn level_picture(reference: &Image, test: &Image) -> Image {
    with_legend(
        reference,
        level_map(reference, test).rgb888,
        &level_legend(),
    )
}

/// The FLIP errors in the colours of its authors, from black (looks the same) to light yellow.
pub fn flip_picture(reference: &Image, comparison: &Comparison) -> Image {
    let errors = comparison.flip_map.iter();
    let pixels = errors.flat_map(|error| color(MAGMA, f64::from(*error)));
    let entries: Vec<_> = [0.0, 0.2, 0.4, 0.6, 0.8, 1.0]
        .map(|error| (format!("{error:.1}"), color(MAGMA, error)))
        .into();
    with_legend(reference, pixels.collect(), &entries)
}

fn color(gradient: Gradient, place: f64) -> [u8; 3] {
    gradient.eval_continuous(place.clamp(0.0, 1.0)).as_array()
}

/// A picture of `size`'s size and a legend below it, as wide as the wider of both.
fn with_legend(size: &Image, rgb888: Vec<u8>, entries: &[(String, [u8; 3])]) -> Image {
    let width = size.width.max(entries.len() * ENTRY_WIDTH);
    let height = size.height + LEGEND_HEIGHT;
    let mut image = Image {
        width,
        height,
        rgb888: vec![0; width * height * 3],
    };
    let row_bytes = size.width * 3;
    let rows = image.rgb888.chunks_exact_mut(width * 3);
    for (to, from) in rows.zip(rgb888.chunks_exact(row_bytes)) {
        to[..row_bytes].copy_from_slice(from);
    }
    let style = MonoTextStyle::new(&FONT_6X10, Rgb888::WHITE);
    for (index, (label, [r, g, b])) in entries.iter().enumerate() {
        let corner = Point::new((index * ENTRY_WIDTH) as i32 + 1, size.height as i32 + 2);
        let Ok(()) = Rectangle::new(corner, Size::new(8, 10))
            .into_styled(PrimitiveStyle::with_fill(Rgb888::new(*r, *g, *b)))
            .draw(&mut image);
        let corner = corner + Point::new(10, 0);
        let Ok(_) = Text::with_baseline(label, corner, style, Baseline::Top).draw(&mut image);
    }
    image
}

impl OriginDimensions for Image {
    fn size(&self) -> Size {
        Size::new(self.width as u32, self.height as u32)
    }
}

impl DrawTarget for Image {
    type Color = Rgb888;
    type Error = Infallible;

    fn draw_iter<I>(&mut self, pixels: I) -> Result<(), Infallible>
    where
        I: IntoIterator<Item = Pixel<Rgb888>>,
    {
        let bounds = self.bounding_box();
        for Pixel(place, color) in pixels {
            if bounds.contains(place) {
                let index = place.y as usize * self.width + place.x as usize;
                self.rgb888[index * 3..][..3].copy_from_slice(&[color.r(), color.g(), color.b()]);
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shows_each_difference_in_the_colour_of_the_legend() {
        let (width, height) = (9, 1);
        let reference = Image {
            width,
            height,
            rgb888: vec![90; 27],
        };
        let mut test = reference.clone();
        for (pixel, level) in [0, 1, 2, 3, 4, 9, 30, 90, 160].into_iter().enumerate() {
            test.rgb888[pixel * 3 + 1] = 90_u8.wrapping_add(level);
        }
        let picture = level_picture(&reference, &test);
        assert_eq!(
            (picture.width, picture.height),
            (8 * ENTRY_WIDTH, 1 + LEGEND_HEIGHT)
        );
        let pixel = |x: usize, y: usize| &picture.rgb888[(y * picture.width + x) * 3..][..3];
        assert_eq!(pixel(0, 0), [30; 3]);
        for (x, class) in [(1, 0), (2, 1), (3, 1), (4, 2), (5, 3), (6, 4), (7, 6)] {
            assert_eq!(pixel(x, 0), pixel(class * ENTRY_WIDTH + 3, 5), "{x}");
        }
        // 90 + 160 is 250: a difference of 160.
        assert_eq!(pixel(8, 0), pixel(7 * ENTRY_WIDTH + 3, 5));
        assert_eq!(pixel(9, 0), [0; 3]);
    }
}
