//! Wall time on the host.

use std::time::Instant;

use serde::Serialize;

/// How often a picture is drawn.
const RUNS: usize = 7;

/// Wall time of drawing a picture on one thread, one ray at a time, in seconds. Not deterministic.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub(crate) struct HostTime {
    pub(crate) median: f64,
    pub(crate) least: f64,
    pub(crate) most: f64,
}

impl HostTime {
    /// Draws a picture several times.
    pub(crate) fn measure(draw: &dyn Fn()) -> Self {
        let mut seconds: Vec<f64> = (0..RUNS)
            .map(|_| {
                let start = Instant::now();
                draw();
                start.elapsed().as_secs_f64()
            })
            .collect();
        seconds.sort_by(f64::total_cmp);
        Self {
            median: seconds[RUNS / 2],
            least: seconds[0],
            most: seconds[RUNS - 1],
        }
    }

    /// Whether the machine was busy with something else.
    pub(crate) fn is_doubtful(&self) -> bool {
        self.most > 1.5 * self.median
    }
}
