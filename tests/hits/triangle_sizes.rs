//! Triangles of any size are hit as they are at size 1, or refused; none vanishes.

use crate::common::random::Random;
use scanray::parser::FromDecimal;
use scanray::shape::{ObjectInfo, ShapeError, Triangle};
use scanray::{Ray, Scalar, ScenePools, Vec3};

const INFO: ObjectInfo = ObjectInfo {
    material: 0,
    number: 0,
};

fn scaled<T: Scalar>(vertices: [Vec3<T>; 3], exponent: i32) -> [Vec3<T>; 3] {
    vertices.map(|vertex| vertex * T::from_f64(2.0_f64.powi(exponent)))
}

/// Rays at triangles with coordinates up to 1 and a third of that in size at least, scaled by powers of two.
fn hits_at_every_size<T: Scalar>(seed: u64, exponents: impl Iterator<Item = i32> + Clone) {
    let random = Random::of_test(seed);
    let (mut hits, mut misses) = (0, 0);
    while hits < 200 {
        let vertices: [Vec3<T>; 3] = [(); 3].map(|()| random.point(0.999));
        let Ok(triangle) = Triangle::new(vertices, INFO) else {
            continue;
        };
        if triangle.bounds_radius_squared() < T::from_f64(0.1) {
            continue;
        }
        let ray = Ray::new(random.point(1.0), random.direction());
        let t = triangle.intersect(&ray, T::MAX);
        for exponent in exponents.clone() {
            let factor = T::from_f64(2.0_f64.powi(exponent));
            let triangle = Triangle::new(scaled(vertices, exponent), INFO);
            let triangle = triangle.unwrap_or_else(|why| panic!("2^{exponent}: {why}"));
            let ray = Ray::new(ray.origin * factor, ray.direction);
            assert_eq!(
                triangle.intersect(&ray, T::MAX),
                t.map(|t| t * factor),
                "2^{exponent}: {triangle:?}, {ray:?}"
            );
        }
        match t {
            Some(_) => hits += 1,
            None => misses += 1,
        }
    }
    assert!(misses > 200);
}

#[test]
fn are_hit_as_at_size_1() {
    hits_at_every_size::<f32>(194, -48..=60);
    hits_at_every_size::<f64>(195, (-482..=508).step_by(11));
}

#[test]
fn beyond_are_refused() {
    fn check<T: Scalar>(smallest: i32, largest: i32) {
        let unit = [
            Vec3::new(T::ZERO, T::ZERO, T::ZERO),
            Vec3::new(T::ONE, T::ZERO, T::ZERO),
            Vec3::new(T::ZERO, T::ONE, T::ZERO),
        ];
        let new = |exponent| Triangle::new(scaled(unit, exponent), INFO).err();
        // Its bounding sphere has a radius of 0.7.
        assert_eq!(new(smallest + 1), None);
        assert_eq!(new(smallest), Some(ShapeError::TooSmall));
        assert_eq!(new(smallest - 60), Some(ShapeError::TooSmall));
        assert_eq!(new(largest), None);
        assert_eq!(new(largest + 1), Some(ShapeError::TooLarge));
        let mut infinite = unit;
        infinite[1].y = T::MAX * T::TWO;
        assert_eq!(
            Triangle::new(infinite, INFO).err(),
            Some(ShapeError::TooLarge)
        );
    }
    check::<f32>(-51, 60);
    check::<f64>(-485, 508);
}

#[test]
fn a_text_says_where_and_what_is_possible() {
    fn message<T: Scalar + FromDecimal>(size: &str) -> String {
        let text = format!(
            "1\n0 0 0\n4 3\n0 0 0 1 1 1 1 1 1\n1\n0\n0 0 0\n\
             2 {size} 0 0 0 {size} 0 0 0 {size} 0 0 0 0 1 1 1 0 0 0 1 1 1 0 50 0 0\n"
        );
        let mut pools = ScenePools::<T, 0, 0, 1, 1>::new();
        match pools.parse(text.as_bytes()) {
            Ok(_) => String::new(),
            Err(why) => why.to_string(),
        }
    }
    for size in ["1e-17", "-1e-30", "3e18", "1e30"] {
        let message = message::<f32>(size);
        assert!(message.starts_with("line 8, column 3: "), "{message}");
        assert!(
            message.contains("a triangle of at least 1e-15 across, with coordinates up to 1e18"),
            "{message}"
        );
        assert!(message.contains(&format!("`{size}`")), "{message}");
    }
    for size in ["2e-15", "1e-6", "1", "5e12", "1e18"] {
        assert_eq!(message::<f32>(size), "");
    }
    for size in ["1e-140", "1e-30", "1e30", "1e152"] {
        assert_eq!(message::<f64>(size), "");
    }
    assert!(message::<f64>("1e153").contains("coordinates up to 8e152"));
}
