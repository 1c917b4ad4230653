//! A model of display controllers with the MIPI Display Command Set, such as ILI9341 and ST7789, as
//! far as a picture depends on it.

use std::ops::RangeInclusive;

use super::bus::Sent;

/// Columns and rows of the frame memory.
pub(crate) const MEMORY: [usize; 2] = [240, 320];

const SOFTWARE_RESET: u8 = 0x01;
const SLEEP_OUT: u8 = 0x11;
const NORMAL_MODE: u8 = 0x13;
const INVERSION_OFF: u8 = 0x20;
const DISPLAY_ON: u8 = 0x29;
const COLUMN_ADDRESS: u8 = 0x2A;
const PAGE_ADDRESS: u8 = 0x2B;
const MEMORY_WRITE: u8 = 0x2C;
const ADDRESS_MODE: u8 = 0x36;
const PIXEL_FORMAT: u8 = 0x3A;
const MEMORY_WRITE_CONTINUE: u8 = 0x3C;
const INVERSION_CONTROL: u8 = 0xB4;

const REVERSE_ROWS: u8 = 1 << 7;
const REVERSE_COLUMNS: u8 = 1 << 6;
const SWAP_ROWS_AND_COLUMNS: u8 = 1 << 5;

/// The controller's state.
#[derive(Debug)]
pub(crate) struct Controller {
    /// RGB565 as received, row by row; `None` where nothing was written.
    memory: Vec<Option<u16>>,
    address_mode: u8,
    columns: RangeInclusive<u16>,
    pages: RangeInclusive<u16>,
    /// Column and page that the next pixel goes to.
    next: (u16, u16),
    command: u8,
    parameters: Vec<u8>,
    is_on: bool,
    is_awake: bool,
    /// Windows that were written to: how many memory writes began.
    pub(crate) windows: usize,
    /// Bytes of pixels.
    pub(crate) pixel_bytes: usize,
}

impl Controller {
    pub(crate) fn new() -> Self {
        let [columns, rows] = MEMORY;
        Self {
            memory: vec![None; columns * rows],
            address_mode: 0,
            columns: 0..=columns as u16 - 1,
            pages: 0..=rows as u16 - 1,
            next: (0, 0),
            command: 0,
            parameters: Vec::new(),
            is_on: false,
            is_awake: false,
            windows: 0,
            pixel_bytes: 0,
        }
    }

    pub(crate) fn receive(&mut self, sent: impl IntoIterator<Item = Sent>) {
        for sent in sent {
            match sent {
                Sent::Command(command) => self.command(command),
                Sent::Data(byte) => self.parameter(byte),
            }
        }
    }

    fn command(&mut self, command: u8) {
        let in_vain = std::mem::take(&mut self.parameters);
        assert!(
            in_vain.is_empty(),
            "{:#04x} was cut short after {in_vain:02x?}",
            self.command
        );
        self.command = command;
        match command {
            SLEEP_OUT => self.is_awake = true,
            DISPLAY_ON => self.is_on = true,
            MEMORY_WRITE => {
                self.next = (*self.columns.start(), *self.pages.start());
                self.windows += 1;
            }
            SOFTWARE_RESET
            | NORMAL_MODE
            | INVERSION_OFF
            | COLUMN_ADDRESS
            | PAGE_ADDRESS
            | ADDRESS_MODE
            | PIXEL_FORMAT
            | MEMORY_WRITE_CONTINUE
            | INVERSION_CONTROL => {}
            _ => panic!("{command:#04x} is no command that this model knows"),
        }
    }

    fn parameter(&mut self, byte: u8) {
        self.parameters.push(byte);
        match (self.command, &*self.parameters) {
            (COLUMN_ADDRESS, &[a, b, c, d]) => self.columns = range([a, b], [c, d]),
            (PAGE_ADDRESS, &[a, b, c, d]) => self.pages = range([a, b], [c, d]),
            (COLUMN_ADDRESS | PAGE_ADDRESS, _) => return,
            (MEMORY_WRITE | MEMORY_WRITE_CONTINUE, &[high, low]) => {
                self.write(u16::from_be_bytes([high, low]));
            }
            (MEMORY_WRITE | MEMORY_WRITE_CONTINUE, _) => return,
            (ADDRESS_MODE, &[mode]) => self.address_mode = mode,
            (PIXEL_FORMAT, &[format]) => {
                assert_eq!(format, 0x55, "the model knows 16 bits a pixel only");
            }
            (INVERSION_CONTROL, _) => {}
            (command, parameters) => panic!("{command:#04x} takes no {parameters:02x?}"),
        }
        self.parameters.clear();
    }

    /// Writes a pixel at the pointer, and moves it through the window, row by row and back to its start.
    fn write(&mut self, pixel: u16) {
        self.pixel_bytes += 2;
        let (column, page) = self.next;
        let index = self.index(column.into(), page.into());
        self.memory[index] = Some(pixel);
        self.next = if column < *self.columns.end() {
            (column + 1, page)
        } else if page < *self.pages.end() {
            (*self.columns.start(), page + 1)
        } else {
            (*self.columns.start(), *self.pages.start())
        };
    }

    /// Where the address mode puts a column and page of the window.
    fn index(&self, column: usize, page: usize) -> usize {
        let has = |bit| self.address_mode & bit != 0;
        let (mut x, mut y) = if has(SWAP_ROWS_AND_COLUMNS) {
            (page, column)
        } else {
            (column, page)
        };
        let [columns, rows] = MEMORY;
        assert!(x < columns && y < rows, "({x}, {y}) is outside the memory");
        if has(REVERSE_COLUMNS) {
            x = columns - 1 - x;
        }
        if has(REVERSE_ROWS) {
            y = rows - 1 - y;
        }
        y * columns + x
    }

    /// The RGB565 pixel at a column and row of the memory, which must have been written.
    pub(crate) fn stored(&self, (column, row): (u16, u16)) -> u16 {
        assert!(self.is_awake && self.is_on, "the display is off");
        self.memory[usize::from(row) * MEMORY[0] + usize::from(column)]
            .unwrap_or_else(|| panic!("column {column} of row {row} was never written"))
    }

    /// How many pixels of the memory were written.
    pub(crate) fn written(&self) -> usize {
        self.memory.iter().flatten().count()
    }
}

fn range(start: [u8; 2], end: [u8; 2]) -> RangeInclusive<u16> {
    let (start, end) = (u16::from_be_bytes(start), u16::from_be_bytes(end));
    assert!(start <= end, "a window from {start} to {end}");
    start..=end
}
