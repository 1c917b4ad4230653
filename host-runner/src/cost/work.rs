//! What the tracer does for a picture.

use std::ops::{Add, Range};

use rayon::prelude::*;
use scanray::{
    Ray, Scalar, Vec3,
    shape::Object,
    tracer::{Intersection, Observer, RayKind, TestKind, WorkCount},
};

use crate::parallel_drawing::Workers;

/// What the tracer does, counted: what a picture's cost is made of.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Work {
    /// Pixels of the picture, whether traced or repeated in a block.
    pub pixels: u64,
    /// Pixels that are compared with their neighbours.
    pub compared_pixels: u64,
    /// Rays and tests by kind.
    pub count: WorkCount,
    /// Tests of spheres, and of triangles by their bounding spheres, that no look in integers decides: what a core without
    /// hardware for floats tests exactly.
    pub exact_tests: u64,
    /// Tests against triangles whose bounding sphere the ray's line crosses.
    pub crossed_bounds: u64,
    /// Tests against planes whose normal is not along an axis.
    pub slanted_planes: u64,
    /// Rays that hit an object, shadow rays left out.
    pub hits: u64,
}

impl Work {
    /// Counts what rows of a picture take: `trace` traces one, watched.
    pub fn count(
        width: u16,
        rows: Range<u16>,
        workers: &Workers,
        trace: impl Fn(u16, &mut Self) + Sync,
    ) -> Self {
        let count_row = |y: u16| {
            let mut work = Self::of_pixels(width.into());
            trace(y, &mut work);
            work
        };
        workers.install(|| {
            rows.into_par_iter()
                .map(count_row)
                .reduce(Self::default, Self::add)
        })
    }

    /// Nothing is counted yet but the pixels.
    pub fn of_pixels(pixels: u64) -> Self {
        Self {
            pixels,
            ..Self::default()
        }
    }

    /// The same, if pixels are compared with their neighbours: each is.
    pub fn compared(self, is_adaptive: bool) -> Self {
        Self {
            compared_pixels: if is_adaptive { self.pixels } else { 0 },
            ..self
        }
    }

    /// The terms of the instruction model, by name.
    pub fn terms(&self) -> [(&'static str, u64); 12] {
        let count = &self.count;
        let secondary_rays = count.reflected_rays + count.refracted_rays;
        let has_bvh = count.box_tests > 0;
        [
            ("pixels", self.pixels),
            // On a core with hardware for floats the loop over samples takes more than a ray that hits nothing.
            (
                "extra_samples",
                count.primary_rays.saturating_sub(self.pixels),
            ),
            ("compared_pixels", self.compared_pixels),
            ("primary_rays", count.primary_rays),
            ("secondary_rays", secondary_rays),
            ("hits", self.hits),
            ("object_tests", count.tests() - count.box_tests),
            ("exact_tests", self.exact_tests),
            ("crossed_bounds", self.crossed_bounds),
            ("slanted_planes", self.slanted_planes),
            ("box_tests", count.box_tests),
            (
                "rays_through_bvh",
                u64::from(has_bvh) * (count.primary_rays + secondary_rays),
            ),
        ]
    }
}

impl Add for Work {
    type Output = Self;

    fn add(mut self, other: Self) -> Self {
        self.count.add(&other.count);
        Self {
            pixels: self.pixels + other.pixels,
            compared_pixels: self.compared_pixels + other.compared_pixels,
            count: self.count,
            exact_tests: self.exact_tests + other.exact_tests,
            crossed_bounds: self.crossed_bounds + other.crossed_bounds,
            slanted_planes: self.slanted_planes + other.slanted_planes,
            hits: self.hits + other.hits,
        }
    }
}

impl<T: Scalar> Observer<T> for Work {
    fn ray(&mut self, kind: RayKind, depth: usize, ray: &Ray<T>) {
        self.count.ray(kind, depth, ray);
    }

    fn test(&mut self, kind: TestKind) {
        Observer::<T>::test(&mut self.count, kind);
    }

    fn test_object(&mut self, object: Object<'_, T>, ray: &Ray<T>, t_max: T) {
        self.count.test_object(object, ray, t_max);
        match object {
            Object::Sphere(sphere) => {
                self.exact_tests += u64::from(!sphere.quick_reject(ray));
            }
            Object::Plane(plane) => {
                self.slanted_planes += u64::from(!is_along_an_axis(plane.normal()));
            }
            Object::Triangle(triangle) => {
                self.exact_tests += u64::from(!triangle.quick_reject(ray));
                let to_center = triangle.bounds_center() - ray.origin;
                let across = to_center - ray.direction * to_center.dot(ray.direction);
                let is_crossed = across.dot(across) <= triangle.bounds_radius_squared();
                self.crossed_bounds += u64::from(is_crossed);
            }
            // The model knows no others.
            _ => {}
        }
    }

    fn intersection(&mut self, _: &Intersection<'_, T>) {
        self.hits += 1;
    }
}

/// Whether a vector of length 1 is a direction of an axis.
fn is_along_an_axis<T: Scalar>(unit: Vec3<T>) -> bool {
    let zeros = [unit.x, unit.y, unit.z].map(|component| u8::from(component == T::ZERO));
    zeros.iter().sum::<u8>() == 2
}
