//! Pictures before quantisation.

use embedded_graphics::pixelcolor::Rgb888;
use embedded_graphics::prelude::RgbColor;
use rayon::prelude::*;
use scanray::{
    Color, Resolution, Scalar,
    render::{DisplayColor, PixelSource, Quantizer},
};

use scanray_host::option_values::ColorName;
use scanray_host::parallel_drawing::Workers;

/// The linear colours of a picture, row by row, each channel in 0…1.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Linear {
    pub(crate) resolution: Resolution,
    pub(crate) pixels: Vec<[f64; 3]>,
}

impl Linear {
    /// The same colours in double precision, which is exact.
    pub(crate) fn new<T: Scalar>(resolution: Resolution, colors: &[Color<T>]) -> Self {
        Self {
            resolution,
            pixels: colors.iter().map(channels).collect(),
        }
    }

    /// A picture of which each pixel is the mean of `factor` × `factor` pixels of a source.
    pub(crate) fn draw_reduced<P: PixelSource + Sync>(
        source: &P,
        factor: u16,
        workers: &Workers,
    ) -> Self {
        let large = source.resolution();
        let resolution = Resolution {
            width: large.width / factor,
            height: large.height / factor,
        };
        let scale = 1.0 / (f64::from(factor) * f64::from(factor));
        let row = |y: u16| {
            let mut sums = vec![[0.0; 3]; usize::from(resolution.width)];
            for part in 0..factor {
                let scanline = source.scanline(y * factor + part);
                for (x, sum) in (0..).zip(&mut sums) {
                    for column in 0..factor {
                        let color = source.pixel_on(&scanline, x * factor + column).0;
                        let color = channels(&color);
                        *sum = std::array::from_fn(|i| sum[i] + color[i]);
                    }
                }
            }
            sums.into_iter().map(move |sum| sum.map(|s| s * scale))
        };
        let pixels = workers.install(|| {
            (0..resolution.height)
                .into_par_iter()
                .flat_map_iter(row)
                .collect()
        });
        Self { resolution, pixels }
    }

    /// The picture in 8 bits a channel.
    pub(crate) fn to_rgb888(&self) -> Vec<[u8; 3]> {
        let colors: Vec<_> = self
            .pixels
            .iter()
            .map(|[r, g, b]| Color::new(*r, *g, *b))
            .collect();
        shown::<f64, scanray::render::Exact<Rgb888>>(&colors, self.resolution)
    }
}

/// The colours as a display of a kind can show them: on those without colours, their greys.
pub(crate) fn in_greys(mut linear: Linear, display: ColorName) -> Linear {
    if display.is_grey() {
        for [r, g, b] in &mut linear.pixels {
            let grey = Color::new(*r, *g, *b).luma();
            (*r, *g, *b) = (grey, grey, grey);
        }
    }
    linear
}

fn channels<T: Scalar>(color: &Color<T>) -> [f64; 3] {
    [color.r.to_f64(), color.g.to_f64(), color.b.to_f64()]
}

/// What a display makes of linear colours, in 8 bits a channel.
pub(crate) fn shown<T: Scalar, Q: Quantizer<Color: DisplayColor + Into<Rgb888>>>(
    colors: &[Color<T>],
    resolution: Resolution,
) -> Vec<[u8; 3]> {
    let width = usize::from(resolution.width);
    let show = |(at, color): (usize, &Color<T>)| {
        // No picture has more than 65,535 rows or columns.
        let (x, y) = ((at % width) as u16, (at / width) as u16);
        let shown: Rgb888 = Q::quantize(*color, x, y).into();
        [shown.r(), shown.g(), shown.b()]
    };
    colors.iter().enumerate().map(show).collect()
}
