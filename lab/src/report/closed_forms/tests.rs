//! The split of errors on the scenes whose pictures can be computed by hand.

use super::*;
use crate::report::document::Configuration;
use crate::report::sweep::Sweep;
use scanray_host::option_values::ColorName;

/// Measures settings on a scene, and hands over the sweep for more.
fn measured<R>(form: &ClosedForm, check: impl FnOnce(&Sweep<'_>) -> R) -> R {
    let scene = form.load().unwrap();
    let workers = Workers::new(Some(2)).unwrap();
    check(&Sweep::new(&scene, SIZE, &workers).unwrap())
}

fn measure(sweep: &Sweep<'_>, settings: Settings) -> Configuration {
    sweep.measure(&settings).unwrap()
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
    let [form, ..] = &closed_forms();
    let radius = silhouette();
    let color = |share: f64| 0.2 + 0.5 * share;
    let centre = |x, y| form.mean(x, y, 1);
    measured(form, |sweep| {
        let errors = measure(sweep, Settings::DEFAULT).errors;
        assert_eq!(errors.truncation.max, 0.0);
        // 0.7 and 0.2 have no exact f32.
        assert!(errors.rounding.max < 255.0 * f64::from(f32::EPSILON));
        let quantisation = rmse(pixels().map(|(x, y)| shown(centre(x, y)) - centre(x, y)));
        close(errors.quantisation.rmse, quantisation, 1e-5);
        // R2 is the mean of its grid exactly, and close to the area.
        let mean = |x: u16, y: u16| form.mean(x, y, SAMPLES_A_SIDE);
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
    let [_, form, _] = &closed_forms();
    measured(form, |sweep| {
        let errors = measure(sweep, Settings::DEFAULT).errors;
        assert_eq!(errors.truncation.max, 0.0);
        assert!(errors.rounding.max < 1e-3, "{}", errors.rounding.max);
        let mean = |x: u16, y: u16| form.mean(x, y, SAMPLES_A_SIDE);
        let centre = |x, y| form.mean(x, y, 1);
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
    let [.., form] = &closed_forms();
    let (ambient, share) = MIRRORS;
    measured(form, |sweep| {
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
    let form = ClosedForm {
        name: "an empty scene",
        scene: head(0, "0 9 0 0 0 0 0 0 0", "0.3 0.3 0.3"),
        grey: |_, _| 0.3,
    };
    measured(&form, |sweep| {
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

#[test]
fn the_references_are_the_closed_forms() {
    let workers = Workers::new(Some(2)).unwrap();
    for Distance { name, r1, r2 } in distances(&workers).unwrap() {
        assert!(r1 < 1e-9 && r2 < 1e-9, "{name}: {r1}, {r2}");
    }
    // What is not the closed form is noticed.
    let wrong = ClosedForm {
        grey: |_, _| series(DEPTH - 1),
        ..closed_forms().into_iter().next_back().unwrap()
    };
    let scene = wrong.load().unwrap();
    let references =
        References::draw(scene.double(Settings::DEFAULT.power), SIZE, &workers).unwrap();
    assert!(Error::between(&references.r2, &wrong.picture(1)).max > 1e-3);
}
