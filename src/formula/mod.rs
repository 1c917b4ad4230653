//! The formulas of the tracer, each once, over any [`Number`](crate::number::Number).
//!
//! They are arithmetic alone: who calls them decides by comparing what they give. The tracer calls them with
//! [`Real`](crate::real::Real), one ray at a time; a tracer of several rays side by side calls the same functions with lanes
//! and has the same bits.

pub mod camera;
pub mod optics;
pub mod plane;
pub mod shading;
pub mod sphere;
pub mod triangle;

use crate::number::Number;
use crate::vec3::Vec3;

/// The point of a ray at distance `t`.
#[inline(always)]
pub fn at<N: Number>(origin: Vec3<N>, direction: Vec3<N>, t: N) -> Vec3<N> {
    origin + direction * t
}

/// How far from a surface a new ray must start so that no rounding puts its origin on the wrong side.
///
/// `e = 2u (Σ|nᵢPᵢ| + extent)` with `u = 2⁻²³` (2⁻⁵²), where `Σ|nᵢPᵢ|` (`components`) bounds the
/// rounding of the hit point along the normal and `extent` that of the object's own intersection test:
/// the radius, the plane's distance or the largest coordinate of the vertices. In the manner of
/// Wächter and Binder (Ray Tracing Gems, ch. 6) and pbrt-v4, section 6.8.6.
#[inline(always)]
pub fn origin_offset<N: Number>(components: N, extent: N) -> N {
    components.constant(2.0 * N::ULP) * (components + extent)
}
