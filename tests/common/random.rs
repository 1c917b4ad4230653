//! Reproducible random numbers.

use std::cell::Cell;

use scanray::{Scalar, Vec3};

/// The generator splitmix64; shared, so that a random number may be made from others.
#[derive(Debug)]
pub(crate) struct Random(Cell<u64>);

impl Random {
    /// The generator of a test: prints its seed, which a failed test shows, and takes it from `SEED` to
    /// try others.
    pub(crate) fn of_test(default_seed: u64) -> Self {
        let seed = match std::env::var("SEED") {
            Ok(seed) => seed.parse().expect("SEED is a whole number"),
            Err(_) => default_seed,
        };
        println!("random seed: {seed} (SEED={seed} repeats this run)");
        Self(Cell::new(seed))
    }

    pub(crate) fn bits(&self) -> u64 {
        let state = self.0.get().wrapping_add(0x9e37_79b9_7f4a_7c15);
        self.0.set(state);
        let z = (state ^ (state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// A whole number from 0 to `end − 1`.
    pub(crate) fn below(&self, end: usize) -> usize {
        (self.bits() % end as u64) as usize
    }

    /// Evenly spread over `low..high`.
    pub(crate) fn between(&self, low: f64, high: f64) -> f64 {
        low + (high - low) * (self.bits() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// With the logarithm evenly spread over `low..high`, which are positive.
    pub(crate) fn log_between(&self, low: f64, high: f64) -> f64 {
        self.between(low.ln(), high.ln()).exp()
    }

    pub(crate) fn sign(&self) -> f64 {
        if self.bits() & 1 == 0 { 1.0 } else { -1.0 }
    }

    /// A point with coordinates of up to `extent`.
    pub(crate) fn point<T: Scalar>(&self, extent: f64) -> Vec3<T> {
        let coordinate = || T::from_f64(self.between(-extent, extent));
        Vec3::new(coordinate(), coordinate(), coordinate())
    }

    /// A unit vector of any direction.
    pub(crate) fn direction<T: Scalar>(&self) -> Vec3<T> {
        loop {
            let v: Vec3<f64> = self.point(1.0);
            let squared = v.dot(v);
            if (1e-4..=1.0).contains(&squared) {
                let unit = v.normalize();
                return Vec3::new(
                    T::from_f64(unit.x),
                    T::from_f64(unit.y),
                    T::from_f64(unit.z),
                )
                .normalize();
            }
        }
    }

    /// Puts the elements in a random order.
    pub(crate) fn shuffle<E>(&self, elements: &mut [E]) {
        for end in (2..=elements.len()).rev() {
            elements.swap(end - 1, self.below(end));
        }
    }
}
