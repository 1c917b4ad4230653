//! Measures every setting of every knob.

use scanray::{Color, Dithered, Exact, Resolution, Scalar, Scene};

use super::document::{Configuration, Cost, Line, Measure, PerPixel, SceneReport, Verdict};
use super::errors::{Error, Errors, Steps};
use super::linear::{Linear, shown};
use super::pareto::{Point, dominators};
use super::references::{LeftOut, References};
use super::scenes::BothScalars;
use super::settings::{Knob, Settings, knobs};
use super::timing::HostTime;
use super::tracing::ReportTracer;
use crate::compare::{Comparison, DEFAULT_PIXELS_PER_DEGREE};
use crate::cost::{Core, MODEL, Work, no_prediction};
use crate::drawing::Workers;
use crate::failure::Failure;
use crate::image::Image;
use crate::options::{ScalarName, with_color};
use crate::progress::Progress;

/// A share of pixels that rounding alone may put more than one level off: those on edges.
const ALLOWED_SHARE: f64 = 0.01;

/// The measuring of a scene.
pub(crate) struct Sweep<'a> {
    scene: &'a BothScalars,
    resolution: Resolution,
    references: References<'a>,
    workers: &'a Workers,
}

/// A picture of some settings before quantisation and as it is shown.
struct Drawn {
    linear: Linear,
    shown: Vec<[u8; 3]>,
}

/// What settings take and how wrong their picture is.
pub(crate) struct Estimate {
    pub(crate) work: Work,
    /// Of a picture.
    pub(crate) instructions: f64,
    /// Of what is shown, against R2, in levels of 255.
    pub(crate) rmse: f64,
}

impl<'a> Sweep<'a> {
    /// Draws the references.
    ///
    /// # Errors
    ///
    /// [`Failure::Usage`] for a picture that is too large.
    pub(crate) fn new(
        scene: &'a BothScalars,
        resolution: Resolution,
        workers: &'a Workers,
    ) -> Result<Self, Failure> {
        let references =
            References::draw(scene.double(Settings::DEFAULT.power), resolution, workers)?;
        Ok(Self {
            scene,
            resolution,
            references,
            workers,
        })
    }

    /// By how much R1 may lack light.
    pub(crate) fn left_out(&self) -> LeftOut {
        self.references.left_out
    }

    /// How many configurations [`Sweep::run`] measures.
    pub(crate) fn steps() -> u64 {
        distinct(&knobs()).len() as u64
    }

    /// Turns all knobs.
    ///
    /// # Errors
    ///
    /// [`Failure`].
    pub(crate) fn run(&self, name: String, progress: &Progress) -> Result<SceneReport, Failure> {
        let knobs = knobs();
        let settings = distinct(&knobs);
        let mut configurations = settings
            .iter()
            .map(|settings| {
                let configuration = self.measure(settings);
                progress.advance(1);
                configuration
            })
            .collect::<Result<Vec<_>, _>>()?;
        judge(&mut configurations);
        let index_of = |wanted: &Settings| settings.iter().position(|settings| settings == wanted);
        let lines = knobs
            .iter()
            .map(|knob| Line {
                knob: knob.name,
                points: knob
                    .steps
                    .iter()
                    .filter_map(|step| Some((step.label.clone(), index_of(&step.settings)?)))
                    .collect(),
            })
            .collect();
        Ok(SceneReport {
            name,
            size: self.resolution,
            left_out_of_reference: self.left_out(),
            knobs: lines,
            configurations,
            reference: image(self.resolution, &self.references.r2.to_rgb888()),
        })
    }

    /// Draws with some settings, and measures.
    ///
    /// # Errors
    ///
    /// [`Failure`].
    pub(crate) fn measure(&self, settings: &Settings) -> Result<Configuration, Failure> {
        let single = self.scene.single(settings.power);
        let double = self.scene.double(settings.power);
        let (drawn, work, host_time) = match settings.scalar {
            ScalarName::F32 => self.draw(single, settings)?,
            ScalarName::F64 => self.draw(double, settings)?,
        };
        let exact = self.tracer(double, settings)?;
        let exact = exact.colors(settings.sampling, self.workers);
        let exact = Linear::new(self.resolution, &exact);
        let r1 = self.references.r1(settings.sampling, self.workers);
        let on_display = self.on_display(&drawn.shown);
        let errors = Errors::split(&Steps {
            shown: &on_display,
            linear: &drawn.linear,
            exact: &exact,
            r1: &r1,
            r2: &self.references.r2,
        });
        let reference = image(self.resolution, &self.references.r2.to_rgb888());
        let shown = image(self.resolution, &drawn.shown);
        let flip = Comparison::of(&reference, &shown, DEFAULT_PIXELS_PER_DEGREE).flip();
        let instructions = (settings.scalar == ScalarName::F32)
            .then(|| MODEL.instructions_per_pixel(&work))
            .flatten();
        Ok(Configuration {
            name: settings.to_string(),
            settings: *settings,
            errors,
            flip,
            work: PerPixel::of(&work),
            host_time,
            instructions,
            verdict: match instructions {
                Some(_) => Verdict::Best,
                None => Verdict::NotForDevices,
            },
            shown,
        })
    }

    /// What settings in `f32` take and how wrong their picture is, and nothing else.
    ///
    /// # Errors
    ///
    /// [`Failure`].
    pub(crate) fn estimate(&self, settings: &Settings, core: Core) -> Result<Estimate, Failure> {
        let tracer = self.tracer(self.scene.single(settings.power), settings)?;
        let work = tracer.work(settings.sampling, self.workers);
        let instructions = MODEL
            .instructions_per_pixel(&work)
            .ok_or_else(no_prediction)?;
        let colors = tracer.colors(settings.sampling, self.workers);
        let on_display = self.on_display(&self.shown(&colors, settings));
        Ok(Estimate {
            instructions: instructions[core as usize] * work.pixels as f64,
            rmse: Error::between(&on_display, &self.references.r2).rmse,
            work,
        })
    }

    /// What the display shows, in 8 bits a channel.
    fn shown<T: Scalar>(&self, colors: &[Color<T>], settings: &Settings) -> Vec<[u8; 3]> {
        with_color!(settings.color, C => if settings.dither {
            shown::<T, Dithered<C>>(colors, self.resolution)
        } else {
            shown::<T, Exact<C>>(colors, self.resolution)
        })
    }

    /// The same in numbers.
    fn on_display(&self, shown: &[[u8; 3]]) -> Linear {
        let channels = |pixel: &[u8; 3]| pixel.map(|channel| f64::from(channel) / 255.0);
        Linear {
            resolution: self.resolution,
            pixels: shown.iter().map(channels).collect(),
        }
    }

    fn tracer<'s, T: Scalar>(
        &self,
        scene: Scene<'s, T>,
        settings: &Settings,
    ) -> Result<ReportTracer<'s, T>, Failure> {
        let cutoff = settings.cutoff.map_or(0.0, |of| 1.0 / f64::from(of));
        ReportTracer::new(scene, self.resolution, settings.max_depth, cutoff)
    }

    /// The picture, what it takes, and how long.
    fn draw<T: Scalar>(
        &self,
        scene: Scene<'_, T>,
        settings: &Settings,
    ) -> Result<(Drawn, Work, HostTime), Failure> {
        let tracer = self.tracer(scene, settings)?;
        let colors = tracer.colors(settings.sampling, self.workers);
        let shown = self.shown(&colors, settings);
        let drawn = Drawn {
            linear: Linear::new(self.resolution, &colors),
            shown,
        };
        let work = tracer.work(settings.sampling, self.workers);
        Ok((drawn, work, tracer.time(settings.sampling)))
    }
}

/// The settings of all knobs without repetitions, in order.
fn distinct(knobs: &[Knob]) -> Vec<Settings> {
    let mut found: Vec<Settings> = Vec::new();
    for step in knobs.iter().flat_map(|knob| &knob.steps) {
        if !found.contains(&step.settings) {
            found.push(step.settings);
        }
    }
    found
}

fn image(resolution: Resolution, pixels: &[[u8; 3]]) -> Image {
    Image {
        width: resolution.width.into(),
        height: resolution.height.into(),
        rgb888: pixels.concat(),
    }
}

/// Finds what has failed, and what is dominated by another configuration on the same display.
fn judge(configurations: &mut [Configuration]) {
    for configuration in &mut *configurations {
        let rounding = &configuration.errors.rounding;
        if rounding.share_above_a_level > ALLOWED_SHARE {
            configuration.verdict = Verdict::Failed(format!(
                "rounding puts {:.1} % of the pixels more than a level off, {:.0} % are allowed",
                100.0 * rounding.share_above_a_level,
                100.0 * ALLOWED_SHARE
            ));
        }
    }
    let candidates: Vec<usize> = (0..configurations.len())
        .filter(|i| configurations[*i].verdict == Verdict::Best)
        .collect();
    let cost = Cost::Instructions(Core::M4f);
    for i in &candidates {
        let display = configurations[*i].settings;
        let group: Vec<usize> = candidates
            .iter()
            .copied()
            .filter(|other| configurations[*other].settings.same_display(&display))
            .collect();
        let points: Vec<Point> = group
            .iter()
            .map(|other| Point {
                cost: cost.of(&configurations[*other]).unwrap_or(f64::INFINITY),
                error: Measure::Total.of(&configurations[*other]),
            })
            .collect();
        let place = group.iter().position(|other| other == i);
        let dominator = place.and_then(|place| dominators(&points)[place]);
        if let Some(dominator) = dominator {
            configurations[*i].verdict = Verdict::DominatedBy(group[dominator]);
        }
    }
}
