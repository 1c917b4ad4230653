//! Mirrored and refracted directions.

use crate::number::Number;
use crate::vec3::Vec3;

/// One Newton step of `1/√(x·x)` at 1: full precision for a vector that rounding has moved off
/// length 1, without a root or a division.
#[inline(always)]
pub fn renormalize<N: Number>(v: Vec3<N>) -> Vec3<N> {
    let square = v.dot(v);
    if square.is_surely_one() {
        return v;
    }
    v * (square.constant(1.5) - square.halve())
}

/// The mirror direction at a surface with a unit normal, where `cosine = −direction·normal`.
#[inline(always)]
pub fn mirror<N: Number>(direction: Vec3<N>, normal: Vec3<N>, cosine: N) -> Vec3<N> {
    renormalize(direction + normal * cosine.double())
}

/// What the sine decides: total reflection where it is below 0. `cosine = −direction·normal`, with the normal on the side the ray
/// comes from; `bend = 1/eta² − 1`, which a caller computes from the index itself because the difference cancels
/// when `eta` is near 1.
///
/// Snell's law as `eta (d + (c − √(c² + bend)) n)`: the same as the usual
/// `k = 1 − eta²(1 − c²)`, but the sign that decides total reflection has no cancellation.
#[inline(always)]
pub fn beyond_critical<N: Number>(cosine: N, bend: N) -> N {
    cosine * cosine + bend
}

/// The refracted direction, up to rounding of its length, from what [`beyond_critical`] gives.
#[inline(always)]
pub fn refract<N: Number>(
    direction: Vec3<N>,
    normal: Vec3<N>,
    cosine: N,
    beyond_critical: N,
    eta: N,
) -> Vec3<N> {
    (direction + normal * (cosine - beyond_critical.sqrt())) * eta
}

/// How far the square of a direction's length is from 1; where it is not below 256u, [`renormalize`] is not enough.
#[inline(always)]
pub fn drift<N: Number>(direction: Vec3<N>) -> N {
    let square = direction.dot(direction);
    (square - square.constant(1.0)).abs()
}
