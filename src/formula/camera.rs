//! Rays of pixels.

use crate::number::Number;
use crate::vec3::Vec3;

/// The direction through a place in the picture plane, 1 away: `column/height` across, `y` up.
#[inline(always)]
pub fn direction<N: Number>(column: N, height: N, y: N) -> Vec3<N> {
    Vec3::new(column / height, y, y.constant(1.0)).normalize()
}
