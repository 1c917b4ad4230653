//! The textbook's forms, for comparison: what most ray tracers do, and what fails in stiff scenes.
//!
//! The sphere's discriminant is the difference of two squares, `b² − (f·f − r²)`; triangles are met by
//! Möller and Trumbore's test with an absolute bound of 1e-8 on the determinant; hits are `origin + t·d`,
//! not projected back; new rays are told from their own surface by a fixed least distance; refraction decides by
//! `1 − η²(1 − c²)`. Colour, light and recursion are the same as in the core.

use scanray::{Background, Color, Material, MaterialDescription, Ray, Scalar, Scene, Vec3};

/// A ray tracer of textbook forms.
#[derive(Clone, Copy, Debug)]
pub struct Textbook<'a, T> {
    scene: Scene<'a, T>,
    max_depth: usize,
    least_distance: T,
}

/// The least distance of a hit, in the units of the scene.
pub const EPSILON: f64 = 1e-3;

struct Hit<'a, T> {
    t: T,
    normal: Vec3<T>,
    material: &'a Material<T>,
}

impl<'a, T: Scalar> Textbook<'a, T> {
    /// A tracer with the usual fixed least distance.
    pub fn new(scene: Scene<'a, T>, max_depth: usize) -> Self {
        Self {
            scene,
            max_depth,
            least_distance: T::from_f64(EPSILON),
        }
    }

    /// The colour that a ray sees.
    pub fn radiance(&self, ray: &Ray<T>) -> Color<T> {
        self.radiance_at(ray, 0)
    }

    fn radiance_at(&self, ray: &Ray<T>, depth: usize) -> Color<T> {
        let Some(hit) = self.nearest(ray) else {
            let background = &self.scene.background;
            return if background.sky {
                Background::sky(ray.direction)
            } else {
                background.color.clamp()
            };
        };
        let material = hit.material.description();
        let point = ray.at(hit.t);
        let entering = hit.normal.dot(ray.direction) <= T::ZERO;
        let normal = if entering { hit.normal } else { -hit.normal };
        let mut color = self.local_color(point, normal, ray.direction, material);
        if depth < self.max_depth {
            let cosine = -normal.dot(ray.direction);
            if material.reflection > T::ZERO {
                let mirrored = ray.direction + normal * (T::TWO * cosine);
                let seen = self.radiance_at(&Ray::new(point, mirrored), depth + 1);
                color = color + seen * material.reflection;
            }
            if material.refraction > T::ZERO {
                let index = material.index_of_refraction;
                let eta = if entering { T::ONE / index } else { index };
                if let Some(refracted) = refract(ray.direction, normal, eta) {
                    let seen = self.radiance_at(&Ray::new(point, refracted), depth + 1);
                    color = color + seen * material.refraction;
                }
            }
        }
        color.clamp()
    }

    fn local_color(
        &self,
        point: Vec3<T>,
        normal: Vec3<T>,
        direction: Vec3<T>,
        material: &MaterialDescription<T>,
    ) -> Color<T> {
        let mut color = material.ambient * self.scene.ambient;
        for light in self.scene.lights {
            let to_light = light.position - point;
            let distance = to_light.dot(to_light).sqrt();
            let to_light = to_light * (T::ONE / distance);
            let cosine = normal.dot(to_light);
            if !(cosine > T::ZERO) || self.occluded(&Ray::new(point, to_light), distance) {
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
                let power = base.powf(material.shininess);
                color = color + light.specular * power * material.specular;
            }
        }
        color
    }

    /// The distances and normals of all crossings in front of the ray, but for those that are too near.
    fn crossings(&self, ray: &Ray<T>) -> impl Iterator<Item = Hit<'a, T>> {
        let (scene, ray, least) = (self.scene, *ray, self.least_distance);
        let material = move |index: u32| &scene.materials[index as usize];
        let spheres = scene.spheres.iter().filter_map(move |s| {
            let t = sphere(s.center(), s.radius(), &ray, least)?;
            let normal = (ray.at(t) - s.center()).normalize();
            let material = material(s.surface().material);
            Some(Hit {
                t,
                normal,
                material,
            })
        });
        let planes = scene.planes.iter().filter_map(move |p| {
            let t = (p.height() - p.normal().dot(ray.origin)) / p.normal().dot(ray.direction);
            (t > least && t.is_finite()).then(|| Hit {
                t,
                normal: p.normal(),
                material: material(p.surface().material),
            })
        });
        let triangles = scene.triangles.iter().filter_map(move |triangle| {
            let t = triangle_crossing(triangle.vertices(), &ray)?;
            (t > least).then(|| Hit {
                t,
                normal: triangle.normal(),
                material: material(triangle.surface().material),
            })
        });
        spheres.chain(planes).chain(triangles)
    }

    fn nearest(&self, ray: &Ray<T>) -> Option<Hit<'a, T>> {
        self.crossings(ray)
            .reduce(|nearest, hit| if hit.t < nearest.t { hit } else { nearest })
    }

    fn occluded(&self, ray: &Ray<T>, distance: T) -> bool {
        self.crossings(ray)
            .any(|hit| hit.t < distance && hit.material.casts_shadow())
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
