//! `scanray join`: a picture from its parts, or a turntable from its pictures.

use std::fs;
use std::io;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Args;

use crate::console::say;
use crate::failure::Failure;
use crate::image::{self, Animation, Image, ImageFormat};
use crate::options::centiseconds;
use crate::output::Place;
use crate::part::PartRecord;
use crate::places::{PictureFile, Steps, files, refuse_input_as_output, single_place};
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

Exit codes: 0 fine, 2 parts that do not fit together, 4 files.")]
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
    let pictures = pictures(&parts, steps.unwrap_or(1))?;
    refuse_gaps(&pictures, size.height)?;

    let turntable = steps.map(|of| Steps { range: 0..of, of });
    let place = single_place(&args.output)?;
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
        self.path.display().to_string()
    }

    fn refuse_unless_of_the_same(&self, first: &Self) -> Result<(), Failure> {
        let differences = first.record.differences(&self.record);
        if differences.is_empty() {
            return Ok(());
        }
        Err(Failure::Usage(format!(
            "{} is no part of the same picture as {}: {}",
            self.name(),
            first.name(),
            differences.join(", ")
        )))
    }

    /// The rows, each as bytes.
    fn rows(&self) -> Result<Image, Failure> {
        Image::read(self.path)
    }
}

/// The parts of each picture, of `count`, from parts in order.
fn pictures<'p, 'a>(parts: &'p [Part<'a>], count: u16) -> Result<Vec<&'p [Part<'a>]>, Failure> {
    let index = |part: &Part<'_>| part.record.step.map_or(0, |(index, _)| index);
    let pictures: Vec<_> = (0..count)
        .map(|step| {
            let start = parts.partition_point(|part| index(part) < step);
            let end = parts.partition_point(|part| index(part) <= step);
            &parts[start..end]
        })
        .collect();
    let missing: Vec<u16> = (0..count)
        .zip(&pictures)
        .filter(|(_, parts)| parts.is_empty())
        .map(|(step, _)| step)
        .collect();
    if !missing.is_empty() {
        let ranges = ranges(&missing);
        return Err(Failure::Usage(format!(
            "steps {} of the turntable's {count} are missing: draw them with scanray render --steps {}",
            ranges.join(", "),
            ranges[0]
        )));
    }
    Ok(pictures)
}

/// Numbers in order as ranges `A..B`.
fn ranges(numbers: &[u16]) -> Vec<String> {
    numbers
        .chunk_by(|a, b| a + 1 == *b)
        .map(|run| format!("{}..{}", run[0], run[0] as usize + run.len()))
        .collect()
}

/// Refuses pictures that lack rows, or have rows twice.
fn refuse_gaps(pictures: &[&[Part<'_>]], height: u16) -> Result<(), Failure> {
    for parts in pictures {
        let mut missing = Vec::new();
        // The rows above `next` are there; the part that reached farthest down has the last of them.
        let (mut next, mut lowest): (u16, Option<&Part<'_>>) = (0, None);
        for part in *parts {
            let Range { start, end } = part.record.rows;
            if let Some(before) = lowest.filter(|_| start < next) {
                return Err(Failure::Usage(format!(
                    "rows {start}..{} are both in {} and in {}: leave one of them out",
                    end.min(next),
                    before.name(),
                    part.name()
                )));
            }
            missing.extend(next..start);
            (next, lowest) = (end, Some(part));
        }
        missing.extend(next..height);
        if !missing.is_empty() {
            let step = parts.first().and_then(|part| part.record.step);
            let step = step.map_or(String::new(), |(step, _)| format!(" of step {step}"));
            let ranges = ranges(&missing);
            return Err(Failure::Usage(format!(
                "rows {}{step} are missing, of 0..{height}: draw them with scanray render --rows {}",
                ranges.join(", "),
                ranges[0]
            )));
        }
    }
    Ok(())
}

/// Writes a picture, part by part, so that no more than one is in memory.
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
    file.place.write(|out| {
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
            .flat_map(|image| {
                let rows = image.rgb888.chunks_exact(3 * image.width);
                rows.map(<[u8]>::to_vec).collect::<Vec<_>>()
            });
        let result = image::write(file.format, out, size, comment.as_deref(), &mut rows);
        drop(rows);
        match failure {
            Some(Failure::Files(words)) => Err(io::Error::other(words)),
            Some(_) => Err(io::Error::other("a part cannot be read any more")),
            None => result,
        }
    })
}

/// Writes pictures into a GIF file.
fn write_animation(
    file: &PictureFile,
    pictures: &[&[Part<'_>]],
    size: [u16; 2],
    delay: u16,
    progress: &Progress,
) -> Result<u64, Failure> {
    let in_memory = |error: io::Error| Failure::Files(format!("cannot make the GIF: {error}"));
    let mut animation = Animation::new(size, delay).map_err(in_memory)?;
    for parts in pictures {
        let mut pixels = Vec::new();
        for part in *parts {
            pixels.append(&mut part.rows()?.rgb888);
            progress.advance(1);
        }
        animation.add(&pixels).map_err(in_memory)?;
    }
    let encoded = animation.finish().map_err(in_memory)?;
    file.place.write(|out| out.write_all(&encoded))
}
