//! How far a picture is from its references, and why.
//!
//! The difference between what a display shows and R2 is the sum of four, each against a reference of its
//! own, pixel by pixel and channel by channel:
//!
//! * **quantisation**: what the display shows, less the colours before;
//! * **rounding**: the colours, less those of the same settings in `f64`;
//! * **truncation**: those, less the same sampling followed to the end (R1);
//! * **aliasing**: that, less R2.

use serde::Serialize;

use super::linear::Linear;

/// Sizes of the differences between two pictures, in levels of 8 bits: 255 lies between black and white.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub(crate) struct Error {
    /// Root of the mean square over all pixels and channels.
    pub(crate) rmse: f64,
    /// The largest of any pixel and channel.
    pub(crate) max: f64,
    /// Share of the pixels that are more than one level off in some channel.
    pub(crate) share_above_a_level: f64,
}

/// The errors of a picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub(crate) struct Errors {
    pub(crate) quantisation: Error,
    pub(crate) rounding: Error,
    pub(crate) truncation: Error,
    pub(crate) aliasing: Error,
    /// Rounding and truncation together: the colours before quantisation, against R1.
    pub(crate) before_quantisation: Error,
    /// All four together: what the display shows, against R2.
    pub(crate) total: Error,
}

/// Pictures that lie between R2 and what a display shows.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Steps<'a> {
    /// What the display shows, each channel in 0…1.
    pub(crate) shown: &'a Linear,
    /// The colours before quantisation.
    pub(crate) linear: &'a Linear,
    /// The same settings in `f64`.
    pub(crate) exact: &'a Linear,
    /// The same sampling, followed to the end.
    pub(crate) r1: &'a Linear,
    /// Many samples.
    pub(crate) r2: &'a Linear,
}

impl Error {
    /// The error of a picture against a reference of the same size.
    pub(crate) fn between(picture: &Linear, reference: &Linear) -> Self {
        debug_assert_eq!(picture.resolution, reference.resolution);
        let (mut sum, mut max, mut above) = (0.0, 0.0, 0_u64);
        for (a, b) in picture.pixels.iter().zip(&reference.pixels) {
            let levels: [f64; 3] = std::array::from_fn(|i| 255.0 * (a[i] - b[i]).abs());
            // A channel that is no number is as wrong as can be.
            let levels = levels.map(|level| if level.is_nan() { 255.0 } else { level });
            let worst = levels.into_iter().fold(0.0, f64::max);
            sum += levels.iter().map(|level| level * level).sum::<f64>();
            max = f64::max(max, worst);
            above += u64::from(worst > 1.0);
        }
        let pixels = picture.pixels.len().max(1) as f64;
        Self {
            rmse: (sum / (3.0 * pixels)).sqrt(),
            max,
            share_above_a_level: above as f64 / pixels,
        }
    }
}

impl Errors {
    /// Splits the error of what a display shows.
    pub(crate) fn split(steps: &Steps<'_>) -> Self {
        let Steps {
            shown,
            linear,
            exact,
            r1,
            r2,
        } = steps;
        Self {
            quantisation: Error::between(shown, linear),
            rounding: Error::between(linear, exact),
            truncation: Error::between(exact, r1),
            aliasing: Error::between(r1, r2),
            before_quantisation: Error::between(linear, r1),
            total: Error::between(shown, r2),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use scanray::Resolution;

    fn picture(pixels: &[[f64; 3]]) -> Linear {
        Linear {
            resolution: Resolution {
                width: pixels.len() as u16,
                height: 1,
            },
            pixels: pixels.to_vec(),
        }
    }

    #[test]
    fn errors_are_in_levels_of_8_bits() {
        let a = picture(&[[0.0; 3], [0.5, 0.5, 0.5]]);
        let b = picture(&[[0.0; 3], [0.5, 0.5, 0.5 + 2.0 / 255.0]]);
        let error = Error::between(&a, &b);
        assert!((error.rmse - (4.0_f64 / 6.0).sqrt()).abs() < 1e-12);
        assert!((error.max - 2.0).abs() < 1e-12);
        assert_eq!(error.share_above_a_level, 0.5);
        assert_eq!(Error::between(&a, &a), Error::default());
    }

    #[test]
    fn a_channel_that_is_no_number_is_wrong() {
        let error = Error::between(&picture(&[[f64::NAN; 3]]), &picture(&[[0.0; 3]]));
        assert_eq!(error.max, 255.0);
    }
}
