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
//! A pixel is a pure function of scene, settings and coordinates. Rows, bands, pictures, [`Frame`](render::Frame)s that
//! stop after a budget of rays, a second core: all are only schedules over that function and give the
//! same bits, on every machine: only `+ − × ÷ √` of IEEE 754 are used, in source order, never fused, and
//! software functions of this crate and of libm.
//!
//! # What a scene does not need
//!
//! [`Scene::stages`] is a constant function; [`tracer_for!`] compiles only the stages that a
//! `static` scene needs. At run time objects that a ray cannot hit are not tested, with the same bits: in a
//! small scene by lists of candidates, in a large one by a bounding-volume hierarchy ([`Bvh`](accel::Bvh)), which is
//! baked into flash or built in the pools if they have room for it.
//!
//! # More or less
//!
//! [`Tracer::with_cutoff`] leaves out rays that hardly show, with a bound on what is lost. [`Supersampled`](render::Supersampled) and
//! [`Adaptive`](render::Adaptive) sample pixels more than once, everywhere or at edges. [`Progressive`](render::Progressive) shows blocks first and
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
//! to the display's levels. [`picture`] fixes all of it, and where it goes beyond the paper it implements, or leaves it.
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

// What all of it draws: documentation alone.
pub mod picture;

// The modules stand in the order of their layers: a file may use those above it, never those below.

// Numbers, vectors, colours.
mod soft_float;

pub mod number;

pub mod scalar;

pub mod vec3;

pub mod color;

pub mod real;

pub mod formula;

pub mod stages;

// Geometry.
pub mod ray;

pub mod shape;

// What else a scene has.
pub mod material;

pub mod light;

pub mod camera;

pub mod background;

// What is known of a scene before the first ray.
pub mod accel;

pub mod scene;

#[macro_use]
pub mod pools;

// Scenes from text, to text and to Rust source.
#[cfg(feature = "parser")]
pub mod parser;

#[cfg(feature = "bake")]
mod bake;

#[cfg(feature = "print")]
pub mod print;

// From ray to colour, from colour to display.
pub mod tracer;

pub mod render;

pub use background::Background;
#[cfg(feature = "bake")]
pub use bake::bake;
pub use camera::{Camera, Resolution};
pub use color::Color;
pub use light::Light;
pub use material::{Material, MaterialDescription};
#[cfg(feature = "parser")]
pub use parser::ParseError;
pub use pools::{SceneError, ScenePools};
#[cfg(feature = "print")]
pub use print::print;
pub use ray::Ray;
pub use render::Picture;
pub use scalar::Scalar;
pub use scene::Scene;
pub use stages::Stages;
pub use tracer::{DEFAULT_MAX_DEPTH, Tracer};
pub use vec3::Vec3;
