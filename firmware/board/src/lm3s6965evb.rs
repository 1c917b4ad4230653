//! Stellaris LM3S6965 evaluation board: Cortex-M3, and a 128×64 OLED (SSD0323) on SSI0 with its data/command line on PC7.

use core::convert::Infallible;

use embedded_hal::digital::{ErrorType, OutputPin};

use crate::{pl022::Pl022, read, write};

const RCGC1: usize = 0x400F_E104;
const RCGC2: usize = 0x400F_E108;
const GPIO_A: usize = 0x4000_4000;
const GPIO_C: usize = 0x4000_6000;
const GPIO_D: usize = 0x4000_7000;
const SSI0: usize = 0x4000_8000;

const GPIO_DIRECTION: usize = 0x400;
const GPIO_ALTERNATE: usize = 0x420;
const GPIO_DIGITAL: usize = 0x51C;

/// Starts what the board has to start: nothing until a program asks for the display.
#[inline(always)]
pub fn start() {}

/// One output of a GPIO port.
#[derive(Debug)]
pub struct Pin {
    port: usize,
    mask: u32,
}

impl Pin {
    fn output(port: usize, number: u32) -> Self {
        let mask = 1 << number;
        // SAFETY: GPIO registers touch no memory.
        unsafe {
            write(port + GPIO_DIRECTION, read(port + GPIO_DIRECTION) | mask);
            write(port + GPIO_ALTERNATE, read(port + GPIO_ALTERNATE) & !mask);
            write(port + GPIO_DIGITAL, read(port + GPIO_DIGITAL) | mask);
        }
        Self { port, mask }
    }

    fn set(&mut self, value: u32) {
        // Address bits 2 to 9 of the data register select the pins that a write changes.
        // SAFETY: GPIO registers touch no memory.
        unsafe { write(self.port + ((self.mask as usize) << 2), value) };
    }
}

impl ErrorType for Pin {
    type Error = Infallible;
}

impl OutputPin for Pin {
    fn set_low(&mut self) -> Result<(), Infallible> {
        self.set(0);
        Ok(())
    }

    fn set_high(&mut self) -> Result<(), Infallible> {
        self.set(self.mask);
        Ok(())
    }
}

/// The OLED's bus and its data/command line. Call once.
pub fn oled() -> (Pl022, Pin) {
    // SAFETY: clock gates, GPIO and SSI registers touch no memory.
    unsafe {
        // Clock SSI0 and the ports A, C and D.
        write(RCGC1, read(RCGC1) | 1 << 4);
        write(RCGC2, read(RCGC2) | 0b1101);
        read(RCGC2);

        // PA2, PA3 and PA5 are the SSI's clock, frame (the OLED's select) and output.
        const SSI_PINS: u32 = 0b10_1100;
        write(
            GPIO_A + GPIO_ALTERNATE,
            read(GPIO_A + GPIO_ALTERNATE) | SSI_PINS,
        );
        write(
            GPIO_A + GPIO_DIGITAL,
            read(GPIO_A + GPIO_DIGITAL) | SSI_PINS,
        );
    }
    // PD0 high deselects the SD card on the same bus, PC6 high switches the panel's 15 V on.
    Pin::output(GPIO_D, 0).set(!0);
    Pin::output(GPIO_C, 6).set(!0);
    // SAFETY: SSI0's registers, clocked above.
    (unsafe { Pl022::new(SSI0) }, Pin::output(GPIO_C, 7))
}
