//! Eight rays and a plane.

use fearless_simd::prelude::*;
use scanray::formula::plane::{offset, project, rise};
use scanray::shape::Object;
use scanray::shape::Plane;

use super::{Bounds, Intersection, LaneShape, Point};
use crate::packet::lanes::{InLanes, Mask, Numbers, Rays, Vec3s};

impl LaneShape for Plane {
    const HAS_BOUNDS: bool = false;
    const IS_ITS_BOUNDS: bool = false;
    const IS_FLAT: bool = true;

    type Held<'a> = &'a Self;

    fn of(object: Object<'_>) -> Option<&Self> {
        match object {
            Object::Plane(plane) => Some(plane),
            _ => None,
        }
    }

    #[inline(always)]
    fn bounds(&self) -> Bounds {
        Bounds::default()
    }

    #[inline(always)]
    fn intersections<S: Simd>(
        &self,
        simd: S,
        _: Bounds,
        rays: &Rays<S>,
    ) -> Option<Intersection<S>> {
        let normal = Vec3s::in_every_lane(simd, self.normal());
        let height = Numbers::splat(simd, self.height());
        let (below, slope) = rise(normal, height, rays.origin, rays.direction);
        Some(Intersection {
            lanes: Mask::splat(simd, true),
            t: below / slope,
        })
    }

    #[inline(always)]
    fn points<S: Simd>(&self, simd: S, places: Vec3s<S>) -> Point<S> {
        let normal = Vec3s::in_every_lane(simd, self.normal());
        let height = Numbers::splat(simd, self.height());
        let point = project(places, normal, height);
        Point {
            point,
            normal,
            offset: offset(point, normal, height),
        }
    }
}
