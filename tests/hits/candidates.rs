//! Leaving out objects that a ray cannot hit changes no bit: scenes with and without candidates.

use crate::common::quick_reject::ClearMisses;
use crate::common::random::Random;
use crate::common::scenes::{Model, Part, RoomyPools, Shape, load, names};
use scanray::shape::ShapeError;
use scanray::{
    Background, Camera, Color, Light, Material, MaterialDescription, Resolution, Scalar, Scene,
    SceneError, ScenePools, Tracer, Vec3, accel::ObjectSet, parser::FromDecimal, pools::PoolsMut,
};

/// Draws a scene with its candidates and by brute force and compares all bits. How many tests by brute force
/// integers decide, which are watched, too.
fn compare<T: Scalar>(
    scene: Scene<'_, T>,
    resolution: Resolution,
    what: impl Fn() -> String,
) -> u64 {
    let brute_force = scene.without_accel();
    let with = Tracer::new(scene).with_resolution(resolution);
    let without = Tracer::new(brute_force).with_resolution(resolution);
    let mut misses = ClearMisses::default();
    for y in 0..resolution.height {
        let scanline = with.scanline(y);
        for x in 0..resolution.width {
            let candidates = with.pixel(x, y);
            // `radiance` has all objects as candidates of the primary ray.
            let ray = without.primary_ray(&scanline, x);
            let all = without.radiance_observed(ray, ObjectSet::ALL, &mut misses);
            assert_eq!(
                bits(candidates),
                bits(all),
                "{}: pixel {x},{y}: {candidates:?} instead of {all:?}",
                what()
            );
        }
    }
    misses.count
}

/// The number of pairs of a side and an object that the candidates exclude, a pair of one octant of
/// directions counting an eighth, in a scene whose objects a set tells apart.
fn excluded_pairs<T: Scalar>(scene: Scene<'_, T>) -> usize {
    let objects = scene.object_count();
    let excluded = |set: ObjectSet| objects - set.members(objects).count();
    let eighths: usize = scene
        .accel()
        .sides()
        .iter()
        .map(|side| {
            let near: usize = side.near.iter().copied().map(excluded).sum();
            near + 8 * excluded(side.occluders)
        })
        .sum();
    eighths / 8
}

/// The same of the grids of planes: of the pairs of a slab's direction along its axis, or its way to the lights, and an
/// object.
fn excluded_by_grids<T: Scalar>(scene: Scene<'_, T>) -> usize {
    let objects = scene.object_count();
    scene
        .accel()
        .grids()
        .iter()
        .flat_map(|grid| grid.slabs.as_flattened())
        .flat_map(|slab| [slab.ahead[0], slab.ahead[1], slab.occluders])
        .map(|set| objects - set.members(objects).count())
        .sum()
}

fn bits<T: Scalar>(color: Color<T>) -> [u64; 3] {
    [color.r, color.g, color.b].map(|channel| channel.to_f64().to_bits())
}

fn scenes_of_the_repository<T: Scalar + FromDecimal>() {
    for name in names() {
        let pools = load::<T>(&name);
        let resolution = Resolution {
            width: 160,
            height: 120,
        };
        compare(pools.as_scene(), resolution, || name.clone());
        // A ray that leaves an object outwards does not hit it again: that alone is two pairs each.
        let (excluded, objects) = (
            excluded_pairs(pools.as_scene()),
            pools.as_scene().object_count(),
        );
        println!(
            "{name}: {excluded} pairs excluded of {}",
            4 * objects * objects
        );
        assert!(excluded > 2 * objects, "{name}: {excluded}");
        let scene = pools.as_scene();
        if scene.object_count() <= ObjectSet::TOLD_APART {
            // Of 48 directions and ways of each plane, one of four excludes one object at least.
            let by_grids = excluded_by_grids(scene);
            println!("{name}: {by_grids} pairs excluded by grids");
            assert!(by_grids >= 12 * scene.planes().len(), "{name}: {by_grids}");
        }
        let with_faint = |material: &Material<T>| material.faint_alignment() > 0;
        let faint = scene.materials().iter().copied().filter(with_faint).count();
        println!("{name}: {faint} materials with faint highlights");
        assert!(faint > 0, "{name}: no highlight is faint");
    }
}

#[test]
fn the_scenes_of_the_repository_have_the_same_bits_in_f32() {
    scenes_of_the_repository::<f32>();
}

#[test]
fn the_scenes_of_the_repository_have_the_same_bits_in_f64() {
    scenes_of_the_repository::<f64>();
}

fn material<T: Scalar>(random: &Random) -> MaterialDescription<T> {
    let share = || T::from_f64(random.between(0.0, 1.0));
    let coefficient = || match random.below(3) {
        0 => T::ZERO,
        _ => T::from_f64(random.between(0.2, 1.0)),
    };
    let indices = [0.7, 0.9999, 1.0, 1.0, 1.0001, 1.5, 2.4];
    MaterialDescription {
        diffuse: Color::new(share(), share(), share()),
        specular: Color::new(share(), share(), share()),
        ambient: Color::new(share(), share(), share()),
        reflection: coefficient(),
        shininess: T::from_i32(random.below(60) as i32),
        refraction: coefficient(),
        index_of_refraction: T::from_f64(indices[random.below(indices.len())]),
    }
}

/// A scene in which much touches, overlaps, encloses and hides much: the objects crowd around a few
/// places, at sizes over several decades, the camera and the light often inside one of them.
fn crowded<T: Scalar>(random: &Random, offset: f64, scale: f64) -> Model<T> {
    let to_scene = |v: Vec3<f64>| {
        Vec3::new(
            T::from_f64(offset + scale * v.x),
            T::from_f64(offset + scale * v.y),
            T::from_f64(offset + scale * v.z),
        )
    };
    let places: Vec<Vec3<f64>> = (0..3)
        .map(|_| random.point::<f64>(1.0) + Vec3::new(0.0, 0.0, 3.0))
        .collect();
    let near_a_place = |spread: f64| places[random.below(3)] + random.point(spread);
    let parts = (0..2 + random.below(9))
        .map(|_| Part {
            material: material(random),
            shape: match random.below(5) {
                0 => {
                    let normal: Vec3<T> = random.direction();
                    // Through one of the places, or just beside it.
                    let point = to_scene(near_a_place(0.3));
                    Shape::Plane {
                        normal,
                        distance: -normal.dot(point),
                    }
                }
                1 | 2 => Shape::Triangle({
                    let size = random.log_between(1e-2, 2.0);
                    let corner = near_a_place(0.5);
                    [(); 3].map(|()| to_scene(corner + random.point(size)))
                }),
                _ => Shape::Sphere {
                    center: to_scene(near_a_place(0.5)),
                    radius: T::from_f64(scale * random.log_between(1e-2, 2.0)),
                },
            },
        })
        .collect();
    let light = || Light {
        position: to_scene(match random.below(4) {
            0 => random.point(30.0),
            1 => near_a_place(0.1),
            _ => near_a_place(3.0),
        }),
        specular: Color::new(T::ONE, T::ONE, T::ONE),
        diffuse: Color::new(T::ONE, T::HALF, T::ONE),
    };
    Model {
        camera: to_scene(match random.below(3) {
            0 => near_a_place(0.2),
            _ => random.point(1.0),
        }),
        resolution: Resolution {
            width: 800,
            height: 600,
        },
        ambient: T::from_f64(0.1),
        background: Background {
            color: Color::BLACK,
            sky: true,
        },
        lights: (0..1 + random.below(2)).map(|_| light()).collect(),
        parts,
    }
}

/// Fills empty pools with a model and prepares them. A triangle that the scalar sees as a line is left
/// out.
fn fill<T: Scalar>(pools: &mut PoolsMut<'_, T>, model: &Model<T>) {
    pools.set_camera(Camera {
        position: model.camera,
    });
    pools.set_ambient(model.ambient);
    pools.set_background(model.background);
    for light in &model.lights {
        pools.add_light(*light).unwrap();
    }
    for part in &model.parts {
        match part.add_to(pools) {
            Ok(()) | Err(SceneError::Shape(ShapeError::NoArea)) => {}
            Err(error) => panic!("{part:?}: {error}"),
        }
    }
    pools.prepare();
}

fn crowded_scenes<T: Scalar>(default_seed: u64, scenes: usize) {
    let random = Random::of_test(default_seed);
    let (mut excluded, mut objects, mut quick_reject) = (0, 0, 0);
    for number in 0..scenes {
        let offset = [0.0, 0.0, 1.0, -30.0, 1000.0][random.below(5)];
        let scale = [1.0, 1.0, 1e-3, 1e3][random.below(4)];
        let model = crowded::<T>(&random, offset * scale, scale);
        let mut pools = RoomyPools::new();
        fill(&mut pools.as_mut(), &model);
        assert!(!pools.as_scene().accel().sides().is_empty());
        let resolution = Resolution {
            width: 24,
            height: 18,
        };
        quick_reject += compare(pools.as_scene(), resolution, || {
            format!("scene {number}, offset {offset}, scale {scale}: {model:#?}")
        });
        excluded += excluded_pairs(pools.as_scene());
        objects += pools.as_scene().object_count();
    }
    println!(
        "{scenes} scenes of {objects} objects, {excluded} pairs excluded, {quick_reject} clear misses"
    );
    let single = T::NAME == f32::NAME;
    assert_eq!(
        quick_reject > 1000 * scenes as u64,
        single,
        "{quick_reject}"
    );
    assert!(excluded > 4 * objects, "only {excluded} pairs excluded");
}

#[test]
fn thousands_of_crowded_scenes_have_the_same_bits_in_f32() {
    crowded_scenes::<f32>(1, 4000);
}

#[test]
fn crowded_scenes_have_the_same_bits_in_f64() {
    crowded_scenes::<f64>(2, 1000);
}

#[test]
fn objects_beyond_the_bits_of_a_set_are_candidates() {
    let random = Random::of_test(3);
    for _ in 0..20 {
        let mut model = crowded::<f32>(&random, 0.0, 1.0);
        while model.parts.len() < 140 {
            model.parts.extend(crowded(&random, 0.0, 1.0).parts);
        }
        model.parts.truncate(140);
        let mut pools = ScenePools::<f32, 140, 140, 140, 140, 4, 140>::new();
        fill(&mut pools.as_mut(), &model);
        let resolution = Resolution {
            width: 16,
            height: 12,
        };
        let scene = pools.as_scene();
        assert!(scene.spheres().len().max(scene.triangles().len()) > ObjectSet::TOLD_APART);
        compare(scene, resolution, || "a large scene".into());
    }
}
