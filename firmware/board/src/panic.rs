//! A panic: under `prove-no-panic` a link error wherever one is reachable, otherwise a message and a failed run.

use core::panic::PanicInfo;

#[cfg(feature = "prove-no-panic")]
#[panic_handler]
fn panic(_: &PanicInfo<'_>) -> ! {
    unsafe extern "C" {
        /// Nobody defines this. The linker drops the handler with the last call to it, so an image links only if no
        /// panic is reachable in it.
        safe fn a_panic_is_reachable() -> !;
    }
    a_panic_is_reachable()
}

#[cfg(not(feature = "prove-no-panic"))]
#[panic_handler]
fn panic(info: &PanicInfo<'_>) -> ! {
    use core::fmt::Write as _;
    // The console cannot fail.
    let _ = writeln!(crate::console::Console, "{info}");
    crate::exit(Err("panic"))
}
