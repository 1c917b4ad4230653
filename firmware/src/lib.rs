//! What the programs share.

#![no_std]
#![deny(
    missing_docs,
    missing_debug_implementations,
    unreachable_pub,
    unsafe_code
)]

pub mod bad_scenes;
pub mod hash;
#[cfg(feature = "counts")]
pub mod measure;
