//! What a picture costs: the tracer's work, counted, and what it stands for on a microcontroller.

mod cycles;
mod emulation;
mod instructions;
mod table;
mod work;

pub(crate) use cycles::{Span, cycles};
pub(crate) use emulation::{Counted, Emulator, Job};
pub(crate) use instructions::{Core, MODEL};
pub(crate) use work::{Circumstances, Counter, Work};
