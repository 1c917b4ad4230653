//! What a scene asks of a device.

use serde_json::Value;

use crate::program::{Folder, SMALL_SCENE, scene};

#[test]
fn names_stages_sizes_and_a_line_for_firmware() {
    let folder = Folder::new();
    folder.write("scene.txt", SMALL_SCENE);
    let run = folder.succeed(&["needs", "scene.txt", "--display", "ssd1306"]);
    let said = String::from_utf8(run.stdout).unwrap();
    for words in [
        "scene.txt: 1 object\nstages: spheres, light, shadows, specular, sky\n",
        "row of 128 binary",
        "\nlet mut pools: ScenePools<f32, 1, 0, 0, 1, 1, 1> = ScenePools::new();\n\
         let tracer = Tracer::new(pools.as_scene());\n",
    ] {
        assert!(said.contains(words), "{words}: {said}");
    }
    // A pool without entries is no line of the table.
    assert!(!said.contains("\nplanes"), "{said}");
}

#[test]
fn a_cutoff_takes_stack_too() {
    let folder = Folder::new();
    folder.write("scene.txt", SMALL_SCENE);
    let arguments = ["needs", "scene.txt", "--cutoff", "1/64", "--max-depth", "3"];
    let said = String::from_utf8(folder.succeed(&arguments).stdout).unwrap();
    // A length and three factors.
    assert!(
        said.contains("\ncut-off                            16  "),
        "{said}"
    );
    assert!(said.contains(".with_cutoff(0.015625);\n"), "{said}");
    let without = folder.succeed(&["needs", "scene.txt"]).stdout;
    assert!(!String::from_utf8(without).unwrap().contains("cut-off"));
}

#[test]
fn json_adds_up() {
    let folder = Folder::new();
    let run = folder.succeed(&["needs", &scene("default"), "--json"]);
    let json: Value = serde_json::from_slice(&run.stdout).unwrap();
    let number = |value: &Value| value.as_u64().unwrap();
    let pools = json["pools"].as_array().unwrap();
    let mut sum = number(&json["settings"]);
    for pool in pools {
        assert_eq!(
            number(&pool["bytes"]),
            number(&pool["entries"]) * number(&pool["bytes_each"])
        );
        // Each pool has a length of 4 bytes.
        sum += number(&pool["bytes"]) + 4;
    }
    // Whether all lights are off all surfaces, aligned.
    sum += 4;
    assert_eq!(number(&json["scene_pools"]), sum);
    assert_eq!(json["pools_type"], "ScenePools<f32, 5, 1, 1, 5, 1, 7>");
    assert_eq!(json["rows"][2]["color"], "rgb565");
    assert_eq!(json["rows"][2]["bytes"], 1600);
    // The frames and the rays that wait have a length of 4 bytes each.
    assert_eq!(number(&json["stack"]), 5 * number(&json["stack_frame"]) + 8);
}

#[test]
fn wrong_input_is_told() {
    let folder = Folder::new();
    folder.write("bad.txt", "1 x");
    for (code, arguments, words) in [
        (2, &["needs", "--display", "vga"][..], "ssd1306"),
        (
            2,
            &["needs", "--max-depth", "33"],
            "from 0 (no mirror rays) to 32",
        ),
        (3, &["needs", "bad.txt"], "bad.txt:1:3"),
        (4, &["needs", "missing.txt"], "cannot read missing.txt"),
    ] {
        let said = folder.fail(code, arguments);
        assert!(said.contains(words), "{arguments:?}: {said}");
    }
}
