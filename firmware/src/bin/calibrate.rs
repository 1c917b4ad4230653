//! Calibrates the instruction counter: loops of known length, counted and printed beside what they must take.

#![no_std]
#![no_main]

use board::console;

board::entry!(program);

/// Executes 2·`rounds` instructions and a few more.
#[inline(never)]
fn count_down(rounds: u32) {
    // SAFETY: changes one register and the flags.
    unsafe {
        #[cfg(target_arch = "arm")]
        core::arch::asm!(
            "2:",
            "subs {0}, {0}, #1",
            "bne 2b",
            inout(reg) rounds => _,
            options(nomem, nostack),
        );
        #[cfg(target_arch = "riscv32")]
        core::arch::asm!(
            "2:",
            "addi {0}, {0}, -1",
            "bnez {0}, 2b",
            inout(reg) rounds => _,
            options(nomem, nostack),
        );
    }
}

fn program() -> Result<(), &'static str> {
    for rounds in [1_000_000, 3_000_000] {
        let before = board::ticks();
        count_down(rounds);
        let after = board::ticks();
        console::hexadecimal("rounds ", rounds);
        console::hexadecimal("ticks ", after.wrapping_sub(before));
    }
    Ok(())
}
