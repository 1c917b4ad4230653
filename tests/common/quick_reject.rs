//! Makes sure that what a device tests with integers, before it tests with floats, is what it says.

use scanray::{Ray, Scalar, shape::Object, tracer::Observer};

/// An observer that checks each test of a ray: of spheres and triangles that integers find to be missed floats do, too.
///
/// # Panics
///
/// With the ray and the object, if one is hit.
#[derive(Clone, Copy, Debug, Default)]
pub struct ClearMisses {
    /// How many tests integers decide.
    pub count: u64,
}

impl<T: Scalar> Observer<T> for ClearMisses {
    fn test_object(&mut self, object: Object<'_, T>, ray: &Ray<T>, _: T) {
        let (is_clear, is_met) = match object {
            Object::Sphere(sphere) => (
                sphere.quick_reject(ray),
                sphere.intersect(ray, T::MAX).is_some(),
            ),
            Object::Triangle(triangle) => (
                triangle.quick_reject(ray),
                triangle.intersect(ray, T::MAX).is_some(),
            ),
            _ => return,
        };
        assert!(!(is_clear && is_met), "{ray:?} hits {object:?}");
        self.count += u64::from(is_clear);
    }
}
