//! The scene as it is stored, for people to check: the listing of the original program, with its digits or with all.

use std::io::{self, Write};

use scanray::{Color, MaterialDescription, Scalar, Scene, Vec3, shape::Object};

/// The digits of a listing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Digits {
    /// As the paper prints them: six decimals in settings, two in objects.
    AsPublished,
    /// What is stored: the fewest that read back to the same bits.
    AsStored,
}

/// Writes the listing, the objects in the order of the file.
///
/// # Errors
///
/// Those of `out`.
pub(crate) fn write<T: Scalar>(
    out: &mut dyn Write,
    scene: &Scene<'_, T>,
    digits: Digits,
) -> io::Result<()> {
    let format = Format {
        digits,
        decimals: 6,
    };
    writeln!(out, "SCENE DATA")?;
    writeln!(out, "Number of Objects: {}", scene.object_count())?;
    let position = format.vector(scene.camera().position);
    writeln!(out, "Camera Position: {position}")?;
    let size = scene.resolution();
    writeln!(out, "Image properties: {}x{}", size.width, size.height)?;
    for light in scene.lights() {
        let position = format.vector(light.position);
        writeln!(out, "Light Source Direction: {position}")?;
        let diffuse = format.color(light.diffuse);
        writeln!(out, "Light Source Diffuse Colour: {diffuse}")?;
        let specular = format.color(light.specular);
        writeln!(out, "Light Source Specular Colour: {specular}")?;
    }
    writeln!(out, "Ambient Intensity: {}", format.number(scene.ambient()))?;
    let sky = u8::from(scene.background().sky);
    writeln!(out, "Use Sky Gradient Background (1-Yes; 0-No): {sky}")?;
    let background = format.color(scene.background().color);
    writeln!(out, "Background Colour: {background}")?;
    let format = Format {
        digits,
        decimals: 2,
    };
    for object in scene.objects() {
        match object {
            Object::Sphere(sphere) => write!(
                out,
                "SPHERE: centre{}, radius={}",
                format.vector(sphere.center()),
                format.number(sphere.radius())
            )?,
            Object::Plane(plane) => write!(
                out,
                "PLANE: normal{}, distance={}",
                format.vector(plane.normal()),
                format.number(-plane.height())
            )?,
            Object::Triangle(triangle) => {
                let [v1, v2, v3] = triangle.vertices();
                let normal = triangle.normal();
                write!(
                    out,
                    "TRIANGLE: T1{}, T2{}, T3{}, normal{}, distance={}",
                    format.vector(v1),
                    format.vector(v2),
                    format.vector(v3),
                    format.vector(normal),
                    format.number(-normal.dot(v1))
                )?;
            }
            // The paper has no layout for others.
            other => write!(out, "{:?}", other.shape())?,
        }
        write_material(out, &scene.material(object.info()), format)?;
    }
    Ok(())
}

fn write_material<T: Scalar>(
    out: &mut dyn Write,
    material: &MaterialDescription<T>,
    format: Format,
) -> io::Result<()> {
    write!(
        out,
        ", diffuse{}, specular{}, ambient{}",
        format.color(material.diffuse),
        format.color(material.specular),
        format.color(material.ambient)
    )?;
    writeln!(
        out,
        ", reflection={}, shininess={}, refraction={}, indexOfRefraction={}",
        format.number(material.reflection),
        format.number(material.shininess),
        format.number(material.refraction),
        format.number(material.index_of_refraction)
    )
}

/// How numbers are written.
#[derive(Clone, Copy, Debug)]
struct Format {
    digits: Digits,
    /// In a published listing.
    decimals: usize,
}

impl Format {
    /// A published number is never −0.
    fn number<T: Scalar>(self, value: T) -> String {
        match self.digits {
            Digits::AsPublished => {
                let digits = format!("{:.*}", self.decimals, value.to_f64());
                let is_zero = digits
                    .bytes()
                    .all(|byte| matches!(byte, b'-' | b'0' | b'.'));
                match digits.strip_prefix('-') {
                    Some(zero) if is_zero => zero.to_owned(),
                    _ => digits,
                }
            }
            Digits::AsStored => {
                let digits = format!("{value:?}");
                match digits.strip_suffix(".0") {
                    Some(whole) => whole.to_owned(),
                    None => digits,
                }
            }
        }
    }

    fn triple<T: Scalar>(self, triple: [T; 3]) -> String {
        let [x, y, z] = triple.map(|value| self.number(value));
        format!("({x}, {y}, {z})")
    }

    fn vector<T: Scalar>(self, vector: Vec3<T>) -> String {
        self.triple([vector.x, vector.y, vector.z])
    }

    fn color<T: Scalar>(self, color: Color<T>) -> String {
        self.triple([color.r, color.g, color.b])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn published(value: f64, decimals: usize) -> String {
        let digits = Digits::AsPublished;
        Format { digits, decimals }.number(value)
    }

    #[test]
    fn no_published_number_is_minus_zero() {
        assert_eq!(published(-0.0, 2), "0.00");
        assert_eq!(published(-0.0049, 2), "0.00");
        assert_eq!(published(-0.0049, 6), "-0.004900");
        assert_eq!(published(-10.0, 2), "-10.00");
        assert_eq!(published(1e9, 6), "1000000000.000000");
    }

    #[test]
    fn stored_numbers_read_back() {
        let format = Format {
            digits: Digits::AsStored,
            decimals: 2,
        };
        for (value, digits) in [
            (-0.0_f32, "-0"),
            (50.0, "50"),
            (0.1, "0.1"),
            (1e-7, "1e-7"),
            (1.0 / 3.0, "0.33333334"),
            (f32::MAX, "3.4028235e38"),
        ] {
            assert_eq!(format.number(value), digits);
            assert_eq!(digits.parse::<f32>().map(f32::to_bits), Ok(value.to_bits()));
        }
        assert_eq!(format.number(1.0 / 3.0), "0.3333333333333333");
        assert_eq!(format.vector(Vec3::new(1.0, 0.5, -2.25)), "(1, 0.5, -2.25)");
    }
}
