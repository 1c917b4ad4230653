//! Reproducible random numbers.

use std::cell::Cell;

use scanray::{Scalar, Vec3};

/// The generator splitmix64; shared, so that a random number may be made from others.
#[derive(Debug)]
pub struct Random(Cell<u64>);

impl Random {
    /// The generator of a test: prints its seed, which a failed test shows, and takes it from `SEED` to
    /// try others.
    pub fn of_test(default_seed: u64) -> Self {
        let seed = Self::seed(default_seed);
        println!("random seed: {seed} (SEED={seed} repeats this run)");
        Self::seeded(seed)
    }

    /// The seed that the environment variable `SEED` names, or else the default.
    ///
    /// # Panics
    ///
    /// When it names none: [`Random::named_seed`] tells before.
    pub fn seed(default: u64) -> u64 {
        match Self::named_seed() {
            Ok(seed) => seed.unwrap_or(default),
            Err(why) => panic!("{why}"),
        }
    }

    /// The seed that the environment variable `SEED` names, if it is set.
    ///
    /// # Errors
    ///
    /// A sentence, when it is no seed.
    pub fn named_seed() -> Result<Option<u64>, String> {
        let Some(word) = std::env::var_os("SEED") else {
            return Ok(None);
        };
        let word = word.to_string_lossy();
        word.parse().map(Some).map_err(|_| {
            format!(
                "SEED is `{word}`: give it a whole number from 0 to {}, or unset it",
                u64::MAX
            )
        })
    }

    /// How many rounds a long test takes: what the environment variable `SCENES` says, or else the default.
    ///
    /// # Panics
    ///
    /// When it says no number.
    pub fn count(default: usize) -> usize {
        std::env::var("SCENES").map_or(default, |word| {
            word.parse().unwrap_or_else(|_| {
                panic!("SCENES is `{word}`: give it a whole number, or unset it")
            })
        })
    }

    /// The generator of a seed.
    pub fn seeded(seed: u64) -> Self {
        Self(Cell::new(seed))
    }

    /// 64 random bits.
    pub fn bits(&self) -> u64 {
        let state = self.0.get().wrapping_add(0x9e37_79b9_7f4a_7c15);
        self.0.set(state);
        let z = (state ^ (state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// A whole number from 0 to `end − 1`.
    pub fn below(&self, end: usize) -> usize {
        (self.bits() % end as u64) as usize
    }

    /// Evenly spread over `low..high`.
    pub fn between(&self, low: f64, high: f64) -> f64 {
        low + (high - low) * (self.bits() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// With the logarithm evenly spread over `low..high`, which are positive.
    pub fn log_between(&self, low: f64, high: f64) -> f64 {
        // Not the platform's functions, so that a seed means the same numbers everywhere.
        libm::exp(self.between(libm::log(low), libm::log(high)))
    }

    /// 1 or −1.
    pub fn sign(&self) -> f64 {
        if self.bits() & 1 == 0 { 1.0 } else { -1.0 }
    }

    /// A point with coordinates of up to `extent`.
    pub fn point<T: Scalar>(&self, extent: f64) -> Vec3<T> {
        let coordinate = || T::from_f64(self.between(-extent, extent));
        Vec3::new(coordinate(), coordinate(), coordinate())
    }

    /// A unit vector of any direction.
    pub fn direction<T: Scalar>(&self) -> Vec3<T> {
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
    pub fn shuffle<E>(&self, elements: &mut [E]) {
        for end in (2..=elements.len()).rev() {
            elements.swap(end - 1, self.below(end));
        }
    }
}
