//! What is measured of a case.

use embedded_graphics::pixelcolor::Rgb888;
use scanray::{
    Color, Ray, Scalar, Tracer, Vec3,
    render::DisplayColor,
    shape::Object,
    tracer::{Observer, RayCount, RayKind},
};
use serde::Serialize;

use crate::Number;
use crate::quick_reject::ClearMisses;
use crate::random::Random;
use crate::scenes::Model;
use crate::settled::{View, level_distance, levels, settled_through};
use crate::textbook::Textbook;

/// How much work a measurement may take.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Effort {
    /// Small pictures of the scenes: for tests.
    Quick,
    /// The scenes at 800×600.
    Full,
}

/// What a figure is.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Quantity {
    /// A number of things that are wrong.
    Count,
    /// A share of things that are wrong, in 0…1.
    Share,
    /// An error.
    Error,
}

/// A figure, and what it may be at most.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Finding {
    /// What was measured, in words.
    pub what: String,
    /// What the figure is.
    pub quantity: Quantity,
    /// The figure.
    pub measured: f64,
    /// What it may be at most; nothing for a figure that only informs.
    pub bound: Option<f64>,
    /// Whether the figure keeps to its bound.
    pub pass: bool,
    /// How many things were looked at.
    pub of: u64,
    /// The seed of the random numbers, if there are any.
    pub seed: Option<u64>,
    /// The same figure for the textbook's form.
    pub textbook: Option<f64>,
}

/// How close a picture is to come to that of `f64`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Tier {
    /// At most 1 level off, and that on at most 0.02 % of the settled pixels.
    A,
    /// At most 0.1 % of the settled pixels more than 1 level off.
    B,
    /// No bound.
    C,
}

/// The findings of a case as they are made.
#[derive(Debug)]
pub struct Record {
    effort: Effort,
    findings: Vec<Finding>,
    seed: Option<u64>,
    /// Statements that hold.
    statements: u64,
    /// Pixels drawn, and those of them that are no colours or took too many rays.
    drawn: u64,
    broken: u64,
    /// Pixels drawn with a cut-off, too, and those of them that lose more than a level of 8 bits.
    cut: u64,
    cut_too_far: u64,
}

/// A picture's linear colours, row by row.
pub(super) type Colors<T> = Vec<Color<T>>;

/// What is watched of a pixel.
#[derive(Default)]
struct Watch {
    rays: RayCount,
    misses: ClearMisses,
}

impl<T: Scalar> Observer<T> for Watch {
    fn ray(&mut self, kind: RayKind, depth: usize, ray: &Ray<T>) {
        self.rays.ray(kind, depth, ray);
    }

    fn test_object(&mut self, object: Object<'_, T>, ray: &Ray<T>, t_max: T) {
        self.misses.test_object(object, ray, t_max);
    }
}

impl Record {
    pub(super) fn new(effort: Effort) -> Self {
        Self {
            effort,
            findings: Vec::new(),
            seed: None,
            statements: 0,
            drawn: 0,
            broken: 0,
            cut: 0,
            cut_too_far: 0,
        }
    }

    pub(super) fn into_findings(mut self) -> Vec<Finding> {
        if self.statements > 0 {
            self.seed = None;
            self.count("statements that do not hold", 0, self.statements);
        }
        if self.drawn > 0 {
            self.seed = None;
            self.count(
                "pixels that are no colour or took too many rays",
                self.broken,
                self.drawn,
            );
        }
        if self.cut > 0 {
            self.count(
                "pixels that lose more than a level to the cut-off of 8 bits",
                self.cut_too_far,
                self.cut,
            );
        }
        self.findings
    }

    pub(super) fn effort(&self) -> Effort {
        self.effort
    }

    /// Random numbers for what is measured next.
    pub(super) fn random(&mut self, default_seed: u64) -> Random {
        let seed = Random::seed(default_seed);
        self.seed = Some(seed);
        Random::seeded(seed)
    }

    fn add(
        &mut self,
        what: impl Into<String>,
        quantity: Quantity,
        measured: f64,
        bound: Option<f64>,
        of: u64,
    ) {
        self.findings.push(Finding {
            what: what.into(),
            quantity,
            measured,
            bound,
            // NaN keeps to no bound.
            pass: bound.is_none_or(|bound| measured <= bound),
            of,
            seed: self.seed,
            textbook: None,
        });
    }

    /// A number of wrong answers, of which none may be.
    pub(super) fn count(&mut self, what: impl Into<String>, wrong: u64, of: u64) {
        assert!(of > 0, "nothing was looked at");
        self.add(what, Quantity::Count, wrong as f64, Some(0.0), of);
    }

    /// A number of wrong answers in one of several places, of which none may be: one figure for all places but
    /// those where something is wrong.
    pub(super) fn count_in(&mut self, place: &str, what: &str, wrong: u64, of: u64) {
        if wrong > 0 {
            self.count(format!("{place}: {what}"), wrong, of);
            return;
        }
        let same = |finding: &&mut Finding| finding.what == what;
        match self.findings.iter_mut().find(same) {
            Some(finding) => finding.of += of,
            None => self.count(what, wrong, of),
        }
    }

    /// Whether something holds: a finding if it does not, and a number of all that do.
    pub(super) fn holds(&mut self, what: impl Into<String>, holds: bool) {
        if holds {
            self.statements += 1;
        } else {
            self.count(what, 1, 1);
        }
    }

    /// A share of wrong answers.
    pub(super) fn share(&mut self, what: impl Into<String>, wrong: u64, of: u64, bound: f64) {
        self.add(
            what,
            Quantity::Share,
            wrong as f64 / of as f64,
            Some(bound),
            of,
        );
    }

    /// A share without a bound.
    pub(super) fn informative_share(&mut self, what: impl Into<String>, wrong: u64, of: u64) {
        self.add(what, Quantity::Share, wrong as f64 / of as f64, None, of);
    }

    /// The largest error of several.
    pub(super) fn error(&mut self, what: impl Into<String>, worst: f64, bound: f64, of: u64) {
        assert!(of > 0, "nothing was looked at");
        self.add(what, Quantity::Error, worst, Some(bound), of);
    }

    /// The last figure, for the textbook's form: how many of the same number of things.
    pub(super) fn textbook_share(&mut self, wrong: u64) {
        if let Some(last) = self.findings.last_mut() {
            last.textbook = Some(match last.quantity {
                Quantity::Count => wrong as f64,
                _ => wrong as f64 / last.of as f64,
            });
        }
    }

    /// The colours of a tracer's picture; what must hold of every pixel is looked after.
    pub(super) fn draw<T: Scalar, const STAGES: u64, const STACK: usize>(
        &mut self,
        tracer: &Tracer<'_, T, STAGES, STACK>,
    ) -> Colors<T> {
        let size = tracer.resolution();
        let mut colors = Vec::new();
        for y in 0..size.height {
            let scanline = tracer.scanline(y);
            for x in 0..size.width {
                let mut rays = Watch::default();
                let color = tracer.pixel_observed(&scanline, x, &mut rays);
                self.watch(tracer, color, rays);
                self.cut_off(tracer, tracer.primary_ray(&scanline, x), color);
                colors.push(color);
            }
        }
        colors
    }

    /// The colour that a ray sees, looked after.
    pub(super) fn see<T: Scalar, const STAGES: u64, const STACK: usize>(
        &mut self,
        tracer: &Tracer<'_, T, STAGES, STACK>,
        ray: Ray<T>,
    ) -> Color<T> {
        let mut rays = Watch::default();
        let color = tracer.radiance_observed(ray, scanray::accel::ObjectSet::ALL, &mut rays);
        self.watch(tracer, color, rays);
        self.cut_off(tracer, ray, color);
        color
    }

    /// A pixel, looked after and watched by somebody else, too.
    pub(super) fn pixel_watched<T: Scalar, const STAGES: u64, const STACK: usize>(
        &mut self,
        tracer: &Tracer<'_, T, STAGES, STACK>,
        (x, y): (u16, u16),
        observer: &mut impl Observer<T>,
    ) -> Color<T> {
        let color = tracer.pixel_observed(&tracer.scanline(y), x, observer);
        self.watch(tracer, color, Watch::default());
        color
    }

    fn watch<T: Scalar, const STAGES: u64, const STACK: usize>(
        &mut self,
        tracer: &Tracer<'_, T, STAGES, STACK>,
        color: Color<T>,
        rays: Watch,
    ) {
        let is_color = color.is_finite() && color == color.clamp();
        let is_bounded = u64::from(rays.rays.0) <= tracer.max_rays_per_pixel();
        self.drawn += 1;
        self.broken += u64::from(!(is_color && is_bounded));
    }

    /// Traces a ray without the rays that hardly show: it sees no more than this colour, and at most one
    /// level of 8 bits less.
    fn cut_off<T: Scalar, const STAGES: u64, const STACK: usize>(
        &mut self,
        tracer: &Tracer<'_, T, STAGES, STACK>,
        ray: Ray<T>,
        color: Color<T>,
    ) {
        let cut = Tracer::new(*tracer.scene()).with_stack::<STACK>();
        let cut = cut.with_max_depth(tracer.max_depth()).unwrap_or(cut);
        let cut = cut.with_cutoff(T::from_f64(Rgb888::LEVEL.into()));
        let [whole, cut] = [color, cut.radiance(ray)].map(levels);
        let keeps_to_it =
            |(whole, cut): (u8, u8)| whole.checked_sub(cut).is_some_and(|loss| loss <= 1);
        self.cut += 1;
        self.cut_too_far += u64::from(!whole.into_iter().zip(cut).all(keeps_to_it));
    }

    /// Draws a model in `T`, and compares the settled pixels with those of the model in `f64`. The model is
    /// given in `f64` and rounded to `T`, as a scene file is.
    pub(super) fn tier<T: Number, const DEPTH: usize>(
        &mut self,
        model: &Model<f64>,
        half_height: f64,
        tier: Tier,
        what: &str,
    ) {
        let (own_pools, exact_pools) = (model.rounded::<T>().build(), model.build());
        let own = Tracer::new(own_pools.as_scene()).with_stack::<DEPTH>();
        let own = own.with_max_depth(DEPTH).unwrap_or(own);
        let exact = Tracer::new(exact_pools.as_scene()).with_stack::<DEPTH>();
        let exact = exact.with_max_depth(DEPTH).unwrap_or(exact);
        let own_view = View {
            half_height,
            ..View::of(&own)
        };
        let exact_view = View {
            half_height,
            ..View::of(&exact)
        };
        let own_textbook = Textbook::new(own_pools.as_scene(), DEPTH);
        let size = own.resolution();
        let mut counts = Counts::default();
        for y in 0..size.height {
            for x in 0..size.width {
                let actual = if half_height == 1.0 {
                    let mut rays = Watch::default();
                    let scanline = own.scanline(y);
                    let color = own.pixel_observed(&scanline, x, &mut rays);
                    self.watch(&own, color, rays);
                    self.cut_off(&own, own.primary_ray(&scanline, x), color);
                    color
                } else {
                    self.see(&own, own_view.ray((x, y), (0.0, 0.0)))
                };
                if T::NAME == f64::NAME {
                    continue;
                }
                let expected = settled_through(&exact, &exact_view, (x, y));
                let textbook = own_textbook.radiance(&own_view.ray((x, y), (0.0, 0.0)));
                counts.add(actual, textbook, expected);
            }
        }
        // f64 is what the others are compared with.
        if T::NAME != f64::NAME {
            self.tier_findings(&counts, tier, what);
        }
    }

    pub(super) fn tier_findings(&mut self, counts: &Counts, tier: Tier, what: &str) {
        let Counts {
            settled,
            unsettled,
            one_off,
            further_off,
            textbook_off,
        } = *counts;
        let further = format!("{what}: settled pixels more than 1 level off");
        match tier {
            Tier::A => self.count(further, further_off, settled),
            Tier::B => self.share(further, further_off, settled, 0.001),
            Tier::C => self.informative_share(further, further_off, settled),
        }
        self.textbook_share(textbook_off);
        if tier == Tier::A {
            let one = format!("{what}: settled pixels 1 level off");
            self.share(one, one_off, settled, 0.000_2);
        }
        let not_settled = format!("{what}: pixels not settled");
        let pixels = settled + unsettled;
        match tier {
            Tier::C => self.informative_share(not_settled, unsettled, pixels),
            _ => self.share(not_settled, unsettled, pixels, 0.01),
        }
    }
}

/// Pixels compared with those of `f64`.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Counts {
    pub(super) settled: u64,
    pub(super) unsettled: u64,
    pub(super) one_off: u64,
    pub(super) further_off: u64,
    pub(super) textbook_off: u64,
}

impl Counts {
    /// Counts a pixel; `expected` is its `f64` colour, if it is settled.
    pub(super) fn add<T: Scalar>(
        &mut self,
        actual: Color<T>,
        textbook: Color<T>,
        expected: Option<Color<f64>>,
    ) {
        let Some(expected) = expected else {
            self.unsettled += 1;
            return;
        };
        self.settled += 1;
        let expected = levels(expected);
        match level_distance(levels(actual), expected) {
            0 => {}
            1 => self.one_off += 1,
            _ => self.further_off += 1,
        }
        self.textbook_off += u64::from(level_distance(levels(textbook), expected) > 1);
    }

    pub(super) fn join(mut self, other: Self) -> Self {
        self.settled += other.settled;
        self.unsettled += other.unsettled;
        self.one_off += other.one_off;
        self.further_off += other.further_off;
        self.textbook_off += other.textbook_off;
        self
    }
}

/// `x`, `y`, `z`, rounded to the scalar.
pub(super) fn vector<T: Scalar>(x: f64, y: f64, z: f64) -> Vec3<T> {
    Vec3::new(T::from_f64(x), T::from_f64(y), T::from_f64(z))
}

/// A vector rounded to the scalar.
pub(super) fn rounded<T: Scalar>(v: Vec3<f64>) -> Vec3<T> {
    vector(v.x, v.y, v.z)
}

/// A vector of either scalar, widened exactly.
pub(super) fn widened<T: Scalar>(v: Vec3<T>) -> Vec3<f64> {
    Vec3::new(v.x.to_f64(), v.y.to_f64(), v.z.to_f64())
}

/// The same amount in every channel.
pub(super) fn grey<T: Scalar>(level: f64) -> Color<T> {
    let channel = T::from_f64(level);
    Color::new(channel, channel, channel)
}

/// A ray from `origin` towards `target`, rounded to the scalar.
pub(super) fn ray_to<T: Scalar>(origin: Vec3<T>, target: Vec3<f64>) -> Ray<T> {
    let exact = (target - widened(origin)).normalize();
    Ray::new(origin, rounded::<T>(exact).normalize())
}

/// The rounding unit: 2⁻²³ or 2⁻⁵².
pub(super) fn unit<T: Scalar>() -> f64 {
    T::EPSILON.to_f64()
}

/// A bound that is stated for `f32`, for the scalar: in proportion to the rounding unit.
pub(super) fn scaled<T: Scalar>(single: f64) -> f64 {
    single * unit::<T>() / unit::<f32>()
}
