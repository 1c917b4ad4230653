//! Operations of `f32` in integers, for cores that emulate it: the same bits as the operators', in fewer instructions than
//! the routines of the compiler's library that these call.

/// The core multiplies 32 bits to 32 bits, so that longer products are calls of a routine: ARMv6-M, which alone of Arm's
/// architectures has no atomic exchange either.
const HAS_SHORT_PRODUCTS: bool = cfg!(all(target_arch = "arm", not(target_has_atomic = "32")));

/// Counting leading zeros is an instruction of the core.
const COUNTS_ZEROS: bool = cfg!(target_arch = "arm") && !HAS_SHORT_PRODUCTS;

/// The sign.
const SIGN: u32 = 1 << 31;

/// Infinity as a number: NaN and all negative numbers are above.
const INFINITY: u32 = f32::INFINITY.to_bits();

/// Bits behind the point.
const FRACTION_BITS: u32 = 23;

/// The exponent of 1 as it is stored.
const BIAS: u32 = 127;

/// The exponent as it is stored: 0 for 0 and subnormal numbers, 255 for infinity and NaN.
#[inline(always)]
fn exponent(bits: u32) -> u32 {
    bits >> FRACTION_BITS & 0xff
}

/// `x > 0`.
#[inline(always)]
pub(crate) fn is_positive(x: f32) -> bool {
    x.to_bits().wrapping_sub(1) < INFINITY
}

/// `x ≥ 0`.
#[inline(always)]
pub(crate) fn is_zero_or_positive(x: f32) -> bool {
    x.to_bits() <= INFINITY || x.to_bits() == SIGN
}

/// `x < y`, where neither is below 0; `y` is not NaN.
#[inline(always)]
pub(crate) fn is_before(x: f32, y: f32) -> bool {
    x.to_bits() < y.to_bits()
}

/// `x ≤ y`, where `x` is not below 0, and `y` neither −0 nor NaN.
#[inline(always)]
pub(crate) fn is_up_to(x: f32, y: f32) -> bool {
    x.to_bits() <= INFINITY && x.to_bits() as i32 <= y.to_bits() as i32
}

/// `x = 0`.
#[inline(always)]
pub(crate) fn is_zero(x: f32) -> bool {
    x.to_bits() << 1 == 0
}

/// `x = 0` and `y = 0`.
// Of one number LLVM knows the comparison of floats again.
#[inline(always)]
pub(crate) fn are_zero(x: f32, y: f32) -> bool {
    (x.to_bits() | y.to_bits()) << 1 == 0
}

/// `x = 1`.
#[inline(always)]
pub(crate) fn is_one(x: f32) -> bool {
    x.to_bits() == 1.0_f32.to_bits()
}

/// Neither infinite nor NaN.
#[inline(always)]
pub(crate) fn is_finite(x: f32) -> bool {
    x.to_bits() << 1 < INFINITY << 1
}

/// `2x`.
#[inline(always)]
pub(crate) fn double(x: f32) -> f32 {
    if (1..254).contains(&exponent(x.to_bits())) {
        f32::from_bits(x.to_bits() + (1 << FRACTION_BITS))
    } else {
        multiply_extremes(x.to_bits(), 2.0_f32.to_bits())
    }
}

/// `½x`.
#[inline(always)]
pub(crate) fn halve(x: f32) -> f32 {
    if (2..255).contains(&exponent(x.to_bits())) {
        f32::from_bits(x.to_bits() - (1 << FRACTION_BITS))
    } else {
        multiply_extremes(x.to_bits(), 0.5_f32.to_bits())
    }
}

/// `x as u32`.
#[inline(always)]
pub(crate) fn to_u32(x: f32) -> u32 {
    let bits = x.to_bits();
    match bits >> FRACTION_BITS {
        0..BIAS => 0,
        exponent @ BIAS..159 => (bits << 8 | 1 << 31) >> (158 - exponent),
        // Negative numbers too: their sign makes the exponent larger than all others.
        _ if bits > INFINITY => 0,
        _ => u32::MAX,
    }
}

/// `x as i32`.
#[inline(always)]
pub(crate) fn to_i32(x: f32) -> i32 {
    let magnitude = to_u32(x.abs()).min(SIGN);
    if x.is_sign_negative() {
        (magnitude as i32).wrapping_neg()
    } else {
        magnitude.min(i32::MAX as u32) as i32
    }
}

/// `x·y`.
pub(crate) fn multiply(x: f32, y: f32) -> f32 {
    let (x_bits, y_bits) = (x.to_bits(), y.to_bits());
    let (x_exponent, y_exponent) = (exponent(x_bits), exponent(y_bits));
    // Far enough from both ends for the exponent of the product.
    const ORDINARY: core::ops::Range<u32> = 64..191;
    if !(ORDINARY.contains(&x_exponent) && ORDINARY.contains(&y_exponent)) {
        return multiply_extremes(x_bits, y_bits);
    }
    let mut exponent = x_exponent + y_exponent - BIAS;
    let significand = |bits: u32| bits & ((1 << FRACTION_BITS) - 1) | 1 << FRACTION_BITS;
    let (x, y) = (significand(x_bits), significand(y_bits));
    let [mut high, mut rest] = if HAS_SHORT_PRODUCTS {
        short_product(x, y)
    } else {
        long_product(x, y)
    };
    // The leading bit of the significand adds 1 to the exponent.
    if high >> FRACTION_BITS == 0 {
        high = high << 1 | rest >> 31;
        rest <<= 1;
        exponent -= 1;
    }
    // To the nearest, of two to the even one; the lowest bit of `rest` is free.
    let up = (rest | high & 1) > SIGN;
    let magnitude = (exponent << FRACTION_BITS) + high + u32::from(up);
    f32::from_bits((x_bits ^ y_bits) & SIGN | magnitude)
}

/// [`multiply`] where a factor or the product may be none of the normal numbers.
// A function, so that the other way through the caller keeps no registers for the call; of bits, which LLVM does not
// compare as floats.
#[cold]
#[inline(never)]
fn multiply_extremes(x: u32, y: u32) -> f32 {
    // Black is common.
    if (x << 1 == 0 || y << 1 == 0) && exponent(x) < 255 && exponent(y) < 255 {
        f32::from_bits((x ^ y) & SIGN)
    } else {
        f32::from_bits(x) * f32::from_bits(y)
    }
}

/// `x/y`.
pub(crate) fn divide(x: f32, y: f32) -> f32 {
    let (x_bits, y_bits) = (x.to_bits(), y.to_bits());
    let (x_exponent, y_exponent) = (exponent(x_bits), exponent(y_bits));
    // Far enough from both ends for the exponent of the quotient.
    const ORDINARY: core::ops::Range<u32> = 65..190;
    let is_ordinary = ORDINARY.contains(&x_exponent) && ORDINARY.contains(&y_exponent);
    if HAS_SHORT_PRODUCTS || !is_ordinary {
        return divide_extremes(x_bits, y_bits);
    }
    let significand = |bits: u32| bits & ((1 << FRACTION_BITS) - 1) | 1 << FRACTION_BITS;
    let (mut left, divisor) = (significand(x_bits), significand(y_bits));
    // The leading bit of the significand adds 1 to the exponent.
    let mut exponent = x_exponent + BIAS - 1 - y_exponent;
    if left < divisor {
        left <<= 1;
        exponent -= 1;
    }
    // The leading bit, then 24 more, which is one more than is kept.
    left -= divisor;
    let mut digits = || {
        let digits = (left << 8) / divisor;
        left = (left << 8) - digits * divisor;
        digits
    };
    let (high, middle, low) = (digits(), digits(), digits());
    let quotient = 1 << 24 | high << 16 | middle << 8 | low;
    // No quotient lies in the middle between two numbers.
    let magnitude = (exponent << FRACTION_BITS) + (quotient >> 1) + (quotient & 1);
    f32::from_bits((x_bits ^ y_bits) & SIGN | magnitude)
}

/// [`divide`] by the operator.
#[cold]
#[inline(never)]
fn divide_extremes(x: u32, y: u32) -> f32 {
    f32::from_bits(x) / f32::from_bits(y)
}

/// The product of two significands, which has 47 or 48 bits: the upper ones, and 24 below them at the upper end of a word.
#[inline(always)]
fn long_product(x: u32, y: u32) -> [u32; 2] {
    let product = u64::from(x << 8) * u64::from(y);
    [(product >> 32) as u32, product as u32]
}

/// [`long_product`] in parts of 16 bits.
#[inline(always)]
fn short_product(x: u32, y: u32) -> [u32; 2] {
    let (x_high, x_low) = (x >> 16, x & 0xffff);
    let (y_high, y_low) = (y >> 16, y & 0xffff);
    let low = x_low * y_low;
    let middle = x_high * y_low + x_low * y_high + (low >> 16);
    [
        ((x_high * y_high) << 8) + (middle >> 8),
        middle << 24 | (low & 0xffff) << 8,
    ]
}

/// `x + y`.
pub(crate) fn add(x: f32, y: f32) -> f32 {
    let (mut large, mut small) = (x.to_bits(), y.to_bits());
    if large << 1 < small << 1 {
        (large, small) = (small, large);
    }
    let large_exponent = exponent(large);
    // Far enough from both ends for whatever cancels and carries.
    if !(32..254).contains(&large_exponent) {
        return add_extremes(x.to_bits(), y.to_bits());
    }
    let distance = large_exponent - exponent(small);
    // Less than half a unit in the last place, whatever the sign; 0 and subnormal numbers among them.
    if distance > 25 {
        return f32::from_bits(large);
    }
    // The leading bit has one above it, for the carry, and 7 bits follow.
    let significand = |bits: u32| (bits << 7 | 1 << 30) & !SIGN;
    let (a, b) = (significand(large), significand(small));
    // Of what is shifted out the lowest bit remembers that there was something.
    let shifted = b >> distance;
    let b = shifted | u32::from(shifted << distance != b);
    let mut sign_and_exponent = large & !((1 << FRACTION_BITS) - 1);
    let mut sum;
    if (large ^ small) & SIGN == 0 {
        sum = a + b;
        if sum & SIGN != 0 {
            sum = sum >> 1 | sum & 1;
            sign_and_exponent += 1 << FRACTION_BITS;
        }
    } else {
        sum = a - b;
        if sum == 0 {
            return 0.0;
        }
        let zeros = leading_zeros(sum) - 1;
        sum <<= zeros;
        sign_and_exponent -= zeros << FRACTION_BITS;
    }
    // To the nearest, of two to the even one.
    let rounded = sum - (1 << 30) + 0x3f + (sum >> 7 & 1);
    f32::from_bits(sign_and_exponent + (rounded >> 7))
}

/// [`add`] where a summand or the sum may be none of the normal numbers.
#[cold]
#[inline(never)]
fn add_extremes(x: u32, y: u32) -> f32 {
    // So are cameras at 0.
    match (x << 1 == 0, y << 1 == 0) {
        // Of two zeros only −0 and −0 is −0.
        (true, true) => f32::from_bits(x & y),
        (false, true) => f32::from_bits(x),
        (true, false) => f32::from_bits(y),
        (false, false) => f32::from_bits(x) + f32::from_bits(y),
    }
}

/// The number of zeros above the highest one, of which there is one.
#[inline(always)]
fn leading_zeros(bits: u32) -> u32 {
    if COUNTS_ZEROS {
        bits.leading_zeros()
    } else {
        count_zeros(bits)
    }
}

/// [`leading_zeros`], of which there are mostly few.
#[inline(always)]
fn count_zeros(mut bits: u32) -> u32 {
    let mut zeros = 0;
    while bits & SIGN == 0 {
        bits <<= 1;
        zeros += 1;
    }
    zeros
}

/// `√x`.
pub(crate) fn square_root(x: f32) -> f32 {
    let bits = x.to_bits();
    if !(1..255).contains(&(bits >> FRACTION_BITS)) {
        // 0, subnormal, negative, infinite, NaN.
        return libm::sqrtf(x);
    }
    let exponent = exponent(bits) + BIAS;
    let significand = bits & ((1 << FRACTION_BITS) - 1) | 1 << FRACTION_BITS;
    // The sum of exponent and bias is odd where the power of 2 is odd, half of which goes to the significand.
    let square = significand << (1 + (exponent & 1));
    // One bit more than is kept.
    let root = if HAS_SHORT_PRODUCTS {
        root_by_digits(square)
    } else {
        root_by_division(square)
    };
    // No root lies in the middle between two numbers. The leading bit adds 1 to the exponent.
    f32::from_bits((((exponent >> 1) - 1) << FRACTION_BITS) + (root >> 1) + (root & 1))
}

/// `⌊√(2²⁴·square)⌋` for `square` in 2²⁴…2²⁶, digit by digit.
#[inline(always)]
fn root_by_digits(square: u32) -> u32 {
    let mut rest = square;
    let mut twice_root = 0;
    let mut digit = 1 << 24;
    while digit != 0 {
        let candidate = twice_root + digit;
        if candidate <= rest {
            twice_root = candidate + digit;
            rest -= candidate;
        }
        rest <<= 1;
        digit >>= 1;
    }
    twice_root >> 1
}

/// [`root_by_digits`] for cores that divide.
#[inline(always)]
fn root_by_division(square: u32) -> u32 {
    // The upper 32 bits of the 48 to 50 below the root; the 18 others are 0.
    let top = square << 6;
    // 0.354 + ⅔x is off by at most 4 %, two steps of Newton's less than 1 of 2¹⁶.
    let guess = (((top >> 16) * 43_691) >> 16) + 23_211;
    let guess = (guess + top / guess) >> 1;
    let mut upper = (guess + top / guess) >> 1;
    if top / upper < upper {
        upper -= 1;
    }
    // (2⁹·upper + lower)² = 2¹⁸·upper² + 2¹⁰·upper·lower + lower²: lower from the second term, 1 less if there is no room
    // for the third.
    let left = (top - upper * upper) << 8;
    let lower = left / upper;
    let left = (left - lower * upper) << 10;
    (upper << 9) + lower - u32::from(left < lower * lower)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::vec::Vec;

    /// An interpreter, which takes a thousand times as long, tries one number of so many.
    const STEP: usize = if cfg!(miri) { 51 } else { 1 };

    /// Numbers of all kinds: around every power of 2, and a spread of all bits.
    fn numbers() -> Vec<f32> {
        let mut numbers = Vec::new();
        for exponent in (0..=255_u32).step_by(STEP) {
            for fraction in [
                0, 1, 2, 0x3f_ffff, 0x40_0000, 0x40_0001, 0x7f_fffe, 0x7f_ffff,
            ] {
                let bits = exponent << FRACTION_BITS | fraction;
                numbers.extend([bits, bits | SIGN].map(f32::from_bits));
            }
        }
        numbers.extend(spread(4096));
        numbers
    }

    /// Numbers whose bits are a sequence of low discrepancy.
    fn spread(count: u32) -> impl Iterator<Item = f32> {
        let numbers = (0..count).map(|i| f32::from_bits(i.wrapping_mul(0x9e37_79b9)));
        numbers.step_by(STEP)
    }

    fn same(a: f32, b: f32) -> bool {
        a.to_bits() == b.to_bits() || a.is_nan() && b.is_nan()
    }

    #[test]
    fn questions_of_one_number_have_the_operators_answers() {
        for x in numbers() {
            assert_eq!(is_positive(x), x > 0.0, "{x:?}");
            assert_eq!(is_zero_or_positive(x), x >= 0.0, "{x:?}");
            assert_eq!(is_zero(x), x == 0.0, "{x:?}");
            assert_eq!(is_one(x), x == 1.0, "{x:?}");
            assert_eq!(is_finite(x), x.is_finite(), "{x:?}");
            assert_eq!(to_u32(x), x as u32, "{x:?}");
            assert_eq!(to_i32(x), x as i32, "{x:?}");
            assert!(same(double(x), 2.0 * x), "{x:?}");
            assert!(same(halve(x), 0.5 * x), "{x:?}");
        }
    }

    #[test]
    fn comparisons_products_and_sums_are_the_operators() {
        let numbers = numbers();
        for &x in &numbers {
            for &y in &numbers {
                assert!(same(multiply(x, y), x * y), "{x:?} · {y:?}");
                assert!(same(add(x, y), x + y), "{x:?} + {y:?}");
                assert!(same(divide(x, y), x / y), "{x:?} / {y:?}");
                assert_eq!(are_zero(x, y), x == 0.0 && y == 0.0, "{x:?}, {y:?}");
                let x_fits = x.is_nan() || x.to_bits() <= INFINITY;
                if x_fits && y.to_bits() <= INFINITY {
                    assert_eq!(is_before(x, y), x < y, "{x:?} < {y:?}");
                }
                if x_fits && !y.is_nan() && y.to_bits() != SIGN {
                    assert_eq!(is_up_to(x, y), x <= y, "{x:?} ≤ {y:?}");
                }
            }
        }
    }

    #[test]
    fn products_and_sums_are_rounded_like_the_operators() {
        // Exponents near 1, so that all of them are finite.
        let near_one = |x: f32| f32::from_bits(x.to_bits() & !(0x3f << 24) | 0x3f << 24);
        let factors: Vec<f32> = spread(3000).map(near_one).collect();
        for &x in &factors {
            for &y in &factors {
                assert!(same(multiply(x, y), x * y), "{x:?} · {y:?}");
                assert!(same(add(x, y), x + y), "{x:?} + {y:?}");
                assert!(same(divide(x, y), x / y), "{x:?} / {y:?}");
            }
        }
    }

    #[test]
    fn what_cores_do_in_parts_is_the_same() {
        let significand = |x: f32| x.to_bits() >> 8 | 1 << FRACTION_BITS;
        let significands: Vec<u32> = numbers().into_iter().map(significand).collect();
        for &x in &significands {
            assert_eq!(count_zeros(x >> 3), (x >> 3).leading_zeros());
            for &y in &significands {
                assert_eq!(short_product(x, y), long_product(x, y), "{x:#x} · {y:#x}");
            }
        }
        for square in (1 << 24..1 << 26).step_by(STEP * STEP * STEP) {
            assert_eq!(
                root_by_digits(square),
                root_by_division(square),
                "√{square:#x}"
            );
        }
    }

    #[test]
    fn roots_are_rounded_correctly() {
        for x in numbers() {
            assert!(same(square_root(x), x.sqrt()), "√{x:?}");
        }
        // All significands with either parity of the exponent.
        for bits in (127 << FRACTION_BITS..129 << FRACTION_BITS).step_by(STEP * STEP * STEP) {
            let x = f32::from_bits(bits);
            assert_eq!(square_root(x), x.sqrt(), "√{x:?}");
        }
    }
}
