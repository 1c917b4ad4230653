//! Host speed, as times and as ratios to other programs.
//!
//! `cargo bench -p scanray-lab --bench speed [-- GROUP…]`; without a group, all of them:
//!
//! * `few`: the scenes of scenes/ (or files that are named) against the plain C program beside this file.
//! * `many`: spheres and triangles by the thousand against Tachyon, POV-Ray and brute force.
//! * `load`: how long reading such scenes and building their trees takes.
//! * `threads`: two threads against one.
//!
//! Programs are drawn with in turn, so that a drifting machine changes all of them; medians are printed. Times are
//! CPU times but where wall time is said. What is not installed is skipped, and said to be.

mod few;
mod load;
mod many;
mod peers;
mod run;
mod scenes;
mod threads;

use std::path::PathBuf;

/// A name, and what is done with the files that are named.
type Group = (&'static str, fn(&[PathBuf]));

const GROUPS: [Group; 4] = [
    ("few", few::run),
    ("many", |_| many::run()),
    ("load", |_| load::run()),
    ("threads", threads::run),
];

fn main() {
    // cargo itself passes --bench.
    let words = std::env::args()
        .skip(1)
        .filter(|word| !word.starts_with("--"));
    let (names, files): (Vec<_>, Vec<_>) =
        words.partition(|word| GROUPS.iter().any(|(name, _)| name == word));
    let files: Vec<_> = files.into_iter().map(PathBuf::from).collect();
    for (name, run) in GROUPS {
        // Files alone are for the group that draws files.
        let is_wanted = match names.as_slice() {
            [] => files.is_empty() || name == "few",
            names => names.iter().any(|wanted| wanted == name),
        };
        if is_wanted {
            println!("\n## {name}\n");
            run(&files);
        }
    }
}
