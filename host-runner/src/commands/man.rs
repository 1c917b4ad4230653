//! `scanray man`: manual pages.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Args, Command};
use clap_mangen::Man;
use roff::{Roff, roman};

use crate::console::{print, say, shown};
use crate::failure::Failure;
use crate::output_files::Place;

/// The command line.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  scanray man > scanray.1              the page of the program; man -l scanray.1 shows it
  scanray man render > render.1        the page of a command
  scanray man -o pictures              all pages into a folder, such as ~/.local/share/man/man1")]
pub struct ManArgs {
    /// Command whose page is printed [default: the program's]
    #[arg(value_name = "COMMAND", conflicts_with = "output")]
    command: Option<String>,

    /// Write all pages into this folder, which must exist
    #[arg(short, long, value_name = "FOLDER")]
    output: Option<PathBuf>,
}

/// Prints or writes the pages of a program.
///
/// # Errors
///
/// [`Failure`].
pub fn run(args: &ManArgs, program: Command) -> Result<ExitCode, Failure> {
    let name_of_program = program.get_name().to_owned();
    let prefix = format!("{name_of_program}-");
    let mut pages = pages(program);
    if let Some(folder) = &args.output {
        if !folder.is_dir() {
            return Err(Failure::Files(format!(
                "there is no folder {}: create it first",
                shown(folder)
            )));
        }
        let count = pages.len();
        for (name, page) in pages {
            Place::file(&folder.join(format!("{name}.1")))?.write(|file| file.write_all(&page))?;
        }
        say(format_args!("{count} pages written to {}", shown(folder)));
        return Ok(ExitCode::SUCCESS);
    }
    let name = match &args.command {
        Some(command) => format!("{prefix}{command}"),
        None => name_of_program,
    };
    let Some(index) = pages.iter().position(|(page, _)| *page == name) else {
        let names: Vec<_> = pages
            .iter()
            .filter_map(|(name, _)| name.strip_prefix(&*prefix))
            .collect();
        return Err(Failure::Usage(format!(
            "there is no command {}; there are {}",
            args.command.as_deref().unwrap_or_default(),
            names.join(", ")
        )));
    };
    let (_, page) = pages.swap_remove(index);
    print(|out| out.write_all(&page))?;
    Ok(ExitCode::SUCCESS)
}

/// Name and text of each page: the program's, then the commands'.
fn pages(program: Command) -> Vec<(String, Vec<u8>)> {
    let own_name = program.get_name().to_owned();
    let mut program = program.disable_help_subcommand(true);
    program.build();
    let commands = program.get_subcommands().cloned().collect::<Vec<_>>();
    let page = |name: String, command: Command| {
        let mut page = Vec::new();
        let help = command.get_after_help().map(ToString::to_string);
        let command = command
            .after_help(None::<&str>)
            .after_long_help(None::<&str>);
        // Writing to memory does not fail.
        let _ = Man::new(command).render(&mut page);
        page.extend(
            help.iter()
                .flat_map(|help| sections(help).to_roff().into_bytes()),
        );
        (name, page)
    };
    let of_commands = commands.into_iter().map(|command| {
        let name = format!("{own_name}-{}", command.get_name());
        page(name.clone(), command.name(name.clone()).display_name(name))
    });
    [page(own_name.clone(), program.clone())]
        .into_iter()
        .chain(of_commands)
        .collect()
}

/// The sections of what a help text says after the options: notes, exit codes, examples.
fn sections(help: &str) -> Roff {
    let (mut notes, mut status, mut examples) = (Roff::new(), Roff::new(), Roff::new());
    for paragraph in help.split("\n\n") {
        let (first, rest) = paragraph.split_once('\n').unwrap_or((paragraph, ""));
        if first == "Examples:" {
            as_it_is(&mut examples, rest.lines());
        } else if let Some(codes) = paragraph.strip_prefix("Exit codes: ") {
            status.text([roman(codes)]);
        } else if first.starts_with(' ') {
            as_it_is(&mut notes, paragraph.lines());
        } else {
            notes.control("PP", []);
            notes.text([roman(paragraph)]);
        }
    }
    let mut all = Roff::new();
    for (title, section) in [
        ("NOTES", notes),
        ("EXIT STATUS", status),
        ("EXAMPLES", examples),
    ] {
        if section != Roff::new() {
            all.control("SH", [title]).extend([section]);
        }
    }
    all
}

/// Lines that are not filled.
fn as_it_is<'a>(page: &mut Roff, lines: impl Iterator<Item = &'a str>) {
    page.control("PP", []).control("nf", []);
    for line in lines {
        page.text([roman(line.strip_prefix("  ").unwrap_or(line))]);
    }
    page.control("fi", []);
}
