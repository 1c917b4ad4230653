//! Who can meet whom: objects that a ray cannot meet are not tested. (Large scenes: [`tree`].)
//!
//! The tracer asks for the *candidates* of a ray that leaves a given place (a row of the camera, a side
//! of an object, a side towards the lights) and tests only those. A set of candidates may be too large,
//! never too small: with all objects as candidates the picture has the same bits. That holds because an
//! object is excluded only if geometry keeps it away by a margin that is far more than all rounding in
//! the tracer:
//!
//! * Origins lie within a few units of rounding (of the coordinates) of their surface, directions within
//!   a few units of rounding (in radians) of where they point, and the tests report a hit for rays that
//!   pass an object at a few units of rounding of the distance to it: all together well below 32 units.
//! * The margin is 128 units of rounding of `f32` of every length and coordinate that is involved, and
//!   1/4096 of the radii ([`margin`]). `f64` uses the same.
//!
//! Unbounded planes are excluded only where the argument does not depend on how far away they are met.

mod highlights;
mod row;
mod side;
mod tree;
mod zones;

pub(crate) use row::visible_in_row;
pub(crate) use tree::Walk;

use crate::scalar::Scalar;
use crate::scene::{Object, ObjectSet, PoolsMut, Scene, ScenePools};
use crate::vec3::Vec3;

/// A ball around a bounded object.
#[derive(Clone, Copy, Debug)]
struct Ball<T> {
    center: Vec3<T>,
    radius: T,
}

impl<T: Scalar> Ball<T> {
    /// The ball around an object; `None` around a plane, and a triangle so large that the square of its radius is no
    /// number.
    fn around(object: Object<'_, T>) -> Option<Self> {
        match object {
            Object::Sphere(sphere) => Some(Self {
                center: sphere.center(),
                radius: sphere.radius(),
            }),
            Object::Plane(_) => None,
            Object::Triangle(triangle) => {
                let square = triangle.ball_radius_squared();
                (square < T::MAX).then(|| Self {
                    center: triangle.ball_center(),
                    radius: square.sqrt(),
                })
            }
        }
    }
}

/// What keeps an exclusion safe from rounding, for the lengths and coordinates and the radii involved.
fn margin<T: Scalar>(lengths: T, radii: T) -> T {
    T::from_f64(1.0 / 65_536.0) * lengths + T::from_f64(1.0 / 4096.0) * radii
}

/// Sum of the absolute coordinates.
fn size<T: Scalar>(v: Vec3<T>) -> T {
    let v = v.abs();
    v.x + v.y + v.z
}

/// The set of the objects for which something holds.
fn collect<T: Scalar>(
    scene: &Scene<'_, T>,
    mut holds: impl FnMut(Object<'_, T>) -> bool,
) -> ObjectSet {
    const END: usize = ObjectSet::TOLD_APART;
    let (planes, triangles) = (
        scene.spheres.len(),
        scene.spheres.len() + scene.planes.len(),
    );
    let mut set = ObjectSet::NONE;
    for (index, sphere) in (0..END).zip(scene.spheres) {
        if holds(Object::Sphere(sphere)) {
            set = set.with(index);
        }
    }
    for (index, plane) in (planes..END).zip(scene.planes) {
        if holds(Object::Plane(plane)) {
            set = set.with(index);
        }
    }
    for (index, triangle) in (triangles..END).zip(scene.triangles) {
        if holds(Object::Triangle(triangle)) {
            set = set.with(index);
        }
    }
    if scene.object_count() > END {
        // What is not told apart is in every set.
        set = set.with(END);
    }
    set
}

impl<T: Scalar> PoolsMut<'_, T> {
    /// See [`ScenePools::prepare`].
    pub fn prepare(&mut self) {
        self.find_sides();
        self.find_faint_highlights();
        self.build_tree();
    }
}

impl<
    T: Scalar,
    const SPHERES: usize,
    const PLANES: usize,
    const TRIANGLES: usize,
    const MATERIALS: usize,
    const LIGHTS: usize,
    const SIDES: usize,
    const TREE: usize,
> ScenePools<T, SPHERES, PLANES, TRIANGLES, MATERIALS, LIGHTS, SIDES, TREE>
{
    /// Finds out which objects can meet, and builds the tree of a large scene, if the pools have room for
    /// that: the same picture in less time.
    ///
    /// Loading a scene text does this; call it after adding objects by hand. Adding another one undoes
    /// it.
    pub fn prepare(&mut self) {
        let mut pools = self.as_mut();
        pools.find_sides();
        pools.find_zones();
        pools.find_faint_highlights();
        // Not compiled for pools without room.
        if const { TREE > 0 } {
            pools.build_tree();
        }
    }
}
