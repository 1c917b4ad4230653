//! Exported scenes, drawn by POV-Ray, are the pictures that are drawn here.

use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;
use tempfile::TempDir;

/// A folder with the program and POV-Ray.
struct Folder(TempDir);

impl Folder {
    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    fn run(&self, program: &str, arguments: &[&str]) -> (i32, Vec<u8>) {
        let output = Command::new(program)
            .args(arguments)
            .current_dir(self.0.path())
            .output()
            .unwrap();
        let code = output.status.code().unwrap();
        assert!(
            code < 2,
            "{program} {arguments:?}: {}",
            String::from_utf8_lossy(&output.stderr)
        );
        (code, output.stdout)
    }

    /// Draws a scene both ways and compares; returns the shares of the pixels that differ by more than 2 levels and
    /// by more than 16.
    fn shares(&self, text: &str, size: [usize; 2], depth: &str) -> [f64; 2] {
        fs::write(self.path("scene.txt"), text).unwrap();
        let scanray = env!("CARGO_BIN_EXE_scanray");
        let [width, height] = size;
        let settings = ["--size", &format!("{width}x{height}"), "--max-depth", depth];
        self.run(
            scanray,
            &[&["render", "scene.txt", "-o", "here.png"], &settings[..]].concat(),
        );
        self.run(
            scanray,
            &[&["export", "scene.txt", "-o", "scene.pov"], &settings[..]].concat(),
        );
        let (width, height) = (format!("+W{width}"), format!("+H{height}"));
        let pov = [
            "+WT1",
            "+Iscene.pov",
            "+Othere.png",
            &width,
            &height,
            "-A",
            "-D",
            "File_Gamma=1.0",
        ];
        let (code, _) = self.run("povray", &pov);
        assert_eq!(code, 0);
        [2, 16].map(|tolerance: u8| {
            let tolerance = tolerance.to_string();
            let (_, json) = self.run(
                scanray,
                &[
                    "diff",
                    "here.png",
                    "there.png",
                    "--json",
                    "--tolerance",
                    &tolerance,
                ],
            );
            let json: Value = serde_json::from_slice(&json).unwrap();
            json["beyond_tolerance"].as_f64().unwrap() / json["pixels"].as_f64().unwrap()
        })
    }
}

fn scene(name: &str) -> String {
    let scenes = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes");
    fs::read_to_string(scenes.join(name).with_extension("txt")).unwrap()
}

/// The scene with a factor on the intensities of the light, the ambient light and the background.
fn dimmed(text: &str, factor: f64) -> String {
    let mut record = 0;
    let mut out = String::new();
    for line in text.lines() {
        let words: Vec<&str> = line.split('#').next().unwrap().split_whitespace().collect();
        if words.is_empty() {
            continue;
        }
        let intensities = match record {
            3 => 3..words.len(),
            4 | 6 => 0..words.len(),
            _ => 0..0,
        };
        for (index, word) in words.iter().enumerate() {
            match intensities.contains(&index) {
                true => out += &format!("{} ", word.parse::<f64>().unwrap() * factor),
                false => out += &format!("{word} "),
            }
        }
        out += "\n";
        record += 1;
    }
    out
}

/// What the scenes do not have: a tinted light with a tinted highlight, a glass sphere that casts a shadow, an
/// opaque sphere of index 1 that casts none, a camera off the origin, a plain background.
const MIXTURE: &str = "\
5
0.5 1 -3
8 6
-4 6 -3  0.4 0.3 0.2  0.5 0.45 0.3
0.3
0
0.1 0.2 0.4
1  0 1 0.1 0.2   0.4 0.5 0.3  0.2 0.2 0.2  0.5 0.4 0.5  0.2 12 0 0
0  -1 1 1 0.8    0.1 0.1 0.1  0.6 0.6 0.6  0.1 0.1 0.2  0.1 30 0.6 1.4
0  1.4 0.9 0.6 0.6  0.7 0.2 0.2  0.5 0.5 0.5  0.4 0.4 0.4  0 7.5 0 1
0  0.2 2 3 0.7   0 0.5 0.6  0.3 0.3 0.3  0.2 0.5 0.5  0.4 50 0 0
2  -3 0.2 4  3 0.2 4  0 4 5  0 0 0 0  0.3 0.3 0.6  0.1 0.1 0.1  0.3 0.3 0.4  0 20 0.5 1
";

/// Name, text, maximum depths, and what may differ at most: bright and dimmed.
type Case<'a> = (&'a str, String, &'a [&'a str], [f64; 2], [f64; 2]);

/// Where more differs than may.
fn differences((name, text, depths, bright, dim): Case<'_>) -> Vec<String> {
    let folder = Folder(tempfile::tempdir().unwrap());
    let mut wrong = Vec::new();
    for (kind, text, most) in [
        ("bright", text.clone(), bright),
        ("dim", dimmed(&text, 0.3), dim),
    ] {
        // With 97 columns rays of window-room pass exactly through the corners where its ceiling and walls meet, which rounding decides.
        for (depth, size) in depths.iter().zip([[160, 120], [99, 41], [60, 80]]) {
            let shares = folder
                .shares(&text, size, depth)
                .map(|share| share * 1000.0);
            if shares[0] > most[0] || shares[1] > most[1] {
                wrong.push(format!(
                    "{name}, {kind}, {size:?}, depth {depth}: {shares:.2?}"
                ));
            }
        }
    }
    wrong
}

#[test]
fn povray_draws_the_same() {
    if Command::new("povray").arg("--version").output().is_err() {
        let _ = writeln!(
            std::io::stderr(),
            "not run, because povray is not installed: apt-get install povray"
        );
        return;
    }
    // The most that may differ by more than 2 levels and by more than 16, in thousandths. Bright scenes differ where
    // a mirrored or refracted colour exceeds 1, which is clamped here at each level and there at the end alone;
    // dimmed, only single pixels at edges are left. POV-Ray does not count rays that pass straight as a level, so that
    // a small depth is another picture where several sheets are behind one another.
    let (deep, all) = (&["5", "0"][..], &["5", "1", "0"][..]);
    let cases = [
        ("default", scene("default"), all, [2.0, 2.0], [2.0, 1.0]),
        (
            "mirror-room",
            scene("mirror-room"),
            all,
            [10.0, 2.0],
            [3.0, 1.0],
        ),
        ("pyramids", scene("pyramids"), deep, [10.0, 2.0], [3.0, 1.0]),
        (
            "reflective",
            scene("reflective"),
            deep,
            [25.0, 12.0],
            [3.0, 1.0],
        ),
        (
            "window-room",
            scene("window-room"),
            all,
            [10.0, 3.0],
            [3.0, 1.0],
        ),
        ("mixture", MIXTURE.to_owned(), all, [3.0, 1.0], [3.0, 1.0]),
    ];
    // POV-Ray waits a second for its own threads.
    let wrong: Vec<String> = std::thread::scope(|scope| {
        let threads = cases.map(|case| scope.spawn(move || differences(case)));
        threads
            .into_iter()
            .flat_map(|thread| thread.join().unwrap())
            .collect()
    });
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
