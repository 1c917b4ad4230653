//! What a picture is and what it costs.

use board::{console, crc32::Crc32, stack};
use embedded_graphics::pixelcolor::{Rgb888, RgbColor};
use scanray::{
    Picture, Resolution,
    render::{Exact, PixelSource},
};

/// Size of the pictures whose hashes and costs are published.
pub const RESOLUTION: Resolution = Resolution {
    width: 160,
    height: 120,
};

/// A row of them.
pub type Row = [Rgb888; RESOLUTION.width as usize];

/// An empty row.
pub const EMPTY_ROW: Row = [Rgb888::BLACK; RESOLUTION.width as usize];

/// Draws the picture row by row and prints its hash, the ticks that the drawing took and the stack that the program used.
/// Neither the hash nor the console counts as drawing.
#[inline(always)]
pub fn picture(source: impl PixelSource, row: &mut Row) {
    let picture: Picture<_, Exact<Rgb888>> = Picture::new(source);
    let mut crc = Crc32::new();
    let mut ticks = 0_u32;
    for y in 0..RESOLUTION.height {
        let before = board::ticks();
        picture.row(0, y, row);
        // The row is complete before the clock is read again.
        core::hint::black_box(&mut *row);
        ticks = ticks.wrapping_add(board::ticks().wrapping_sub(before));
        for pixel in &*row {
            crc.byte(pixel.r());
            crc.byte(pixel.g());
            crc.byte(pixel.b());
        }
    }
    console::hexadecimal("crc32 ", crc.value());
    console::hexadecimal("ticks ", ticks);
    console::hexadecimal("stack ", stack::high_water());
}
