//! A ray and a disc.

use super::plane;
use crate::number::Number;
use crate::vec3::Vec3;

/// The distance at which a ray crosses the plane of a disc.
#[inline(always)]
pub fn crossing<N: Number>(normal: Vec3<N>, height: N, origin: Vec3<N>, direction: Vec3<N>) -> N {
    let (below, slope) = plane::rise(normal, height, origin, direction);
    below / slope
}

/// The square of how far from the centre the point of the disc's plane is that is nearest to a place: at grazing angles a
/// distance along a ray is uncertain; where the point is on the plane is not.
#[inline(always)]
pub fn eccentricity<N: Number>(place: Vec3<N>, center: Vec3<N>, normal: Vec3<N>, height: N) -> N {
    let across = plane::project(place, normal, height) - center;
    across.dot(across)
}
