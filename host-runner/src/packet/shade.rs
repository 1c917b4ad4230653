//! Shading of up to eight hits on one object, and the rays they cast.

use fearless_simd::prelude::*;
use scanray::formula::{optics, shading};
use scanray::{Light, Material, accel::ObjectSet, number::Number};

use super::batch::{Batch, Lanes};
use super::lanes::{Colors, InLanes, Indices, LANES, Mask, Numbers, Rays, Vec3s, first_lanes};
use super::shapes::Among;
use super::{PacketTracer, Target};

/// Intersections with the surface of one object, ready for shading. `Hit` of the core.
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
        let (entering, leaving) = (
            Numbers::splat(simd, entering),
            Numbers::splat(simd, leaving),
        );
        Numbers::select(self.entering, entering, leaving)
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
                // As in `Tracer::radiance_observed`.
                if description.reflection > 0.0 {
                    let mirrored = Rays {
                        origin: hits.outside,
                        direction: optics::mirror(rays.direction, hits.normal, hits.cosine),
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
        let mut color = Colors::in_every_lane(simd, description.ambient * scene.ambient());
        let [front, back] = target.reach;
        let front_open = hits.entering & valid & Mask::splat(simd, !front.shadowed);
        let back_open = !hits.entering & valid & Mask::splat(simd, !back.shadowed);
        if !(front_open | back_open).any_true() {
            return color;
        }
        for (number, light) in scene.lights().iter().enumerate() {
            let toward = TowardLight::new(simd, light, hits.outside, hits.normal);
            let facing = toward.is_facing();
            let mut lit = (front_open | back_open) & facing;
            if !lit.any_true() {
                continue;
            }
            let (shadow, distance, cosine) = toward.shadow(hits.outside);
            if self.bvh.is_some() {
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
            let [diffuse, share] = [light.diffuse, description.diffuse];
            let diffuse = shading::reflected(
                Colors::in_every_lane(simd, diffuse),
                cosine,
                Colors::in_every_lane(simd, share),
            );
            color = Colors::select(lit, color + diffuse, color);
            if !description.specular.is_black() {
                let alignment =
                    shading::alignment(cosine, hits.cosine, shadow.direction, rays.direction);
                let shines = lit & alignment.simd_gt(0.0);
                if shines.any_true() {
                    let highlight = shading::reflected(
                        Colors::in_every_lane(simd, light.specular),
                        phong_power(alignment, material),
                        Colors::in_every_lane(simd, description.specular),
                    );
                    color = Colors::select(shines, color + highlight, color);
                }
            }
        }
        color
    }

    /// The lanes whose rays, which leave the object `leaves`, hit an object that casts a shadow before
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
                let among = Among::Set(candidates);
                self.shapes
                    .occlude(simd, rays, leaves, t_max, among, &mut occluded);
                occluded
            },
        )
    }
}

/// The way from hits to a light. `Tracer::lit`.
#[derive(Clone, Copy)]
pub(super) struct TowardLight<S: Simd> {
    to_light: Vec3s<S>,
    /// Along the normal.
    rise: Numbers<S>,
    distance_squared: Numbers<S>,
}

impl<S: Simd> TowardLight<S> {
    #[inline(always)]
    pub(super) fn new(simd: S, light: &Light, outside: Vec3s<S>, normal: Vec3s<S>) -> Self {
        let to_light = Vec3s::in_every_lane(simd, light.position) - outside;
        Self {
            to_light,
            rise: to_light.along(normal),
            distance_squared: to_light.dot(to_light),
        }
    }

    /// The lanes in which the light is in front of the surface.
    #[inline(always)]
    pub(super) fn is_facing(&self) -> Mask<S> {
        self.rise.simd_gt(0.0) & self.distance_squared.simd_gt(0.0)
    }

    /// The shadow rays from there, the distance of the light and the cosine of its angle.
    #[inline(always)]
    pub(super) fn shadow(&self, origin: Vec3s<S>) -> (Rays<S>, Numbers<S>, Numbers<S>) {
        let distance = self.distance_squared.sqrt();
        let inverse = distance.constant(1.0) / distance;
        let direction = self.to_light * inverse;
        (Rays { origin, direction }, distance, self.rise * inverse)
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

/// `Tracer::hit`.
#[inline(always)]
pub(super) fn hits<S: Simd>(
    simd: S,
    target: &Target<'_>,
    batch: &Batch,
    lanes: &Lanes,
    rays: &Rays<S>,
) -> Hits<S> {
    let places = rays.at(batch.distances(simd, lanes));
    let at = target.object.points(simd, places);
    let slope = rays.direction.along(at.normal);
    let entering = slope.simd_le(0.0);
    let normal = Vec3s::select(entering, at.normal, -at.normal);
    let step = normal * at.offset;
    Hits {
        normal,
        cosine: slope.abs(),
        entering,
        outside: at.point + step,
        inside: at.point - step,
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
    // `Vec3::refract`.
    let beyond = optics::beyond_critical(hits.cosine, bend);
    let mut passes = valid & beyond.simd_ge(0.0);
    let bent = optics::refract(rays.direction, hits.normal, hits.cosine, beyond, eta);
    let mut direction = optics::renormalize(bent);
    let rare = passes & !optics::drift(bent).simd_lt(f32::EPSILON * 256.0);
    if rare.any_true() {
        // Leave the extreme index to the core.
        let mut parts = [
            direction.x.to_array(),
            direction.y.to_array(),
            direction.z.to_array(),
        ];
        for lane in (0..LANES).filter(|lane| rare.test(*lane)) {
            let (incoming, normal) = (rays.direction.lane(lane), hits.normal.lane(lane));
            let refracted = incoming.refract(normal, eta[lane], bend[lane]);
            passes.set(lane, refracted.is_some());
            let v = refracted.unwrap_or_default();
            for (part, component) in parts.iter_mut().zip([v.x, v.y, v.z]) {
                part[lane] = component;
            }
        }
        let [x, y, z] = parts;
        direction = Vec3s::new(
            Numbers::from_array(simd, x),
            Numbers::from_array(simd, y),
            Numbers::from_array(simd, z),
        );
    }
    (direction, passes)
}

/// `Tracer::phong_power`.
#[inline(always)]
fn phong_power<S: Simd>(alignment: Numbers<S>, material: &Material) -> Numbers<S> {
    let one = alignment.constant(1.0);
    let base = Numbers::select(alignment.simd_lt(one), alignment, one);
    match material.whole_shininess() {
        Material::<f32>::FRACTIONAL => base.powf(material.description().shininess),
        whole => shading::power(base, whole),
    }
}
