//! Flat discs.

use super::{
    BoundingSphere, FlatPlane, Kind, ObjectInfo, Primitive, Shape, ShapeError, StoredShape,
    SurfacePoint,
};
use crate::formula::{self, origin_offset};
use crate::ray::Ray;
use crate::real::Real;
use crate::scalar::Scalar;
use crate::vec3::Vec3;

/// A disc, seen from both sides.
///
/// Invariants: `normal` has length 1; `height = normal·center`; `radius_squared` is the finite square of `radius > 0`; `offset` is
/// an upper bound of the origin offset anywhere on the disc.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Disc<T = f32> {
    center: Vec3<T>,
    normal: Vec3<T>,
    height: T,
    radius_squared: T,
    radius: T,
    offset: T,
    info: ObjectInfo,
}

impl<T: Scalar> Disc<T> {
    /// The points of a plane through `center` that are not farther from it than `radius`. The normal may have any length but 0.
    ///
    /// # Errors
    ///
    /// [`ShapeError::NormalZero`], [`ShapeError::RadiusNotPositive`], [`ShapeError::RadiusTooLarge`],
    /// [`ShapeError::DistanceTooLarge`].
    pub fn new(
        center: Vec3<T>,
        normal: Vec3<T>,
        radius: T,
        info: ObjectInfo,
    ) -> Result<Self, ShapeError> {
        let (normal, _) = normal.try_normalize().ok_or(ShapeError::NormalZero)?;
        if !(radius > T::ZERO) {
            return Err(ShapeError::RadiusNotPositive);
        }
        let radius_squared = radius * radius;
        if !radius_squared.is_finite() {
            return Err(ShapeError::RadiusTooLarge);
        }
        let height = normal.dot(center);
        if !height.is_finite() {
            return Err(ShapeError::DistanceTooLarge);
        }
        // Σ|nᵢPᵢ| ≤ Σ|nᵢ|(|cᵢ| + r) ≤ Σ|nᵢcᵢ| + 2r, since Σ|nᵢ| ≤ √3.
        let components = normal.abs().dot(center.abs()) + T::TWO * radius;
        Ok(Self {
            center,
            normal,
            height,
            radius_squared,
            radius,
            offset: origin_offset(components, height.abs()),
            info,
        })
    }

    /// Centre.
    pub const fn center(&self) -> Vec3<T> {
        self.center
    }

    /// Unit normal.
    pub const fn normal(&self) -> Vec3<T> {
        self.normal
    }

    /// `normal·p` of its points.
    pub const fn height(&self) -> T {
        self.height
    }

    /// Radius, greater than 0.
    pub const fn radius(&self) -> T {
        self.radius
    }

    /// Square of the radius, as rounded.
    pub const fn radius_squared(&self) -> T {
        self.radius_squared
    }

    /// Upper bound of the origin offset on this disc.
    pub const fn offset(&self) -> T {
        self.offset
    }

    /// Material and place in the text.
    pub const fn info(&self) -> ObjectInfo {
        self.info
    }

    /// Distance of the crossing within `0 < t ≤ t_max`.
    #[inline(always)]
    pub fn intersect(&self, ray: &Ray<T>, t_max: T) -> Option<T> {
        let (normal, height) = (self.normal.real(), Real(self.height));
        let t = formula::disc::crossing(normal, height, ray.origin.real(), ray.direction.real()).0;
        if !(t.is_positive() && t <= t_max) {
            return None;
        }
        let place = ray.at(t).real();
        let eccentricity = formula::disc::eccentricity(place, self.center.real(), normal, height);
        (eccentricity.0 <= self.radius_squared).then_some(t)
    }

    /// The point at a distance, projected onto the plane.
    #[inline(always)]
    fn project(&self, ray: &Ray<T>, t: T) -> Vec3<T> {
        let (normal, height) = (self.normal.real(), Real(self.height));
        formula::plane::project(ray.at(t).real(), normal, height).plain()
    }
}

impl<T: Scalar> Primitive<T> for Disc<T> {
    const KIND: Kind = Kind::Disc;
    const IS_FLAT: bool = true;
    const IS_BOUNDED: bool = true;

    fn shape(&self) -> Shape<T> {
        Shape::Disc {
            center: self.center,
            normal: self.normal,
            radius: self.radius,
        }
    }

    #[inline(always)]
    fn info(&self) -> ObjectInfo {
        self.info
    }

    fn set_material(&mut self, material: u32) {
        self.info.material = material;
    }

    fn bounding_sphere(&self) -> Option<BoundingSphere<T>> {
        Some(BoundingSphere {
            center: self.center,
            radius: self.radius,
        })
    }

    fn bounding_box(&self) -> Option<[Vec3<T>; 2]> {
        let radius = Vec3::splat(self.radius);
        Some([self.center - radius, self.center + radius])
    }

    #[inline(always)]
    fn hit(&self, ray: &Ray<T>, t_max: T) -> Option<T> {
        self.intersect(ray, t_max)
    }

    fn plane(&self) -> Option<FlatPlane<T>> {
        Some(FlatPlane {
            normal: self.normal,
            height: self.height,
            offset: self.offset,
        })
    }

    #[inline(always)]
    fn point(&self, ray: &Ray<T>, t: T) -> SurfacePoint<T> {
        SurfacePoint {
            point: self.project(ray, t),
            normal: self.normal,
            offset: self.offset,
        }
    }
}

impl<T: Scalar> StoredShape<T> for Disc<T> {
    const NUMBERS: usize = 10;

    fn write(&self, numbers: &mut [T]) {
        let (c, n) = (self.center, self.normal);
        let all = [
            c.x,
            c.y,
            c.z,
            n.x,
            n.y,
            n.z,
            self.height,
            self.radius_squared,
            self.radius,
            self.offset,
        ];
        for (to, from) in numbers.iter_mut().zip(all) {
            *to = from;
        }
    }

    #[inline(always)]
    fn read(numbers: &[T], info: ObjectInfo) -> Self {
        let none = [T::ZERO; 10];
        let [
            cx,
            cy,
            cz,
            nx,
            ny,
            nz,
            height,
            radius_squared,
            radius,
            offset,
        ] = *numbers.first_chunk().unwrap_or(&none);
        Self {
            center: Vec3::new(cx, cy, cz),
            normal: Vec3::new(nx, ny, nz),
            height,
            radius_squared,
            radius,
            offset,
            info,
        }
    }
}
