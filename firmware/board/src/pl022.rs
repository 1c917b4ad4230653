//! Arm PrimeCell SSP (PL022) as an embedded-hal SPI master, mode 0, eight bits, for a bus whose only device is selected by
//! the controller's frame signal.

use core::convert::Infallible;

use embedded_hal::spi::{ErrorType, Operation, SpiBus, SpiDevice};

use crate::{read, write};

const CONTROL0: usize = 0x00;
const CONTROL1: usize = 0x04;
const DATA: usize = 0x08;
const STATUS: usize = 0x0C;
const PRESCALE: usize = 0x10;

const ENABLE: u32 = 1 << 1;
const EIGHT_BITS: u32 = 7;
const RECEIVE_NOT_EMPTY: u32 = 1 << 2;
const BUSY: u32 = 1 << 4;

/// The controller.
#[derive(Debug)]
pub struct Pl022 {
    base: usize,
}

impl Pl022 {
    /// Sets the controller up.
    ///
    /// # Safety
    ///
    /// `base` must be the address of a clocked PL022 that nobody else uses.
    pub unsafe fn new(base: usize) -> Self {
        unsafe {
            write(base + CONTROL1, 0);
            write(base + PRESCALE, 2);
            write(base + CONTROL0, EIGHT_BITS);
            write(base + CONTROL1, ENABLE);
        }
        Self { base }
    }

    /// Sends a byte and takes the one that comes back: the transmitter stalls when eight of them lie unread.
    fn exchange(&mut self, byte: u8) -> u8 {
        // SAFETY: `base` is a PL022, by `new`.
        unsafe {
            write(self.base + DATA, byte.into());
            while read(self.base + STATUS) & RECEIVE_NOT_EMPTY == 0 {}
            read(self.base + DATA) as u8
        }
    }
}

impl ErrorType for Pl022 {
    type Error = Infallible;
}

impl SpiBus for Pl022 {
    fn read(&mut self, words: &mut [u8]) -> Result<(), Infallible> {
        for word in words {
            *word = self.exchange(0);
        }
        Ok(())
    }

    fn write(&mut self, words: &[u8]) -> Result<(), Infallible> {
        for &word in words {
            self.exchange(word);
        }
        Ok(())
    }

    fn transfer(&mut self, read: &mut [u8], write: &[u8]) -> Result<(), Infallible> {
        for index in 0..read.len().max(write.len()) {
            let received = self.exchange(write.get(index).copied().unwrap_or(0));
            if let Some(word) = read.get_mut(index) {
                *word = received;
            }
        }
        Ok(())
    }

    fn transfer_in_place(&mut self, words: &mut [u8]) -> Result<(), Infallible> {
        for word in words {
            *word = self.exchange(*word);
        }
        Ok(())
    }

    fn flush(&mut self) -> Result<(), Infallible> {
        // SAFETY: `base` is a PL022, by `new`.
        while unsafe { read(self.base + STATUS) } & BUSY != 0 {}
        Ok(())
    }
}

impl SpiDevice for Pl022 {
    fn transaction(&mut self, operations: &mut [Operation<'_, u8>]) -> Result<(), Infallible> {
        for operation in operations {
            match operation {
                Operation::Read(words) => SpiBus::read(self, words)?,
                Operation::Write(words) => SpiBus::write(self, words)?,
                Operation::Transfer(read, write) => SpiBus::transfer(self, read, write)?,
                Operation::TransferInPlace(words) => SpiBus::transfer_in_place(self, words)?,
                // At up to 50 MHz a read of the status register takes at least 40 ns.
                Operation::DelayNs(nanoseconds) => {
                    for _ in 0..nanoseconds.div_ceil(40) {
                        // SAFETY: `base` is a PL022, by `new`.
                        unsafe { read(self.base + STATUS) };
                    }
                }
            }
        }
        SpiBus::flush(self)
    }
}
