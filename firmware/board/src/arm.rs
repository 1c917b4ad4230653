//! What the Cortex-M boards share: start-up by cortex-m-rt, console and exit by semihosting, the floating-point state.

use cortex_m_semihosting::{debug, nr, syscall};

/// No program here takes a device's interrupt (SysTick is the core's), and cortex-m-rt wants at least one vector. Without
/// this table it would add 240 of them, a kilobyte.
#[unsafe(link_section = ".vector_table.interrupts")]
#[unsafe(no_mangle)]
static __INTERRUPTS: [u32; 1] = [0];

pub(crate) fn write_byte(byte: u8) {
    // SAFETY: SYS_WRITEC takes the address of one byte.
    unsafe {
        syscall(nr::WRITEC, &byte);
    }
}

pub(crate) fn exit_code(success: bool) -> ! {
    loop {
        debug::exit(if success {
            debug::EXIT_SUCCESS
        } else {
            debug::EXIT_FAILURE
        });
    }
}

/// Waits for an interrupt.
pub fn sleep() {
    cortex_m::asm::wfi();
}

/// The hardware must not flush subnormal numbers to zero, or replace NaNs, or round other than to nearest: the bits would
/// differ from the other boards'. Ends the emulation if it does. (Case 67 of `scanray stability`.)
pub fn check_floating_point() {
    #[cfg(target_abi = "eabihf")]
    {
        let status: u32;
        // SAFETY: reads a register; cortex-m-rt has switched the FPU on.
        unsafe {
            core::arch::asm!("vmrs {}, fpscr", out(reg) status, options(nomem, nostack, preserves_flags));
        }
        const ROUNDING: u32 = 0b11 << 22;
        const FLUSH_TO_ZERO: u32 = 1 << 24;
        const DEFAULT_NAN: u32 = 1 << 25;
        if status & (ROUNDING | FLUSH_TO_ZERO | DEFAULT_NAN) != 0 {
            crate::console::hexadecimal("not in IEEE mode: FPSCR ", status);
            exit_code(false);
        }
    }
}

/// A fault ends the emulation as a failure, at once.
#[cortex_m_rt::exception(trampoline = false)]
unsafe fn HardFault() -> ! {
    exit_code(false)
}
