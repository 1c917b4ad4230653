//! `scanray report`: what each setting costs and what it buys.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::{Args, ValueEnum};
use scanray::Resolution;

use crate::console::say;
use crate::drawing::Workers;
use crate::failure::Failure;
use crate::options::{Size, whole};
use crate::output::Place;
use crate::progress::Progress;
use crate::report::{self, BothScalars, Document, Sweep};
use crate::scene_file::SceneSource;

/// The command line.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  scanray report scene.txt --size 96x64 -o small     small/index.html and other forms
  scanray report scene.txt --size 96x64 --only csv   the figures alone, as report/report.csv

Several scenes become one report: scanray report scenes/*.txt. The page needs no network. Errors are measured against \
the scene in f64 and with 256 samples a pixel; instructions are predicted for Cortex-M4F, M3 and M0. How each figure comes \
about is told at the end of the page.")]
pub(crate) struct ReportArgs {
    /// Scene files, `-` for standard input; the default scene if there are none
    #[arg(value_name = "SCENE")]
    scenes: Vec<PathBuf>,

    /// Folder for the report; made if there is none
    #[arg(short, long, value_name = "DIR", default_value = "report")]
    output: PathBuf,

    /// Width and height in pixels
    #[arg(long, value_name = "WxH", default_value = "160x120")]
    size: Size,

    /// Write only these
    #[arg(long, value_name = "KIND", value_delimiter = ',', default_values_t = Kind::ALL)]
    only: Vec<Kind>,

    /// Threads that draw [default: one for each core]; host time is that of one
    #[arg(long, value_name = "N", value_parser = whole::<u16>(1..=1024), allow_negative_numbers = true)]
    threads: Option<u16>,
}

/// What a report is written as.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Kind {
    /// index.html
    Html,
    /// report.md and its plots as SVG
    Markdown,
    /// report.csv
    Csv,
    /// report.json
    Json,
}

impl Kind {
    const ALL: [Self; 4] = [Self::Html, Self::Markdown, Self::Csv, Self::Json];
}

impl std::fmt::Display for Kind {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&crate::options::name_of(*self))
    }
}

/// Measures and writes.
///
/// # Errors
///
/// [`Failure`]; nothing is written then.
pub(crate) fn run(args: &ReportArgs) -> Result<ExitCode, Failure> {
    let scenes = SceneSource::list(&args.scenes);
    let Size(resolution) = args.size;
    let folder = &args.output;
    fs::create_dir_all(folder).map_err(|error| Failure::file("make the folder", folder, error))?;
    let workers = Workers::new(args.threads)?;
    let steps = scenes.len() as u64 * (Sweep::steps() + 1);
    let progress = Progress::new("Measuring".to_owned(), steps);
    let reports = scenes
        .iter()
        .map(|scene| measure(scene, &scenes, resolution, &workers, &progress))
        .collect::<Result<Vec<_>, _>>()?;
    drop(progress);
    write(&Document::new(reports), folder, &args.only)?;
    Ok(ExitCode::SUCCESS)
}

fn measure(
    source: &SceneSource,
    all: &[SceneSource],
    resolution: Resolution,
    workers: &Workers,
    progress: &Progress,
) -> Result<report::SceneReport, Failure> {
    let scene = BothScalars::load(source)?;
    let sweep = Sweep::new(&scene, resolution, workers)?;
    progress.advance(1);
    // Two scenes of the same name are told apart by their folders.
    let stem = source.stem().display().to_string();
    let is_alone = all
        .iter()
        .filter(|other| other.stem() == source.stem())
        .count()
        == 1;
    let name = if is_alone { stem } else { source.name() };
    sweep.run(name, progress)
}

fn write(document: &Document, folder: &Path, kinds: &[Kind]) -> Result<(), Failure> {
    let cannot = |error| Failure::file("write the report in", folder, error);
    let mut files: Vec<(String, Vec<u8>)> = Vec::new();
    for kind in kinds {
        match kind {
            Kind::Html => {
                let page = report::write_page(document).map_err(cannot)?;
                files.push(("index.html".to_owned(), page.into_bytes()));
            }
            Kind::Markdown => {
                let (text, plots) = report::write_markdown(document);
                files.push(("report.md".to_owned(), text.into_bytes()));
                files.extend(
                    plots
                        .into_iter()
                        .map(|(name, svg)| (name, svg.into_bytes())),
                );
            }
            Kind::Csv => {
                let mut text = Vec::new();
                report::write_csv(document, &mut text).map_err(cannot)?;
                files.push(("report.csv".to_owned(), text));
            }
            Kind::Json => {
                let mut text = Vec::new();
                report::write_json(document, &mut text).map_err(cannot)?;
                files.push(("report.json".to_owned(), text));
            }
        }
    }
    for (name, content) in &files {
        let place = Place::file(&folder.join(name))?;
        place.write(|file| file.write_all(content))?;
    }
    if let Some((first, _)) = files.first() {
        say(format_args!(
            "Report {} saved.",
            folder.join(first).display()
        ));
    }
    Ok(())
}
