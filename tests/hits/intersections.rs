//! The three shapes, in random positions over many decades: what is hit lies on the shape and on the ray,
//! what is missed is missed, and the question in another form has the same answer.

use crate::common::random::Random;
use crate::common::scenes::RoomyPools;
use scanray::ScenePools;
use scanray::shape::{ObjectInfo, Plane, Sphere, Triangle};
use scanray::{MaterialDescription, Ray, Scalar, Tracer, Vec3, ray::Side, shape::Object};

const SURFACE: ObjectInfo = ObjectInfo {
    material: 0,
    number: 0,
};

fn wide<T: Scalar>(v: Vec3<T>) -> Vec3<f64> {
    Vec3::new(v.x.to_f64(), v.y.to_f64(), v.z.to_f64())
}

fn narrow<T: Scalar>(v: Vec3<f64>) -> Vec3<T> {
    Vec3::new(T::from_f64(v.x), T::from_f64(v.y), T::from_f64(v.z))
}

fn length(v: Vec3<f64>) -> f64 {
    v.dot(v).sqrt()
}

fn largest<T: Scalar>(v: Vec3<T>) -> f64 {
    wide(v).abs().max_component()
}

/// A ray from `origin` in the direction of `target`, both as rounded to the scalar.
fn ray_to<T: Scalar>(origin: Vec3<T>, target: Vec3<f64>) -> Ray<T> {
    let exact = (target - wide(origin)).normalize();
    Ray::new(origin, narrow::<T>(exact).normalize())
}

/// Distance of a point from the line of a ray.
fn distance_from_ray<T: Scalar>(ray: &Ray<T>, point: Vec3<T>) -> f64 {
    let (origin, direction) = (wide(ray.origin), wide(ray.direction));
    length((wide(point) - origin).cross(direction)) / length(direction)
}

/// The rounding unit.
fn unit<T: Scalar>() -> f64 {
    T::EPSILON.to_f64()
}

/// `occludes` is `intersect` with a nearer end, and both keep to it.
fn check_ends<T: Scalar>(
    t: Option<T>,
    random: &Random,
    intersect: impl Fn(T) -> Option<T>,
    occludes: impl Fn(T) -> bool,
    what: &dyn Fn() -> String,
) {
    let ends = match t {
        Some(t) => {
            assert!(t > T::ZERO && t.is_finite(), "t = {t:?} at {}", what());
            let beyond = t + t * T::EPSILON;
            let before = t - t * T::EPSILON;
            let near = t * T::from_f64(random.between(0.0, 0.9));
            assert_eq!(intersect(t), Some(t), "t_max = t is included at {}", what());
            assert!(!occludes(t), "t_max = t does not occlude at {}", what());
            assert!(occludes(beyond), "occludes before {beyond:?} at {}", what());
            vec![t, beyond, before, near, T::MAX]
        }
        None => vec![T::ONE, T::from_f64(random.log_between(1e-10, 1e10)), T::MAX],
    };
    for end in ends {
        let found = intersect(end);
        let is_before = matches!(found, Some(t) if t < end);
        assert_eq!(occludes(end), is_before, "t_max = {end:?} at {}", what());
        if let Some(found) = found {
            assert!(
                found <= end,
                "{found:?} beyond t_max = {end:?} at {}",
                what()
            );
        }
        // A shorter ray finds the same crossing or none.
        assert!(
            found.is_none() || found == t,
            "t_max = {end:?} at {}",
            what()
        );
    }
}

/// Rays at a sphere of any size from any distance, near its silhouette and inside it.
fn spheres<T: Scalar>(seed: u64, rounds: usize) {
    let random = Random::of_test(seed);
    let (mut hits, mut misses, mut quick_reject) = (0, 0, 0);
    for _ in 0..rounds {
        let radius = T::from_f64(random.log_between(1e-6, 1e6));
        let r = radius.to_f64();
        let center: Vec3<T> = random.point(random.log_between(1e-3, 1e3) * r);
        let sphere = Sphere::new(center, radius, SURFACE).unwrap();
        let c = wide(center);
        // From 1/10 of a radius to 1,000 radii away from the centre.
        let away: Vec3<f64> = random.direction();
        let origin: Vec3<T> = narrow(c + away * (r * random.log_between(0.1, 1e3)));
        // Past the centre at 0 to 2 radii.
        let aside: Vec3<f64> = random.direction();
        let target = c + aside * (r * random.between(0.0, 2.0));
        let ray = ray_to(origin, target);
        let what = || format!("{sphere:?}, {ray:?}");

        let t = sphere.intersect(&ray, T::MAX);
        if sphere.quick_reject(&ray) {
            assert_eq!(t, None, "clearly missed: {}", what());
            quick_reject += 1;
        }
        check_ends(
            t,
            &random,
            |end| sphere.intersect(&ray, end),
            |end| sphere.occludes(&ray, end),
            &what,
        );

        // The answer by plain geometry in f64, which is sure outside a thin band.
        let (f, d) = (c - wide(origin), wide(ray.direction));
        let (ahead, beside) = (f.dot(d), length(f.cross(d)));
        let inside = length(f) < r * (1.0 - 1e-3);
        let passes = beside < r * (1.0 - 1e-3);
        let outside = length(f) > r * (1.0 + 1e-3);
        if inside || (outside && passes && ahead > 0.0) {
            assert!(t.is_some(), "should be hit: {}", what());
        }
        if outside && (beside > r * (1.0 + 1e-3) || ahead < 0.0) {
            assert!(t.is_none(), "should be missed: {}", what());
        }

        let Some(t) = t else {
            misses += 1;
            continue;
        };
        hits += 1;
        let hit = sphere.surface_point(&ray, t);
        let extent = largest(center) + r;
        let off = (length(wide(hit.point) - c) - r).abs();
        assert!(
            off <= 4.0 * unit::<T>() * extent,
            "{off:e} off the sphere: {}",
            what()
        );
        let normal = length(wide(hit.normal));
        assert!(
            (normal - 1.0).abs() <= 4.0 * unit::<T>(),
            "normal {normal}: {}",
            what()
        );
        // Next to the ray: at the silhouette the crossing is uncertain along the surface.
        let reach = extent + t.to_f64() + largest(origin);
        let off = distance_from_ray(&ray, hit.point);
        let cosine = wide(hit.normal).dot(d).abs().max(1e-6);
        assert!(
            off <= 16.0 * unit::<T>() * reach / cosine,
            "{off:e} off the ray: {}",
            what()
        );
        // The far crossing shows the inner side, the near one the outer.
        if outside {
            assert!(
                cosine < 1e-3 || wide(hit.normal).dot(d) < 0.0,
                "far side: {}",
                what()
            );
        }
        assert!(
            hit.offset > T::ZERO && hit.offset.to_f64() < 1e-5 * (extent + r),
            "{hit:?}"
        );
    }
    println!("{hits} hits, {misses} misses, {quick_reject} of them clear");
    assert!(
        hits > rounds / 4
            && misses > rounds / 20
            && (quick_reject > misses / 4) == (T::NAME == f32::NAME)
    );
}

#[test]
fn spheres_in_single_precision() {
    spheres::<f32>(81, 200_000);
}

#[test]
fn spheres_in_double_precision() {
    spheres::<f64>(82, 100_000);
}

/// Integers tell of misses alone, however little a ray passes a sphere by or its origin lies outside of it.
#[test]
fn clear_misses_are_misses_at_the_edge() {
    let random = Random::of_test(83);
    let (mut hits, mut quick_reject) = (0, 0);
    for _ in 0..1_000_000 {
        let radius = random.log_between(1e-18, 1e18) as f32;
        let r = f64::from(radius);
        let center: Vec3 = random.point(random.log_between(1e-3, 1e3) * r);
        let sphere = Sphere::new(center, radius, SURFACE).unwrap();
        let c = wide(center);
        let nearly = |by: f64| 1.0 + random.sign() * random.log_between(1e-8, by);
        let away: Vec3<f64> = random.direction();
        let ray = match random.below(2) {
            // A tangent, or nearly, from near and far, the sphere ahead or behind.
            0 => {
                let side = away.cross(random.direction()).normalize() * (r * nearly(0.3));
                let start = side + away * (r * random.sign() * random.log_between(1e-6, 1e2));
                let origin: Vec3 = narrow(c + start);
                ray_to(origin, c + side)
            }
            // From the surface, or nearly, in any direction.
            _ => {
                let origin: Vec3 = narrow(c + away * (r * nearly(0.1)));
                Ray::new(origin, random.direction())
            }
        };
        let t = sphere.intersect(&ray, f32::MAX);
        hits += usize::from(t.is_some());
        if sphere.quick_reject(&ray) {
            assert_eq!(t, None, "{sphere:?}, {ray:?}");
            quick_reject += 1;
        }
    }
    println!("{hits} hits, {quick_reject} clear misses");
    assert!(hits > 200_000 && quick_reject > 30_000);
}

/// Rays at a plane from both sides, along it and away from it.
fn planes<T: Scalar>(seed: u64, rounds: usize) {
    let random = Random::of_test(seed);
    let mut hits = 0;
    for _ in 0..rounds {
        let scale = random.log_between(1e-6, 1e6);
        let stretch = T::from_f64(random.log_between(1e-3, 1e3));
        let normal: Vec3<T> = random.direction::<T>() * stretch;
        let distance = T::from_f64(random.between(-1.0, 1.0) * scale);
        let plane = Plane::new(normal, distance, SURFACE).unwrap();
        let origin: Vec3<T> = random.point(scale * random.log_between(1e-2, 1e2));
        let (n, o) = (wide(plane.normal()), wide(origin));
        let mut direction: Vec3<f64> = random.direction();
        if random.below(4) == 0 {
            // Grazing: almost along the plane.
            let along = direction - n * n.dot(direction);
            direction = along + n * (random.sign() * random.log_between(1e-6, 1e-2));
        }
        let ray = Ray::new(origin, narrow::<T>(direction.normalize()).normalize());
        let what = || format!("{plane:?}, {ray:?}");

        let t = plane.intersect(&ray, T::MAX);
        check_ends(
            t,
            &random,
            |end| plane.intersect(&ray, end),
            |end| plane.occludes(&ray, end),
            &what,
        );

        let (k, d) = (plane.height().to_f64(), wide(ray.direction));
        let (above, slope) = (n.dot(o) - k, n.dot(d));
        // Sure when neither the height above the plane nor the slope may be rounding alone.
        let noise = 8.0 * unit::<T>();
        let sure = above.abs() > noise * (length(o) + k.abs()) && slope.abs() > noise;
        if sure {
            assert_eq!(t.is_some(), above * slope < 0.0, "{}", what());
        }
        let Some(t) = t else { continue };
        hits += 1;
        let hit = plane.surface_point(&ray, t);
        let p = wide(hit.point);
        assert_eq!(hit.normal, plane.normal());
        let components = (n.x * p.x).abs() + (n.y * p.y).abs() + (n.z * p.z).abs();
        // Far away the point itself is rounded: its components bound how well it can lie on the plane.
        let off = (n.dot(p) - k).abs();
        let bound = 2.0 * unit::<T>() * (components + k.abs());
        assert!(
            off <= bound,
            "{off:e} off the plane, more than {bound:e}: {}",
            what()
        );
        // What new rays start from is far enough away, and not further than it must.
        let offset = hit.offset.to_f64();
        assert!(
            offset >= off && offset <= 1.01 * bound + f64::MIN_POSITIVE,
            "{}",
            what()
        );
        if sure {
            let exact = -above / slope;
            let error = (t.to_f64() - exact).abs();
            let bound =
                noise * (length(o) + k.abs()) / slope.abs() + 4.0 * noise * exact / slope.abs();
            assert!(
                error <= bound,
                "t is {error:e} off, more than {bound:e}: {}",
                what()
            );
        }
    }
    println!("{hits} hits of {rounds}");
    assert!(hits > rounds / 3 && hits < rounds);
}

#[test]
fn planes_in_single_precision() {
    planes::<f32>(84, 200_000);
}

#[test]
fn planes_in_double_precision() {
    planes::<f64>(85, 100_000);
}

/// Rays at triangles of any size and distance, at places inside and outside of them.
fn triangles<T: Scalar>(seed: u64, rounds: usize) {
    let random = Random::of_test(seed);
    let (mut hits, mut misses, mut quick_reject) = (0, 0, 0);
    for _ in 0..rounds {
        let size = random.log_between(1e-4, 1e4);
        let place: Vec3<f64> = random.point(size * random.log_between(1e-2, 1e2));
        let vertex = || narrow::<T>(place + random.point::<f64>(size));
        let vertices = [vertex(), vertex(), vertex()];
        let Ok(triangle) = Triangle::new(vertices, SURFACE) else {
            continue;
        };
        let [v1, v2, v3] = vertices.map(wide);
        let (e2, e3) = (v2 - v1, v3 - v1);
        // Thin ones have tests of their own.
        let area = length(e2.cross(e3)) / (length(e2) * length(e3)).max(1e-300);
        if area < 0.05 {
            continue;
        }
        let (a, b) = (random.between(-0.3, 1.3), random.between(-0.3, 1.3));
        let target = v1 + e2 * a + e3 * b;
        let origin: Vec3<T> =
            narrow(target + random.direction::<f64>() * (size * random.log_between(0.3, 30.0)));
        let mut ray = ray_to(origin, target);
        if random.below(5) == 0 {
            // The other way.
            ray.direction = -ray.direction;
        }
        let what = || format!("{triangle:?}, {ray:?}");

        let found = triangle.intersect(&ray, T::MAX);
        if triangle.quick_reject(&ray) {
            assert_eq!(found, None, "clearly missed: {}", what());
            quick_reject += 1;
        }
        check_ends(
            found,
            &random,
            |end| triangle.intersect(&ray, end),
            |end| triangle.occludes(&ray, end),
            &what,
        );

        // Where the ray's line hits the plane, in f64 (Möller and Trumbore).
        let (o, d) = (wide(ray.origin), wide(ray.direction));
        let p = d.cross(e3);
        let determinant = e2.dot(p);
        let grazing = determinant.abs() / (length(e2) * length(e3));
        if grazing < 0.02 {
            continue;
        }
        let s = o - v1;
        let q = s.cross(e2);
        let (u, v, t) = (
            s.dot(p) / determinant,
            d.dot(q) / determinant,
            e3.dot(q) / determinant,
        );
        // Rounding moves the ray by some units of the coordinates, which a slant magnifies.
        let reach = largest(origin) + largest(vertices[0]) + size + t.abs();
        let shortest = length(e2).min(length(e3));
        let band = 64.0 * unit::<T>() * reach / (shortest * grazing);
        let least = u.min(v).min(1.0 - u - v);
        let sure = least.abs() > band && t.abs() > band * shortest;
        if sure {
            assert_eq!(
                found.is_some(),
                least > 0.0 && t > 0.0,
                "u = {u}, v = {v}: {}",
                what()
            );
        }
        let Some(found) = found else {
            misses += 1;
            continue;
        };
        hits += 1;
        let hit = triangle.surface_point(&ray, found);
        let extent = vertices.map(largest).into_iter().fold(0.0, f64::max);
        // On the triangle: off its exact plane by no more than where new rays start.
        let exact_normal = e3.cross(e2).normalize();
        let off = exact_normal.dot(wide(hit.point) - v1).abs();
        // The exact plane is one of f64, too.
        let reference_error = 8.0 * f64::EPSILON * extent / area;
        assert!(
            off <= hit.offset.to_f64() + reference_error,
            "{off:e} off the triangle: {}",
            what()
        );
        assert!(
            hit.offset.to_f64() <= 16.0 * unit::<T>() * extent,
            "{}",
            what()
        );
        let turn = length(wide(hit.normal) - exact_normal);
        assert!(
            turn < 64.0 * unit::<T>() * extent / (shortest * area),
            "{turn:e}: {}",
            what()
        );
        // On the ray, too.
        let off = distance_from_ray(&ray, hit.point);
        assert!(
            off <= 64.0 * unit::<T>() * reach / grazing,
            "{off:e} off the ray: {}",
            what()
        );
        let error = (found.to_f64() - t).abs();
        assert!(
            error <= 64.0 * unit::<T>() * reach / grazing,
            "t is {error:e} off: {}",
            what()
        );
    }
    println!("{hits} hits, {misses} misses, {quick_reject} of them clear");
    assert!(
        hits > rounds / 10
            && misses > rounds / 10
            && (quick_reject > misses / 4) == (T::NAME == f32::NAME)
    );
}

#[test]
fn triangles_in_single_precision() {
    triangles::<f32>(86, 200_000);
}

#[test]
fn triangles_in_double_precision() {
    triangles::<f64>(87, 100_000);
}

#[test]
fn rays_that_leave_a_flat_object_do_not_hit_it_again() {
    let random = Random::of_test(90);
    for round in 0..20_000 {
        let scale = random.log_between(1e-4, 1e4);
        let mut pools = ScenePools::<f32, 1, 1, 1, 1, 0, 4>::new();
        let mut filling = pools.as_mut();
        let material = MaterialDescription::default();
        filling
            .add_plane(random.direction(), scale as f32, material)
            .unwrap();
        let vertices = [(); 3].map(|()| random.point::<f32>(scale));
        let _ = filling.add_triangle(vertices, material);
        // With what is derived and without.
        if round % 2 == 0 {
            pools.prepare();
        }
        let scene = pools.as_scene();
        let tracer = Tracer::new(scene);
        for index in 0..scene.object_count() {
            let leaving = Ray {
                origin: random.point(scale),
                direction: random.direction(),
                leaves: Side::new(index as u32, random.below(2) == 0),
            };
            let hit = tracer.nearest(&leaving).map(|nearest| nearest.index);
            assert_ne!(hit, Some(index), "{leaving:?}");
            let others = Tracer::new(match index {
                0 => scene.with_planes(&[]),
                _ => scene.with_triangles(&[]),
            });
            let open = Ray::new(leaving.origin, leaving.direction);
            let reach = f32::MAX;
            assert_eq!(
                tracer.occluded(&leaving, reach),
                others.occluded(&open, reach)
            );
        }
    }
}

/// The object of a hit by what it is, not by its number.
fn geometry(object: Object<'_>) -> String {
    match object {
        Object::Sphere(sphere) => format!("sphere {:?} {}", sphere.center(), sphere.radius()),
        Object::Plane(plane) => format!("plane {:?} {}", plane.normal(), plane.height()),
        Object::Triangle(triangle) => format!("triangle {:?}", triangle.vertices()),
        other => format!("{:?}", other.shape()),
    }
}

/// The nearest object is the same in whatever order objects are added, is the nearest of all single
/// answers, and what hides it is found by the shadow test too.
#[test]
fn nearest_does_not_depend_on_the_order_of_objects() {
    type Add = Box<dyn Fn(&mut scanray::pools::PoolsMut<'_, f32>)>;
    let random = Random::of_test(91);
    let material = MaterialDescription::default();
    for _ in 0..300 {
        let scale = random.log_between(1e-4, 1e4);
        let mut adds: Vec<Add> = Vec::new();
        for _ in 0..6 {
            let center = random.point::<f32>(scale);
            let radius = (scale * random.log_between(0.02, 0.3)) as f32;
            adds.push(Box::new(move |pools| {
                pools.add_sphere(center, radius, material).unwrap();
            }));
            let vertices = [(); 3].map(|()| center + random.point(0.4 * scale));
            adds.push(Box::new(move |pools| {
                let _ = pools.add_triangle(vertices, material);
            }));
        }
        for _ in 0..2 {
            let (normal, distance) = (
                random.direction(),
                (scale * random.between(0.2, 1.0)) as f32,
            );
            adds.push(Box::new(move |pools| {
                pools.add_plane(normal, distance, material).unwrap();
            }));
        }
        let rays: Vec<Ray> = (0..30)
            .map(|_| Ray::new(random.point(scale), random.direction()))
            .collect();
        let mut first: Option<Vec<_>> = None;
        for _ in 0..4 {
            random.shuffle(&mut adds);
            let mut pools = RoomyPools::<f32>::new();
            for add in &adds {
                add(&mut pools.as_mut());
            }
            let tracer = Tracer::new(pools.as_scene());
            let answers: Vec<_> = rays
                .iter()
                .map(|ray| {
                    let nearest = tracer.nearest(ray);
                    let singly = singly(&tracer, ray);
                    assert_eq!(nearest.map(|hit| hit.t), singly, "{ray:?}");
                    if let Some(hit) = nearest {
                        assert!(!tracer.occluded(ray, hit.t), "{ray:?}");
                        assert!(tracer.occluded(ray, hit.t * 1.000_001), "{ray:?}");
                    } else {
                        assert!(!tracer.occluded(ray, f32::MAX), "{ray:?}");
                    }
                    nearest.map(|hit| (hit.t, geometry(hit.object)))
                })
                .collect();
            match &first {
                None => first = Some(answers),
                Some(first) => assert_eq!(*first, answers),
            }
        }
    }
}

/// The smallest distance of all objects, each asked by itself.
fn singly(tracer: &Tracer<'_>, ray: &Ray) -> Option<f32> {
    tracer
        .scene()
        .objects()
        .filter_map(|object| match object {
            Object::Sphere(sphere) => sphere.intersect(ray, f32::MAX),
            Object::Plane(plane) => plane.intersect(ray, f32::MAX),
            Object::Triangle(triangle) => triangle.intersect(ray, f32::MAX),
            _ => unreachable!(),
        })
        .min_by(f32::total_cmp)
}
