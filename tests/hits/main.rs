//! What a ray hits: the shapes' formulas, and the same hits with less work. `cargo test --test hits bvh` runs the tests
//! of one file.

mod bvh;
mod candidates;
mod candidates_special_positions;
#[path = "../common/mod.rs"]
mod common;
mod exclusions;
mod intersections;
mod permutations;
mod thin_triangles;
mod triangle_sizes;
