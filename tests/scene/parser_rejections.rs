//! Rejections of the scene text that need no file: full pools, and each field with each number that is none. A rejected text
//! leaves the pools empty. Those of scenes/invalid/ are in tests/repository.

use crate::common::rejection::{check_place, rejection};
use scanray::{Color, ScenePools, parser::Expected, pools::Pool};

const HEADER: &str = "\
0.0 0.0 0.0
64 48
5.0 6.0 -4.0 1.0 1.0 1.0 1.0 1.0 1.0
0.1
1
0.5 0.5 1.0
";

/// A scene of these objects.
fn scene_of(objects: &[String]) -> String {
    let mut text = format!("{}\n{HEADER}", objects.len());
    for object in objects {
        text += object;
        text += "\n";
    }
    text
}

/// A material that is not equal to that of another number.
fn material(number: usize) -> String {
    format!("0.5 0.5 0.5 0.5 0.5 0.5 1.0 1.0 1.0 0.2 {number}.0 0.0 0.0")
}

fn sphere(material_number: usize) -> String {
    format!("0 0.0 0.0 4.0 0.5 {}", material(material_number))
}

fn plane(material_number: usize) -> String {
    format!("1 0.0 1.0 0.0 1.0 {}", material(material_number))
}

fn triangle(material_number: usize) -> String {
    format!(
        "2 2.0 0.5 2.5 3.0 0.5 1.5 2.5 1.5 2.0 0.0 0.0 0.0 0.0 {}",
        material(material_number)
    )
}

type SmallPools = ScenePools<f32, 3, 2, 1, 4, 1>;

/// Parses into small pools; the message, after which they must be empty.
fn small_rejection(objects: &[String]) -> String {
    let mut pools = SmallPools::new();
    // What fits is accepted before and after.
    let fitting = scene_of(&[sphere(1), plane(1), triangle(2)]);
    pools.parse(fitting.as_bytes()).unwrap();
    let error = pools.parse(scene_of(objects).as_bytes()).unwrap_err();
    assert_eq!(pools.as_scene().object_count(), 0);
    assert!(pools.usage().iter().all(|pool| pool.used == 0));
    check_place(scene_of(objects).as_bytes(), &error).unwrap();
    pools.parse(fitting.as_bytes()).unwrap();
    error.to_string()
}

#[test]
fn a_full_pool_is_named_with_its_capacity_and_the_first_object_that_does_not_fit() {
    assert_eq!(
        small_rejection(&[sphere(1), sphere(1), plane(1), sphere(1), sphere(1)]),
        "line 12, column 1: expected at most 3 spheres, which is all their pool holds; object 5 does not \
         fit; found `0`"
    );
    assert_eq!(
        small_rejection(&[plane(1), plane(1), plane(1), sphere(1)]),
        "line 10, column 1: expected at most 2 planes, which is all their pool holds; object 3 does not \
         fit; found `1`"
    );
    assert_eq!(
        small_rejection(&[triangle(1), format!("\n # one too many\n\t{}", triangle(1))]),
        "line 11, column 2: expected at most 1 triangles, which is all their pool holds; object 2 does not \
         fit; found `2`"
    );
    assert_eq!(
        small_rejection(&[
            sphere(1),
            plane(2),
            sphere(3),
            sphere(4),
            plane(5),
            plane(6)
        ]),
        "line 12, column 1: expected at most 4 materials, which is all their pool holds; object 5 does not \
         fit; found `1`"
    );
}

#[test]
fn full_pools_of_the_default_capacities_take_no_more() {
    let capacity = |pool| {
        let usage = ScenePools::<f32>::new().usage();
        usage
            .iter()
            .find(|entry| entry.pool == pool)
            .unwrap()
            .capacity
    };
    for (pool, object) in [
        (Pool::Spheres, sphere as fn(usize) -> String),
        (Pool::Planes, plane),
        (Pool::Triangles, triangle),
    ] {
        let full = vec![object(1); capacity(pool)];
        let mut pools = ScenePools::<f32>::new();
        pools.parse(scene_of(&full).as_bytes()).unwrap();
        let mut one_more = full;
        one_more.push(object(1));
        let error = rejection(scene_of(&one_more).as_bytes()).unwrap();
        let object = Some(one_more.len() as u32);
        let capacity = capacity(pool);
        assert_eq!(
            error.expected,
            Expected::Room {
                pool,
                capacity,
                object
            }
        );
    }
}

#[test]
fn materials_that_are_equal_take_one_place() {
    let mut pools = SmallPools::new();
    let objects = [sphere(1), sphere(2), plane(1), triangle(2), sphere(1)];
    pools.parse(scene_of(&objects).as_bytes()).unwrap();
    assert_eq!(pools.as_scene().materials().len(), 2);
}

#[test]
fn a_light_that_does_not_fit_is_named() {
    let mut pools = ScenePools::<f32, 1, 1, 1, 1, 0>::new();
    let error = pools.parse(scene_of(&[]).as_bytes()).unwrap_err();
    assert_eq!(
        error.to_string(),
        "line 4, column 1: expected at most 0 lights, which is all their pool holds; the light does not \
         fit; found `5.0`"
    );
}

#[test]
fn the_rest_of_a_line_that_does_not_fit_is_not_read() {
    // Which of two errors is told: the one that comes first.
    let text = scene_of(&[triangle(1), String::from("2 nonsense")]);
    let error = SmallPools::new().parse(text.as_bytes()).unwrap_err();
    assert!(matches!(error.expected, Expected::Room { .. }), "{error}");
}

#[test]
fn what_is_too_large_depends_on_the_scalar() {
    let large = |number: &str| {
        let text = scene_of(&[]).replace("0.0 0.0 0.0", &format!("0.0 {number} 0.0"));
        let single = ScenePools::<f32>::new().parse(text.as_bytes());
        let double = ScenePools::<f64>::new().parse(text.as_bytes());
        (
            single.map_err(|error| error.to_string()),
            double.map_err(|error| error.to_string()),
        )
    };
    let (single, double) = large("1e39");
    assert_eq!(
        single.unwrap_err(),
        "line 2, column 5: expected the camera position y: a finite number; found `1e39`, which is too \
         large for f32"
    );
    assert!(double.is_ok());
    let (_, double) = large("1e309");
    assert_eq!(
        double.unwrap_err(),
        "line 2, column 5: expected the camera position y: a finite number; found `1e309`, which is too \
         large for f64"
    );
    let radius = |radius: &str| {
        let text = scene_of(&[sphere(1).replace(" 4.0 0.5 ", &format!(" 4.0 {radius} "))]);
        ScenePools::<f64>::new().parse(text.as_bytes())
    };
    assert!(radius("2e19").is_ok());
    assert_eq!(
        radius("2e154").unwrap_err().to_string(),
        "line 8, column 15: expected the sphere's radius: a number above 0 whose square is finite; found \
         `2e154`"
    );
}

/// Every number of a scene with every shape, replaced in turn, is refused at its own place.
#[test]
fn no_field_takes_what_is_no_finite_number() {
    let text = scene_of(&[sphere(1), plane(2), triangle(3)]);
    let mut fields = 0;
    let mut start = 0;
    while start < text.len() {
        let length = text[start..]
            .find(|c: char| c.is_ascii_whitespace())
            .unwrap_or(text.len() - start);
        if length > 0 {
            fields += 1;
            for bad in [
                "nan", "NaN", "-nan", "inf", "+inf", "-inf", "infinity", "1e39", "-1e39", "3.5e38",
                "x", "1x", "1e", "0x10", "1,5", "''", "1..", "-", "+", ".", "e5", "١",
            ] {
                let changed = format!("{}{bad}{}", &text[..start], &text[start + length..]);
                let error = rejection(changed.as_bytes())
                    .unwrap_or_else(|what| panic!("`{bad}` at byte {start} {what}"));
                check_place(changed.as_bytes(), &error).unwrap();
                assert_eq!(error.offset, start, "`{bad}` at byte {start}: {error}");
                assert!(
                    error.to_string().contains(&format!("found `{bad}`")),
                    "`{bad}` at byte {start}: {error}"
                );
            }
        }
        start += length + 1;
    }
    // The header, and objects of 18, 18 and 27 numbers.
    assert_eq!(fields, 1 + 3 + 2 + 9 + 1 + 1 + 3 + 18 + 18 + 27);
}

/// Which numbers may be negative: positions, normals, distances, placeholders. No other.
#[test]
fn only_places_and_directions_may_be_negative() {
    let text = scene_of(&[sphere(1), plane(2), triangle(3)]);
    let signs = [
        "+",                           // number of objects
        "---",                         // camera
        "++",                          // width, height
        "---++++++",                   // light
        "+",                           // ambient
        "+",                           // flag
        "+++",                         // background
        "+---++++++++++++++",          // sphere
        "+----+++++++++++++",          // plane
        "+-------------+++++++++++++", // triangle
    ];
    for (line, signs) in signs.iter().enumerate() {
        let numbers = text.lines().nth(line).unwrap().split(' ').count();
        assert_eq!(numbers, signs.len(), "line {line}");
        for (i, sign) in signs.chars().enumerate() {
            let mut lines: Vec<String> = text.lines().map(String::from).collect();
            let mut words: Vec<&str> = text.lines().nth(line).unwrap().split(' ').collect();
            words[i] = "-0.375";
            lines[line] = words.join(" ");
            let accepted = ScenePools::<f32>::new().parse(lines.join("\n").as_bytes());
            assert_eq!(
                accepted.is_ok(),
                sign == '-',
                "line {line}, number {i}: {accepted:?}"
            );
        }
    }
}

#[test]
fn the_message_without_its_place_is_the_end_of_that_with_it() {
    let error = rejection(b"1\n0.0 0.0").unwrap();
    let message = error.message().to_string();
    assert_eq!(error.to_string(), format!("line 2, column 8: {message}"));
    assert_eq!(
        message,
        "expected the camera position z: a finite number; found the end of the text"
    );
}

#[test]
fn colors_and_intensities_above_one_are_accepted() {
    let text = scene_of(&[sphere(1), plane(2), triangle(3)])
        .replace("1.0 1.0 1.0 1.0 1.0 1.0\n", "1e30 2 3 4 5 6\n")
        .replace("\n0.1\n", "\n7.5\n")
        .replace("0.5 0.5 1.0\n", "8 9 10\n")
        .replace("1.0 1.0 1.0 0.2", "1.5 2.5 3.5 1.2");
    let mut pools = ScenePools::<f32>::new();
    pools.parse(text.as_bytes()).unwrap();
    let scene = pools.as_scene();
    assert_eq!(scene.lights()[0].specular, Color::new(1e30, 2.0, 3.0));
    assert_eq!(scene.lights()[0].diffuse, Color::new(4.0, 5.0, 6.0));
    assert_eq!(scene.ambient(), 7.5);
    assert_eq!(scene.background().color, Color::new(8.0, 9.0, 10.0));
    let material = scene.material(scene.spheres()[0].info());
    assert_eq!(material.ambient, Color::new(1.5, 2.5, 3.5));
    assert_eq!(material.reflection, 1.2);
}

#[test]
fn a_byte_order_mark_is_skipped_at_the_start_alone() {
    let text = scene_of(&[sphere(1)]);
    let mut pools = ScenePools::<f32>::new();
    pools.parse(format!("\u{feff}{text}").as_bytes()).unwrap();
    assert_eq!(pools.as_scene().object_count(), 1);
    let error = rejection(text.replace("\n64", "\n\u{feff}64").as_bytes()).unwrap();
    assert_eq!((error.line, error.column), (3, 1));
    let error = rejection("\u{feff}".as_bytes()).unwrap();
    assert_eq!((error.line, error.column, error.offset), (1, 4, 3));
}
