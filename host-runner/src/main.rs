//! The program `scanray`.

use std::process::ExitCode;

fn main() -> ExitCode {
    scanray_host::run()
}
