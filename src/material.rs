//! What a surface is made of.

use crate::color::Color;
use crate::real::Real;
use crate::scalar::Scalar;

/// The numbers that describe a material, as scene text gives them. All are ≥ 0; only the index of
/// refraction may be 0, and only without refraction.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MaterialDescription<T = f32> {
    /// Share of diffusely reflected light.
    pub diffuse: Color<T>,
    /// Strength of the highlight.
    pub specular: Color<T>,
    /// Share of the ambient light.
    pub ambient: Color<T>,
    /// Share of the mirror ray's colour; 0 casts none.
    pub reflection: T,
    /// Exponent of the highlight: larger is sharper.
    pub shininess: T,
    /// Share of the refracted ray's colour; 0 casts none.
    pub refraction: T,
    /// Index of refraction; exactly 1 casts no shadow and passes rays straight through.
    pub index_of_refraction: T,
}

/// A material with the values that rendering derives from its description.
///
/// Invariants: `inverse_index` is `1/n` and `bend` is `n² − 1` of the index of refraction `n` of a material
/// that refracts; `whole_shininess` is the shininess if that is a whole number that repeated squaring may
/// raise, else [`Material::FRACTIONAL`]; `faint_alignment` is 0 or belongs to a scene's lights, and is used only
/// where [`Accel`](crate::accel::Accel) says that it does to this one's.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Material<T = f32> {
    description: MaterialDescription<T>,
    inverse_index: T,
    bend: T,
    whole_shininess: u16,
    faint_alignment: i16,
}

/// One way through a surface: the arguments of [`crate::Vec3::refract`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Interface<T = f32> {
    /// Index on the ray's side divided by the index beyond.
    pub eta: T,
    /// `1/eta² − 1`.
    pub bend: T,
}

impl<T: Scalar> Material<T> {
    /// [`Material::whole_shininess`] of a shininess that is fractional or very large.
    pub const FRACTIONAL: u16 = u16::MAX;

    /// A material; computes what rendering needs.
    pub fn new(description: MaterialDescription<T>) -> Self {
        let index = description.index_of_refraction;
        let (inverse_index, bend) = if description.refraction > T::ZERO {
            // (n − 1)(n + 1) keeps all digits where n² − 1 would cancel.
            (T::ONE / index, (index - T::ONE) * (index + T::ONE))
        } else {
            (T::ZERO, T::ZERO)
        };
        let whole = description.shininess.to_u32();
        let is_whole = whole <= u32::from(T::MAX_SQUARED_EXPONENT)
            && T::from_i32(whole as i32) == description.shininess;
        let whole_shininess = if is_whole {
            whole as u16
        } else {
            Self::FRACTIONAL
        };
        Self::from_parts(description, inverse_index, bend, whole_shininess, 0)
    }

    /// A material from values that [`Material::new`] has computed: for baked scenes.
    pub const fn from_parts(
        description: MaterialDescription<T>,
        inverse_index: T,
        bend: T,
        whole_shininess: u16,
        faint_alignment: i16,
    ) -> Self {
        Self {
            description,
            inverse_index,
            bend,
            whole_shininess,
            faint_alignment,
        }
    }

    pub(crate) fn set_faint_alignment(&mut self, alignment: i16) {
        self.faint_alignment = alignment;
    }

    /// The numbers it was made from.
    #[inline(always)]
    pub const fn description(&self) -> &MaterialDescription<T> {
        &self.description
    }

    /// Inverse of the index of refraction; 0 without refraction.
    pub const fn inverse_index(&self) -> T {
        self.inverse_index
    }

    /// Square of the index of refraction, less 1; 0 without refraction.
    pub const fn bend(&self) -> T {
        self.bend
    }

    /// For a ray that hits the side its geometric normal points to.
    #[inline(always)]
    pub fn entering(&self) -> Interface<T> {
        Interface {
            eta: self.inverse_index,
            bend: self.bend,
        }
    }

    /// For a ray that comes from behind the surface.
    #[inline(always)]
    pub fn leaving(&self) -> Interface<T> {
        Interface {
            eta: self.description.index_of_refraction,
            bend: (-Real(self.bend) * Real(self.inverse_index) * Real(self.inverse_index)).0,
        }
    }

    /// The shininess as a whole exponent, or [`Material::FRACTIONAL`].
    pub const fn whole_shininess(&self) -> u16 {
        self.whole_shininess
    }

    /// The [`Scalar::upper_half`] of a number below which the alignment of view and mirrored light adds no highlight
    /// that changes a colour, with the ambient light and the lights of the scene; 0 if that is not known.
    #[inline(always)]
    pub const fn faint_alignment(&self) -> i16 {
        self.faint_alignment
    }

    /// Objects with an index of refraction of exactly 1 let all light pass.
    #[inline(always)]
    pub fn casts_shadow(&self) -> bool {
        !self.description.index_of_refraction.is_one()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn knows_whole_exponents() {
        let whole = |shininess: f32| {
            Material::new(MaterialDescription {
                shininess,
                ..Default::default()
            })
            .whole_shininess()
        };
        assert_eq!(whole(0.0), 0);
        assert_eq!(whole(50.0), 50);
        assert_eq!(whole(1024.0), 1024);
        assert_eq!(whole(1025.0), Material::<f32>::FRACTIONAL);
        assert_eq!(whole(50.5), Material::<f32>::FRACTIONAL);
        assert_eq!(whole(1e30), Material::<f32>::FRACTIONAL);
    }
}
