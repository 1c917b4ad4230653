//! Linear colour.

use core::ops::{Add, Mul};

use crate::number::Number;
use crate::scalar::Scalar;

/// A linear colour or light intensity; 0 is black, 1 the display's brightest. Scene data may exceed
/// 1, the colour of a ray never does.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Color<T = f32> {
    /// Red.
    pub r: T,
    /// Green.
    pub g: T,
    /// Blue.
    pub b: T,
}

impl<T> Color<T> {
    /// The colour of three channels.
    pub const fn new(r: T, g: T, b: T) -> Self {
        Self { r, g, b }
    }
}

impl<T: Scalar> Color<T> {
    /// No light.
    pub const BLACK: Self = Self::new(T::ZERO, T::ZERO, T::ZERO);

    /// Every channel limited to 0…1; NaN becomes 0.
    #[inline(always)]
    pub fn clamp(self) -> Self {
        // Nearly all are.
        if self.r.is_clamped() & self.g.is_clamped() & self.b.is_clamped() {
            return self;
        }
        Self::new(self.r.clamp01(), self.g.clamp01(), self.b.clamp01())
    }

    /// All channels are 0.
    #[inline(always)]
    pub fn is_black(self) -> bool {
        self.r.is_zero() && self.g.is_zero() && self.b.is_zero()
    }

    /// All channels are finite.
    pub fn is_finite(self) -> bool {
        self.r.is_finite() && self.g.is_finite() && self.b.is_finite()
    }

    /// Luma `0.299 r + 0.587 g + 0.114 b` (ITU-R BT.601), in 0…1 for a colour in 0…1.
    #[inline(always)]
    pub fn luma(self) -> T {
        T::from_f64(0.299) * self.r + T::from_f64(0.587) * self.g + T::from_f64(0.114) * self.b
    }
}

impl<N: Number> Color<N> {
    /// The same number in all channels.
    #[inline(always)]
    fn splat(channel: N) -> Self {
        Self::new(channel, channel, channel)
    }

    /// One product stands for those of all channels: light without a hue is common.
    #[inline(always)]
    fn is_surely_grey(self) -> bool {
        N::are_surely_same([self.r, self.g, self.b])
    }
}

impl<N: Number> Add for Color<N> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self::new(
            self.r.plus(other.r),
            self.g.plus(other.g),
            self.b.plus(other.b),
        )
    }
}

/// Componentwise: light of one colour on a surface of another.
impl<N: Number> Mul for Color<N> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        if self.is_surely_grey() && other.is_surely_grey() {
            return Self::splat(self.r.times(other.r));
        }
        Self::new(
            self.r.times(other.r),
            self.g.times(other.g),
            self.b.times(other.b),
        )
    }
}

impl<N: Number> Mul<N> for Color<N> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, factor: N) -> Self {
        if self.is_surely_grey() {
            return Self::splat(self.r.times(factor));
        }
        Self::new(
            self.r.times(factor),
            self.g.times(factor),
            self.b.times(factor),
        )
    }
}
