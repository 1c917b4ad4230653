//! Why a scene text was rejected, and where.

use core::fmt;

use crate::pools::Pool;
use crate::stages::Stages;

/// A rejection: where, what was expected there and what was found.
///
/// [`fmt::Display`] gives one line with the place; [`ParseError::message`] the same without it, for
/// callers that show the place in their own way.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ParseError {
    /// Byte of the text it is about, from 0; at most its length.
    pub offset: usize,
    /// Line, from 1.
    pub line: u32,
    /// Column in bytes, from 1.
    pub column: u32,
    /// What would have been accepted.
    pub expected: Expected,
    /// What is there instead.
    pub found: Found,
}

/// What would have been accepted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Expected {
    /// A number with a meaning.
    Number {
        /// Its meaning.
        name: &'static str,
        /// The numbers that are accepted.
        range: Range,
    },
    /// No further number on the line.
    EndOfLine,
    /// No further object.
    EndOfScene {
        /// Number of objects that the first number announces.
        objects: u32,
        /// Number of objects that there are.
        follow: u32,
        /// The line of the first number.
        line: u32,
    },
    /// An object.
    Object {
        /// The one that is missing, from 1.
        number: u32,
        /// Number of objects that the first number announces.
        of: u32,
        /// The line of the first number.
        line: u32,
    },
    /// Room in a pool.
    Room {
        /// The pool that is full.
        pool: Pool,
        /// What it holds.
        capacity: usize,
        /// The object that does not fit, from 1; `None` if it is the light.
        object: Option<u32>,
    },
}

/// A range of accepted numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Range {
    /// Any finite number.
    Finite,
    /// Finite and not negative.
    NotNegative,
    /// An intensity of light: from 0 to [`Range::MAX_INTENSITY`].
    Intensity,
    /// A colour or a coefficient of a material: from 0 to [`Range::MAX_SHARE`].
    Share,
    /// Digits only, within limits.
    Whole {
        /// The smallest that is accepted.
        min: u32,
        /// The largest that is accepted.
        max: u32,
    },
    /// The digit 0 or 1.
    Flag,
    /// The kind of an object: the digit 0, 1 or 2.
    ObjectKind,
    /// Above 0, with a finite square.
    Radius,
    /// Three numbers that are not all 0.
    Direction,
    /// Finite also after division by the length of the normal.
    Distance,
    /// Nine numbers that make a triangle with an area and finite edges.
    TriangleWithArea,
    /// Nine numbers that make a triangle that this scalar can compute with: neither too large nor too small.
    TriangleSize(&'static str),
    /// Within [`Range::INDEX`], because the object refracts.
    RefractiveIndex,
    /// A number that does not need these stages, without which the pools are declared.
    Without(Stages),
}

/// What is there instead of what was expected.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Found {
    /// A word that is not what was expected.
    Word(Excerpt),
    /// A number that is infinite in the scalar of this name.
    TooLarge(Excerpt, &'static str),
    /// A number above 0 that is 0 in the scalar of this name.
    TooSmall(Excerpt, &'static str),
    /// The line ends.
    EndOfLine,
    /// The text ends.
    EndOfText,
}

/// The beginning of a word of the text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Excerpt {
    bytes: [u8; Self::CAPACITY],
    length: u8,
    is_cut: bool,
}

impl Excerpt {
    const CAPACITY: usize = 24;

    pub(super) fn new(word: &[u8]) -> Self {
        let mut bytes = [0; Self::CAPACITY];
        for (to, from) in bytes.iter_mut().zip(word) {
            *to = *from;
        }
        Self {
            bytes,
            length: word.len().min(Self::CAPACITY) as u8,
            is_cut: word.len() > Self::CAPACITY,
        }
    }

    /// The bytes that are kept.
    pub fn bytes(&self) -> &[u8] {
        self.bytes.get(..usize::from(self.length)).unwrap_or(&[])
    }
}

/// Characters that a reader would not see, or that change the order of others: controls, blanks that are
/// none to this format, marks of direction and of byte order.
fn is_invisible(character: char) -> bool {
    character.is_control()
        || matches!(
            character,
            '\u{a0}' | '\u{ad}' | '\u{61c}' | '\u{1680}' | '\u{3000}' | '\u{feff}'
                | '\u{2000}'..='\u{200f}'
                | '\u{2028}'..='\u{202f}'
                | '\u{205f}'..='\u{206f}'
        )
}

impl fmt::Display for Excerpt {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("`")?;
        for chunk in self.bytes().utf8_chunks() {
            for character in chunk.valid().chars() {
                if is_invisible(character) {
                    write!(f, "{}", character.escape_default())?;
                } else {
                    write!(f, "{character}")?;
                }
            }
            // A character that the excerpt cut in two is dropped rather than shown as bytes.
            if !self.is_cut {
                write!(f, "{}", chunk.invalid().escape_ascii())?;
            }
        }
        f.write_str(if self.is_cut { "…`" } else { "`" })
    }
}

impl Range {
    /// The largest intensity of light. Together with [`Range::MAX_SHARE`] it keeps all sums of light finite in `f32`.
    pub const MAX_INTENSITY: f32 = 1e30;

    /// The largest colour or coefficient of a material.
    pub const MAX_SHARE: f32 = 1e6;

    /// The smallest and the largest index of refraction of what refracts. A refracted direction is off by the index times what the
    /// normal is off: with an index of 1000 every twentieth pixel of the published picture is wrong, in `f32`, with 100 every
    /// thousandth.
    pub const INDEX: [f32; 2] = [0.01, 100.0];

    /// The largest number of a range that begins at 0.
    pub(super) fn largest(self) -> Option<f32> {
        match self {
            Self::NotNegative => Some(f32::INFINITY),
            Self::Intensity => Some(Self::MAX_INTENSITY),
            Self::Share => Some(Self::MAX_SHARE),
            _ => None,
        }
    }
}

impl fmt::Display for Range {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Finite => "a finite number",
            Self::NotNegative => "a number of at least 0",
            // As text: on a board floats are not formatted.
            Self::Intensity => "a number from 0 to 1e30",
            Self::Share => "a number from 0 to 1e6",
            Self::Whole { min, max } => {
                return write!(f, "a whole number from {min} to {max} in digits only");
            }
            Self::Flag => "1 for the sky gradient or 0 for the background colour",
            Self::ObjectKind => "0 for a sphere, 1 for a plane or 2 for a triangle",
            Self::Radius => "a number above 0 whose square is finite",
            Self::Direction => "three numbers that are not all 0",
            Self::Distance => "a number that stays finite when divided by the normal's length",
            Self::TriangleWithArea => {
                "three points that are not on one line and not infinitely far apart"
            }
            Self::TriangleSize("f64") => {
                "a triangle of at least 2e-146 across, with coordinates up to 8e152"
            }
            Self::TriangleSize(_) => {
                "a triangle of at least 1e-15 across, with coordinates up to 1e18"
            }
            Self::Without(stages) => {
                let number = if *stages == Stages::BENDING { 1 } else { 0 };
                return write!(
                    f,
                    "{number}, because the pools are declared without {stages}"
                );
            }
            Self::RefractiveIndex => "a number from 0.01 to 100, because the refraction is above 0",
        })
    }
}

impl fmt::Display for Expected {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number { name, range } => write!(f, "the {name}: {range}"),
            Self::EndOfLine => f.write_str("the end of the line"),
            // What follows is no object.
            Self::EndOfScene {
                objects,
                follow,
                line,
            } if follow == objects => write!(
                f,
                "the end of the scene after the {objects} objects that line {line} announces"
            ),
            Self::EndOfScene {
                objects,
                follow,
                line,
            } => {
                f.write_str("the end of the scene: ")?;
                write_counts(f, *line, *objects, *follow)
            }
            Self::Object { number, of, line } => {
                write!(f, "object {number}: ")?;
                write_counts(f, *line, *of, number.saturating_sub(1))
            }
            Self::Room {
                pool,
                capacity,
                object,
            } => {
                let pool = pool.name();
                write!(
                    f,
                    "at most {capacity} {pool}, which is all their pool holds; "
                )?;
                match object {
                    Some(object) => write!(f, "object {object} does not fit"),
                    None => f.write_str("the light does not fit"),
                }
            }
        }
    }
}

/// What is announced, what there is, and what to write.
fn write_counts(f: &mut fmt::Formatter<'_>, line: u32, said: u32, follow: u32) -> fmt::Result {
    let plural = if said == 1 { "" } else { "s" };
    write!(
        f,
        "line {line} says {said} object{plural}, {follow} follow: write {follow}"
    )
}

impl fmt::Display for Found {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Word(word) => word.fmt(f),
            Self::TooLarge(word, scalar) => write!(f, "{word}, which is too large for {scalar}"),
            Self::TooSmall(word, scalar) => write!(f, "{word}, which is 0 in {scalar}"),
            Self::EndOfLine => f.write_str("the end of the line"),
            Self::EndOfText => f.write_str("the end of the text"),
        }
    }
}

impl ParseError {
    /// What was expected and found, without the place.
    pub fn message(&self) -> impl fmt::Display {
        struct Message(Expected, Found);
        impl fmt::Display for Message {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                write!(f, "expected {}; found {}", self.0, self.1)
            }
        }
        Message(self.expected, self.found)
    }
}

impl fmt::Display for ParseError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "line {}, column {}: {}",
            self.line,
            self.column,
            self.message()
        )
    }
}

impl core::error::Error for ParseError {}

/// Line and column, both from 1, of a byte of the text.
pub(super) fn place(text: &[u8], offset: usize) -> (u32, u32) {
    let before = text.get(..offset).unwrap_or(text);
    let mut line = 1;
    let mut column = 1;
    for byte in before {
        if *byte == b'\n' {
            line += 1;
            column = 1;
        } else {
            column += 1;
        }
    }
    (line, column)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::format;

    #[test]
    fn ranges_are_told_as_they_are() {
        let ends = |low: f32, high: f32| format!("a number from {low} to {high:e}");
        let told = |range: Range| format!("{range}");
        assert_eq!(told(Range::Intensity), ends(0.0, Range::MAX_INTENSITY));
        assert_eq!(told(Range::Share), ends(0.0, Range::MAX_SHARE));
        let [least, most] = Range::INDEX;
        let index = format!("a number from {least} to {most}, because the refraction is above 0");
        assert_eq!(told(Range::RefractiveIndex), index);
    }
}
