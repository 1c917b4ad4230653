//! What a file that holds a part of something says about itself: some rows of a picture, or one picture
//! of a turntable.
//!
//! The words stand in a comment of a PPM file or in a text chunk of a PNG file, where other programs
//! leave them alone or show them:
//!
//! ```text
//! scanray-part rows=0..60 size=160x120 step=3/36 about=0,2.5 scene=1f0c… version=0.1.0 scalar=f32 …
//! ```

use std::fmt::{self, Write};
use std::ops::Range;

use scanray::{Resolution, Scalar, Scene, Tree};
use sha2::{Digest, Sha256};

/// The first word.
const MARK: &str = "scanray-part";

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
}

/// What identifies a scene: a hash of all that is in it. It does not change with comments, blanks or the
/// size that the scene asks for, which the record has anyway.
pub(crate) fn scene_identity<T: Scalar>(scene: &Scene<'_, T>) -> String {
    let content = Scene {
        resolution: Resolution {
            width: 1,
            height: 1,
        },
        // Derived from the rest.
        sides: &[],
        tree: Tree::NONE,
        ..*scene
    };
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
