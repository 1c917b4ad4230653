//! Parts, drawn anywhere, put together.

use std::process::Command;

use crate::program::{Folder, Picture, SMALL_SCENE, scene, tell};

/// Draws rows of a picture into files.
fn draw_parts(folder: &Folder, options: &[&str], parts: &[(&str, &str)]) {
    for (rows, file) in parts {
        folder.succeed(&[&["render"], options, &["--rows", rows, "-o", file]].concat());
    }
}

#[test]
fn parts_become_the_file_that_one_run_writes() {
    let folder = Folder::new();
    let path = scene("reflective");
    for color in [
        &[][..],
        &["--color", "gray4", "--dither"],
        &["--scalar", "f64"],
    ] {
        let options = [&[&*path, "--size", "40x31"], color].concat();
        let parts = [
            ("..1", "a.ppm"),
            ("12..30", "b.png"),
            ("1..12", "c.ppm"),
            ("30..", "d.png"),
        ];
        draw_parts(&folder, &options, &parts);
        for whole in ["whole.ppm", "whole.png", "whole.gif"] {
            folder.succeed(&[&["render", "-o", whole], &options[..]].concat());
            let joined = whole.replace("whole", "joined");
            folder.succeed(&["join", "d.png", "c.ppm", "a.ppm", "b.png", "-o", &joined]);
            assert!(
                folder.read(&joined) == folder.read(whole),
                "{whole} {color:?}"
            );
        }
        let run = folder.succeed(&["join", "a.ppm", "b.png", "c.ppm", "d.png", "-o", "-"]);
        assert!(run.stdout == folder.read("whole.ppm"));
        assert_eq!(
            run.stderr,
            format!(
                "Image written to standard output (40x31, {} bytes).\n",
                run.stdout.len()
            )
        );
    }
}

#[test]
fn a_turntable_is_joined_from_steps_and_rows() {
    let folder = Folder::new();
    folder.write("scene.txt", SMALL_SCENE);
    let turntable = [
        "render",
        "scene.txt",
        "--turntable",
        "3",
        "--size",
        "16x12",
        "-o",
    ];
    for whole in ["whole.gif", "whole.png", "whole.ppm"] {
        folder.succeed(&[&turntable[..], &[whole]].concat());
    }
    folder.succeed(&[&turntable[..], &["low.ppm", "--rows", "5.."]].concat());
    folder.succeed(
        &[
            &turntable[..],
            &["high.png", "--rows", "..5", "--steps", "0..2"],
        ]
        .concat(),
    );
    folder.succeed(
        &[
            &turntable[..],
            &["other.png", "--rows", "..5", "--steps", "2.."],
        ]
        .concat(),
    );
    let parts = [
        "low-000.ppm",
        "low-001.ppm",
        "low-002.ppm",
        "high-001.png",
        "high-000.png",
        "other-002.png",
    ];
    for extension in ["gif", "png", "ppm"] {
        let output = format!("joined.{extension}");
        folder.succeed(&[&["join", "-o", &output], &parts[..]].concat());
    }
    for name in ["000.png", "001.png", "002.png", "000.ppm", "002.ppm"] {
        let [joined, whole] = ["joined", "whole"].map(|n| folder.read(&format!("{n}-{name}")));
        assert!(joined == whole, "{name}");
    }
    assert!(folder.read("joined.gif") == folder.read("whole.gif"));
}

#[test]
fn what_does_not_fit_together_is_refused() {
    let folder = Folder::new();
    folder.write("scene.txt", SMALL_SCENE);
    // The same scene, written otherwise.
    folder.write(
        "same.txt",
        format!("# same\r\n{}", SMALL_SCENE.replace("8 6", "80 60")),
    );
    folder.write("other.txt", SMALL_SCENE.replace("0.1\n", "0.2\n"));
    let size = ["--size", "8x9"];
    let draw = |scene: &str, options: &[&str], rows: &str, file: &str| {
        draw_parts(
            &folder,
            &[&[scene], &size[..], options].concat(),
            &[(rows, file)],
        );
    };
    draw("scene.txt", &[], "0..3", "a.ppm");
    draw("same.txt", &[], "3..9", "b.ppm");
    draw("other.txt", &[], "3..9", "other.ppm");
    draw("scene.txt", &["--color", "rgb565"], "3..9", "color.ppm");
    draw("scene.txt", &["--max-depth", "4"], "3..9", "depth.ppm");
    draw("scene.txt", &["--scalar", "f64"], "3..9", "double.ppm");
    folder.write("copy.ppm", folder.read("a.ppm"));
    draw("scene.txt", &[], "5..7", "middle.ppm");
    draw("scene.txt", &[], "2..9", "early.png");
    draw(
        "scene.txt",
        &["--turntable", "2", "--steps", "1..2", "--about", "0,3"],
        "3..9",
        "turn.ppm",
    );
    draw_parts(&folder, &["scene.txt"], &[("3..6", "size.ppm")]);
    folder.succeed(&["render", "scene.txt", "-o", "whole.ppm"]);
    folder.succeed(&["join", "a.ppm", "b.ppm", "-o", "fine.ppm"]);
    let no_part_of = "is no part of the same picture as a.ppm: ";
    for (parts, words) in [
        (
            &["other.ppm"][..],
            &*format!("other.ppm {no_part_of}another scene, in its camera, light, "),
        ),
        (&["color.ppm"], "--color rgb565 instead of rgb888"),
        (&["depth.ppm"], "--max-depth 4 instead of 5"),
        (&["size.ppm"], "--size 8x6 instead of 8x9"),
        (
            &["turn-001.ppm"],
            "--turntable 2 instead of none, --about 0,3 instead of none",
        ),
        (
            &[],
            "rows 3..9 of rows 0..9 are missing; draw them, and join them with what is there:\n  scanray render SCENE --rows 3..9 --size 8x9 -o FILE\n",
        ),
        (
            &["middle.ppm"],
            "rows 3..5, rows 7..9 of rows 0..9 are missing",
        ),
        (
            &["early.png"],
            "rows 2..3 are both in a.ppm and in early.png",
        ),
        (
            &["b.ppm", "./a.ppm"],
            "a.ppm is given twice: leave it out once",
        ),
        (
            &["b.ppm", "copy.ppm"],
            "rows 0..3 are both in a.ppm and in copy.ppm",
        ),
        (
            &["double.ppm"],
            "as a.ppm: --scalar f64 instead of f32; draw both",
        ),
    ] {
        let said = folder.fail(2, &[&["join", "-o", "joined.ppm", "a.ppm"], parts].concat());
        assert!(said.contains(words), "{parts:?}: {said}");
    }
    let said = folder.fail(2, &["join", "turn-001.ppm", "-o", "turn.gif"]);
    assert!(
        said.contains("steps 0..1, rows 0..3 of steps 1..2 of rows 0..9 of steps 0..2 are missing"),
        "{said}"
    );
    for (part, words) in [
        ("missing.ppm", "cannot read missing.ppm: "),
        (
            "scene.txt",
            "cannot read scene.txt: this is neither a PNG nor a PPM picture",
        ),
        (
            "whole.ppm",
            "cannot join whole.ppm: it does not say which part",
        ),
    ] {
        let said = folder.fail(4, &["join", "-o", "joined.ppm", "a.ppm", part]);
        assert!(said.contains(words), "{said}");
    }
    // Cut off in the middle, and with other pixels than it says.
    let part = folder.read("b.ppm");
    folder.write("short.ppm", &part[..part.len() - 1]);
    let said = folder.fail(4, &["join", "a.ppm", "short.ppm", "-o", "joined.ppm"]);
    assert!(said.contains("short.ppm: the file ends before"), "{said}");
    let text = String::from_utf8_lossy(&part[..part.len() - 8 * 6 * 3]).replace("rows=3", "rows=4");
    folder.write(
        "forged.ppm",
        [text.as_bytes(), &part[part.len() - 8 * 6 * 3..]].concat(),
    );
    let said = folder.fail(4, &["join", "a.ppm", "forged.ppm", "-o", "joined.ppm"]);
    assert!(said.contains("it is 8x6 pixels instead of 8x5"), "{said}");
    assert!(
        folder
            .fail(2, &["join", "a.ppm"])
            .contains("--output <FILE>")
    );
    assert!(!folder.names().iter().any(|name| name.starts_with("joined")));
}

#[test]
fn what_is_missing_is_drawn_by_the_commands_that_are_told() {
    let folder = Folder::new();
    folder.write("scene.txt", SMALL_SCENE);
    let options = [
        "scene.txt",
        "--size",
        "16x12",
        "--color",
        "gray4",
        "--dither",
        "--samples",
        "4",
    ];
    let turntable = [&["render"], &options[..], &["--turntable", "6", "-o"]].concat();
    folder.succeed(&[&turntable[..], &["whole.gif"]].concat());
    folder.succeed(&[&turntable[..], &["a.ppm", "--steps", "1..2"]].concat());
    folder.succeed(
        &[
            &turntable[..],
            &["b.ppm", "--steps", "2..5", "--rows", "3..8"],
        ]
        .concat(),
    );
    let parts = ["a-001.ppm", "b-002.ppm", "b-003.ppm", "b-004.ppm"];
    let said = folder.fail(2, &[&["join", "-o", "joined.gif"], &parts[..]].concat());
    assert!(
        said.contains(
            "steps 0..1, rows 0..3 of steps 2..5, rows 8..12 of steps 2..5, steps 5..6 of"
        ),
        "{said}"
    );
    let mut all: Vec<String> = parts.map(str::to_owned).to_vec();
    for (index, command) in said.lines().skip(1).enumerate() {
        let words = command
            .trim()
            .strip_prefix("scanray render SCENE ")
            .unwrap();
        let words = words.strip_suffix(" -o FILE").unwrap();
        let folder_of_part = format!("part{index}");
        std::fs::create_dir(folder.path(&folder_of_part)).unwrap();
        let file = format!("{folder_of_part}/c.ppm");
        let arguments: Vec<&str> = words.split(' ').collect();
        folder.succeed(&[&["render", "scene.txt", "-o", &file], &arguments[..]].concat());
        for entry in std::fs::read_dir(folder.path(&folder_of_part)).unwrap() {
            all.push(entry.unwrap().path().to_str().unwrap().to_owned());
        }
    }
    assert_eq!(all.len(), 4 + 1 + 3 + 3 + 1);
    let all: Vec<&str> = all.iter().map(String::as_str).collect();
    folder.succeed(&[&["join", "-o", "joined.gif"], &all[..]].concat());
    assert!(folder.read("joined.gif") == folder.read("whole.gif"));
}

/// The scripts of docs/several-machines.md by the names in their comments, smaller than there.
fn script(name: &str) -> String {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/several-machines.md");
    let text = std::fs::read_to_string(path).unwrap();
    let mut blocks = text.split("```sh\n").skip(1);
    let block = blocks.find(|block| block.contains(&format!("# {name}\n")));
    let script = block.unwrap().split("```").next().unwrap();
    let scale = [
        ("width=3840", "width=64"),
        ("height=2160", "height=38"),
        ("rows=270", "rows=5"),
    ];
    let small = |script: String, (from, to): (&str, &str)| script.replace(from, to);
    scale.into_iter().fold(script.to_owned(), small)
}

/// Runs a script where `scanray` is in the path.
#[track_caller]
fn run_script(folder: &Folder, script: &str, variables: &[(&str, &str)]) {
    let program = folder.program(&[]);
    let bin = std::path::Path::new(program.get_program())
        .parent()
        .unwrap();
    let path = format!("{}:{}", bin.display(), std::env::var("PATH").unwrap());
    let run = Command::new("sh")
        .args(["-e", "-c", script])
        .current_dir(folder.path(""))
        .env("PATH", path)
        .envs(variables.iter().copied())
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&run.stderr);
    assert!(run.status.success(), "{script}\n{said}");
}

fn furnished() -> Folder {
    let folder = Folder::new();
    folder.write("scene.txt", std::fs::read(scene("pyramids")).unwrap());
    folder
}

#[test]
#[cfg(unix)]
fn the_job_array_draws_the_picture_of_one_machine() {
    let folder = furnished();
    for task in ["3", "1", "0", "2", "7", "6", "5", "4"] {
        run_script(
            &folder,
            &script("part.sh"),
            &[("SLURM_ARRAY_TASK_ID", task)],
        );
    }
    run_script(&folder, "scanray join part-*.ppm -o picture.png", &[]);
    folder.succeed(&["render", "scene.txt", "--size", "64x38", "-o", "whole.png"]);
    assert!(folder.read("picture.png") == folder.read("whole.png"));
}

#[test]
#[cfg(unix)]
fn gnu_parallel_draws_the_pictures_of_one_machine() {
    let is_installed = Command::new("sh")
        .args(["-c", "parallel --version | grep -q GNU"])
        .status();
    if !is_installed.is_ok_and(|status| status.success()) {
        tell("not run, because GNU parallel is not installed: several machines");
        return;
    }
    let folder = furnished();
    run_script(&folder, &script("picture.sh"), &[("HOSTS", ":")]);
    folder.succeed(&["render", "scene.txt", "--size", "64x38", "-o", "whole.png"]);
    assert!(folder.read("picture.png") == folder.read("whole.png"));
    let small = script("turntable.sh").replace("--display st7789", "--size 20x15");
    run_script(&folder, &small, &[("HOSTS", ":")]);
    folder.succeed(&[
        "render",
        "scene.txt",
        "--size",
        "20x15",
        "--turntable",
        "36",
        "-o",
        "whole.gif",
    ]);
    assert!(folder.read("turn.gif") == folder.read("whole.gif"));
}

#[test]
fn other_programs_read_the_parts() {
    let folder = Folder::new();
    folder.write("scene.txt", SMALL_SCENE);
    draw_parts(
        &folder,
        &["scene.txt"],
        &[("2..5", "part.ppm"), ("2..5", "part.png")],
    );
    let pixels = folder.ppm("part.ppm").rgb888;
    assert!(Picture::from_png(&folder.read("part.png")).rgb888 == pixels);
    // ImageMagick, netpbm, Python's Pillow.
    let mut readers = 0;
    for (program, arguments) in [
        ("convert", &["part.ppm", "-depth", "8", "rgb:-"][..]),
        ("convert", &["part.png", "-depth", "8", "rgb:-"]),
        ("ppmtoppm", &[]),
        (
            "python3",
            &[
                "-c",
                "import sys, PIL.Image as i; sys.stdout.buffer.write(i.open('part.ppm').tobytes())",
            ],
        ),
    ] {
        let input = std::fs::File::open(folder.path("part.ppm")).unwrap();
        let run = Command::new(program)
            .args(arguments)
            .current_dir(folder.path(""))
            .stdin(input)
            .output();
        match run {
            Ok(run) if run.status.success() => {
                assert!(run.stdout.ends_with(&pixels), "{program}");
                readers += 1;
            }
            _ => tell(&format!(
                "not tried, because {program} (or its library) is not installed: reading parts"
            )),
        }
    }
    tell(&format!("{readers} other programs have read the parts"));
}
