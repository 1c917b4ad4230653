//! What a picture may lose to be drawn sooner, or cost to be smoother.

use std::str::FromStr;

use clap::ValueEnum;
use scanray::{Scalar, camera::Subpixel, render::Supersampled};

/// Settings of a picture that trade time for quality.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Knobs {
    /// What the rays that are not cast may take from a channel; 0 casts them all.
    pub cutoff: f64,
    /// In each pixel.
    pub samples: SampleCount,
    /// Differences of channels from which on a pixel has the samples; `None` gives them to all.
    pub edges: Option<f64>,
    /// Pixels in one block, side by side.
    pub detail: Detail,
}

impl Default for Knobs {
    /// Every ray of one sample in each pixel.
    fn default() -> Self {
        Self {
            cutoff: 0.0,
            samples: SampleCount::One,
            edges: None,
            detail: Detail::Full,
        }
    }
}

/// Samples in a pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum SampleCount {
    /// The centre
    #[value(name = "1")]
    One,
    /// The rotated grid
    #[value(name = "4")]
    Four,
    /// Each 16th of a column and of a row has one
    #[value(name = "16")]
    Sixteen,
    /// Each 64th of a column and of a row has one
    #[value(name = "64")]
    SixtyFour,
}

impl SampleCount {
    /// Where they are.
    pub fn pattern(self) -> &'static [Subpixel] {
        match self {
            Self::One => &Supersampled::<(), 1>::PATTERN,
            Self::Four => &Supersampled::<(), 4>::PATTERN,
            Self::Sixteen => &Supersampled::<(), 16>::PATTERN,
            Self::SixtyFour => &Supersampled::<(), 64>::PATTERN,
        }
    }

    /// One divided by their number, which is exact.
    pub fn share<T: Scalar>(self) -> T {
        T::ONE / T::from_i32(self.pattern().len() as i32)
    }
}

/// How much of a picture that is drawn coarse to fine is there.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Detail {
    /// Each fourth pixel of each fourth row
    Quarter,
    /// Each second pixel of each second row
    Half,
    /// All pixels
    Full,
}

impl Detail {
    /// Side of the blocks, in pixels.
    pub fn block(self) -> u16 {
        match self {
            Self::Quarter => 4,
            Self::Half => 2,
            Self::Full => 1,
        }
    }
}

/// A cut-off on the command line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum CutoffChoice {
    /// As much as is less than a level of the display.
    Auto,
    Of(f64),
}

impl FromStr for CutoffChoice {
    type Err = String;

    fn from_str(word: &str) -> Result<Self, String> {
        match word {
            "auto" => Ok(Self::Auto),
            "none" => Ok(Self::Of(0.0)),
            _ => fraction(word)
                .map(Self::Of)
                .map_err(|why| format!("{why}; or none, or auto for a level of the display")),
        }
    }
}

/// A share of a channel's range, `A/B` or a decimal number.
///
/// # Errors
///
/// A sentence.
pub fn fraction(word: &str) -> Result<f64, String> {
    let (over, under) = word.split_once('/').unwrap_or((word, "1"));
    let number = |word: &str| word.parse::<f64>().ok();
    number(over)
        .zip(number(under))
        .map(|(over, under)| over / under)
        .filter(|share| (0.0..=1.0).contains(share))
        .ok_or_else(|| "give a share from 0 to 1, such as 1/256".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fractions() {
        assert_eq!(fraction("1/256"), Ok(1.0 / 256.0));
        assert_eq!(fraction("0.25"), Ok(0.25));
        assert_eq!(fraction("0"), Ok(0.0));
        for word in ["", "/", "1/", "2", "-1/2", "1/0", "0/0", "nan", "1/2/3"] {
            assert!(fraction(word).is_err(), "{word}");
        }
    }

    #[test]
    fn cutoffs() {
        assert_eq!("auto".parse(), Ok(CutoffChoice::Auto));
        assert_eq!("none".parse(), Ok(CutoffChoice::Of(0.0)));
        assert_eq!("1/64".parse(), Ok(CutoffChoice::Of(1.0 / 64.0)));
        let error = "much".parse::<CutoffChoice>().unwrap_err();
        assert!(error.contains("none, or auto"), "{error}");
    }
}
