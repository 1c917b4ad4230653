//! A bar on standard error for work that takes longer than a second.

use std::sync::Once;
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// What is finished sooner shows no bar.
const PATIENCE: Duration = Duration::from_secs(1);

/// The progress of some work, shared by all who do it. The bar is gone when this is dropped; where
/// standard error is no terminal there is none.
#[derive(Debug)]
pub struct Progress {
    start: Instant,
    bar: ProgressBar,
    shown: Once,
}

impl Progress {
    /// Begins work of as many steps.
    pub fn new(what: String, steps: u64) -> Self {
        let bar = ProgressBar::with_draw_target(Some(steps), ProgressDrawTarget::hidden())
            .with_message(what);
        if let Ok(style) =
            ProgressStyle::with_template("[{bar:40}] {percent:>3} %, {eta} left  {wide_msg}")
        {
            bar.set_style(style.progress_chars("=> "));
        }
        Self {
            start: Instant::now(),
            bar,
            shown: Once::new(),
        }
    }

    /// There are more steps than were known at first.
    pub fn expect(&self, more: u64) {
        self.bar.inc_length(more);
    }

    /// Counts steps that are done.
    pub fn advance(&self, steps: u64) {
        self.bar.inc(steps);
        if self.start.elapsed() > PATIENCE {
            self.shown
                .call_once(|| self.bar.set_draw_target(ProgressDrawTarget::stderr()));
        }
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}
