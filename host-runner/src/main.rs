//! scanray on the desktop: draws the scenes that devices draw, and answers questions about them.

mod canonical;
mod canvas;
mod cli;
mod commands;
mod compare;
mod console;
mod cost;
mod device_memory;
mod displays;
mod drawing;
mod failure;
mod host_pixels;
mod host_tracer;
mod image;
mod interrupt;
mod knobs;
mod memory;
mod options;
mod output;
mod packet;
mod part;
mod picture_args;
mod places;
mod pools;
mod povray;
mod progress;
mod ray_tree;
mod render_report;
mod report;
mod scene_data;
mod scene_file;
mod scene_lines;
mod turntable;

use std::process::ExitCode;

use cli::{Cli, Command};
use commands::report as report_command;
use commands::{
    ask, bake, completions, diff, example, export, fmt, generate, inspect, join, man, needs, pixel,
    render, stability, tune, view,
};

fn main() -> ExitCode {
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
        Command::Stability(args) => stability::run(&args),
        Command::Completions(args) => completions::run(&args),
        Command::Man(args) => man::run(&args),
        Command::Report(args) => report_command::run(&args),
        Command::Generate(args) => generate::run(&args),
        Command::Tune(args) => tune::run(&args),
    };
    result.unwrap_or_else(|failure| failure.report())
}
