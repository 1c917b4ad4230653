//! The scenes of the repository, and scenes that are built from them.

use std::path::{Path, PathBuf};

pub use scanray::shape::Shape;
use scanray::shape::Transform;
use scanray::{
    Background, Camera, Color, Light, MaterialDescription, Resolution, Scalar, Scene, SceneError,
    ScenePools, Vec3, parser::FromDecimal, pools::PoolsMut,
};

/// A file of the repository.
pub fn path(relative: &str) -> PathBuf {
    let package = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut folders = package.ancestors();
    let root = folders.find(|folder| folder.join("scenes/default.txt").exists());
    root.unwrap_or(package).join(relative)
}

/// The scenes of scenes/ by name, in alphabetical order.
pub(crate) const SCENES: &[(&str, &[u8])] = &[
    ("default", include_bytes!("../../scenes/default.txt")),
    (
        "mirror-room",
        include_bytes!("../../scenes/mirror-room.txt"),
    ),
    ("pyramids", include_bytes!("../../scenes/pyramids.txt")),
    ("reflective", include_bytes!("../../scenes/reflective.txt")),
    (
        "window-room",
        include_bytes!("../../scenes/window-room.txt"),
    ),
];

/// The names of all scenes in scenes/, in alphabetical order.
pub fn names() -> Vec<String> {
    SCENES.iter().map(|(name, _)| (*name).to_owned()).collect()
}

/// The text of a scene in scenes/.
pub fn text(name: &str) -> Vec<u8> {
    let scene = SCENES.iter().find(|(known, _)| *known == name);
    scene.expect("the name of a scene").1.to_vec()
}

/// A scene of scenes/, in pools of the default capacities, which promise to hold it.
pub fn load<T: Scalar + FromDecimal>(name: &str) -> ScenePools<T> {
    let mut pools = ScenePools::new();
    if let Err(error) = pools.parse(&text(name)) {
        panic!("scenes/{name}.txt: {error}");
    }
    pools
}

/// Pools with room for a scene of scenes/ and more.
pub type RoomyPools<T> = ScenePools<T, 64, 16, 64, 64, 4, 144>;

/// An object in the numbers that make it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Part<T> {
    /// Its geometry.
    pub shape: Shape<T>,
    /// What it is made of.
    pub material: MaterialDescription<T>,
}

impl<T: Scalar> Part<T> {
    /// Adds the object to pools.
    ///
    /// # Errors
    ///
    /// Those of the pools.
    pub fn add_to(&self, pools: &mut PoolsMut<'_, T>) -> Result<(), SceneError> {
        pools.add(self.shape, self.material)
    }
}

/// A change of shapes by functions.
struct Mapped<P, N, L> {
    point: P,
    normal: N,
    length: L,
}

impl<T: Scalar, U: Scalar, P, N, L> Transform<T, U> for Mapped<P, N, L>
where
    P: Fn(Vec3<T>) -> Vec3<U>,
    N: Fn(Vec3<T>) -> Vec3<U>,
    L: Fn(T) -> U,
{
    fn point(&self, point: Vec3<T>) -> Vec3<U> {
        (self.point)(point)
    }

    fn normal(&self, normal: Vec3<T>) -> Vec3<U> {
        (self.normal)(normal)
    }

    fn length(&self, length: T) -> U {
        (self.length)(length)
    }
}

/// A scene taken apart, to be changed and built again.
#[derive(Clone, Debug, PartialEq)]
pub struct Model<T> {
    /// Where the camera is.
    pub camera: Vec3<T>,
    /// Size of the picture.
    pub resolution: Resolution,
    /// Intensity of the ambient light.
    pub ambient: T,
    /// What is behind everything.
    pub background: Background<T>,
    /// Lights.
    pub lights: Vec<Light<T>>,
    /// Objects.
    pub parts: Vec<Part<T>>,
}

impl<T: Scalar> Model<T> {
    /// A scene, taken apart.
    pub fn of(scene: &Scene<'_, T>) -> Self {
        let parts = scene
            .objects()
            .map(|object| Part {
                material: scene.material(object.info()),
                shape: object.shape(),
            })
            .collect();
        Self {
            camera: scene.camera().position,
            resolution: scene.resolution(),
            ambient: scene.ambient(),
            background: scene.background(),
            lights: scene.lights().to_vec(),
            parts,
        }
    }

    /// The model with every point changed by a map that keeps angles, and every length scaled with it.
    pub fn mapped(
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
        let map = Mapped {
            point,
            normal,
            length: |length: T| length * scale,
        };
        for part in &mut model.parts {
            part.shape = part.shape.transformed(&map);
        }
        model
    }

    /// The model with every point moved; planes move with it.
    pub fn moved(&self, by: Vec3<T>) -> Self {
        let mut model = self.mapped(|point| point + by, |normal| normal, T::ONE);
        for part in &mut model.parts {
            if let Shape::Plane { normal, distance } = &mut part.shape {
                *distance -= normal.dot(by);
            }
        }
        model
    }

    /// The model with every number rounded to another scalar.
    pub fn rounded<U: Scalar>(&self) -> Model<U> {
        let number = |x: T| U::from_f64(x.to_f64());
        let vector = |v: Vec3<T>| Vec3::new(number(v.x), number(v.y), number(v.z));
        let color = |c: Color<T>| Color::new(number(c.r), number(c.g), number(c.b));
        let part = |part: &Part<T>| Part {
            shape: part.shape.transformed(&Mapped {
                point: vector,
                normal: vector,
                length: number,
            }),
            material: MaterialDescription {
                diffuse: color(part.material.diffuse),
                specular: color(part.material.specular),
                ambient: color(part.material.ambient),
                reflection: number(part.material.reflection),
                shininess: number(part.material.shininess),
                refraction: number(part.material.refraction),
                index_of_refraction: number(part.material.index_of_refraction),
            },
        };
        Model {
            camera: vector(self.camera),
            resolution: self.resolution,
            ambient: number(self.ambient),
            background: Background {
                color: color(self.background.color),
                sky: self.background.sky,
            },
            lights: self
                .lights
                .iter()
                .map(|light| Light {
                    position: vector(light.position),
                    specular: color(light.specular),
                    diffuse: color(light.diffuse),
                })
                .collect(),
            parts: self.parts.iter().map(part).collect(),
        }
    }

    /// Pools that hold the model.
    pub fn build(&self) -> RoomyPools<T> {
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
pub fn invisible<T: Scalar>() -> MaterialDescription<T> {
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_scene_of_the_folder_is_missing() {
        let mut files: Vec<String> = std::fs::read_dir(path("scenes"))
            .unwrap()
            .map(|entry| entry.unwrap().path())
            .filter(|file| file.extension().is_some_and(|extension| extension == "txt"))
            .map(|file| file.file_stem().unwrap().to_str().unwrap().to_owned())
            .collect();
        files.sort();
        assert_eq!(names(), files);
    }
}
