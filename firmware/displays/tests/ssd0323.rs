//! The driver on a recording bus: a small model of the controller turns the bytes back into a picture.

use std::{cell::RefCell, convert::Infallible, rc::Rc};

use displays::ssd0323::{HEIGHT, Ssd0323, WIDTH};
use embedded_graphics::{pixelcolor::Gray4, prelude::*, primitives::Rectangle};
use embedded_hal::{
    digital::{self, OutputPin},
    spi::{self, Operation, SpiDevice},
};

/// What the data sheet says of the commands that matter to a picture.
struct Controller {
    is_data: bool,
    command: Vec<u8>,
    columns: (u8, u8),
    rows: (u8, u8),
    at: (u8, u8),
    memory: [[u8; WIDTH as usize / 2]; HEIGHT as usize],
    is_on: bool,
    windows: usize,
}

impl Controller {
    fn command_byte(&mut self, byte: u8) {
        self.command.push(byte);
        match self.command[..] {
            [0x15, start, end] => {
                assert!(start <= end && end < 64, "columns {start} to {end}");
                self.columns = (start, end);
                self.at.0 = start;
                self.command.clear();
            }
            [0x75, start, end] => {
                assert!(start <= end && end < 64, "rows {start} to {end}");
                self.rows = (start, end);
                self.at.1 = start;
                self.windows += 1;
                self.command.clear();
            }
            [0xAF] => {
                self.is_on = true;
                self.command.clear();
            }
            [0x84..=0x86 | 0xA4..=0xA7 | 0xAE | 0xE3]
            | [
                0x81 | 0xA0..=0xA2 | 0xA8 | 0xAD | 0xB0..=0xB3 | 0xBC | 0xBE | 0xBF,
                _,
            ]
            | [0xB8, _, _, _, _, _, _, _, _] => self.command.clear(),
            [
                0x15
                | 0x75
                | 0x81
                | 0xA0..=0xA2
                | 0xA8
                | 0xAD
                | 0xB0..=0xB3
                | 0xB8
                | 0xBC
                | 0xBE
                | 0xBF,
                ..,
            ] => {}
            _ => panic!("no such command: {:02x?}", self.command),
        }
    }

    fn data_byte(&mut self, byte: u8) {
        assert!(self.command.is_empty(), "data inside a command");
        let (x, y) = self.at;
        self.memory[usize::from(y)][usize::from(x)] = byte;
        self.at = match (x == self.columns.1, y == self.rows.1) {
            (false, _) => (x + 1, y),
            (true, false) => (self.columns.0, y + 1),
            (true, true) => (self.columns.0, self.rows.0),
        };
    }

    fn pixel(&self, x: u32, y: u32) -> Gray4 {
        let byte = self.memory[y as usize][x as usize / 2];
        Gray4::new(if x % 2 == 0 { byte >> 4 } else { byte & 15 })
    }
}

#[derive(Clone)]
struct Bus(Rc<RefCell<Controller>>);

impl Bus {
    fn new() -> Self {
        Self(Rc::new(RefCell::new(Controller {
            is_data: false,
            command: Vec::new(),
            columns: (0, 63),
            rows: (0, 63),
            at: (0, 0),
            memory: [[0xA5; 64]; 64],
            is_on: false,
            windows: 0,
        })))
    }
}

impl spi::ErrorType for Bus {
    type Error = Infallible;
}

impl SpiDevice for Bus {
    fn transaction(&mut self, operations: &mut [Operation<'_, u8>]) -> Result<(), Infallible> {
        let mut controller = self.0.borrow_mut();
        for operation in operations {
            let Operation::Write(bytes) = operation else {
                panic!("the panel cannot be read: {operation:?}");
            };
            for byte in *bytes {
                if controller.is_data {
                    controller.data_byte(*byte);
                } else {
                    controller.command_byte(*byte);
                }
            }
        }
        Ok(())
    }
}

impl digital::ErrorType for Bus {
    type Error = Infallible;
}

impl OutputPin for Bus {
    fn set_low(&mut self) -> Result<(), Infallible> {
        self.0.borrow_mut().is_data = false;
        Ok(())
    }

    fn set_high(&mut self) -> Result<(), Infallible> {
        self.0.borrow_mut().is_data = true;
        Ok(())
    }
}

fn display() -> (Ssd0323<Bus, Bus>, Bus) {
    let bus = Bus::new();
    (Ssd0323::new(bus.clone(), bus.clone()).unwrap(), bus)
}

/// A shade for each place of the plane, inside the panel or not.
fn shade(point: Point) -> Gray4 {
    Gray4::new((point.x * 7 + point.y * 3).rem_euclid(16) as u8)
}

#[test]
fn starts_black_and_on() {
    let (_, bus) = display();
    let controller = bus.0.borrow();
    assert!(controller.is_on);
    assert!(controller.memory.iter().flatten().all(|byte| *byte == 0));
}

#[test]
fn rows_need_one_window_each_and_two_pixels_a_byte() {
    let (mut display, bus) = display();
    let before = bus.0.borrow().windows;
    for y in 0..HEIGHT as i32 {
        let row = Rectangle::new(Point::new(0, y), Size::new(WIDTH, 1));
        display
            .fill_contiguous(&row, row.points().map(shade))
            .unwrap();
    }
    let controller = bus.0.borrow();
    assert_eq!(controller.windows - before, HEIGHT as usize);
    for point in display.bounding_box().points() {
        assert_eq!(
            controller.pixel(point.x as u32, point.y as u32),
            shade(point),
            "{point}"
        );
    }
}

#[test]
fn areas_are_clipped_and_keep_the_background_beside_them() {
    let corners = [(-3, -2), (5, 7), (126, 60), (0, 0), (200, 0), (-50, 3)];
    let sizes = [(8, 5), (1, 1), (3, 9), (300, 100), (7, 0)];
    for corner in corners {
        for size in sizes {
            let (mut display, bus) = display();
            display.clear(Gray4::new(9)).unwrap();
            let area = Rectangle::new(corner.into(), size.into());
            display
                .fill_contiguous(&area, area.points().map(shade))
                .unwrap();
            let controller = bus.0.borrow();
            for point in display.bounding_box().points() {
                let wanted = if area.contains(point) {
                    shade(point)
                } else {
                    Gray4::new(9)
                };
                let got = controller.pixel(point.x as u32, point.y as u32);
                assert_eq!(got, wanted, "{area:?} at {point}");
            }
        }
    }
}

#[test]
fn too_few_colours_leave_the_rest_as_it_was() {
    let (mut display, bus) = display();
    let area = Rectangle::new(Point::new(4, 2), Size::new(6, 3));
    display
        .fill_contiguous(&area, area.points().map(shade).take(8))
        .unwrap();
    let controller = bus.0.borrow();
    for (index, point) in area.points().enumerate() {
        let wanted = if index < 8 {
            shade(point)
        } else {
            Gray4::BLACK
        };
        assert_eq!(
            controller.pixel(point.x as u32, point.y as u32),
            wanted,
            "{point}"
        );
    }
}

#[test]
fn single_pixels_from_left_to_right_share_their_bytes() {
    let (mut display, bus) = display();
    let points = || (-2..200).map(|x| Point::new(x, 31));
    display
        .draw_iter(points().map(|point| Pixel(point, shade(point))))
        .unwrap();
    let controller = bus.0.borrow();
    for point in points().filter(|point| display.bounding_box().contains(*point)) {
        assert_eq!(
            controller.pixel(point.x as u32, 31),
            shade(point),
            "{point}"
        );
    }
}
