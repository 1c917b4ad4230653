//! Drivers that people use, over a bus that records: what a picture puts on the wires is decoded by a model of the
//! controller, and every pixel is the picture's own.

mod bus;
mod mipi;
mod ssd1306;

use std::fmt::Debug;

use crate::common::{picture::Rgb, scenes};
use ::ssd1306::mode::DisplayConfig;
use ::ssd1306::{I2CDisplayInterface, Ssd1306, prelude::*};
use embedded_graphics::pixelcolor::raw::RawU16;
use embedded_graphics::pixelcolor::{BinaryColor, Rgb565, Rgb888, RgbColor};
use embedded_graphics::prelude::*;
use mipidsi::Builder;
use mipidsi::interface::SpiInterface;
use mipidsi::models::{ILI9341Rgb565, Model, ST7789};
use mipidsi::options::{Orientation, Rotation};
use scanray::{
    Picture, Resolution, Tracer,
    render::{Budget, Frame, Progress},
};

use self::bus::{DisplayOnI2c, NoDelay, Spi};

/// A panel: the part of the controller's memory that it shows, and how far it is turned clockwise.
#[derive(Clone, Copy, Debug)]
struct Panel {
    size: [u16; 2],
    offset: [u16; 2],
    rotation: Rotation,
}

const PORTRAIT: Panel = Panel {
    size: [240, 320],
    offset: [0, 0],
    rotation: Rotation::Deg0,
};

/// A square panel on a controller for oblong ones.
const SQUARE: Panel = Panel {
    size: [240, 240],
    offset: [0, 80],
    rotation: Rotation::Deg0,
};

impl Panel {
    const fn turned(self, rotation: Rotation) -> Self {
        Self { rotation, ..self }
    }

    /// Size of the picture that fills it.
    fn resolution(&self) -> Resolution {
        let [width, height] = self.size;
        match self.rotation {
            Rotation::Deg0 | Rotation::Deg180 => Resolution { width, height },
            Rotation::Deg90 | Rotation::Deg270 => Resolution {
                width: height,
                height: width,
            },
        }
    }

    /// The memory's column and row that is seen at a place.
    fn seen_at(&self, x: u16, y: u16) -> (u16, u16) {
        let [right, bottom] = [self.size[0] - 1, self.size[1] - 1];
        let (column, row) = match self.rotation {
            Rotation::Deg0 => (x, y),
            Rotation::Deg90 => (right - y, x),
            Rotation::Deg180 => (right - x, bottom - y),
            Rotation::Deg270 => (y, bottom - x),
        };
        (self.offset[0] + column, self.offset[1] + row)
    }
}

/// A display that is set up, over a bus that records.
fn set_up<M: Model<ColorFormat = Rgb565>>(
    model: M,
    panel: &Panel,
    spi: Spi,
    buffer: &mut [u8],
) -> impl DrawTarget<Color = Rgb565, Error: Debug> {
    let data_command = spi.data_command();
    Builder::new(model, SpiInterface::new(spi, data_command, buffer))
        .display_size(panel.size[0], panel.size[1])
        .display_offset(panel.offset[0], panel.offset[1])
        .orientation(Orientation::new().rotate(panel.rotation))
        .init(&mut NoDelay)
        .expect("this bus does not fail")
}

/// What is seen on a panel whose upper left part shows a picture.
fn seen(controller: &mipi::Controller, panel: &Panel, size: Resolution) -> Rgb {
    assert_eq!(controller.written(), pixels(size), "pixels were written");
    Rgb::from_fn(size, |x, y| {
        let pixel = controller.stored(panel.seen_at(x, y));
        bytes(Rgb565::from(RawU16::new(pixel)))
    })
}

fn bytes(color: impl Into<Rgb888>) -> [u8; 3] {
    let color: Rgb888 = color.into();
    [color.r(), color.g(), color.b()]
}

fn pixels(size: Resolution) -> usize {
    usize::from(size.width) * usize::from(size.height)
}

/// Draws the default scene on a panel, whole and in instalments, and checks what was sent.
fn fills_panel_with_one_window_a_row<M: Model<ColorFormat = Rgb565>>(
    model: fn() -> M,
    panel: Panel,
) {
    let pools = scenes::load::<f32>("default");
    let size = panel.resolution();
    let tracer = Tracer::new(pools.as_scene()).with_resolution(size);
    let picture = Picture::new(&tracer);
    let expected = Rgb::from_fn(size, |x, y| bytes(picture.pixel(x, y)));
    for in_instalments in [false, true] {
        let spi = Spi::default();
        // Not a multiple of a row.
        let mut buffer = [0; 90];
        let mut display = set_up(model(), &panel, spi.clone(), &mut buffer);
        let mut controller = mipi::Controller::new();
        controller.receive(spi.take());
        assert_eq!(controller.pixel_bytes, 0, "set-up sends no pixel");

        if in_instalments {
            let mut row = vec![Rgb565::BLACK; size.width.into()];
            let mut frame = Frame::of(&picture);
            while frame
                .draw(&picture, &mut display, &mut row, Budget::Rays(500))
                .expect("this bus does not fail")
                != Progress::Done
            {}
        } else {
            picture.draw(&mut display).expect("this bus does not fail");
        }
        controller.receive(spi.take());

        assert_eq!(controller.windows, usize::from(size.height));
        assert_eq!(controller.pixel_bytes, 2 * pixels(size));
        assert_same(&seen(&controller, &panel, size), &expected);
    }
}

fn assert_same(seen: &Rgb, expected: &Rgb) {
    if let Some(words) = seen.describe_difference(expected) {
        panic!("what the panel shows {words}");
    }
}

/// The golden picture of the default scene in the colours of a display.
fn golden(name: &str) -> Rgb {
    let file = scenes::path(&format!("tests/golden/displays/{name}.png"));
    Rgb::read_png(&file).unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn ili9341_shows_the_golden_picture() {
    let golden = golden("rgb565");
    let pools = scenes::load::<f32>("default");
    let tracer = Tracer::new(pools.as_scene()).with_resolution(golden.size);
    let spi = Spi::default();
    let mut buffer = [0; 90];
    let mut display = set_up(ILI9341Rgb565, &PORTRAIT, spi.clone(), &mut buffer);
    Picture::new(&tracer)
        .draw(&mut display)
        .expect("this bus does not fail");
    let mut controller = mipi::Controller::new();
    controller.receive(spi.take());
    assert_same(&seen(&controller, &PORTRAIT, golden.size), &golden);
}

#[test]
fn ili9341_gets_one_window_a_row_and_two_bytes_a_pixel() {
    let turned = PORTRAIT.turned(Rotation::Deg90);
    fills_panel_with_one_window_a_row(|| ILI9341Rgb565, PORTRAIT);
    fills_panel_with_one_window_a_row(|| ILI9341Rgb565, turned);
}

#[test]
fn st7789_gets_one_window_a_row_and_two_bytes_a_pixel() {
    let turned = PORTRAIT.turned(Rotation::Deg270);
    fills_panel_with_one_window_a_row(|| ST7789, turned);
    fills_panel_with_one_window_a_row(|| ST7789, SQUARE);
    fills_panel_with_one_window_a_row(|| ST7789, SQUARE.turned(Rotation::Deg180));
}

#[test]
fn ssd1306_shows_the_dithered_picture_from_its_own_buffer() {
    let pools = scenes::load::<f32>("default");
    let golden = golden("binary-dithered");
    for (size, golden) in [
        (
            Resolution {
                width: 128,
                height: 64,
            },
            None,
        ),
        (golden.size, Some(golden)),
    ] {
        let tracer = Tracer::new(pools.as_scene()).with_resolution(size);
        let picture = Picture::new(&tracer).dithered();
        let i2c = DisplayOnI2c::at(0x3C);
        let interface = I2CDisplayInterface::new(i2c.clone());
        let mut display = Ssd1306::new(interface, DisplaySize128x64, DisplayRotation::Rotate0)
            .into_buffered_graphics_mode();
        let mut controller = ssd1306::Controller::new();
        display.init().expect("this bus does not fail");
        display.flush().expect("this bus does not fail");
        controller.receive(i2c.take());
        assert_eq!(controller.pixel_bytes, 1024, "init clears the panel");

        picture.draw(&mut display).expect("this bus does not fail");
        assert_eq!(i2c.take(), [], "drawing sends nothing");

        display.flush().expect("this bus does not fail");
        controller.receive(i2c.take());
        assert_eq!(
            controller.pixel_bytes - 1024,
            pixels(size) / 8,
            "an eighth of a byte a pixel"
        );
        let seen = Rgb::from_fn(size, |x, y| {
            bytes(BinaryColor::from(controller.shown(x.into(), y.into())))
        });
        let expected = Rgb::from_fn(size, |x, y| bytes(picture.pixel(x, y)));
        assert_same(&seen, &expected);
        if let Some(golden) = golden {
            assert_same(&seen, &golden);
        }
    }
}
