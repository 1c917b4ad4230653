//! Random spheres.

use super::random::Random;
use super::{floor, material};

/// Few enough for a loader to find them again among the latest.
const COLORS: [[f64; 3]; 8] = [
    [0.9, 0.3, 0.25],
    [0.95, 0.6, 0.2],
    [0.9, 0.85, 0.3],
    [0.35, 0.75, 0.35],
    [0.25, 0.7, 0.75],
    [0.3, 0.45, 0.9],
    [0.6, 0.35, 0.8],
    [0.85, 0.85, 0.85],
];

/// The lines of a floor and `count` spheres.
pub(super) fn objects(count: u32, random: &mut Random) -> Vec<String> {
    let size = f64::from(count).powf(-1.0 / 3.0);
    let sphere = |index: u32| {
        let mut between = |low, high| random.between(low, high);
        let (x, y, z) = (between(-4.0, 4.0), between(-0.9, 3.6), between(3.0, 12.0));
        let radius = size * between(0.5, 1.5);
        let color = COLORS[between(0.0, COLORS.len() as f64) as usize];
        let reflection = if index.is_multiple_of(4) { 0.5 } else { 0.0 };
        format!(
            "0 {x:.6} {y:.6} {z:.6} {radius:.6} {}",
            material(color, reflection)
        )
    };
    let spheres = (0..count).map(sphere);
    std::iter::once(floor(0.3)).chain(spheres).collect()
}
