//! Point lights.

use crate::color::Color;
use crate::vec3::Vec3;

/// A point light without falloff.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Light<T = f32> {
    /// Where it is. (The paper's "direction" is used as this position.)
    pub position: Vec3<T>,
    /// Intensity of highlights.
    pub specular: Color<T>,
    /// Intensity of diffuse light.
    pub diffuse: Color<T>,
}

impl<T: crate::scalar::Scalar> Light<T> {
    /// White light of intensity 1 at the origin.
    pub const WHITE: Self = Self {
        position: Vec3::new(T::ZERO, T::ZERO, T::ZERO),
        specular: Color::new(T::ONE, T::ONE, T::ONE),
        diffuse: Color::new(T::ONE, T::ONE, T::ONE),
    };
}
