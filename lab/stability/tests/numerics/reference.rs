//! The arithmetic that the cases are measured against.

use scanray::{Ray, Vec3};
use scanray_stability::reference::{Wide, beside, narrow, plane_crossing, ratio, sphere_crossings};

#[test]
fn has_the_digits_that_double_precision_has_not() {
    let root = Wide::from(2.0).sqrt();
    assert!(narrow((root * root - 2.0).abs()) < 1e-31);
    for (a, b) in [(1.0, 3.0), (-2.0, 7.0), (1e10, 0.1)] {
        let quotient = ratio(Wide::from(a), root * b);
        assert!(narrow((quotient * root * b - a).abs()) < a.abs() * 1e-30);
    }
    let ray = Ray::new(Vec3::new(0.0, 0.0, 0.0), Vec3::new(0.0, 0.6, 0.8_f64));
    // 0.6 and 0.8 are rounded, so that the direction is not quite of length 1: the distance from the
    // line does not depend on it.
    let point = ray.direction * 1e6;
    assert!(narrow(beside(point, &ray)) < 1e-9);
    let crossings = sphere_crossings(Vec3::new(0.0, 3.0, 4.0), 1.0, &ray).unwrap();
    assert!((narrow(crossings[0]) - 4.0).abs() < 1e-15);
    let plane = plane_crossing(Vec3::new(0.0, 0.0, 1.0), 4.0, &ray).unwrap();
    assert!((narrow(plane) - 5.0).abs() < 1e-15);
}
