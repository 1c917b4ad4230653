//! What the camera can see in a row of pixels.

use super::{ObjectSet, collect, margin, size};
use crate::camera::Camera;
use crate::scalar::Scalar;
use crate::shape::{BoundingSphere, Geometry, Object, Plane};
use crate::vec3::Vec3;

/// The objects that the camera's rays in the directions `(x, image_plane_y, 1)`, `|x| ≤ half_width`, can
/// hit.
pub(crate) fn visible_in_row<T: Scalar>(
    geometry: &Geometry<'_, T>,
    camera: &Camera<T>,
    image_plane_y: T,
    half_width: T,
) -> ObjectSet {
    let row = Row {
        origin: camera.position,
        height: image_plane_y,
        half_width,
        scale_squared: T::ONE + image_plane_y * image_plane_y,
    };
    collect(geometry, |object| {
        match (object, object.bounding_sphere()) {
            (Object::Plane(plane), _) => row.may_show_plane(plane),
            (_, Some(bounds)) => row.may_show_sphere(bounds),
            _ => true,
        }
    })
}

/// The flat sector of the rays of a row.
struct Row<T> {
    origin: Vec3<T>,
    height: T,
    half_width: T,
    /// How many times larger the square of `y − height·z` is than that of the distance from the plane of
    /// the row.
    scale_squared: T,
}

impl<T: Scalar> Row<T> {
    fn may_show_sphere(&self, bounds: BoundingSphere<T>) -> bool {
        let f = bounds.center - self.origin;
        // The tracer's tests begin with the same difference: coordinates add no rounding of their own.
        let reach = bounds.radius + margin(size(f), bounds.radius);
        let across = f.y - self.height * f.z;
        // Not on the row, or behind the camera.
        !(across * across > reach * reach * self.scale_squared || -f.z > reach)
    }

    /// A plane is hit where its slope along the ray has the sign of its height above the camera, which
    /// does not depend on the distance.
    fn may_show_plane(&self, plane: &Plane<T>) -> bool {
        let n = plane.normal();
        let slope = n.y * self.height + n.z;
        let spread = n.x.abs() * self.half_width
            + margin(T::ONE + self.height.abs() + self.half_width, T::ZERO);
        if plane.height() > n.dot(self.origin) {
            slope + spread > T::ZERO
        } else {
            slope - spread < T::ZERO
        }
    }
}
