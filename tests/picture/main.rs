//! What is drawn: colours, golden pictures, and the same bits whatever the schedule and the display.
//! `cargo test --test picture golden` runs the tests of one file.

mod camera;
mod closed_forms;
#[path = "../common/mod.rs"]
mod common;
mod cutoff;
mod display_colors;
mod drivers;
mod finite_colors;
mod golden;
mod lights_on_surfaces;
mod progressive;
mod rays;
mod samples;
mod schedules;
mod stages;
