//! Draws the baked scene at several maximum depths and prints what each takes: what the host's instruction model is fitted to.

#![no_std]
#![no_main]

use board::console;
use embedded_graphics::pixelcolor::{Rgb888, RgbColor};
use scanray::{Exact, Picture, PixelSource, Resolution, Scene, Tracer};

/// A quarter of the pictures whose costs are published: a pixel takes as much, and there are many to draw.
const RESOLUTION: Resolution = Resolution {
    width: 80,
    height: 60,
};

type Row = [Rgb888; RESOLUTION.width as usize];

board::entry!(program, Row = [Rgb888::BLACK; RESOLUTION.width as usize]);

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
        console::hexadecimal("ticks ", ticks(tracer, row));
    }
    Ok(())
}

/// What drawing a picture row by row takes.
#[inline(always)]
fn ticks(source: impl PixelSource, row: &mut Row) -> u32 {
    let picture: Picture<_, Exact<Rgb888>> = Picture::new(source);
    let mut ticks = 0_u32;
    for y in 0..RESOLUTION.height {
        let before = board::ticks();
        picture.row(0, y, row);
        // The row is complete before the clock is read again.
        core::hint::black_box(&mut *row);
        ticks = ticks.wrapping_add(board::ticks().wrapping_sub(before));
    }
    ticks
}
