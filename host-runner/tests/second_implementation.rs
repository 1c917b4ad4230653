//! The independent C program of lab/benches/reference.c draws the same pictures.

use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The part of the pixels that must be within [`TOLERANCE`] of each other.
const AGREEING: f64 = 0.998;
/// Levels of 255 in any channel.
const TOLERANCE: u8 = 2;

fn repository() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// Runs a command that must succeed.
fn run(command: &mut Command) {
    let output = command
        .output()
        .unwrap_or_else(|error| panic!("{command:?}: {error}"));
    assert!(
        output.status.success(),
        "{command:?}: {}\n{}",
        output.status,
        String::from_utf8_lossy(&output.stderr)
    );
}

/// The C program, compiled; `None` where there is no C compiler.
fn reference() -> Option<PathBuf> {
    let program = Path::new(env!("CARGO_TARGET_TMPDIR")).join("reference");
    let compiler = std::env::var_os("CC").unwrap_or_else(|| "cc".into());
    if Command::new(&compiler).arg("--version").output().is_err() {
        return None;
    }
    run(Command::new(compiler)
        .args(["-O2", "-o"])
        .arg(&program)
        .arg(repository().join("lab/benches/reference.c"))
        .arg("-lm"));
    Some(program)
}

/// The pixels of a P6 file of 8 bits.
fn pixels(file: &Path) -> Vec<u8> {
    let bytes = std::fs::read(file).unwrap_or_else(|error| panic!("{}: {error}", file.display()));
    // Three lines: P6, width and height, 255.
    let header: usize = bytes
        .split_inclusive(|byte| *byte == b'\n')
        .take(3)
        .map(<[u8]>::len)
        .sum();
    bytes[header..].to_vec()
}

#[test]
fn agrees_on_every_scene() {
    let Some(reference) = reference() else {
        assert!(
            std::env::var_os("CI").is_none(),
            "a C compiler is needed to compare with lab/benches/reference.c"
        );
        // Not `println`, which the test harness keeps to itself.
        let _ = writeln!(
            std::io::stderr(),
            "skipped: no C compiler to build lab/benches/reference.c with"
        );
        return;
    };
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("second-implementation");
    std::fs::create_dir_all(&folder).unwrap();
    let mut scenes: Vec<PathBuf> = std::fs::read_dir(repository().join("scenes"))
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|extension| extension == "txt"))
        .collect();
    scenes.sort();
    assert!(scenes.len() >= 5);
    for scene in scenes {
        let name = scene.file_stem().unwrap().to_str().unwrap();
        let ours = folder.join(format!("{name}.ppm"));
        let theirs = folder.join(format!("{name}-reference.ppm"));
        run(Command::new(env!("CARGO_BIN_EXE_scanray"))
            .arg("render")
            .arg(&scene)
            .args(["--size", "400x300", "-o"])
            .arg(&ours));
        run(Command::new(&reference)
            .arg(&scene)
            .arg(&theirs)
            .arg("400x300"));
        let (ours, theirs) = (pixels(&ours), pixels(&theirs));
        assert_eq!(ours.len(), 3 * 400 * 300);
        assert_eq!(ours.len(), theirs.len());
        let differing = ours
            .chunks(3)
            .zip(theirs.chunks(3))
            .filter(|(a, b)| a.iter().zip(*b).any(|(a, b)| a.abs_diff(*b) > TOLERANCE))
            .count();
        let agreeing = 1.0 - differing as f64 / (400.0 * 300.0);
        println!(
            "{name}: {differing} pixels differ by more than {TOLERANCE}, {:.4} % agree",
            100.0 * agreeing
        );
        assert!(agreeing >= AGREEING, "{name}: only {agreeing} agree");
    }
}
