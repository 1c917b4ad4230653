//! The contribution cut-off keeps its bound, and saves rays.

use crate::common::random::Random;
use crate::common::sampling::{bits, channels};
use crate::common::scenes::{Model, Part, Shape, load, names};
use embedded_graphics::pixelcolor::{
    Gray2, Gray4, Gray8, GrayColor, Rgb555, Rgb565, Rgb666, Rgb888, RgbColor,
};
use scanray::{
    Background, Color, Light, MaterialDescription, Picture, Resolution, Scalar, Scene, Stages,
    Tracer, Vec3,
    render::DisplayColor,
    tracer::{MissingStages, WorkCount},
};

const SIZE: Resolution = Resolution {
    width: 160,
    height: 120,
};

/// What a cut-off does to a picture.
#[derive(Debug, Default)]
struct Effect {
    /// The most that a channel of a pixel loses.
    loss: f64,
    /// Pixels that are not what they were in 8 bits.
    changed: u32,
    with: WorkCount,
    without: WorkCount,
}

/// Draws a scene with a cut-off and without and holds each channel to the bound, with an allowance for
/// rounding.
fn effect<T: Scalar>(
    scene: Scene<'_, T>,
    size: Resolution,
    max_depth: usize,
    cutoff: T,
    rounding: f64,
) -> Effect {
    let all = Tracer::new(scene)
        .with_stack::<16>()
        .with_resolution(size)
        .with_max_depth(max_depth)
        .unwrap();
    let few = all.with_cutoff(cutoff);
    let mut effect = Effect::default();
    for y in 0..size.height {
        let scanline = all.scanline(y);
        for x in 0..size.width {
            let whole = all.pixel_observed(&scanline, x, &mut effect.without);
            let cut = few.pixel_observed(&scanline, x, &mut effect.with);
            for (whole, cut) in channels(whole).into_iter().zip(channels(cut)) {
                let loss = whole - cut;
                assert!(
                    -rounding <= loss && loss < cutoff.to_f64() + rounding,
                    "pixel {x},{y}, cutoff {cutoff}: {cut} instead of {whole}"
                );
                effect.loss = effect.loss.max(loss);
            }
            let [whole, cut] = [whole, cut].map(|color| Rgb888::from_linear(color, T::HALF));
            effect.changed += u32::from(whole != cut);
        }
    }
    effect
}

#[test]
fn the_scenes_lose_less_than_the_cutoff() {
    for name in names() {
        let pools = load::<f32>(&name);
        for max_depth in [5, 16] {
            for cutoff in [1.0 / 512.0, 1.0 / 256.0, 1.0 / 64.0, 1.0 / 16.0] {
                let effect = effect(pools.as_scene(), SIZE, max_depth, cutoff, 1e-6);
                let [with, without] = [effect.with, effect.without].map(|work| work.rays());
                println!(
                    "{name}, depth {max_depth}, cut-off 1/{}: {:.1} % fewer rays, {:.2} of the cut-off \
                     lost at most, {} pixels changed",
                    1.0 / cutoff,
                    100.0 * (1.0 - with as f64 / without as f64),
                    effect.loss / f64::from(cutoff),
                    effect.changed
                );
                assert!(with < without, "{name}: nothing is saved");
            }
        }
    }
}

#[test]
fn random_scenes_lose_less_than_the_cutoff() {
    let random = Random::of_test(20_261_125);
    let size = Resolution {
        width: 16,
        height: 12,
    };
    let mut saved = 0;
    for _ in 0..60 {
        let pools = mirrors_and_glass(&random).build();
        let cutoff = random.log_between(1e-4, 0.5);
        let max_depth = random.below(9);
        let effect = effect(pools.as_scene(), size, max_depth, cutoff, 1e-12);
        saved += effect.without.rays() - effect.with.rays();
    }
    assert!(saved > 10_000, "{saved} rays saved");
}

/// Spheres of every kind, also such as give back more light than they get, around the camera.
fn mirrors_and_glass(random: &Random) -> Model<f64> {
    let color = || {
        let channel = || random.between(0.0, 1.0);
        Color::new(channel(), channel(), channel())
    };
    let material = || MaterialDescription {
        diffuse: color(),
        specular: color(),
        ambient: color(),
        reflection: random.between(0.0, 1.2),
        shininess: 20.0,
        refraction: random.between(0.0, 1.2),
        index_of_refraction: random.between(1.0, 2.0),
    };
    let spheres = (0..8).map(|_| Part {
        shape: Shape::Sphere {
            center: random.point(4.0),
            radius: random.between(0.2, 2.0),
        },
        material: material(),
    });
    let floor = Part {
        shape: Shape::Plane {
            normal: Vec3::new(0.0, 1.0, 0.0),
            distance: 5.0,
        },
        material: material(),
    };
    Model {
        camera: Vec3::new(0.0, 0.0, 0.0),
        resolution: SIZE,
        ambient: 0.2,
        background: Background {
            color: Color::BLACK,
            sky: true,
        },
        lights: vec![Light {
            position: random.point(9.0),
            specular: color(),
            diffuse: color(),
        }],
        parts: spheres.chain([floor]).collect(),
    }
}

/// Draws a scene in a display's colours with the display's cut-off and without, and finds by how many
/// levels a channel is off at most.
fn levels_off<C: DisplayColor>(
    scene: Scene<'_, f32>,
    channels: impl Fn(C) -> [u8; 3],
    dithered: bool,
) -> u8 {
    let all = Tracer::new(scene).with_resolution(SIZE);
    let few = all.with_cutoff(C::LEVEL);
    let draw = |x, y| match dithered {
        false => [
            Picture::new(&all).pixel(x, y),
            Picture::new(&few).pixel(x, y),
        ],
        true => [
            Picture::new(&all).dithered().pixel(x, y),
            Picture::new(&few).dithered().pixel(x, y),
        ],
    };
    let mut most = 0;
    for y in 0..SIZE.height {
        for x in 0..SIZE.width {
            let [whole, cut] = draw(x, y).map(&channels);
            for (whole, cut) in whole.into_iter().zip(cut) {
                assert!(cut <= whole, "pixel {x},{y} is brighter: {cut} > {whole}");
                most = most.max(whole - cut);
            }
        }
    }
    most
}

#[test]
fn a_cutoff_of_the_display_stays_within_one_level() {
    fn rgb<C: RgbColor>(color: C) -> [u8; 3] {
        [color.r(), color.g(), color.b()]
    }
    fn gray<C: GrayColor>(color: C) -> [u8; 3] {
        [color.luma(); 3]
    }
    let mut changed = false;
    for name in names() {
        let pools = load::<f32>(&name);
        let scene = pools.as_scene();
        for dithered in [false, true] {
            for most in [
                levels_off::<Rgb888>(scene, rgb, dithered),
                levels_off::<Rgb666>(scene, rgb, dithered),
                levels_off::<Rgb565>(scene, rgb, dithered),
                levels_off::<Rgb555>(scene, rgb, dithered),
                levels_off::<Gray8>(scene, gray, dithered),
                levels_off::<Gray4>(scene, gray, dithered),
                levels_off::<Gray2>(scene, gray, dithered),
            ] {
                assert!(most <= 1, "{name}, dithered {dithered}: {most} levels");
                changed |= most > 0;
            }
        }
    }
    assert!(changed, "no picture shows that there is a cut-off");
}

#[test]
fn a_cutoff_of_zero_changes_no_bit() {
    for name in names() {
        let pools = load::<f32>(&name);
        let without = Tracer::new(pools.as_scene()).with_resolution(SIZE);
        for nothing in [0.0, -0.0, -1.0, f32::NAN] {
            let with = without.with_cutoff(nothing);
            for (x, y) in (0..SIZE.height).flat_map(|y| (0..SIZE.width).map(move |x| (x, y))) {
                assert_eq!(bits(with.pixel(x, y)), bits(without.pixel(x, y)), "{name}");
            }
        }
    }
}

#[test]
fn a_cutoff_of_one_leaves_no_secondary_ray_whose_coefficient_is_below() {
    // All coefficients of this scene are below 1, and no hit has two secondary rays.
    let pools = load::<f32>("mirror-room");
    let effect = effect(pools.as_scene(), SIZE, 5, 1.0, 1e-6);
    assert_eq!(effect.with.reflected_rays, 0);
    assert!(effect.without.reflected_rays > 0);
}

#[test]
fn the_stage_is_not_dropped_unnoticed() {
    const FEW: u64 = Stages::ALL.bits();
    let pools = load::<f32>("default");
    let tracer = Tracer::new(pools.as_scene()).with_cutoff(0.1);
    assert_eq!(
        tracer.specialize::<FEW>().err(),
        Some(MissingStages(Stages::CUTOFF))
    );
    let none = tracer
        .with_compiled_cutoff(0.0)
        .specialize::<FEW>()
        .unwrap();
    assert_eq!((none.cutoff(), none.stages()), (0.0, Stages::ALL));
    assert_eq!(Stages::CUTOFF.to_string(), "cutoff");
}
