//! Drawing on all cores, as a device draws: a picture on a [`DrawTarget`], band by band.
//!
//! [`DrawTarget`]: embedded_graphics::draw_target::DrawTarget

use std::ops::Range;
use std::time::{Duration, Instant};

use cpu_time::ProcessTime;
use embedded_graphics::Drawable;
use embedded_graphics::pixelcolor::Rgb888;
use rayon::{ThreadPool, ThreadPoolBuilder};
use scanray::{DisplayColor, Picture, PixelSource, Quantizer};

use crate::canvas::Canvas;
use crate::failure::Failure;
use crate::memory::{Shortage, require};
use crate::progress::Progress;

/// A picture of more pixels is drawn and written in parts of about as many, so that memory has a
/// bound.
const PART_PIXELS: usize = 1 << 24;

/// Rows that a thread draws before it takes new ones.
const BAND_ROWS: usize = 4;

fn rows_of_a_part(width: usize) -> usize {
    (PART_PIXELS / width).max(1)
}

/// The threads that draw.
#[derive(Debug)]
pub struct Workers(ThreadPool);

impl Workers {
    /// As many threads, or one for each core.
    ///
    /// # Errors
    ///
    /// [`Failure::Usage`] when the system does not give so many.
    pub fn new(threads: Option<u16>) -> Result<Self, Failure> {
        ThreadPoolBuilder::new()
            .num_threads(threads.map_or(0, usize::from))
            .build()
            .map(Self)
            .map_err(|error| Failure::Usage(format!("cannot start the threads: {error}")))
    }

    /// How many there are.
    pub fn count(&self) -> usize {
        self.0.current_num_threads()
    }

    /// Lets them do parallel work.
    pub fn install<R: Send>(&self, work: impl FnOnce() -> R + Send) -> R {
        self.0.install(work)
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
    ///
    /// # Errors
    ///
    /// A [`Shortage`] of memory for a canvas.
    pub(crate) fn new(
        picture: Picture<P, Q>,
        rows: Range<u16>,
        workers: &'a Workers,
        progress: &'a Progress,
    ) -> Result<Self, Shortage> {
        let width = usize::from(picture.resolution().width);
        let pixels = width * rows.len().min(rows_of_a_part(width));
        require(
            (pixels * size_of::<Q::Color>()) as u64,
            format_args!("a part of {pixels} pixels"),
            "draw smaller parts with --rows, or draw with a smaller --size",
        )?;
        Ok(Self {
            picture,
            rows,
            workers,
            progress,
            time: Duration::ZERO,
            cpu_time: Duration::ZERO,
        })
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
        let rows = self.rows.len().min(rows_of_a_part(width.into())) as u16;
        let top = self.rows.start;
        self.rows.start += rows;

        let (picture, progress) = (&self.picture, self.progress);
        let canvas = self.workers.install(|| {
            Canvas::draw([width, top, rows], BAND_ROWS, |band| {
                let Ok(()) = picture.draw(band);
                progress.advance(band.rows());
            })
        });
        self.time += start.elapsed();
        self.cpu_time += cpu_start.elapsed();
        Some(canvas)
    }
}
