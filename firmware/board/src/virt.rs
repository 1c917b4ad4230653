//! QEMU's RISC-V `virt` machine, entered in machine mode without firmware.

use crate::{read, write};

/// Frequency of [`ticks`]. Under `-icount shift=0` an instruction takes a nanosecond, and a tick is one instruction.
pub const TICKS_PER_SECOND: u32 = 1_000_000_000;

const TEST_FINISHER: usize = 0x0010_0000;
const CLINT_SOFTWARE_INTERRUPT: usize = 0x0200_0000;
const UART_DATA: *mut u8 = 0x1000_0000 as *mut u8;
const UART_LINE_STATUS: *const u8 = 0x1000_0005 as *const u8;

core::arch::global_asm!(
    ".pushsection .text.start, \"ax\"",
    ".globl _start",
    ".type _start, @function",
    "_start:",
    // A pending software interrupt ends a sleep; none is ever taken.
    "    csrwi mie, 8",
    "    csrr t0, mhartid",
    "    bnez t0, 4f",
    "    la sp, _stack_start",
    // Zero .bss.
    "    la t0, __sbss",
    "    la t1, __ebss",
    "0:  bgeu t0, t1, 1f",
    "    sw zero, 0(t0)",
    "    addi t0, t0, 4",
    "    j 0b",
    // Copy .data.
    "1:  la t0, __sdata",
    "    la t1, __edata",
    "    la t2, __sidata",
    "2:  bgeu t0, t1, 3f",
    "    lw t3, 0(t2)",
    "    sw t3, 0(t0)",
    "    addi t0, t0, 4",
    "    addi t2, t2, 4",
    "    j 2b",
    "3:  call main",
    // The second hart sleeps until its software interrupt is pending.
    "4:",
    "5:  wfi",
    "    csrr t1, mip",
    "    andi t1, t1, 8",
    "    beqz t1, 5b",
    "    la sp, _second_stack_start",
    "    call second_main",
    "6:  wfi",
    "    j 6b",
    ".size _start, . - _start",
    ".popsection",
    // What the linker takes for the `second_main` of a program for one hart.
    ".pushsection .text.no_second_main, \"ax\"",
    ".globl no_second_main",
    "no_second_main:",
    "    ret",
    ".popsection",
);

/// Starts what the board has to start: nothing here.
#[inline(always)]
pub fn start() {}

/// Counts up, and wraps around.
#[inline(always)]
pub fn ticks() -> u32 {
    let instructions: u32;
    // SAFETY: reads a counter.
    unsafe {
        core::arch::asm!("csrr {}, minstret", out(reg) instructions, options(nomem, nostack))
    };
    instructions
}

/// Lets the second hart run the program's `extern "C" fn second_main()`.
pub fn start_second_hart() {
    // SAFETY: the second hart waits for this and has its own stack.
    unsafe { write(CLINT_SOFTWARE_INTERRUPT + 4, 1) };
}

/// Ends the sleep of the first hart, now or when it next sleeps.
pub fn wake_first_hart() {
    // SAFETY: no interrupt is ever taken.
    unsafe { write(CLINT_SOFTWARE_INTERRUPT, 1) };
}

pub(crate) fn write_byte(byte: u8) {
    const TRANSMITTER_EMPTY: u8 = 0x20;
    // SAFETY: the UART touches no memory.
    unsafe {
        while UART_LINE_STATUS.read_volatile() & TRANSMITTER_EMPTY == 0 {}
        UART_DATA.write_volatile(byte);
    }
}

pub(crate) fn exit_code(success: bool) -> ! {
    // SAFETY: ends the emulation.
    unsafe {
        write(
            TEST_FINISHER,
            if success { 0x5555 } else { 1 << 16 | 0x3333 },
        );
        loop {
            read(TEST_FINISHER);
        }
    }
}

/// Waits for a software interrupt.
pub fn sleep() {
    // SAFETY: changes nothing.
    unsafe { core::arch::asm!("wfi", options(nomem, nostack)) };
}

/// riscv32imc has no floating-point registers: nothing to check.
pub fn check_floating_point() {}
