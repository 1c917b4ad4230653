//! The tree of rays for programs.

use scanray::{
    Color, Ray, Scalar,
    ray::ObjectNumber,
    tracer::{LightAtHit, RayKind},
};
use serde::Serialize;

use super::text::Names;
use super::{HitNode, LightNode, RayNode};
use crate::json_numbers::{Number, Triple, color, number, vector};
use crate::knobs::Knobs;

/// A pixel, its colours and its rays.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct PixelReport {
    scene: String,
    width: u16,
    height: u16,
    x: u16,
    y: u16,
    /// Column and row of the pixel whose rays are told.
    traced: [u16; 2],
    #[serde(flatten)]
    samples: Samples,
    scalar: &'static str,
    max_depth: usize,
    /// The colour before quantisation.
    linear: Triple,
    /// What the display shows, as 8-bit values.
    shown: [u8; 3],
    color: String,
    dither: bool,
    /// The rays from the camera.
    rays: Vec<RayReport>,
}

#[derive(Clone, Debug, Serialize)]
struct RayReport {
    kind: &'static str,
    depth: usize,
    weight: Number,
    origin: Triple,
    direction: Triple,
    /// Null for the background.
    hit: Option<HitReport>,
    result: Triple,
}

#[derive(Clone, Debug, Serialize)]
struct HitReport {
    #[serde(flatten)]
    object: ObjectReport,
    front: bool,
    t: Number,
    point: Triple,
    normal: Triple,
    ambient: Triple,
    lights: Vec<LightReport>,
    local: Triple,
    rays: Vec<RayReport>,
    /// Rays that the material asks for and that were not cast, and why.
    not_cast: Vec<NotCast>,
}

#[derive(Clone, Debug, Serialize)]
struct ObjectReport {
    /// Its shape.
    object: &'static str,
    /// Its place among the objects of the file, from 0.
    number: ObjectNumber,
    /// Its line in the file, from 1.
    line: Option<u32>,
}

#[derive(Clone, Debug, Serialize)]
struct LightReport {
    outcome: &'static str,
    blocker: Option<ObjectReport>,
    shadow_ray: Option<ShadowRay>,
    diffuse: Option<Triple>,
    specular: Option<Triple>,
}

#[derive(Clone, Debug, Serialize)]
struct ShadowRay {
    origin: Triple,
    direction: Triple,
}

#[derive(Clone, Debug, Serialize)]
struct NotCast {
    kind: &'static str,
    why: &'static str,
}

/// Where a pixel is and what it looks like.
#[derive(Clone, Debug)]
pub(crate) struct PixelHeader<T> {
    pub(crate) size: scanray::Resolution,
    pub(crate) place: [u16; 2],
    /// The pixel whose rays are told: another one where a coarse picture repeats it.
    pub(crate) traced: [u16; 2],
    pub(crate) samples: Samples,
    pub(crate) linear: Color<T>,
    pub(crate) shown: [u8; 3],
    pub(crate) color: String,
    pub(crate) dither: bool,
}

/// What a pixel's rays from the camera are, in their order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(tag = "rays_are", rename_all = "kebab-case")]
pub(crate) enum Samples {
    /// One sample, whose colour is the pixel's.
    One,
    /// So many samples, whose mean is the pixel's colour.
    Mean { of: usize },
    /// The centre, which differs from no neighbour: its colour is the pixel's.
    CentreAlone,
    /// The centre, which differs from a neighbour, and so many samples, whose mean is the pixel's colour.
    Edge { of: usize },
}

impl Samples {
    /// What so many rays are.
    pub(crate) fn of(knobs: &Knobs, rays: usize) -> Self {
        let of = knobs.samples.pattern().len();
        match (knobs.edges, rays) {
            (None, 1) => Self::One,
            (None, _) => Self::Mean { of },
            (Some(_), 1) => Self::CentreAlone,
            (Some(_), _) => Self::Edge { of },
        }
    }
}

impl PixelReport {
    /// What is told of a pixel and its rays.
    pub(crate) fn new<T: Scalar>(
        header: &PixelHeader<T>,
        rays: &[RayNode<T>],
        names: &Names<'_, T>,
    ) -> Self {
        Self {
            scene: names.file.to_owned(),
            width: header.size.width,
            height: header.size.height,
            x: header.place[0],
            y: header.place[1],
            traced: header.traced,
            samples: header.samples,
            scalar: T::NAME,
            max_depth: names.max_depth,
            linear: color(header.linear),
            shown: header.shown,
            color: header.color.clone(),
            dither: header.dither,
            rays: rays.iter().map(|ray| RayReport::new(ray, names)).collect(),
        }
    }
}

impl RayReport {
    fn new<T: Scalar>(node: &RayNode<T>, names: &Names<'_, T>) -> Self {
        Self {
            kind: kind(node.kind),
            depth: node.depth,
            weight: number(node.weight),
            origin: vector(node.ray.origin),
            direction: vector(node.ray.direction),
            hit: node
                .hit
                .as_ref()
                .map(|hit| HitReport::new(node, hit, names)),
            result: color(node.result),
        }
    }
}

impl HitReport {
    fn new<T: Scalar>(node: &RayNode<T>, hit: &HitNode<T>, names: &Names<'_, T>) -> Self {
        let secondary = [RayKind::Reflected, RayKind::Refracted];
        let not_cast = secondary.into_iter().filter_map(|missing| {
            let why = node.why_not(missing, names.max_depth)?;
            Some(NotCast {
                kind: kind(missing),
                why,
            })
        });
        Self {
            object: ObjectReport::new(hit.object, names),
            front: hit.front,
            t: number(hit.t),
            point: vector(hit.point),
            normal: vector(hit.normal),
            ambient: color(hit.material.ambient * names.scene.ambient()),
            lights: hit
                .lights
                .iter()
                .map(|light| LightReport::new(light, names))
                .collect(),
            local: color(hit.local),
            rays: hit
                .secondary
                .iter()
                .map(|ray| RayReport::new(ray, names))
                .collect(),
            not_cast: not_cast.collect(),
        }
    }
}

impl ObjectReport {
    fn new<T: Scalar>(number: ObjectNumber, names: &Names<'_, T>) -> Self {
        Self {
            object: names.kind(number),
            number,
            line: names.line(number),
        }
    }
}

impl LightReport {
    fn new<T: Scalar>(light: &LightNode<T>, names: &Names<'_, T>) -> Self {
        let (outcome, diffuse, specular) = match light.at_hit {
            LightAtHit::Behind => ("behind", None, None),
            LightAtHit::Enclosed => ("enclosed", None, None),
            LightAtHit::Blocked => ("blocked", None, None),
            LightAtHit::Reaches { diffuse, specular } => ("reaches", Some(diffuse), specular),
        };
        let shadow_ray = |ray: Ray<T>| ShadowRay {
            origin: vector(ray.origin),
            direction: vector(ray.direction),
        };
        Self {
            outcome,
            blocker: light.blocker.map(|object| ObjectReport::new(object, names)),
            shadow_ray: light.shadow_ray.map(shadow_ray),
            diffuse: diffuse.map(color),
            specular: specular.map(color),
        }
    }
}

fn kind(kind: RayKind) -> &'static str {
    match kind {
        RayKind::Primary => "primary",
        RayKind::Reflected => "reflected",
        RayKind::Refracted => "refracted",
        RayKind::Shadow => "shadow",
    }
}
