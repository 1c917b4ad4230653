//! FLIP: how different two pictures look to someone who flips between them on a screen.
//!
//! LDR-FLIP of Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström and Fairchild, "FLIP: A Difference
//! Evaluator for Alternating Images" (Proc. ACM Comput. Graph. Interact. Tech. 3, 2, 2020), with the
//! paper's constants. The bytes are taken as sRGB, as screens show them.
//!
//! 1. Both pictures are blurred as the eye blurs them at that distance (contrast sensitivity of luma, red
//!    to green and blue to yellow); what is left of the colours is compared in CIELAB with the Hunt effect by the HyAB
//!    distance, compressed to 0…1: `ΔEc`.
//! 2. Edges and points are found in the luma of both by derivatives of a Gaussian; how much they differ: `ΔEf`.
//! 3. The error of a pixel is `ΔEc^(1 − ΔEf)`, and that of the picture is the mean.

use std::f64::consts::PI;

use rayon::prelude::*;

use super::color_space::{Triple, lab_from_rgb, linear, rgb_from_ycxcz, ycxcz_from_rgb};
use crate::image::Image;

/// Pixels that one degree of the visual field covers: a 4K screen 0.7 m wide, seen from 0.7 m.
pub const DEFAULT_PIXELS_PER_DEGREE: f32 = 0.7 * 3840.0 / 0.7 * std::f32::consts::PI / 180.0;

/// Rows that are worked on at a time, so that memory has a bound.
const BAND_ROWS: usize = 32;

/// A Gaussian of a contrast sensitivity function: amplitude and width.
type Gaussian = (f32, f32);

const LUMA: Gaussian = (1.0, 0.0047);
const RED_GREEN: Gaussian = (1.0, 0.0053);
const BLUE_YELLOW: [Gaussian; 2] = [(34.1, 0.04), (13.5, 0.025)];

/// Width of the widest of them, which decides how far the filters reach.
const WIDEST: f32 = 0.04;

/// Width of the feature detector in degrees.
const FEATURE_WIDTH: f32 = 0.082;

/// The error of each pixel, from 0 (looks the same) to 1.
///
/// Both pictures must have the same size; `pixels_per_degree` must be above 0.
pub(crate) fn error_map(reference: &Image, test: &Image, pixels_per_degree: f32) -> Vec<f32> {
    let filters = Filters::new(pixels_per_degree);
    let linear: Vec<f32> = (0..=u8::MAX).map(linear).collect();
    let largest = largest_color_difference();
    let width = reference.width;
    let mut map = vec![0.0; width * reference.height];
    map.par_chunks_mut(width * BAND_ROWS)
        .enumerate()
        .for_each(|(index, errors)| {
            let top = index * BAND_ROWS;
            let rows = errors.len() / width;
            let [a, b] =
                [reference, test].map(|image| Appearance::of(image, top, rows, &filters, &linear));
            for (i, error) in errors.iter_mut().enumerate() {
                let color = compressed(hyab(a.color[i], b.color[i]), largest);
                let feature = (a.edge[i] - b.edge[i])
                    .abs()
                    .max((a.point[i] - b.point[i]).abs());
                let feature = (feature * std::f32::consts::FRAC_1_SQRT_2).sqrt().min(1.0);
                *error = color.powf(1.0 - feature);
            }
        });
    map
}

/// HyAB distance of two colours in CIELAB.
fn hyab([l, a, b]: Triple, [m, c, d]: Triple) -> f32 {
    (l - m).abs() + ((a - c).powi(2) + (b - d).powi(2)).sqrt()
}

/// Chroma counts for more where it is bright (Hunt).
fn hunt([l, a, b]: Triple) -> Triple {
    [l, 0.01 * l * a, 0.01 * l * b]
}

/// Exponent of the colour difference.
const COLOR_EXPONENT: f32 = 0.7;

/// That of green and blue, before compression.
fn largest_color_difference() -> f32 {
    let [green, blue] = [[0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(|rgb| hunt(lab_from_rgb(rgb)));
    hyab(green, blue).powf(COLOR_EXPONENT)
}

/// To 0…1: what is below 0.4 of the largest difference takes 0.95 of the range.
fn compressed(difference: f32, largest: f32) -> f32 {
    const KNEE: f32 = 0.4;
    const SHARE: f32 = 0.95;
    let difference = difference.powf(COLOR_EXPONENT);
    let knee = KNEE * largest;
    if difference < knee {
        difference * (SHARE / knee)
    } else {
        SHARE + (difference - knee) / (largest - knee) * (1.0 - SHARE)
    }
}

/// A symmetric or antisymmetric window of odd length.
type Kernel = Vec<f32>;

/// The one-dimensional parts of all filters; every filter is separable.
struct Filters {
    luma: Kernel,
    red_green: Kernel,
    /// With the share each has in the whole.
    blue_yellow: [(f32, Kernel); 2],
    /// Gaussian of the feature detector and its first two derivatives.
    feature: Kernel,
    edge: Kernel,
    point: Kernel,
}

impl Filters {
    fn new(pixels_per_degree: f32) -> Self {
        let ppd = f64::from(pixels_per_degree);
        let reach = 3.0 * (f64::from(WIDEST) / (2.0 * PI * PI)).sqrt() * ppd;
        // exp(−π²x²/b), the Gaussian's Fourier transform, and its weight in two dimensions.
        let transformed = |(amplitude, width): Gaussian| {
            let (amplitude, width) = (f64::from(amplitude), f64::from(width));
            let window = window(reach, |x| (-PI * PI * (x / ppd).powi(2) / width).exp());
            let sum: f64 = window.iter().sum();
            let weight = amplitude * (PI / width).sqrt() * sum * sum;
            (weight, scaled(&window, 1.0 / sum, 1.0 / sum))
        };
        let [(first, first_kernel), (second, second_kernel)] = BLUE_YELLOW.map(transformed);
        let share = |weight: f64| (weight / (first + second)) as f32;

        let deviation = 0.5 * f64::from(FEATURE_WIDTH) * ppd;
        let gauss = |x: f64| (-x * x / (2.0 * deviation * deviation)).exp();
        // Positive and negative weights each sum to 1.
        let balanced = |value: &dyn Fn(f64) -> f64| {
            let window = window(3.0 * deviation, value);
            let sum = |sign: f64| -> f64 { window.iter().map(|w| (w * sign).max(0.0)).sum() };
            let or_1 = |sum: f64| if sum > 0.0 { sum } else { 1.0 };
            scaled(&window, 1.0 / or_1(sum(1.0)), 1.0 / or_1(sum(-1.0)))
        };
        Self {
            luma: transformed(LUMA).1,
            red_green: transformed(RED_GREEN).1,
            blue_yellow: [(share(first), first_kernel), (share(second), second_kernel)],
            feature: balanced(&gauss),
            edge: balanced(&|x| -x * gauss(x)),
            point: balanced(&|x| (x * x / (deviation * deviation) - 1.0) * gauss(x)),
        }
    }

    /// Rows above and below that a pixel depends on.
    fn reach(&self) -> usize {
        self.luma.len().max(self.feature.len()) / 2
    }
}

/// Values at the whole numbers up to `reach`, rounded up, to both sides of 0.
fn window(reach: f64, value: impl Fn(f64) -> f64) -> Vec<f64> {
    let reach = reach.ceil() as i32;
    (-reach..=reach).map(|x| value(f64::from(x))).collect()
}

fn scaled(window: &[f64], positive: f64, negative: f64) -> Kernel {
    window
        .iter()
        .map(|w| (w * if *w > 0.0 { positive } else { negative }) as f32)
        .collect()
}

/// What the eye makes of some rows of a picture.
struct Appearance {
    /// Blurred, in CIELAB with the Hunt effect.
    color: Vec<Triple>,
    /// Strength of edges and points.
    edge: Vec<f32>,
    point: Vec<f32>,
}

impl Appearance {
    fn of(image: &Image, top: usize, rows: usize, filters: &Filters, linear: &[f32]) -> Self {
        let (width, height) = (image.width, image.height);
        let reach = filters.reach();
        // Beyond its border the picture goes on as at its border.
        let first = top.saturating_sub(reach);
        let last = (top + rows + reach).min(height);
        let row_of = |y: isize| y.clamp(0, height as isize - 1) as usize - first;

        let pixels = image.rgb888[first * width * 3..last * width * 3].chunks_exact(3);
        let ycxcz: Vec<Triple> = pixels
            .map(|p| ycxcz_from_rgb([p[0], p[1], p[2]].map(|value| linear[usize::from(value)])))
            .collect();
        let channel = |index: usize| -> Vec<f32> { ycxcz.iter().map(|c| c[index]).collect() };
        let across = |channel: &[f32], kernel: &Kernel| filter_rows(channel, width, kernel);
        let down = |channel: &[f32], kernel: &Kernel| {
            let half = (kernel.len() / 2) as isize;
            let mut result = vec![0.0_f32; width * rows];
            for (y, out) in result.chunks_exact_mut(width).enumerate() {
                for (k, weight) in kernel.iter().enumerate() {
                    let row = row_of((top + y) as isize + k as isize - half);
                    let source = &channel[row * width..][..width];
                    for (sum, value) in out.iter_mut().zip(source) {
                        *sum += weight * value;
                    }
                }
            }
            result
        };

        let [luma, cx, cz] = [0, 1, 2].map(channel);
        let blurred = |channel: &[f32], kernel| down(&across(channel, kernel), kernel);
        let blurred_luma = blurred(&luma, &filters.luma);
        let blurred_cx = blurred(&cx, &filters.red_green);
        let [(share, kernel), (other_share, other_kernel)] = &filters.blue_yellow;
        let mut blurred_cz = blurred(&cz, kernel);
        for (value, other) in blurred_cz.iter_mut().zip(blurred(&cz, other_kernel)) {
            *value = *value * share + other * other_share;
        }
        let color = (0..width * rows)
            .map(|i| {
                let rgb = rgb_from_ycxcz([blurred_luma[i], blurred_cx[i], blurred_cz[i]]);
                hunt(lab_from_rgb(rgb.map(|c| c.clamp(0.0, 1.0))))
            })
            .collect();

        let gray: Vec<f32> = luma.iter().map(|luma| (luma + 16.0) / 116.0).collect();
        let smooth = across(&gray, &filters.feature);
        let strength = |kernel: &Kernel| -> Vec<f32> {
            let horizontal = down(&across(&gray, kernel), &filters.feature);
            let vertical = down(&smooth, kernel);
            let pairs = horizontal.iter().zip(&vertical);
            pairs.map(|(x, y)| x.hypot(*y)).collect()
        };
        Self {
            color,
            edge: strength(&filters.edge),
            point: strength(&filters.point),
        }
    }
}

/// Rows filtered across.
fn filter_rows(channel: &[f32], width: usize, kernel: &Kernel) -> Vec<f32> {
    let half = kernel.len() / 2;
    let mut padded = vec![0.0; width + 2 * half];
    let mut result = Vec::with_capacity(channel.len());
    for row in channel.chunks_exact(width) {
        padded[..half].fill(row[0]);
        padded[half..half + width].copy_from_slice(row);
        padded[half + width..].fill(row[width - 1]);
        result.extend(padded.windows(kernel.len()).map(|window| {
            let products = window
                .iter()
                .zip(kernel)
                .map(|(value, weight)| value * weight);
            products.sum::<f32>()
        }));
    }
    result
}

#[cfg(test)]
mod tests {
    use super::*;

    fn picture(color: impl Fn(usize, usize) -> [u8; 3]) -> Image {
        let (width, height) = (48, 40);
        let places = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
        let rgb888 = places.flat_map(|(x, y)| color(x, y)).collect();
        Image {
            width,
            height,
            rgb888,
        }
    }

    /// The mean and the errors at (0, 0), (24, 20), (20, 15) and (47, 39) are those of the authors' own
    /// program (flip_evaluator 1.7), at 67.02, 20 and 150 pixels a degree.
    #[test]
    fn agrees_with_the_authors_program() {
        let gradient = picture(|x, y| [x * 5, y * 6, x * y].map(|value| value as u8));
        let changed = picture(|x, y| {
            let is_inside = (10..20).contains(&x) && (10..30).contains(&y);
            let red = x * 5 + if is_inside { 40 } else { 0 };
            let blue = x * y + usize::from(x == 30);
            [red, y * 6, blue].map(|value| value as u8)
        });
        let plain = |color| picture(move |_, _| color);
        let dot = picture(|x, y| [if (x, y) == (24, 20) { 255 } else { 0 }; 3]);
        let checks = |shift| picture(move |x, y| [((x + shift) / 4 + y / 4) as u8 % 2 * 255; 3]);
        let (black, white) = (plain([0; 3]), plain([255; 3]));
        let cases = [
            (
                (&gradient, &changed),
                [
                    [0.036387, 0.0, 0.014761, 0.162706, 0.0],
                    [0.030062, 0.0, 0.0, 0.085357, 0.0],
                    [0.044486, 0.001997, 0.039816, 0.178299, 0.000385],
                ],
            ),
            ((&white, &black), [[0.9674; 5]; 3]),
            ((&black, &white), [[0.9674; 5]; 3]),
            ((&plain([0, 255, 0]), &plain([0, 0, 255])), [[1.0; 5]; 3]),
            (
                (&black, &dot),
                [
                    [0.007453, 0.0, 0.864906, 0.0, 0.0],
                    [0.001514, 0.0, 0.989930, 0.0, 0.0],
                    [0.015507, 0.0, 0.501670, 0.049153, 0.0],
                ],
            ),
            (
                (&checks(0), &checks(1)),
                [
                    [0.307236, 0.273810, 0.216787, 0.264768, 0.979473],
                    [0.416532, 0.0, 0.104051, 0.361482, 0.994726],
                    [0.068883, 0.320836, 0.030118, 0.030910, 0.814982],
                ],
            ),
        ];
        for (case, ((a, b), expected)) in cases.iter().enumerate() {
            for (expected, ppd) in expected
                .iter()
                .zip([DEFAULT_PIXELS_PER_DEGREE, 20.0, 150.0])
            {
                let map = error_map(a, b, ppd);
                let mean = map.iter().sum::<f32>() / map.len() as f32;
                let [corner, middle, side, end] =
                    [(0, 0), (24, 20), (20, 15), (47, 39)].map(|(x, y)| map[y * a.width + x]);
                for (got, expected) in [mean, corner, middle, side, end].iter().zip(expected) {
                    assert!(
                        (got - expected).abs() < 1e-4,
                        "case {case}, {ppd}: {got}, not {expected}"
                    );
                }
            }
        }
    }

    #[test]
    fn equal_pictures_have_no_error_and_small_ones_are_no_obstacle() {
        for (width, height) in [(1, 1), (3, 70), (70, 3)] {
            let image = |value: u8| Image {
                width,
                height,
                rgb888: vec![value; width * height * 3],
            };
            for ppd in [0.1, 1.0, DEFAULT_PIXELS_PER_DEGREE, 300.0] {
                let same = error_map(&image(90), &image(90), ppd);
                assert!(same.iter().all(|error| *error == 0.0));
                let other = error_map(&image(90), &image(200), ppd);
                assert!(other.iter().all(|error| *error > 0.1 && *error <= 1.0));
            }
        }
    }
}
