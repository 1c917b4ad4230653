//! What the camera meets on its way around a scene.

use scanray::shape::Transform;
use scanray::{Ray, Scalar, Scene, Tracer, ray::ObjectNumber};

use super::{Axis, Turn};

/// The camera passes through the surface of an object after a step, before the next.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Crossing {
    pub(crate) step: u16,
    pub(crate) object: ObjectNumber,
}

/// The circle is walked along in as many chords at least.
const CHORDS: u16 = 360;

/// The surfaces that the camera passes through in one turn of as many steps about an axis, in order. Each object counts
/// once between two steps.
pub(crate) fn crossings<T: Scalar>(scene: Scene<'_, T>, steps: u16, axis: Axis) -> Vec<Crossing> {
    let tracer = Tracer::new(scene).with_bvh();
    let chords_a_step = CHORDS.div_ceil(steps);
    let chords = u32::from(chords_a_step) * u32::from(steps);
    // While the scene stands, the camera goes round the other way than the scene turns. The first step is the last.
    let place = |chord: u32| {
        let turn = Turn::of(axis, chords - chord, chords);
        turn.point(scene.camera().position)
    };
    let mut crossings: Vec<Crossing> = Vec::new();
    for chord in 0..chords {
        let (from, to) = (place(chord), place(chord + 1));
        let way = to - from;
        let length = way.dot(way).sqrt();
        if length.to_f64() == 0.0 {
            continue;
        }
        let ray = Ray::new(from, way * (T::ONE / length));
        if let Some(nearest) = tracer.nearest(&ray)
            && nearest.t <= length
        {
            let crossing = Crossing {
                step: (chord / u32::from(chords_a_step)) as u16,
                object: nearest.object.info().number,
            };
            if !crossings.contains(&crossing) {
                crossings.push(crossing);
            }
        }
    }
    crossings
}
