//! Rays, and where a ray that leaves a surface starts.

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
    /// The surface it leaves. A flat object cannot be met again by a ray that leaves it, which no
    /// rounding may undo; spheres decide by the offset of the origin.
    pub leaves: Side,
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
        self.origin + self.direction * t
    }
}

/// How far from a surface a new ray must start so that no rounding puts its origin on the wrong side.
///
/// `e = 2u (Σ|nᵢPᵢ| + extent)` with `u = 2⁻²³` (2⁻⁵²), where `Σ|nᵢPᵢ|` (`components`) bounds the
/// rounding of the hit point along the normal and `extent` that of the object's own intersection test:
/// the radius, the plane's distance or the largest coordinate of the vertices. In the manner of
/// Wächter and Binder (Ray Tracing Gems, ch. 6) and pbrt-v4, section 6.8.6.
#[inline(always)]
pub fn origin_offset<T: Scalar>(components: T, extent: T) -> T {
    T::TWO * T::EPSILON * (components + extent)
}
