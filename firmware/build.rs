//! Bakes the scene that the programs draw: `SCANRAY_SCENE`, a file of scene text relative to this folder, which is
//! `../scenes/default.txt` unless it is set.
//!
//! `SCANRAY_WITHOUT` names a stage that `picture` leaves out although the scene needs it, to see what the stage costs.
//! `SCANRAY_CUTOFF` is the cut-off of `cutoff`. `SCANRAY_SETTINGS` are the items that `settings` includes, and
//! `SCANRAY_POWER=polynomial` computes its highlights as if no shininess were a whole number.

use std::{env, fs, path::Path};

use scanray::accel::Accel;
use scanray::{Material, ScenePools};

/// A picture as a program draws it that sets nothing.
const DEFAULT_SETTINGS: &str = "
type Shown = embedded_graphics::pixelcolor::Rgb888;
const DITHERED: bool = false;
const RESOLUTION: Resolution = Resolution { width: 160, height: 120 };
const METHOD: Method = Method::Fixed;
const SAMPLES: usize = 1;
const STACK: usize = 5;
const RUNS: &[Run] = &[Run { max_depth: 5, cutoff: 0.0, threshold: 0.0, block: 1, of_rows: 1 }];
macro_rules! tracer { ($run:ident) => { tracer_for!(SCENE, stack = STACK) } }
";

fn main() {
    let path = env::var("SCANRAY_SCENE").unwrap_or_else(|_| "../scenes/default.txt".into());
    let text = fs::read(&path).unwrap_or_else(|error| panic!("{path}: {error}"));
    let mut pools = ScenePools::<f32, 1024, 1024, 1024, 1024, 1, 48, 2048>::new();
    if let Err(error) = pools.parse(&text) {
        panic!("{path}: {error}");
    }
    let out = env::var("OUT_DIR").expect("cargo sets OUT_DIR");
    let place = |name: &str, content: &[u8]| {
        let file = Path::new(&out).join(name);
        fs::write(&file, content).unwrap_or_else(|error| panic!("{}: {error}", file.display()));
    };
    let scene = pools.as_scene();
    let (accel, materials) = (*scene.accel(), scene.materials());
    let materials: Vec<_> = match env::var("SCANRAY_POWER").as_deref() {
        Ok("polynomial") => materials.iter().map(without_squaring).collect(),
        _ => materials.to_vec(),
    };
    let without = env::var("SCANRAY_WITHOUT").unwrap_or_else(|_| "NONE".into());
    let accel = match without.as_str() {
        // What nothing walks takes no flash either.
        "BVH" => Accel::from_parts(
            accel.sides(),
            accel.grids(),
            &[],
            &[],
            accel.lights_are_clear(),
        ),
        _ => accel,
    };
    // A power of another kind changes nothing that is derived.
    let scene = scene.with_materials(&materials).with_accel(accel);
    place("scene.rs", scanray::bake(&scene).to_string().as_bytes());
    place("scene.txt", &text);
    place(
        "without.rs",
        format!("scanray::Stages::{without}").as_bytes(),
    );
    let cutoff = env::var("SCANRAY_CUTOFF").unwrap_or_else(|_| "1.0 / 256.0".into());
    place("cutoff.rs", cutoff.as_bytes());
    let settings = env::var("SCANRAY_SETTINGS").unwrap_or_else(|_| DEFAULT_SETTINGS.into());
    place("settings.rs", settings.as_bytes());

    println!("cargo:rerun-if-changed={path}");
    println!("cargo:rerun-if-env-changed=SCANRAY_SCENE");
    println!("cargo:rerun-if-env-changed=SCANRAY_WITHOUT");
    println!("cargo:rerun-if-env-changed=SCANRAY_CUTOFF");
    println!("cargo:rerun-if-env-changed=SCANRAY_SETTINGS");
    println!("cargo:rerun-if-env-changed=SCANRAY_POWER");
}

/// The same material, whose shininess is not taken for a whole number.
fn without_squaring(material: &Material) -> Material {
    Material::from_parts(
        *material.description(),
        material.inverse_index(),
        material.bend(),
        Material::<f32>::FRACTIONAL,
        material.faint_alignment(),
    )
}
