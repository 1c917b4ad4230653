//! Why a command ended early, and the exit code that says so.

use std::fmt::Display;
use std::io;
use std::path::Path;
use std::process::ExitCode;

use crate::console::shown;

/// The end of a command, with the words for it.
#[derive(Debug)]
pub enum Failure {
    /// The command line asks for something that cannot be: code 2.
    Usage(String),
    /// A scene was rejected; the words are a whole report: code 3.
    Scene(String),
    /// A file could not be read or written: code 4.
    Files(String),
    /// The machine has too little memory: code 4.
    Memory(String),
    /// Nobody reads standard output any more, as after `| head`: no words, code 0.
    ClosedPipe,
}

impl Failure {
    /// A file could not be read or written.
    pub fn file(deed: &str, path: &Path, why: impl Display) -> Self {
        Self::Files(format!("cannot {deed} {}: {why}", shown(path)))
    }

    /// Standard output could not be written.
    pub fn stdout(error: &io::Error) -> Self {
        match error.kind() {
            io::ErrorKind::BrokenPipe => Self::ClosedPipe,
            _ => Self::Files(format!("cannot write to standard output: {error}")),
        }
    }

    /// What went wrong, in words; none for a closed pipe.
    pub fn words(&self) -> String {
        match self {
            Self::Usage(words) | Self::Files(words) | Self::Memory(words) => {
                format!("error: {words}")
            }
            Self::Scene(report) => report.clone(),
            Self::ClosedPipe => String::new(),
        }
    }

    /// Says on standard error what went wrong; returns the exit code.
    pub fn report(&self) -> ExitCode {
        let code = match self {
            Self::Usage(_) => 2,
            Self::Scene(_) => 3,
            Self::Files(_) | Self::Memory(_) => 4,
            Self::ClosedPipe => return ExitCode::SUCCESS,
        };
        crate::console::say(self.words());
        ExitCode::from(code)
    }
}
