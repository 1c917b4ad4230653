//! `scanray inspect`: the scene as it is stored.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;

use crate::console::print;
use crate::failure::Failure;
use crate::option_values::ScalarName;
use crate::pools::HostScalar;
use crate::scene_file::SceneSource;
use crate::scene_listing;

/// The command line.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  scanray inspect                      the default scene
  scanray inspect scenes/pyramids.txt
  sed 's/^800 600$/160 120/' scene.txt | scanray inspect -")]
pub(crate) struct InspectArgs {
    /// Scene file, `-` for standard input; the default scene if there is none
    #[arg(value_name = "SCENE")]
    scene: Option<PathBuf>,

    /// Number type that the scene is stored in
    #[arg(long, value_name = "TYPE", default_value = "f32")]
    scalar: ScalarName,
}

/// Prints the scene.
///
/// # Errors
///
/// [`Failure`].
pub(crate) fn run(args: &InspectArgs) -> Result<ExitCode, Failure> {
    let scene = SceneSource::named(args.scene.as_deref());
    match args.scalar {
        ScalarName::F32 => inspect::<f32>(&scene)?,
        ScalarName::F64 => inspect::<f64>(&scene)?,
    }
    Ok(ExitCode::SUCCESS)
}

fn inspect<T: HostScalar>(scene: &SceneSource) -> Result<(), Failure> {
    let mut pools = T::pools();
    scene.load(&mut pools)?;
    print(|out| scene_listing::write(out, &pools.as_scene()))
}
