//! Draws black instead of a scene: what start-up, quantisation, hash, counter and console cost by themselves.

#![no_std]
#![no_main]

use board::stack;
use scanray::{Color, Resolution, render::PixelSource};
use scanray_firmware::measure::{self, EMPTY_ROW, RESOLUTION, Row};

board::entry!(program, Row = EMPTY_ROW);

struct Black;

impl PixelSource for Black {
    type Scalar = f32;
    type Scanline = ();

    fn resolution(&self) -> Resolution {
        RESOLUTION
    }

    fn scanline(&self, _: u16) {}

    fn pixel_on(&self, (): &(), _: u16) -> (Color, u32) {
        (core::hint::black_box(Color::BLACK), 0)
    }
}

fn program(row: &mut Row) -> Result<(), &'static str> {
    stack::paint();
    measure::picture(Black, row);
    Ok(())
}
