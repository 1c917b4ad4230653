//! A scene from all around.

use gif::{ColorOutput, DecodeOptions};
use serde_json::Value;

use crate::program::{Folder, Picture, scene};

/// A sphere, a triangle, a slanted plane and the light, seen from x = 0, z = −1.
const SCENE: &str = "\
3
0 1 -1
48 32
5 6 -2  1 1 1  1 1 1
0.3
1
0 0 0
0  0.5 0.5 2.5  0.5       .8 .2 .2  .5 .5 .5  .8 .2 .2  .3 50 0 0
2  -1 0 3  0 1.5 3.5  -1 1 4  0 0 0 0  .2 .8 .2  .5 .5 .5  .2 .8 .2  0 50 0 0
1  1 4 0  0               .2 .2 .8  .1 .1 .1  .2 .2 .8  .2 50 0 0
";

/// The same after a quarter of a turn about x = 0, z = 3: (x, z) becomes (z − 3, 3 − x).
const QUARTER: &str = "\
3
0 1 -1
48 32
-5 6 -2  1 1 1  1 1 1
0.3
1
0 0 0
0  -0.5 0.5 2.5  0.5      .8 .2 .2  .5 .5 .5  .8 .2 .2  .3 50 0 0
2  0 0 4  0.5 1.5 3  1 1 4  0 0 0 0  .2 .8 .2  .5 .5 .5  .2 .8 .2  0 50 0 0
1  0 4 -1  3              .2 .2 .8  .1 .1 .1  .2 .2 .8  .2 50 0 0
";

fn folder_with_scene() -> Folder {
    let folder = Folder::new();
    folder.write("scene.txt", SCENE);
    folder
}

#[test]
fn the_camera_circles_the_scene_and_its_light() {
    let folder = folder_with_scene();
    folder.write("quarter.txt", QUARTER);
    let turntable = ["render", "scene.txt", "--turntable", "4", "--about", "0,3"];
    let run = folder.succeed(&[&turntable[..], &["-o", "turn.png"]].concat());
    assert_eq!(
        run.stderr,
        format!(
            "Image files turn-000.png to turn-003.png saved (4 of 48x32, {} bytes).\n",
            (0..4)
                .map(|i| folder.read(&format!("turn-00{i}.png")).len())
                .sum::<usize>()
        )
    );
    assert_eq!(folder.names().len(), 2 + 4);
    let step = |i: usize| Picture::from_png(&folder.read(&format!("turn-00{i}.png")));
    // The first is the scene itself, to the bit.
    assert!(step(0) == folder.draw(&["scene.txt"]));
    // The second was computed by hand; the plane's normal is rounded in another order.
    let by_hand = folder.draw(&["quarter.txt"]);
    let turned = step(1);
    let pairs = || turned.rgb888.iter().zip(&by_hand.rgb888);
    let different = pairs().filter(|(a, b)| a.abs_diff(**b) > 1).count();
    assert!(different * 100 < by_hand.rgb888.len(), "{different}");
    assert!(step(1) != step(3) && step(0) != step(2));
}

#[test]
fn steps_by_themselves_are_those_of_the_whole_turn() {
    let folder = folder_with_scene();
    let turntable = ["render", "scene.txt", "--turntable", "5", "-o"];
    folder.succeed(&[&turntable[..], &["all.ppm"]].concat());
    folder.succeed(&[&turntable[..], &["some.ppm", "--steps", "2..4"]].concat());
    for name in ["002.ppm", "003.ppm"] {
        let [all, some] = ["all", "some"].map(|part| folder.read(&format!("{part}-{name}")));
        assert!(all == some);
    }
    assert_eq!(folder.names().len(), 1 + 5 + 2);
    // Standard output has them one after the other.
    let stdout = folder.succeed(&[&turntable[..], &["-"]].concat()).stdout;
    let mut rest = &stdout[..];
    for i in 0..5 {
        let (picture, behind) = Picture::first_of(rest);
        assert!(picture == folder.ppm(&format!("all-00{i}.ppm")));
        rest = behind;
    }
    assert_eq!(rest, b"");
}

/// The pictures of a GIF file, and how long each is shown.
fn pictures(file: &[u8]) -> Vec<(Picture, u16)> {
    let mut options = DecodeOptions::new();
    options.set_color_output(ColorOutput::RGBA);
    let mut decoder = options.read_info(file).unwrap();
    let mut pictures = Vec::new();
    while let Some(frame) = decoder.read_next_frame().unwrap() {
        let pixels = frame.buffer.chunks_exact(4);
        let picture = Picture {
            width: frame.width.into(),
            height: frame.height.into(),
            rgb888: pixels.flat_map(|p| [p[0], p[1], p[2]]).collect(),
        };
        pictures.push((picture, frame.delay));
    }
    pictures
}

#[test]
fn a_gif_file_holds_all_pictures() {
    let folder = folder_with_scene();
    for (display, is_exact) in [("ssd1306", true), ("ssd1327", true), ("ssd1351", false)] {
        let turntable = [
            "render",
            "scene.txt",
            "--turntable",
            "3",
            "--display",
            display,
        ];
        let run = folder.succeed(&[&turntable[..], &["--delay", "250"]].concat());
        assert!(
            run.stderr.contains("Image file output.gif saved"),
            "{}",
            run.stderr
        );
        assert!(run.stderr.contains(", 3 pictures, "), "{}", run.stderr);
        folder.succeed(&[&turntable[..], &["-o", "turn.ppm"]].concat());
        let drawn = pictures(&folder.read("output.gif"));
        assert_eq!(drawn.len(), 3);
        for (i, (picture, delay)) in drawn.iter().enumerate() {
            let exact = folder.ppm(&format!("turn-00{i}.ppm"));
            assert_eq!(*delay, 25);
            assert!(!is_exact || *picture == exact, "{display} {i}");
            let errors = picture.rgb888.iter().zip(&exact.rgb888);
            let sum: u64 = errors.map(|(a, b)| u64::from(a.abs_diff(*b))).sum();
            assert!(sum < 3 * exact.rgb888.len() as u64, "{display} {i}: {sum}");
        }
    }
    // One picture is a GIF file too.
    folder.succeed(&["render", "scene.txt", "--color", "gray8", "-o", "one.gif"]);
    let [(one, _)] = &pictures(&folder.read("one.gif"))[..] else {
        panic!("one picture");
    };
    assert!(*one == folder.draw(&["scene.txt", "--color", "gray8"]));
}

#[test]
fn the_axis_goes_through_what_is_in_view() {
    let folder = folder_with_scene();
    let turn = |arguments: &[&str]| {
        folder
            .succeed(
                &[
                    &["render", "--turntable", "2", "--size", "40x30"],
                    arguments,
                ]
                .concat(),
            )
            .stderr
    };
    // The glass sphere in the middle of the default scene is at 0,2.5; but about its centre the camera would pass through
    // another one.
    let said = turn(&[&scene("default")]);
    assert!(
        said.contains("turns about x = 0, z = 2.125 (--about 0,2.125).\n"),
        "{said}"
    );
    let by_default = folder.read("output.gif");
    assert!(!turn(&[&scene("default"), "--about", "0,2.125"]).contains("turns about"));
    assert!(folder.read("output.gif") == by_default);
    turn(&[&scene("default"), "--about", "-1,2.5"]);
    assert!(folder.read("output.gif") != by_default);
    // It is the scene's, whatever size is drawn.
    for size in [&["--size", "30x60"][..], &["--display", "ssd1331"]] {
        let run = folder.succeed(&[&["render", "--turntable", "1"], size].concat());
        assert!(run.stderr.contains("(--about 0,2.125)"), "{}", run.stderr);
    }
    // Nothing but sky.
    folder.write(
        "empty.txt",
        "0\n0 0 0\n8 6\n0 0 0 1 1 1 1 1 1\n0\n1\n0 0 0\n",
    );
    let said = folder.fail(2, &["render", "empty.txt", "--turntable", "2"]);
    assert!(said.contains("give --about X,Z"), "{said}");
    turn(&["empty.txt", "--about", "0,0"]);
}

#[test]
fn json_counts_the_pictures_of_a_file_together() {
    let folder = folder_with_scene();
    let report = |arguments: &[&str]| -> Vec<Value> {
        let run = folder.succeed(&[&["render", "scene.txt", "--json"], arguments].concat());
        let text = String::from_utf8(run.stdout).unwrap();
        text.lines()
            .map(|line| serde_json::from_str(line).unwrap())
            .collect()
    };
    let turntable = ["--turntable", "3", "--about", "0,3", "-o"];
    let [gif] = &report(&[&turntable[..], &["turn.gif"]].concat())[..] else {
        panic!("one file");
    };
    assert_eq!(gif["turntable"]["of"], 3);
    assert_eq!(gif["turntable"]["about"], serde_json::json!([0.0, 3.0]));
    assert_eq!(gif["rays"]["primary"], 3 * 48 * 32);
    assert_eq!(gif["bytes"], folder.read("turn.gif").len());
    let files = report(&[&turntable[..], &["turn.png"]].concat());
    let total = |report: &Value| report["rays"]["total"].as_u64().unwrap();
    assert_eq!(files.len(), 3);
    assert_eq!(files.iter().map(total).sum::<u64>(), total(gif));
    assert_eq!(files[2]["turntable"]["steps"]["start"], 2);
    assert_eq!(files[2]["file"], "turn-002.png");
    assert!(report(&["-o", "one.png"])[0].get("turntable").is_none());
}

#[test]
fn a_camera_that_leaves_the_room_is_told() {
    let folder = Folder::new();
    let turn = |name: &str, about: &[&str]| {
        let turntable = ["render", "--turntable", "8", "--size", "8x6", name];
        folder.succeed(&[&turntable[..], about].concat()).stderr
    };
    for (name, about, places, on_the_spot) in [
        (
            "mirror-room",
            "0.05865,1.5",
            "after step 1 (line 15), after step 4 (lines 14, 15), after step 6 (line 14)",
            "0,-1.3",
        ),
        (
            "window-room",
            "0.24,1.5",
            "after step 2 (line 34), after step 5 (line 38)",
            "0.2,-1.6",
        ),
        // Into the sphere and out of it.
        (
            "default",
            "0,2.5",
            "after step 4 (line 10), after step 5 (line 10)",
            "0,0",
        ),
    ] {
        let said = turn(&scene(name), &["--about", about]);
        let words = format!(
            "{name}.txt: the camera passes through objects: {places}. Turn about another axis, or on the spot: --about \
             {on_the_spot}\n"
        );
        assert!(said.contains(&words), "{said}");
        let said = turn(&scene(name), &["--about", on_the_spot]);
        assert!(!said.contains("the camera"), "{said}");
        // An axis that is not given is one that the camera finds its way around.
        let said = turn(&scene(name), &[]);
        assert!(!said.contains("the camera"), "{said}");
    }
    for name in ["pyramids", "reflective"] {
        let said = turn(&scene(name), &[]);
        assert!(!said.contains("the camera"), "{said}");
    }
    // A wall that is all there is in view: what turns about it passes through it.
    folder.write(
        "wall.txt",
        "1\n0 0 0\n9 7\n0 0 0 1 1 1 1 1 1\n1\n0\n0 0 0\n\
         1 0 0 -1 1 .5 .5 .5 0 0 0 1 1 1 0 1 0 0\n",
    );
    let said = turn("wall.txt", &[]);
    assert!(said.contains("(--about 0,1).\n"), "{said}");
    assert!(
        said.contains("the camera passes through objects: "),
        "{said}"
    );
}
