//! The catalogue: 73 numbered cases, what is expected of each, and what is measured.
//!
//! In every case: no channel is other than finite and in 0…1 before quantisation, nothing panics, no pixel
//! takes more rays than the tracer promises; with the cut-off of 8 bits no pixel is brighter, and none more
//! than 1 level darker. A pixel is *settled* when its `f64` colour stays within 1 level
//! of 255 while the sample moves by a thousandth of a pixel in x and y; the others lie on an edge that
//! rounding alone may move; they are counted, and at most 1 % of a picture. The tiers compare settled pixels
//! with the same scene in `f64`: **A** at most 1 level off, and that on at most 0.02 %; **B** at most 0.1 %
//! more than 1 level off; **C** what holds in every case, alone. *Rejected* means that the constructor or the
//! parser says why.

mod geometry;
mod image;
mod input;
mod record;
mod shading;

pub(crate) use image::telephoto;
pub use record::{Effort, Finding, Quantity, Record};

use std::panic::{AssertUnwindSafe, catch_unwind};

use serde::Serialize;

/// What a case is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Group {
    /// Rays and shapes.
    Geometry,
    /// Local colour, shadows, and where secondary rays start.
    Shading,
    /// Camera, picture, and the whole scene.
    Image,
    /// What is read, and what machine it runs on.
    Input,
}

/// A case of the catalogue.
#[derive(Clone, Copy)]
pub struct Case {
    /// Its number, from 1 to 73.
    pub number: u8,
    /// Its name, in words joined by `_`.
    pub name: &'static str,
    /// What it is about.
    pub group: Group,
    /// What is expected.
    pub expected: &'static str,
    how: How,
}

#[derive(Clone, Copy)]
struct How {
    single: fn(&mut Record),
    double: fn(&mut Record),
    /// The check by which it is checked on the boards, too.
    on_boards: Option<&'static str>,
}

impl std::fmt::Debug for Case {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Case")
            .field("number", &self.number)
            .field("name", &self.name)
            .finish_non_exhaustive()
    }
}

/// A scalar's name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum ScalarName {
    /// Single precision.
    F32,
    /// Double precision.
    F64,
}

impl ScalarName {
    /// Both.
    pub const ALL: [Self; 2] = [Self::F32, Self::F64];

    /// `f32` or `f64`.
    pub const fn name(self) -> &'static str {
        match self {
            Self::F32 => "f32",
            Self::F64 => "f64",
        }
    }
}

impl Case {
    /// All cases, by number.
    pub fn all() -> Vec<Self> {
        let mut all = [geometry::CASES, shading::CASES, image::CASES, input::CASES].concat();
        all.sort_by_key(|case| case.number);
        all
    }

    /// Its name in words: `1e_3` is 1e-3, `0_9` is 0.9.
    pub fn title(&self) -> String {
        let name: Vec<char> = self.name.chars().collect();
        let digit = |place: usize| name.get(place).is_some_and(char::is_ascii_digit);
        let sign = |(place, letter): (usize, &char)| match letter {
            '_' if place > 1 && digit(place + 1) && digit(place - 1) => '.',
            '_' if place > 1 && digit(place + 1) && name[place - 1] == 'e' && digit(place - 2) => {
                '-'
            }
            '_' => ' ',
            letter => *letter,
        };
        name.iter().enumerate().map(sign).collect()
    }

    /// Where the case is checked on the boards, if what is measured here is half of it.
    pub fn on_boards(&self) -> Option<&'static str> {
        self.how.on_boards
    }

    /// Measures the case in a scalar. A panic is a finding, too.
    pub fn measure(&self, scalar: ScalarName, effort: Effort) -> Vec<Finding> {
        let measure = match scalar {
            ScalarName::F32 => self.how.single,
            ScalarName::F64 => self.how.double,
        };
        let mut record = Record::new(effort);
        if catch_unwind(AssertUnwindSafe(|| measure(&mut record))).is_err() {
            record.count("panics", 1, 1);
        }
        record.into_findings()
    }
}

/// The cases of a group: `number name: "what is expected";` with a function of the name for each.
macro_rules! cases {
    ($group:ident: $($number:literal $name:ident: $expected:literal;)*) => {
        pub(super) const CASES: &[$crate::catalogue::Case] = &[$($crate::catalogue::Case {
            number: $number,
            name: stringify!($name),
            group: $crate::catalogue::Group::$group,
            expected: $expected,
            how: $crate::catalogue::How { single: $name::<f32>, double: $name::<f64>, on_boards: None },
        }),*];
    };
}
use cases;
