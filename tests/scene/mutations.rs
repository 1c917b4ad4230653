//! Bad scenes at scale: every number of the default scene replaced by each of eight others gives a picture
//! without a channel that is not finite, or an error at the place of that number.

use crate::common::scenes;
use scanray::{Resolution, Scalar, ScenePools, Tracer, parser::FromDecimal};

/// What takes the place of a number: not finite, too large for `f32`, out of most ranges, subnormal in `f32`,
/// nothing, no number.
const REPLACEMENTS: [&str; 8] = ["NaN", "inf", "1e39", "-1", "0", "1e-45", "", "word"];

/// Line and column of each word that is no comment, and its place in the text.
fn numbers(text: &str) -> Vec<(u32, u32, usize, usize)> {
    let mut numbers = Vec::new();
    let mut start = 0;
    for (number, line) in text.split_inclusive('\n').enumerate() {
        let code = &line[..line.find('#').unwrap_or(line.len())];
        let mut column = 0;
        for word in code.split_inclusive(|c: char| c.is_ascii_whitespace()) {
            let length = word.trim_end().len();
            if length > 0 {
                numbers.push((number as u32 + 1, column as u32 + 1, start + column, length));
            }
            column += word.len();
        }
        start += line.len();
    }
    numbers
}

/// Where the error is: at the number itself, unless something else becomes wrong by it.
fn place_of_error<T: FromDecimal>(
    replacement: &str,
    (line, column): (u32, u32),
    mutated: &str,
) -> (u32, u32) {
    let its_line = mutated.lines().nth(line as usize - 1).unwrap();
    match (replacement, line, column) {
        // Alone in its line: the next record takes its place, and the first that cannot tells.
        ("", 1, _) => (2, 3),
        ("", 5 | 6, _) => (7, 1),
        // Without its kind, an object begins with its first coordinate, which may be one.
        ("", 8.., 1) if !matches!(its_line.split_whitespace().next(), Some("0" | "1" | "2")) => {
            (line, 3)
        }
        // One of several: the line is too short, just behind its last number.
        ("", ..) => (line, its_line.trim_end().len() as u32 + 1),
        // No objects: the first is one too many.
        ("0", 1, 1) => (8, 1),
        // A normal without a length; a triangle that becomes a sphere with a long line; a normal so short that
        // the distance divided by its length is infinite.
        ("0", 13, 6) => (13, 4),
        ("0", 14, 1) => (14, 63),
        ("1e-45", 13, 6) => (13, 15),
        // A vertex so far away in f64 that all three lie on a line; f32 refuses the number itself.
        ("1e39", 14, 4..=34) if T::from_decimal(replacement.as_bytes()).is_ok() => (14, 4),
        // A little refraction, but no index: the last number of the line.
        ("1e-45", 8.., 40..) if its_line.ends_with(" 1e-45 0") => (line, its_line.len() as u32),
        _ => (line, column),
    }
}

/// Scenes that were drawn and scenes that were refused.
fn mutate<T: Scalar + FromDecimal>(replacement: &str) -> (u32, u32) {
    let text = String::from_utf8(scenes::text("default")).unwrap();
    let numbers = numbers(&text);
    // The header with the light of 9 numbers, six spheres, planes and a triangle.
    assert_eq!(numbers.len(), 1 + 3 + 2 + 9 + 1 + 1 + 3 + 5 * 18 + 18 + 27);
    let (mut drawn, mut refused) = (0, 0);
    for (line, column, place, length) in numbers {
        let mut mutated = text.clone();
        mutated.replace_range(place..place + length, replacement);
        let what = || format!("`{replacement}` at line {line}, column {column}");
        let mut pools = ScenePools::<T>::new();
        match pools.parse(mutated.as_bytes()) {
            Ok(_) => {
                drawn += 1;
                let tracer = Tracer::new(pools.as_scene()).with_resolution(Resolution {
                    width: 24,
                    height: 18,
                });
                for (x, y) in (0..18).flat_map(|y| (0..24).map(move |x| (x, y))) {
                    let color = tracer.pixel(x, y);
                    assert!(color.is_finite(), "{}: {color:?} at ({x}, {y})", what());
                    assert_eq!(color, color.clamp(), "{}", what());
                }
            }
            Err(error) => {
                refused += 1;
                let expected = place_of_error::<T>(replacement, (line, column), &mutated);
                assert_eq!((error.line, error.column), expected, "{}: {error}", what());
            }
        }
    }
    println!(
        "{}: `{replacement}` for each number: {drawn} drawn, {refused} refused",
        T::NAME
    );
    (drawn, refused)
}

fn mutate_all<T: Scalar + FromDecimal>() {
    let mut all = (0, 0);
    for replacement in REPLACEMENTS {
        let (drawn, refused) = mutate::<T>(replacement);
        all = (all.0 + drawn, all.1 + refused);
        if ["NaN", "inf", "word"].contains(&replacement) {
            assert_eq!(drawn, 0, "`{replacement}`");
        }
        if ["0", "1e-45"].contains(&replacement) {
            assert!(drawn > 80, "`{replacement}`");
        }
    }
    println!("{}: {} drawn, {} refused", T::NAME, all.0, all.1);
}

#[test]
fn single_numbers_of_the_default_scene_in_single_precision() {
    mutate_all::<f32>();
}

#[test]
fn single_numbers_of_the_default_scene_in_double_precision() {
    mutate_all::<f64>();
}
