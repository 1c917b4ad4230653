//! Vectors and points in three dimensions, and the two directions a surface sends a ray in.

use core::ops::{Add, Mul, Neg, Sub};

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

impl<T: Scalar> Vec3<T> {
    /// The same component three times.
    #[inline(always)]
    pub fn splat(component: T) -> Self {
        Self::new(component, component, component)
    }

    /// Scalar product, summed from left to right.
    #[inline(always)]
    pub fn dot(self, other: Self) -> T {
        self.x
            .times(other.x)
            .plus(self.y.times(other.y))
            .plus(self.z.times(other.z))
    }

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
    fn along(self, axis: Axis) -> (T, [T; 2]) {
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
            let (value, others) = self.along(axis);
            // Infinity times 0 is NaN.
            if others.into_iter().all(T::is_finite) {
                let (one, _) = unit.along(axis);
                return value.with_sign_of(one);
            }
        }
        unit.dot(self)
    }

    /// `self + unit·distance` for a vector of length 1.
    #[inline(always)]
    pub(crate) fn moved_along(self, unit: Self, distance: T) -> Self {
        if let Some(axis) = unit.axis() {
            let (value, others) = self.along(axis);
            // ±0 changes no number but −0.
            if distance.is_finite() && others.into_iter().all(T::is_normal) {
                let (one, _) = unit.along(axis);
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

    /// Absolute value of each component.
    #[inline(always)]
    pub fn abs(self) -> Self {
        Self::new(self.x.abs(), self.y.abs(), self.z.abs())
    }

    /// The largest component.
    #[inline]
    pub fn max_component(self) -> T {
        self.x.max(self.y).max(self.z)
    }

    /// The smaller of two, component by component; that of `self` where they do not compare.
    pub(crate) fn min_by_component(self, other: Self) -> Self {
        let min = |a: T, b: T| if b < a { b } else { a };
        Self::new(min(self.x, other.x), min(self.y, other.y), min(self.z, other.z))
    }

    /// The larger of two, component by component; that of `self` where they do not compare.
    pub(crate) fn max_by_component(self, other: Self) -> Self {
        let max = |a: T, b: T| if b > a { b } else { a };
        Self::new(max(self.x, other.x), max(self.y, other.y), max(self.z, other.z))
    }

    /// All three components are finite.
    #[inline]
    pub fn is_finite(self) -> bool {
        self.x.is_finite() && self.y.is_finite() && self.z.is_finite()
    }

    /// The vector of length 1, for vectors whose square is neither zero nor infinite.
    #[inline(always)]
    pub fn normalize(self) -> Self {
        self * T::ONE.over(self.dot(self).sqrt())
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

    /// One Newton step of `1/√(x·x)` at 1: full precision for a vector that rounding has moved off
    /// length 1, without a root or a division.
    #[inline(always)]
    fn renormalize(self) -> Self {
        let square = self.dot(self);
        if T::EMULATED && square.is_one() {
            return self;
        }
        self * (T::THREE_HALVES.minus(square.halve()))
    }

    /// The mirror direction of the unit vector `self` at a surface with unit normal `normal`.
    #[inline(always)]
    pub fn reflect(self, normal: Self) -> Self {
        self.reflect_at(normal, -self.dot(normal))
    }

    /// [`Vec3::reflect`] where `cosine = −self·normal` is known.
    #[inline(always)]
    pub(crate) fn reflect_at(self, normal: Self, cosine: T) -> Self {
        (self + normal * cosine.double()).renormalize()
    }

    /// The refracted direction of the unit vector `self`, or `None` at total internal reflection.
    ///
    /// `normal` is the unit normal on the side the ray comes from, `eta` the ratio of the index of
    /// refraction on that side to the one beyond, and `bend = 1/eta² − 1`, which a caller computes
    /// from the index itself because the difference cancels when `eta` is near 1.
    ///
    /// Snell's law as `eta (d + (c − √(c² + bend)) n)` with `c = −d·n`: the same as the usual
    /// `k = 1 − eta²(1 − c²)`, but the sign that decides total reflection has no cancellation.
    #[inline]
    pub fn refract(self, normal: Self, eta: T, bend: T) -> Option<Self> {
        self.refract_at(normal, -self.dot(normal), eta, bend)
    }

    /// [`Vec3::refract`] where `cosine = −self·normal` is known.
    #[inline]
    pub(crate) fn refract_at(self, normal: Self, cosine: T, eta: T, bend: T) -> Option<Self> {
        let k = cosine.times(cosine).plus(bend);
        // NaN counts as total reflection, so that no direction without a length leaves here.
        if !k.is_zero_or_positive() {
            return None;
        }
        let direction = (self + normal * (cosine.minus(k.sqrt()))) * eta;
        let drift = direction.dot(direction).minus(T::ONE).abs();
        if drift.is_before(T::EPSILON * T::from_i32(256)) {
            Some(direction.renormalize())
        } else {
            // Only an extreme index cancels enough to come here, or even to end on the wrong side.
            let (unit, _) = direction.try_normalize()?;
            (unit.dot(normal) < T::ZERO).then_some(unit)
        }
    }
}

impl<T: Scalar> Add for Vec3<T> {
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

impl<T: Scalar> Sub for Vec3<T> {
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

impl<T: Scalar> Mul<T> for Vec3<T> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, factor: T) -> Self {
        Self::new(
            self.x.times(factor),
            self.y.times(factor),
            self.z.times(factor),
        )
    }
}

impl<T: Scalar> Neg for Vec3<T> {
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
    fn reflection_keeps_length_over_many_bounces() {
        let mut direction = Vec3::new(0.6_f32, -0.48, 0.64);
        for step in 0..1000_i32 {
            let (normal, _) = Vec3::new(f32::from_i32(step % 7) - 3.2, 1.0, 0.3)
                .try_normalize()
                .unwrap();
            direction = direction.reflect(normal);
            assert!((direction.dot(direction).sqrt() - 1.0).abs() <= 2e-7);
        }
    }

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

    #[test]
    fn refraction_bends_by_snell_and_reflects_totally_beyond_the_critical_angle() {
        let normal = Vec3::new(0.0_f64, 1.0, 0.0);
        let (sine, cosine) = (0.6, 0.8);
        let incoming = Vec3::new(sine, -cosine, 0.0);
        // Into glass: the sine shrinks by the index.
        let index = 1.5;
        let inside = incoming
            .refract(normal, 1.0 / index, (index - 1.0) * (index + 1.0))
            .unwrap();
        assert!((inside.x - sine / index).abs() < 1e-15);
        // Out of glass: beyond asin(1/1.5) nothing leaves.
        let bend = (1.0 / index) * (1.0 / index) - 1.0;
        assert_eq!(
            incoming.refract(normal, index, bend).map(|d| d.x > 0.89),
            Some(true)
        );
        let steep = Vec3::new(0.7, -(1.0_f64 - 0.49).sqrt(), 0.0);
        assert_eq!(steep.refract(normal, index, bend), None);
    }
}
