//! What a file that holds a part of something says about itself: some rows of a picture, or one picture
//! of a turntable.
//!
//! The words stand in a comment of a PPM file or in a text chunk of a PNG file, where other programs
//! leave them alone or show them:
//!
//! ```text
//! scanray-part rows=0..60 size=160x120 step=3/36 about=0,2.5 scene=1f0c… version=0.2.0 scalar=f32 …
//! ```

use std::collections::BTreeSet;
use std::fmt::{self, Write};
use std::ops::Range;

use scanray::{Resolution, Scalar, Scene};
use sha2::{Digest, Sha256};

use crate::console::shown;
use crate::option_values::Size;
use crate::render_settings::PictureSettings;

/// The first word.
const MARK: &str = "scanray-part";

/// The settings that are a hash of the scene, and the name of the number type.
pub(crate) const SCENE: &str = "scene";
const SCALAR: &str = "scalar";

/// Settings that no option of the command line is named after.
const NO_OPTIONS: [&str; 2] = [SCENE, "version"];

/// Which part of what.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct PartRecord {
    /// The rows that the file holds.
    pub(crate) rows: Range<u16>,
    /// The size of the whole picture.
    pub(crate) size: Resolution,
    /// Which picture of a turntable, and of how many.
    pub(crate) step: Option<(u16, u16)>,
    /// All else that decides the picture, name and value.
    pub(crate) settings: Vec<(String, String)>,
}

impl PartRecord {
    /// The words, in one line.
    pub(crate) fn words(&self) -> String {
        let Self {
            rows,
            size,
            step,
            settings,
        } = self;
        let mut words = format!(
            "{MARK} rows={}..{} size={}x{}",
            rows.start, rows.end, size.width, size.height
        );
        if let Some((index, of)) = step {
            words += &format!(" step={index}/{of}");
        }
        for (name, value) in settings {
            words += &format!(" {name}={value}");
        }
        words
    }

    /// The record in the comment of a file, if that is one.
    pub(crate) fn parse(comment: &str) -> Option<Self> {
        let mut pairs = comment
            .strip_prefix(MARK)?
            .split_ascii_whitespace()
            .map(|word| word.split_once('='));
        let mut next = |wanted: &str| pairs.next()?.filter(|(name, _)| *name == wanted);
        let (_, rows) = next("rows")?;
        let (_, size) = next("size")?;
        let Size(size) = size.parse().ok()?;
        let (start, end) = rows.split_once("..")?;
        let rows = start.parse().ok()?..end.parse().ok()?;
        let mut record = Self {
            rows,
            size,
            step: None,
            settings: Vec::new(),
        };
        for pair in pairs {
            match pair? {
                ("step", step) => {
                    let (index, of) = step.split_once('/')?;
                    record.step = Some((index.parse().ok()?, of.parse().ok()?));
                }
                (name, value) => record.settings.push((name.to_owned(), value.to_owned())),
            }
        }
        let is_possible = !record.rows.is_empty()
            && record.rows.end <= record.size.height
            && record.step.is_none_or(|(index, of)| index < of);
        is_possible.then_some(record)
    }

    /// The options of `scanray render` that draw another part of the same, each after a blank; those that
    /// change nothing are left out.
    pub(crate) fn options(&self) -> String {
        let Resolution { width, height } = self.size;
        let mut options = format!(" --size {width}x{height}");
        let defaults = PictureSettings::default().record();
        for setting in &self.settings {
            let (name, value) = setting;
            if !NO_OPTIONS.contains(&&**name) && !defaults.contains(setting) {
                options += &format!(" --{name}={value}");
            }
        }
        options
    }

    /// In what the whole differs that another part belongs to, as "--color rgb565 instead of rgb888".
    pub(crate) fn differences(&self, other: &Self) -> Vec<String> {
        let mut differences = Vec::new();
        let mut compare = |name: &str, mine: Option<&str>, others: Option<&str>| {
            if mine != others {
                // They come from files.
                let [mine, others] = [mine, others].map(|value| shown(value.unwrap_or("none")));
                let dashes = if NO_OPTIONS.contains(&name) { "" } else { "--" };
                differences.push(format!(
                    "{dashes}{} {others} instead of {mine}",
                    shown(name)
                ));
            }
        };
        let [mine, others] = [self, other].map(|record| {
            let Resolution { width, height } = record.size;
            format!("{width}x{height}")
        });
        compare("size", Some(&mine), Some(&others));
        let [mine, others] = [self, other].map(|record| record.step.map(|(_, of)| of.to_string()));
        compare("turntable", mine.as_deref(), others.as_deref());
        let names: BTreeSet<&str> = [self, other]
            .iter()
            .flat_map(|record| record.settings.iter().map(|(name, _)| &**name))
            .collect();
        let is_same = |name: &str| self.setting(name) == other.setting(name);
        for name in names.iter().filter(|name| **name != SCENE) {
            compare(name, self.setting(name), other.setting(name));
        }
        // The same scene has other numbers in another type.
        if !is_same(SCENE) && is_same(SCALAR) {
            differences.push(
                "another scene, in its camera, light, objects or background (comments and the file's name do not \
                 count)"
                    .to_owned(),
            );
        }
        differences
    }

    fn setting(&self, name: &str) -> Option<&str> {
        let mut settings = self.settings.iter();
        let (_, value) = settings.find(|(known, _)| known == name)?;
        Some(value)
    }
}

/// What identifies a scene: a hash of all that is in it. It does not change with comments, blanks or the
/// size that the scene asks for, which the record has anyway.
pub(crate) fn scene_identity<T: Scalar>(scene: &Scene<'_, T>) -> String {
    let size = Resolution {
        width: 1,
        height: 1,
    };
    // What is derived follows from the rest.
    let content = scene.with_resolution(size).without_accel();
    let mut hash = Hashing(Sha256::new());
    // Hashing takes whatever is written.
    let _ = write!(hash, "{}", scanray::bake(&content));
    let digest = hash.0.finalize();
    digest
        .iter()
        .take(8)
        .map(|byte| format!("{byte:02x}"))
        .collect()
}

/// A hash of text that is too long to be kept.
struct Hashing(Sha256);

impl Write for Hashing {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        self.0.update(text);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn record() -> PartRecord {
        let setting = |name: &str, value: &str| (name.to_owned(), value.to_owned());
        PartRecord {
            rows: 20..60,
            size: Resolution {
                width: 160,
                height: 120,
            },
            step: Some((3, 36)),
            settings: vec![setting("scene", "1f0c"), setting("color", "rgb888")],
        }
    }

    #[test]
    fn what_is_written_is_read() {
        let record = record();
        let words = "scanray-part rows=20..60 size=160x120 step=3/36 scene=1f0c color=rgb888";
        assert_eq!(record.words(), words);
        assert_eq!(PartRecord::parse(words), Some(record.clone()));
        let single = PartRecord {
            step: None,
            ..record
        };
        assert_eq!(PartRecord::parse(&single.words()), Some(single));
        for words in [
            "",
            "Created with GIMP",
            "scanray-part",
            "scanray-part rows=20..60",
            "scanray-part size=160x120 rows=20..60",
            "scanray-part rows=60..60 size=160x120",
            "scanray-part rows=60..121 size=160x120",
            "scanray-part rows=0..1 size=0x120",
            "scanray-part rows=0..1 size=1x1 step=4/4",
            "scanray-part rows=0..1 size=1x1 color",
        ] {
            assert_eq!(PartRecord::parse(words), None, "{words}");
        }
    }

    #[test]
    fn differences_are_named() {
        let record = record();
        let mut other = record.clone();
        (other.rows, other.step) = (60..120, Some((4, 36)));
        assert_eq!(record.differences(&other), [""; 0]);
        other.size.width = 80;
        other.step = None;
        other.settings[1].1 = "rgb565".to_owned();
        other.settings.push(("cutoff".to_owned(), "0.1".to_owned()));
        assert_eq!(
            record.differences(&other),
            [
                "--size 80x120 instead of 160x120",
                "--turntable none instead of 36",
                "--color rgb565 instead of rgb888",
                "--cutoff 0.1 instead of none",
            ]
        );
    }
}
