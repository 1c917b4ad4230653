//! Vectors of eight lanes, one for each of eight rays, with the arithmetic of the core's `Vec3`.
//!
//! Everything here is the same IEEE operation in the same order as in the core, so that a lane holds
//! the same bits: never `mul_add`, never an approximate reciprocal, and no minimum or maximum, whose NaN
//! depends on the machine.
//!
//! Everything that holds vectors is a function with `#[inline(always)]`, here and in the modules that
//! use this one: only what is inlined into [`Simd::vectorize`] is compiled for the level of vector
//! instructions. A closure may be left outside, and is then slow.

use std::ops::{Add, Mul, Neg, Sub};

use fearless_simd::prelude::*;
use fearless_simd::{f32x8, mask32x8, u32x8};
use scanray::{Scalar, Vec3};

/// Rays that are traced together.
pub(super) const LANES: usize = 8;

/// A number for each lane.
pub(super) type Numbers<S> = f32x8<S>;
/// A whole number for each lane.
pub(super) type Indices<S> = u32x8<S>;
/// Yes or no for each lane.
pub(super) type Mask<S> = mask32x8<S>;

/// A vector, a point or a colour for each lane.
#[derive(Clone, Copy)]
pub(super) struct Vec3s<S: Simd> {
    pub(super) x: Numbers<S>,
    pub(super) y: Numbers<S>,
    pub(super) z: Numbers<S>,
}

/// A colour for each lane: red, green and blue as `x`, `y` and `z`.
pub(super) type Colors<S> = Vec3s<S>;

impl<S: Simd> Vec3s<S> {
    #[inline(always)]
    pub(super) fn new(x: Numbers<S>, y: Numbers<S>, z: Numbers<S>) -> Self {
        Self { x, y, z }
    }

    /// The same vector in every lane.
    #[inline(always)]
    pub(super) fn splat(simd: S, v: Vec3) -> Self {
        Self::new(
            Numbers::splat(simd, v.x),
            Numbers::splat(simd, v.y),
            Numbers::splat(simd, v.z),
        )
    }

    /// `Vec3::dot`.
    #[inline(always)]
    pub(super) fn dot(self, other: Self) -> Numbers<S> {
        self.x * other.x + self.y * other.y + self.z * other.z
    }

    /// `Vec3::abs`.
    #[inline(always)]
    pub(super) fn abs(self) -> Self {
        Self::new(self.x.abs(), self.y.abs(), self.z.abs())
    }

    /// `Vec3::normalize`.
    #[inline(always)]
    pub(super) fn normalize(self, simd: S) -> Self {
        self * (Numbers::splat(simd, 1.0) / self.dot(self).sqrt())
    }

    /// `Vec3::renormalize`.
    #[inline(always)]
    fn renormalize(self, simd: S) -> Self {
        self * (Numbers::splat(simd, 1.5) - self.dot(self) * 0.5)
    }

    /// `Vec3::reflect`.
    #[inline(always)]
    pub(super) fn reflect(self, simd: S, normal: Self) -> Self {
        (self - normal * (self.dot(normal) * 2.0)).renormalize(simd)
    }

    /// `Vec3::refract`, and the lanes without total reflection.
    #[inline(always)]
    pub(super) fn refract(
        self,
        simd: S,
        normal: Self,
        eta: Numbers<S>,
        bend: Numbers<S>,
        valid: Mask<S>,
    ) -> (Self, Mask<S>) {
        let cosine = -self.dot(normal);
        let k = cosine * cosine + bend;
        let mut passes = valid & k.simd_ge(0.0);
        let bent = (self + normal * (cosine - k.sqrt())) * eta;
        let drift = (bent.dot(bent) - 1.0).abs();
        let mut direction = bent.renormalize(simd);
        let rare = passes & !drift.simd_lt(f32::EPSILON * 256.0);
        if rare.any_true() {
            // Leave the extreme index to the core.
            for lane in (0..LANES).filter(|lane| rare.test(*lane)) {
                let refracted = self
                    .lane(lane)
                    .refract(normal.lane(lane), eta[lane], bend[lane]);
                passes.set(lane, refracted.is_some());
                direction.set_lane(lane, refracted.unwrap_or_default());
            }
        }
        (direction, passes)
    }

    /// The vector of a lane.
    #[inline(always)]
    pub(super) fn lane(&self, lane: usize) -> Vec3 {
        Vec3::new(self.x[lane], self.y[lane], self.z[lane])
    }

    fn set_lane(&mut self, lane: usize, v: Vec3) {
        (self.x[lane], self.y[lane], self.z[lane]) = (v.x, v.y, v.z);
    }

    /// One of two vectors in each lane.
    #[inline(always)]
    pub(super) fn select(mask: Mask<S>, a: Self, b: Self) -> Self {
        Self::new(
            mask.select(a.x, b.x),
            mask.select(a.y, b.y),
            mask.select(a.z, b.z),
        )
    }

    /// `Color::clamp`.
    #[inline(always)]
    pub(super) fn clamp(self, simd: S) -> Self {
        Self::new(
            clamp01(simd, self.x),
            clamp01(simd, self.y),
            clamp01(simd, self.z),
        )
    }

    /// Component by component: light on a surface.
    #[inline(always)]
    pub(super) fn tint(self, other: Self) -> Self {
        Self::new(self.x * other.x, self.y * other.y, self.z * other.z)
    }
}

impl<S: Simd> Add for Vec3s<S> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self::new(self.x + other.x, self.y + other.y, self.z + other.z)
    }
}

impl<S: Simd> Sub for Vec3s<S> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self::new(self.x - other.x, self.y - other.y, self.z - other.z)
    }
}

impl<S: Simd> Mul<Numbers<S>> for Vec3s<S> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, factor: Numbers<S>) -> Self {
        Self::new(self.x * factor, self.y * factor, self.z * factor)
    }
}

impl<S: Simd> Neg for Vec3s<S> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self::new(-self.x, -self.y, -self.z)
    }
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
        self.origin + self.direction * t
    }
}

/// `Scalar::clamp01`.
#[inline(always)]
fn clamp01<S: Simd>(simd: S, number: Numbers<S>) -> Numbers<S> {
    let (zero, one) = (Numbers::splat(simd, 0.0), Numbers::splat(simd, 1.0));
    let below_one = number.simd_lt(one).select(number, one);
    number.simd_gt(zero).select(below_one, zero)
}

/// The first `count` lanes.
#[inline(always)]
pub(super) fn first_lanes<S: Simd>(simd: S, count: usize) -> Mask<S> {
    Mask::from_bitmask(simd, (1 << count) - 1)
}

/// `Scalar::powi`: repeated squaring.
#[inline(always)]
pub(super) fn power_of_whole<S: Simd>(
    simd: S,
    mut base: Numbers<S>,
    mut exponent: u16,
) -> Numbers<S> {
    let mut power = Numbers::splat(simd, 1.0);
    loop {
        if exponent & 1 != 0 {
            power *= base;
        }
        exponent >>= 1;
        if exponent == 0 {
            return power;
        }
        base = base * base;
    }
}

/// `Scalar::powf`, lane by lane.
#[inline(always)]
pub(super) fn powf<S: Simd>(simd: S, base: Numbers<S>, exponent: f32) -> Numbers<S> {
    Numbers::from_fn(simd, |lane| Scalar::powf(base[lane], exponent))
}
