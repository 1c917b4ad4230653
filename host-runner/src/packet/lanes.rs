//! Numbers of eight lanes, one for each of eight rays: what the core's formulas are called with here.
//!
//! Every operation is the same IEEE operation as in the core, so that a lane holds the same bits: never
//! `mul_add`, never an approximate reciprocal, and no minimum or maximum where the NaN that they give, which depends on the
//! machine, would matter.
//!
//! Everything that holds vectors is a function with `#[inline(always)]`, here, in the core's formulas and in the
//! modules that use this one: only what is inlined into [`Simd::vectorize`] is compiled for the level of vector
//! instructions. A closure may be left outside, and is then slow.

use std::ops::{Add, Div, Index, Mul, Neg, Sub};

use fearless_simd::prelude::*;
use fearless_simd::{f32x8, mask32x8, u32x8};
use scanray::{Color, Scalar, Vec3, formula, number::Number};

/// Rays that are traced together.
pub(super) const LANES: usize = 8;

/// A number for each lane.
#[derive(Clone, Copy)]
pub(super) struct Numbers<S: Simd>(pub(super) f32x8<S>);

/// A whole number for each lane.
pub(super) type Indices<S> = u32x8<S>;
/// Yes or no for each lane.
pub(super) type Mask<S> = mask32x8<S>;
/// A vector or a point for each lane.
pub(super) type Vec3s<S> = Vec3<Numbers<S>>;
/// A colour for each lane.
pub(super) type Colors<S> = Color<Numbers<S>>;

macro_rules! operator {
    ($trait:ident, $method:ident, $operator:tt) => {
        impl<S: Simd> $trait for Numbers<S> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Self(self.0 $operator other.0)
            }
        }
    };
}

operator!(Add, add, +);
operator!(Sub, sub, -);
operator!(Mul, mul, *);
operator!(Div, div, /);

impl<S: Simd> Neg for Numbers<S> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl<S: Simd> Number for Numbers<S> {
    const ULP: f64 = <f32 as Number>::ULP;
    const SPLIT: f64 = <f32 as Number>::SPLIT;

    #[inline(always)]
    fn constant(self, value: f64) -> Self {
        Self::splat(self.0.simd, value as f32)
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(self.0.sqrt())
    }

    #[inline(always)]
    fn abs(self) -> Self {
        Self(self.0.abs())
    }

    #[inline(always)]
    fn if_zero(self, then: Self, otherwise: Self) -> Self {
        Self::select(self.simd_eq(0.0), then, otherwise)
    }
}

/// What numbers are compared with: a number for each lane, or one for all.
pub(super) trait Comparand<S: Simd> {
    fn in_lanes(self, simd: S) -> f32x8<S>;
}

impl<S: Simd> Comparand<S> for Numbers<S> {
    #[inline(always)]
    fn in_lanes(self, _: S) -> f32x8<S> {
        self.0
    }
}

impl<S: Simd> Comparand<S> for f32 {
    #[inline(always)]
    fn in_lanes(self, simd: S) -> f32x8<S> {
        f32x8::splat(simd, self)
    }
}

macro_rules! comparisons {
    ($($name:ident)*) => {
        $(
            #[inline(always)]
            pub(super) fn $name(self, other: impl Comparand<S>) -> Mask<S> {
                self.0.$name(other.in_lanes(self.0.simd))
            }
        )*
    };
}

impl<S: Simd> Numbers<S> {
    comparisons!(simd_eq simd_lt simd_le simd_gt simd_ge);

    #[inline(always)]
    pub(super) fn splat(simd: S, number: f32) -> Self {
        Self(f32x8::splat(simd, number))
    }

    #[inline(always)]
    pub(super) fn from_array(simd: S, numbers: [f32; LANES]) -> Self {
        Self(f32x8::simd_from(simd, numbers))
    }

    #[inline(always)]
    pub(super) fn from_fn(simd: S, number: impl FnMut(usize) -> f32) -> Self {
        Self(f32x8::from_fn(simd, number))
    }

    #[inline(always)]
    pub(super) fn to_array(self) -> [f32; LANES] {
        self.0.into()
    }

    #[inline(always)]
    pub(super) fn from_slice(simd: S, numbers: &[f32]) -> Self {
        Self(f32x8::from_slice(simd, numbers))
    }

    #[inline(always)]
    pub(super) fn store_slice(self, numbers: &mut [f32]) {
        self.0.store_slice(numbers);
    }

    /// The smaller of two, one of them if one is NaN.
    #[inline(always)]
    pub(super) fn min(self, other: Self) -> Self {
        Self(self.0.min(other.0))
    }

    /// The larger of two, one of them if one is NaN.
    #[inline(always)]
    pub(super) fn max(self, other: Self) -> Self {
        Self(self.0.max(other.0))
    }

    /// `Scalar::clamp01`.
    #[inline(always)]
    fn clamp01(self) -> Self {
        let (zero, one) = (self.constant(0.0), self.constant(1.0));
        let below_one = Self::select(self.simd_lt(one), self, one);
        Self::select(self.simd_gt(zero), below_one, zero)
    }

    /// `Scalar::powf`, lane by lane.
    #[inline(always)]
    pub(super) fn powf(self, exponent: f32) -> Self {
        let mut powers = self.to_array();
        for power in &mut powers {
            *power = Scalar::powf(*power, exponent);
        }
        Self::from_array(self.0.simd, powers)
    }
}

impl<S: Simd> Index<usize> for Numbers<S> {
    type Output = f32;
    #[inline(always)]
    fn index(&self, lane: usize) -> &f32 {
        &self.0[lane]
    }
}

/// What has a value in each lane.
pub(super) trait InLanes<S: Simd>: Copy {
    /// The value of a lane.
    type One: Copy;

    /// The same in every lane.
    fn in_every_lane(simd: S, one: Self::One) -> Self;

    /// The value of a lane.
    fn lane(&self, lane: usize) -> Self::One;

    /// One of two in each lane.
    fn select(mask: Mask<S>, a: Self, b: Self) -> Self;
}

impl<S: Simd> InLanes<S> for Numbers<S> {
    type One = f32;

    #[inline(always)]
    fn in_every_lane(simd: S, one: f32) -> Self {
        Self::splat(simd, one)
    }

    #[inline(always)]
    fn lane(&self, lane: usize) -> f32 {
        self[lane]
    }

    #[inline(always)]
    fn select(mask: Mask<S>, a: Self, b: Self) -> Self {
        Self(mask.select(a.0, b.0))
    }
}

/// Three numbers for each lane.
pub(super) trait Three<S: Simd>: InLanes<S> {
    fn from_three(three: [Numbers<S>; 3]) -> Self;

    fn three(self) -> [Numbers<S>; 3];
}

macro_rules! three {
    ($type:ident, $x:ident, $y:ident, $z:ident) => {
        impl<S: Simd> Three<S> for $type<Numbers<S>> {
            #[inline(always)]
            fn from_three([x, y, z]: [Numbers<S>; 3]) -> Self {
                Self::new(x, y, z)
            }

            #[inline(always)]
            fn three(self) -> [Numbers<S>; 3] {
                [self.$x, self.$y, self.$z]
            }
        }

        impl<S: Simd> InLanes<S> for $type<Numbers<S>> {
            type One = $type;

            #[inline(always)]
            fn in_every_lane(simd: S, one: $type) -> Self {
                Self::new(
                    Numbers::splat(simd, one.$x),
                    Numbers::splat(simd, one.$y),
                    Numbers::splat(simd, one.$z),
                )
            }

            #[inline(always)]
            fn lane(&self, lane: usize) -> $type {
                $type::new(self.$x[lane], self.$y[lane], self.$z[lane])
            }

            #[inline(always)]
            fn select(mask: Mask<S>, a: Self, b: Self) -> Self {
                Self::new(
                    Numbers::select(mask, a.$x, b.$x),
                    Numbers::select(mask, a.$y, b.$y),
                    Numbers::select(mask, a.$z, b.$z),
                )
            }
        }
    };
}

three!(Vec3, x, y, z);
three!(Color, r, g, b);

/// `Color::clamp`.
#[inline(always)]
pub(super) fn clamp<S: Simd>(color: Colors<S>) -> Colors<S> {
    Color::new(color.r.clamp01(), color.g.clamp01(), color.b.clamp01())
}

/// Eight rays.
#[derive(Clone, Copy)]
pub(super) struct Rays<S: Simd> {
    pub(super) origin: Vec3s<S>,
    pub(super) direction: Vec3s<S>,
}

impl<S: Simd> Rays<S> {
    /// `Ray::at`.
    #[inline(always)]
    pub(super) fn at(&self, t: Numbers<S>) -> Vec3s<S> {
        formula::at(self.origin, self.direction, t)
    }
}

/// The first `count` lanes.
#[inline(always)]
pub(super) fn first_lanes<S: Simd>(simd: S, count: usize) -> Mask<S> {
    Mask::from_bitmask(simd, (1 << count) - 1)
}
