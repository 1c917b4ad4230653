//! `scanray report`.

use std::io::Write as _;

use crate::program::{Folder, Run, SMALL_SCENE};

#[test]
fn writes_page_markdown_csv_and_json() {
    let folder = Folder::new();
    folder.write("a.txt", SMALL_SCENE);
    folder.write("b.txt", SMALL_SCENE.replace(".8 .2 .2", ".2 .2 .8"));
    folder.succeed(&["report", "a.txt", "b.txt", "-o", "out", "--size", "12x9"]);
    let text = |name: &str| String::from_utf8(folder.read(&format!("out/{name}"))).unwrap();

    let json: serde_json::Value = serde_json::from_str(&text("report.json")).unwrap();
    let scenes = json["scenes"].as_array().unwrap();
    assert_eq!(scenes.len(), 2);
    for scene in scenes {
        assert_eq!(scene["size"], serde_json::json!([12, 9]));
        let configurations = scene["configurations"].as_array().unwrap();
        let knobs = scene["knobs"].as_array().unwrap();
        assert_eq!(knobs.len(), 14);
        for knob in knobs {
            let points = knob["points"].as_array().unwrap();
            assert!(points.len() > 1 || knob["core"].is_string(), "{knob}");
            for point in points {
                let index = point[1].as_u64().unwrap() as usize;
                assert!(index < configurations.len());
            }
        }
        let on_front = configurations
            .iter()
            .filter(|c| c["verdict"] == "pareto-front")
            .count();
        assert!(on_front > 0);
    }

    let csv = text("report.csv");
    let width = csv.lines().next().unwrap().split(',').count();
    let configurations = scenes[0]["configurations"].as_array().unwrap().len();
    assert_eq!(csv.lines().count(), 1 + 2 * configurations);
    assert!(width > 20);
    // Names of several settings are quoted, for their commas.
    for record in csv.lines().filter(|line| !line.contains('"')) {
        assert_eq!(record.split(',').count(), width, "{record}");
    }
    let place = |name| {
        csv.lines()
            .next()?
            .split(',')
            .position(|field| field == name)
    };
    let depth_1 = csv.lines().find(|line| line.starts_with("a,depth 1,"));
    let value = |name| depth_1?.split(',').nth(place(name)?);
    assert_eq!(
        ["max_depth", "cutoff", "power", "color", "dither"].map(value),
        ["1", "0.0", "squaring", "rgb888", "false"].map(Some)
    );
    let settings = &scenes[0]["configurations"][0]["settings"];
    assert_eq!(settings.as_object().unwrap().len(), 10);

    let markdown = text("report.md");
    let page = text("index.html");
    for name in ["a", "b"] {
        assert!(markdown.contains(&format!("## {name} (12×9)")));
        assert!(page.contains(&format!("<section id=\"scene-{name}\">")));
    }
    for plot in markdown.lines().filter(|line| line.starts_with("![")) {
        let (_, file) = plot.rsplit_once('(').unwrap();
        let svg = text(file.trim_end_matches(')'));
        assert!(
            svg.starts_with("<svg ") && svg.ends_with("</svg>\n"),
            "{plot}"
        );
    }
    for word in [
        "max depth",
        "cut-off",
        "samples a pixel",
        "R2: f64",
        "Dominated",
        "Failed",
    ] {
        assert!(page.contains(word), "{word}");
    }
}

#[test]
fn scenes_of_one_name_stay_apart() {
    let folder = Folder::new();
    for (name, red) in [("x y/a.txt", "1"), ("z/a.txt", ".5"), ("method.txt", ".2")] {
        std::fs::create_dir_all(folder.path(name).parent().unwrap()).unwrap();
        folder.write(name, SMALL_SCENE.replace(".8 .2 .2", &format!("{red} 0 0")));
    }
    folder.succeed(&[
        "report",
        "x y/a.txt",
        "z/a.txt",
        "z/a.txt",
        "method.txt",
        "-o",
        "out",
        "--size",
        "4x3",
    ]);
    let text = |name: &str| String::from_utf8(folder.read(&format!("out/{name}"))).unwrap();
    let (markdown, page) = (text("report.md"), text("index.html"));
    let mut ids: Vec<_> = page.split("<section id=\"").skip(1).collect();
    ids.iter_mut()
        .for_each(|rest| *rest = rest.split_once('"').unwrap().0);
    assert_eq!(
        ids,
        [
            "scene-x-y-a-txt",
            "scene-z-a-txt",
            "scene-z-a-txt-2",
            "scene-method",
            "method"
        ]
    );
    for id in ids {
        assert!(page.contains(&format!("href=\"#{id}\"")), "{id}");
    }
    let links = markdown.lines().filter(|line| line.starts_with("!["));
    let files: std::collections::BTreeSet<_> = links
        .map(|line| line.rsplit_once('(').unwrap().1.trim_end_matches(')'))
        .collect();
    assert_eq!(files.len(), 4 * 3);
    for file in files {
        assert!(!file.contains([' ', '%', '/']), "{file}");
        assert!(text(file).starts_with("<svg "), "{file}");
    }
}

#[test]
fn settings_that_change_nothing_are_not_worth_having() {
    let folder = Folder::new();
    // A sky, and nothing that could be turned.
    folder.write(
        "sky.txt",
        "0\n0 0 0\n4 3\n0 9 0 1 1 1 1 1 1\n.2\n1\n0 0 0\n",
    );
    folder.succeed(&[
        "report", "sky.txt", "-o", "out", "--size", "4x3", "--only", "json",
    ]);
    let json: serde_json::Value = serde_json::from_slice(&folder.read("out/report.json")).unwrap();
    let verdict = |name: &str| {
        let configurations = json["scenes"][0]["configurations"].as_array().unwrap();
        let found = configurations.iter().find(|c| c["name"] == name);
        found.unwrap_or_else(|| panic!("{name}"))["verdict"].to_string()
    };
    for name in ["depth 1", "depth 16", "polynomial power"] {
        assert!(
            verdict(name).contains("equal-to"),
            "{name}: {}",
            verdict(name)
        );
    }
    assert_eq!(verdict("default"), "\"pareto-front\"");
}

#[test]
fn without_a_checkout_instructions_are_predicted() {
    let folder = Folder::new();
    folder.write("a.txt", SMALL_SCENE);
    // Wherever the program was built, the current folder decides.
    let run = folder.run(&[
        "report",
        "a.txt",
        "-o",
        "out",
        "--size",
        "8x6",
        "--emulate=m4f",
        "--only",
        "json",
    ]);
    assert_eq!(run.code, 0, "{}", run.stderr);
    assert!(
        run.stderr.contains("predicted, not counted")
            && run.stderr.contains("run the command in a checkout"),
        "{}",
        run.stderr
    );
}

#[test]
#[ignore = "builds and emulates firmware: .ci/run runs it"]
fn instructions_are_counted_where_there_is_an_emulator() {
    let folder = Folder::new();
    // With a mirror, so that a depth matters.
    let mirror = SMALL_SCENE.replace("1 1 1  0 50 0 0", "1 1 1  0.5 50 0 0");
    assert_ne!(mirror, SMALL_SCENE);
    folder.write("a.txt", mirror);
    let [scene, out] =
        ["a.txt", "out"].map(|name| folder.path(name).into_os_string().into_string().unwrap());
    // Where the firmware is.
    let run = folder
        .program(&[
            "report",
            &scene,
            "-o",
            &out,
            "--size",
            "8x6",
            "--emulate=m4f",
            "--threads",
            "2",
        ])
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .unwrap();
    let run = Run {
        code: run.status.code().unwrap(),
        stdout: run.stdout,
        stderr: String::from_utf8(run.stderr).unwrap(),
    };
    assert_eq!(run.code, 0, "{}", run.stderr);
    let text = |name: &str| String::from_utf8(folder.read(&format!("out/{name}"))).unwrap();
    let json: serde_json::Value = serde_json::from_str(&text("report.json")).unwrap();
    let configurations = json["scenes"][0]["configurations"].as_array().unwrap();
    if let Some(why) = json["emulation"]["missing"].as_str() {
        // The columns say so, and why.
        assert!(run.stderr.contains(why), "{}", run.stderr);
        assert!(text("report.md").contains(why) && text("report.md").contains("M4F (model)"));
        assert!(text("index.html").contains("M0, instructions per pixel (model)"));
        // Not `println`, which the test harness keeps to itself.
        let _ = writeln!(std::io::stderr(), "skipped: {why}");
        return;
    }
    assert_eq!(
        json["emulation"]["counted"]["failures"],
        serde_json::json!([])
    );
    let find = |name: &str| configurations.iter().find(|c| c["name"] == name).unwrap();
    let counted = |name: &str| find(name)["instructions_emulated"][0].as_f64().unwrap();
    for configuration in configurations {
        // Whatever a device can have, and on the core that was asked for.
        assert_eq!(
            configuration["instructions_emulated"][0].is_number(),
            configuration["instructions_by_model"].is_array(),
            "{configuration}"
        );
        assert!(configuration["instructions_emulated"][1].is_null());
    }
    let [one, four] = ["default", "4 samples"].map(counted);
    assert!((3.5..5.5).contains(&(four / one)), "{one}, {four}");
    assert!(counted("depth 0") < one);
    assert!(counted("quarter preview") < counted("half preview"));
    assert!(text("index.html").contains("M4F, instructions per pixel (emulated)"));
    assert!(text("report.md").contains("M4F (emulated) | M3 (model)"));
}

#[test]
fn writes_only_what_is_wanted() {
    let folder = Folder::new();
    folder.write("a.txt", SMALL_SCENE);
    folder.succeed(&[
        "report", "a.txt", "-o", "out", "--size", "4x3", "--only", "csv",
    ]);
    let entries: Vec<_> = std::fs::read_dir(folder.path("out")).unwrap().collect();
    assert_eq!(entries.len(), 1);
}

#[test]
fn refuses_what_it_cannot_measure() {
    let folder = Folder::new();
    folder.write("bad.txt", "0\n0 0\n");
    let words = folder.fail(3, &["report", "bad.txt", "-o", "out"]);
    assert!(words.contains("bad.txt:2"), "{words}");
    // Before anything is measured, and before the folder is made.
    folder.write("good.txt", SMALL_SCENE);
    let words = folder.fail(3, &["report", "good.txt", "bad.txt", "-o", "out"]);
    assert!(words.contains("bad.txt:2"), "{words}");
    assert!(!folder.path("out").exists());
    folder.write("file", "");
    let words = folder.fail(4, &["report", "-o", "file", "--size", "4x3"]);
    assert!(words.contains("it is a file; name a folder"), "{words}");
    // A file of the report that cannot be written is told of at once, too: nothing is measured, so that the older stays.
    std::fs::create_dir_all(folder.path("taken/report.csv")).unwrap();
    folder.write("taken/index.html", "older");
    let words = folder.fail(4, &["report", "-o", "taken", "--size", "4x3"]);
    assert!(
        words.contains("report.csv") && words.contains("it is a folder"),
        "{words}"
    );
    assert_eq!(folder.read("taken/index.html"), b"older");
    let words = folder.fail(2, &["report", "-o", "out", "--size", "9000x3"]);
    assert!(words.contains("--size"), "{words}");
    assert!(!folder.path("out").exists());
}
