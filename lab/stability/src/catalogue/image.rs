//! Cases 53 to 61: camera, picture, and changes of the whole scene that must not change it.

use std::ops::Range;

use embedded_graphics::pixelcolor::Rgb888;
use embedded_graphics::prelude::RgbColor;
use scanray::{Color, Picture, Resolution, Scalar, Tracer, Vec3};

use super::cases;
use super::record::{Colors, Record, Tier, scaled, vector};
use crate::Number;
use crate::reference::{Wide, narrow, ratio, wide};
use crate::scenes::{self, Model, Shape};
use crate::settled::bits;
use crate::textbook::Textbook;

cases! { Image:
    53 pictures_of_one_row_or_column: "drawn; one pixel looks straight ahead";
    54 picture_of_width_65535: "no overflow: directions as computed with 106 bits, the last pixels are drawn";
    55 telephoto_lens: "1e3: tier B; 1e5: tier C";
    56 field_of_view_of_179_9_degrees: "tier C";
    57 schedules: "whole, row by row, in bands, on any number of threads: the same bits";
    58 translation_of_the_scene: "by 1e3: tier B; by 1e5: tier C";
    59 scale_by_powers_of_two: "the same bits";
    60 mirror_in_x: "the mirrored bits";
    61 permuted_objects: "the same bits";
}

const SIZE: Resolution = Resolution {
    width: 80,
    height: 60,
};

/// Every scene of scenes/, taken apart. Building it again normalises the planes a second time, so that its
/// picture is compared with that of another built scene, not with that of the parsed one.
pub(super) fn models<T: Number>(size: Resolution) -> Vec<(String, Model<T>)> {
    scenes::names()
        .into_iter()
        .map(|name| {
            let mut model = Model::of(&scenes::load::<T>(&name).as_scene());
            model.resolution = size;
            (name, model)
        })
        .collect()
}

fn draw<T: Number>(record: &mut Record, model: &Model<T>) -> Colors<T> {
    let pools = model.build();
    record.draw(&Tracer::new(pools.as_scene()))
}

/// The picture by textbook forms.
fn draw_by_textbook<T: Number>(model: &Model<T>) -> Colors<T> {
    let pools = model.build();
    let tracer = Tracer::new(pools.as_scene());
    let textbook = Textbook::new(pools.as_scene(), tracer.max_depth());
    (0..SIZE.height)
        .flat_map(|y| (0..SIZE.width).map(move |x| (x, y)))
        .map(|(x, y)| textbook.radiance(&tracer.primary_ray(&tracer.scanline(y), x)))
        .collect()
}

pub(super) fn different<T: Scalar>(a: &[Color<T>], b: &[Color<T>]) -> u64 {
    assert_eq!(a.len(), b.len());
    a.iter()
        .zip(b)
        .filter(|(a, b)| bits(**a) != bits(**b))
        .count() as u64
}

fn pictures_of_one_row_or_column<T: Number>(record: &mut Record) {
    for (name, mut model) in models::<T>(SIZE) {
        for (width, height) in [(1, 1), (1, 2), (1, 97), (2, 1), (97, 1), (65_535, 1)] {
            model.resolution = Resolution { width, height };
            draw(record, &model);
            if (width, height) == (1, 1) {
                let pools = model.build();
                let tracer = Tracer::new(pools.as_scene());
                let ray = tracer.primary_ray(&tracer.scanline(0), 0);
                record.holds(
                    format!("{name}: the only pixel looks along z"),
                    ray.direction == vector(0.0, 0.0, 1.0),
                );
            }
        }
    }
}

fn picture_of_width_65535<T: Number>(record: &mut Record) {
    let largest = u16::MAX;
    let mut model = models::<T>(SIZE).remove(0).1;
    let (mut worst, mut of) = (0.0_f64, 0);
    for (width, height) in [(largest, largest), (largest, 1), (largest, 3), (5, largest)] {
        model.resolution = Resolution { width, height };
        let pools = model.build();
        let tracer = Tracer::new(pools.as_scene());
        let ends = |length: u16| [0, 1, length / 2, length.saturating_sub(2), length - 1];
        for y in ends(height).into_iter().filter(|y| *y < height) {
            for x in ends(width).into_iter().filter(|x| *x < width) {
                let ray = tracer.primary_ray(&tracer.scanline(y), x);
                let whole = |number: i64| Wide::from(number as f64);
                let (w, h) = (i64::from(width), i64::from(height));
                let exact = [
                    ratio(whole(2 * i64::from(x) + 1 - w), whole(h)),
                    ratio(whole(h - 1 - 2 * i64::from(y)), whole(h)),
                    Wide::from(1.0),
                ];
                let length = exact
                    .iter()
                    .fold(Wide::from(0.0), |sum, c| sum + *c * *c)
                    .sqrt();
                let actual = [ray.direction.x, ray.direction.y, ray.direction.z];
                for (a, e) in actual.into_iter().zip(exact) {
                    worst = worst.max(narrow((wide(a) - ratio(e, length)).abs()));
                }
                of += 1;
                record.see(&tracer, ray);
            }
        }
    }
    record.error(
        "direction off, in a component",
        worst,
        scaled::<T>(1.5e-7),
        of,
    );
}

/// The default scene seen from far away along z through a lens that shows it as large.
pub(crate) fn telephoto(times: f64) -> (Model<f64>, f64) {
    let mut model = models::<f64>(SIZE).remove(0).1;
    // The middle of the scene, which stays in place in the picture.
    const MIDDLE: f64 = 3.0;
    model.camera.z = MIDDLE - MIDDLE * times;
    // The sphere behind the usual camera is in the way of this one.
    model.parts.retain(|part| match part.shape {
        Shape::Sphere { center, .. } => center.z > 0.0,
        _ => true,
    });
    (model, 1.0 / times)
}

fn telephoto_lens<T: Number>(record: &mut Record) {
    for (times, tier) in [(1e3, Tier::B), (1e5, Tier::C)] {
        let (mut model, half_height) = telephoto(times);
        model.resolution = Resolution {
            width: 160,
            height: 120,
        };
        record.tier::<T, 5>(&model, half_height, tier, &format!("{times:.0e} times"));
    }
}

fn field_of_view_of_179_9_degrees<T: Number>(record: &mut Record) {
    let half_angle = 179.9_f64.to_radians() / 2.0;
    for (name, model) in models::<f64>(SIZE) {
        let half_height = libm::tan(half_angle);
        record.tier::<T, 5>(&model, half_height, Tier::C, &name);
    }
}

/// Pixels of the display's colours that another schedule draws differently.
fn schedules<T: Number>(record: &mut Record) {
    for (name, model) in models::<T>(SIZE) {
        let pools = model.build();
        let tracer = Tracer::new(pools.as_scene());
        let picture = Picture::new(&tracer);
        let whole: Vec<Rgb888> = (0..SIZE.height)
            .flat_map(|y| (0..SIZE.width).map(move |x| (x, y)))
            .map(|(x, y)| picture.pixel(x, y))
            .collect();
        let rows = |rows: Range<u16>| {
            let mut pixels = vec![Rgb888::BLACK; usize::from(SIZE.width) * rows.len()];
            for (y, row) in rows.zip(pixels.chunks_mut(usize::from(SIZE.width))) {
                // In two parts, right one first.
                let (left, right) = row.split_at_mut(31);
                picture.row(31, y, right);
                picture.row(0, y, left);
            }
            pixels
        };
        let bands = |bands: u16| {
            let edge = |band: u16| band * SIZE.height / bands;
            (0..bands)
                .map(|band| edge(band)..edge(band + 1))
                .collect::<Vec<_>>()
        };
        let mut wrong = 0;
        let mut of = 0;
        let mut compare = |pixels: Vec<Rgb888>| {
            wrong += pixels.iter().zip(&whole).filter(|(a, b)| a != b).count() as u64;
            wrong += u64::from(pixels.len() != whole.len());
            of += pixels.len() as u64;
        };
        compare(rows(0..SIZE.height));
        compare(bands(7).into_iter().flat_map(rows).collect());
        for threads in [1, 2, 3, 8] {
            let drawn = std::thread::scope(|scope| {
                let running: Vec<_> = bands(threads)
                    .into_iter()
                    .map(|band| scope.spawn(|| rows(band)))
                    .collect();
                let joined = running.into_iter().map(|thread| thread.join());
                joined
                    .flat_map(|pixels| pixels.expect("no panic"))
                    .collect()
            });
            compare(drawn);
        }
        record.count_in(&name, "pixels that differ", wrong, of);
    }
}

fn translation_of_the_scene<T: Number>(record: &mut Record) {
    let mut model = models::<f64>(SIZE).remove(0).1;
    model.resolution = Resolution {
        width: 160,
        height: 120,
    };
    for (by, tier) in [(1e3, Tier::B), (1e5, Tier::C)] {
        let moved = model.moved(Vec3::new(by, 0.7 * by, -0.4 * by));
        // As the scalar has the scene: how it rounds the numbers of a file is not the tracer's error.
        let moved = moved.rounded::<T>().rounded::<f64>();
        record.tier::<T, 5>(&moved, 1.0, tier, &format!("by {by:.0e}"));
    }
}

fn scale_by_powers_of_two<T: Number>(record: &mut Record) {
    let exponents: &[i32] = if T::NAME == f32::NAME {
        &[-30, -13, -5, -1, 1, 2, 13, 30]
    } else {
        &[-100, -13, -1, 13, 100]
    };
    let mut by_textbook = 0;
    for (name, model) in models::<T>(SIZE) {
        let expected = draw(record, &model);
        let (mut wrong, mut of) = (0, 0);
        let textbook = draw_by_textbook(&model);
        for &exponent in exponents {
            let factor = T::from_f64(2_f64.powi(exponent));
            let scaled = model.mapped(|point| point * factor, |normal| normal, factor);
            wrong += different(&draw(record, &scaled), &expected);
            of += expected.len() as u64;
            by_textbook += different(&draw_by_textbook(&scaled), &textbook);
        }
        record.count_in(&name, "pixels that differ", wrong, of);
    }
    record.textbook_share(by_textbook);
}

/// Mirroring swaps the sides of a triangle, which matters only where it bends rays.
fn bends_at_a_triangle<T: Scalar>(model: &Model<T>) -> bool {
    model.parts.iter().any(|part| {
        matches!(part.shape, Shape::Triangle(_))
            && part.material.refraction > T::ZERO
            && part.material.index_of_refraction != T::ONE
    })
}

fn mirror_in_x<T: Number>(record: &mut Record) {
    let flip = |v: Vec3<T>| Vec3::new(-v.x, v.y, v.z);
    let mut compared = 0;
    for (name, model) in models::<T>(SIZE) {
        if bends_at_a_triangle(&model) {
            continue;
        }
        compared += 1;
        let mut expected = draw(record, &model);
        for row in expected.chunks_mut(usize::from(SIZE.width)) {
            row.reverse();
        }
        let mirrored = draw(record, &model.mapped(flip, flip, T::ONE));
        let wrong = different(&mirrored, &expected);
        record.count_in(&name, "pixels that differ", wrong, expected.len() as u64);
    }
    record.holds(
        "no scene but those with bending triangles is left out",
        compared >= 5,
    );
}

fn permuted_objects<T: Number>(record: &mut Record) {
    let random = record.random(161);
    for (name, mut model) in models::<T>(SIZE) {
        let expected = draw(record, &model);
        let (mut wrong, mut of) = (0, 0);
        for round in 0..7 {
            if round == 0 {
                model.parts.reverse();
            } else {
                random.shuffle(&mut model.parts);
            }
            wrong += different(&draw(record, &model), &expected);
            of += expected.len() as u64;
        }
        record.count_in(&name, "pixels that differ", wrong, of);
    }
}
