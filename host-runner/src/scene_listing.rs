//! The scene as it is stored, for people to check: the listing of the original program.

use std::fmt::{self, Display};
use std::io::{self, Write};

use scanray::{Color, MaterialDescription, Scalar, Scene, Vec3, shape::Object};

/// Writes the listing: settings with six decimals, objects in the order of the file with two.
///
/// # Errors
///
/// Those of `out`.
pub(crate) fn write<T: Scalar>(out: &mut dyn Write, scene: &Scene<'_, T>) -> io::Result<()> {
    writeln!(out, "SCENE DATA")?;
    writeln!(out, "Number of Objects: {}", scene.object_count())?;
    let position = vector(scene.camera().position);
    writeln!(out, "Camera Position: {position:.6}")?;
    let size = scene.resolution();
    writeln!(out, "Image properties: {}x{}", size.width, size.height)?;
    for light in scene.lights() {
        let position = vector(light.position);
        writeln!(out, "Light Source Direction: {position:.6}")?;
        let diffuse = color(light.diffuse);
        writeln!(out, "Light Source Diffuse Colour: {diffuse:.6}")?;
        let specular = color(light.specular);
        writeln!(out, "Light Source Specular Colour: {specular:.6}")?;
    }
    writeln!(out, "Ambient Intensity: {:.6}", number(scene.ambient()))?;
    let sky = u8::from(scene.background().sky);
    writeln!(out, "Use Sky Gradient Background (1-Yes; 0-No): {sky}")?;
    let background = color(scene.background().color);
    writeln!(out, "Background Colour: {background:.6}")?;
    for object in scene.objects() {
        match object {
            Object::Sphere(sphere) => write!(
                out,
                "SPHERE: centre{:.2}, radius={:.2}",
                vector(sphere.center()),
                number(sphere.radius())
            )?,
            Object::Plane(plane) => write!(
                out,
                "PLANE: normal{:.2}, distance={:.2}",
                vector(plane.normal()),
                number(-plane.height())
            )?,
            Object::Triangle(triangle) => {
                let [v1, v2, v3] = triangle.vertices();
                let normal = triangle.normal();
                write!(
                    out,
                    "TRIANGLE: T1{:.2}, T2{:.2}, T3{:.2}, normal{:.2}, distance={:.2}",
                    vector(v1),
                    vector(v2),
                    vector(v3),
                    vector(normal),
                    number(-normal.dot(v1))
                )?;
            }
            // The paper has no layout for others.
            other => write!(out, "{:?}", other.shape())?,
        }
        write_material(out, &scene.material(object.info()))?;
    }
    Ok(())
}

fn write_material<T: Scalar>(
    out: &mut dyn Write,
    material: &MaterialDescription<T>,
) -> io::Result<()> {
    write!(
        out,
        ", diffuse{:.2}, specular{:.2}, ambient{:.2}",
        color(material.diffuse),
        color(material.specular),
        color(material.ambient)
    )?;
    writeln!(
        out,
        ", reflection={:.2}, shininess={:.2}, refraction={:.2}, indexOfRefraction={:.2}",
        number(material.reflection),
        number(material.shininess),
        number(material.refraction),
        number(material.index_of_refraction)
    )
}

/// A number that is never printed as −0.
#[derive(Clone, Copy)]
struct Number(f64);

/// Three numbers in brackets.
struct Triple([Number; 3]);

fn number<T: Scalar>(value: T) -> Number {
    Number(value.to_f64())
}

fn vector<T: Scalar>(vector: Vec3<T>) -> Triple {
    Triple([vector.x, vector.y, vector.z].map(number))
}

fn color<T: Scalar>(color: Color<T>) -> Triple {
    Triple([color.r, color.g, color.b].map(number))
}

impl Display for Number {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let decimals = f.precision().unwrap_or(2);
        let digits = format!("{:.decimals$}", self.0);
        let is_zero = digits
            .bytes()
            .all(|byte| matches!(byte, b'-' | b'0' | b'.'));
        f.write_str(if is_zero {
            digits.trim_start_matches('-')
        } else {
            &digits
        })
    }
}

impl Display for Triple {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let decimals = f.precision().unwrap_or(2);
        let [x, y, z] = self.0;
        write!(f, "({x:.decimals$}, {y:.decimals$}, {z:.decimals$})")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_number_is_minus_zero() {
        assert_eq!(format!("{:.2}", Number(-0.0)), "0.00");
        assert_eq!(format!("{:.2}", Number(-0.0049)), "0.00");
        assert_eq!(format!("{:.6}", Number(-0.0049)), "-0.004900");
        assert_eq!(format!("{:.2}", Number(-10.0)), "-10.00");
        let triple = vector(Vec3::new(-0.0_f32, -1e-9, 1e9));
        assert_eq!(
            format!("{triple:.6}"),
            "(0.000000, 0.000000, 1000000000.000000)"
        );
    }
}
