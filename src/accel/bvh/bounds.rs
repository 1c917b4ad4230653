//! Boxes along the axes.

use crate::scalar::Scalar;
use crate::shape::Geometry;
use crate::vec3::Vec3;

/// A box, or nothing if its lowest corner is above its highest.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bounds<T> {
    pub(super) low: Vec3<T>,
    pub(super) high: Vec3<T>,
}

impl<T: Scalar> Bounds<T> {
    pub(super) fn nothing() -> Self {
        Self {
            low: Vec3::splat(T::MAX),
            high: Vec3::splat(-T::MAX),
        }
    }

    /// The box around what rays can hit of the object of an index.
    pub(super) fn around(geometry: &Geometry<'_, T>, entry: u32) -> Self {
        let exact = geometry
            .object(entry as usize)
            .and_then(|object| object.bounding_box());
        // Entries are indices of bounded objects.
        exact
            .map_or(Self::nothing(), |[low, high]| Self { low, high })
            .widened()
    }

    /// The box with the margin of the tests. The largest coordinates of each axis add up to at least
    /// `|c| + r`.
    fn widened(self) -> Self {
        let (low, high) = (self.low.abs(), self.high.abs());
        let largest = Vec3::new(low.x.max(high.x), low.y.max(high.y), low.z.max(high.z));
        let size = largest.x + largest.y + largest.z;
        let margin = size * T::EPSILON * T::from_i32(64) + T::SMALLEST_TO_SQUARE * T::from_i32(8);
        Self {
            low: self.low - Vec3::splat(margin),
            high: self.high + Vec3::splat(margin),
        }
    }

    /// The box around both.
    pub(super) fn around_both(self, other: Self) -> Self {
        Self {
            low: self.low.min_by_component(other.low),
            high: self.high.max_by_component(other.high),
        }
    }

    /// The middle.
    pub(super) fn middle(&self) -> Vec3<T> {
        // Halve before adding: the sum of two large coordinates may overflow.
        self.low * T::HALF + self.high * T::HALF
    }

    /// Half of the surface; 0 or less for nothing.
    pub(super) fn half_area(&self) -> T {
        let size = self.high - self.low;
        size.x * size.y + size.y * size.z + size.z * size.x
    }
}

/// The component along an axis.
pub(super) fn along<T: Scalar>(v: Vec3<T>, axis: usize) -> T {
    match axis {
        0 => v.x,
        1 => v.y,
        _ => v.z,
    }
}
