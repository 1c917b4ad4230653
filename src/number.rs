//! Numbers that formulas are written over.

use core::ops::{Add, Div, Mul, Neg, Sub};

/// A number, or several side by side: the arithmetic that formulas are written with, `+ − × ÷ √` alone, correctly rounded.
///
/// A formula over it stands once, for `f32`, `f64`, [`Real`](crate::real::Real) and any number of lanes: each does the same
/// operations in the same order and so has the same bits. Branches are not formulas; they stay with whoever calls them.
pub trait Number:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// The distance from 1 to the next larger number.
    const ULP: f64;

    /// `2^⌈p/2⌉ + 1` for a significand of `p` bits: Dekker's constant that splits a number in halves.
    const SPLIT: f64;

    /// A constant, rounded to such a number.
    fn constant(self, value: f64) -> Self;

    /// Correctly rounded square root; NaN below zero.
    fn sqrt(self) -> Self;

    /// Absolute value.
    fn abs(self) -> Self;

    /// `then` where `self` is 0, or else `otherwise`.
    fn if_zero(self, then: Self, otherwise: Self) -> Self;

    /// `2·self`.
    #[inline(always)]
    fn double(self) -> Self {
        self * self.constant(2.0)
    }

    /// `½·self`.
    #[inline(always)]
    fn halve(self) -> Self {
        self * self.constant(0.5)
    }

    /// What `+` of components does.
    #[inline(always)]
    fn plus(self, other: Self) -> Self {
        self + other
    }

    /// What `−` of components does.
    #[inline(always)]
    fn minus(self, other: Self) -> Self {
        self - other
    }

    /// What `×` of components does.
    #[inline(always)]
    fn times(self, other: Self) -> Self {
        self * other
    }

    /// What `÷` of components does.
    #[inline(always)]
    fn over(self, other: Self) -> Self {
        self / other
    }

    /// `a·b`, summed from left to right.
    #[inline(always)]
    fn dot(a: [Self; 3], b: [Self; 3]) -> Self {
        let ([ax, ay, az], [bx, by, bz]) = (a, b);
        ax.times(bx).plus(ay.times(by)).plus(az.times(bz))
    }

    /// `unit·v` for a vector of length 1, up to the sign of a zero.
    #[inline(always)]
    fn along(v: [Self; 3], unit: [Self; 3]) -> Self {
        Self::dot(unit, v)
    }

    /// `v + unit·distance` for a vector of length 1.
    #[inline(always)]
    fn moved(v: [Self; 3], unit: [Self; 3], distance: Self) -> [Self; 3] {
        let ([x, y, z], [ux, uy, uz]) = (v, unit);
        [
            x.plus(ux.times(distance)),
            y.plus(uy.times(distance)),
            z.plus(uz.times(distance)),
        ]
    }

    /// It is known to be 1 and a product with it need not be computed: never said where computing is as fast as asking.
    #[inline(always)]
    fn is_surely_one(self) -> bool {
        false
    }

    /// The three have the same bits, and one product stands for those of all: never said where computing is as fast as asking.
    #[inline(always)]
    fn are_surely_same(_: [Self; 3]) -> bool {
        false
    }
}
