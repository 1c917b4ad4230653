//! Several samples a pixel: the pattern, edges alone, and the same bits whatever the schedule.

use crate::common::random::Random;
use crate::common::sampling::{bits, channels, ray_beside};
use crate::common::scenes::{load, names};
use embedded_graphics::pixelcolor::{Rgb888, RgbColor};
use embedded_graphics::primitives::PointsIter;
use scanray::{
    Color, Picture, Resolution, Scalar, Tracer,
    camera::Subpixel,
    render::{
        Adaptive, Budget, CenterSample, Exact, Frame, PixelSource, Progress, Supersampled, differ,
    },
    tracer::WorkCount,
};

const SIZE: Resolution = Resolution {
    width: 37,
    height: 23,
};

fn pixels(size: Resolution) -> impl Iterator<Item = (u16, u16)> {
    (0..size.height).flat_map(move |y| (0..size.width).map(move |x| (x, y)))
}

fn color_of<P: PixelSource>(source: &P, (x, y): (u16, u16)) -> Color<P::Scalar> {
    source.pixel_on(&source.scanline(y), x).0
}

#[test]
fn one_sample_is_the_pixel_itself() {
    for name in names() {
        let (single, double) = (load::<f32>(&name), load::<f64>(&name));
        let tracer = Tracer::new(single.as_scene()).with_resolution(SIZE);
        let double = Tracer::new(double.as_scene()).with_resolution(SIZE);
        for (x, y) in pixels(SIZE) {
            let one = color_of(&Supersampled::<_, 1>::new(&tracer), (x, y));
            assert_eq!(bits(one), bits(tracer.pixel(x, y)), "{name} {x},{y}");
            let one = color_of(&Supersampled::<_, 1>::new(&double), (x, y));
            assert_eq!(bits(one), bits(double.pixel(x, y)), "{name} {x},{y}");
        }
    }
}

/// Samples are the pixels of a picture with as many times more columns and rows.
fn are_pixels_of_a_larger_picture<const SAMPLES: usize>(name: &str) {
    let pools = load::<f32>(name);
    let size = Resolution {
        width: 11,
        height: 7,
    };
    let of = SAMPLES as u16;
    let tracer = Tracer::new(pools.as_scene()).with_resolution(size);
    let large = tracer.with_resolution(Resolution {
        width: size.width * of,
        height: size.height * of,
    });
    let supersampled = Supersampled::<_, SAMPLES>::new(&tracer);
    for (x, y) in pixels(size) {
        let mut sum = Color::BLACK;
        for at in Supersampled::<Tracer<'_>, SAMPLES>::PATTERN {
            let (column, row) = (x * of + u16::from(at.column), y * of + u16::from(at.row));
            sum = sum + large.pixel(column, row);
        }
        let mean = sum * (1.0 / SAMPLES as f32);
        let color = color_of(&supersampled, (x, y));
        assert_eq!(bits(color), bits(mean), "{name} {x},{y}");
    }
}

#[test]
fn pixels_are_the_means_of_their_samples() {
    for name in names() {
        are_pixels_of_a_larger_picture::<4>(&name);
        are_pixels_of_a_larger_picture::<16>(&name);
        are_pixels_of_a_larger_picture::<64>(&name);
    }
}

#[test]
fn samples_lie_where_the_pattern_says() {
    // As offsets from the centre of the pixel, by another way to the ray.
    let pools = load::<f64>("default");
    let tracer = Tracer::new(pools.as_scene()).with_resolution(SIZE);
    let position = tracer.scene().camera().position;
    for at in Supersampled::<Tracer<'_, f64>, 16>::PATTERN {
        let offset = |cell: u8| (f64::from(cell) + 0.5) / 16.0 - 0.5;
        let beside = (offset(at.column), -offset(at.row));
        for (x, y) in pixels(SIZE) {
            let ray = tracer.primary_ray_at(&tracer.scanline_at(y, at), x, at);
            let expected = ray_beside::<f64>(position, SIZE, (x, y), beside);
            let off = ray.direction - expected.direction;
            assert!(off.dot(off) < 1e-30, "{at:?} {x},{y}");
        }
    }
}

/// Root of the mean squared error of a picture against samples on a finer grid than any pattern's.
fn error<P: PixelSource>(source: &P, reference: &[Color<f64>]) -> f64 {
    let sum: f64 = pixels(source.resolution())
        .zip(reference)
        .flat_map(|(pixel, expected)| {
            let color = channels(color_of(source, pixel));
            let expected = channels(*expected);
            (0..3).map(move |i| (color[i] - expected[i]).powi(2))
        })
        .sum();
    (sum / (3.0 * reference.len() as f64)).sqrt()
}

/// The mean of 32 × 32 samples in each pixel.
fn reference(tracer: &Tracer<'_>) -> Vec<Color<f64>> {
    const OF: u8 = 32;
    pixels(tracer.resolution())
        .map(|(x, y)| {
            let mut sum = Color::BLACK;
            for row in 0..OF {
                let at = |column| Subpixel {
                    column,
                    row,
                    of: OF,
                };
                let scanline = tracer.scanline_at(y, at(0));
                for column in 0..OF {
                    let color = tracer.sample_observed(&scanline, x, at(column), &mut ());
                    let [r, g, b] = channels(color);
                    sum = sum + Color::new(r, g, b);
                }
            }
            sum * (1.0 / f64::from(OF).powi(2))
        })
        .collect()
}

#[test]
fn more_samples_are_less_wrong() {
    let size = Resolution {
        width: 32,
        height: 24,
    };
    for name in names() {
        let pools = load::<f32>(&name);
        let tracer = Tracer::new(pools.as_scene()).with_resolution(size);
        let reference = reference(&tracer);
        let errors = [
            error(&tracer, &reference),
            error(&Supersampled::<_, 4>::new(&tracer), &reference),
            error(&Supersampled::<_, 16>::new(&tracer), &reference),
            error(&Supersampled::<_, 64>::new(&tracer), &reference),
        ];
        println!("{name}: root mean square error of 1, 4, 16 and 64 samples {errors:.4?}");
        for (few, more) in errors.iter().zip(&errors[1..]) {
            // Random samples would halve it; these do better at edges, which are most of it.
            assert!(*more < 0.55 * few, "{name}: {errors:?}");
        }
    }
}

/// The picture of [`Adaptive`] by its definition.
fn adaptive_by_definition<T: Scalar, const SAMPLES: usize>(
    tracer: &Tracer<'_, T>,
    threshold: T,
) -> Vec<(Color<T>, bool)> {
    let size = tracer.resolution();
    let inside = |x: i32, y: i32| {
        (0..size.width.into()).contains(&x) && (0..size.height.into()).contains(&y)
    };
    pixels(size)
        .map(|(x, y)| {
            let own = tracer.pixel(x, y);
            let (column, row) = (i32::from(x), i32::from(y));
            let neighbours = [
                (column + 1, row),
                (column - 1, row),
                (column, row + 1),
                (column, row - 1),
            ];
            let is_edge = neighbours.into_iter().any(|(x, y)| {
                inside(x, y) && differ(own, tracer.pixel(x as u16, y as u16), threshold)
            });
            if is_edge {
                let samples = Supersampled::<_, SAMPLES>::new(tracer);
                (color_of(&samples, (x, y)), true)
            } else {
                (own, false)
            }
        })
        .collect()
}

#[test]
fn edges_alone_have_more_samples() {
    let threshold = 1.0 / 16.0;
    for name in names() {
        let pools = load::<f32>(&name);
        let tracer = Tracer::new(pools.as_scene()).with_resolution(SIZE);
        let expected = adaptive_by_definition::<f32, 4>(&tracer, threshold);
        let mut centers = [CenterSample::EMPTY; 2 * SIZE.width as usize];
        let adaptive = Adaptive::<_, 4>::new(&tracer, threshold, &mut centers);
        let mut work = WorkCount::default();
        let mut row = None;
        for ((x, y), (color, _)) in pixels(SIZE).zip(&expected) {
            if x == 0 {
                row = Some(adaptive.scanline(y));
            }
            let pixel = adaptive.pixel_observed(row.as_ref().unwrap(), x, &mut work);
            assert_eq!(bits(pixel), bits(*color), "{name} {x},{y}");
        }
        // Row by row each centre is traced once.
        let edges = expected.iter().filter(|(_, is_edge)| *is_edge).count();
        assert_eq!(work.primary_rays as usize, expected.len() + 4 * edges);
        assert!((1..expected.len()).contains(&edges), "{name}: {edges}");
    }
}

#[test]
fn thresholds_at_their_ends() {
    let pools = load::<f32>("default");
    let tracer = Tracer::new(pools.as_scene()).with_resolution(SIZE);
    let same_as = |threshold: f32, expected: &dyn Fn((u16, u16)) -> Color| {
        let mut centers = [CenterSample::EMPTY; 2 * SIZE.width as usize];
        let adaptive = Adaptive::<_, 4>::new(&tracer, threshold, &mut centers);
        for pixel in pixels(SIZE) {
            let color = color_of(&adaptive, pixel);
            assert_eq!(bits(color), bits(expected(pixel)), "{threshold} {pixel:?}");
        }
    };
    let four = Supersampled::<_, 4>::new(&tracer);
    // No two channels differ by more than 1; all differ by more than a number below 0.
    same_as(1.0, &|pixel| color_of(&tracer, pixel));
    same_as(-1.0, &|pixel| color_of(&four, pixel));
}

#[test]
fn any_order_and_any_room_give_the_same_bits() {
    let random = Random::of_test(20_261_126);
    let pools = load::<f32>("default");
    let tracer = Tracer::new(pools.as_scene()).with_resolution(SIZE);
    let threshold = 1.0 / 32.0;
    let expected = adaptive_by_definition::<f32, 4>(&tracer, threshold);
    let width = usize::from(SIZE.width);
    for room in [0, 1, 2, 20, 2 * width - 2, 2 * width, 2 * width + 1, 999] {
        let mut centers = vec![CenterSample::EMPTY; room];
        let adaptive = Adaptive::<_, 4>::new(&tracer, threshold, &mut centers);
        let mut order: Vec<_> = pixels(SIZE).zip(&expected).collect();
        for shuffled in [false, true] {
            if shuffled {
                random.shuffle(&mut order);
            }
            for (pixel, (color, _)) in &order {
                let drawn = color_of(&adaptive, *pixel);
                assert_eq!(bits(drawn), bits(*color), "{room} {pixel:?}");
            }
        }
    }
}

/// Frames whose budgets end anywhere, some of them dropped and begun anew, have the bits of the pixels.
fn frames_have_the_bits_of_pixels<P: PixelSource>(source: P, fresh: impl Fn() -> P) {
    let random = Random::of_test(20_261_127);
    let expected: Picture<_, Exact<Rgb888>> = Picture::new(fresh());
    let picture: Picture<_, Exact<Rgb888>> = Picture::new(source);
    let mut row = [Rgb888::BLACK; SIZE.width as usize];
    let mut frame = Frame::of(&picture);
    let (mut rows, mut calls) = (0, 0);
    while frame.progress() != Progress::Done {
        calls += 1;
        let mut budget = Budget::Rays(random.below(400) as u32);
        if let Some((area, colors)) = frame.trace(&picture, &mut row, &mut budget) {
            rows += 1;
            for (point, color) in area.points().zip(colors) {
                let pixel = expected.pixel(point.x as u16, point.y as u16);
                assert_eq!(*color, pixel, "{point}");
            }
        }
    }
    assert_eq!(rows, SIZE.height);
    assert!(calls > 2 * rows, "{calls} instalments");
}

#[test]
fn instalments_give_the_same_bits() {
    let pools = load::<f32>("default");
    let tracer = Tracer::new(pools.as_scene()).with_resolution(SIZE);
    let four = || Supersampled::<_, 4>::new(tracer);
    frames_have_the_bits_of_pixels(four(), four);
    let adaptive = || {
        let centers = vec![CenterSample::EMPTY; 2 * usize::from(SIZE.width)];
        Adaptive::<_, 16>::new(tracer, 1.0 / 16.0, centers.leak())
    };
    frames_have_the_bits_of_pixels(adaptive(), adaptive);
}

#[test]
fn centers_of_another_scene_are_forgotten() {
    let (first, second) = (load::<f32>("default"), load::<f32>("pyramids"));
    let tracers =
        [first.as_scene(), second.as_scene()].map(|scene| Tracer::new(scene).with_resolution(SIZE));
    let mut centers = [CenterSample::EMPTY; 2 * SIZE.width as usize];
    for tracer in &tracers {
        let expected = adaptive_by_definition::<f32, 4>(tracer, 0.1);
        let adaptive = Adaptive::<_, 4>::new(tracer, 0.1, &mut centers);
        for (pixel, (color, _)) in pixels(SIZE).zip(expected) {
            assert_eq!(bits(color_of(&adaptive, pixel)), bits(color));
        }
    }
}

#[test]
fn a_picture_of_one_pixel_has_no_edges() {
    let pools = load::<f32>("default");
    let size = Resolution {
        width: 1,
        height: 1,
    };
    let tracer = Tracer::new(pools.as_scene()).with_resolution(size);
    let adaptive = Adaptive::<_, 64>::new(&tracer, 0.0, &mut []);
    assert_eq!(bits(color_of(&adaptive, (0, 0))), bits(tracer.pixel(0, 0)));
}
