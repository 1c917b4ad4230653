//! The laboratory as its users meet it: each test runs it in a folder of its own.

#[path = "../../../host-runner/tests/cli/examples.rs"]
mod examples;
mod manual;
#[allow(dead_code)]
#[path = "../../../host-runner/tests/cli/program.rs"]
mod program;
mod report;
mod stability;
mod tune;

/// The program's file.
const PROGRAM: &str = env!("CARGO_BIN_EXE_scanray-lab");
/// What examples call it.
const NAME: &str = "scanray-lab";

/// Puts what the examples name, beside scenes, into a folder.
fn furnish(folder: &program::Folder) {
    std::fs::create_dir(folder.path("pictures")).unwrap();
}
