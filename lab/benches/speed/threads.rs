//! Two threads against one.

use std::path::PathBuf;

use crate::run::{Time, median, scanray};
use crate::scenes::{generate, of_repository};

/// Pairs of pictures.
const ROUNDS: usize = 15;

pub(crate) fn run(files: &[PathBuf]) {
    let scenes = match files {
        [] => {
            let mut scenes = of_repository();
            scenes.push(generate("spheres", 10_000));
            scenes
        }
        files => files.to_vec(),
    };
    println!("Drawing 800x600 pixels, medians of {ROUNDS} pairs of pictures\n");
    println!(
        "{:<20} {:>12} {:>12}   {:>20}   {:>14}",
        "scene", "1 thread, ms", "2, ms", "times as fast (best)", "CPU time, 2 / 1"
    );
    for scene in scenes {
        let draw = |threads| scanray(&scene, &["--size", "800x600", "--threads", threads]);
        let pairs: Vec<(Time, Time)> = (0..ROUNDS).map(|_| (draw("1"), draw("2"))).collect();
        let median = |value: fn(&(Time, Time)) -> f64| median(pairs.iter().map(value));
        let milliseconds = 480_000.0 * 1e-6;
        let best =
            |value: fn(&(Time, Time)) -> f64| pairs.iter().map(value).fold(f64::INFINITY, f64::min);
        println!(
            "{:<20} {:>12.2} {:>12.2}   {:>13.2} ({:.2})   {:>14.3}",
            scene.file_stem().unwrap_or_default().to_string_lossy(),
            median(|(one, _)| one.wall) * milliseconds,
            median(|(_, two)| two.wall) * milliseconds,
            median(|(one, two)| one.wall / two.wall),
            best(|(one, _)| one.wall) / best(|(_, two)| two.wall),
            median(|(one, two)| two.cpu / one.cpu),
        );
    }
    println!(
        "\nWall time is that of a machine with nothing else to do only if it has nothing else to do; best: the shortest \
         of one thread by the shortest of two."
    );
}
