//! `scanray inspect`: the scene as it is stored.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;

use crate::console::print;
use crate::failure::Failure;
use crate::option_values::ScalarName;
use crate::pools::HostScalar;
use crate::scene_file::SceneSource;
use crate::scene_json::SceneReport;
use crate::scene_listing::{self, Digits};

/// The command line.
#[derive(Args, Debug)]
#[command(after_help = "\
Numbers have the fewest digits that read back to what is stored. Planes are stored with a normal of length 1.

Examples:
  scanray inspect                      the default scene
  scanray inspect scenes/pyramids.txt
  scanray inspect scene.txt --json | jq .objects[0].radius
  sed 's/^800 600$/160 120/' scene.txt | scanray inspect -")]
pub(crate) struct InspectArgs {
    /// Scene file, `-` for standard input; the default scene if there is none
    #[arg(value_name = "SCENE")]
    scene: Option<PathBuf>,

    /// Number type that the scene is stored in
    #[arg(long, value_name = "TYPE", default_value = "f32")]
    scalar: ScalarName,

    /// Print JSON
    #[arg(long)]
    json: bool,
}

/// Prints the scene.
///
/// # Errors
///
/// [`Failure`].
pub(crate) fn run(args: &InspectArgs) -> Result<ExitCode, Failure> {
    let scene = SceneSource::named(args.scene.as_deref());
    match args.scalar {
        ScalarName::F32 => inspect::<f32>(&scene, args.json)?,
        ScalarName::F64 => inspect::<f64>(&scene, args.json)?,
    }
    Ok(ExitCode::SUCCESS)
}

fn inspect<T: HostScalar>(scene: &SceneSource, json: bool) -> Result<(), Failure> {
    let mut pools = T::pools();
    scene.load(&mut pools)?;
    if json {
        let report = SceneReport::new(scene.data_name(), &pools.as_scene());
        return print(|out| {
            serde_json::to_writer(&mut *out, &report)?;
            writeln!(out)
        });
    }
    print(|out| scene_listing::write(out, &pools.as_scene(), Digits::AsStored))
}
