//! A number of the core inside formulas.

use core::ops::{Add, Div, Mul, Neg, Sub};

use crate::color::Color;
use crate::number::Number;
use crate::scalar::Scalar;
use crate::vec3::Vec3;

/// A number of the core inside formulas. Its operators are those of `T`, or on cores without hardware for `T` the routines of
/// this crate, which have the same bits in a third of the instructions: an `f32`'s own operators would be the compiler's.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(transparent)]
pub struct Real<T>(pub T);

macro_rules! operator {
    ($trait:ident, $method:ident, $routine:ident) => {
        impl<T: Scalar> $trait for Real<T> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Self(self.0.$routine(other.0))
            }
        }
    };
}

operator!(Add, add, plus);
operator!(Sub, sub, minus);
operator!(Mul, mul, times);
operator!(Div, div, over);

impl<T: Scalar> Neg for Real<T> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl<T: Scalar> Number for Real<T> {
    const ULP: f64 = T::ULP;
    const SPLIT: f64 = T::SPLIT;

    #[inline(always)]
    fn constant(self, value: f64) -> Self {
        Self(T::from_f64(value))
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(Number::sqrt(self.0))
    }

    #[inline(always)]
    fn abs(self) -> Self {
        Self(Number::abs(self.0))
    }

    #[inline(always)]
    fn if_zero(self, then: Self, otherwise: Self) -> Self {
        if self.0.is_zero() { then } else { otherwise }
    }

    #[inline(always)]
    fn double(self) -> Self {
        Self(self.0.double())
    }

    #[inline(always)]
    fn halve(self) -> Self {
        Self(self.0.halve())
    }

    #[inline(always)]
    fn along([x, y, z]: [Self; 3], [ux, uy, uz]: [Self; 3]) -> Self {
        let unit = Vec3::new(ux.0, uy.0, uz.0);
        Self(Vec3::new(x.0, y.0, z.0).component_along(unit))
    }

    #[inline(always)]
    fn moved([x, y, z]: [Self; 3], [ux, uy, uz]: [Self; 3], distance: Self) -> [Self; 3] {
        let unit = Vec3::new(ux.0, uy.0, uz.0);
        let Vec3 { x, y, z } = Vec3::new(x.0, y.0, z.0).moved_along(unit, distance.0);
        [Self(x), Self(y), Self(z)]
    }

    #[inline(always)]
    fn is_surely_one(self) -> bool {
        T::EMULATED && self.0.is_one()
    }

    #[inline(always)]
    fn are_surely_same([r, g, b]: [Self; 3]) -> bool {
        T::EMULATED && r.0.is_same(g.0) && r.0.is_same(b.0)
    }
}

impl<T: Scalar> Vec3<T> {
    /// The vector for formulas.
    #[inline(always)]
    pub fn real(self) -> Vec3<Real<T>> {
        Vec3::new(Real(self.x), Real(self.y), Real(self.z))
    }
}

impl<T: Scalar> Vec3<Real<T>> {
    /// The vector of the scene.
    #[inline(always)]
    pub fn plain(self) -> Vec3<T> {
        Vec3::new(self.x.0, self.y.0, self.z.0)
    }
}

impl<T: Scalar> Color<T> {
    /// The colour for formulas.
    #[inline(always)]
    pub fn real(self) -> Color<Real<T>> {
        Color::new(Real(self.r), Real(self.g), Real(self.b))
    }
}

impl<T: Scalar> Color<Real<T>> {
    /// The colour of the scene.
    #[inline(always)]
    pub fn plain(self) -> Color<T> {
        Color::new(self.r.0, self.g.0, self.b.0)
    }
}
