//! f32 against f64 on every scene: tier A of the numerics rules, and the camera against its formula.
//!
//! A pixel is *settled* when its f64 colour stays within 1 level (of 255) while the sample moves by a
//! thousandth of a pixel. Settled pixels may be at most 1 level off, and at most 0.02 % of them; the
//! others lie on an edge that rounding alone may move, and are at most 1 % of a picture.

mod common;

use common::sampling::{level_distance, levels, ray_beside, settled_color};
use common::scenes;
use scanray::{Resolution, Scalar, ScenePools, Tracer};

const SIZE: Resolution = Resolution {
    width: 160,
    height: 120,
};

#[derive(Debug, Default)]
struct Counts {
    settled: u32,
    unsettled: u32,
    one_level_off: u32,
    further_off: u32,
}

fn compare(name: &str) -> Counts {
    let (single, double): (ScenePools<f32>, ScenePools<f64>) =
        (scenes::load(name), scenes::load(name));
    let single = Tracer::new(single.as_scene()).with_resolution(SIZE);
    let double = Tracer::new(double.as_scene()).with_resolution(SIZE);
    let mut counts = Counts::default();
    for y in 0..SIZE.height {
        for x in 0..SIZE.width {
            let actual = single.pixel(x, y);
            assert!(actual.is_finite(), "{name}: pixel ({x}, {y}) is {actual:?}");
            let Some(exact) = settled_color(&double, (x, y)) else {
                counts.unsettled += 1;
                continue;
            };
            counts.settled += 1;
            match level_distance(levels(actual), levels(exact)) {
                0 => {}
                1 => counts.one_level_off += 1,
                distance => {
                    println!(
                        "{name}: pixel ({x}, {y}) is {distance} levels off: {actual:?} {exact:?}"
                    );
                    counts.further_off += 1;
                }
            }
        }
    }
    println!("{name}: {counts:?}");
    counts
}

#[test]
fn every_scene_is_the_same_in_single_and_double_precision() {
    for name in scenes::names() {
        let counts = compare(&name);
        let pixels = counts.settled + counts.unsettled;
        assert_eq!(pixels, u32::from(SIZE.width) * u32::from(SIZE.height));
        assert_eq!(counts.further_off, 0, "{name}: {counts:?}");
        assert!(
            f64::from(counts.one_level_off) <= 0.000_2 * f64::from(counts.settled),
            "{name}: {counts:?}"
        );
        assert!(
            f64::from(counts.unsettled) <= 0.01 * f64::from(pixels),
            "{name}: {counts:?}"
        );
    }
}

/// The rays of the crate's camera are those of the contract's formula, within rounding.
fn camera_follows_its_formula<T: Scalar + scanray::FromDecimal>() {
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
                let position = tracer.scene().camera.position;
                assert_eq!(ray.origin, position);
                let exact = ray_beside::<T>(position, size, (x, y), (0.0, 0.0));
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
