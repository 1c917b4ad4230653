//! Ordered dither by position.

use crate::scalar::Scalar;

/// The 8×8 threshold matrix of Bayer (1973): each number from 0 to 63 once, neighbours far apart.
const BAYER: [[u8; 8]; 8] = [
    [0, 32, 8, 40, 2, 34, 10, 42],
    [48, 16, 56, 24, 50, 18, 58, 26],
    [12, 44, 4, 36, 14, 46, 6, 38],
    [60, 28, 52, 20, 62, 30, 54, 22],
    [3, 35, 11, 43, 1, 33, 9, 41],
    [51, 19, 59, 27, 49, 17, 57, 25],
    [15, 47, 7, 39, 13, 45, 5, 37],
    [63, 31, 55, 23, 61, 29, 53, 21],
];

/// What is added before rounding down, in place of ½: evenly spread over 0…1 and on average ½. It
/// depends on the position alone, so that any part of a picture can be drawn by itself.
#[inline(always)]
pub(super) fn threshold<T: Scalar>(x: u16, y: u16) -> T {
    let level = BAYER[usize::from(y % 8)][usize::from(x % 8)];
    (T::from_i32(i32::from(level)) + T::HALF) * (T::ONE / T::from_i32(64))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::vec::Vec;

    #[test]
    fn thresholds_are_all_different_and_average_one_half() {
        let mut all: Vec<f32> = (0..64).map(|i| threshold(i % 8, i / 8)).collect();
        assert_eq!(all.iter().sum::<f32>(), 32.0);
        all.sort_by(f32::total_cmp);
        all.dedup();
        assert_eq!(all.len(), 64);
        assert!(all[0] > 0.0 && all[63] < 1.0);
    }

    #[test]
    fn the_matrix_is_the_recursive_one() {
        // Bayer's rule: the bits of x ^ y and y, interleaved, in reverse.
        for y in 0..8_u16 {
            for x in 0..8_u16 {
                let mut value = 0;
                for bit in 0..3 {
                    value = value << 2 | ((x ^ y) >> bit & 1) << 1 | (y >> bit & 1);
                }
                assert_eq!(u16::from(BAYER[usize::from(y)][usize::from(x)]), value);
            }
        }
    }
}
