//! `scanray render`: scenes into image files.

mod job;

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;

use self::job::Job;
use crate::console::print;
use crate::displays;
use crate::failure::Failure;
use crate::image::ImageFormat;
use crate::option_values::{RangeOption, ScalarName, axis, centiseconds, whole};
use crate::output_files::Place;
use crate::output_paths::{PictureFile, Steps, places};
use crate::parallel_drawing::Workers;
use crate::render_settings::PictureArgs;
use crate::scene_file::SceneSource;
use crate::turntable::Axis;

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
  scanray render scene.txt --turntable 36 -o turn.gif --display ssd1351
                                                      seen from all around, as a film
  scanray render scene.txt --turntable 36 -o turn.png
                                                      the same, to turn-000.png, turn-001.png …
  scanray render scene.txt --rows 0..3 -o upper.png   a part of its rows
  scanray render scenes/*.txt -o pictures             each scene to pictures/NAME.ppm
  scanray render scene.txt -o - | pnmtojpeg > scene.jpg
  scanray render scene.txt --json | jq .rays          what the picture took")]
pub(crate) struct RenderArgs {
    /// Scene files, `-` for standard input; the default scene if there are none
    #[arg(value_name = "SCENE")]
    scenes: Vec<PathBuf>,

    /// File that ends in .ppm, .png or .gif, existing folder, or `-` for PPM on standard output [default:
    /// output.ppm for one scene, NAME.ppm for each of several; .gif for turntables]
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,

    #[command(flatten)]
    picture: PictureArgs,

    /// Draw only rows A up to, but not including, B; the file holds nothing else, and says so in a
    /// comment, for `scanray join`
    #[arg(long, value_name = "A..B", allow_hyphen_values = true)]
    rows: Option<RangeOption>,

    /// Draw the scene from all around, in N steps: the camera circles it to the right, the light stays
    /// with the scene. A GIF file holds all pictures, PPM and PNG files get numbers. In a small room the
    /// camera may leave through a wall, of which a warning tells; --about with the camera's own x and z
    /// turns it on the spot
    #[arg(long, value_name = "N", value_parser = whole::<u16>(1..=65_535), allow_negative_numbers = true)]
    turntable: Option<u16>,

    /// Draw only steps A up to, but not including, B of the turntable
    #[arg(
        long,
        value_name = "A..B",
        requires = "turntable",
        allow_hyphen_values = true
    )]
    steps: Option<RangeOption>,

    /// The vertical axis that the camera circles [default: through the middle of what is in view at the
    /// scene's own size, or near it if the camera passes through objects otherwise]
    #[arg(
        long,
        value_name = "X,Z",
        requires = "turntable",
        value_parser = axis,
        allow_hyphen_values = true
    )]
    about: Option<Axis>,

    /// How long a GIF file shows each picture, in milliseconds
    #[arg(
        long,
        value_name = "MS",
        default_value = "100",
        requires = "turntable",
        value_parser = centiseconds
    )]
    delay: u16,

    /// Threads that draw [default: one for each core]; the picture is the same for any number
    #[arg(long, value_name = "N", value_parser = whole::<u16>(1..=1024), allow_negative_numbers = true)]
    threads: Option<u16>,

    /// Print time, rays, intersection tests and pools as JSON, one line for each scene
    #[arg(long)]
    json: bool,

    /// Print the scene data, as `scanray inspect` does
    #[arg(short, long)]
    verbose: bool,
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
    let settings = args.picture.settings()?;
    let turntable = args.steps()?;
    let scenes = SceneSource::list(&args.scenes);
    let places = places(&scenes, args.output.as_deref(), turntable.as_ref())?;
    let any = |is: fn(&PictureFile) -> bool| places.iter().flatten().any(is);
    if args.json && any(|file| matches!(file.place, Place::Stdout)) {
        return Err(Failure::Usage(
            "--json and -o - both want standard output: name a file with -o".to_owned(),
        ));
    }
    if args.rows.is_some() && any(|file| file.format == ImageFormat::Gif) {
        return Err(Failure::Usage(
            "--rows: a GIF file has too few colours for a part; draw parts into .ppm or .png files \
             with -o, then join them into a GIF file with scanray join"
                .to_owned(),
        ));
    }
    let workers = Workers::new(args.threads)?;
    let mut code = ExitCode::SUCCESS;
    for (scene, files) in scenes.iter().zip(&places) {
        let job = Job {
            args,
            settings,
            workers: &workers,
            scene,
            files,
            turntable: turntable.as_ref(),
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

impl RenderArgs {
    /// The steps of the turntable.
    fn steps(&self) -> Result<Option<Steps>, Failure> {
        let steps = |of| {
            let range = RangeOption::within(self.steps, of, "--steps", ["the turntable", "steps"])
                .map_err(Failure::Usage)?;
            Ok(Steps { range, of })
        };
        self.turntable.map(steps).transpose()
    }
}
