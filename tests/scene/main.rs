//! From text to a scene: what is read, what is refused and how, what is printed.
//!
//! The tests of an area are one program, so that the tracer is compiled for them once. `cargo test --test scene fuzzing`
//! runs those of one file.

#[path = "../common/mod.rs"]
mod common;
mod fuzzing;
mod mutations;
mod parser_properties;
mod parser_rejections;
mod pools;
