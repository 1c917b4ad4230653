//! BBC micro:bit: nRF51822, Cortex-M0, 16 KB of RAM.

use crate::{read, write};

/// Frequency of [`ticks`]. Under `-icount shift=0` an instruction takes a nanosecond, so a tick is 62.5 instructions.
pub const TICKS_PER_SECOND: u32 = 16_000_000;

const TIMER0: usize = 0x4000_8000;
const TASKS_START: usize = TIMER0;
const TASKS_CAPTURE0: usize = TIMER0 + 0x040;
const BITMODE: usize = TIMER0 + 0x508;
const PRESCALER: usize = TIMER0 + 0x510;
const CC0: usize = TIMER0 + 0x540;

/// Starts the counter.
#[inline(always)]
pub fn start() {
    // SAFETY: TIMER0 touches no memory.
    unsafe {
        write(BITMODE, 3); // 32 bits
        write(PRESCALER, 0);
        write(TASKS_START, 1);
    }
}

/// Counts up, and wraps around.
#[inline(always)]
pub fn ticks() -> u32 {
    // SAFETY: TIMER0 may be captured and read at any time.
    unsafe {
        write(TASKS_CAPTURE0, 1);
        read(CC0)
    }
}
