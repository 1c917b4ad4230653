//! Text out of the board: semihosting on Arm, the UART on RISC-V. Numbers are printed without a division and without
//! `core::fmt`, which would cost more flash than the harness.

/// Writes text.
pub fn text(text: &str) {
    for &byte in text.as_bytes() {
        byte_out(byte);
    }
}

/// Writes a label, text and the end of the line.
pub fn line(label: &str, value: &str) {
    text(label);
    text(value);
    byte_out(b'\n');
}

/// Writes a label, eight hexadecimal digits and the end of the line.
pub fn hexadecimal(label: &str, value: u32) {
    text(label);
    let mut rest = value;
    for _ in 0..8 {
        rest = rest.rotate_left(4);
        let digit = (rest & 15) as u8;
        byte_out(if digit < 10 {
            b'0' + digit
        } else {
            b'a' - 10 + digit
        });
    }
    byte_out(b'\n');
}

/// Writes a label, a number and the end of the line.
pub fn decimal(label: &str, value: u32) {
    text(label);
    let mut rest = value;
    let mut is_leading = true;
    for power in [
        1_000_000_000,
        100_000_000,
        10_000_000,
        1_000_000,
        100_000,
        10_000,
        1_000,
        100,
        10,
        1,
    ] {
        let mut digit = b'0';
        while rest >= power {
            rest -= power;
            digit += 1;
        }
        is_leading &= digit == b'0' && power > 1;
        if !is_leading {
            byte_out(digit);
        }
    }
    byte_out(b'\n');
}

/// `core::fmt` onto the console, for programs that print more than numbers.
#[derive(Debug)]
pub struct Console;

impl core::fmt::Write for Console {
    fn write_str(&mut self, string: &str) -> core::fmt::Result {
        text(string);
        Ok(())
    }
}

#[cfg(target_os = "none")]
use crate::write_byte as byte_out;

#[cfg(not(target_os = "none"))]
fn byte_out(_: u8) {}
