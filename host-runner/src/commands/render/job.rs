//! Drawing the pictures of one scene.

use std::io::{self, Write};
use std::ops::Range;

use embedded_graphics::pixelcolor::Rgb888;
use scanray::{Picture, Resolution, Scene, Vec3, render::DisplayColor};

use super::RenderArgs;
use crate::canvas::Canvas;
use crate::console::{print, say};
use crate::cost::Work;
use crate::failure::Failure;
use crate::host_pixels::{Drawing, HostPixels};
use crate::host_tracer::HostTracer;
use crate::image::{self, Animation, ImageFormat, require_gif_memory};
use crate::interrupt;
use crate::option_values::{RangeOption, name_of, with_color};
use crate::output_files::{Place, Unwritten};
use crate::output_paths::{PictureFile, Steps};
use crate::parallel_drawing::{Parts, Workers};
use crate::picture_part::{self, PartRecord, scene_identity};
use crate::pools::{HostPools, HostScalar};
use crate::progress::Progress;
use crate::render_report::{Pools, RenderReport, TurntableReport};
use crate::render_settings::PictureSettings;
use crate::scene_file::SceneSource;
use crate::scene_lines::object_lines;
use crate::scene_listing::{self, Digits};
use crate::turntable::{Axis, Crossing, Turntable, crossings, default_axis};

/// The pictures of a scene, to be drawn.
pub(super) struct Job<'a> {
    pub(super) args: &'a RenderArgs,
    pub(super) settings: PictureSettings,
    pub(super) workers: &'a Workers,
    pub(super) scene: &'a SceneSource,
    pub(super) files: &'a [PictureFile],
    pub(super) turntable: Option<&'a Steps>,
}

/// What the pictures of a file are drawn with.
struct Studio<'a, T: HostScalar> {
    pools: &'a mut HostPools<T>,
    turntable: Option<Turntable<T>>,
    resolution: Resolution,
    rows: Range<u16>,
    progress: Progress,
}

impl Job<'_> {
    /// Draws and writes them.
    ///
    /// # Errors
    ///
    /// [`Failure`].
    pub(super) fn run<T: HostScalar + Drawing>(&self) -> Result<(), Failure> {
        let args = self.args;
        let mut pools = T::pools();
        let text = self.scene.read()?;
        self.scene.load_text(&text, &mut pools)?;
        let scene = pools.as_scene();
        if args.verbose {
            // The listing is for people when standard output is taken by data.
            if args.json || self.writes_to_stdout() {
                let _ = scene_listing::write(&mut io::stderr().lock(), &scene, Digits::AsStored);
            } else {
                still_draw(print(|out| {
                    scene_listing::write(out, &scene, Digits::AsStored)
                }))?;
            }
        }
        let resolution = self.settings.resolution(scene.resolution());
        let rows = RangeOption::within(
            args.rows,
            resolution.height,
            "--rows",
            ["the picture", "rows"],
        )
        .map_err(Failure::Usage)?;
        let axis = match self.turntable {
            Some(Steps { of, .. }) => {
                let axis = self.axis(scene)?;
                self.warn_of_crossings(scene, &crossings(scene, *of, axis), &text);
                Some(axis)
            }
            None => None,
        };
        let is_part = args.rows.is_some() || self.turntable.is_some();
        let identity = is_part.then(|| scene_identity(&scene));
        let turntable = self.turntable.zip(axis);
        let turntable = turntable.map(|(steps, axis)| Turntable::new(&scene, steps.of, axis));
        let pictures: u64 = self.files.iter().map(|file| file.steps.len() as u64).sum();
        let mut studio = Studio {
            pools: &mut pools,
            turntable,
            resolution,
            progress: Progress::new(
                format!("Drawing {}", self.scene.name()),
                rows.len() as u64 * pictures,
            ),
            rows,
        };
        let mut bytes = 0;
        for (done, file) in self.files.iter().enumerate() {
            interrupt::advise(self.advice(done), self.advice(done + 1));
            let mut report = self.report(file, axis, &studio);
            let mut work = args.json.then(Work::default);
            report.bytes = if file.format == ImageFormat::Gif {
                self.draw_animation(file, &mut studio, &mut report, work.as_mut())?
            } else {
                let record = identity
                    .as_deref()
                    .map(|scene| self.record(file, axis, scene, &studio).words());
                let step = file.steps.start;
                studio
                    .draw(self, step, &mut report, work.as_mut(), &mut |size, rows| {
                        let comment = record.as_deref();
                        let write = |out: &mut dyn Write| {
                            image::write(file.format, out, size, comment, rows)
                        };
                        Ok(file.place.write(write)?)
                    })
                    .map_err(|unwritten| unwritten.of(&file.place))?
            };
            bytes += report.bytes;
            if let Some(work) = work {
                report.set_work(&work);
                still_draw(print(|out| report.write_json(out)))?;
            }
        }
        interrupt::advise(None, None);
        let Studio { rows, .. } = studio;
        self.say_saved(resolution, &rows, bytes);
        Ok(())
    }

    fn writes_to_stdout(&self) -> bool {
        let mut files = self.files.iter();
        files.any(|file| matches!(file.place, Place::Stdout))
    }

    /// How to go on with a turntable that is interrupted when so many of its files are written.
    fn advice(&self, done: usize) -> Option<String> {
        let Steps { range, .. } = self.turntable?;
        let name = self.scene.name();
        let file = self.files.get(done)?;
        if file.format == ImageFormat::Gif {
            return (range.len() > 1).then(|| {
                format!(
                    "Interrupted: a GIF file is written whole or not at all. Numbered files can be gone on with: draw {name} \
                     with -o turn.png, the rest with --steps, then scanray join turn-*.png -o turn.gif"
                )
            });
        }
        let Range { start, end } = range;
        let next = file.steps.start;
        let drawn = match done {
            0 => "nothing is drawn yet".to_owned(),
            _ => format!("steps {start}..{next} are drawn"),
        };
        Some(format!(
            "Interrupted: {drawn} of {name}. To go on, add --steps {next}..{end}"
        ))
    }

    /// The axis that the scene turns about.
    fn axis<T: HostScalar>(&self, scene: Scene<'_, T>) -> Result<Axis, Failure> {
        if let Some(axis) = self.args.about {
            return Ok(axis);
        }
        let axis = default_axis(scene).ok_or_else(|| {
            Failure::Usage(format!(
                "--turntable: nothing of {} is in view to turn about; give --about X,Z",
                self.scene.name()
            ))
        })?;
        say(format_args!(
            "{} turns about x = {}, z = {} (--about {},{}).",
            self.scene.name(),
            axis.x,
            axis.z,
            axis.x,
            axis.z
        ));
        Ok(axis)
    }

    /// Says where the camera passes through something on its way, beyond which it may see nothing but walls.
    fn warn_of_crossings<T: HostScalar>(
        &self,
        scene: Scene<'_, T>,
        crossings: &[Crossing],
        text: &[u8],
    ) {
        if crossings.is_empty() {
            return;
        }
        let lines = object_lines(text);
        let places = crossings.chunk_by(|a, b| a.step == b.step).map(|between| {
            let lines: Vec<String> = between
                .iter()
                .filter_map(|crossing| lines.get(crossing.object as usize))
                .map(u32::to_string)
                .collect();
            let noun = if lines.len() == 1 { "line" } else { "lines" };
            format!(
                "after step {} ({noun} {})",
                between[0].step,
                lines.join(", ")
            )
        });
        let Vec3 { x, z, .. } = scene.camera().position;
        say(format_args!(
            "warning: {}: the camera passes through objects: {}. Turn about another axis, or on the spot: \
             --about {x},{z}",
            self.scene.name(),
            places.collect::<Vec<_>>().join(", ")
        ));
    }

    fn report<T: HostScalar>(
        &self,
        file: &PictureFile,
        axis: Option<Axis>,
        studio: &Studio<'_, T>,
    ) -> RenderReport {
        let settings = &self.settings;
        let turntable = self.turntable.zip(axis);
        RenderReport {
            scene: self.scene.data_name(),
            file: file.place.data_name(),
            bytes: 0,
            size: studio.resolution,
            rows: studio.rows.clone(),
            turntable: turntable.map(|(Steps { of, .. }, axis)| TurntableReport {
                steps: file.steps.clone(),
                of: *of,
                about: [axis.x, axis.z],
            }),
            scalar: T::NAME,
            color: name_of(settings.color),
            dither: settings.dither,
            max_depth: settings.max_depth,
            cutoff: settings.knobs.cutoff,
            samples: settings.knobs.samples.pattern().len(),
            adaptive: settings.knobs.edges,
            preview: name_of(settings.knobs.detail),
            threads: self.workers.count(),
            seconds: 0.0,
            cpu_seconds: 0.0,
            counted_by: "a second pass, not timed",
            rays: Default::default(),
            tests: Default::default(),
            work: Default::default(),
            predicted_instructions_per_pixel: None,
            predicted_within_percent: None,
            pools: Pools(studio.pools.usage()),
        }
    }

    /// What a file says of itself that holds a part of something.
    fn record<T: HostScalar>(
        &self,
        file: &PictureFile,
        axis: Option<Axis>,
        scene_identity: &str,
        studio: &Studio<'_, T>,
    ) -> PartRecord {
        let mut settings = vec![(picture_part::SCENE.to_owned(), scene_identity.to_owned())];
        settings.extend(axis.map(|axis| ("about".to_owned(), format!("{},{}", axis.x, axis.z))));
        settings.extend(self.settings.record());
        PartRecord {
            rows: studio.rows.clone(),
            size: studio.resolution,
            step: self.turntable.map(|steps| (file.steps.start, steps.of)),
            settings,
        }
    }

    /// Draws the pictures of a GIF file; returns its bytes.
    fn draw_animation<T: HostScalar + Drawing>(
        &self,
        file: &PictureFile,
        studio: &mut Studio<'_, T>,
        report: &mut RenderReport,
        mut work: Option<&mut Work>,
    ) -> Result<u64, Failure> {
        let Resolution { width, height } = studio.resolution;
        let delay = if file.steps.len() > 1 {
            self.args.delay
        } else {
            0
        };
        require_gif_memory([width, height])?;
        file.place.write_made(|out| {
            let mut animation = Animation::new(out, [width, height], delay)?;
            for step in file.steps.clone() {
                studio.draw(self, step, report, work.as_deref_mut(), &mut |_, rows| {
                    animation.add(rows)?;
                    Ok(0)
                })?;
            }
            Ok(animation.finish()?)
        })
    }

    fn say_saved(&self, size: Resolution, rows: &Range<u16>, bytes: u64) {
        let [first, .., last] = self.files else {
            let [file] = self.files else { return };
            let part = if rows.len() < usize::from(size.height) {
                format!("rows {}..{} of {}, ", rows.start, rows.end, size.height)
            } else if file.steps.len() > 1 {
                format!("{} pictures, ", file.steps.len())
            } else {
                String::new()
            };
            let place = match file.place {
                Place::Stdout => "written to standard output".to_owned(),
                Place::File { .. } | Place::Device(_) => {
                    format!("file {} saved", file.place.name())
                }
            };
            let (width, height) = (size.width, rows.len());
            say(format_args!(
                "Image {place} ({width}x{height}, {part}{bytes} bytes)."
            ));
            return;
        };
        let place = match first.place {
            Place::Stdout => "written to standard output".to_owned(),
            Place::File { .. } | Place::Device(_) => {
                format!(
                    "files {} to {} saved",
                    first.place.name(),
                    last.place.name()
                )
            }
        };
        let (count, width, height) = (self.files.len(), size.width, rows.len());
        say(format_args!(
            "Image {place} ({count} of {width}x{height}, {bytes} bytes)."
        ));
    }
}

/// Takes the rows of a picture of this size, and returns how many bytes were written.
type Consume<'a> =
    dyn FnMut([u16; 2], &mut dyn Iterator<Item = Vec<u8>>) -> Result<u64, Unwritten> + 'a;

impl<T: HostScalar + Drawing> Studio<'_, T> {
    /// Draws a picture, adds what it took to the report and to `work`, and returns what `consume` does.
    fn draw(
        &mut self,
        job: &Job<'_>,
        step: u16,
        report: &mut RenderReport,
        work: Option<&mut Work>,
        consume: &mut Consume<'_>,
    ) -> Result<u64, Unwritten> {
        // Step 0 is the scene as it was loaded.
        if let (Some(turntable), 1..) = (&self.turntable, step) {
            turntable
                .turn(&mut self.pools.as_mut(), step)
                .map_err(|error| {
                    Failure::Usage(format!("--turntable: cannot turn to step {step}: {error}"))
                })?;
        }
        let scene = self.pools.as_scene();
        let tracer = HostTracer::new(scene, self.resolution, job.settings.max_depth)?
            .with_knobs(job.settings.knobs);
        let pixels = T::pixels(&tracer);
        let bytes = with_color!(job.settings.color, C => {
            self.draw_in_color::<C>(job, &pixels, report, consume)
        })?;
        if let Some(work) = work {
            *work = *work + tracer.count_work(self.rows.clone(), job.workers);
        }
        Ok(bytes)
    }

    fn draw_in_color<C: DisplayColor + Into<Rgb888> + Send + Sync + 'static>(
        &self,
        job: &Job<'_>,
        pixels: &HostPixels<'_, T>,
        report: &mut RenderReport,
        consume: &mut Consume<'_>,
    ) -> Result<u64, Unwritten> {
        let picture: Picture<_, scanray::render::Exact<C>> = Picture::new(pixels);
        let (rows, workers, progress) = (self.rows.clone(), job.workers, &self.progress);
        let parts = if job.settings.dither {
            Parts::new(picture.dithered(), rows, workers, progress)
        } else {
            Parts::new(picture, rows, workers, progress)
        };
        draw_picture(
            [self.resolution.width, self.rows.len() as u16],
            parts?,
            report,
            consume,
        )
    }
}

/// Draws and writes a picture. Small ones are complete before their file is begun.
fn draw_picture(
    size: [u16; 2],
    mut parts: Parts<'_>,
    report: &mut RenderReport,
    consume: &mut Consume<'_>,
) -> Result<u64, Unwritten> {
    let first = parts.next();
    let canvases = first.into_iter().chain(&mut parts);
    let bytes = consume(size, &mut canvases.flat_map(Canvas::into_rows_rgb888))?;
    report.seconds += parts.time().as_secs_f64();
    report.cpu_seconds += parts.cpu_time().as_secs_f64();
    Ok(bytes)
}

/// A reader that has read enough of the listing or of the JSON does not end the drawing: the pictures go
/// elsewhere.
fn still_draw(printed: Result<(), Failure>) -> Result<(), Failure> {
    match printed {
        Err(Failure::ClosedPipe) => Ok(()),
        other => other,
    }
}
