//! Draws the baked scene on the OLED of the LM3S6965 board.

#![no_std]
#![no_main]

use board::console;
use displays::ssd0323::{Error, Ssd0323};
use embedded_graphics::prelude::*;
use embedded_hal::{digital::OutputPin, spi::SpiDevice};
use scanray::{Picture, Resolution, Scene, tracer_for};

board::entry!(program);

static SCENE: Scene<'static> = include!(concat!(env!("OUT_DIR"), "/scene.rs"));

fn draw<SPI: SpiDevice, DC: OutputPin>(
    spi: SPI,
    data_command: DC,
) -> Result<(), Error<SPI::Error, DC::Error>> {
    let (width, height) = (128, 64);
    let mut display = Ssd0323::new(spi, data_command)?;
    let tracer = tracer_for!(SCENE).with_resolution(Resolution { width, height });
    Picture::new(&tracer).dithered().draw(&mut display)
}

fn program() -> Result<(), &'static str> {
    let (spi, data_command) = board::oled();
    draw(spi, data_command).map_err(|_| "the display does not answer")?;

    console::text("drawn\n");
    // The panel shows the picture until the emulator is closed.
    loop {
        board::sleep();
    }
}
