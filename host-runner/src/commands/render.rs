//! `scanray render`: scenes into image files.

use std::io;
use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;
use embedded_graphics::pixelcolor::Rgb888;
use scanray::{DisplayColor, Picture, Quantizer};

use crate::canvas::Canvas;
use crate::console::{print, say};
use crate::displays;
use crate::drawing::{Drawing, HostTracer, Parts, Workers};
use crate::failure::Failure;
use crate::image::{self, ImageFormat};
use crate::options::{RowRange, ScalarName, name_of, with_color};
use crate::output::Place;
use crate::picture_args::{PictureArgs, PictureSettings};
use crate::places::places;
use crate::pools::HostScalar;
use crate::render_report::{Pools, RenderReport};
use crate::scene_data;
use crate::scene_file::SceneSource;

/// The command line.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  scanray render                                      the default scene, to output.ppm
  scanray render scenes/pyramids.txt -o pyramids.png  a PNG file
  scanray render scene.txt -o tft.png --display st7789
                                                      as a small colour display shows it
  scanray render --display list                       displays, and what each name stands for
  scanray render scene.txt -o oled.png --size 72x40 --color binary --dither
                                                      as any other display shows it
  scanray render scenes/*.txt -o pictures             each scene to pictures/NAME.ppm
  scanray render scene.txt -o - | pnmtojpeg > scene.jpg
  scanray render scene.txt --json | jq .rays          what the picture took")]
pub(crate) struct RenderArgs {
    /// Scene files, `-` for standard input; the default scene if there are none
    #[arg(value_name = "SCENE")]
    scenes: Vec<PathBuf>,

    /// File that ends in .ppm or .png, existing folder, or `-` for PPM on standard output [default:
    /// output.ppm for one scene, NAME.ppm for each of several]
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,

    #[command(flatten)]
    picture: PictureArgs,

    /// Draw only rows A up to, but not including, B; the file holds nothing else
    #[arg(long, value_name = "A..B")]
    rows: Option<RowRange>,

    /// Threads that draw [default: one for each core]; the picture is the same for any number
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,

    /// Print time, rays, intersection tests and pools as JSON, one line for each scene
    #[arg(long)]
    json: bool,

    /// Print the scene data, as `scanray inspect` does
    #[arg(short, long)]
    verbose: bool,
}

/// A reader that has read enough of the listing or of the JSON does not end the drawing: the pictures go
/// elsewhere.
fn still_draw(printed: Result<(), Failure>) -> Result<(), Failure> {
    match printed {
        Err(Failure::ClosedPipe) => Ok(()),
        other => other,
    }
}

/// A picture to be drawn.
struct Job<'a> {
    args: &'a RenderArgs,
    settings: PictureSettings,
    workers: &'a Workers,
    scene: &'a SceneSource,
    place: &'a Place,
    format: ImageFormat,
}

/// Draws the scenes. One that fails does not keep the others from being drawn.
///
/// # Errors
///
/// [`Failure`], for what concerns them all.
pub(crate) fn run(args: &RenderArgs) -> Result<ExitCode, Failure> {
    if args.picture.wants_list() {
        return print(displays::write_list).map(|()| ExitCode::SUCCESS);
    }
    let settings = args.picture.settings();
    let scenes = SceneSource::list(&args.scenes);
    let places = places(&scenes, args.output.as_deref())?;
    if args.json && matches!(*places, [(Place::Stdout, _)]) {
        return Err(Failure::Usage(
            "--json and -o - both want standard output: name a file with -o".to_owned(),
        ));
    }
    let workers = Workers::new(args.threads)?;
    let mut code = ExitCode::SUCCESS;
    for (scene, (place, format)) in scenes.iter().zip(&places) {
        let job = Job {
            args,
            settings,
            workers: &workers,
            scene,
            place,
            format: *format,
        };
        let result = match settings.scalar {
            ScalarName::F32 => job.run::<f32>(),
            ScalarName::F64 => job.run::<f64>(),
        };
        match result {
            Ok(()) => {}
            Err(Failure::ClosedPipe) => return Err(Failure::ClosedPipe),
            Err(failure) => {
                let its_code = failure.report();
                if code == ExitCode::SUCCESS {
                    code = its_code;
                }
            }
        }
    }
    Ok(code)
}

impl Job<'_> {
    fn run<T: HostScalar + Drawing>(&self) -> Result<(), Failure> {
        let args = self.args;
        let mut pools = T::pools();
        self.scene.load(&mut pools)?;
        let scene = pools.as_scene();
        if args.verbose {
            // The listing is for people when standard output is taken by data.
            if args.json || matches!(self.place, Place::Stdout) {
                let _ = scene_data::write(&mut io::stderr().lock(), &scene);
            } else {
                still_draw(print(|out| scene_data::write(out, &scene)))?;
            }
        }
        let settings = &self.settings;
        let resolution = settings.resolution(scene.resolution);
        let rows = RowRange::within(args.rows, resolution.height).map_err(Failure::Usage)?;
        let tracer = HostTracer::new(scene, resolution, settings.max_depth)?;
        let mut report = RenderReport {
            scene: self.scene.name(),
            file: self.place.name(),
            bytes: 0,
            size: resolution,
            rows: rows.clone(),
            scalar: T::NAME,
            color: name_of(settings.color),
            dither: settings.dither,
            max_depth: settings.max_depth,
            threads: self.workers.count(),
            seconds: 0.0,
            cpu_seconds: 0.0,
            counted_by: "a second pass, not timed",
            rays: Default::default(),
            tests: Default::default(),
            pools: Pools(pools.usage()),
        };
        let pixels = T::pixels(&tracer);
        with_color!(settings.color, C => self.draw_in_color::<T, C>(&pixels, &mut report))?;
        self.say_saved(&report);
        if args.json {
            report.set_work(&tracer.count_work(rows, self.workers));
            still_draw(print(|out| report.write_json(out)))?;
        }
        Ok(())
    }

    fn draw_in_color<T: Drawing, C: DisplayColor + Into<Rgb888> + Send + Sync>(
        &self,
        pixels: &T::Pixels<'_>,
        report: &mut RenderReport,
    ) -> Result<(), Failure> {
        let picture = Picture::new(pixels);
        if self.settings.dither {
            self.draw::<T, scanray::Dithered<C>>(picture.dithered(), report)
        } else {
            self.draw::<T, scanray::Exact<C>>(picture, report)
        }
    }

    /// Draws and writes the picture. Small ones are complete before their file is begun.
    fn draw<T: Drawing, Q: Quantizer<Color: DisplayColor + Into<Rgb888> + Send> + Sync>(
        &self,
        picture: Picture<&T::Pixels<'_>, Q>,
        report: &mut RenderReport,
    ) -> Result<(), Failure> {
        let rows = report.rows.clone();
        let mut parts = Parts::new(picture, rows.clone(), self.workers, &report.scene);
        let first = parts.next();
        report.bytes = self.place.write(|file| {
            let size = [report.size.width, rows.len() as u16];
            let canvases = first.into_iter().chain(&mut parts);
            let mut rows = canvases.flat_map(Canvas::into_rows_rgb888);
            image::write(self.format, file, size, &mut rows)
        })?;
        report.seconds = parts.time().as_secs_f64();
        report.cpu_seconds = parts.cpu_time().as_secs_f64();
        Ok(())
    }

    fn say_saved(&self, report: &RenderReport) {
        let RenderReport {
            size, rows, bytes, ..
        } = report;
        let part = if rows.len() < usize::from(size.height) {
            format!("rows {}..{} of {}, ", rows.start, rows.end, size.height)
        } else {
            String::new()
        };
        let place = match self.place {
            Place::Stdout => "written to standard output".to_owned(),
            Place::File { .. } | Place::Device(_) => format!("file {} saved", self.place.name()),
        };
        let (width, height) = (size.width, rows.len());
        say(format_args!(
            "Image {place} ({width}x{height}, {part}{bytes} bytes)."
        ));
    }
}
