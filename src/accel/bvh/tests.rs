//! The shape of the hierarchy; that it leaves out nothing that a ray hits is tested in tests/hits/bvh.rs.

use std::vec::Vec;

use super::bounds::Bounds;
use super::{Bvh, BvhNode, NodeContent, Walk, build};
use crate::ray::Ray;
use crate::shape::{Geometry, ObjectInfo, Sphere};
use crate::vec3::Vec3;

fn sphere((center, radius): (Vec3<f32>, f32)) -> Sphere<f32> {
    let info = ObjectInfo {
        material: 0,
        number: 0,
    };
    Sphere::new(center, radius, info).unwrap()
}

fn scene(spheres: &[Sphere<f32>]) -> Geometry<'_> {
    Geometry {
        spheres,
        ..Geometry::NONE
    }
}

/// Builds the hierarchy of spheres, checks all that is promised of it, and returns how deep it is.
fn check(spheres: &[(Vec3<f32>, f32)]) -> usize {
    let spheres: Vec<Sphere<f32>> = spheres.iter().copied().map(sphere).collect();
    let scene = scene(&spheres);
    let mut entries: Vec<u32> = (0..spheres.len() as u32).collect();
    let mut nodes = heapless::Vec::<BvhNode, 4096>::new();
    build(&scene, &mut entries, nodes.as_mut_view());
    assert!(!nodes.is_empty() && nodes.len() < spheres.len().max(2));

    let mut found = std::vec![0; spheres.len()];
    let mut reached = 1;
    let mut deepest = 0;
    let mut depths = std::vec![0; nodes.len()];
    for (index, node) in nodes.iter().enumerate() {
        let holds = |inside: &Bounds<f32>| {
            let (low, high) = (node.low(), node.high());
            let is_below = |a: Vec3<f32>, b: Vec3<f32>| a.x <= b.x && a.y <= b.y && a.z <= b.z;
            is_below(low, inside.low) && is_below(inside.high, high)
        };
        match node.content() {
            NodeContent::Leaf { first, count } => {
                deepest = deepest.max(depths[index]);
                assert!(count >= 1);
                for entry in &entries[first as usize..][..count as usize] {
                    found[*entry as usize] += 1;
                    assert!(holds(&Bounds::around(&scene, *entry)));
                }
            }
            NodeContent::Inner { first, axis } => {
                // Every node but the root is a child once.
                assert_eq!(first, reached);
                reached += 2;
                assert!(first as usize > index && axis < 3);
                for child in [first, first + 1].map(|child| child as usize) {
                    depths[child] = depths[index] + 1;
                    let child = &nodes[child];
                    assert!(holds(&Bounds {
                        low: child.low(),
                        high: child.high(),
                    }));
                }
            }
        }
    }
    assert_eq!(reached as usize, nodes.len());
    assert!(found.iter().all(|times| *times == 1), "{found:?}");
    assert!(deepest <= Bvh::<f32>::MAX_DEPTH);

    // A walk that nothing stops visits every node.
    let bvh = Bvh {
        nodes: &nodes,
        entries: &entries,
    };
    let nan = Vec3::splat(f32::NAN);
    let mut walk = Walk::new(bvh, &Ray::new(nan, nan));
    let (mut boxes, mut objects) = (0, 0);
    while let Some(leaf) = walk.next_leaf(1.0, || boxes += 1) {
        objects += leaf.len();
    }
    assert_eq!((boxes, objects), (nodes.len(), spheres.len()));
    deepest
}

#[test]
fn hierarchies_of_any_number_of_spheres_keep_their_promises() {
    for count in 1..200_u32 {
        let place = |i: u32| (i.wrapping_mul(2_654_435_769) >> 8) as f32 / 1e6;
        let spheres: Vec<_> = (0..count)
            .map(|i| {
                let center = Vec3::new(place(3 * i), place(3 * i + 1), place(3 * i + 2));
                (center, 0.1 + place(7 * i))
            })
            .collect();
        check(&spheres);
    }
}

#[test]
fn objects_in_one_place_are_halved() {
    let deepest = check(&std::vec![(Vec3::new(1.0, 2.0, 3.0), 1.0); 3000]);
    assert_eq!(deepest, 9);
}

#[test]
fn sizes_of_any_spread_keep_the_depth() {
    // Each sphere is half as large as the one before and half as far away.
    let halved = |i: i32| 2.0_f32.powi(-i);
    let series: Vec<_> = (-40..85)
        .map(|i| (Vec3::new(0.0, 0.0, 3.0 * halved(i)), halved(i)))
        .collect();
    let many: Vec<_> = series.iter().cycle().take(4000).copied().collect();
    assert!(check(&series) > 10);
    check(&many);
}

#[test]
fn numbers_at_the_end_of_the_range_make_a_bvh() {
    let largest = Vec3::splat(f32::MAX);
    let mut spheres = std::vec![(largest, 1e19), (-largest, 1.0), (largest, 1e-30)];
    spheres.extend((0..40).map(|i| (Vec3::splat(1e-40 * i as f32), 1e-38)));
    check(&spheres);
    spheres.push((Vec3::splat(f32::NAN), 1.0));
    let spheres: Vec<Sphere<f32>> = spheres.into_iter().map(sphere).collect();
    let mut entries: Vec<u32> = (0..spheres.len() as u32).collect();
    let mut nodes = heapless::Vec::<BvhNode, 64>::new();
    build(&scene(&spheres), &mut entries, nodes.as_mut_view());
}

/// A ray from the origin has no margin, nor has a box that is not built around anything.
#[test]
fn a_box_that_begins_at_the_farthest_distance_is_visited_and_one_beyond_it_is_not() {
    for (axis, sign) in (0..3).flat_map(|axis| [(axis, 1.0_f32), (axis, -1.0)]) {
        let along = |on: f32, across: f32| {
            let coordinate = |other| if other == axis { on } else { across };
            Vec3::new(coordinate(0), coordinate(1), coordinate(2))
        };
        let (near, far) = (along(2.0 * sign, -1.0), along(3.0 * sign, 1.0));
        let content = NodeContent::Leaf { first: 0, count: 1 };
        let node = BvhNode::new(
            near.min_by_component(far),
            near.max_by_component(far),
            content,
        );
        let bvh = Bvh {
            nodes: &[node],
            entries: &[7],
        };
        let ray = Ray::new(Vec3::splat(0.0), along(sign, 0.0));
        let visited = |t_max: f32| Walk::new(bvh, &ray).next_leaf(t_max, || ());
        assert_eq!(visited(2.0), Some(&[7][..]), "axis {axis}, {sign}");
        assert_eq!(visited(2.0_f32.next_down()), None, "axis {axis}, {sign}");
    }
}
