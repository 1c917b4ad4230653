//! The textbook's forms, for comparison: what most ray tracers do, and what fails in stiff scenes.
//!
//! The sphere's discriminant is the difference of two squares, `b² − (f·f − r²)`; triangles are met by
//! Möller and Trumbore's test with an absolute bound of 1e-8 on the determinant; hits are `origin + t·d`,
//! not projected back; new rays are told from their own surface by a fixed least distance; refraction decides by
//! `1 − η²(1 − c²)`. Colour, light and recursion are the same as in the core.
//!
//! Between the two stands [`Textbook::with_robust_shapes`]: the core's forms, but new rays that start a fixed distance above
//! the surface.

use scanray::formula::shading::power;
use scanray::{
    Background, Color, Material, MaterialDescription, Ray, Scalar, Scene, Vec3, real::Real,
    shape::Object,
};

/// A ray tracer of textbook forms.
#[derive(Clone, Copy, Debug)]
pub struct Textbook<'a, T> {
    scene: Scene<'a, T>,
    max_depth: usize,
    least_distance: T,
    has_robust_shapes: bool,
}

/// The least distance of a hit, or the distance above the surface where new rays start, in the units of the scene.
pub const EPSILON: f64 = 1e-3;

/// What tracing took.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Effort {
    /// Rays of all kinds.
    pub rays: u64,
    /// Tests of a ray against an object: every ray is tested against all.
    pub tests: u64,
}

struct Hit<'a, T> {
    t: T,
    point: Vec3<T>,
    normal: Vec3<T>,
    material: &'a Material<T>,
}

impl<'a, T: Scalar> Hit<'a, T> {
    /// The refracted direction; `None` at total reflection.
    fn refracted(
        &self,
        direction: Vec3<T>,
        normal: Vec3<T>,
        entering: bool,
        is_robust: bool,
    ) -> Option<Vec3<T>> {
        let index = self.material.description().index_of_refraction;
        if is_robust {
            let interface = if entering {
                self.material.entering()
            } else {
                self.material.leaving()
            };
            return direction.refract(normal, interface.eta, interface.bend);
        }
        refract(
            direction,
            normal,
            if entering { T::ONE / index } else { index },
        )
    }
}

impl<'a, T: Scalar> Textbook<'a, T> {
    /// A tracer with the usual fixed least distance.
    pub fn new(scene: Scene<'a, T>, max_depth: usize) -> Self {
        Self {
            scene,
            max_depth,
            least_distance: T::from_f64(EPSILON),
            has_robust_shapes: false,
        }
    }

    /// The same tracer with the core's forms, whose hits are projected back onto their surface: of the textbook's there
    /// remains the fixed distance, at which new rays start above the surface.
    pub fn with_robust_shapes(self) -> Self {
        Self {
            has_robust_shapes: true,
            ..self
        }
    }

    /// The colour that a ray sees.
    pub fn radiance(&self, ray: &Ray<T>) -> Color<T> {
        self.radiance_counted(ray, &mut Effort::default())
    }

    /// The same; what it takes is added to `effort`.
    pub fn radiance_counted(&self, ray: &Ray<T>, effort: &mut Effort) -> Color<T> {
        self.radiance_at(ray, 0, effort)
    }

    fn count(&self, effort: &mut Effort) {
        effort.rays += 1;
        effort.tests += self.scene.object_count() as u64;
    }

    fn radiance_at(&self, ray: &Ray<T>, depth: usize, effort: &mut Effort) -> Color<T> {
        self.count(effort);
        let Some(hit) = self.nearest(ray) else {
            let background = &self.scene.background();
            return if background.sky {
                Background::sky(ray.direction)
            } else {
                background.color.clamp()
            };
        };
        let material = hit.material.description();
        let entering = hit.normal.dot(ray.direction) <= T::ZERO;
        let normal = if entering { hit.normal } else { -hit.normal };
        let step = if self.has_robust_shapes {
            normal * self.least_distance
        } else {
            normal * T::ZERO
        };
        let (outside, inside) = (hit.point + step, hit.point - step);
        let mut color = self.local_color(outside, normal, ray.direction, hit.material, effort);
        if depth < self.max_depth {
            let cosine = -normal.dot(ray.direction);
            if material.reflection > T::ZERO {
                let mirrored = if self.has_robust_shapes {
                    ray.direction.reflect(normal)
                } else {
                    ray.direction + normal * (T::TWO * cosine)
                };
                let seen = self.radiance_at(&Ray::new(outside, mirrored), depth + 1, effort);
                color = color + seen * material.reflection;
            }
            if material.refraction > T::ZERO
                && let Some(refracted) =
                    hit.refracted(ray.direction, normal, entering, self.has_robust_shapes)
            {
                let seen = self.radiance_at(&Ray::new(inside, refracted), depth + 1, effort);
                color = color + seen * material.refraction;
            }
        }
        color.clamp()
    }

    fn local_color(
        &self,
        point: Vec3<T>,
        normal: Vec3<T>,
        direction: Vec3<T>,
        material: &Material<T>,
        effort: &mut Effort,
    ) -> Color<T> {
        let whole_shininess = material.whole_shininess();
        let material: &MaterialDescription<T> = material.description();
        let mut color = material.ambient * self.scene.ambient();
        for light in self.scene.lights() {
            let to_light = light.position - point;
            let distance = to_light.dot(to_light).sqrt();
            let to_light = to_light * (T::ONE / distance);
            let cosine = normal.dot(to_light);
            if !(cosine > T::ZERO) {
                continue;
            }
            self.count(effort);
            if self.occluded(&Ray::new(point, to_light), distance) {
                continue;
            }
            color = color + light.diffuse * cosine * material.diffuse;
            let mirrored = normal * (T::TWO * cosine) - to_light;
            let alignment = -mirrored.dot(direction);
            if alignment > T::ZERO {
                let base = if alignment < T::ONE {
                    alignment
                } else {
                    T::ONE
                };
                let is_whole = whole_shininess != Material::<T>::FRACTIONAL;
                let power = if self.has_robust_shapes && is_whole {
                    power(Real(base), whole_shininess).0
                } else {
                    base.powf(material.shininess)
                };
                color = color + light.specular * power * material.specular;
            }
        }
        color
    }

    /// The distances and normals of all crossings in front of the ray, but for those that are too near.
    fn crossings(&self, ray: &Ray<T>) -> impl Iterator<Item = Hit<'a, T>> {
        let (scene, ray, least) = (self.scene, *ray, self.least_distance);
        let material = move |index: u32| &scene.materials()[index as usize];
        let spheres = scene.spheres().iter().filter_map(move |s| {
            let t = sphere(s.center(), s.radius(), &ray, least)?;
            let point = ray.at(t);
            Some(Hit {
                t,
                point,
                normal: (point - s.center()).normalize(),
                material: material(s.info().material),
            })
        });
        let planes = scene.planes().iter().filter_map(move |p| {
            let t = (p.height() - p.normal().dot(ray.origin)) / p.normal().dot(ray.direction);
            (t > least && t.is_finite()).then(|| Hit {
                t,
                point: ray.at(t),
                normal: p.normal(),
                material: material(p.info().material),
            })
        });
        let triangles = scene.triangles().iter().filter_map(move |triangle| {
            let t = triangle_crossing(triangle.vertices(), &ray)?;
            (t > least).then(|| Hit {
                t,
                point: ray.at(t),
                normal: triangle.normal(),
                material: material(triangle.info().material),
            })
        });
        spheres.chain(planes).chain(triangles)
    }

    /// The same by the core's forms.
    fn robust_crossings(&self, ray: &Ray<T>) -> impl Iterator<Item = Hit<'a, T>> {
        let (scene, ray) = (self.scene, *ray);
        scene.objects().filter_map(move |object| {
            let (t, place) = match object {
                Object::Sphere(sphere) => {
                    let t = sphere.intersect(&ray, T::MAX)?;
                    (t, sphere.surface_point(&ray, t))
                }
                Object::Plane(plane) => {
                    let t = plane.intersect(&ray, T::MAX)?;
                    (t, plane.surface_point(&ray, t))
                }
                Object::Triangle(triangle) => {
                    let t = triangle.intersect(&ray, T::MAX)?;
                    (t, triangle.surface_point(&ray, t))
                }
                _ => return None,
            };
            Some(Hit {
                t,
                point: place.point,
                normal: place.normal,
                material: &scene.materials()[object.info().material as usize],
            })
        })
    }

    fn nearest(&self, ray: &Ray<T>) -> Option<Hit<'a, T>> {
        let nearer =
            |nearest: Hit<'a, T>, hit: Hit<'a, T>| if hit.t < nearest.t { hit } else { nearest };
        if self.has_robust_shapes {
            self.robust_crossings(ray).reduce(nearer)
        } else {
            self.crossings(ray).reduce(nearer)
        }
    }

    fn occluded(&self, ray: &Ray<T>, distance: T) -> bool {
        let occludes = |hit: Hit<'a, T>| hit.t < distance && hit.material.casts_shadow();
        if self.has_robust_shapes {
            self.robust_crossings(ray).any(occludes)
        } else {
            self.crossings(ray).any(occludes)
        }
    }
}

/// The first crossing with a sphere beyond a least distance, by the difference of two squares.
pub fn sphere<T: Scalar>(center: Vec3<T>, radius: T, ray: &Ray<T>, least: T) -> Option<T> {
    let f = center - ray.origin;
    let b = f.dot(ray.direction);
    let discriminant = b * b - (f.dot(f) - radius * radius);
    if !(discriminant >= T::ZERO) {
        return None;
    }
    let root = discriminant.sqrt();
    [b - root, b + root].into_iter().find(|t| *t > least)
}

/// The crossing with a triangle: Möller and Trumbore, "Fast, minimum storage ray/triangle intersection",
/// Journal of Graphics Tools 2(1), 1997.
pub fn triangle_crossing<T: Scalar>(vertices: [Vec3<T>; 3], ray: &Ray<T>) -> Option<T> {
    let [v1, v2, v3] = vertices;
    let (e2, e3) = (v2 - v1, v3 - v1);
    let p = ray.direction.cross(e3);
    let determinant = e2.dot(p);
    if !(determinant.abs() > T::from_f64(1e-8)) {
        return None;
    }
    let inverse = T::ONE / determinant;
    let s = ray.origin - v1;
    let u = s.dot(p) * inverse;
    let q = s.cross(e2);
    let v = ray.direction.dot(q) * inverse;
    let is_inside = u >= T::ZERO && v >= T::ZERO && u + v <= T::ONE;
    let t = e3.dot(q) * inverse;
    (is_inside && t > T::ZERO).then_some(t)
}

/// The refracted direction; `None` at total reflection.
pub fn refract<T: Scalar>(direction: Vec3<T>, normal: Vec3<T>, eta: T) -> Option<Vec3<T>> {
    let cosine = -direction.dot(normal);
    let k = T::ONE - eta * eta * (T::ONE - cosine * cosine);
    (k >= T::ZERO).then(|| direction * eta + normal * (eta * cosine - k.sqrt()))
}
