//! How the figures of a report came about, in words.

use super::document::Document;
use super::references::{DEPTH, SAMPLES};

/// A heading and what belongs to it.
pub(crate) type Paragraph = (&'static str, String);

/// What a reader has to know.
pub(crate) fn paragraphs(document: &Document) -> Vec<Paragraph> {
    let left_out = document
        .scenes
        .iter()
        .map(|scene| {
            let left = scene.left_out_of_reference;
            format!(
                "{} {:.1e} on average, {:.1e} at most",
                scene.name, left.mean, left.max
            )
        })
        .collect::<Vec<_>>()
        .join("; ");
    vec![
        (
            "References",
            format!(
                "R1 has the same sampling, in f64, followed to depth {DEPTH}. R2 is R1 with {SAMPLES} samples a pixel \
                 on a regular grid. What R1 may lack in light because paths end, where 1 is white: {left_out}."
            ),
        ),
        (
            "Errors",
            "In levels of 8 bits, 255 from black to white. What a display shows differs from R2 by the sum of four: \
             quantisation (what is shown less the colours before), rounding (those less the same settings in f64), \
             truncation (those less R1) and aliasing (R1 less R2). RMSE: root of the mean square over all pixels and channels. \
             FLIP: the mean of what someone sees who flips between the picture and R2 (Andersson et al. 2020), 0 to 1."
                .to_owned(),
        ),
        (
            "Rays and tests",
            "Counted while the picture is traced: rays from the camera, mirrored, refracted and towards the light; \
             tests of a ray against a sphere, plane or triangle."
                .to_owned(),
        ),
        (
            "Instructions",
            "Instructions, not cycles, for each pixel on Cortex-M4F, M3 and M0, from a model: what the tracer does, counted \
             by kind, times what each takes, which was fitted to pictures drawn under emulation \
             (firmware/tools/instruction_model.py). The model stands for RGB888 and f32."
                .to_owned(),
        ),
        (
            "Host time",
            "Wall time of the core on one thread, one ray at a time: the median of seven runs, with the shortest and the \
             longest. Not deterministic."
                .to_owned(),
        ),
        (
            "Pareto front",
            "Settings that no other on the same display matches in both instructions on the M4F and error against R2. \
             All others are dominated: there is no reason to choose them."
                .to_owned(),
        ),
    ]
}
