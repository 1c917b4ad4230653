//! The three shapes: sphere, plane, triangle.
//!
//! Each has `intersect(ray, t_max)`, the nearest meeting within `0 < t ≤ t_max`, and
//! `occludes(ray, t_max)`, whether there is any within `0 < t < t_max`. `t_max` must be finite, so
//! that a distance always is; NaN anywhere is a miss.

mod coarse;
mod plane;
mod sphere;
mod triangle;

pub use plane::Plane;
pub use sphere::Sphere;
pub use triangle::{Barycentric, Triangle};

use core::fmt;

use crate::ray::ObjectNumber;
use crate::scalar::Scalar;
use crate::vec3::Vec3;

/// What belongs to an object besides its geometry.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Surface {
    /// Index of its material in the scene's materials.
    pub material: u32,
    /// Its place in the scene file.
    pub number: ObjectNumber,
}

/// A point on a surface, projected back onto it, as seen along a ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfacePoint<T> {
    /// The point.
    pub point: Vec3<T>,
    /// Geometric unit normal, whichever side the ray comes from.
    pub normal: Vec3<T>,
    /// How far from the point new rays start, along the normal.
    pub offset: T,
}

/// Why numbers do not make a shape.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ShapeError {
    /// The radius is zero, negative or not a number.
    RadiusNotPositive,
    /// The square of the radius is infinite.
    RadiusTooLarge,
    /// The plane's normal has no length.
    NormalZero,
    /// The plane's distance, divided by the length of its normal, is infinite.
    DistanceTooLarge,
    /// The triangle's vertices lie on a line, as nearly as the scalar can tell.
    NoArea,
    /// The triangle's edges are infinitely long in this scalar.
    EdgeTooLong,
}

impl fmt::Display for ShapeError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::RadiusNotPositive => "a sphere's radius must be greater than 0",
            Self::RadiusTooLarge => "the square of a sphere's radius must be finite",
            Self::NormalZero => "a plane's normal must have a length",
            Self::DistanceTooLarge => {
                "a plane's distance divided by the length of its normal must be finite"
            }
            Self::NoArea => "a triangle must have an area",
            Self::EdgeTooLong => "a triangle's edges must have a finite length",
        })
    }
}

impl core::error::Error for ShapeError {}

/// The larger of the absolute coordinates of a point.
fn extent<T: Scalar>(point: Vec3<T>) -> T {
    point.abs().max_component()
}
