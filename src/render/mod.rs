//! From linear colour to a display: quantisation, rows, whole pictures, frames that can be resumed, more
//! samples a pixel.

mod adaptive;
mod dither;
mod frame;
mod picture;
mod progressive;
mod quantize;
mod supersampling;

pub use adaptive::{Adaptive, AdaptiveScanline, CenterSample, differ};
pub use frame::{Budget, Frame, Progress};
pub use picture::{Picture, PixelSource};
pub use progressive::Progressive;
pub use quantize::{DisplayColor, Dithered, Exact, Quantizer, ThroughRgb888};
pub use supersampling::{SampleSource, Supersampled};
