//! The stiff and extreme cases that scanray is held to, measured.
//!
//! [`catalogue`] has the cases: each measures `f32` and `f64` and says what was found and what may be. The
//! tests in tests/numerics and the command `scanray stability` both ask here, so that a case is written once.
//! Around it are the instruments: seeded [`random`] numbers, [`scenes`] to change and build again,
//! [`settled`] pixels, a [`reference`](mod@reference) of higher precision, and the [`textbook`] forms that the
//! core's are compared with. [`pictures`] draws the telling cases.
//!
//! "Stiff" means two widely separated scales in one scene.

pub mod catalogue;
pub mod clear_misses;
pub mod pictures;
pub mod random;
pub mod reference;
pub mod scenes;
pub mod settled;
pub mod textbook;

use scanray::{FromDecimal, Scalar};

/// A scalar that cases are measured in.
pub trait Number: Scalar + FromDecimal {}

impl<T: Scalar + FromDecimal> Number for T {}
