//! Display drivers over embedded-hal that draw without a frame buffer.

#![no_std]
#![deny(
    missing_docs,
    missing_debug_implementations,
    unreachable_pub,
    unsafe_code
)]

pub mod ssd0323;
