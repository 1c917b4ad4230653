//! The colour spaces of FLIP: from sRGB to the opponent space YCxCz and to CIELAB.

/// Three coordinates of a colour.
pub(super) type Triple = [f32; 3];

/// Linear sRGB to CIE XYZ (IEC 61966-2-1, as exact fractions).
const XYZ_FROM_RGB: [[f64; 3]; 3] = [
    [
        10_135_552.0 / 24_577_794.0,
        8_788_810.0 / 24_577_794.0,
        4_435_075.0 / 24_577_794.0,
    ],
    [
        2_613_072.0 / 12_288_897.0,
        8_788_810.0 / 12_288_897.0,
        887_015.0 / 12_288_897.0,
    ],
    [
        1_425_312.0 / 73_733_382.0,
        8_788_810.0 / 73_733_382.0,
        70_074_185.0 / 73_733_382.0,
    ],
];

/// Its inverse.
const RGB_FROM_XYZ: [[f64; 3]; 3] = inverse(&XYZ_FROM_RGB);

/// XYZ of white, (1, 1, 1).
const WHITE: [f64; 3] = product(&XYZ_FROM_RGB, [1.0; 3]);

const fn product(m: &[[f64; 3]; 3], [a, b, c]: [f64; 3]) -> [f64; 3] {
    [
        m[0][0] * a + m[0][1] * b + m[0][2] * c,
        m[1][0] * a + m[1][1] * b + m[1][2] * c,
        m[2][0] * a + m[2][1] * b + m[2][2] * c,
    ]
}

/// By Cramer's rule.
const fn inverse(m: &[[f64; 3]; 3]) -> [[f64; 3]; 3] {
    const fn minor(m: &[[f64; 3]; 3], row: usize, column: usize) -> f64 {
        let (r, s) = ((row + 1) % 3, (row + 2) % 3);
        let (c, d) = ((column + 1) % 3, (column + 2) % 3);
        m[r][c] * m[s][d] - m[r][d] * m[s][c]
    }
    let determinant =
        m[0][0] * minor(m, 0, 0) + m[0][1] * minor(m, 0, 1) + m[0][2] * minor(m, 0, 2);
    let mut result = [[0.0; 3]; 3];
    let mut row = 0;
    while row < 3 {
        let mut column = 0;
        while column < 3 {
            result[column][row] = minor(m, row, column) / determinant;
            column += 1;
        }
        row += 1;
    }
    result
}

/// The linear intensity, 0 to 1, that an 8-bit value of sRGB stands for.
pub(super) fn linear(value: u8) -> f32 {
    let value = f64::from(value) / 255.0;
    let linear = if value <= 0.04045 {
        value / 12.92
    } else {
        ((value + 0.055) / 1.055).powf(2.4)
    };
    linear as f32
}

/// XYZ relative to white.
fn relative_xyz(rgb: Triple) -> [f64; 3] {
    let [x, y, z] = product(&XYZ_FROM_RGB, rgb.map(f64::from));
    [x / WHITE[0], y / WHITE[1], z / WHITE[2]]
}

/// YCxCz of a linear colour: CIELAB without its cube roots.
pub(super) fn ycxcz_from_rgb(rgb: Triple) -> Triple {
    let [x, y, z] = relative_xyz(rgb);
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)].map(|c| c as f32)
}

/// The linear colour of YCxCz.
pub(super) fn rgb_from_ycxcz([luma, cx, cz]: Triple) -> Triple {
    let y = (f64::from(luma) + 16.0) / 116.0;
    let x = f64::from(cx) / 500.0 + y;
    let z = y - f64::from(cz) / 200.0;
    let xyz = [x * WHITE[0], y * WHITE[1], z * WHITE[2]];
    product(&RGB_FROM_XYZ, xyz).map(|c| c as f32)
}

/// CIELAB (CIE 15) of a linear colour, relative to sRGB's white.
pub(super) fn lab_from_rgb(rgb: Triple) -> Triple {
    const DELTA: f64 = 6.0 / 29.0;
    let [x, y, z] = relative_xyz(rgb).map(|t| {
        if t > DELTA * DELTA * DELTA {
            t.cbrt()
        } else {
            t / (3.0 * DELTA * DELTA) + 4.0 / 29.0
        }
    });
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)].map(|c| c as f32)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn close(a: Triple, b: Triple, tolerance: f32) -> bool {
        a.iter().zip(b).all(|(a, b)| (a - b).abs() <= tolerance)
    }

    #[test]
    fn lab_of_the_primaries_is_the_published_one() {
        // Lindbloom's calculator, sRGB with its own white D65.
        for (rgb, lab) in [
            ([1.0, 1.0, 1.0], [100.0, 0.0, 0.0]),
            ([0.0, 0.0, 0.0], [0.0, 0.0, 0.0]),
            ([1.0, 0.0, 0.0], [53.24, 80.09, 67.20]),
            ([0.0, 1.0, 0.0], [87.73, -86.18, 83.18]),
            ([0.0, 0.0, 1.0], [32.30, 79.19, -107.86]),
        ] {
            assert!(
                close(lab_from_rgb(rgb), lab, 0.02),
                "{:?}",
                lab_from_rgb(rgb)
            );
        }
    }

    #[test]
    fn ycxcz_goes_both_ways() {
        for rgb in [[0.0, 0.0, 0.0], [1.0, 1.0, 1.0], [0.2, 0.7, 0.05]] {
            assert!(close(rgb_from_ycxcz(ycxcz_from_rgb(rgb)), rgb, 1e-6));
        }
        assert!(close(ycxcz_from_rgb([1.0; 3]), [100.0, 0.0, 0.0], 1e-4));
    }

    #[test]
    fn srgb_is_linear_near_black_and_ends_at_1() {
        assert_eq!(linear(0), 0.0);
        assert!((linear(10) - 10.0 / 255.0 / 12.92).abs() < 1e-9);
        assert!((linear(128) - 0.215_860_5).abs() < 1e-6);
        assert_eq!(linear(255), 1.0);
    }
}
