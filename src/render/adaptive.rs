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
    /// Row of the pixel, counted from 1: a `static` of zeros takes no flash. No picture has the row [`u16::MAX`].
    row_from_1: u16,
    color: Color<T>,
}

impl<T: Scalar> CenterSample<T> {
    /// Nothing is known.
    pub const EMPTY: Self = Self {
        row_from_1: 0,
        color: Color::BLACK,
    };
}

/// The pixels whose centres decide about a pixel, as offsets of its column and row: itself, and its neighbours. The one below
/// comes last, because it is kept where the one above was.
const CENTERS: [(i16, i16); 5] = [(0, 0), (-1, 0), (1, 0), (0, -1), (0, 1)];

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
/// use scanray::{render::{Adaptive, CenterSample}, Picture};
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

impl<L, const SAMPLES: usize> AdaptiveScanline<L, SAMPLES> {
    /// For the centres of the row so many rows further: −1, 0 or 1.
    #[inline(always)]
    fn of_centers(&self, rows: i16) -> &L {
        let [above, beside, below] = &self.centers;
        match rows {
            ..0 => above,
            0 => beside,
            1.. => below,
        }
    }

    /// For a sample of the pattern, and where that is.
    #[inline(always)]
    fn of_sample(&self, index: usize) -> Option<(&L, Subpixel)> {
        let at = Supersampled::<(), SAMPLES>::PATTERN.get(index)?;
        Some((self.refined.get(index)?, *at))
    }
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
        let source = self.refined.source();
        let mut own = Color::BLACK;
        let mut is_edge = false;
        let mut sum = Color::BLACK;
        // Centres and samples in one loop, so that the source is compiled once.
        for step in 0..CENTERS.len() + SAMPLES {
            let center = CENTERS.get(step).copied();
            let (column, row) = match center {
                Some(offset) => match self.neighbor(x, scanline.y, offset) {
                    Some(place) => place,
                    None => continue,
                },
                None if is_edge => (x, scanline.y),
                None => return own,
            };
            let room = center.and_then(|_| self.room(column, row));
            let kept = room
                .map(Cell::get)
                .filter(|kept| kept.row_from_1 == row + 1);
            let color = match kept {
                Some(kept) => kept.color,
                None => {
                    let (line, at) = match center {
                        Some((_, rows)) => (scanline.of_centers(rows), Subpixel::CENTER),
                        None => match scanline.of_sample(step - CENTERS.len()) {
                            Some(sample) => sample,
                            None => break,
                        },
                    };
                    let color = source.sample(line, column, at, observer);
                    if let Some(room) = room {
                        room.set(CenterSample {
                            row_from_1: row + 1,
                            color,
                        });
                    }
                    color
                }
            };
            match center {
                None => sum = sum + color,
                Some((0, 0)) => own = color,
                Some(_) => is_edge |= differ(own, color, self.threshold),
            }
        }
        Supersampled::<S, SAMPLES>::mean(sum)
    }

    /// The column and row of a pixel so many columns and rows further, if the picture has it.
    #[inline(always)]
    fn neighbor(&self, x: u16, y: u16, (dx, dy): (i16, i16)) -> Option<(u16, u16)> {
        let Resolution { width, height } = self.resolution();
        let (x, y) = (x.checked_add_signed(dx)?, y.checked_add_signed(dy)?);
        (x < width && y < height).then_some((x, y))
    }

    /// Where the centre of a pixel is kept.
    #[inline(always)]
    fn room(&self, x: u16, y: u16) -> Option<&'c Cell<CenterSample<S::Scalar>>> {
        let (even, odd) = self.centers.split_at(self.centers.len() / 2);
        let row = if y.is_multiple_of(2) { even } else { odd };
        row.get(usize::from(x))
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
