//! How many instructions a picture takes on a microcontroller: a model.
//!
//! Each thing that the tracer does ([`Work`]) takes as many as `instructions.txt` says. The file is fitted
//! to pictures drawn under emulation, by `firmware/tools/instruction_model.py`, and holds for programs
//! that are compiled as those are: a baked scene with the stages it needs, the size profile. What the display's colours take is
//! not in it: dither adds 1 % or so, fewer levels save less.

use std::fmt;
use std::sync::LazyLock;

use serde::Serialize;

use super::Work;
use super::table::{self, Rows};

/// A core there are coefficients for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, clap::ValueEnum)]
#[serde(rename_all = "lowercase")]
pub enum Core {
    /// Cortex-M4 with single-precision hardware
    M4f,
    /// Cortex-M3, floating point in software
    M3,
    /// Cortex-M0, floating point in software
    M0,
}

impl Core {
    /// All of them, the fastest first.
    pub const ALL: [Self; 3] = [Self::M4f, Self::M3, Self::M0];

    /// As the tables name it.
    pub fn name(self) -> &'static str {
        match self {
            Self::M4f => "M4F",
            Self::M3 => "M3",
            Self::M0 => "M0",
        }
    }
}

impl fmt::Display for Core {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// What each thing takes: a name and a number for each of [`Core::ALL`].
#[derive(Clone, Debug, PartialEq)]
pub struct Model {
    terms: Rows,
}

/// The model that is checked in.
pub static MODEL: LazyLock<Model> = LazyLock::new(|| {
    Model::parse(include_str!("instructions.txt")).unwrap_or_else(|| Model { terms: Vec::new() })
});

impl Model {
    fn parse(text: &str) -> Option<Self> {
        table::parse(text).map(|terms| Self { terms })
    }

    /// Instructions a pixel on each core.
    pub fn instructions_per_pixel(&self, work: &Work) -> [f64; Core::ALL.len()] {
        Core::ALL.map(|core| self.sum(work, core))
    }

    fn sum(&self, work: &Work, core: Core) -> f64 {
        let sum: f64 = self
            .terms
            .iter()
            .map(|(name, each)| each[core as usize] * work.count_of(name).unwrap_or(0) as f64)
            .sum();
        sum / work.pixels.max(1) as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_knows_what_the_counter_counts() {
        let model = Model::parse(include_str!("instructions.txt")).unwrap();
        assert!(!model.terms.is_empty());
        for (name, each) in &model.terms {
            assert!(Work::default().count_of(name).is_some(), "{name}");
            assert!(each.iter().all(|number| *number >= 0.0), "{name}");
        }
    }

    #[test]
    fn instructions_add_up() {
        let table = "# comment\nterm M3 M4F M0\nprimary_rays 10 1 100\nlit 20 2 200\n";
        let model = Model::parse(table).unwrap();
        let work = Work {
            pixels: 2,
            primary_rays: 4,
            lit: 3,
            ..Default::default()
        };
        let predicted = model.instructions_per_pixel(&work);
        assert_eq!(predicted, [5.0, 50.0, 500.0]);
        assert_eq!(Model::parse("term M4F M3 M0\nlit 1 x 2\n"), None);
    }
}
