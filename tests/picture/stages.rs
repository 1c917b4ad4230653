//! Stages that a scene does not need can be left out: the picture has the same bits. Stages that it needs
//! cannot.

use crate::common::sampling::bits;
use crate::common::scenes::load;
use scanray::{Resolution, ScenePools, Stages, Tracer, tracer::MissingStages};

const SIZE: Resolution = Resolution {
    width: 80,
    height: 60,
};

/// What all scenes of the repository need.
const COMMON: Stages = Stages::SPHERES
    .union(Stages::SEVERAL_SPHERES)
    .union(Stages::PLANES)
    .union(Stages::TRIANGLES)
    .union(Stages::LIGHT)
    .union(Stages::SHADOWS)
    .union(Stages::SPECULAR)
    .union(Stages::REFLECTION);

/// Draws a scene with the stages `STAGES` alone, which must be exactly those it needs.
fn draws_with<const STAGES: u64>(name: &str) {
    let pools = load::<f32>(name);
    let all = Tracer::new(pools.as_scene()).with_resolution(SIZE);
    assert_eq!(all.stages(), Stages::ALL);
    assert_eq!(all.with_bvh().stages(), Stages::ALL.union(Stages::BVH));
    assert_eq!(
        pools.as_scene().stages(),
        Stages::from_bits(STAGES),
        "{name}"
    );
    let few = all.specialize::<STAGES>().unwrap();
    for y in 0..SIZE.height {
        for x in 0..SIZE.width {
            assert_eq!(
                bits(few.pixel(x, y)),
                bits(all.pixel(x, y)),
                "{name} {x},{y}"
            );
        }
    }
}

#[test]
fn the_scenes_have_the_same_bits_with_what_they_need() {
    const STRAIGHT: Stages = COMMON.union(Stages::REFRACTION);
    const BENT: Stages = STRAIGHT.union(Stages::BENDING);
    const FACES: Stages = Stages::SEVERAL_TRIANGLES;
    const WALLS: Stages = Stages::SEVERAL_PLANES.union(FACES);
    const SKY: Stages = Stages::SKY;
    const PLAIN: Stages = Stages::PLAIN_BACKGROUND;
    draws_with::<{ BENT.union(SKY).bits() }>("default");
    draws_with::<{ STRAIGHT.union(FACES).union(SKY).bits() }>("reflective");
    draws_with::<
        {
            STRAIGHT
                .union(WALLS)
                .union(SKY)
                .union(Stages::MANY_OBJECTS)
                .bits()
        },
    >("window-room");
    draws_with::<{ STRAIGHT.union(FACES).union(PLAIN).bits() }>("pyramids");
    draws_with::<{ COMMON.union(WALLS).union(PLAIN).bits() }>("mirror-room");
}

#[test]
fn a_missing_stage_is_named() {
    let pools = load::<f32>("default");
    let tracer = Tracer::new(pools.as_scene());
    let error = tracer.specialize::<{ COMMON.bits() }>().unwrap_err();
    assert_eq!(
        error,
        MissingStages(Stages::REFRACTION.union(Stages::BENDING).union(Stages::SKY))
    );
    assert_eq!(
        error.to_string(),
        "the scene needs stages that are not compiled in: refraction, bending, sky"
    );
}

#[test]
fn loops_are_needed_where_there_are_several() {
    type Pools = ScenePools<f32, 2, 1, 1, 4, 2>;
    const LOOPS: Stages = Stages::SEVERAL_SPHERES.union(Stages::SEVERAL_LIGHTS);
    const REST: Stages = Stages::SEVERAL_PLANES
        .union(Stages::SEVERAL_TRIANGLES)
        .union(Stages::MANY_OBJECTS)
        .union(Stages::DISCS);
    assert_eq!(Pools::STAGES, Stages::ALL.without(REST));
    let none = ScenePools::<f32, 0, 0, 1, 1, 0>::STAGES;
    assert!(none.contains(Stages::TRIANGLES));
    for left_out in [Stages::SPHERES, Stages::PLANES, Stages::LIGHT, LOOPS, REST] {
        assert!(none.without(left_out) == none, "{left_out}");
    }

    let mut pools = Pools::new();
    pools
        .parse(
            b"2\n0 0 0\n8 6\n5 5 0 1 1 1 1 1 1\n0.1\n0\n0 0 0\n\
              0 -1 0 4 1 .1 .1 .1 1 1 1 .5 .5 .5 0 9 0 0\n0 1 0 4 1 .1 .1 .1 1 1 1 .5 .5 .5 0 9 0 0\n",
        )
        .unwrap();
    let one_light = pools.as_scene();
    assert!(one_light.stages().contains(Stages::SEVERAL_SPHERES));
    assert!(!one_light.stages().contains(Stages::SEVERAL_LIGHTS));
    let pixels = || (0..6).flat_map(|y| (0..8).map(move |x| (x, y)));
    let dark = Tracer::new(one_light);
    let before: Vec<_> = pixels().map(|(x, y)| bits(dark.pixel(x, y))).collect();
    let mut light = one_light.lights()[0];
    light.position.x = -5.0;
    pools.as_mut().add_light(light).unwrap();
    pools.prepare();
    let scene = pools.as_scene();
    assert!(scene.stages().contains(LOOPS));
    let all = Tracer::new(scene);
    let few = all.specialize::<{ Pools::STAGES.bits() }>().unwrap();
    let mut after = Vec::new();
    for (x, y) in pixels() {
        after.push(bits(few.pixel(x, y)));
        assert_eq!(after.last(), Some(&bits(all.pixel(x, y))), "{x},{y}");
    }
    assert_ne!(before, after);
    let error = all
        .specialize::<{ Stages::ALL.without(Stages::SEVERAL_LIGHTS).bits() }>()
        .unwrap_err();
    assert_eq!(error, MissingStages(Stages::SEVERAL_LIGHTS));
}

#[test]
fn fractional_shininess_is_needed_where_it_shows() {
    let text = |shininess: &str, specular: &str| {
        format!(
            "1\n0 0 0\n8 6\n5 5 0 1 1 1 1 1 1\n0.1\n0\n0 0 0\n\
             0 0 0 3 1 1 1 1 {specular} 1 1 1 0 {shininess} 0 0\n"
        )
    };
    let needs = |text: String| {
        let mut pools: scanray::ScenePools = scanray::ScenePools::new();
        pools.parse(text.as_bytes()).unwrap();
        pools.as_scene().stages()
    };
    let shining = Stages::SPHERES
        .union(Stages::LIGHT)
        .union(Stages::SHADOWS)
        .union(Stages::PLAIN_BACKGROUND)
        .union(Stages::SPECULAR);
    assert_eq!(needs(text("50", "1 1 1")), shining);
    let fractional = shining.union(Stages::FRACTIONAL_SHININESS);
    assert_eq!(needs(text("50.5", "1 1 1")), fractional);
    // Without a highlight its exponent does not matter.
    assert_eq!(
        needs(text("50.5", "0 0 0")),
        shining.without(Stages::SPECULAR)
    );
}
