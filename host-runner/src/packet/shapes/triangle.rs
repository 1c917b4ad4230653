//! Eight rays and a triangle.

use fearless_simd::prelude::*;
use scanray::formula::sphere::closest_approach;
use scanray::formula::triangle::{GRAZING, Shear, edge, product_error, project, reach, rise};
use scanray::number::Number;
use scanray::shape::Triangle;
use scanray::{Vec3, shape::Object};

use super::{Bounds, Intersection, LaneShape, Point};
use crate::packet::lanes::{InLanes, Mask, Numbers, Rays, Vec3s};

impl LaneShape for Triangle {
    const HAS_BOUNDS: bool = true;
    const IS_ITS_BOUNDS: bool = false;
    const IS_FLAT: bool = true;

    type Held<'a> = &'a Self;

    fn of(object: Object<'_>) -> Option<&Self> {
        match object {
            Object::Triangle(triangle) => Some(triangle),
            _ => None,
        }
    }

    #[inline(always)]
    fn bounds(&self) -> Bounds {
        Bounds {
            center: self.bounds_center(),
            radius_squared: self.bounds_radius_squared(),
        }
    }

    /// `Triangle::crossing_exactly`.
    #[inline(always)]
    fn intersections<S: Simd>(
        &self,
        simd: S,
        bounds: Bounds,
        rays: &Rays<S>,
    ) -> Option<Intersection<S>> {
        let lanes = may_hit(simd, bounds, rays);
        if !lanes.any_true() {
            return None;
        }
        let turn = Turn::largest_to_z(rays.direction);
        let shear = Shear::along(turn.apply(rays.direction));
        // Without closures, which would be compiled without the instructions that lanes need.
        let [v1, v2, v3] = self.vertices();
        let to_v1 = Vec3s::in_every_lane(simd, v1) - rays.origin;
        let v1 = turn.apply(to_v1);
        let v2 = turn.apply(Vec3s::in_every_lane(simd, v2) - rays.origin);
        let v3 = turn.apply(Vec3s::in_every_lane(simd, v3) - rays.origin);
        let (a, b, c) = (shear.apply(v1), shear.apply(v2), shear.apply(v3));
        let u = signed_edge(c, b, lanes);
        let v = signed_edge(a, c, lanes);
        let w = signed_edge(b, a, lanes);
        let positive = u.simd_ge(0.0) & v.simd_ge(0.0) & w.simd_ge(0.0);
        let negative = u.simd_le(0.0) & v.simd_le(0.0) & w.simd_le(0.0);
        let inside = lanes & (positive | negative) & !(u + v + w).simd_eq(0.0);
        if !inside.any_true() {
            return None;
        }
        let normal = Vec3s::in_every_lane(simd, self.normal());
        let (below, slope) = rise(normal, to_v1, rays.direction);
        let mut t = below / slope;
        let grazing = slope.abs().simd_lt(GRAZING as f32);
        if (grazing & inside).any_true() {
            let center = Vec3s::in_every_lane(simd, bounds.center);
            let limited = limited(
                t,
                closest_approach(center, rays.origin, rays.direction),
                Numbers::splat(simd, bounds.radius_squared),
                turn.apply(rays.direction).z,
                [v1.z, v2.z, v3.z],
            );
            t = Numbers::select(grazing, limited, t);
        }
        Some(Intersection { lanes: inside, t })
    }

    #[inline(always)]
    fn points<S: Simd>(&self, simd: S, places: Vec3s<S>) -> Point<S> {
        let [vertex, ..] = self.vertices();
        let normal = Vec3s::in_every_lane(simd, self.normal());
        Point {
            point: project(places, normal, Vec3s::in_every_lane(simd, vertex)),
            normal,
            offset: Numbers::splat(simd, self.offset()),
        }
    }
}

/// `Triangle::may_hit`.
#[inline(always)]
fn may_hit<S: Simd>(simd: S, bounds: Bounds, rays: &Rays<S>) -> Mask<S> {
    let center = Vec3s::in_every_lane(simd, bounds.center);
    let (b, across) = closest_approach(center, rays.origin, rays.direction);
    across.simd_le(reach(Numbers::splat(simd, bounds.radius_squared), b))
}

/// The lesser of two numbers; the first where they do not compare.
#[inline(always)]
fn lesser<S: Simd>(a: Numbers<S>, b: Numbers<S>) -> Numbers<S> {
    Numbers::select(b.simd_lt(a), b, a)
}

/// The greater of two numbers; the first where they do not compare.
#[inline(always)]
fn greater<S: Simd>(a: Numbers<S>, b: Numbers<S>) -> Numbers<S> {
    Numbers::select(b.simd_gt(a), b, a)
}

/// The core's `limited`, given what has been turned so that the largest component is z.
#[inline(always)]
fn limited<S: Simd>(
    t: Numbers<S>,
    (middle, across): (Numbers<S>, Numbers<S>),
    radius_squared: Numbers<S>,
    direction: Numbers<S>,
    [v1, v2, v3]: [Numbers<S>; 3],
) -> Numbers<S> {
    let half_chord = (radius_squared - across).sqrt();
    let lowest = lesser(lesser(v1, v2), v3) / direction;
    let highest = greater(greater(v1, v2), v3) / direction;
    let first = greater(lesser(lowest, highest), middle - half_chord);
    let last = lesser(greater(lowest, highest), middle + half_chord);
    let raised = Numbers::select(t.simd_lt(first), first, t);
    Numbers::select(t.simd_gt(last) & !t.simd_lt(first), last, raised)
}

/// The core's `Turn`, as the lanes that turn each way.
#[derive(Clone, Copy)]
struct Turn<S: Simd> {
    x_to_z: Mask<S>,
    y_to_z: Mask<S>,
}

impl<S: Simd> Turn<S> {
    #[inline(always)]
    fn largest_to_z(direction: Vec3s<S>) -> Self {
        let d = direction.abs();
        Self {
            x_to_z: d.x.simd_gt(d.y) & d.x.simd_gt(d.z),
            y_to_z: d.y.simd_gt(d.z),
        }
    }

    #[inline(always)]
    fn apply(self, v: Vec3s<S>) -> Vec3s<S> {
        let turned = Vec3s::select(self.y_to_z, Vec3::new(v.z, v.x, v.y), v);
        Vec3s::select(self.x_to_z, Vec3::new(v.y, v.z, v.x), turned)
    }
}

/// The core's `signed_edge`, exact where the edge function is 0 in one of the lanes of a mask.
#[inline(always)]
fn signed_edge<S: Simd>(p: [Numbers<S>; 2], q: [Numbers<S>; 2], lanes: Mask<S>) -> Numbers<S> {
    let edge = edge(p, q);
    let is_zero = edge.simd_eq(0.0);
    if (is_zero & lanes).any_true() {
        let ([px, py], [qx, qy]) = (p, q);
        let exact = product_error(px, qy) - product_error(py, qx);
        Numbers::select(is_zero, exact, edge)
    } else {
        edge
    }
}
