//! The scene as it is stored, for programs.

use scanray::{MaterialDescription, Scalar, Scene, shape::Object, shape::Shape};
use serde::Serialize;

use crate::json_numbers::{Number, Triple, color, number, vector};

/// A scene.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct SceneReport {
    scene: String,
    scalar: &'static str,
    camera: Triple,
    width: u16,
    height: u16,
    lights: Vec<LightReport>,
    ambient: Number,
    sky: bool,
    background: Triple,
    /// In the order of the text.
    objects: Vec<ObjectReport>,
}

#[derive(Clone, Debug, Serialize)]
struct LightReport {
    position: Triple,
    specular: Triple,
    diffuse: Triple,
}

#[derive(Clone, Debug, Serialize)]
struct ObjectReport {
    kind: &'static str,
    #[serde(flatten)]
    shape: ShapeReport,
    material: MaterialReport,
}

#[derive(Clone, Debug, Serialize)]
#[serde(untagged)]
enum ShapeReport {
    Sphere {
        center: Triple,
        radius: Number,
    },
    Plane {
        normal: Triple,
        distance: Number,
    },
    Triangle {
        vertices: [Triple; 3],
        normal: Triple,
    },
    Disc {
        center: Triple,
        normal: Triple,
        radius: Number,
    },
    /// There is no other.
    Other {},
}

#[derive(Clone, Debug, Serialize)]
struct MaterialReport {
    diffuse: Triple,
    specular: Triple,
    ambient: Triple,
    reflection: Number,
    shininess: Number,
    refraction: Number,
    index_of_refraction: Number,
}

impl SceneReport {
    pub(crate) fn new<T: Scalar>(name: String, scene: &Scene<'_, T>) -> Self {
        let size = scene.resolution();
        let lights = scene.lights().iter().map(|light| LightReport {
            position: vector(light.position),
            specular: color(light.specular),
            diffuse: color(light.diffuse),
        });
        let objects = scene.objects().map(|object| ObjectReport {
            kind: object.kind().name(),
            shape: shape(&object),
            material: material(&scene.material(object.info())),
        });
        Self {
            scene: name,
            scalar: T::NAME,
            camera: vector(scene.camera().position),
            width: size.width,
            height: size.height,
            lights: lights.collect(),
            ambient: number(scene.ambient()),
            sky: scene.background().sky,
            background: color(scene.background().color),
            objects: objects.collect(),
        }
    }
}

fn shape<T: Scalar>(object: &Object<'_, T>) -> ShapeReport {
    match object.shape() {
        Shape::Sphere { center, radius } => ShapeReport::Sphere {
            center: vector(center),
            radius: number(radius),
        },
        Shape::Plane { normal, distance } => ShapeReport::Plane {
            normal: vector(normal),
            distance: number(distance),
        },
        Shape::Triangle(vertices) => ShapeReport::Triangle {
            vertices: vertices.map(vector),
            normal: match object {
                Object::Triangle(triangle) => vector(triangle.normal()),
                _ => [number(T::ZERO); 3],
            },
        },
        Shape::Disc {
            center,
            normal,
            radius,
        } => ShapeReport::Disc {
            center: vector(center),
            normal: vector(normal),
            radius: number(radius),
        },
        _ => ShapeReport::Other {},
    }
}

fn material<T: Scalar>(material: &MaterialDescription<T>) -> MaterialReport {
    MaterialReport {
        diffuse: color(material.diffuse),
        specular: color(material.specular),
        ambient: color(material.ambient),
        reflection: number(material.reflection),
        shininess: number(material.shininess),
        refraction: number(material.refraction),
        index_of_refraction: number(material.index_of_refraction),
    }
}
