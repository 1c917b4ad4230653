//! A scene that was printed is read back as the same scene.
#![no_main]

#[path = "../../scene/printing.rs"]
mod printing;
#[path = "../../scene/properties.rs"]
mod properties;

libfuzzer_sys::fuzz_target!(|text: &[u8]| printing::print(text));
