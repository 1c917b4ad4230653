//! A test of spheres in integers that finds most misses where floats are emulated.
//!
//! On such a core the exact test of a sphere takes more than a thousand instructions, and most rays miss; the clear
//! misses are found here in less than a hundred. Only rays that the exact tests would find to miss are told of, so
//! that no bit changes.

use core::num::Wrapping;

use crate::ray::Ray;
use crate::scalar::Scalar;
use crate::vec3::Vec3;

/// Bits behind the point of the components of a direction.
const DIRECTION_BITS: usize = 15;

/// The unit of length is 2⁻¹² of a power of two that bounds a sphere's coordinates and diameter.
const BOUND_BITS: i32 = 12;

/// Origins of rays are less than 2¹⁴ units from 0 along each axis.
const ORIGIN_BITS: i32 = 14;

/// Where a sphere is, as seen along a ray: in whole units, none off by more than the margin of `reach_squared`.
pub(super) struct QuickReject {
    /// Distance of the centre along the ray.
    along: Wrapping<i32>,
    /// Square of the distance of the centre from the ray's line.
    across_squared: Wrapping<i32>,
    /// Square of the radius with a margin.
    reach_squared: Wrapping<i32>,
}

impl QuickReject {
    /// `None` where lengths of very different scales meet, and in `f64`. `offset` is the
    /// [origin offset](crate::ray::origin_offset) of what is in the sphere.
    ///
    /// The unit `q` is a power of 2. As `offset ≥ 2⁻²²(Σ|cᵢ| + 2r)`, its exponent gives one with
    /// `Σ|cᵢ| + 2r < 2¹²q`. With `|oᵢ| < 2¹⁴q` the vector `f` from the origin to the centre is shorter than 35,500,
    /// and no product leaves 31 bits.
    ///
    /// Centre and origin are rounded down, so that each component of `f` is off by less than 1 and `f` by √3; the
    /// direction by √3·2⁻¹⁵, which moves products with it by √3·35,500·2⁻¹⁵ < 1.9; and rounding these down takes
    /// another √3 of the vector across. So the distance `l` of the centre from the line is off by less than 5.4 and the
    /// distance `b` along it by less than 4.7. Where rounding made the direction too long, `b` and `l` are too large by
    /// 2⁻¹³, at most 0.3 of what matters; where it is too short, they are too small, and so is what the exact tests take for `b`,
    /// while their `l` is larger. These see hits up to `8u(|f| + r) < 0.04` beyond the sphere. Together
    /// that is less than 6, and `(r + 7)² = r² + 14r + 49 < r² + r²/32 + 2048`.
    #[inline(always)]
    pub(super) fn of<T: Scalar>(
        ray: &Ray<T>,
        center: Vec3<T>,
        radius_squared: T,
        offset: T,
    ) -> Option<Self> {
        if T::NAME != f32::NAME {
            return None;
        }
        let [dx, dy, dz] = fixed(ray.direction, -(DIRECTION_BITS as i32));
        let length = dx * dx + dy * dy + dz * dz;
        let unit = exponent(offset) - exponent(T::EPSILON) - BOUND_BITS;
        let o = ray.origin;
        let limit = unit + ORIGIN_BITS;
        if length.0 as u32 > (1 << 30) + (1 << 17)
            || exponent(o.x) >= limit
            || exponent(o.y) >= limit
            || exponent(o.z) >= limit
        {
            return None;
        }
        let ([cx, cy, cz], [ox, oy, oz]) = (fixed(center, unit), fixed(o, unit));
        let (x, y, z) = (cx - ox, cy - oy, cz - oz);
        let along = (x * dx + y * dy + z * dz) >> DIRECTION_BITS;
        let across_x = (y * dz - z * dy) >> DIRECTION_BITS;
        let across_y = (z * dx - x * dz) >> DIRECTION_BITS;
        let across_z = (x * dy - y * dx) >> DIRECTION_BITS;
        let radius_squared = to_fixed(radius_squared, 2 * unit);
        Some(Self {
            along,
            across_squared: across_x * across_x + across_y * across_y + across_z * across_z,
            reach_squared: radius_squared + (radius_squared >> 5) + Wrapping(2048),
        })
    }

    /// The line passes the sphere at a distance, or all of the sphere lies behind the origin.
    #[inline(always)]
    pub(super) fn is_clear_miss(&self) -> bool {
        self.across_squared > self.reach_squared
            || (self.along.0 < 0 && self.along * self.along > self.reach_squared)
    }

    /// Besides that, the origin is outside of the sphere and the ray leads away from its centre.
    #[inline(always)]
    pub(super) fn is_clear_miss_of_surface(&self) -> bool {
        self.across_squared > self.reach_squared
            || (self.along.0 < 0
                && self.along * self.along + self.across_squared > self.reach_squared)
    }
}

#[inline(always)]
fn fixed<T: Scalar>(v: Vec3<T>, unit: i32) -> [Wrapping<i32>; 3] {
    [
        to_fixed(v.x, unit),
        to_fixed(v.y, unit),
        to_fixed(v.z, unit),
    ]
}

/// `⌊value·2^−unit⌋` if that has less than 31 bits.
#[inline(always)]
fn to_fixed<T: Scalar>(value: T, unit: i32) -> Wrapping<i32> {
    let bits = value.to_f32().to_bits();
    let magnitude = ((bits << 7 | 1 << 30) & 0x7fff_ff80) as i32;
    let sign = bits as i32 >> 31;
    let below = ((unit + 30 + 127) as u32).wrapping_sub(bits >> 23 & 0xff);
    Wrapping(((magnitude ^ sign) - sign) >> below.min(31))
}

/// `⌊log₂ |value|⌋` of normal numbers.
#[inline(always)]
fn exponent<T: Scalar>(value: T) -> i32 {
    (value.to_f32().to_bits() >> 23 & 0xff) as i32 - 127
}
