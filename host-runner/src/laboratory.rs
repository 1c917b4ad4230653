//! The commands of the laboratory, which is a program of its own: `scanray report` runs `scanray-lab report`.

use std::env;
use std::ffi::OsString;
use std::path::PathBuf;
use std::process::{Command, ExitCode};

use crate::failure::Failure;

/// The program.
const PROGRAM: &str = "scanray-lab";

/// Its commands that are commands of `scanray`, too.
pub(crate) const COMMANDS: [&str; 3] = ["report", "tune", "stability"];

/// Runs the laboratory in place of this program, if the arguments name one of its commands or ask for help on one.
pub(crate) fn run_if_asked() -> Option<ExitCode> {
    let arguments: Vec<OsString> = env::args_os().skip(1).collect();
    let named = match arguments.first()?.to_str()? {
        "help" => arguments.get(1)?.to_str()?,
        name => name,
    };
    COMMANDS.contains(&named).then(|| match run(&arguments) {
        Ok(code) => code,
        Err(failure) => failure.report(),
    })
}

fn run(arguments: &[OsString]) -> Result<ExitCode, Failure> {
    let program = find().ok_or_else(|| {
        Failure::Usage(format!(
            "the laboratory is a program of its own, {PROGRAM}, and is neither beside scanray nor in PATH; in a checkout build it with \
             cargo build --release -p {PROGRAM}"
        ))
    })?;
    let mut command = Command::new(&program);
    command.args(arguments);
    let failed = |error| Failure::file("run", &program, error);
    #[cfg(unix)]
    {
        use std::os::unix::process::CommandExt as _;
        Err(failed(command.exec()))
    }
    #[cfg(not(unix))]
    {
        let status = command.status().map_err(failed)?;
        let code = status.code().and_then(|code| u8::try_from(code).ok());
        Ok(code.map_or(ExitCode::FAILURE, ExitCode::from))
    }
}

/// The program beside this one, or else in a folder of `PATH`.
fn find() -> Option<PathBuf> {
    let name = format!("{PROGRAM}{}", env::consts::EXE_SUFFIX);
    let own = env::current_exe().ok();
    let beside = own.iter().filter_map(|own| own.parent().map(PathBuf::from));
    let path = env::var_os("PATH").unwrap_or_default();
    beside
        .chain(env::split_paths(&path))
        .map(|folder| folder.join(&name))
        .find(|file| file.is_file())
}
