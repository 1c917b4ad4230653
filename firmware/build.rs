//! Bakes the scene that the programs draw: `SCANRAY_SCENE`, a file of scene text relative to this folder, which is
//! `../scenes/default.txt` unless it is set.
//!
//! `SCANRAY_WITHOUT` names a stage that `picture` leaves out although the scene needs it, to see what the stage costs.
//! `SCANRAY_CUTOFF` is the cut-off of `cutoff`.

use std::{env, fs, path::Path};

use scanray::ScenePools;

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
    place(
        "scene.rs",
        scanray::bake(&pools.as_scene()).to_string().as_bytes(),
    );
    place("scene.txt", &text);
    let without = env::var("SCANRAY_WITHOUT").unwrap_or_else(|_| "NONE".into());
    place(
        "without.rs",
        format!("scanray::Needs::{without}").as_bytes(),
    );
    let cutoff = env::var("SCANRAY_CUTOFF").unwrap_or_else(|_| "1.0 / 256.0".into());
    place("cutoff.rs", cutoff.as_bytes());

    println!("cargo:rerun-if-changed={path}");
    println!("cargo:rerun-if-env-changed=SCANRAY_SCENE");
    println!("cargo:rerun-if-env-changed=SCANRAY_WITHOUT");
    println!("cargo:rerun-if-env-changed=SCANRAY_CUTOFF");
}
