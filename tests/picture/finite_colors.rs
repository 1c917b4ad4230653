//! No colour on the way to a pixel is infinite or not a number, whatever scene a text describes: looked at before it is
//! limited to 0…1.

use crate::common::random::Random;
use crate::common::random_texts::Writer;
use scanray::parser::FromDecimal;
use scanray::tracer::{LightAtHit, Observer};
use scanray::{Color, Scalar, ScenePools, Tracer};

type Pools<T> = ScenePools<T, 8, 8, 8, 16, 1, 16>;

/// Colours that are none.
#[derive(Default)]
struct Finite {
    looked_at: u64,
    wrong: u64,
}

impl Finite {
    fn look<T: Scalar>(&mut self, color: Color<T>) {
        self.looked_at += 1;
        let is_finite = color.r.is_finite() && color.g.is_finite() && color.b.is_finite();
        self.wrong += u64::from(!is_finite);
    }
}

impl<T: Scalar> Observer<T> for Finite {
    fn local_color(&mut self, color: Color<T>) {
        self.look(color);
    }

    fn light(&mut self, at: LightAtHit<T>) {
        if let LightAtHit::Reaches { diffuse, specular } = at {
            self.look(diffuse);
            specular.into_iter().for_each(|color| self.look(color));
        }
    }

    fn sum(&mut self, color: Color<T>) {
        self.look(color);
    }
}

fn random_scenes<T: Scalar + FromDecimal>(seed: u64, scenes: usize) {
    let random = Random::of_test(seed);
    let mut pools = Box::new(Pools::<T>::new());
    let (mut parsed, mut looked_at) = (0, 0);
    let mut wrong = Vec::new();
    for round in 0..scenes {
        let writer = Writer {
            random: &random,
            extreme: [0, 0, 3, 10, 40][round % 5],
            scale: random.log_between(1e-3, 1e5),
            aimed: round % 2 == 0,
        };
        let text = writer.scene();
        if pools.parse(text.as_bytes()).is_err() {
            continue;
        }
        parsed += 1;
        let tracer = Tracer::new(pools.as_scene());
        let mut finite = Finite::default();
        for y in 0..3 {
            let scanline = tracer.scanline(y);
            for x in 0..4 {
                tracer.pixel_observed(&scanline, x, &mut finite);
            }
        }
        looked_at += finite.looked_at;
        if finite.wrong > 0 {
            wrong.push((writer.extreme, finite.wrong, text));
        }
    }
    println!("{parsed} of {scenes} texts are scenes; {looked_at} colours");
    assert!(parsed > scenes / 3 && looked_at > 3 * parsed as u64);
    for (extreme, count, text) in wrong.iter().take(5) {
        println!("{count} colours, one number in {extreme} extreme:\n{text}");
    }
    let ordinary = wrong.iter().filter(|(extreme, ..)| *extreme == 0).count();
    assert!(
        wrong.is_empty(),
        "{} scenes of {}, {ordinary} of them ordinary",
        wrong.len(),
        T::NAME
    );
}

#[test]
fn of_random_scenes() {
    random_scenes::<f32>(191, 20_000);
    random_scenes::<f64>(192, 5_000);
}

/// `SCENES=900000` makes it that many texts, of which more than a third are scenes.
#[test]
#[ignore = "takes long: .ci/run runs it"]
fn of_many_random_scenes() {
    random_scenes::<f32>(193, Random::count(100_000));
}
