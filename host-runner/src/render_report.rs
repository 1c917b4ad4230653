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
    /// The counts that the instruction model takes.
    pub(crate) work: Terms,
    /// What the instruction model predicts for devices; they draw in `f32`.
    pub(crate) predicted_instructions_per_pixel: Option<ByCore<f64>>,
    /// How far off the prediction may be.
    pub(crate) predicted_within_percent: Option<ByCore<u32>>,
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
    other: u64,
    #[serde(rename = "box")]
    boxes: u64,
    total: u64,
}

/// Terms of the instruction model by name.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Terms(Work);

/// A figure for each core, by its name.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ByCore<F>([F; Core::ALL.len()]);

/// How full the pools are.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pools(pub(crate) [PoolUse; 5]);

impl RenderReport {
    /// Enters what the picture took.
    pub(crate) fn set_work(&mut self, work: &Work) {
        let count = &work.count;
        self.rays = Rays {
            primary: count.primary_rays,
            reflected: count.reflected_rays,
            refracted: count.refracted_rays,
            shadow: count.shadow_rays,
            total: count.rays(),
        };
        self.tests = Tests {
            sphere: count.sphere_tests,
            plane: count.plane_tests,
            triangle: count.triangle_tests,
            other: count.other_tests,
            boxes: count.box_tests,
            total: count.tests(),
        };
        self.work = Terms(*work);
        if self.scalar == f32::NAME {
            self.predicted_instructions_per_pixel =
                Some(ByCore(MODEL.instructions_per_pixel(work)));
            self.predicted_within_percent = Some(ByCore(MODEL.within_percent()));
        }
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

impl Serialize for Terms {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        to.collect_map(self.0.terms())
    }
}

impl<F: Serialize> Serialize for ByCore<F> {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        to.collect_map(Core::ALL.map(Core::name).into_iter().zip(&self.0))
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
