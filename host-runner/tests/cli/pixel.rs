//! How pixels come about.

use std::collections::BTreeSet;

use serde_json::Value;

use crate::program::{Folder, SMALL_SCENE, scene};

fn numbers(value: &Value) -> Vec<f32> {
    let numbers = value.as_array().unwrap();
    numbers
        .iter()
        .map(|number| number.as_f64().unwrap() as f32)
        .collect()
}

/// The colour of a ray from what is told of it.
fn recomputed(ray: &Value) -> Vec<f32> {
    let hit = &ray["hit"];
    if hit.is_null() {
        return numbers(&ray["result"]);
    }
    let mut color = numbers(&hit["ambient"]);
    let mut add = |other: Vec<f32>, factor: f32| {
        for (sum, other) in color.iter_mut().zip(other) {
            *sum += other * factor;
        }
    };
    for light in hit["lights"].as_array().unwrap() {
        for part in ["diffuse", "specular"] {
            if !light[part].is_null() {
                add(numbers(&light[part]), 1.0);
            }
        }
    }
    for ray in hit["rays"].as_array().unwrap() {
        add(recomputed(ray), ray["weight"].as_f64().unwrap() as f32);
    }
    color
        .iter()
        .map(|channel| channel.clamp(0.0, 1.0))
        .collect()
}

#[test]
fn agrees_with_the_picture_to_the_bit() {
    let folder = Folder::new();
    let mut kinds = BTreeSet::new();
    for (name, settings) in [
        ("default", &["--size", "40x30"][..]),
        ("mirror-room", &["--size", "41x31", "--max-depth", "9"]),
        ("pyramids", &["--display", "ssd1306"]),
        (
            "reflective",
            &["--size", "40x30", "--color", "rgb565", "--dither"],
        ),
        (
            "default",
            &["--size", "20x15", "--samples", "4", "--cutoff", "1/64"],
        ),
        (
            "default",
            &["--size", "40x30", "--adaptive", "1/16", "--scalar", "f32"],
        ),
        ("reflective", &["--size", "41x30", "--preview", "quarter"]),
        ("window-room", &["--size", "40x30", "--max-depth", "0"]),
    ] {
        let path = scene(name);
        let picture = folder.draw(&[&[&*path], settings].concat());
        let places: Vec<(usize, usize)> = (0..60)
            .map(|i| (i * 7 % picture.width, i * 11 % picture.height))
            .collect();
        let words: Vec<String> = places.iter().map(|(x, y)| format!("{x},{y}")).collect();
        let words: Vec<&str> = words.iter().map(|word| &**word).collect();
        let run = folder.succeed(&[&["pixel", &path, "--json"], settings, &words].concat());
        let lines: Vec<&str> = std::str::from_utf8(&run.stdout).unwrap().lines().collect();
        assert_eq!(lines.len(), places.len());
        for (line, (x, y)) in lines.iter().zip(places) {
            let json: Value = serde_json::from_str(line).unwrap();
            let pixel = &picture.rgb888[(y * picture.width + x) * 3..][..3];
            let shown: Vec<u8> = serde_json::from_value(json["shown"].clone()).unwrap();
            assert_eq!(shown, pixel, "{name} {x},{y}");
            let rays = json["rays"].as_array().unwrap();
            kinds.insert(json["rays_are"].as_str().unwrap().to_owned());
            for ray in rays {
                assert_eq!(recomputed(ray), numbers(&ray["result"]));
            }
            // The samples come last; their number is a power of 2, so that the share is exact.
            let of = json["of"].as_u64().unwrap_or(1) as usize;
            let mut mean = [0.0; 3];
            for ray in &rays[rays.len() - of..] {
                for (sum, channel) in mean.iter_mut().zip(recomputed(ray)) {
                    *sum += channel;
                }
            }
            let mean: Vec<f32> = mean.iter().map(|sum| sum / of as f32).collect();
            assert_eq!(mean, numbers(&json["linear"]), "{name} {x},{y}");
        }
    }
    let kinds: Vec<&str> = kinds.iter().map(|kind| &**kind).collect();
    assert_eq!(kinds, ["centre-alone", "edge", "mean", "one"]);
}

#[test]
fn tells_people_which_lines_matter() {
    let folder = Folder::new();
    let shadowing = "0  5 5 -1  3  1 1 1  1 1 1  1 1 1  0 1 0 0\n";
    let text =
        SMALL_SCENE.replacen("1\n", "# two objects\n2\n\n", 1) + "# in the way\n" + shadowing;
    folder.write("scene.txt", text);
    let run = folder.succeed(&["pixel", "scene.txt", "4,3", "0,0"]);
    let said = String::from_utf8(run.stdout).unwrap();
    for words in [
        "scene.txt, 8x6, pixel 4,3\n",
        "│  meets      the sphere of line 10, from outside, at t = 2.",
        "│  light      in the shadow of the sphere of line 12\n",
        "scene.txt, 8x6, pixel 0,0\n",
        "│  meets      nothing: the sky\n",
        " as rgb888\n",
    ] {
        assert!(said.contains(words), "{words}: {said}");
    }
}

#[test]
fn wrong_input_is_told() {
    let folder = Folder::new();
    folder.write("scene.txt", SMALL_SCENE);
    folder.write("bad.txt", "1 x");
    for (code, arguments, words) in [
        (2, &["pixel"][..], "<SCENE>"),
        (2, &["pixel", "scene.txt"], "<X,Y>"),
        (2, &["pixel", "scene.txt", "4"], "such as 80,60"),
        (2, &["pixel", "scene.txt", "-1,4"], "-1"),
        (2, &["pixel", "scene.txt", "4,99999"], "such as 80,60"),
        (
            2,
            &["pixel", "scene.txt", "8,0"],
            "there is no pixel 8,0: the picture is 8x6, its last pixel 7,5",
        ),
        (
            2,
            &["pixel", "scene.txt", "0,0", "0,6"],
            "there is no pixel 0,6",
        ),
        (3, &["pixel", "bad.txt", "0,0"], "bad.txt:1:3"),
        (
            4,
            &["pixel", "missing.txt", "0,0"],
            "cannot read missing.txt",
        ),
    ] {
        let said = folder.fail(code, arguments);
        assert!(said.contains(words), "{arguments:?}: {said}");
    }
}
