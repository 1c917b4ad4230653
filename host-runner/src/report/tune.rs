//! The settings with the least error within a budget.

use serde::Serialize;

use super::pareto::Point;
use super::settings::{Sampling, Settings};
use super::sweep::{Estimate, Sweep};
use crate::cost::{Core, Span, Work, cycles};
use crate::failure::Failure;
use crate::progress::Progress;

/// What there is to spend, and where.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Budget {
    pub(crate) core: Core,
    /// Cycles a second.
    pub(crate) clock: f64,
    /// Seconds for a picture.
    pub(crate) seconds: f64,
    /// Of the flash.
    pub(crate) wait_states: u32,
}

/// Settings, what they take and how wrong their picture is.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Choice {
    pub(crate) settings: Settings,
    /// Predicted for a picture.
    pub(crate) instructions: f64,
    /// An estimate.
    pub(crate) milliseconds: Span,
    /// Root of the mean square error of what is shown against R2, in levels of 255.
    pub(crate) rmse: f64,
}

/// What came of it. All are on the Pareto front.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Tuned {
    /// The least error within the budget; none when nothing fits.
    pub(crate) best: Option<Choice>,
    /// The next with less error, beyond the budget; the cheapest of all when nothing fits.
    pub(crate) better: Option<Choice>,
    /// The next that takes less.
    pub(crate) cheaper: Option<Choice>,
    /// How many settings were tried.
    pub(crate) tried: usize,
}

impl Budget {
    /// Milliseconds for a picture of as many instructions.
    pub(crate) fn milliseconds(&self, instructions: f64) -> Span {
        let Span { least, most } = cycles(self.core, instructions, self.wait_states);
        let each = 1e3 / self.clock;
        Span {
            least: least * each,
            most: most * each,
        }
    }

    /// Whether even the upper end is within.
    fn holds(&self, choice: &Choice) -> bool {
        choice.milliseconds.most <= 1e3 * self.seconds
    }
}

/// The settings that are tried; those that only differ in `sampling` stand together, in the order of what they take.
fn candidates(display: &Settings) -> Vec<[Settings; 7]> {
    // A level of the display, and what is coarser and finer.
    let level = match display.color.levels() {
        256 => [None, Some(1024), Some(256), Some(64), Some(16)],
        _ => [None, Some(256), Some(64), Some(32), Some(8)],
    };
    let depths = [0, 1, 2, 3, 4, 5, 6, 8, 10];
    let samplings = [
        Sampling::Fixed(1),
        Sampling::Adaptive(4),
        Sampling::Adaptive(8),
        Sampling::Adaptive(32),
        Sampling::Fixed(4),
        Sampling::Fixed(16),
        Sampling::Fixed(64),
    ];
    let mut all = Vec::new();
    for max_depth in depths {
        for cutoff in level {
            if max_depth == 0 && cutoff.is_some() {
                continue;
            }
            all.push(samplings.map(|sampling| Settings {
                max_depth,
                cutoff,
                sampling,
                ..*display
            }));
        }
    }
    all
}

/// Tries settings. `display` has the colours; the rest of it is not used.
///
/// # Errors
///
/// [`Failure`].
pub(crate) fn tune(
    sweep: &Sweep<'_>,
    display: &Settings,
    budget: &Budget,
) -> Result<Tuned, Failure> {
    let groups = candidates(display);
    let progress = Progress::new("Trying settings".to_owned(), groups.len() as u64);
    let mut choices = Vec::new();
    let mut known: Vec<Work> = Vec::new();
    for group in groups {
        progress.advance(1);
        for settings in group {
            let Estimate {
                work,
                instructions,
                rmse,
            } = sweep.estimate(&settings, budget.core)?;
            // A larger depth or a finer cut-off that casts no ray more draws the same picture.
            if settings.sampling == Sampling::Fixed(1) {
                if known.contains(&work) {
                    break;
                }
                known.push(work);
            }
            let choice = Choice {
                settings,
                instructions,
                milliseconds: budget.milliseconds(instructions),
                rmse,
            };
            let is_far_beyond = choice.milliseconds.least > 4e3 * budget.seconds;
            choices.push(choice);
            // What has more samples takes more.
            if is_far_beyond {
                break;
            }
        }
    }
    Ok(choose(choices, |choice| budget.holds(choice)))
}

/// The choice and its neighbours on the Pareto front.
fn choose(choices: Vec<Choice>, fits: impl Fn(&Choice) -> bool) -> Tuned {
    let tried = choices.len();
    let mut front = front(choices);
    let number_that_fit = front.iter().take_while(|choice| fits(choice)).count();
    let mut beyond = front.split_off(number_that_fit).into_iter();
    Tuned {
        best: front.pop(),
        cheaper: front.pop(),
        better: beyond.next(),
        tried,
    }
}

/// The choices that nothing dominates, from the cheapest to the one with the least error; of equal ones the
/// simplest, which came first.
fn front(choices: Vec<Choice>) -> Vec<Choice> {
    let point = |choice: &Choice| Point {
        cost: choice.instructions,
        error: choice.rmse,
    };
    let mut kept: Vec<Choice> = Vec::new();
    for (index, choice) in choices.iter().enumerate() {
        let is_dominated = choices
            .iter()
            .any(|other| point(other).dominates(&point(choice)));
        let is_repeated = choices[..index]
            .iter()
            .any(|other| point(other) == point(choice));
        if !is_dominated && !is_repeated {
            kept.push(choice.clone());
        }
    }
    kept.sort_by(|a, b| a.instructions.total_cmp(&b.instructions));
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    fn choice(max_depth: usize, instructions: f64, rmse: f64) -> Choice {
        Choice {
            settings: Settings {
                max_depth,
                ..Settings::DEFAULT
            },
            instructions,
            milliseconds: Span {
                least: instructions,
                most: 2.0 * instructions,
            },
            rmse,
        }
    }

    fn depths(limit: f64) -> [Option<usize>; 3] {
        // Depth 3 is dominated by 2; 4 and 5 are equal.
        let choices = vec![
            choice(0, 1.0, 9.0),
            choice(1, 2.0, 5.0),
            choice(2, 4.0, 3.0),
            choice(3, 5.0, 3.5),
            choice(4, 8.0, 1.0),
            choice(5, 8.0, 1.0),
        ];
        let tuned = choose(choices, |choice| choice.milliseconds.most <= limit);
        assert_eq!(tuned.tried, 6);
        [tuned.cheaper, tuned.best, tuned.better].map(|c| c.map(|c| c.settings.max_depth))
    }

    #[test]
    fn the_least_error_within_the_budget_and_its_neighbours() {
        assert_eq!(depths(10.0), [Some(1), Some(2), Some(4)]);
        assert_eq!(depths(1000.0), [Some(2), Some(4), None]);
        assert_eq!(depths(2.0), [None, Some(0), Some(1)]);
    }

    #[test]
    fn nothing_fits() {
        assert_eq!(depths(1.0), [None, None, Some(0)]);
    }

    #[test]
    fn time_is_the_cores_cycles_at_its_clock() {
        let budget = Budget {
            core: Core::M4f,
            clock: 100e6,
            seconds: 0.1,
            wait_states: 0,
        };
        let cycles = cycles(Core::M4f, 1e6, 0);
        let span = budget.milliseconds(1e6);
        assert!((span.least - cycles.least / 1e5).abs() < 1e-9);
        assert!((span.most - cycles.most / 1e5).abs() < 1e-9);
    }
}
