//! A ray and a triangle.
//!
//! Woop, Benthin and Wald, "Watertight Ray/Triangle Intersection", JCGT 2(1), 2013: the vertices
//! are sheared so that the ray is an axis; the signs of the three edge functions then agree between
//! triangles that share an edge, so that no ray passes between them. Where an edge function rounds
//! to 0 its sign is computed again, exactly, with two-products (the paper uses double precision,
//! which a microcontroller would have to emulate).

use crate::number::Number;
use crate::vec3::Vec3;

/// `64u`, the slack of [`reach`] and of the square radii of bounding spheres.
#[inline(always)]
pub fn slack<N: Number>(like: N) -> N {
    like.constant(64.0 * N::ULP)
}

/// The square of how close to the centre of a triangle's bounding sphere a ray must come for the exact test to hit.
///
/// Never too small. With `R` the sphere's radius, `b` the distance along the ray to
/// its centre and `u` the rounding unit, the distance `l` computed and the edges of the
/// exact test are each off by less than `s = 8u(|b| + R)` together, which changes `l²` by
/// `2sR = 16u(|b|R + R²) ≤ 64u(b² + R²)`: the first term is added here, the second when the sphere is
/// made.
#[inline(always)]
pub fn reach<N: Number>(radius_squared: N, b: N) -> N {
    radius_squared + slack(b) * (b * b)
}

/// Moves points so that a ray is the z axis.
#[derive(Clone, Copy, Debug)]
pub struct Shear<N> {
    x: N,
    y: N,
    scale: N,
}

impl<N: Number> Shear<N> {
    /// Of the ray of a direction whose largest component is z, by an exchange of axes.
    #[inline(always)]
    pub fn along(direction: Vec3<N>) -> Self {
        let Vec3 { x, y, z } = direction;
        Self {
            scale: z.constant(1.0) / z,
            x: x / z,
            y: y / z,
        }
    }

    /// The place of a point, as seen from the ray's origin, the axes exchanged alike.
    #[inline(always)]
    pub fn apply(&self, point: Vec3<N>) -> Vec3<N> {
        Vec3::new(
            point.x - self.x * point.z,
            point.y - self.y * point.z,
            self.scale * point.z,
        )
    }
}

/// The edge function `p × q` in the plane across the ray. It has the right sign unless it is 0: the difference of two
/// rounded products has it, because rounding is monotonic. Where they are equal, what rounding took from them remains: the
/// difference of [`product_error`] of `p.x, q.y` and of `p.y, q.x`.
#[inline(always)]
pub fn edge<N: Number>(p: Vec3<N>, q: Vec3<N>) -> N {
    p.x * q.y - p.y * q.x
}

/// `a·b − round(a·b)`, exactly, barring underflow. Dekker, "A floating-point technique for extending
/// the available precision", Numerische Mathematik 18, 1971.
#[inline(always)]
pub fn product_error<N: Number>(a: N, b: N) -> N {
    let product = a * b;
    let (a_high, a_low) = split(a);
    let (b_high, b_low) = split(b);
    ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low
}

/// The upper and the lower half of a number.
#[inline(always)]
fn split<N: Number>(x: N) -> (N, N) {
    let scaled = x.constant(N::SPLIT) * x;
    let high = scaled - (scaled - x);
    (high, x - high)
}

/// Distance of a hit and the weights of the second and third vertex there, from the edge functions opposite the vertices, their sum
/// and the sheared vertices.
#[inline(always)]
pub fn interpolate<N: Number>([u, v, w]: [N; 3], sum: N, [a, b, c]: [Vec3<N>; 3]) -> (N, [N; 2]) {
    let inverse = sum.constant(1.0) / sum;
    let t = (u * a.z + v * b.z + w * c.z) * inverse;
    (t, [v * inverse, w * inverse])
}

/// The point of two weights: interpolated between the vertices, it lies as close to the
/// triangle as its own coordinates allow, however far the ray has come.
#[inline(always)]
pub fn point<N: Number>([v1, v2, v3]: [Vec3<N>; 3], [at_v2, at_v3]: [N; 2]) -> Vec3<N> {
    let at_v1 = at_v2.constant(1.0) - at_v2 - at_v3;
    v1 * at_v1 + v2 * at_v2 + v3 * at_v3
}
