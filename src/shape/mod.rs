//! The shapes: what each is, and the one list of them.
//!
//! A shape implements `Primitive` and stands in `for_each_shape!`, [`Kind`], [`Object`], [`Shape`] and [`Geometry`], all in
//! this folder. Its bounds alone put it into exact visibility and the BVH.
//!
//! Each has `intersect(ray, t_max)`, the nearest hit within `0 < t ≤ t_max`, and
//! `occludes(ray, t_max)`, whether there is any within `0 < t < t_max`. `t_max` must be finite, so
//! that a distance always is; NaN anywhere is a miss.

mod disc;
mod geometry;
pub(crate) mod light_on_surface;
pub(crate) mod margin;
mod plane;
mod quick_reject;
mod sphere;
mod stored;
mod triangle;

pub use disc::Disc;
pub use geometry::Geometry;
use light_on_surface::FlatPlane;
pub use plane::Plane;
pub use sphere::Sphere;
pub(crate) use stored::StoredShape;
pub use stored::{Stored, StoredEntry, StoredObject};
pub use triangle::Triangle;

use core::fmt;

use crate::ray::{ObjectNumber, Ray};
use crate::scalar::Scalar;
use crate::stages::Stages;
use crate::vec3::Vec3;

/// The shapes that have slices of their own in every scene: calls a macro with their list. Of two objects at exactly the same
/// distance the kind that comes first here is hit, and those of [`for_each_stored_shape!`] come last.
macro_rules! for_each_shape {
    ($then:ident $($with:tt)*) => {
        $then! { [Sphere Plane Triangle] $($with)* }
    };
}
pub(crate) use for_each_shape;

/// The shapes that are [`Stored`] by their numbers: calls a macro with their list.
macro_rules! for_each_stored_shape {
    ($then:ident $($with:tt)*) => {
        $then! { [Disc] $($with)* }
    };
}
pub(crate) use for_each_stored_shape;

/// Of an object of any shape what all have: `of_any_shape!(object, it => it.material())`.
macro_rules! of_any_shape {
    ($object:expr, $it:ident => $call:expr) => {
        $crate::shape::for_each_shape!(match_shape_with_stored $object, $it => $call)
    };
}

/// Both lists for [`of_any_shape`].
macro_rules! match_shape_with_stored {
    ([$($shape:ident)*] $($with:tt)*) => {
        for_each_stored_shape!(match_shape [$($shape)*] $($with)*)
    };
}

/// The arms of [`of_any_shape`].
macro_rules! match_shape {
    ([$($stored:ident)*] [$($shape:ident)*] $object:expr, $it:ident => $call:expr) => {
        match $object {
            $(Object::$shape($it) => { let $it = *$it; $call })*
            Object::Stored(object) => match object.entry.kind {
                $(Kind::$stored => {
                    let $it: &$stored<_> = &StoredShape::of(*object);
                    $call
                })*
                // Kinds that are not stored do not come here; of whatever numbers, it is an object.
                _ => {
                    let $it: &Disc<_> = &StoredShape::of(*object);
                    $call
                }
            },
        }
    };
}

/// A kind of shape.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Kind {
    /// Spheres.
    Sphere,
    /// Planes.
    Plane,
    /// Triangles.
    Triangle,
    /// Discs.
    Disc,
}

impl Kind {
    /// All kinds, in the order of the indices of objects.
    pub const ALL: [Self; Self::COUNT] = [Self::Sphere, Self::Plane, Self::Triangle, Self::Disc];

    /// How many kinds there are.
    pub const COUNT: usize = 4;

    /// Its place in [`Kind::ALL`].
    pub const fn index(self) -> usize {
        self as usize
    }

    /// The stage that draws it.
    pub const fn stage(self) -> Stages {
        match self {
            Self::Sphere => Stages::SPHERES,
            Self::Plane => Stages::PLANES,
            Self::Triangle => Stages::TRIANGLES,
            Self::Disc => Stages::DISCS,
        }
    }

    /// Its name in messages, in the singular.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Sphere => "sphere",
            Self::Plane => "plane",
            Self::Triangle => "triangle",
            Self::Disc => "disc",
        }
    }
}

/// An object of a scene, of any shape.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Object<'a, T = f32> {
    /// A sphere.
    Sphere(&'a Sphere<T>),
    /// A plane.
    Plane(&'a Plane<T>),
    /// A triangle.
    Triangle(&'a Triangle<T>),
    /// An object of a shape that few scenes have.
    Stored(StoredObject<'a, T>),
}

/// What an object is, in the numbers that describe it: what parsers, printers and programs hand on.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Shape<T = f32> {
    /// All points at a distance from a centre.
    Sphere {
        /// Centre.
        center: Vec3<T>,
        /// Radius, above 0; its square must be finite.
        radius: T,
    },
    /// All points with `normal·p + distance = 0`.
    Plane {
        /// Normal, of any length but 0.
        normal: Vec3<T>,
        /// Distance, in units of the normal's length.
        distance: T,
    },
    /// Three vertices and what is between them; the normal is `normalize((v3 − v1) × (v2 − v1))`.
    Triangle([Vec3<T>; 3]),
    /// The points of a plane that are not farther than a radius from a centre.
    Disc {
        /// Centre.
        center: Vec3<T>,
        /// Normal, of any length but 0.
        normal: Vec3<T>,
        /// Radius, above 0; its square must be finite.
        radius: T,
    },
}

/// How the numbers of a shape are changed: moved, turned, scaled, mirrored, rounded to another scalar.
pub trait Transform<T: Scalar, U: Scalar = T> {
    /// Where a point goes.
    fn point(&self, point: Vec3<T>) -> Vec3<U>;

    /// How a normal is turned; its length does not matter.
    fn normal(&self, normal: Vec3<T>) -> Vec3<U>;

    /// How long a length becomes.
    fn length(&self, length: T) -> U;

    /// Where the points with `normal·p + distance = 0` go, the normal's length kept. Unless it is said otherwise the origin stays.
    fn plane(&self, normal: Vec3<T>, distance: T) -> (Vec3<U>, U) {
        (self.normal(normal), self.length(distance))
    }
}

impl<T: Scalar> Shape<T> {
    /// The shape changed.
    #[must_use]
    pub fn transformed<U: Scalar>(self, by: &impl Transform<T, U>) -> Shape<U> {
        match self {
            Self::Sphere { center, radius } => Shape::Sphere {
                center: by.point(center),
                radius: by.length(radius),
            },
            Self::Plane { normal, distance } => {
                let (normal, distance) = by.plane(normal, distance);
                Shape::Plane { normal, distance }
            }
            Self::Triangle([v1, v2, v3]) => {
                Shape::Triangle([by.point(v1), by.point(v2), by.point(v3)])
            }
            Self::Disc {
                center,
                normal,
                radius,
            } => Shape::Disc {
                center: by.point(center),
                normal: by.normal(normal),
                radius: by.length(radius),
            },
        }
    }
}

impl<T> Shape<T> {
    /// Its kind.
    pub const fn kind(&self) -> Kind {
        match self {
            Self::Sphere { .. } => Kind::Sphere,
            Self::Plane { .. } => Kind::Plane,
            Self::Triangle(_) => Kind::Triangle,
            Self::Disc { .. } => Kind::Disc,
        }
    }
}

/// A sphere around an object.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoundingSphere<T = f32> {
    /// Centre.
    pub center: Vec3<T>,
    /// Radius.
    pub radius: T,
}

/// What the tracer asks of a shape.
pub(crate) trait Primitive<T: Scalar>: Copy {
    /// Its kind.
    const KIND: Kind;
    /// The stage that draws it.
    const STAGE: Stages = Self::KIND.stage();
    /// A ray that leaves it cannot hit it again, whatever rounding says.
    const IS_FLAT: bool;
    /// It can be in a box of the hierarchy.
    const IS_BOUNDED: bool;

    /// What describes it.
    fn shape(&self) -> Shape<T>;

    /// Material and place in the text.
    fn info(&self) -> ObjectInfo;

    /// Another material.
    fn set_material(&mut self, material: u32);

    /// A sphere around it; `None` if it is unbounded, or as good as that.
    fn bounding_sphere(&self) -> Option<BoundingSphere<T>>;

    /// The lowest and the highest coordinates of what rays can hit; `None` if it is unbounded.
    fn bounding_box(&self) -> Option<[Vec3<T>; 2]>;

    /// Distance, above 0, of the nearest hit. One beyond `t_max` may be told or not.
    fn hit(&self, ray: &Ray<T>, t_max: T) -> Option<T>;

    /// Whether there is a hit within `0 < t < t_max`.
    #[inline(always)]
    fn occludes(&self, ray: &Ray<T>, t_max: T) -> bool {
        matches!(self.hit(ray, t_max), Some(t) if t < t_max)
    }

    /// The plane that all of it lies in, if it is flat.
    fn plane(&self) -> Option<FlatPlane<T>> {
        None
    }

    /// Of what is not flat: whether a point inside its bounds is so near to its surface that rounding may decide on which side.
    fn has_surface_near(&self, _: Vec3<T>) -> bool {
        true
    }

    /// [`Primitive::occludes`] for a light there, by its place and its distance.
    fn occludes_near(&self, ray: &Ray<T>, _light: Vec3<T>, distance: T) -> bool {
        self.occludes(ray, distance)
    }

    /// The point of a hit, projected back onto the surface.
    fn point(&self, ray: &Ray<T>, t: T) -> SurfacePoint<T>;
}

/// A shape that has a slice of its own in every scene.
pub(crate) trait ListedShape<T: Scalar>: Primitive<T> {
    /// The stage that draws more than one of it.
    const SEVERAL: Stages;

    /// The object in general.
    fn object(&self) -> Object<'_, T>;

    /// All of this kind.
    fn all<'a>(geometry: &Geometry<'a, T>) -> &'a [Self];

    /// Name of its type, and the arguments of its `from_parts` but the last, for baked scenes.
    #[cfg(feature = "bake")]
    fn parts(&self) -> (&'static str, [Option<Part<T>>; 6]);
}

/// An argument of `from_parts`.
#[cfg(feature = "bake")]
#[derive(Clone, Copy, Debug)]
pub(crate) enum Part<T> {
    /// A number.
    Number(T),
    /// A vector.
    Vector(Vec3<T>),
    /// Several vectors.
    Vectors([Vec3<T>; 3]),
}

impl<T: Scalar> Object<'_, T> {
    /// Material and place in the text.
    #[inline(always)]
    pub fn info(&self) -> ObjectInfo {
        of_any_shape!(self, it => Primitive::<T>::info(it))
    }

    /// Its kind.
    pub fn kind(&self) -> Kind {
        self.shape().kind()
    }

    /// What describes it.
    pub fn shape(&self) -> Shape<T> {
        of_any_shape!(self, it => Primitive::<T>::shape(it))
    }

    /// The lowest and the highest coordinates of what rays can hit; `None` if it is unbounded.
    pub fn bounding_box(&self) -> Option<[Vec3<T>; 2]> {
        of_any_shape!(self, it => Primitive::<T>::bounding_box(it))
    }

    /// Whether a ray that leaves it cannot hit it again.
    pub(crate) fn is_flat(&self) -> bool {
        fn is_flat<T: Scalar, P: Primitive<T>>(_: &P) -> bool {
            P::IS_FLAT
        }
        of_any_shape!(self, it => is_flat::<T, _>(it))
    }

    /// Whether a light is so near to its surface that rounding may decide on which side.
    pub(crate) fn is_near(&self, light: Vec3<T>) -> bool {
        of_any_shape!(self, it => light_on_surface::is_near(it, light))
    }

    /// Whether it has a bounding box.
    pub(crate) fn is_bounded(&self) -> bool {
        self.bounding_box().is_some()
    }

    /// A sphere around it; `None` if it is unbounded, or as good as that.
    pub fn bounding_sphere(&self) -> Option<BoundingSphere<T>> {
        of_any_shape!(self, it => Primitive::<T>::bounding_sphere(it))
    }
}

/// What belongs to an object besides its geometry.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ObjectInfo {
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
#[non_exhaustive]
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
    /// The triangle is so small that products of its sides lose digits ([`Triangle::smallest`]).
    TooSmall,
    /// A coordinate is so large that products are infinite ([`Triangle::largest`]).
    TooLarge,
}

impl fmt::Display for ShapeError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::RadiusNotPositive => "a radius must be greater than 0",
            Self::RadiusTooLarge => "the square of a radius must be finite",
            Self::NormalZero => "a normal must have a length",
            Self::DistanceTooLarge => {
                "a plane's distance divided by the length of its normal must be finite"
            }
            Self::NoArea => "a triangle must have an area",
            Self::TooSmall => {
                "a triangle must not be so small that products of its sides lose digits"
            }
            Self::TooLarge => "a triangle's coordinates must have finite products",
        })
    }
}

impl core::error::Error for ShapeError {}

/// The larger of the absolute coordinates of a point.
fn extent<T: Scalar>(point: Vec3<T>) -> T {
    point.abs().max_component()
}
