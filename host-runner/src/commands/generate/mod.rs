//! `scanray generate`: scenes of any number of objects, to measure with.

mod icosphere;
mod random;
mod spheres;

use std::io::{self, Write};
use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Args, ValueEnum};

use crate::console::{print, say};
use crate::failure::Failure;
use crate::option_values::whole;
use crate::output_files::Place;
use random::Random;

/// The most objects: what the host's pools hold of a shape.
const MOST: u64 = 131_072;

/// The command line.
#[derive(Args, Debug)]
#[command(after_help = "\
spheres    N spheres of a radius of about N^(-1/3), a quarter of them mirrors, above a mirroring floor
icosphere  a closed mesh of triangles, the largest of 20 f² for a whole f that has at most N, with bumps: a boulder of \
many triangles, a gem of few; above a floor

The same kind, number and seed give the same scene everywhere.

Examples:
  scanray generate spheres --count 10000 -o spheres.txt
  scanray generate icosphere --count 20480 --seed 7 -o boulder.txt
  scanray generate spheres --count 500 | scanray render - -o spheres.png")]
pub(crate) struct GenerateArgs {
    /// What the scene is made of
    kind: Kind,

    /// How many spheres there are, or the most triangles; the floor comes on top
    #[arg(short = 'n', long, value_name = "N", default_value = "1000",
          value_parser = whole::<u32>(1..=MOST), allow_negative_numbers = true)]
    count: u32,

    /// Number that the random numbers follow from
    #[arg(long, value_name = "SEED", default_value = "1")]
    seed: u64,

    /// File for the scene, `-` for standard output
    #[arg(short, long, value_name = "FILE", default_value = "-")]
    output: PathBuf,
}

/// What a scene is made of.
#[derive(Clone, Copy, Debug, ValueEnum)]
enum Kind {
    /// Random spheres
    Spheres,
    /// A ball of triangles with bumps
    Icosphere,
}

/// Writes the scene.
///
/// # Errors
///
/// [`Failure`].
pub(crate) fn run(args: &GenerateArgs) -> Result<ExitCode, Failure> {
    let mut random = Random::new(args.seed);
    let objects = match args.kind {
        Kind::Spheres => spheres::objects(args.count, &mut random),
        Kind::Icosphere => {
            if args.count < icosphere::FEWEST {
                return Err(Failure::Usage(format!(
                    "an icosphere has at least {} triangles: give --count {} or more",
                    icosphere::FEWEST,
                    icosphere::FEWEST
                )));
            }
            icosphere::objects(args.count, &mut random)
        }
    };
    let kind = args.kind.to_possible_value();
    let name = kind.as_ref().map_or("", |kind| kind.get_name());
    let title = format!(
        "scanray generate {name} --count {} --seed {}",
        args.count, args.seed
    );
    let write = |out: &mut dyn Write| write_scene(out, &title, &objects);
    if args.output.as_os_str() == "-" {
        return print(write).map(|()| ExitCode::SUCCESS);
    }
    let place = Place::file(&args.output)?;
    place.write(write)?;
    say(format_args!("file {} saved", place.name()));
    Ok(ExitCode::SUCCESS)
}

/// Writes scene text: the objects, seen from the origin, under a sky.
fn write_scene(out: &mut dyn Write, title: &str, objects: &[String]) -> io::Result<()> {
    writeln!(out, "# {title}")?;
    writeln!(out, "{} # objects", objects.len())?;
    writeln!(out, "0 0 0 # camera")?;
    writeln!(out, "800 600 # pixels")?;
    writeln!(out, "5 12 -6 0.7 0.7 0.7 1 1 1 # light")?;
    writeln!(out, "0.2 # ambient")?;
    writeln!(out, "1 # sky")?;
    writeln!(out, "0 0 0")?;
    for object in objects {
        writeln!(out, "{object}")?;
    }
    Ok(())
}

/// The 13 numbers of an opaque, shining material.
fn material([r, g, b]: [f64; 3], reflection: f64) -> String {
    format!("{r} {g} {b} 0.4 0.4 0.4 {r} {g} {b} {reflection} 40 0 0")
}

/// A floor below everything.
fn floor(reflection: f64) -> String {
    format!("1 0 1 0 1 {}", material([0.6, 0.6, 0.6], reflection))
}
