//! `scanray report`: what each setting costs and what it buys.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::{Args, ValueEnum};
use scanray::Resolution;

use crate::cost::{Core, Counted, Emulator, Job};
use crate::report::{self, BothScalars, Document, Emulation, SceneReport, Sweep};
use scanray_host::console::{say, shown};
use scanray_host::failure::Failure;
use scanray_host::option_values::{Size, whole};
use scanray_host::output_files::Place;
use scanray_host::parallel_drawing::Workers;
use scanray_host::progress::Progress;
use scanray_host::scene_file::SceneSource;

/// The command line.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  scanray-lab report scene.txt --size 96x64 -o small     small/index.html and other forms
  scanray-lab report scene.txt --size 96x64 --only csv   the figures alone, as report/report.csv

Several scenes become one report: scanray-lab report scenes/*.txt. The page needs no network. Errors are measured against \
the scene in f64 and with 256 samples a pixel; instructions are predicted for Cortex-M4F, M3 and M0, or counted with --emulate. How \
each figure comes about is told at the end of the page.")]
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

    /// Count instructions under emulation, of all cores or of these, instead of predicting them: takes minutes for
    /// each scene, QEMU and a checkout of scanray
    #[arg(
        long,
        value_name = "CORE",
        value_delimiter = ',',
        num_args = 0..=1,
        require_equals = true,
        default_missing_value = "m4f,m3,m0",
        ignore_case = true
    )]
    emulate: Vec<Core>,

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

    /// The name of its file; the plots of Markdown are beside it.
    const fn file(self) -> &'static str {
        match self {
            Self::Html => "index.html",
            Self::Markdown => "report.md",
            Self::Csv => "report.csv",
            Self::Json => "report.json",
        }
    }
}

impl std::fmt::Display for Kind {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&scanray_host::option_values::name_of(*self))
    }
}

/// A scene of the command line.
struct Named {
    source: SceneSource,
    text: Vec<u8>,
    /// No other scene of the report has it, nor one that leads to the same names of files.
    name: String,
}

/// Measures and writes.
///
/// # Errors
///
/// [`Failure`]; nothing is written then.
pub(crate) fn run(args: &ReportArgs) -> Result<ExitCode, Failure> {
    let scenes = named(SceneSource::list(&args.scenes))?;
    let Size(resolution) = args.size;
    // Whatever is wrong with a scene is told before the first is measured.
    for Named { source, text, .. } in &scenes {
        source.check::<f32>(text)?;
        source.check::<f64>(text)?;
    }
    Sweep::check(resolution)?;
    let folder = &args.output;
    try_folder(folder, &args.only)?;
    let emulator = (!args.emulate.is_empty()).then(Emulator::find);
    if let Some(Err(why)) = &emulator {
        say(format_args!(
            "warning: instructions are predicted, not counted: {why}"
        ));
    }
    let document = measure_all(&scenes, resolution, args, emulator)?;
    write(&document, folder, &args.only)?;
    Ok(ExitCode::SUCCESS)
}

fn make_folder(folder: &Path) -> Result<(), Failure> {
    if folder.is_file() {
        let why = "it is a file; name a folder with --output";
        return Err(Failure::file("write the report in", folder, why));
    }
    fs::create_dir_all(folder).map_err(|error| Failure::file("make the folder", folder, error))
}

/// Makes sure that the report can be written, before minutes are spent on it. A folder that is not there yet is there
/// only when the report is.
fn try_folder(folder: &Path, kinds: &[Kind]) -> Result<(), Failure> {
    let is_new = !folder.exists();
    make_folder(folder)?;
    let tried = kinds
        .iter()
        .try_for_each(|kind| Place::file(&folder.join(kind.file())).map(drop));
    if is_new {
        // It is empty, unless somebody else put something there.
        let _ = fs::remove_dir(folder);
    }
    tried
}

/// Reads the scenes and gives each a name of its own: the file's, with folders where that is not enough.
fn named(sources: Vec<SceneSource>) -> Result<Vec<Named>, Failure> {
    let stem = |source: &SceneSource| shown(source.stem());
    let names: Vec<String> = sources
        .iter()
        .map(|source| {
            let same =
                |other: &&SceneSource| report::slug(&stem(other)) == report::slug(&stem(source));
            if sources.iter().filter(same).count() == 1 {
                stem(source)
            } else {
                source.name()
            }
        })
        .collect();
    let mut found: Vec<Named> = Vec::new();
    for (source, name) in sources.into_iter().zip(names) {
        let is_taken = |name: &String| {
            let slug = report::slug(name);
            found.iter().any(|other| report::slug(&other.name) == slug)
        };
        let mut numbered = (2..).map(|number: u32| format!("{name} {number}"));
        let own = Some(name.clone()).into_iter().chain(&mut numbered);
        let name = own
            .into_iter()
            .find(|name| !is_taken(name))
            .unwrap_or(name.clone());
        found.push(Named {
            text: source.read()?,
            source,
            name,
        });
    }
    Ok(found)
}

fn measure_all(
    scenes: &[Named],
    resolution: Resolution,
    args: &ReportArgs,
    emulator: Option<Result<Emulator, String>>,
) -> Result<Document, Failure> {
    let workers = Workers::new(args.threads)?;
    let steps = scenes.len() as u64 * (Sweep::steps() + 1);
    let progress = Progress::new("Measuring".to_owned(), steps);
    let closed_forms = report::distances(&workers)?;
    let mut reports = Vec::new();
    for Named { source, text, name } in scenes {
        let scene = BothScalars::load_text(source, text)?;
        let sweep = Sweep::new(&scene, resolution, &workers)?;
        progress.advance(1);
        reports.push(sweep.run(name.clone(), &progress)?);
    }
    drop(progress);
    let emulation = match emulator {
        None => Emulation::NotAsked,
        Some(Err(why)) => Emulation::Missing(why),
        Some(Ok(emulator)) => count(&emulator, &args.emulate, scenes, &mut reports)?,
    };
    Ok(Document::new(closed_forms, emulation, reports))
}

/// Enters what is counted under emulation.
fn count(
    emulator: &Emulator,
    cores: &[Core],
    scenes: &[Named],
    reports: &mut [SceneReport],
) -> Result<Emulation, Failure> {
    let mut failures = Vec::new();
    let all = || reports.iter().flat_map(|report| &report.configurations);
    let total = all().filter(|c| c.settings.is_for_devices()).count() * cores.len();
    let progress = Progress::new("Counting under emulation".to_owned(), total as u64);
    for (Named { text, name, .. }, report) in scenes.iter().zip(reports) {
        let indices: Vec<usize> = (0..report.configurations.len())
            .filter(|index| report.configurations[*index].settings.is_for_devices())
            .collect();
        let settings: Vec<_> = indices
            .iter()
            .map(|index| report.configurations[*index].settings)
            .collect();
        let job = Job {
            size: [report.size.width, report.size.height],
            cores: cores.iter().map(|core| core.name()).collect(),
            scenes: &[String::from_utf8_lossy(text).into_owned()],
            settings: &settings,
        };
        let configurations = &mut report.configurations;
        emulator.count(
            &job,
            |Counted {
                 setting,
                 core,
                 instructions,
                 ..
             }| {
                progress.advance(1);
                let Some(configuration) = indices
                    .get(setting)
                    .and_then(|index| configurations.get_mut(*index))
                else {
                    return;
                };
                match instructions {
                    Ok(count) => configuration.counted[core as usize] = Some(count),
                    Err(why) => {
                        let why = why.lines().next_back().unwrap_or_default();
                        failures.push(format!("{name}, {} on {core}: {why}", configuration.name));
                    }
                }
            },
        )?;
    }
    Ok(Emulation::Counted {
        cores: cores.to_vec(),
        failures,
    })
}

fn write(document: &Document, folder: &Path, kinds: &[Kind]) -> Result<(), Failure> {
    let cannot = |error| Failure::file("write the report in", folder, error);
    let mut files: Vec<(String, Vec<u8>)> = Vec::new();
    for kind in kinds {
        let name = kind.file().to_owned();
        match kind {
            Kind::Html => {
                let page = report::write_page(document).map_err(cannot)?;
                files.push((name, page.into_bytes()));
            }
            Kind::Markdown => {
                let (text, plots) = report::write_markdown(document);
                files.push((name, text.into_bytes()));
                files.extend(
                    plots
                        .into_iter()
                        .map(|(name, svg)| (name, svg.into_bytes())),
                );
            }
            Kind::Csv => {
                let mut text = Vec::new();
                report::write_csv(document, &mut text).map_err(cannot)?;
                files.push((name, text));
            }
            Kind::Json => {
                let mut text = Vec::new();
                report::write_json(document, &mut text).map_err(cannot)?;
                files.push((name, text));
            }
        }
    }
    make_folder(folder)?;
    for (name, content) in &files {
        let place = Place::file(&folder.join(name))?;
        place.write(|file| file.write_all(content))?;
    }
    if let Some((first, _)) = files.first() {
        say(format_args!("Report {} saved.", shown(folder.join(first))));
    }
    Ok(())
}
