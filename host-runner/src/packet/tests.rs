//! Equality with the core, to the bit, at every level of vector instructions that the machine has.

use std::cell::Cell;
use std::path::PathBuf;

use fearless_simd::Level;
use scanray::shape::{ObjectInfo, Sphere, Stored};
use scanray::{
    Background, Camera, Color, Light, Material, MaterialDescription, Resolution, Scene, SceneError,
    Tracer, Vec3, camera::Subpixel, render::Supersampled, shape::Shape,
};

use random::Random as Numbers;
use random_texts::Writer;

use super::PacketTracer;
use super::bvh::PacketBvh;
use crate::host_tracer::SampleRow;

// Those of the core's tests.
#[allow(dead_code, unreachable_pub)]
#[path = "../../../tests/common/random.rs"]
mod random;
#[allow(unreachable_pub)]
#[path = "../../../tests/common/random_texts.rs"]
mod random_texts;

scanray::scene_pools! {
    struct Pools { spheres: 64, planes: 64, triangles: 64, discs: 64, materials: 256, lights: 4 }
}

scanray::scene_pools! {
    struct One { spheres: 1, planes: 1, triangles: 1, materials: 1, lights: 1 }
}

/// That of the host, so that everything is compiled once.
pub(super) const STACK: usize = crate::host_tracer::MAX_DEPTH;

/// The levels of this machine, the scalar one included where there is one.
fn levels() -> Vec<Level> {
    let best = Level::new();
    #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
    let others = [
        #[cfg(not(target_feature = "sse4.2"))]
        Some(Level::Fallback(fearless_simd::Fallback::new())),
    ];
    #[cfg(not(any(target_arch = "x86", target_arch = "x86_64")))]
    let others: [Option<Level>; 0] = [];
    std::iter::once(best)
        .chain(others.into_iter().flatten())
        .collect()
}

/// The centres of the pixels of row `y` from column `x` on.
fn places(x: u16, y: u16) -> SampleRow {
    SampleRow {
        x,
        step: 1,
        y,
        at: Subpixel::CENTER,
    }
}

/// Compares rows of a picture with the core's pixels.
fn assert_same(name: &str, scene: Scene<'_>, width: u16, height: u16, max_depth: usize) {
    let resolution = Resolution { width, height };
    assert_same_as(name, scene, scene, resolution, max_depth);
}

/// Compares rows of a picture of a scene with pixels by the core of one that has other aids to the same hits.
pub(super) fn assert_same_as(
    name: &str,
    scene: Scene<'_>,
    of_core: Scene<'_>,
    resolution: Resolution,
    max_depth: usize,
) {
    let [tracer, core] = [scene, of_core].map(|scene| {
        Tracer::new(scene)
            .with_bvh()
            .with_stack::<STACK>()
            .with_resolution(resolution)
            .with_max_depth(max_depth)
            .unwrap()
    });
    let Resolution { width, height } = resolution;
    let pixels = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
    let expected: Vec<Color> = pixels.map(|(x, y)| core.pixel(x, y)).collect();
    for level in levels() {
        let mut packets = PacketTracer::new(tracer);
        packets.level = level;
        let compare = |packets: &PacketTracer<'_, STACK>| {
            // The bits of an outdated row must not show.
            let mut row = vec![Color::new(f32::NAN, 2.0, -1.0); width.into()];
            for (y, expected) in (0..).zip(expected.chunks(width.into())) {
                packets.sample_row(places(0, y), &mut row);
                for (x, (color, expected)) in row.iter().zip(expected).enumerate() {
                    let bits = |c: &Color| [c.r, c.g, c.b].map(f32::to_bits);
                    assert!(
                        bits(color) == bits(expected),
                        "{name}, {width}x{height}, depth {max_depth}, {level:?}, pixel ({x}, {y}): \
                         {color:?} instead of {expected:?}"
                    );
                }
            }
        };
        compare(&packets);
        let singles = PacketBvh::new(&packets, 0);
        if singles.as_ref().is_some_and(PacketBvh::has_singles) {
            packets.bvh = singles;
            compare(&packets);
        }
    }
}

const SCENES: [&str; 5] = [
    "default",
    "mirror-room",
    "pyramids",
    "reflective",
    "window-room",
];

fn load(name: &str) -> Box<Pools> {
    let mut file = PathBuf::from(env!("CARGO_MANIFEST_DIR"));
    file.extend(["..", "scenes", &format!("{name}.txt")]);
    let mut pools = Box::new(Pools::new());
    pools.parse(&std::fs::read(file).unwrap()).unwrap();
    pools
}

#[test]
fn draws_the_scenes_of_the_repository_to_the_bit() {
    for name in SCENES {
        let pools = load(name);
        for (width, height) in [(1, 1), (7, 5), (8, 1), (1, 9), (161, 97)] {
            for max_depth in [0, 1, 5] {
                assert_same(name, pools.as_scene(), width, height, max_depth);
            }
        }
        assert_same(name, pools.as_scene(), 31, 23, 16);
        // Wider than a batch.
        assert_same(name, pools.as_scene(), 1201, 3, 5);
    }
}

#[test]
#[ignore = "takes long: .ci/run runs it"]
fn draws_whole_pictures_to_the_bit() {
    for name in SCENES {
        let pools = load(name);
        assert_same(name, pools.as_scene(), 800, 600, 5);
        assert_same(name, pools.as_scene(), 203, 151, 16);
    }
}

#[test]
fn draws_parts_of_rows() {
    let pools = load("default");
    let tracer = Tracer::new(pools.as_scene())
        .with_bvh()
        .with_stack::<STACK>();
    let packets = PacketTracer::new(tracer);
    let mut part = [Color::default(); 13];
    packets.sample_row(places(391, 300), &mut part);
    for (x, color) in (391..).zip(part) {
        assert_eq!(color, tracer.pixel(x, 300));
    }
    packets.sample_row(places(5, 5), &mut []);
}

#[test]
fn draws_places_beside_the_centres_of_some_columns() {
    let pools = load("default");
    let tracer = Tracer::new(pools.as_scene())
        .with_bvh()
        .with_stack::<STACK>()
        .with_resolution(Resolution {
            width: 61,
            height: 47,
        });
    for level in levels() {
        let mut packets = PacketTracer::new(tracer);
        packets.level = level;
        let pattern = Supersampled::<(), 64>::PATTERN.into_iter().step_by(13);
        for (at, (x, step)) in pattern.zip([(0, 1), (3, 1), (0, 2), (0, 4), (5, 3)]) {
            let y = u16::from(at.row) % 47;
            let mut colors = vec![Color::default(); (61 - usize::from(x)).div_ceil(step)];
            let step = step as u16;
            packets.sample_row(SampleRow { x, step, y, at }, &mut colors);
            let scanline = tracer.scanline_at(y, at);
            for (x, color) in (x..).step_by(step.into()).zip(colors) {
                let expected = tracer.sample_observed(&scanline, x, at, &mut ());
                assert_eq!(color, expected, "{level:?}, {at:?}, pixel ({x}, {y})");
            }
        }
    }
}

#[test]
fn draws_a_picture_from_several_threads() {
    let pools = load("reflective");
    let tracer = Tracer::new(pools.as_scene())
        .with_bvh()
        .with_stack::<STACK>()
        .with_resolution(Resolution {
            width: 64,
            height: 40,
        });
    let packets = PacketTracer::new(tracer);
    let rows = |rows: std::ops::Range<u16>| {
        for y in rows {
            let mut row = [Color::default(); 64];
            packets.sample_row(places(0, y), &mut row);
            for (x, color) in (0..).zip(row) {
                assert_eq!(color, tracer.pixel(x, y));
            }
        }
    };
    std::thread::scope(|scope| {
        scope.spawn(|| rows(0..20));
        rows(20..40);
    });
    assert!(packets.workspaces().len() <= 2);
}

#[test]
fn draws_random_scenes_to_the_bit() {
    // Without optimisation, fewer.
    let scenes = if cfg!(debug_assertions) { 3000 } else { 20_000 };
    for seed in 0..scenes {
        let random = Random::new(seed);
        let mut pools = Box::new(Pools::new());
        random.fill(&mut pools);
        if random.one_in(2) {
            pools.prepare();
        }
        let (width, height) = (1 + random.below(19), 1 + random.below(13));
        let max_depth = random.pick(&[0, 1, 2, 3, 5]);
        let name = format!("random scene of seed {seed}");
        assert_same(
            &name,
            pools.as_scene(),
            width as u16,
            height as u16,
            max_depth,
        );
    }
}

#[test]
fn draws_random_scenes_with_a_bvh_to_the_bit() {
    let scenes = if cfg!(debug_assertions) { 100 } else { 2000 };
    let mut hierarchies = 0;
    for seed in 0..scenes {
        let random = Random::new(1_000_000 + seed);
        let mut pools = Box::new(Pools::new());
        random.fill(&mut pools);
        random.crowd(&mut pools);
        pools.prepare();
        hierarchies += u64::from(pools.as_scene().accel().bvh().is_some());
        let (width, height) = (1 + random.below(40), 1 + random.below(9));
        let max_depth = random.pick(&[0, 1, 3]);
        let name = format!("random crowd of seed {seed}");
        let (width, height) = (width as u16, height as u16);
        assert_same(&name, pools.as_scene(), width, height, max_depth);
    }
    assert!(
        hierarchies > scenes / 2,
        "only {hierarchies} of {scenes} have a bvh"
    );
}

/// Scenes of texts that are aimed at what is hard: shapes along the axes and all but along them, that touch, of extreme ratios,
/// a few objects or so many that there is a hierarchy.
fn draws_random_texts(seed: u64, texts: usize, is_crowd: bool) {
    let numbers = Numbers::of_test(seed);
    let mut pools = Box::new(Pools::new());
    let (mut scenes, mut in_lanes, mut with_bvh) = (0, 0, 0);
    for round in 0..texts {
        let writer = Writer {
            random: &numbers,
            extreme: [0, 0, 20, 5][round % 4],
            scale: numbers.log_between(1e-2, 1e3),
            aimed: round % 3 > 0,
        };
        let text = if is_crowd {
            let is_scene = |text: &str| One::new().parse(text.as_bytes()).is_ok();
            writer.crowd(60 + numbers.below(60), is_scene)
        } else {
            writer.scene()
        };
        if pools.parse(text.as_bytes()).is_err() {
            continue;
        }
        scenes += 1;
        let scene = pools.as_scene();
        in_lanes += usize::from(!scene.has_light_on_surface());
        with_bvh += usize::from(scene.accel().bvh().is_some());
        let resolution = Resolution {
            width: 9,
            height: 2,
        };
        assert_same_as(&text, scene, scene.without_accel(), resolution, 4);
    }
    println!("{scenes} scenes, {in_lanes} in lanes, {with_bvh} with a hierarchy");
    assert!(in_lanes > 10 && (with_bvh > scenes / 2) == is_crowd);
}

#[test]
fn draws_random_texts_to_the_bit() {
    draws_random_texts(198, 1500, false);
    draws_random_texts(200, 60, true);
}

#[test]
#[ignore = "takes long: .ci/run runs it"]
fn draws_many_random_texts_to_the_bit() {
    draws_random_texts(199, 20_000, false);
    draws_random_texts(201, 1000, true);
}

#[test]
fn draws_objects_without_material_and_with_any_numbers() {
    let sphere = |x, material, number| {
        Sphere::new(Vec3::new(x, 0.0, 3.0), 1.0, ObjectInfo { material, number }).unwrap()
    };
    let spheres = [
        sphere(-1.0, 0, 5),
        sphere(0.0, 7, 70),
        sphere(1.0, 0, 1_000_000),
    ];
    let materials = [Material::new(MaterialDescription {
        diffuse: Color::new(0.5, 0.6, 0.7),
        reflection: 0.5,
        refraction: 0.5,
        index_of_refraction: 1.5,
        ..Default::default()
    })];
    let light = Light {
        position: Vec3::new(9.0, 9.0, -9.0),
        specular: Color::new(1.0, 1.0, 1.0),
        diffuse: Color::new(1.0, 1.0, 1.0),
    };
    let lights = [light];
    let scene = Scene::EMPTY
        .with_ambient(0.5)
        .with_background(Background {
            color: Color::new(0.1, 2.0, 0.3),
            sky: false,
        })
        .with_lights(&lights)
        .with_spheres(&spheres)
        .with_materials(&materials);
    assert_same("without material", scene, 33, 21, 5);
}

/// A material that shows where it is and casts both kinds of rays.
fn glass(shade: f32) -> MaterialDescription {
    MaterialDescription {
        ambient: Color::new(shade, 0.5, 1.0 - shade),
        reflection: 0.4,
        refraction: 0.6,
        index_of_refraction: 1.2,
        ..Default::default()
    }
}

#[test]
fn draws_more_rays_of_a_depth_than_a_batch_holds() {
    let mut pools = Box::new(Pools::new());
    let mut filling = Pools::as_mut(&mut pools);
    filling.set_ambient(0.5);
    for radius in [1.0, 2.0, 4.0] {
        let center = Vec3::new(0.1, 0.2, 0.3);
        filling
            .add_sphere(center, radius, glass(radius / 4.0))
            .unwrap();
    }
    assert_same("glass spheres", pools.as_scene(), 1201, 2, 6);
}

/// A disc across an axis that is `slant` off the one of the camera.
fn disc(center: Vec3, radius: f32, slant: f32) -> Shape {
    Shape::Disc {
        center,
        normal: Vec3::new(slant, 0.5 * slant, -1.0),
        radius,
    }
}

/// Discs that shine, mirror and cast shadows, among objects of all other shapes, `crowd` more of them.
fn discs(crowd: usize) -> Box<Pools> {
    let random = Random::new(crowd as u64);
    let mut pools = Box::new(Pools::new());
    let mut filling = Pools::as_mut(&mut pools);
    filling.set_ambient(0.2);
    for x in [-4.0, 3.0] {
        let light = Light {
            position: Vec3::new(x, 5.0, -3.0),
            specular: Color::new(0.5, 0.5, 0.5),
            diffuse: Color::new(0.6, 0.5, 0.4),
        };
        filling.add_light(light).unwrap();
    }
    let matt = MaterialDescription {
        diffuse: Color::new(0.5, 0.6, 0.7),
        specular: Color::new(0.5, 0.5, 0.5),
        shininess: 20.0,
        ..Default::default()
    };
    let mirror = MaterialDescription {
        reflection: 0.7,
        ..matt
    };
    let floor = Vec3::new(0.0, 1.0, 0.0);
    filling.add_plane(floor, 1.0, mirror).unwrap();
    filling
        .add_sphere(Vec3::new(0.3, 0.1, 5.0), 0.8, mirror)
        .unwrap();
    let corners = [(-2.0, 6.0), (2.0, 6.0), (0.0, 7.0)].map(|(x, z)| Vec3::new(x, z - 5.5, z));
    filling.add_triangle(corners, matt).unwrap();
    // Lies just above the floor, and is seen in it from below.
    let lying = Shape::Disc {
        center: Vec3::new(-0.5, -0.9, 4.0),
        normal: floor,
        radius: 1.2,
    };
    filling.add(lying, matt).unwrap();
    for (x, slant) in [(-1.2, 0.5), (0.0, 0.0), (1.2, -30.0)] {
        let center = Vec3::new(x, 0.2, 3.0);
        filling.add(disc(center, 0.4, slant), glass(0.3)).unwrap();
    }
    for index in 0..crowd {
        let center = random.point(2.0, false) + Vec3::new(0.0, 0.0, 5.0);
        let (radius, slant) = (random.between(0.05, 0.3), random.between(-2.0, 2.0));
        let material = random.pick(&[matt, mirror]);
        match index % 3 {
            0 => filling.add_sphere(center, radius, material),
            _ => filling.add(disc(center, radius, slant), material),
        }
        .unwrap();
    }
    pools.prepare();
    pools
}

#[test]
fn draws_discs_among_other_shapes_to_the_bit() {
    let resolution = Resolution {
        width: 97,
        height: 61,
    };
    // With candidates, with more than are told apart, and with a hierarchy.
    for (crowd, has_bvh) in [(0, false), (30, false), (70, true)] {
        let pools = discs(crowd);
        let scene = pools.as_scene();
        assert_eq!(scene.accel().bvh().is_some(), has_bvh, "{crowd} more");
        let tracer = Tracer::new(scene).with_bvh().with_stack::<STACK>();
        assert!(PacketTracer::new(tracer).has_lanes);
        let name = format!("discs, {crowd} more");
        let brute_force = scene.without_accel();
        assert_same_as(&name, scene, brute_force, resolution, 4);
        assert_same_as(&name, brute_force, scene, resolution, 4);
        // A disc that is not there is missed.
        let pixel = |scene| Tracer::new(scene).with_resolution(resolution).pixel(48, 29);
        assert_ne!(pixel(scene), pixel(scene.with_stored(Stored::NONE)));
    }
}

#[test]
fn the_first_of_coincident_objects_of_any_shapes_wins() {
    // Along the axis of the camera each of them is hit at exactly 2.
    let orders = [
        [0, 1, 2],
        [0, 2, 1],
        [1, 0, 2],
        [1, 2, 0],
        [2, 0, 1],
        [2, 1, 0],
    ];
    // With the disc at each place.
    for (order, at) in (0..24).map(|i| (orders[i / 4], i % 4)) {
        let mut order = order.to_vec();
        order.insert(at, 3);
        let mut pools = Box::new(Pools::new());
        let mut filling = Pools::as_mut(&mut pools);
        filling.set_ambient(1.0);
        for shape in &order {
            match shape {
                0 => filling.add_sphere(Vec3::new(0.0, 0.0, 4.0), 2.0, glass(0.1)),
                1 => filling.add_plane(Vec3::new(0.0, 0.0, 1.0), -2.0, glass(0.2)),
                3 => filling.add(disc(Vec3::new(0.0, 0.0, 2.0), 1.0, 0.4), glass(0.4)),
                _ => {
                    let corner = |x, y| Vec3::new(x, y, 2.0);
                    let corners = [corner(-4.0, -4.0), corner(4.0, -4.0), corner(0.0, 4.0)];
                    filling.add_triangle(corners, glass(0.3))
                }
            }
            .unwrap();
        }
        assert_same(&format!("order {order:?}"), pools.as_scene(), 9, 9, 2);
    }
}

/// The generator splitmix64, and scenes from it.
pub(super) struct Random(Cell<u64>);

impl Random {
    pub(super) fn new(seed: u64) -> Self {
        Self(Cell::new(seed))
    }

    fn bits(&self) -> u64 {
        let state = self.0.get().wrapping_add(0x9e37_79b9_7f4a_7c15);
        self.0.set(state);
        let z = (state ^ (state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    pub(super) fn below(&self, end: usize) -> usize {
        (self.bits() % end as u64) as usize
    }

    pub(super) fn one_in(&self, n: usize) -> bool {
        self.below(n) == 0
    }

    pub(super) fn pick<T: Copy>(&self, choices: &[T]) -> T {
        choices[self.below(choices.len())]
    }

    pub(super) fn between(&self, low: f32, high: f32) -> f32 {
        low + (high - low) * (self.bits() >> 40) as f32 / (1_u64 << 24) as f32
    }

    /// A point with coordinates of up to `extent`; on a coarse grid, vertices, edges and rays
    /// coincide.
    pub(super) fn point(&self, extent: f32, grid: bool) -> Vec3 {
        let coordinate = || {
            if grid {
                (self.below(9) as f32 - 4.0) * 0.25 * extent
            } else {
                self.between(-extent, extent)
            }
        };
        Vec3::new(coordinate(), coordinate(), coordinate())
    }

    fn color(&self) -> Color {
        match self.below(8) {
            0 => Color::BLACK,
            1 => Color::new(5.0, 0.0, 1e20),
            _ => Color::new(
                self.between(0.0, 1.0),
                self.between(0.0, 1.0),
                self.between(0.0, 1.0),
            ),
        }
    }

    pub(super) fn material(&self) -> MaterialDescription {
        MaterialDescription {
            diffuse: self.color(),
            specular: self.color(),
            ambient: self.color(),
            reflection: self.pick(&[0.0, 0.0, 0.3, 1.0, 1e30]),
            shininess: self.pick(&[0.0, 1.0, 50.0, 1024.0, 1025.0, 0.3, 2.5, 50.5, 1e30]),
            refraction: self.pick(&[0.0, 0.0, 0.4, 1.0, 3.0]),
            index_of_refraction: self
                .pick(&[1.0, 1.0, 1.5, 1.5, 0.9, 1.0001, 2.4, 1e-3, 1e-6, 1e4, 1e10]),
        }
    }

    /// Adds spheres, triangles and discs of all sizes, as many as there is room for, but for a few.
    fn crowd(&self, pools: &mut Pools) {
        let mut pools = pools.as_mut();
        let scale = self.pick(&[1.0, 1.0, 1e-3, 1e5]);
        let grid = self.one_in(3);
        let material = self.material();
        for _ in 0..40 + self.below(100) {
            let size = scale * self.pick(&[1e-3, 0.1, 0.3, 2.0]);
            let at = self.point(3.0 * scale, grid);
            let corner = || at + self.point(size, grid);
            // What does not fit is left out.
            let _ = match self.below(3) {
                0 => pools.add_sphere(at, size, material),
                1 => pools.add_triangle([corner(), corner(), corner()], material),
                _ => pools.add(disc(at, size, self.between(-3.0, 3.0)), material),
            };
        }
    }

    /// Fills pools with a scene that may be of any size, crowded, coincident or empty.
    fn fill(&self, pools: &mut Pools) {
        let mut pools = pools.as_mut();
        let scale = self.pick(&[
            1.0, 1.0, 1.0, 1.0, 1e-3, 1e3, 1e-12, 1e12, 1e-19, 1e17, 1e-30,
        ]);
        let grid = self.one_in(3);
        let count = |usual| match self.below(12) {
            0 => 40,
            1 => 0,
            _ => self.below(usual),
        };
        pools.set_camera(Camera {
            position: self.point(self.pick(&[0.0, 0.5, 3.0]) * scale, grid),
        });
        pools.set_ambient(self.pick(&[0.0, 0.1, 1.0]));
        pools.set_background(Background {
            color: self.color(),
            sky: self.one_in(2),
        });
        for _ in 0..self.below(4) {
            let light = Light {
                position: self.point(self.pick(&[1.0, 5.0, 50.0]) * scale, grid),
                specular: self.color(),
                diffuse: self.color(),
            };
            pools.add_light(light).unwrap();
        }
        let extent = self.pick(&[1.0, 3.0, 10.0]) * scale;
        // Shapes that are none are left out; the pools have room for all others.
        let check = |added: Result<(), SceneError>| {
            assert!(!matches!(added, Err(SceneError::PoolFull { .. })));
        };
        let material = self.material();
        let material = || {
            if self.one_in(3) {
                material
            } else {
                self.material()
            }
        };
        // In any order of shapes, some of them twice.
        let counts = [count(8), count(4), count(10), count(4)];
        let mut shapes: Vec<usize> = (0..).zip(counts).flat_map(|(it, n)| vec![it; n]).collect();
        while !shapes.is_empty() {
            let shape = shapes.swap_remove(self.below(shapes.len()));
            let copies = if shapes.len() < 20 && self.one_in(6) {
                2
            } else {
                1
            };
            let points = [(); 3].map(|()| self.point(extent, grid));
            let size = self.pick(&[0.1, 0.5, 1.0, 4.0, 1e-4]) * extent;
            let size = if grid {
                size
            } else {
                size * self.between(0.5, 1.0)
            };
            for _ in 0..copies {
                check(match shape {
                    0 => pools.add_sphere(points[0], size, material()),
                    1 => pools.add_plane(points[0], size, material()),
                    3 => {
                        let [center, normal, _] = points;
                        let disc = Shape::Disc {
                            center,
                            normal,
                            radius: size,
                        };
                        pools.add(disc, material())
                    }
                    _ => pools.add_triangle(points, material()),
                });
            }
        }
    }
}
