//! Light on a surface (Phong 1975), and what is behind everything.

use crate::color::Color;
use crate::number::Number;
use crate::vec3::Vec3;

/// What an intensity of light on a share of reflected light adds.
///
/// Light first, then material: a factor ≤ 1 keeps the product finite, so that 0·∞ cannot arise from bright lights on bright
/// materials.
#[inline(always)]
pub fn reflected<N: Number>(light: Color<N>, factor: N, share: Color<N>) -> Color<N> {
    light * factor * share
}

/// `R·V` of the mirrored light `R = 2(N·L)N − L` and the view `V = −direction`: `cosine` is N·L, `hit_cosine` N·V.
#[inline(always)]
pub fn alignment<N: Number>(cosine: N, hit_cosine: N, to_light: Vec3<N>, direction: Vec3<N>) -> N {
    cosine.double() * hit_cosine + to_light.dot(direction)
}

/// `base^exponent` by repeated squaring; `x⁰ = 1`.
#[inline(always)]
pub fn power<N: Number>(base: N, exponent: u16) -> N {
    let (mut base, mut exponent) = (base, exponent);
    let mut power = base.constant(1.0);
    loop {
        if exponent & 1 != 0 {
            power = power * base;
        }
        exponent >>= 1;
        if exponent == 0 {
            return power;
        }
        base = base * base;
    }
}

/// The sky above the `y` of a direction of length 1: white at the nadir, (½, 0.7, 1) at the zenith.
#[inline(always)]
pub fn sky<N: Number>(y: N) -> Color<N> {
    let one = y.constant(1.0);
    let s = (y + one).halve();
    let white = one - s;
    Color::new(white + s.halve(), white + s * s.constant(0.7), white + s)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn whole_powers_are_those_of_the_standard_library() {
        for exponent in [0_u16, 1, 2, 3, 50, 255, 1024] {
            for base in [0.0_f64, 0.1, 0.5, 0.99, 0.9999, 1.0] {
                let exact = base.powi(i32::from(exponent));
                assert!((power(base, exponent) - exact).abs() < 1e-12);
            }
        }
    }
}
