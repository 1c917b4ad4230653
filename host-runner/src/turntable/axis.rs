//! The axis that a scene turns about, if none is given.

use scanray::{Object, Scalar, Scene, Tracer};

use super::Axis;

/// Columns and rows of the rays that look for what is in view.
const PROBES: [u16; 2] = [64, 48];

/// The axis through the middle of what is in view: the median, over the picture, of the centres of the
/// spheres and of the places on triangles that are seen, or of places on planes if there is nothing else.
/// Rounded to four digits, so that it can be given again. `None` if only the background is seen.
///
/// It is the picture in the scene's own size that counts, so that the axis is the scene's, whatever is drawn of it.
pub(crate) fn axis_in_view<T: Scalar>(scene: Scene<'_, T>) -> Option<Axis> {
    let resolution = scene.resolution;
    let tracer = Tracer::new(scene).with_tree();
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
                Object::Triangle(_) => bodies.push(place),
                Object::Plane(_) => floors.push(place),
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
    let median = values.get(values.len() / 2)?;
    format!("{median:.3e}").parse().ok()
}
