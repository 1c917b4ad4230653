//! scanray: a fixed-function Whitted ray tracer for microcontroller displays.
#![no_std]
#![deny(unsafe_code)]

#[cfg(test)]
extern crate std;

// The order is that of the layers: a file may use those above it, never those below.
mod background;
mod camera;
mod color;
mod light;
mod material;
#[cfg(feature = "parser")]
mod parser;
mod ray;
mod render;
mod scalar;
mod scene;
pub mod shape;
mod tracer;
mod vec3;
mod visibility;

pub use background::Background;
pub use camera::{Camera, Resolution};
pub use color::Color;
pub use light::Light;
pub use material::{Interface, Material, MaterialDescription};
#[cfg(feature = "parser")]
pub use parser::{Excerpt, Expected, Found, FromDecimal, ParseError, Range, Report};
pub use ray::{ObjectNumber, Ray, Side, origin_offset};
pub use render::{
    Budget, DisplayColor, Dithered, Exact, Frame, Picture, PixelSource, Progress, Quantizer,
    ThroughRgb888,
};
pub use scalar::Scalar;
pub use scene::{
    Needs, Object, ObjectSet, Pool, PoolUse, PoolsMut, Reach, Scene, SceneError, ScenePools,
};
pub use tracer::{
    DEFAULT_MAX_DEPTH, DepthError, MissingStages, Nearest, Observer, RayCount, RayKind, Scanline,
    TestKind, Tracer, WorkCount,
};
pub use vec3::Vec3;
