//! Several samples a pixel, on a fixed pattern.

use super::picture::PixelSource;
use crate::camera::{Resolution, Subpixel};
use crate::color::Color;
use crate::scalar::Scalar;
use crate::tracer::{Observer, RayCount, Scanline, Tracer};

/// A source whose pixels can be sampled beside their centres: a [`Tracer`], whatever its stages and
/// stack, and what wraps one.
pub trait SampleSource: PixelSource {
    /// What the samples at a place in the pixels of row `y` have in common.
    fn scanline_at(&self, y: u16, at: Subpixel) -> Self::Scanline;

    /// The colour at a place in the pixel in column `x`, for the scanline of that place. At
    /// [`Subpixel::CENTER`] it is the pixel's.
    fn sample(
        &self,
        scanline: &Self::Scanline,
        x: u16,
        at: Subpixel,
        observer: &mut impl Observer<Self::Scalar>,
    ) -> Color<Self::Scalar>;
}

impl<T: Scalar, const STAGES: u64, const STACK: usize> SampleSource
    for Tracer<'_, T, STAGES, STACK>
{
    #[inline(always)]
    fn scanline_at(&self, y: u16, at: Subpixel) -> Scanline<T> {
        Tracer::scanline_at(self, y, at)
    }

    #[inline(always)]
    fn sample(
        &self,
        scanline: &Scanline<T>,
        x: u16,
        at: Subpixel,
        observer: &mut impl Observer<T>,
    ) -> Color<T> {
        self.sample_observed(scanline, x, at, observer)
    }
}

impl<S: SampleSource> SampleSource for &S {
    #[inline(always)]
    fn scanline_at(&self, y: u16, at: Subpixel) -> Self::Scanline {
        (**self).scanline_at(y, at)
    }

    #[inline(always)]
    fn sample(
        &self,
        scanline: &Self::Scanline,
        x: u16,
        at: Subpixel,
        observer: &mut impl Observer<Self::Scalar>,
    ) -> Color<Self::Scalar> {
        (**self).sample(scanline, x, at, observer)
    }
}

/// A source of pixels that are each the mean of 1, 4, 16 or 64 samples.
///
/// The samples lie where Hammersley's points do, with the rows exchanged for the largest distances: sample
/// `i` of `N` in column `i` and in row `reverse(i) ⊕ (√N − 1)` of `N`×`N` cells, `reverse` being the
/// reversal of the bits. So every column and every row of cells holds one sample, and so does every
/// larger cell of `√N`×`√N`; an edge takes `N` shades, most of all the nearly horizontal and vertical ones
/// that show steps. 4 are the well-known rotated grid; 1 is the centre, with the bits of the source
/// itself.
///
/// The scanline holds one of the source for each sample.
///
/// ```
/// # use embedded_graphics::{mock_display::MockDisplay, pixelcolor::Rgb888, prelude::*};
/// # let mut pools: scanray::ScenePools = scanray::ScenePools::new();
/// # #[cfg(feature = "parser")]
/// # pools.parse(include_bytes!("../../scenes/default.txt")).unwrap();
/// # let tracer = scanray::Tracer::new(pools.as_scene());
/// # let tracer = tracer.with_resolution(scanray::Resolution { width: 16, height: 12 });
/// # let mut display = MockDisplay::<Rgb888>::new();
/// use scanray::{render::Supersampled, Picture};
///
/// Picture::new(Supersampled::<_, 4>::new(&tracer)).draw(&mut display)?;
/// # Ok::<(), core::convert::Infallible>(())
/// ```
///
/// Other numbers of samples do not compile:
///
/// ```compile_fail,E0080
/// # let pools: scanray::ScenePools = scanray::ScenePools::new();
/// # let tracer = scanray::Tracer::new(pools.as_scene());
/// scanray::render::Supersampled::<_, 8>::new(&tracer);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Supersampled<S, const SAMPLES: usize> {
    source: S,
}

impl<S, const SAMPLES: usize> Supersampled<S, SAMPLES> {
    /// Where the samples of a pixel are, from left to right.
    pub const PATTERN: [Subpixel; SAMPLES] = {
        assert!(
            matches!(SAMPLES, 1 | 4 | 16 | 64),
            "a pixel can have 1, 4, 16 or 64 samples"
        );
        let bits = SAMPLES.trailing_zeros();
        let mut pattern = [Subpixel::CENTER; SAMPLES];
        let mut i = 0;
        while i < SAMPLES {
            let reversed = (i as u8).reverse_bits() as u32 >> (8 - bits);
            pattern[i] = Subpixel {
                column: i as u8,
                row: reversed as u8 ^ ((1 << (bits / 2)) - 1),
                of: SAMPLES as u8,
            };
            i += 1;
        }
        pattern
    };
}

impl<S: SampleSource, const SAMPLES: usize> Supersampled<S, SAMPLES> {
    /// The picture of a source with more samples.
    pub const fn new(source: S) -> Self {
        const { assert!(Self::PATTERN.len() == SAMPLES) };
        Self { source }
    }

    /// The source of the samples.
    pub const fn source(&self) -> &S {
        &self.source
    }

    /// Colour of the pixel in column `x` of a row, watched: the sum of the samples in the order of
    /// [`Supersampled::PATTERN`], divided by their number, which is exact.
    #[inline(always)]
    pub fn pixel_observed(
        &self,
        scanlines: &[S::Scanline; SAMPLES],
        x: u16,
        observer: &mut impl Observer<S::Scalar>,
    ) -> Color<S::Scalar> {
        let mut sum = Color::BLACK;
        for (at, scanline) in Self::PATTERN.iter().zip(scanlines) {
            sum = sum + self.source.sample(scanline, x, *at, observer);
        }
        Self::mean(sum)
    }

    /// Of the samples of a pixel, from their sum.
    #[inline(always)]
    pub(super) fn mean(sum: Color<S::Scalar>) -> Color<S::Scalar> {
        sum * (S::Scalar::ONE / S::Scalar::from_i32(SAMPLES as i32))
    }
}

impl<S: SampleSource, const SAMPLES: usize> PixelSource for Supersampled<S, SAMPLES> {
    type Scalar = S::Scalar;
    type Scanline = [S::Scanline; SAMPLES];

    fn resolution(&self) -> Resolution {
        self.source.resolution()
    }

    #[inline(always)]
    fn scanline(&self, y: u16) -> [S::Scanline; SAMPLES] {
        Self::PATTERN.map(|at| self.source.scanline_at(y, at))
    }

    #[inline(always)]
    fn pixel_on(&self, scanlines: &[S::Scanline; SAMPLES], x: u16) -> (Color<S::Scalar>, u32) {
        let mut rays = RayCount::default();
        let color = self.pixel_observed(scanlines, x, &mut rays);
        (color, rays.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::vec::Vec;

    /// Every column and row of cells and every larger cell of a pixel holds one of the samples, and the
    /// pattern is its own image under half a turn.
    fn is_a_net<const SAMPLES: usize>() {
        let pattern = Supersampled::<(), SAMPLES>::PATTERN;
        let side = SAMPLES.isqrt();
        let places: Vec<[usize; 2]> = pattern
            .iter()
            .map(|at| {
                assert_eq!(usize::from(at.of), SAMPLES);
                [at.column.into(), at.row.into()]
            })
            .collect();
        let cells = |cell: &dyn Fn([usize; 2]) -> usize| {
            let mut cells: Vec<usize> = places.iter().map(|place| cell(*place)).collect();
            cells.sort_unstable();
            assert!(cells.iter().copied().eq(0..SAMPLES), "{places:?}");
        };
        cells(&|[column, _]| column);
        cells(&|[_, row]| row);
        cells(&|[column, row]| column / side + row / side * side);
        for [column, row] in &places {
            assert!(places.contains(&[SAMPLES - 1 - column, SAMPLES - 1 - row]));
        }
    }

    #[test]
    fn patterns_are_nets() {
        is_a_net::<1>();
        is_a_net::<4>();
        is_a_net::<16>();
        is_a_net::<64>();
    }

    #[test]
    fn four_are_the_rotated_grid_and_one_is_the_centre() {
        assert_eq!(Supersampled::<(), 1>::PATTERN, [Subpixel::CENTER]);
        let places = Supersampled::<(), 4>::PATTERN.map(|at| (at.column, at.row));
        assert_eq!(places, [(0, 1), (1, 3), (2, 0), (3, 2)]);
    }
}
