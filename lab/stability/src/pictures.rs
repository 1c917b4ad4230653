//! Small pictures of the telling cases: by scanray in `f32`, by the textbook's forms in `f32`, by scanray in
//! `f64`.

use rayon::prelude::*;
use scanray::{Background, Color, MaterialDescription, Resolution, Tracer, Vec3};

use crate::scenes::{self, Model, Part, Shape};
use crate::settled::{View, level_distance, levels};
use crate::textbook::Textbook;

/// Size of each picture.
pub const SIZE: Resolution = Resolution {
    width: 160,
    height: 120,
};

/// How many secondary rays may follow one another.
const DEPTH: usize = 5;

/// A case that shows what stiffness does.
#[derive(Clone, Debug)]
pub struct Telling {
    /// Its name, as in a file's.
    pub name: &'static str,
    /// What is seen, in words.
    pub title: &'static str,
    model: Model<f64>,
    half_height: f64,
}

/// The three pictures of a telling case, row by row.
#[derive(Clone, Debug)]
pub struct Pictures {
    /// By scanray in `f32`.
    pub single: Vec<[u8; 3]>,
    /// By the textbook's forms in `f32`, with a fixed least distance of 1e-3.
    pub textbook: Vec<[u8; 3]>,
    /// By scanray in `f64`.
    pub double: Vec<[u8; 3]>,
}

impl Pictures {
    /// The share of a picture's pixels that are more than one level off that in `f64`.
    pub fn share_off(&self, picture: &[[u8; 3]]) -> f64 {
        let pairs = picture.iter().zip(&self.double);
        let off = pairs.filter(|(a, b)| level_distance(**a, **b) > 1).count();
        off as f64 / self.double.len() as f64
    }
}

fn v(x: f64, y: f64, z: f64) -> Vec3<f64> {
    Vec3::new(x, y, z)
}

fn default_scene() -> Model<f64> {
    let mut model = Model::of(&scenes::load::<f64>("default").as_scene());
    model.resolution = SIZE;
    model
}

fn scaled(factor: f64) -> Model<f64> {
    default_scene().mapped(|point| point * factor, |normal| normal, factor)
}

fn lacquer(r: f64, g: f64, b: f64) -> MaterialDescription<f64> {
    let color = Color::new(r, g, b);
    MaterialDescription {
        diffuse: color,
        ambient: color * 0.25,
        specular: Color::new(0.5, 0.5, 0.5),
        shininess: 30.0,
        reflection: 0.2,
        ..Default::default()
    }
}

/// Three spheres on a floor around the origin, seen from a distance.
fn three_spheres(distance: f64) -> Model<f64> {
    let mut model = default_scene();
    model.camera = v(0.0, 0.3 * distance.min(3.0), -distance);
    model.background = Background {
        color: Color::new(0.5, 0.6, 0.8),
        sky: false,
    };
    model.ambient = 1.0;
    model.lights[0].position = v(6.0, 9.0, -7.0);
    let ball = |x, z, material| Part {
        shape: Shape::Sphere {
            center: v(x, 0.0, z),
            radius: 1.0,
        },
        material,
    };
    model.parts = vec![
        Part {
            shape: Shape::Plane {
                normal: v(0.0, 1.0, 0.0),
                distance: 1.0,
            },
            material: lacquer(0.5, 0.5, 0.5),
        },
        ball(-2.1, 0.0, lacquer(0.8, 0.2, 0.2)),
        ball(0.0, 1.0, lacquer(0.2, 0.7, 0.2)),
        ball(2.1, 0.0, lacquer(0.2, 0.3, 0.8)),
    ];
    model
}

/// Sixty slivers from one point, each 500 times as long as wide, a few millionths of a unit in all.
fn sliver_fan() -> Model<f64> {
    const SLIVERS: i32 = 60;
    let scale = 1e-3;
    let mut model = default_scene();
    model.ambient = 1.0;
    model.background = Background {
        color: Color::new(1.0, 0.5, 0.0),
        sky: false,
    };
    model.lights[0].diffuse = Color::BLACK;
    model.lights[0].specular = Color::BLACK;
    let ray = |i: i32| {
        let y = 0.24 * (f64::from(i) / f64::from(SLIVERS) - 0.5);
        v(1.0, y, 3.0) * scale
    };
    model.parts = (0..SLIVERS)
        .map(|i| {
            let level = 0.2 + 0.5 * f64::from(i % 3) / 2.0;
            Part {
                shape: Shape::Triangle([v(-1.0, 0.0, 3.0) * scale, ray(i), ray(i + 1)]),
                material: MaterialDescription {
                    ambient: Color::new(0.3 * level, 0.6 * level, level),
                    ..Default::default()
                },
            }
        })
        .collect();
    model
}

/// The default scene through a glass sphere that hardly bends.
fn thin_glass() -> Model<f64> {
    let mut model = default_scene();
    model.parts.push(Part {
        shape: Shape::Sphere {
            center: v(0.3, 0.3, 1.2),
            radius: 0.45,
        },
        material: MaterialDescription {
            refraction: 1.0,
            index_of_refraction: 1.000_1,
            ..Default::default()
        },
    });
    model
}

impl Telling {
    /// All telling cases.
    pub fn all() -> Vec<Self> {
        let case = |name, title, model, half_height| Self {
            name,
            title,
            model,
            half_height,
        };
        let mut distant = three_spheres(1e4);
        // In no plane's way, for the sphere's silhouette alone.
        distant.parts.remove(0);
        let (telephoto, half_height) = crate::catalogue::telephoto(1e5);
        let telephoto = Model {
            resolution: SIZE,
            ..telephoto
        };
        vec![
            case(
                "radius-over-distance-1e-4",
                "spheres of radius 1 from a distance of 10,000, through a long lens",
                distant,
                2.6e-4,
            ),
            case(
                "scale-1e-4",
                "the default scene at a ten-thousandth of its size",
                scaled(1e-4),
                1.0,
            ),
            case(
                "scale-1e4",
                "the default scene at ten thousand times its size",
                scaled(1e4),
                1.0,
            ),
            case(
                "camera-1e3-radii-away",
                "spheres of radius 1 on a floor from a distance of 1,000, through a long lens",
                three_spheres(1e3),
                2.6e-3,
            ),
            case(
                "telephoto-1e5",
                "the default scene from 100,000 times as far, through a lens 100,000 times as long",
                telephoto,
                half_height,
            ),
            case(
                "sliver-fan",
                "a fan of 60 slivers, 0.002 long and 500 times as long as wide",
                sliver_fan(),
                0.06,
            ),
            case(
                "glass-of-index-1.0001",
                "the default scene through a glass sphere of index 1.0001",
                thin_glass(),
                1.0,
            ),
        ]
    }

    /// Draws the three pictures.
    pub fn draw(&self) -> Pictures {
        let (single, double) = (self.model.rounded::<f32>().build(), self.model.build());
        let (single, double) = (single.as_scene(), double.as_scene());
        let (half_height, size) = (self.half_height, SIZE);
        let single_view = View {
            position: single.camera().position,
            size,
            half_height,
        };
        let double_view = View {
            position: double.camera().position,
            size,
            half_height,
        };
        let single_tracer = Tracer::new(single);
        let double_tracer = Tracer::new(double);
        let textbook = Textbook::new(single, DEPTH);
        let still = (0.0, 0.0);
        let pixels: Vec<_> = (0..size.height)
            .into_par_iter()
            .flat_map_iter(|y| (0..size.width).map(move |x| (x, y)))
            .map(|pixel| {
                let ray = single_view.ray(pixel, still);
                let exact = double_view.ray(pixel, still);
                [
                    levels(single_tracer.radiance(ray)),
                    levels(textbook.radiance(&ray)),
                    levels(double_tracer.radiance(exact)),
                ]
            })
            .collect();
        let picture = |which: usize| pixels.iter().map(|pixel| pixel[which]).collect();
        Pictures {
            single: picture(0),
            textbook: picture(1),
            double: picture(2),
        }
    }
}
