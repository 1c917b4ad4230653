//! Samples beside pixel centres, and which pixels an f32 picture can be held to.

use scanray::{Color, Ray, Resolution, Scalar, Tracer, Vec3};

/// A camera that looks along +z, as docs/picture.md says, independently of the crate's; it may have a telephoto
/// lens or a wide-angle lens.
#[derive(Clone, Copy, Debug)]
pub struct View<T> {
    /// Where it is.
    pub position: Vec3<T>,
    /// Size of the picture.
    pub size: Resolution,
    /// Half the picture's height at distance 1: 1 for the crate's camera, less for a longer lens.
    pub half_height: f64,
}

impl<T: Scalar> View<T> {
    /// The crate's camera of a tracer.
    pub fn of<const STAGES: u64, const STACK: usize>(
        tracer: &Tracer<'_, T, STAGES, STACK>,
    ) -> Self {
        Self {
            position: tracer.scene().camera().position,
            size: tracer.resolution(),
            half_height: 1.0,
        }
    }

    /// The ray through a place of the picture, `(dx, dy)` pixels to the right of and above the centre of
    /// a pixel.
    pub fn ray(&self, (column, row): (u16, u16), (dx, dy): (f64, f64)) -> Ray<T> {
        let (width, height) = (f64::from(self.size.width), f64::from(self.size.height));
        let x = (2.0 * f64::from(column) + 1.0 - width + 2.0 * dx) / height * self.half_height;
        let y = (height - 1.0 - 2.0 * f64::from(row) + 2.0 * dy) / height * self.half_height;
        let direction = Vec3::new(T::from_f64(x), T::from_f64(y), T::ONE).normalize();
        Ray::new(self.position, direction)
    }
}

/// [`View::ray`] of the crate's camera.
pub fn ray_beside<T: Scalar>(
    position: Vec3<T>,
    size: Resolution,
    pixel: (u16, u16),
    offset: (f64, f64),
) -> Ray<T> {
    let view = View {
        position,
        size,
        half_height: 1.0,
    };
    view.ray(pixel, offset)
}

/// The f64 colour of a pixel, if it stays within one level of 255 while the sample moves by up to a
/// thousandth of a pixel: then rounding alone may not move it either.
pub fn settled_color<const STAGES: u64, const STACK: usize>(
    tracer: &Tracer<'_, f64, STAGES, STACK>,
    pixel: (u16, u16),
) -> Option<Color<f64>> {
    settled_through(tracer, &View::of(tracer), pixel)
}

/// [`settled_color`] of another camera's picture.
pub fn settled_through<const STAGES: u64, const STACK: usize>(
    tracer: &Tracer<'_, f64, STAGES, STACK>,
    view: &View<f64>,
    pixel: (u16, u16),
) -> Option<Color<f64>> {
    const STEP: f64 = 1e-3;
    let color_at = |dx, dy| tracer.radiance(view.ray(pixel, (dx, dy)));
    let center = color_at(0.0, 0.0);
    for dy in [-STEP, 0.0, STEP] {
        for dx in [-STEP, 0.0, STEP] {
            if (dx, dy) == (0.0, 0.0) {
                continue;
            }
            let moved = color_at(dx, dy);
            if channels(moved)
                .iter()
                .zip(channels(center))
                .any(|(a, b)| (a - b).abs() * 255.0 > 1.0)
            {
                return None;
            }
        }
    }
    Some(center)
}

/// The channels, widened exactly.
pub fn channels<T: Scalar>(color: Color<T>) -> [f64; 3] {
    [color.r, color.g, color.b].map(Scalar::to_f64)
}

/// 8-bit levels by the rule of docs/picture.md, in f64.
pub fn levels<T: Scalar>(color: Color<T>) -> [u8; 3] {
    channels(color).map(|channel| (255.0 * channel + 0.5).floor() as u8)
}

/// By how many of 255 levels two colours differ, in the channel that differs most.
pub fn level_distance(a: [u8; 3], b: [u8; 3]) -> u8 {
    let [r, g, b] = std::array::from_fn(|i| a[i].abs_diff(b[i]));
    r.max(g).max(b)
}

/// The bits of a colour of any scalar: f32 is widened exactly.
pub fn bits<T: Scalar>(color: Color<T>) -> [u64; 3] {
    channels(color).map(f64::to_bits)
}
