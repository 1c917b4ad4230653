//! What excludes objects, lists of candidates, plane grids and the hierarchy, changes no bit of any picture: against every object
//! tested, over random scenes that are aimed at where it could.

use crate::common::random::Random;
use crate::common::random_texts::Writer;
use scanray::{Color, Scalar, ScenePools, Tracer, parser::FromDecimal};

type Pools<T, const BVH: usize> = ScenePools<T, 80, 80, 80, 80, 1, 32, BVH>;

fn bits<T: Scalar>(color: Color<T>) -> [u64; 3] {
    [color.r, color.g, color.b].map(|channel| channel.to_f64().to_bits())
}

/// Compares pictures of so many scenes.
fn compare<T: Scalar + FromDecimal>(seed: u64, scenes: usize) {
    let random = Random::of_test(seed);
    let mut pools = Box::new(Pools::<T, 80>::new());
    let mut compared = 0;
    let mut different = Vec::new();
    for round in 0..scenes {
        let writer = Writer {
            random: &random,
            extreme: [0, 0, 0, 20, 5][round % 5],
            scale: random.log_between(1e-2, 1e3),
            aimed: true,
        };
        let text = writer.scene();
        if pools.parse(text.as_bytes()).is_err() {
            continue;
        }
        compared += 1;
        let prepared = Tracer::new(pools.as_scene());
        let plain = Tracer::new(pools.as_scene().without_accel());
        let mut count = 0;
        for y in 0..3 {
            let (scanline, row) = (prepared.scanline(y), plain.scanline(y));
            for x in 0..4 {
                let ray = plain.primary_ray(&row, x);
                let is = prepared.pixel_observed(&scanline, x, &mut ());
                count += usize::from(bits(is) != bits(plain.radiance(ray)));
            }
        }
        if count > 0 {
            different.push((count, text));
        }
    }
    println!("{compared} scenes");
    assert!(compared > scenes / 4);
    for (count, text) in different.iter().take(8) {
        println!("{count} pixels:\n{text}");
    }
    assert!(different.is_empty(), "{} scenes", different.len());
}

#[test]
fn change_no_bit() {
    compare::<f32>(196, 10_000);
    compare::<f64>(197, 3_000);
}

/// `SCENES=2000000` makes it that many texts, of which nearly half are scenes.
#[test]
#[ignore = "takes long: .ci/run runs it"]
fn change_no_bit_of_many_scenes() {
    compare::<f32>(198, Random::count(100_000));
}
