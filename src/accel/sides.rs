//! What rays can hit that leave a side of an object.

use super::{Candidates, Octant, Source, collect, margin, size};
use crate::light::Light;
use crate::scalar::Scalar;
use crate::shape::{BoundingSphere, Object, Plane, Sphere, Triangle};
use crate::vec3::Vec3;

/// The candidates of the front and the back of an object.
pub(super) fn sides<T: Scalar>(scene: &Source<'_, T>, object: Object<'_, T>) -> [Candidates; 2] {
    let reach = |front: bool| Candidates {
        near: Octant::ALL.map(|octant| {
            collect(&scene.geometry, |other| {
                may_hit(object, front, other) && may_lie_ahead(object, octant, other)
            })
        }),
        occluders: collect(&scene.geometry, |other| {
            casts_shadow(scene, other)
                && scene
                    .lights
                    .iter()
                    .any(|light| may_shade(object, front, light, other))
        }),
        shadowed: is_shadowed(scene, object, front),
    };
    [reach(true), reach(false)]
}

fn is_same<T: Scalar>(a: Object<'_, T>, b: Object<'_, T>) -> bool {
    a.info().number == b.info().number
}

/// Whether a ray that leaves a side of `from` can hit `other` first.
fn may_hit<T: Scalar>(from: Object<'_, T>, front: bool, other: Object<'_, T>) -> bool {
    match from {
        // Outside, a sphere is convex: it cannot hit itself.
        Object::Sphere(_) if front => !is_same(from, other),
        // Inside, the ray hits the sphere itself before anything that lies outside of it.
        Object::Sphere(sphere) => {
            !has_inside(sphere) || is_same(from, other) || touches_sphere(from, other)
        }
        // A flat object cannot hit itself.
        Object::Plane(_) => !is_same(from, other),
        Object::Triangle(triangle) => !is_same(from, other) && !lies_behind(triangle, front, other),
        // What bounds alone tell is asked for all shapes.
        _ => !(from.is_flat() && is_same(from, other)),
    }
}

/// Whether a ray that leaves an object in a direction of an octant can come to `other`.
fn may_lie_ahead<T: Scalar>(from: Object<'_, T>, octant: Octant, other: Object<'_, T>) -> bool {
    let Some(bounds) = from.bounding_sphere() else {
        return true;
    };
    match (other, other.bounding_sphere()) {
        (Object::Plane(plane), _) => {
            // Not where the whole sphere lies above the plane, and all directions lead up; or both down.
            let above = height(plane, bounds.center);
            let is_apart = above.abs() > bounds.radius + plane_margin(plane, bounds);
            !(is_apart && leads_along(octant, plane.normal(), above > T::ZERO))
        }
        // A ray from one sphere hits the other only if a ray from the origin hits a sphere with both radii
        // around the way from one centre to the other; `across` is that sphere's distance from the octant.
        (_, Some(other)) => {
            let across = outside_part(octant, other.center - bounds.center);
            let radii = bounds.radius + other.radius;
            let reach = radii + margin(size(bounds.center) + size(other.center), radii);
            !(across.dot(across).sqrt() > reach)
        }
        _ => true,
    }
}

/// Whether no direction of an octant has a negative scalar product with a vector, or with its opposite if
/// `along` is false. That holds for the rounded product too, whose terms have one sign.
fn leads_along<T: Scalar>(octant: Octant, vector: Vec3<T>, along: bool) -> bool {
    let vector = if along { vector } else { -vector };
    let Vec3 { x, y, z } = outside_part(octant, vector);
    // Each for itself: the square of what is all but 0 may be 0.
    x == T::ZERO && y == T::ZERO && z == T::ZERO
}

/// The vector from the nearest point of an octant to a point.
fn outside_part<T: Scalar>(octant: Octant, point: Vec3<T>) -> Vec3<T> {
    let [x, y, z] = octant.is_negative();
    let outside = |coordinate: T, is_negative: bool| {
        if (coordinate < T::ZERO) == is_negative {
            T::ZERO
        } else {
            coordinate
        }
    };
    Vec3::new(
        outside(point.x, x),
        outside(point.y, y),
        outside(point.z, z),
    )
}

/// Whether something of an object may lie in the sphere around another.
fn touches_sphere<T: Scalar>(inside: Object<'_, T>, other: Object<'_, T>) -> bool {
    let Some(bounds) = inside.bounding_sphere() else {
        return true;
    };
    match (other, other.bounding_sphere()) {
        (Object::Plane(plane), _) => {
            height(plane, bounds.center).abs() <= bounds.radius + plane_margin(plane, bounds)
        }
        (_, Some(other)) => {
            let between = other.center - bounds.center;
            let radii = bounds.radius + other.radius;
            let lengths = size(bounds.center) + size(other.center);
            between.dot(between).sqrt() <= radii + margin(lengths, radii)
        }
        _ => true,
    }
}

/// Signed distance of a point from a plane.
fn height<T: Scalar>(plane: &Plane<T>, point: Vec3<T>) -> T {
    plane.normal().dot(point) - plane.height()
}

fn plane_margin<T: Scalar>(plane: &Plane<T>, bounds: BoundingSphere<T>) -> T {
    margin(size(bounds.center) + plane.height().abs(), bounds.radius)
}

/// Whether all of `other` lies on the far side of a triangle's plane. Rays leave the triangle towards
/// the near side, up to their rounding, and the triangle is bounded, so that they do not reach it. (One without a sphere is
/// as good as unbounded.)
fn lies_behind<T: Scalar>(triangle: &Triangle<T>, front: bool, other: Object<'_, T>) -> bool {
    let normal = if front {
        triangle.normal()
    } else {
        -triangle.normal()
    };
    let Some(bounds) = Object::Triangle(triangle).bounding_sphere() else {
        return false;
    };
    let [corner, ..] = triangle.vertices();
    let own = size(corner) + bounds.radius;
    let is_behind = |point: Vec3<T>, radius: T| {
        normal.dot(point - corner) + radius < -margin(own + size(point), radius)
    };
    match other {
        Object::Sphere(sphere) => is_behind(sphere.center(), sphere.radius()),
        Object::Plane(_) => false,
        Object::Triangle(other) => other
            .vertices()
            .iter()
            .all(|vertex| is_behind(*vertex, T::ZERO)),
        _ => other
            .bounding_sphere()
            .is_some_and(|bounds| is_behind(bounds.center, bounds.radius)),
    }
}

/// Whether `other` may stand between a side of an object and a light.
fn may_shade<T: Scalar>(
    from: Object<'_, T>,
    front: bool,
    light: &Light<T>,
    other: Object<'_, T>,
) -> bool {
    let Some(bounds) = from.bounding_sphere() else {
        return !is_same(from, other);
    };
    if is_same(from, other) {
        // Flat objects are not hit by rays that leave them, nor convex ones from outside.
        return !(from.is_flat() || front && matches!(from, Object::Sphere(_)));
    }
    match (other, other.bounding_sphere()) {
        (Object::Plane(plane), _) => {
            // Both the object and the light strictly on one side?
            let margin = plane_margin(plane, bounds) + margin(size(light.position), T::ZERO);
            let reach = bounds.radius + margin;
            let (from, to) = (height(plane, bounds.center), height(plane, light.position));
            let above = from > reach && to > margin;
            let below = from < -reach && to < -margin;
            !(above || below)
        }
        (_, Some(other)) => !lies_beside_light(bounds, light.position, other),
        _ => true,
    }
}

/// Whether a sphere lies outside of the convex hull of another sphere and a point: of all segments from the
/// other sphere to the light.
///
/// The hull lies in the cone of half-angle φ, `sin φ = R/V`, with its tip in the light, at distance `V`
/// from the sphere of radius `R`; for a point at distance `a` along the axis and `h` from it the tangent
/// plane of the cone is at the distance `h cos φ − (V − a) sin φ`.
fn lies_beside_light<T: Scalar>(
    from: BoundingSphere<T>,
    light: Vec3<T>,
    other: BoundingSphere<T>,
) -> bool {
    let to_light = light - from.center;
    let to_other = other.center - from.center;
    let light_distance = to_light.dot(to_light).sqrt();
    let other_distance = to_other.dot(to_other).sqrt();
    let radii = from.radius + other.radius;
    let lengths = light_distance + size(from.center) + size(light) + size(other.center);
    let margin = margin(lengths, radii);
    let is_apart = other_distance > radii + margin;
    if !(light_distance > from.radius) {
        // The light is in the sphere, and so is the hull.
        return is_apart;
    }
    let axis = to_light * (T::ONE / light_distance);
    let along = to_other.dot(axis);
    let across = to_other - axis * along;
    let height = across.dot(across).sqrt();
    let sine = from.radius / light_distance;
    let cosine = (T::ONE - sine * sine).sqrt();
    let beside = height * cosine - (light_distance - along) * sine > other.radius + margin;
    let beyond = along > light_distance + other.radius + margin;
    let behind = along < T::ZERO && is_apart;
    beside || beyond || behind
}

/// Whether a ray that leaves the inside of a sphere starts there. If it is as small as the rounding of its coordinates, the
/// ray may start anywhere near.
fn has_inside<T: Scalar>(sphere: &Sphere<T>) -> bool {
    sphere.radius() > margin(size(sphere.center()), T::ZERO)
}

/// Whether no light reaches a side: inside a sphere that casts a shadow, from lights outside.
fn is_shadowed<T: Scalar>(scene: &Source<'_, T>, object: Object<'_, T>, front: bool) -> bool {
    let Object::Sphere(sphere) = object else {
        return false;
    };
    !front
        && casts_shadow(scene, object)
        && has_inside(sphere)
        && scene.lights.iter().all(|light| {
            let to_light = light.position - sphere.center();
            let lengths = size(light.position) + size(sphere.center());
            let reach = sphere.radius() + margin(lengths, sphere.radius());
            to_light.dot(to_light).sqrt() > reach
        })
}

/// Whether an object casts a shadow; one without a material does.
fn casts_shadow<T: Scalar>(scene: &Source<'_, T>, object: Object<'_, T>) -> bool {
    scene
        .materials
        .get(object.info().material as usize)
        .is_none_or(|material| material.casts_shadow())
}
