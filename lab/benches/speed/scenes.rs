//! The scenes, and the memory they are loaded into.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::{Mutex, MutexGuard, PoisonError};

use scanray::ScenePools;

use crate::run::temporary;

/// Kind and number of objects of the large scenes: words for `scanray generate`.
pub(crate) const LARGE: [(&str, u32); 6] = [
    ("spheres", 1000),
    ("spheres", 10_000),
    ("spheres", 100_000),
    ("icosphere", 1280),
    ("icosphere", 20_480),
    ("icosphere", 81_920),
];

/// Room for the large scenes: what `scanray` itself has.
pub(crate) type Pools = ScenePools<f32, 131_072, 1024, 131_072, 262_144, 16, 48, 262_144>;

static POOLS: Mutex<Pools> = Mutex::new(Pools::new());

/// Pools that are no part of the stack.
pub(crate) fn pools() -> MutexGuard<'static, Pools> {
    POOLS.lock().unwrap_or_else(PoisonError::into_inner)
}

/// The files of scenes/.
pub(crate) fn of_repository() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes");
    let mut scenes: Vec<PathBuf> = std::fs::read_dir(folder)
        .expect("scenes/ can be read")
        .map(|entry| entry.expect("an entry of scenes/").path())
        .filter(|path| path.extension().is_some_and(|extension| extension == "txt"))
        .collect();
    scenes.sort();
    scenes
}

/// Writes a large scene.
pub(crate) fn generate(kind: &str, count: u32) -> PathBuf {
    let file = temporary(&format!("{kind}-{count}.txt"));
    let status = Command::new(crate::run::program())
        .args(["generate", kind, "--count", &count.to_string(), "-o"])
        .arg(&file)
        .stderr(std::process::Stdio::null())
        .status()
        .expect("scanray runs");
    assert!(status.success(), "scanray generate {kind}: {status}");
    file
}

/// What a large scene is called in tables.
pub(crate) fn name(kind: &str, count: u32) -> String {
    let count = match count / 1000 {
        0 => count.to_string(),
        thousands => format!("{thousands},{:03}", count % 1000),
    };
    match kind {
        "icosphere" => format!("{count} triangles"),
        kind => format!("{count} {kind}"),
    }
}
