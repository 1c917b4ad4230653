//! The command line as a whole.

use std::path::Path;

use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{CommandFactory, Parser, Subcommand};

use crate::commands::ask::AskArgs;
use crate::commands::bake::BakeArgs;
use crate::commands::completions::CompletionsArgs;
use crate::commands::diff::DiffArgs;
use crate::commands::example::ExampleArgs;
use crate::commands::export::ExportArgs;
use crate::commands::fmt::FmtArgs;
use crate::commands::generate::GenerateArgs;
use crate::commands::inspect::InspectArgs;
use crate::commands::join::JoinArgs;
use crate::commands::man::ManArgs;
use crate::commands::needs::NeedsArgs;
use crate::commands::pixel::PixelArgs;
use crate::commands::render::RenderArgs;
use crate::commands::view::ViewArgs;
#[cfg(feature = "window")]
use crate::commands::window::WindowArgs;
use crate::console::{say, shown};
use crate::option_values::meant_for_option;

/// What `--help` prints; commands of the laboratory are another program's.
const HELP: &str = "\
{about-with-newline}
{usage-heading} {usage}

{all-args}

Laboratory, the program scanray-lab, which these run:
  report       Measure what each setting costs and what it buys, as a page with plots
  tune         Find the settings with the least error for a device and a time
  stability    Measure stiff and extreme cases: a table of figures and their bounds{after-help}";

/// Draws scenes for small displays on the desktop, with the bits the device will draw.
#[derive(Parser, Debug)]
#[command(
    name = "scanray",
    version,
    // A word at the end of a line that is called again changes what it says.
    args_override_self = true,
    help_template = HELP,
    after_help = "\
Without a command, the default scene is drawn into output.ppm.

Examples:
  scanray                                  draw the default scene
  scanray example > scene.txt              a scene to start from, its numbers explained
  scanray render scene.txt -o scene.png    draw a scene of yours into a PNG file
  scanray render -o tft.png --display st7789
                                           see it as a small colour display shows it
  scanray render --display list            displays to choose from
  scanray render scene.txt -o turn.gif --turntable 36
                                           see it from all around
  scanray view scene.txt                   look at it in the terminal
  scanray inspect scene.txt                check what was read
  scanray bake scene.txt -o scene.rs       put it into a firmware's flash
  scanray needs scene.txt                  what it asks of a device: stages, bytes
  scanray pixel scene.txt 4,3              why a pixel has its colour
  scanray diff old.png new.png             how different two pictures are
  scanray generate spheres --count 10000 -o many.txt
                                           a large scene
  scanray help example                     how a scene file is written
  scanray help render                      all that render can do

Exit codes: 0 fine, 1 a difference (diff, fmt --check), 2 usage, 3 scene, 4 files or memory."
)]
pub(crate) struct Cli {
    #[command(subcommand)]
    command: Option<Command>,
}

/// What is meant without a command.
#[derive(Parser, Debug)]
struct NoCommand {
    #[command(flatten)]
    render: RenderArgs,
}

/// The commands: to draw, to ask questions, to rewrite, the rest.
#[derive(Subcommand, Debug)]
pub(crate) enum Command {
    /// Draw scenes into image files
    Render(RenderArgs),
    /// Show a scene in the terminal, and again whenever it is saved
    View(ViewArgs),
    /// Show a display in a window, drawn as slowly as a device draws
    #[cfg(feature = "window")]
    Window(WindowArgs),
    /// Put a picture or turntable together that was drawn in parts
    Join(JoinArgs),
    /// Print a scene as it was read
    Inspect(InspectArgs),
    /// Tell what a scene asks of a device: stages, bytes, a line for firmware
    Needs(NeedsArgs),
    /// Tell how the colours of pixels come about: the tree of rays
    Pixel(PixelArgs),
    /// Compare two pictures: numbers, a picture of the differences
    Diff(DiffArgs),
    /// Print a scene to start from, its numbers explained
    Example(ExampleArgs),
    /// Rewrite scenes in canonical form, comments kept
    Fmt(FmtArgs),
    /// Write a scene as Rust source, for a `static` in a firmware's flash
    Bake(BakeArgs),
    /// Write a scene for POV-Ray
    Export(ExportArgs),
    /// Write a scene of any number of spheres or triangles, to measure with
    Generate(GenerateArgs),
    /// Ask which scene to draw: the dialogue of the original program
    Ask(AskArgs),
    /// Print what a shell needs to complete command lines
    Completions(CompletionsArgs),
    /// Print or write manual pages
    Man(ManArgs),
}

impl Cli {
    /// The command that the program's arguments name. Ends the program for `--help` and for what
    /// cannot be understood.
    pub(crate) fn from_arguments() -> Command {
        let cli = Self::try_parse().unwrap_or_else(|error| {
            let error = with_hint(harmless(error));
            // Nobody may listen.
            let _ = error.print();
            if error.kind() == ErrorKind::MissingRequiredArgument
                && let Some(example) = example_of_the_command()
            {
                say(format_args!("For example: {example}"));
            }
            std::process::exit(error.exit_code())
        });
        cli.command
            .unwrap_or_else(|| Command::Render(NoCommand::parse_from([""; 0]).render))
    }
}

/// The first example of the command that the arguments begin with.
fn example_of_the_command() -> Option<String> {
    let name = std::env::args().nth(1)?;
    let cli = Cli::command();
    let help = cli.find_subcommand(&name)?.get_after_help()?.to_string();
    let mut lines = help.lines().map(str::trim_start);
    let example = lines.find(|line| line.starts_with(&format!("scanray {name} ")))?;
    Some(example.split("  ").next()?.to_owned())
}

/// The same error, but of the words that it quotes nothing is obeyed by a terminal.
fn harmless(mut error: clap::Error) -> clap::Error {
    let quoted: Vec<_> = error
        .context()
        .filter_map(|(kind, value)| match value {
            ContextValue::String(word) => Some((kind, ContextValue::String(shown(word)))),
            ContextValue::Strings(words) => {
                let words = words.iter().map(shown).collect();
                Some((kind, ContextValue::Strings(words)))
            }
            ContextValue::StyledStrs(tips) => {
                let plain = tips.iter().map(|tip| shown(tip.to_string()).into());
                let is_harmless = tips
                    .iter()
                    .all(|tip| shown(tip.to_string()) == tip.to_string());
                (!is_harmless).then(|| (kind, ContextValue::StyledStrs(plain.collect())))
            }
            _ => None,
        })
        .collect();
    for (kind, value) in quoted {
        error.insert(kind, value);
    }
    error
}

/// Adds what a newcomer may have meant: a scene or an option without the command.
fn with_hint(error: clap::Error) -> clap::Error {
    let word = |kind| match error.get(kind) {
        Some(ContextValue::String(word)) => Some(word.clone()),
        _ => None,
    };
    let hint = match error.kind() {
        ErrorKind::InvalidSubcommand
            if word(ContextKind::InvalidSubcommand).is_some_and(|word| word == "window") =>
        {
            Some(
                "this scanray was built without windows; build it again with SDL 2 (on Debian \
                 libsdl2-dev): cargo install --path host-runner --features window"
                    .to_owned(),
            )
        }
        ErrorKind::InvalidSubcommand => word(ContextKind::InvalidSubcommand)
            .filter(|word| word.ends_with(".txt") || Path::new(word).exists())
            .map(|path| format!("{path} is no command; to draw it: scanray render {path}")),
        ErrorKind::InvalidValue if std::env::args().skip(1).any(|word| word.is_empty()) => {
            word(ContextKind::InvalidArg).map(|argument| {
                format!("{argument} is empty: a variable that is not set, perhaps?")
            })
        }
        ErrorKind::ValueValidation => word(ContextKind::InvalidValue)
            .and_then(|value| Some(format!("{}: {}", shown(&value), meant_for_option(&value)?))),
        // A negative column looks like an option.
        ErrorKind::UnknownArgument if std::env::args().nth(1).is_some_and(|a| a == "pixel") => {
            let is_negative = |argument: &String| {
                let digits = argument.strip_prefix('-');
                digits.is_some_and(|digits| digits.starts_with(|c: char| c.is_ascii_digit()))
            };
            std::env::args().find(is_negative).map(|place| {
                format!(
                    "{}: give column and row from 0 to 65535, such as 80,60",
                    shown(place)
                )
            })
        }
        ErrorKind::UnknownArgument
            if std::env::args().nth(1).is_some_and(|a| a.starts_with('-')) =>
        {
            word(ContextKind::InvalidArg).map(|option| {
                format!("{option} needs a command before it: scanray render {option} …")
            })
        }
        _ => None,
    };
    match hint {
        Some(hint) => Cli::command().error(error.kind(), hint),
        None => error,
    }
}
