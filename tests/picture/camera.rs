//! The camera against its formula.

use crate::common::sampling::View;
use crate::common::scenes;
use scanray::{Resolution, Scalar, Tracer};

const SIZE: Resolution = Resolution {
    width: 160,
    height: 120,
};

/// The rays of the crate's camera are those of the contract's formula, within rounding.
fn camera_follows_its_formula<T: Scalar + scanray::parser::FromDecimal>() {
    let pools = scenes::load::<T>("window-room");
    for size in [
        SIZE,
        Resolution {
            width: 1,
            height: 1,
        },
        Resolution {
            width: 65_535,
            height: 3,
        },
        Resolution {
            width: 5,
            height: 65_535,
        },
    ] {
        let tracer = Tracer::new(pools.as_scene()).with_resolution(size);
        for y in (0..size.height).step_by(usize::from(size.height / 50 + 1)) {
            for x in (0..size.width).step_by(usize::from(size.width / 50 + 1)) {
                let ray = tracer.primary_ray(&tracer.scanline(y), x);
                let position = tracer.scene().camera().position;
                assert_eq!(ray.origin, position);
                let exact = View::of(&tracer).ray((x, y), (0.0, 0.0));
                let off = (ray.direction - exact.direction).abs().max_component();
                assert!(
                    off <= T::TWO * T::EPSILON,
                    "{size:?}, pixel ({x}, {y}): {ray:?} instead of {exact:?}"
                );
            }
        }
    }
}

#[test]
fn camera_follows_its_formula_in_single_precision() {
    camera_follows_its_formula::<f32>();
}

#[test]
fn camera_follows_its_formula_in_double_precision() {
    camera_follows_its_formula::<f64>();
}
