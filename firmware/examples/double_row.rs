//! Two row buffers: while one is on its way to the display by DMA, the next row is traced into the other.
//!
//! The emulated board has no DMA controller. The SysTick interrupt stands for it: it takes a few pixels at a time out of the
//! buffer it owns, while the loop below traces.

#![no_std]
#![no_main]

use core::cell::RefCell;

use board::{console, crc32::Crc32};
use cortex_m::peripheral::{Peripherals, SYST, syst::SystClkSource};
use critical_section::Mutex;
use embedded_graphics::pixelcolor::{Rgb888, RgbColor};
use scanray::{
    Picture, Resolution, Scene,
    render::{Budget, Frame},
    tracer_for,
};

const WIDTH: usize = 160;
type Row = [Rgb888; WIDTH];

board::entry!(program, [Row; 2] = [[Rgb888::BLACK; WIDTH]; 2]);

static SCENE: Scene<'static> = include!(concat!(env!("OUT_DIR"), "/scene.rs"));

fn program([first, second]: &'static mut [Row; 2]) -> Result<(), &'static str> {
    let tracer = tracer_for!(SCENE).with_resolution(Resolution {
        width: WIDTH as u16,
        height: 120,
    });
    let picture = Picture::new(&tracer);
    let mut frame = Frame::of(&picture);

    let dma = Dma::start(Peripherals::take().ok_or("taken")?.SYST);
    let (mut front, mut spare) = (first, Some(second));
    let mut rows_sent_in_time = 0;
    while frame
        .trace(&picture, front, &mut Budget::Unlimited)
        .is_some()
    {
        rows_sent_in_time += u32::from(!dma.is_busy());
        let back = spare.take().unwrap_or_else(|| dma.wait());
        dma.send(front);
        front = back;
    }
    dma.wait();

    let received = critical_section::with(|token| DISPLAY.borrow_ref(token).value());
    console::hexadecimal("crc32 ", received);
    console::decimal("rows sent in time ", rows_sent_in_time);
    Ok(())
}

/// What the display has received.
static DISPLAY: Mutex<RefCell<Crc32>> = Mutex::new(RefCell::new(Crc32::new()));

/// The buffer on its way, which the DMA owns until all of it is sent.
static TRANSFER: Mutex<RefCell<Option<Transfer>>> = Mutex::new(RefCell::new(None));

struct Transfer {
    row: &'static mut Row,
    sent: usize,
}

/// A DMA channel to the display.
struct Dma(());

impl Dma {
    const TICKS_PER_BURST: u32 = 200;
    const PIXELS_PER_BURST: usize = 8;

    fn start(mut timer: SYST) -> Self {
        timer.set_clock_source(SystClkSource::Core);
        timer.set_reload(Self::TICKS_PER_BURST);
        timer.clear_current();
        timer.enable_counter();
        timer.enable_interrupt();
        Self(())
    }

    /// Sends a row; the channel must be idle.
    fn send(&self, row: &'static mut Row) {
        let transfer = Transfer { row, sent: 0 };
        critical_section::with(|token| TRANSFER.replace(token, Some(transfer)));
    }

    fn is_busy(&self) -> bool {
        critical_section::with(
            |token| matches!(&*TRANSFER.borrow_ref(token), Some(transfer) if transfer.sent < WIDTH),
        )
    }

    /// Waits for the end of the transfer, and gives its buffer back.
    fn wait(&self) -> &'static mut Row {
        loop {
            if !self.is_busy()
                && let Some(transfer) = critical_section::with(|token| TRANSFER.take(token))
            {
                return transfer.row;
            }
            board::sleep();
        }
    }
}

#[cortex_m_rt::exception]
fn SysTick() {
    critical_section::with(|token| {
        let mut transfer = TRANSFER.borrow_ref_mut(token);
        let mut display = DISPLAY.borrow_ref_mut(token);
        if let Some(Transfer { row, sent }) = &mut *transfer {
            for pixel in row.iter().skip(*sent).take(Dma::PIXELS_PER_BURST) {
                for byte in [pixel.r(), pixel.g(), pixel.b()] {
                    display.byte(byte);
                }
            }
            *sent += Dma::PIXELS_PER_BURST;
        }
    });
}
