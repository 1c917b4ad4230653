//! A scene that was printed is read back as the same scene.
#![no_main]

#[path = "../properties.rs"]
mod properties;

libfuzzer_sys::fuzz_target!(|text: &[u8]| properties::print(text));
