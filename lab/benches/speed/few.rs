//! Scenes of a few objects, against the plain C program.

use std::path::{Path, PathBuf};
use std::process::Command;

use crate::run::{Time, is_installed, median, scanray, temporary};
use crate::scenes::of_repository;

/// Pictures of each program and scene.
const ROUNDS: usize = 11;

/// One picture of each kind.
struct Round {
    c: f64,
    single: Time,
    reference_scalar: Time,
}

pub(crate) fn run(files: &[PathBuf]) {
    if !is_installed("gcc") {
        println!("skipped: gcc is not installed");
        return;
    }
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("benches/reference.c");
    let reference = compile(&source);
    let scenes = match files {
        [] => of_repository(),
        files => files.to_vec(),
    };
    println!("ns of CPU time a pixel on one thread, medians of {ROUNDS} pictures in turn\n");
    println!(
        "{:<20} {:>7} {:>14}   {:<19} {:>14}   ratio",
        "scene", "C, f64", "scanray, f32", "ratio (min–max)", "scanray, f64"
    );
    for scene in scenes {
        let rounds: Vec<Round> = (0..ROUNDS)
            .map(|_| Round {
                c: c_cpu(&reference, &scene),
                single: scanray(&scene, &["--threads", "1"]),
                reference_scalar: scanray(&scene, &["--threads", "1", "--scalar", "f64"]),
            })
            .collect();
        let median = |value: fn(&Round) -> f64| median(rounds.iter().map(value));
        let ratios = || rounds.iter().map(|round| round.single.cpu / round.c);
        println!(
            "{:<20} {:>7.1} {:>14.1}   {:.3} ({:.3}–{:.3}) {:>14.1}   {:.3}",
            scene.file_stem().unwrap_or_default().to_string_lossy(),
            median(|round| round.c),
            median(|round| round.single.cpu),
            median(|round| round.single.cpu / round.c),
            ratios().fold(f64::INFINITY, f64::min),
            ratios().fold(0.0, f64::max),
            median(|round| round.reference_scalar.cpu),
            median(|round| round.reference_scalar.cpu / round.c),
        );
    }
}

fn compile(source: &Path) -> PathBuf {
    let program = temporary("reference-native");
    let status = Command::new("gcc")
        .args(["-O3", "-march=native", "-o"])
        .arg(&program)
        .arg(source)
        .arg("-lm")
        .status()
        .expect("gcc runs");
    assert!(status.success(), "gcc: {status}");
    program
}

/// CPU nanoseconds a pixel of the C program, which it prints itself.
fn c_cpu(program: &Path, scene: &Path) -> f64 {
    let output = Command::new(program)
        .arg(scene)
        .arg(temporary("reference.ppm"))
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
