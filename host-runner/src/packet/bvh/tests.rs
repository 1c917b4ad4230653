//! That the hierarchies in other layouts have the objects of the scene's own, and that pictures by them are those of
//! brute force, to the bit.

use scanray::accel::{Accel, BvhNode, NodeContent};
use scanray::{
    Background, Camera, Color, Light, MaterialDescription, Resolution, Scene, ScenePools, Tracer,
    Vec3,
};

use super::wide::{WideBvh, WideChild, WideLeaf, WidePart};
use super::{PacketBvh, PairBvh};
use crate::packet::PacketTracer;
use crate::packet::tests::{Random, STACK, assert_same_as};

type Pools = ScenePools<f32, 1024, 1, 0, 1025, 2, 0, 1024>;

/// Compares pictures of a crowd of spheres, seen from where most of it is in view, with those by brute force.
fn compare(name: &str, random: &Random, spheres: &[(Vec3, f32)], is_bvh_expected: bool) {
    let mut pools = Box::new(Pools::new());
    let mut filling = Pools::as_mut(&mut pools);
    let extent = spheres.iter().fold(1e-30_f32, |extent, (center, radius)| {
        let Vec3 { x, y, z } = center.abs();
        extent.max(x + radius).max(y + radius).max(z + radius)
    });
    filling.set_ambient(0.5);
    filling.set_camera(Camera {
        position: Vec3::new(0.1, 0.2, -1.5) * extent,
    });
    filling.set_background(Background {
        color: Color::BLACK,
        sky: true,
    });
    for place in [Vec3::new(1.0, 3.0, -2.0), Vec3::new(0.1, 0.2, 0.3)] {
        let light = Light {
            position: place * extent,
            specular: Color::new(0.5, 0.5, 0.5),
            diffuse: Color::new(0.5, 0.5, 0.5),
        };
        filling.add_light(light).unwrap();
    }
    let floor = MaterialDescription {
        reflection: 0.5,
        ..Default::default()
    };
    filling
        .add_plane(Vec3::new(0.0, 1.0, 0.0), extent, floor)
        .unwrap();
    for (number, (center, radius)) in spheres.iter().enumerate() {
        let material = MaterialDescription {
            // Neighbours of the same place can be told apart.
            ambient: Color::new((number % 7) as f32 / 7.0, (number % 5) as f32 / 5.0, 0.5),
            diffuse: Color::new(0.5, 0.5, 0.5),
            reflection: random.pick(&[0.0, 0.5]),
            refraction: random.pick(&[0.0, 0.0, 0.5]),
            index_of_refraction: random.pick(&[1.0, 1.5]),
            ..Default::default()
        };
        filling.add_sphere(*center, *radius, material).unwrap();
    }
    pools.prepare();
    let scene = pools.as_scene();
    assert_eq!(scene.accel().bvh().is_some(), is_bvh_expected, "{name}");
    if is_bvh_expected {
        check_layouts(name, scene);
    }
    let by_brute_force = scene.without_accel();
    let resolution = Resolution {
        width: 20,
        height: 9,
    };
    assert_same_as(name, scene, by_brute_force, resolution, 3);
}

/// Every sphere is in one leaf of each layout, and a pair and its part of the wide hierarchy have the same spheres.
fn check_layouts(name: &str, scene: Scene<'_>) {
    let tracer = Tracer::new(scene).with_bvh().with_stack::<STACK>();
    let packets = PacketTracer::new(tracer);
    let bvh = PacketBvh::new(&packets, 0).expect("the builder's leaves are small");
    let wide = bvh.wide.as_ref().expect("a walk has room for this bvh");
    let mut all = spheres_of_part(
        wide,
        WidePart {
            node: 0,
            children: u8::MAX,
        },
    );
    all.sort_unstable();
    // Indices count through the spheres first, whatever the order of the text.
    let expected: Vec<u32> = (0..scene.spheres().len() as u32).collect();
    assert_eq!(all, expected, "{name}");
    for (index, pair) in bvh.pairs.nodes.iter().enumerate() {
        let mut spheres = spheres_of_pair(&bvh.pairs, index);
        let mut of_part = spheres_of_part(wide, pair.wide);
        spheres.sort_unstable();
        of_part.sort_unstable();
        let in_one_leaf = pair.wide.children.is_power_of_two() && of_part.len() <= 8;
        if in_one_leaf {
            // The leaf may hold more.
            spheres.retain(|sphere| of_part.binary_search(sphere).is_err());
            assert!(spheres.is_empty(), "{name}, pair {index}: {spheres:?}");
        } else {
            assert_eq!(spheres, of_part, "{name}, pair {index}");
        }
    }
}

fn spheres_of_pair(bvh: &PairBvh<'_>, index: usize) -> Vec<u32> {
    let mut spheres = Vec::new();
    let mut pending = vec![index as u32];
    while let Some(index) = pending.pop() {
        let pair = &bvh.nodes[index as usize];
        for (first, count) in pair.first.into_iter().zip(pair.count) {
            match count {
                0 => pending.push(first),
                _ => {
                    let leaf = &bvh.leaves[first as usize..][..usize::from(count)];
                    spheres.extend(leaf.iter().map(|object| object.index));
                }
            }
        }
    }
    spheres
}

fn spheres_of_part(bvh: &WideBvh, part: WidePart) -> Vec<u32> {
    let mut spheres = Vec::new();
    let mut pending = vec![part];
    while let Some(WidePart { node, children }) = pending.pop() {
        let node = &bvh.nodes[node as usize];
        for lane in 0..8 {
            let is_there = node.bounds[0][0][lane] <= node.bounds[0][1][lane];
            if children >> lane & 1 == 0 || !is_there {
                continue;
            }
            let child: WideChild = node.children[lane];
            match child.leaf() {
                Some(leaf) => {
                    let WideLeaf {
                        radius_squared,
                        index,
                        ..
                    } = &bvh.leaves[leaf];
                    let there = radius_squared.map(|square| square > f32::NEG_INFINITY);
                    let there = index.iter().zip(there).filter(|(_, there)| *there);
                    spheres.extend(there.map(|(index, _)| index));
                }
                None => pending.push(WidePart {
                    node: child.0,
                    children: u8::MAX,
                }),
            }
        }
    }
    spheres
}

#[test]
fn pictures_of_random_spheres_are_those_of_brute_force() {
    let scenes = if cfg!(debug_assertions) { 60 } else { 1000 };
    for seed in 0..scenes {
        let random = Random::new(2_000_000 + seed);
        let scale = random.pick(&[1.0, 1.0, 1e-3, 1e5, 1e-12, 1e15]);
        let grid = random.one_in(2);
        let mut spheres = Vec::new();
        for _ in 0..48 + random.below(300) {
            let center = random.point(scale, grid);
            let radius = scale * random.pick(&[1e-5, 0.03, 0.125, 0.25, 1.0]);
            // Ties: the same place, and surfaces that touch.
            for _ in 0..1 + random.below(12) / 11 {
                spheres.push((center, radius));
            }
        }
        let name = format!("random spheres of seed {seed}");
        compare(&name, &random, &spheres, true);
    }
}

#[test]
fn pictures_of_any_number_of_spheres_are_those_of_brute_force() {
    for count in [0, 1, 2, 47, 48, 49, 50, 64, 65, 511, 512, 513, 1024] {
        let random = Random::new(count);
        let spheres: Vec<_> = (0..count)
            .map(|_| (random.point(1.0, false), random.between(0.01, 0.2)))
            .collect();
        compare(&format!("{count} spheres"), &random, &spheres, count >= 48);
    }
}

#[test]
fn pictures_of_stiff_crowds_are_those_of_brute_force() {
    let random = Random::new(7);
    let one_place = vec![(Vec3::new(1.0, 2.0, 3.0), 1.0); 700];
    compare("all in one place", &random, &one_place, true);
    // Each half as large as the one before and half as far away: a hierarchy as deep as there can be.
    let halved = |i: i32| 2.0_f32.powi(-i);
    let series: Vec<_> = (-40..60)
        .map(|i| (Vec3::new(0.0, 0.0, 3.0 * halved(i)), halved(i)))
        .collect();
    compare("halved", &random, &series, true);
    let many: Vec<_> = series.iter().cycle().take(1000).copied().collect();
    compare("halved, ten times", &random, &many, true);
    // Away from the camera, so that depth in the hierarchy is depth in the picture.
    let away: Vec<_> = (0..60)
        .map(|i| (Vec3::new(0.0, 0.0, halved(-i)), 0.3 * halved(-i)))
        .collect();
    compare("doubled", &random, &away, true);
    let huge: Vec<_> = (0..200)
        .map(|_| (random.point(1e18, false), 1e17))
        .collect();
    compare("huge", &random, &huge, true);
    let line: Vec<_> = (0..1000)
        .map(|i| (Vec3::new(i as f32 - 500.0, 0.0, 0.0), 0.5))
        .collect();
    compare("touching in a row", &random, &line, true);
}

/// A hierarchy that the scene's builder would not make is left to the core.
#[test]
fn a_bvh_of_large_leaves_is_left_to_the_core() {
    let mut pools = Box::new(Pools::new());
    let mut filling = Pools::as_mut(&mut pools);
    filling.set_ambient(1.0);
    for i in 0..60 {
        let center = Vec3::new(i as f32 * 0.1 - 3.0, 0.0, 4.0);
        let material = MaterialDescription {
            ambient: Color::new(0.3, i as f32 / 60.0, 0.5),
            ..Default::default()
        };
        filling.add_sphere(center, 0.2, material).unwrap();
    }
    let scene = pools.as_scene();
    let entries: Vec<_> = (0..60).collect();
    let all = NodeContent::Leaf {
        first: 0,
        count: 60,
    };
    let nodes = [BvhNode::new(Vec3::splat(-9.0), Vec3::splat(9.0), all)];
    let by_leaf = scene.with_accel(Accel::from_parts(&[], &[], &nodes, &entries, true));
    let tracer = Tracer::new(by_leaf).with_bvh().with_stack::<STACK>();
    assert!(PacketTracer::new(tracer).bvh.is_none());
    let resolution = Resolution {
        width: 40,
        height: 9,
    };
    assert_same_as("one leaf", by_leaf, scene, resolution, 1);
}
