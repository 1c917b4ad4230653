//! Must not compile: the scene needs stages that are left out, and the error says which.

#![no_std]
#![no_main]

use scanray::{Scene, Stages, tracer_for};

board::entry!(program);

static SCENE: Scene<'static> = include!(concat!(env!("OUT_DIR"), "/scene.rs"));

fn program() -> Result<(), &'static str> {
    let _ = tracer_for!(SCENE, stages = SCENE.stages().without(Stages::REFRACTION));
    Ok(())
}
