//! `scanray diff`: how different two pictures are.

use std::io::Write;
use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Args, ValueEnum};
use serde::Serialize;

use crate::compare::{Comparison, DEFAULT_PIXELS_PER_DEGREE, flip_picture, level_picture};
use crate::console::{print, say, shown};
use crate::failure::Failure;
use crate::image::{self, Image, ImageFormat};
use crate::option_values::whole;
use crate::output_paths::{refuse_input_as_output, single_place};
use crate::picture_memory::require;

/// The command line.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  scanray diff old.png new.png                  how different, in numbers
  scanray diff old.png new.ppm -o diff.png      and where: a picture with a legend
  scanray diff old.png new.png -o flip.png --map flip
                                                where one would see it (FLIP)
  scanray diff old.png new.png --tolerance 2    fine if no channel is more than 2 levels off
  scanray render scene.txt -o - | scanray diff golden.png - --json

Exit codes: 0 within the tolerance, 1 beyond it, 2 usage or other sizes, 4 files or memory.")]
pub(crate) struct DiffArgs {
    /// The picture to compare with: PNG or PPM, `-` for standard input
    #[arg(value_name = "A")]
    reference: PathBuf,

    /// The picture to judge: the same size, PNG or PPM, `-` for standard input
    #[arg(value_name = "B")]
    test: PathBuf,

    /// Write a picture of the differences: a file that ends in .ppm or .png, or `-` for PPM on
    /// standard output
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,

    /// What the picture of the differences shows
    #[arg(
        long,
        value_name = "MAP",
        default_value = "levels",
        requires = "output"
    )]
    map: Map,

    /// Levels of 255 that a channel may differ by before the exit code is 1
    #[arg(
        long,
        value_name = "N",
        default_value_t = 0,
        value_parser = whole::<u8>(0..=255),
        allow_negative_numbers = true
    )]
    tolerance: u8,

    /// Pixels that one degree of the visual field covers, for FLIP: 67 is a 4K screen 0.7 m wide seen
    /// from 0.7 m; more is farther away
    #[arg(
        long,
        value_name = "N",
        default_value_t = DEFAULT_PIXELS_PER_DEGREE,
        value_parser = pixels_per_degree,
        allow_negative_numbers = true
    )]
    pixels_per_degree: f32,

    /// Print the measures as JSON
    #[arg(long)]
    json: bool,
}

/// What a picture of differences shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Map {
    /// By how many levels the pixels differ, a colour for each power of 2
    Levels,
    /// The FLIP error, black to yellow
    Flip,
}

/// # Errors
///
/// A sentence.
fn pixels_per_degree(word: &str) -> Result<f32, String> {
    word.parse()
        .ok()
        .filter(|ppd| (1.0..=1000.0).contains(ppd))
        .ok_or_else(|| "give a number from 1 to 1000".to_owned())
}

/// What `--json` prints.
#[derive(Debug, Serialize)]
struct Measures {
    reference: String,
    test: String,
    width: usize,
    height: usize,
    pixels: u64,
    /// Pixels with any difference.
    different: u64,
    tolerance: u8,
    /// Pixels that differ by more than the tolerance.
    beyond_tolerance: u64,
    /// In levels of 255.
    maximum: u8,
    /// Column and row of the first such pixel.
    maximum_at: Option<[usize; 2]>,
    /// In levels of 255, over all channels.
    rmse: f64,
    /// In decibels; none for equal pictures.
    psnr: Option<f64>,
    /// Mean, 0 to 1.
    flip: f64,
    pixels_per_degree: f32,
}

/// Compares the pictures.
///
/// # Errors
///
/// [`Failure`].
pub(crate) fn run(args: &DiffArgs) -> Result<ExitCode, Failure> {
    let place = match &args.output {
        Some(output) => {
            refuse_input_as_output(output, [&args.reference, &args.test])?;
            Some(single_place(output, ImageFormat::EXACT)?)
        }
        None => None,
    };
    let is_to_stdout = args
        .output
        .as_ref()
        .is_some_and(|path| path.as_os_str() == "-");
    if args.json && is_to_stdout {
        return Err(Failure::Usage(
            "--json and -o - both want standard output: name a file with -o".to_owned(),
        ));
    }
    if args.reference.as_os_str() == "-" && args.test.as_os_str() == "-" {
        return Err(Failure::Usage(
            "standard input has one picture: give a file for the other".to_owned(),
        ));
    }
    let reference = Image::read(&args.reference)?;
    let test = Image::read(&args.test)?;
    if (reference.width, reference.height) != (test.width, test.height) {
        return Err(Failure::Usage(format!(
            "the pictures have different sizes: {} is {}x{}, {} is {}x{}; draw both with the same --size",
            shown(&args.reference),
            reference.width,
            reference.height,
            shown(&args.test),
            test.width,
            test.height
        )));
    }
    let pixels = reference.width as u64 * reference.height as u64;
    require(
        16 * pixels,
        "the comparison",
        "compare smaller pictures, or parts of them",
    )?;
    let comparison = Comparison::of(&reference, &test, args.pixels_per_degree);
    let measures = Measures {
        reference: args.reference.to_string_lossy().into_owned(),
        test: args.test.to_string_lossy().into_owned(),
        width: reference.width,
        height: reference.height,
        pixels: comparison.pixels(),
        different: comparison.pixels_beyond(0),
        tolerance: args.tolerance,
        beyond_tolerance: comparison.pixels_beyond(args.tolerance),
        maximum: comparison.maximum(),
        maximum_at: comparison.largest_at(),
        rmse: comparison.rmse,
        psnr: Some(comparison.psnr()).filter(|psnr| psnr.is_finite()),
        flip: comparison.flip(),
        pixels_per_degree: args.pixels_per_degree,
    };
    if let Some((place, format)) = place {
        let picture = match args.map {
            Map::Levels => level_picture(&reference, &test),
            Map::Flip => flip_picture(&reference, &comparison),
        };
        place.write(|file| image::write_whole(format, file, &picture))?;
        say(format_args!("Picture of the differences: {}", place.name()));
    }
    if args.json {
        print(|out| {
            serde_json::to_writer(&mut *out, &measures)?;
            writeln!(out)
        })?;
    } else if is_to_stdout {
        let _ = measures.write(&mut std::io::stderr().lock());
    } else {
        print(|out| measures.write(out))?;
    }
    Ok(match measures.beyond_tolerance {
        0 => ExitCode::SUCCESS,
        _ => ExitCode::from(1),
    })
}

impl Measures {
    /// For people.
    fn write(&self, out: &mut dyn Write) -> std::io::Result<()> {
        let percent = |count: u64| 100.0 * count as f64 / self.pixels as f64;
        writeln!(out, "size      {}x{}", self.width, self.height)?;
        writeln!(
            out,
            "different {} of {} pixels ({:.3} %)",
            self.different,
            self.pixels,
            percent(self.different)
        )?;
        if self.tolerance > 0 {
            writeln!(
                out,
                "beyond    {} pixels ({:.3} %) differ by more than {}",
                self.beyond_tolerance,
                percent(self.beyond_tolerance),
                self.tolerance
            )?;
        }
        write!(out, "maximum   {} of 255", self.maximum)?;
        match self.maximum_at {
            Some([x, y]) => writeln!(out, " (first at {x},{y})")?,
            None => writeln!(out)?,
        }
        writeln!(out, "RMSE      {:.4} of 255", self.rmse)?;
        match self.psnr {
            Some(psnr) => writeln!(out, "PSNR      {psnr:.2} dB")?,
            None => writeln!(out, "PSNR      infinite")?,
        }
        writeln!(
            out,
            "FLIP      {:.5} (mean; 0 looks the same, 1 as different as can be; {:.0} pixels a degree)",
            self.flip, self.pixels_per_degree
        )
    }
}
