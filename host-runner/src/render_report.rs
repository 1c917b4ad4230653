//! What `scanray render --json` tells of a picture.

use std::io::{self, Write};
use std::ops::Range;

use scanray::{Resolution, Scalar, pools::PoolUse};
use serde::ser::{Serialize, SerializeMap, Serializer};

use crate::cost::{Core, MODEL, Work};

/// A picture that was drawn, its settings and what it took.
#[derive(Clone, Debug, serde::Serialize)]
pub(crate) struct RenderReport {
    pub(crate) scene: String,
    pub(crate) file: String,
    pub(crate) bytes: u64,
    #[serde(serialize_with = "serialize_resolution")]
    pub(crate) size: Resolution,
    pub(crate) rows: Range<u16>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) turntable: Option<TurntableReport>,
    pub(crate) scalar: &'static str,
    pub(crate) color: String,
    pub(crate) dither: bool,
    pub(crate) max_depth: usize,
    /// What the rays that are not cast may take from a channel.
    pub(crate) cutoff: f64,
    /// In a pixel.
    pub(crate) samples: usize,
    /// The difference that is an edge, if only pixels at edges have more than one sample.
    pub(crate) adaptive: Option<f64>,
    pub(crate) preview: String,
    pub(crate) threads: usize,
    /// Wall time of drawing, without loading, writing and counting.
    pub(crate) seconds: f64,
    /// CPU time of all threads for the same.
    pub(crate) cpu_seconds: f64,
    /// How `rays` and `tests` came about.
    pub(crate) counted_by: &'static str,
    pub(crate) rays: Rays,
    pub(crate) tests: Tests,
    /// What rays, tests and hits are made of: the counts that the instruction model takes.
    pub(crate) work: Counts,
    /// What the instruction model predicts for devices; they draw in `f32`.
    pub(crate) predicted_instructions_per_pixel: Option<Instructions>,
    pub(crate) pools: Pools,
}

/// The pictures of a turntable that are in a file; times, rays and tests are those of all of them.
#[derive(Clone, Debug, serde::Serialize)]
pub(crate) struct TurntableReport {
    pub(crate) steps: Range<u16>,
    pub(crate) of: u16,
    /// x and z of the axis.
    pub(crate) about: [f64; 2],
}

/// Rays by kind.
#[derive(Clone, Debug, Default, serde::Serialize)]
pub(crate) struct Rays {
    primary: u64,
    reflected: u64,
    refracted: u64,
    shadow: u64,
    total: u64,
}

/// Intersection tests by kind.
#[derive(Clone, Debug, Default, serde::Serialize)]
pub(crate) struct Tests {
    sphere: u64,
    plane: u64,
    triangle: u64,
    #[serde(rename = "box")]
    boxes: u64,
    total: u64,
}

/// Counts by name.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Counts(Work);

/// Instructions by core.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Instructions([f64; 3]);

/// How full the pools are.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pools(pub(crate) [PoolUse; 5]);

impl RenderReport {
    /// Enters what the picture took.
    pub(crate) fn set_work(&mut self, work: &Work) {
        self.rays = Rays {
            primary: work.primary_rays,
            reflected: work.reflected_rays,
            refracted: work.refracted_rays,
            shadow: work.shadow_rays,
            total: work.rays(),
        };
        self.tests = Tests {
            sphere: work.sphere_tests,
            plane: work.plane_tests,
            triangle: work.triangle_tests,
            boxes: work.box_tests,
            total: work.tests(),
        };
        self.work = Counts(*work);
        self.predicted_instructions_per_pixel =
            (self.scalar == f32::NAME).then(|| Instructions(MODEL.instructions_per_pixel(work)));
    }

    /// Writes a line of JSON.
    ///
    /// # Errors
    ///
    /// Those of `out`.
    pub(crate) fn write_json(&self, out: &mut dyn Write) -> io::Result<()> {
        serde_json::to_writer(&mut *out, self)?;
        writeln!(out)
    }
}

fn serialize_resolution<S: Serializer>(size: &Resolution, to: S) -> Result<S::Ok, S::Error> {
    let mut map = to.serialize_map(Some(2))?;
    map.serialize_entry("width", &size.width)?;
    map.serialize_entry("height", &size.height)?;
    map.end()
}

impl Serialize for Counts {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        to.collect_map(self.0.counts())
    }
}

impl Serialize for Instructions {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        to.collect_map(Core::ALL.map(Core::name).into_iter().zip(self.0))
    }
}

impl Serialize for Pools {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        /// One pool; `bytes` are those of the entries in use.
        #[derive(serde::Serialize)]
        struct Usage {
            used: usize,
            capacity: usize,
            bytes: usize,
            capacity_bytes: usize,
        }
        let mut map = to.serialize_map(Some(self.0.len()))?;
        for pool in &self.0 {
            let entry_bytes = pool.bytes.checked_div(pool.capacity).unwrap_or(0);
            let usage = Usage {
                used: pool.used,
                capacity: pool.capacity,
                bytes: pool.used * entry_bytes,
                capacity_bytes: pool.bytes,
            };
            map.serialize_entry(pool.pool.name(), &usage)?;
        }
        map.end()
    }
}
