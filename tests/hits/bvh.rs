//! The hierarchy of a large scene gives the hits and shadows of brute force, to the bit: in crowds of any scale,
//! with ties, coincident and degenerate objects, for rays that only just hit what they are aimed at.

use crate::common::random::Random;
use crate::common::sampling::bits;
use scanray::{
    Camera, Color, Light, MaterialDescription, Ray, Resolution, Scalar, ScenePools, Tracer, Vec3,
    ray::Side,
};

type Pools<T> = ScenePools<T, 256, 4, 512, 800, 1, 0, 768>;

/// A random scene and what rays to it are aimed at.
struct Crowd<'r, T> {
    random: &'r Random,
    pools: Box<Pools<T>>,
    scale: f64,
    center: Vec3<f64>,
    targets: Vec<Target<T>>,
}

#[derive(Clone, Copy)]
enum Target<T> {
    Sphere(Vec3<T>, T),
    Triangle([Vec3<T>; 3]),
}

fn cast<T: Scalar>(v: Vec3<f64>) -> Vec3<T> {
    Vec3::new(T::from_f64(v.x), T::from_f64(v.y), T::from_f64(v.z))
}

fn widen<T: Scalar>(v: Vec3<T>) -> Vec3<f64> {
    Vec3::new(v.x.to_f64(), v.y.to_f64(), v.z.to_f64())
}

/// On a coarse grid, so that objects, edges and rays coincide.
fn snap(v: Vec3<f64>, cell: f64) -> Vec3<f64> {
    let snap = |x: f64| (x / cell).round() * cell;
    Vec3::new(snap(v.x), snap(v.y), snap(v.z))
}

impl<'r, T: Scalar> Crowd<'r, T> {
    fn new(random: &'r Random) -> Self {
        let scale = random.log_between(1e-3, 1e5);
        let center = match random.below(4) {
            // Far from where coordinates are small.
            0 => random.point::<f64>(scale * random.log_between(1.0, 1e4)),
            _ => Vec3::new(0.0, 0.0, 2.0 * scale),
        };
        let mut crowd = Self {
            random,
            pools: Box::new(Pools::new()),
            scale,
            center,
            targets: Vec::new(),
        };
        for _ in 0..1 + random.below(3) {
            match random.below(7) {
                0 => crowd.add_cloud(1e-2, 0.3),
                1 => crowd.add_cloud(1e-5, 3.0),
                2 => crowd.add_grid(),
                3 => crowd.add_height_field(),
                4 => crowd.add_nested(),
                5 => crowd.add_copies(),
                _ => crowd.add_edge_on(),
            }
        }
        while crowd.targets.len() < 60 {
            crowd.add_cloud(1e-3, 1.0);
        }
        crowd.pools.prepare();
        crowd
    }

    fn point(&self) -> Vec3<f64> {
        self.center + self.random.point::<f64>(self.scale)
    }

    fn material(&self) -> MaterialDescription<T> {
        let number = |low, high| T::from_f64(self.random.between(low, high));
        MaterialDescription {
            ambient: Color::new(number(0.0, 1.0), number(0.0, 1.0), number(0.0, 1.0)),
            diffuse: Color::new(T::HALF, T::HALF, T::HALF),
            reflection: [T::ZERO, T::HALF][self.random.below(2)],
            refraction: [T::ZERO, T::ZERO, T::HALF][self.random.below(3)],
            index_of_refraction: [T::ONE, T::THREE_HALVES][self.random.below(2)],
            ..Default::default()
        }
    }

    fn add_sphere(&mut self, center: Vec3<f64>, radius: f64) {
        let (center, radius) = (cast(center), T::from_f64(radius));
        let material = self.material();
        let mut pools = Pools::as_mut(&mut self.pools);
        if pools.add_sphere(center, radius, material).is_ok() {
            self.targets.push(Target::Sphere(center, radius));
        }
    }

    /// Adds a triangle unless it has no area.
    fn add_triangle(&mut self, vertices: [Vec3<f64>; 3]) {
        let vertices = vertices.map(cast);
        let material = self.material();
        let mut pools = Pools::as_mut(&mut self.pools);
        if pools.add_triangle(vertices, material).is_ok() {
            self.targets.push(Target::Triangle(vertices));
        }
    }

    fn add_cloud(&mut self, smallest: f64, largest: f64) {
        let random = self.random;
        for _ in 0..random.below(60) {
            let size = self.scale * random.log_between(smallest, largest);
            let at = self.point();
            if random.below(2) == 0 {
                self.add_sphere(at, size);
            } else {
                let corner = || at + random.point::<f64>(size);
                self.add_triangle([corner(), corner(), corner()]);
            }
        }
    }

    fn add_grid(&mut self) {
        let random = self.random;
        let cell = self.scale * [0.25, 0.5][random.below(2)];
        for _ in 0..random.below(60) {
            let snapped = || snap(self.center + random.point::<f64>(self.scale), cell);
            let corners = [snapped(), snapped(), snapped()];
            if random.below(2) == 0 {
                self.add_sphere(corners[0], cell * [0.5, 1.0, 2.0][random.below(3)]);
            } else {
                self.add_triangle(corners);
            }
        }
    }

    /// A mesh without gaps.
    fn add_height_field(&mut self) {
        let random = self.random;
        let steps = 2 + random.below(8);
        let step = 2.0 * self.scale / steps as f64;
        let bump = self.scale * random.log_between(1e-6, 1.0);
        let corner = self.center - Vec3::splat(self.scale);
        let heights: Vec<f64> = (0..=steps * (steps + 2))
            .map(|_| random.between(-bump, bump))
            .collect();
        let vertex = |i: usize, j: usize| {
            let height = heights[(i * (steps + 1) + j) % heights.len()];
            corner + Vec3::new(i as f64 * step, height, j as f64 * step)
        };
        for i in 0..steps {
            for j in 0..steps {
                let [a, b] = [vertex(i, j), vertex(i + 1, j)];
                let [c, d] = [vertex(i, j + 1), vertex(i + 1, j + 1)];
                self.add_triangle([a, b, c]);
                self.add_triangle([b, d, c]);
            }
        }
    }

    fn add_nested(&mut self) {
        let at = self.point();
        let mut radius = self.scale;
        for _ in 0..self.random.below(40) {
            self.add_sphere(at, radius);
            radius *= self.random.between(0.5, 1.0);
        }
    }

    fn add_copies(&mut self) {
        let random = self.random;
        let (at, size) = (self.point(), self.scale * random.log_between(1e-3, 1.0));
        let corners = [(); 3].map(|()| at + random.point::<f64>(size));
        for _ in 0..random.below(40) {
            if random.below(2) == 0 {
                self.add_sphere(at, size);
            } else {
                self.add_triangle(corners);
            }
        }
    }

    /// Triangles in planes that contain the camera, or nearly.
    fn add_edge_on(&mut self) {
        let random = self.random;
        for _ in 0..random.below(40) {
            let (a, b) = (self.point(), self.point());
            let off = random.point::<f64>(self.scale * random.log_between(1e-9, 1e-3));
            let c = a * random.between(0.2, 3.0) + b * random.between(-1.0, 1.0) + off;
            self.add_triangle([a, b, c]);
        }
    }

    /// A ray that is likely to hit something, or to miss it by little.
    fn ray(&self) -> Ray<T> {
        let random = self.random;
        let target = self.targets[random.below(self.targets.len())];
        let near: Vec3<f64> = match random.below(5) {
            0 | 1 => Vec3::default(),
            2 => self.point(),
            3 => self.center + random.point::<f64>(self.scale * random.log_between(1.0, 1e3)),
            _ => snap(self.point(), self.scale * 0.25),
        };
        let origin: Vec3<T> = cast(near);
        let aim = match target {
            Target::Sphere(center, radius) => {
                let to_center = widen(center) - near;
                let side = to_center.cross(random.direction::<f64>()).normalize();
                // About the silhouette.
                let distance = match random.below(3) {
                    0 => 1.0 + random.sign() * random.log_between(1e-8, 1e-2),
                    1 => 1.0,
                    _ => random.between(0.0, 1.0),
                };
                widen(center) + side * (radius.to_f64() * distance)
            }
            Target::Triangle(vertices) => {
                let [a, b, c] = vertices.map(widen);
                let (s, t) = (random.between(0.0, 1.0), random.between(0.0, 1.0));
                match random.below(4) {
                    0 => a,
                    1 => b + (c - b) * s,
                    2 => a + (c - a) * (s + random.log_between(1e-8, 1e-2)),
                    _ => a + ((b - a) * t + (c - a) * (1.0 - t)) * s,
                }
            }
        };
        let direction = match random.below(8) {
            0 => [
                Vec3::new(T::ONE, T::ZERO, T::ZERO),
                Vec3::new(-T::ZERO, -T::ONE, T::ZERO),
                Vec3::new(T::ZERO, -T::ZERO, T::ONE),
            ][random.below(3)],
            1 => {
                // Along two axes, or nearly.
                let mut d = cast::<T>(aim - near);
                d.x = d.x * T::from_f64([0.0, 1e-30, 1e-7][random.below(3)]);
                d
            }
            _ => cast(aim - near),
        };
        let direction = match direction.try_normalize() {
            Some((direction, _)) => direction,
            None => random.direction(),
        };
        Ray {
            origin,
            direction,
            leaves: match random.below(6) {
                0 => Side::new(random.below(self.targets.len()) as u32, true),
                _ => Side::NOWHERE,
            },
        }
    }
}

fn compare_crowds<T: Scalar>(seed: u64, scenes: usize) {
    let random = Random::of_test(seed);
    let (mut hits, mut shadows, mut boxes, mut tests) = (0, 0, 0_u64, 0_u64);
    for index in 0..scenes {
        let crowd = Crowd::<T>::new(&random);
        let scene = crowd.pools.as_scene();
        assert!(scene.accel().bvh().is_some());
        let by_bvh = Tracer::new(scene).with_bvh();
        let brute_force = Tracer::new(scene.without_accel());
        for _ in 0..200 {
            let ray = crowd.ray();
            let (actual, expected) = (by_bvh.nearest(&ray), brute_force.nearest(&ray));
            let result = |nearest: Option<scanray::tracer::Nearest<'_, T>>| {
                nearest.map(|n| (n.t.to_f64().to_bits(), n.object.info().number))
            };
            assert_eq!(
                result(actual),
                result(expected),
                "scene {index}: {ray:?} hits {actual:?} instead of {expected:?}"
            );
            let reach = match expected {
                Some(nearest) => {
                    hits += 1;
                    nearest.t * [T::ONE, T::ONE + T::EPSILON, T::TWO][random.below(3)]
                }
                None => T::from_f64(crowd.scale * 10.0),
            };
            let occluded = by_bvh.occluded(&ray, reach);
            assert_eq!(
                occluded,
                brute_force.occluded(&ray, reach),
                "scene {index}: shadow of {ray:?} within {reach}"
            );
            shadows += u32::from(occluded);
            let mut count = scanray::tracer::WorkCount::default();
            by_bvh.radiance_observed(ray, scanray::accel::ObjectSet::ALL, &mut count);
            boxes += count.box_tests;
            tests += count.rays() * scene.accel().bvh().nodes.len() as u64;
        }
    }
    // The comparison is of intersections, and not of hierarchies that leave out nothing.
    let rays = 200 * scenes as u32;
    assert!(hits > rays / 3, "only {hits} of {rays} rays hit something");
    assert!(shadows > rays / 10, "only {shadows} shadows");
    assert!(boxes < tests * 3 / 4, "{boxes} of {tests} boxes are tested");
}

#[test]
fn hits_and_shadows_are_those_of_brute_force() {
    compare_crowds::<f32>(1, 2000);
}

#[test]
fn hits_and_shadows_are_those_of_brute_force_in_f64() {
    compare_crowds::<f64>(2, 500);
}

/// Secondary rays and all: pictures.
#[test]
fn pictures_are_those_of_brute_force() {
    let random = Random::of_test(3);
    for index in 0..60 {
        let mut crowd = Crowd::<f32>::new(&random);
        let mut pools = Box::new((*crowd.pools).clone());
        let mut filling = Pools::as_mut(&mut pools);
        filling.set_ambient(0.5);
        filling.set_camera(Camera {
            position: cast(crowd.center - Vec3::new(0.0, 0.0, 2.0 * crowd.scale)),
        });
        let light = Light {
            position: cast(crowd.point() * 2.0),
            diffuse: Color::new(0.5, 0.5, 0.5),
            specular: Color::BLACK,
        };
        filling.add_light(light).unwrap();
        let floor = Vec3::new(0.0, 1.0, 0.0);
        let distance = crowd.scale as f32 - crowd.center.y as f32;
        filling
            .add_plane(floor, distance, crowd.material())
            .unwrap();
        pools.prepare();
        crowd.pools = pools;
        let scene = crowd.pools.as_scene();
        let size = Resolution {
            width: 24,
            height: 18,
        };
        let by_bvh = Tracer::new(scene).with_bvh().with_resolution(size);
        let brute_force = scene.without_accel();
        let brute_force = Tracer::new(brute_force).with_resolution(size);
        for y in 0..size.height {
            for x in 0..size.width {
                assert_eq!(
                    bits(by_bvh.pixel(x, y)),
                    bits(brute_force.pixel(x, y)),
                    "scene {index}, pixel ({x}, {y})"
                );
            }
        }
    }
}

#[test]
fn rays_that_are_none_hit_nothing() {
    let random = Random::of_test(4);
    let crowd = Crowd::<f32>::new(&random);
    let tracer = Tracer::new(crowd.pools.as_scene()).with_bvh();
    let numbers = [f32::NAN, f32::INFINITY, -f32::INFINITY, 0.0, 1e38, 1e-45];
    for _ in 0..2000 {
        let number = || numbers[random.below(numbers.len())];
        let mut ray = crowd.ray();
        ray.direction = Vec3::new(number(), number(), number());
        if random.below(2) == 0 {
            ray.origin = Vec3::new(number(), number(), number());
        }
        let nearest = tracer.nearest(&ray);
        let brute_force = Tracer::new(tracer.scene().without_accel());
        if !(ray.origin.is_finite() && ray.direction.is_finite()) {
            assert_eq!(nearest, None, "{ray:?}");
            assert_eq!(brute_force.nearest(&ray), None, "{ray:?}");
        }
        tracer.occluded(&ray, 1.0);
    }
}

#[test]
fn another_object_undoes_the_bvh_and_small_pools_have_none() {
    let random = Random::of_test(5);
    let mut crowd = Crowd::<f32>::new(&random);
    assert!(crowd.pools.as_scene().accel().bvh().is_some());
    let mut filling = Pools::as_mut(&mut crowd.pools);
    filling
        .add_sphere(Vec3::default(), 1.0, MaterialDescription::default())
        .unwrap();
    assert!(!crowd.pools.as_scene().accel().bvh().is_some());

    let mut small: ScenePools<f32, 128, 1, 1, 1, 1, 0, 99> = ScenePools::new();
    for count in 1..=100 {
        let center = Vec3::new(count as f32, 0.0, 0.0);
        let mut filling = small.as_mut();
        filling
            .add_sphere(center, 0.6, MaterialDescription::default())
            .unwrap();
        small.prepare();
        // Few objects do not need one, and there is room for 99.
        let bvh = small.as_scene().accel().bvh();
        assert_eq!(bvh.is_some(), (48..=99).contains(&count), "{count} objects");
        assert_eq!(
            bvh.is_some(),
            small.as_scene().stages().contains(scanray::Stages::BVH)
        );
    }
}
