//! `scanray bake`: a scene as Rust source.

use std::io::{self, Write};
use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;
use scanray::bake;

use crate::console::{print, say};
use crate::failure::Failure;
use crate::option_values::ScalarName;
use crate::output_files::Place;
use crate::output_paths::refuse_input_as_output;
use crate::pools::HostScalar;
use crate::scene_file::SceneSource;

/// The command line.
#[derive(Args, Debug)]
#[command(after_help = "\
The source is an expression of type scanray::Scene<'static>. A firmware writes

  static SCENE: scanray::Scene<'static> = include!(\"scene.rs\");
  let tracer = scanray::tracer_for!(SCENE);

and has the scene in flash, with all that loading computes, and only the stages that it needs. A build script can do the \
same with scanray::bake.

Examples:
  scanray bake                              the default scene, to standard output
  scanray bake scene.txt -o scene.rs        into a file
  scanray bake scene.txt --scalar f64 -o scene.rs
                                            for a tracer in f64: scanray::Scene<'static, f64>")]
pub(crate) struct BakeArgs {
    /// Scene file, `-` for standard input; the default scene if there is none
    #[arg(value_name = "SCENE")]
    scene: Option<PathBuf>,

    /// File for the source, `-` for standard output
    #[arg(short, long, value_name = "FILE", default_value = "-")]
    output: PathBuf,

    /// Number type of the baked scene
    #[arg(long, value_name = "TYPE", default_value = "f32")]
    scalar: ScalarName,
}

/// Bakes the scene.
///
/// # Errors
///
/// [`Failure`].
pub(crate) fn run(args: &BakeArgs) -> Result<ExitCode, Failure> {
    match args.scalar {
        ScalarName::F32 => write::<f32>(args)?,
        ScalarName::F64 => write::<f64>(args)?,
    }
    Ok(ExitCode::SUCCESS)
}

fn write<T: HostScalar>(args: &BakeArgs) -> Result<(), Failure> {
    let source = SceneSource::named(args.scene.as_deref());
    let mut pools = T::pools();
    source.load(&mut pools)?;
    let scene = pools.as_scene();
    let write = |out: &mut dyn Write| -> io::Result<()> {
        let version = env!("CARGO_PKG_VERSION");
        writeln!(out, "// {} by scanray {version}.", source.name())?;
        writeln!(out, "{}", bake(&scene))
    };
    if args.output.as_os_str() == "-" {
        return print(write);
    }
    refuse_input_as_output(&args.output, source.file())?;
    let place = Place::file(&args.output)?;
    place.write(write)?;
    say(format_args!("file {} saved", place.name()));
    Ok(())
}
