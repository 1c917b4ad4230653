//! Arm MPS2 with the Cortex-M4F (AN386) or Cortex-M3 (AN385) image: the reference boards.

use core::convert::Infallible;

use crate::{read, write};

/// Frequency of [`ticks`]. Under `-icount shift=0` an instruction takes a nanosecond, so a tick is 40 instructions.
pub const TICKS_PER_SECOND: u32 = 25_000_000;

const TIMER_CONTROL: usize = 0x4000_0000;
const TIMER_VALUE: usize = 0x4000_0004;
const TIMER_RELOAD: usize = 0x4000_0008;

const UART_DATA: usize = 0x4000_4000;
const UART_STATE: usize = 0x4000_4004;
const UART_CONTROL: usize = 0x4000_4008;
const UART_DIVIDER: usize = 0x4000_4010;

const WATCHDOG_LOAD: usize = 0x4000_8000;
const WATCHDOG_CONTROL: usize = 0x4000_8008;
const WATCHDOG_CLEAR: usize = 0x4000_800C;

/// Starts the counter.
#[inline(always)]
pub fn start() {
    // SAFETY: CMSDK timer 0 touches no memory.
    unsafe {
        write(TIMER_RELOAD, u32::MAX);
        write(TIMER_VALUE, u32::MAX);
        write(TIMER_CONTROL, 1);
    }
}

/// Counts up, and wraps around.
#[inline(always)]
pub fn ticks() -> u32 {
    // SAFETY: CMSDK timer 0 may be read at any time. It counts down.
    !unsafe { read(TIMER_VALUE) }
}

/// The watchdog: resets the board when it starves.
#[derive(Debug)]
pub struct Watchdog(());

impl Watchdog {
    /// Starts the watchdog, which bites when it is not fed for twice as many [`ticks`].
    pub fn start(ticks: u32) -> Self {
        const INTERRUPT_AND_RESET: u32 = 0b11;
        // SAFETY: the watchdog touches no memory.
        unsafe {
            write(WATCHDOG_LOAD, ticks);
            write(WATCHDOG_CONTROL, INTERRUPT_AND_RESET);
        }
        Self(())
    }

    /// Starts its time anew.
    pub fn feed(&mut self) {
        // SAFETY: the watchdog touches no memory.
        unsafe { write(WATCHDOG_CLEAR, 1) };
    }
}

/// The first serial port.
#[derive(Debug)]
pub struct Uart(());

impl Uart {
    /// Switches the port on.
    pub fn start() -> Self {
        const TRANSMIT_AND_RECEIVE: u32 = 0b11;
        // SAFETY: the UART touches no memory.
        unsafe {
            write(UART_DIVIDER, TICKS_PER_SECOND / 115_200);
            write(UART_CONTROL, TRANSMIT_AND_RECEIVE);
        }
        Self(())
    }
}

impl embedded_io::ErrorType for Uart {
    type Error = Infallible;
}

impl embedded_io::Read for Uart {
    fn read(&mut self, buffer: &mut [u8]) -> Result<usize, Infallible> {
        const RECEIVED: u32 = 1 << 1;
        let Some(first) = buffer.first_mut() else {
            return Ok(0);
        };
        // SAFETY: the UART touches no memory.
        unsafe {
            while read(UART_STATE) & RECEIVED == 0 {}
            *first = read(UART_DATA) as u8;
        }
        Ok(1)
    }
}
