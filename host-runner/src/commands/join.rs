//! `scanray join`: a picture from its parts, or a turntable from its pictures.

use std::fs;
use std::io;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Args;

use crate::console::{say, shown};
use crate::failure::Failure;
use crate::image::{self, Animation, Image, ImageFormat, require_gif_memory};
use crate::option_values::centiseconds;
use crate::output_files::{Place, Unwritten};
use crate::output_paths::{PictureFile, Steps, files, refuse_input_as_output, single_place};
use crate::picture_part::PartRecord;
use crate::progress::Progress;

/// The command line.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  scanray render scene.txt --rows 0..3 -o upper.ppm
  scanray render scene.txt --rows 3.. -o lower.ppm
                                          two parts, which two machines may draw
  scanray join upper.ppm lower.ppm -o whole.png
                                          the picture
  scanray render scene.txt --turntable 4 -o film.png
                                          four pictures, film-000.png to film-003.png
  scanray join film-*.png -o film.gif     the film

The bits are those of one run on one machine. Parts say in a comment what they are part of; docs/several-machines.md \
tells how to share the work among hosts.

Exit codes: 0 fine, 2 parts that do not fit together, 4 files or memory.")]
pub(crate) struct JoinArgs {
    /// Files of `scanray render` with --rows, --turntable or both, PPM or PNG, in any order
    #[arg(value_name = "PART", required = true)]
    parts: Vec<PathBuf>,

    /// File that ends in .ppm, .png or .gif, or `-` for PPM on standard output; the pictures of a
    /// turntable become one GIF file, or numbered files
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,

    /// How long a GIF file shows each picture of a turntable, in milliseconds
    #[arg(long, value_name = "MS", default_value = "100", value_parser = centiseconds)]
    delay: u16,
}

/// A file and what it says of itself.
#[derive(Debug)]
struct Part<'a> {
    path: &'a Path,
    record: PartRecord,
}

/// Joins the parts.
///
/// # Errors
///
/// [`Failure::Usage`] for parts that do not fit together, and [`Failure::Files`].
pub(crate) fn run(args: &JoinArgs) -> Result<ExitCode, Failure> {
    refuse_input_as_output(&args.output, &args.parts)?;
    let mut parts = args
        .parts
        .iter()
        .map(|path| Part::read(path))
        .collect::<Result<Vec<_>, _>>()?;
    let Some(first) = parts.first() else {
        return Err(Failure::Usage("there are no parts".to_owned()));
    };
    for part in &parts {
        part.refuse_unless_of_the_same(first)?;
    }
    let (size, steps) = (first.record.size, first.record.step.map(|(_, of)| of));
    parts.sort_by_key(|part| (part.record.step, part.record.rows.start));
    let pictures = pictures(&parts, steps.unwrap_or(1));
    refuse_doubles(&pictures)?;
    refuse_gaps(&pictures, &parts[0].record)?;

    let turntable = steps.map(|of| Steps { range: 0..of, of });
    let place = single_place(&args.output, ImageFormat::ALL)?;
    let progress = Progress::new("Joining".to_owned(), parts.len() as u64);
    for file in files(&args.output, place, turntable.as_ref())? {
        let pictures = &pictures[usize::from(file.steps.start)..usize::from(file.steps.end)];
        let bytes = match file.format {
            ImageFormat::Gif => {
                let delay = if pictures.len() > 1 { args.delay } else { 0 };
                write_animation(&file, pictures, [size.width, size.height], delay, &progress)?
            }
            ImageFormat::Ppm | ImageFormat::Png => {
                let [picture] = pictures else { continue };
                write_picture(&file, picture, &progress)?
            }
        };
        let place = match file.place {
            Place::Stdout => "written to standard output".to_owned(),
            Place::File { .. } | Place::Device(_) => format!("file {} saved", file.place.name()),
        };
        let (width, height) = (size.width, size.height);
        say(format_args!(
            "Image {place} ({width}x{height}, {bytes} bytes)."
        ));
    }
    Ok(ExitCode::SUCCESS)
}

impl<'a> Part<'a> {
    /// Makes sure that a file is a part of something, and whole.
    fn read(path: &'a Path) -> Result<Self, Failure> {
        let cannot = |why: &str| Failure::file("join", path, why);
        let file = fs::read(path).map_err(|error| Failure::file("read", path, error))?;
        let image = Image::decode(&file).map_err(|why| Failure::file("read", path, why))?;
        let comment = image::comment(&file);
        let record = comment
            .as_deref()
            .and_then(PartRecord::parse)
            .ok_or_else(|| {
                cannot(
                    "it does not say which part of a picture it is; draw parts with scanray render \
                     --rows or --turntable, and join them before other programs change them",
                )
            })?;
        let size = (usize::from(record.size.width), record.rows.len());
        if size != (image.width, image.height) {
            let ((width, rows), found) = (size, (image.width, image.height));
            return Err(cannot(&format!(
                "it is {}x{} pixels instead of {width}x{rows}: another program has changed it",
                found.0, found.1
            )));
        }
        Ok(Self { path, record })
    }

    fn name(&self) -> String {
        shown(self.path)
    }

    fn refuse_unless_of_the_same(&self, first: &Self) -> Result<(), Failure> {
        let differences = first.record.differences(&self.record);
        if differences.is_empty() {
            return Ok(());
        }
        Err(Failure::Usage(format!(
            "{} is no part of the same picture as {}: {}; draw both from the same scene with the same options",
            self.name(),
            first.name(),
            differences.join(", ")
        )))
    }

    /// Says that another part has rows of this one.
    fn shares_rows(&self, other: &Self) -> String {
        let [one, two] = [self, other].map(|part| fs::canonicalize(part.path).ok());
        if one.is_some() && one == two {
            return format!("{} is given twice: leave it out once", self.name());
        }
        let (mine, others) = (&self.record.rows, &other.record.rows);
        let step = self.record.step;
        format!(
            "rows {}..{}{} are both in {} and in {}: leave one of them out",
            others.start,
            mine.end.min(others.end),
            step.map_or(String::new(), |(step, _)| format!(" of step {step}")),
            self.name(),
            other.name()
        )
    }

    /// The rows, each as bytes.
    fn rows(&self) -> Result<Image, Failure> {
        Image::read(self.path)
    }
}

/// The parts of each picture, of `count`, from parts in order.
fn pictures<'p, 'a>(parts: &'p [Part<'a>], count: u16) -> Vec<&'p [Part<'a>]> {
    let index = |part: &Part<'_>| part.record.step.map_or(0, |(index, _)| index);
    let of_step = |step| {
        let start = parts.partition_point(|part| index(part) < step);
        let end = parts.partition_point(|part| index(part) <= step);
        &parts[start..end]
    };
    (0..count).map(of_step).collect()
}

/// Refuses pictures that have rows twice.
fn refuse_doubles(pictures: &[&[Part<'_>]]) -> Result<(), Failure> {
    for parts in pictures {
        // The part that reached farthest down so far.
        let mut lowest: Option<&Part<'_>> = None;
        for part in *parts {
            let start = part.record.rows.start;
            if let Some(before) = lowest.filter(|before| start < before.record.rows.end) {
                return Err(Failure::Usage(before.shares_rows(part)));
            }
            lowest = Some(part);
        }
    }
    Ok(())
}

/// Refuses pictures that lack rows, and tells how to draw them all. `first` is any of the parts.
fn refuse_gaps(pictures: &[&[Part<'_>]], first: &PartRecord) -> Result<(), Failure> {
    let height = first.size.height;
    // The rows that each picture lacks.
    let gaps: Vec<Vec<Range<u16>>> = pictures
        .iter()
        .map(|parts| {
            let starts = parts.iter().map(|part| part.record.rows.start);
            let ends = parts.iter().map(|part| part.record.rows.end);
            let between = [0].into_iter().chain(ends).zip(starts.chain([height]));
            let between = between.map(|(end, start)| end..start);
            between.filter(|rows| !rows.is_empty()).collect()
        })
        .collect();
    let (mut missing, mut commands) = (Vec::new(), Vec::new());
    let mut step = 0;
    for run in gaps.chunk_by(|a, b| a == b) {
        let steps = step..step + run.len();
        step = steps.end;
        for rows in &run[0] {
            let Range { start, end } = rows;
            let is_whole = first.step.is_some() && *rows == (0..height);
            let (mut what, mut option) = match is_whole {
                true => (String::new(), String::new()),
                false => (
                    format!("rows {start}..{end}"),
                    format!(" --rows {start}..{end}"),
                ),
            };
            if let Some((_, of)) = first.step {
                let Range { start, end } = steps;
                let of_steps = if is_whole { "steps " } else { " of steps " };
                what += &format!("{of_steps}{start}..{end}");
                option = format!(" --turntable {of} --steps {start}..{end}{option}");
            }
            missing.push(what);
            commands.push(format!(
                "\n  scanray render SCENE{option}{} -o FILE",
                first.options()
            ));
        }
    }
    if missing.is_empty() {
        return Ok(());
    }
    let whole = match first.step {
        Some((_, of)) => format!("rows 0..{height} of steps 0..{of}"),
        None => format!("rows 0..{height}"),
    };
    Err(Failure::Usage(format!(
        "{} of {whole} are missing; draw them, and join them with what is there:{}",
        missing.join(", "),
        commands.concat()
    )))
}

/// Writes a picture.
fn write_picture(
    file: &PictureFile,
    parts: &[Part<'_>],
    progress: &Progress,
) -> Result<u64, Failure> {
    // As one run on one machine would have written it.
    let Some(Part { record, .. }) = parts.first() else {
        return Ok(0);
    };
    let whole = record.step.map(|_| PartRecord {
        rows: 0..record.size.height,
        ..record.clone()
    });
    let comment = whole.map(|record| record.words());
    let size = [record.size.width, record.size.height];
    file.place.write_made(|out| {
        with_rows(parts, progress, |rows| {
            image::write(file.format, out, size, comment.as_deref(), rows)
        })
    })
}

/// Lets `write` have the rows of a picture, part by part, so that no more than one is in memory.
fn with_rows(
    parts: &[Part<'_>],
    progress: &Progress,
    write: impl FnOnce(&mut dyn Iterator<Item = Vec<u8>>) -> io::Result<()>,
) -> Result<(), Unwritten> {
    let mut failure = None;
    let mut rows = parts
        .iter()
        .map_while(|part| match part.rows() {
            Ok(image) => {
                progress.advance(1);
                Some(image)
            }
            Err(error) => {
                failure = Some(error);
                None
            }
        })
        .flat_map(
            |Image {
                 width,
                 height,
                 rgb888,
             }| {
                (0..height).map(move |y| rgb888[3 * width * y..][..3 * width].to_vec())
            },
        );
    let written = write(&mut rows);
    drop(rows);
    match failure {
        // What was written ends too early.
        Some(failure) => Err(failure.into()),
        None => Ok(written?),
    }
}

/// Writes pictures into a GIF file.
fn write_animation(
    file: &PictureFile,
    pictures: &[&[Part<'_>]],
    size: [u16; 2],
    delay: u16,
    progress: &Progress,
) -> Result<u64, Failure> {
    require_gif_memory(size)?;
    file.place.write_made(|out| {
        let mut animation = Animation::new(out, size, delay)?;
        for parts in pictures {
            with_rows(parts, progress, |rows| animation.add(rows))?;
        }
        Ok(animation.finish()?)
    })
}
