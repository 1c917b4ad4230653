//! What the integration tests share: scenes, pictures, a recording display, random numbers.

// Every test program compiles this module for itself and uses a part of it.
#![allow(dead_code)]

pub(crate) mod canvas;
pub(crate) mod picture;

#[allow(unused_imports)]
pub(crate) use scanray_stability::{clear_misses, random, scenes, settled as sampling};

/// Whether expected files are to be rewritten instead of compared.
pub(crate) fn is_blessing() -> bool {
    std::env::var_os("BLESS").is_some_and(|value| value == "1")
}
