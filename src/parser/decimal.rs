//! Correctly rounded reading of decimal numbers as `f32` and `f64`.
//!
//! The result is the float nearest to the written number, ties to even, for
//! every text of
//!
//! ```text
//! [+-]? ( digits [ '.' digits* ] | '.' digits+ ) ( [eE] [+-]? digits+ )?
//! ```
//!
//! It is found in three steps, with integers only:
//!
//! 1. One pass over the text collects the first 19 significant digits in a
//!    `u64` and the power of ten they are scaled by.
//! 2. The digits are multiplied by that power as 64-bit extended floats, with
//!    a bound on the error. If every number within the bound rounds the same
//!    way, that is the answer. This is the `Bellerophon` algorithm of William
//!    D. Clinger, *How to Read Floating Point Numbers Accurately* (PLDI 1990).
//! 3. Otherwise the number lies next to a known halfway point between two
//!    floats. A second pass compares all digits with that point as big
//!    integers, in the manner of `AlgorithmR` in the same paper and of the digit
//!    comparison by Alexander Huszagh in the `minimal-lexical` and `fast_float`
//!    libraries. For `f32` that happens about once in 2³⁶ random numbers, and
//!    for numbers which are halfway exactly.

use core::cmp::Ordering;

/// Why a text could not be read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum DecimalError {
    /// The text is not a decimal number, or not only that.
    NotANumber,
    /// The number rounds to infinity.
    TooLarge,
}

/// Binary floating-point formats this module can read.
pub trait FromDecimal: Copy {
    /// Reads the whole of `text` as one decimal number.
    ///
    /// The result is correctly rounded, and bit for bit that of [`str::parse`]
    /// for all finite numbers. Too small numbers become subnormal or zero of
    /// the written sign.
    ///
    /// # Errors
    ///
    /// [`DecimalError::NotANumber`] if `text` does not follow the grammar (`inf`
    /// and `nan` do not), [`DecimalError::TooLarge`] if the number rounds to
    /// infinity.
    fn from_decimal(text: &[u8]) -> Result<Self, DecimalError>;
}

impl FromDecimal for f32 {
    fn from_decimal(text: &[u8]) -> Result<Self, DecimalError> {
        read::<Self>(text).map(|bits| Self::from_bits(bits as u32))
    }
}

impl FromDecimal for f64 {
    fn from_decimal(text: &[u8]) -> Result<Self, DecimalError> {
        read::<Self>(text).map(Self::from_bits)
    }
}

/// What the algorithm needs to know about a binary format.
trait Format {
    /// Bits of the significand, with the implicit one.
    const PRECISION: u32;
    /// The smallest positive number is two to this power.
    const MIN_EXPONENT: i32;
    /// The bit of the sign.
    const SIGN: u64;
    /// Significant digits that decide the rounding: no halfway point between
    /// two floats has more, so of the digits behind them it only matters
    /// whether one is not zero.
    const DIGITS: usize;
    /// Exponent of the first power of ten in `POWERS`.
    const FIRST_POWER: isize;
    /// Every eighth power of ten, as by `powers_of_ten`. Numbers of 19 digits
    /// with an exponent below the first round to zero, and those of one digit
    /// with an exponent eight above the last to infinity.
    const POWERS: &'static [u64];
    /// Storage for a big integer.
    type Words: AsRef<[u32]> + AsMut<[u32]>;
    /// The big integer zero.
    const ZERO: Self::Words;
}

// Why `DIGITS` and `Words` are large enough, for p = PRECISION and
// m = MIN_EXPONENT:
//
// Of the halfway points, those between the smallest floats have most digits:
// they are k * 2^(m-1) with k < 2^(p+1), or k * 5^(1-m) with the decimal point
// moved, which is below 10^113 for `f32` and below 10^768 for `f64`.
//
// `compare` makes the integers d * 5^e * 2^s and n * 5^-e * 2^-s, each with the
// positive exponents only, where d < 10^(DIGITS+1), and n < 2^(p+1). It is
// called if the two differ by less than a tenth. Then
// - for e >= 0, they are about n or at most d * 10^e, which is below 10^60 (200
//   bits) for `f32` and 10^332 (1103 bits) for `f64`, as the `POWERS` end there;
// - for e < 0 and s <= 0, they are about d: 379 bits for `f32`, 2555 for `f64`;
// - for e < 0 and s > 0, they are about n * 5^-e. As d * 10^e is about n * 2^x
//   with x >= m - 1, and 5 = 10^0.699, that is n^0.301 * (d / 2^x)^0.699, at
//   most 378 bits for `f32` and 2554 for `f64`.
// 12 words have 384 bits, and 80 words 2560.

impl Format for f32 {
    const PRECISION: u32 = 24;
    const MIN_EXPONENT: i32 = -149;
    const SIGN: u64 = 1 << 31;
    const DIGITS: usize = 113;
    const FIRST_POWER: isize = -72; // 10^(19 - 73) < 2^-150
    const POWERS: &'static [u64] = &powers_of_ten::<14>(-72, 8); // to 10^32
    type Words = [u32; 12];
    const ZERO: Self::Words = [0; 12];
}

impl Format for f64 {
    const PRECISION: u32 = 53;
    const MIN_EXPONENT: i32 = -1074;
    const SIGN: u64 = 1 << 63;
    const DIGITS: usize = 768;
    const FIRST_POWER: isize = -344; // 10^(19 - 345) < 2^-1075
    const POWERS: &'static [u64] = &powers_of_ten::<82>(-344, 8); // to 10^304
    type Words = [u32; 80];
    const ZERO: Self::Words = [0; 80];
}

/// Powers of ten that step from one entry of `Format::POWERS` to the next.
const SMALL_POWERS: &[u64; 8] = &powers_of_ten(0, 1);

/// Digits that always fit in a `u64`.
const WORD_DIGITS: u32 = 19;

/// Returns the bits of the float nearest to the number in `text`.
fn read<F: Format>(text: &[u8]) -> Result<u64, DecimalError> {
    let (sign, text) = split_sign(text);
    let sign = if sign { F::SIGN } else { 0 };

    // The number is `digits` times ten to the power of `exponent`, but for the
    // unread digits.
    let mut digits = 0;
    let mut unread = 0; // count of those behind the first 19 significant ones
    let mut fraction = 0; // count of those behind the point
    let mut exponent = 0;
    let mut any = false;
    let mut point = false;
    let mut bytes = text.iter();
    while let Some(&byte) = bytes.next() {
        if let Some(digit) = digit(byte) {
            any = true;
            if digits < 10_u64.pow(WORD_DIGITS - 1) {
                digits = digits * 10 + u64::from(digit);
            } else {
                unread += 1;
            }
            fraction += isize::from(point);
        } else if byte == b'.' && !point {
            point = true;
        } else if byte | 0x20 == b'e' && any {
            exponent = read_exponent(bytes.as_slice())?;
            break;
        } else {
            return Err(DecimalError::NotANumber);
        }
    }
    if !any {
        return Err(DecimalError::NotANumber);
    }
    if digits == 0 {
        return Ok(sign);
    }
    exponent = exponent.saturating_add(unread - fraction);

    // An exponent below the table becomes a huge index. (The index of the small
    // power is always good.)
    let index = exponent.wrapping_sub(F::FIRST_POWER) >> 3;
    let (Some(&power), Some(&small)) = (
        F::POWERS.get(index.cast_unsigned()),
        SMALL_POWERS.get((exponent & 7).cast_unsigned()),
    ) else {
        return if exponent < 0 {
            Ok(sign)
        } else {
            Err(DecimalError::TooLarge)
        };
    };
    let exponent = exponent as i32;

    // Find m with 64 bits such that the number is at least m * 2^x and less than
    // (m + error) * 2^x. Unread digits start with an error of 16, as 19 digits
    // have at least 60 bits. A product adds less than 1 for rounding down, and 1
    // more for a rounded power, and its normalization doubles that: less than
    // ((0 + 1) * 2 + 2) * 2 = 8 or ((16 + 1) * 2 + 2) * 2 = 72. One more is for
    // the shift of subnormal numbers, and one for the safe side.
    let up = digits.leading_zeros();
    let mut m = digits << up;
    let mut x = -(up.cast_signed());
    for (power, exponent) in [(small, exponent & 7), (power, exponent & !7)] {
        m = high_product(m, power);
        let up = !m >> 63;
        m <<= up;
        x += binary_exponent(exponent) + 1 - up as i32;
    }
    let error = if unread == 0 { 10 } else { 74 };

    // Now x is the exponent of the last bit in the result. Subnormal numbers
    // have fewer bits.
    let spare = 64 - F::PRECISION;
    x += spare.cast_signed();
    m >>= (F::MIN_EXPONENT - x).clamp(0, 63);
    x = x.max(F::MIN_EXPONENT);

    let floor = m >> spare;
    let rest = m & ((1 << spare) - 1);
    let half = 1_u64 << (spare - 1);
    let round_up = if half.wrapping_sub(rest) < error {
        match compare::<F>(text, exponent, 2 * floor + 1, x - 1) {
            Ordering::Less => false,
            Ordering::Equal => floor & 1 == 1,
            Ordering::Greater => true,
        }
    } else {
        rest > half
    };

    // The implicit bit adds one to the exponent field of normal numbers.
    let field = u64::from((x - F::MIN_EXPONENT).cast_unsigned());
    let bits = (field << (F::PRECISION - 1)) + floor + u64::from(round_up);
    if bits < F::SIGN - (1 << (F::PRECISION - 1)) {
        Ok(sign | bits)
    } else {
        Err(DecimalError::TooLarge)
    }
}

/// Compares the number in `text`, which has no sign, with `n` times two to the
/// power of `x`. The 19th significant digit of the text, or the last one if there
/// are fewer, is worth ten to the power of `exponent`.
#[cold]
#[inline(never)]
fn compare<F: Format>(text: &[u8], mut exponent: i32, n: u64, x: i32) -> Ordering {
    let mut left = Integer::<F>::new(0);
    let mut right = Integer::<F>::new(n);

    let mut digits = text
        .iter()
        .take_while(|&&byte| byte | 0x20 != b'e')
        .filter_map(|&byte| digit(byte))
        .skip_while(|&digit| digit == 0);
    for (i, digit) in digits.by_ref().take(F::DIGITS).enumerate() {
        left.multiply_add(10, digit.into());
        exponent -= i32::from(i >= WORD_DIGITS as usize);
    }
    // One more digit stands for all the others.
    if digits.any(|digit| digit != 0) {
        left.multiply_add(10, 1);
        exponent -= 1;
    }

    let shift = exponent - x;
    let (fives, twos) = (exponent.unsigned_abs(), shift.unsigned_abs());
    if exponent > 0 { &mut left } else { &mut right }.scale(5, 13, fives);
    if shift > 0 { &mut left } else { &mut right }.scale(2, 31, twos);
    left.cmp(&right)
}

/// A big integer, the least significant word first. Words behind `len` are zero.
struct Integer<F: Format> {
    words: F::Words,
    len: usize,
}

impl<F: Format> Integer<F> {
    fn new(value: u64) -> Self {
        let mut result = Self {
            words: F::ZERO,
            len: 0,
        };
        result.multiply_add(1, value);
        result
    }

    /// Multiplies by `factor` and adds `carry`, which may have more than 32 bits
    /// if the number is zero.
    #[inline(never)] // for size
    fn multiply_add(&mut self, factor: u32, mut carry: u64) {
        for (i, word) in self.words.as_mut().iter_mut().enumerate() {
            if i >= self.len {
                if carry == 0 {
                    break;
                }
                self.len = i + 1;
            }
            let sum = u64::from(*word) * u64::from(factor) + carry;
            *word = sum as u32;
            carry = sum >> 32;
        }
    }

    /// Multiplies by `base` to the power of `exponent`, in steps of at most
    /// `base` to the power of `step`, which fits in a word.
    fn scale(&mut self, base: u32, step: u32, mut exponent: u32) {
        while exponent > 0 {
            let now = exponent.min(step);
            self.multiply_add(base.wrapping_pow(now), 0);
            exponent -= now;
        }
    }

    fn cmp(&self, other: &Self) -> Ordering {
        let (left, right) = (self.words.as_ref(), other.words.as_ref());
        left.iter().rev().cmp(right.iter().rev())
    }
}

/// The value of a decimal digit.
fn digit(byte: u8) -> Option<u8> {
    let value = byte.wrapping_sub(b'0');
    (value < 10).then_some(value)
}

/// Takes the sign from the front, and tells if it is a minus.
fn split_sign(text: &[u8]) -> (bool, &[u8]) {
    match text {
        [b'-', rest @ ..] => (true, rest),
        [b'+', rest @ ..] => (false, rest),
        _ => (false, text),
    }
}

/// Reads the text behind the `e`. A large number becomes the largest, which no
/// text that fits in memory has the digits to bring back into range.
fn read_exponent(text: &[u8]) -> Result<isize, DecimalError> {
    let (negative, text) = split_sign(text);
    if text.is_empty() {
        return Err(DecimalError::NotANumber);
    }
    let mut value = 0;
    for &byte in text {
        let digit = digit(byte).ok_or(DecimalError::NotANumber)?;
        value = if value < isize::MAX / 10 {
            value * 10 + isize::from(digit)
        } else {
            isize::MAX
        };
    }
    Ok(if negative { -value } else { value })
}

/// The upper half of the product. Compilers make this a few 32-bit products where
/// there are no larger ones.
fn high_product(a: u64, b: u64) -> u64 {
    ((u128::from(a) * u128::from(b)) >> 64) as u64
}

/// The greatest power of two in ten to the power of `exponent`, which must be
/// within ±400.
fn binary_exponent(exponent: i32) -> i32 {
    (exponent * 217_706) >> 16 // log2(10) * 2^16
}

/// `N` powers of ten, with exponents from `first` in steps of `step`, as the
/// first 64 bits of their significands. Only for constants.
const fn powers_of_ten<const N: usize>(first: i32, step: i32) -> [u64; N] {
    let mut table = [0; N];
    let mut i = 0;
    let mut exponent = first;
    while i < N {
        // Rounding down to 124 bits at most 400 times leaves more than 64
        // correct, and positive powers up to 10^53 exact.
        let mut power: u128 = 1 << 123;
        let mut n = 0;
        while n < exponent.abs() {
            power = if exponent > 0 {
                power * 10
            } else {
                (power << 4) / 10
            };
            power = power << power.leading_zeros() >> 4;
            n += 1;
        }
        table[i] = (power >> 60) as u64;
        exponent += step;
        i += 1;
    }
    table
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::{format, string::String, vec, vec::Vec};

    /// The generator splitmix64.
    struct Random(u64);

    impl Random {
        fn bits(&mut self) -> u64 {
            self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
            let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
            let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
            z ^ (z >> 31)
        }

        /// A number from 0 to `end - 1`.
        fn below(&mut self, end: usize) -> usize {
            (self.bits() % end as u64) as usize
        }

        fn digits(&mut self, count: usize) -> String {
            (0..count)
                .map(|_| char::from(b'0' + self.below(10) as u8))
                .collect()
        }
    }

    /// How often to repeat a test.
    fn times(release: usize) -> usize {
        if cfg!(debug_assertions) {
            release / 40
        } else {
            release
        }
    }

    fn zeros(count: usize) -> String {
        "0".repeat(count)
    }

    /// Compares with the standard library.
    fn check(text: &str) {
        let value: f32 = text.parse().unwrap();
        let expected = if value.is_finite() {
            Ok(value.to_bits())
        } else {
            Err(DecimalError::TooLarge)
        };
        assert_eq!(
            f32::from_decimal(text.as_bytes()).map(f32::to_bits),
            expected,
            "{text}"
        );

        let value: f64 = text.parse().unwrap();
        let expected = if value.is_finite() {
            Ok(value.to_bits())
        } else {
            Err(DecimalError::TooLarge)
        };
        assert_eq!(
            f64::from_decimal(text.as_bytes()).map(f64::to_bits),
            expected,
            "{text}"
        );
    }

    /// The halfway point above the positive float with these bits, as `n` and
    /// `x` in n * 2^x.
    fn halfway_above<F: Format>(bits: u64) -> (u64, i32) {
        let implicit = 1 << (F::PRECISION - 1);
        let (field, fraction) = (bits / implicit, bits % implicit);
        let floor = if field == 0 {
            fraction
        } else {
            fraction + implicit
        };
        (
            2 * floor + 1,
            F::MIN_EXPONENT + (field as i32 - 1).max(0) - 1,
        )
    }

    /// All digits of n * 2^x, and the exponent of the last one.
    fn exact(n: u64, x: i32) -> (String, i32) {
        const BASE: u64 = 1_000_000_000;
        let mut limbs = vec![n % BASE, n / BASE % BASE, n / BASE / BASE];
        for _ in 0..x.abs() {
            let mut carry = 0;
            for limb in &mut limbs {
                let product = *limb * if x < 0 { 5 } else { 2 } + carry;
                *limb = product % BASE;
                carry = product / BASE;
            }
            if carry > 0 {
                limbs.push(carry);
            }
        }
        let digits: String = limbs
            .iter()
            .rev()
            .map(|limb| format!("{limb:09}"))
            .collect();
        (digits.trim_start_matches('0').into(), x.min(0))
    }

    /// Checks the number n * 2^x and some very near.
    fn check_near(n: u64, x: i32) {
        let (digits, exponent) = exact(n, x);
        check(&format!("{digits}e{exponent}"));
        check(&format!("-{digits}{}e{}", zeros(1000), exponent - 1000));
        check(&format!("{digits}{}1e{}", zeros(1000), exponent - 1001));

        // One less in the last digit.
        let kept = digits.trim_end_matches('0');
        let (kept, last) = kept.split_at(kept.len() - 1);
        let last = last.parse::<u8>().unwrap() - 1;
        let nines = "9".repeat(digits.len() - kept.len() - 1);
        check(&format!("{kept}{last}{nines}e{exponent}"));
        check(&format!("{kept}{last}{nines}9e{}", exponent - 1));
        check(&format!(
            "{kept}{last}{nines}{}e{}",
            "9".repeat(1000),
            exponent - 1000
        ));

        // Without an exponent.
        let point = digits.len() as i32 + exponent;
        if point > 0 {
            let (whole, fraction) = digits.split_at(point as usize);
            check(&format!("{whole}.{fraction}"));
            check(&format!("+{whole}.{fraction}0000001"));
        } else {
            check(&format!(
                ".{}{digits}",
                zeros(point.unsigned_abs() as usize)
            ));
            check(&format!(
                "-0.{}{digits}2",
                zeros(point.unsigned_abs() as usize)
            ));
        }

        // Around the digits that are read at first.
        for length in 15..23.min(digits.len()) {
            let exponent = exponent + (digits.len() - length) as i32;
            let head: u128 = digits[..length].parse().unwrap();
            for head in head - 1..=head + 2 {
                check(&format!("{head}e{exponent}"));
            }
        }
    }

    #[test]
    fn random_decimals() {
        let mut random = Random(1);
        for _ in 0..times(400_000) {
            let sign = ["", "-", "+"][random.below(3)];
            let (whole, fraction) = (random.below(12) + 1, random.below(12));
            let (whole, fraction) = (random.digits(whole), random.digits(fraction));
            check(&format!("{sign}{whole}.{fraction}"));
            check(&format!(
                "{sign}{whole}.{fraction}e{}",
                random.below(120) as i32 - 70
            ));
            check(&format!(
                "{sign}.{whole}{fraction}E{:+}",
                random.below(700) as i32 - 350
            ));
        }
    }

    #[test]
    fn prints_of_random_floats() {
        let mut random = Random(2);
        for _ in 0..times(200_000) {
            let bits = random.bits();
            let (single, double) = (f32::from_bits(bits as u32), f64::from_bits(bits));
            if single.is_finite() {
                assert_eq!(
                    f32::from_decimal(format!("{single}").as_bytes()),
                    Ok(single)
                );
                check(&format!("{single:e}"));
                check(&format!("{single:.0$e}", random.below(12)));
            }
            if double.is_finite() {
                assert_eq!(
                    f64::from_decimal(format!("{double:e}").as_bytes()),
                    Ok(double)
                );
                check(&format!("{double:e}"));
                check(&format!("{double:.0$e}", random.below(25)));
            }
        }
    }

    #[test]
    fn halfway_points() {
        let mut random = Random(3);
        // Of every exponent.
        for field in (0..0xff).step_by(if cfg!(debug_assertions) { 5 } else { 1 }) {
            for fraction in [0, 1, 0x7f_ffff, random.bits() >> 41, random.bits() >> 41] {
                let (n, x) = halfway_above::<f32>((field << 23) + fraction);
                check_near(n, x);
            }
        }
        for field in (0..0x7ff).step_by(if cfg!(debug_assertions) { 200 } else { 7 }) {
            for fraction in [0, (1 << 52) - 1, random.bits() >> 12] {
                let (n, x) = halfway_above::<f64>((field << 52) + fraction);
                check_near(n, x);
            }
        }
        // Short ones.
        for _ in 0..times(20_000) {
            let n = (random.bits() >> 39) | (1 << 24) | 1;
            check_near(n, random.below(20) as i32 - 10);
            let n = (random.bits() >> 10) | (1 << 53) | 1;
            check_near(n, random.below(20) as i32 - 10);
        }
    }

    #[test]
    fn subnormal_numbers() {
        let mut random = Random(4);
        for bits in (0..20).chain(0x7f_fff0..0x80_0010) {
            let (n, x) = halfway_above::<f32>(bits);
            check_near(n, x);
            check_near(n - 1 + u64::from(bits == 0), x);
        }
        for bits in (0..2).chain((1 << 52) - 1..(1 << 52) + 1) {
            let (n, x) = halfway_above::<f64>(bits);
            check_near(n, x);
        }
        for _ in 0..times(1000) {
            let (n, x) = halfway_above::<f32>(random.bits() >> 41);
            check_near(n, x);
            let (n, x) = halfway_above::<f64>(random.bits() >> (12 + random.below(52)));
            check_near(n, x);
        }
        for text in [
            "7e-46", "7.1e-46", "1e-45", "-1e-46", "2e-324", "3e-324", "-1e-325", "1e-400",
        ] {
            check(text);
        }
        assert_eq!(f32::from_decimal(b"-1e-50").map(f32::to_bits), Ok(1 << 31));
    }

    #[test]
    fn largest_numbers() {
        for below in 0..3 {
            let (n, x) = halfway_above::<f32>(0x7f7f_ffff - below);
            check_near(n, x);
            let (n, x) = halfway_above::<f64>(0x7fef_ffff_ffff_ffff - below);
            check_near(n, x);
        }
        assert_eq!(f32::from_decimal(b"3.4028235e38"), Ok(f32::MAX));
        assert_eq!(
            f32::from_decimal(b"-3.4028236e38"),
            Err(DecimalError::TooLarge)
        );
        assert_eq!(f64::from_decimal(b"1.7976931348623157e308"), Ok(f64::MAX));
        assert_eq!(
            f64::from_decimal(b"1.7976931348623159e308"),
            Err(DecimalError::TooLarge)
        );
        for exponent in [38, 39, 40, 41, 60, 308, 309, 312, 313, 1000] {
            check(&format!("1e{exponent}"));
            check(&format!("-9.99999999999999999999e{exponent}"));
            check(&format!("{}1e{}", zeros(50), exponent));
        }
    }

    #[test]
    fn long_numbers() {
        let mut random = Random(5);
        for count in [113, 114, 115, 768, 769, 770, 1000, 5000, 100_000] {
            let digits = random.digits(count);
            check(&digits);
            check(&format!("0.{digits}"));
            check(&format!("{}.{digits}", zeros(count)));
            check(&format!("7.{digits}e-{count}"));
            check(&format!("{digits}e-{count}"));
            check(&format!("{digits}.{digits}e-{}", count + 300));
            check(&format!("3{}", zeros(count)));
            check(&format!("3{}e-{count}", zeros(count)));
            check(&format!("{}3{}e-{}", zeros(count), zeros(count), count - 1));
            check(&format!("0.{}1e{}", zeros(count), count + 1));
            check(&format!(
                "0.{}1{}e{}",
                zeros(count),
                zeros(count),
                count - 44
            ));
            check(&format!("16777217.{}1", zeros(count)));
            check(&format!("9007199254740993.{}", zeros(count)));
        }
        check(&format!("0.{}1e401", zeros(400)));
        check(&format!("1{}e-401", zeros(400)));
    }

    #[test]
    fn exponents_of_any_length() {
        for digits in [1, 2, 3, 4, 9, 10, 11, 18, 19, 20, 21, 1000] {
            let nines = "9".repeat(digits);
            for number in [
                "1",
                "0",
                "-0",
                "-.5",
                "00.0e",
                &format!("{}1", zeros(99)),
                "1234567890123456789012",
            ] {
                let number = number.trim_end_matches('e');
                check(&format!("{number}e{nines}"));
                check(&format!("{number}e-{nines}"));
                check(&format!("{number}e+{}{nines}", zeros(digits)));
                check(&format!("{number}e{}12", zeros(digits)));
            }
        }
        for exponent in [
            isize::MAX as i128,
            isize::MIN as i128,
            i64::MAX as i128,
            1 << 32,
        ] {
            for near in exponent - 20..exponent + 20 {
                check(&format!("123456789012345678901.5e{near}"));
                check(&format!("0.000000000000000000001e{near}"));
            }
        }
    }

    #[test]
    fn zeros_keep_their_sign() {
        for text in [
            "0",
            "-0",
            "+0",
            "0.",
            ".0",
            "-.0",
            "-0e5",
            "0000.0000e-9",
            "-0.0e99999999999",
        ] {
            check(text);
        }
        assert_eq!(f32::from_decimal(b"-0").map(f32::to_bits), Ok(1 << 31));
    }

    /// The grammar, written differently.
    fn is_number(text: &[u8]) -> bool {
        fn unsigned(text: &[u8]) -> &[u8] {
            text.strip_prefix(b"+")
                .or(text.strip_prefix(b"-"))
                .unwrap_or(text)
        }
        let digits = |text: &[u8]| text.iter().all(u8::is_ascii_digit);
        let mut parts = unsigned(text).splitn(2, |byte| matches!(byte, b'e' | b'E'));
        let number: Vec<_> = parts
            .next()
            .unwrap_or_default()
            .split(|&byte| byte == b'.')
            .collect();
        number.len() <= 2
            && number.iter().all(|part| digits(part))
            && number.iter().any(|part| !part.is_empty())
            && parts
                .next()
                .map(unsigned)
                .is_none_or(|text| !text.is_empty() && digits(text))
    }

    #[test]
    fn garbage() {
        let check_any = |text: &[u8]| {
            if is_number(text) {
                check(str::from_utf8(text).unwrap());
            } else {
                assert_eq!(
                    f32::from_decimal(text),
                    Err(DecimalError::NotANumber),
                    "{text:?}"
                );
                assert_eq!(
                    f64::from_decimal(text),
                    Err(DecimalError::NotANumber),
                    "{text:?}"
                );
            }
        };
        for text in [
            "",
            "+",
            "-",
            ".",
            "-.",
            "+.e1",
            "e",
            "e5",
            ".e5",
            "1e",
            "1e+",
            "1e-",
            "1.e",
            "0x1",
            "1_0",
            "1 ",
            " 1",
            "1 2",
            "inf",
            "-inf",
            "infinity",
            "nan",
            "NaN",
            "--1",
            "+-1",
            "1-",
            "1.2.3",
            "1..2",
            "1e5.0",
            "1e5e5",
            "1ee5",
            "1e 5",
            "1f",
            "1e5_0",
            "1\0",
            "\u{661}",
            "1,5",
            "0e",
            "0.0x",
            "1e99999999999999999999x",
        ] {
            assert!(!is_number(text.as_bytes()), "{text}");
            check_any(text.as_bytes());
        }
        for text in ["1.", "1.e5", ".5", "+.5E-0", "00", "1E+05"] {
            assert!(is_number(text.as_bytes()), "{text}");
            check_any(text.as_bytes());
        }

        let mut random = Random(6);
        for _ in 0..times(1_000_000) {
            let length = random.below(12);
            let likely: Vec<u8> = (0..length)
                .map(|_| b"0123456789015..eE+-x \xff"[random.below(22)])
                .collect();
            check_any(&likely);
            let any: Vec<u8> = (0..length).map(|_| random.bits() as u8).collect();
            check_any(&any);
        }
    }

    #[test]
    fn powers_of_ten_are_rounded_down() {
        // Every power in the tables is the first 64 bits of the exact one:
        // power <= 10^exponent / 2^x < power + 1.
        let tables = [
            (f32::FIRST_POWER, 8, f32::POWERS),
            (f64::FIRST_POWER, 8, f64::POWERS),
            (0, 1, &SMALL_POWERS[..]),
        ];
        for (first, step, table) in tables {
            for (i, &power) in table.iter().enumerate() {
                assert!(power >> 63 == 1);
                let exponent = (first + i as isize * step) as i32;
                let x = binary_exponent(exponent) - 63;
                let mut one = Integer::<f64>::new(1);
                let mut low = Integer::<f64>::new(power);
                let mut high = Integer::<f64>::new(power);
                high.multiply_add(1, 1);
                for (base, count) in [(5, exponent), (2, exponent - x)] {
                    if count > 0 {
                        one.scale(base, 1, count.unsigned_abs());
                    } else {
                        low.scale(base, 1, count.unsigned_abs());
                        high.scale(base, 1, count.unsigned_abs());
                    }
                }
                assert!(
                    low.cmp(&one).is_le() && one.cmp(&high).is_lt(),
                    "10^{exponent}"
                );
            }
        }
    }
}
