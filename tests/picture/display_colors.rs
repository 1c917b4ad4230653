//! From linear colour to the colours of displays: one rounding, straight to the display's levels, and
//! dither by position.

use std::fmt::Debug;

use embedded_graphics::pixelcolor::{
    Bgr555, Bgr565, Bgr666, Bgr888, BinaryColor, Gray2, Gray4, Gray8, GrayColor, PixelColor,
    Rgb555, Rgb565, Rgb666, Rgb888, RgbColor,
};
use scanray::{
    Color, Picture, Resolution, Scalar,
    render::{DisplayColor, Dithered, Exact, PixelSource, Quantizer, ThroughRgb888},
};

use crate::common::random::Random;
use crate::common::sampling;

/// Steps of the ramp: its products with up to 255 levels are exact in f32, so that no rounding of the
/// crate's own arithmetic excuses a wrong level.
const STEPS: u32 = 1 << 16;

/// `⌊levels·c + ½⌋` for `c = step/STEPS`, in whole numbers.
fn level(levels: u32, step: u32) -> u8 {
    ((levels * step + STEPS / 2) / STEPS) as u8
}

fn at<T: Scalar>(step: u32) -> T {
    T::from_f64(f64::from(step) / f64::from(STEPS))
}

/// The colour of a picture whose pixels all have this linear colour.
fn shown<Q: Quantizer, T: Scalar>(color: Color<T>, x: u16, y: u16) -> Q::Color {
    Q::quantize(color, x, y)
}

fn rgb_is_rounded_once<C: DisplayColor + RgbColor + Debug>(levels: [u32; 3]) {
    assert_eq!([C::MAX_R, C::MAX_G, C::MAX_B].map(u32::from), levels);
    let channels = |color: C| [color.r(), color.g(), color.b()];
    for step in 0..=STEPS {
        let c = at::<f32>(step);
        let expected = levels.map(|levels| level(levels, step));
        let grey = shown::<Exact<C>, f32>(Color::new(c, c, c), 3, 5);
        assert_eq!(channels(grey), expected, "{c}");
        // Each channel by itself, so that none takes another's place.
        let zero = 0.0;
        for (i, color) in [
            Color::new(c, zero, zero),
            Color::new(zero, c, zero),
            Color::new(zero, zero, c),
        ]
        .into_iter()
        .enumerate()
        {
            let mut alone = [0; 3];
            alone[i] = expected[i];
            assert_eq!(channels(shown::<Exact<C>, f32>(color, 0, 0)), alone, "{c}");
        }
        let c = at::<f64>(step);
        assert_eq!(
            channels(shown::<Exact<C>, f64>(Color::new(c, c, c), 9, 1)),
            expected,
            "{c}"
        );
    }
}

#[test]
fn every_rgb_color_gets_its_levels_in_one_rounding() {
    rgb_is_rounded_once::<Rgb888>([255, 255, 255]);
    rgb_is_rounded_once::<Bgr888>([255, 255, 255]);
    rgb_is_rounded_once::<Rgb666>([63, 63, 63]);
    rgb_is_rounded_once::<Bgr666>([63, 63, 63]);
    rgb_is_rounded_once::<Rgb565>([31, 63, 31]);
    rgb_is_rounded_once::<Bgr565>([31, 63, 31]);
    rgb_is_rounded_once::<Rgb555>([31, 31, 31]);
    rgb_is_rounded_once::<Bgr555>([31, 31, 31]);
}

/// Luma by the contract's weights, in f64.
fn luma(color: Color<f64>) -> f64 {
    0.299 * color.r + 0.587 * color.g + 0.114 * color.b
}

/// Colours of all kinds: a ramp of greys and random ones.
fn colors() -> impl Iterator<Item = Color<f64>> {
    let random = Random::of_test(5);
    let ramp = (0..=4096).map(|step| {
        let c = f64::from(step) / 4096.0;
        Color::new(c, c, c)
    });
    let primary = (0..=256).flat_map(|step| {
        let c = f64::from(step) / 256.0;
        [
            Color::new(c, 0.0, 0.0),
            Color::new(0.0, c, 0.0),
            Color::new(0.0, 0.0, c),
        ]
    });
    let scattered = (0..40_000).map(move |_| {
        // Numbers of f32, so that both scalars quantise the same colour.
        let channel = || f64::from(random.between(0.0, 1.0) as f32);
        Color::new(channel(), channel(), channel())
    });
    ramp.chain(primary).chain(scattered)
}

fn to_f32(color: Color<f64>) -> Color<f32> {
    Color::new(color.r as f32, color.g as f32, color.b as f32)
}

fn gray_is_luma<C: DisplayColor + Debug>(levels: f64, level_of: impl Fn(C) -> f64) {
    let mut close = 0;
    let mut all = 0;
    for color in colors() {
        all += 1;
        let exact = levels * luma(color) + 0.5;
        let double = level_of(shown::<Exact<C>, f64>(color, 1, 2));
        let single = level_of(shown::<Exact<C>, f32>(to_f32(color), 1, 2));
        // The weights are no binary fractions: next to a boundary either level is right.
        let distance = (exact - exact.round()).abs();
        if distance > 1e-12 {
            assert_eq!(double, exact.floor(), "{color:?} in f64");
        }
        if distance > 2e-7 * (levels + 1.0) {
            assert_eq!(single, exact.floor(), "{color:?} in f32");
        } else {
            close += 1;
            assert!((single - exact).abs() < 1.0 + 1e-4, "{color:?} in f32");
        }
    }
    assert!(close * 200 < all, "{close} of {all} colours not tested");
}

#[test]
fn grey_levels_are_those_of_luma() {
    gray_is_luma::<Gray8>(255.0, |color| color.luma().into());
    gray_is_luma::<Gray4>(15.0, |color| color.luma().into());
    gray_is_luma::<Gray2>(3.0, |color| color.luma().into());
    gray_is_luma::<BinaryColor>(1.0, |color| if color.is_on() { 1.0 } else { 0.0 });
}

#[test]
fn one_bit_is_on_from_one_half() {
    let is_on = |color| shown::<Exact<BinaryColor>, f64>(color, 0, 0).is_on();
    let green = |g: f64| Color::new(0.0, g, 0.0);
    assert!(is_on(green(0.5 / 0.587 + 1e-12)));
    assert!(!is_on(green(0.5 / 0.587 - 1e-12)));
    // Colours whose luma is one half to the bit.
    let mut halves = 0;
    for step in 0..1_000 {
        let r = f64::from(step) / 1_000.0;
        let color = Color::new(r, (0.5 - 0.114 * r - 0.299 * r) / 0.587, r);
        if color.luma() == 0.5 {
            halves += 1;
            assert!(is_on(color), "{color:?}");
        }
    }
    assert!(halves > 100, "{halves}");
}

#[test]
fn black_and_white_are_the_darkest_and_brightest_everywhere() {
    fn check<C: DisplayColor + Debug>(black: C, white: C) {
        for y in 0..8 {
            for x in 0..8 {
                let (zero, one) = (Color::new(0.0, 0.0, 0.0), Color::new(1.0, 1.0, 1.0));
                assert_eq!(shown::<Exact<C>, f32>(zero, x, y), black);
                assert_eq!(shown::<Exact<C>, f32>(one, x, y), white);
                assert_eq!(shown::<Dithered<C>, f32>(zero, x, y), black, "({x}, {y})");
                assert_eq!(shown::<Dithered<C>, f32>(one, x, y), white, "({x}, {y})");
            }
        }
    }
    check(Rgb888::BLACK, Rgb888::WHITE);
    check(Rgb565::BLACK, Rgb565::WHITE);
    check(Bgr666::BLACK, Bgr666::WHITE);
    check(Gray8::BLACK, Gray8::WHITE);
    check(Gray4::BLACK, Gray4::WHITE);
    check(Gray2::BLACK, Gray2::WHITE);
    check(BinaryColor::Off, BinaryColor::On);
}

/// The seven inks of a paper display: a colour that embedded-graphics does not know.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Ink(u8);

impl PixelColor for Ink {
    type Raw = ();
}

impl From<Rgb888> for Ink {
    fn from(color: Rgb888) -> Self {
        Self(color.r() / 64 + color.g() / 64 * 4 + color.b() / 64 * 16)
    }
}

/// A picture whose pixels are a function of their column.
#[derive(Clone, Copy, Debug)]
struct Columns<F>(F);

impl<F: Fn(u16) -> Color<f32>> PixelSource for Columns<F> {
    type Scalar = f32;
    type Scanline = ();

    fn resolution(&self) -> Resolution {
        Resolution {
            width: 4_096,
            height: 64,
        }
    }

    fn scanline(&self, _: u16) {}

    fn pixel_on(&self, (): &(), x: u16) -> (Color<f32>, u32) {
        ((self.0)(x), 1)
    }
}

#[test]
fn colors_of_other_crates_come_through_rgb888() {
    let ramp = |x: u16| {
        let c = f32::from(x) / 4096.0;
        Color::new(c, 1.0 - c, c * c)
    };
    let picture = Picture::<_, ThroughRgb888<Ink>>::converted(Columns(ramp));
    let bytes = Picture::<_, Exact<Rgb888>>::new(Columns(ramp));
    for x in 0..4_096 {
        let expected = Ink::from(bytes.pixel(x, 7));
        assert_eq!(picture.pixel(x, 7), expected);
        let levels = sampling::levels(ramp(x));
        assert_eq!(
            expected,
            Rgb888::new(levels[0], levels[1], levels[2]).into()
        );
    }
}

/// The mean level over the 8×8 positions of the matrix, at a place of the picture.
fn mean_level<C: DisplayColor>(c: f64, level_of: impl Fn(C) -> f64, (x, y): (u16, u16)) -> f64 {
    let color = Color::new(c, c, c);
    let sum: f64 = (0..64)
        .map(|i| level_of(shown::<Dithered<C>, f64>(color, x + i % 8, y + i / 8)))
        .sum();
    sum / 64.0
}

fn dither_averages_right<C: DisplayColor>(levels: f64, level_of: impl Fn(C) -> f64 + Copy) {
    for step in 0..=2_000 {
        let c = f64::from(step) / 2_000.0;
        for corner in [(0, 0), (8, 16), (13, 3)] {
            let mean = mean_level::<C>(c, level_of, corner);
            // Half a step of the 64 thresholds.
            assert!(
                (mean - levels * c).abs() <= 0.5 / 64.0 + 1e-9,
                "{c}: {mean} instead of {}",
                levels * c
            );
        }
        for i in 0..64 {
            let color = Color::new(c, c, c);
            let level = level_of(shown::<Dithered<C>, f64>(color, i % 8, i / 8));
            assert!((level - levels * c).abs() < 1.0, "{c} at {i}: {level}");
        }
    }
}

#[test]
fn dither_shows_the_mean_of_an_area() {
    dither_averages_right::<Rgb888>(255.0, |color| color.r().into());
    dither_averages_right::<Rgb565>(31.0, |color| color.r().into());
    dither_averages_right::<Rgb565>(63.0, |color| color.g().into());
    dither_averages_right::<Bgr666>(63.0, |color| color.b().into());
    dither_averages_right::<Gray4>(15.0, |color| color.luma().into());
    dither_averages_right::<Gray2>(3.0, |color| color.luma().into());
    dither_averages_right::<BinaryColor>(1.0, |color| if color.is_on() { 1.0 } else { 0.0 });
}

#[test]
fn dither_depends_on_the_position_alone() {
    let picture =
        Picture::<_, Exact<Gray2>>::new(Columns(|_| Color::new(0.4, 0.4, 0.4))).dithered();
    for y in 0..64 {
        for x in 0..64 {
            let again = picture.pixel(x, y);
            assert_eq!(picture.pixel(x, y), again);
            assert_eq!(picture.pixel(x % 8, y % 8), again, "({x}, {y})");
        }
        // A row by itself, from any column.
        for start in [0, 3, 8] {
            let mut row = [Gray2::BLACK; 40];
            picture.row(start, y, &mut row);
            for (x, color) in (start..).zip(row) {
                assert_eq!(color, picture.pixel(x, y), "({x}, {y})");
            }
        }
    }
    // Not along one axis only: both neighbours differ somewhere.
    let differs = |dx: u16, dy: u16| {
        (0..64_u16).any(|i| picture.pixel(i % 8, i / 8) != picture.pixel(i % 8 + dx, i / 8 + dy))
    };
    assert!(differs(1, 0) && differs(0, 1) && differs(4, 0) && differs(0, 4));
}

#[test]
fn both_scalars_dither_alike() {
    for color in colors() {
        for (x, y) in [(0, 0), (1, 0), (5, 6)] {
            let single = shown::<Dithered<Rgb888>, f32>(to_f32(color), x, y);
            let double = shown::<Dithered<Rgb888>, f64>(color, x, y);
            for (a, b) in [
                (single.r(), double.r()),
                (single.g(), double.g()),
                (single.b(), double.b()),
            ] {
                assert!(a.abs_diff(b) <= 1, "{color:?} at ({x}, {y})");
            }
        }
    }
}
