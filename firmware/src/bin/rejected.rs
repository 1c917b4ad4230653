//! Parses bad scenes on the board and prints each one's whole message.

#![no_std]
#![no_main]

use core::fmt::Write as _;

use board::console::Console;
use scanray::ScenePools;
use scanray_firmware::bad_scenes::{BAD_SCENES, SPHERES};

board::entry!(program);

fn program() -> Result<(), &'static str> {
    let mut pools = ScenePools::<f32, SPHERES>::new();
    for text in BAD_SCENES {
        match pools.parse(text) {
            Ok(_) => return Err("a bad scene was accepted"),
            // The console cannot fail.
            Err(error) => _ = writeln!(Console, "{error}"),
        }
    }
    Ok(())
}
