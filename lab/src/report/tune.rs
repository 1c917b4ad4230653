//! The settings with the least error within a budget.

use serde::Serialize;

use super::pareto::{Point, Standing, standings};
use super::settings::{Sampling, Settings, Step};
use super::sweep::{Estimate, Sweep};
use crate::cost::{Core, Span, Work, cycles};
use scanray_host::failure::Failure;
use scanray_host::progress::Progress;

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
    /// Of what is shown, against R2: FLIP where it is dithered, else the root of the mean square in levels of 255.
    pub(crate) error: f64,
}

/// What came of it. All are on the Pareto front, whose settings differ by more than 1 %.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Tuned {
    /// The least error within the budget; none when nothing fits.
    pub(crate) best: Option<Choice>,
    /// The next with less error, beyond the budget.
    pub(crate) better: Option<Choice>,
    /// The next that takes less.
    pub(crate) cheaper: Option<Choice>,
    /// The cheapest of all, when nothing fits.
    pub(crate) cheapest: Option<Choice>,
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

/// Maximum depths that are tried.
const DEPTHS: [usize; 10] = [0, 1, 2, 3, 4, 5, 6, 8, 10, 16];

/// Thresholds and samples that are tried: in each list what comes later casts more rays.
const SAMPLINGS: [&[Sampling]; 2] = [
    &[
        Sampling::Adaptive(4),
        Sampling::Adaptive(8),
        Sampling::Adaptive(16),
        Sampling::Adaptive(32),
        Sampling::Adaptive(64),
    ],
    &[Sampling::Fixed(4), Sampling::Fixed(16), Sampling::Fixed(64)],
];

/// The settings with one sample that are tried.
fn candidates(display: &Settings) -> Vec<Settings> {
    // A level of the display, and what is coarser and finer.
    let cutoffs = match display.color.levels() {
        256 => [None, Some(1024), Some(256), Some(64), Some(16)],
        _ => [None, Some(256), Some(64), Some(32), Some(8)],
    };
    let with = |max_depth: usize| {
        // Without secondary rays there is nothing to cut off.
        let count = if max_depth == 0 { 1 } else { cutoffs.len() };
        cutoffs[..count].iter().map(move |cutoff| Settings {
            max_depth,
            cutoff: *cutoff,
            sampling: Sampling::Fixed(1),
            ..*display
        })
    };
    DEPTHS.into_iter().flat_map(with).collect()
}

/// Settings and what they take and err.
type Tried = (Settings, Estimate);

/// Tries settings. What takes more than `is_too_much` allows is left out, and so is what takes still more than it.
fn estimates(
    sweep: &Sweep<'_>,
    display: &Settings,
    progress: &Progress,
    is_too_much: impl Fn(&Tried) -> bool,
) -> Result<Vec<Tried>, Failure> {
    let mut tried: Vec<Tried> = Vec::new();
    let mut known: Vec<Work> = Vec::new();
    for settings in candidates(display) {
        progress.advance(1);
        let estimate = sweep.estimate(&settings)?;
        // A larger depth or a finer cut-off that casts no ray more draws the same picture.
        if known.contains(&estimate.work) {
            continue;
        }
        known.push(estimate.work);
        let single = (settings, estimate);
        let is_beyond = is_too_much(&single);
        tried.push(single);
        if is_beyond {
            continue;
        }
        for list in SAMPLINGS {
            for sampling in list {
                let settings = Settings {
                    sampling: *sampling,
                    ..settings
                };
                let more = (settings, sweep.estimate(&settings)?);
                let is_beyond = is_too_much(&more);
                tried.push(more);
                if is_beyond {
                    break;
                }
            }
        }
    }
    Ok(tried)
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
    let progress = Progress::new(
        "Trying settings".to_owned(),
        candidates(display).len() as u64,
    );
    let milliseconds =
        |(_, estimate): &Tried| budget.milliseconds(estimate.instructions[budget.core as usize]);
    let is_far_beyond = |tried: &Tried| milliseconds(tried).least > 4e3 * budget.seconds;
    let tried = estimates(sweep, display, &progress, is_far_beyond)?;
    let choices = tried
        .iter()
        .map(|tried| Choice {
            settings: tried.0,
            instructions: tried.1.instructions[budget.core as usize],
            milliseconds: milliseconds(tried),
            error: tried.1.error,
        })
        .collect();
    Ok(choose(choices, |choice| budget.holds(choice)))
}

/// Steps of [`choices`].
pub(crate) fn steps() -> u64 {
    candidates(&Settings::DEFAULT).len() as u64
}

/// What [`tune`] would choose on each core as the budget grows, from the cheapest on, a step for each third of
/// the error that goes; 64 samples a pixel are not tried.
///
/// # Errors
///
/// [`Failure`].
pub(crate) fn choices(
    sweep: &Sweep<'_>,
    progress: &Progress,
) -> Result<[Vec<Step>; Core::ALL.len()], Failure> {
    let is_too_much = |(settings, _): &Tried| settings.sampling == Sampling::Fixed(16);
    let tried = estimates(sweep, &Settings::DEFAULT, progress, is_too_much)?;
    Ok(Core::ALL.map(|core| {
        let choices = tried.iter().map(|(settings, estimate)| Choice {
            settings: *settings,
            instructions: estimate.instructions[core as usize],
            milliseconds: Span {
                least: 0.0,
                most: 0.0,
            },
            error: estimate.error,
        });
        let mut steps: Vec<Step> = Vec::new();
        let mut last = f64::INFINITY;
        for choice in front(choices.collect()) {
            if choice.error <= last * 2.0 / 3.0 {
                last = choice.error;
                steps.push(Step {
                    label: choice.settings.to_string(),
                    settings: choice.settings,
                });
            }
        }
        steps
    }))
}

/// The choice and its neighbours on the Pareto front.
fn choose(choices: Vec<Choice>, fits: impl Fn(&Choice) -> bool) -> Tuned {
    let tried = choices.len();
    let mut front = front(choices);
    let number_that_fit = front.iter().take_while(|choice| fits(choice)).count();
    let beyond = front.split_off(number_that_fit).into_iter().next();
    let best = front.pop();
    let (better, cheapest) = match best {
        Some(_) => (beyond, None),
        None => (None, beyond),
    };
    Tuned {
        best,
        better,
        cheaper: front.pop(),
        cheapest,
        tried,
    }
}

/// The choices that nothing dominates, from the cheapest to the one with the least error; of those that differ by less
/// than 1 % the simplest, which came first.
fn front(choices: Vec<Choice>) -> Vec<Choice> {
    let point = |choice: &Choice| Point {
        cost: choice.instructions,
        error: choice.error,
    };
    let points: Vec<Point> = choices.iter().map(point).collect();
    let mut kept: Vec<Choice> = choices
        .into_iter()
        .zip(standings(&points))
        .filter(|(_, standing)| *standing == Standing::OnFront)
        .map(|(choice, _)| choice)
        .collect();
    kept.sort_by(|a, b| a.instructions.total_cmp(&b.instructions));
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    fn choice(max_depth: usize, instructions: f64, error: f64) -> Choice {
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
            error,
        }
    }

    /// Cheaper, best, better, cheapest.
    fn depths(limit: f64) -> [Option<usize>; 4] {
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
        let Tuned {
            cheaper,
            best,
            better,
            cheapest,
            ..
        } = tuned;
        [cheaper, best, better, cheapest].map(|c| c.map(|c| c.settings.max_depth))
    }

    #[test]
    fn the_least_error_within_the_budget_and_its_neighbours() {
        assert_eq!(depths(10.0), [Some(1), Some(2), Some(4), None]);
        assert_eq!(depths(1000.0), [Some(2), Some(4), None, None]);
        assert_eq!(depths(2.0), [None, Some(0), Some(1), None]);
    }

    #[test]
    fn lists_of_samplings_grow() {
        let samples = |sampling: &Sampling| match sampling {
            Sampling::Fixed(samples) => u16::from(*samples),
            Sampling::Adaptive(of) => *of,
        };
        for list in SAMPLINGS {
            assert!(list.is_sorted_by_key(samples), "{list:?}");
        }
    }

    #[test]
    fn neighbours_differ() {
        let choices = vec![
            choice(1, 1.0, 9.0),
            choice(2, 1.2, 8.95),
            choice(3, 2.0, 5.0),
        ];
        let tuned = choose(choices, |choice| choice.instructions < 1.5);
        assert_eq!(tuned.best.map(|c| c.settings.max_depth), Some(1));
        assert_eq!(tuned.better.map(|c| c.settings.max_depth), Some(3));
    }

    #[test]
    fn nothing_fits() {
        assert_eq!(depths(1.0), [None, None, None, Some(0)]);
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
