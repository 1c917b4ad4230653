//! The fuzz targets' properties on a stable compiler: seeded mutations of the scenes, good and bad. What
//! coverage guides, tests/fuzz does.

// The package of the core is tested without the optional parts unless they are asked for.
#[cfg(feature = "print")]
#[path = "printing.rs"]
mod printing;
#[path = "properties.rs"]
mod properties;

use crate::common::random::Random;
use crate::common::scenes;

/// Scenes that are accepted.
const GOOD: usize = 5;

/// Words that take the place of others.
fn dictionary() -> Vec<Vec<u8>> {
    let text = std::fs::read_to_string(scenes::path("tests/scene/scene.dict")).unwrap();
    let words: Vec<_> = text
        .lines()
        .filter_map(|line| line.strip_prefix('"')?.strip_suffix('"'))
        .map(|word| {
            let plain = word
                .replace("\\x0a", "\n")
                .replace("\\x0d", "\r")
                .replace("\\x09", "\t");
            assert!(!plain.contains('\\'), "{word}");
            plain.into_bytes()
        })
        .collect();
    assert!(words.len() > 40);
    words
}

/// The scenes of scenes/ and of scenes/invalid/, which the package of the core leaves out.
fn seeds() -> Vec<Vec<u8>> {
    let texts = |folder: &str| {
        let files = std::fs::read_dir(scenes::path(folder));
        let mut paths: Vec<_> = files
            .into_iter()
            .flatten()
            .map(|file| file.unwrap().path())
            .collect();
        paths.retain(|path| path.extension().is_some_and(|e| e == "txt"));
        paths.sort();
        paths
            .into_iter()
            .map(|path| std::fs::read(path).unwrap())
            .collect::<Vec<_>>()
    };
    let good = texts("scenes");
    assert!(good.len() >= GOOD);
    let is_repository = scenes::path("tests/repository").exists();
    let bad = texts("scenes/invalid");
    assert!(bad.len() > 100 || !is_repository);
    [good, bad].concat()
}

/// A text changed in a few places: most often a word for another, which keeps it a scene.
fn mutated(text: &[u8], words: &[Vec<u8>], random: &Random) -> Vec<u8> {
    let mut text = text.to_vec();
    for _ in 0..1 + random.below(4) {
        let is_word = |byte: u8| !byte.is_ascii_whitespace();
        let place = random.below(text.len() + 1);
        let start = place
            - text[..place]
                .iter()
                .rev()
                .take_while(|&&b| is_word(b))
                .count();
        let end = place + text[place..].iter().take_while(|&&b| is_word(b)).count();
        match random.below(8) {
            0 => text.truncate(place),
            1 => text.insert(place, random.bits() as u8),
            2 => drop(text.drain(start..end)),
            3 => {
                let line = text[start..end].to_vec();
                text.splice(start..start, line);
            }
            _ => {
                let word = words[random.below(words.len())].iter().copied();
                text.splice(start..end, word);
            }
        }
    }
    text
}

fn holds_for_mutations(property: fn(&[u8]), seed: u64, rounds: usize) {
    let random = Random::of_test(seed);
    let (words, seeds) = (dictionary(), seeds());
    for text in &seeds {
        property(text);
    }
    // The accepted scenes come first in the list and half of the time.
    for _ in 0..rounds {
        let few = if random.below(2) == 0 {
            GOOD
        } else {
            seeds.len()
        };
        let text = mutated(&seeds[random.below(few)], &words, &random);
        let result = std::panic::catch_unwind(|| property(&text));
        if let Err(panic) = result {
            println!("the text was:\n{}", text.escape_ascii());
            std::panic::resume_unwind(panic);
        }
    }
}

#[test]
fn mutated_texts_are_scenes_or_errors_at_a_place() {
    holds_for_mutations(properties::parse, 41, 20_000);
}

#[cfg(feature = "print")]
#[test]
fn mutated_scenes_are_read_back_as_they_are_printed() {
    holds_for_mutations(printing::print, 42, 10_000);
}

#[test]
fn mutated_scenes_are_drawn_finite_within_the_ray_bound() {
    holds_for_mutations(properties::draw, 43, 1_000);
}
