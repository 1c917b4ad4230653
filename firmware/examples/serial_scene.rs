//! Receives scene text over the serial port, up to an end-of-transmission byte, and draws it; says what is wrong with a bad
//! one.

#![no_std]
#![no_main]

use core::fmt::Write as _;

use board::{Uart, console::Console};
use embedded_graphics::prelude::*;
use embedded_io::Read as _;
use scanray::{Picture, Resolution, ScenePools, Tracer};
use scanray_firmware::hash::Hash;

board::entry!(
    program,
    Memory = Memory {
        text: [0; 4096],
        pools: ScenePools::new()
    }
);

const END_OF_TRANSMISSION: u8 = 4;

struct Memory {
    text: [u8; 4096],
    pools: ScenePools,
}

fn program(memory: &mut Memory) -> Result<(), &'static str> {
    let mut port = Uart::start();
    let mut length = 0;
    loop {
        let rest = memory.text.get_mut(length..).unwrap_or_default();
        let Ok(received) = port.read(rest);
        match rest.get(..received) {
            Some([]) | None => return Err("the text is longer than the buffer"),
            Some(bytes) => match bytes.iter().position(|byte| *byte == END_OF_TRANSMISSION) {
                Some(end) => break length += end,
                None => length += received,
            },
        }
    }

    if let Err(error) = memory
        .pools
        .parse(memory.text.get(..length).unwrap_or_default())
    {
        // The console cannot fail.
        let _ = writeln!(Console, "{error}");
        return Err("the scene was rejected");
    }
    let tracer = Tracer::new(memory.pools.as_scene()).with_resolution(Resolution {
        width: 160,
        height: 120,
    });
    let picture = Picture::new(&tracer);
    let mut display = Hash::new(picture.bounding_box().size);
    let Ok(()) = picture.draw(&mut display);
    display.print();
    Ok(())
}
