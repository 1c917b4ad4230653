//! Draws the baked scene without the rays that hardly show and prints the picture's hash and cost: `SCANRAY_CUTOFF`, an
//! expression of Rust, which is `1.0 / 256.0` unless it is set.

#![no_std]
#![no_main]

use board::stack;
use scanray::{Scene, tracer_for};
use scanray_firmware::measure::{self, EMPTY_ROW, RESOLUTION, Row};

board::entry!(program, Row = EMPTY_ROW);

static SCENE: Scene<'static> = include!(concat!(env!("OUT_DIR"), "/scene.rs"));

const CUTOFF: f32 = include!(concat!(env!("OUT_DIR"), "/cutoff.rs"));

fn program(row: &mut Row) -> Result<(), &'static str> {
    stack::paint();
    let tracer = tracer_for!(SCENE, cutoff = CUTOFF);
    measure::picture(tracer.with_resolution(RESOLUTION), row);
    Ok(())
}
