//! A loaded scene as scene text, to be read again.

use core::fmt;

use crate::color::Color;
use crate::light::Light;
use crate::material::MaterialDescription;
use crate::scalar::Scalar;
use crate::scene::Scene;
use crate::shape::{Kind, Object, ObjectInfo, Plane};
use crate::vec3::Vec3;

/// A scene as text in the numeric dialect, one record a line, every number with the fewest digits that read
/// back to the same bits: parsing it gives the same scene, derived values and all.
///
/// Planes are written with a normal whose largest component is ±1 and the distance that belongs to it,
/// because that is what normalises to the plane's bits; a unit normal often would not. Triangles are written
/// with zeros for placeholders. A scene without a light has a black one in the text.
///
/// ```
/// let mut pools: scanray::ScenePools = scanray::ScenePools::new();
/// # #[cfg(feature = "parser")] {
/// pools.parse(include_bytes!("../scenes/default.txt"))?;
/// let text = scanray::print(&pools.as_scene())?.to_string();
/// let mut again = pools.clone();
/// again.parse(text.as_bytes())?;
/// assert_eq!(again.as_scene(), pools.as_scene());
/// # }
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
///
/// [`PrintError`] for a scene that no text describes.
pub fn print<'s, T: Scalar>(scene: &'s Scene<'_, T>) -> Result<impl fmt::Display + 's, PrintError> {
    let lights = scene.lights.len();
    if lights > 1 {
        return Err(PrintError::TooManyLights { lights });
    }
    if let Some(kind) = scene
        .objects()
        .map(|object| object.kind())
        .find(is_wordless)
    {
        return Err(PrintError::NoWord { kind });
    }
    Ok(Text(scene))
}

/// Why a scene has no text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum PrintError {
    /// The dialect has one light.
    TooManyLights {
        /// How many there are.
        lights: usize,
    },
    /// The dialect has no such shape.
    NoWord {
        /// The shape.
        kind: Kind,
    },
}

/// Whether the dialect has no word for a shape.
fn is_wordless(kind: &Kind) -> bool {
    !matches!(kind, Kind::Sphere | Kind::Plane | Kind::Triangle)
}

impl fmt::Display for PrintError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TooManyLights { lights } => write!(
                f,
                "scene text has room for one light, and the scene has {lights}"
            ),
            Self::NoWord { kind } => {
                write!(f, "the numeric dialect has no word for a {}", kind.name())
            }
        }
    }
}

impl core::error::Error for PrintError {}

struct Text<'s, T>(&'s Scene<'s, T>);

impl<T: Scalar> fmt::Display for Text<'_, T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let scene = self.0;
        writeln!(f, "{}", scene.object_count())?;
        writeln!(f, "{}", Numbers(&vector(scene.camera.position)))?;
        let size = scene.resolution;
        writeln!(f, "{} {}", size.width, size.height)?;
        let light = scene.lights.first().copied().unwrap_or(Light {
            position: Vec3::new(T::ZERO, T::ZERO, T::ZERO),
            specular: Color::BLACK,
            diffuse: Color::BLACK,
        });
        writeln!(
            f,
            "{} {} {}",
            Numbers(&vector(light.position)),
            Numbers(&color(light.specular)),
            Numbers(&color(light.diffuse))
        )?;
        writeln!(f, "{}", Numbers(&[scene.ambient]))?;
        writeln!(f, "{}", u8::from(scene.background.sky))?;
        writeln!(f, "{}", Numbers(&color(scene.background.color)))?;
        for object in scene.objects() {
            match object {
                Object::Sphere(sphere) => write!(
                    f,
                    "0 {} {}",
                    Numbers(&vector(sphere.center())),
                    Numbers(&[sphere.radius()])
                )?,
                Object::Plane(plane) => {
                    let (normal, distance) = plane_numbers(plane);
                    write!(f, "1 {} {}", Numbers(&vector(normal)), Numbers(&[distance]))?;
                }
                Object::Triangle(triangle) => {
                    f.write_str("2")?;
                    for vertex in triangle.vertices() {
                        write!(f, " {}", Numbers(&vector(vertex)))?;
                    }
                    write!(f, " {}", Numbers(&[T::ZERO; 4]))?;
                }
                // `print` has refused others.
                _ => return Err(fmt::Error),
            }
            writeln!(f, " {}", Material(&scene.material(object.info())))?;
        }
        Ok(())
    }
}

struct Material<'s, T>(&'s MaterialDescription<T>);

impl<T: Scalar> fmt::Display for Material<'_, T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let m = self.0;
        let colors = [m.diffuse, m.specular, m.ambient].map(color);
        write!(
            f,
            "{} {}",
            Numbers(colors.as_flattened()),
            Numbers(&[
                m.reflection,
                m.shininess,
                m.refraction,
                m.index_of_refraction
            ])
        )
    }
}

/// Numbers with a blank between them.
struct Numbers<'s, T>(&'s [T]);

impl<T: Scalar> fmt::Display for Numbers<'_, T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut separator = "";
        for number in self.0 {
            // `Debug` writes the shortest digits that read back to the same bits.
            write!(f, "{separator}{number:?}")?;
            separator = " ";
        }
        Ok(())
    }
}

fn vector<T>(v: Vec3<T>) -> [T; 3] {
    [v.x, v.y, v.z]
}

fn color<T>(c: Color<T>) -> [T; 3] {
    [c.r, c.g, c.b]
}

/// A normal and a distance from which [`Plane::new`] makes this very plane.
///
/// Loading divides the normal by its largest component, which leaves a vector `s` with a component ±1, and
/// then by the length `l` of `s`. So `s` itself makes the same plane, and it is found from the unit normal
/// `n`: `l` is next to `1/|largest component of n|`, the other components of `s` are next to `n·l`, and the
/// distance is next to `−height·l`. A plane that loading has not made may have no such numbers; it is
/// written as it is.
fn plane_numbers<T: Scalar>(plane: &Plane<T>) -> (Vec3<T>, T) {
    let (normal, height) = (plane.normal(), plane.height());
    let makes_it = |normal, distance| {
        let info = ObjectInfo {
            material: 0,
            number: 0,
        };
        Plane::new(normal, distance, info)
            .is_ok_and(|made| made.normal() == plane.normal() && made.height() == height)
    };
    if makes_it(normal, -height) {
        return (normal, -height);
    }
    let largest = normal.abs().max_component();
    let scaled = |component: T, length: T, steps: i32| {
        if component.abs() == largest {
            component / largest
        } else {
            neighbour(component * length, steps)
        }
    };
    const REACH: core::ops::RangeInclusive<i32> = -5..=5;
    for of_length in REACH {
        let length = neighbour(T::ONE / largest, of_length);
        for of_x in REACH {
            for of_y in REACH {
                for of_z in REACH {
                    let candidate = Vec3::new(
                        scaled(normal.x, length, of_x),
                        scaled(normal.y, length, of_y),
                        scaled(normal.z, length, of_z),
                    );
                    let is_it = candidate
                        .try_normalize()
                        .is_some_and(|(unit, _)| unit == normal);
                    if !is_it {
                        continue;
                    }
                    let length = candidate.dot(candidate).sqrt();
                    for of_distance in REACH {
                        let distance = neighbour(-height * length, of_distance);
                        if makes_it(candidate, distance) {
                            return (candidate, distance);
                        }
                    }
                }
            }
        }
    }
    (normal, -height)
}

/// A number some half units of rounding away, relative to it; the smallest step is one number. Zero is its
/// own only neighbour, and keeps its sign.
fn neighbour<T: Scalar>(x: T, half_units: i32) -> T {
    if x == T::ZERO {
        return x;
    }
    x + x * (T::EPSILON * T::HALF * T::from_i32(half_units))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn planes_are_found_again_whatever_their_normal_was() {
        let info = ObjectInfo {
            material: 0,
            number: 0,
        };
        let mut state = 1_u64;
        let mut random = || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (state >> 40) as f32 / (1_u64 << 23) as f32 - 1.0
        };
        let rounds = if cfg!(miri) { 20 } else { 20_000 };
        for round in 0..rounds {
            let zero = if round % 2 == 0 { 0.0 } else { -0.0 };
            let x = if round % 8 < 2 { zero } else { random() };
            let normal = Vec3::new(x, random(), random());
            let distance = random() * 10.0_f32.powf(10.0 * random());
            let plane = Plane::new(normal, distance, info).unwrap();
            let (normal, distance) = plane_numbers(&plane);
            let again = Plane::new(normal, distance, info).unwrap();
            // The debug format tells −0 from 0.
            assert_eq!(std::format!("{again:?}"), std::format!("{plane:?}"));
        }
    }

    #[test]
    fn more_than_one_light_is_an_error() {
        let lights = [Light::default(), Light::default()];
        let scene = Scene::<f32>::EMPTY.with_lights(&lights);
        assert_eq!(
            print(&scene).err(),
            Some(PrintError::TooManyLights { lights: 2 })
        );
    }
}
