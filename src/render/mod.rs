//! From linear colour to a display: quantisation, rows, whole pictures, frames that can be resumed.

mod color;
mod dither;
mod frame;
mod picture;

pub use color::{DisplayColor, Dithered, Exact, Quantizer, ThroughRgb888};
pub use frame::{Budget, Frame, Progress};
pub use picture::{Picture, PixelSource};
