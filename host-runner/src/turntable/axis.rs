//! The axis that a scene turns about, if none is given.

use scanray::{Scalar, Scene, Tracer, shape::Object};

use super::{Axis, crossings};

/// Columns and rows of the rays that look for what is in view.
const PROBES: [u16; 2] = [64, 48];

/// How far between the camera and the middle of what is in view the axis is looked for, in percent of the way: from half
/// of it to half beyond.
const FARTHEST: i32 = 50;
const STRIDE: i32 = 5;

/// As many steps as the longest turntables have, so that the axis is the same for any number.
const STEPS: u16 = 360;

/// The axis through the middle of what is in view or, where the camera would pass through objects around that, the nearest
/// on the way from the camera, or beyond, around which it passes through nothing; with room to spare on both sides.
/// In a closed room there may be no such axis: then it is the middle. `None` if only the background is seen.
pub(crate) fn default_axis<T: Scalar>(scene: Scene<'_, T>) -> Option<Axis> {
    let middle = axis_in_view(scene)?;
    let camera = scene.camera().position;
    let at = |percent: i32| {
        let between = |from: T, to: f64| {
            let from = from.to_f64();
            rounded(from + (to - from) * f64::from(percent) / 100.0)
        };
        Some(Axis {
            x: between(camera.x, middle.x)?,
            z: between(camera.z, middle.z)?,
        })
    };
    let is_clear =
        |percent| at(percent).is_some_and(|axis| crossings(scene, STEPS, axis).is_empty());
    let mut places = (0..=FARTHEST)
        .step_by(STRIDE as usize)
        .flat_map(|off| [100 - off, 100 + off]);
    places
        .find(|&place| {
            [place, place - STRIDE, place + STRIDE]
                .into_iter()
                .all(is_clear)
        })
        .and_then(at)
        .or(Some(middle))
}

/// The axis through the middle of what is in view: the median, over the picture, of the centres of the
/// spheres and of the places on triangles that are seen, or of places on planes if there is nothing else.
/// Rounded to four digits, so that it can be given again. `None` if only the background is seen.
///
/// It is the picture in the scene's own size that counts, so that the axis is the scene's, whatever is drawn of it.
fn axis_in_view<T: Scalar>(scene: Scene<'_, T>) -> Option<Axis> {
    let resolution = scene.resolution();
    let tracer = Tracer::new(scene).with_bvh();
    let (mut bodies, mut floors) = (Vec::new(), Vec::new());
    let probes = |length: u16, count: u16| {
        let count = count.min(length);
        (0..count).map(move |i| {
            let place = (2 * u32::from(i) + 1) * u32::from(length) / (2 * u32::from(count));
            place as u16
        })
    };
    for y in probes(resolution.height, PROBES[1]) {
        let scanline = tracer.scanline(y);
        for x in probes(resolution.width, PROBES[0]) {
            let ray = tracer.primary_ray(&scanline, x);
            let Some(nearest) = tracer.nearest(&ray) else {
                continue;
            };
            let place = ray.at(nearest.t);
            match nearest.object {
                Object::Sphere(sphere) => bodies.push(sphere.center()),
                Object::Plane(_) => floors.push(place),
                _ => bodies.push(place),
            }
        }
    }
    let places = if bodies.is_empty() { floors } else { bodies };
    Some(Axis {
        x: median(places.iter().map(|place| place.x.to_f64()))?,
        z: median(places.iter().map(|place| place.z.to_f64()))?,
    })
}

/// The median, rounded to four digits.
fn median(values: impl Iterator<Item = f64>) -> Option<f64> {
    let mut values: Vec<f64> = values.collect();
    values.sort_by(f64::total_cmp);
    rounded(*values.get(values.len() / 2)?)
}

/// Four digits of a number.
fn rounded(value: f64) -> Option<f64> {
    format!("{value:.3e}").parse().ok()
}
