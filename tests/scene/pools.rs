//! Pools that are declared by name, and scenes that are changed: never a picture that is wrong without an error.

use crate::common::scenes::{Shape, load};
use scanray::{
    Camera, Color, Light, MaterialDescription, Resolution, Scene, SceneError, ScenePools, Stages,
    Tracer, Vec3,
    pools::{Pool, PoolsMut},
};

scanray::scene_pools! {
    /// As the default scene needs them.
    struct AsDefault { spheres: 5, planes: 1, triangles: 1, materials: 7, lights: 1 }
}

scanray::scene_pools! {
    struct Opaque { spheres: 2, discs: 3, materials: 4, lights: 2 } without refraction
}

scanray::scene_pools! {
    struct Bare { spheres: 2, materials: 2 } without accel, reflection, specular
}

scanray::scene_pools! {
    struct Large<f64> { triangles: 100, planes: 1, materials: 2, lights: 1 }
}

const TEXT: &[u8] = include_bytes!("../../scenes/default.txt");

const SIZE: Resolution = Resolution {
    width: 40,
    height: 30,
};

fn picture(scene: Scene<'_>) -> Vec<[u32; 3]> {
    let tracer = Tracer::new(scene).with_resolution(SIZE);
    let places = (0..SIZE.height).flat_map(|y| (0..SIZE.width).map(move |x| (x, y)));
    places
        .map(|(x, y)| {
            let Color { r, g, b } = tracer.pixel(x, y);
            [r, g, b].map(f32::to_bits)
        })
        .collect()
}

fn painted(r: f32) -> MaterialDescription {
    MaterialDescription {
        diffuse: Color::new(r, 0.4, 0.3),
        ambient: Color::new(r, 0.4, 0.3),
        ..Default::default()
    }
}

#[test]
fn named_pools_hold_what_they_name_and_draw_the_same_picture() {
    let mut named = AsDefault::new();
    named.parse(TEXT).unwrap();
    assert_eq!(
        picture(named.as_scene()),
        picture(load("default").as_scene())
    );
    let tracer = named.tracer().with_resolution(SIZE);
    let all = Tracer::new(named.as_scene()).with_resolution(SIZE);
    assert_eq!(tracer.pixel(20, 15), all.pixel(20, 15));
    let several = Stages::SEVERAL_PLANES
        .union(Stages::SEVERAL_TRIANGLES)
        .union(Stages::MANY_OBJECTS)
        .union(Stages::SEVERAL_LIGHTS);
    let left_out = several.union(Stages::DISCS);
    assert_eq!(AsDefault::STAGES, Stages::ALL.without(left_out));
    assert!(named.as_scene().accel().sides().len() == 14);
}

#[test]
fn what_is_not_named_takes_no_room_and_is_an_error_that_says_so() {
    // 80 bytes of candidates an object, 36 the sphere, 72 a material; lengths of lists.
    assert!(size_of::<Bare>() < size_of::<Opaque>());
    let lengths = 16 * size_of::<usize>();
    let spheres = 2 * size_of::<scanray::shape::Sphere>() + 2 * size_of::<scanray::Material>();
    assert!(
        size_of::<Bare>() <= spheres + 64 + lengths,
        "{}",
        size_of::<Bare>()
    );

    let mut opaque = Opaque::new();
    let error = opaque.parse(TEXT).unwrap_err();
    assert_eq!(
        error.to_string(),
        "line 9, column 56: expected the refraction: 0, because the pools are declared without refraction; found `0.7`",
    );
    assert_eq!(opaque.as_scene().object_count(), 0);

    let mut bare = Bare::new();
    let mut filling = bare.as_mut();
    let full = SceneError::PoolFull {
        pool: Pool::Planes,
        capacity: 0,
    };
    let up = Vec3::new(0.0, 1.0, 0.0);
    assert_eq!(filling.add_plane(up, 1.0, painted(0.1)), Err(full));
    let shiny = MaterialDescription {
        reflection: 0.5,
        ..painted(0.1)
    };
    assert_eq!(
        filling.add_sphere(up, 1.0, shiny),
        Err(SceneError::LeftOut {
            stage: Stages::REFLECTION
        })
    );
    filling.add_sphere(up, 1.0, painted(0.2)).unwrap();
    filling.prepare();
    assert_eq!(bare.as_scene().object_count(), 1);
    assert!(bare.as_scene().accel().sides().is_empty());
}

#[test]
fn large_named_pools_have_a_hierarchy() {
    let mut large = Large::new();
    let mut filling = large.as_mut();
    for i in 0..60 {
        let corner = Vec3::new(f64::from(i) * 0.1 - 3.0, 0.0, 5.0);
        let vertices = [
            corner,
            corner + Vec3::new(0.05, 0.0, 0.0),
            corner + Vec3::new(0.0, 0.5, 0.1),
        ];
        filling.add_triangle(vertices, Default::default()).unwrap();
    }
    filling.prepare();
    assert!(large.as_scene().accel().bvh().is_some());
    assert!(large.tracer().stages().contains(Stages::BVH));
    let brute_force = Tracer::new(large.as_scene().without_accel()).with_resolution(SIZE);
    let tracer = large.tracer().with_resolution(SIZE);
    for x in 0..SIZE.width {
        assert_eq!(tracer.pixel(x, 14), brute_force.pixel(x, 14));
    }
}

#[test]
fn discs_are_added_changed_and_counted() {
    let mut pools = Opaque::new();
    let disc = |x: f32| Shape::Disc {
        center: Vec3::new(x, 0.0, 4.0),
        normal: Vec3::new(0.0, 0.2, -1.0),
        radius: 0.6,
    };
    let mut filling = pools.as_mut();
    filling.add_light(Light::WHITE).unwrap();
    filling.set_ambient(0.2);
    for x in [-1.0, 0.0, 1.0] {
        filling.add(disc(x), painted(0.5)).unwrap();
    }
    let full = SceneError::PoolFull {
        pool: Pool::Discs,
        capacity: 3,
    };
    assert_eq!(filling.add(disc(2.0), painted(0.5)), Err(full));
    filling.prepare();
    let before = picture(pools.as_scene());
    assert_eq!(before, picture(pools.as_scene().without_accel()));
    assert!(before.iter().any(|pixel| *pixel != before[0]));
    pools.as_mut().set(1, disc(0.3)).unwrap();
    assert!(pools.as_scene().accel().sides().is_empty());
    let after = picture(pools.as_scene());
    assert_ne!(before, after);
    pools.prepare();
    assert_eq!(after, picture(pools.as_scene()));
    let missing = SceneError::Missing {
        pool: Pool::Discs,
        index: 3,
        used: 3,
    };
    assert_eq!(pools.as_mut().set(3, disc(0.0)), Err(missing));
}

/// Changes a scene in two ways that must show the same: in pools that are prepared, and in pools that know nothing.
fn change(change: impl Fn(&mut PoolsMut<'_, f32>)) {
    let mut prepared: ScenePools = load("default");
    let before = picture(prepared.as_scene());
    change(&mut prepared.as_mut());
    let plain = prepared.as_scene().without_accel();
    let expected = picture(plain);
    assert_ne!(before, expected);
    assert_eq!(picture(prepared.as_scene()), expected);
    prepared.prepare();
    assert_eq!(picture(prepared.as_scene()), expected);
}

#[test]
fn a_changed_scene_keeps_nothing_that_was_derived_from_the_old_one() {
    change(|pools| {
        pools.set_sphere(1, Vec3::new(0.5, 0.3, 2.0), 0.7).unwrap();
    });
    change(|pools| {
        pools.set_plane(0, Vec3::new(0.1, 1.0, 0.0), 0.6).unwrap();
    });
    change(|pools| {
        let z = 3.0;
        let vertices = [
            Vec3::new(-3.0, 0.0, z),
            Vec3::new(-1.0, 2.0, z),
            Vec3::new(0.0, -1.0, z),
        ];
        pools.set_triangle(0, vertices).unwrap();
    });
    change(|pools| {
        let light = Light {
            position: Vec3::new(-30.0, 20.0, 1.0),
            ..Light::WHITE
        };
        pools.set_light(0, light).unwrap();
    });
    change(|pools| {
        let ghost = MaterialDescription {
            index_of_refraction: 1.0,
            ..painted(0.9)
        };
        pools.set_material(0, ghost).unwrap();
    });
    change(|pools| {
        pools.set_camera(Camera {
            position: Vec3::new(0.3, 0.4, -1.0),
        });
    });
    change(|pools| pools.set_ambient(0.0));
}

#[test]
fn what_is_not_there_cannot_be_changed() {
    let mut pools: ScenePools = load("default");
    let before = picture(pools.as_scene());
    let mut filling = pools.as_mut();
    let missing = |pool, used| SceneError::Missing {
        pool,
        index: 9,
        used,
    };
    let up = Vec3::new(0.0, 1.0, 0.0);
    assert_eq!(
        filling.set_sphere(9, up, 1.0),
        Err(missing(Pool::Spheres, 5))
    );
    assert_eq!(filling.set_plane(9, up, 1.0), Err(missing(Pool::Planes, 1)));
    assert_eq!(
        filling.set_light(9, Light::WHITE),
        Err(missing(Pool::Lights, 1))
    );
    assert_eq!(
        filling.set_material(9, painted(0.0)),
        Err(missing(Pool::Materials, 5))
    );
    assert!(filling.set_sphere(0, up, -1.0).is_err());
    assert_eq!(
        missing(Pool::Lights, 1).to_string(),
        "there are 1 lights, so that none has the index 9"
    );
    // What was derived is still there, and true.
    assert!(!pools.as_scene().accel().sides().is_empty());
    assert_eq!(picture(pools.as_scene()), before);
}

#[test]
fn a_view_with_other_parts_drops_what_was_derived_and_keeps_it_with_another_camera() {
    let pools: ScenePools = load("default");
    let scene = pools.as_scene();
    let lights = [Light {
        position: Vec3::new(-9.0, 9.0, -2.0),
        ..Light::WHITE
    }];
    let camera = Camera {
        position: Vec3::new(0.2, 0.1, -1.0),
    };
    for (changed, keeps) in [
        (scene.with_camera(camera), true),
        (scene.with_lights(&lights), false),
        (scene.with_spheres(&scene.spheres()[1..]), false),
        (scene.with_planes(&[]), false),
        (scene.with_triangles(&[]), false),
        (scene.with_materials(&scene.materials()[1..]), false),
    ] {
        assert_eq!(!changed.accel().sides().is_empty(), keeps);
        assert_eq!(picture(changed), picture(changed.without_accel()));
        assert_ne!(picture(changed), picture(scene));
    }
}
