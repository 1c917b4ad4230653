//! `scanray completions`: what a shell needs to complete command lines.

use std::process::ExitCode;

use clap::{Args, Command};
use clap_complete::Shell;

use crate::console::print;
use crate::failure::Failure;

/// The command line.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  scanray completions bash > scanray.bash    to ~/.local/share/bash-completion/completions/scanray
  scanray completions zsh > _scanray         to a folder of $fpath
  scanray completions fish > scanray.fish    to ~/.config/fish/completions/scanray.fish")]
pub struct CompletionsArgs {
    /// The shell
    #[arg(value_name = "SHELL")]
    shell: Shell,
}

/// Prints the shell's script for a program.
///
/// # Errors
///
/// [`Failure`].
pub fn run(args: &CompletionsArgs, mut program: Command) -> Result<ExitCode, Failure> {
    let mut script = Vec::new();
    let name = program.get_name().to_owned();
    clap_complete::generate(args.shell, &mut program, name, &mut script);
    print(|out| out.write_all(&script))?;
    Ok(ExitCode::SUCCESS)
}
