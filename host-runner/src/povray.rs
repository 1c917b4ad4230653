//! A scene in the language of POV-Ray 3.7.
//!
//! POV-Ray has one colour for a light and a pigment that tints everything but the highlight; here ambient, diffuse
//! and specular colours are independent. So the light gets the specular intensity, the pigment what makes the
//! diffuse light right, and emission, which POV-Ray multiplies with the pigment, the ambient light divided by
//! it. A transparent pigment weakens diffuse light and emission, which are strengthened by as much.

use std::fmt;
use std::path::Path;

use scanray::{Color, Light, MaterialDescription, Resolution, Scalar, Scene, Vec3, shape::Shape};

use crate::console::shown;

/// The share that a surface keeps for its own colour at least, because it is divided by.
const LEAST_OPACITY: f64 = 1e-3;

/// What stands for black in a pigment, for the same reason.
const BLACK_PIGMENT: f64 = 1e-6;

/// A scene to be written as POV-Ray source with `Display`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PovScene<'a, T> {
    pub(crate) scene: Scene<'a, T>,
    /// Where it comes from, for the comment.
    pub(crate) name: &'a str,
    /// The file it becomes, for the command that draws it.
    pub(crate) file: &'a Path,
    pub(crate) resolution: Resolution,
    pub(crate) max_depth: usize,
}

impl<T: Scalar> fmt::Display for PovScene<'_, T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Resolution { width, height } = self.resolution;
        let light = self.scene.lights().first();
        writeln!(
            f,
            "// {}, for POV-Ray 3.7, written by scanray. To draw it with scanray's values:",
            self.name
        )?;
        writeln!(
            f,
            "//   povray {} {} +W{width} +H{height} -A File_Gamma=1.0",
            shell_word("+I", self.file),
            shell_word("+O", &self.file.with_extension("png"))
        )?;
        writeln!(f, "#version 3.7;\n")?;
        // The ray from the camera is a level too.
        writeln!(
            f,
            "global_settings {{ assumed_gamma 1.0 max_trace_level {} adc_bailout 0 }}",
            self.max_depth + 1
        )?;
        writeln!(f, "#default {{ finish {{ ambient 0 diffuse 1 }} }}\n")?;
        let aspect = f64::from(width) / f64::from(height);
        writeln!(
            f,
            "camera {{ perspective location {} direction z up 2*y right {:?}*x }}\n",
            vector(self.scene.camera().position),
            2.0 * aspect
        )?;
        let background = &self.scene.background();
        if background.sky {
            writeln!(
                f,
                "sky_sphere {{ pigment {{ gradient y color_map {{ [0 rgb 1] [1 rgb <0.5, 0.7, 1.0>] }} \
                 scale 2 translate -y }} }}\n"
            )?;
        } else {
            writeln!(
                f,
                "background {{ rgb {} }}\n",
                color(background.color.clamp())
            )?;
        }
        if let Some(light) = light {
            writeln!(
                f,
                "light_source {{ {}, rgb {} }}\n",
                vector(light.position),
                triple(light_color(light))
            )?;
        }
        for object in self.scene.objects() {
            let material = self.scene.material(object.info());
            let shape = Geometry(object.shape());
            let look = Look {
                material: &material,
                ambient: self.scene.ambient().to_f64(),
                light,
            };
            let casts_shadow = material.index_of_refraction != T::ONE;
            let is_transparent = material.refraction > T::ZERO;
            let no_shadow = if !casts_shadow || is_transparent {
                " no_shadow"
            } else {
                ""
            };
            writeln!(f, "{shape}{look}{no_shadow} }}")?;
            if casts_shadow && is_transparent {
                // It keeps all light away, but for POV-Ray that which passes a transparent object goes on.
                writeln!(f, "{shape} pigment {{ rgb 0 }} no_image no_reflection }}")?;
            }
        }
        Ok(())
    }
}

/// An option with a path, as a shell and one line have it.
fn shell_word(option: &str, path: &Path) -> String {
    let word = format!("{option}{}", shown(path));
    let is_plain = |c: char| c.is_alphanumeric() || "+-_./".contains(c);
    if word.chars().all(is_plain) {
        word
    } else {
        format!("'{}'", word.replace('\'', r"'\''"))
    }
}

/// The beginning of an object: its kind and geometry.
struct Geometry<T>(Shape<T>);

impl<T: Scalar> fmt::Display for Geometry<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0 {
            Shape::Sphere { center, radius } => {
                write!(f, "sphere {{ {}, {:?}", vector(center), radius.to_f64())
            }
            Shape::Plane { normal, distance } => {
                write!(f, "plane {{ {}, {:?}", vector(normal), -distance.to_f64())
            }
            Shape::Triangle(vertices) => {
                let [a, b, c] = vertices.map(vector);
                write!(f, "triangle {{ {a}, {b}, {c}")
            }
            Shape::Disc {
                center,
                normal,
                radius,
            } => write!(
                f,
                "disc {{ {}, {}, {:?}",
                vector(center),
                vector(normal),
                radius.to_f64()
            ),
            // A shape that is not written would be a picture that is wrong.
            _ => Err(fmt::Error),
        }
    }
}

/// Pigment, finish and interior of an object.
struct Look<'a, T> {
    material: &'a MaterialDescription<T>,
    ambient: f64,
    light: Option<&'a Light<T>>,
}

impl<T: Scalar> fmt::Display for Look<'_, T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let m = self.material;
        let of_light = self.light.map_or([1.0; 3], light_color);
        let intensity = |pick: fn(&Light<T>) -> Color<T>| {
            self.light.map_or([0.0; 3], |light| channels(pick(light)))
        };
        let (diffuse, specular) = (
            intensity(|light| light.diffuse),
            intensity(|light| light.specular),
        );
        let transmit = m.refraction.to_f64().min(1.0 - LEAST_OPACITY);
        let opacity = 1.0 - transmit;
        let pigment = [0, 1, 2].map(|i| {
            let wanted = diffuse[i] * channels(m.diffuse)[i] / of_light[i];
            wanted.max(BLACK_PIGMENT)
        });
        let emission =
            [0, 1, 2].map(|i| self.ambient * channels(m.ambient)[i] / (pigment[i] * opacity));
        // A highlight has one strength for all colours.
        let highlight = [0, 1, 2].map(|i| specular[i] * channels(m.specular)[i] / of_light[i]);
        let phong = highlight.iter().sum::<f64>() / 3.0;
        write!(f, " pigment {{ rgb {}", triple(pigment))?;
        if transmit > 0.0 {
            write!(f, " transmit {transmit:?}")?;
        }
        write!(
            f,
            " }} finish {{ emission rgb {} diffuse {:?}",
            triple(emission),
            1.0 / opacity
        )?;
        if phong > 0.0 {
            write!(f, " phong {phong:?} phong_size {:?}", m.shininess.to_f64())?;
        }
        if m.reflection > T::ZERO {
            write!(f, " reflection {:?}", m.reflection.to_f64())?;
        }
        f.write_str(" }")?;
        if transmit > 0.0 {
            write!(
                f,
                " interior {{ ior {:?} }}",
                m.index_of_refraction.to_f64()
            )?;
        }
        Ok(())
    }
}

/// The colour of the light source: the specular intensity, unless a channel of it is black, by which the diffuse
/// intensity could not be divided.
fn light_color<T: Scalar>(light: &Light<T>) -> [f64; 3] {
    let specular = channels(light.specular);
    if specular.iter().all(|channel| *channel > 0.0) {
        specular
    } else {
        [1.0; 3]
    }
}

fn channels<T: Scalar>(c: Color<T>) -> [f64; 3] {
    [c.r, c.g, c.b].map(T::to_f64)
}

fn triple([x, y, z]: [f64; 3]) -> String {
    format!("<{x:?}, {y:?}, {z:?}>")
}

fn color<T: Scalar>(c: Color<T>) -> String {
    triple(channels(c))
}

fn vector<T: Scalar>(v: Vec3<T>) -> String {
    triple([v.x, v.y, v.z].map(T::to_f64))
}
