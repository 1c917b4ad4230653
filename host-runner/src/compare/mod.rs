//! How different two pictures are.

mod color_space;
mod flip;
mod picture;

pub use flip::DEFAULT_PIXELS_PER_DEGREE;
pub use picture::{flip_picture, level_legend, level_map, level_picture};

use crate::image::Image;

/// The measures of the difference between two pictures of the same size.
///
/// Levels are those of 8 bits, 0 to 255. A pixel's difference is that of the channel that differs most.
#[derive(Clone, Debug)]
pub struct Comparison {
    /// How many pixels differ by each number of levels.
    pixels_by_difference: Box<[u64; 256]>,
    /// The first of the pixels that differ most, as column and row.
    largest_at: [usize; 2],
    /// Root of the mean squared difference of all channels, in levels.
    pub rmse: f64,
    /// The FLIP error of each pixel.
    pub flip_map: Vec<f32>,
}

impl Comparison {
    /// Compares a picture with another, which must have its size.
    pub fn of(reference: &Image, test: &Image, pixels_per_degree: f32) -> Self {
        let mut pixels_by_difference = Box::new([0; 256]);
        let mut squares = 0_u64;
        let (mut largest, mut largest_at) = (0, 0);
        for (index, difference) in level_differences(reference, test).enumerate() {
            let of_pixel = difference.into_iter().max().unwrap_or(0);
            pixels_by_difference[usize::from(of_pixel)] += 1;
            squares += difference.map(|d| u64::from(d).pow(2)).iter().sum::<u64>();
            if of_pixel > largest {
                (largest, largest_at) = (of_pixel, index);
            }
        }
        Self {
            pixels_by_difference,
            largest_at: [largest_at % reference.width, largest_at / reference.width],
            rmse: (squares as f64 / reference.rgb888.len() as f64).sqrt(),
            flip_map: flip::error_map(reference, test, pixels_per_degree),
        }
    }

    /// Number of pixels.
    pub fn pixels(&self) -> u64 {
        self.pixels_by_difference.iter().sum()
    }

    /// Pixels that differ by more levels.
    pub fn pixels_beyond(&self, tolerance: u8) -> u64 {
        self.pixels_by_difference[usize::from(tolerance) + 1..]
            .iter()
            .sum()
    }

    /// The largest difference, in levels.
    pub fn maximum(&self) -> u8 {
        (0..=u8::MAX)
            .rev()
            .find(|level| self.pixels_by_difference[usize::from(*level)] > 0)
            .unwrap_or(0)
    }

    /// Column and row of the first pixel that differs most, if any differs.
    pub fn largest_at(&self) -> Option<[usize; 2]> {
        (self.maximum() > 0).then_some(self.largest_at)
    }

    /// Peak signal-to-noise ratio in decibels, `20 log₁₀(255/RMSE)`; infinite for equal pictures.
    pub fn psnr(&self) -> f64 {
        20.0 * (255.0 / self.rmse).log10()
    }

    /// The mean of the FLIP errors, 0 (look the same) to 1.
    pub fn flip(&self) -> f64 {
        let sum: f64 = self.flip_map.iter().map(|error| f64::from(*error)).sum();
        sum / self.flip_map.len() as f64
    }
}

/// How many levels the channels of each pixel differ by.
fn level_differences<'a>(a: &'a Image, b: &'a Image) -> impl Iterator<Item = [u8; 3]> + 'a {
    let pixels = a.rgb888.chunks_exact(3).zip(b.rgb888.chunks_exact(3));
    pixels.map(|(a, b)| [0, 1, 2].map(|channel| a[channel].abs_diff(b[channel])))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn image(pixels: &[[u8; 3]]) -> Image {
        Image {
            width: 2,
            height: pixels.len() / 2,
            rgb888: pixels.concat(),
        }
    }

    #[test]
    fn measures_are_those_computed_by_hand() {
        let a = image(&[[0, 0, 0], [10, 20, 30], [255, 0, 7], [1, 1, 1]]);
        let b = image(&[[0, 0, 0], [10, 22, 29], [255, 4, 7], [1, 1, 5]]);
        for (a, b) in [(&a, &b), (&b, &a)] {
            let comparison = Comparison::of(a, b, DEFAULT_PIXELS_PER_DEGREE);
            assert_eq!(comparison.pixels(), 4);
            let beyond = [0, 1, 2, 3, 4, 255].map(|t| comparison.pixels_beyond(t));
            assert_eq!(beyond, [3, 3, 2, 2, 0, 0]);
            assert_eq!(comparison.maximum(), 4);
            assert_eq!(comparison.largest_at(), Some([0, 1]));
            // (4 + 1 + 16 + 16)/12
            assert!((comparison.rmse - (37.0_f64 / 12.0).sqrt()).abs() < 1e-12);
            assert!(
                (comparison.psnr() - 43.240_1).abs() < 1e-3,
                "{}",
                comparison.psnr()
            );
            assert!(comparison.flip() > 0.0);
        }
        let same = Comparison::of(&a, &a, DEFAULT_PIXELS_PER_DEGREE);
        assert_eq!((same.maximum(), same.largest_at()), (0, None));
        assert_eq!(
            (same.rmse, same.psnr(), same.flip()),
            (0.0, f64::INFINITY, 0.0)
        );
        let black = image(&[[0; 3]; 2]);
        let white = image(&[[255; 3]; 2]);
        let opposite = Comparison::of(&black, &white, DEFAULT_PIXELS_PER_DEGREE);
        assert_eq!((opposite.rmse, opposite.psnr()), (255.0, 0.0));
        assert_eq!(opposite.pixels_beyond(254), 2);
    }
}
