//! What pictures are compared with.
//!
//! * **R1**: the same sampling in `f64`, followed until depth [`DEPTH`]: what is left of rounding and
//!   truncation is the difference to it.
//! * **R2**: R1 with [`SAMPLES`] samples a pixel on a regular grid: the difference between R1 and it is
//!   aliasing.
//! * **R3**: closed forms ([`super::closed_forms`]), which R1 and R2 are checked with.
//!
//! One reference for all would hide rounding behind aliasing, which is a thousand times larger.

use std::collections::HashMap;
use std::sync::{Arc, Mutex, PoisonError};

use rayon::prelude::*;
use scanray::{
    Ray, Resolution, Scene,
    camera::Subpixel,
    ray::ObjectNumber,
    render::{PixelSource, SampleSource},
    shape::Object,
    tracer::{Observer, RayKind},
};

use super::linear::{Linear, in_greys};
use super::settings::Sampling;
use super::tracing::ReportTracer;
use scanray_host::failure::Failure;
use scanray_host::knobs::Detail;
use scanray_host::option_values::ColorName;
use scanray_host::parallel_drawing::Workers;

/// How many secondary rays follow one another in R1 and R2.
pub(crate) const DEPTH: usize = 16;

/// Samples a pixel of R2, along each side.
pub(crate) const SAMPLES_A_SIDE: u16 = 16;

/// Samples a pixel of R2.
pub(crate) const SAMPLES: u32 = SAMPLES_A_SIDE as u32 * SAMPLES_A_SIDE as u32;

/// R1 of a way of sampling.
struct R1 {
    sampling: Sampling,
    preview: Detail,
    picture: Arc<Linear>,
}

/// The references of a scene.
pub(crate) struct References<'a> {
    tracer: ReportTracer<'a, f64>,
    /// R1 of each way of sampling that was asked for.
    r1: Mutex<Vec<R1>>,
    /// Many samples a pixel, and the same in greys.
    pub(crate) r2: Linear,
    r2_in_greys: Linear,
    /// What R1 leaves out, with one sample a pixel.
    pub(crate) left_out: LeftOut,
}

/// By how much a picture may lack light because paths end: the mean and the largest bound of a pixel,
/// where 1 is white.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize)]
pub(crate) struct LeftOut {
    pub(crate) mean: f64,
    pub(crate) max: f64,
}

impl<'a> References<'a> {
    /// Draws R2.
    ///
    /// # Errors
    ///
    /// [`Failure::Usage`] for a picture too large for it.
    pub(crate) fn draw(
        scene: Scene<'a, f64>,
        resolution: Resolution,
        workers: &Workers,
    ) -> Result<Self, Failure> {
        let tracer = ReportTracer::new(scene, resolution, DEPTH, 0.0)?;
        let large = enlarged(resolution)?;
        let fine = ReportTracer::new(scene, large, DEPTH, 0.0)?;
        let r2 = Linear::draw_reduced(&fine, SAMPLES_A_SIDE, workers);
        Ok(Self {
            tracer,
            r1: Mutex::default(),
            r2_in_greys: in_greys(r2.clone(), ColorName::Gray8),
            r2,
            left_out: left_out(&tracer, workers),
        })
    }

    /// R2 as a display of a kind would show it if it had all levels.
    pub(crate) fn r2_in(&self, color: ColorName) -> &Linear {
        if color.is_grey() {
            &self.r2_in_greys
        } else {
            &self.r2
        }
    }

    /// R1 of a way of sampling.
    pub(crate) fn r1(&self, sampling: Sampling, preview: Detail, workers: &Workers) -> Arc<Linear> {
        let mut known = self.r1.lock().unwrap_or_else(PoisonError::into_inner);
        let is_same = |r1: &&R1| r1.sampling == sampling && r1.preview == preview;
        if let Some(r1) = known.iter().find(is_same) {
            return r1.picture.clone();
        }
        let colors = self.tracer.colors(sampling, preview, workers);
        let picture = Arc::new(Linear::new(self.tracer.resolution(), &colors));
        known.push(R1 {
            sampling,
            preview,
            picture: picture.clone(),
        });
        picture
    }
}

/// The size of a picture that has a pixel for each sample of R2.
///
/// # Errors
///
/// [`Failure::Usage`] for a side that is too long.
pub(crate) fn enlarged(resolution: Resolution) -> Result<Resolution, Failure> {
    let larger = |side: u16| {
        side.checked_mul(SAMPLES_A_SIDE).ok_or_else(|| {
            let most = u16::MAX / SAMPLES_A_SIDE;
            Failure::Usage(format!(
                "a side of {side} pixels is too long for the reference, which takes {SAMPLES} samples \
                 a pixel: at most {most}; name a smaller --size"
            ))
        })
    };
    Ok(Resolution {
        width: larger(resolution.width)?,
        height: larger(resolution.height)?,
    })
}

/// Bounds what a picture lacks because secondary rays are not cast.
///
/// A ray of throughput `w` that hits a surface at the last depth would have added at most `w` times the
/// surface's reflection and refraction together, and no more than `w`, because colours are clamped.
fn left_out(tracer: &ReportTracer<'_, f64>, workers: &Workers) -> LeftOut {
    let Resolution { width, height } = tracer.resolution();
    let shares = Shares::of(tracer.scene());
    let row = |y: u16| {
        let scanline = tracer.scanline(y);
        let bound = |x: u16| {
            let mut ends = Ends {
                tracer,
                shares: &shares,
                throughputs: [1.0; DEPTH + 1],
                bound: 0.0,
            };
            tracer.sample(&scanline, x, Subpixel::CENTER, &mut ends);
            ends.bound
        };
        (0..width).map(bound).fold((0.0, 0.0), |(sum, max), bound| {
            (sum + bound, f64::max(max, bound))
        })
    };
    let (sum, max) = workers.install(|| {
        (0..height)
            .into_par_iter()
            .map(row)
            .reduce(|| (0.0, 0.0), |a, b| (a.0 + b.0, f64::max(a.1, b.1)))
    });
    LeftOut {
        mean: sum / (f64::from(width) * f64::from(height)),
        max,
    }
}

/// Shares of light that the objects of a scene reflect and refract, by their numbers.
struct Shares(HashMap<ObjectNumber, (f64, f64)>);

impl Shares {
    fn of(scene: &Scene<'_, f64>) -> Self {
        let shares = |object: Object<'_, f64>| {
            let material = scene.material(object.info());
            let shares = (material.reflection, material.refraction);
            (object.info().number, shares)
        };
        Self(scene.objects().map(shares).collect())
    }

    fn get(&self, object: ObjectNumber) -> (f64, f64) {
        self.0.get(&object).copied().unwrap_or_default()
    }
}

/// Sums up the throughput that ends at the last depth.
struct Ends<'t, 's> {
    tracer: &'t ReportTracer<'s, f64>,
    shares: &'t Shares,
    /// Of the rays from the primary one to the one under way.
    throughputs: [f64; DEPTH + 1],
    bound: f64,
}

impl Observer<f64> for Ends<'_, '_> {
    fn ray(&mut self, kind: RayKind, depth: usize, ray: &Ray<f64>) {
        let (reflected, refracted) = self.shares.get(ray.leaves.object());
        let weight = match kind {
            RayKind::Shadow => return,
            RayKind::Primary => 1.0,
            RayKind::Reflected => self.throughputs[depth - 1] * reflected,
            RayKind::Refracted => self.throughputs[depth - 1] * refracted,
        };
        self.throughputs[depth] = weight;
        if depth == DEPTH {
            let met = self.tracer.nearest(ray);
            let (reflected, refracted) =
                met.map_or((0.0, 0.0), |met| self.shares.get(met.object.info().number));
            self.bound += weight * f64::min(reflected + refracted, 1.0);
        }
    }
}
