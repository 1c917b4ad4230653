//! Vectors and points in three dimensions.

use core::ops::{Add, Mul, Neg, Sub};

use crate::number::Number;
use crate::scalar::Scalar;

/// A vector or point: `x` to the right, `y` up, `z` into the picture.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Vec3<T = f32> {
    /// To the right.
    pub x: T,
    /// Up.
    pub y: T,
    /// Into the picture.
    pub z: T,
}

/// One of the three axes.
#[derive(Clone, Copy)]
enum Axis {
    X,
    Y,
    Z,
}

impl<T> Vec3<T> {
    /// The vector of three components.
    pub const fn new(x: T, y: T, z: T) -> Self {
        Self { x, y, z }
    }
}

impl<N: Number> Vec3<N> {
    /// The same component three times.
    #[inline(always)]
    pub fn splat(component: N) -> Self {
        Self::new(component, component, component)
    }

    #[inline(always)]
    fn components(self) -> [N; 3] {
        [self.x, self.y, self.z]
    }

    /// Scalar product, summed from left to right.
    #[inline(always)]
    pub fn dot(self, other: Self) -> N {
        N::dot(self.components(), other.components())
    }

    /// `unit·self` for a vector of length 1, up to the sign of a zero.
    #[inline(always)]
    pub fn along(self, unit: Self) -> N {
        N::along(self.components(), unit.components())
    }

    /// `self + unit·distance` for a vector of length 1.
    #[inline(always)]
    pub fn moved(self, unit: Self, distance: N) -> Self {
        let [x, y, z] = N::moved(self.components(), unit.components(), distance);
        Self::new(x, y, z)
    }

    /// Absolute value of each component.
    #[inline(always)]
    pub fn abs(self) -> Self {
        Self::new(self.x.abs(), self.y.abs(), self.z.abs())
    }

    /// The vector of length 1, for vectors whose square is neither zero nor infinite.
    #[inline(always)]
    pub fn normalize(self) -> Self {
        let square = self.dot(self);
        self * square.constant(1.0).over(square.sqrt())
    }
}

impl<T: Scalar> Vec3<T> {
    /// The axis along which a unit vector lies exactly, if arithmetic is emulated: products with 0 and 1 need not be
    /// computed there.
    #[inline(always)]
    fn axis(self) -> Option<Axis> {
        if !T::EMULATED {
            None
        } else if self.y.abs().is_one() && self.x.are_zero(self.z) {
            Some(Axis::Y)
        } else if self.x.abs().is_one() && self.y.are_zero(self.z) {
            Some(Axis::X)
        } else if self.z.abs().is_one() && self.x.are_zero(self.y) {
            Some(Axis::Z)
        } else {
            None
        }
    }

    /// The component along an axis, and the two others.
    #[inline(always)]
    fn split_at(self, axis: Axis) -> (T, [T; 2]) {
        match axis {
            Axis::X => (self.x, [self.y, self.z]),
            Axis::Y => (self.y, [self.x, self.z]),
            Axis::Z => (self.z, [self.x, self.y]),
        }
    }

    /// `unit·self` for a vector of length 1, up to the sign of a zero.
    #[inline(always)]
    pub(crate) fn component_along(self, unit: Self) -> T {
        if let Some(axis) = unit.axis() {
            let (value, others) = self.split_at(axis);
            // Infinity times 0 is NaN.
            if others.into_iter().all(T::is_finite) {
                let (one, _) = unit.split_at(axis);
                return value.with_sign_of(one);
            }
        }
        T::dot([unit.x, unit.y, unit.z], [self.x, self.y, self.z])
    }

    /// `self + unit·distance` for a vector of length 1.
    #[inline(always)]
    pub(crate) fn moved_along(self, unit: Self, distance: T) -> Self {
        if let Some(axis) = unit.axis() {
            let (value, others) = self.split_at(axis);
            // ±0 changes no number but −0.
            if distance.is_finite() && others.into_iter().all(T::is_normal) {
                let (one, _) = unit.split_at(axis);
                let mut moved = self;
                *match axis {
                    Axis::X => &mut moved.x,
                    Axis::Y => &mut moved.y,
                    Axis::Z => &mut moved.z,
                } = value.plus(distance.with_sign_of(one));
                return moved;
            }
        }
        self + unit * distance
    }

    /// Vector product.
    #[inline]
    pub fn cross(self, other: Self) -> Self {
        Self::new(
            self.y * other.z - self.z * other.y,
            self.z * other.x - self.x * other.z,
            self.x * other.y - self.y * other.x,
        )
    }

    /// The largest component.
    #[inline]
    pub fn max_component(self) -> T {
        self.x.max(self.y).max(self.z)
    }

    /// The smaller of two, component by component; that of `self` where they do not compare.
    pub(crate) fn min_by_component(self, other: Self) -> Self {
        let min = |a: T, b: T| if b < a { b } else { a };
        Self::new(
            min(self.x, other.x),
            min(self.y, other.y),
            min(self.z, other.z),
        )
    }

    /// The larger of two, component by component; that of `self` where they do not compare.
    pub(crate) fn max_by_component(self, other: Self) -> Self {
        let max = |a: T, b: T| if b > a { b } else { a };
        Self::new(
            max(self.x, other.x),
            max(self.y, other.y),
            max(self.z, other.z),
        )
    }

    /// All three components are finite.
    #[inline]
    pub fn is_finite(self) -> bool {
        self.x.is_finite() && self.y.is_finite() && self.z.is_finite()
    }

    /// The vector of length 1, whatever the scale, and the length it had as two factors, whose product
    /// may be too large or too small for the scalar; `None` when it has none (zero, infinite, NaN). Meant
    /// for loading: it divides more than [`Vec3::normalize`].
    pub fn try_normalize(self) -> Option<(Self, [T; 2])> {
        let largest = self.abs().max_component();
        if !(largest > T::ZERO && self.is_finite()) {
            return None;
        }
        // The square of the scaled vector lies in 1…3, so that it neither under- nor overflows.
        let scaled = Self::new(self.x / largest, self.y / largest, self.z / largest);
        let length = scaled.dot(scaled).sqrt();
        let unit = Self::new(scaled.x / length, scaled.y / length, scaled.z / length);
        Some((unit, [largest, length]))
    }
}

impl<N: Number> Add for Vec3<N> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self::new(
            self.x.plus(other.x),
            self.y.plus(other.y),
            self.z.plus(other.z),
        )
    }
}

impl<N: Number> Sub for Vec3<N> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self::new(
            self.x.minus(other.x),
            self.y.minus(other.y),
            self.z.minus(other.z),
        )
    }
}

impl<N: Number> Mul<N> for Vec3<N> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, factor: N) -> Self {
        Self::new(
            self.x.times(factor),
            self.y.times(factor),
            self.z.times(factor),
        )
    }
}

impl<N: Number> Neg for Vec3<N> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self::new(-self.x, -self.y, -self.z)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn try_normalize_knows_no_scale() {
        for scale in [1e-38_f32, 1e-20, 1.0, 1e20, 1e38] {
            let (unit, length) = Vec3::new(0.0, scale, 0.0).try_normalize().unwrap();
            assert_eq!(unit, Vec3::new(0.0, 1.0, 0.0));
            assert_eq!(length, [scale, 1.0]);
        }
        assert_eq!(Vec3::new(0.0_f32, 0.0, -0.0).try_normalize(), None);
        assert_eq!(Vec3::new(f32::NAN, 1.0, 0.0).try_normalize(), None);
        assert_eq!(Vec3::new(f32::INFINITY, 1.0, 0.0).try_normalize(), None);
    }
}
