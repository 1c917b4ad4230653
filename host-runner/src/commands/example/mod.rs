//! `scanray example`: a scene to start from.

use std::process::ExitCode;

use clap::Args;

use crate::console::print;
use crate::failure::Failure;

/// The default scene, its numbers explained.
const SCENE: &[u8] = include_bytes!("scene.txt");

/// The command line.
#[derive(Args, Debug)]
#[command(after_help = "\
A scene is a text of numbers, one record a line, separated by blanks. `#` begins a comment; empty lines do not count. \
The records are, in this order:

  objects         how many lines of objects follow
  camera          x y z; it looks along z, x is to the right, y up
  size            width and height in pixels, 1 to 65535
  light           x y z, specular colour, diffuse colour (red green blue each)
  ambient         intensity of the ambient light
  sky             1 = a sky that fades to white, 0 = the background colour
  background      red green blue
  sphere          0, centre x y z, radius, material
  plane           1, normal x y z, distance, material
  triangle        2, three vertices x y z, four unused numbers, material

A material has 13 numbers: diffuse, specular and ambient colour (red green blue each, 0 to 1 as a rule), reflection \
(0 = no mirror), shininess, refraction (0 = opaque), index of refraction (1.5 = glass). The points of a plane are those with \
normal·(x, y, z) + distance = 0. Objects come in any order.

Examples:
  scanray example > scene.txt       the default scene, its numbers explained by comments
  scanray example | scanray render - -o scene.png --size 160x120")]
pub(crate) struct ExampleArgs {}

/// Prints the scene.
///
/// # Errors
///
/// [`Failure`].
pub(crate) fn run(_: &ExampleArgs) -> Result<ExitCode, Failure> {
    print(|out| out.write_all(SCENE))?;
    Ok(ExitCode::SUCCESS)
}
