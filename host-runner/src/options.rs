//! Words of the command line that several commands understand.

use std::ops::Range;
use std::str::FromStr;

use clap::ValueEnum;
use scanray::Resolution;

/// `WxH`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Size(pub(crate) Resolution);

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

/// `A..B`: rows from A up to, but not including, B. Either may be left out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct RowRange {
    start: u16,
    end: Option<u16>,
}

impl FromStr for RowRange {
    type Err = String;

    fn from_str(word: &str) -> Result<Self, String> {
        let row = |digits: &str| match digits {
            "" => Some(None),
            _ => digits.parse().ok().map(Some),
        };
        word.split_once("..")
            .and_then(|(start, end)| {
                let (start, end) = (row(start)?.unwrap_or(0), row(end)?);
                let is_empty = end.is_some_and(|end| end <= start);
                (!is_empty).then_some(Self { start, end })
            })
            .ok_or_else(|| {
                "give the first row and the row after the last, such as 0..100 for the first hundred"
                    .to_owned()
            })
    }
}

impl RowRange {
    /// The rows of a picture that are meant.
    ///
    /// # Errors
    ///
    /// A sentence, when the picture has not all of them.
    pub(crate) fn within(option: Option<Self>, height: u16) -> Result<Range<u16>, String> {
        let Some(Self { start, end }) = option else {
            return Ok(0..height);
        };
        let range = start..end.unwrap_or(height);
        if range.is_empty() || range.end > height {
            let end = end.map(|end| end.to_string()).unwrap_or_default();
            return Err(format!(
                "--rows {start}..{end}: the picture has {height} rows, so the most is 0..{height}"
            ));
        }
        Ok(range)
    }
}

/// A maximum depth that there is a stack for.
///
/// # Errors
///
/// A sentence.
pub(crate) fn max_depth(word: &str) -> Result<usize, String> {
    const MOST: usize = crate::drawing::MAX_DEPTH;
    word.parse()
        .ok()
        .filter(|depth| *depth <= MOST)
        .ok_or_else(|| format!("give a whole number from 0 (no mirror rays) to {MOST}"))
}

/// Number type of the tracer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum ScalarName {
    /// Single precision, as on devices
    F32,
    /// Double precision, the reference
    F64,
}

/// A display's colours.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum ColorName {
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

/// `with_color!(name, C => expression)`: the expression with `C` standing for the named colour of
/// embedded-graphics.
macro_rules! with_color {
    ($name:expr, $color:ident => $body:expr) => {
        with_color!(@match $name, $color, $body;
            Rgb888 = Rgb888, Rgb666 = Rgb666, Rgb565 = Rgb565, Rgb555 = Rgb555,
            Bgr888 = Bgr888, Bgr666 = Bgr666, Bgr565 = Bgr565, Bgr555 = Bgr555,
            Gray8 = Gray8, Gray4 = Gray4, Gray2 = Gray2, Binary = BinaryColor)
    };
    (@match $name:expr, $color:ident, $body:expr; $($variant:ident = $type:ident),*) => {
        match $name {$(
            $crate::options::ColorName::$variant => {
                type $color = embedded_graphics::pixelcolor::$type;
                $body
            }
        )*}
    };
}
pub(crate) use with_color;

/// The name of a choice, as the command line has it.
pub(crate) fn name_of(choice: impl ValueEnum) -> String {
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
    fn ranges_of_rows() {
        let within = |word: &str, height| {
            let range = word.parse::<RowRange>().ok()?;
            RowRange::within(Some(range), height).ok()
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
        assert_eq!(RowRange::within(None, 7), Ok(0..7));
    }
}
