//! The command line as a whole.

use clap::{Parser, Subcommand};
use scanray_host::commands::completions::CompletionsArgs;
use scanray_host::commands::man::ManArgs;

use crate::commands::report::ReportArgs;
use crate::commands::stability::StabilityArgs;
use crate::commands::tune::TuneArgs;

/// Measures scanray: what its settings cost and what they buy, and the stiff and extreme cases it is held to.
#[derive(Parser, Debug)]
#[command(
    name = "scanray-lab",
    version,
    // As in scanray.
    args_override_self = true,
    after_help = "\
`scanray report`, `scanray tune` and `scanray stability` are the same commands: scanray runs this program if it stands beside it or \
in PATH.

Examples:
  scanray-lab report scene.txt --size 96x64    what each setting costs and what it buys
  scanray-lab stability 26 44                  two of the cases
  scanray-lab help tune                        all that tune can do

Exit codes: 0 fine, 1 nothing fits (tune) or a figure is beyond its bound (stability), 2 usage, 3 scene, 4 files or memory."
)]
pub(crate) struct Cli {
    #[command(subcommand)]
    pub(crate) command: Command,
}

/// The commands.
#[derive(Subcommand, Debug)]
pub(crate) enum Command {
    /// Measure what each setting costs and what it buys, as a page with plots
    Report(ReportArgs),
    /// Find the settings with the least error for a device and a time
    Tune(TuneArgs),
    /// Measure stiff and extreme cases: a table of figures and their bounds
    Stability(StabilityArgs),
    /// Print what a shell needs to complete command lines
    #[command(after_help = "\
Examples:
  scanray-lab completions bash > scanray-lab.bash    to ~/.bash_completion
  scanray-lab completions zsh > _scanray-lab         to a folder of $fpath
  scanray-lab completions fish > scanray-lab.fish    to ~/.config/fish/completions")]
    Completions(CompletionsArgs),
    /// Print or write manual pages
    #[command(after_help = "\
Examples:
  scanray-lab man > scanray-lab.1          the page of the program; man -l scanray-lab.1 shows it
  scanray-lab man report > report.1        the page of a command
  scanray-lab man -o pictures              all pages into a folder, such as ~/.local/share/man/man1")]
    Man(ManArgs),
}
