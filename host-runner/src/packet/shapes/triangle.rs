//! Eight rays and a triangle.

use fearless_simd::prelude::*;
use scanray::formula::sphere::closest_approach;
use scanray::formula::triangle::{Shear, edge, interpolate, point, product_error, reach};
use scanray::shape::Triangle;
use scanray::{Vec3, shape::Object};

use super::{Bounds, Intersection, LaneShape, Point};
use crate::packet::batch::{Batch, Lanes};
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

    /// `Triangle::intersect_exactly`.
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
        let [v1, v2, v3] = self.vertices();
        let a = shear.apply(turn.apply(Vec3s::in_every_lane(simd, v1) - rays.origin));
        let b = shear.apply(turn.apply(Vec3s::in_every_lane(simd, v2) - rays.origin));
        let c = shear.apply(turn.apply(Vec3s::in_every_lane(simd, v3) - rays.origin));
        let u = signed_edge(c, b, lanes);
        let v = signed_edge(a, c, lanes);
        let w = signed_edge(b, a, lanes);
        let positive = u.simd_ge(0.0) & v.simd_ge(0.0) & w.simd_ge(0.0);
        let negative = u.simd_le(0.0) & v.simd_le(0.0) & w.simd_le(0.0);
        let determinant = u + v + w;
        let inside = lanes & (positive | negative) & !determinant.simd_eq(0.0);
        if !inside.any_true() {
            return None;
        }
        let (t, place) = interpolate([u, v, w], determinant, [a, b, c]);
        Some(Intersection {
            lanes: inside,
            t,
            place: Some(place),
        })
    }

    #[inline(always)]
    fn points<S: Simd>(&self, simd: S, _: &Rays<S>, batch: &Batch, lanes: &Lanes) -> Point<S> {
        let [v1, v2, v3] = self.vertices();
        let vertices = [
            Vec3s::in_every_lane(simd, v1),
            Vec3s::in_every_lane(simd, v2),
            Vec3s::in_every_lane(simd, v3),
        ];
        Point {
            point: point(vertices, batch.places(simd, lanes)),
            normal: Vec3s::in_every_lane(simd, self.normal()),
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
fn signed_edge<S: Simd>(p: Vec3s<S>, q: Vec3s<S>, lanes: Mask<S>) -> Numbers<S> {
    let edge = edge(p, q);
    let is_zero = edge.simd_eq(0.0);
    if (is_zero & lanes).any_true() {
        let exact = product_error(p.x, q.y) - product_error(p.y, q.x);
        Numbers::select(is_zero, exact, edge)
    } else {
        edge
    }
}
