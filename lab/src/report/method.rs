//! How the figures of a report came about, in words.

use super::closed_forms::Distance;
use super::document::{Document, Emulation};
use super::references::{DEPTH, SAMPLES};
use crate::cost::MODEL;

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
    let closed_forms = document
        .closed_forms
        .iter()
        .map(|Distance { name, r1, r2 }| format!("{name} {:.0e} levels", f64::max(*r1, *r2)))
        .collect::<Vec<_>>()
        .join(", ");
    vec![
        (
            "References",
            format!(
                "R1 has the same sampling, in f64, followed to depth {DEPTH}. R2 is R1 with {SAMPLES} samples a pixel \
                 on a regular grid. R3 are closed forms, which R1 and R2 differ from by no more than this: {closed_forms}. What R1 may lack in light because paths end, where 1 is white: {left_out}."
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
        ("Instructions", instructions(&document.emulation)),
        (
            "Host time",
            "Wall time of the core on one thread, one ray at a time: the median of seven runs, with the shortest and the \
             longest. Not deterministic; where the longest takes more than half as long again as the median, the machine was \
             busy, and the figure is marked with a question mark."
                .to_owned(),
        ),
        (
            "Other formulas",
            format!(
                "Textbook: what most ray tracers do, drawn by the code that scanray's stability is measured with. Fixed offset: \
                 the core's formulas, but new rays start {} above the surface. Both test every ray against every object; no \
                 device has them. Their rounding is the difference to the core in f64.",
                scanray_stability::textbook::EPSILON
            ),
        ),
        (
            "Preview",
            "What a picture that is drawn coarse to fine shows after its first pass, of every fourth or second pixel of every \
             fourth or second row; blocks stand for the rest. What remains to be traced afterwards is the rest, no more."
                .to_owned(),
        ),
        (
            "Pareto front",
            "Of the settings on the same display, from the cheapest on, each whose error is by more than 1 % less than that of the \
             last that was taken. Of settings that differ by less than 1 % in both the first stands for all, and the others are \
             equal to it; the rest is dominated: there is no reason to choose it. The tables go by instructions on the M4F and the error \
             against R2; each plot rings the front of its own axes."
                .to_owned(),
        ),
        (
            "tune's choices",
            "What scanray tune would choose as the budget grows, by the model: depth, cut-off and samples together, a step for \
             each third of the error that goes."
                .to_owned(),
        ),
    ]
}

/// How instructions come about.
fn instructions(emulation: &Emulation) -> String {
    let model = format!(
        "from a model: what the tracer does, counted by kind, times what each takes, which was fitted to pictures drawn under \
         emulation and is {} of them and of others (firmware/tools/instruction_model.py)",
        MODEL.within()
    );
    let unit = "Instructions, not cycles, for each pixel on Cortex-M4F, M3 and M0";
    match emulation {
        Emulation::NotAsked => format!("{unit}, {model}. --emulate counts them instead."),
        Emulation::Missing(why) => {
            format!("{unit}, {model}. They were to be counted under emulation, but {why}.")
        }
        Emulation::Counted { cores, failures } => {
            let cores = cores
                .iter()
                .map(|core| core.name())
                .collect::<Vec<_>>()
                .join(", ");
            let failures: String = failures
                .iter()
                .map(|failure| format!(" Not counted, but from the model: {failure}."))
                .collect();
            format!(
                "{unit}: on {cores} counted by QEMU (-icount shift=0), which gives each instruction a nanosecond of the board's time, on \
                 mps2-an386, mps2-an385 and microbit, while pictures of the size above are drawn row by row from a baked scene \
                 with the stages it needs, compiled for size. A program is compiled for each way of sampling, with a cut-off or \
                 without, for each kind of display and each power routine; depth, cut-off, threshold and block size are unknown to \
                 the compiler. Of pictures with more than 100,000 samples, as many to each pixel, so many rows were drawn as have 100,000, \
                 which stand for all (firmware/tools/settings.py). On other cores they are {model}.{failures}"
            )
        }
    }
}
