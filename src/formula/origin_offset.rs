//! The offset that keeps a new ray from hitting the surface that it leaves (shadow bias).

use crate::number::Number;

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
