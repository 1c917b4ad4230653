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

/// Moves points so that a ray is the z axis, and forgets how far along it they are.
#[derive(Clone, Copy, Debug)]
pub struct Shear<N> {
    x: N,
    y: N,
}

impl<N: Number> Shear<N> {
    /// Of the ray of a direction whose largest component is z, by an exchange of axes.
    #[inline(always)]
    pub fn along(direction: Vec3<N>) -> Self {
        let Vec3 { x, y, z } = direction;
        Self { x: x / z, y: y / z }
    }

    /// Where a point is across the ray, as seen from the ray's origin, the axes exchanged alike.
    #[inline(always)]
    pub fn apply(&self, point: Vec3<N>) -> [N; 2] {
        [point.x - self.x * point.z, point.y - self.y * point.z]
    }
}

/// The edge function `p × q` in the plane across the ray. It has the right sign unless it is 0: the difference of two
/// rounded products has it, because rounding is monotonic. Where they are equal, what rounding took from them remains: the
/// difference of [`product_error`] of `px, qy` and of `py, qx`.
#[inline(always)]
pub fn edge<N: Number>([px, py]: [N; 2], [qx, qy]: [N; 2]) -> N {
    px * qy - py * qx
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

/// `a·b − c·d` without cancellation: what rounding took from the products is put back (Kahan's algorithm with Dekker's product).
#[inline(always)]
pub fn difference_of_products<N: Number>(a: N, b: N, c: N, d: N) -> N {
    (a * b - c * d) + (product_error(a, b) - product_error(c, d))
}

/// The upper and the lower half of a number.
#[inline(always)]
fn split<N: Number>(x: N) -> (N, N) {
    let scaled = x.constant(N::SPLIT) * x;
    let high = scaled - (scaled - x);
    (high, x - high)
}

/// How far a ray rises to the plane of a triangle, along the normal, and how much it rises on its way: it crosses the plane at
/// the quotient; `to_vertex` is the way from the ray's origin to a vertex.
///
/// The edge functions give the distance, too, as a mean of the vertices' weighted with them. But on a triangle of length `L` and
/// height `h` they are of the size of `Lh` and may be differences of numbers of the size of `L²`: that mean is off by `uL²/h`,
/// and this by `uL`, where the ray does not graze the plane ([`GRAZING`]). (Few triangles lie along the axes: there is no shorter
/// way for them.)
#[inline(always)]
pub fn rise<N: Number>(normal: Vec3<N>, to_vertex: Vec3<N>, direction: Vec3<N>) -> (N, N) {
    (normal.dot(to_vertex), normal.dot(direction))
}

/// Where a ray rises less than this on its way the quotient of [`rise`] may be off by more than the size of the
/// triangle, and is limited to where the vertices are.
pub const GRAZING: f64 = 0.25;

/// The point of the plane of a triangle that is nearest to a place.
#[inline(always)]
pub fn project<N: Number>(place: Vec3<N>, normal: Vec3<N>, vertex: Vec3<N>) -> Vec3<N> {
    place - normal * normal.dot(place - vertex)
}
