//! Anti-aliasing where the picture has edges.

use core::cell::Cell;

use super::picture::PixelSource;
use super::supersampling::{SampleSource, Supersampled};
use crate::camera::{Resolution, Subpixel};
use crate::color::Color;
use crate::scalar::Scalar;
use crate::tracer::{Observer, RayCount};

/// Whether two colours differ in a channel by more than a threshold.
#[inline(always)]
pub fn differ<T: Scalar>(a: Color<T>, b: Color<T>, threshold: T) -> bool {
    (a.r - b.r).abs() > threshold || (a.g - b.g).abs() > threshold || (a.b - b.b).abs() > threshold
}

/// Room for the colour at the centre of a pixel, so that its neighbours need not trace it again.
#[derive(Clone, Copy, Debug)]
pub struct CenterSample<T = f32> {
    /// Row of the pixel; no picture has the row [`u16::MAX`].
    row: u16,
    color: Color<T>,
}

impl<T: Scalar> CenterSample<T> {
    /// Nothing is known.
    pub const EMPTY: Self = Self {
        row: u16::MAX,
        color: Color::BLACK,
    };
}

/// A source of pixels that have more samples where the picture has edges.
///
/// A pixel whose centre differs from that of a pixel beside, above or below by more than `threshold` in a
/// channel has the bits of [`Supersampled`]; any other has the bits of the source itself. Edges that pass
/// between the centres, and what is smaller than a pixel and lies beside them, are not found.
///
/// A pixel depends on five centres, so it is still a function of its coordinates, and any schedule gives
/// the same bits. `centers` keeps centres that are traced. With room for two rows
/// (`2 * WIDTH`) a picture that is drawn row by row traces each centre once; with less, what does not
/// fit is traced again for each neighbour, up to five times. The number of rays that a pixel takes
/// depends on what is kept, its colour never does.
///
/// ```
/// # use embedded_graphics::{mock_display::MockDisplay, pixelcolor::Rgb888, prelude::*};
/// # let mut pools: scanray::ScenePools = scanray::ScenePools::new();
/// # #[cfg(feature = "parser")]
/// # pools.parse(include_bytes!("../../scenes/default.txt")).unwrap();
/// # let tracer = scanray::Tracer::new(pools.as_scene());
/// # let tracer = tracer.with_resolution(scanray::Resolution { width: 16, height: 12 });
/// # let mut display = MockDisplay::<Rgb888>::new();
/// use scanray::{Adaptive, CenterSample, Picture};
///
/// let mut centers = [CenterSample::EMPTY; 2 * 16];
/// let smooth = Adaptive::<_, 16>::new(&tracer, 1.0 / 16.0, &mut centers);
/// Picture::new(&smooth).draw(&mut display)?;
/// # Ok::<(), core::convert::Infallible>(())
/// ```
#[derive(Debug)]
pub struct Adaptive<'c, S: SampleSource, const SAMPLES: usize> {
    refined: Supersampled<S, SAMPLES>,
    threshold: S::Scalar,
    /// Direct-mapped: those of even rows, then those of odd rows, by column.
    centers: &'c [Cell<CenterSample<S::Scalar>>],
}

/// What the pixels of a row have in common.
#[derive(Clone, Copy, Debug)]
pub struct AdaptiveScanline<L, const SAMPLES: usize> {
    y: u16,
    /// For the centres of the row above, of the row itself and of the row below.
    centers: [L; 3],
    refined: [L; SAMPLES],
}

impl<'c, S: SampleSource, const SAMPLES: usize> Adaptive<'c, S, SAMPLES> {
    /// The picture of a source with more samples at edges. `threshold` is a difference of channels in
    /// 0…1; at 0 every difference is an edge. What `centers` held is forgotten.
    pub fn new(
        source: S,
        threshold: S::Scalar,
        centers: &'c mut [CenterSample<S::Scalar>],
    ) -> Self {
        centers.fill(CenterSample::EMPTY);
        Self {
            refined: Supersampled::new(source),
            threshold,
            centers: Cell::from_mut(centers).as_slice_of_cells(),
        }
    }

    /// Colour of the pixel in column `x` of a row, watched: rays for centres that are kept are not cast.
    #[inline(always)]
    pub fn pixel_observed(
        &self,
        scanline: &AdaptiveScanline<S::Scanline, SAMPLES>,
        x: u16,
        observer: &mut impl Observer<S::Scalar>,
    ) -> Color<S::Scalar> {
        let Resolution { width, height } = self.resolution();
        let y = scanline.y;
        let mut own = Color::BLACK;
        let mut is_edge = false;
        // The pixel itself, then its neighbours; the one below comes last, because it is kept where the
        // one above was.
        for (dx, dy) in [(0, 0), (-1, 0), (1, 0), (0, -1), (0, 1)] {
            let (Some(x), Some(y)) = (x.checked_add_signed(dx), y.checked_add_signed(dy)) else {
                continue;
            };
            if x >= width || y >= height {
                continue;
            }
            let color = self.center(scanline, x, y, observer);
            if (dx, dy) == (0, 0) {
                own = color;
            }
            is_edge |= differ(own, color, self.threshold);
        }
        if is_edge {
            self.refined.pixel_observed(&scanline.refined, x, observer)
        } else {
            own
        }
    }

    /// The colour at the centre of a pixel of a row or of those next to it, kept or traced.
    #[inline(always)]
    fn center(
        &self,
        scanline: &AdaptiveScanline<S::Scanline, SAMPLES>,
        x: u16,
        y: u16,
        observer: &mut impl Observer<S::Scalar>,
    ) -> Color<S::Scalar> {
        let (even, odd) = self.centers.split_at(self.centers.len() / 2);
        let row = if y.is_multiple_of(2) { even } else { odd };
        let room = row.get(usize::from(x));
        if let Some(kept) = room.map(Cell::get)
            && kept.row == y
        {
            return kept.color;
        }
        let [above, beside, below] = &scanline.centers;
        let centers = match y {
            y if y < scanline.y => above,
            y if y > scanline.y => below,
            _ => beside,
        };
        let source = self.refined.source();
        let color = source.sample(centers, x, Subpixel::CENTER, observer);
        if let Some(room) = room {
            room.set(CenterSample { row: y, color });
        }
        color
    }
}

impl<S: SampleSource, const SAMPLES: usize> PixelSource for Adaptive<'_, S, SAMPLES> {
    type Scalar = S::Scalar;
    type Scanline = AdaptiveScanline<S::Scanline, SAMPLES>;

    fn resolution(&self) -> Resolution {
        self.refined.resolution()
    }

    #[inline(always)]
    fn scanline(&self, y: u16) -> Self::Scanline {
        let rows = [y.saturating_sub(1), y, y.saturating_add(1)];
        AdaptiveScanline {
            y,
            centers: rows.map(|y| self.refined.source().scanline(y)),
            refined: self.refined.scanline(y),
        }
    }

    #[inline(always)]
    fn pixel_on(&self, scanline: &Self::Scanline, x: u16) -> (Color<S::Scalar>, u32) {
        let mut rays = RayCount::default();
        let color = self.pixel_observed(scanline, x, &mut rays);
        (color, rays.0)
    }
}
