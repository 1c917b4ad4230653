//! `scanray stability`: the catalogue of stiff and extreme cases, measured.

mod report;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Args;
use rayon::prelude::*;
use scanray_stability::catalogue::{Case, Effort, ScalarName};
use scanray_stability::pictures::{self, Pictures, Telling};
use scanray_stability::random::Random;

use report::{Measured, Shown};
use scanray_host::console::{print, say};
use scanray_host::failure::Failure;
use scanray_host::image::{self, Image, ImageFormat};
use scanray_host::option_values::whole;
use scanray_host::output_files::Place;

/// The command line.
#[derive(Args, Debug)]
#[command(after_help = "\
Without options, all 73 cases are measured, one of them on every scene at 800x600, which takes a minute or so.

Examples:
  scanray-lab stability 26 44                  two of the cases
  scanray-lab stability 1 2 3 --json | jq .    their figures as JSON
  scanray-lab stability 58 -o pictures         and the pictures of telling cases
  scanray-lab stability 10 --markdown          as docs/stability.md has it
  SEED=7 scanray-lab stability 3               with other random numbers

Figures of random numbers name their seed. The environment variable SEED, a whole number, replaces all seeds.

Exit codes: 1 a figure exceeds its bound.")]
pub(crate) struct StabilityArgs {
    /// Numbers of cases; all if there are none
    #[arg(value_name = "CASE", value_parser = whole::<u8>(1..=73), allow_negative_numbers = true)]
    cases: Vec<u8>,

    /// Compare the scenes at 160x120 instead of 800x600
    #[arg(long)]
    quick: bool,

    /// Print JSON
    #[arg(long, conflicts_with = "markdown")]
    json: bool,

    /// Print a Markdown document
    #[arg(long)]
    markdown: bool,

    /// Folder for the pictures of the telling cases, made if it is not there
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
}

/// Measures the cases and prints what was found.
///
/// # Errors
///
/// [`Failure`].
pub(crate) fn run(args: &StabilityArgs) -> Result<ExitCode, Failure> {
    Random::named_seed().map_err(Failure::Usage)?;
    let effort = if args.quick {
        Effort::Quick
    } else {
        Effort::Full
    };
    let is_wanted = |case: &Case| args.cases.is_empty() || args.cases.contains(&case.number);
    let cases: Vec<_> = Case::all().into_iter().filter(is_wanted).collect();
    let measured: Vec<Measured> = cases
        .par_iter()
        .flat_map(|case| {
            ScalarName::ALL.map(|scalar| Measured {
                case: *case,
                scalar,
                findings: case.measure(scalar, effort),
            })
        })
        .collect();
    let shown: Vec<Shown> = if args.markdown || args.output.is_some() {
        Telling::all()
            .into_iter()
            .map(|telling| Shown {
                pictures: telling.draw(),
                telling,
            })
            .collect()
    } else {
        Vec::new()
    };
    if let Some(folder) = &args.output {
        write_pictures(folder, &shown)?;
    }
    print(|out| {
        if args.json {
            report::write_json(out, &measured)
        } else if args.markdown {
            report::write_markdown(out, &measured, &shown)
        } else {
            report::write_table(out, &measured)
        }
    })?;
    Ok(if measured.iter().all(Measured::passes) {
        ExitCode::SUCCESS
    } else {
        ExitCode::from(1)
    })
}

/// Writes the three pictures of each telling case into one file, from left to right: scanray in `f32`, the
/// textbook in `f32`, scanray in `f64`.
fn write_pictures(folder: &Path, shown: &[Shown]) -> Result<(), Failure> {
    fs::create_dir_all(folder).map_err(|error| Failure::file("make", folder, error))?;
    for Shown { telling, pictures } in shown {
        let place = Place::file(&folder.join(format!("{}.png", telling.name)))?;
        let picture = side_by_side(pictures);
        place.write(|file| image::write_whole(ImageFormat::Png, file, &picture))?;
        say(format_args!("Picture {} saved.", place.name()));
    }
    Ok(())
}

/// Three pictures in one, with white between them.
fn side_by_side(pictures: &Pictures) -> Image {
    const GAP: usize = 4;
    let (width, height) = (
        usize::from(pictures::SIZE.width),
        usize::from(pictures::SIZE.height),
    );
    let three = [&pictures.single, &pictures.textbook, &pictures.double];
    let rows = (0..height).map(|y| {
        let row = |picture: &Vec<[u8; 3]>| picture[y * width..][..width].to_vec();
        three.map(row).join(&[[255; 3]; GAP][..])
    });
    Image {
        width: 3 * width + 2 * GAP,
        height,
        rgb888: rows.flatten().flatten().collect(),
    }
}
