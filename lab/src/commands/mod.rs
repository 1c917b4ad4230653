//! The commands, one file each.

pub(crate) mod report;
pub(crate) mod stability;
pub(crate) mod tune;
