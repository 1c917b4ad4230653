//! Words of the command line that several commands understand.

use std::ops::{Range, RangeInclusive};
use std::str::FromStr;

use clap::ValueEnum;
use scanray::Resolution;

use crate::console::shown;
use crate::turntable::Axis;

/// `WxH`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Size(pub Resolution);

impl FromStr for Size {
    type Err = String;

    fn from_str(word: &str) -> Result<Self, String> {
        let side = |digits: &str| {
            let is_number = !digits.is_empty() && digits.bytes().all(|byte| byte.is_ascii_digit());
            let number: u16 = digits.parse().ok().filter(|_| is_number)?;
            (number > 0).then_some(number)
        };
        word.split_once(['x', 'X'])
            .and_then(|(width, height)| {
                Some(Self(Resolution {
                    width: side(width)?,
                    height: side(height)?,
                }))
            })
            .ok_or_else(|| {
                "give width and height from 1 to 65535 pixels, such as 320x240".to_owned()
            })
    }
}

/// `A..B`: numbers from A up to, but not including, B. Either may be left out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RangeOption {
    start: u16,
    end: Option<u16>,
}

impl FromStr for RangeOption {
    type Err = String;

    fn from_str(word: &str) -> Result<Self, String> {
        let number = |digits: &str| match digits {
            "" => Some(None),
            _ => digits.parse().ok().map(Some),
        };
        word.split_once("..")
            .and_then(|(start, end)| {
                let (start, end) = (number(start)?.unwrap_or(0), number(end)?);
                let is_empty = end.is_some_and(|end| end <= start);
                (!is_empty).then_some(Self { start, end })
            })
            .ok_or_else(|| {
                "give the first and the one after the last, such as 0..100 for the first hundred"
                    .to_owned()
            })
    }
}

impl RangeOption {
    /// The numbers that are meant, of `count`, or all of them. Where that cannot be, the sentence is "--rows
    /// 0..9: the picture has 8 rows", with `option` and `things`.
    ///
    /// # Errors
    ///
    /// A sentence, when there are not so many.
    pub fn within(
        range: Option<Self>,
        count: u16,
        option: &str,
        [whole, things]: [&str; 2],
    ) -> Result<Range<u16>, String> {
        let Some(Self { start, end }) = range else {
            return Ok(0..count);
        };
        let range = start..end.unwrap_or(count);
        if range.is_empty() || range.end > count {
            let end = end.map(|end| end.to_string()).unwrap_or_default();
            return Err(format!(
                "{option} {start}..{end}: {whole} has {count} {things}, so the most is 0..{count}"
            ));
        }
        Ok(range)
    }
}

/// Options whose value may be left out, so that it needs the sign of equality.
const WITH_OPTIONAL_VALUE: [&str; 2] = ["--dither", "--emulate"];

/// What to say of a word of the command line that cannot be what it is taken for, if it stands behind an option whose value it
/// may be.
pub(crate) fn meant_for_option(word: &str) -> Option<String> {
    let arguments: Vec<_> = std::env::args_os().collect();
    let option = arguments
        .iter()
        .zip(arguments.iter().skip(1))
        .find_map(|(option, behind)| (behind == word).then_some(option.to_str()?))?;
    WITH_OPTIONAL_VALUE.contains(&option).then(|| {
        format!(
            "if it is meant for {option}, write {option}={}",
            shown(word)
        )
    })
}

/// `X,Z`: a vertical axis.
///
/// # Errors
///
/// A sentence.
pub(crate) fn axis(word: &str) -> Result<Axis, String> {
    let number = |word: &str| word.trim().parse().ok().filter(|n: &f64| n.is_finite());
    word.split_once(',')
        .and_then(|(x, z)| {
            Some(Axis {
                x: number(x)?,
                z: number(z)?,
            })
        })
        .ok_or_else(|| "give the x and the z of the axis, such as 0,2.5".to_owned())
}

/// Milliseconds, as hundredths of a second: that is what GIF counts in.
///
/// # Errors
///
/// A sentence.
pub fn centiseconds(word: &str) -> Result<u16, String> {
    word.parse()
        .ok()
        .filter(|ms| (20..=60_000).contains(ms) && ms % 10 == 0)
        .map(|ms: u16| ms / 10)
        .ok_or_else(|| {
            "give tens of milliseconds from 20 to 60000; viewers show shorter ones too long"
                .to_owned()
        })
}

/// Whole numbers of a range.
pub fn whole<N: TryFrom<u64> + 'static>(
    range: RangeInclusive<u64>,
) -> impl Fn(&str) -> Result<N, String> + Clone {
    move |word| {
        word.parse()
            .ok()
            .filter(|number| range.contains(number))
            .and_then(|number| N::try_from(number).ok())
            .ok_or_else(|| {
                let (least, most) = (range.start(), range.end());
                format!("give a whole number from {least} to {most}")
            })
    }
}

/// A maximum depth that there is a stack for.
///
/// # Errors
///
/// A sentence.
pub fn max_depth(word: &str) -> Result<usize, String> {
    const MOST: usize = crate::host_tracer::MAX_DEPTH;
    word.parse()
        .ok()
        .filter(|depth| *depth <= MOST)
        .ok_or_else(|| format!("give a whole number from 0 (no mirror rays) to {MOST}"))
}

/// Number type of the tracer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum ScalarName {
    /// Single precision, as on devices
    F32,
    /// Double precision, the reference
    F64,
}

/// A display's colours.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum ColorName {
    /// 8 bits a channel
    Rgb888,
    /// 6 bits a channel
    Rgb666,
    /// 5, 6 and 5 bits
    Rgb565,
    /// 5 bits a channel
    Rgb555,
    /// As rgb888, blue first
    Bgr888,
    /// As rgb666, blue first
    Bgr666,
    /// As rgb565, blue first
    Bgr565,
    /// As rgb555, blue first
    Bgr555,
    /// 256 shades of grey
    Gray8,
    /// 16 shades of grey
    Gray4,
    /// 4 shades of grey
    Gray2,
    /// Black and white
    Binary,
}

impl ColorName {
    /// Whether it has no colours.
    pub fn is_grey(self) -> bool {
        matches!(self, Self::Gray8 | Self::Gray4 | Self::Gray2 | Self::Binary)
    }

    /// Levels of the finest channel.
    pub fn levels(self) -> u16 {
        match self {
            Self::Rgb888 | Self::Bgr888 | Self::Gray8 => 256,
            Self::Rgb666 | Self::Bgr666 | Self::Rgb565 | Self::Bgr565 => 64,
            Self::Rgb555 | Self::Bgr555 => 32,
            Self::Gray4 => 16,
            Self::Gray2 => 4,
            Self::Binary => 2,
        }
    }
}

/// `with_color!(name, C => expression)`: the expression with `C` standing for the named colour of
/// embedded-graphics.
#[macro_export]
macro_rules! with_color {
    ($name:expr, $color:ident => $body:expr) => {
        $crate::with_color!(@match $name, $color, $body;
            Rgb888 = Rgb888, Rgb666 = Rgb666, Rgb565 = Rgb565, Rgb555 = Rgb555,
            Bgr888 = Bgr888, Bgr666 = Bgr666, Bgr565 = Bgr565, Bgr555 = Bgr555,
            Gray8 = Gray8, Gray4 = Gray4, Gray2 = Gray2, Binary = BinaryColor)
    };
    (@match $name:expr, $color:ident, $body:expr; $($variant:ident = $type:ident),*) => {
        match $name {$(
            $crate::option_values::ColorName::$variant => {
                type $color = $crate::pixelcolor::$type;
                $body
            }
        )*}
    };
}
pub use crate::with_color;

/// The name of a choice, as the command line has it.
pub fn name_of(choice: impl ValueEnum) -> String {
    choice
        .to_possible_value()
        .map(|value| value.get_name().to_owned())
        .unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes() {
        let size = |word: &str| word.parse::<Size>().ok().map(|Size(r)| (r.width, r.height));
        assert_eq!(size("160x120"), Some((160, 120)));
        assert_eq!(size("1X65535"), Some((1, 65_535)));
        for word in [
            "", "x", "160", "0x1", "1x0", "65536x1", "+1x1", "1x1x1", "1 x1", "-1x1",
        ] {
            assert_eq!(size(word), None, "{word}");
        }
    }

    #[test]
    fn ranges() {
        let within = |word: &str, count| {
            let range = word.parse::<RangeOption>().ok()?;
            RangeOption::within(Some(range), count, "--rows", ["the picture", "rows"]).ok()
        };
        assert_eq!(within("0..5", 5), Some(0..5));
        assert_eq!(within("2..", 5), Some(2..5));
        assert_eq!(within("..3", 5), Some(0..3));
        assert_eq!(within("..", 5), Some(0..5));
        for word in [
            "", "3", "3..3", "4..3", "0..6", "5..", "a..b", "-1..2", "1...3", "1..=3",
        ] {
            assert_eq!(within(word, 5), None, "{word}");
        }
        assert_eq!(
            RangeOption::within(None, 7, "--rows", ["the picture", "rows"]),
            Ok(0..7)
        );
    }

    #[test]
    fn axes_and_delays() {
        assert_eq!(axis("-1.5, 2"), Ok(Axis { x: -1.5, z: 2.0 }));
        for word in ["", "1", "1,2,3", "1;2", "a,b", "inf,0"] {
            assert!(axis(word).is_err(), "{word}");
        }
        assert_eq!(centiseconds("40"), Ok(4));
        for word in ["", "0", "10", "45", "60010", "-40", "1s"] {
            assert!(centiseconds(word).is_err(), "{word}");
        }
    }
}
