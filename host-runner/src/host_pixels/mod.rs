//! The pixels of [`HostTracer`], row by row and as fast as the host can.

#[cfg(test)]
mod tests;

use std::collections::VecDeque;
use std::fmt;
use std::sync::{Arc, Mutex, PoisonError};

use scanray::{
    Color, Resolution, Scalar,
    camera::Subpixel,
    render::{PixelSource, differ},
};

use crate::host_tracer::{HostTracer, MAX_DEPTH, SampleRow};
use crate::knobs::Knobs;
use crate::packet::PacketTracer;

/// Rows of samples, from wide vectors where there are such, else from [`HostTracer`].
trait SampleRows<T>: Sync {
    fn sample_row(&self, places: SampleRow, colors: &mut [Color<T>]);
}

impl SampleRows<f32> for PacketTracer<'_, MAX_DEPTH> {
    fn sample_row(&self, places: SampleRow, colors: &mut [Color<f32>]) {
        PacketTracer::sample_row(self, places, colors);
    }
}

impl<T: Scalar> SampleRows<T> for HostTracer<'_, T> {
    fn sample_row(&self, places: SampleRow, colors: &mut [Color<T>]) {
        HostTracer::sample_row(self, places, colors);
    }
}

/// How the host draws with a scalar.
pub(crate) trait Drawing: Scalar {
    /// The pixels of a tracer. In `f32` eight rays are traced at a time, unless some are cut off: which
    /// ones depends on the order of the core, one ray after the other.
    fn pixels<'a>(tracer: &HostTracer<'a, Self>) -> HostPixels<'a, Self>;
}

impl Drawing for f32 {
    fn pixels<'a>(tracer: &HostTracer<'a, Self>) -> HostPixels<'a, Self> {
        match tracer.uncut() {
            Some(uncut) => HostPixels::new(tracer, PacketTracer::new(uncut)),
            None => HostPixels::new(tracer, *tracer),
        }
    }
}

impl Drawing for f64 {
    fn pixels<'a>(tracer: &HostTracer<'a, Self>) -> HostPixels<'a, Self> {
        HostPixels::new(tracer, *tracer)
    }
}

/// A source of pixels whose scanline is a row that is traced already. Rays are not counted: their number
/// is 0.
pub(crate) struct HostPixels<'a, T> {
    rows: Box<dyn SampleRows<T> + 'a>,
    resolution: Resolution,
    knobs: Knobs,
    /// Of the centres of pixels.
    centers: KeptRows<T>,
    /// Of the first pixels of blocks.
    blocks: KeptRows<T>,
}

impl<T> fmt::Debug for HostPixels<'_, T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("HostPixels")
            .field("resolution", &self.resolution)
            .field("knobs", &self.knobs)
            .finish_non_exhaustive()
    }
}

impl<'a, T: Scalar> HostPixels<'a, T> {
    fn new(tracer: &HostTracer<'a, T>, rows: impl SampleRows<T> + 'a) -> Self {
        Self {
            rows: Box::new(rows),
            resolution: tracer.resolution(),
            knobs: tracer.knobs(),
            centers: KeptRows::default(),
            blocks: KeptRows::default(),
        }
    }

    /// Every `step`-th pixel of row `y`.
    fn row(&self, y: u16, step: u16) -> Vec<Color<T>> {
        let width = self.resolution.width;
        let Some(threshold) = self.knobs.edges else {
            return self.means(0, y, step, width.div_ceil(step).into());
        };
        let mut row = self.edges_refined(y, T::from_f64(threshold));
        let mut kept = (0..step).cycle().map(|column| column == 0);
        row.retain(|_| kept.next() == Some(true));
        row
    }

    /// Row `y` with more samples in the pixels that differ from a neighbour: [`scanray::render::Adaptive`].
    fn edges_refined(&self, y: u16, threshold: T) -> Vec<Color<T>> {
        let Resolution { height, .. } = self.resolution;
        let centers = |y: u16| {
            self.centers.get(y, || {
                let mut row = vec![Color::BLACK; self.resolution.width.into()];
                let places = SampleRow {
                    x: 0,
                    step: 1,
                    y,
                    at: Subpixel::CENTER,
                };
                self.rows.sample_row(places, &mut row);
                row
            })
        };
        let own = centers(y);
        let beside = [
            (y > 0).then(|| centers(y - 1)),
            (y + 1 < height).then(|| centers(y + 1)),
        ];
        let is_edge = |x: usize| {
            let left_and_right = [x.checked_sub(1), x.checked_add(1)].into_iter().flatten();
            let neighbours = left_and_right.filter_map(|x| own.get(x));
            neighbours
                .chain(beside.iter().flatten().map(|row| &row[x]))
                .chain([&own[x]])
                .any(|color| differ(own[x], *color, threshold))
        };
        let edges: Vec<bool> = (0..own.len()).map(is_edge).collect();
        let mut row = own.as_ref().clone();
        let mut start = 0;
        for run in edges.chunk_by(|a, b| a == b) {
            if run[0] {
                // No picture has more than 65,535 columns.
                let means = self.means(start as u16, y, 1, run.len());
                row[start..start + run.len()].copy_from_slice(&means);
            }
            start += run.len();
        }
        row
    }

    /// The means of the samples of pixels, as [`scanray::render::Supersampled`] has them.
    fn means(&self, x: u16, y: u16, step: u16, count: usize) -> Vec<Color<T>> {
        let mut sums = vec![Color::BLACK; count];
        if let [at] = self.knobs.samples.pattern() {
            let places = SampleRow {
                x,
                step,
                y,
                at: *at,
            };
            self.rows.sample_row(places, &mut sums);
            return sums;
        }
        let mut samples = sums.clone();
        for at in self.knobs.samples.pattern() {
            let places = SampleRow {
                x,
                step,
                y,
                at: *at,
            };
            self.rows.sample_row(places, &mut samples);
            for (sum, sample) in sums.iter_mut().zip(&samples) {
                *sum = *sum + *sample;
            }
        }
        let share: T = self.knobs.samples.share();
        for sum in &mut sums {
            *sum = *sum * share;
        }
        sums
    }
}

impl<T: Scalar> PixelSource for HostPixels<'_, T> {
    type Scalar = T;
    type Scanline = Row<T>;

    fn resolution(&self) -> Resolution {
        self.resolution
    }

    fn scanline(&self, y: u16) -> Row<T> {
        let block = self.knobs.detail.block();
        if block == 1 {
            return Arc::new(self.row(y, 1));
        }
        let shown = y - y % block;
        self.blocks.get(shown, || {
            let firsts = self.row(shown, block).into_iter();
            let mut row: Vec<_> = firsts
                .flat_map(|color| std::iter::repeat_n(color, block.into()))
                .collect();
            row.truncate(self.resolution.width.into());
            row
        })
    }

    #[inline(always)]
    fn pixel_on(&self, row: &Row<T>, x: u16) -> (Color<T>, u32) {
        (row[usize::from(x)], 0)
    }
}

/// The colours of a row, which several pixels and threads look at.
type Row<T> = Arc<Vec<Color<T>>>;

/// The last rows that were traced, for the rows next to them.
#[derive(Debug)]
struct KeptRows<T>(Mutex<VecDeque<(u16, Row<T>)>>);

impl<T> Default for KeptRows<T> {
    fn default() -> Self {
        Self(Mutex::default())
    }
}

impl<T> KeptRows<T> {
    /// As many as some threads need that each draw a few rows.
    const MOST: usize = 96;

    /// A row that is kept, or else is traced and kept. Two threads may trace the same one.
    fn get(&self, y: u16, trace: impl FnOnce() -> Vec<Color<T>>) -> Row<T> {
        let lock = || self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, row)) = lock().iter().rev().find(|(kept, _)| *kept == y) {
            return Arc::clone(row);
        }
        let row = Arc::new(trace());
        let mut kept = lock();
        if kept.len() == Self::MOST {
            kept.pop_front();
        }
        kept.push_back((y, Arc::clone(&row)));
        row
    }
}
