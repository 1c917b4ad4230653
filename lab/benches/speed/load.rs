//! Reading the text of large scenes and building their trees.

use std::path::Path;
use std::process::Command;

use cpu_time::ProcessTime;

use crate::run::{median, temporary};
use crate::scenes::{LARGE, generate, name, pools};

/// How often each is done.
const ROUNDS: usize = 5;

pub(crate) fn run() {
    println!("Seconds of CPU time, medians of {ROUNDS}, and bytes an object\n");
    println!(
        "{:<18} {:>8} {:>8}   {:>18}   {:>7} {:>7}",
        "scene", "text", "tree", "to the first pixel", "objects", "tree"
    );
    for (kind, count) in LARGE {
        let scene = generate(kind, count);
        let mut pools = pools();
        let (mut loads, mut trees) = (Vec::new(), Vec::new());
        for _ in 0..ROUNDS {
            let start = ProcessTime::now();
            let text = std::fs::read(&scene).expect("the scene was written");
            pools.parse(&text).expect("it is a scene");
            let load = start.elapsed().as_secs_f64();
            // What loading has done last, once more.
            let start = ProcessTime::now();
            pools.prepare();
            let tree = start.elapsed().as_secs_f64();
            loads.push(load - tree);
            trees.push(tree);
        }
        let scene_data = pools.as_scene();
        let objects = scene_data.object_count() as f64;
        let shapes = size_of_val(scene_data.spheres())
            + size_of_val(scene_data.planes())
            + size_of_val(scene_data.triangles());
        let tree = size_of_val(scene_data.accel().bvh().nodes)
            + size_of_val(scene_data.accel().bvh().entries);
        println!(
            "{:<18} {:>8.4} {:>8.4}   {:>18}   {:>7.1} {:>7.1}",
            name(kind, count),
            median(loads),
            median(trees),
            to_first_pixel(&scene),
            shapes as f64 / objects,
            tree as f64 / objects,
        );
    }
    println!(
        "\ntext: reading and parsing; to the first pixel: `scanray render --size 1x1` from its start to its end"
    );
}

/// CPU seconds of a whole run of the program.
#[cfg(unix)]
fn to_first_pixel(scene: &Path) -> String {
    let seconds = (0..ROUNDS).map(|_| {
        crate::run::cpu_seconds(
            Command::new(crate::run::program())
                .args(["render", "--size", "1x1", "--threads", "1", "-o"])
                .arg(temporary("first.ppm"))
                .arg(scene),
        )
    });
    format!("{:.4}", median(seconds))
}

#[cfg(not(unix))]
fn to_first_pixel(_: &Path) -> String {
    "not measured".to_owned()
}
