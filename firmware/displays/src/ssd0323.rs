//! Solomon SSD0323: a controller of OLED panels of 128×64 pixels in 16 greys, two pixels a byte.
//!
//! The panel cannot be read back and there is no frame buffer, so a pixel that is written without the other half of its
//! byte takes the colour of the last [`clear`](DrawTarget::clear) for it. Rows of even position and length, which is what a
//! picture drawn row by row is, have no such halves; neither have runs of single pixels from left to right.

use embedded_graphics::{Pixel, pixelcolor::Gray4, prelude::*, primitives::Rectangle};
use embedded_hal::{digital::OutputPin, spi::SpiDevice};

/// Pixels across.
pub const WIDTH: u32 = 128;
/// Pixels down.
pub const HEIGHT: u32 = 64;

/// Commands of the data sheet, each followed by its arguments.
const SET_UP: [&[u8]; 15] = [
    &[0x81, 0x50],                                           // contrast
    &[0x85],                                                 // half current range
    &[0xA0, 0x52],             // high nibble left, columns first, the panel's wiring
    &[0xA1, 0x00],             // start line
    &[0xA2, 0x00],             // offset
    &[0xA4],                   // normal display
    &[0xA8, HEIGHT as u8 - 1], // rows
    &[0xB1, 0x22],             // phase lengths
    &[0xB2, 0x46],             // row period
    &[0xB3, 0x91],             // clock
    &[0xBF, 0x0D],             // low segment voltage
    &[0xBE, 0x02],             // common voltage
    &[0xBC, 0x0F],             // pre-charge voltage
    &[0xB8, 0x01, 0x11, 0x22, 0x32, 0x43, 0x54, 0x65, 0x76], // grey table
    &[0xAD, 0x03],             // converter on
];
const DISPLAY_ON: u8 = 0xAF;
const SET_COLUMNS: u8 = 0x15;
const SET_ROWS: u8 = 0x75;

/// Why nothing, or not everything, was drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Error<S, P> {
    /// The SPI device's error.
    Spi(S),
    /// The data/command line's error.
    Pin(P),
}

/// The panel as a [`DrawTarget`].
#[derive(Debug)]
pub struct Ssd0323<SPI, DC> {
    spi: SPI,
    data_command: DC,
    background: u8,
}

type Outcome<T, SPI, DC> = Result<
    T,
    Error<
        <SPI as embedded_hal::spi::ErrorType>::Error,
        <DC as embedded_hal::digital::ErrorType>::Error,
    >,
>;

impl<SPI: SpiDevice, DC: OutputPin> Ssd0323<SPI, DC> {
    /// Sets the controller up, black, and switches the panel on.
    pub fn new(spi: SPI, data_command: DC) -> Outcome<Self, SPI, DC> {
        let mut display = Self {
            spi,
            data_command,
            background: 0,
        };
        for command in SET_UP {
            display.command(command)?;
        }
        display.clear(Gray4::BLACK)?;
        display.command(&[DISPLAY_ON])?;
        Ok(display)
    }

    /// Gives the bus and the line back.
    pub fn release(self) -> (SPI, DC) {
        (self.spi, self.data_command)
    }

    fn command(&mut self, bytes: &[u8]) -> Outcome<(), SPI, DC> {
        self.data_command.set_low().map_err(Error::Pin)?;
        self.spi.write(bytes).map_err(Error::Spi)
    }

    fn data(&mut self, bytes: &[u8]) -> Outcome<(), SPI, DC> {
        self.data_command.set_high().map_err(Error::Pin)?;
        self.spi.write(bytes).map_err(Error::Spi)
    }

    /// Sets the window that data fills, in pixels; whole bytes of it.
    fn window(&mut self, left: u32, right: u32, top: u32, bottom: u32) -> Outcome<(), SPI, DC> {
        self.command(&[SET_COLUMNS, (left / 2) as u8, (right / 2) as u8])?;
        self.command(&[SET_ROWS, top as u8, bottom as u8])
    }
}

impl<SPI, DC> OriginDimensions for Ssd0323<SPI, DC> {
    fn size(&self) -> Size {
        Size::new(WIDTH, HEIGHT)
    }
}

impl<SPI: SpiDevice, DC: OutputPin> DrawTarget for Ssd0323<SPI, DC> {
    type Color = Gray4;
    type Error = Error<SPI::Error, DC::Error>;

    fn draw_iter<I>(&mut self, pixels: I) -> Result<(), Self::Error>
    where
        I: IntoIterator<Item = Pixel<Gray4>>,
    {
        let mut last: Option<(u32, u32, u8)> = None;
        for Pixel(point, color) in pixels {
            if !self.bounding_box().contains(point) {
                continue;
            }
            let (x, y) = (point.x as u32, point.y as u32);

            // The byte as this run left it, otherwise the background.
            let byte = match last {
                Some((column, row, byte)) if (column, row) == (x / 2, y) => byte,
                _ => self.background,
            };
            let byte = with_pixel(byte, x, color);
            self.window(x, x, y, y)?;
            self.data(&[byte])?;
            last = Some((x / 2, y, byte));
        }
        Ok(())
    }

    fn fill_contiguous<I>(&mut self, area: &Rectangle, colors: I) -> Result<(), Self::Error>
    where
        I: IntoIterator<Item = Gray4>,
    {
        let visible = area.intersection(&self.bounding_box());
        let Some(corner) = visible.bottom_right() else {
            return Ok(());
        };
        let (left, top) = (visible.top_left.x as u32, visible.top_left.y as u32);
        let (right, bottom) = (corner.x as u32, corner.y as u32);
        self.window(left, right, top, bottom)?;

        // A row at a time: skip what lies outside, pack the rest two to a byte.
        let mut colors = colors.into_iter();
        let before = (visible.top_left.x - area.top_left.x) as usize;
        let after = (area.size.width - visible.size.width) as usize - before;
        let rows_above = (visible.top_left.y - area.top_left.y) as usize;
        skip(&mut colors, rows_above * area.size.width as usize);
        for _ in top..=bottom {
            skip(&mut colors, before);
            let mut row = [self.background; WIDTH as usize / 2];
            let mut drawn = None;
            for x in left..=right {
                let Some(color) = colors.next() else { break };
                if let Some(byte) = row.get_mut((x / 2) as usize) {
                    *byte = with_pixel(*byte, x, color);
                    drawn = Some(x);
                }
            }
            // Fewer colours than pixels end the drawing.
            let Some(end) = drawn else { break };
            if let Some(bytes) = row.get((left / 2) as usize..=(end / 2) as usize) {
                self.data(bytes)?;
            }
            skip(&mut colors, after);
        }
        Ok(())
    }

    fn fill_solid(&mut self, area: &Rectangle, color: Gray4) -> Result<(), Self::Error> {
        self.fill_contiguous(area, core::iter::repeat(color))
    }

    fn clear(&mut self, color: Gray4) -> Result<(), Self::Error> {
        self.background = color.luma() * 0x11;
        self.fill_solid(&self.bounding_box(), color)
    }
}

/// The byte with the pixel of column `x` in it: the left one is the high nibble.
fn with_pixel(byte: u8, x: u32, color: Gray4) -> u8 {
    if x.is_multiple_of(2) {
        byte & 0x0F | color.luma() << 4
    } else {
        byte & 0xF0 | color.luma()
    }
}

fn skip(colors: &mut impl Iterator<Item = Gray4>, count: usize) {
    for _ in 0..count {
        colors.next();
    }
}
