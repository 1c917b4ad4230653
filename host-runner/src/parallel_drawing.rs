//! Drawing on all cores, as a device draws: a picture on a [`DrawTarget`], band by band.
//!
//! [`DrawTarget`]: embedded_graphics::draw_target::DrawTarget

use std::fmt;
use std::ops::Range;
use std::time::{Duration, Instant};

use cpu_time::ProcessTime;
use embedded_graphics::Drawable;
use embedded_graphics::pixelcolor::Rgb888;
use rayon::{ThreadPool, ThreadPoolBuilder};
use scanray::{
    Picture,
    render::{DisplayColor, PixelSource, Quantizer},
};

use crate::canvas::{Band, Canvas, DrawBand};
use crate::failure::Failure;
use crate::picture_memory::{Shortage, require};
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
pub(crate) struct Parts<'a> {
    draw: Box<DrawBand<'a>>,
    width: u16,
    rows: Range<u16>,
    workers: &'a Workers,
    progress: &'a Progress,
    time: Duration,
    cpu_time: Duration,
}

impl fmt::Debug for Parts<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Parts")
            .field("width", &self.width)
            .field("rows", &self.rows)
            .finish_non_exhaustive()
    }
}

impl<'a> Parts<'a> {
    /// Begins to draw rows of a picture; each is a step of the progress.
    ///
    /// # Errors
    ///
    /// A [`Shortage`] of memory for a canvas.
    pub(crate) fn new<P, Q>(
        picture: Picture<P, Q>,
        rows: Range<u16>,
        workers: &'a Workers,
        progress: &'a Progress,
    ) -> Result<Self, Shortage>
    where
        P: PixelSource + Sync + 'a,
        Q: Quantizer<Color: DisplayColor + Into<Rgb888> + Send + 'static> + Sync + 'a,
    {
        let width = picture.resolution().width;
        let draw = move |area| {
            Band::drawn(area, |band| {
                let Ok(()) = picture.draw(band);
            })
        };
        let parts = Self {
            draw: Box::new(draw),
            width,
            rows,
            workers,
            progress,
            time: Duration::ZERO,
            cpu_time: Duration::ZERO,
        };
        parts.require_memory(size_of::<Q::Color>())?;
        Ok(parts)
    }

    fn require_memory(&self, bytes_a_pixel: usize) -> Result<(), Shortage> {
        let width = usize::from(self.width);
        let pixels = width * self.rows.len().min(rows_of_a_part(width));
        require(
            (pixels * bytes_a_pixel) as u64,
            format_args!("a part of {pixels} pixels"),
            "draw smaller parts with --rows, or draw with a smaller --size",
        )
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

impl Iterator for Parts<'_> {
    type Item = Canvas;

    fn next(&mut self) -> Option<Canvas> {
        if self.rows.is_empty() {
            return None;
        }
        let start = Instant::now();
        let cpu_start = ProcessTime::now();
        let width = self.width;
        let rows = self.rows.len().min(rows_of_a_part(width.into())) as u16;
        let top = self.rows.start;
        self.rows.start += rows;

        let (draw, progress) = (&self.draw, self.progress);
        let canvas = self.workers.install(|| {
            Canvas::draw([width, top, rows], BAND_ROWS, &|area| {
                let band = draw(area);
                let [_, _, rows] = area;
                progress.advance(rows as u64);
                band
            })
        });
        self.time += start.elapsed();
        self.cpu_time += cpu_start.elapsed();
        Some(canvas)
    }
}
