//! Any bytes are a scene or an error at a place.
#![no_main]

#[path = "../../scene/properties.rs"]
mod properties;

libfuzzer_sys::fuzz_target!(|text: &[u8]| properties::parse(text));
