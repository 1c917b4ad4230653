//! What is right in a scene's text, but is hardly meant.

use scanray::{Color, MaterialDescription, Scalar, Scene, Vec3, shape::Shape};

use crate::scene_lines::{Line, lines, object_lines};

/// Records of a text, counted from 0.
const CAMERA_RECORD: usize = 1;
const LIGHT_RECORD: usize = 3;
const BACKGROUND_RECORD: usize = 6;

/// A point of a plane is not farther from it than this share of its coordinates.
const IN_PLANE: f64 = 1e-6;

/// So many lines are named for one reason.
const NAMED: usize = 5;

/// The warnings, each with its line; what is the matter in several lines for the same reason is told once.
pub(crate) fn warnings<T: Scalar>(text: &[u8], scene: &Scene<'_, T>) -> Vec<(u32, String)> {
    let records = lines(text).filter(Line::is_record);
    let records: Vec<u32> = records
        .take(BACKGROUND_RECORD + 1)
        .map(|line| line.number)
        .collect();
    let record = |index: usize| records.get(index).copied().unwrap_or(1);
    let objects: Vec<_> = object_lines(text)
        .into_iter()
        .zip(scene.objects())
        .collect();
    let shapes: Vec<_> = objects
        .iter()
        .map(|(line, object)| (*line, object.shape()))
        .collect();
    let materials: Vec<_> = objects
        .iter()
        .map(|(_, object)| scene.material(object.info()))
        .collect();
    let mut all = Vec::new();

    let mut bytes: Vec<_> = scene
        .lights()
        .iter()
        .flat_map(|light| {
            let colors = [
                ("specular intensity", light.specular),
                ("diffuse intensity", light.diffuse),
            ];
            colors.map(|color| (record(LIGHT_RECORD), color))
        })
        .collect();
    let background = ("background colour", scene.background().color);
    bytes.push((record(BACKGROUND_RECORD), background));
    for ((line, _), material) in shapes.iter().zip(&materials) {
        let colors = [
            ("diffuse colour", material.diffuse),
            ("specular colour", material.specular),
            ("ambient colour", material.ambient),
        ];
        bytes.extend(colors.map(|color| (*line, color)));
    }
    let bytes = bytes
        .into_iter()
        .filter_map(|(line, (name, color))| Some((line, of_bytes(name, color)?)));
    all.extend(once(bytes));

    let camera = scene.camera().position;
    let around_camera = shapes.iter().filter(|(_, shape)| is_inside(camera, shape));
    all.extend(once(around_camera.map(|(line, _)| {
        let words = "the camera is inside of this sphere, whose inner side is all it sees unless it is of glass";
        (*line, words.to_owned())
    })));

    if !shapes.is_empty() && shapes.iter().all(|(_, shape)| is_behind(camera, shape)) {
        let words = "all objects are behind the camera, which looks along +z";
        all.push((record(CAMERA_RECORD), words.to_owned()));
    }

    for light in scene.lights() {
        let around_light = shapes
            .iter()
            .zip(&materials)
            .filter(|((_, shape), material)| {
                is_inside(light.position, shape) && casts_shadow(material)
            });
        all.extend(once(around_light.map(|((line, _), _)| {
            let words = "the light is inside of this sphere, which keeps it from everything else unless its index of refraction is 1";
            (*line, words.to_owned())
        })));
    }

    let in_planes = shapes.iter().filter_map(|(line, shape)| {
        let mut planes = shapes.iter().filter(|(_, plane)| lies_in(shape, plane));
        let (plane, _) = planes.next()?;
        let kind = shape.kind().name();
        Some((
            *line,
            format!(
                "this {kind} lies in the plane of line {plane}, and rounding decides which of them is seen: move one a little"
            ),
        ))
    });
    all.extend(once(in_planes));
    all
}

/// The first of the warnings for a reason, with the lines of others.
fn once(mut warnings: impl Iterator<Item = (u32, String)>) -> Option<(u32, String)> {
    let (line, mut words) = warnings.next()?;
    let mut others: Vec<u32> = warnings
        .map(|(line, _)| line)
        .filter(|other| *other != line)
        .collect();
    others.dedup();
    if !others.is_empty() {
        let named: Vec<String> = others.iter().take(NAMED).map(u32::to_string).collect();
        let more = if others.len() > NAMED { " …" } else { "" };
        let noun = if others.len() == 1 { "line" } else { "lines" };
        words += &format!(" (so in {noun} {}{more})", named.join(", "));
    }
    Some((line, words))
}

fn triple<T: Scalar>(v: Vec3<T>) -> [f64; 3] {
    [v.x, v.y, v.z].map(T::to_f64)
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// What to say of a colour that looks as if it were written in levels of 0 to 255: whole numbers, at least one of which is far
/// above 1.
fn of_bytes<T: Scalar>(name: &str, color: Color<T>) -> Option<String> {
    let levels = [color.r, color.g, color.b].map(T::to_f64);
    let are_levels = levels
        .iter()
        .all(|level| level.fract() == 0.0 && (0.0..=255.0).contains(level));
    if !are_levels || levels.iter().all(|level| *level < 16.0) {
        return None;
    }
    let [r, g, b] = levels;
    let [red, green, blue] = levels.map(|level| (level / 255.0 * 1000.0).round() / 1000.0);
    Some(format!(
        "the {name} {r} {g} {b} looks like levels of 0 to 255, but 1 is full intensity: write {red} {green} {blue}"
    ))
}

/// Whether a point is inside of a sphere.
fn is_inside<T: Scalar>(point: Vec3<T>, shape: &Shape<T>) -> bool {
    let Shape::Sphere { center, radius } = *shape else {
        return false;
    };
    let (point, center) = (triple(point), triple(center));
    let away = [0, 1, 2].map(|i| point[i] - center[i]);
    dot(away, away) < radius.to_f64() * radius.to_f64()
}

/// Whether the camera has no part of a shape before it.
fn is_behind<T: Scalar>(camera: Vec3<T>, shape: &Shape<T>) -> bool {
    let camera = camera.z.to_f64();
    match *shape {
        Shape::Sphere { center, radius } => center.z.to_f64() + radius.to_f64() <= camera,
        // One that is not parallel to the picture goes on before the camera.
        Shape::Plane { normal, distance } => {
            let [x, y, z] = triple(normal);
            x == 0.0 && y == 0.0 && -distance.to_f64() / z <= camera
        }
        Shape::Triangle(vertices) => vertices.iter().all(|vertex| vertex.z.to_f64() <= camera),
        Shape::Disc {
            center,
            normal,
            radius,
        } => {
            let normal = triple(normal);
            let slope = normal[0].hypot(normal[1]) / dot(normal, normal).sqrt();
            center.z.to_f64() + radius.to_f64() * slope <= camera
        }
        _ => false,
    }
}

/// Whether it keeps light away: lamps are given an index of 1, which does not.
fn casts_shadow<T: Scalar>(material: &MaterialDescription<T>) -> bool {
    material.index_of_refraction != T::ONE
}

/// Whether a flat shape lies in a plane.
fn lies_in<T: Scalar>(shape: &Shape<T>, plane: &Shape<T>) -> bool {
    let Shape::Plane { normal, distance } = *plane else {
        return false;
    };
    let (normal, distance) = (triple(normal), distance.to_f64());
    let length = dot(normal, normal).sqrt();
    let is_on = |point: Vec3<T>| {
        let point = triple(point);
        let scale = dot(point, point).sqrt().max(distance.abs() / length);
        (dot(normal, point) + distance).abs() <= IN_PLANE * length * scale
    };
    match *shape {
        Shape::Triangle(vertices) => vertices.into_iter().all(is_on),
        Shape::Disc {
            center,
            normal: own,
            ..
        } => {
            let own = triple(own);
            let cosine = dot(own, normal).abs() / (length * dot(own, own).sqrt());
            is_on(center) && cosine >= 1.0 - IN_PLANE
        }
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use scanray::ScenePools;

    const GREY: &str = ".5 .5 .5  .5 .5 .5  1 1 1  0 50 0 0";

    /// The warnings for a scene of these objects, as seen from the origin; the first object is in line 9.
    fn warnings_of(light: &str, background: &str, objects: &[String]) -> Vec<(u32, String)> {
        let text = format!(
            "# a comment\n{}\n0 0 0\n8 6\n{light}\n0.1\n1\n{background}\n{}\n",
            objects.len(),
            objects.join("\n")
        );
        let mut pools = Box::new(ScenePools::<f32>::new());
        pools.parse(text.as_bytes()).unwrap();
        warnings(text.as_bytes(), &pools.as_scene())
    }

    fn of_objects(objects: &[&str]) -> Vec<(u32, String)> {
        let objects: Vec<_> = objects.iter().map(|o| format!("{o}  {GREY}")).collect();
        warnings_of("5 5 -5  1 1 1  1 1 1", "0 0 0", &objects)
    }

    #[test]
    fn colours_in_levels_are_told_with_what_to_write() {
        let red = "0  0 0 9  1  255 0 51  .5 .5 .5  1 1 1  0 50 0 0".to_owned();
        let found = warnings_of("5 5 -5  255 255 255  1 1 1", "0 0 128", &[red.clone(), red]);
        let [(line, words)] = &found[..] else {
            panic!("{found:?}")
        };
        assert_eq!(*line, 5);
        assert!(
            words.contains("specular intensity 255 255 255")
                && words.ends_with("write 1 1 1 (so in lines 8, 9, 10)"),
            "{words}"
        );
        let red = "0  0 0 9  1  255 0 51  .5 .5 .5  1 1 1  0 50 0 0".to_owned();
        let found = warnings_of("5 5 -5  1 1 1  1 1 1", "0 0 0", &[red]);
        assert_eq!(found[0].0, 9);
        assert!(found[0].1.ends_with("write 1 0 0.2"), "{found:?}");
        // Bright, but no levels.
        assert_eq!(warnings_of("5 5 -5  2 2 2  20.5 1 1", "0 0 0", &[]), []);
    }

    #[test]
    fn camera_and_light_inside_of_spheres_are_told() {
        let found = of_objects(&["0  0 0 9  1", "0  0 0 0.5  1"]);
        assert!(
            found.len() == 1 && found[0].0 == 10 && found[0].1.contains("the camera"),
            "{found:?}"
        );
        let found = of_objects(&["0  5 5 -5.5  1", "0  0 0 9  1"]);
        assert!(
            found.len() == 1 && found[0].0 == 9 && found[0].1.contains("the light"),
            "{found:?}"
        );
        // What casts no shadow keeps no light.
        let lamp = "0  5 5 -5.5  1  .5 .5 .5  .5 .5 .5  1 1 1  0 50 0 1".to_owned();
        let ball = format!("0  0 0 9  1  {GREY}");
        assert_eq!(
            warnings_of("5 5 -5  1 1 1  1 1 1", "0 0 0", &[lamp, ball]),
            []
        );
        assert_eq!(of_objects(&["0  0 0 1  1", "0  5 5 -6  1"]), []);
    }

    #[test]
    fn a_scene_behind_the_camera_is_told() {
        let behind = [
            "0  0 0 -9  1",
            "2  0 0 0  1 0 0  0 1 0  0 0 0 0",
            "1  0 0 -2  -2",
        ];
        let found = of_objects(&behind);
        assert!(
            found.len() == 1 && found[0].0 == 3 && found[0].1.contains("along +z"),
            "{found:?}"
        );
        for before in [
            "0  0 0 -0.5  1",
            "1  0 1 0  1",
            "1  0 0 1  -2",
            "2  0 0 1  1 0 0  0 1 0  0 0 0 0",
        ] {
            let found = of_objects(&[&behind[..], &[before]].concat());
            assert!(
                found.iter().all(|(_, words)| !words.contains("behind")),
                "{before} {found:?}"
            );
        }
        assert_eq!(of_objects(&[]), []);
    }

    #[test]
    fn triangles_in_planes_are_told() {
        let found = of_objects(&[
            "1  0 2 0  3",
            "2  0 -1.5 9  1 -1.5 9  0 -1.5 8  0 0 0 0",
            "2  0 -1.5 9  1 -1.5 9  0 -1.4999 8  0 0 0 0",
            "2  2 -1.5 9  3 -1.5 9  2 -1.5 8  0 0 0 0",
        ]);
        let [(10, words)] = &found[..] else {
            panic!("{found:?}")
        };
        assert!(
            words.contains("this triangle lies in the plane of line 9")
                && words.ends_with("(so in line 12)"),
            "{words}"
        );
    }
}
