//! What the integration tests share: scenes, pictures, a recording display, random numbers.

// Every test program compiles this module for itself and uses a part of it. The catalogue of the laboratory (lab/stability) takes
// in some of its files, whose items it makes public.
#![allow(dead_code, unused_imports, unreachable_pub)]

pub(crate) mod canvas;
pub(crate) mod picture;
pub(crate) mod quick_reject;
pub(crate) mod random;
pub(crate) mod random_texts;
pub(crate) mod rejection;
#[path = "settled.rs"]
pub(crate) mod sampling;
pub(crate) mod scenes;

/// Whether expected files are to be rewritten instead of compared.
pub(crate) fn is_blessing() -> bool {
    std::env::var_os("BLESS").is_some_and(|value| value == "1")
}
