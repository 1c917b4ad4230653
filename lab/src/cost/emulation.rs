//! Instructions counted under emulation: the firmware's program `settings` on the boards, by `firmware/tools/settings.py`.

use std::io::{BufRead as _, BufReader, Write as _};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use serde::{Deserialize, Serialize};

use super::Core;
use scanray_host::console::shown;
use scanray_host::failure::Failure;

/// The script that builds the programs and runs them.
const SCRIPT: &str = "tools/settings.py";

/// Targets of the cores.
const TARGETS: [&str; 3] = [
    "thumbv7em-none-eabihf",
    "thumbv7m-none-eabi",
    "thumbv6m-none-eabi",
];

/// What is needed for it.
#[derive(Clone, Debug)]
pub(crate) struct Emulator {
    firmware: PathBuf,
}

/// What is to be counted: every setting on every scene.
#[derive(Debug, Serialize)]
pub(crate) struct Job<'a, S> {
    pub(crate) size: [u16; 2],
    pub(crate) cores: Vec<&'static str>,
    /// Their texts.
    pub(crate) scenes: &'a [String],
    pub(crate) settings: &'a [S],
}

/// A line of what the script prints.
#[derive(Debug, Deserialize)]
#[serde(untagged)]
enum Line {
    Counted {
        scene: usize,
        setting: usize,
        core: String,
        instructions: f64,
    },
    Failed {
        scene: usize,
        settings: Vec<usize>,
        core: String,
        error: String,
    },
}

/// What was counted for a picture.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Counted {
    pub(crate) scene: usize,
    pub(crate) setting: usize,
    pub(crate) core: Core,
    /// Instructions a pixel, or why there are none.
    pub(crate) instructions: Result<f64, String>,
}

impl Emulator {
    /// Finds it.
    ///
    /// # Errors
    ///
    /// What is missing, and how it is had.
    pub(crate) fn find() -> Result<Self, String> {
        let firmware = firmware_folder().ok_or(
            "neither this folder nor one above it has the firmware of scanray: run the command in a checkout, with -o for the report's folder",
        )?;
        for (program, package) in [
            ("python3", "python3"),
            ("qemu-system-arm", "qemu-system-arm"),
            ("cargo", "cargo"),
        ] {
            if !runs(program) {
                return Err(format!(
                    "{program} is not installed (Debian package {package})"
                ));
            }
        }
        if std::env::var_os("SCANRAY_BUILD_STD").is_none() {
            for target in TARGETS {
                if !has_target(target) {
                    return Err(format!(
                        "the compiler lacks the target {target} (rustup target add {target})"
                    ));
                }
            }
        }
        Ok(Self { firmware })
    }

    /// Counts, and hands over what is counted as soon as it is.
    ///
    /// # Errors
    ///
    /// [`Failure::Files`] when the script does not run to its end.
    pub(crate) fn count(
        &self,
        job: &Job<'_, impl Serialize>,
        mut take: impl FnMut(Counted),
    ) -> Result<(), Failure> {
        let cannot = |why: &dyn std::fmt::Display| {
            Failure::Files(format!(
                "cannot count under emulation by {}: {why}",
                shown(self.firmware.join(SCRIPT))
            ))
        };
        let mut script = Command::new("python3");
        script
            .arg(SCRIPT)
            .current_dir(&self.firmware)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped());
        // What cargo set for this program is not meant for the firmware's.
        script
            .env_remove("CARGO_TARGET_DIR")
            .env_remove("RUSTFLAGS");
        let mut script = script.spawn().map_err(|error| cannot(&error))?;
        if let Some(mut input) = script.stdin.take() {
            let text = serde_json::to_vec(job).map_err(|error| cannot(&error))?;
            input.write_all(&text).map_err(|error| cannot(&error))?;
        }
        if let Some(output) = script.stdout.take() {
            for line in BufReader::new(output).lines() {
                let line = line.map_err(|error| cannot(&error))?;
                let line = serde_json::from_str(&line).map_err(|error| cannot(&error))?;
                for counted in Counted::all(line) {
                    take(counted);
                }
            }
        }
        let status = script.wait().map_err(|error| cannot(&error))?;
        if !status.success() {
            return Err(cannot(&status));
        }
        Ok(())
    }
}

impl Counted {
    fn all(line: Line) -> Vec<Self> {
        let core_of = |name: &str| Core::ALL.into_iter().find(|core| core.name() == name);
        let (scene, settings, core, instructions) = match line {
            Line::Counted {
                scene,
                setting,
                core,
                instructions,
            } => (scene, vec![setting], core, Ok(instructions)),
            Line::Failed {
                scene,
                settings,
                core,
                error,
            } => (scene, settings, core, Err(error)),
        };
        let Some(core) = core_of(&core) else {
            return Vec::new();
        };
        let counted = |setting| Self {
            scene,
            setting,
            core,
            instructions: instructions.clone(),
        };
        settings.into_iter().map(counted).collect()
    }
}

/// The firmware of the checkout that the current folder is in.
fn firmware_folder() -> Option<PathBuf> {
    let here = std::env::current_dir().ok();
    let above = here.iter().flat_map(|here| here.ancestors());
    above
        .map(|folder| folder.join("firmware"))
        .find(|folder| folder.join(SCRIPT).is_file())
}

/// Whether a program is installed.
fn runs(program: &str) -> bool {
    let version = Command::new(program)
        .arg("--version")
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .status();
    version.is_ok_and(|status| status.success())
}

/// Whether the compiler has the core library of a target.
fn has_target(target: &str) -> bool {
    let compiler = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    let found = Command::new(compiler)
        .args(["--print", "target-libdir", "--target", target])
        .stderr(Stdio::null())
        .output();
    found.is_ok_and(|output| {
        output.status.success()
            && Path::new(String::from_utf8_lossy(&output.stdout).trim()).is_dir()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(line: &str) -> Vec<Counted> {
        serde_json::from_str(line).map(Counted::all).unwrap()
    }

    #[test]
    fn lines_of_the_script_are_read() {
        let one = read(r#"{"scene": 1, "setting": 2, "core": "M3", "instructions": 12.5}"#);
        let expected = Counted {
            scene: 1,
            setting: 2,
            core: Core::M3,
            instructions: Ok(12.5),
        };
        assert_eq!(one, [expected]);
        let two = read(r#"{"scene": 0, "settings": [3, 4], "core": "M0", "error": "no room"}"#);
        assert_eq!(two.len(), 2);
        assert_eq!(two[1].setting, 4);
        assert_eq!(two[1].instructions, Err("no room".to_owned()));
    }
}
