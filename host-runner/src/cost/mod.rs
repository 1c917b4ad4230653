//! What a picture costs: the tracer's work, counted, and what it stands for on a microcontroller.

mod cycles;
mod instructions;
mod work;

use crate::failure::Failure;

pub(crate) use cycles::{Span, cycles};
pub(crate) use instructions::{Core, MODEL};
pub(crate) use work::{Counter, Work};

/// That [`MODEL`] says nothing about a scene.
pub(crate) fn no_prediction() -> Failure {
    Failure::Usage(
        "no instructions can be predicted: the scene is large enough for a tree, which the model does not \
         know; measure on the board"
            .to_owned(),
    )
}
