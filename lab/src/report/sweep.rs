//! Measures every setting of every knob.

use scanray::{
    Color, Resolution, Scalar, Scene,
    render::{Dithered, Exact},
};
use scanray_stability::textbook::{Effort, Textbook};

use super::document::{Configuration, Cost, Line, Measure, PerPixel, SceneReport, Verdict};
use super::errors::{Error, Errors, Steps};
use super::linear::{Linear, in_greys, shown};
use super::pareto::{Point, Standing, standings};
use super::references::{LeftOut, References};
use super::scenes::BothScalars;
use super::settings::{Formulas, Knob, Settings, knobs};
use super::timing::HostTime;
use super::tracing::ReportTracer;
use super::tune;
use crate::cost::{Core, MODEL, Work};
use scanray_host::compare::{Comparison, DEFAULT_PIXELS_PER_DEGREE};
use scanray_host::failure::Failure;
use scanray_host::image::Image;
use scanray_host::option_values::{ScalarName, with_color};
use scanray_host::parallel_drawing::Workers;
use scanray_host::progress::Progress;

/// A share of pixels that rounding alone may put more than one level off: those on edges.
const ALLOWED_SHARE: f64 = 0.01;

/// The measuring of a scene.
pub(crate) struct Sweep<'a> {
    scene: &'a BothScalars,
    resolution: Resolution,
    references: References<'a>,
    workers: &'a Workers,
}

/// A picture of some settings before quantisation and as it is shown, and what it takes.
struct Drawn {
    linear: Linear,
    shown: Vec<[u8; 3]>,
    per_pixel: PerPixel,
    /// None of formulas that are not the core's.
    work: Option<Work>,
    host_time: HostTime,
}

/// What settings take and how wrong their picture is.
pub(crate) struct Estimate {
    pub(crate) work: Work,
    /// Of a picture, by [`Core::ALL`].
    pub(crate) instructions: [f64; Core::ALL.len()],
    /// Of what is shown, against R2: FLIP where it is dithered, else the root of the mean square in levels of 255.
    pub(crate) error: f64,
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

    /// Whether pictures can be of a size.
    ///
    /// # Errors
    ///
    /// [`Failure::Usage`] for one that is too large for the references.
    pub(crate) fn check(resolution: Resolution) -> Result<(), Failure> {
        super::references::enlarged(resolution).map(drop)
    }

    /// How many steps [`Sweep::run`] takes at least.
    pub(crate) fn steps() -> u64 {
        distinct(&knobs()).len() as u64 + tune::steps()
    }

    /// Turns all knobs, and measures combinations too: those of [`choices`](super::tune::choices) on each core.
    ///
    /// # Errors
    ///
    /// [`Failure`].
    pub(crate) fn run(&self, name: String, progress: &Progress) -> Result<SceneReport, Failure> {
        let mut knobs = knobs();
        let known = distinct(&knobs).len();
        for (core, choices) in Core::ALL.into_iter().zip(tune::choices(self, progress)?) {
            knobs.push(Knob {
                name: "tune's choices",
                core: Some(core),
                steps: choices,
            });
        }
        let settings = distinct(&knobs);
        progress.expect((settings.len() - known) as u64);
        let configurations = settings
            .iter()
            .map(|settings| {
                let configuration = self.measure(settings);
                progress.advance(1);
                configuration
            })
            .collect::<Result<Vec<_>, _>>()?;
        let index_of = |wanted: &Settings| settings.iter().position(|settings| settings == wanted);
        let lines = knobs
            .iter()
            .map(|knob| Line {
                knob: knob.name,
                core: knob.core,
                points: knob
                    .steps
                    .iter()
                    .filter_map(|step| Some((step.label.clone(), index_of(&step.settings)?)))
                    .collect(),
            })
            .collect();
        Ok(SceneReport {
            slug: slug(&name),
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
        let drawn = match settings.scalar {
            ScalarName::F32 => self.draw(single, settings)?,
            ScalarName::F64 => self.draw(double, settings)?,
        };
        let exact = self.tracer(double, settings)?;
        let exact = exact.colors(settings.sampling, settings.preview, self.workers);
        let exact = Linear::new(self.resolution, &exact);
        let r1 = self
            .references
            .r1(settings.sampling, settings.preview, self.workers);
        // A grey display is compared with what it would show if it had all greys.
        let r2 = self.references.r2_in(settings.color);
        let on_display = self.on_display(&drawn.shown);
        let errors = Errors::split(&Steps {
            shown: &on_display,
            linear: &in_greys(drawn.linear, settings.color),
            exact: &in_greys(exact, settings.color),
            r1: &in_greys(Linear::clone(&r1), settings.color),
            r2,
        });
        let reference = image(self.resolution, &r2.to_rgb888());
        let shown = image(self.resolution, &drawn.shown);
        let flip = Comparison::of(&reference, &shown, DEFAULT_PIXELS_PER_DEGREE).flip();
        let predicted = drawn.work.filter(|_| settings.is_for_devices());
        Ok(Configuration {
            name: settings.to_string(),
            settings: *settings,
            errors,
            flip,
            work: drawn.per_pixel,
            host_time: drawn.host_time,
            predicted: predicted.map(|work| MODEL.instructions_per_pixel(&work)),
            counted: [None; 3],
            verdict: Verdict::NotForDevices,
            shown,
        })
    }

    /// What settings for devices take and how wrong their picture is, and nothing else.
    ///
    /// # Errors
    ///
    /// [`Failure`].
    pub(crate) fn estimate(&self, settings: &Settings) -> Result<Estimate, Failure> {
        let tracer = self.tracer(self.scene.single(settings.power), settings)?;
        let work = tracer.work(settings.sampling, settings.preview, self.workers);
        let colors = tracer.colors(settings.sampling, settings.preview, self.workers);
        let r2 = self.references.r2_in(settings.color);
        let shown = self.shown(&colors, settings);
        let error = if settings.dither {
            // The root of the mean square punishes the pattern, which the eye averages.
            let [reference, shown] =
                [&r2.to_rgb888(), &shown].map(|pixels| image(self.resolution, pixels));
            Comparison::of(&reference, &shown, DEFAULT_PIXELS_PER_DEGREE).flip()
        } else {
            Error::between(&self.on_display(&shown), r2).rmse
        };
        Ok(Estimate {
            instructions: MODEL
                .instructions_per_pixel(&work)
                .map(|each| each * work.pixels as f64),
            error,
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
    fn draw<T: Scalar>(&self, scene: Scene<'_, T>, settings: &Settings) -> Result<Drawn, Failure> {
        let tracer = self.tracer(scene, settings)?;
        let others = match settings.formulas {
            Formulas::Robust => None,
            Formulas::FixedOffset => {
                Some(Textbook::new(scene, settings.max_depth).with_robust_shapes())
            }
            Formulas::Textbook => Some(Textbook::new(scene, settings.max_depth)),
        };
        let (colors, per_pixel, work, host_time) = match others {
            None => {
                let work = tracer.work(settings.sampling, settings.preview, self.workers);
                (
                    tracer.colors(settings.sampling, settings.preview, self.workers),
                    PerPixel::of(&work),
                    Some(work),
                    tracer.time(settings.sampling, settings.preview),
                )
            }
            Some(textbook) => {
                let mut effort = Effort::default();
                let colors = tracer.primary_rays();
                let colors: Vec<_> = colors
                    .iter()
                    .map(|ray| textbook.radiance_counted(ray, &mut effort))
                    .collect();
                let pixels = colors.len().max(1) as f64;
                let per_pixel = PerPixel {
                    rays: effort.rays as f64 / pixels,
                    tests: effort.tests as f64 / pixels,
                };
                let time = HostTime::measure(&|| {
                    for ray in tracer.primary_rays() {
                        std::hint::black_box(textbook.radiance(&ray));
                    }
                });
                (colors, per_pixel, None, time)
            }
        };
        Ok(Drawn {
            linear: Linear::new(self.resolution, &colors),
            shown: self.shown(&colors, settings),
            per_pixel,
            work,
            host_time,
        })
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

/// The part of a file's name and of an anchor that stands for a name.
pub(crate) fn slug(name: &str) -> String {
    let plain = |c: char| {
        if c.is_ascii_alphanumeric() {
            c.to_ascii_lowercase()
        } else {
            '-'
        }
    };
    name.chars().map(plain).collect()
}

/// Finds what has failed, what is on the Pareto front, and what is dominated by or equal to another configuration on the
/// same display.
pub(crate) fn judge(configurations: &mut [Configuration]) {
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
    let (cost, measure) = (Cost::Instructions(Core::M4f), Measure::Total);
    let point = |configuration: &Configuration| {
        let cost = cost.of(configuration)?;
        let error = measure.of(configuration);
        Some(Point { cost, error })
    };
    let is_default = |c: &Configuration| c.settings == Settings::DEFAULT;
    let default = configurations.iter().position(is_default);
    let default = default.and_then(|index| Some((index, point(&configurations[index])?)));
    let standings = front(configurations, cost, measure);
    for (index, standing) in standings.into_iter().enumerate() {
        let configuration = &configurations[index];
        // What changes nothing is told, even where both are dominated.
        let as_default = default.filter(|(other, of_default)| {
            *other != index
                && configuration.settings.same_display(&Settings::DEFAULT)
                && point(configuration).is_some_and(|own| own.equals(of_default))
        });
        configurations[index].verdict = match (standing, as_default) {
            (None, _) => continue,
            (Some(_), Some((default, _))) => Verdict::EqualTo(default),
            (Some(Standing::OnFront), None) => Verdict::Best,
            (Some(Standing::EqualTo(other)), None) => Verdict::EqualTo(other),
            (Some(Standing::DominatedBy(other)), None) => Verdict::DominatedBy(other),
        };
    }
}

/// How each configuration stands among those on the same display; `None` for those that have failed or whose cost is
/// not known.
pub(crate) fn front(
    configurations: &[Configuration],
    cost: Cost,
    measure: Measure,
) -> Vec<Option<Standing>> {
    let point = |configuration: &Configuration| {
        let has_failed = matches!(configuration.verdict, Verdict::Failed(_));
        let cost = cost.of(configuration).filter(|_| !has_failed)?;
        Some(Point {
            cost,
            error: measure.of(configuration),
        })
    };
    let points: Vec<Option<Point>> = configurations.iter().map(point).collect();
    let mut found = vec![None; configurations.len()];
    for i in 0..configurations.len() {
        if points[i].is_none() || found[i].is_some() {
            continue;
        }
        let display = &configurations[i].settings;
        // The default first: of equals it stands for all.
        let mut group: Vec<usize> = (0..configurations.len())
            .filter(|other| {
                points[*other].is_some() && configurations[*other].settings.same_display(display)
            })
            .collect();
        group.sort_by_key(|other| configurations[*other].settings != Settings::DEFAULT);
        let of_group: Vec<Point> = group.iter().filter_map(|other| points[*other]).collect();
        for (other, standing) in group.iter().zip(standings(&of_group)) {
            found[*other] = Some(match standing {
                Standing::OnFront => Standing::OnFront,
                Standing::EqualTo(place) => Standing::EqualTo(group[place]),
                Standing::DominatedBy(place) => Standing::DominatedBy(group[place]),
            });
        }
    }
    found
}
