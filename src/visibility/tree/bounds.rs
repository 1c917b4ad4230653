//! Boxes along the axes.

use crate::scalar::Scalar;
use crate::scene::{Scene, TreeEntry};
use crate::vec3::Vec3;

/// A box, or nothing if its lowest corner is above its highest.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bounds<T> {
    pub(super) low: Vec3<T>,
    pub(super) high: Vec3<T>,
}

/// Component by component.
fn pick<T>(a: Vec3<T>, b: Vec3<T>, choose: impl Fn(T, T) -> T) -> Vec3<T> {
    Vec3::new(choose(a.x, b.x), choose(a.y, b.y), choose(a.z, b.z))
}

impl<T: Scalar> Bounds<T> {
    pub(super) fn nothing() -> Self {
        Self {
            low: Vec3::splat(T::MAX),
            high: Vec3::splat(-T::MAX),
        }
    }

    /// The box around what rays can meet of an object.
    pub(super) fn around(scene: &Scene<'_, T>, entry: TreeEntry) -> Self {
        let exact = if entry.is_triangle() {
            scene.triangles.get(entry.index()).map(|triangle| {
                let vertices = triangle.vertices();
                vertices.iter().fold(Self::nothing(), |b, v| b.with(*v))
            })
        } else {
            scene.spheres.get(entry.index()).map(|sphere| {
                let (center, radius) = (sphere.center(), Vec3::splat(sphere.radius()));
                Self {
                    low: center - radius,
                    high: center + radius,
                }
            })
        };
        // Entries are indices of objects.
        exact.unwrap_or(Self::nothing()).widened()
    }

    /// The box with the margin of the tests. The largest coordinates of each axis add up to at least
    /// `|c| + r`.
    fn widened(self) -> Self {
        let largest = pick(self.low.abs(), self.high.abs(), T::max);
        let size = largest.x + largest.y + largest.z;
        let margin = size * T::EPSILON * T::from_i32(64) + T::SMALLEST_TO_SQUARE * T::from_i32(8);
        Self {
            low: self.low - Vec3::splat(margin),
            high: self.high + Vec3::splat(margin),
        }
    }

    fn with(self, point: Vec3<T>) -> Self {
        self.around_both(Self {
            low: point,
            high: point,
        })
    }

    /// The box around both.
    pub(super) fn around_both(self, other: Self) -> Self {
        let min = |a: T, b: T| if b < a { b } else { a };
        let max = |a: T, b: T| if b > a { b } else { a };
        Self {
            low: pick(self.low, other.low, min),
            high: pick(self.high, other.high, max),
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
