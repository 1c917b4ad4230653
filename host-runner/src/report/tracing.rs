//! Drawing with any settings.

use rayon::prelude::*;
use scanray::{
    Adaptive, CenterSample, Color, Nearest, Needs, Observer, PixelSource, Ray, Resolution,
    SampleSource, Scalar, Scanline, Scene, Subpixel, Supersampled, Tracer,
};

use super::references::DEPTH;
use super::settings::{Sampling, Settings};
use super::timing::HostTime;
use crate::cost::{Counter, Work};
use crate::drawing::Workers;
use crate::failure::Failure;

/// A tracer with every stage, and frames for the deepest reference.
///
/// Compiled once a scalar and observer, not once more for each way of sampling.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ReportTracer<'a, T>(AllStages<'a, T>);

type AllStages<'a, T> =
    Tracer<'a, T, { Needs::ALL.union(Needs::TREE).union(Needs::CUTOFF).bits() }, DEPTH>;

impl<'a, T: Scalar> ReportTracer<'a, T> {
    /// A tracer for a picture of a scene. A cut-off of 0 casts every ray.
    ///
    /// # Errors
    ///
    /// [`Failure::Usage`] for a maximum depth beyond [`DEPTH`].
    pub(crate) fn new(
        scene: Scene<'a, T>,
        resolution: Resolution,
        max_depth: usize,
        cutoff: f64,
    ) -> Result<Self, Failure> {
        Tracer::new(scene)
            .with_tree()
            .with_stack()
            .with_cutoff(T::from_f64(cutoff))
            .with_resolution(resolution)
            .with_max_depth(max_depth)
            .map(Self)
            .map_err(|error| Failure::Usage(error.to_string()))
    }

    /// The scene.
    pub(crate) fn scene(&self) -> &Scene<'a, T> {
        self.0.scene()
    }

    /// The object a ray meets first.
    pub(crate) fn nearest(&self, ray: &Ray<T>) -> Option<Nearest<'a, T>> {
        self.0.nearest(ray)
    }

    /// The colours of all pixels, row by row.
    pub(crate) fn colors(&self, sampling: Sampling, workers: &Workers) -> Vec<Color<T>> {
        match sampling {
            Sampling::Fixed(samples) => match samples {
                4 => rows(&Supersampled::<_, 4>::new(self), workers),
                16 => rows(&Supersampled::<_, 16>::new(self), workers),
                64 => rows(&Supersampled::<_, 64>::new(self), workers),
                _ => rows(self, workers),
            },
            Sampling::Adaptive(denominator) => self.with_adaptive(denominator, |source| {
                let mut colors = Vec::new();
                draw(source, |color| colors.push(color));
                colors
            }),
        }
    }

    /// What the picture takes.
    pub(crate) fn work(&self, sampling: Sampling, workers: &Workers) -> Work {
        let Resolution { width, height } = self.resolution();
        macro_rules! supersampled {
            ($samples:literal) => {{
                let source = Supersampled::<_, $samples>::new(self);
                Work::count(width, 0..height, workers, |y, counter| {
                    let scanlines = source.scanline(y);
                    for x in 0..width {
                        source.pixel_observed(&scanlines, x, counter);
                    }
                })
            }};
        }
        match sampling {
            Sampling::Fixed(samples) => match samples {
                4 => supersampled!(4),
                16 => supersampled!(16),
                64 => supersampled!(64),
                _ => supersampled!(1),
            },
            Sampling::Adaptive(denominator) => self.with_adaptive(denominator, |source| {
                let mut counter = Counter::new();
                for y in 0..height {
                    let scanline = source.scanline(y);
                    for x in 0..width {
                        source.pixel_observed(&scanline, x, &mut counter);
                    }
                }
                counter.finish(u64::from(width) * u64::from(height))
            }),
        }
    }

    /// How long the picture takes.
    pub(crate) fn time(&self, sampling: Sampling) -> HostTime {
        let draw_all = |source: &dyn Fn()| HostTime::measure(source);
        macro_rules! supersampled {
            ($samples:literal) => {
                draw_all(&|| {
                    draw(&Supersampled::<_, $samples>::new(self), |color| {
                        std::hint::black_box(color);
                    })
                })
            };
        }
        match sampling {
            Sampling::Fixed(samples) => match samples {
                4 => supersampled!(4),
                16 => supersampled!(16),
                64 => supersampled!(64),
                _ => supersampled!(1),
            },
            Sampling::Adaptive(denominator) => draw_all(&|| {
                self.with_adaptive(denominator, |source| {
                    draw(source, |color| {
                        std::hint::black_box(color);
                    });
                });
            }),
        }
    }

    /// An adaptive source with room for two rows of centres, as a device would have.
    fn with_adaptive<R>(
        &self,
        denominator: u16,
        use_it: impl FnOnce(&Adaptive<'_, &Self, { Settings::ADAPTIVE_SAMPLES }>) -> R,
    ) -> R {
        let mut centers = vec![CenterSample::EMPTY; 2 * usize::from(self.resolution().width)];
        let threshold = T::ONE / T::from_i32(i32::from(denominator));
        use_it(&Adaptive::new(self, threshold, &mut centers))
    }
}

/// All pixels of a source, row by row.
fn rows<P: PixelSource + Sync>(source: &P, workers: &Workers) -> Vec<Color<P::Scalar>> {
    let Resolution { width, height } = source.resolution();
    let row = |y: u16| {
        let scanline = source.scanline(y);
        (0..width)
            .map(|x| source.pixel_on(&scanline, x).0)
            .collect::<Vec<_>>()
    };
    workers.install(|| (0..height).into_par_iter().flat_map_iter(row).collect())
}

/// The same on one thread.
fn draw<P: PixelSource>(source: &P, mut take: impl FnMut(Color<P::Scalar>)) {
    let Resolution { width, height } = source.resolution();
    for y in 0..height {
        let scanline = source.scanline(y);
        for x in 0..width {
            take(source.pixel_on(&scanline, x).0);
        }
    }
}

impl<T: Scalar> PixelSource for ReportTracer<'_, T> {
    type Scalar = T;
    type Scanline = Scanline<T>;

    fn resolution(&self) -> Resolution {
        self.0.resolution()
    }

    fn scanline(&self, y: u16) -> Scanline<T> {
        self.0.scanline(y)
    }

    #[inline(never)]
    fn pixel_on(&self, scanline: &Scanline<T>, x: u16) -> (Color<T>, u32) {
        self.0.pixel_on(scanline, x)
    }
}

impl<T: Scalar> SampleSource for ReportTracer<'_, T> {
    fn scanline_at(&self, y: u16, at: Subpixel) -> Scanline<T> {
        self.0.scanline_at(y, at)
    }

    #[inline(never)]
    fn sample(
        &self,
        scanline: &Scanline<T>,
        x: u16,
        at: Subpixel,
        observer: &mut impl Observer<T>,
    ) -> Color<T> {
        self.0.sample_observed(scanline, x, at, observer)
    }
}
