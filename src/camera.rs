//! The camera: looks along +z, with +y up and +x to the right.

use crate::ray::Ray;
use crate::scalar::Scalar;
use crate::vec3::Vec3;

/// A pinhole camera whose picture is 2 units high and 1 unit away.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Camera<T = f32> {
    /// Where it is.
    pub position: Vec3<T>,
}

/// Width and height of a picture, in pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Resolution {
    /// Pixels in a row; at least 1.
    pub width: u16,
    /// Rows; at least 1.
    pub height: u16,
}

impl<T: Scalar> Camera<T> {
    /// `y` of the ray through the centre of row `row`, before normalisation:
    /// `(H − 1 − 2·row)/H`.
    #[inline(always)]
    pub fn row_height(&self, resolution: Resolution, row: u16) -> T {
        let height = i32::from(resolution.height);
        T::from_i32(height - 1 - 2 * i32::from(row)) / T::from_i32(height)
    }

    /// The largest `|x|` of a ray through a pixel, before normalisation: `(W − 1)/H`.
    pub fn half_width(&self, resolution: Resolution) -> T {
        T::from_i32(i32::from(resolution.width) - 1) / T::from_i32(i32::from(resolution.height))
    }

    /// The ray through the centre of the pixel in `column` of the row at `row_height`:
    /// `x = (2·column + 1 − W)/H`, exactly opposite for mirrored columns.
    #[inline(always)]
    pub fn ray(&self, resolution: Resolution, row_height: T, column: u16) -> Ray<T> {
        let x = T::from_i32(2 * i32::from(column) + 1 - i32::from(resolution.width))
            / T::from_i32(i32::from(resolution.height));
        Ray::new(self.position, Vec3::new(x, row_height, T::ONE).normalize())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn samples_pixel_centres_and_mirrors_exactly() {
        let camera = Camera::<f32>::default();
        let resolution = Resolution {
            width: 65_535,
            height: 3,
        };
        assert_eq!(camera.row_height(resolution, 0), 2.0 / 3.0);
        assert_eq!(camera.row_height(resolution, 1), 0.0);
        let left = camera.ray(resolution, 0.0, 0).direction;
        let right = camera.ray(resolution, 0.0, 65_534).direction;
        assert_eq!(left.x, -right.x);
        assert_eq!(left.z, right.z);
        assert_eq!(camera.ray(resolution, 0.0, 32_767).direction.x, 0.0);
    }
}
