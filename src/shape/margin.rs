//! How far from a surface rounding is out of the question.

use crate::scalar::Scalar;
use crate::vec3::Vec3;

/// What keeps a decision about all rays safe from their rounding, for the lengths and coordinates and the radii involved.
pub(crate) fn margin<T: Scalar>(lengths: T, radii: T) -> T {
    T::from_f64(1.0 / 65_536.0) * lengths + T::from_f64(1.0 / 4096.0) * radii
}

/// Sum of the absolute coordinates.
pub(crate) fn size<T: Scalar>(v: Vec3<T>) -> T {
    let v = v.abs();
    v.x + v.y + v.z
}
