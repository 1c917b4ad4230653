//! The commands, one file each.

pub(crate) mod bake;
pub(crate) mod diff;
pub(crate) mod inspect;
pub(crate) mod join;
pub(crate) mod pixel;
pub(crate) mod render;
