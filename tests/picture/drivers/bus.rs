//! Buses that record what a driver sends.

use std::cell::{Cell, RefCell};
use std::convert::Infallible;
use std::rc::Rc;

use embedded_hal::delay::DelayNs;
use embedded_hal::digital::{self, OutputPin};
use embedded_hal::i2c::{self, I2c};
use embedded_hal::spi::{self, SpiDevice};

/// A byte on the bus.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Sent {
    Command(u8),
    Data(u8),
}

type Log = Rc<RefCell<Vec<Sent>>>;

/// An SPI device and its data/command line, which share a log.
#[derive(Clone, Debug, Default)]
pub(crate) struct Spi {
    log: Log,
    is_data: Rc<Cell<bool>>,
}

/// The data/command line: high for data.
#[derive(Debug)]
pub(crate) struct DataCommand(Rc<Cell<bool>>);

impl Spi {
    pub(crate) fn data_command(&self) -> DataCommand {
        DataCommand(Rc::clone(&self.is_data))
    }

    /// What was sent since this was last asked.
    pub(crate) fn take(&self) -> Vec<Sent> {
        self.log.take()
    }
}

impl spi::ErrorType for Spi {
    type Error = Infallible;
}

impl SpiDevice for Spi {
    fn transaction(&mut self, operations: &mut [spi::Operation<'_, u8>]) -> Result<(), Infallible> {
        for operation in operations {
            let spi::Operation::Write(bytes) = operation else {
                panic!("a display is only written to")
            };
            let kind = if self.is_data.get() {
                Sent::Data
            } else {
                Sent::Command
            };
            self.log
                .borrow_mut()
                .extend(bytes.iter().map(|byte| kind(*byte)));
        }
        Ok(())
    }
}

impl digital::ErrorType for DataCommand {
    type Error = Infallible;
}

impl OutputPin for DataCommand {
    fn set_low(&mut self) -> Result<(), Infallible> {
        self.0.set(false);
        Ok(())
    }

    fn set_high(&mut self) -> Result<(), Infallible> {
        self.0.set(true);
        Ok(())
    }
}

/// An I2C bus with one display on it. Each transaction begins with a control byte: commands or data.
#[derive(Clone, Debug)]
pub(crate) struct DisplayOnI2c {
    address: u8,
    log: Log,
}

impl DisplayOnI2c {
    pub(crate) fn at(address: u8) -> Self {
        Self {
            address,
            log: Log::default(),
        }
    }

    /// What was sent since this was last asked, without the control bytes.
    pub(crate) fn take(&self) -> Vec<Sent> {
        self.log.take()
    }
}

impl i2c::ErrorType for DisplayOnI2c {
    type Error = Infallible;
}

impl I2c for DisplayOnI2c {
    fn transaction(
        &mut self,
        address: u8,
        operations: &mut [i2c::Operation<'_>],
    ) -> Result<(), Infallible> {
        assert_eq!(address, self.address, "nobody has this address");
        let mut bytes = operations.iter().flat_map(|operation| match operation {
            i2c::Operation::Write(bytes) => bytes.iter().copied(),
            i2c::Operation::Read(_) => panic!("a display is only written to"),
        });
        let kind = match bytes.next() {
            Some(0x00) => Sent::Command,
            Some(0x40) => Sent::Data,
            other => panic!("the control byte is {other:02x?}"),
        };
        self.log.borrow_mut().extend(bytes.map(kind));
        Ok(())
    }
}

/// A clock that need not be waited for.
#[derive(Debug)]
pub(crate) struct NoDelay;

impl DelayNs for NoDelay {
    fn delay_ns(&mut self, _: u32) {}
}
