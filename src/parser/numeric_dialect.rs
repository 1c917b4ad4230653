//! The numeric dialect: one record a line, numbers separated by blanks.
//!
//! | record | numbers | meaning |
//! |---|---|---|
//! | 1 | 1 | number of objects that follow |
//! | 2 | 3 | camera position |
//! | 3 | 2 | image width and height |
//! | 4 | 9 | light: position, specular intensity, diffuse intensity; with 8 numbers the last is repeated |
//! | 5 | 1 | ambient intensity |
//! | 6 | 1 | 1 = sky gradient, 0 = background colour |
//! | 7 | 3 | background colour |
//! | 8… | | one object each: kind, geometry, material |
//!
//! Kind 0 is a sphere (centre, radius), 1 a plane (normal, distance), 2 a triangle (three vertices,
//! then four placeholders for normal and distance). The material is diffuse, specular and ambient
//! colour, reflection, shininess, refraction, index of refraction.

use super::decimal::{DecimalError, FromDecimal};
use super::error::{Excerpt, Expected, Found, ParseError, Range, place};
use super::{Report, lexeme};
use crate::background::Background;
use crate::camera::{Camera, Resolution};
use crate::color::Color;
use crate::light::Light;
use crate::material::MaterialDescription;
use crate::pools::{Declared, Pool, PoolsMut, SceneError};
use crate::scalar::Scalar;
use crate::shape::ShapeError;
use crate::stages::Stages;
use crate::vec3::Vec3;

/// Reads a scene into empty pools. After an error they hold a part of it.
pub(super) fn read<T: Scalar + FromDecimal, D: Declared>(
    text: &[u8],
    pools: &mut PoolsMut<'_, T, D>,
) -> Result<Report, ParseError> {
    let mut records = Records::new(text);
    let mut report = Report::default();

    records.begin();
    let objects = records.whole("number of objects", 0, u32::MAX)?;
    records.count_end = records.behind;
    records.end()?;

    records.begin();
    pools.set_camera(Camera {
        position: records.vector([
            "camera position x",
            "camera position y",
            "camera position z",
        ])?,
    });
    records.end()?;

    records.begin();
    pools.set_resolution(Resolution {
        width: records.whole("image width", 1, u32::from(u16::MAX))? as u16,
        height: records.whole("image height", 1, u32::from(u16::MAX))? as u16,
    });
    records.end()?;

    records.begin();
    let first = records.peek_word();
    let light = read_light(&mut records, &mut report)?;
    records.end()?;
    if let Err(SceneError::PoolFull { pool, capacity }) = pools.add_light(light) {
        return Err(records.no_room(first, pool, capacity, None));
    }

    records.begin();
    pools.set_ambient(records.number("ambient intensity", Range::Intensity)?.value);
    records.end()?;

    records.begin();
    let sky = records.digit("background flag", Range::Flag, 1)? == 1;
    records.end()?;

    records.begin();
    pools.set_background(Background {
        color: records.color(
            [
                "red of the background colour",
                "green of the background colour",
                "blue of the background colour",
            ],
            Range::Intensity,
        )?,
        sky,
    });
    records.end()?;

    for number in 1..=objects {
        records.begin();
        read_object(&mut records, pools, number, objects)?;
    }

    records.begin();
    let too_many = records.peek_word();
    if !too_many.is_empty() {
        let follow = objects.saturating_add(records.objects_left());
        let (line, _) = place(text, records.count_end);
        return Err(records.error_at(
            too_many,
            Expected::EndOfScene {
                objects,
                follow,
                line,
            },
            Found::Word(Excerpt::new(too_many)),
        ));
    }
    Ok(report)
}

fn read_light<T: Scalar + FromDecimal>(
    records: &mut Records<'_>,
    report: &mut Report,
) -> Result<Light<T>, ParseError> {
    let position = records.vector(["light position x", "light position y", "light position z"])?;
    let specular = records.color(
        [
            "red of the light's specular intensity",
            "green of the light's specular intensity",
            "blue of the light's specular intensity",
        ],
        Range::Intensity,
    )?;
    let red = records.number("red of the light's diffuse intensity", Range::Intensity)?;
    let green = records.number("green of the light's diffuse intensity", Range::Intensity)?;
    // The published example gives 8 numbers here.
    let blue = if records.is_at_end() {
        report.short_light_line = Some(records.place().0);
        green
    } else {
        records.number("blue of the light's diffuse intensity", Range::Intensity)?
    };
    Ok(Light {
        position,
        specular,
        diffuse: Color::new(red.value, green.value, blue.value),
    })
}

fn read_object<T: Scalar + FromDecimal, D: Declared>(
    records: &mut Records<'_>,
    pools: &mut PoolsMut<'_, T, D>,
    number: u32,
    of: u32,
) -> Result<(), ParseError> {
    let Some(first) = records.word() else {
        let (line, _) = place(records.text, records.count_end);
        return Err(records.error_behind(Expected::Object { number, of, line }));
    };
    let kind = records.digit_of(first, "kind of the object", Range::ObjectKind, 2)?;
    let pool = match kind {
        0 => Pool::Spheres,
        1 => Pool::Planes,
        _ => Pool::Triangles,
    };
    if let Err(SceneError::PoolFull { pool, capacity }) = pools.has_room(pool) {
        return Err(records.no_room(first, pool, capacity, Some(number)));
    }
    // Where the geometry begins: what an error about all of it points at.
    let geometry = records.peek_word();
    let result = match pool {
        Pool::Spheres => {
            let center: Vec3<T> = records.vector([
                "sphere's centre x",
                "sphere's centre y",
                "sphere's centre z",
            ])?;
            let radius: Number<'_, T> = records.number("sphere's radius", Range::Radius)?;
            if radius.value == T::ZERO && has_digit_above_0(radius.word) {
                return Err(records.error_at(
                    radius.word,
                    Expected::Number {
                        name: "sphere's radius",
                        range: Range::Radius,
                    },
                    Found::TooSmall(Excerpt::new(radius.word), T::NAME),
                ));
            }
            if !(radius.value > T::ZERO && (radius.value * radius.value).is_finite()) {
                return Err(records.unfit("sphere's radius", Range::Radius, radius.word));
            }
            let material = read_material::<T, D>(records)?;
            records.end()?;
            pools.add_sphere(center, radius.value, material)
        }
        Pool::Planes => {
            let normal: Vec3<T> =
                records.vector(["plane's normal x", "plane's normal y", "plane's normal z"])?;
            if normal.try_normalize().is_none() {
                return Err(records.unfit("plane's normal", Range::Direction, geometry));
            }
            let distance = records.number("plane's distance", Range::Finite)?;
            let material = read_material::<T, D>(records)?;
            records.end()?;
            let result = pools.add_plane(normal, distance.value, material);
            if let Err(SceneError::Shape(ShapeError::DistanceTooLarge)) = result {
                return Err(records.unfit("plane's distance", Range::Distance, distance.word));
            }
            result
        }
        _ => {
            let vertices = [
                records.vector(["first vertex x", "first vertex y", "first vertex z"])?,
                records.vector(["second vertex x", "second vertex y", "second vertex z"])?,
                records.vector(["third vertex x", "third vertex y", "third vertex z"])?,
            ];
            for name in [
                "placeholder of the normal x",
                "placeholder of the normal y",
                "placeholder of the normal z",
                "placeholder of the distance",
            ] {
                records.number::<T>(name, Range::Finite)?;
            }
            let material = read_material::<T, D>(records)?;
            records.end()?;
            pools.add_triangle(vertices, material)
        }
    };
    match result {
        Ok(()) => Ok(()),
        Err(SceneError::PoolFull { pool, capacity }) => {
            Err(records.no_room(first, pool, capacity, Some(number)))
        }
        Err(SceneError::LeftOut { stage }) => {
            Err(records.unfit("material", Range::Without(stage), geometry))
        }
        Err(SceneError::Shape(ShapeError::TooSmall | ShapeError::TooLarge)) => {
            Err(records.unfit("triangle", Range::TriangleSize(T::NAME), geometry))
        }
        Err(_) => Err(records.unfit("triangle", Range::TriangleWithArea, geometry)),
    }
}

fn read_material<T: Scalar + FromDecimal, D: Declared>(
    records: &mut Records<'_>,
) -> Result<MaterialDescription<T>, ParseError> {
    // A number that needs what the pools are declared without.
    let fits = |records: &Records<'_>, name, is_needed: bool, stage: Stages, word: &[u8]| {
        if is_needed && !D::STAGES.contains(stage) {
            return Err(records.unfit(name, Range::Without(stage), word));
        }
        Ok(())
    };
    let diffuse = records.color(
        [
            "red diffuse colour",
            "green diffuse colour",
            "blue diffuse colour",
        ],
        Range::Share,
    )?;
    let word = records.peek_word();
    let specular: Color<T> = records.color(
        [
            "red specular colour",
            "green specular colour",
            "blue specular colour",
        ],
        Range::Share,
    )?;
    let shines = !specular.is_black();
    fits(records, "specular colour", shines, Stages::SPECULAR, word)?;
    let ambient = records.color(
        [
            "red ambient colour",
            "green ambient colour",
            "blue ambient colour",
        ],
        Range::Share,
    )?;
    let reflection: Number<'_, T> = records.number("reflection", Range::Share)?;
    let reflects = reflection.value > T::ZERO;
    fits(
        records,
        "reflection",
        reflects,
        Stages::REFLECTION,
        reflection.word,
    )?;
    let shininess = records.number("shininess", Range::NotNegative)?.value;
    let refraction: Number<'_, T> = records.number("refraction", Range::Share)?;
    let refracts = refraction.value > T::ZERO;
    fits(
        records,
        "refraction",
        refracts,
        Stages::REFRACTION,
        refraction.word,
    )?;
    let index: Number<'_, T> = records.number("index of refraction", Range::NotNegative)?;
    let bends = refracts && index.value != T::ONE;
    fits(
        records,
        "index of refraction",
        bends,
        Stages::BENDING,
        index.word,
    )?;
    let [lowest, highest] = Range::INDEX.map(|end| T::from_f64(end.into()));
    if refracts && !(lowest <= index.value && index.value <= highest) {
        return Err(records.unfit("index of refraction", Range::RefractiveIndex, index.word));
    }
    Ok(MaterialDescription {
        diffuse,
        specular,
        ambient,
        reflection: reflection.value,
        shininess,
        refraction: refraction.value,
        index_of_refraction: index.value,
    })
}

/// A number and the word it was written as.
#[derive(Clone, Copy)]
struct Number<'t, T> {
    value: T,
    word: &'t [u8],
}

/// U+FEFF in UTF-8.
const BYTE_ORDER_MARK: &[u8] = b"\xef\xbb\xbf";

/// Reads a text record by record.
struct Records<'t> {
    text: &'t [u8],
    /// What is not read yet.
    rest: &'t [u8],
    /// Offset just behind the last word that was read.
    behind: usize,
    /// The same for the number of objects.
    count_end: usize,
}

impl<'t> Records<'t> {
    fn new(text: &'t [u8]) -> Self {
        // Some editors begin every file with it.
        let rest = text.strip_prefix(BYTE_ORDER_MARK).unwrap_or(text);
        Self {
            text,
            rest,
            behind: text.len() - rest.len(),
            count_end: 0,
        }
    }

    /// Goes to the next line with a word, or to the end of the text.
    fn begin(&mut self) {
        if let Ok((rest, ())) = lexeme::empty_lines(self.rest) {
            self.rest = rest;
        }
    }

    /// How many of the lines that are not read yet begin as objects do, up to one that does not.
    fn objects_left(&self) -> u32 {
        let mut count = 0_u32;
        let mut rest = self.rest;
        while let Ok((behind, Some(word))) = lexeme::word(rest) {
            if digits(word).is_none_or(|kind| kind > 2) {
                break;
            }
            count = count.saturating_add(1);
            let end = behind.iter().position(|byte| *byte == b'\n');
            let next = end.and_then(|end| behind.get(end..)).unwrap_or(&[]);
            rest = match lexeme::empty_lines(next) {
                Ok((rest, ())) => rest,
                Err(_) => break,
            };
        }
        count
    }

    /// Ends a record: only blanks and a comment may follow.
    fn end(&mut self) -> Result<(), ParseError> {
        match lexeme::end_of_line(self.rest) {
            Ok((rest, ())) => {
                self.rest = rest;
                Ok(())
            }
            Err(_) => {
                let word = self.peek_word();
                Err(self.error_at(word, Expected::EndOfLine, Found::Word(Excerpt::new(word))))
            }
        }
    }

    /// The next word of the line.
    fn word(&mut self) -> Option<&'t [u8]> {
        let (rest, word) = lexeme::word(self.rest).ok()?;
        if word.is_some() {
            self.rest = rest;
            self.behind = self.text.len() - rest.len();
        }
        word
    }

    /// The next word of the line, not taken; empty if there is none.
    fn peek_word(&self) -> &'t [u8] {
        match lexeme::word(self.rest) {
            Ok((_, Some(word))) => word,
            _ => &[],
        }
    }

    fn is_at_end(&self) -> bool {
        self.peek_word().is_empty()
    }

    /// Line and column just behind the last word that was read.
    fn place(&self) -> (u32, u32) {
        place(self.text, self.behind)
    }

    /// A finite number of a range that begins at 0, or of one that is the caller's to check.
    fn number<T: Scalar + FromDecimal>(
        &mut self,
        name: &'static str,
        range: Range,
    ) -> Result<Number<'t, T>, ParseError> {
        let expected = Expected::Number { name, range };
        let Some(word) = self.word() else {
            return Err(self.error_behind(expected));
        };
        match T::from_decimal(word) {
            Ok(value) => match range.largest() {
                Some(largest) if !(T::ZERO <= value && value <= T::from_f64(largest.into())) => {
                    Err(self.unfit(name, range, word))
                }
                _ => Ok(Number { value, word }),
            },
            Err(DecimalError::NotANumber) => Err(self.unfit(name, range, word)),
            Err(DecimalError::TooLarge) => {
                Err(self.error_at(word, expected, Found::TooLarge(Excerpt::new(word), T::NAME)))
            }
        }
    }

    fn vector<T: Scalar + FromDecimal>(
        &mut self,
        [x, y, z]: [&'static str; 3],
    ) -> Result<Vec3<T>, ParseError> {
        Ok(Vec3::new(
            self.number(x, Range::Finite)?.value,
            self.number(y, Range::Finite)?.value,
            self.number(z, Range::Finite)?.value,
        ))
    }

    fn color<T: Scalar + FromDecimal>(
        &mut self,
        [r, g, b]: [&'static str; 3],
        range: Range,
    ) -> Result<Color<T>, ParseError> {
        Ok(Color::new(
            self.number(r, range)?.value,
            self.number(g, range)?.value,
            self.number(b, range)?.value,
        ))
    }

    /// A whole number in digits only.
    fn whole(&mut self, name: &'static str, min: u32, max: u32) -> Result<u32, ParseError> {
        let range = Range::Whole { min, max };
        let Some(word) = self.word() else {
            return Err(self.error_behind(Expected::Number { name, range }));
        };
        match digits(word) {
            Some(value) if (min..=max).contains(&value) => Ok(value),
            _ => Err(self.unfit(name, range, word)),
        }
    }

    fn digit(&mut self, name: &'static str, range: Range, max: u32) -> Result<u32, ParseError> {
        let Some(word) = self.word() else {
            return Err(self.error_behind(Expected::Number { name, range }));
        };
        self.digit_of(word, name, range, max)
    }

    fn digit_of(
        &self,
        word: &[u8],
        name: &'static str,
        range: Range,
        max: u32,
    ) -> Result<u32, ParseError> {
        match digits(word) {
            Some(value) if value <= max => Ok(value),
            _ => Err(self.unfit(name, range, word)),
        }
    }

    /// A word that is not in its range.
    fn unfit(&self, name: &'static str, range: Range, word: &[u8]) -> ParseError {
        self.error_at(
            word,
            Expected::Number { name, range },
            Found::Word(Excerpt::new(word)),
        )
    }

    /// A light or an object, which begins with this word, does not fit.
    fn no_room(&self, word: &[u8], pool: Pool, capacity: usize, object: Option<u32>) -> ParseError {
        self.error_at(
            word,
            Expected::Room {
                pool,
                capacity,
                object,
            },
            Found::Word(Excerpt::new(word)),
        )
    }

    /// An error about a word of this text.
    fn error_at(&self, word: &[u8], expected: Expected, found: Found) -> ParseError {
        let offset = (word.as_ptr() as usize).wrapping_sub(self.text.as_ptr() as usize);
        self.error(offset.min(self.text.len()), expected, found)
    }

    /// An error about something missing, just behind the last word.
    fn error_behind(&self, expected: Expected) -> ParseError {
        let is_last = matches!(lexeme::empty_lines(self.rest), Ok(([], ())));
        let found = if is_last {
            Found::EndOfText
        } else {
            Found::EndOfLine
        };
        self.error(self.behind, expected, found)
    }

    fn error(&self, offset: usize, expected: Expected, found: Found) -> ParseError {
        let (line, column) = place(self.text, offset);
        ParseError {
            offset,
            line,
            column,
            expected,
            found,
        }
    }
}

/// Whether a number is written with a digit other than 0 before its exponent.
fn has_digit_above_0(word: &[u8]) -> bool {
    word.iter()
        .take_while(|byte| !matches!(byte, b'e' | b'E'))
        .any(|byte| matches!(byte, b'1'..=b'9'))
}

/// The value of a word of digits; `None` if it is not one or above `u32::MAX`.
fn digits(word: &[u8]) -> Option<u32> {
    let mut value = 0_u32;
    for byte in word {
        let digit = byte.checked_sub(b'0').filter(|digit| *digit < 10)?;
        value = value.checked_mul(10)?.checked_add(u32::from(digit))?;
    }
    (!word.is_empty()).then_some(value)
}
