//! Eight rays and a disc.

use fearless_simd::prelude::*;
use scanray::formula::disc::{crossing, eccentricity};
use scanray::formula::plane::project;
use scanray::shape::Disc;
use scanray::shape::Object;

use super::{Bounds, Intersection, LaneShape, Point};
use crate::packet::lanes::{InLanes, Numbers, Rays, Vec3s};

impl LaneShape for Disc {
    const HAS_BOUNDS: bool = true;
    const IS_ITS_BOUNDS: bool = false;
    const IS_FLAT: bool = true;

    type Held<'a> = Box<Self>;

    fn of(object: Object<'_>) -> Option<Box<Self>> {
        match object {
            Object::Stored(stored) => Self::try_from(stored).ok().map(Box::new),
            _ => None,
        }
    }

    /// Its own, which all of it lies in.
    #[inline(always)]
    fn bounds(&self) -> Bounds {
        Bounds {
            center: self.center(),
            radius_squared: self.radius_squared(),
        }
    }

    #[inline(always)]
    fn intersections<S: Simd>(
        &self,
        simd: S,
        bounds: Bounds,
        rays: &Rays<S>,
    ) -> Option<Intersection<S>> {
        let normal = Vec3s::in_every_lane(simd, self.normal());
        let height = Numbers::splat(simd, self.height());
        let center = Vec3s::in_every_lane(simd, bounds.center);
        let t = crossing(normal, height, rays.origin, rays.direction);
        let lanes = eccentricity(rays.at(t), center, normal, height).simd_le(bounds.radius_squared);
        lanes.any_true().then_some(Intersection { lanes, t })
    }

    #[inline(always)]
    fn points<S: Simd>(&self, simd: S, places: Vec3s<S>) -> Point<S> {
        let normal = Vec3s::in_every_lane(simd, self.normal());
        let height = Numbers::splat(simd, self.height());
        Point {
            point: project(places, normal, height),
            normal,
            offset: Numbers::splat(simd, self.offset()),
        }
    }
}
