//! What is swept: settings, and the knobs that change one of them at a time.

use std::fmt;

use clap::ValueEnum;
use scanray::DEFAULT_MAX_DEPTH;
use serde::{Serialize, Serializer};
use serde_json::Value;

use crate::cost::Core;
use scanray_host::knobs::Detail;
use scanray_host::option_values::{ColorName, ScalarName, name_of};

/// The formulas that rays hit shapes by, and where new rays start.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Formulas {
    /// The core's: robust ones, and origins that are offset by a bound derived from rounding
    Robust,
    /// The core's, but origins that are offset by a fixed distance
    FixedOffset,
    /// What most ray tracers do: [`scanray_stability::textbook`]
    Textbook,
}

/// How a highlight's power is computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum PowerRoutine {
    /// Repeated squaring where the shininess is a whole number, the polynomial elsewhere
    Squaring,
    /// The log2/exp2 polynomial for every exponent
    Polynomial,
}

/// How many samples a pixel has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Sampling {
    /// As many for each: 1, 4, 16 or 64.
    Fixed(u8),
    /// 1, and [`Settings::ADAPTIVE_SAMPLES`] where neighbours differ by more than one part in so many.
    Adaptive(u16),
}

impl fmt::Display for Sampling {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Fixed(1) => f.write_str("1 sample"),
            Self::Fixed(samples) => write!(f, "{samples} samples"),
            Self::Adaptive(of) => write!(f, "adaptive 1/{of}"),
        }
    }
}

/// Everything about a picture that can be set.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Settings {
    pub(crate) scalar: ScalarName,
    pub(crate) max_depth: usize,
    /// Secondary rays that add less than one part in so many are not cast.
    pub(crate) cutoff: Option<u16>,
    pub(crate) sampling: Sampling,
    pub(crate) power: PowerRoutine,
    pub(crate) formulas: Formulas,
    /// How much is there of a picture that is drawn coarse to fine.
    pub(crate) preview: Detail,
    pub(crate) color: ColorName,
    pub(crate) dither: bool,
}

impl Settings {
    /// What a program gets that sets nothing.
    pub(crate) const DEFAULT: Self = Self {
        scalar: ScalarName::F32,
        max_depth: DEFAULT_MAX_DEPTH,
        cutoff: None,
        sampling: Sampling::Fixed(1),
        power: PowerRoutine::Squaring,
        formulas: Formulas::Robust,
        preview: Detail::Full,
        color: ColorName::Rgb888,
        dither: false,
    };

    /// Samples at the edges that adaptive sampling finds.
    pub(crate) const ADAPTIVE_SAMPLES: usize = 16;

    /// Whether both show their pictures on the same kind of display, in the same way: an error counted in levels
    /// says nothing about dither.
    pub(crate) fn same_display(&self, other: &Self) -> bool {
        self.color == other.color && self.dither == other.dither
    }

    /// Whether a firmware can have them: the formulas of others exist on the host alone, and double precision has
    /// no hardware on these cores.
    pub(crate) fn is_for_devices(&self) -> bool {
        self.scalar == ScalarName::F32 && self.formulas == Formulas::Robust
    }
}

/// What differs from [`Settings::DEFAULT`].
impl fmt::Display for Settings {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let default = Self::DEFAULT;
        let mut words = Vec::new();
        if self.scalar != default.scalar {
            words.push(name_of(self.scalar));
        }
        if self.max_depth != default.max_depth {
            words.push(format!("depth {}", self.max_depth));
        }
        if let Some(of) = self.cutoff {
            words.push(format!("cut-off 1/{of}"));
        }
        if self.sampling != default.sampling {
            words.push(self.sampling.to_string());
        }
        if self.power != default.power {
            words.push("polynomial power".to_owned());
        }
        match self.formulas {
            Formulas::Robust => {}
            Formulas::FixedOffset => words.push("fixed offset".to_owned()),
            Formulas::Textbook => words.push("textbook formulas".to_owned()),
        }
        if self.preview != default.preview {
            words.push(format!("{} preview", name_of(self.preview)));
        }
        if self.color != default.color {
            words.push(name_of(self.color));
        }
        if self.dither {
            words.push("dither".to_owned());
        }
        if words.is_empty() {
            f.write_str("default")
        } else {
            f.write_str(&words.join(", "))
        }
    }
}

impl Settings {
    /// What is set, for programs: the names and units of `scanray render --json`.
    pub(crate) fn fields(&self) -> [(&'static str, Value); 10] {
        let one_in = |of: u16| 1.0 / f64::from(of);
        let (samples, adaptive) = match self.sampling {
            Sampling::Fixed(samples) => (samples.into(), None),
            Sampling::Adaptive(of) => (Self::ADAPTIVE_SAMPLES, Some(one_in(of))),
        };
        [
            ("scalar", name_of(self.scalar).into()),
            ("max_depth", self.max_depth.into()),
            ("cutoff", self.cutoff.map_or(0.0, one_in).into()),
            ("samples", samples.into()),
            ("adaptive", adaptive.into()),
            ("power", name_of(self.power).into()),
            ("formulas", name_of(self.formulas).into()),
            ("preview", name_of(self.preview).into()),
            ("color", name_of(self.color).into()),
            ("dither", self.dither.into()),
        ]
    }
}

impl Serialize for Settings {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        to.collect_map(self.fields())
    }
}

/// Something that can be turned, through these steps in order.
#[derive(Clone, Debug)]
pub(crate) struct Knob {
    pub(crate) name: &'static str,
    /// The core that the steps are for, if they are for one.
    pub(crate) core: Option<Core>,
    pub(crate) steps: Vec<Step>,
}

/// Where a knob stands.
#[derive(Clone, Debug)]
pub(crate) struct Step {
    /// In a word.
    pub(crate) label: String,
    pub(crate) settings: Settings,
}

impl Knob {
    /// A knob whose steps change one of [`Settings::DEFAULT`].
    fn new<V: Copy>(
        name: &'static str,
        values: &[V],
        label: impl Fn(V) -> String,
        turn: impl Fn(&mut Settings, V),
    ) -> Self {
        let step = |value: &V| {
            let mut settings = Settings::DEFAULT;
            turn(&mut settings, *value);
            Step {
                label: label(*value),
                settings,
            }
        };
        Self {
            name,
            core: None,
            steps: values.iter().map(step).collect(),
        }
    }
}

/// All knobs; each passes through [`Settings::DEFAULT`].
pub(crate) fn knobs() -> Vec<Knob> {
    use ColorName::{Binary, Gray4, Rgb565, Rgb888};
    use PowerRoutine::{Polynomial, Squaring};
    let colors = [Rgb888, Rgb565, Gray4, Binary];
    vec![
        Knob::new(
            "max depth",
            &[0, 1, 2, 3, 4, 5, 8, 16],
            |depth: usize| depth.to_string(),
            |settings, depth| settings.max_depth = depth,
        ),
        Knob::new(
            "cut-off",
            &[None, Some(1024), Some(256), Some(64), Some(16), Some(4)],
            |cutoff| cutoff.map_or("off".to_owned(), |of| format!("1/{of}")),
            |settings, cutoff| settings.cutoff = cutoff,
        ),
        Knob::new(
            "samples a pixel",
            &[1, 4, 16, 64],
            |samples: u8| samples.to_string(),
            |settings, samples| settings.sampling = Sampling::Fixed(samples),
        ),
        Knob::new(
            "adaptive, up to 16 samples",
            &[None, Some(4), Some(8), Some(16), Some(32), Some(64)],
            |of| of.map_or("off".to_owned(), |of| format!("1/{of}")),
            |settings, of| settings.sampling = of.map_or(Sampling::Fixed(1), Sampling::Adaptive),
        ),
        Knob::new(
            "preview, coarse to fine",
            &[Detail::Quarter, Detail::Half, Detail::Full],
            name_of,
            |settings, preview| settings.preview = preview,
        ),
        Knob::new(
            "formulas",
            &[Formulas::Robust, Formulas::Textbook],
            name_of,
            |settings, formulas| settings.formulas = formulas,
        ),
        Knob::new(
            "ray offset",
            &[Formulas::Robust, Formulas::FixedOffset],
            |formulas| match formulas {
                Formulas::FixedOffset => "fixed".to_owned(),
                _ => "derived".to_owned(),
            },
            |settings, formulas| settings.formulas = formulas,
        ),
        Knob::new(
            "scalar",
            &[ScalarName::F32, ScalarName::F64],
            name_of,
            |settings, scalar| settings.scalar = scalar,
        ),
        Knob::new(
            "power routine",
            &[Squaring, Polynomial],
            name_of,
            |settings, power| settings.power = power,
        ),
        Knob::new("colour depth", &colors, name_of, |settings, color| {
            settings.color = color;
        }),
        Knob::new(
            "colour depth, dithered",
            &colors,
            name_of,
            |settings, color| (settings.color, settings.dither) = (color, color != Rgb888),
        ),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_knob_passes_through_the_default() {
        for knob in knobs() {
            let stands_at_default = |step: &Step| step.settings == Settings::DEFAULT;
            assert!(knob.steps.iter().any(stands_at_default), "{}", knob.name);
            assert!(knob.steps.len() > 1, "{}", knob.name);
        }
    }

    #[test]
    fn settings_are_named_by_what_differs() {
        assert_eq!(Settings::DEFAULT.to_string(), "default");
        let settings = Settings {
            max_depth: 2,
            color: ColorName::Rgb565,
            dither: true,
            ..Settings::DEFAULT
        };
        assert_eq!(settings.to_string(), "depth 2, rgb565, dither");
    }
}
