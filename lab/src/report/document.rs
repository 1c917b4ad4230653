//! What a report says, whatever it is written as.

use scanray::Resolution;
use serde::{Serialize, Serializer};

use super::closed_forms::Distance;
use super::errors::Errors;
use super::references::{DEPTH, LeftOut, SAMPLES};
use super::settings::Settings;
use super::sweep::judge;
use super::timing::HostTime;
use crate::cost::{Core, MODEL, Work};
use scanray_host::image::Image;

/// A report.
#[derive(Debug, Serialize)]
pub(crate) struct Document {
    pub(crate) version: &'static str,
    pub(crate) reference_depth: usize,
    pub(crate) reference_samples: u32,
    /// How far the references are from closed forms.
    pub(crate) closed_forms: Vec<Distance>,
    pub(crate) emulation: Emulation,
    /// How far off predicted instructions may be, by [`Core::ALL`].
    pub(crate) instructions_within_percent: [u32; 3],
    pub(crate) scenes: Vec<SceneReport>,
}

/// Where the instructions come from.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum Emulation {
    /// From the model: nobody asked for more.
    NotAsked,
    /// From the model, because something is missing for the emulator.
    Missing(String),
    /// Counted under emulation on these cores, but for what failed, which is the model's.
    Counted {
        cores: Vec<Core>,
        failures: Vec<String>,
    },
}

impl Emulation {
    /// Where a core's instructions come from, in a word.
    pub(crate) fn word(&self, core: Core) -> &'static str {
        match self {
            Self::Counted { cores, .. } if cores.contains(&core) => "emulated",
            _ => "model",
        }
    }
}

impl Document {
    /// A report on scenes.
    pub(crate) fn new(
        closed_forms: Vec<Distance>,
        emulation: Emulation,
        mut scenes: Vec<SceneReport>,
    ) -> Self {
        for scene in &mut scenes {
            judge(&mut scene.configurations);
        }
        Self {
            closed_forms,
            emulation,
            instructions_within_percent: MODEL.within_percent(),
            version: env!("CARGO_PKG_VERSION"),
            reference_depth: DEPTH,
            reference_samples: SAMPLES,
            scenes,
        }
    }
}

/// What was measured of a scene.
#[derive(Debug, Serialize)]
pub(crate) struct SceneReport {
    pub(crate) name: String,
    /// The name as a part of the names of files and anchors, which no other scene of the report has.
    pub(crate) slug: String,
    #[serde(serialize_with = "serialize_size")]
    pub(crate) size: Resolution,
    /// By how much R1 may lack light.
    pub(crate) left_out_of_reference: LeftOut,
    pub(crate) knobs: Vec<Line>,
    pub(crate) configurations: Vec<Configuration>,
    /// R2 in 8 bits a channel.
    #[serde(skip)]
    pub(crate) reference: Image,
}

/// A knob, and the configurations it passes through: where it stands and their index.
#[derive(Debug, Serialize)]
pub(crate) struct Line {
    pub(crate) knob: &'static str,
    /// The core that it is about, if it is about one.
    pub(crate) core: Option<Core>,
    pub(crate) points: Vec<(String, usize)>,
}

/// Settings, and what came of them.
#[derive(Debug, Serialize)]
pub(crate) struct Configuration {
    pub(crate) name: String,
    pub(crate) settings: Settings,
    pub(crate) errors: Errors,
    /// The mean FLIP error of what the display shows against R2.
    pub(crate) flip: f64,
    pub(crate) work: PerPixel,
    pub(crate) host_time: HostTime,
    /// Instructions a pixel by the model, by [`Core::ALL`]; none where nothing is known.
    #[serde(rename = "instructions_by_model")]
    pub(crate) predicted: Option<[f64; 3]>,
    /// The same, counted under emulation.
    #[serde(rename = "instructions_emulated")]
    pub(crate) counted: [Option<f64>; 3],
    pub(crate) verdict: Verdict,
    /// What the display shows, in 8 bits a channel.
    #[serde(skip)]
    pub(crate) shown: Image,
}

/// Rays and tests a pixel.
#[derive(Clone, Copy, Debug, Serialize)]
pub(crate) struct PerPixel {
    pub(crate) rays: f64,
    pub(crate) tests: f64,
}

/// Whether a configuration is worth having.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum Verdict {
    /// On the Pareto front of its display.
    #[serde(rename = "pareto-front")]
    Best,
    /// The configuration with this index costs and errs as much, to 1 %.
    EqualTo(usize),
    /// The configuration with this index costs no more and errs no more, to 1 %.
    DominatedBy(usize),
    /// Its picture is wrong, and why.
    Failed(String),
    /// No device has it.
    NotForDevices,
}

/// An axis of costs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Cost {
    Rays,
    Tests,
    HostTime,
    Instructions(Core),
}

impl Cost {
    /// All of them.
    pub(crate) const ALL: [Self; 6] = [
        Self::Instructions(Core::M4f),
        Self::Instructions(Core::M3),
        Self::Instructions(Core::M0),
        Self::Rays,
        Self::Tests,
        Self::HostTime,
    ];

    /// What is on the axis, with its unit.
    pub(crate) fn label(self, emulation: &Emulation) -> String {
        match self {
            Self::Rays => "rays per pixel".to_owned(),
            Self::Tests => "intersection tests per pixel".to_owned(),
            Self::HostTime => "host, milliseconds per picture (wall time, median)".to_owned(),
            Self::Instructions(core) => {
                format!("{core}, instructions per pixel ({})", emulation.word(core))
            }
        }
    }

    /// Part of a file's name.
    pub(crate) fn slug(self) -> &'static str {
        match self {
            Self::Rays => "rays",
            Self::Tests => "tests",
            Self::HostTime => "host",
            Self::Instructions(Core::M4f) => "m4f",
            Self::Instructions(Core::M3) => "m3",
            Self::Instructions(Core::M0) => "m0",
        }
    }

    /// Whether a line belongs into a plot over this cost: of those for one core the core's, or else the first's.
    pub(crate) fn shows(self, line: &Line) -> bool {
        let core = match self {
            Self::Instructions(core) => core,
            _ => Core::ALL[0],
        };
        line.core.is_none_or(|of| of == core)
    }

    /// Of a configuration.
    pub(crate) fn of(self, configuration: &Configuration) -> Option<f64> {
        match self {
            Self::Rays => Some(configuration.work.rays),
            Self::Tests => Some(configuration.work.tests),
            Self::HostTime => Some(1e3 * configuration.host_time.median),
            Self::Instructions(core) => configuration.counted[core as usize]
                .or_else(|| configuration.predicted.map(|all| all[core as usize])),
        }
    }
}

/// An axis of errors.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Measure {
    /// What the display shows against R2.
    Total,
    /// The colours before quantisation against R1.
    BeforeQuantisation,
}

impl Measure {
    /// All of them.
    pub(crate) const ALL: [Self; 2] = [Self::Total, Self::BeforeQuantisation];

    /// What is on the axis, with its unit.
    pub(crate) fn label(self) -> &'static str {
        match self {
            Self::Total => "RMSE of what is shown, levels of 255",
            Self::BeforeQuantisation => "RMSE before quantisation, levels of 255",
        }
    }

    /// What it is measured against.
    pub(crate) fn reference(self) -> String {
        match self {
            Self::Total => format!("R2: f64, depth {DEPTH}, {SAMPLES} samples a pixel"),
            Self::BeforeQuantisation => format!("R1: f64, depth {DEPTH}, the same sampling"),
        }
    }

    /// Part of a file's name.
    pub(crate) fn slug(self) -> &'static str {
        match self {
            Self::Total => "total",
            Self::BeforeQuantisation => "linear",
        }
    }

    /// Of a configuration.
    pub(crate) fn of(self, configuration: &Configuration) -> f64 {
        match self {
            Self::Total => configuration.errors.total.rmse,
            Self::BeforeQuantisation => configuration.errors.before_quantisation.rmse,
        }
    }
}

impl PerPixel {
    /// Of a picture.
    pub(crate) fn of(work: &Work) -> Self {
        let pixels = work.pixels.max(1) as f64;
        Self {
            rays: work.count.rays() as f64 / pixels,
            tests: work.count.tests() as f64 / pixels,
        }
    }
}

fn serialize_size<S: Serializer>(size: &Resolution, to: S) -> Result<S::Ok, S::Error> {
    [size.width, size.height].serialize(to)
}
