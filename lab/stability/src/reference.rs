//! Geometry in double-double arithmetic: 106 bits, twice those of `f64`.
//!
//! By the crate `twofloat` (Joldes, Muller and Popescu, "Tight and rigorous error bounds for basic building
//! blocks of double-word arithmetic", ACM TOMS 44(2), 2017). Scene and ray are taken as the code under test
//! has them, rounded, so that what differs is the code's own error.

use scanray::{Ray, Scalar, Vec3};
use twofloat::TwoFloat;

/// A number of 106 bits. Divide by [`ratio`]: the operator of `twofloat` 0.8 has 53 bits where both numbers are
/// wide.
pub type Wide = TwoFloat;

/// The quotient, by long division: each digit of 53 bits is taken from what the ones before it left.
pub fn ratio(a: Wide, b: Wide) -> Wide {
    let first = a.hi() / b.hi();
    let left = a - b * first;
    let second = left.hi() / b.hi();
    let left = left - b * second;
    Wide::new_add(first, second) + left.hi() / b.hi()
}

/// A vector of such numbers.
#[derive(Clone, Copy, Debug)]
pub struct WideVec([Wide; 3]);

impl WideVec {
    /// A vector of either scalar, exactly.
    pub fn of<T: Scalar>(v: Vec3<T>) -> Self {
        Self([v.x, v.y, v.z].map(|component| Wide::from(component.to_f64())))
    }

    /// The sum.
    pub fn plus(self, other: Self) -> Self {
        Self(std::array::from_fn(|i| self.0[i] + other.0[i]))
    }

    /// The difference.
    pub fn minus(self, other: Self) -> Self {
        Self(std::array::from_fn(|i| self.0[i] - other.0[i]))
    }

    /// The multiple.
    pub fn times(self, factor: Wide) -> Self {
        Self(self.0.map(|component| component * factor))
    }

    /// The scalar product.
    pub fn dot(self, other: Self) -> Wide {
        self.0[0] * other.0[0] + self.0[1] * other.0[1] + self.0[2] * other.0[2]
    }

    /// The vector product.
    pub fn cross(self, other: Self) -> Self {
        let ([a, b, c], [d, e, f]) = (self.0, other.0);
        Self([b * f - c * e, c * d - a * f, a * e - b * d])
    }

    /// The length.
    pub fn length(self) -> Wide {
        self.dot(self).sqrt()
    }

    /// The vector of length 1.
    pub fn unit(self) -> Self {
        self.times(ratio(Wide::from(1.0), self.length()))
    }
}

/// A number of either scalar, exactly.
pub fn wide<T: Scalar>(x: T) -> Wide {
    Wide::from(x.to_f64())
}

/// The nearest number of `f64`.
pub fn narrow(x: Wide) -> f64 {
    f64::from(x)
}

/// The distance between a point and the line of a ray.
pub fn beside<T: Scalar>(point: Vec3<T>, ray: &Ray<T>) -> Wide {
    let (f, d) = (
        WideVec::of(point).minus(WideVec::of(ray.origin)),
        WideVec::of(ray.direction),
    );
    ratio(f.cross(d).length(), d.length())
}

/// The distances, along the ray, at which its line crosses a sphere, nearer first.
pub fn sphere_crossings<T: Scalar>(center: Vec3<T>, radius: T, ray: &Ray<T>) -> Option<[Wide; 2]> {
    let (f, d) = (
        WideVec::of(center).minus(WideVec::of(ray.origin)),
        WideVec::of(ray.direction),
    );
    let (squared, across) = (d.dot(d), f.cross(d));
    let discriminant = wide(radius) * wide(radius) * squared - across.dot(across);
    (discriminant >= 0.0).then(|| {
        let (middle, half) = (f.dot(d), discriminant.sqrt());
        [ratio(middle - half, squared), ratio(middle + half, squared)]
    })
}

/// The distance, along the ray, at which its line crosses the plane of the points with `normal·p = height`;
/// `None` for a parallel ray.
pub fn plane_crossing<T: Scalar>(normal: Vec3<T>, height: T, ray: &Ray<T>) -> Option<Wide> {
    let n = WideVec::of(normal);
    let slope = n.dot(WideVec::of(ray.direction));
    let above = wide(height) - n.dot(WideVec::of(ray.origin));
    (slope != 0.0).then(|| ratio(above, slope))
}

/// How far inside the edges of a triangle the ray's line passes, as the least barycentric weight: negative
/// outside; `None` for a parallel ray.
pub fn least_weight<T: Scalar>(vertices: [Vec3<T>; 3], ray: &Ray<T>) -> Option<Wide> {
    let origin = WideVec::of(ray.origin);
    let d = WideVec::of(ray.direction);
    let [a, b, c] = vertices.map(|vertex| WideVec::of(vertex).minus(origin));
    let volumes = [d.dot(b.cross(c)), d.dot(c.cross(a)), d.dot(a.cross(b))];
    let sum = volumes[0] + volumes[1] + volumes[2];
    (sum != 0.0).then(|| {
        let [u, v, w] = volumes.map(|volume| ratio(volume, sum));
        u.min(v).min(w)
    })
}
