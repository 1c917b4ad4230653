//! Lights on surfaces, or so near to one that rounding would decide for each shadow ray on which side of it the light is.
//!
//! A shape does not stand before a light on its own surface. Which light is that is decided once, by how far it is from the
//! surface, and not by the distance along each ray, whose rounding grows with the ray's length and its slant. Lights that are near
//! no surface, as nearly all are, cost nothing: what is derived from a scene says so ([`Accel`](crate::accel::Accel)).

use super::margin::{margin, size};
use super::{BoundingSphere, Primitive, Sphere};
use crate::formula::{self, sphere::closest_approach};
use crate::ray::Ray;
use crate::real::Real;
use crate::scalar::Scalar;
use crate::vec3::Vec3;

/// The plane that a flat shape lies in: the points with `normal·p = height`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FlatPlane<T> {
    /// Length 1.
    pub(crate) normal: Vec3<T>,
    pub(crate) height: T,
    /// The shape's own origin offset, if it has one bound for all of it.
    pub(crate) offset: T,
}

impl<T: Scalar> FlatPlane<T> {
    /// Signed distance of a point, and the largest at which that is rounding.
    #[inline(never)]
    fn distance(&self, point: Vec3<T>) -> (T, T) {
        let offset = formula::plane::offset(point.real(), self.normal.real(), Real(self.height)).0;
        let distance = self.normal.dot(point) - self.height;
        (distance, T::TWO * (offset + self.offset))
    }

    fn is_near(&self, point: Vec3<T>) -> bool {
        let (distance, rounding) = self.distance(point);
        let margin = margin(size(point) + self.height.abs(), T::ZERO);
        distance.abs() <= margin + T::from_i32(16) * rounding
    }

    /// Whether a point lies beyond the plane for a ray that comes to it, and not on it.
    fn is_before(&self, point: Vec3<T>, direction: Vec3<T>) -> bool {
        let (distance, rounding) = self.distance(point);
        let beyond = if self.normal.dot(direction) > T::ZERO {
            distance
        } else {
            -distance
        };
        beyond > rounding
    }
}

/// Whether a light is so near to a surface that distances along rays do not decide whether the shape stands before it: of a flat
/// shape that the light lies beyond it does, of others [`Primitive::occludes_near`].
#[inline(never)]
pub(crate) fn is_near<T: Scalar, P: Primitive<T>>(shape: &P, light: Vec3<T>) -> bool {
    shape
        .bounding_sphere()
        .is_none_or(|bounds| is_within(bounds, light))
        && match shape.plane() {
            Some(plane) => plane.is_near(light),
            None => shape.has_surface_near(light),
        }
}

/// Whether a light that is near to a shape lies beyond it, for a ray that crosses it on its way, and not on it.
#[cold]
#[inline(never)]
pub(crate) fn is_before<T: Scalar, P: Primitive<T>>(
    shape: &P,
    light: Vec3<T>,
    direction: Vec3<T>,
) -> bool {
    shape
        .plane()
        .is_none_or(|plane| plane.is_before(light, direction))
}

#[inline(never)]
fn is_within<T: Scalar>(bounds: BoundingSphere<T>, light: Vec3<T>) -> bool {
    let BoundingSphere { center, radius } = bounds;
    let reach = radius + margin(size(light) + size(center), T::from_i32(256) * radius);
    let across = light - center;
    across.dot(across) <= reach * reach
}

impl<T: Scalar> Sphere<T> {
    /// Whether a point is closer to the surface than a hundredth of the radius, or than rounding.
    #[inline(never)]
    pub(super) fn is_surface_near(&self, point: Vec3<T>) -> bool {
        let across = point - self.center();
        let from_surface = across.dot(across).sqrt() - self.radius();
        let rounding = T::from_i32(16) * self.offset();
        from_surface.abs() <= T::from_f64(1.0 / 64.0) * self.radius() + rounding
    }

    /// Whether the sphere stands between the origin of a shadow ray and a light near its surface: asked from the light, because
    /// rounding is that of the length of what is looked at.
    #[cold]
    #[inline(never)]
    pub(super) fn occludes_light_near(&self, ray: &Ray<T>, light: Vec3<T>, distance: T) -> bool {
        let (middle, across_squared) =
            closest_approach(self.center().real(), light.real(), ray.direction.real());
        let (middle, half_chord_squared) = (middle.0, self.radius_squared() - across_squared.0);
        if !(half_chord_squared >= T::ZERO) {
            return false;
        }
        let is_between = |crossing: T| crossing < T::ZERO && crossing > -distance;
        let across = light - self.center();
        let from_surface = across.dot(across).sqrt() - self.radius();
        let half_chord = half_chord_squared.sqrt();
        if from_surface.abs() <= T::TWO * self.offset() {
            // One of the crossings is the light itself; the other one is the farther of both.
            return middle < T::ZERO && is_between(middle - half_chord);
        }
        is_between(middle - half_chord) || is_between(middle + half_chord)
    }
}
