//! Infinite planes.

use super::{
    BoundingSphere, FlatPlane, Geometry, Kind, ListedShape, Object, ObjectInfo, Primitive, Shape,
    ShapeError, SurfacePoint,
};
use crate::formula;
use crate::ray::Ray;
use crate::real::Real;
use crate::scalar::Scalar;
use crate::stages::Stages;
use crate::vec3::Vec3;

/// The plane of the points with `normal·p = height`; the `distance` of scene text is `−height`.
///
/// Invariants: `normal` has length 1, `height` is finite.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane<T = f32> {
    normal: Vec3<T>,
    height: T,
    info: ObjectInfo,
}

impl<T: Scalar> Plane<T> {
    /// The plane of the points with `normal·p + distance = 0`. The normal may have any length but 0;
    /// the distance is divided by that length too.
    ///
    /// # Errors
    ///
    /// [`ShapeError::NormalZero`], [`ShapeError::DistanceTooLarge`].
    pub fn new(normal: Vec3<T>, distance: T, info: ObjectInfo) -> Result<Self, ShapeError> {
        let (normal, [largest, length]) = normal.try_normalize().ok_or(ShapeError::NormalZero)?;
        let height = -(distance / largest / length);
        if !height.is_finite() {
            return Err(ShapeError::DistanceTooLarge);
        }
        Ok(Self::from_parts(normal, height, info))
    }

    /// A plane from values that [`Plane::new`] has computed: for baked scenes.
    pub const fn from_parts(normal: Vec3<T>, height: T, info: ObjectInfo) -> Self {
        Self {
            normal,
            height,
            info,
        }
    }

    /// Unit normal.
    pub const fn normal(&self) -> Vec3<T> {
        self.normal
    }

    /// `normal·p` of its points.
    pub const fn height(&self) -> T {
        self.height
    }

    /// Material and place in the file.
    #[inline(always)]
    pub const fn info(&self) -> ObjectInfo {
        self.info
    }

    /// Distance of the crossing within `0 < t ≤ t_max`. A ray in the plane or parallel to
    /// it does not cross it.
    #[inline(always)]
    pub fn intersect(&self, ray: &Ray<T>, t_max: T) -> Option<T> {
        self.crossing(ray).filter(|t| *t <= t_max)
    }

    /// [`Plane::intersect`] without a limit; the distance may be infinite.
    #[inline(always)]
    pub(crate) fn crossing(&self, ray: &Ray<T>) -> Option<T> {
        let (below, slope) = formula::plane::rise(
            self.normal.real(),
            Real(self.height),
            ray.origin.real(),
            ray.direction.real(),
        );
        if T::EMULATED && below.0.is_negative() != slope.0.is_negative() {
            return None;
        }
        let t = (below / slope).0;
        t.is_positive().then_some(t)
    }

    /// Whether the ray crosses the plane within `0 < t < t_max`.
    #[inline(always)]
    pub fn occludes(&self, ray: &Ray<T>, t_max: T) -> bool {
        matches!(self.intersect(ray, t_max), Some(t) if t < t_max)
    }

    /// The point at distance `t`, projected back onto the plane.
    #[inline(always)]
    pub fn surface_point(&self, ray: &Ray<T>, t: T) -> SurfacePoint<T> {
        let (normal, height) = (self.normal.real(), Real(self.height));
        let point = formula::plane::project(ray.at(t).real(), normal, height);
        SurfacePoint {
            point: point.plain(),
            normal: self.normal,
            offset: formula::plane::offset(point, normal, height).0,
        }
    }
}

impl<T: Scalar> Primitive<T> for Plane<T> {
    const KIND: Kind = Kind::Plane;
    const IS_FLAT: bool = true;
    const IS_BOUNDED: bool = false;

    fn shape(&self) -> Shape<T> {
        Shape::Plane {
            normal: self.normal,
            distance: -self.height,
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
        None
    }

    fn bounding_box(&self) -> Option<[Vec3<T>; 2]> {
        None
    }

    #[inline(always)]
    fn hit(&self, ray: &Ray<T>, _: T) -> Option<T> {
        self.crossing(ray)
    }

    #[inline(always)]
    fn occludes(&self, ray: &Ray<T>, t_max: T) -> bool {
        self.occludes(ray, t_max)
    }

    fn plane(&self) -> Option<FlatPlane<T>> {
        Some(FlatPlane {
            normal: self.normal,
            height: self.height,
            offset: T::ZERO,
        })
    }

    #[inline(always)]
    fn point(&self, ray: &Ray<T>, t: T) -> SurfacePoint<T> {
        self.surface_point(ray, t)
    }
}

impl<T: Scalar> ListedShape<T> for Plane<T> {
    const SEVERAL: Stages = Stages::SEVERAL_PLANES;

    #[inline(always)]
    fn object(&self) -> Object<'_, T> {
        Object::Plane(self)
    }

    #[inline(always)]
    fn all<'a>(geometry: &Geometry<'a, T>) -> &'a [Self] {
        geometry.planes
    }

    #[cfg(feature = "bake")]
    fn parts(&self) -> (&'static str, [Option<super::Part<T>>; 6]) {
        use super::Part::{Number, Vector};
        let parts = [
            Some(Vector(self.normal)),
            Some(Number(self.height)),
            None,
            None,
            None,
            None,
        ];
        ("Plane", parts)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const INFO: ObjectInfo = ObjectInfo {
        material: 0,
        number: 7,
    };

    #[test]
    fn normalises_the_normal_and_the_distance_with_it() {
        let plane = Plane::new(Vec3::new(0.0_f32, 2.0, 0.0), 3.0, INFO).unwrap();
        assert_eq!(plane.normal(), Vec3::new(0.0, 1.0, 0.0));
        assert_eq!(plane.height(), -1.5);
    }

    #[test]
    fn is_hit_from_both_sides_but_not_along_itself() {
        let plane = Plane::new(Vec3::new(0.0_f32, 1.0, 0.0), 1.0, INFO).unwrap();
        let t = |y, dy, dz| {
            let ray = Ray::new(Vec3::new(0.0, y, 0.0), Vec3::new(0.0, dy, dz));
            plane.intersect(&ray, f32::MAX)
        };
        assert_eq!(t(1.0, -1.0, 0.0), Some(2.0));
        assert_eq!(t(-3.0, 1.0, 0.0), Some(2.0));
        assert_eq!(t(1.0, 1.0, 0.0), None);
        assert_eq!(t(1.0, 0.0, 1.0), None);
        assert_eq!(t(-1.0, 0.0, 1.0), None);
    }

    #[test]
    fn refuses_what_is_no_plane() {
        let new = |normal, distance| Plane::new(normal, distance, INFO).err();
        assert_eq!(
            new(Vec3::new(0.0_f32, -0.0, 0.0), 1.0),
            Some(ShapeError::NormalZero)
        );
        assert_eq!(
            new(Vec3::new(0.0_f32, 1e-30, 0.0), 1e30),
            Some(ShapeError::DistanceTooLarge)
        );
    }
}
