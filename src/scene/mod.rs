//! A scene: borrowed slices, wherever they are stored.

mod stages;

use crate::accel::{Accel, Source};
use crate::background::Background;
use crate::camera::{Camera, Resolution};
use crate::color::Color;
use crate::light::Light;
use crate::material::{Material, MaterialDescription};
use crate::scalar::Scalar;
use crate::shape::{Geometry, Object, ObjectInfo, Plane, Sphere, Stored, Triangle};
use crate::vec3::Vec3;

/// A view of a scene in [`ScenePools`](crate::ScenePools) or in flash; copying it copies no object.
///
/// What was derived from a scene ([`Accel`]) goes with it: methods that change what it was derived from drop it, so that a picture
/// may take longer but is never wrong. ([`PoolsMut::prepare`](crate::pools::PoolsMut::prepare) and baking derive it.) An object whose material index is out of
/// range shows the background.
///
/// ```
/// use scanray::{Light, Scene, ScenePools, Tracer, Vec3};
///
/// # let mut pools: ScenePools = ScenePools::new();
/// # #[cfg(feature = "parser")]
/// pools.parse(include_bytes!("../../scenes/default.txt"))?;
/// let scene = pools.as_scene();
/// let mine = [Light { position: Vec3::new(-3.0, 9.0, 0.0), ..Light::WHITE }];
/// let tracer = Tracer::new(scene.with_lights(&mine));
/// # let _ = tracer;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scene<'a, T = f32> {
    pub(crate) camera: Camera<T>,
    pub(crate) resolution: Resolution,
    pub(crate) ambient: T,
    pub(crate) background: Background<T>,
    pub(crate) lights: &'a [Light<T>],
    pub(crate) geometry: Geometry<'a, T>,
    pub(crate) materials: &'a [Material<T>],
    pub(crate) accel: Accel<'a, T>,
}

impl<'a, T: Scalar> Scene<'a, T> {
    /// No objects, no lights, a black background, no pixels.
    // All bits of it but the lengths' are zero, so that empty pools in a `static` take no flash.
    pub const EMPTY: Self = Self {
        camera: Camera {
            position: Vec3::new(T::ZERO, T::ZERO, T::ZERO),
        },
        resolution: Resolution {
            width: 0,
            height: 0,
        },
        ambient: T::ZERO,
        background: Background {
            color: Color::BLACK,
            sky: false,
        },
        lights: &[],
        geometry: Geometry::NONE,
        materials: &[],
        accel: Accel::NONE,
    };

    /// The scene seen by another camera.
    #[must_use]
    pub const fn with_camera(mut self, camera: Camera<T>) -> Self {
        self.camera = camera;
        self
    }

    /// The scene with another size of its picture.
    #[must_use]
    pub const fn with_resolution(mut self, resolution: Resolution) -> Self {
        self.resolution = resolution;
        self
    }

    /// The scene in another ambient light; drops what was derived, of which a part depends on it.
    #[must_use]
    pub const fn with_ambient(mut self, ambient: T) -> Self {
        self.ambient = ambient;
        self.without_accel()
    }

    /// The scene before another background.
    #[must_use]
    pub const fn with_background(mut self, background: Background<T>) -> Self {
        self.background = background;
        self
    }

    /// The scene in other lights; drops what was derived.
    #[must_use]
    pub const fn with_lights(mut self, lights: &'a [Light<T>]) -> Self {
        self.lights = lights;
        self.without_accel()
    }

    /// The scene of other objects; drops what was derived.
    #[must_use]
    pub const fn with_geometry(mut self, geometry: Geometry<'a, T>) -> Self {
        self.geometry = geometry;
        self.without_accel()
    }

    /// The scene with other spheres; drops what was derived.
    #[must_use]
    pub const fn with_spheres(mut self, spheres: &'a [Sphere<T>]) -> Self {
        self.geometry.spheres = spheres;
        self.without_accel()
    }

    /// The scene with other planes; drops what was derived.
    #[must_use]
    pub const fn with_planes(mut self, planes: &'a [Plane<T>]) -> Self {
        self.geometry.planes = planes;
        self.without_accel()
    }

    /// The scene with other triangles; drops what was derived.
    #[must_use]
    pub const fn with_triangles(mut self, triangles: &'a [Triangle<T>]) -> Self {
        self.geometry.triangles = triangles;
        self.without_accel()
    }

    /// For baked scenes: the objects of the shapes that few scenes have; drops what was derived.
    #[doc(hidden)]
    #[must_use]
    pub const fn with_stored(mut self, stored: Stored<'a, T>) -> Self {
        self.geometry.stored = stored;
        self.without_accel()
    }

    /// The scene of other materials; drops what was derived.
    #[must_use]
    pub const fn with_materials(mut self, materials: &'a [Material<T>]) -> Self {
        self.materials = materials;
        self.without_accel()
    }

    /// The scene without what was derived: the same picture by testing every object.
    #[must_use]
    pub const fn without_accel(mut self) -> Self {
        self.accel = Accel::NONE;
        self
    }

    /// For baked scenes alone: nothing checks that it belongs to the scene.
    #[doc(hidden)]
    #[must_use]
    pub const fn with_accel(mut self, accel: Accel<'a, T>) -> Self {
        self.accel = accel;
        self
    }

    /// Where it is seen from.
    pub const fn camera(&self) -> Camera<T> {
        self.camera
    }

    /// Size of its picture, unless the tracer is told otherwise.
    pub const fn resolution(&self) -> Resolution {
        self.resolution
    }

    /// Intensity of the ambient light.
    pub const fn ambient(&self) -> T {
        self.ambient
    }

    /// What is behind everything.
    pub const fn background(&self) -> Background<T> {
        self.background
    }

    /// Lights.
    pub const fn lights(&self) -> &'a [Light<T>] {
        self.lights
    }

    /// The objects, kind by kind.
    pub const fn geometry(&self) -> Geometry<'a, T> {
        self.geometry
    }

    /// Spheres.
    pub const fn spheres(&self) -> &'a [Sphere<T>] {
        self.geometry.spheres
    }

    /// Planes.
    pub const fn planes(&self) -> &'a [Plane<T>] {
        self.geometry.planes
    }

    /// Triangles.
    pub const fn triangles(&self) -> &'a [Triangle<T>] {
        self.geometry.triangles
    }

    /// Materials, which the objects share.
    pub const fn materials(&self) -> &'a [Material<T>] {
        self.materials
    }

    /// What was derived.
    pub const fn accel(&self) -> &Accel<'a, T> {
        &self.accel
    }

    /// Number of objects.
    pub const fn object_count(&self) -> usize {
        self.geometry.count()
    }

    /// The object of an index among all: spheres first, then planes, then triangles.
    pub fn object(&self, index: usize) -> Option<Object<'a, T>> {
        self.geometry.object(index)
    }

    /// Whether a light is so near to a surface that rounding may decide on which side of it: shadow rays then take longer.
    pub fn has_light_on_surface(&self) -> bool {
        !self.accel.lights_are_clear && !self.source().are_lights_clear()
    }

    /// The objects of all shapes, in the order of the text.
    pub fn objects(&self) -> impl Iterator<Item = Object<'a, T>> + use<'a, T> {
        self.geometry.in_text_order()
    }

    /// What a surface is made of; all numbers are 0 if the scene has no such material.
    pub fn material(&self, info: ObjectInfo) -> MaterialDescription<T> {
        self.materials
            .get(info.material as usize)
            .map(|m| *m.description())
            .unwrap_or_default()
    }

    /// What candidates and boxes are derived from.
    pub(crate) const fn source(&self) -> Source<'a, T> {
        Source {
            geometry: self.geometry,
            lights: self.lights,
            materials: self.materials,
        }
    }

    /// Ambient light that a material sends back.
    #[inline(always)]
    pub(crate) fn ambient_color(&self, material: &MaterialDescription<T>) -> Color<T> {
        material.ambient * self.ambient
    }
}
