//! Leaving out the objects that a ray cannot hit changes no bit where objects stand in special ways:
//! touching, resting, nested, coplanar, coincident, around the camera or the light. What is known of
//! visibility ends with the scene it was found for. (Scenes of scenes/ and crowds: candidates.rs.)

use crate::common::random::Random;
use crate::common::sampling::{self, bits};
use crate::common::scenes::{self, Model, Part, RoomyPools, Shape};
use scanray::{
    Background, Color, Light, MaterialDescription, Ray, Resolution, Scalar, ScenePools, Tracer,
    Vec3,
};

/// Compares the picture of prepared pools with that of pools which know nothing of visibility.
fn compare<T: Scalar>(model: &Model<T>, size: Resolution, how: &dyn std::fmt::Display) {
    let plain = model.build();
    assert!(plain.as_scene().accel().sides().is_empty());
    let mut prepared = model.build();
    prepared.prepare();
    assert_eq!(
        prepared.as_scene().accel().sides().len(),
        2 * model.parts.len()
    );
    let plain = Tracer::new(plain.as_scene()).with_resolution(size);
    let prepared = Tracer::new(prepared.as_scene()).with_resolution(size);
    for y in 0..size.height {
        for x in 0..size.width {
            let ray = plain.primary_ray(&plain.scanline(y), x);
            let (actual, expected) = (prepared.pixel(x, y), plain.radiance(ray));
            assert!(
                expected.is_finite(),
                "{how}: pixel ({x}, {y}) is {expected:?}"
            );
            assert_eq!(
                bits(actual),
                bits(expected),
                "{how}: pixel ({x}, {y}) is {actual:?} instead of {expected:?}"
            );
        }
    }
}

/// Makes random scenes around the view of a camera in the middle, of objects that touch the others in
/// some special way.
struct Maker<'r, T> {
    random: &'r Random,
    scale: f64,
    parts: Vec<Part<T>>,
}

impl<T: Scalar> Maker<'_, T> {
    fn point(&self) -> Vec3<T> {
        let p: Vec3<f64> = self.random.point(self.scale);
        // Most of it in front of the camera.
        let z = if self.random.below(5) == 0 {
            p.z
        } else {
            p.z.abs() + 0.3 * self.scale
        };
        Vec3::new(T::from_f64(p.x), T::from_f64(p.y), T::from_f64(z))
    }

    fn length(&self) -> T {
        T::from_f64(self.scale * self.random.log_between(1e-3, 1.0))
    }

    fn material(&self) -> MaterialDescription<T> {
        let random = self.random;
        let number = |low, high| T::from_f64(random.between(low, high));
        let color = || Color::new(number(0.1, 0.9), number(0.1, 0.9), number(0.1, 0.9));
        let (refraction, index) = match random.below(6) {
            0 | 1 => (number(0.3, 1.0), number(1.0, 2.5)),
            2 => (number(0.3, 1.0), T::ONE),
            // Opaque, without a shadow.
            3 => (T::ZERO, T::ONE),
            _ => (T::ZERO, T::ZERO),
        };
        MaterialDescription {
            diffuse: color(),
            specular: color(),
            ambient: color(),
            reflection: if random.below(2) == 0 {
                T::ZERO
            } else {
                number(0.2, 1.0)
            },
            shininess: number(0.0, 60.0),
            refraction,
            index_of_refraction: index,
        }
    }

    fn add(&mut self, shape: Shape<T>) {
        let material = self.material();
        self.parts.push(Part { shape, material });
    }

    fn add_sphere(&mut self, center: Vec3<T>, radius: T) {
        self.add(Shape::Sphere { center, radius });
    }

    /// A triangle, unless it has no area.
    fn add_triangle(&mut self, vertices: [Vec3<T>; 3]) {
        let surface = scanray::shape::ObjectInfo {
            material: 0,
            number: 0,
        };
        if scanray::shape::Triangle::new(vertices, surface).is_ok() {
            self.add(Shape::Triangle(vertices));
        }
    }

    fn add_something(&mut self) {
        let random = self.random;
        match random.below(12) {
            0 | 1 => self.add_sphere(self.point(), self.length()),
            2 => self.add_triangle([self.point(), self.point(), self.point()]),
            3 => {
                // A plane that passes next to the origin, where the camera may be.
                let distance = T::from_f64(self.scale * random.between(-1.0, 1.0));
                let distance = if random.below(6) == 0 {
                    T::ZERO
                } else {
                    distance
                };
                let normal = match random.below(3) {
                    0 => random.direction(),
                    1 => Vec3::new(T::ZERO, T::ONE, T::ZERO),
                    _ => Vec3::new(T::ZERO, T::ZERO, -T::ONE),
                };
                self.add(Shape::Plane { normal, distance });
            }
            4 => {
                // A sphere that rests on a plane.
                let (center, radius) = (self.point(), self.length());
                self.add_sphere(center, radius);
                self.add(Shape::Plane {
                    normal: Vec3::new(T::ZERO, T::ONE, T::ZERO),
                    distance: radius - center.y,
                });
            }
            5 => {
                // Two spheres that touch, from outside or from inside.
                let (center, r1, r2) = (self.point(), self.length(), self.length());
                let between = if random.below(2) == 0 {
                    r1 + r2
                } else {
                    (r1 - r2).abs()
                };
                self.add_sphere(center, r1);
                self.add_sphere(center + random.direction::<T>() * between, r2);
            }
            6 => {
                // Spheres around one another.
                let center = self.point();
                for _ in 0..3 {
                    self.add_sphere(center, self.length());
                }
            }
            7 => {
                // A sphere around the camera or the light.
                let radius = T::from_f64(self.scale * random.between(0.05, 4.0));
                self.add_sphere(self.point() * T::from_f64(0.05), radius);
            }
            8 => {
                // A tetrahedron, closed, with all windings.
                let corners = [self.point(), self.point(), self.point(), self.point()];
                for leave_out in 0..4 {
                    let kept: Vec<_> = (0..4)
                        .filter(|i| *i != leave_out)
                        .map(|i| corners[i])
                        .collect();
                    self.add_triangle([kept[0], kept[1], kept[2]]);
                }
            }
            9 => {
                // A rectangle of two triangles, and one in its plane a little further.
                let (corner, u, v) = (
                    self.point(),
                    random.direction::<T>(),
                    random.direction::<T>(),
                );
                let (u, v) = (u * self.length(), v * self.length());
                self.add_triangle([corner, corner + u, corner + u + v]);
                self.add_triangle([corner, corner + u + v, corner + v]);
                self.add_triangle([corner + u, corner + u + u, corner + u + u + v]);
            }
            10 => {
                // Something with its own copy, or with what lies in front of it by very little.
                if let Some(part) = self.parts.last().copied() {
                    self.add(part.shape);
                    if let Shape::Sphere { center, radius } = part.shape {
                        let little = T::ONE + T::from_f64(random.log_between(1e-7, 1e-2));
                        self.add_sphere(center, radius * little);
                    }
                }
            }
            _ => {
                // A wall right and left, as in a room.
                let (near, far) = (T::from_f64(-self.scale), T::from_f64(3.0 * self.scale));
                for side in [near, -near] {
                    let v = |y, z| Vec3::new(side, y, z);
                    self.add_triangle([v(near, near), v(far, near), v(near, far)]);
                }
            }
        }
    }
}

fn random_model<T: Scalar>(random: &Random) -> Model<T> {
    let scale = random.log_between(1e-3, 1e3);
    let mut maker = Maker {
        random,
        scale,
        parts: Vec::new(),
    };
    let count = [1, 2, 3, 5, 8, 15, 45][random.below(7)];
    while maker.parts.len() < count {
        maker.add_something();
    }
    let small = T::from_f64(0.2);
    let lights = (0..1 + random.below(3)).map(|_| Light {
        position: match random.below(8) {
            0 => maker.point() * small,
            // In the middle of something.
            1 => match maker.parts[random.below(maker.parts.len())].shape {
                Shape::Sphere { center, .. } => center,
                Shape::Plane { normal, distance } => normal * -distance,
                Shape::Triangle([v1, v2, _]) => (v1 + v2) * T::HALF,
                _ => unreachable!(),
            },
            2 => maker.point() * T::from_f64(100.0),
            _ => maker.point() + Vec3::new(T::ZERO, T::from_f64(scale), T::ZERO),
        },
        specular: Color::new(T::HALF, T::ONE, T::HALF),
        diffuse: Color::new(T::ONE, T::HALF, T::ONE),
    });
    let lights = lights.collect();
    Model {
        camera: match random.below(3) {
            0 => Vec3::new(T::ZERO, T::ZERO, T::ZERO),
            _ => maker.point() * small - Vec3::new(T::ZERO, T::ZERO, T::from_f64(scale)),
        },
        resolution: Resolution {
            width: 1,
            height: 1,
        },
        ambient: T::from_f64(0.2),
        background: Background {
            color: Color::new(T::HALF, T::ZERO, T::ONE),
            sky: random.below(2) == 0,
        },
        lights,
        parts: maker.parts,
    }
}

fn objects_in_special_places_have_the_same_bits<T: Scalar>(seed: u64, scenes: u32) {
    let random = Random::of_test(seed);
    for round in 0..scenes {
        let model = random_model::<T>(&random);
        let (width, height) = [(24, 18), (12, 24), (40, 8)][random.below(3)];
        let size = Resolution { width, height };
        compare(&model, size, &format_args!("scene {round}, {model:#?}"));
    }
}

#[test]
fn objects_in_special_places_have_the_same_bits_in_single_precision() {
    objects_in_special_places_have_the_same_bits::<f32>(101, 1_500);
}

#[test]
fn objects_in_special_places_have_the_same_bits_in_double_precision() {
    objects_in_special_places_have_the_same_bits::<f64>(102, 500);
}

/// Spheres that a row of pixels touches from above or below, to within a few units of rounding, so that
/// the exact test of a ray decides and what is known of the row must not.
#[test]
fn spheres_that_graze_a_row_have_the_same_bits() {
    let random = Random::of_test(104);
    let size = Resolution {
        width: 24,
        height: 18,
    };
    let mut hits = 0;
    for round in 0..30_000 {
        let scale = random.log_between(1e-2, 1e2);
        let (column, row) = (random.below(24) as u16, random.below(18) as u16);
        let mut model = random_model::<f32>(&random);
        model.parts.clear();
        model.camera = random.point(scale * random.log_between(1e-2, 10.0));
        let ray = sampling::ray_beside(model.camera, size, (column, row), (0.0, 0.0));
        // Perpendicular to all rays of the row.
        let height = (17.0 - 2.0 * f64::from(row)) / 18.0;
        let across = Vec3::new(0.0, 1.0, -height).normalize() * random.sign();
        let radius = scale * random.log_between(1e-3, 1.0);
        let wide = |v: Vec3<f32>| Vec3::new(f64::from(v.x), f64::from(v.y), f64::from(v.z));
        let touch = wide(ray.at((scale * random.between(0.5, 2.0)) as f32));
        let center = touch + across * radius;
        let little = 1.0 + f64::from(f32::EPSILON) * random.between(-8.0, 8.0);
        model.parts.push(Part {
            shape: Shape::Sphere {
                center: Vec3::new(center.x as f32, center.y as f32, center.z as f32),
                radius: (radius * little) as f32,
            },
            material: MaterialDescription {
                ambient: Color::new(0.3, 0.6, 0.9),
                ..Default::default()
            },
        });
        let pools = model.build();
        let tracer = Tracer::new(pools.as_scene()).with_resolution(size);
        let ray = tracer.primary_ray(&tracer.scanline(row), column);
        hits += usize::from(tracer.nearest(&ray).is_some());
        assert_eq!(
            bits(tracer.pixel(column, row)),
            bits(tracer.radiance(ray)),
            "scene {round}: pixel ({column}, {row}), {model:#?}"
        );
    }
    println!("{hits} of 30000 spheres hit");
    assert!((3_000..27_000).contains(&hits));
}

/// What is known of visibility does not outlive the scene it was found for.
#[test]
fn a_change_of_the_scene_forgets_what_was_visible() {
    let random = Random::of_test(103);
    for round in 0..50 {
        let mut model = random_model::<f32>(&random);
        let added = random_model::<f32>(&random);
        let (part, light) = (added.parts[0], added.lights[0]);
        let mut pools: RoomyPools<f32> = model.build();
        pools.prepare();
        part.add_to(&mut pools.as_mut()).unwrap();
        assert!(
            pools.as_scene().accel().sides().is_empty(),
            "scene {round}, object"
        );
        model.parts.push(part);
        pools.prepare();
        assert_eq!(
            pools.as_scene().accel().sides().len(),
            2 * model.parts.len()
        );
        if model.lights.len() < 4 {
            pools.as_mut().add_light(light).unwrap();
            assert!(
                pools.as_scene().accel().sides().is_empty(),
                "scene {round}, light"
            );
        }
        pools.as_mut().clear();
        assert!(
            pools.as_scene().accel().sides().is_empty(),
            "scene {round}, clear"
        );
    }
}

/// More objects than there is room for sides, or bits in a set, are all tested.
#[test]
fn too_many_objects_are_drawn_all_the_same() {
    let mut model = Model::of(&scenes::load::<f32>("default").as_scene());
    let material = model.parts[2].material;
    for i in 0..50 {
        let angle = f64::from(i) / 8.0;
        let (x, y) = (angle.sin() * 2.0, angle.cos() * 2.0);
        let center = Vec3::new(x as f32, y as f32, 4.0 + i as f32 / 20.0);
        let radius = 0.1;
        model.parts.push(Part {
            shape: Shape::Sphere { center, radius },
            material,
        });
        let corner = |dx, dy| center + Vec3::new(dx, dy, -0.5);
        model.parts.push(Part {
            shape: Shape::Triangle([corner(0.0, 0.1), corner(0.1, -0.1), corner(-0.1, -0.1)]),
            material,
        });
    }
    let size = Resolution {
        width: 80,
        height: 60,
    };
    compare(&model, size, &"spiral");
    // Pools that hold the objects, but not their sides.
    let mut small = ScenePools::<f32, 64, 16, 64, 64, 1, 10>::new();
    let mut filling = small.as_mut();
    for part in &model.parts {
        part.add_to(&mut filling).unwrap();
    }
    filling.set_camera(scanray::Camera {
        position: model.camera,
    });
    filling.set_ambient(model.ambient);
    filling.set_background(model.background);
    filling.add_light(model.lights[0]).unwrap();
    small.prepare();
    assert!(small.as_scene().accel().sides().is_empty());
    let roomy = model.build();
    let small = Tracer::new(small.as_scene()).with_resolution(size);
    let roomy = Tracer::new(roomy.as_scene()).with_resolution(size);
    for (x, y) in (0..60).flat_map(|y| (0..80).map(move |x| (x, y))) {
        assert_eq!(
            bits(small.pixel(x, y)),
            bits(roomy.pixel(x, y)),
            "pixel ({x}, {y})"
        );
    }
}

#[test]
fn an_object_that_is_refused_changes_nothing() {
    let mut pools: ScenePools = scenes::load("default");
    let before = (
        pools.as_scene().object_count(),
        pools.as_scene().accel().sides().len(),
    );
    assert!(before.1 > 0);
    let mut filling = pools.as_mut();
    let material = scenes::invisible();
    assert!(filling.add_sphere(Vec3::default(), -1.0, material).is_err());
    assert!(filling.add_plane(Vec3::default(), 1.0, material).is_err());
    assert!(
        filling
            .add_triangle([Vec3::default(); 3], material)
            .is_err()
    );
    let scene = pools.as_scene();
    assert_eq!((scene.object_count(), scene.accel().sides().len()), before);
}

/// Draws texts with what is known of visibility and without.
fn compare_texts(texts: &[&str]) {
    const SIZE: Resolution = Resolution {
        width: 8,
        height: 8,
    };
    for text in texts {
        let mut pools: ScenePools = ScenePools::new();
        pools.parse(text.as_bytes()).unwrap();
        let scene = pools.as_scene();
        let prepared = Tracer::new(scene).with_resolution(SIZE);
        let plain = scene.without_accel();
        let plain = Tracer::new(plain).with_resolution(SIZE);
        for (x, y) in (0..8).flat_map(|y| (0..8).map(move |x| (x, y))) {
            let expected = plain.radiance(plain.primary_ray(&plain.scanline(y), x));
            assert_eq!(bits(prepared.pixel(x, y)), bits(expected), "{x},{y}");
        }
    }
}

/// Found by fuzzing. In the first a sphere of radius 1 where coordinates are 4096 apart is hit from inside, at a point outside
/// of it; in the second one of no size to speak of, by a ray from far away.
#[test]
fn spheres_smaller_than_the_rounding_of_their_places_have_the_same_bits() {
    compare_texts(&[
        "2\n0 .5 -2\n64 48\n565535 6 -4 1 1 1 .9 .9 .9\n.1\n1\n.5 .5 1\n\
         0 0 .5 4 2e18 .6 .1 .1 .5 .5 .5 1 1 1 .2 50 0 0\n\
         0 42949672955 1 .4 1 .6 .1 .1 .5 .5 .5 1 1 1 .2 50 0 0\n",
        "3\n.4 0 5\n800 600\n1 250 50 0 1 1 1 1 1\n.1\n1\n.5 .5 1\n\
         0 1.5 1 0 .51e-10 .6 .1 .1 .5 .5 .5 1 1 1 .2 50 0 0\n\
         0 -1.5 0 -2.5 1e9 .1 .1 .6 .5 .5 .5 1 1 1 .5 50 0 0\n\
         1 0 1 0 1 .5 .5 .5 .1 .1 .1 1 1 1 .3 50 0 0\n",
    ]);
}

/// A light that only rounding takes out of a sphere lies on its surface, and lights the inside: all of it, as one does that is in the
/// sphere by as little.
#[test]
fn spheres_with_a_light_on_their_surface_have_the_same_bits() {
    for (center, radius) in [(0.0, 1.0_f32), (0.0, 0.1), (0.0, 30.0), (2.5, 0.7)] {
        for units in -40..=40 {
            let height = radius * (1.0 + f32::EPSILON * units as f32) - center;
            let text = format!(
                "1\n0 {:e} {:e}\n8 8\n0 {height:e} 0 1 1 1 1 1 1\n0\n0\n0 0 0\n\
                 0 0 {:e} 0 {radius:e} .5 .5 .5 .5 .5 .5 0 0 0 0 20 0 1.5\n",
                -center,
                -0.5 * radius,
                -center,
            );
            compare_texts(&[&text]);
            let mut pools: ScenePools = ScenePools::new();
            pools.parse(text.as_bytes()).unwrap();
            let tracer = Tracer::new(pools.as_scene()).with_resolution(Resolution {
                width: 8,
                height: 8,
            });
            let pixels = (0..8).flat_map(|y| (0..8).map(move |x| (x, y)));
            let lit = pixels
                .filter(|&(x, y)| tracer.pixel(x, y) != Color::BLACK)
                .count();
            // Rounding decides for all at once, and not on the surface.
            assert!(lit == 64 || lit == 0 && units > 4, "{text}: {lit} lit");
        }
    }
}

/// Found by a search: the ray comes to the first triangle edge-on, and has passed it for good. What its plane tells is limited to the
/// triangle's bounding sphere, which is behind the ray.
#[test]
fn a_triangle_that_is_seen_edge_on_is_hit_nowhere_but_in_its_bounds() {
    let text = "2\n1.2840706e0 1.1663839e0 -6.94865e-1\n8 8\n3 50 1 1 1 1 1 1 1\n1\n0\n0 0 0\n\
        2 7.812001e-4 5.096922e-4 7.80004e-4 -1.116028e-3 -7.28554e-4 -1.111888e-3 -1.1446606e-3 -7.8129716e-4 -9.3554513e-4 \
        0 0 0 0 0 0 0 0 0 0 .1 .1 .1 0 20 1 1\n\
        2 -1.6026819e-3 1.0140328e-2 -6.889999e-2 5.86568e-2 4.520477e-2 1.684736e-2 6.399743e-2 6.775515e-2 -9.252885e-2 \
        0 0 0 0 0 0 0 0 0 0 .5 .5 .5 0 0 0 0\n";
    let mut pools: ScenePools = ScenePools::new();
    pools.parse(text.as_bytes()).unwrap();
    let scene = pools.as_scene();
    let [v1, v2, v3] = scene.triangles()[0].vertices();
    let camera = scene.camera().position;
    let (toward, _) = ((v1 + v2 + v3) * (1.0 / 3.0) - camera)
        .try_normalize()
        .unwrap();
    let ray = Ray::new(camera, toward);
    let prepared = Tracer::new(scene).radiance(ray);
    assert_eq!(
        bits(prepared),
        bits(Tracer::new(scene.without_accel()).radiance(ray))
    );
    assert_ne!(prepared, Color::BLACK, "the first triangle is hit");
}

/// A triangle near the origin, all but in whose plane lies what a ray along it hits: behind the plane by so little that rounding may
/// take a ray there that leaves the front.
#[test]
fn objects_behind_a_triangle_by_rounding_have_the_same_bits() {
    const MIRROR: &str = "0 0 0 0 0 0 .1 .1 .1 1 20 0 0";
    const CLEAR: &str = "0 0 0 0 0 0 .1 .1 .1 0 20 1 1";
    let mut hits = 0;
    for (camera, triangle, material, other) in [
        (
            "-1.4037843e-1 -6.572165e-2 -5.1419612e-2",
            "1.2571306e-3 1.7020165e-4 -1.8934425e-3 -4.2613684e-3 6.624084e-4 1.339165e-2 \
             1.6549979e-3 1.0794348e-3 2.3201136e-3",
            MIRROR,
            "2 -7.922906e-2 5.977595e-2 5.160226e-1 6.484114e-1 3.5705197e-1 5.3843063e-1 \
             -7.217603e-1 -3.597897e-1 -3.8748404e-1 0 0 0 0",
        ),
        (
            "4.1444212e-2 3.529563e-2 -2.6687586e-3",
            "-8.415266e-3 -5.230354e-3 -3.0593106e-3 -7.1062474e-4 7.4628205e-4 -2.467591e-3 \
             1.5722719e-3 3.0899048e-3 -3.3573834e-3",
            MIRROR,
            "2 2.434786e-1 8.10092e-1 -1.1365671e0 -4.4375986e-1 -6.571209e-1 5.4779774e-1 \
             -1.009302e0 -7.8245515e-1 -7.840651e-2 0 0 0 0",
        ),
        (
            "2.6069746e0 8.356921e-1 -1.0685174e0",
            "-3.4075182e-2 2.8688755e-2 9.2468215e-3 2.4749149e-2 -2.4265237e-2 -6.3075963e-3 \
             2.2906679e-4 7.115482e-2 -8.562846e-3",
            CLEAR,
            "2 -5.730382e-1 -2.1193607e-1 2.3823562e-1 6.06007e-3 -7.705395e-1 8.9553185e-2 \
             2.3351128e-1 6.608969e-1 -1.6553278e-1 0 0 0 0",
        ),
        (
            "-2.605009e-1 -7.392292e-1 -9.6537894e-1",
            "-1.0009283e-4 -3.0099228e-4 -4.4771453e-4 -6.2518736e-4 -1.3990095e-3 \
             -6.1829516e-4 2.322699e-4 1.5857081e-4 -1.4058676e-3",
            CLEAR,
            "2 -1.906078e-2 2.315262e-3 1.8477993e-1 5.1547527e-2 1.4242889e-1 1.7359978e-1 \
             2.485885e-2 9.101618e-2 1.848311e-1 0 0 0 0",
        ),
        (
            "8.5638195e-1 -5.1537377e-1 -3.8555863e-1",
            "-2.056573e-3 2.7109525e-4 -2.0319615e-2 2.2553733e-2 -1.2680287e-2 9.46646e-3 \
             -2.5008002e-2 1.5591201e-2 2.315705e-2",
            MIRROR,
            "2 5.5103083e0 -3.0061133e0 4.333363e0 -1.9856435e-1 6.573356e-2 -1.0923519e0 \
             -5.434385e0 3.232999e0 1.6238545e0 0 0 0 0",
        ),
        (
            "1.6532615e-1 -2.7320227e-1 -1.5515156e0",
            "-8.636615e-3 6.664414e-3 5.785022e-2 -1.2722896e-2 -6.8023703e-3 3.4535885e-2 \
             -3.6862995e-2 -4.0284365e-2 3.7315458e-2",
            CLEAR,
            "0 -4.635033e0 3.2326288e0 -9.254051e-1 5.7245803e0",
        ),
        (
            "4.8426547e0 -1.2482725e0 -2.72632e0",
            "-6.391933e-3 -9.488381e-3 -6.424556e-3 -5.3591765e-3 1.20842036e-4 1.8825191e-3 \
             -3.61092e-3 -7.91549e-3 -5.929303e-3",
            CLEAR,
            "0 -3.993341e-1 1.0671276e0 -1.1965215e0 1.6522156e0",
        ),
        (
            "-7.1553755e-1 2.9363647e0 -1.1199952e-1",
            "1.0450293e-3 -2.912127e-4 6.8051135e-4 7.300866e-4 9.848924e-5 5.144715e-4 \
             7.080145e-4 -1.113946e-3 3.4250837e-4",
            CLEAR,
            "0 -5.101742e0 -1.0292214e0 7.449544e0 9.087251e0",
        ),
        (
            "-1.3136482e-1 -6.367054e-2 -2.5119478e-1",
            "4.919902e-3 -1.1551115e-2 1.1210073e-2 5.4470054e-3 5.4795146e-3 1.0048502e-2 \
             5.660629e-4 -6.7894734e-3 1.9959714e-3",
            CLEAR,
            "2 2.0687711e0 -6.2804234e-1 4.1667886e0 -1.2625448e0 -3.4385207e0 -2.0485914e0 \
             3.8636202e-1 4.3914433e0 1.9508101e-1 0 0 0 0",
        ),
        (
            "-1.549192e-1 3.1429315e-1 -1.7853737e0",
            "-1.6783902e-3 -4.9835868e-5 -3.5531747e-3 1.6530704e-3 -2.70334e-4 4.9593793e-3 \
             2.618878e-3 1.7861595e-3 -2.2635334e-3",
            MIRROR,
            "2 -4.851699e-2 -6.6860884e-2 1.9627315e-1 1.6875249e-1 9.851531e-2 -7.008413e-2 \
             2.9568875e-1 1.4627919e-1 -2.4223726e-3 0 0 0 0",
        ),
        (
            "-8.36732e-3 -4.364056e-3 -9.172002e-2",
            "9.272098e-4 -2.4541947e-3 -3.040229e-3 5.2275584e-4 -1.4210952e-4 3.8661107e-3 \
             -6.6794414e-4 5.812617e-4 -3.1434877e-3",
            MIRROR,
            "2 6.3827205e-1 -1.1730609e0 2.2793943e-1 -5.4549026e-1 1.4531665e0 1.8305424e0 \
             -1.1754276e0 1.9581112e0 -1.3284304e0 0 0 0 0",
        ),
        (
            "1.0754704e0 -6.566896e-1 -3.3037296e-1",
            "-6.5357884e-4 4.3473832e-4 5.878755e-4 8.422097e-4 -4.483195e-4 4.571073e-4 \
             1.1290067e-3 -6.737868e-4 -1.7755068e-4",
            CLEAR,
            "0 4.4363675e0 7.630894e0 -7.0092154e-1 8.854555e0",
        ),
    ] {
        let text = format!(
            "2\n{camera}\n8 8\n3 50 1 1 1 1 1 1 1\n1\n0\n0 0 0\n\
             2 {triangle} 0 0 0 0 {material}\n{other} 0 0 0 0 0 0 .5 .5 .5 0 0 0 0\n"
        );
        let mut pools: ScenePools = ScenePools::new();
        pools.parse(text.as_bytes()).unwrap();
        let scene = pools.as_scene();
        let [v1, v2, v3] = scene.triangles()[0].vertices();
        let camera = scene.camera().position;
        let target = (v1 + v2 + v3) * (1.0 / 3.0);
        let (direction, _) = (target - camera).try_normalize().unwrap();
        let ray = Ray::new(camera, direction);
        let expected = Tracer::new(scene.without_accel()).radiance(ray);
        let actual = Tracer::new(scene).radiance(ray);
        assert_eq!(bits(actual), bits(expected), "{text}");
        // The triangle's own colour and the other object's.
        hits += u32::from(expected.r > 0.55);
    }
    // Which of them a ray hits is rounding, indeed.
    assert!(hits > 4, "{hits}");
}
