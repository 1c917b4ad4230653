//! What the tracer does for a picture.

use std::ops::{Add, Range};

use rayon::prelude::*;
use scanray::{LightAtHit, Meeting, Object, Observer, Ray, RayKind, Scalar, TestKind, Vec3};

use crate::drawing::Workers;

/// What the tracer does, counted: what a picture's cost is made of.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Work {
    pub(crate) pixels: u64,
    /// Rays from the camera.
    pub(crate) primary_rays: u64,
    /// Mirror rays.
    pub(crate) reflected_rays: u64,
    pub(crate) refracted_rays: u64,
    /// Rays towards lights.
    pub(crate) shadow_rays: u64,
    pub(crate) sphere_tests: u64,
    pub(crate) plane_tests: u64,
    pub(crate) triangle_tests: u64,
    /// Tests against the boxes of the tree of a large scene.
    pub(crate) box_tests: u64,
    /// Tests against spheres that the ray's line crosses: they take a root.
    pub(crate) sphere_crossings: u64,
    /// Tests against triangles whose bounding ball the ray's line crosses: they take the exact test.
    pub(crate) ball_crossings: u64,
    /// Rays that meet a sphere first, shadow rays left out.
    pub(crate) sphere_hits: u64,
    pub(crate) plane_hits: u64,
    pub(crate) triangle_hits: u64,
    /// Of these, those on materials that bend rays.
    pub(crate) bending_hits: u64,
    /// Lights that reach a hit.
    pub(crate) lit: u64,
    /// Lights that show a highlight.
    pub(crate) highlights: u64,
}

impl Work {
    /// Counts what rows of a picture take: `trace` traces one, watched.
    pub(crate) fn count<T: Scalar>(
        width: u16,
        rows: Range<u16>,
        workers: &Workers,
        trace: impl Fn(u16, &mut Counter<T>) + Sync,
    ) -> Self {
        let count_row = |y: u16| {
            let mut counter = Counter::new();
            trace(y, &mut counter);
            counter.finish(u64::from(width))
        };
        workers.install(|| {
            rows.into_par_iter()
                .map(count_row)
                .reduce(Self::default, Self::add)
        })
    }

    /// Everything that is counted, by its name.
    pub(crate) fn counts(&self) -> [(&'static str, u64); 17] {
        [
            ("pixels", self.pixels),
            ("primary_rays", self.primary_rays),
            ("reflected_rays", self.reflected_rays),
            ("refracted_rays", self.refracted_rays),
            ("shadow_rays", self.shadow_rays),
            ("sphere_tests", self.sphere_tests),
            ("plane_tests", self.plane_tests),
            ("triangle_tests", self.triangle_tests),
            ("box_tests", self.box_tests),
            ("sphere_crossings", self.sphere_crossings),
            ("ball_crossings", self.ball_crossings),
            ("sphere_hits", self.sphere_hits),
            ("plane_hits", self.plane_hits),
            ("triangle_hits", self.triangle_hits),
            ("bending_hits", self.bending_hits),
            ("lit", self.lit),
            ("highlights", self.highlights),
        ]
    }

    /// One of [`Work::counts`].
    pub(crate) fn count_of(&self, name: &str) -> Option<u64> {
        let counts = self.counts();
        counts.iter().find(|(n, _)| *n == name).map(|(_, c)| *c)
    }

    /// Rays of all kinds.
    pub(crate) fn rays(&self) -> u64 {
        self.primary_rays + self.reflected_rays + self.refracted_rays + self.shadow_rays
    }

    /// Tests of all kinds.
    pub(crate) fn tests(&self) -> u64 {
        self.sphere_tests + self.plane_tests + self.triangle_tests + self.box_tests
    }
}

impl Add for Work {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            pixels: self.pixels + other.pixels,
            primary_rays: self.primary_rays + other.primary_rays,
            reflected_rays: self.reflected_rays + other.reflected_rays,
            refracted_rays: self.refracted_rays + other.refracted_rays,
            shadow_rays: self.shadow_rays + other.shadow_rays,
            sphere_tests: self.sphere_tests + other.sphere_tests,
            plane_tests: self.plane_tests + other.plane_tests,
            triangle_tests: self.triangle_tests + other.triangle_tests,
            box_tests: self.box_tests + other.box_tests,
            sphere_crossings: self.sphere_crossings + other.sphere_crossings,
            ball_crossings: self.ball_crossings + other.ball_crossings,
            sphere_hits: self.sphere_hits + other.sphere_hits,
            plane_hits: self.plane_hits + other.plane_hits,
            triangle_hits: self.triangle_hits + other.triangle_hits,
            bending_hits: self.bending_hits + other.bending_hits,
            lit: self.lit + other.lit,
            highlights: self.highlights + other.highlights,
        }
    }
}

/// Counts while the tracer works.
pub(crate) struct Counter<T> {
    work: Work,
    /// The ray under way, shadow rays aside: the distance of the closest meeting so far, and its shape.
    closest: Option<(T, Shape)>,
}

#[derive(Clone, Copy)]
enum Shape {
    Sphere,
    Plane,
    Triangle,
}

impl<T: Scalar> Counter<T> {
    /// Nothing is counted yet.
    pub(crate) fn new() -> Self {
        Self {
            work: Work::default(),
            closest: None,
        }
    }

    /// What was counted for as many pixels.
    pub(crate) fn finish(self, pixels: u64) -> Work {
        Work {
            pixels,
            ..self.work
        }
    }
}

impl<T: Scalar> Observer<T> for Counter<T> {
    fn ray(&mut self, kind: RayKind, _: usize, _: &Ray<T>) {
        *match kind {
            RayKind::Primary => &mut self.work.primary_rays,
            RayKind::Reflected => &mut self.work.reflected_rays,
            RayKind::Refracted => &mut self.work.refracted_rays,
            RayKind::Shadow => &mut self.work.shadow_rays,
        } += 1;
        self.closest = None;
    }

    fn test(&mut self, kind: TestKind) {
        self.work.box_tests += u64::from(kind == TestKind::Box);
    }

    fn test_object(&mut self, object: Object<'_, T>, ray: &Ray<T>, t_max: T) {
        let work = &mut self.work;
        let (shape, t) = match object {
            Object::Sphere(sphere) => {
                work.sphere_tests += 1;
                let crosses = crosses(ray, sphere.center(), sphere.radius_squared());
                work.sphere_crossings += u64::from(crosses);
                (Shape::Sphere, sphere.intersect(ray, t_max))
            }
            Object::Plane(plane) => {
                work.plane_tests += 1;
                (Shape::Plane, plane.intersect(ray, t_max))
            }
            Object::Triangle(triangle) => {
                work.triangle_tests += 1;
                let (center, squared) = (triangle.ball_center(), triangle.ball_radius_squared());
                work.ball_crossings += u64::from(crosses(ray, center, squared));
                let t = triangle.intersect(ray, t_max).map(|(t, _)| t);
                (Shape::Triangle, t)
            }
        };
        if let Some(t) = t
            && self.closest.is_none_or(|(closest, _)| t <= closest)
        {
            self.closest = Some((t, shape));
        }
    }

    fn meeting(&mut self, meeting: &Meeting<'_, T>) {
        let material = meeting.material;
        let bends = material.refraction > T::ZERO && material.index_of_refraction != T::ONE;
        self.work.bending_hits += u64::from(bends);
        match self.closest {
            Some((_, Shape::Sphere)) => self.work.sphere_hits += 1,
            Some((_, Shape::Plane)) => self.work.plane_hits += 1,
            Some((_, Shape::Triangle)) => self.work.triangle_hits += 1,
            None => {}
        }
    }

    fn light(&mut self, light: LightAtHit<T>) {
        if let LightAtHit::Reaches { specular, .. } = light {
            self.work.lit += 1;
            self.work.highlights += u64::from(specular.is_some());
        }
    }
}

/// Whether a ray's line passes a point within a distance.
fn crosses<T: Scalar>(ray: &Ray<T>, center: Vec3<T>, distance_squared: T) -> bool {
    let f = center - ray.origin;
    let across = f - ray.direction * f.dot(ray.direction);
    across.dot(across) <= distance_squared
}
