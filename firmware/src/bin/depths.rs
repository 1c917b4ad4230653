//! Draws the baked scene at several maximum depths and prints what each takes: what the host's instruction model is fitted to.

#![no_std]
#![no_main]

use board::console;
use scanray::{Scene, Tracer};
use scanray_firmware::measure::{self, EMPTY_ROW, RESOLUTION, Row};

board::entry!(program, Row = EMPTY_ROW);

static SCENE: Scene<'static> = include!(concat!(env!("OUT_DIR"), "/scene.rs"));

/// The deepest of them.
const STACK: usize = 8;

fn program(row: &mut Row) -> Result<(), &'static str> {
    let tracer = Tracer::<f32, { SCENE.needs().bits() }, STACK>::with_stages(SCENE)
        .with_resolution(RESOLUTION);
    for depth in [0, 2, 5, STACK] {
        // The compiler must not know the depth: it is one code for all.
        let depth = core::hint::black_box(depth);
        let tracer = tracer.with_max_depth(depth).map_err(|_| "too deep")?;
        console::decimal("depth ", depth as u32);
        measure::picture(tracer, row);
    }
    Ok(())
}
