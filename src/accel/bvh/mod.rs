//! The hierarchy: in a large scene most objects are far from a ray, and boxes around many of them tell so at
//! once.
//!
//! Spheres and triangles are in one hierarchy; planes are not bounded and stay in lists. [`build`] makes it in
//! the memory of the pools, when a scene is loaded or baked; [`walk`] gives the leaves that a ray can
//! hit, the nearer first.
//!
//! # Same hits
//!
//! The hierarchy must offer every object whose own test reports an intersection at the distance `t` as long as no
//! smaller one is known; in which order does not matter, because ties are decided by number. Let `o` be the
//! ray's origin, `d` its direction, `u` the unit of rounding [`Scalar::EPSILON`](crate::Scalar::EPSILON),
//! `|v|` the sum of the absolute coordinates, and let an object lie within `r` of its centre `c` (a
//! triangle's vertices within `r` of the middle of their box).
//!
//! * A sphere's test finds `b` and `l` with errors of 2u and 4u times `|o| + |c|`. Where it reports `t`, the
//!   point `q = o + t·d` lies within `8u(|o| + |c| + r)` of the sphere.
//! * A triangle's test moves each vertex by at most `4u(|o| + |c| + r)` across the ray, and then decides
//!   without error whether the ray passes through the moved triangle: the ray's line passes the triangle
//!   at most that far away. The reported `t` is that of the triangle's plane; where the triangle is seen
//!   edge-on, so that it has no correct digit, it is limited to what lies between the vertices' distances, which
//!   are measured along the ray's largest component, the *leading axis*.
//! * The walk computes where the line enters and leaves the slab between two coordinates of a box as
//!   `(coordinate − oᵢ)·(1/dᵢ)`, with three roundings, which is what the exact expression gives for a
//!   coordinate moved by at most `2u(|oᵢ| + |coordinate|)`.
//!
//! So all boxes are wider than their objects by `64u(|c| + r)` when they are built, and a ray takes them to be
//! wider by `64u·|o|` again; less than a third of that is needed. Then the line of a ray that is to hit an
//! object in the box enters all slabs of the box before it leaves any, and leaves the slab of the leading axis
//! at or behind `t`, which it enters at or before `t`. A box is left out only where that is not so. (A
//! box that the line hits elsewhere than the leading axis says is not left out: `t` of a triangle
//! seen edge-on may be there.) A NaN leaves nothing out.
//!
//! All this bars underflow of products, as the triangle's test does; boxes are wider by another
//! 8 times the root of the smallest number with all its digits, below which no object is hit.

mod bounds;
mod build;
mod node;
#[cfg(test)]
mod tests;
mod walk;

pub(super) use build::build;
pub use node::{Bvh, BvhNode, NodeContent};
pub(crate) use walk::Walk;
