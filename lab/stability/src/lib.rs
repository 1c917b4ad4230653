//! The stiff and extreme cases that scanray is held to, measured.
//!
//! [`catalogue`] has the cases: each measures `f32` and `f64` and says what was found and what may be. The
//! tests in tests/numerics and the command `scanray stability` both ask here, so that a case is written once.
//! Around it are the instruments: seeded [`random`] numbers, [`scenes`] to change and build again,
//! [`settled`] pixels, a [`reference`](mod@reference) of higher precision, and the [`textbook`] forms that the
//! core's are compared with. [`pictures`] draws the telling cases.
//!
//! "Stiff" means two widely separated scales in one scene.

// Files of tests/common are those that the core's own tests use, too: the core can be tested without this crate.
mod boards;
pub mod catalogue;
pub mod pictures;
#[path = "../../../tests/common/quick_reject.rs"]
pub mod quick_reject;
#[path = "../../../tests/common/random.rs"]
pub mod random;
pub mod reference;
#[path = "../../../tests/common/scenes.rs"]
pub mod scenes;
#[path = "../../../tests/common/settled.rs"]
pub mod settled;
pub mod textbook;

use scanray::{Scalar, parser::FromDecimal};

/// A scalar that cases are measured in.
pub trait Number: Scalar + FromDecimal {}

impl<T: Scalar + FromDecimal> Number for T {}
