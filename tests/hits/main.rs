//! What a ray meets: the shapes' formulas, and the same hits with less work. `cargo test --test hits tree` runs the tests
//! of one file.

mod candidates;
#[path = "../common/mod.rs"]
mod common;
mod intersections;
mod tree;
mod visibility;
