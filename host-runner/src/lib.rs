//! scanray on the desktop: draws the scenes that devices draw, and answers questions about them.
//!
//! The program `scanray` is [`run`]; the laboratory (`lab/`) uses the public modules.

mod canonical_text;
mod canvas;
mod cli;
pub mod commands;
pub mod compare;
pub mod console;
pub mod cost;
mod device_memory;
mod displays;
pub mod failure;
mod host_pixels;
mod host_tracer;
pub mod image;
mod interrupt;
mod json_numbers;
pub mod knobs;
mod laboratory;
pub mod option_values;
pub mod output_files;
mod output_paths;
mod packet;
pub mod parallel_drawing;
mod picture_memory;
mod picture_part;
pub mod pools;
mod povray;
pub mod progress;
mod ray_tree;
mod render_report;
mod render_settings;
pub mod scene_file;
mod scene_json;
mod scene_lines;
mod scene_listing;
mod scene_warnings;
mod turntable;

use std::process::ExitCode;

use clap::CommandFactory as _;
use cli::{Cli, Command};
use commands::{
    ask, bake, completions, diff, example, export, fmt, generate, inspect, join, man, needs, pixel,
    render, view,
};

#[doc(hidden)]
pub use embedded_graphics::pixelcolor;

/// Does what the program's arguments say.
pub fn run() -> ExitCode {
    if let Some(code) = laboratory::run_if_asked() {
        return code;
    }
    let result = match Cli::from_arguments() {
        Command::Render(args) => render::run(&args),
        Command::Inspect(args) => inspect::run(&args),
        Command::Join(args) => join::run(&args),
        Command::View(args) => view::run(&args),
        #[cfg(feature = "window")]
        Command::Window(args) => commands::window::run(&args),
        Command::Bake(args) => bake::run(&args),
        Command::Needs(args) => needs::run(&args),
        Command::Pixel(args) => pixel::run(&args),
        Command::Diff(args) => diff::run(&args),
        Command::Fmt(args) => fmt::run(&args),
        Command::Example(args) => example::run(&args),
        Command::Export(args) => export::run(&args),
        Command::Ask(args) => ask::run(&args),
        Command::Completions(args) => completions::run(&args, Cli::command()),
        Command::Man(args) => man::run(&args, Cli::command()),
        Command::Generate(args) => generate::run(&args),
    };
    result.unwrap_or_else(|failure| failure.report())
}
