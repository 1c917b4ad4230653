//! `scanray report`.

use crate::program::{Folder, SMALL_SCENE};

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
        for knob in scene["knobs"].as_array().unwrap() {
            let points = knob["points"].as_array().unwrap();
            assert!(points.len() > 1, "{knob}");
            for point in points {
                let index = point[1].as_u64().unwrap() as usize;
                assert!(index < configurations.len());
            }
        }
        let on_front = configurations
            .iter()
            .filter(|c| c["verdict"] == "best")
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
        ["1", "0", "squaring", "rgb888", "false"].map(Some)
    );
    let settings = &scenes[0]["configurations"][0]["settings"];
    assert_eq!(settings.as_object().unwrap().len(), 7);

    let markdown = text("report.md");
    let page = text("index.html");
    for name in ["a", "b"] {
        assert!(markdown.contains(&format!("## {name} (12×9)")));
        assert!(page.contains(&format!("<section id=\"{name}\">")));
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
    assert!(!folder.path("out/index.html").exists());
    folder.write("file", "");
    folder.fail(4, &["report", "-o", "file", "--size", "4x3"]);
    let words = folder.fail(2, &["report", "-o", "out", "--size", "9000x3"]);
    assert!(words.contains("--size"), "{words}");
}
