//! `scanray export`: a scene for other renderers.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Args;
use scanray::DEFAULT_MAX_DEPTH;

use crate::console::{print, say, shown};
use crate::failure::Failure;
use crate::option_values::{ScalarName, Size, max_depth};
use crate::output_files::Place;
use crate::output_paths::refuse_input_as_output;
use crate::pools::HostScalar;
use crate::povray::PovScene;
use crate::scene_file::SceneSource;

/// The command line.
#[derive(Args, Debug)]
#[command(after_help = "\
The camera, objects, light, shadows, highlights, mirrors and glass are the same. POV-Ray draws the \
same picture but for

  * colours above 1 in mirrors and behind glass: scanray clamps the colour of every ray to 0…1
  * total reflection: POV-Ray mirrors there, scanray adds nothing
  * planes and triangles that bend light (an index other than 1): solids for POV-Ray
  * the maximum depth where rays pass straight (index 1): POV-Ray does not count them
  * highlights of another tint than the light's: POV-Ray gets the mean of their channels
  * refraction coefficients above 0.999

Examples:
  scanray export scene.txt -o scene.pov      the file tells how to draw it with povray
  scanray export scenes/pyramids.txt -o small.pov --size 160x120
  scanray export scene.txt                   to standard output")]
pub(crate) struct ExportArgs {
    /// Scene file, `-` for standard input
    #[arg(value_name = "SCENE")]
    scene: PathBuf,

    /// File that ends in .pov, `-` for standard output
    #[arg(short, long, value_name = "FILE", default_value = "-")]
    output: PathBuf,

    /// Width and height in pixels, which decide the width of the view [default: the scene's own]
    #[arg(long, value_name = "WxH")]
    size: Option<Size>,

    /// How many mirrored or refracted rays may follow one another, at most 32
    #[arg(
        long,
        value_name = "N",
        default_value_t = DEFAULT_MAX_DEPTH,
        value_parser = max_depth,
        allow_negative_numbers = true
    )]
    max_depth: usize,

    /// Number type that has room for the scene's numbers, which are written in full
    #[arg(long, value_name = "TYPE", default_value = "f32")]
    scalar: ScalarName,
}

/// Writes the scene.
///
/// # Errors
///
/// [`Failure`].
pub(crate) fn run(args: &ExportArgs) -> Result<ExitCode, Failure> {
    let source = SceneSource::named(Some(&args.scene));
    let place = place(&args.output)?;
    if let Some(Place::File { name, .. }) = &place {
        refuse_input_as_output(name, source.file())?;
    }
    let text = source.read()?;
    if args.scalar == ScalarName::F32 {
        // What scanray cannot draw in f32 is no scene for the other commands either.
        source.check::<f32>(&text)?;
    }
    let mut pools = f64::pools();
    source.load_text(&text, &mut pools)?;
    let scene = pools.as_scene();
    let file = match &place {
        Some(_) => args.output.clone(),
        None => source.stem().with_extension("pov"),
    };
    let pov = PovScene {
        scene,
        name: &source.name(),
        file: &file,
        resolution: args.size.map_or(scene.resolution(), |Size(size)| size),
        max_depth: args.max_depth,
    };
    match place {
        None => print(|out| write!(out, "{pov}"))?,
        Some(place) => {
            place.write(|file| write!(file, "{pov}"))?;
            say(format_args!(
                "Scene for POV-Ray written to {}",
                place.name()
            ));
        }
    }
    Ok(ExitCode::SUCCESS)
}

/// The file that is meant; `None` for standard output.
fn place(output: &Path) -> Result<Option<Place>, Failure> {
    if output.as_os_str() == "-" {
        return Ok(None);
    }
    let is_pov = output
        .extension()
        .is_some_and(|extension| extension.eq_ignore_ascii_case("pov"));
    if !is_pov {
        return Err(Failure::Usage(format!(
            "-o {}: the name must end in .pov, for POV-Ray",
            shown(output)
        )));
    }
    Place::file(output).map(Some)
}
