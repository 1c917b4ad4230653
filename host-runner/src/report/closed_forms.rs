//! R3: the split of errors on scenes whose pictures can be computed by hand.

use std::fs;

use scanray::Resolution;

use super::document::Configuration;
use super::references::{DEPTH, SAMPLES_A_SIDE};
use super::scenes::BothScalars;
use super::settings::{Sampling, Settings};
use super::sweep::Sweep;
use crate::drawing::Workers;
use crate::options::ColorName;
use crate::scene_file::SceneSource;

const SIZE: Resolution = Resolution {
    width: 32,
    height: 24,
};

/// The head of a scene without sky: camera at the origin, light as given, ambient intensity 1, background.
fn head(objects: usize, light: &str, background: &str) -> String {
    format!("{objects}\n0 0 0\n32 24\n{light}\n1\n0\n{background}\n")
}

/// Measures settings on a scene, and hands over the sweep for more.
fn measured<R>(scene: &str, check: impl FnOnce(&Sweep<'_>) -> R) -> R {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scene.txt");
    fs::write(&path, scene).unwrap();
    let scene = BothScalars::load(&SceneSource::File(path)).unwrap();
    let workers = Workers::new(Some(2)).unwrap();
    check(&Sweep::new(&scene, SIZE, &workers).unwrap())
}

fn measure(sweep: &Sweep<'_>, settings: Settings) -> Configuration {
    sweep.measure(&settings).unwrap()
}

/// Where the centre of a part of a pixel lies on the image plane at z = 1.
fn place(x: u16, y: u16, part: (u16, u16), parts: u16) -> (f64, f64) {
    let at = |pixel: u16, part: u16| f64::from(pixel) + (f64::from(part) + 0.5) / f64::from(parts);
    let (width, height) = (f64::from(SIZE.width), f64::from(SIZE.height));
    let (x, y) = (at(x, part.0), at(y, part.1));
    ((2.0 * x - width) / height, (height - 2.0 * y) / height)
}

fn pixels() -> impl Iterator<Item = (u16, u16)> {
    (0..SIZE.height).flat_map(|y| (0..SIZE.width).map(move |x| (x, y)))
}

/// Root of the mean square, in levels, of grey differences.
fn rmse(differences: impl Iterator<Item = f64>) -> f64 {
    let (mut sum, mut count) = (0.0, 0);
    for difference in differences {
        sum += (255.0 * difference).powi(2);
        count += 1;
    }
    (sum / f64::from(count)).sqrt()
}

fn shown(value: f64) -> f64 {
    (255.0 * value + 0.5).floor() / 255.0
}

#[track_caller]
fn close(actual: f64, expected: f64, tolerance: f64) {
    let difference = (actual - expected).abs();
    assert!(difference <= tolerance, "{actual} instead of {expected}");
}

/// The share of a pixel that a disc of a radius around the middle of the picture covers: the length of its
/// chords is exact, their sum over the pixel's width is taken in 2,000 steps.
fn covered(x: u16, y: u16, radius: f64) -> f64 {
    const STEPS: u16 = 2000;
    let height = f64::from(SIZE.height);
    let (top, bottom) = (
        1.0 - 2.0 * f64::from(y) / height,
        1.0 - 2.0 * (f64::from(y) + 1.0) / height,
    );
    let chord = |step: u16| {
        let (across, _) = place(x, y, (step, 0), STEPS);
        let half = (radius * radius - across * across).max(0.0).sqrt();
        (top.min(half) - bottom.max(-half)).max(0.0) / (top - bottom)
    };
    (0..STEPS).map(chord).sum::<f64>() / f64::from(STEPS)
}

#[test]
fn a_sphere_has_aliasing_and_quantisation_alone() {
    // A disc of 0.7 on 0.2: the silhouette of a sphere on the axis is a circle.
    let scene = head(1, "0 0 -9 0 0 0 0 0 0", "0.2 0.2 0.2")
        + "0 0 0 5 2.1 0 0 0 0 0 0 0.7 0.7 0.7 0 1 0 0\n";
    let radius = 2.1 / (25.0_f64 - 2.1 * 2.1).sqrt();
    let color = |share: f64| 0.2 + 0.5 * share;
    let sample = |x, y, part, parts| {
        let (x, y) = place(x, y, part, parts);
        color(if x * x + y * y <= radius * radius {
            1.0
        } else {
            0.0
        })
    };
    let centre = |x, y| sample(x, y, (0, 0), 1);
    measured(&scene, |sweep| {
        let errors = measure(sweep, Settings::DEFAULT).errors;
        assert_eq!(errors.truncation.max, 0.0);
        // 0.7 and 0.2 have no exact f32.
        assert!(errors.rounding.max < 255.0 * f64::from(f32::EPSILON));
        let quantisation = rmse(pixels().map(|(x, y)| shown(centre(x, y)) - centre(x, y)));
        close(errors.quantisation.rmse, quantisation, 1e-5);
        // R2 is the mean of its grid exactly, and close to the area.
        let mean = |x: u16, y: u16| {
            let side = SAMPLES_A_SIDE;
            let parts = (0..side).flat_map(|b| (0..side).map(move |a| (a, b)));
            parts.map(|part| sample(x, y, part, side)).sum::<f64>() / f64::from(side * side)
        };
        let aliasing = rmse(pixels().map(|(x, y)| centre(x, y) - mean(x, y)));
        close(errors.aliasing.rmse, aliasing, 1e-9);
        let total = rmse(pixels().map(|(x, y)| shown(centre(x, y)) - mean(x, y)));
        close(errors.total.rmse, total, 1e-9);
        let area = rmse(pixels().map(|(x, y)| mean(x, y) - color(covered(x, y, radius))));
        assert!(
            area < 0.1 * aliasing,
            "R2 is {area} off, aliasing {aliasing}"
        );
        // More samples have less of it.
        let smooth = Settings {
            sampling: Sampling::Fixed(16),
            ..Settings::DEFAULT
        };
        let smooth = measure(sweep, smooth).errors;
        assert!(smooth.aliasing.rmse < 0.2 * aliasing);
        let adaptive = Settings {
            sampling: Sampling::Adaptive(16),
            ..Settings::DEFAULT
        };
        close(
            measure(sweep, adaptive).errors.aliasing.rmse,
            smooth.aliasing.rmse,
            1e-9,
        );
    });
}

#[test]
fn a_plane_is_shaded_as_by_hand() {
    // A lit floor at y = −1 below a grey background.
    let scene = head(1, "1 3 4 0 0 0 1 1 1", "0.5 0.5 0.5")
        + "1 0 1 0 1 0.8 0.8 0.8 0 0 0 0.1 0.1 0.1 0 1 0 0\n";
    let sample = |x: u16, y: u16, part, parts| {
        let (x, y) = place(x, y, part, parts);
        if y >= 0.0 {
            return 0.5;
        }
        let point = [x / -y, -1.0, 1.0 / -y];
        let to_light = [1.0 - point[0], 4.0, 4.0 - point[2]];
        let distance = to_light.iter().map(|c| c * c).sum::<f64>().sqrt();
        0.1 + 0.8 * 4.0 / distance
    };
    measured(&scene, |sweep| {
        let errors = measure(sweep, Settings::DEFAULT).errors;
        assert_eq!(errors.truncation.max, 0.0);
        assert!(errors.rounding.max < 1e-3, "{}", errors.rounding.max);
        let side = SAMPLES_A_SIDE;
        let mean = |x: u16, y: u16| {
            let parts = (0..side).flat_map(|b| (0..side).map(move |a| (a, b)));
            parts.map(|part| sample(x, y, part, side)).sum::<f64>() / f64::from(side * side)
        };
        let centre = |x, y| sample(x, y, (0, 0), 1);
        let aliasing = rmse(pixels().map(|(x, y)| centre(x, y) - mean(x, y)));
        close(errors.aliasing.rmse, aliasing, 1e-9);
        let quantisation = rmse(pixels().map(|(x, y)| shown(centre(x, y)) - centre(x, y)));
        close(errors.quantisation.rmse, quantisation, 1e-3);
        // Half a level at most.
        assert!(errors.quantisation.max <= 0.5 + 1e-3);
    });
}

#[test]
fn facing_mirrors_have_truncation_alone() {
    let (ambient, share) = (0.2, 0.6);
    let mirror = format!("0 0 0 0 0 0 {ambient} {ambient} {ambient} {share} 1 0 0\n");
    let scene =
        head(2, "0 9 0 0 0 0 0 0 0", "0 0 0") + &format!("1 0 0 1 1 {mirror}1 0 0 -1 1 {mirror}");
    let series = |depth: usize| {
        (0..=depth)
            .map(|k| ambient * f64::powi(share, k as i32))
            .sum::<f64>()
    };
    measured(&scene, |sweep| {
        for max_depth in [0, 1, 5, DEPTH] {
            let errors = measure(
                sweep,
                Settings {
                    max_depth,
                    ..Settings::DEFAULT
                },
            )
            .errors;
            let (value, end) = (series(max_depth), series(DEPTH));
            close(errors.truncation.rmse, 255.0 * (end - value), 1e-9);
            close(errors.truncation.max, 255.0 * (end - value), 1e-9);
            close(errors.aliasing.max, 0.0, 1e-9);
            assert!(errors.rounding.max < 1e-4);
            close(
                errors.quantisation.max,
                255.0 * (shown(value) - value).abs(),
                1e-4,
            );
            close(errors.total.max, 255.0 * (shown(value) - end).abs(), 1e-9);
        }
        // What R1 leaves out is bounded: the rest of the series is less than the last throughput.
        let left = sweep.left_out();
        close(left.max, f64::powi(share, DEPTH as i32 + 1), 1e-12);
        close(left.mean, left.max, 1e-12);
        let rest = ambient * f64::powi(share, DEPTH as i32 + 1) / (1.0 - share);
        assert!(rest <= left.max);
        // A cut-off leaves out no more than it says.
        let cut = Settings {
            max_depth: DEPTH,
            cutoff: Some(64),
            ..Settings::DEFAULT
        };
        let errors = measure(sweep, cut).errors;
        assert!(errors.truncation.max > 0.0 && errors.truncation.max < 255.0 / 64.0);
    });
}

#[test]
fn few_colours_have_quantisation_alone() {
    let scene = head(0, "0 9 0 0 0 0 0 0 0", "0.3 0.3 0.3");
    measured(&scene, |sweep| {
        let settings = Settings {
            color: ColorName::Gray4,
            ..Settings::DEFAULT
        };
        let errors = measure(sweep, settings).errors;
        // 0.3 is 4.5 of 15 levels, and f32's 0.3 is a little more.
        close(errors.quantisation.rmse, 255.0 * (5.0 / 15.0 - 0.3), 1e-4);
        close(errors.total.rmse, errors.quantisation.rmse, 1e-4);
        assert_eq!(errors.truncation.max, 0.0);
        close(errors.aliasing.max, 0.0, 1e-9);
    });
}
