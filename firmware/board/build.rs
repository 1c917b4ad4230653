//! Puts the selected board's memory layout where the linker finds it.

use std::{env, fs, path::Path};

fn main() {
    let out = env::var("OUT_DIR").expect("cargo sets OUT_DIR");
    let boards = ["mps2", "microbit", "lm3s6965evb", "virt"];
    let selected: Vec<_> = boards
        .into_iter()
        .filter(|board| env::var(format!("CARGO_FEATURE_{}", board.to_uppercase())).is_ok())
        .collect();

    // No board at all is a host build: there is nothing to link.
    assert!(selected.len() <= 1, "select one board, not {selected:?}");
    if let [board] = selected[..] {
        let place = |from: &str, to: &str| {
            fs::copy(Path::new("link").join(from), Path::new(&out).join(to))
                .unwrap_or_else(|error| panic!("link/{from}: {error}"));
        };
        if board == "virt" {
            place("virt.x", "virt.x");
        } else {
            place(&format!("{board}.x"), "memory.x");
            place("device.x", "device.x");
        }
        place("stack_sizes.x", "stack_sizes.x");
    }
    println!("cargo:rustc-link-search={out}");
    println!("cargo:rerun-if-changed=link");
}
