//! Shading of up to eight hits on one object, and the rays they cast.

use fearless_simd::prelude::*;
use scanray::{Material, Object, ObjectSet};

use super::batch::{Batch, Lanes};
use super::lanes::{
    Colors, Indices, Mask, Numbers, Rays, Vec3s, first_lanes, power_of_whole, powf,
};
use super::{PacketTracer, Target, shapes, splat};

/// Meetings with the surface of one object, ready for shading. `Hit` of the core.
#[derive(Clone, Copy)]
pub(super) struct Hits<S: Simd> {
    /// Unit normal on the side the ray comes from.
    pub(super) normal: Vec3s<S>,
    /// `|normal·direction|`.
    cosine: Numbers<S>,
    /// The geometric normal faces the ray.
    entering: Mask<S>,
    pub(super) outside: Vec3s<S>,
    inside: Vec3s<S>,
}

impl<S: Simd> Hits<S> {
    /// One of two numbers in each lane, by whether the ray enters.
    #[inline(always)]
    fn by_side(&self, simd: S, entering: f32, leaving: f32) -> Numbers<S> {
        let entering = Numbers::splat(simd, entering);
        self.entering
            .select(entering, Numbers::splat(simd, leaving))
    }
}

impl<const STACK: usize> PacketTracer<'_, STACK> {
    /// Finds the local colours of hits on an object and casts their secondary rays into the batch below,
    /// if there is one.
    pub(super) fn shade<S: Simd>(
        &self,
        simd: S,
        index: u32,
        batch: &mut Batch,
        lanes: &Lanes,
        below: Option<&mut Batch>,
    ) {
        simd.vectorize(
            #[inline(always)]
            || {
                let target = &self.objects[index as usize];
                let rays = batch.rays(simd, lanes);
                let Some(material) = target.material else {
                    batch
                        .color
                        .scatter(lanes, self.background(simd, rays.direction));
                    batch.forget(lanes);
                    return;
                };
                let valid = first_lanes(simd, lanes.count);
                let hits = hits(simd, target, batch, lanes, &rays);
                let color =
                    self.local_color(simd, index, target, material, batch, lanes, &rays, &hits);
                batch.color.scatter(lanes, color);

                let Some(below) = below else { return };
                let description = material.description();
                // `Tracer::mirrored`.
                if description.reflection > 0.0 {
                    let mirrored = Rays {
                        origin: hits.outside,
                        direction: rays.direction.reflect(simd, hits.normal),
                    };
                    let leaves = sides(simd, index, hits.entering);
                    below.push(&mirrored, leaves, description.reflection, lanes, valid);
                }
                // `Tracer::refracted`.
                if description.refraction > 0.0 {
                    let (direction, passes) = refracted(simd, material, &rays, &hits, valid);
                    let refracted = Rays {
                        origin: hits.inside,
                        direction,
                    };
                    let leaves = sides(simd, index, !hits.entering);
                    below.push(&refracted, leaves, description.refraction, lanes, passes);
                }
            },
        )
    }

    /// `Tracer::local_color`.
    #[inline(always)]
    #[expect(clippy::too_many_arguments)]
    fn local_color<S: Simd>(
        &self,
        simd: S,
        index: u32,
        target: &Target<'_>,
        material: &Material,
        batch: &Batch,
        of: &Lanes,
        rays: &Rays<S>,
        hits: &Hits<S>,
    ) -> Colors<S> {
        let valid = first_lanes(simd, of.count);
        let scene = self.tracer.scene();
        let description = material.description();
        let mut color = splat(simd, description.ambient * scene.ambient());
        let [front, back] = target.reach;
        let front_open = hits.entering & valid & Mask::splat(simd, !front.shadowed);
        let back_open = !hits.entering & valid & Mask::splat(simd, !back.shadowed);
        if !(front_open | back_open).any_true() {
            return color;
        }
        for (number, light) in scene.lights().iter().enumerate() {
            let to_light = Vec3s::splat(simd, light.position) - hits.outside;
            let toward = hits.normal.dot(to_light);
            let distance_squared = to_light.dot(to_light);
            let facing = toward.simd_gt(0.0) & distance_squared.simd_gt(0.0);
            let mut lit = (front_open | back_open) & facing;
            if !lit.any_true() {
                continue;
            }
            let distance = distance_squared.sqrt();
            let inverse = Numbers::splat(simd, 1.0) / distance;
            let shadow = Rays {
                origin: hits.outside,
                direction: to_light * inverse,
            };
            if self.tree.is_some() {
                // `cast_shadows` has found it out.
                lit &= batch.lit(simd, of, number);
            } else {
                for (reach, lanes) in [(front, front_open), (back, back_open)] {
                    let lanes = lanes & facing;
                    if lanes.any_true() {
                        let occluded =
                            self.occluded(simd, &shadow, index, distance, reach.occluders, lanes);
                        lit &= !(occluded & lanes);
                    }
                }
            }
            if !lit.any_true() {
                continue;
            }
            let cosine = toward * inverse;
            let diffuse = splat(simd, light.diffuse) * cosine;
            let diffuse = color + diffuse.tint(splat(simd, description.diffuse));
            color = Vec3s::select(lit, diffuse, color);
            if !description.specular.is_black() {
                let alignment = cosine * 2.0 * hits.cosine + shadow.direction.dot(rays.direction);
                let shines = lit & alignment.simd_gt(0.0);
                if shines.any_true() {
                    let highlight =
                        splat(simd, light.specular) * phong_power(simd, alignment, material);
                    let shining = color + highlight.tint(splat(simd, description.specular));
                    color = Vec3s::select(shines, shining, color);
                }
            }
        }
        color
    }

    /// The lanes whose rays, which leave the object `leaves`, meet an object that casts a shadow before
    /// `t_max`; only those of a mask matter. `Tracer::occluded`.
    fn occluded<S: Simd>(
        &self,
        simd: S,
        rays: &Rays<S>,
        leaves: u32,
        t_max: Numbers<S>,
        candidates: ObjectSet,
        lanes: Mask<S>,
    ) -> Mask<S> {
        simd.vectorize(
            #[inline(always)]
            || {
                let mut occluded = !lanes;
                for sphere in self.spheres_among(candidates) {
                    if sphere.casts_shadow {
                        let (center, square) =
                            (sphere.shape.center(), sphere.shape.radius_squared());
                        occluded |= shapes::sphere_occludes(simd, center, square, rays, t_max);
                    }
                }
                for plane in self.planes_among(candidates) {
                    if plane.casts_shadow && plane.index != leaves {
                        let t = shapes::meet_plane(simd, plane.shape, rays);
                        occluded |= t.simd_gt(0.0) & t.simd_lt(t_max);
                    }
                }
                for triangle in self.triangles_among(candidates) {
                    if occluded.all_true() {
                        break;
                    }
                    if triangle.casts_shadow
                        && triangle.index != leaves
                        && let Some(meeting) = shapes::meet_triangle(simd, triangle.shape, rays)
                    {
                        let t = meeting.t;
                        occluded |= meeting.inside & t.simd_gt(0.0) & t.simd_lt(t_max);
                    }
                }
                occluded
            },
        )
    }
}

/// The front of an object in the lanes of a mask, its back in the others: `Side::new`.
#[inline(always)]
fn sides<S: Simd>(simd: S, index: u32, front: Mask<S>) -> Indices<S> {
    let [to_front, to_back] = [index << 1, index << 1 | 1];
    front.select(
        Indices::splat(simd, to_front),
        Indices::splat(simd, to_back),
    )
}

/// `surface_point` of the shapes and `Tracer::hit`.
#[inline(always)]
pub(super) fn hits<S: Simd>(
    simd: S,
    target: &Target<'_>,
    batch: &Batch,
    lanes: &Lanes,
    rays: &Rays<S>,
) -> Hits<S> {
    let (point, normal, offset) = match target.object {
        Object::Sphere(sphere) => {
            let center = Vec3s::splat(simd, sphere.center());
            let at = rays.at(batch.distances(simd, lanes));
            let normal = (at - center).normalize(simd);
            let radius = Numbers::splat(simd, sphere.radius());
            let offset = Numbers::splat(simd, sphere.offset());
            (center + normal * radius, normal, offset)
        }
        Object::Plane(plane) => {
            let normal = Vec3s::splat(simd, plane.normal());
            let at = rays.at(batch.distances(simd, lanes));
            let point = at - normal * (normal.dot(at) - plane.height());
            let components = normal.tint(point).abs();
            let components = components.x + components.y + components.z;
            // `origin_offset`.
            let offset = (components + plane.height().abs()) * (2.0 * f32::EPSILON);
            (point, normal, offset)
        }
        Object::Triangle(triangle) => {
            let [v1, v2, v3] = triangle.vertices();
            let (v1, v2, v3) = (
                Vec3s::splat(simd, v1),
                Vec3s::splat(simd, v2),
                Vec3s::splat(simd, v3),
            );
            let [at_v2, at_v3] = batch.places(simd, lanes);
            let at_v1 = Numbers::splat(simd, 1.0) - at_v2 - at_v3;
            let normal = Vec3s::splat(simd, triangle.normal());
            let offset = Numbers::splat(simd, triangle.offset());
            let point = v1 * at_v1 + v2 * at_v2 + v3 * at_v3;
            (point, normal, offset)
        }
        _ => unreachable!("scenes of other shapes are drawn by the core"),
    };
    let slope = normal.dot(rays.direction);
    let entering = slope.simd_le(0.0);
    let normal = Vec3s::select(entering, normal, -normal);
    let step = normal * offset;
    Hits {
        normal,
        cosine: slope.abs(),
        entering,
        outside: point + step,
        inside: point - step,
    }
}

/// `Tracer::refracted_direction`, and the lanes of a mask without total reflection.
#[inline(always)]
fn refracted<S: Simd>(
    simd: S,
    material: &Material,
    rays: &Rays<S>,
    hits: &Hits<S>,
    valid: Mask<S>,
) -> (Vec3s<S>, Mask<S>) {
    if material.description().index_of_refraction == 1.0 {
        return (rays.direction, valid);
    }
    let (entering, leaving) = (material.entering(), material.leaving());
    let eta = hits.by_side(simd, entering.eta, leaving.eta);
    let bend = hits.by_side(simd, entering.bend, leaving.bend);
    rays.direction.refract(simd, hits.normal, eta, bend, valid)
}

/// `Tracer::phong_power`.
#[inline(always)]
fn phong_power<S: Simd>(simd: S, alignment: Numbers<S>, material: &Material) -> Numbers<S> {
    let one = Numbers::splat(simd, 1.0);
    let base = alignment.simd_lt(one).select(alignment, one);
    match material.whole_shininess() {
        Material::<f32>::FRACTIONAL => powf(simd, base, material.description().shininess),
        whole => power_of_whole(simd, base, whole),
    }
}
