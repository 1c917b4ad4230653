//! The tree of rays for people.

use std::fmt::{self, Display};
use std::io::{self, Write};

use scanray::{
    Color, Scalar, Scene, Vec3,
    ray::ObjectNumber,
    tracer::{LightAtHit, RayKind},
};

use super::{HitNode, LightNode, RayNode};

/// What a tree is told with: the scene and the lines of its objects.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Names<'a, T> {
    pub(crate) scene: &'a Scene<'a, T>,
    /// The scene's name.
    pub(crate) file: &'a str,
    /// The line of each object.
    pub(crate) lines: &'a [u32],
    pub(crate) max_depth: usize,
}

impl<T: Scalar> Names<'_, T> {
    /// The kind of an object.
    pub(super) fn kind(&self, number: ObjectNumber) -> &'static str {
        let mut objects = self.scene.objects();
        objects
            .find(|object| object.info().number == number)
            .map_or("object", |object| object.kind().name())
    }

    /// The line of an object.
    pub(super) fn line(&self, number: ObjectNumber) -> Option<u32> {
        self.lines.get(number as usize).copied()
    }

    fn object(&self, number: ObjectNumber) -> String {
        let kind = self.kind(number);
        match self.line(number) {
            Some(line) => format!("the {kind} of line {line}"),
            None => kind.to_owned(),
        }
    }
}

/// Writes a ray and all that follows from it, indented by its depth.
///
/// # Errors
///
/// Those of `out`.
pub(crate) fn write_rays<T: Scalar>(
    out: &mut dyn Write,
    node: &RayNode<T>,
    names: &Names<'_, T>,
) -> io::Result<()> {
    let margin = "│  ".repeat(node.depth);
    match node.kind {
        RayKind::Reflected => writeln!(
            out,
            "{margin}reflected × {}, depth {}",
            node.weight, node.depth
        )?,
        RayKind::Refracted => writeln!(
            out,
            "{margin}refracted × {}, depth {}",
            node.weight, node.depth
        )?,
        RayKind::Primary | RayKind::Shadow => {
            writeln!(out, "{margin}from the camera, depth {}", node.depth)?
        }
    }
    let margin = margin + "│  ";
    let mut line = |name: &str, value: &dyn Display| writeln!(out, "{margin}{name:<11}{value}");
    line("origin", &vector(node.ray.origin))?;
    line("direction", &vector(node.ray.direction))?;
    let Some(hit) = &node.hit else {
        let sky = names.scene.background().sky;
        let what = if sky {
            "nothing: the sky"
        } else {
            "nothing: the background"
        };
        line("meets", &what)?;
        return line("result", &color_digits(node.result));
    };
    let side = match (hit.front, names.kind(hit.object)) {
        (true, "sphere") => "from outside",
        (false, "sphere") => "from inside",
        (true, _) => "on its front",
        (false, _) => "on its back",
    };
    line(
        "meets",
        &format_args!(
            "{}, {side}, at t = {}",
            names.object(hit.object),
            digits(hit.t)
        ),
    )?;
    line("point", &vector(hit.point))?;
    line("normal", &vector(hit.normal))?;
    line(
        "ambient",
        &color_digits(hit.material.ambient * names.scene.ambient()),
    )?;
    if hit.lights.is_empty() {
        line("light", &"none in the scene that shows on this material")?;
    }
    for light in &hit.lights {
        line("light", &LightText(light, names))?;
    }
    line("local", &color_digits(hit.local))?;
    write_secondary(out, node, hit, names)?;
    writeln!(
        out,
        "{margin}{:<11}{}{}",
        "result",
        color_digits(node.result),
        clamped(node, hit)
    )
}

/// The secondary rays of a hit, those that were not cast included.
fn write_secondary<T: Scalar>(
    out: &mut dyn Write,
    node: &RayNode<T>,
    hit: &HitNode<T>,
    names: &Names<'_, T>,
) -> io::Result<()> {
    let margin = "│  ".repeat(node.depth + 1);
    for (kind, name) in [
        (RayKind::Reflected, "reflected"),
        (RayKind::Refracted, "refracted"),
    ] {
        for ray in hit.secondary.iter().filter(|ray| ray.kind == kind) {
            write_rays(out, ray, names)?;
        }
        if let Some(why) = node.why_not(kind, names.max_depth) {
            writeln!(out, "{margin}{name:<11}not cast: {why}")?;
        }
    }
    Ok(())
}

/// Whether the sum exceeds what a colour may have.
fn clamped<T: Scalar>(node: &RayNode<T>, hit: &HitNode<T>) -> &'static str {
    let sum = hit
        .secondary
        .iter()
        .fold(hit.local, |sum, ray| sum + ray.result * ray.weight);
    if sum == node.result {
        ""
    } else {
        ", clamped to 1"
    }
}

struct LightText<'a, T>(&'a LightNode<T>, &'a Names<'a, T>);

impl<T: Scalar> Display for LightText<'_, T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self(light, names) = self;
        let blocker = || {
            light
                .blocker
                .map_or("an object".to_owned(), |object| names.object(object))
        };
        match light.at_hit {
            LightAtHit::Behind => f.write_str("behind the surface"),
            LightAtHit::Enclosed => write!(f, "kept out by {}", blocker()),
            LightAtHit::Blocked => write!(f, "in the shadow of {}", blocker()),
            LightAtHit::Reaches { diffuse, specular } => {
                write!(f, "diffuse {}", color_digits(diffuse))?;
                match specular {
                    Some(specular) => write!(f, ", highlight {}", color_digits(specular)),
                    None => Ok(()),
                }
            }
        }
    }
}

fn vector<T: Scalar>(v: Vec3<T>) -> String {
    format!("({}, {}, {})", digits(v.x), digits(v.y), digits(v.z))
}

/// A colour in full: the fewest digits that read back to the same bits.
pub(crate) fn color_digits<T: Scalar>(c: Color<T>) -> String {
    format!("{} {} {}", digits(c.r), digits(c.g), digits(c.b))
}

/// A number in full: the fewest digits that read back to the same bits, with an exponent if there would be many
/// zeros.
fn digits<T: Scalar>(number: T) -> String {
    let size = number.to_f64().abs();
    if size != 0.0 && !(1e-5..1e16).contains(&size) {
        // The fewest digits of f32 are few enough for f64 to keep them.
        let shortest = number.to_string();
        shortest
            .parse::<f64>()
            .map_or(shortest, |number| format!("{number:e}"))
    } else {
        number.to_string()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_and_large_numbers_have_an_exponent() {
        assert_eq!(digits(4.900_751_6e-17_f32), "4.9007516e-17");
        assert_eq!(digits(-1e-6_f64), "-1e-6");
        assert_eq!(digits(0.000_1_f32), "0.0001");
        assert_eq!(digits(3e30_f32), "3e30");
        assert_eq!(digits(-0.0_f32), "-0");
        assert_eq!(digits(f64::INFINITY), "inf");
    }
}
