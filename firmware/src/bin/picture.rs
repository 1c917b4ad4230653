//! Draws the baked scene and prints the picture's hash and cost.

#![no_std]
#![no_main]

use board::stack;
use scanray::{DEFAULT_MAX_DEPTH, Scene, Stages, Tracer};
use scanray_firmware::measure::{self, EMPTY_ROW, RESOLUTION, Row};

board::entry!(program, Row = EMPTY_ROW);

static SCENE: Scene<'static> = include!(concat!(env!("OUT_DIR"), "/scene.rs"));

/// What the scene needs, less what the build leaves out to see what it costs. A program that leaves nothing out says
/// `tracer_for!(SCENE)`.
const STAGES: Stages = SCENE
    .stages()
    .without(include!(concat!(env!("OUT_DIR"), "/without.rs")));

fn program(row: &mut Row) -> Result<(), &'static str> {
    stack::paint();
    let tracer = Tracer::<f32, { STAGES.bits() }, DEFAULT_MAX_DEPTH>::with_stages(SCENE);
    measure::picture(tracer.with_resolution(RESOLUTION), row);
    Ok(())
}
