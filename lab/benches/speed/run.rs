//! Running the programs, and their times.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::LazyLock;

/// What drawing a picture has taken, in nanoseconds a pixel.
pub(crate) struct Time {
    pub(crate) cpu: f64,
    pub(crate) wall: f64,
}

/// Draws a scene with `scanray render`; the time is that of drawing alone.
pub(crate) fn scanray(scene: &Path, settings: &[&str]) -> Time {
    let output = Command::new(program())
        .arg("render")
        .arg(scene)
        .args(settings)
        .arg("--json")
        .arg("-o")
        .arg(temporary("scanray.ppm"))
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

/// The file of `scanray`, which is built first if need be.
pub(crate) fn program() -> &'static Path {
    static PROGRAM: LazyLock<PathBuf> = LazyLock::new(|| {
        let status = Command::new(env!("CARGO"))
            .args(["build", "--quiet", "--release", "--package", "scanray-host"])
            .current_dir(env!("CARGO_MANIFEST_DIR"))
            .status()
            .expect("cargo runs");
        assert!(status.success(), "scanray is not built: {status}");
        // The bench is in release/deps, or in that of a target's folder.
        let bench = std::env::current_exe().expect("the bench is a file");
        let release = bench
            .ancestors()
            .nth(2)
            .expect("the bench is in a folder of a folder");
        release.join(format!("scanray{}", std::env::consts::EXE_SUFFIX))
    });
    &PROGRAM
}

/// A file of the bench's own.
pub(crate) fn temporary(name: &str) -> PathBuf {
    Path::new(env!("CARGO_TARGET_TMPDIR")).join(name)
}

/// Whether a program is installed.
pub(crate) fn is_installed(program: &str) -> bool {
    let output = Command::new(program).arg("--version").output();
    output.is_ok()
}

/// The CPU seconds that a program takes from its start to its end.
///
/// # Panics
///
/// If it fails.
#[cfg(unix)]
pub(crate) fn cpu_seconds(command: &mut Command) -> f64 {
    use nix::sys::resource::{UsageWho, getrusage};
    let of_children = || {
        let usage = getrusage(UsageWho::RUSAGE_CHILDREN).expect("the system counts CPU time");
        let seconds =
            |time: nix::sys::time::TimeVal| time.tv_sec() as f64 + time.tv_usec() as f64 * 1e-6;
        seconds(usage.user_time()) + seconds(usage.system_time())
    };
    let before = of_children();
    let output = command.output().expect("the program is there");
    assert!(
        output.status.success(),
        "{command:?}: {}",
        String::from_utf8_lossy(&output.stderr)
    );
    of_children() - before
}

/// The number in the middle.
///
/// # Panics
///
/// If there is none.
pub(crate) fn median(numbers: impl IntoIterator<Item = f64>) -> f64 {
    let mut numbers: Vec<f64> = numbers.into_iter().collect();
    numbers.sort_by(f64::total_cmp);
    numbers[numbers.len() / 2]
}
