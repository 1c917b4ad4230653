//! What a ray sees that hits nothing.

use crate::color::Color;
use crate::formula::shading;
use crate::real::Real;
use crate::scalar::Scalar;
use crate::vec3::Vec3;

/// Background of a scene.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Background<T = f32> {
    /// The colour where there is no sky.
    pub color: Color<T>,
    /// Show the sky gradient instead of the colour.
    pub sky: bool,
}

impl<T: Scalar> Background<T> {
    /// The sky in a direction of length 1: white at the nadir, (½, 0.7, 1) at the zenith.
    #[inline(always)]
    pub fn sky(direction: Vec3<T>) -> Color<T> {
        shading::sky(Real(direction.y)).plain()
    }
}
