//! Spheres.

use super::quick_reject::QuickReject;
use super::{
    BoundingSphere, Geometry, Kind, ListedShape, Object, ObjectInfo, Primitive, Shape, ShapeError,
    SurfacePoint,
};
use crate::formula::{self, origin_offset};
use crate::ray::Ray;
use crate::real::Real;
use crate::scalar::Scalar;
use crate::stages::Stages;
use crate::vec3::Vec3;

/// A sphere.
///
/// Invariants: `radius > 0`; `radius_squared` is its finite square, or −1 for a radius so small that the
/// square loses digits (below 1.1e-19 in `f32`), so that no ray hits the sphere; `offset` is an upper bound of the origin offset anywhere
/// on the surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sphere<T = f32> {
    center: Vec3<T>,
    radius_squared: T,
    radius: T,
    offset: T,
    info: ObjectInfo,
}

impl<T: Scalar> Sphere<T> {
    /// A sphere; computes what rendering needs.
    ///
    /// # Errors
    ///
    /// [`ShapeError::RadiusNotPositive`], [`ShapeError::RadiusTooLarge`].
    pub fn new(center: Vec3<T>, radius: T, info: ObjectInfo) -> Result<Self, ShapeError> {
        if !(radius > T::ZERO) {
            return Err(ShapeError::RadiusNotPositive);
        }
        let square = radius * radius;
        if !square.is_finite() {
            return Err(ShapeError::RadiusTooLarge);
        }
        let radius_squared = if square < T::MIN_POSITIVE {
            -T::ONE
        } else {
            square
        };
        // Σ|nᵢPᵢ| ≤ Σ|cᵢ| + r, since P = c + n·r and Σnᵢ² = 1.
        let c = center.abs();
        let offset = origin_offset(c.x + c.y + c.z + radius, radius);
        Ok(Self::from_parts(
            center,
            radius_squared,
            radius,
            offset,
            info,
        ))
    }

    /// A sphere from values that [`Sphere::new`] has computed: for baked scenes.
    pub const fn from_parts(
        center: Vec3<T>,
        radius_squared: T,
        radius: T,
        offset: T,
        info: ObjectInfo,
    ) -> Self {
        Self {
            center,
            radius_squared,
            radius,
            offset,
            info,
        }
    }

    /// Centre.
    pub const fn center(&self) -> Vec3<T> {
        self.center
    }

    /// Radius, greater than 0.
    pub const fn radius(&self) -> T {
        self.radius
    }

    /// Square of the radius, as rounded; −1 if no ray is to hit the sphere.
    pub const fn radius_squared(&self) -> T {
        self.radius_squared
    }

    /// Upper bound of the origin offset on this sphere.
    pub const fn offset(&self) -> T {
        self.offset
    }

    /// Material and place in the file.
    #[inline(always)]
    pub const fn info(&self) -> ObjectInfo {
        self.info
    }

    /// Whether a coarse look in integers, which decides first where floats are emulated, finds that the ray does
    /// not hit it.
    #[doc(hidden)]
    #[inline(always)]
    pub fn quick_reject(&self, ray: &Ray<T>) -> bool {
        QuickReject::of(ray, self.center, self.radius_squared, self.offset)
            .is_some_and(|quick| quick.is_clear_miss_of_surface())
    }

    /// The distances of both crossings of the ray's line, nearer first.
    #[inline(always)]
    fn crossings(&self, ray: &Ray<T>) -> Option<(T, T)> {
        if T::EMULATED && self.quick_reject(ray) {
            return None;
        }
        let (middle, discriminant) = formula::sphere::chord(
            self.center.real(),
            Real(self.radius_squared),
            ray.origin.real(),
            ray.direction.real(),
        );
        if discriminant.0.is_zero_or_positive() {
            let (near, far) = formula::sphere::crossings(middle, discriminant);
            Some((near.0, far.0))
        } else {
            None
        }
    }

    /// Distance of the nearest crossing within `0 < t ≤ t_max`.
    #[inline(always)]
    pub fn intersect(&self, ray: &Ray<T>, t_max: T) -> Option<T> {
        self.crossing(ray).filter(|t| *t <= t_max)
    }

    /// [`Sphere::intersect`] without a limit.
    #[inline(always)]
    pub(crate) fn crossing(&self, ray: &Ray<T>) -> Option<T> {
        let (near, far) = self.crossings(ray)?;
        // From inside the sphere only the far crossing lies ahead.
        if near.is_positive() {
            Some(near)
        } else {
            far.is_positive().then_some(far)
        }
    }

    /// Whether the ray crosses the surface anywhere within `0 < t < t_max`.
    #[inline(always)]
    pub fn occludes(&self, ray: &Ray<T>, t_max: T) -> bool {
        match self.crossings(ray) {
            Some((near, far)) => {
                (near.is_positive() && near.is_before(t_max))
                    || (far.is_positive() && far.is_before(t_max))
            }
            None => false,
        }
    }

    /// The point at distance `t`, projected back onto the sphere.
    #[inline(always)]
    pub fn surface_point(&self, ray: &Ray<T>, t: T) -> SurfacePoint<T> {
        let place = ray.at(t).real();
        let (point, normal) =
            formula::sphere::project(place, self.center.real(), Real(self.radius));
        SurfacePoint {
            point: point.plain(),
            normal: normal.plain(),
            offset: self.offset,
        }
    }
}

impl<T: Scalar> Primitive<T> for Sphere<T> {
    const KIND: Kind = Kind::Sphere;
    const IS_FLAT: bool = false;
    const IS_BOUNDED: bool = true;

    fn shape(&self) -> Shape<T> {
        Shape::Sphere {
            center: self.center,
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
    fn hit(&self, ray: &Ray<T>, _: T) -> Option<T> {
        self.crossing(ray)
    }

    #[inline(always)]
    fn occludes(&self, ray: &Ray<T>, t_max: T) -> bool {
        self.occludes(ray, t_max)
    }

    fn has_surface_near(&self, point: Vec3<T>) -> bool {
        self.is_surface_near(point)
    }

    fn occludes_near(&self, ray: &Ray<T>, light: Vec3<T>, distance: T) -> bool {
        self.occludes_light_near(ray, light, distance)
    }

    #[inline(always)]
    fn point(&self, ray: &Ray<T>, t: T) -> SurfacePoint<T> {
        self.surface_point(ray, t)
    }
}

impl<T: Scalar> ListedShape<T> for Sphere<T> {
    const SEVERAL: Stages = Stages::SEVERAL_SPHERES;

    #[inline(always)]
    fn object(&self) -> Object<'_, T> {
        Object::Sphere(self)
    }

    #[inline(always)]
    fn all<'a>(geometry: &Geometry<'a, T>) -> &'a [Self] {
        geometry.spheres
    }

    #[cfg(feature = "bake")]
    fn parts(&self) -> (&'static str, [Option<super::Part<T>>; 6]) {
        use super::Part::{Number, Vector};
        let parts = [
            Some(Vector(self.center)),
            Some(Number(self.radius_squared)),
            Some(Number(self.radius)),
            Some(Number(self.offset)),
            None,
            None,
        ];
        ("Sphere", parts)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const INFO: ObjectInfo = ObjectInfo {
        material: 0,
        number: 0,
    };

    fn sphere(center: Vec3<f32>, radius: f32) -> Sphere<f32> {
        Sphere::new(center, radius, INFO).unwrap()
    }

    const ALONG_Z: Vec3<f32> = Vec3::new(0.0, 0.0, 1.0);

    #[test]
    fn hits_the_near_side_from_outside_and_the_far_side_from_inside() {
        let s = sphere(Vec3::new(0.0, 0.0, 5.0), 1.0);
        let t = |z: f32| s.intersect(&Ray::new(Vec3::new(0.0, 0.0, z), ALONG_Z), f32::MAX);
        assert_eq!(t(0.0), Some(4.0));
        assert_eq!(t(4.5), Some(1.5));
        assert_eq!(t(6.5), None);
    }

    #[test]
    fn t_max_is_included_by_intersect_and_excluded_by_occludes() {
        let s = sphere(Vec3::new(0.0, 0.0, 5.0), 1.0);
        let ray = Ray::new(Vec3::default(), ALONG_Z);
        assert_eq!(s.intersect(&ray, 4.0), Some(4.0));
        assert!(!s.occludes(&ray, 4.0));
        assert!(s.occludes(&ray, 4.5));
        // From inside, the far wall may lie beyond the light.
        let inside = Ray::new(Vec3::new(0.0, 0.0, 5.0), ALONG_Z);
        assert!(!s.occludes(&inside, 1.0));
        assert!(s.occludes(&inside, 1.5));
    }

    #[test]
    fn refuses_radii_that_are_none() {
        let new = |radius| Sphere::new(Vec3::<f32>::default(), radius, INFO).err();
        assert_eq!(new(0.0), Some(ShapeError::RadiusNotPositive));
        assert_eq!(new(-1.0), Some(ShapeError::RadiusNotPositive));
        assert_eq!(new(f32::NAN), Some(ShapeError::RadiusNotPositive));
        assert_eq!(new(2e19), Some(ShapeError::RadiusTooLarge));
        assert_eq!(new(1e-23), None);
    }
}
