//! A picture that is there at once, in blocks of 4×4 pixels, and is refined in place: a bare loop, which can look at the
//! buttons every few hundred rays and begin anew when the scene has changed. Prints how many rays each pass has taken.

#![no_std]
#![no_main]

use core::convert::Infallible;

use board::{console, crc32::Crc32};
use embedded_graphics::{
    pixelcolor::{Rgb888, RgbColor},
    prelude::*,
};
use scanray::{
    Color, Picture, Resolution, Scene,
    render::{Budget, Progress, Progressive},
    tracer_for,
};

const WIDTH: usize = 160;
const HEIGHT: usize = 120;

board::entry!(
    program,
    (Memory, [Color; WIDTH]) = ([[[0; 3]; WIDTH]; HEIGHT], [Color::BLACK; WIDTH])
);

static SCENE: Scene<'static> = include!(concat!(env!("OUT_DIR"), "/scene.rs"));

/// Rays between two looks at the buttons.
const INSTALMENT: u32 = 500;

fn program((memory, row): &mut (Memory, [Color; WIDTH])) -> Result<(), &'static str> {
    let tracer = tracer_for!(SCENE).with_resolution(Resolution {
        width: WIDTH as u16,
        height: HEIGHT as u16,
    });
    let picture = Picture::new(&tracer);
    let mut display = Display(memory);

    let mut progressive = Progressive::of(&picture);
    let mut instalments = 0;
    loop {
        let block = progressive.block();
        let Ok(progress) =
            progressive.draw_pass(&picture, &mut display, row, Budget::Rays(INSTALMENT));
        instalments += 1;
        if progress == Progress::Done || progressive.block() != block {
            print(block, instalments * INSTALMENT);
        }
        if progress == Progress::Done {
            break;
        }
        // Here is the time to look at the buttons: `progressive = progressive.rewound()` begins anew.
    }
    display.print();
    Ok(())
}

fn print(block: u16, rays: u32) {
    console::decimal(
        match block {
            4 => "rays until the blocks of 4x4 are drawn ",
            2 => "rays until the blocks of 2x2 are drawn ",
            _ => "rays until the pixels are drawn ",
        },
        rays,
    );
}

/// A pixel is three bytes: red, green, blue.
type Memory = [[[u8; 3]; WIDTH]; HEIGHT];

/// Stands for a display, which has a memory of its own.
struct Display<'a>(&'a mut Memory);

impl Display<'_> {
    fn print(&self) {
        let mut crc = Crc32::new();
        for &byte in self.0.as_flattened().as_flattened() {
            crc.byte(byte);
        }
        console::hexadecimal("crc32 ", crc.value());
    }
}

impl OriginDimensions for Display<'_> {
    fn size(&self) -> Size {
        Size::new(WIDTH as u32, HEIGHT as u32)
    }
}

impl DrawTarget for Display<'_> {
    type Color = Rgb888;
    type Error = Infallible;

    fn draw_iter<I>(&mut self, pixels: I) -> Result<(), Infallible>
    where
        I: IntoIterator<Item = Pixel<Rgb888>>,
    {
        for Pixel(point, color) in pixels {
            let row = self.0.get_mut(point.y as usize);
            if let Some(pixel) = row.and_then(|row| row.get_mut(point.x as usize)) {
                *pixel = [color.r(), color.g(), color.b()];
            }
        }
        Ok(())
    }
}
