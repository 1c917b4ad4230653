//! A scene that is accepted is drawn: finite colours, no more rays than promised.
#![no_main]

#[path = "../../scene/properties.rs"]
mod properties;

libfuzzer_sys::fuzz_target!(|text: &[u8]| properties::draw(text));
