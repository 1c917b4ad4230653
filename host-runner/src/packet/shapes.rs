//! Eight rays against one object: `intersect` and `occludes` of the core's shapes, lane by lane.

use fearless_simd::prelude::*;
use scanray::Vec3;
use scanray::shape::{Plane, Triangle};

use super::lanes::{Mask, Numbers, Rays, Vec3s};

/// Distances of both crossings of each ray with a sphere, nearer first, NaN without one; `None` where
/// no lane has any. `Sphere::crossings`.
#[inline(always)]
fn crossings<S: Simd>(
    simd: S,
    center: Vec3,
    radius_squared: f32,
    rays: &Rays<S>,
) -> Option<(Numbers<S>, Numbers<S>)> {
    let f = Vec3s::splat(simd, center) - rays.origin;
    let b = f.dot(rays.direction);
    let l = f - rays.direction * b;
    let discriminant = Numbers::splat(simd, radius_squared) - l.dot(l);
    if !discriminant.simd_ge(0.0).any_true() {
        return None;
    }
    // The root of a negative number is NaN, which fails every comparison.
    let half_chord = discriminant.sqrt();
    Some((b - half_chord, b + half_chord))
}

/// Distance of the nearest crossing ahead; not above 0 or NaN for none. `Sphere::intersect`.
#[inline(always)]
pub(super) fn meet_sphere<S: Simd>(
    simd: S,
    center: Vec3,
    radius_squared: f32,
    rays: &Rays<S>,
) -> Option<Numbers<S>> {
    let (near, far) = crossings(simd, center, radius_squared, rays)?;
    Some(near.simd_gt(0.0).select(near, far))
}

/// `Sphere::occludes`.
#[inline(always)]
pub(super) fn sphere_occludes<S: Simd>(
    simd: S,
    center: Vec3,
    radius_squared: f32,
    rays: &Rays<S>,
    t_max: Numbers<S>,
) -> Mask<S> {
    match crossings(simd, center, radius_squared, rays) {
        Some((near, far)) => {
            (near.simd_gt(0.0) & near.simd_lt(t_max)) | (far.simd_gt(0.0) & far.simd_lt(t_max))
        }
        None => Mask::splat(simd, false),
    }
}

/// Distance of the crossing; not above 0 or NaN for none. `Plane::intersect`, for rays that do not
/// leave the plane.
#[inline(always)]
pub(super) fn meet_plane<S: Simd>(simd: S, plane: &Plane, rays: &Rays<S>) -> Numbers<S> {
    let normal = Vec3s::splat(simd, plane.normal());
    (Numbers::splat(simd, plane.height()) - normal.dot(rays.origin)) / normal.dot(rays.direction)
}

/// Where rays meet a triangle.
#[derive(Clone, Copy)]
pub(super) struct TriangleMeeting<S: Simd> {
    /// The lanes that meet it at all, ahead or behind.
    pub(super) inside: Mask<S>,
    /// Distance.
    pub(super) t: Numbers<S>,
    /// Weights of the second and third vertex.
    pub(super) place: [Numbers<S>; 2],
}

/// `Triangle::intersect` but for the range of the distance, for rays that do not leave the triangle;
/// `None` where no lane meets it.
#[inline(always)]
pub(super) fn meet_triangle<S: Simd>(
    simd: S,
    triangle: &Triangle,
    rays: &Rays<S>,
) -> Option<TriangleMeeting<S>> {
    let lanes = may_meet(simd, triangle, rays);
    if !lanes.any_true() {
        return None;
    }
    let shear = Shear::along(simd, rays);
    let [v1, v2, v3] = triangle.vertices();
    let a = shear.apply(simd, v1);
    let b = shear.apply(simd, v2);
    let c = shear.apply(simd, v3);
    let (u, v, w) = (edge(c, b, lanes), edge(a, c, lanes), edge(b, a, lanes));
    let positive = u.simd_ge(0.0) & v.simd_ge(0.0) & w.simd_ge(0.0);
    let negative = u.simd_le(0.0) & v.simd_le(0.0) & w.simd_le(0.0);
    let determinant = u + v + w;
    let inside = lanes & (positive | negative) & !determinant.simd_eq(0.0);
    if !inside.any_true() {
        return None;
    }
    let inverse = Numbers::splat(simd, 1.0) / determinant;
    Some(TriangleMeeting {
        inside,
        t: (u * a.z + v * b.z + w * c.z) * inverse,
        place: [v * inverse, w * inverse],
    })
}

/// `Triangle::may_meet`.
#[inline(always)]
fn may_meet<S: Simd>(simd: S, triangle: &Triangle, rays: &Rays<S>) -> Mask<S> {
    const BALL_SLACK: f32 = f32::EPSILON * 64.0;
    let f = Vec3s::splat(simd, triangle.ball_center()) - rays.origin;
    let b = f.dot(rays.direction);
    let l = f - rays.direction * b;
    let reach = Numbers::splat(simd, triangle.ball_radius_squared()) + b * b * BALL_SLACK;
    l.dot(l).simd_le(reach)
}

/// Moves points so that the rays are the z axis: the `shear` of `Triangle::intersect_exactly`.
#[derive(Clone, Copy)]
struct Shear<S: Simd> {
    origin: Vec3s<S>,
    turn: Turn<S>,
    x: Numbers<S>,
    y: Numbers<S>,
    scale: Numbers<S>,
}

impl<S: Simd> Shear<S> {
    #[inline(always)]
    fn along(simd: S, rays: &Rays<S>) -> Self {
        let turn = Turn::largest_to_z(rays.direction);
        let d = turn.apply(rays.direction);
        Self {
            origin: rays.origin,
            turn,
            x: d.x / d.z,
            y: d.y / d.z,
            scale: Numbers::splat(simd, 1.0) / d.z,
        }
    }

    #[inline(always)]
    fn apply(&self, simd: S, vertex: Vec3) -> Vec3s<S> {
        let v = self.turn.apply(Vec3s::splat(simd, vertex) - self.origin);
        Vec3s::new(v.x - self.x * v.z, v.y - self.y * v.z, self.scale * v.z)
    }
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
        let turned = Vec3s::select(self.y_to_z, Vec3s::new(v.z, v.x, v.y), v);
        Vec3s::select(self.x_to_z, Vec3s::new(v.y, v.z, v.x), turned)
    }
}

/// The core's `edge`, exact where a difference among the lanes of a mask is 0.
#[inline(always)]
fn edge<S: Simd>(p: Vec3s<S>, q: Vec3s<S>, lanes: Mask<S>) -> Numbers<S> {
    let difference = p.x * q.y - p.y * q.x;
    let is_zero = difference.simd_eq(0.0);
    if (is_zero & lanes).any_true() {
        // The core's `exact_edge`.
        let exact = product_error(p.x, q.y) - product_error(p.y, q.x);
        is_zero.select(exact, difference)
    } else {
        difference
    }
}

/// The core's `product_error`.
#[inline(always)]
fn product_error<S: Simd>(a: Numbers<S>, b: Numbers<S>) -> Numbers<S> {
    let product = a * b;
    let (a_high, a_low) = split(a);
    let (b_high, b_low) = split(b);
    ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low
}

#[inline(always)]
fn split<S: Simd>(x: Numbers<S>) -> (Numbers<S>, Numbers<S>) {
    let scaled = x * <f32 as scanray::Number>::SPLIT as f32;
    let high = scaled - (scaled - x);
    (high, x - high)
}
