//! The listing of a scene: with the published digits, which `ask` prints, and with all that are stored.

use serde_json::{Value, json};

use crate::program::{Folder, SMALL_SCENE, scene};

/// The listing that `ask` prints of a scene's file.
#[track_caller]
fn published(folder: &Folder, name: &str) -> String {
    let run = folder.run_with_input(&["ask"], format!("0\n{name}\n").as_bytes());
    assert_eq!(run.code, 0, "{}", run.stderr);
    let said = String::from_utf8(run.stdout).unwrap();
    let (_, listing) = said.split_once("\nSCENE DATA\n").unwrap();
    let (listing, _) = listing.split_once("\n\n").unwrap();
    format!("SCENE DATA\n{listing}\n")
}

/// The listing of the published example, as published.
const DEFAULT_LISTING: &str = "\
SCENE DATA
Number of Objects: 7
Camera Position: (0.000000, 0.000000, 0.000000)
Image properties: 800x600
Light Source Direction: (50.000000, 50.000000, 0.000000)
Light Source Diffuse Colour: (1.000000, 1.000000, 1.000000)
Light Source Specular Colour: (1.000000, 1.000000, 1.000000)
Ambient Intensity: 0.100000
Use Sky Gradient Background (1-Yes; 0-No): 1
Background Colour: (0.500000, 0.500000, 1.000000)
SPHERE: centre(1.50, 1.00, 4.00), radius=0.50, diffuse(0.60, 0.10, 0.10), specular(0.50, 0.50, 0.50), ambient(1.00, 1.00, 1.00), reflection=0.20, shininess=50.00, refraction=0.00, indexOfRefraction=0.00
SPHERE: centre(0.00, 0.00, 2.50), radius=1.00, diffuse(0.10, 0.10, 0.10), specular(0.50, 0.50, 0.50), ambient(1.00, 1.00, 1.00), reflection=0.10, shininess=50.00, refraction=0.70, indexOfRefraction=1.50
SPHERE: centre(-2.50, 0.00, 4.50), radius=1.00, diffuse(0.10, 0.10, 0.60), specular(0.50, 0.50, 0.50), ambient(1.00, 1.00, 1.00), reflection=0.50, shininess=50.00, refraction=0.00, indexOfRefraction=0.00
SPHERE: centre(0.00, 2.50, 4.50), radius=1.00, diffuse(0.10, 0.10, 0.60), specular(0.50, 0.50, 0.50), ambient(1.00, 1.00, 1.00), reflection=0.50, shininess=50.00, refraction=0.00, indexOfRefraction=0.00
SPHERE: centre(-2.50, 0.00, -2.50), radius=1.00, diffuse(0.10, 0.10, 0.60), specular(0.50, 0.50, 0.50), ambient(1.00, 1.00, 1.00), reflection=0.50, shininess=50.00, refraction=0.00, indexOfRefraction=0.00
PLANE: normal(0.00, 1.00, 0.00), distance=1.00, diffuse(0.50, 0.50, 0.50), specular(0.10, 0.10, 0.10), ambient(1.00, 1.00, 1.00), reflection=0.30, shininess=50.00, refraction=0.00, indexOfRefraction=0.00
TRIANGLE: T1(2.00, 0.50, 2.50), T2(3.00, 0.50, 1.50), T3(2.50, 1.50, 2.00), normal(-0.71, 0.00, -0.71), distance=3.18, diffuse(0.80, 0.10, 0.20), specular(0.50, 0.50, 0.50), ambient(1.00, 1.00, 1.00), reflection=0.20, shininess=50.00, refraction=0.00, indexOfRefraction=0.00
";

#[test]
fn lists_the_published_example_as_published() {
    let folder = Folder::new();
    assert_eq!(published(&folder, &scene("default")), DEFAULT_LISTING);
    // The program has the same scene.
    let own = folder.succeed(&["inspect"]).stdout;
    assert!(own == folder.succeed(&["inspect", &scene("default")]).stdout);
}

#[test]
fn keeps_the_order_of_the_file_and_prints_no_minus_zero() {
    let folder = Folder::new();
    let material = "-0 0 0  0 0 0  0 0 0  0 1e6 0 0.001";
    let scene = format!(
        "3\n-0 -0.0000001 1\n8 6\n0 0 0 0 0 0 0 0 0\n0\n0\n.25 1.5 0\n\
         1  0 0 -2  -0  {material}\n\
         2  0 0 0  1 0 0  0 1 0  9 9 9 9  {material}\n\
         0  -0.004 -0.006 12345.678  .125  {material}\n"
    );
    folder.write("scene.txt", scene);
    let material = "diffuse(0.00, 0.00, 0.00), specular(0.00, 0.00, 0.00), ambient(0.00, 0.00, 0.00), \
                    reflection=0.00, shininess=1000000.00, refraction=0.00, indexOfRefraction=0.00";
    let expected = format!(
        "SCENE DATA\n\
         Number of Objects: 3\n\
         Camera Position: (0.000000, 0.000000, 1.000000)\n\
         Image properties: 8x6\n\
         Light Source Direction: (0.000000, 0.000000, 0.000000)\n\
         Light Source Diffuse Colour: (0.000000, 0.000000, 0.000000)\n\
         Light Source Specular Colour: (0.000000, 0.000000, 0.000000)\n\
         Ambient Intensity: 0.000000\n\
         Use Sky Gradient Background (1-Yes; 0-No): 0\n\
         Background Colour: (0.250000, 1.500000, 0.000000)\n\
         PLANE: normal(0.00, 0.00, -1.00), distance=0.00, {material}\n\
         TRIANGLE: T1(0.00, 0.00, 0.00), T2(1.00, 0.00, 0.00), T3(0.00, 1.00, 0.00), \
         normal(0.00, 0.00, -1.00), distance=0.00, {material}\n\
         SPHERE: centre(0.00, -0.01, 12345.68), radius=0.12, {material}\n"
    );
    assert_eq!(published(&folder, "scene.txt"), expected);
}

/// A scene with numbers that two decimals cut, f32 rounds, or that are 0 with a sign.
const PRECISE_SCENE: &str = "\
2
0 -0 1e-7
8 6
5 5 -5  1 1 1  1 1 1
0.1
0
0.3333333333333333 0 16777217
0  0.004 -12345.678 3  0.001  .8 .2 .2  .5 .5 .5  1 1 1  0 50 0 1.0001
2  0 0 0  1 0 0  0 1 0  9 9 9 9  .8 .2 .2  .5 .5 .5  1 1 1  0 50 0 0
";

#[test]
fn prints_what_is_stored() {
    let folder = Folder::new();
    folder.write("scene.txt", PRECISE_SCENE);
    let lines = |options: &[&str]| {
        let run = folder.succeed(&[&["inspect", "scene.txt"], options].concat());
        assert_eq!(run.stderr, "");
        let listing = String::from_utf8(run.stdout).unwrap();
        listing.lines().map(str::to_owned).collect::<Vec<_>>()
    };
    let single = lines(&[]);
    assert_eq!(single[2], "Camera Position: (0, -0, 1e-7)");
    assert_eq!(single[9], "Background Colour: (0.33333334, 0, 16777216)");
    assert_eq!(
        single[10],
        "SPHERE: centre(0.004, -12345.678, 3), radius=0.001, diffuse(0.8, 0.2, 0.2), \
         specular(0.5, 0.5, 0.5), ambient(1, 1, 1), reflection=0, shininess=50, refraction=0, \
         indexOfRefraction=1.0001"
    );
    let double = lines(&["--scalar", "f64"]);
    assert_eq!(
        double[9],
        "Background Colour: (0.3333333333333333, 0, 16777217)"
    );
}

#[test]
fn json_has_what_is_stored() {
    let folder = Folder::new();
    folder.write("scene.txt", PRECISE_SCENE);
    let run = folder.succeed(&["inspect", "scene.txt", "--json"]);
    let text = String::from_utf8(run.stdout).unwrap();
    assert!(
        text.contains("\"radius\":0.001,") && text.contains("0.33333334"),
        "{text}"
    );
    let json: Value = serde_json::from_str(&text).unwrap();
    assert_eq!(json["scalar"], "f32");
    assert_eq!((&json["width"], &json["height"]), (&json!(8), &json!(6)));
    assert_eq!(json["lights"][0]["position"], json!([5.0, 5.0, -5.0]));
    assert_eq!(json["sky"], false);
    let [sphere, triangle] = &json["objects"].as_array().unwrap()[..] else {
        panic!("{text}")
    };
    assert_eq!(sphere["kind"], "sphere");
    assert_eq!(sphere["material"]["index_of_refraction"], 1.0001);
    assert_eq!(triangle["kind"], "triangle");
    assert_eq!(triangle["vertices"][1], json!([1.0, 0.0, 0.0]));
    assert_eq!(triangle["normal"], json!([0.0, 0.0, -1.0]));
    let run = folder.succeed(&["inspect", "scene.txt", "--json", "--scalar", "f64"]);
    let json: Value = serde_json::from_slice(&run.stdout).unwrap();
    assert_eq!(json["background"][2], 16_777_217.0);
}

#[test]
fn lists_the_normalised_plane() {
    let folder = Folder::new();
    let plane = "1 0 2 0 3  0 0 0 0 0 0 0 0 0 0 0 0 0\n";
    let text = SMALL_SCENE.replacen('1', "2", 1) + plane;
    let run = folder.run_with_input(&["inspect", "-"], text.as_bytes());
    let listing = String::from_utf8(run.stdout).unwrap();
    assert!(
        listing.contains("PLANE: normal(0, 1, 0), distance=1.5, "),
        "{listing}"
    );
}
