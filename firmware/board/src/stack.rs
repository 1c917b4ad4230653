//! How deep the stack has been: unused stack is painted, and what is still painted was never used.

const PAINT: u32 = 0xC0DE_57AC;

unsafe extern "C" {
    static _stack_end: u32;
    static _stack_start: u32;
}

/// Paints the stack below the caller's frame. Assembly throughout, since only a function without a frame of its own knows
/// where the live stack ends.
#[unsafe(naked)]
pub extern "C" fn paint() {
    #[cfg(target_arch = "arm")]
    core::arch::naked_asm!(
        "ldr r0, 3f",
        "ldr r1, 4f",
        "mov r2, sp",
        "2: cmp r2, r0",
        "bls 5f",
        "subs r2, #4",
        "str r1, [r2]",
        "b 2b",
        "5: bx lr",
        ".p2align 2",
        "3: .word _stack_end",
        "4: .word {paint}",
        paint = const PAINT,
    );
    #[cfg(target_arch = "riscv32")]
    core::arch::naked_asm!(
        "la t0, _stack_end",
        "li t1, {paint}",
        "mv t2, sp",
        "2: bleu t2, t0, 3f",
        "addi t2, t2, -4",
        "sw t1, 0(t2)",
        "j 2b",
        "3: ret",
        paint = const PAINT as i32,
    );
}

/// The bytes of stack used since [`paint`], from the very start of the stack.
#[inline(never)]
pub fn high_water() -> u32 {
    let start = (&raw const _stack_start).addr();
    let mut address = (&raw const _stack_end).addr();
    // SAFETY: stays between the linker's `_stack_end` and `_stack_start`.
    while address < start && unsafe { crate::read(address) } == PAINT {
        address += size_of::<u32>();
    }
    (start - address) as u32
}
