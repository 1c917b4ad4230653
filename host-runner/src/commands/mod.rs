//! The commands, one file each.

pub(crate) mod ask;
pub(crate) mod bake;
pub mod completions;
pub(crate) mod diff;
pub(crate) mod example;
pub(crate) mod export;
pub(crate) mod fmt;
pub(crate) mod generate;
pub(crate) mod inspect;
pub(crate) mod join;
pub mod man;
pub(crate) mod needs;
pub(crate) mod pixel;
pub(crate) mod render;
pub(crate) mod view;
#[cfg(feature = "window")]
pub(crate) mod window;
