//! Pictures.

use serde_json::Value;

use crate::program::{Folder, Picture, SMALL_SCENE, scene};

#[test]
fn alone_draws_the_default_scene_in_any_folder() {
    let folder = Folder::new();
    let run = folder.succeed(&[]);
    let picture = folder.ppm("output.ppm");
    assert_eq!((picture.width, picture.height), (800, 600));
    assert_eq!(run.stdout, b"");
    let last_line = run.stderr.lines().last().unwrap();
    assert_eq!(
        last_line,
        "Image file output.ppm saved (800x600, 1440015 bytes)."
    );
    assert_eq!(folder.names(), ["output.ppm"]);
    // The default scene is that of the repository.
    folder.succeed(&["render", &scene("default"), "-o", "again.ppm"]);
    assert!(folder.read("again.ppm") == folder.read("output.ppm"));
    // There is a sky above, whose zenith is bluer than its horizon.
    let pixel = |x: usize, y: usize| &picture.rgb888[3 * (y * 800 + x)..][..3];
    assert!(pixel(10, 0)[0] < pixel(10, 250)[0]);
    assert_eq!(pixel(10, 0)[2], 255);
}

#[test]
fn png_and_standard_output_have_the_pixels_of_the_ppm() {
    let folder = Folder::new();
    let arguments = [&scene("pyramids"), "--size", "70x50"];
    let ppm = folder.draw(&arguments);
    folder.succeed(&[&["render", "-o", "drawn.PNG"], &arguments[..]].concat());
    assert!(Picture::from_png(&folder.read("drawn.PNG")) == ppm);
    assert_eq!((ppm.width, ppm.height), (70, 50));
    let run = folder.succeed(&[&["render", "-o", "-"], &arguments[..]].concat());
    assert!(Picture::from_ppm(&run.stdout) == ppm);
    assert!(run.stderr.ends_with("(70x50, 10513 bytes).\n"));
}

#[test]
fn reads_a_scene_from_standard_input() {
    let folder = Folder::new();
    folder.write("small.txt", SMALL_SCENE);
    let drawn = folder.draw(&["small.txt"]);
    let run = folder.run_with_input(&["render", "-", "-o", "-"], SMALL_SCENE.as_bytes());
    assert_eq!(run.code, 0);
    assert_eq!(Picture::from_ppm(&run.stdout), drawn);
}

#[test]
fn the_number_of_threads_does_not_show() {
    let folder = Folder::new();
    for size in ["61x43", "1x1", "3x64"] {
        let draw = |threads| {
            let dithered = ["--color", "rgb565", "--dither", "--threads", threads];
            folder.draw(&[&[&scene("window-room"), "--size", size], &dithered[..]].concat())
        };
        let one = draw("1");
        for threads in ["2", "3", "7"] {
            assert!(draw(threads) == one, "{size} {threads}");
        }
    }
}

#[test]
fn rows_are_those_of_the_whole_picture() {
    let folder = Folder::new();
    let options = ["--size", "40x31", "--color", "gray4", "--dither"];
    let whole = folder.draw(&options);
    let mut joined = Vec::new();
    for (rows, count) in [("..1", 1), ("1..12", 11), ("12..30", 18), ("30..", 1)] {
        let part = folder.draw(&[&options[..], &["--rows", rows]].concat());
        assert_eq!((part.width, part.height), (40, count));
        joined.extend(part.rgb888);
    }
    assert!(joined == whole.rgb888);
    let run = folder.succeed(&["render", "--rows", "10..30", "--size", "4x60"]);
    let last_line = run.stderr.lines().last().unwrap();
    let bytes = folder.read("output.ppm").len();
    assert_eq!(
        last_line,
        format!("Image file output.ppm saved (4x20, rows 10..30 of 60, {bytes} bytes).")
    );
}

#[test]
fn a_picture_of_several_parts_is_the_same() {
    // 26 million pixels are more than are drawn at once.
    let folder = Folder::new();
    folder.write(
        "empty.txt",
        "0\n0 0 0\n400 65535\n1 1 1 1 1 1 1 1 1\n0\n1\n0 0 0\n",
    );
    let whole = folder.draw(&["empty.txt"]);
    assert_eq!((whole.width, whole.height), (400, 65_535));
    // 2²⁴ pixels are 41,943 rows and a piece of one.
    let seam = folder.draw(&["empty.txt", "--rows", "41900..42000"]);
    let row = 3 * 400;
    assert!(whole.rgb888[41_900 * row..42_000 * row] == seam.rgb888);
    // The sky gets bluer all the way up.
    let reds: Vec<u8> = whole.rgb888.chunks(row).map(|row| row[0]).collect();
    assert!(reds.is_sorted() && reds[0] < reds[65_534]);
}

#[test]
fn colours_are_those_of_the_display() {
    let folder = Folder::new();
    let exact = folder.draw(&["--size", "64x48"]);
    let expanded = |levels: u16| -> Vec<u8> {
        let expand = |level| ((level * 255 + levels / 2) / levels) as u8;
        (0..=levels).map(expand).collect()
    };
    for (color, levels) in [
        ("rgb888", vec![255]),
        ("rgb666", vec![63]),
        ("rgb565", vec![31, 63]),
        ("rgb555", vec![31]),
        ("bgr888", vec![255]),
        ("bgr666", vec![63]),
        ("bgr565", vec![31, 63]),
        ("bgr555", vec![31]),
        ("gray8", vec![255]),
        ("gray4", vec![15]),
        ("gray2", vec![3]),
        ("binary", vec![1]),
    ] {
        for dither in [&[][..], &["--dither"]] {
            let options = [&["--size", "64x48", "--color", color], dither].concat();
            let picture = folder.draw(&options);
            let possible: Vec<u8> = levels.iter().flat_map(|l| expanded(*l)).collect();
            let levels_drawn = picture.levels();
            assert!(levels_drawn.len() > 1, "{color}");
            assert!(
                levels_drawn.iter().all(|level| possible.contains(level)),
                "{color}: {levels_drawn:?}"
            );
            let is_gray = picture
                .rgb888
                .chunks(3)
                .all(|p| p[0] == p[1] && p[1] == p[2]);
            assert_eq!(
                is_gray,
                color.starts_with('g') || color == "binary",
                "{color}"
            );
            // Half a step of the coarsest channel apart, a whole one with dither.
            if !is_gray {
                let steps = if dither.is_empty() { 2 } else { 1 };
                let most = 255 / levels[0] / steps + 1;
                let differences = exact.rgb888.iter().zip(&picture.rgb888);
                let largest = differences.map(|(a, b)| a.abs_diff(*b)).max();
                assert!(largest <= Some(most as u8), "{color}: {largest:?}");
            }
        }
    }
    let bgr = folder.draw(&["--size", "64x48", "--color", "bgr565"]);
    assert!(bgr == folder.draw(&["--size", "64x48", "--color", "rgb565"]));
}

#[test]
fn dither_shows_shades_that_the_display_has_not() {
    let folder = Folder::new();
    let options = ["--size", "64x48", "--color", "binary"];
    let plain = folder.draw(&options);
    let dithered = folder.draw(&[&options[..], &["--dither"]].concat());
    let gray = folder.draw(&["--size", "64x48", "--color", "gray8"]);
    let mean = |picture: &Picture| {
        let sum: u64 = picture.rgb888.iter().map(|level| u64::from(*level)).sum();
        sum as f64 / picture.rgb888.len() as f64
    };
    assert!((mean(&dithered) - mean(&gray)).abs() < 2.0);
    assert!((mean(&plain) - mean(&gray)).abs() > 5.0);
}

#[test]
fn single_and_double_precision_differ_by_rounding_alone() {
    let folder = Folder::new();
    let single = folder.draw(&["--size", "80x60"]);
    let double = folder.draw(&["--size", "80x60", "--scalar", "f64"]);
    let pairs = || single.rgb888.iter().zip(&double.rgb888);
    let far = pairs().filter(|(a, b)| a.abs_diff(**b) > 1).count();
    assert!(far * 200 < single.rgb888.len(), "{far}");
}

#[test]
fn max_depth_0_shows_no_mirror_images() {
    let folder = Folder::new();
    let draw = |depth| folder.draw(&["--size", "80x60", "--max-depth", depth]);
    assert!(draw("0") != draw("1"));
    assert!(draw("5") == folder.draw(&["--size", "80x60"]));
    assert!(draw("32") != draw("1"));
}

#[test]
fn json_tells_what_the_picture_took() {
    let folder = Folder::new();
    let run = folder.succeed(&["render", "--json", "--size", "50x40", "--threads", "2"]);
    let text = String::from_utf8(run.stdout).unwrap();
    assert_eq!(text.lines().count(), 1);
    let report: Value = serde_json::from_str(&text).unwrap();
    let number = |path: &str| report.pointer(path).and_then(Value::as_u64).unwrap();
    assert_eq!(report["file"], "output.ppm");
    assert_eq!(number("/bytes"), 6013);
    assert_eq!((number("/size/width"), number("/size/height")), (50, 40));
    assert_eq!((number("/rows/start"), number("/rows/end")), (0, 40));
    assert_eq!(report["scalar"], "f32");
    assert_eq!(report["color"], "rgb888");
    assert_eq!(report["dither"], false);
    assert_eq!(number("/max_depth"), 5);
    assert_eq!(number("/threads"), 2);
    assert!(report["seconds"].as_f64().unwrap() > 0.0);
    assert_eq!(number("/rays/primary"), 50 * 40);
    let sum = |group: &str, names: &[&str]| -> u64 {
        let number_of = |name: &&str| number(&format!("/{group}/{name}"));
        names.iter().map(number_of).sum()
    };
    let rays = ["primary", "reflected", "refracted", "shadow"];
    assert_eq!(number("/rays/total"), sum("rays", &rays));
    assert!(rays.iter().all(|kind| number(&format!("/rays/{kind}")) > 0));
    let tests = ["sphere", "plane", "triangle", "other", "box"];
    assert_eq!(number("/tests/total"), sum("tests", &tests));
    assert!(number("/tests/sphere") > 0);
    for core in ["M4F", "M3", "M0"] {
        let predicted = &report["predicted_instructions_per_pixel"][core];
        assert!(predicted.as_f64().unwrap() > 100.0, "{core}");
        assert!((1..100).contains(&number(&format!("/predicted_within_percent/{core}"))));
    }
    for (pool, used) in [
        ("spheres", 5),
        ("planes", 1),
        ("triangles", 1),
        ("materials", 5),
        ("lights", 1),
    ] {
        let value = |key: &str| number(&format!("/pools/{pool}/{key}"));
        assert_eq!(value("used"), used, "{pool}");
        assert!(value("capacity") >= used);
        assert_eq!(
            value("bytes") * value("capacity"),
            value("capacity_bytes") * used
        );
    }
    // Rows by themselves take what they take in the whole.
    let total = |rows| {
        let run = folder.succeed(&["render", "--json", "--size", "50x40", "--rows", rows]);
        let report: Value = serde_json::from_slice(&run.stdout).unwrap();
        report["rays"]["total"].as_u64().unwrap()
    };
    assert_eq!(total("0..13") + total("13..40"), number("/rays/total"));
}

#[test]
fn several_scenes_become_several_files() {
    let folder = Folder::new();
    let scenes = [scene("default"), scene("reflective")];
    let arguments = ["render", &scenes[0], &scenes[1], "--size", "20x15"];
    let run = folder.succeed(&[&arguments[..], &["--json"]].concat());
    assert_eq!(folder.names(), ["default.ppm", "reflective.ppm"]);
    assert_eq!(String::from_utf8(run.stdout).unwrap().lines().count(), 2);
    std::fs::create_dir(folder.path("pictures")).unwrap();
    folder.succeed(&[&arguments[..], &["-o", "pictures"]].concat());
    for name in ["default.ppm", "reflective.ppm"] {
        assert!(folder.read(name) == folder.read(&format!("pictures/{name}")));
    }
    folder.succeed(&[
        "render",
        "-o",
        "pictures",
        &scene("pyramids"),
        "--size",
        "4x3",
    ]);
    assert_eq!(folder.ppm("pictures/pyramids.ppm").width, 4);
}

#[test]
fn verbose_prints_the_scene_data_too() {
    let folder = Folder::new();
    let listing = folder.succeed(&["inspect"]).stdout;
    let size = ["--size", "4x3"];
    let run = folder.succeed(&[&["render", "--verbose"], &size[..]].concat());
    assert_eq!(run.stdout, listing);
    // Where standard output is taken by data, it is for the eyes alone.
    let run = folder.succeed(&[&["render", "--verbose", "-o", "-"], &size[..]].concat());
    assert_eq!(Picture::from_ppm(&run.stdout).width, 4);
    assert!(run.stderr.contains(&String::from_utf8(listing).unwrap()));
}
