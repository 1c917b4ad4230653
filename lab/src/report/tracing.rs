//! Drawing with any settings.

use rayon::prelude::*;
use scanray::{
    Color, Ray, Resolution, Scalar, Scene, Stages, Tracer,
    camera::Subpixel,
    render::{Adaptive, CenterSample, PixelSource, SampleSource, Supersampled},
    tracer::{Nearest, Observer, Scanline},
};

use super::references::DEPTH;
use super::settings::{Sampling, Settings};
use super::timing::HostTime;
use crate::cost::Work;
use scanray_host::failure::Failure;
use scanray_host::knobs::Detail;
use scanray_host::parallel_drawing::Workers;

/// Does something with the source of a way of sampling: the adaptive one stays on its thread.
macro_rules! with_source {
    ($tracer:expr, $sampling:expr, |$source:ident| adaptive: $adaptive:expr, fixed: $fixed:expr) => {
        match $sampling {
            Sampling::Adaptive(denominator) => {
                $tracer.with_adaptive(denominator, |$source| $adaptive)
            }
            Sampling::Fixed(4) => {
                let $source = &Supersampled::<_, 4>::new($tracer);
                $fixed
            }
            Sampling::Fixed(16) => {
                let $source = &Supersampled::<_, 16>::new($tracer);
                $fixed
            }
            Sampling::Fixed(64) => {
                let $source = &Supersampled::<_, 64>::new($tracer);
                $fixed
            }
            Sampling::Fixed(_) => {
                let $source = &Supersampled::<_, 1>::new($tracer);
                $fixed
            }
        }
    };
}

/// A tracer with every stage, and frames for the deepest reference.
///
/// Compiled once a scalar and observer, not once more for each way of sampling.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ReportTracer<'a, T>(AllStages<'a, T>);

type AllStages<'a, T> =
    Tracer<'a, T, { Stages::ALL.union(Stages::BVH).union(Stages::CUTOFF).bits() }, DEPTH>;

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
            .with_bvh()
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

    /// The object a ray hits first.
    pub(crate) fn nearest(&self, ray: &Ray<T>) -> Option<Nearest<'a, T>> {
        self.0.nearest(ray)
    }

    /// The rays through the centres of all pixels, row by row.
    pub(crate) fn primary_rays(&self) -> Vec<Ray<T>> {
        let Resolution { width, height } = self.resolution();
        let row = |y: u16| {
            let scanline = self.0.scanline(y);
            (0..width).map(move |x| self.0.primary_ray(&scanline, x))
        };
        (0..height).flat_map(row).collect()
    }

    /// The colours of all pixels, row by row. Those of a preview are repeated.
    pub(crate) fn colors(
        &self,
        sampling: Sampling,
        preview: Detail,
        workers: &Workers,
    ) -> Vec<Color<T>> {
        let mut colors = with_source!(self, sampling, |source|
            adaptive: {
                let mut colors = Vec::new();
                draw(source, 1, |color| colors.push(color));
                colors
            },
            fixed: rows(source, workers));
        if preview != Detail::Full {
            let (width, block) = (
                usize::from(self.resolution().width),
                usize::from(preview.block()),
            );
            // What is overwritten lies behind what is read.
            for at in 0..colors.len() {
                let (x, y) = (at % width, at / width);
                colors[at] = colors[(y - y % block) * width + (x - x % block)];
            }
        }
        colors
    }

    /// What the picture takes.
    pub(crate) fn work(&self, sampling: Sampling, preview: Detail, workers: &Workers) -> Work {
        let Resolution { width, height } = self.resolution();
        let block = preview.block();
        with_source!(self, sampling, |source|
        // Its rows hand centres on, and are counted one after the other.
        adaptive: {
            let mut work = Work::of_pixels(u64::from(width) * u64::from(height));
            for y in 0..height {
                let scanline = source.scanline(y);
                for x in 0..width {
                    source.pixel_observed(&scanline, x, &mut work);
                }
            }
            work.compared(true)
        },
        fixed: Work::count(width, 0..height, workers, |y, work| {
            if y % block != 0 {
                return;
            }
            let scanlines = source.scanline(y);
            for x in (0..width).step_by(block.into()) {
                source.pixel_observed(&scanlines, x, work);
            }
        }))
    }

    /// How long the picture takes.
    pub(crate) fn time(&self, sampling: Sampling, preview: Detail) -> HostTime {
        let forget = |color| {
            std::hint::black_box(color);
        };
        HostTime::measure(&|| {
            with_source!(self, sampling, |source|
                adaptive: draw(source, 1, forget),
                fixed: draw(source, preview.block(), forget));
        })
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

/// The same on one thread, of each block its first pixel.
pub(super) fn draw<P: PixelSource>(source: &P, block: u16, mut take: impl FnMut(Color<P::Scalar>)) {
    let Resolution { width, height } = source.resolution();
    for y in (0..height).step_by(block.into()) {
        let scanline = source.scanline(y);
        for x in (0..width).step_by(block.into()) {
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
