//! The number type of the tracer: `f32` on devices, `f64` as its own reference.
//!
//! This is the only file that calls libm or a hardware square root, so that every other file is the
//! same IEEE 754 arithmetic (`+ − × ÷ √`, in source order, never fused) on every machine.

use core::fmt::{Debug, Display};
use core::ops::{AddAssign, SubAssign};

use crate::number::Number;
use crate::soft_float;

mod sealed {
    pub trait Sealed {}
    impl Sealed for f32 {}
    impl Sealed for f64 {}
}

/// A binary floating-point number: `f32` or `f64`.
///
/// The trait is sealed. All operations are correctly rounded, except [`Scalar::powf`], whose error is stated there.
pub trait Scalar:
    sealed::Sealed
    + Copy
    + Debug
    + Display
    + Default
    + PartialEq
    + PartialOrd
    + Send
    + Sync
    + 'static
    + Number
    + AddAssign
    + SubAssign
{
    /// Its name in messages: `f32` or `f64`.
    const NAME: &'static str;
    /// The core has no hardware for it, so that operations are routines in integers (`soft_float`). Told of `f32` alone.
    const EMULATED: bool;
    /// 0.
    const ZERO: Self;
    /// ½.
    const HALF: Self;
    /// 1.
    const ONE: Self;
    /// 1½.
    const THREE_HALVES: Self;
    /// 2.
    const TWO: Self;
    /// The largest finite number.
    const MAX: Self;
    /// The smallest number above 0 with all its digits.
    const MIN_POSITIVE: Self;
    /// The root of [`Scalar::MIN_POSITIVE`]: the smallest number whose square has all its digits.
    const SMALLEST_TO_SQUARE: Self;
    /// The distance from 1 to the next larger number: 2⁻²³ or 2⁻⁵². Error bounds are multiples of it.
    const EPSILON: Self;
    /// The largest whole exponent that repeated squaring still raises well within a display level.
    const MAX_SQUARED_EXPONENT: u16;

    /// Nearest number to an integer.
    fn from_i32(value: i32) -> Self;

    /// Nearest number to `value`.
    fn from_f64(value: f64) -> Self;

    /// Nearest `f32`.
    fn to_f32(self) -> f32;

    /// The number as `f64`, exactly.
    fn to_f64(self) -> f64;

    /// The whole part towards zero, saturating; 0 for NaN.
    fn to_u32(self) -> u32;

    /// The whole part towards zero, saturating; 0 for NaN.
    fn to_i32(self) -> i32;

    /// Sign, exponent and seven digits of the number as an `f32`, as an integer: numbers of which neither is
    /// negative are in its order.
    fn upper_half(self) -> i16;

    /// The sign bit is set.
    fn is_negative(self) -> bool;

    /// `self^exponent` for `self` in 0…1 and `exponent ≥ 0`, to an absolute error of 1e-6 (`f32`) or
    /// 1e-15 (`f64`). `f32` uses no double-precision operation.
    fn powf(self, exponent: Self) -> Self;

    /// Neither infinite nor NaN.
    fn is_finite(self) -> bool;

    /// Above 0; false for NaN.
    #[inline(always)]
    fn is_positive(self) -> bool {
        self > Self::ZERO
    }

    /// 0 or above, −0 too; false for NaN.
    #[inline(always)]
    fn is_zero_or_positive(self) -> bool {
        self >= Self::ZERO
    }

    /// 0 or below, +0 too; false for NaN.
    #[inline(always)]
    fn is_zero_or_negative(self) -> bool {
        self <= Self::ZERO
    }

    /// `self < other`, where neither is below 0 or NaN.
    #[inline(always)]
    fn is_before(self, other: Self) -> bool {
        self < other
    }

    /// `self ≤ other`, where `self` is not below 0 and `other` neither −0 nor NaN; false if `self` is NaN.
    #[inline(always)]
    fn is_up_to(self, other: Self) -> bool {
        self <= other
    }

    /// Equal to 0 or −0.
    #[inline(always)]
    fn is_zero(self) -> bool {
        self == Self::ZERO
    }

    /// Both equal to 0 or −0.
    #[inline(always)]
    fn are_zero(self, other: Self) -> bool {
        self == Self::ZERO && other == Self::ZERO
    }

    /// Neither 0 nor subnormal, neither infinite nor NaN.
    fn is_normal(self) -> bool;

    /// `−self` if `other` is negative, else `self`.
    #[inline(always)]
    fn with_sign_of(self, other: Self) -> Self {
        if other.is_negative() { -self } else { self }
    }

    /// Has the same bits.
    fn is_same(self, other: Self) -> bool;

    /// Equal to 1.
    #[inline(always)]
    fn is_one(self) -> bool {
        self == Self::ONE
    }

    /// The larger of two numbers; the other one when `self` is NaN.
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        if self > other { self } else { other }
    }

    /// [`Scalar::clamp01`] changes nothing.
    fn is_clamped(self) -> bool;

    /// The number limited to 0…1; 0 for NaN.
    #[inline(always)]
    fn clamp01(self) -> Self {
        if self > Self::ZERO {
            if self < Self::ONE { self } else { Self::ONE }
        } else {
            Self::ZERO
        }
    }
}

impl Number for f32 {
    const ULP: f64 = f32::EPSILON as f64;
    const SPLIT: f64 = 4097.0;

    #[inline(always)]
    fn constant(self, value: f64) -> Self {
        value as f32
    }

    #[inline(always)]
    fn abs(self) -> Self {
        f32::abs(self)
    }

    #[inline(always)]
    fn if_zero(self, then: Self, otherwise: Self) -> Self {
        if Scalar::is_zero(self) {
            then
        } else {
            otherwise
        }
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        if <Self as Scalar>::EMULATED {
            soft_float::square_root(self)
        } else {
            hardware_sqrt(self)
        }
    }

    #[inline(always)]
    fn times(self, other: Self) -> Self {
        if <Self as Scalar>::EMULATED {
            soft_float::multiply(self, other)
        } else {
            self * other
        }
    }

    #[inline(always)]
    fn plus(self, other: Self) -> Self {
        if <Self as Scalar>::EMULATED {
            soft_float::add(self, other)
        } else {
            self + other
        }
    }

    #[inline(always)]
    fn minus(self, other: Self) -> Self {
        if <Self as Scalar>::EMULATED {
            soft_float::add(self, -other)
        } else {
            self - other
        }
    }

    #[inline(always)]
    fn over(self, other: Self) -> Self {
        if <Self as Scalar>::EMULATED {
            soft_float::divide(self, other)
        } else {
            self / other
        }
    }

    #[inline(always)]
    fn double(self) -> Self {
        if <Self as Scalar>::EMULATED {
            soft_float::double(self)
        } else {
            2.0 * self
        }
    }

    #[inline(always)]
    fn halve(self) -> Self {
        if <Self as Scalar>::EMULATED {
            soft_float::halve(self)
        } else {
            0.5 * self
        }
    }

    #[inline(always)]
    fn are_surely_same([r, g, b]: [Self; 3]) -> bool {
        <Self as Scalar>::EMULATED && r.is_same(g) && r.is_same(b)
    }
}

impl Number for f64 {
    const ULP: f64 = f64::EPSILON;
    const SPLIT: f64 = 134_217_729.0;

    #[inline(always)]
    fn constant(self, value: f64) -> Self {
        value
    }

    #[inline(always)]
    fn abs(self) -> Self {
        f64::abs(self)
    }

    #[inline(always)]
    fn if_zero(self, then: Self, otherwise: Self) -> Self {
        if Scalar::is_zero(self) {
            then
        } else {
            otherwise
        }
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        libm::sqrt(self)
    }
}

impl Scalar for f32 {
    const NAME: &'static str = "f32";
    const EMULATED: bool = cfg!(any(
        all(target_arch = "arm", target_abi = "eabi"),
        all(target_arch = "riscv32", not(target_feature = "f")),
    ));
    const ZERO: Self = 0.0;
    const HALF: Self = 0.5;
    const ONE: Self = 1.0;
    const THREE_HALVES: Self = 1.5;
    const TWO: Self = 2.0;
    const MAX: Self = f32::MAX;
    const MIN_POSITIVE: Self = f32::MIN_POSITIVE;
    const SMALLEST_TO_SQUARE: Self = f32::from_bits(64 << 23);
    const EPSILON: Self = f32::EPSILON;
    const MAX_SQUARED_EXPONENT: u16 = 1024;

    #[inline(always)]
    fn from_i32(value: i32) -> Self {
        value as f32
    }

    #[inline(always)]
    fn from_f64(value: f64) -> Self {
        value as f32
    }

    #[inline(always)]
    fn to_f32(self) -> f32 {
        self
    }

    #[inline(always)]
    fn to_f64(self) -> f64 {
        f64::from(self)
    }

    #[inline(always)]
    fn to_u32(self) -> u32 {
        if <Self as Scalar>::EMULATED {
            soft_float::to_u32(self)
        } else {
            self as u32
        }
    }

    #[inline(always)]
    fn to_i32(self) -> i32 {
        if <Self as Scalar>::EMULATED {
            soft_float::to_i32(self)
        } else {
            self as i32
        }
    }

    #[inline(always)]
    fn upper_half(self) -> i16 {
        (self.to_bits() >> 16) as i16
    }

    // As integers positive numbers are in their order, below infinity, NaN and all negative numbers: a
    // comparison of floats costs more, and is a call where they are emulated.
    #[inline(always)]
    fn clamp01(self) -> Self {
        const ONE: u32 = 1.0_f32.to_bits();
        const INFINITY: u32 = f32::INFINITY.to_bits();
        let bits = self.to_bits();
        let above_zero = if bits > INFINITY { 0 } else { bits };
        f32::from_bits(if above_zero > ONE { ONE } else { above_zero })
    }

    #[inline(always)]
    fn is_clamped(self) -> bool {
        self.to_bits() <= 1.0_f32.to_bits()
    }

    #[inline(always)]
    fn is_negative(self) -> bool {
        self.is_sign_negative()
    }

    fn powf(self, exponent: Self) -> Self {
        exp2(exponent * log2(self))
    }

    #[inline(always)]
    fn is_finite(self) -> bool {
        if <Self as Scalar>::EMULATED {
            soft_float::is_finite(self)
        } else {
            f32::is_finite(self)
        }
    }

    #[inline(always)]
    fn is_same(self, other: Self) -> bool {
        self.to_bits() == other.to_bits()
    }

    #[inline(always)]
    fn is_normal(self) -> bool {
        // Of the exponent's 8 bits neither all nor none.
        ((self.to_bits() >> 23) + 1) & 0xff > 1
    }

    #[inline(always)]
    fn with_sign_of(self, other: Self) -> Self {
        f32::from_bits(self.to_bits() ^ other.to_bits() & (-0.0_f32).to_bits())
    }

    #[inline(always)]
    fn is_positive(self) -> bool {
        if <Self as Scalar>::EMULATED {
            soft_float::is_positive(self)
        } else {
            self > 0.0
        }
    }

    #[inline(always)]
    fn is_zero_or_positive(self) -> bool {
        if <Self as Scalar>::EMULATED {
            soft_float::is_zero_or_positive(self)
        } else {
            self >= 0.0
        }
    }

    #[inline(always)]
    fn is_zero_or_negative(self) -> bool {
        if Self::EMULATED {
            (-self).is_zero_or_positive()
        } else {
            self <= 0.0
        }
    }

    #[inline(always)]
    fn is_before(self, other: Self) -> bool {
        if <Self as Scalar>::EMULATED {
            soft_float::is_before(self, other)
        } else {
            self < other
        }
    }

    #[inline(always)]
    fn is_up_to(self, other: Self) -> bool {
        if <Self as Scalar>::EMULATED {
            soft_float::is_up_to(self, other)
        } else {
            self <= other
        }
    }

    #[inline(always)]
    fn is_zero(self) -> bool {
        if <Self as Scalar>::EMULATED {
            soft_float::is_zero(self)
        } else {
            self == 0.0
        }
    }

    #[inline(always)]
    fn are_zero(self, other: Self) -> bool {
        if <Self as Scalar>::EMULATED {
            soft_float::are_zero(self, other)
        } else {
            self == 0.0 && other == 0.0
        }
    }

    #[inline(always)]
    fn is_one(self) -> bool {
        if <Self as Scalar>::EMULATED {
            soft_float::is_one(self)
        } else {
            self == 1.0
        }
    }
}

impl Scalar for f64 {
    const NAME: &'static str = "f64";
    const EMULATED: bool = false;
    const ZERO: Self = 0.0;
    const HALF: Self = 0.5;
    const ONE: Self = 1.0;
    const THREE_HALVES: Self = 1.5;
    const TWO: Self = 2.0;
    const MAX: Self = f64::MAX;
    const MIN_POSITIVE: Self = f64::MIN_POSITIVE;
    const SMALLEST_TO_SQUARE: Self = f64::from_bits(512 << 52);
    const EPSILON: Self = f64::EPSILON;
    const MAX_SQUARED_EXPONENT: u16 = u16::MAX - 1;

    #[inline(always)]
    fn from_i32(value: i32) -> Self {
        f64::from(value)
    }

    #[inline(always)]
    fn from_f64(value: f64) -> Self {
        value
    }

    #[inline(always)]
    fn to_f32(self) -> f32 {
        self as f32
    }

    #[inline(always)]
    fn to_f64(self) -> f64 {
        self
    }

    #[inline(always)]
    fn to_u32(self) -> u32 {
        self as u32
    }

    #[inline(always)]
    fn to_i32(self) -> i32 {
        self as i32
    }

    #[inline(always)]
    fn upper_half(self) -> i16 {
        (self as f32).upper_half()
    }

    #[inline(always)]
    fn is_clamped(self) -> bool {
        self.to_bits() <= 1.0_f64.to_bits()
    }

    #[inline(always)]
    fn is_negative(self) -> bool {
        self.is_sign_negative()
    }

    fn powf(self, exponent: Self) -> Self {
        libm::pow(self, exponent)
    }

    #[inline(always)]
    fn is_same(self, other: Self) -> bool {
        self.to_bits() == other.to_bits()
    }

    #[inline(always)]
    fn is_normal(self) -> bool {
        f64::is_normal(self)
    }

    #[inline(always)]
    fn is_finite(self) -> bool {
        f64::is_finite(self)
    }
}

/// `libm::sqrtf` knows x86-64 and AArch64 hardware but is an integer routine on Arm's hard-float
/// microcontrollers; both are correctly rounded, so the picture has the same bits.
#[cfg(all(target_arch = "arm", target_abi = "eabihf"))]
#[allow(unsafe_code)]
#[inline(always)]
fn hardware_sqrt(value: f32) -> f32 {
    let root: u32;
    // SAFETY: `vsqrt.f32` exists wherever the hard-float ABI does, and touches s0 and one core
    // register only, both declared here.
    unsafe {
        core::arch::asm!(
            "vmov s0, {bits}",
            "vsqrt.f32 s0, s0",
            "vmov {root}, s0",
            bits = in(reg) value.to_bits(),
            root = lateout(reg) root,
            out("s0") _,
            options(pure, nomem, nostack, preserves_flags)
        );
    }
    f32::from_bits(root)
}

#[cfg(not(all(target_arch = "arm", target_abi = "eabihf")))]
#[inline(always)]
fn hardware_sqrt(value: f32) -> f32 {
    libm::sqrtf(value)
}

/// Binary logarithm of `x` in 0…1 (any positive number works), relative error below 4e-7 also next
/// to 1, where a power amplifies it most; −∞ at 0.
///
/// `x = m·2^e` with `m` in √½…√2, then `ln m = 2 artanh s`, `s = (m − 1)/(m + 1)`, whose series ends
/// below half an ulp at `s¹⁰`: Abramowitz and Stegun 4.1.27.
fn log2(x: f32) -> f32 {
    const SQRT_HALF_BITS: u32 = 0x3f35_04f3;
    // A subnormal number has no room for its exponent: move it up first.
    let (x, below) = if x < f32::MIN_POSITIVE {
        (x * 16_777_216.0, 24)
    } else {
        (x, 0)
    };
    if x <= 0.0 {
        return f32::NEG_INFINITY;
    }
    let shifted = x.to_bits().wrapping_sub(SQRT_HALF_BITS) as i32;
    let exponent = shifted >> 23;
    let m = f32::from_bits((shifted & 0x007f_ffff) as u32 + SQRT_HALF_BITS);
    let s = (m - 1.0) / (m + 1.0);
    let z = s * s;
    let series = 1.0 / 3.0 + z * (1.0 / 5.0 + z * (1.0 / 7.0 + z * (1.0 / 9.0)));
    const TWO_OVER_LN2: f32 = 2.0 * core::f32::consts::LOG2_E;
    (exponent - below) as f32 + (s + s * (z * series)) * TWO_OVER_LN2
}

/// `2^y` for `y ≤ 0`, relative error below 3e-7; 0 below the normal numbers (no display shows them)
/// and for NaN.
///
/// `y = n + r` with `r` in −½…½, then the Taylor series of `e^(r ln 2)`, whose rest after the sixth
/// power is below 2e-8.
fn exp2(y: f32) -> f32 {
    if y > -126.0 {
        let n = (y - 0.5) as i32;
        let r = (y - n as f32) * core::f32::consts::LN_2;
        let series = 1.0
            + r * (1.0
                + r * (0.5
                    + r * (1.0 / 6.0 + r * (1.0 / 24.0 + r * (1.0 / 120.0 + r * (1.0 / 720.0))))));
        series * f32::from_bits(((n + 127) as u32) << 23)
    } else {
        0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn powf_of_f32_stays_within_its_stated_error() {
        let mut worst = 0.0_f64;
        for exponent in [
            0.25_f32, 0.5, 1.5, 2.7, 50.5, 1000.25, 1025.0, 65_535.0, 1e7,
        ] {
            for step in 0..=4000 {
                // Bases next to 1 are the ones that large exponents still show.
                let base = 1.0 - (step as f32 / 4000.0).powi(5);
                let exact = f64::from(base).powf(f64::from(exponent));
                worst = worst.max((f64::from(<f32 as Scalar>::powf(base, exponent)) - exact).abs());
            }
        }
        assert!(worst < 1e-6, "worst absolute error {worst:e}");
    }

    #[test]
    fn powf_at_the_ends_of_its_range() {
        assert_eq!(<f32 as Scalar>::powf(0.0, 2.5), 0.0);
        assert_eq!(<f32 as Scalar>::powf(1.0, 1e30), 1.0);
        assert_eq!(<f32 as Scalar>::powf(0.5, 1e30), 0.0);
        // The smallest subnormal number, 2⁻¹⁴⁹.
        let tiny = <f32 as Scalar>::powf(f32::from_bits(1), 0.25);
        assert!((f64::from(tiny) / 2_f64.powf(-149.0 / 4.0) - 1.0).abs() < 1e-6);
    }

    #[test]
    fn clamp01_turns_nan_into_zero() {
        assert_eq!(f32::NAN.clamp01(), 0.0);
        assert_eq!(f32::INFINITY.clamp01(), 1.0);
        assert_eq!((-0.0_f64).clamp01(), 0.0);
    }

    #[test]
    fn what_is_clamped_stays_as_it_is() {
        for number in [0.0_f32, 1e-45, 0.5, 1.0] {
            assert!(number.is_clamped() && f64::from(number).is_clamped());
            assert_eq!(number.clamp01().to_bits(), number.to_bits());
        }
        for number in [
            -0.0_f32,
            -1.0,
            1.0 + f32::EPSILON,
            f32::INFINITY,
            f32::NAN,
            -f32::NAN,
        ] {
            assert!(!number.is_clamped() && !f64::from(number).is_clamped());
        }
    }
}
