//! The camera: looks along +z, with +y up and +x to the right.

use crate::formula;
use crate::ray::Ray;
use crate::real::Real;
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

/// A place in a pixel: the middle of one of `of`×`of` cells. It is that of a pixel in a picture with `of`
/// times as many columns and rows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Subpixel {
    /// Column of the cell, from the left; less than `of`.
    pub column: u8,
    /// Row of the cell, from the top; less than `of`.
    pub row: u8,
    /// Cells side by side; 1 to 64, so that all places are exact in `f32`.
    pub of: u8,
}

impl Subpixel {
    /// The centre of the pixel.
    pub const CENTER: Self = Self {
        column: 0,
        row: 0,
        of: 1,
    };
}

impl<T: Scalar> Camera<T> {
    /// `y` of the ray through the centre of row `row`, before normalisation:
    /// `(H − 1 − 2·row)/H`.
    #[inline(always)]
    pub fn image_plane_y(&self, resolution: Resolution, row: u16) -> T {
        self.image_plane_y_at(resolution, row, Subpixel::CENTER)
    }

    /// [`Camera::image_plane_y`] of a place in each pixel.
    #[inline(always)]
    pub fn image_plane_y_at(&self, resolution: Resolution, row: u16, at: Subpixel) -> T {
        let of = i32::from(at.of);
        let height = i32::from(resolution.height) * of;
        let row = i32::from(row) * of + i32::from(at.row);
        T::from_i32(height - 1 - 2 * row) / T::from_i32(height)
    }

    /// The largest `|x|` of a ray through a pixel, before normalisation: `(W − 1)/H`.
    pub fn half_width(&self, resolution: Resolution) -> T {
        T::from_i32(i32::from(resolution.width) - 1) / T::from_i32(i32::from(resolution.height))
    }

    /// [`Camera::half_width`] of any place in a row of cells.
    pub fn half_width_at(&self, resolution: Resolution, at: Subpixel) -> T {
        let of = i32::from(at.of);
        let [width, height] = [resolution.width, resolution.height].map(i32::from);
        T::from_i32(of * width - 1) / T::from_i32(of * height)
    }

    /// The ray through the centre of the pixel in `column` of the row at `image_plane_y`:
    /// `x = (2·column + 1 − W)/H`, exactly opposite for mirrored columns.
    #[inline(always)]
    pub fn ray(&self, resolution: Resolution, image_plane_y: T, column: u16) -> Ray<T> {
        self.ray_at(resolution, image_plane_y, column, Subpixel::CENTER)
    }

    /// [`Camera::ray`] through a place in the pixel, whose row of cells is at `image_plane_y`.
    #[inline(always)]
    pub fn ray_at(
        &self,
        resolution: Resolution,
        image_plane_y: T,
        column: u16,
        at: Subpixel,
    ) -> Ray<T> {
        let of = i32::from(at.of);
        let column = i32::from(column) * of + i32::from(at.column);
        let column = T::from_i32(2 * column + 1 - i32::from(resolution.width) * of);
        let height = T::from_i32(i32::from(resolution.height) * of);
        let direction = formula::camera::direction(Real(column), Real(height), Real(image_plane_y));
        Ray::new(self.position, direction.plain())
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
        assert_eq!(camera.image_plane_y(resolution, 0), 2.0 / 3.0);
        assert_eq!(camera.image_plane_y(resolution, 1), 0.0);
        let left = camera.ray(resolution, 0.0, 0).direction;
        let right = camera.ray(resolution, 0.0, 65_534).direction;
        assert_eq!(left.x, -right.x);
        assert_eq!(left.z, right.z);
        assert_eq!(camera.ray(resolution, 0.0, 32_767).direction.x, 0.0);
    }
}
