//! What the files of the repository promise of each other: layers of the source, documentation.

#[path = "../common/mod.rs"]
mod common;
mod documentation;
mod layers;
