//! A view into the tracer's work: counters, budgets, debugging. Without one it costs nothing.

use crate::color::Color;
use crate::material::MaterialDescription;
use crate::ray::{ObjectNumber, Ray, Side};
use crate::shape::Object;
use crate::vec3::Vec3;

/// Why a ray is cast.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RayKind {
    /// From the camera.
    Primary,
    /// From a mirroring surface.
    Reflected,
    /// Through a transparent surface.
    Refracted,
    /// Towards a light.
    Shadow,
}

/// A kind of intersection test.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum TestKind {
    /// Ray against sphere.
    Sphere,
    /// Ray against plane.
    Plane,
    /// Ray against triangle, bounding sphere included.
    Triangle,
    /// Ray against an object of any other shape.
    Other,
    /// Ray against a box of the hierarchy.
    Box,
}

/// An intersection of a ray with an object.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Intersection<'a, T> {
    /// The object's side that the ray comes from, by its index among all objects.
    pub side: Side,
    /// The object's place in the text.
    pub number: ObjectNumber,
    /// Distance along the ray.
    pub t: T,
    /// The point, projected back onto the surface.
    pub point: Vec3<T>,
    /// Unit normal on the ray's side.
    pub normal: Vec3<T>,
    /// What the object is made of.
    pub material: &'a MaterialDescription<T>,
}

/// What becomes of a light at a hit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LightAtHit<T> {
    /// It stands behind the surface, or in it.
    Behind,
    /// No light reaches the inside of the object that was hit; no ray is cast to find out.
    Enclosed,
    /// An object stands before it: the one that was tested last.
    Blocked,
    /// It adds these colours.
    Reaches {
        /// Diffuse light.
        diffuse: Color<T>,
        /// The highlight, if there is one.
        specular: Option<Color<T>>,
    },
}

/// Is told what the tracer does. Every method does nothing by default; `()` observes nothing.
pub trait Observer<T> {
    /// A ray is about to be cast. `depth` is 0 for primary rays and that of the hit for shadow rays.
    #[inline(always)]
    fn ray(&mut self, kind: RayKind, depth: usize, ray: &Ray<T>) {
        let _ = (kind, depth, ray);
    }

    /// A ray is about to be tested against an object.
    #[inline(always)]
    fn test(&mut self, kind: TestKind) {
        let _ = kind;
    }

    /// A ray is about to be tested against this object, for an intersection at most `t_max` away. Unless it does
    /// something else, it tells [`Observer::test`] of the kind.
    #[inline(always)]
    fn test_object(&mut self, object: Object<'_, T>, ray: &Ray<T>, t_max: T) {
        let _ = (ray, t_max);
        self.test(match object {
            Object::Sphere(_) => TestKind::Sphere,
            Object::Plane(_) => TestKind::Plane,
            Object::Triangle(_) => TestKind::Triangle,
            _ => TestKind::Other,
        });
    }

    /// The ray that was cast last, shadow rays aside, hits an object.
    #[inline(always)]
    fn intersection(&mut self, intersection: &Intersection<'_, T>) {
        let _ = intersection;
    }

    /// What becomes of the next light at that intersection.
    #[inline(always)]
    fn light(&mut self, light: LightAtHit<T>) {
        let _ = light;
    }

    /// The intersection's colour without secondary rays, not clamped.
    #[inline(always)]
    fn local_color(&mut self, color: Color<T>) {
        let _ = color;
    }

    /// The colour of an intersection with the shares of the secondary rays that are done, not clamped.
    #[inline(always)]
    fn sum(&mut self, color: Color<T>) {
        let _ = color;
    }

    /// The deepest ray under way sees this colour, and is done; its secondary rays were done before.
    #[inline(always)]
    fn result(&mut self, color: Color<T>) {
        let _ = color;
    }
}

impl<T> Observer<T> for () {}

/// Counts rays of all kinds: what a budget is charged with.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RayCount(pub u32);

impl<T> Observer<T> for RayCount {
    #[inline(always)]
    fn ray(&mut self, _: RayKind, _: usize, _: &Ray<T>) {
        self.0 = self.0.saturating_add(1);
    }
}

/// Counts rays and intersection tests by kind.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct WorkCount {
    /// Rays from the camera.
    pub primary_rays: u64,
    /// Mirror rays.
    pub reflected_rays: u64,
    /// Refracted rays.
    pub refracted_rays: u64,
    /// Rays towards lights.
    pub shadow_rays: u64,
    /// Tests against spheres.
    pub sphere_tests: u64,
    /// Tests against planes.
    pub plane_tests: u64,
    /// Tests against triangles.
    pub triangle_tests: u64,
    /// Tests against objects of other shapes.
    pub other_tests: u64,
    /// Tests against boxes of the hierarchy.
    pub box_tests: u64,
}

impl WorkCount {
    /// Rays of all kinds.
    pub fn rays(&self) -> u64 {
        self.primary_rays + self.reflected_rays + self.refracted_rays + self.shadow_rays
    }

    /// Tests of all kinds.
    pub fn tests(&self) -> u64 {
        self.sphere_tests
            + self.plane_tests
            + self.triangle_tests
            + self.other_tests
            + self.box_tests
    }

    /// Adds the counts of another part of the picture.
    pub fn add(&mut self, other: &Self) {
        self.primary_rays += other.primary_rays;
        self.reflected_rays += other.reflected_rays;
        self.refracted_rays += other.refracted_rays;
        self.shadow_rays += other.shadow_rays;
        self.sphere_tests += other.sphere_tests;
        self.plane_tests += other.plane_tests;
        self.triangle_tests += other.triangle_tests;
        self.other_tests += other.other_tests;
        self.box_tests += other.box_tests;
    }
}

impl<T> Observer<T> for WorkCount {
    fn ray(&mut self, kind: RayKind, _: usize, _: &Ray<T>) {
        *match kind {
            RayKind::Primary => &mut self.primary_rays,
            RayKind::Reflected => &mut self.reflected_rays,
            RayKind::Refracted => &mut self.refracted_rays,
            RayKind::Shadow => &mut self.shadow_rays,
        } += 1;
    }

    fn test(&mut self, kind: TestKind) {
        *match kind {
            TestKind::Sphere => &mut self.sphere_tests,
            TestKind::Plane => &mut self.plane_tests,
            TestKind::Triangle => &mut self.triangle_tests,
            TestKind::Other => &mut self.other_tests,
            TestKind::Box => &mut self.box_tests,
        } += 1;
    }
}
