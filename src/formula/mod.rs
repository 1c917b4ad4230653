//! The formulas of the tracer, each once, over any [`Number`].
//!
//! They are arithmetic alone: who calls them decides by comparing what they give. The tracer calls them with
//! [`Real`](crate::real::Real), one ray at a time; a tracer of several rays side by side calls the same functions with lanes
//! and has the same bits.

pub mod camera;
pub mod disc;
pub mod optics;
mod origin_offset;
pub mod plane;
pub mod shading;
pub mod sphere;
pub mod triangle;

pub use origin_offset::origin_offset;

use crate::number::Number;
use crate::vec3::Vec3;

/// The point of a ray at distance `t`.
#[inline(always)]
pub fn at<N: Number>(origin: Vec3<N>, direction: Vec3<N>, t: N) -> Vec3<N> {
    origin + direction * t
}
