//! The core as the host uses it: every stage, the deepest stack, every knob.

use std::ops::Range;

use scanray::{
    Color, Ray, Resolution, Scalar, Scene, Stages, Tracer,
    camera::Subpixel,
    render::{PixelSource, differ},
    shape::Object,
    tracer::{Intersection, LightAtHit, Observer, RayCount, RayKind, Scanline, TestKind},
};

use crate::cost::Work;
use crate::failure::Failure;
use crate::knobs::Knobs;
use crate::parallel_drawing::Workers;
use crate::progress::Progress;

/// The largest maximum depth.
pub(crate) const MAX_DEPTH: usize = 32;

/// A tracer with every stage but the cut-off.
pub(crate) type AllStages<'a, T> =
    Tracer<'a, T, { Stages::ALL.union(Stages::BVH).bits() }, MAX_DEPTH>;

type WithCutoff<'a, T> =
    Tracer<'a, T, { Stages::ALL.union(Stages::BVH).union(Stages::CUTOFF).bits() }, MAX_DEPTH>;

/// Traces single rays. It can be watched; [`HostPixels`](crate::host_pixels::HostPixels) is the
/// faster way to the same pixels.
///
/// As a source of pixels it is compiled once a scalar, not once more for each colour.
#[derive(Clone, Copy, Debug)]
pub(crate) struct HostTracer<'a, T> {
    /// For rows of samples, unless there is a cut-off.
    tracer: AllStages<'a, T>,
    /// For everything else: a cut-off of 0 casts every ray.
    cut: WithCutoff<'a, T>,
    knobs: Knobs,
}

/// What the pixels of a row have in common.
#[derive(Clone, Debug)]
pub(crate) struct HostScanline<T> {
    /// The row whose pixels are shown: another one in the lower rows of blocks.
    shown: u16,
    is_repeated: bool,
    /// For the centres of the row above, of the row itself and of the one below; the others count with
    /// edges alone.
    centers: [Scanline<T>; 3],
    /// For each sample.
    samples: Vec<Scanline<T>>,
}

impl<'a, T: Scalar> HostTracer<'a, T> {
    /// A tracer for a picture of a scene.
    ///
    /// # Errors
    ///
    /// [`Failure::Usage`] for a larger maximum depth than [`MAX_DEPTH`].
    pub(crate) fn new(
        scene: Scene<'a, T>,
        resolution: Resolution,
        max_depth: usize,
    ) -> Result<Self, Failure> {
        Tracer::new(scene)
            .with_bvh()
            .with_stack()
            .with_resolution(resolution)
            .with_max_depth(max_depth)
            .map(|tracer| Self {
                tracer,
                cut: tracer.with_cutoff(T::ZERO),
                knobs: Knobs::default(),
            })
            .map_err(|error| Failure::Usage(error.to_string()))
    }

    /// The same tracer with other knobs.
    pub(crate) fn with_knobs(self, knobs: Knobs) -> Self {
        Self {
            cut: self.tracer.with_cutoff(T::from_f64(knobs.cutoff)),
            knobs,
            ..self
        }
    }

    /// The knobs.
    pub(crate) fn knobs(&self) -> Knobs {
        self.knobs
    }

    fn has_cutoff(&self) -> bool {
        self.cut.cutoff() > T::ZERO
    }

    /// The tracer without knobs, if no rays are cut off.
    pub(crate) fn uncut(&self) -> Option<AllStages<'a, T>> {
        (!self.has_cutoff()).then_some(self.tracer)
    }

    /// The linear colour of a pixel, watched.
    pub(crate) fn pixel_observed(
        &self,
        x: u16,
        y: u16,
        observer: &mut dyn Observer<T>,
    ) -> Color<T> {
        self.observe(&self.scanline(y), x, &mut Watch(observer))
    }

    /// The linear colour of a pixel of a row, watched. The observer is told of what the pixel adds to
    /// the picture's cost: centres of neighbours, and pixels that a block repeats, are traced for others.
    pub(crate) fn observe(
        &self,
        scanline: &HostScanline<T>,
        x: u16,
        observer: &mut impl Observer<T>,
    ) -> Color<T> {
        let shown = x - x % self.knobs.detail.block();
        if scanline.is_repeated || shown != x {
            self.traced(scanline, shown, &mut ())
        } else {
            self.traced(scanline, x, observer)
        }
    }

    fn traced(
        &self,
        scanline: &HostScanline<T>,
        x: u16,
        observer: &mut impl Observer<T>,
    ) -> Color<T> {
        if let Some(threshold) = self.knobs.edges {
            let own = self.sample(&scanline.centers[1], x, Subpixel::CENTER, observer);
            if !self.is_edge(scanline, x, own, T::from_f64(threshold)) {
                return own;
            }
        }
        // `Supersampled::pixel_observed`.
        let mut sum = Color::BLACK;
        for (at, scanline) in self.knobs.samples.pattern().iter().zip(&scanline.samples) {
            sum = sum + self.sample(scanline, x, *at, observer);
        }
        sum * self.knobs.samples.share::<T>()
    }

    /// Whether a neighbour of a pixel, whose centre has this colour, differs from it: see
    /// [`scanray::render::Adaptive`].
    fn is_edge(&self, scanline: &HostScanline<T>, x: u16, own: Color<T>, threshold: T) -> bool {
        let Resolution { width, height } = self.resolution();
        let [above, beside, below] = &scanline.centers;
        let y = scanline.shown;
        [
            (x > 0).then(|| (beside, x - 1)),
            (x + 1 < width).then(|| (beside, x + 1)),
            (y > 0).then_some((above, x)),
            (y + 1 < height).then_some((below, x)),
        ]
        .into_iter()
        .flatten()
        .map(|(scanline, x)| self.sample(scanline, x, Subpixel::CENTER, &mut ()))
        .chain([own])
        .any(|color| differ(own, color, threshold))
    }

    fn scanline_at(&self, y: u16, at: Subpixel) -> Scanline<T> {
        self.tracer.scanline_at(y, at)
    }

    fn sample(
        &self,
        scanline: &Scanline<T>,
        x: u16,
        at: Subpixel,
        observer: &mut impl Observer<T>,
    ) -> Color<T> {
        self.cut.sample_observed(scanline, x, at, observer)
    }

    /// Colours at a place in each pixel of a part of a row, one by one.
    pub(crate) fn sample_row(&self, places: SampleRow, colors: &mut [Color<T>]) {
        let SampleRow { x, step, y, at } = places;
        let scanline = self.scanline_at(y, at);
        let places = (x..=u16::MAX).step_by(step.into());
        if self.has_cutoff() {
            for (x, color) in places.zip(colors) {
                *color = self.sample(&scanline, x, at, &mut ());
            }
        } else {
            for (x, color) in places.zip(colors) {
                *color = self.tracer.sample_observed(&scanline, x, at, &mut ());
            }
        }
    }

    /// What the rows take. It is counted by tracing every pixel once more, so that drawing is not slowed
    /// down by counting.
    pub(crate) fn count_work(&self, rows: Range<u16>, workers: &Workers) -> Work {
        let width = self.resolution().width;
        let progress = Progress::new("Counting rays".to_owned(), rows.len() as u64);
        let work = Work::count(width, rows, workers, |y, work| {
            let scanline = self.scanline(y);
            for x in 0..width {
                self.observe(&scanline, x, &mut Watch(work));
            }
            progress.advance(1);
        });
        work.compared(self.knobs.edges.is_some())
    }
}

/// Tells any observer: the tracer is compiled once for all but those whose speed matters.
struct Watch<'o, T>(&'o mut dyn Observer<T>);

impl<T> Observer<T> for Watch<'_, T> {
    fn ray(&mut self, kind: RayKind, depth: usize, ray: &Ray<T>) {
        self.0.ray(kind, depth, ray);
    }

    fn test(&mut self, kind: TestKind) {
        self.0.test(kind);
    }

    fn test_object(&mut self, object: Object<'_, T>, ray: &Ray<T>, t_max: T) {
        self.0.test_object(object, ray, t_max);
    }

    fn intersection(&mut self, intersection: &Intersection<'_, T>) {
        self.0.intersection(intersection);
    }

    fn light(&mut self, light: LightAtHit<T>) {
        self.0.light(light);
    }

    fn local_color(&mut self, color: Color<T>) {
        self.0.local_color(color);
    }

    fn result(&mut self, color: Color<T>) {
        self.0.result(color);
    }
}

/// A place in each `step`-th pixel of row `y` from column `x` on.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SampleRow {
    pub(crate) x: u16,
    pub(crate) step: u16,
    pub(crate) y: u16,
    pub(crate) at: Subpixel,
}

impl<T: Scalar> PixelSource for HostTracer<'_, T> {
    type Scalar = T;
    type Scanline = HostScanline<T>;

    fn resolution(&self) -> Resolution {
        self.tracer.resolution()
    }

    fn scanline(&self, y: u16) -> HostScanline<T> {
        let shown = y - y % self.knobs.detail.block();
        let rows = match self.knobs.edges {
            Some(_) => [shown.saturating_sub(1), shown, shown.saturating_add(1)],
            None => [shown; 3],
        };
        let pattern = self.knobs.samples.pattern();
        HostScanline {
            shown,
            is_repeated: shown != y,
            centers: rows.map(|y| self.scanline_at(y, Subpixel::CENTER)),
            samples: pattern
                .iter()
                .map(|at| self.scanline_at(shown, *at))
                .collect(),
        }
    }

    #[inline(never)]
    fn pixel_on(&self, scanline: &HostScanline<T>, x: u16) -> (Color<T>, u32) {
        let mut rays = RayCount::default();
        let color = self.observe(scanline, x, &mut rays);
        (color, rays.0)
    }
}
