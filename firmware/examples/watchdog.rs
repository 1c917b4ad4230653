//! A bare loop that draws in instalments of a few hundred rays and feeds the watchdog between them.

#![no_std]
#![no_main]

use board::{Watchdog, console};
use embedded_graphics::{
    pixelcolor::{Rgb888, RgbColor},
    prelude::*,
};
use scanray::{
    Picture, Resolution, Scene,
    render::{Budget, Frame, Progress},
    tracer_for,
};
use scanray_firmware::hash::Hash;

board::entry!(program, [Rgb888; 160] = [Rgb888::BLACK; 160]);

static SCENE: Scene<'static> = include!(concat!(env!("OUT_DIR"), "/scene.rs"));

/// A millisecond.
const PATIENCE: u32 = board::TICKS_PER_SECOND / 1000;

fn program(row: &mut [Rgb888]) -> Result<(), &'static str> {
    let tracer = tracer_for!(SCENE).with_resolution(Resolution {
        width: 160,
        height: 120,
    });
    let picture = Picture::new(&tracer);
    let mut display = Hash::new(picture.bounding_box().size);

    let mut watchdog = Watchdog::start(PATIENCE);
    let mut frame = Frame::of(&picture);
    while frame.draw(&picture, &mut display, row, Budget::Rays(500)) != Ok(Progress::Done) {
        watchdog.feed();
    }

    display.print();
    // The watchdog was awake all the time: starved, it resets the board.
    console::text("starving the watchdog\n");
    loop {
        board::sleep();
    }
}
