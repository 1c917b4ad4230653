//! Comparing pictures.

use serde_json::Value;

use crate::program::{Folder, Picture, SMALL_SCENE, scene};

/// A P6 file of 4×2 pixels, all black but the last, whose green is this.
fn picture(green: u8) -> Vec<u8> {
    let mut file = b"P6\n4 2\n255\n".to_vec();
    file.extend([0; 22]);
    file.extend([green, 0]);
    file
}

#[test]
fn the_exit_code_tells_whether_the_tolerance_holds() {
    let folder = Folder::new();
    folder.write("a.ppm", picture(0));
    folder.write("b.ppm", picture(3));
    for (arguments, code) in [
        (&["diff", "a.ppm", "a.ppm"][..], 0),
        (&["diff", "a.ppm", "b.ppm"], 1),
        (&["diff", "b.ppm", "a.ppm", "--tolerance", "2"], 1),
        (&["diff", "b.ppm", "a.ppm", "--tolerance", "3"], 0),
    ] {
        let run = folder.run(arguments);
        assert_eq!((run.code, &*run.stderr), (code, ""), "{arguments:?}");
        let said = String::from_utf8(run.stdout).unwrap();
        assert!(said.starts_with("size      4x2\n"), "{said}");
    }
    let run = folder.run(&["diff", "a.ppm", "b.ppm", "--tolerance", "1"]);
    let said = String::from_utf8(run.stdout).unwrap();
    for line in [
        "different 1 of 8 pixels (12.500 %)\n",
        "beyond    1 pixels (12.500 %) differ by more than 1\n",
        "maximum   3 of 255 (first at 3,1)\n",
        "RMSE      0.6124 of 255\n",
        "PSNR      52.39 dB\n",
    ] {
        assert!(said.contains(line), "{said}");
    }
}

#[test]
fn json_has_all_measures() {
    let folder = Folder::new();
    let render = |file: &str, depth: &str| {
        let settings = ["--size", "80x60", "--max-depth", depth];
        folder.succeed(&[&["render", &scene("reflective"), "-o", file], &settings[..]].concat());
    };
    render("a.png", "5");
    render("b.ppm", "1");
    let run = folder.run(&["diff", "a.png", "b.ppm", "--json", "--tolerance", "9"]);
    assert_eq!(run.code, 1);
    let json: Value = serde_json::from_slice(&run.stdout).unwrap();
    // The measures of pictures that are read again here.
    folder.succeed(&[
        "render",
        &scene("reflective"),
        "-o",
        "a.ppm",
        "--size",
        "80x60",
    ]);
    let (a, b) = (folder.ppm("a.ppm"), folder.ppm("b.ppm"));
    let differences: Vec<u8> = a
        .rgb888
        .iter()
        .zip(&b.rgb888)
        .map(|(a, b)| a.abs_diff(*b))
        .collect();
    let of_pixels: Vec<u8> = differences
        .chunks(3)
        .map(|c| *c.iter().max().unwrap())
        .collect();
    let beyond = |tolerance| of_pixels.iter().filter(|d| **d > tolerance).count();
    assert_eq!(json["different"], beyond(0));
    assert_eq!(json["beyond_tolerance"], beyond(9));
    assert_eq!(json["maximum"], *of_pixels.iter().max().unwrap());
    assert_eq!(
        (&json["width"], &json["height"], &json["pixels"]),
        (&80.into(), &60.into(), &4800.into())
    );
    let squares: f64 = differences.iter().map(|d| f64::from(*d).powi(2)).sum();
    let rmse = (squares / differences.len() as f64).sqrt();
    assert!((json["rmse"].as_f64().unwrap() - rmse).abs() < 1e-9);
    assert!((json["psnr"].as_f64().unwrap() - 20.0 * (255.0 / rmse).log10()).abs() < 1e-9);
    assert!((0.001..0.9).contains(&json["flip"].as_f64().unwrap()));
    let run = folder.run(&["diff", "a.png", "a.ppm", "--json"]);
    let json: Value = serde_json::from_slice(&run.stdout).unwrap();
    assert_eq!(
        (&json["psnr"], &json["flip"], &json["maximum_at"]),
        (&Value::Null, &0.0.into(), &Value::Null)
    );
    assert_eq!(run.code, 0);
}

#[test]
fn the_picture_shows_where() {
    let folder = Folder::new();
    folder.write("a.ppm", picture(0));
    folder.write("b.ppm", picture(200));
    for map in ["levels", "flip"] {
        let run = folder.run(&["diff", "a.ppm", "b.ppm", "-o", "diff.ppm", "--map", map]);
        assert_eq!(
            (run.code, &*run.stderr),
            (1, "Picture of the differences: diff.ppm\n")
        );
        let shown = folder.ppm("diff.ppm");
        let pixel = |x: usize, y: usize| &shown.rgb888[(y * shown.width + x) * 3..][..3];
        assert_ne!(pixel(3, 1), [0; 3]);
        // FLIP sees the neighbours of a bright pixel, but the levels do not.
        assert!(map == "flip" || pixel(2, 1) == [0; 3]);
        assert!(shown.width > 4 && shown.height > 2, "the legend");
    }
    let run = folder.run(&["diff", "a.ppm", "b.ppm", "-o", "-"]);
    assert_eq!(run.code, 1);
    Picture::from_ppm(&run.stdout);
    assert!(run.stderr.contains("maximum   200"), "{}", run.stderr);
}

#[test]
fn reads_one_picture_from_standard_input() {
    let folder = Folder::new();
    folder.write("a.ppm", picture(0));
    let run = folder.run_with_input(&["diff", "a.ppm", "-"], &picture(0));
    assert_eq!((run.code, &*run.stderr), (0, ""));
    let said = folder.fail(2, &["diff", "-", "-"]);
    assert!(said.contains("give a file for the other"), "{said}");
}

#[test]
fn wrong_input_is_told() {
    let folder = Folder::new();
    folder.write("a.ppm", picture(0));
    folder.write("wide.ppm", b"P6 8 1 255\n                        ");
    folder.write("cut.ppm", &picture(0)[..20]);
    folder.write("text.png", "text");
    for (code, arguments, words) in [
        (
            2,
            &["diff", "a.ppm", "wide.ppm"][..],
            "a.ppm is 4x2, wide.ppm is 8x1; draw both with the same --size",
        ),
        (2, &["diff", "a.ppm"], "<B>"),
        (
            2,
            &["diff", "a.ppm", "a.ppm", "--tolerance", "256"],
            "a whole number from 0 to 255",
        ),
        (
            2,
            &["diff", "a.ppm", "a.ppm", "--tolerance", "-1"],
            "a whole number from 0 to 255",
        ),
        (
            2,
            &["diff", "a.ppm", "a.ppm", "--pixels-per-degree", "0"],
            "from 1 to 1000",
        ),
        (
            2,
            &["diff", "a.ppm", "a.ppm", "--map", "flip"],
            "--output <FILE>",
        ),
        (
            2,
            &["diff", "a.ppm", "a.ppm", "-o", "a.gif"],
            "-o a.gif: the name must end in .ppm or .png",
        ),
        (
            2,
            &["diff", "a.ppm", "a.ppm", "-o", "a.jpg"],
            "-o a.jpg: the name must end in .ppm or .png",
        ),
        (
            2,
            &["diff", "a.ppm", "a.ppm", "-o", "-", "--json"],
            "name a file with -o",
        ),
        (
            4,
            &["diff", "a.ppm", "missing.png"],
            "cannot read missing.png: ",
        ),
        (
            4,
            &["diff", "a.ppm", "cut.ppm"],
            "cannot read cut.ppm: the file ends before",
        ),
        (
            4,
            &["diff", "text.png", "a.ppm"],
            "text.png: this is neither a PNG nor a PPM picture",
        ),
    ] {
        let said = folder.fail(code, arguments);
        assert!(said.contains(words), "{arguments:?}: {said}");
    }
    assert_eq!(folder.names(), ["a.ppm", "cut.ppm", "text.png", "wide.ppm"]);
}

#[test]
fn the_output_is_never_an_input() {
    let folder = Folder::new();
    folder.write("scene.txt", SMALL_SCENE);
    folder.succeed(&["render", "scene.txt", "-o", "a.png"]);
    folder.succeed(&["render", "scene.txt", "-o", "b.png"]);
    folder.succeed(&["render", "scene.txt", "-o", "part.ppm", "--rows", "0..6"]);
    let before = folder.read("b.png");
    let said = folder.fail(2, &["diff", "a.png", "b.png", "-o", "./b.png"]);
    assert!(said.contains("overwrite"), "{said}");
    assert!(folder.read("b.png") == before);
    let said = folder.fail(2, &["join", "part.ppm", "-o", "part.ppm"]);
    assert!(said.contains("overwrite"), "{said}");
}
