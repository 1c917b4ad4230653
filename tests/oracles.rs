//! Oracles that need no second implementation: changes of a scene that must not change its picture, or
//! only as foreseen.

mod common;

use common::random::Random;
use common::sampling::{bits, level_distance, levels, settled_color};
use common::scenes::{self, Model, Part, Shape};
use scanray::{
    Color, FromDecimal, MaterialDescription, Observer, Ray, RayKind, Resolution, Scalar, Tracer,
    Vec3,
};

const SIZE: Resolution = Resolution {
    width: 80,
    height: 60,
};

/// The linear colours of a model's picture, as bits.
fn render<T: Scalar>(model: &Model<T>) -> Vec<[u64; 3]> {
    let pools = model.build();
    let tracer = Tracer::new(pools.as_scene()).with_resolution(SIZE);
    pixels().map(|(x, y)| bits(tracer.pixel(x, y))).collect()
}

fn pixels() -> impl Iterator<Item = (u16, u16)> {
    (0..SIZE.height).flat_map(|y| (0..SIZE.width).map(move |x| (x, y)))
}

/// Every scene of scenes/, taken apart. Building it again normalises the planes a second time, so that
/// its picture is compared with that of another built scene, not with that of the parsed one.
fn models<T: Scalar + FromDecimal>() -> Vec<(String, Model<T>)> {
    scenes::names()
        .into_iter()
        .map(|name| {
            let model = Model::of(&scenes::load::<T>(&name).as_scene());
            (name, model)
        })
        .collect()
}

#[track_caller]
fn assert_same(what: &str, actual: &[[u64; 3]], expected: &[[u64; 3]]) {
    let different: Vec<(u16, u16)> = pixels()
        .zip(actual.iter().zip(expected))
        .filter(|(_, (a, b))| a != b)
        .map(|(pixel, _)| pixel)
        .collect();
    assert!(
        different.is_empty(),
        "{what}: {} pixels differ, the first at {:?}",
        different.len(),
        different[0]
    );
}

fn scaling_by_a_power_of_two_changes_no_bit<T: Scalar + FromDecimal>(exponents: &[i32]) {
    for (name, model) in models::<T>() {
        let expected = render(&model);
        for &exponent in exponents {
            let factor = T::from_f64(2_f64.powi(exponent));
            let scaled = model.mapped(|point| point * factor, |normal| normal, factor);
            assert_same(
                &format!("{name} times 2^{exponent}"),
                &render(&scaled),
                &expected,
            );
        }
    }
}

#[test]
fn scaling_by_a_power_of_two_changes_no_bit_in_single_precision() {
    scaling_by_a_power_of_two_changes_no_bit::<f32>(&[-30, -13, -5, -1, 1, 2, 13, 30]);
}

#[test]
fn scaling_by_a_power_of_two_changes_no_bit_in_double_precision() {
    scaling_by_a_power_of_two_changes_no_bit::<f64>(&[-100, -13, -1, 13, 100]);
}

fn flip<T: Scalar>(v: Vec3<T>) -> Vec3<T> {
    Vec3::new(-v.x, v.y, v.z)
}

/// Mirroring swaps the sides of a triangle, which matters only where it bends rays.
fn bends_at_a_triangle<T: Scalar>(model: &Model<T>) -> bool {
    model.parts.iter().any(|part| {
        matches!(part.shape, Shape::Triangle(_))
            && part.material.refraction > T::ZERO
            && part.material.index_of_refraction != T::ONE
    })
}

fn mirroring_the_scene_mirrors_the_picture<T: Scalar + FromDecimal>() {
    let mut compared = 0;
    for (name, model) in models::<T>() {
        if bends_at_a_triangle(&model) {
            println!("{name} is left out: its refracting triangles change sides");
            continue;
        }
        compared += 1;
        let mut expected = render(&model);
        for row in expected.chunks_mut(usize::from(SIZE.width)) {
            row.reverse();
        }
        let mirrored = model.mapped(flip, flip, T::ONE);
        assert_ne!(mirrored, model);
        assert_same(&format!("{name} mirrored"), &render(&mirrored), &expected);
    }
    assert!(compared >= 5, "only {compared} scenes compared");
}

#[test]
fn mirroring_the_scene_mirrors_the_picture_in_single_precision() {
    mirroring_the_scene_mirrors_the_picture::<f32>();
}

#[test]
fn mirroring_the_scene_mirrors_the_picture_in_double_precision() {
    mirroring_the_scene_mirrors_the_picture::<f64>();
}

#[test]
fn the_order_of_objects_does_not_matter() {
    let random = Random::of_test(61);
    for (name, mut model) in models::<f32>() {
        let expected = render(&model);
        model.parts.reverse();
        assert_same(&format!("{name} in reverse"), &render(&model), &expected);
        for round in 0..6 {
            random.shuffle(&mut model.parts);
            assert_same(
                &format!("{name} shuffled {round} times"),
                &render(&model),
                &expected,
            );
        }
    }
}

#[test]
fn the_sign_of_zero_does_not_matter() {
    fn negative_zero(x: f32) -> f32 {
        if x == 0.0 { -x.abs() } else { x }
    }
    fn negative_zeros(v: Vec3<f32>) -> Vec3<f32> {
        Vec3::new(negative_zero(v.x), negative_zero(v.y), negative_zero(v.z))
    }
    let color =
        |c: Color<f32>| Color::new(negative_zero(c.r), negative_zero(c.g), negative_zero(c.b));
    for (name, model) in models::<f32>() {
        let mut changed = model.mapped(negative_zeros, negative_zeros, 1.0);
        changed.background.color = color(changed.background.color);
        for part in &mut changed.parts {
            let m = part.material;
            part.material = MaterialDescription {
                diffuse: color(m.diffuse),
                specular: color(m.specular),
                ambient: color(m.ambient),
                reflection: negative_zero(m.reflection),
                shininess: negative_zero(m.shininess),
                refraction: negative_zero(m.refraction),
                index_of_refraction: negative_zero(m.index_of_refraction),
            };
        }
        assert_same(
            &format!("{name} with −0"),
            &render(&changed),
            &render(&model),
        );
    }
}

/// Greatest depth at which a ray was cast.
#[derive(Default)]
struct Deepest(usize);

impl<T> Observer<T> for Deepest {
    fn ray(&mut self, kind: RayKind, depth: usize, _: &Ray<T>) {
        if kind != RayKind::Shadow {
            self.0 = self.0.max(depth);
        }
    }
}

/// The published scene with one mirror only, the floor, so that no path is longer than a few rays.
fn shallow_scene<T: Scalar + FromDecimal>() -> Model<T> {
    let mut model = Model::of(&scenes::load::<T>("default").as_scene());
    for part in &mut model.parts {
        if !matches!(part.shape, Shape::Plane { .. }) {
            part.material.reflection = T::ZERO;
        }
    }
    model
}

/// Objects that nothing shows: one enclosing the camera, one in the middle of the picture, a sheet
/// across it and a slanted one.
fn invisible_parts<T: Scalar>() -> Vec<(&'static str, Part<T>)> {
    let v = |x, y, z| Vec3::new(T::from_f64(x), T::from_f64(y), T::from_f64(z));
    let sphere = |center, radius| Shape::Sphere {
        center,
        radius: T::from_f64(radius),
    };
    let plane = |normal, distance| Shape::Plane {
        normal,
        distance: T::from_f64(distance),
    };
    [
        ("sphere around the camera", sphere(v(0.1, 0.2, 0.1), 1.1)),
        ("sphere in sight", sphere(v(0.9, 0.3, 2.2), 0.8)),
        (
            "huge sphere around everything",
            sphere(v(1.0, 2.0, 3.0), 500.0),
        ),
        ("plane across the view", plane(v(0.0, 0.0, 1.0), -1.2)),
        ("slanted plane", plane(v(1.0, 0.3, -0.5), 1.0)),
        (
            "triangle across the view",
            Shape::Triangle([v(-3.0, -0.8, 1.3), v(4.0, -0.9, 1.1), v(0.3, 4.0, 2.7)]),
        ),
    ]
    .map(|(name, shape)| {
        let material = scenes::invisible();
        (name, Part { shape, material })
    })
    .to_vec()
}

#[test]
fn an_object_that_shows_nothing_changes_no_settled_pixel() {
    const DEPTH: usize = 24;
    let double = shallow_scene::<f64>().build();
    let double = Tracer::new(double.as_scene()).with_resolution(SIZE);
    let single = shallow_scene::<f32>();
    let all: Vec<_> = invisible_parts()
        .into_iter()
        .map(|(_, part)| part)
        .collect();
    let groups = invisible_parts()
        .into_iter()
        .map(|(name, part)| (name, vec![part]))
        .chain([("all of them", all)]);
    for (name, parts) in groups {
        let mut model = single.clone();
        // Not at the end, so that the numbers of the others change too.
        model.parts.splice(2..2, parts);
        let pools = model.build();
        let tracer = Tracer::new(pools.as_scene())
            .with_resolution(SIZE)
            .with_stack::<DEPTH>()
            .with_max_depth(DEPTH)
            .unwrap();
        let mut deepest = Deepest::default();
        let (mut settled, mut changed) = (0, 0);
        for (x, y) in pixels() {
            let actual = tracer.pixel_observed(&tracer.scanline(y), x, &mut deepest);
            if let Some(expected) = settled_color(&double, (x, y)) {
                settled += 1;
                if level_distance(levels(actual), levels(expected)) > 1 {
                    changed += 1;
                    println!("{name}: pixel ({x}, {y}) is {actual:?} instead of {expected:?}");
                }
            }
        }
        println!(
            "{name}: {settled} settled pixels, {changed} changed, depth {}",
            deepest.0
        );
        assert_eq!(changed, 0, "{name}");
        assert!(settled > 4_700, "{name}: only {settled} pixels settled");
        // A clipped path would be darker: the oracle holds only without any.
        assert!(
            deepest.0 < DEPTH,
            "{name}: a path reached the maximum depth"
        );
        assert!(deepest.0 >= 2, "{name}: nothing was crossed");
    }
}

/// An object of index exactly 1 casts no shadow and bends no ray.
#[test]
fn index_one_passes_straight_through_to_the_bit() {
    let random = Random::of_test(43);
    for (name, part) in invisible_parts::<f32>() {
        let mut model = shallow_scene::<f32>();
        model.parts = vec![part];
        model.background.sky = true;
        let pools = model.build();
        let tracer = Tracer::new(pools.as_scene());
        let empty = Model {
            parts: Vec::new(),
            ..model
        }
        .build();
        let nothing = Tracer::new(empty.as_scene());
        let mut crossed = 0;
        for _ in 0..20_000 {
            let ray = Ray::new(random.point(3.0), random.direction());
            crossed += usize::from(tracer.nearest(&ray).is_some());
            assert!(!tracer.occluded(&ray, f32::MAX), "{name} casts a shadow");
            // The sky depends on the direction alone, so that any bend would change its bits.
            let (actual, straight) = (tracer.radiance(ray), nothing.radiance(ray));
            assert_eq!(bits(actual), bits(straight), "{name}: {ray:?}");
        }
        assert!(crossed > 500, "{name} is in the way of {crossed} rays");
    }
}
