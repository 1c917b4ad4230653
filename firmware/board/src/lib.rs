//! What a program needs of a board, the same on all of them: [`entry!`], [`console`], the exact instruction
//! [`counter`], the painted [`stack`], the picture's [`crc32`], and [`exit`].
//!
//! One cargo feature selects the board. Without any, only what is not a board's compiles, for tests on the host.

#![no_std]
#![deny(missing_docs, missing_debug_implementations, unreachable_pub)]

#[cfg(any(feature = "mps2", feature = "microbit", feature = "lm3s6965evb"))]
mod arm;
#[cfg(feature = "lm3s6965evb")]
#[path = "lm3s6965evb.rs"]
mod selected;
#[cfg(feature = "microbit")]
#[path = "microbit.rs"]
mod selected;
#[cfg(feature = "mps2")]
#[path = "mps2.rs"]
mod selected;
#[cfg(feature = "virt")]
#[path = "virt.rs"]
mod selected;

pub mod console;
pub mod crc32;
#[cfg(target_os = "none")]
mod panic;
#[cfg(feature = "lm3s6965evb")]
pub mod pl022;
#[cfg(target_os = "none")]
pub mod stack;

#[cfg(target_os = "none")]
pub use on_a_board::*;

#[cfg(target_os = "none")]
mod on_a_board {
    #[cfg(any(feature = "mps2", feature = "microbit", feature = "lm3s6965evb"))]
    pub use crate::arm::{check_floating_point, sleep};
    #[cfg(any(feature = "mps2", feature = "microbit", feature = "lm3s6965evb"))]
    pub(crate) use crate::arm::{exit_code, write_byte};
    pub use crate::selected::*;

    /// Ends the emulation: `Ok` is success, `Err` says why not.
    pub fn exit(result: Result<(), &'static str>) -> ! {
        if let Err(reason) = result {
            crate::console::line("failed: ", reason);
        }
        exit_code(result.is_ok())
    }

    /// What [`entry!`](crate::entry) runs: checks the floating-point state, then the program, then ends the emulation.
    #[inline(always)]
    pub fn run(program: impl FnOnce() -> Result<(), &'static str>) -> ! {
        check_floating_point();
        start();
        exit(program())
    }
}

/// Makes a function the program: `fn() -> Result<(), &'static str>`, or with static memory that it alone owns
/// `fn(&'static mut Memory) -> Result<(), &'static str>`.
#[macro_export]
macro_rules! entry {
    ($program:path) => {
        /// What the start-up code calls when RAM is initialised.
        #[unsafe(no_mangle)]
        extern "C" fn main() -> ! {
            $crate::run($program)
        }
    };
    ($program:path, $memory:ty = $initial:expr) => {
        /// What the start-up code calls when RAM is initialised.
        #[unsafe(no_mangle)]
        extern "C" fn main() -> ! {
            static mut MEMORY: $memory = $initial;
            // SAFETY: the start-up code calls this function, and once; nobody else can name the memory.
            $crate::run(|| $program(unsafe { &mut *(&raw mut MEMORY) }))
        }
    };
}

/// Reads a device register.
///
/// # Safety
///
/// `address` must be a register of this board.
#[cfg(target_os = "none")]
#[inline(always)]
pub unsafe fn read(address: usize) -> u32 {
    unsafe { (address as *const u32).read_volatile() }
}

/// Writes a device register.
///
/// # Safety
///
/// `address` must be a register of this board, and the write must not change memory that Rust owns.
#[cfg(target_os = "none")]
#[inline(always)]
pub unsafe fn write(address: usize, value: u32) {
    unsafe { (address as *mut u32).write_volatile(value) }
}
