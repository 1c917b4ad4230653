//! What a picture costs: the tracer's work, counted, and the instructions it stands for on a microcontroller.

mod instructions;
mod table;
mod work;

pub use instructions::{Core, MODEL, Model};
pub use table::{Rows, parse as parse_table};
pub use work::Work;
