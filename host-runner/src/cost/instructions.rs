//! How many instructions a picture takes on a microcontroller: a model.
//!
//! Each thing that the tracer does ([`Work::terms`]) takes as many as `instructions.txt` says, which also says how far the sum was off
//! at most. The file is fitted to pictures drawn under emulation, by `firmware/tools/instruction_model.py`, and holds for programs
//! that are compiled as those are: a baked scene with the stages it needs, the size profile. What highlights, the look whether rays show
//! and the display's colours take is not in it by itself.

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
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Model {
    terms: Rows,
    /// Largest errors in percent, of what it was fitted to and of what was held out.
    errors: Rows,
}

/// The model that is checked in.
pub static MODEL: LazyLock<Model> =
    LazyLock::new(|| Model::parse(include_str!("instructions.txt")).unwrap_or_default());

impl Model {
    fn parse(text: &str) -> Option<Self> {
        let mut terms = table::parse(text)?;
        terms.retain(|(name, _)| !name.starts_with("median_error"));
        let (errors, terms) = terms
            .into_iter()
            .partition(|(name, _)| name.starts_with("largest_error"));
        Some(Self { terms, errors })
    }

    /// Instructions a pixel on each core.
    pub fn instructions_per_pixel(&self, work: &Work) -> [f64; Core::ALL.len()] {
        let counts = work.terms();
        let sum = |core: Core| -> f64 {
            let of = |name: &str| {
                counts
                    .iter()
                    .find(|(n, _)| *n == name)
                    .map_or(0, |(_, c)| *c)
            };
            let instructions =
                |(name, each): &(String, [f64; 3])| each[core as usize] * of(name) as f64;
            self.terms.iter().map(instructions).sum()
        };
        Core::ALL.map(|core| sum(core) / work.pixels.max(1) as f64)
    }

    /// By how many percent a prediction was off at most on each core, when the table was written.
    pub fn within_percent(&self) -> [u32; Core::ALL.len()] {
        let largest = |core: Core| {
            self.errors
                .iter()
                .map(|(_, e)| e[core as usize])
                .fold(0.0, f64::max)
        };
        Core::ALL.map(|core| largest(core).ceil() as u32)
    }

    /// The same in words.
    pub fn within(&self) -> String {
        let [m4f, m3, m0] = self.within_percent();
        format!("within {m4f} % on the M4F, {m3} % on the M3 and {m0} % on the M0")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_has_the_terms_that_are_counted() {
        let model = Model::parse(include_str!("instructions.txt")).unwrap();
        let names: Vec<_> = model.terms.iter().map(|(name, _)| name.as_str()).collect();
        assert_eq!(names, Work::default().terms().map(|(name, _)| name));
        assert!(names.len() <= 12);
        let numbers = model.terms.iter().flat_map(|(_, each)| each);
        assert!(numbers.into_iter().all(|number| *number >= 0.0));
        assert_eq!(model.errors.len(), 2);
        assert!(model.within_percent().iter().all(|percent| *percent > 0));
    }

    #[test]
    fn instructions_add_up() {
        let table = "# comment\nterm M3 M4F M0\nlargest_error_fitted 7 5 9\nlargest_error_held_out 6 8 9\n\
                     median_error_fitted 50 50 50\npixels 10 1 100\nhits 20 2 200\n";
        let model = Model::parse(table).unwrap();
        let work = Work {
            pixels: 2,
            hits: 3,
            ..Default::default()
        };
        assert_eq!(model.instructions_per_pixel(&work), [4.0, 40.0, 400.0]);
        assert_eq!(model.within_percent(), [8, 7, 9]);
        assert_eq!(Model::parse("term M4F M3 M0\nhits 1 x 2\n"), None);
    }
}
