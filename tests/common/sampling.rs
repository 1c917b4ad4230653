//! Samples beside pixel centres, and which pixels an f32 picture can be held to.

use scanray::{Color, Ray, Resolution, Scalar, Tracer, Vec3};

/// The ray through a place of the picture, `(dx, dy)` pixels to the right of and above the centre of
/// a pixel: as image.md's camera says, independently of the crate's.
pub(crate) fn ray_beside<T: Scalar>(
    position: Vec3<T>,
    size: Resolution,
    (column, row): (u16, u16),
    (dx, dy): (f64, f64),
) -> Ray<T> {
    let (width, height) = (f64::from(size.width), f64::from(size.height));
    let x = (2.0 * f64::from(column) + 1.0 - width + 2.0 * dx) / height;
    let y = (height - 1.0 - 2.0 * f64::from(row) + 2.0 * dy) / height;
    let direction = Vec3::new(T::from_f64(x), T::from_f64(y), T::ONE).normalize();
    Ray::new(position, direction)
}

/// The f64 colour of a pixel, if it stays within one level of 255 while the sample moves by up to a
/// thousandth of a pixel: then rounding alone may not move it either.
pub(crate) fn settled_color<const NEEDS: u32, const STACK: usize>(
    tracer: &Tracer<'_, f64, NEEDS, STACK>,
    pixel: (u16, u16),
) -> Option<Color<f64>> {
    const STEP: f64 = 1e-3;
    let color_at = |dx, dy| {
        let position = tracer.scene().camera.position;
        tracer.radiance(ray_beside(position, tracer.resolution(), pixel, (dx, dy)))
    };
    let center = color_at(0.0, 0.0);
    for dy in [-STEP, 0.0, STEP] {
        for dx in [-STEP, 0.0, STEP] {
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

pub(crate) fn channels<T: Scalar>(color: Color<T>) -> [f64; 3] {
    [color.r, color.g, color.b].map(Scalar::to_f64)
}

/// 8-bit levels by image.md's rule, in f64.
pub(crate) fn levels<T: Scalar>(color: Color<T>) -> [u8; 3] {
    channels(color).map(|channel| (255.0 * channel + 0.5).floor() as u8)
}

/// By how many of 255 levels two colours differ, in the channel that differs most.
pub(crate) fn level_distance(a: [u8; 3], b: [u8; 3]) -> u8 {
    let [r, g, b] = std::array::from_fn(|i| a[i].abs_diff(b[i]));
    r.max(g).max(b)
}

/// The bits of a colour of any scalar: f32 is widened exactly.
pub(crate) fn bits<T: Scalar>(color: Color<T>) -> [u64; 3] {
    channels(color).map(f64::to_bits)
}
