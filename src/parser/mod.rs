//! Scene text, into pools.

mod decimal;
mod error;
mod lexeme;
mod numeric_dialect;

pub use decimal::{DecimalError, FromDecimal};
pub use error::{Excerpt, Expected, Found, ParseError, Range};

use crate::pools::{Declared, PoolsMut, ScenePools};
use crate::scalar::Scalar;

/// What is worth knowing about a scene that was accepted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Report {
    /// Warning: the line whose light had 8 numbers instead of 9, so that the last was used twice.
    pub short_light_line: Option<u32>,
}

impl<T: Scalar + FromDecimal, D: Declared> PoolsMut<'_, T, D> {
    /// Replaces the scene in the pools by that of a text in the numeric dialect.
    ///
    /// # Errors
    ///
    /// [`ParseError`] for the first thing that is wrong; the pools are then empty.
    pub fn parse(&mut self, text: &[u8]) -> Result<Report, ParseError> {
        let report = self.read(text)?;
        self.prepare();
        Ok(report)
    }

    fn read(&mut self, text: &[u8]) -> Result<Report, ParseError> {
        self.clear();
        let result = numeric_dialect::read(text, self);
        if result.is_err() {
            self.clear();
        }
        result
    }
}

impl<
    T: Scalar + FromDecimal,
    const SPHERES: usize,
    const PLANES: usize,
    const TRIANGLES: usize,
    const MATERIALS: usize,
    const LIGHTS: usize,
    const SIDES: usize,
    const BVH: usize,
> ScenePools<T, SPHERES, PLANES, TRIANGLES, MATERIALS, LIGHTS, SIDES, BVH>
{
    /// Replaces the scene in the pools by that of a text in the numeric dialect.
    ///
    /// # Errors
    ///
    /// [`ParseError`] for the first thing that is wrong; the pools are then empty. To keep an old
    /// picture until a new scene is known to be good, load into a second set of pools.
    pub fn parse(&mut self, text: &[u8]) -> Result<Report, ParseError> {
        let report = self.as_mut().read(text)?;
        self.prepare();
        Ok(report)
    }
}
