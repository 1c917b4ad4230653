//! Quantisation: from linear colour straight to the levels of a display, in one rounding.

use core::fmt;
use core::marker::PhantomData;

use embedded_graphics::pixelcolor::{
    Bgr555, Bgr565, Bgr666, Bgr888, BinaryColor, Gray2, Gray4, Gray8, PixelColor, Rgb555, Rgb565,
    Rgb666, Rgb888, RgbColor,
};

use super::dither;
use crate::color::Color;
use crate::scalar::Scalar;

/// A display's colour that linear colour can be quantised to.
///
/// Implemented for all colours of embedded-graphics. A channel with `levels` steps above 0 becomes
/// `⌊levels·c + threshold⌋`; grey is the [luma](Color::luma). There is no gamma.
pub trait DisplayColor: PixelColor {
    /// A little less than the step between two levels of the finest channel, where 1 is the brightest:
    /// 1/256 for 8 bits. A pixel that is darker by less is at most one level off, with dither too.
    /// For black and white, which has but one step, the step of the shades that dither shows.
    const LEVEL: f32;

    /// The display's colour for a linear colour with channels in 0…1 and a threshold in 0…1, which is ½
    /// without dither.
    fn from_linear<T: Scalar>(color: Color<T>, threshold: T) -> Self;
}

/// `⌊levels·c + threshold⌋`.
#[inline(always)]
fn quantize<T: Scalar>(channel: T, levels: u8, threshold: T) -> u8 {
    T::from_i32(i32::from(levels))
        .times(channel)
        .plus(threshold)
        .to_u32() as u8
}

macro_rules! rgb {
    ($($color:ty),*) => {$(
        impl DisplayColor for $color {
            // No display has more levels of red or blue than of green.
            const LEVEL: f32 = 1.0 / (Self::MAX_G as f32 + 1.0);

            #[inline(always)]
            fn from_linear<T: Scalar>(color: Color<T>, threshold: T) -> Self {
                Self::new(
                    quantize(color.r, Self::MAX_R, threshold),
                    quantize(color.g, Self::MAX_G, threshold),
                    quantize(color.b, Self::MAX_B, threshold),
                )
            }
        }
    )*};
}

rgb!(
    Rgb555, Bgr555, Rgb565, Bgr565, Rgb666, Bgr666, Rgb888, Bgr888
);

macro_rules! gray {
    ($($color:ty: $levels:literal),*) => {$(
        impl DisplayColor for $color {
            const LEVEL: f32 = 1.0 / ($levels as f32 + 1.0);

            #[inline(always)]
            fn from_linear<T: Scalar>(color: Color<T>, threshold: T) -> Self {
                Self::new(quantize(color.luma(), $levels, threshold))
            }
        }
    )*};
}

gray!(Gray2: 3, Gray4: 15, Gray8: 255);

impl DisplayColor for BinaryColor {
    const LEVEL: f32 = 1.0 / 64.0;

    #[inline(always)]
    fn from_linear<T: Scalar>(color: Color<T>, threshold: T) -> Self {
        if color.luma() + threshold >= T::ONE {
            Self::On
        } else {
            Self::Off
        }
    }
}

/// A way from linear colour to a display's colour at a place.
pub trait Quantizer: Copy {
    /// The display's colour.
    type Color: PixelColor;

    /// The display's colour for a linear colour at a pixel.
    fn quantize<T: Scalar>(color: Color<T>, x: u16, y: u16) -> Self::Color;
}

/// Rounds to the nearest level.
pub struct Exact<C>(PhantomData<C>);

/// Rounds by the 8×8 Bayer matrix, so that areas show the shades between two levels.
pub struct Dithered<C>(PhantomData<C>);

/// Rounds to 8 bits a channel and converts from there: for colours of other crates.
pub struct ThroughRgb888<C>(PhantomData<C>);

macro_rules! marker {
    ($($name:ident),*) => {$(
        impl<C> Clone for $name<C> {
            fn clone(&self) -> Self {
                *self
            }
        }
        impl<C> Copy for $name<C> {}
        impl<C> fmt::Debug for $name<C> {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str(stringify!($name))
            }
        }
    )*};
}

marker!(Exact, Dithered, ThroughRgb888);

impl<C: DisplayColor> Quantizer for Exact<C> {
    type Color = C;
    #[inline(always)]
    fn quantize<T: Scalar>(color: Color<T>, _: u16, _: u16) -> C {
        C::from_linear(color, T::HALF)
    }
}

impl<C: DisplayColor> Quantizer for Dithered<C> {
    type Color = C;
    #[inline(always)]
    fn quantize<T: Scalar>(color: Color<T>, x: u16, y: u16) -> C {
        C::from_linear(color, dither::threshold(x, y))
    }
}

impl<C: PixelColor + From<Rgb888>> Quantizer for ThroughRgb888<C> {
    type Color = C;
    #[inline(always)]
    fn quantize<T: Scalar>(color: Color<T>, _: u16, _: u16) -> C {
        Rgb888::from_linear(color, T::HALF).into()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use embedded_graphics::pixelcolor::GrayColor;

    #[test]
    fn rounds_once_to_the_display_levels() {
        // 0.0187 is 0.58 of 31 and 4.77 of 255: by way of 8 bits it would become 5/255 = 0.61 of 31,
        // which rounds the same; 0.0157 is 0.487 of 31 but 4.004 of 255.
        let red = |r: f32| Rgb565::from_linear(Color::new(r, 0.0, 0.0), 0.5).r();
        assert_eq!(
            (red(0.0), red(0.0157), red(0.0165), red(1.0)),
            (0, 0, 1, 31)
        );
        let c = Color::new(0.5_f64, 0.25, 1.0);
        assert_eq!(Rgb888::from_linear(c, 0.5), Rgb888::new(128, 64, 255));
        assert_eq!(Bgr888::from_linear(c, 0.5), Bgr888::new(128, 64, 255));
    }

    #[test]
    fn gray_is_luma_and_binary_is_on_from_one_half() {
        let white = Color::new(1.0_f32, 1.0, 1.0);
        assert_eq!(Gray8::from_linear(white, 0.5).luma(), 255);
        assert_eq!(Gray4::from_linear(white, 63.5 / 64.0).luma(), 15);
        assert_eq!(Gray2::from_linear(white * 0.5, 0.5).luma(), 2);
        let binary = |value| BinaryColor::from_linear(Color::new(value, value, value), 0.5_f64);
        assert_eq!(binary(0.51), BinaryColor::On);
        assert_eq!(binary(0.49), BinaryColor::Off);
    }

    #[test]
    fn dither_shows_shades_between_levels() {
        let gray = Color::new(0.25_f32, 0.25, 0.25);
        let lit = (0..64)
            .filter(|i| Dithered::<BinaryColor>::quantize(gray, i % 8, i / 8).is_on())
            .count();
        assert_eq!(lit, 16);
    }
}
