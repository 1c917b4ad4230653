//! `scanray fmt`: scenes in canonical form.

use std::path::PathBuf;
use std::process::ExitCode;

use annotate_snippets::Renderer;
use clap::Args;

use crate::canonical_text::canonical;
use crate::console::{print, say, shown};
use crate::failure::Failure;
use crate::option_values::ScalarName;
use crate::output_files::Place;
use crate::pools::HostScalar;
use crate::scene_file::SceneSource;

/// The command line.
#[derive(Args, Debug)]
#[command(after_help = "\
Numbers keep their value to the last digit and comments stay, so that the picture keeps its bits. \
Numbers that belong together stand together, `+.50` becomes `0.5`, a light of 8 numbers gets its \
ninth. A scene with an error is left as it is. Files are written beside their place and renamed.

Examples:
  scanray fmt scene.txt                 rewrite a scene
  scanray fmt scenes/*.txt              or several
  scanray fmt scene.txt -o tidy.txt     leave the file as it is and write another
  scanray fmt - < scene.txt             from standard input to standard output
  scanray fmt --check scene.txt         write nothing; exit code 1 if it would change

Exit codes: 0 fine, 1 --check found a scene that would change, 2 usage, 3 scene, 4 files.")]
pub(crate) struct FmtArgs {
    /// Scene files, `-` for standard input
    #[arg(value_name = "SCENE", required = true)]
    scenes: Vec<PathBuf>,

    /// Write another file, `-` for standard output, instead of the scene's own
    #[arg(short, long, value_name = "FILE", conflicts_with = "check")]
    output: Option<PathBuf>,

    /// Write nothing, but name the scenes that would change
    #[arg(long)]
    check: bool,

    /// Number type that has room for the scene's numbers
    #[arg(long, value_name = "TYPE", default_value = "f32")]
    scalar: ScalarName,
}

/// Rewrites the scenes. One that fails does not keep the others from being written.
///
/// # Errors
///
/// [`Failure`], for what concerns them all.
pub(crate) fn run(args: &FmtArgs) -> Result<ExitCode, Failure> {
    if let (Some(output), [_, _, ..]) = (&args.output, &*args.scenes) {
        return Err(Failure::Usage(format!(
            "-o {} cannot take {} scenes: leave -o out to rewrite each in its place",
            shown(output),
            args.scenes.len()
        )));
    }
    let mut code = ExitCode::SUCCESS;
    for path in &args.scenes {
        let result = match args.scalar {
            ScalarName::F32 => format_one::<f32>(path, args),
            ScalarName::F64 => format_one::<f64>(path, args),
        };
        let its_code = match result {
            Ok(its_code) => its_code,
            Err(Failure::ClosedPipe) => return Err(Failure::ClosedPipe),
            Err(failure) => failure.report(),
        };
        if code == ExitCode::SUCCESS {
            code = its_code;
        }
    }
    Ok(code)
}

fn format_one<T: HostScalar>(path: &PathBuf, args: &FmtArgs) -> Result<ExitCode, Failure> {
    let source = SceneSource::named(Some(path));
    let text = source.read()?;
    let mut pools = T::pools();
    source.load_text(&text, &mut pools)?;
    let tidy = canonical(&text);
    // The file is not touched unless what replaces it is the same scene.
    let print_scene = |pools: &crate::pools::HostPools<T>| {
        scanray::print(&pools.as_scene())
            .map(|text| text.to_string())
            .map_err(|error| Failure::Scene(format!("error: {}: {error}", source.name())))
    };
    let before = print_scene(&pools)?;
    // Its warnings were told.
    source.parse(&tidy, &mut pools, &Renderer::plain())?;
    if print_scene(&pools)? != before {
        return Err(Failure::Scene(format!(
            "error: {}: the canonical form would be another scene, which is a fault of this program; the file is as \
             it was",
            source.name()
        )));
    }
    drop(pools);
    if args.check {
        if tidy == text {
            return Ok(ExitCode::SUCCESS);
        }
        say(format_args!("{} is not in canonical form", source.name()));
        return Ok(ExitCode::from(1));
    }
    let is_own = args.output.is_none();
    let output = args.output.as_ref().unwrap_or(path);
    if output.as_os_str() == "-" {
        print(|out| out.write_all(&tidy))?;
    } else if !(is_own && tidy == text) {
        let place = Place::file(output)?;
        place.write(|file| file.write_all(&tidy))?;
        say(format_args!("{} written in canonical form", place.name()));
    }
    Ok(ExitCode::SUCCESS)
}
