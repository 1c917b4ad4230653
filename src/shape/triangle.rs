//! Triangles.

use super::quick_reject::QuickReject;
use super::{
    BoundingSphere, FlatPlane, Geometry, Kind, ListedShape, Object, ObjectInfo, Primitive, Shape,
    ShapeError, SurfacePoint, extent,
};
use crate::formula::triangle::{
    GRAZING, Shear, difference_of_products, edge, product_error, project, reach, rise, slack,
};
use crate::formula::{origin_offset, sphere::closest_approach};
use crate::ray::Ray;
use crate::real::Real;
use crate::scalar::Scalar;
use crate::stages::Stages;
use crate::vec3::Vec3;

/// A triangle, seen from both sides.
///
/// Invariants: `normal = normalize((v3 − v1) × (v2 − v1))`; the sphere around `bounds_center` holds the
/// three vertices with room for the rounding of its own construction; `offset` is an upper bound of the origin offset anywhere
/// on the surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Triangle<T = f32> {
    bounds_center: Vec3<T>,
    bounds_radius_squared: T,
    vertices: [Vec3<T>; 3],
    normal: Vec3<T>,
    offset: T,
    info: ObjectInfo,
}

impl<T: Scalar> Triangle<T> {
    /// A triangle; computes what rendering needs.
    ///
    /// # Errors
    ///
    /// [`ShapeError::NoArea`] when two edges enclose an angle whose sine is below four units of
    /// rounding, [`ShapeError::TooLarge`], [`ShapeError::TooSmall`].
    pub fn new(vertices: [Vec3<T>; 3], info: ObjectInfo) -> Result<Self, ShapeError> {
        let [v1, v2, v3] = vertices;
        let extent = extent(v1).max(extent(v2)).max(extent(v3));
        if !(vertices.iter().all(|vertex| vertex.is_finite()) && extent <= Self::largest()) {
            return Err(ShapeError::TooLarge);
        }
        // Unit edges: the product of their directions neither under- nor overflows, and its length is
        // the sine of the angle between them.
        let (to_v2, _) = (v2 - v1).try_normalize().ok_or(ShapeError::NoArea)?;
        let (to_v3, _) = (v3 - v1).try_normalize().ok_or(ShapeError::NoArea)?;
        let across = precise_cross(to_v3, to_v2);
        let (normal, [largest, length]) = across.try_normalize().ok_or(ShapeError::NoArea)?;
        let sine = largest * length;
        if !(sine > T::TWO * T::TWO * T::EPSILON) {
            return Err(ShapeError::NoArea);
        }
        let (bounds_center, bounds_radius_squared) = bounds_of(vertices);
        if bounds_radius_squared < Self::smallest() * Self::smallest() {
            return Err(ShapeError::TooSmall);
        }
        // Σ|nᵢPᵢ| is largest in a corner. The normal is off by some units of rounding, which tilts the plane about the first.
        let across = normal.abs();
        let [c1, c2, c3] = vertices.map(|vertex| across.dot(vertex.abs()));
        let size = super::extent(v2 - v1).max(super::extent(v3 - v1));
        Ok(Self::from_parts(
            vertices,
            normal,
            bounds_center,
            bounds_radius_squared,
            origin_offset(c1.max(c2).max(c3), size),
            info,
        ))
    }

    /// The largest coordinate of a vertex, either way: 2⁶⁰ = 1.2e18 in `f32`, 2⁵⁰⁸ in `f64`. With rays that start as far away the
    /// edge functions, sums of products of two numbers sixteen times that size, are finite.
    pub fn largest() -> T {
        T::ONE / (T::SMALLEST_TO_SQUARE * T::from_i32(8))
    }

    /// The smallest radius of a triangle's bounding sphere: 2⁻⁵¹ = 4.4e-16 in `f32`, 2⁻⁴⁸⁵ in `f64`. The edge functions of smaller ones
    /// lose digits, and their errors are 0.
    pub fn smallest() -> T {
        T::SMALLEST_TO_SQUARE
            * T::from_f64(if T::EPSILON > T::from_f64(1e-10) {
                4096.0
            } else {
                67_108_864.0
            })
    }

    /// A triangle from values that [`Triangle::new`] has computed: for baked scenes.
    pub const fn from_parts(
        vertices: [Vec3<T>; 3],
        normal: Vec3<T>,
        bounds_center: Vec3<T>,
        bounds_radius_squared: T,
        offset: T,
        info: ObjectInfo,
    ) -> Self {
        Self {
            bounds_center,
            bounds_radius_squared,
            vertices,
            normal,
            offset,
            info,
        }
    }

    /// The vertices, in the order of the file.
    pub const fn vertices(&self) -> [Vec3<T>; 3] {
        self.vertices
    }

    /// Unit normal.
    pub const fn normal(&self) -> Vec3<T> {
        self.normal
    }

    /// Centre of the bounding sphere.
    pub const fn bounds_center(&self) -> Vec3<T> {
        self.bounds_center
    }

    /// Square of the radius of the bounding sphere, rounded up.
    pub const fn bounds_radius_squared(&self) -> T {
        self.bounds_radius_squared
    }

    /// Upper bound of the origin offset on this triangle.
    pub const fn offset(&self) -> T {
        self.offset
    }

    /// Material and place in the file.
    #[inline(always)]
    pub const fn info(&self) -> ObjectInfo {
        self.info
    }

    /// Whether a coarse look in integers, which decides first where floats are emulated, finds that the ray does
    /// not hit its sphere.
    #[doc(hidden)]
    #[inline(always)]
    pub fn quick_reject(&self, ray: &Ray<T>) -> bool {
        QuickReject::of(
            ray,
            self.bounds_center,
            self.bounds_radius_squared,
            self.offset,
        )
        .is_some_and(|quick| quick.is_clear_miss())
    }

    /// Whether the ray's line may come close enough to the triangle for the exact test to hit; never wrong in the other
    /// direction ([`reach`]).
    #[inline(always)]
    fn may_hit(&self, ray: &Ray<T>) -> bool {
        if T::EMULATED && self.quick_reject(ray) {
            return false;
        }
        let (b, across) = closest_approach(
            self.bounds_center.real(),
            ray.origin.real(),
            ray.direction.real(),
        );
        across
            .0
            .is_up_to(reach(Real(self.bounds_radius_squared), b).0)
    }

    /// Distance of the crossing within `0 < t ≤ t_max`.
    #[inline(always)]
    pub fn intersect(&self, ray: &Ray<T>, t_max: T) -> Option<T> {
        self.crossing(ray).filter(|t| t.is_up_to(t_max))
    }

    /// [`Triangle::intersect`] without a limit; the distance may be infinite.
    #[inline(always)]
    fn crossing(&self, ray: &Ray<T>) -> Option<T> {
        if !self.may_hit(ray) {
            return None;
        }
        let (o, d) = (ray.origin, ray.direction);
        self.crossing_exactly(o.x, o.y, o.z, d.x, d.y, d.z)
    }

    /// The watertight test of [`formula::triangle`](crate::formula::triangle).
    // Numbers are passed in registers; a vector is passed by a reference, which would keep the tracer's rays in
    // memory.
    #[inline]
    fn crossing_exactly(
        &self,
        origin_x: T,
        origin_y: T,
        origin_z: T,
        direction_x: T,
        direction_y: T,
        direction_z: T,
    ) -> Option<T> {
        let origin = Vec3::new(origin_x, origin_y, origin_z);
        let direction = Vec3::new(direction_x, direction_y, direction_z);
        // Turn the axes so that z is the ray's largest component; the winding does not matter here.
        let turn = Turn::largest_to_z(direction);
        let shear = Shear::along(turn.apply(direction).real());
        let [v1, v2, v3] = self.vertices;
        let sheared = |vertex: Vec3<T>| shear.apply(turn.apply(vertex - origin).real());
        let (a, b, c) = (sheared(v1), sheared(v2), sheared(v3));
        let (u, v, w) = (signed_edge(c, b), signed_edge(a, c), signed_edge(b, a));
        // Inside: no two edge functions of opposite sign.
        let inside =
            (u.0.is_zero_or_positive() && v.0.is_zero_or_positive() && w.0.is_zero_or_positive())
                || (u.0.is_zero_or_negative()
                    && v.0.is_zero_or_negative()
                    && w.0.is_zero_or_negative());
        if !inside || (u + v + w).0.is_zero() {
            return None;
        }
        let (below, slope) = rise(self.normal.real(), (v1 - origin).real(), direction.real());
        let t = (below / slope).0;
        let t = if slope.0.abs().is_before(T::from_f64(GRAZING)) {
            self.limited(
                turn,
                t,
                origin_x,
                origin_y,
                origin_z,
                direction_x,
                direction_y,
                direction_z,
            )
        } else {
            t
        };
        t.is_positive().then_some(t)
    }

    /// A distance limited to where the ray passes the vertices along the largest component of its direction, which the
    /// hierarchy relies on, and to where it is in the bounding sphere, which all other exclusions rely on. Not a number remains none.
    // The operators are the compiler's, which are smaller where floats are emulated.
    #[cold]
    #[inline(never)]
    #[expect(clippy::too_many_arguments)]
    fn limited(
        &self,
        turn: Turn,
        t: T,
        origin_x: T,
        origin_y: T,
        origin_z: T,
        direction_x: T,
        direction_y: T,
        direction_z: T,
    ) -> T {
        let origin = Vec3::new(origin_x, origin_y, origin_z);
        let d = Vec3::new(direction_x, direction_y, direction_z);
        let lesser = |a: T, b: T| if b < a { b } else { a };
        let greater = |a: T, b: T| if b > a { b } else { a };
        // `closest_approach`.
        let f = self.bounds_center - origin;
        let middle = f.x * d.x + f.y * d.y + f.z * d.z;
        let l = f - d * middle;
        let across = l.x * l.x + l.y * l.y + l.z * l.z;
        let half_chord = (self.bounds_radius_squared - across).sqrt();
        let [v1, v2, v3] = &self.vertices;
        let (v1, v2, v3, origin, direction) = match turn {
            Turn::None => (v1.z, v2.z, v3.z, origin.z, d.z),
            Turn::XToZ => (v1.x, v2.x, v3.x, origin.x, d.x),
            Turn::YToZ => (v1.y, v2.y, v3.y, origin.y, d.y),
        };
        let lowest = (lesser(lesser(v1, v2), v3) - origin) / direction;
        let highest = (greater(greater(v1, v2), v3) - origin) / direction;
        // Comparisons with NaN, of a ray that passes by the sphere, keep what is there.
        let first = greater(lesser(lowest, highest), middle - half_chord);
        let last = lesser(greater(lowest, highest), middle + half_chord);
        if t < first {
            first
        } else if t > last {
            last
        } else {
            t
        }
    }

    /// Whether the ray crosses the triangle within `0 < t < t_max`.
    #[inline(always)]
    pub fn occludes(&self, ray: &Ray<T>, t_max: T) -> bool {
        matches!(self.intersect(ray, t_max), Some(t) if t < t_max)
    }

    /// The point at distance `t`, projected back onto the plane of the triangle.
    #[inline(always)]
    pub fn surface_point(&self, ray: &Ray<T>, t: T) -> SurfacePoint<T> {
        let [vertex, ..] = self.vertices;
        SurfacePoint {
            point: project(ray.at(t).real(), self.normal.real(), vertex.real()).plain(),
            normal: self.normal,
            offset: self.offset,
        }
    }
}

impl<T: Scalar> Primitive<T> for Triangle<T> {
    const KIND: Kind = Kind::Triangle;
    const IS_FLAT: bool = true;
    const IS_BOUNDED: bool = true;

    fn shape(&self) -> Shape<T> {
        Shape::Triangle(self.vertices)
    }

    #[inline(always)]
    fn info(&self) -> ObjectInfo {
        self.info
    }

    fn set_material(&mut self, material: u32) {
        self.info.material = material;
    }

    fn bounding_sphere(&self) -> Option<BoundingSphere<T>> {
        Some(BoundingSphere {
            center: self.bounds_center,
            radius: self.bounds_radius_squared.sqrt(),
        })
    }

    fn bounding_box(&self) -> Option<[Vec3<T>; 2]> {
        let [v1, v2, v3] = self.vertices;
        let lowest = v1.min_by_component(v2).min_by_component(v3);
        let highest = v1.max_by_component(v2).max_by_component(v3);
        Some([lowest, highest])
    }

    #[inline(always)]
    fn hit(&self, ray: &Ray<T>, t_max: T) -> Option<T> {
        self.intersect(ray, t_max)
    }

    #[inline(always)]
    fn occludes(&self, ray: &Ray<T>, t_max: T) -> bool {
        self.occludes(ray, t_max)
    }

    fn plane(&self) -> Option<FlatPlane<T>> {
        let [vertex, ..] = self.vertices;
        Some(FlatPlane {
            normal: self.normal,
            height: self.normal.dot(vertex),
            offset: self.offset,
        })
    }

    #[inline(always)]
    fn point(&self, ray: &Ray<T>, t: T) -> SurfacePoint<T> {
        self.surface_point(ray, t)
    }
}

impl<T: Scalar> ListedShape<T> for Triangle<T> {
    const SEVERAL: Stages = Stages::SEVERAL_TRIANGLES;

    #[inline(always)]
    fn object(&self) -> Object<'_, T> {
        Object::Triangle(self)
    }

    #[inline(always)]
    fn all<'a>(geometry: &Geometry<'a, T>) -> &'a [Self] {
        geometry.triangles
    }

    #[cfg(feature = "bake")]
    fn parts(&self) -> (&'static str, [Option<super::Part<T>>; 6]) {
        use super::Part::{Number, Vector, Vectors};
        let parts = [
            Some(Vectors(self.vertices)),
            Some(Vector(self.normal)),
            Some(Vector(self.bounds_center)),
            Some(Number(self.bounds_radius_squared)),
            Some(Number(self.offset)),
            None,
        ];
        ("Triangle", parts)
    }
}

/// A cyclic exchange of axes.
#[derive(Clone, Copy)]
enum Turn {
    None,
    XToZ,
    YToZ,
}

impl Turn {
    #[inline(always)]
    fn largest_to_z<T: Scalar>(direction: Vec3<T>) -> Self {
        let d = direction.abs();
        if d.x > d.y && d.x > d.z {
            Self::XToZ
        } else if d.y > d.z {
            Self::YToZ
        } else {
            Self::None
        }
    }

    #[inline(always)]
    fn apply<T: Scalar>(self, v: Vec3<T>) -> Vec3<T> {
        match self {
            Self::None => v,
            Self::XToZ => Vec3::new(v.y, v.z, v.x),
            Self::YToZ => Vec3::new(v.z, v.x, v.y),
        }
    }
}

/// A vector product whose components are off by their own rounding alone. Of a long thin triangle it is short, and what
/// products lose would tilt its normal along its length.
fn precise_cross<T: Scalar>(a: Vec3<T>, b: Vec3<T>) -> Vec3<T> {
    #[inline(never)]
    fn component<T: Scalar>(a: T, b: T, c: T, d: T) -> T {
        difference_of_products(a, b, c, d)
    }
    Vec3::new(
        component(a.y, b.z, a.z, b.y),
        component(a.z, b.x, a.x, b.z),
        component(a.x, b.y, a.y, b.x),
    )
}

/// The edge function with the right sign.
#[inline(always)]
fn signed_edge<T: Scalar>(p: [Real<T>; 2], q: [Real<T>; 2]) -> Real<T> {
    // Hardly ever called, so that it is not inlined. Numbers are passed in registers. Where floats are emulated the compiler's
    // operators are smaller than this crate's, and so is one error less inlined.
    #[cold]
    #[inline(never)]
    fn exact<T: Scalar>(px: T, qy: T, py: T, qx: T) -> T {
        if T::EMULATED {
            error(px, qy) - error(py, qx)
        } else {
            product_error(px, qy) - product_error(py, qx)
        }
    }
    #[inline(never)]
    fn error<T: Scalar>(a: T, b: T) -> T {
        product_error(a, b)
    }
    let edge = edge(p, q);
    if edge.0.is_zero() {
        let ([px, py], [qx, qy]) = (p, q);
        Real(exact(px.0, qy.0, py.0, qx.0))
    } else {
        edge
    }
}

/// A small sphere that holds three points: around the middle of the longest edge or around the
/// centroid, whichever is smaller. Its square radius is rounded up as [`reach`] needs.
fn bounds_of<T: Scalar>(vertices: [Vec3<T>; 3]) -> (Vec3<T>, T) {
    let [v1, v2, v3] = vertices;
    let squared = |v: Vec3<T>| v.dot(v);
    // Halve before adding: the sum of two large coordinates may overflow.
    let middle = |a: Vec3<T>, b: Vec3<T>| a * T::HALF + b * T::HALF;
    let third = T::ONE / (T::ONE + T::TWO);
    let candidates = [
        middle(v1, v2),
        middle(v2, v3),
        middle(v3, v1),
        v1 * third + v2 * third + v3 * third,
    ];
    let mut best = (v1, T::MAX);
    for center in candidates {
        let radius_squared = squared(v1 - center)
            .max(squared(v2 - center))
            .max(squared(v3 - center));
        let rounded_up = radius_squared + radius_squared * slack(radius_squared);
        if rounded_up < best.1 {
            best = (center, rounded_up);
        }
    }
    best
}
