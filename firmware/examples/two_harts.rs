//! Two cores draw one picture, the even rows and the odd ones: the bits are those of one core.

#![no_std]
#![no_main]

use core::sync::atomic::{AtomicBool, AtomicU32, Ordering};

use board::{console, crc32::Crc32};
use embedded_graphics::{
    pixelcolor::{
        Rgb888,
        raw::{RawData, RawU24},
    },
    prelude::*,
};
use scanray::{Picture, Resolution, Scene, render::Exact, tracer_for};

board::entry!(program);

static SCENE: Scene<'static> = include!(concat!(env!("OUT_DIR"), "/scene.rs"));

const WIDTH: usize = 160;
const HEIGHT: usize = 120;

/// What a display with two ports would keep for itself.
static SCREEN: [[AtomicU32; WIDTH]; HEIGHT] =
    [const { [const { AtomicU32::new(0) }; WIDTH] }; HEIGHT];
static SECOND_IS_DONE: AtomicBool = AtomicBool::new(false);

/// Draws every second row, from `first`.
fn draw(first: usize) {
    let tracer = tracer_for!(SCENE).with_resolution(Resolution {
        width: WIDTH as u16,
        height: HEIGHT as u16,
    });
    let picture = Picture::<_, Exact<Rgb888>>::new(&tracer);
    let mut row = [Rgb888::BLACK; WIDTH];
    for (y, line) in SCREEN.iter().enumerate().skip(first).step_by(2) {
        picture.row(0, y as u16, &mut row);
        for (place, pixel) in line.iter().zip(row) {
            place.store(RawU24::from(pixel).into_inner(), Ordering::Relaxed);
        }
    }
}

/// What the second hart runs.
#[unsafe(no_mangle)]
extern "C" fn second_main() {
    draw(1);
    SECOND_IS_DONE.store(true, Ordering::Release);
    board::wake_first_hart();
}

fn program() -> Result<(), &'static str> {
    board::start_second_hart();
    draw(0);
    while !SECOND_IS_DONE.load(Ordering::Acquire) {
        board::sleep();
    }

    let mut crc = Crc32::new();
    for pixel in SCREEN.iter().flatten() {
        let [_, red, green, blue] = pixel.load(Ordering::Relaxed).to_be_bytes();
        for byte in [red, green, blue] {
            crc.byte(byte);
        }
    }
    console::hexadecimal("crc32 ", crc.value());
    Ok(())
}
