//! Error against run time: what each setting costs and what it buys.
//!
//! [`sweep`] turns every knob of [`settings`], measures errors against [`references`] and costs in rays,
//! tests, instructions and host time; [`document`] holds the result, which [`page`], [`markdown`] and
//! [`table`] write.

mod closed_forms;
mod document;
mod errors;
mod linear;
mod markdown;
mod method;
mod page;
mod pareto;
mod plot;
mod references;
mod scenes;
mod settings;
mod sweep;
mod table;
mod timing;
mod tracing;
mod tune;

pub(crate) use closed_forms::distances;
pub(crate) use document::{Document, Emulation, SceneReport};
pub(crate) use markdown::write as write_markdown;
pub(crate) use page::write as write_page;
pub(crate) use plot::number;
pub(crate) use scenes::BothScalars;
pub(crate) use settings::{Sampling, Settings};
pub(crate) use sweep::{Sweep, slug};
pub(crate) use table::{write_csv, write_json};
pub(crate) use tune::{Budget, Choice, Tuned, tune};
