//! What the tracer does for a picture.

use std::ops::{Add, Range};

use rayon::prelude::*;
use scanray::{
    Color, Ray, Scalar, Scene, Vec3,
    shape::Object,
    tracer::{Intersection, LightAtHit, Observer, RayKind, TestKind},
};

use crate::parallel_drawing::Workers;

macro_rules! work {
    ($($(#[$doc:meta])* $name:ident,)*) => {
        /// What the tracer does, counted: what a picture's cost is made of.
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
        pub struct Work {
            $($(#[$doc])* pub $name: u64,)*
        }

        impl Work {
            /// Everything that is counted, by its name.
            pub fn counts(&self) -> Vec<(&'static str, u64)> {
                vec![$((stringify!($name), self.$name)),*]
            }
        }

        impl Add for Work {
            type Output = Self;

            fn add(self, other: Self) -> Self {
                Self { $($name: self.$name + other.$name,)* }
            }
        }
    };
}

work! {
    /// Pixels of the picture, whether traced or repeated in a block.
    pixels,
    /// Pixels that repeat the colour of another in a block.
    repeated_pixels,
    /// Pixels whose colour a block repeats.
    block_pixels,
    /// Pixels whose colour dither rounds.
    dithered_pixels,
    /// Rays from the camera.
    primary_rays,
    /// Mirror rays.
    reflected_rays,
    /// Rays that pass a surface.
    refracted_rays,
    /// Rays towards lights.
    shadow_rays,
    /// Tests of a ray against a sphere.
    sphere_tests,
    /// Tests against a plane.
    plane_tests,
    /// Tests against a triangle.
    triangle_tests,
    /// Tests against the boxes of the tree of a large scene.
    box_tests,
    /// Tests against spheres that no look in integers decides: what a core without hardware for floats tests exactly.
    exact_sphere_tests,
    /// The same for the balls of triangles.
    exact_ball_tests,
    /// Tests against planes whose normal is not along an axis.
    slanted_plane_tests,
    /// Tests against planes that lie ahead: they take a division.
    plane_divisions,
    /// Tests against spheres of a scene with several: they pass a loop.
    sphere_tests_in_loops,
    /// The same for planes.
    plane_tests_in_loops,
    /// The same for triangles.
    triangle_tests_in_loops,
    /// Tests against spheres that the ray's line crosses: they take a root.
    sphere_crossings,
    /// Tests against triangles whose bounding ball the ray's line crosses: they take the exact test.
    bounds_crossings,
    /// Rays that hit a sphere first, shadow rays left out.
    sphere_hits,
    /// The same for planes.
    plane_hits,
    /// The same for triangles.
    triangle_hits,
    /// Hits on planes and triangles whose normal is not along an axis.
    slanted_hits,
    /// Hits on materials that bend rays.
    bending_hits,
    /// Hits on materials of an ambient colour that is not grey.
    colored_hits,
    /// Rays that hit nothing but the sky, shadow rays left out.
    sky_rays,
    /// Lights that stand behind the surface of a hit.
    lights_behind,
    /// Lights that reach a hit.
    lit,
    /// Of these, those that reach a diffuse colour that is not grey.
    colored_lit,
    /// Lights that reach a hit whose material has highlights.
    lit_glossy,
    /// Lights that show a highlight.
    highlights,
    /// Objects that are looked at for a row of samples: whether its rays can hit them.
    row_checks,
    /// Rays, shadow rays left out, of a scene with planes: they pass code that is larger.
    rays_among_planes,
    /// Rays, shadow rays left out, of a scene with triangles: they pass code that is larger.
    rays_among_triangles,
    /// Shadow rays of such a scene.
    shadow_rays_among_triangles,
    /// Rays, shadow rays left out, that walk a tree.
    bvh_rays,
    /// Shadow rays that walk a tree.
    bvh_shadow_rays,
    /// Samples that are added up.
    added_samples,
    /// Pixels that are compared with their neighbours.
    compared_pixels,
    /// Rays, shadow rays left out, of pictures whose pixels are compared: they take more than others.
    compared_rays,
    /// Tests of such pictures.
    compared_tests,
    /// Rays, shadow rays left out, of such pictures of scenes with triangles.
    compared_rays_among_triangles,
    /// Hits in scenes with surfaces that reflect or refract: whether this one does is looked at.
    branching_hits,
    /// Hits of pictures with a cut-off: whether their secondary rays show is looked at.
    cutoff_hits,
}

/// What a picture's work does not tell by itself.
#[derive(Clone, Copy, Debug)]
pub struct Circumstances {
    /// Rows of samples that were begun.
    pub scanlines: u64,
    /// Spheres, planes and triangles of the scene.
    pub objects: [u64; 3],
    /// Whether rays that hit nothing see a gradient.
    pub has_sky: bool,
    /// Whether there are secondary rays, if the depth allows it.
    pub has_branches: bool,
    /// Whether rays are cut off.
    pub has_cutoff: bool,
    /// Pixels side by side in a block of one colour.
    pub block: u64,
    /// Samples a pixel, or those of the pixels that differ from a neighbour.
    pub samples: u64,
    /// Whether pixels are compared with their neighbours.
    pub is_adaptive: bool,
}

impl Circumstances {
    /// Of a picture of a scene, begun by as many rows of samples.
    pub fn of<T: Scalar>(scene: &Scene<'_, T>, scanlines: u64) -> Self {
        Self {
            scanlines,
            objects: [
                scene.spheres().len() as u64,
                scene.planes().len() as u64,
                scene.triangles().len() as u64,
            ],
            has_sky: scene.background().sky,
            has_branches: scene.materials().iter().any(|material| {
                let of = material.description();
                of.reflection > T::ZERO || of.refraction > T::ZERO
            }),
            has_cutoff: false,
            block: 1,
            samples: 1,
            is_adaptive: false,
        }
    }
}

impl Work {
    /// Counts what rows of a picture take: `trace` traces one, watched.
    pub fn count<T: Scalar>(
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

    /// One of [`Work::counts`].
    pub fn count_of(&self, name: &str) -> Option<u64> {
        let counts = self.counts();
        counts.iter().find(|(n, _)| *n == name).map(|(_, c)| *c)
    }

    /// The same, with what follows from the circumstances.
    pub fn under(self, circumstances: &Circumstances) -> Self {
        let Circumstances {
            scanlines,
            objects,
            has_sky,
            has_branches,
            has_cutoff,
            block,
            samples,
            is_adaptive,
        } = *circumstances;
        let rays = self.primary_rays + self.reflected_rays + self.refracted_rays;
        let hits = self.sphere_hits + self.plane_hits + self.triangle_hits;
        let has_bvh = self.box_tests > 0;
        let [spheres, planes, triangles] = objects;
        let has_triangles = triangles > 0;
        let if_so = |so: bool, count: u64| if so { count } else { 0 };
        Self {
            repeated_pixels: if_so(block > 1, self.pixels.saturating_sub(self.primary_rays)),
            block_pixels: if_so(block > 1, self.primary_rays),
            sphere_tests_in_loops: if_so(spheres > 1, self.sphere_tests),
            plane_tests_in_loops: if_so(planes > 1, self.plane_tests),
            triangle_tests_in_loops: if_so(triangles > 1, self.triangle_tests),
            sky_rays: if_so(has_sky, rays.saturating_sub(hits)),
            row_checks: scanlines * objects.iter().sum::<u64>(),
            rays_among_planes: if_so(planes > 0, rays),
            rays_among_triangles: if_so(has_triangles && !has_bvh, rays),
            shadow_rays_among_triangles: if_so(has_triangles && !has_bvh, self.shadow_rays),
            bvh_rays: if_so(has_bvh, rays),
            bvh_shadow_rays: if_so(has_bvh, self.shadow_rays),
            added_samples: if_so(samples > 1, self.primary_rays),
            compared_pixels: if_so(is_adaptive, self.pixels),
            compared_rays: if_so(is_adaptive, rays),
            compared_tests: if_so(is_adaptive, self.tests()),
            compared_rays_among_triangles: if_so(is_adaptive && has_triangles, rays),
            branching_hits: if_so(has_branches, hits),
            cutoff_hits: if_so(has_cutoff, hits),
            ..self
        }
    }

    /// The same, shown with dither or without.
    pub fn shown(self, is_dithered: bool) -> Self {
        Self {
            dithered_pixels: if is_dithered { self.pixels } else { 0 },
            ..self
        }
    }

    /// Rays of all kinds.
    pub fn rays(&self) -> u64 {
        self.primary_rays + self.reflected_rays + self.refracted_rays + self.shadow_rays
    }

    /// Tests of all kinds.
    pub fn tests(&self) -> u64 {
        self.sphere_tests + self.plane_tests + self.triangle_tests + self.box_tests
    }
}

/// Counts while the tracer works.
#[derive(Debug)]
pub struct Counter<T> {
    work: Work,
    /// The ray under way, shadow rays aside: the distance of the closest intersection so far, and its shape.
    closest: Option<(T, Shape)>,
    /// What of the material of the hit under way decides about the cost of light.
    lighting: Lighting,
}

#[derive(Clone, Copy, Debug, Default)]
struct Lighting {
    is_colored: bool,
    is_glossy: bool,
}

#[derive(Clone, Copy, Debug)]
enum Shape {
    Sphere,
    Plane,
    Triangle,
}

impl<T: Scalar> Default for Counter<T> {
    fn default() -> Self {
        Self::new()
    }
}

impl<T: Scalar> Counter<T> {
    /// Nothing is counted yet.
    pub fn new() -> Self {
        Self {
            work: Work::default(),
            closest: None,
            lighting: Lighting::default(),
        }
    }

    /// What was counted for as many pixels.
    pub fn finish(self, pixels: u64) -> Work {
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
                work.exact_sphere_tests += u64::from(!sphere.quick_reject(ray));
                let crosses = crosses(ray, sphere.center(), sphere.radius_squared());
                work.sphere_crossings += u64::from(crosses);
                (Shape::Sphere, sphere.intersect(ray, t_max))
            }
            Object::Plane(plane) => {
                work.plane_tests += 1;
                let normal = plane.normal();
                work.slanted_plane_tests += u64::from(!is_along_an_axis(normal));
                let below = plane.height() - normal.dot(ray.origin);
                let slope = normal.dot(ray.direction);
                work.plane_divisions += u64::from((below < T::ZERO) == (slope < T::ZERO));
                (Shape::Plane, plane.intersect(ray, t_max))
            }
            Object::Triangle(triangle) => {
                work.triangle_tests += 1;
                work.exact_ball_tests += u64::from(!triangle.quick_reject(ray));
                let (center, squared) =
                    (triangle.bounds_center(), triangle.bounds_radius_squared());
                work.bounds_crossings += u64::from(crosses(ray, center, squared));
                let t = triangle.intersect(ray, t_max).map(|(t, _)| t);
                (Shape::Triangle, t)
            }
            // The model knows no others.
            _ => return,
        };
        if let Some(t) = t
            && self.closest.is_none_or(|(closest, _)| t <= closest)
        {
            self.closest = Some((t, shape));
        }
    }

    fn intersection(&mut self, intersection: &Intersection<'_, T>) {
        let material = intersection.material;
        let bends = material.refraction > T::ZERO && material.index_of_refraction != T::ONE;
        self.work.bending_hits += u64::from(bends);
        self.work.colored_hits += u64::from(!is_grey(material.ambient));
        self.lighting = Lighting {
            is_colored: !is_grey(material.diffuse),
            is_glossy: !is_black(material.specular),
        };
        if !matches!(self.closest, Some((_, Shape::Sphere))) {
            self.work.slanted_hits += u64::from(!is_along_an_axis(intersection.normal));
        }
        match self.closest {
            Some((_, Shape::Sphere)) => self.work.sphere_hits += 1,
            Some((_, Shape::Plane)) => self.work.plane_hits += 1,
            Some((_, Shape::Triangle)) => self.work.triangle_hits += 1,
            None => {}
        }
    }

    fn light(&mut self, light: LightAtHit<T>) {
        let (work, lighting) = (&mut self.work, self.lighting);
        match light {
            LightAtHit::Behind => work.lights_behind += 1,
            LightAtHit::Reaches { specular, .. } => {
                work.lit += 1;
                work.colored_lit += u64::from(lighting.is_colored);
                work.lit_glossy += u64::from(lighting.is_glossy);
                work.highlights += u64::from(specular.is_some());
            }
            LightAtHit::Enclosed | LightAtHit::Blocked => {}
        }
    }
}

/// Whether a vector of length 1 is a direction of an axis.
fn is_along_an_axis<T: Scalar>(unit: Vec3<T>) -> bool {
    [unit.x, unit.y, unit.z]
        .iter()
        .filter(|component| **component == T::ZERO)
        .count()
        == 2
}

fn is_grey<T: Scalar>(color: Color<T>) -> bool {
    color.r == color.g && color.r == color.b
}

fn is_black<T: Scalar>(color: Color<T>) -> bool {
    is_grey(color) && color.r == T::ZERO
}

/// Whether a ray's line passes a point within a distance.
fn crosses<T: Scalar>(ray: &Ray<T>, center: Vec3<T>, distance_squared: T) -> bool {
    let f = center - ray.origin;
    let across = f - ray.direction * f.dot(ray.direction);
    across.dot(across) <= distance_squared
}
