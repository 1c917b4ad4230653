//! `scanray ask`: the dialogue of the original program.

use std::io::{self, BufRead};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Args;
use embedded_graphics::pixelcolor::Rgb888;
use scanray::{DEFAULT_MAX_DEPTH, Picture, render::Exact};

use crate::canvas::Canvas;
use crate::console::{print, say, shown};
use crate::failure::Failure;
use crate::host_pixels::Drawing;
use crate::host_tracer::HostTracer;
use crate::image::{self, ImageFormat};
use crate::output_files::Place;
use crate::output_paths::refuse_input_as_output;
use crate::parallel_drawing::{Parts, Workers};
use crate::pools::HostScalar;
use crate::progress::Progress;
use crate::scene_file::SceneSource;
use crate::scene_listing::{self, Digits};

/// Where the picture goes.
const OUTPUT: &str = "output.ppm";

/// The command line.
#[derive(Args, Debug)]
#[command(after_help = "\
A wrong answer is asked for again. The end of the input ends the program: with exit code 0, or that \
of the last error that was told.

Examples:
  echo 1 | scanray ask                  the default scene
  printf '0\\nscene.txt\\n' | scanray ask
                                        a scene of one's own")]
pub(crate) struct AskArgs {}

/// Asks for a scene and draws it.
///
/// # Errors
///
/// [`Failure`].
pub(crate) fn run(_: &AskArgs) -> Result<ExitCode, Failure> {
    print(|out| writeln!(out, "RAY TRACER"))?;
    let mut code = ExitCode::SUCCESS;
    loop {
        let Some(scene) = ask_for_scene()? else {
            print(|out| writeln!(out))?;
            say("The input has ended: no picture is drawn.");
            return Ok(code);
        };
        match draw(&scene) {
            Ok(()) => return Ok(ExitCode::SUCCESS),
            Err(Failure::ClosedPipe) => return Err(Failure::ClosedPipe),
            Err(failure) => code = failure.report(),
        }
    }
}

/// The scene that is named; `None` at the end of the input.
fn ask_for_scene() -> Result<Option<SceneSource>, Failure> {
    loop {
        let prompt = "Enter 1 for default scene input file or 0 to specify filename: ";
        match ask(prompt)?.as_deref() {
            None => return Ok(None),
            Some("1") => return Ok(Some(SceneSource::Default)),
            Some("0") => break,
            Some(_) => say("Please answer 1 or 0."),
        }
    }
    loop {
        let prompt = "Enter the name of the input text file (ex.'scenedata.txt'): ";
        match ask(prompt)?.as_deref() {
            None => return Ok(None),
            Some("") => say("Please name a file."),
            Some(name) => return Ok(Some(SceneSource::File(PathBuf::from(name)))),
        }
    }
}

/// The answer to a question, without blanks around it; `None` at the end of the input.
fn ask(prompt: &str) -> Result<Option<String>, Failure> {
    print(|out| write!(out, "{prompt}"))?;
    let mut answer = Vec::new();
    let count = io::stdin()
        .lock()
        .read_until(b'\n', &mut answer)
        .map_err(|error| Failure::Files(format!("cannot read the answer: {error}")))?;
    Ok((count > 0).then(|| String::from_utf8_lossy(&answer).trim().to_owned()))
}

/// Lists and draws a scene.
fn draw(source: &SceneSource) -> Result<(), Failure> {
    let mut pools = f32::pools();
    source.load(&mut pools)?;
    let scene = pools.as_scene();
    print(|out| {
        writeln!(out)?;
        scene_listing::write(out, &scene, Digits::AsPublished)?;
        writeln!(out)
    })?;
    let output = Path::new(OUTPUT);
    refuse_input_as_output(output, source.file())?;
    let place = Place::file(output)?;
    let workers = Workers::new(None)?;
    let size = scene.resolution();
    let tracer = HostTracer::new(scene, size, DEFAULT_MAX_DEPTH)?;
    let pixels = f32::pixels(&tracer);
    let picture: Picture<_, Exact<Rgb888>> = Picture::new(&pixels);
    let progress = Progress::new(format!("Drawing {}", source.name()), size.height.into());
    let parts = Parts::new(picture, 0..size.height, &workers, &progress)?;
    place.write(|file| {
        let mut rows = parts.flat_map(Canvas::into_rows_rgb888);
        let size = [size.width, size.height];
        image::write(ImageFormat::Ppm, file, size, None, &mut rows)
    })?;
    let folder = std::env::current_dir().map_or("this folder".to_owned(), shown);
    print(|out| writeln!(out, "Image file {OUTPUT} saved in {folder}"))
}
