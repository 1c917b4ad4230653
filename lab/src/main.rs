//! The laboratory of scanray: what settings cost and what they buy, and the cases it is held to.
//!
//! `scanray report`, `scanray tune` and `scanray stability` are the commands of this program.

mod cli;
mod commands;
mod cost;
mod report;

use std::process::ExitCode;

use clap::{CommandFactory, Parser};
use scanray_host::commands::{completions, man};

use cli::{Cli, Command};

fn main() -> ExitCode {
    let result = match Cli::parse().command {
        Command::Report(args) => commands::report::run(&args),
        Command::Tune(args) => commands::tune::run(&args),
        Command::Stability(args) => commands::stability::run(&args),
        Command::Completions(args) => completions::run(&args, Cli::command()),
        Command::Man(args) => man::run(&args, Cli::command()),
    };
    result.unwrap_or_else(|failure| failure.report())
}
