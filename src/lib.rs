//! A fixed-function Whitted ray tracer for microcontroller displays: scene in, pixels out, without an
//! allocator, a frame buffer or a panic.
//!
#![doc = include_str!("../docs/default-scene.md")]
//!
//! A scene lives in static pools ([`ScenePools`], filled from text or by hand) or in flash (`bake`); a
//! [`Tracer`] gives each pixel its linear colour, and a [`Picture`] draws them, scanline by scanline, on
//! any `DrawTarget` of [embedded-graphics](embedded_graphics):
//!
//! ```
//! use embedded_graphics::{pixelcolor::Rgb565, prelude::*};
//! use scanray::{Picture, Resolution, ScenePools, Tracer};
//! # use embedded_graphics::mock_display::MockDisplay;
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! # let mut display = MockDisplay::<Rgb565>::new();
//! let mut pools: ScenePools = ScenePools::new(); // or a `static`: 16 spheres, 8 planes, 24 triangles …
//! # #[cfg(feature = "parser")]
//! pools.parse(include_bytes!("../scenes/default.txt"))?;
//! let tracer = Tracer::new(pools.as_scene()).with_resolution(Resolution { width: 64, height: 48 });
//! Picture::new(&tracer).draw(&mut display)?; // the display decides the colour; .dithered() if it has few
//! # Ok(())
//! # }
//! ```
//!
//! # One idea
//!
//! A pixel is a pure function of scene, settings and coordinates. Rows, bands, pictures, [`Frame`]s that
//! stop after a budget of rays, a second core: all are only schedules over that function and give the
//! same bits, on every machine: only `+ − × ÷ √` of IEEE 754 are used, in source order, never fused, and
//! software functions of this crate and of libm.
//!
//! # What a scene does not need
//!
//! [`Scene::needs`](Scene) is a constant function; [`tracer_for!`] compiles only the stages that a
//! `static` scene needs. At run time objects that a ray cannot meet are not tested, with the same bits: in a
//! small scene by lists of candidates, in a large one by a bounding-volume hierarchy ([`Bvh`](accel::Bvh)), which is
//! baked into flash or built in the pools if they have room for it.
//!
//! # More or less
//!
//! [`Tracer::with_cutoff`] leaves out rays that hardly show, with a bound on what is lost. [`Supersampled`] and
//! [`Adaptive`] sample pixels more than once, everywhere or at edges. [`Progressive`] shows blocks first and
//! refines them. None costs anything where it is not used, and all keep to the one idea above.
//!
//! # Memory
//!
//! The caller owns all of it. The core does not allocate and does not recurse: the tree of reflected
//! and refracted rays is walked with a stack of one frame a level, whose size is a parameter of the
//! [`Tracer`]. Deeper than compiled for is an error, not a silent clamp.
//!
//! # The picture
//!
//! Camera at its position, looking along +z with +y up; local colour by Phong with shadows; reflection
//! and refraction to a maximum depth; the colour of every ray clamped to 0…1; quantised once, straight
//! to the display's levels. Where this goes beyond the paper it implements, or leaves it:
//!
//! | subject | here |
//! |---|---|
//! | the light's "direction" | is a position |
//! | shadows | end at the light: objects beyond it cast none |
//! | shading normals | face the incoming ray: surfaces have two sides |
//! | origins of new rays | are offset by a bound derived from rounding, not by a fixed epsilon |
//! | pixels | are sampled at their centres |
//! | sky | from white at the nadir to (0.5, 0.7, 1) at the zenith |
//! | the light's line with 8 numbers | the last is used twice, with a warning |
//! | 8 bits | are rounded to, not truncated |
//! | refraction | works (the paper bypasses it) |
//! | triangle edges | belong to the triangle |
//! | a light in the hit itself, or in its surface | does not light it |
//! | the critical angle itself | refracts |
//!
//! # Features
//!
//! * `parser` (default): scene text, through nom over bytes.
//! * `bake`: scenes as Rust source, for build scripts.
//! * `print`: scenes as text again, for programs that change scenes.
#![no_std]
#![deny(unsafe_code)]

#[cfg(test)]
extern crate std;

// The README's code is compiled with the documentation's.
#[cfg(all(doctest, feature = "parser"))]
#[doc = include_str!("../README.md")]
struct Readme;

// The modules stand in the order of their layers: a file may use those above it, never those below.

// Numbers, vectors, colours.
mod soft_float;

pub mod number;

mod scalar;

mod vec3;

mod color;

pub mod real;

pub mod formula;

mod stages;

// Geometry.
mod ray;

pub mod shape;

// What else a scene has.
mod material;

mod light;

mod camera;

mod background;

// What is known of a scene before the first ray.
pub mod accel;

mod scene;

#[macro_use]
pub mod pools;

// Scenes from text, to text and to Rust source.
#[cfg(feature = "parser")]
mod parser;

#[cfg(feature = "bake")]
mod bake;

#[cfg(feature = "print")]
mod print;

// From ray to colour, from colour to display.
mod tracer;

mod render;

pub use accel::ObjectSet;
pub use background::Background;
#[cfg(feature = "bake")]
pub use bake::bake;
pub use camera::{Camera, Resolution, Subpixel};
pub use color::Color;
pub use light::Light;
pub use material::{Interface, Material, MaterialDescription};
pub use number::Number;
#[cfg(feature = "parser")]
pub use parser::{DecimalError, Excerpt, Expected, Found, FromDecimal, ParseError, Range, Report};
pub use pools::{Pool, PoolUse, PoolsMut, SceneError, ScenePools};
#[cfg(feature = "print")]
pub use print::{PrintError, print};
pub use ray::{ObjectNumber, Ray, Side};
pub use real::Real;
pub use render::{
    Adaptive, AdaptiveScanline, Budget, CenterSample, DisplayColor, Dithered, Exact, Frame,
    Picture, PixelSource, Progress, Progressive, Quantizer, SampleSource, Supersampled,
    ThroughRgb888, differ,
};
pub use scalar::Scalar;
pub use scene::Scene;
pub use shape::{Object, Shape};
pub use stages::Stages;
pub use tracer::{
    DEFAULT_MAX_DEPTH, DepthError, LightAtHit, Meeting, MissingStages, Nearest, Observer, RayCount,
    RayKind, Scanline, TestKind, Tracer, WorkCount,
};
pub use vec3::Vec3;
