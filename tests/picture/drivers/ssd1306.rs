//! A model of the SSD1306, a controller of monochrome OLED panels, as far as a picture depends on it.

use std::ops::RangeInclusive;

use super::bus::Sent;

/// Pixels across and down.
pub(crate) const SIZE: [usize; 2] = [128, 64];
const PAGES: usize = SIZE[1] / 8;

/// The controller's state, on a panel wired as modules are: its upper left corner is the last segment of
/// the last common line.
#[derive(Debug)]
pub(crate) struct Controller {
    /// Eight pixels a byte, one below the other, page by page.
    memory: [[u8; SIZE[0]]; PAGES],
    columns: RangeInclusive<u8>,
    pages: RangeInclusive<u8>,
    next: (u8, u8),
    is_horizontal: bool,
    reverses_segments: bool,
    reverses_commons: bool,
    is_inverted: bool,
    is_on: bool,
    command: Vec<u8>,
    /// Bytes of pixels.
    pub(crate) pixel_bytes: usize,
}

impl Controller {
    pub(crate) fn new() -> Self {
        Self {
            memory: [[0; SIZE[0]]; PAGES],
            columns: 0..=127,
            pages: 0..=7,
            next: (0, 0),
            is_horizontal: false,
            reverses_segments: false,
            reverses_commons: false,
            is_inverted: false,
            is_on: false,
            command: Vec::new(),
            pixel_bytes: 0,
        }
    }

    pub(crate) fn receive(&mut self, sent: impl IntoIterator<Item = Sent>) {
        for sent in sent {
            match sent {
                Sent::Command(byte) => self.command(byte),
                Sent::Data(byte) => self.write(byte),
            }
        }
    }

    /// Commands and their parameters come alike.
    fn command(&mut self, byte: u8) {
        self.command.push(byte);
        match *self.command {
            [0x20, mode] => self.is_horizontal = mode == 0,
            [0x21, start, end] => {
                self.columns = start..=end;
                self.next.0 = start;
            }
            [0x22, start, end] => {
                self.pages = start..=end;
                self.next.1 = start;
            }
            [0xA0 | 0xA1] => self.reverses_segments = byte == 0xA1,
            [0xC0 | 0xC8] => self.reverses_commons = byte == 0xC8,
            [0xA6 | 0xA7] => self.is_inverted = byte == 0xA7,
            [0xAE | 0xAF] => self.is_on = byte == 0xAF,
            // First line, first row and number of rows, as this model has them.
            [0x40] | [0xD3, 0] | [0xA8, 63] => {}
            // What memory holds, not all on; scrolling off.
            [0xA4] | [0x2E] => {}
            // Contrast, charge pump, clock, pre-charge, wiring, voltage: brightness, not the picture.
            [0x81 | 0x8D | 0xD5 | 0xD9 | 0xDA | 0xDB, _] => {}
            [0x20 | 0x21 | 0x22 | 0xD3 | 0xA8 | 0x81 | 0x8D | 0xD5 | 0xD9 | 0xDA | 0xDB]
            | [0x21 | 0x22, _] => return,
            _ => panic!("{:02x?} is no command that this model knows", self.command),
        }
        self.command.clear();
    }

    fn write(&mut self, byte: u8) {
        assert!(
            self.is_horizontal,
            "the model knows horizontal addressing only"
        );
        self.pixel_bytes += 1;
        let (column, page) = self.next;
        self.memory[usize::from(page)][usize::from(column)] = byte;
        self.next = if column < *self.columns.end() {
            (column + 1, page)
        } else if page < *self.pages.end() {
            (*self.columns.start(), page + 1)
        } else {
            (*self.columns.start(), *self.pages.start())
        };
    }

    /// Whether the panel's pixel is lit.
    pub(crate) fn shown(&self, column: usize, row: usize) -> bool {
        assert!(self.is_on, "the display is off");
        let column = if self.reverses_segments {
            column
        } else {
            SIZE[0] - 1 - column
        };
        let row = if self.reverses_commons {
            row
        } else {
            SIZE[1] - 1 - row
        };
        (self.memory[row / 8][column] >> (row % 8) & 1 == 1) != self.is_inverted
    }
}
