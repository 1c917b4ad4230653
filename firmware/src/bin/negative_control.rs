//! Does everything that the checks forbid, so that each is seen to fail: a reachable panic, recursion, double precision,
//! a fused multiply-add, subnormal numbers flushed to zero.

#![no_std]
#![no_main]

use board::console;

board::entry!(program);

const TABLE: [u32; 3] = [1, 2, 3];

#[inline(never)]
fn recursion(depth: u32) -> u32 {
    if depth == 0 {
        return board::ticks();
    }
    // The stack grows: the frame's address is looked at.
    let mut local = depth;
    core::hint::black_box(&mut local);
    recursion(depth - 1) + local
}

#[inline(never)]
fn double_precision(value: u32) -> u32 {
    (f64::from(value) * 0.1) as u32
}

#[cfg(target_abi = "eabihf")]
#[inline(never)]
fn fused(value: f32) -> f32 {
    let mut sum = value;
    // SAFETY: changes one register, and puts the other back.
    unsafe {
        core::arch::asm!(
            "vpush {{s0}}",
            "vmov s0, {0}",
            "vfma.f32 s0, s0, s0",
            "vmov {0}, s0",
            "vpop {{s0}}",
            inout(reg) sum,
        );
    }
    sum
}

#[cfg(not(target_abi = "eabihf"))]
fn fused(value: f32) -> f32 {
    value
}

#[cfg(target_abi = "eabihf")]
fn flush_to_zero() {
    // SAFETY: changes the floating-point state of a program that is about to end.
    unsafe {
        core::arch::asm!(
            "vmrs {0}, fpscr",
            "orr {0}, {0}, #1 << 24",
            "vmsr fpscr, {0}",
            out(reg) _,
        );
    }
}

#[cfg(not(target_abi = "eabihf"))]
fn flush_to_zero() {}

fn program() -> Result<(), &'static str> {
    let index = recursion(board::ticks() & 1);
    console::decimal("entry ", TABLE[double_precision(index) as usize]);
    console::decimal("sum ", fused(1.0) as u32);
    flush_to_zero();
    board::check_floating_point();
    Ok(())
}
