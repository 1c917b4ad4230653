//! Parses scene text on the board and draws it; then parses a bad one and prints where it is wrong.
//!
//! Prints no message: `core::fmt` calls through pointers, which leaves the stack without a provable bound. `rejected` does.

#![no_std]
#![no_main]

use board::{console, stack};
use scanray::{ParseError, ScenePools, tracer_for};
use scanray_firmware::measure::{self, EMPTY_ROW, RESOLUTION, Row};

/// Room for the objects that a tracer tells apart: 31 in all.
type Pools = ScenePools<f32, 12, 4, 15>;

board::entry!(program, (Pools, Row) = (Pools::new(), EMPTY_ROW));

const GOOD: &[u8] = include_bytes!(concat!(env!("OUT_DIR"), "/scene.txt"));
/// Its fifth line should be one number.
const BAD: &[u8] = b"0\n0 0 0\n160 120\n0 9 0 1 1 1 1 1 1\n0.1 dark\n";

fn program((pools, row): &mut (Pools, Row)) -> Result<(), &'static str> {
    stack::paint();
    if let Err(error) = pools.parse(GOOD) {
        print_place(&error);
        return Err("the good scene was rejected");
    }
    let tracer = tracer_for!(pools, in Pools);
    measure::picture(tracer.with_resolution(RESOLUTION), row);

    match pools.parse(BAD) {
        Ok(_) => Err("the bad scene was accepted"),
        Err(error) => {
            print_place(&error);
            Ok(())
        }
    }
}

fn print_place(error: &ParseError) {
    console::decimal("line ", error.line);
    console::decimal("column ", error.column);
}
