//! Eight rays and a sphere.

use fearless_simd::prelude::*;
use scanray::formula::sphere::{chord, crossings, project};
use scanray::shape::Object;
use scanray::shape::Sphere;

use super::{Bounds, Intersection, LaneShape, Point};
use crate::packet::lanes::{InLanes, Mask, Numbers, Rays, Vec3s};

impl LaneShape for Sphere {
    const HAS_BOUNDS: bool = true;
    const IS_ITS_BOUNDS: bool = true;
    const IS_FLAT: bool = false;

    type Held<'a> = &'a Self;

    fn of(object: Object<'_>) -> Option<&Self> {
        match object {
            Object::Sphere(sphere) => Some(sphere),
            _ => None,
        }
    }

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
        let (near, far) = crossings_of(simd, bounds, rays)?;
        Some(Intersection {
            lanes: Mask::splat(simd, true),
            t: Numbers::select(near.simd_gt(0.0), near, far),
        })
    }

    /// From inside, the far wall may lie before the end, and the near one behind.
    #[inline(always)]
    fn occluded<S: Simd>(
        &self,
        simd: S,
        bounds: Bounds,
        rays: &Rays<S>,
        t_max: Numbers<S>,
    ) -> Option<Mask<S>> {
        let (near, far) = crossings_of(simd, bounds, rays)?;
        Some((near.simd_gt(0.0) & near.simd_lt(t_max)) | (far.simd_gt(0.0) & far.simd_lt(t_max)))
    }

    #[inline(always)]
    fn points<S: Simd>(&self, simd: S, places: Vec3s<S>) -> Point<S> {
        let center = Vec3s::in_every_lane(simd, self.center());
        let radius = Numbers::splat(simd, self.radius());
        let (point, normal) = project(places, center, radius);
        Point {
            point,
            normal,
            offset: Numbers::splat(simd, self.offset()),
        }
    }
}

/// Distances of both crossings of each ray, nearer first, NaN without one; `None` where no lane has any.
#[inline(always)]
fn crossings_of<S: Simd>(
    simd: S,
    bounds: Bounds,
    rays: &Rays<S>,
) -> Option<(Numbers<S>, Numbers<S>)> {
    let center = Vec3s::in_every_lane(simd, bounds.center);
    let square = Numbers::splat(simd, bounds.radius_squared);
    let (middle, half_chord_squared) = chord(center, square, rays.origin, rays.direction);
    if !half_chord_squared.simd_ge(0.0).any_true() {
        return None;
    }
    // The root of a negative number is NaN, which fails every comparison.
    Some(crossings(middle, half_chord_squared))
}
