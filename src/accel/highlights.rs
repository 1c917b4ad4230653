//! Highlights that nobody sees: so far from the mirror direction that adding them leaves every channel of the colour
//! as it is.
//!
//! A channel holds at least the ambient light when a highlight is added, because neither light nor colours are
//! negative and rounding is monotonic. A sum of a colour `c` and less than `u·c/4` rounds to `c`, with `u` the distance from 1
//! to the next number: half the distance from `c` to the next number is at least that. A highlight is the
//! alignment's power, at most 1, times the strengths of light and material; repeated squaring and the two products
//! make it too large by less than a thousandth, for which a factor of 2 is left.

use crate::color::Color;
use crate::material::Material;
use crate::scalar::Scalar;

use super::Source;

/// The [`Scalar::upper_half`] of a number below which an alignment adds no highlight that is seen; 0 if there is no such number.
pub(crate) fn faint_alignment<T: Scalar>(
    source: &Source<'_, T>,
    ambient: T,
    material: &Material<T>,
) -> i16 {
    alignment(source, ambient, material).upper_half()
}

fn alignment<T: Scalar>(source: &Source<'_, T>, ambient: T, material: &Material<T>) -> T {
    let whole = material.whole_shininess();
    // The error of a fractional power is absolute, and larger than what is asked for here.
    if whole == 0 || whole == Material::<T>::FRACTIONAL {
        return T::ZERO;
    }
    let description = material.description();
    let channels = |color: Color<T>| [color.r, color.g, color.b];
    let strongest = source
        .lights
        .iter()
        .flat_map(|light| channels(light.specular * description.specular))
        .fold(T::ZERO, |most, channel| channel.max(most));
    let [r, g, b] = channels(description.ambient * ambient);
    let darkest = -((-r).max(-g).max(-b));
    let power = darkest * (T::EPSILON * T::from_f64(0.125)) / strongest;
    if !(power > T::ZERO && power < T::ONE) {
        return T::ZERO;
    }
    let alignment = power.powf(T::ONE / T::from_i32(i32::from(whole)));
    // More than the error of the power.
    (alignment - T::from_f64(1.0 / 65_536.0)).max(T::ZERO)
}
