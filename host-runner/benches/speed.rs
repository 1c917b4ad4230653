//! Host speed as ratios: scanray against the plain C program beside this file, and two threads against
//! one.
//!
//! `cargo bench -p scanray-host --bench speed [-- SCENE…]` compiles the C program with
//! `gcc -O3 -march=native` and draws each scene of scenes/ (or those named) with both in turn, so that a
//! drifting machine changes both. CPU time is that of drawing alone, without loading and writing. Medians
//! are printed, and the smallest and largest ratio.

use std::path::{Path, PathBuf};
use std::process::Command;

/// Pictures of each program and scene.
const ROUNDS: usize = 11;

fn main() {
    let repository = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let reference = compile(&repository.join("host-runner/benches/reference.c"));
    let mut scenes: Vec<PathBuf> = std::env::args_os()
        .skip(1)
        .filter(|argument| !argument.to_string_lossy().starts_with("--"))
        .map(PathBuf::from)
        .collect();
    if scenes.is_empty() {
        scenes = std::fs::read_dir(repository.join("scenes"))
            .expect("scenes/ can be read")
            .map(|entry| entry.expect("an entry of scenes/").path())
            .filter(|path| path.extension().is_some_and(|extension| extension == "txt"))
            .collect();
        scenes.sort();
    }
    println!("ns of CPU time a pixel, medians of {ROUNDS} pictures in turn");
    println!(
        "scene                C, f64   scanray f32, 1 thread   ratio (min–max)       f64   ratio   2 threads, wall"
    );
    for scene in scenes {
        let mut rounds = Vec::new();
        for _ in 0..ROUNDS {
            rounds.push(Round {
                c: c_cpu(&reference, &scene),
                single: scanray(&scene, &["--threads", "1"]),
                double: scanray(&scene, &["--threads", "2"]),
                reference_scalar: scanray(&scene, &["--threads", "1", "--scalar", "f64"]),
            });
        }
        let column = |value: fn(&Round) -> f64| {
            let mut values: Vec<f64> = rounds.iter().map(value).collect();
            values.sort_by(f64::total_cmp);
            values
        };
        let median = |value| column(value)[ROUNDS / 2];
        let ratios = column(|round| round.single.cpu / round.c);
        println!(
            "{:<20} {:>6.1} {:>23.1}   {:.3} ({:.3}–{:.3}) {:>9.1}   {:.3}   {:.2} times as fast",
            scene.file_stem().unwrap_or_default().to_string_lossy(),
            median(|round| round.c),
            median(|round| round.single.cpu),
            ratios[ROUNDS / 2],
            ratios[0],
            ratios[ROUNDS - 1],
            median(|round| round.reference_scalar.cpu),
            median(|round| round.reference_scalar.cpu / round.c),
            median(|round| round.single.wall / round.double.wall),
        );
    }
}

/// One picture of each kind.
struct Round {
    c: f64,
    single: Time,
    double: Time,
    reference_scalar: Time,
}

/// Nanoseconds a pixel.
struct Time {
    cpu: f64,
    wall: f64,
}

fn compile(source: &Path) -> PathBuf {
    let program = Path::new(env!("CARGO_TARGET_TMPDIR")).join("reference-native");
    let status = Command::new("gcc")
        .args(["-O3", "-march=native", "-o"])
        .arg(&program)
        .arg(source)
        .arg("-lm")
        .status()
        .expect("gcc is needed for the program to compare with");
    assert!(status.success(), "gcc: {status}");
    program
}

/// CPU nanoseconds a pixel of the C program, which it prints itself.
fn c_cpu(program: &Path, scene: &Path) -> f64 {
    let output = Command::new(program)
        .arg(scene)
        .arg(Path::new(env!("CARGO_TARGET_TMPDIR")).join("reference.ppm"))
        .output()
        .expect("the C program runs");
    let words = String::from_utf8_lossy(&output.stderr).into_owned();
    let (before, _) = words
        .split_once(" ns per pixel")
        .unwrap_or_else(|| panic!("the C program said {words}"));
    before
        .rsplit(' ')
        .next()
        .and_then(|number| number.parse().ok())
        .unwrap_or_else(|| panic!("the C program said {words}"))
}

fn scanray(scene: &Path, settings: &[&str]) -> Time {
    let output = Command::new(env!("CARGO_BIN_EXE_scanray"))
        .arg("render")
        .arg(scene)
        .args(settings)
        .arg("--json")
        .arg("-o")
        .arg(Path::new(env!("CARGO_TARGET_TMPDIR")).join("scanray.ppm"))
        .output()
        .expect("scanray runs");
    assert!(
        output.status.success(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    let report: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
    let number = |value: &serde_json::Value| value.as_f64().expect("a number");
    let pixels = number(&report["size"]["width"]) * number(&report["size"]["height"]);
    Time {
        cpu: number(&report["cpu_seconds"]) * 1e9 / pixels,
        wall: number(&report["seconds"]) * 1e9 / pixels,
    }
}
