//! A ray and a plane.

use crate::number::Number;
use crate::vec3::Vec3;

/// How far below the plane a ray starts, along the normal, and how much it rises on its way: it crosses the plane at the
/// quotient.
#[inline(always)]
pub fn rise<N: Number>(normal: Vec3<N>, height: N, origin: Vec3<N>, direction: Vec3<N>) -> (N, N) {
    let below = height - origin.along(normal);
    (below, direction.along(normal))
}

/// The point of a plane that is nearest to a place: at grazing angles a distance along a ray is uncertain by `u/cos θ`.
#[inline(always)]
pub fn project<N: Number>(place: Vec3<N>, normal: Vec3<N>, height: N) -> Vec3<N> {
    let above = place.along(normal) - height;
    place.moved(normal, -above)
}

/// The [origin offset](super::origin_offset) at a point of a plane.
#[inline(always)]
pub fn offset<N: Number>(point: Vec3<N>, normal: Vec3<N>, height: N) -> N {
    super::origin_offset(point.abs().along(normal.abs()), height.abs())
}
