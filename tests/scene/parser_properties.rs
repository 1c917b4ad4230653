//! Properties of the scene parser: what is written in any accepted way is what is stored; what is cut off,
//! damaged or garbage is refused at a place of the text, without a panic.

use crate::common::scenes::{self, RoomyPools};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use scanray::{
    Color, MaterialDescription, ParseError, Resolution, Scalar, ScenePools, Vec3,
    parser::{Found, FromDecimal, Range, Report},
    shape::Object,
};

/// The same cases in every run; `PROPTEST_RNG_SEED` and `PROPTEST_CASES` try others.
fn config(cases: u32) -> ProptestConfig {
    let mut config = ProptestConfig::with_cases(cases);
    if std::env::var_os("PROPTEST_CASES").is_some() {
        config.cases = ProptestConfig::default().cases;
    }
    if std::env::var_os("PROPTEST_RNG_SEED").is_none() {
        config.rng_seed = RngSeed::Fixed(2);
    }
    // A failing case is shown with its input; no file is left in the source tree.
    config.failure_persistence = None;
    config
}

/// A random scene in numbers of `f32`, whole numbers aside.
#[derive(Clone, Debug)]
struct SceneNumbers {
    camera: [f32; 3],
    size: (u16, u16),
    light: [f32; 9],
    ambient: f32,
    sky: bool,
    background: [f32; 3],
    objects: Vec<ObjectNumbers>,
}

#[derive(Clone, Debug)]
struct ObjectNumbers {
    kind: u8,
    geometry: Vec<f32>,
    material: [f32; 13],
}

/// Numbers over many decades, whole ones and simple fractions among them, that are not negative.
fn amount() -> impl Strategy<Value = f32> {
    prop_oneof![
        2 => Just(0.0_f32),
        2 => (0_u32..2_000).prop_map(|n| n as f32),
        2 => (0_u32..1_000).prop_map(|n| n as f32 / 8.0),
        3 => (-30.0_f64..18.0).prop_map(|e| 10_f64.powf(e) as f32),
        // Any positive bits, subnormal numbers included, that stay clear of infinite squares.
        1 => (1_u32..0x5f00_0000).prop_map(f32::from_bits),
    ]
}

fn coordinate() -> impl Strategy<Value = f32> {
    (amount(), any::<bool>()).prop_map(|(x, negative)| if negative { -x } else { x })
}

fn radius() -> impl Strategy<Value = f32> {
    amount().prop_map(|x| if x > 0.0 { x } else { 0.75 })
}

fn material() -> impl Strategy<Value = [f32; 13]> {
    prop::array::uniform13(amount()).prop_map(|mut numbers| {
        // Of all but the shininess and the index no more than what is accepted; refraction asks for an index.
        for (place, number) in numbers.iter_mut().enumerate() {
            if place != 10 && place != 12 {
                *number = number.min(Range::MAX_SHARE);
            }
        }
        let [least, most] = Range::INDEX;
        if numbers[11] > 0.0 && !(least..=most).contains(&numbers[12]) {
            numbers[12] = 1.5;
        }
        numbers
    })
}

fn object() -> impl Strategy<Value = ObjectNumbers> {
    let sphere = (prop::array::uniform3(coordinate()), radius())
        .prop_map(|(center, radius)| (0, [&center[..], &[radius]].concat()));
    let plane = (prop::array::uniform3(coordinate()), -1e6_f32..1e6).prop_map(|(mut normal, d)| {
        // Far from where the distance or the length of the normal becomes infinite.
        if normal.iter().all(|n| n.abs() < 1e-20) {
            normal[1] = 2.5;
        }
        (1, [&normal[..], &[d]].concat())
    });
    // The third vertex keeps away from the line through the others.
    let triangle = (
        prop::array::uniform3(-100_f32..100.0),
        prop::array::uniform3(1_f32..10.0),
        prop::array::uniform4(coordinate()),
    )
        .prop_map(|(v1, e, placeholders)| {
            let v2 = [v1[0] + e[0], v1[1], v1[2]];
            let v3 = [v1[0], v1[1] + e[1], v1[2] + e[2]];
            (2, [&v1[..], &v2, &v3, &placeholders].concat())
        });
    (prop_oneof![sphere, plane, triangle], material()).prop_map(|((kind, geometry), material)| {
        ObjectNumbers {
            kind,
            geometry,
            material,
        }
    })
}

fn scene_numbers() -> impl Strategy<Value = SceneNumbers> {
    (
        prop::array::uniform3(coordinate()),
        (1..=u16::MAX, 1..=u16::MAX),
        (
            prop::array::uniform3(coordinate()),
            prop::array::uniform6(amount()),
        ),
        amount(),
        any::<bool>(),
        prop::array::uniform3(amount()),
        prop::collection::vec(object(), 0..12),
    )
        .prop_map(
            |(camera, size, (position, colors), ambient, sky, background, objects)| {
                let mut light = [0.0; 9];
                light[..3].copy_from_slice(&position);
                light[3..].copy_from_slice(&colors);
                SceneNumbers {
                    camera,
                    size,
                    light,
                    ambient,
                    sky,
                    background,
                    objects,
                }
            },
        )
}

/// Choices of how to write things, made by proptest and used in turn.
struct Style<'a> {
    choices: &'a [u8],
    next: usize,
}

impl Style<'_> {
    fn choose(&mut self, options: u8) -> u8 {
        let choice = self.choices[self.next % self.choices.len()];
        // An uneven step, so that a short list is not always used in the same way.
        self.next += 1 + self.next / self.choices.len() % 3;
        choice % options
    }

    /// One of the ways to write a number, all of which the standard library reads as `value`.
    fn number(&mut self, value: f32) -> String {
        let plain = format!("{value}");
        let sign = if value.is_sign_negative() { "-" } else { "" };
        let digits = plain.trim_start_matches('-').to_owned();
        let (whole, fraction) = digits.split_once('.').unwrap_or((&digits, ""));
        let written = match self.choose(11) {
            0 => plain,
            1 if sign.is_empty() => format!("+{plain}"),
            2 => format!("{value:e}"),
            3 => format!("{value:E}")
                .replace("E", "E+")
                .replace("E+-", "E-0"),
            // As exact as it goes.
            4 => format!("{:.*}", 150, f64::from(value)),
            5 => format!("{sign}{whole}.{fraction}"),
            6 if whole == "0" && !fraction.is_empty() => format!("{sign}.{fraction}"),
            7 => format!("{sign}000{whole}.{fraction}00"),
            8 => format!("{sign}{whole}.{fraction}e0"),
            9 => format!("{sign}{whole}{fraction}e-{}", fraction.len()),
            _ => format!("{value:?}"),
        };
        let reread: f32 = written.parse().unwrap();
        assert_eq!(reread.to_bits(), value.to_bits(), "`{written}`");
        written
    }

    fn blanks(&mut self) -> &'static str {
        [" ", "  ", "\t", " \t ", "        "][usize::from(self.choose(5))]
    }

    /// What may stand between two records: an end of line, with comments and empty lines.
    fn line_end(&mut self) -> &'static str {
        [
            "\n",
            "\r\n",
            " \n",
            "\n\n",
            "\t\r\n \r\n",
            "# a comment\n",
            " # 1 2 3 \"µ\"\r\n",
            "\n# a line of comment\n\t# another\n",
            "#\n",
        ][usize::from(self.choose(9))]
    }

    fn record(&mut self, text: &mut String, words: &[String]) {
        if self.choose(4) == 0 {
            *text += self.blanks();
        }
        for (i, word) in words.iter().enumerate() {
            if i > 0 {
                *text += self.blanks();
            }
            *text += word;
        }
        *text += self.line_end();
    }

    fn numbers(&mut self, values: &[f32]) -> Vec<String> {
        values.iter().map(|&value| self.number(value)).collect()
    }
}

/// A scene as text. Placeholders, which nothing stores, may be any numbers.
fn write(scene: &SceneNumbers, choices: &[u8]) -> String {
    let mut style = Style { choices, next: 0 };
    let mut text = String::new();
    if style.choose(3) == 0 {
        text += style.line_end();
    }
    style.record(&mut text, &[scene.objects.len().to_string()]);
    let words = style.numbers(&scene.camera);
    style.record(&mut text, &words);
    style.record(
        &mut text,
        &[scene.size.0.to_string(), scene.size.1.to_string()],
    );
    let words = style.numbers(&scene.light);
    style.record(&mut text, &words);
    let words = style.numbers(&[scene.ambient]);
    style.record(&mut text, &words);
    style.record(&mut text, &[u8::from(scene.sky).to_string()]);
    let words = style.numbers(&scene.background);
    style.record(&mut text, &words);
    for object in &scene.objects {
        let mut words = vec![object.kind.to_string()];
        words.extend(style.numbers(&object.geometry));
        words.extend(style.numbers(&object.material));
        style.record(&mut text, &words);
    }
    if style.choose(3) == 0 {
        text.truncate(text.trim_end().len());
    }
    text
}

fn vector([x, y, z]: [f32; 3]) -> Vec3 {
    Vec3::new(x, y, z)
}

fn color([r, g, b]: [f32; 3]) -> Color {
    Color::new(r, g, b)
}

fn three(numbers: &[f32], from: usize) -> [f32; 3] {
    [numbers[from], numbers[from + 1], numbers[from + 2]]
}

/// Equal, and zeros of the same sign.
fn assert_same_bits(actual: Vec3, expected: Vec3) {
    let bits = |v: Vec3| [v.x, v.y, v.z].map(f32::to_bits);
    assert_eq!(
        bits(actual),
        bits(expected),
        "{actual:?} instead of {expected:?}"
    );
}

fn assert_stored(scene: &SceneNumbers, pools: &RoomyPools<f32>) {
    let stored = pools.as_scene();
    assert_same_bits(stored.camera().position, vector(scene.camera));
    let (width, height) = scene.size;
    assert_eq!(stored.resolution(), Resolution { width, height });
    assert_eq!(stored.ambient().to_bits(), scene.ambient.to_bits());
    assert_eq!(stored.background().sky, scene.sky);
    assert_eq!(stored.background().color, color(scene.background));
    let [light] = stored.lights() else {
        panic!("{} lights", stored.lights().len())
    };
    assert_same_bits(light.position, vector(three(&scene.light, 0)));
    assert_eq!(light.specular, color(three(&scene.light, 3)));
    assert_eq!(light.diffuse, color(three(&scene.light, 6)));
    assert_eq!(stored.object_count(), scene.objects.len());
    for (i, (object, numbers)) in stored.objects().zip(&scene.objects).enumerate() {
        assert_eq!(object.info().number as usize, i);
        assert_object(&object, numbers);
        let m = numbers.material;
        assert_eq!(
            stored.material(object.info()),
            MaterialDescription {
                diffuse: color(three(&m, 0)),
                specular: color(three(&m, 3)),
                ambient: color(three(&m, 6)),
                reflection: m[9],
                shininess: m[10],
                refraction: m[11],
                index_of_refraction: m[12],
            }
        );
    }
}

fn assert_object(object: &Object<'_>, numbers: &ObjectNumbers) {
    let g = &numbers.geometry;
    match (object, numbers.kind) {
        (Object::Sphere(sphere), 0) => {
            assert_same_bits(sphere.center(), vector(three(g, 0)));
            assert_eq!(sphere.radius(), g[3]);
            // No ray hits a sphere whose square loses digits.
            let square = g[3] * g[3];
            let stored = if square.is_normal() { square } else { -1.0 };
            assert_eq!(sphere.radius_squared(), stored);
        }
        (Object::Plane(plane), 1) => {
            let n = [g[0], g[1], g[2]].map(f64::from);
            let length = n.iter().map(|x| x * x).sum::<f64>().sqrt();
            let unit = plane.normal();
            for (actual, x) in [unit.x, unit.y, unit.z].into_iter().zip(n) {
                assert!(
                    (f64::from(actual) - x / length).abs() < 3e-7,
                    "{unit:?} of {g:?}"
                );
            }
            // Points satisfy n·p + d = 0, divided by the length.
            let height = -f64::from(g[3]) / length;
            let error = (f64::from(plane.height()) - height).abs();
            assert!(error <= 5e-7 * height.abs() + 1e-44, "{plane:?} of {g:?}");
        }
        (Object::Triangle(triangle), 2) => {
            let vertices = [0, 3, 6].map(|from| vector(three(g, from)));
            for (actual, expected) in triangle.vertices().into_iter().zip(vertices) {
                assert_same_bits(actual, expected);
            }
            // (v3 − v1) × (v2 − v1), from differences that f32 may round.
            let [v1, v2, v3] = vertices;
            let wide = |v: Vec3| Vec3::new(f64::from(v.x), f64::from(v.y), f64::from(v.z));
            let normal = wide(v3 - v1).cross(wide(v2 - v1)).normalize();
            let error = (wide(triangle.normal()) - normal).abs().max_component();
            assert!(error < 1e-6, "{triangle:?} instead of {normal:?}");
        }
        _ => panic!("{object:?} instead of kind {}", numbers.kind),
    }
}

proptest! {
    #![proptest_config(config(1_500))]

    #[test]
    fn what_is_written_is_what_is_stored(
        scene in scene_numbers(),
        choices in prop::collection::vec(any::<u8>(), 1..200),
    ) {
        let text = write(&scene, &choices);
        let mut pools = RoomyPools::new();
        match pools.parse(text.as_bytes()) {
            Ok(report) => prop_assert_eq!(report, Report::default()),
            Err(error) => prop_assert!(false, "{}\n{}", error, text),
        }
        assert_stored(&scene, &pools);
    }

    #[test]
    fn the_light_may_leave_out_its_last_number(
        scene in scene_numbers(),
        choices in prop::collection::vec(any::<u8>(), 1..200),
    ) {
        let mut scene = scene;
        scene.light[8] = scene.light[7];
        let text = write(&scene, &choices);
        // The fourth record, whose last word goes.
        let is_record = |line: &str| !line.trim_start().is_empty() && !line.trim_start().starts_with('#');
        let number = text
            .split('\n')
            .enumerate()
            .filter(|(_, line)| is_record(line))
            .nth(3)
            .unwrap()
            .0;
        let shorter: Vec<String> = text
            .split('\n')
            .enumerate()
            .map(|(i, line)| if i == number { without_ninth_word(line) } else { line.to_owned() })
            .collect();
        let mut pools = RoomyPools::new();
        let report = pools.parse(shorter.join("\n").as_bytes()).unwrap();
        prop_assert_eq!(report.short_light_line, Some(number as u32 + 1));
        assert_stored(&scene, &pools);
    }
}

fn without_ninth_word(line: &str) -> String {
    let mut start = 0;
    for _ in 0..8 {
        start += line[start..]
            .find(|c: char| !c.is_ascii_whitespace())
            .unwrap();
        start += line[start..]
            .find(|c: char| c.is_ascii_whitespace())
            .unwrap();
    }
    let is_end = |c: char| c.is_ascii_whitespace() || c == '#';
    let word = start + line[start..].find(|c: char| !is_end(c)).unwrap();
    let end = line[word..]
        .find(is_end)
        .map_or(line.len(), |end| word + end);
    format!("{}{}", &line[..start], &line[end..])
}

#[test]
fn the_light_as_published_has_8_numbers() {
    let mut pools = ScenePools::<f32>::new();
    let text = String::from_utf8(scenes::text("default")).unwrap();
    let published = text.replace("50 50 0  1 1 1  1 1 1", "50.0 50.0 0.0 1.0 1.0 1.0 1.0 1.0");
    assert_ne!(published, text);
    let report = pools.parse(published.as_bytes()).unwrap();
    assert_eq!(report.short_light_line, Some(4));
    assert_eq!(
        pools.as_scene().lights()[0].diffuse,
        Color::new(1.0, 1.0, 1.0)
    );
    assert_eq!(pools.as_scene().object_count(), 7);
}

#[test]
fn no_scene_is_warned_about() {
    for name in scenes::names().iter() {
        let report = ScenePools::<f32>::new().parse(&scenes::text(name)).unwrap();
        assert_eq!(report, Report::default(), "{name}");
    }
}

/// What holds for every text: an error points at a byte of the text and says something, and the pools
/// are full or empty.
fn check_any_text(text: &[u8], pools: &mut ScenePools) -> Result<Report, ParseError> {
    let result = pools.parse(text);
    match result {
        Ok(_) => {
            // What is accepted is accepted again, and can be drawn.
            assert!(pools.as_scene().lights().len() == 1);
            assert!(pools.as_scene().resolution().width > 0);
        }
        Err(error) => {
            assert!(error.offset <= text.len(), "{error:?}");
            let before = &text[..error.offset];
            let line = before.split(|&byte| byte == b'\n').count();
            let column = before.rsplit(|&byte| byte == b'\n').next().unwrap().len() + 1;
            assert_eq!((error.line as usize, error.column as usize), (line, column));
            let message = error.to_string();
            let prefix = format!("line {line}, column {column}: expected ");
            assert!(message.starts_with(&prefix), "{message}");
            assert!(message.contains("; found "), "{message}");
            assert!(
                !message.contains('\n') && !message.contains('\r'),
                "{message:?}"
            );
            assert!(pools.usage().iter().all(|pool| pool.used == 0), "{error}");
            // At the end of the line nothing but blanks and a comment follows.
            if matches!(error.found, Found::EndOfLine | Found::EndOfText) {
                let rest = text[error.offset..].split(|&byte| byte == b'\n').next();
                let word = rest.unwrap().iter().find(|byte| !b" \t\r".contains(byte));
                assert!(matches!(word, None | Some(b'#')), "{error}");
            }
        }
    }
    result
}

#[test]
fn a_scene_cut_off_anywhere_is_a_scene_or_an_error_at_a_place() {
    let mut pools = ScenePools::new();
    for name in scenes::names() {
        let text = scenes::text(&name);
        let mut accepted = 0;
        for length in 0..=text.len() {
            accepted += usize::from(check_any_text(&text[..length], &mut pools).is_ok());
        }
        // Only cuts in the last word, the last comment or behind them leave a scene.
        let tail = text
            .iter()
            .rev()
            .skip_while(|byte| byte.is_ascii_whitespace());
        let last_word = tail.take_while(|byte| !byte.is_ascii_whitespace()).count();
        println!("{name}: {accepted} of {} cuts are scenes", text.len() + 1);
        assert!(
            (1..=last_word + 1).contains(&accepted),
            "{name}: {accepted}"
        );
    }
}

#[test]
fn line_ends_of_any_system_and_a_missing_last_one_change_nothing() {
    for name in scenes::names() {
        let text = scenes::text(&name);
        let mut expected = ScenePools::<f32>::new();
        let report = expected.parse(&text).unwrap();
        let text = String::from_utf8(text).unwrap();
        for variant in [
            text.replace('\n', "\r\n"),
            text.trim_end().to_owned(),
            text.replace('\n', " # comment\n"),
            text.replace(' ', "\t \t"),
            format!("{text}\n\n  # the end"),
            format!("{text}\r\n\t\r\n#\r\n\r\n"),
        ] {
            let mut pools = ScenePools::<f32>::new();
            assert_eq!(pools.parse(variant.as_bytes()), Ok(report), "{name}");
            assert_eq!(pools.as_scene(), expected.as_scene(), "{name}");
        }
    }
}

#[test]
fn parsing_replaces_what_was_in_the_pools() {
    let mut pools = ScenePools::<f32>::new();
    for name in scenes::names() {
        pools.parse(&scenes::text(&name)).unwrap();
        assert_eq!(pools.as_scene(), scenes::load(&name).as_scene(), "{name}");
    }
}

proptest! {
    #![proptest_config(config(3_000))]

    #[test]
    fn garbage_is_refused_without_a_panic(text in prop::collection::vec(any::<u8>(), 0..400)) {
        let mut pools = scenes::load("default");
        let _ = check_any_text(&text, &mut pools);
    }

    /// Garbage that looks like a scene gets further.
    #[test]
    fn garbage_of_plausible_words_is_refused_without_a_panic(
        words in prop::collection::vec(
            prop::sample::select(vec![
                "0", "1", "2", "3", "-1", "0.5", "1e39", "1e-50", "nan", "#", "\n", "\n", "\r\n", " ", "\t",
                "1.5", "64 48\n", "7\n", "0 0 0\n", "4294967296", ".", "e", "-", "+.", "\0", "½", "\u{feff}",
                "1 2 3 4 5 6 7 8\n", "0 0 0 4 1 1 1 1 1 1 1 1 1 1 0 1 0 0\n",
            ]),
            0..60,
        ),
        glue in prop::sample::select(vec!["", " ", "\n"]),
    ) {
        let mut pools = scenes::load("default");
        let _ = check_any_text(words.join(glue).as_bytes(), &mut pools);
    }

    /// A good scene with a few bytes replaced, removed or inserted.
    #[test]
    fn damaged_scenes_are_scenes_or_refused_at_a_place(
        name in prop::sample::select(scenes::names()),
        damage in prop::collection::vec((any::<prop::sample::Index>(), 0..3_u8, any::<u8>()), 1..5),
    ) {
        let mut text = scenes::text(&name);
        for (place, how, byte) in damage {
            let place = place.index(text.len());
            // Half of the bytes are such that scenes consist of.
            let byte = if byte < 128 { b"0123456789.-+eE \n\t\r#"[usize::from(byte) % 20] } else { byte };
            match how {
                0 => text[place] = byte,
                1 => drop(text.remove(place)),
                _ => text.insert(place, byte),
            }
        }
        let _ = check_any_text(&text, &mut ScenePools::new());
    }
}

/// A text for a decimal number: of any length, exponent and sign.
fn decimal() -> impl Strategy<Value = String> {
    prop_oneof![
        // Any bits of both formats, in a few notations.
        any::<u32>().prop_map(|bits| format!("{:e}", f32::from_bits(bits))),
        any::<u64>().prop_map(|bits| format!("{:e}", f64::from_bits(bits))),
        any::<u32>().prop_map(|bits| format!("{}", f32::from_bits(bits))),
        // Halfway between two numbers of f32, exactly and next to it.
        (
            any::<u32>(),
            prop::sample::select(vec!["", "0000000001", "1"])
        )
            .prop_map(|(bits, tail)| {
                let bits = (bits & 0x7fff_ffff).min(f32::MAX.to_bits() - 1);
                let (low, high) = (f32::from_bits(bits), f32::from_bits(bits + 1));
                let middle = (f64::from(low) + f64::from(high)) / 2.0;
                format!("{middle:.160}{tail}")
            }),
        "[+-]?[0-9]{1,40}",
        "[+-]?[0-9]{0,25}\\.[0-9]{1,25}",
        "[+-]?[0-9]{1,25}\\.[0-9]{0,25}([eE][+-]?[0-9]{1,3})?",
        "[+-]?\\.[0-9]{1,9}[eE][+-]?[0-9]{1,5}",
        "[+-]?0{0,60}[0-9]{1,5}\\.?0{0,60}([eE][+-]?0{0,9}[0-9]{1,2})?",
    ]
    // Numbers that are none in decimals are another test's.
    .prop_filter("finite in writing", |text| {
        text.bytes().any(|b| b.is_ascii_digit())
    })
}

/// A scene with this text for a coordinate of the camera, where any finite number is accepted.
fn parse_number<T: Scalar + FromDecimal>(text: &str) -> Result<T, ParseError> {
    let scene = format!("0\n0 {text} 0\n1 1\n0 0 0 1 1 1 1 1 1\n0\n0\n0 0 0\n");
    let mut pools = ScenePools::<T>::new();
    pools.parse(scene.as_bytes())?;
    Ok(pools.as_scene().camera().position.y)
}

proptest! {
    #![proptest_config(config(30_000))]

    #[test]
    fn numbers_are_those_of_the_standard_library(text in decimal()) {
        let single: f32 = text.parse().unwrap();
        match parse_number::<f32>(&text) {
            Ok(value) => prop_assert_eq!(value.to_bits(), single.to_bits(), "`{}` for f32", text),
            Err(error) => {
                prop_assert!(single.is_infinite(), "`{}` for f32: {}", text, error);
                prop_assert!(matches!(error.found, Found::TooLarge(_, "f32")), "{}", error);
            }
        }
        let double: f64 = text.parse().unwrap();
        match parse_number::<f64>(&text) {
            Ok(value) => prop_assert_eq!(value.to_bits(), double.to_bits(), "`{}` for f64", text),
            Err(error) => {
                prop_assert!(double.is_infinite(), "`{}` for f64: {}", text, error);
                prop_assert!(matches!(error.found, Found::TooLarge(_, "f64")), "{}", error);
            }
        }
    }
}

#[test]
fn the_notations_of_the_contract_are_read() {
    for (text, value) in [
        ("+1", 1.0_f32),
        ("-0", -0.0),
        (".5", 0.5),
        ("1.", 1.0),
        ("1e-3", 0.001),
        ("-.25E+2", -25.0),
        ("00012.500", 12.5),
        ("3.4028235677973366e38", f32::MAX),
        ("1e-46", 0.0),
        ("-1e-999999999999", -0.0),
    ] {
        let read = parse_number::<f32>(text).unwrap_or_else(|error| panic!("`{text}`: {error}"));
        assert_eq!(
            read.to_bits(),
            value.to_bits(),
            "`{text}` is read as {read:e}"
        );
    }
}

/// Normals of any length are normalised, and the distance with them.
#[test]
fn planes_are_normalised_whatever_the_length_of_their_normal() {
    for length in [
        "1e-38", "1e-30", "1e-15", "1", "1e15", "1e30", "1e38", "3e38",
    ] {
        for normal in [
            [1.0, 0.0, 0.0],
            [1.0, 1.0, 1.0],
            [0.6, -0.8, 0.0],
            [-1.0, 1e-3, 1.0],
        ] {
            let words = normal.map(|n: f32| format!("{}", n * length.parse::<f32>().unwrap()));
            let text = format!(
                "1\n0 0 0\n1 1\n0 0 0 1 1 1 1 1 1\n0\n0\n0 0 0\n1 {} {length} 0 0 0 0 0 0 0 0 0 0 0 0 0\n",
                words.join(" ")
            );
            let mut pools = ScenePools::<f32>::new();
            pools
                .parse(text.as_bytes())
                .unwrap_or_else(|error| panic!("{error}\n{text}"));
            let plane = pools.as_scene().planes()[0];
            let exact = normal.map(f64::from);
            let exact_length = exact.iter().map(|n| n * n).sum::<f64>().sqrt();
            let stored = plane.normal();
            for (actual, n) in [stored.x, stored.y, stored.z].into_iter().zip(exact) {
                let error = (f64::from(actual) - n / exact_length).abs();
                assert!(error < 1e-6, "normal of length {length}: {plane:?}");
            }
            let error = (f64::from(plane.height()) + 1.0 / exact_length).abs();
            assert!(
                error < 1e-6,
                "distance {length} at {normal:?} times {length}: {plane:?}"
            );
        }
    }
}
