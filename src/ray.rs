//! Rays, and where a ray that leaves a surface starts.

use crate::formula::{self, optics};
use crate::real::Real;
use crate::scalar::Scalar;
use crate::vec3::Vec3;

/// The place of an object in its scene file, counted from 0: what decides ties and what messages
/// name.
pub type ObjectNumber = u32;

/// A side of an object, or no object at all: what a ray leaves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Side(u32);

impl Side {
    /// Not on any object.
    pub const NOWHERE: Self = Self(u32::MAX);

    /// A side of the object of a number below 2³¹ − 1: the front is where the geometric normal points
    /// to, the outside of a sphere.
    #[inline(always)]
    pub const fn new(object: ObjectNumber, front: bool) -> Self {
        Self(object << 1 | !front as u32)
    }

    /// The other side of the object.
    #[inline(always)]
    pub const fn opposite(self) -> Self {
        Self(self.0 ^ 1)
    }

    /// Its index among the sides of all objects: the front of each before its back.
    #[inline(always)]
    pub const fn index(self) -> usize {
        self.0 as usize
    }

    /// The object; a number that no object has for [`Side::NOWHERE`].
    #[inline(always)]
    pub const fn object(self) -> ObjectNumber {
        self.0 >> 1
    }

    /// Whether it is the front.
    #[inline(always)]
    pub const fn is_front(self) -> bool {
        self.0 & 1 == 0
    }
}

/// A half-line. `direction` must be normalised.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray<T = f32> {
    /// Where it starts.
    pub origin: Vec3<T>,
    /// Where it goes; length 1.
    pub direction: Vec3<T>,
    /// The surface it leaves. A flat object cannot be hit again by a ray that leaves it, which no
    /// rounding may undo; spheres decide by the offset of the origin.
    pub leaves: Side,
}

/// Where a shadow ray ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RayEnd<T = f32> {
    /// Distance along the ray.
    pub distance: T,
    /// The light there, if it is for one.
    pub light: Option<Vec3<T>>,
}

impl<T: Scalar> Ray<T> {
    /// A ray that starts in the open.
    #[inline(always)]
    pub fn new(origin: Vec3<T>, direction: Vec3<T>) -> Self {
        Self {
            origin,
            direction,
            leaves: Side::NOWHERE,
        }
    }

    /// The point at distance `t`.
    #[inline(always)]
    pub fn at(&self, t: T) -> Vec3<T> {
        formula::at(self.origin, self.direction, t)
    }
}

impl<T: Scalar> Vec3<T> {
    /// The mirror direction of the unit vector `self` at a surface with unit normal `normal`.
    #[inline(always)]
    pub fn reflect(self, normal: Self) -> Self {
        self.reflect_at(normal, -self.dot(normal))
    }

    /// [`Vec3::reflect`] where `cosine = −self·normal` is known.
    #[inline(always)]
    pub(crate) fn reflect_at(self, normal: Self, cosine: T) -> Self {
        optics::mirror(self.real(), normal.real(), Real(cosine)).plain()
    }

    /// The refracted direction of the unit vector `self`, or `None` at total internal reflection.
    ///
    /// `normal` is the unit normal on the side the ray comes from, `eta` the ratio of the index of
    /// refraction on that side to the one beyond, and `bend = 1/eta² − 1`: see [`optics::beyond_critical`].
    #[inline]
    pub fn refract(self, normal: Self, eta: T, bend: T) -> Option<Self> {
        self.refract_at(normal, -self.dot(normal), eta, bend)
    }

    /// [`Vec3::refract`] where `cosine = −self·normal` is known.
    #[inline]
    pub(crate) fn refract_at(self, normal: Self, cosine: T, eta: T, bend: T) -> Option<Self> {
        let k = optics::beyond_critical(Real(cosine), Real(bend));
        // NaN counts as total reflection, so that no direction without a length leaves here.
        if !k.0.is_zero_or_positive() {
            return None;
        }
        let direction = optics::refract(self.real(), normal.real(), Real(cosine), k, Real(eta));
        if optics::drift(direction)
            .0
            .is_before(T::EPSILON * T::from_i32(256))
        {
            Some(optics::renormalize(direction).plain())
        } else {
            // Only an extreme index cancels enough to come here, or even to end on the wrong side.
            let (unit, _) = direction.plain().try_normalize()?;
            (unit.dot(normal) < T::ZERO).then_some(unit)
        }
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
    /// Where the index is extreme the ray all but meets its normal, and the sum of both is what rounding left of them, in whatever
    /// direction.
    #[test]
    fn refraction_by_an_extreme_index_ends_beyond_the_surface_or_nowhere() {
        let (mut beyond, mut refused) = (0, 0);
        for step in 1..2000_i32 {
            let component = |factor: i32| f32::from_i32(step * factor % 101) / 101.0 + 0.1;
            let (normal, _) = Vec3::new(component(7), component(13), component(29))
                .try_normalize()
                .unwrap();
            // A few units of rounding beside the opposite of the normal.
            let units = |factor: i32| 1.0 + f32::EPSILON * f32::from_i32(step * factor % 5 - 2);
            let incoming = Vec3::new(
                -normal.x * units(3),
                -normal.y * units(11),
                -normal.z * units(17),
            );
            for eta in [1e4, 1e9, 1e18] {
                match incoming.refract(normal, eta, (1.0 / eta - 1.0) * (1.0 / eta + 1.0)) {
                    None => refused += 1,
                    Some(direction) => {
                        beyond += 1;
                        let length = direction.dot(direction).sqrt();
                        assert!((length - 1.0).abs() < 1e-6, "{incoming:?} at {normal:?}");
                        assert!(
                            direction.dot(normal) < 0.0,
                            "{incoming:?} at {normal:?}: {direction:?}"
                        );
                    }
                }
            }
        }
        assert!(beyond > 500 && refused > 500, "{beyond}, {refused}");
    }
}
