//! The program as its users meet it: each test runs it in a folder of its own.

mod ask;
mod bake;
mod diff;
mod displays;
mod errors;
mod example;
mod examples;
mod export;
mod files;
mod fmt;
mod generate;
mod harmless_output;
mod inspect;
mod join;
mod knobs;
mod laboratory;
mod manual;
mod memory;
mod needs;
mod pixel;
mod program;
mod render;
mod turntable;
mod view;

/// The program's file.
const PROGRAM: &str = env!("CARGO_BIN_EXE_scanray");
/// What examples call it.
const NAME: &str = "scanray";

/// Puts what the examples name, beside scenes, into a folder.
fn furnish(folder: &program::Folder) {
    std::fs::create_dir(folder.path("pictures")).unwrap();
    for name in ["old.png", "new.png", "new.ppm", "golden.png"] {
        folder.succeed(&["render", "scene.txt", "-o", name]);
    }
}
