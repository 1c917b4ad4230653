//! What the files of the repository promise of each other: layers of the source, documentation, rejected scenes and their
//! messages. The package of the core has none of these tests, and not what they alone need.

#[path = "../common/mod.rs"]
mod common;
mod documentation;
mod invalid_scenes;
mod layers;
