//! Cases 62 to 69: what is read, what the machine does with it, and `f32` against `f64` on every scene.

use std::hint::black_box;

use embedded_graphics::pixelcolor::{Rgb888, RgbColor};
use rayon::prelude::*;
use scanray::shape::{ObjectInfo, Plane, Sphere, Triangle};
use scanray::{
    Color, MaterialDescription, Ray, Resolution, Scalar, SceneError, ScenePools, Tracer, Vec3,
    pools::Pool, render::DisplayColor,
};

use super::record::{Counts, Effort, Record, Tier, grey, vector};
use super::{Case, Group, How};
use crate::Number;
use crate::scenes::{self, Model, Part, RoomyPools, Shape};
use crate::settled::{View, settled_through};
use crate::textbook::Textbook;

macro_rules! case {
    ($number:literal $name:ident: $expected:literal) => {
        case!($number $name: $expected; None)
    };
    ($number:literal $name:ident: $expected:literal; $on_boards:expr) => {
        Case {
            number: $number,
            name: stringify!($name),
            group: Group::Input,
            expected: $expected,
            how: How { single: $name::<f32>, double: $name::<f64>, on_boards: $on_boards },
        }
    };
}

pub(super) const CASES: &[Case] = &[
    case!(62 ends_of_the_pools: "no objects, no light, full pools: drawn; one object too many: refused by name"),
    case!(63 nan_infinity_and_1e39_in_every_field: "rejected at their place"),
    case!(64 subnormal_fields: "tier C, or rejected at their place"),
    case!(65 sign_of_zero: "−0.0 and +0.0 give the same picture"),
    case!(66 rays_that_are_no_rays: "NaN is missed by every shape, at once"),
    case!(67 flush_to_zero: "subnormal numbers are computed with, and on the board the unit's flush-to-zero flag is off";
        Some("every program starts with firmware/board/src/arm.rs, and one that sets the flag must fail in firmware/test.sh")),
    case!(68 same_picture_on_every_machine: "the same hash on x86-64, Cortex-M0, M3, M4F and RISC-V";
        Some("firmware/test.sh draws them anew and compares with firmware/tables/pictures.txt")),
    case!(69 single_precision_on_every_scene: "tier A"),
];

/// A scene with every kind of object.
const EVERY_SHAPE: &str = "3
0.5 0.25 -1.0
16 12
5.0 6.0 -7.0 1.0 1.0 1.0 0.9 0.8 0.7
0.1
1
0.5 0.5 1.0
0 1.5 1.0 4.0 0.5 0.6 0.1 0.1 0.5 0.5 0.5 1.0 1.0 1.0 0.2 50.0 0.5 1.5
1 0.1 1.0 0.2 1.0 0.5 0.5 0.5 0.1 0.1 0.1 1.0 1.0 1.0 0.3 20.5 0.25 1.25
2 2.0 0.5 2.5 3.0 0.5 1.5 2.5 1.5 2.0 0.0 0.0 0.0 0.0 0.8 0.1 0.2 0.5 0.5 0.5 1.0 1.0 1.0 0.2 50.0 0.3 1.0
";

/// The words of a text: line and column of each, from 1, and its range.
pub(super) fn words(text: &str) -> Vec<(u32, u32, std::ops::Range<usize>)> {
    let mut words = Vec::new();
    let mut start = 0;
    for (number, line) in text.split_inclusive('\n').enumerate() {
        let mut column = 0;
        for word in line.split_inclusive(|c: char| c.is_ascii_whitespace()) {
            let length = word.trim_end().len();
            if length > 0 {
                let from = start + column;
                words.push((number as u32 + 1, column as u32 + 1, from..from + length));
            }
            column += word.len();
        }
        start += line.len();
    }
    words
}

fn ends_of_the_pools<T: Number>(record: &mut Record) {
    let size = Resolution {
        width: 8,
        height: 6,
    };
    // Nothing at all, not even a light; then a light; then objects without a light.
    let mut empty = super::shading::dark::<T>();
    empty.resolution = size;
    empty.background.color = grey(0.25);
    let pools = empty.build();
    let colors = record.draw(&Tracer::new(pools.as_scene()));
    record.holds(
        "an empty scene shows its background",
        colors.iter().all(|color| *color == grey(0.25)),
    );
    let mut dark = Model::of(&scenes::load::<T>("default").as_scene());
    dark.resolution = size;
    dark.lights.clear();
    let pools = dark.build();
    record.draw(&Tracer::new(pools.as_scene()));

    // Full pools of two of each.
    type Small<T> = ScenePools<T, 2, 2, 2, 6, 1, 6>;
    let material = |number: usize| MaterialDescription::<T> {
        ambient: grey(0.1 * number as f64),
        ..Default::default()
    };
    let triangle = |z| {
        [
            vector(-1.0, -1.0, z),
            vector(1.0, -1.0, z),
            vector(0.0, 1.0, z),
        ]
    };
    let mut pools = Small::<T>::new();
    let mut filling = pools.as_mut();
    filling.set_resolution(size);
    let mut refused = 0;
    for number in 0..2 {
        let z = 4.0 + number as f64;
        let added = [
            filling.add_sphere(vector(0.0, 0.0, z), T::ONE, material(3 * number)),
            filling.add_plane(vector(0.0, 1.0, 0.0), T::ONE, material(3 * number + 1)),
            filling.add_triangle(triangle(z), material(3 * number + 2)),
        ];
        refused += added.iter().filter(|added| added.is_err()).count();
    }
    refused += usize::from(
        filling
            .add_light(super::shading::light(vector(0.0, 3.0, 0.0), 1.0, 1.0))
            .is_err(),
    );
    record.count("objects refused by pools that have room", refused as u64, 7);
    let full = |result: Result<(), SceneError>, expected: Pool| matches!(result, Err(SceneError::PoolFull { pool, .. }) if pool == expected);
    let known = material(0);
    let named = [
        full(
            filling.add_sphere(vector(0.0, 0.0, 9.0), T::ONE, known),
            Pool::Spheres,
        ),
        full(
            filling.add_plane(vector(0.0, 1.0, 0.0), T::ONE, known),
            Pool::Planes,
        ),
        full(filling.add_triangle(triangle(9.0), known), Pool::Triangles),
        full(
            filling.add_light(super::shading::light(vector(0.0, 3.0, 0.0), 1.0, 1.0)),
            Pool::Lights,
        ),
    ];
    record.count(
        "objects too many that are not refused by the pool's name",
        named.iter().filter(|named| !**named).count() as u64,
        named.len() as u64,
    );
    record.holds(
        "what is refused changes nothing",
        pools.as_scene().object_count() == 6,
    );
    record.draw(&Tracer::new(pools.as_scene()));

    let mut smaller = ScenePools::<T, 1, 1, 0, 2, 1, 2>::new();
    let error = smaller.parse(EVERY_SHAPE.as_bytes()).err();
    record.holds(
        "the parser names the first object that does not fit",
        error.is_some_and(|error| {
            (error.line, error.column) == (10, 1) && error.to_string().contains("triangles")
        }),
    );
}

fn nan_infinity_and_1e39_in_every_field<T: Number>(record: &mut Record) {
    let too_large = if T::NAME == f32::NAME {
        "1e39"
    } else {
        "1e309"
    };
    let negative = format!("-{too_large}");
    for bad in [
        "nan", "NaN", "inf", "-inf", "infinity", too_large, &negative,
    ] {
        let (mut wrong, mut of) = (0, 0);
        for (line, column, range) in words(EVERY_SHAPE) {
            let mut text = EVERY_SHAPE.to_owned();
            text.replace_range(range, bad);
            let mut pools = ScenePools::<T>::new();
            let error = pools.parse(text.as_bytes()).err();
            let is_named = error.is_some_and(|error| {
                (error.line, error.column) == (line, column)
                    && error.to_string().contains(&format!("found `{bad}`"))
            });
            of += 1;
            wrong += u64::from(!is_named || pools.as_scene().object_count() > 0);
        }
        record.count(format!("fields that take `{bad}`"), wrong, of);
    }
}

fn subnormal_fields<T: Number>(record: &mut Record) {
    let numbers: [&str; 4] = if T::NAME == f32::NAME {
        ["1e-45", "-1e-45", "1e-39", "1.1754942e-38"]
    } else {
        ["5e-324", "-5e-324", "1e-310", "2.2250738585072009e-308"]
    };
    let (mut wrong, mut of, mut drawn) = (0, 0, 0);
    for number in numbers {
        for (line, column, range) in words(EVERY_SHAPE) {
            let mut text = EVERY_SHAPE.to_owned();
            text.replace_range(range, number);
            let mut pools = ScenePools::<T>::new();
            of += 1;
            match pools.parse(text.as_bytes()) {
                Ok(_) => {
                    drawn += 1;
                    record.draw(&Tracer::new(pools.as_scene()));
                }
                Err(error) => wrong += u64::from((error.line, error.column) != (line, column)),
            }
        }
    }
    record.count("fields that are rejected elsewhere", wrong, of);
    record.holds("most fields are accepted", drawn > of / 2);
}

fn sign_of_zero<T: Number>(record: &mut Record) {
    let negative_zero = |x: T| if x == T::ZERO { -T::ZERO } else { x };
    let vector = |v: Vec3<T>| Vec3::new(negative_zero(v.x), negative_zero(v.y), negative_zero(v.z));
    let color =
        |c: Color<T>| Color::new(negative_zero(c.r), negative_zero(c.g), negative_zero(c.b));
    let size = Resolution {
        width: 80,
        height: 60,
    };
    for (name, model) in super::image::models::<T>(size) {
        let mut changed = model.mapped(vector, vector, T::ONE);
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
        let (pools, expected) = (changed.build(), model.build());
        let colors = record.draw(&Tracer::new(pools.as_scene()));
        let expected = record.draw(&Tracer::new(expected.as_scene()));
        let wrong = super::image::different(&colors, &expected);
        record.count_in(&name, "pixels that differ", wrong, expected.len() as u64);
    }
}

fn rays_that_are_no_rays<T: Number>(record: &mut Record) {
    let surface = ObjectInfo {
        material: 0,
        number: 0,
    };
    let sphere = Sphere::new(vector::<T>(0.0, 0.0, 5.0), T::ONE, surface).expect("a sphere");
    let plane = Plane::new(vector::<T>(0.0, 0.6, 0.8), T::ONE, surface).expect("a plane");
    let v = |x, y| vector::<T>(x, y, 4.0);
    let triangle =
        Triangle::new([v(-1.0, -1.0), v(1.0, -1.0), v(0.0, 2.0)], surface).expect("a triangle");
    let pools: RoomyPools<T> = Model::of(&scenes::load::<T>("default").as_scene()).build();
    let tracer = Tracer::new(pools.as_scene());
    let (mut hits, mut of, mut no_distances) = (0, 0, 0);
    for set in 1..64 {
        for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            let mut numbers = [0.01, 0.02, 0.0, 0.1, 0.1, 0.98];
            for (place, number) in numbers.iter_mut().enumerate() {
                if set >> place & 1 != 0 {
                    *number = bad;
                }
            }
            let [x, y, z, dx, dy, dz] = numbers;
            let ray = Ray::new(vector::<T>(x, y, z), vector(dx, dy, dz));
            let found = [
                sphere.intersect(&ray, T::MAX),
                plane.intersect(&ray, T::MAX),
                triangle.intersect(&ray, T::MAX),
            ];
            let occluded = [
                sphere.occludes(&ray, T::MAX),
                plane.occludes(&ray, T::MAX),
                triangle.occludes(&ray, T::MAX),
            ];
            of += 3;
            if bad.is_nan() {
                hits += found.iter().filter(|t| t.is_some()).count() as u64;
                hits += occluded.iter().filter(|hit| **hit).count() as u64;
            } else {
                // Such a ray has no length 1; whatever is answered is at least a distance.
                let is_distance = |t: T| t.is_finite() && t > T::ZERO;
                no_distances += found.iter().flatten().filter(|t| !is_distance(**t)).count() as u64;
            }
            if bad.is_nan() {
                hits += u64::from(tracer.nearest(&ray).is_some());
                hits += u64::from(tracer.occluded(&ray, T::MAX));
            }
        }
    }
    record.count("hits of rays with NaN", hits, of);
    record.count("hits at no distance", no_distances, of);
}

/// What a processor that flushes subnormal numbers to zero would do otherwise.
fn flush_to_zero<T: Number>(record: &mut Record) {
    // Not the compiler's arithmetic but the machine's.
    let machine = black_box::<T>;

    // Halved until nothing is left: as often as the significand has bits.
    let (mut wrong, mut of, mut x) = (0, 0, T::MIN_POSITIVE);
    while x != T::MIN_POSITIVE * T::EPSILON && x != T::ZERO {
        let half = machine(x) * machine(T::HALF);
        wrong += u64::from(half == T::ZERO || machine(half) + half != x);
        of += 1;
        x = half;
    }
    let bits = if T::NAME == f32::NAME { 23 } else { 52 };
    record.holds("the smallest number has the last bit alone", of == bits);
    record.count("halves that are not exact", wrong, of);

    // A scene that shines this little, by its objects and behind them.
    let shine = T::MIN_POSITIVE * T::HALF * T::HALF;
    let faint = Color::new(shine, shine, shine);
    let mut model = super::shading::dark::<T>();
    model.resolution = Resolution {
        width: 16,
        height: 12,
    };
    model.ambient = T::ONE;
    model.background.color = faint;
    model.parts.push(Part {
        shape: Shape::Sphere {
            center: vector(0.0, 0.0, 5.0),
            radius: T::ONE,
        },
        material: MaterialDescription {
            ambient: faint,
            ..Default::default()
        },
    });
    let pools = model.build();
    let colors = record.draw(&Tracer::new(pools.as_scene()));
    let wrong = colors.iter().filter(|color| **color != faint).count();
    record.count(
        "pixels of another colour than the scene's",
        wrong as u64,
        colors.len() as u64,
    );

    // The difference of two numbers that are close is exact, unless it is flushed.
    let random = record.random(67);
    let (mut wrong, of) = (0, 10_000);
    for _ in 0..of {
        let number = || T::MIN_POSITIVE * T::from_f64(random.between(1.0, 2.0));
        let (a, b) = (number(), number());
        let difference = machine(a) - machine(b);
        wrong += u64::from((difference == T::ZERO) != (a == b) || machine(difference) + b != a);
    }
    record.count("differences that are not exact", wrong, of);
}

/// The CRC-32 of PNG and zlib: the boards' hash of a picture.
fn crc_32(bytes: impl IntoIterator<Item = u8>) -> u32 {
    !bytes.into_iter().fold(!0, |crc, byte| {
        (0..8).fold(crc ^ u32::from(byte), |crc, _| {
            (crc >> 1) ^ (0xedb8_8320 & 0_u32.wrapping_sub(crc & 1))
        })
    })
}

fn same_picture_on_every_machine<T: Number>(record: &mut Record) {
    // What the boards drew: a line for each scene, its name and a column for each machine.
    let boards = crate::boards::HASHES;
    let mut lines = boards.lines().map(str::split_whitespace);
    let machines: Vec<&str> = lines.next().into_iter().flatten().skip(1).collect();
    record.holds(
        "the table has the host and four boards",
        machines == ["x86-64", "M4F", "M3", "M0", "RISC-V"],
    );
    let mut drawn = Vec::new();
    for mut line in lines {
        let Some(name) = line.next() else { continue };
        let Some(text) = crate::boards::text(name) else {
            record.holds(format!("{name} is a scene"), false);
            continue;
        };
        let mut pools = Box::new(ScenePools::<T>::new());
        pools.parse(text).expect("a scene of the repository");
        let tracer = Tracer::new(pools.as_scene()).with_resolution(Resolution {
            width: 160,
            height: 120,
        });
        let colors = record.draw(&tracer);
        drawn.push(name);
        // The boards draw in single precision; in double, a picture is only looked after.
        if T::NAME == f64::NAME {
            continue;
        }
        let levels = colors.iter().flat_map(|color| {
            let pixel = Rgb888::from_linear(*color, T::HALF);
            [pixel.r(), pixel.g(), pixel.b()]
        });
        let hash = format!("{:08x}", crc_32(levels));
        for machine in &machines {
            let wrong = u64::from(line.next() != Some(&hash));
            record.count_in(
                &format!("{name} on {machine}"),
                "pictures that differ from the boards'",
                wrong,
                1,
            );
        }
    }
    let missing = scenes::names()
        .iter()
        .filter(|name| !drawn.contains(&name.as_str()))
        .count();
    record.count(
        "scenes of scenes/ that no board drew",
        missing as u64,
        scenes::names().len() as u64,
    );
}

fn single_precision_on_every_scene<T: Number>(record: &mut Record) {
    let size = match record.effort() {
        Effort::Quick => Resolution {
            width: 160,
            height: 120,
        },
        Effort::Full => Resolution {
            width: 800,
            height: 600,
        },
    };
    for name in scenes::names() {
        let (pools, exact): (ScenePools<T>, ScenePools<f64>) =
            (scenes::load(&name), scenes::load(&name));
        let tracer = Tracer::new(pools.as_scene()).with_resolution(size);
        let exact = Tracer::new(exact.as_scene()).with_resolution(size);
        let colors = record.draw(&tracer);
        if T::NAME == f64::NAME {
            // It is what the other is compared with.
            continue;
        }
        let textbook = Textbook::new(pools.as_scene(), tracer.max_depth());
        let (view, exact_view) = (View::of(&tracer), View::of(&exact));
        let width = usize::from(size.width);
        let counts = colors
            .par_chunks(width)
            .enumerate()
            .map(|(y, row)| {
                let mut counts = Counts::default();
                for (x, color) in row.iter().enumerate() {
                    let pixel = (x as u16, y as u16);
                    let by_textbook = textbook.radiance(&view.ray(pixel, (0.0, 0.0)));
                    let expected = settled_through(&exact, &exact_view, pixel);
                    counts.add(*color, by_textbook, expected);
                }
                counts
            })
            .reduce(Counts::default, Counts::join);
        let what = format!("{name}, {}×{}", size.width, size.height);
        record.tier_findings(&counts, Tier::A, &what);
    }
}
