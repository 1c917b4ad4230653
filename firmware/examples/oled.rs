//! Draws the baked scene on the OLED of the LM3S6965 board.

#![no_std]
#![no_main]

use board::console;
use displays::ssd0323::{self, Ssd0323};
use embedded_graphics::prelude::*;
use scanray::{Picture, Resolution, Scene, tracer_for};

board::entry!(program);

static SCENE: Scene<'static> = include!(concat!(env!("OUT_DIR"), "/scene.rs"));

fn program() -> Result<(), &'static str> {
    let (spi, data_command) = board::oled();
    let mut display = Ssd0323::new(spi, data_command).map_err(|_| "the display does not answer")?;

    let tracer = tracer_for!(SCENE).with_resolution(Resolution {
        width: ssd0323::WIDTH as u16,
        height: ssd0323::HEIGHT as u16,
    });
    Picture::new(&tracer)
        .dithered()
        .draw(&mut display)
        .map_err(|_| "the display does not answer")?;

    console::text("drawn\n");
    // The panel shows the picture until the emulator is closed.
    loop {
        board::sleep();
    }
}
