//! What pictures cost: the host's counts and predictions, what these stand for in time, and counts under emulation.

mod cycles;
mod emulation;

pub(crate) use cycles::{Span, cycles};
pub(crate) use emulation::{Counted, Emulator, Job};
pub(crate) use scanray_host::cost::{Core, MODEL, Work};
