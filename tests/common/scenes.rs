//! The scenes of the repository, and scenes that are built from them.

use std::path::PathBuf;

use scanray::{
    Background, Camera, Color, FromDecimal, Light, MaterialDescription, Object, PoolsMut,
    Resolution, Scalar, Scene, SceneError, ScenePools, Vec3,
};

/// A file of the repository.
pub(crate) fn path(relative: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join(relative)
}

/// The names of all scenes in scenes/, in alphabetical order.
pub(crate) fn names() -> Vec<String> {
    let mut names: Vec<String> = std::fs::read_dir(path("scenes"))
        .expect("the folder scenes/ can be read")
        .map(|entry| entry.expect("an entry of scenes/ can be read").path())
        .filter(|file| file.extension().is_some_and(|extension| extension == "txt"))
        .map(|file| file.file_stem().unwrap().to_str().unwrap().to_owned())
        .collect();
    names.sort();
    assert!(names.iter().any(|name| name == "default"), "{names:?}");
    names
}

/// The text of a scene in scenes/.
pub(crate) fn text(name: &str) -> Vec<u8> {
    let file = path(&format!("scenes/{name}.txt"));
    std::fs::read(&file).unwrap_or_else(|error| panic!("{}: {error}", file.display()))
}

/// A scene of scenes/, in pools of the default capacities, which promise to hold it.
pub(crate) fn load<T: Scalar + FromDecimal>(name: &str) -> ScenePools<T> {
    let mut pools = ScenePools::new();
    if let Err(error) = pools.parse(&text(name)) {
        panic!("scenes/{name}.txt: {error}");
    }
    pools
}

/// Pools with room for a scene of scenes/ and more.
pub(crate) type RoomyPools<T> = ScenePools<T, 64, 16, 64, 64, 4, 144>;

/// An object in the numbers that make it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Part<T> {
    pub(crate) shape: Shape<T>,
    pub(crate) material: MaterialDescription<T>,
}

/// The geometry of a [`Part`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Shape<T> {
    Sphere { center: Vec3<T>, radius: T },
    Plane { normal: Vec3<T>, distance: T },
    Triangle([Vec3<T>; 3]),
}

impl<T: Scalar> Part<T> {
    pub(crate) fn add_to(&self, pools: &mut PoolsMut<'_, T>) -> Result<(), SceneError> {
        match self.shape {
            Shape::Sphere { center, radius } => pools.add_sphere(center, radius, self.material),
            Shape::Plane { normal, distance } => pools.add_plane(normal, distance, self.material),
            Shape::Triangle(vertices) => pools.add_triangle(vertices, self.material),
        }
    }
}

/// A scene taken apart, to be changed and built again.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Model<T> {
    pub(crate) camera: Vec3<T>,
    pub(crate) resolution: Resolution,
    pub(crate) ambient: T,
    pub(crate) background: Background<T>,
    pub(crate) lights: Vec<Light<T>>,
    pub(crate) parts: Vec<Part<T>>,
}

impl<T: Scalar> Model<T> {
    pub(crate) fn of(scene: &Scene<'_, T>) -> Self {
        let parts = scene
            .objects()
            .map(|object| Part {
                material: scene.material(object.surface()),
                shape: match object {
                    Object::Sphere(sphere) => Shape::Sphere {
                        center: sphere.center(),
                        radius: sphere.radius(),
                    },
                    Object::Plane(plane) => Shape::Plane {
                        normal: plane.normal(),
                        distance: -plane.height(),
                    },
                    Object::Triangle(triangle) => Shape::Triangle(triangle.vertices()),
                },
            })
            .collect();
        Self {
            camera: scene.camera.position,
            resolution: scene.resolution,
            ambient: scene.ambient,
            background: scene.background,
            lights: scene.lights.to_vec(),
            parts,
        }
    }

    /// The model with every point changed by a map that keeps angles, and every length scaled with it.
    pub(crate) fn mapped(
        &self,
        point: impl Fn(Vec3<T>) -> Vec3<T>,
        normal: impl Fn(Vec3<T>) -> Vec3<T>,
        scale: T,
    ) -> Self {
        let mut model = self.clone();
        model.camera = point(model.camera);
        for light in &mut model.lights {
            light.position = point(light.position);
        }
        for part in &mut model.parts {
            part.shape = match part.shape {
                Shape::Sphere { center, radius } => Shape::Sphere {
                    center: point(center),
                    radius: radius * scale,
                },
                Shape::Plane {
                    normal: n,
                    distance,
                } => Shape::Plane {
                    normal: normal(n),
                    distance: distance * scale,
                },
                Shape::Triangle(vertices) => Shape::Triangle(vertices.map(&point)),
            };
        }
        model
    }

    pub(crate) fn build(&self) -> RoomyPools<T> {
        let mut pools = RoomyPools::new();
        let mut filling = pools.as_mut();
        filling.set_camera(Camera {
            position: self.camera,
        });
        filling.set_resolution(self.resolution);
        filling.set_ambient(self.ambient);
        filling.set_background(self.background);
        for light in &self.lights {
            filling.add_light(*light).unwrap();
        }
        for part in &self.parts {
            part.add_to(&mut filling)
                .unwrap_or_else(|error| panic!("{part:?}: {error}"));
        }
        pools
    }
}

/// A material that shows nothing of its own and lets everything through: index 1, refraction 1.
pub(crate) fn invisible<T: Scalar>() -> MaterialDescription<T> {
    MaterialDescription {
        diffuse: Color::BLACK,
        specular: Color::BLACK,
        ambient: Color::BLACK,
        reflection: T::ZERO,
        shininess: T::ZERO,
        refraction: T::ONE,
        index_of_refraction: T::ONE,
    }
}
