//! The rays of a pixel and what they hit, as the tracer tells an observer.

mod json;
mod text;

pub(crate) use json::{PixelHeader, PixelReport, Samples};
pub(crate) use text::{Names, color_digits, write_rays};

use scanray::{
    Color, Material, MaterialDescription, Ray, Scalar, Vec3,
    ray::ObjectNumber,
    shape::Object,
    tracer::{Intersection, LightAtHit, Observer, RayKind},
};

/// A ray, what it hit and the colour it sees.
#[derive(Clone, Debug)]
pub(crate) struct RayNode<T> {
    kind: RayKind,
    depth: usize,
    ray: Ray<T>,
    /// What its colour is multiplied with at the hit that cast it; 1 for a ray from the camera.
    weight: T,
    /// `None` for the background.
    hit: Option<HitNode<T>>,
    /// The colour it sees, clamped.
    result: Color<T>,
}

/// An intersection with an object.
#[derive(Clone, Debug)]
struct HitNode<T> {
    object: ObjectNumber,
    /// The ray hits the side that the geometric normal points to.
    front: bool,
    /// Distance along the ray.
    t: T,
    /// The point, projected back onto the surface.
    point: Vec3<T>,
    /// Unit normal on the ray's side.
    normal: Vec3<T>,
    material: MaterialDescription<T>,
    lights: Vec<LightNode<T>>,
    /// Ambient light and what comes from the lights, not clamped.
    local: Color<T>,
    /// Mirrored, then refracted.
    secondary: Vec<RayNode<T>>,
}

/// A light as a hit sees it.
#[derive(Clone, Debug)]
struct LightNode<T> {
    at_hit: LightAtHit<T>,
    /// Cast if the light does not stand behind the surface.
    shadow_ray: Option<Ray<T>>,
    /// What keeps it away.
    blocker: Option<ObjectNumber>,
}

/// Collects the rays of a pixel.
///
/// Invariant: between two rays of the tracer `open` holds the rays from the camera's down to the one under
/// way, each a secondary ray of the one before.
#[derive(Clone, Debug)]
pub(crate) struct RayTree<T> {
    open: Vec<RayNode<T>>,
    shadow_ray: Option<Ray<T>>,
    /// The object that was tested last.
    tested: Option<ObjectNumber>,
    /// The rays from the camera.
    primary: Vec<RayNode<T>>,
}

impl<T: Scalar> RayTree<T> {
    /// No rays yet.
    pub(crate) fn new() -> Self {
        Self {
            open: Vec::new(),
            shadow_ray: None,
            tested: None,
            primary: Vec::new(),
        }
    }

    /// The rays from the camera.
    pub(crate) fn into_primary_rays(self) -> Vec<RayNode<T>> {
        self.primary
    }

    fn hit(&mut self) -> Option<&mut HitNode<T>> {
        self.open.last_mut()?.hit.as_mut()
    }
}

impl<T: Scalar> Observer<T> for RayTree<T> {
    fn ray(&mut self, kind: RayKind, depth: usize, ray: &Ray<T>) {
        if kind == RayKind::Shadow {
            self.shadow_ray = Some(*ray);
            return;
        }
        let weight = match (kind, self.hit()) {
            (RayKind::Reflected, Some(hit)) => hit.material.reflection,
            (RayKind::Refracted, Some(hit)) => hit.material.refraction,
            _ => T::ONE,
        };
        self.open.push(RayNode {
            kind,
            depth,
            ray: *ray,
            weight,
            hit: None,
            result: Color::BLACK,
        });
    }

    fn test_object(&mut self, object: Object<'_, T>, _: &Ray<T>, _: T) {
        self.tested = Some(object.info().number);
    }

    fn intersection(&mut self, intersection: &Intersection<'_, T>) {
        if let Some(node) = self.open.last_mut() {
            node.hit = Some(HitNode {
                object: intersection.number,
                front: intersection.side.is_front(),
                t: intersection.t,
                point: intersection.point,
                normal: intersection.normal,
                material: *intersection.material,
                lights: Vec::new(),
                local: Color::BLACK,
                secondary: Vec::new(),
            });
        }
    }

    fn light(&mut self, light: LightAtHit<T>) {
        let shadow_ray = self.shadow_ray.take();
        let tested = self.tested;
        if let Some(hit) = self.hit() {
            let blocker = match light {
                // The shadow ray ends with the test of what it hits.
                LightAtHit::Blocked => tested,
                LightAtHit::Enclosed => Some(hit.object),
                LightAtHit::Behind | LightAtHit::Reaches { .. } => None,
            };
            hit.lights.push(LightNode {
                at_hit: light,
                shadow_ray,
                blocker,
            });
        }
    }

    fn local_color(&mut self, color: Color<T>) {
        if let Some(hit) = self.hit() {
            hit.local = color;
        }
    }

    fn result(&mut self, color: Color<T>) {
        let Some(mut node) = self.open.pop() else {
            return;
        };
        node.result = color;
        match self.hit() {
            Some(hit) => hit.secondary.push(node),
            None => self.primary.push(node),
        }
    }
}

impl<T: Scalar> RayNode<T> {
    /// Why a secondary ray that the material asks for was not cast; `None` if it was, or if the material asks
    /// for none.
    fn why_not(&self, kind: RayKind, max_depth: usize) -> Option<&'static str> {
        let hit = self.hit.as_ref()?;
        let weight = match kind {
            RayKind::Reflected => hit.material.reflection,
            _ => hit.material.refraction,
        };
        let is_cast = hit.secondary.iter().any(|ray| ray.kind == kind);
        if is_cast || !(weight > T::ZERO) {
            None
        } else if self.depth >= max_depth {
            Some("the maximum depth is reached")
        } else if kind == RayKind::Refracted && hit.reflects_totally(self.ray.direction) {
            Some("total internal reflection")
        } else {
            Some("its contribution is below the cut-off")
        }
    }
}

impl<T: Scalar> HitNode<T> {
    /// Whether no direction beyond the surface fits Snell's law.
    fn reflects_totally(&self, direction: Vec3<T>) -> bool {
        let material = Material::new(self.material);
        let interface = if self.front {
            material.entering()
        } else {
            material.leaving()
        };
        self.material.index_of_refraction != T::ONE
            && direction
                .refract(self.normal, interface.eta, interface.bend)
                .is_none()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::host_tracer::HostTracer;
    use crate::pools::HostScalar;
    use scanray::{Resolution, Scene};

    /// The colour that follows from what a node tells, by the contract of the picture.
    fn recomputed<T: Scalar>(node: &RayNode<T>, scene: &Scene<'_, T>) -> Color<T> {
        let Some(hit) = &node.hit else {
            return node.result;
        };
        let mut local = hit.material.ambient * scene.ambient();
        for light in &hit.lights {
            if let LightAtHit::Reaches { diffuse, specular } = light.at_hit {
                local = local + diffuse;
                if let Some(specular) = specular {
                    local = local + specular;
                }
            }
        }
        assert_eq!(local, hit.local);
        let mut color = local;
        for secondary in &hit.secondary {
            assert_eq!(secondary.depth, node.depth + 1);
            color = color + recomputed(secondary, scene) * secondary.weight;
        }
        color.clamp()
    }

    /// Blockers block, hits are where the rays lead, weights are the material's.
    fn check<T: Scalar>(node: &RayNode<T>, scene: &Scene<'_, T>, counts: &mut [usize; 6]) {
        counts[0] += 1;
        let Some(hit) = &node.hit else {
            counts[1] += 1;
            return;
        };
        let objects: Vec<_> = scene.objects().collect();
        let object = objects[hit.object as usize];
        assert_eq!(scene.material(object.info()), hit.material);
        assert!(!(hit.normal.dot(node.ray.direction) > T::ZERO));
        let off = hit.point - node.ray.at(hit.t);
        let length = hit.point.abs().max_component() + hit.t;
        assert!(off.abs().max_component() < T::from_f64(1e-3) * length);
        for light in &hit.lights {
            let Some(blocker) = light.blocker else {
                continue;
            };
            if light.at_hit == LightAtHit::Enclosed {
                counts[2] += 1;
                assert!(!hit.front && blocker == hit.object);
                continue;
            }
            counts[3] += 1;
            let ray = light.shadow_ray.unwrap();
            let distance = scene.lights()[0].position - ray.origin;
            let distance = distance.dot(distance).sqrt();
            assert!(match objects[blocker as usize] {
                Object::Sphere(sphere) => sphere.occludes(&ray, distance),
                Object::Plane(plane) => plane.occludes(&ray, distance),
                Object::Triangle(triangle) => triangle.occludes(&ray, distance),
                _ => unreachable!(),
            });
        }
        let at_most = usize::from(node.depth < 5);
        for kind in [RayKind::Reflected, RayKind::Refracted] {
            let cast = hit.secondary.iter().filter(|ray| ray.kind == kind).count();
            assert!(cast <= at_most);
            match node.why_not(kind, 5) {
                Some("total internal reflection") => counts[4] += 1,
                Some("the maximum depth is reached") => counts[5] += 1,
                None => {}
                Some(other) => panic!("{other}"),
            }
        }
        for secondary in &hit.secondary {
            check(secondary, scene, counts);
        }
    }

    /// The surface of water from below, which reflects totally where the look is not steep.
    const UNDER_WATER: &[u8] = b"2\n0 0 0\n64 48\n3 5 -2  1 1 1  1 1 1\n0.2\n1\n0 0 0\n\
        1  0 1 0 -0.2  .1 .1 .1  .5 .5 .5  .2 .2 .3  0.3 20 0.8 1.33\n\
        0  0 -1 4 1  .8 .2 .2  .5 .5 .5  1 1 1  0 50.5 0 0\n";

    fn trees_are_those_of_the_picture<T: HostScalar>(counts: &mut [usize; 6]) {
        for text in [
            &include_bytes!("../../../scenes/default.txt")[..],
            include_bytes!("../../../scenes/mirror-room.txt"),
            include_bytes!("../../../scenes/pyramids.txt"),
            include_bytes!("../../../scenes/reflective.txt"),
            include_bytes!("../../../scenes/window-room.txt"),
            UNDER_WATER,
        ] {
            let mut pools = T::pools();
            pools.parse(text).unwrap();
            let scene = pools.as_scene();
            let resolution = Resolution {
                width: 64,
                height: 48,
            };
            let tracer = HostTracer::new(scene, resolution, 5).unwrap();
            for (x, y) in (0..48).flat_map(|y| (0..64).map(move |x| (x, y))) {
                let mut tree = RayTree::new();
                let color = tracer.pixel_observed(x, y, &mut tree);
                assert!(tree.open.is_empty());
                let primary = tree.into_primary_rays();
                let [ray] = &primary[..] else {
                    panic!("{} primary rays", primary.len());
                };
                assert_eq!(ray.result, color);
                assert_eq!(recomputed(ray, &scene), color, "{x},{y}");
                check(ray, &scene, counts);
            }
        }
    }

    #[test]
    fn what_is_told_makes_the_picture() {
        let mut counts = [0; 6];
        trees_are_those_of_the_picture::<f32>(&mut counts);
        trees_are_those_of_the_picture::<f64>(&mut counts);
        // Rays, backgrounds, enclosed sides, shadows, total reflections, ends: each kind was there.
        assert!(counts.iter().all(|count| *count > 10), "{counts:?}");
    }
}
