//! A scene: borrowed slices, wherever they are stored.

mod needs;
mod pools;
mod reach;
mod tree;
mod zones;

pub use needs::Needs;
pub use pools::{Pool, PoolUse, PoolsMut, SceneError, ScenePools};
pub(crate) use reach::Members;
pub use reach::{ObjectSet, Octant, Reach};
pub use tree::{NodeContent, Tree, TreeEntry, TreeNode};
pub use zones::{Strip, Zones};
pub(crate) use zones::{Zone, across};

use crate::background::Background;
use crate::camera::{Camera, Resolution};
use crate::color::Color;
use crate::light::Light;
use crate::material::{Material, MaterialDescription};
use crate::scalar::Scalar;
use crate::shape::{Plane, Sphere, Surface, Triangle};

/// A view of a scene in [`ScenePools`] or in flash; copying it copies no object.
///
/// The tracer relies on the objects of each slice being in the order of their numbers, and on these
/// being different. An object whose material index is out of range shows the background.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scene<'a, T = f32> {
    /// Where it is seen from.
    pub camera: Camera<T>,
    /// Size of its picture, unless the tracer is told otherwise.
    pub resolution: Resolution,
    /// Intensity of the ambient light.
    pub ambient: T,
    /// What is behind everything.
    pub background: Background<T>,
    /// Lights.
    pub lights: &'a [Light<T>],
    /// Spheres.
    pub spheres: &'a [Sphere<T>],
    /// Planes.
    pub planes: &'a [Plane<T>],
    /// Triangles.
    pub triangles: &'a [Triangle<T>],
    /// Materials, which the objects share.
    pub materials: &'a [Material<T>],
    /// What rays can meet that leave each side of each object, by [`Side::index`](crate::Side::index);
    /// where there is no entry, anything.
    pub sides: &'a [Reach],
    /// What rays can meet that leave each plane, by place; where there is no entry, what `sides` says.
    pub zones: &'a [Zones<T>],
    /// Of a large scene, what its spheres and triangles are found by.
    pub tree: Tree<'a, T>,
}

/// An object of a scene, of any shape.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Object<'a, T = f32> {
    /// A sphere.
    Sphere(&'a Sphere<T>),
    /// A plane.
    Plane(&'a Plane<T>),
    /// A triangle.
    Triangle(&'a Triangle<T>),
}

impl<T: Scalar> Object<'_, T> {
    /// Material and place in the file.
    #[inline(always)]
    pub fn surface(&self) -> Surface {
        match self {
            Self::Sphere(sphere) => sphere.surface(),
            Self::Plane(plane) => plane.surface(),
            Self::Triangle(triangle) => triangle.surface(),
        }
    }
}

impl<'a, T: Scalar> Scene<'a, T> {
    /// Number of objects.
    pub const fn object_count(&self) -> usize {
        self.spheres.len() + self.planes.len() + self.triangles.len()
    }

    /// The object of an index among all: spheres first, then planes, then triangles.
    pub fn object(&self, index: usize) -> Option<Object<'a, T>> {
        let after_spheres = index.wrapping_sub(self.spheres.len());
        let after_planes = after_spheres.wrapping_sub(self.planes.len());
        if let Some(sphere) = self.spheres.get(index) {
            Some(Object::Sphere(sphere))
        } else if let Some(plane) = self.planes.get(after_spheres) {
            Some(Object::Plane(plane))
        } else {
            self.triangles.get(after_planes).map(Object::Triangle)
        }
    }

    /// The objects of all shapes, in the order of the file.
    pub fn objects(&self) -> impl Iterator<Item = Object<'a, T>> + use<'a, T> {
        let mut spheres = self.spheres.iter().map(Object::Sphere).peekable();
        let mut planes = self.planes.iter().map(Object::Plane).peekable();
        let mut triangles = self.triangles.iter().map(Object::Triangle).peekable();
        core::iter::from_fn(move || {
            let number = |object: Option<&Object<'a, T>>| object.map(|o| o.surface().number);
            let next = [
                number(spheres.peek()),
                number(planes.peek()),
                number(triangles.peek()),
            ];
            let first = next.iter().flatten().min().copied();
            match next.iter().position(|n| n.is_some() && *n == first) {
                Some(0) => spheres.next(),
                Some(1) => planes.next(),
                _ => triangles.next(),
            }
        })
    }

    /// What a surface is made of; all numbers are 0 if the scene has no such material.
    pub fn material(&self, surface: Surface) -> MaterialDescription<T> {
        self.materials
            .get(surface.material as usize)
            .map(|m| *m.description())
            .unwrap_or_default()
    }

    /// Ambient light that a material sends back.
    #[inline(always)]
    pub(crate) fn ambient_color(&self, material: &MaterialDescription<T>) -> Color<T> {
        material.ambient * self.ambient
    }
}
