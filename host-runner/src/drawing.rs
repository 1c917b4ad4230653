//! Drawing on all cores, as a device draws: a picture on a [`DrawTarget`], band by band.
//!
//! [`DrawTarget`]: embedded_graphics::draw_target::DrawTarget

use std::ops::Range;
use std::time::{Duration, Instant};

use cpu_time::ProcessTime;
use embedded_graphics::Drawable;
use embedded_graphics::pixelcolor::Rgb888;
use rayon::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};
use scanray::{
    Color, DisplayColor, Needs, Observer, Picture, PixelSource, Quantizer, Resolution, Scalar,
    Scanline, Scene, Tracer,
};

use crate::canvas::Canvas;
use crate::cost::Work;
use crate::failure::Failure;
use crate::packet::PacketTracer;
use crate::progress::Progress;

/// The largest maximum depth.
pub(crate) const MAX_DEPTH: usize = 32;

/// A picture of more pixels is drawn and written in parts of about as many, so that memory has a
/// bound.
const PART_PIXELS: usize = 1 << 24;

/// Rows that a thread draws before it takes new ones.
const BAND_ROWS: usize = 4;

/// The threads that draw.
#[derive(Debug)]
pub(crate) struct Workers(ThreadPool);

impl Workers {
    /// As many threads, or one for each core.
    ///
    /// # Errors
    ///
    /// [`Failure::Usage`] when the system does not give so many.
    pub(crate) fn new(threads: Option<u16>) -> Result<Self, Failure> {
        ThreadPoolBuilder::new()
            .num_threads(threads.map_or(0, usize::from))
            .build()
            .map(Self)
            .map_err(|error| Failure::Usage(format!("cannot start the threads: {error}")))
    }

    /// How many there are.
    pub(crate) fn count(&self) -> usize {
        self.0.current_num_threads()
    }

    /// Lets them do parallel work.
    pub(crate) fn install<R: Send>(&self, work: impl FnOnce() -> R + Send) -> R {
        self.0.install(work)
    }
}

/// A tracer with every stage and the deepest stack.
///
/// As a source of pixels it is compiled once a scalar, not once more for each colour.
#[derive(Clone, Copy, Debug)]
pub(crate) struct HostTracer<'a, T>(AllStages<'a, T>);

type AllStages<'a, T> = Tracer<'a, T, { Needs::ALL.union(Needs::TREE).bits() }, MAX_DEPTH>;

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
            .with_tree()
            .with_stack()
            .with_resolution(resolution)
            .with_max_depth(max_depth)
            .map(Self)
            .map_err(|error| Failure::Usage(error.to_string()))
    }

    /// The linear colour of a pixel, watched.
    pub(crate) fn pixel_observed(
        &self,
        x: u16,
        y: u16,
        observer: &mut impl Observer<T>,
    ) -> Color<T> {
        self.0.pixel_observed(&self.0.scanline(y), x, observer)
    }

    /// What the rows take. It is counted by tracing every pixel once more, so that drawing is not slowed
    /// down by counting.
    pub(crate) fn count_work(&self, rows: Range<u16>, workers: &Workers) -> Work {
        let tracer = &self.0;
        let width = tracer.resolution().width;
        let progress = Progress::new("Counting rays".to_owned(), rows.len() as u64);
        Work::count(width, rows, workers, |y, counter| {
            let scanline = tracer.scanline(y);
            for x in 0..width {
                tracer.pixel_observed(&scanline, x, counter);
            }
            progress.advance(1);
        })
    }
}

/// How the host draws with a scalar.
pub(crate) trait Drawing: Scalar {
    /// The fastest source of the pixels of [`HostTracer`].
    type Pixels<'a>: PixelSource<Scalar = Self> + Sync;

    /// The pixels of a tracer.
    fn pixels<'a>(tracer: &HostTracer<'a, Self>) -> Self::Pixels<'a>;
}

impl Drawing for f32 {
    type Pixels<'a> = PacketTracer<'a, MAX_DEPTH>;

    fn pixels<'a>(tracer: &HostTracer<'a, Self>) -> PacketTracer<'a, MAX_DEPTH> {
        PacketTracer::new(tracer.0)
    }
}

impl Drawing for f64 {
    type Pixels<'a> = HostTracer<'a, Self>;

    fn pixels<'a>(tracer: &HostTracer<'a, Self>) -> HostTracer<'a, Self> {
        *tracer
    }
}

impl<T: Scalar> PixelSource for HostTracer<'_, T> {
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

/// Draws rows of a picture: an iterator over canvases, from top to bottom, that each hold many rows.
#[derive(Debug)]
pub(crate) struct Parts<'a, P, Q> {
    picture: Picture<P, Q>,
    rows: Range<u16>,
    workers: &'a Workers,
    progress: &'a Progress,
    time: Duration,
    cpu_time: Duration,
}

impl<'a, P: PixelSource, Q: Quantizer> Parts<'a, P, Q> {
    /// Begins to draw rows of a picture; each is a step of the progress.
    pub(crate) fn new(
        picture: Picture<P, Q>,
        rows: Range<u16>,
        workers: &'a Workers,
        progress: &'a Progress,
    ) -> Self {
        Self {
            picture,
            rows,
            workers,
            progress,
            time: Duration::ZERO,
            cpu_time: Duration::ZERO,
        }
    }

    /// What drawing has taken so far, without what happens between the parts.
    pub(crate) fn time(&self) -> Duration {
        self.time
    }

    /// The CPU time of all threads for the same.
    pub(crate) fn cpu_time(&self) -> Duration {
        self.cpu_time
    }
}

impl<P, Q> Iterator for Parts<'_, P, Q>
where
    P: PixelSource + Sync,
    Q: Quantizer<Color: DisplayColor + Into<Rgb888> + Send> + Sync,
{
    type Item = Canvas<Q::Color>;

    fn next(&mut self) -> Option<Canvas<Q::Color>> {
        if self.rows.is_empty() {
            return None;
        }
        let start = Instant::now();
        let cpu_start = ProcessTime::now();
        let width = self.picture.resolution().width;
        let most = (PART_PIXELS / usize::from(width)).max(1);
        let rows = self.rows.len().min(most) as u16;
        let top = self.rows.start;
        self.rows.start += rows;

        let mut canvas = Canvas::new(width, top, rows);
        let (picture, progress) = (&self.picture, self.progress);
        self.workers.0.install(|| {
            canvas.bands(BAND_ROWS).for_each(|mut band| {
                let Ok(()) = picture.draw(&mut band);
                progress.advance(band.rows());
            });
        });
        self.time += start.elapsed();
        self.cpu_time += cpu_start.elapsed();
        Some(canvas)
    }
}
