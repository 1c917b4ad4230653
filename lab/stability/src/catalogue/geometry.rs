//! Cases 1 to 28, 70, 71 and 73: rays and shapes.

use scanray::shape::{Disc, ObjectInfo, Plane, Sphere, Triangle};
use scanray::{MaterialDescription, Ray, Scalar, ScenePools, Tracer, Vec3, shape::Object};

use super::cases;
use super::record::{Record, grey, ray_to, rounded, scaled, unit, vector, widened};
use crate::Number;
use crate::random::Random;
use crate::reference::{self, WideVec, narrow, ratio, wide};
use crate::scenes::{Part, Shape};
use crate::textbook;

cases! { Geometry:
    1 sphere_at_radius_over_distance_1e_2: "silhouette misclassified: 0 outside a band of 1e-3 of the radius";
    2 sphere_at_radius_over_distance_1e_3: "silhouette misclassified: 0 outside a band of 1e-3 of the radius";
    3 sphere_at_radius_over_distance_1e_4: "silhouette misclassified: 0 outside a band of 1e-3 of the radius";
    4 sphere_at_radius_over_distance_1e_6: "silhouette misclassified: at most 1 %";
    5 grazing_sphere: "rays at 1 ± 2e-4 radii, at a distance of one radius: at most 0.01 % misclassified";
    6 exact_tangent: "the discriminant is exactly 0, and the touching point is hit at t = 5";
    7 camera_inside_a_sphere: "the far root is hit, with the normal that faces the ray";
    8 camera_at_the_centre_of_a_sphere: "t is exactly the radius along the axes";
    9 origin_on_a_sphere: "outward rays miss, inward rays hit at 2r·cos θ";
    10 sphere_of_radius_1e6_below_the_camera: "the horizon is within 1 pixel, and nothing shadows itself";
    11 sphere_behind_the_ray: "missed";
    12 radius_zero: "rejected";
    13 radius_negative_or_nan: "rejected";
    14 radius_whose_square_is_subnormal: "tier C";
    15 radius_whose_square_is_zero: "tier C";
    16 radius_whose_square_is_infinite: "rejected";
    17 plane_at_grazing_angles: "t is off by at most 1e-7/cos θ, the hit off the plane by at most 2u(Σ|nᵢPᵢ| + |k|)";
    18 ray_in_or_parallel_to_a_plane: "missed";
    19 plane_seen_from_below: "the mirrored picture of the plane seen from above";
    20 plane_normals_of_any_length: "length 0 rejected, others normalised";
    21 rays_at_the_edges_of_a_closed_mesh: "0 leaks in 20,000";
    22 rays_at_the_vertices_of_a_closed_mesh: "0 leaks in 20,000";
    23 double_hits_on_an_edge: "0";
    24 triangle_without_area: "rejected; limit: one that is built by hand with Triangle::from_parts, which trusts its caller, is hit by rays aimed at it, at most 5 % of them";
    25 published_bad_case_of_pbrt: "rejected as a triangle without area, so that it is missed";
    26 sliver_triangle: "at distance 3, aspect 1e-3: 0 misclassified outside a band of 1e-3 of its width; 1e-5: at most 0.3 %";
    27 mesh_scaled_by_powers_of_two: "the same hits";
    28 coincident_objects: "of different shapes the first kind is seen (sphere, plane, triangle, disc), within a kind the first in the text, whatever the order";
    70 rim_of_a_disc: "rays at 0.9 to 1.1 radii, at cosines down to 1e-2: 0 misclassified outside a band of 1e-3 of the radius";
    71 long_thin_triangles: "1 to 10,000 times as long as high: no holes, and never before what hangs in front of them by 64u of their length";
    73 hit_in_the_centre_of_a_sphere: "its colours are finite, and it shows its own";
}

/// Rays of a statistical case.
const RAYS: u64 = 20_000;

const SURFACE: ObjectInfo = ObjectInfo {
    material: 0,
    number: 0,
};

/// A ray at a sphere of any size seen from a distance of so many radii, that passes its centre at a
/// number of radii between two; and what is known of it.
struct Aimed<T> {
    sphere: Sphere<T>,
    ray: Ray<T>,
    /// How far from the centre the ray passes, in radii.
    beside: f64,
}

fn aim<T: Number>(random: &Random, radius_over_distance: f64, [least, most]: [f64; 2]) -> Aimed<T> {
    let r = random.log_between(1e-4, 1e4);
    let toward: Vec3<f64> = random.direction();
    let center: Vec3<T> = rounded(toward * (r / radius_over_distance));
    let sphere = Sphere::new(center, T::from_f64(r), SURFACE).expect("a radius");
    let sideways = toward.cross(random.direction()).normalize();
    let target = widened(center) + sideways * (r * random.between(least, most));
    let ray = ray_to(vector(0.0, 0.0, 0.0), target);
    let beside = narrow(ratio(
        reference::beside(center, &ray),
        wide(sphere.radius()),
    ));
    Aimed {
        sphere,
        ray,
        beside,
    }
}

/// Counts wrong answers about a silhouette, of this form and of the textbook's.
fn silhouette<T: Number>(
    record: &mut Record,
    seed: u64,
    rays: u64,
    ratio: f64,
    passing: [f64; 2],
    band: f64,
) -> [u64; 2] {
    let random = record.random(seed);
    let mut wrong = [0, 0];
    for _ in 0..rays {
        let Aimed {
            sphere,
            ray,
            beside,
        } = aim::<T>(&random, ratio, passing);
        if (beside - 1.0).abs() <= band {
            continue;
        }
        let textbook = textbook::sphere(sphere.center(), sphere.radius(), &ray, T::ZERO);
        let answers = [sphere.intersect(&ray, T::MAX).is_some(), textbook.is_some()];
        for (wrong, hit) in wrong.iter_mut().zip(answers) {
            *wrong += u64::from(hit != (beside < 1.0));
        }
    }
    wrong
}

fn distant_sphere<T: Number>(record: &mut Record, seed: u64, ratio: f64) {
    let band = scaled::<T>(1e-3);
    let [wrong, by_textbook] = silhouette::<T>(record, seed, RAYS, ratio, [0.5, 1.5], band);
    record.count(
        format!("rays misclassified outside a band of {band:.0e}"),
        wrong,
        RAYS,
    );
    record.textbook_share(by_textbook);
}

fn sphere_at_radius_over_distance_1e_2<T: Number>(record: &mut Record) {
    distant_sphere::<T>(record, 101, 1e-2);
}

fn sphere_at_radius_over_distance_1e_3<T: Number>(record: &mut Record) {
    distant_sphere::<T>(record, 102, 1e-3);
}

fn sphere_at_radius_over_distance_1e_4<T: Number>(record: &mut Record) {
    distant_sphere::<T>(record, 103, 1e-4);
}

fn sphere_at_radius_over_distance_1e_6<T: Number>(record: &mut Record) {
    let [wrong, by_textbook] = silhouette::<T>(record, 104, RAYS, 1e-6, [0.0, 2.0], 0.0);
    record.share("rays misclassified", wrong, RAYS, 0.01);
    record.textbook_share(by_textbook);
}

fn grazing_sphere<T: Number>(record: &mut Record) {
    const MANY: u64 = 200_000;
    let near = [1.0 - 2e-4, 1.0 + 2e-4];
    // Two radii from the centre: one from the surface.
    let [wrong, by_textbook] = silhouette::<T>(record, 105, MANY, 0.5, near, 0.0);
    record.share("rays misclassified", wrong, MANY, 1e-4);
    record.textbook_share(by_textbook);
}

/// A material of one ambient and one diffuse level.
fn matte<T: Scalar>(ambient: f64, diffuse: f64) -> MaterialDescription<T> {
    MaterialDescription {
        ambient: grey(ambient),
        diffuse: grey(diffuse),
        ..Default::default()
    }
}

fn exact_tangent<T: Number>(record: &mut Record) {
    let mut wrong = 0;
    let mut of = 0;
    // A ray that touches a sphere in one point, in numbers without rounding, meets its outside.
    for (side, height, expected) in [
        (1.0, -9.0, 0.75),
        (1.0, 9.0, 0.25),
        (-1.0, 9.0, 0.75),
        (-1.0, -9.0, 0.25),
    ] {
        for turn in 0..3 {
            let turned = |x: f64, y: f64, z: f64| {
                let mut v = [x, y, z];
                v.rotate_right(turn);
                vector::<T>(v[0], v[1], v[2])
            };
            let mut model = super::shading::dark::<T>();
            model.ambient = T::from_f64(0.25);
            model.lights = vec![super::shading::light(turned(0.0, height, 5.0), 1.0, 0.0)];
            model.parts = vec![Part {
                shape: Shape::Sphere {
                    center: turned(0.0, 3.0 * side, 5.0),
                    radius: T::from_f64(3.0),
                },
                material: matte(1.0, 0.5),
            }];
            let pools = model.build();
            let tracer = Tracer::new(pools.as_scene());
            let ray = Ray::new(vector(0.0, 0.0, 0.0), turned(0.0, 0.0, 1.0));
            let t = tracer.nearest(&ray).map(|hit| hit.t);
            let color = record.see(&tracer, ray);
            let is_right = t == Some(T::from_f64(5.0)) && color == grey(expected);
            of += 1;
            wrong += u64::from(!is_right);
        }
    }
    record.count("tangents met elsewhere or lit on the wrong side", wrong, of);
}

fn camera_inside_a_sphere<T: Number>(record: &mut Record) {
    let random = record.random(107);
    let (mut missed, mut dark, mut worst) = (0, 0, 0.0_f64);
    for round in 0..RAYS {
        let r = random.log_between(1e-4, 1e4);
        let center: Vec3<T> = random.point(r * random.log_between(0.1, 10.0));
        let inside = random.direction::<f64>() * (r * random.between(0.0, 0.95));
        let origin: Vec3<T> = rounded(widened(center) + inside);
        let sphere = Sphere::new(center, T::from_f64(r), SURFACE).expect("a radius");
        let ray = Ray::new(origin, random.direction());
        let far = reference::sphere_crossings(center, sphere.radius(), &ray);
        match (sphere.intersect(&ray, T::MAX), far) {
            (Some(t), Some([_, far])) => {
                let reach = widened(center).abs().max_component() + r;
                worst = worst.max(narrow((wide(t) - far).abs()) / reach);
            }
            _ => missed += 1,
        }
        // A light where the camera is lights what it sees, if the normal faces both.
        if round % 20 == 0 {
            let mut model = super::shading::dark::<T>();
            model.lights = vec![super::shading::light(origin, 1.0, 0.0)];
            model.parts = vec![Part {
                shape: Shape::Sphere {
                    center,
                    radius: sphere.radius(),
                },
                material: matte(0.0, 1.0),
            }];
            let pools = model.build();
            let color = record.see(&Tracer::new(pools.as_scene()), ray);
            dark += u64::from(!(color.r > T::HALF * T::HALF));
        }
    }
    record.count("rays that hit nothing", missed, RAYS);
    record.error(
        "t off the far root, relative to the coordinates",
        worst,
        // The chord is at least 0.3 of the radius, which bounds how the root amplifies.
        scaled::<T>(4e-6),
        RAYS,
    );
    record.count(
        "inner sides that a light at the camera does not light",
        dark,
        RAYS / 20,
    );
}

fn camera_at_the_centre_of_a_sphere<T: Number>(record: &mut Record) {
    let random = record.random(108);
    let (mut wrong, mut of) = (0, 0);
    for _ in 0..1_000 {
        let radius = T::from_f64(random.log_between(1e-6, 1e6));
        let center: Vec3<T> = random.point(radius.to_f64() * 10.0);
        let sphere = Sphere::new(center, radius, SURFACE).expect("a radius");
        for axis in 0..3 {
            for sign in [1.0, -1.0] {
                let mut d = [0.0; 3];
                d[axis] = sign;
                let ray = Ray::new(center, vector(d[0], d[1], d[2]));
                of += 1;
                // The square and its root are each rounded once.
                let t = sphere.intersect(&ray, T::MAX);
                let expected = (radius * radius).sqrt();
                let is_off = (expected - radius).abs() > radius * T::EPSILON;
                wrong += u64::from(t != Some(expected) || is_off);
            }
        }
        // Whole radii are without rounding.
        let whole = T::from_i32(random.below(1_000) as i32 + 1);
        let sphere = Sphere::new(center, whole, SURFACE).expect("a radius");
        of += 1;
        let along_z = Ray::new(center, vector(0.0, 0.0, 1.0));
        wrong += u64::from(sphere.intersect(&along_z, T::MAX) != Some(whole));
    }
    record.count("axis rays with another t than the radius", wrong, of);
}

fn origin_on_a_sphere<T: Number>(record: &mut Record) {
    let random = record.random(109);
    let (mut outward_hits, mut inward_misses, mut inward, mut worst) = (0, 0, 0, 0.0_f64);
    let (mut textbook_hits, mut rays) = (0, 0);
    for _ in 0..RAYS {
        let r = random.log_between(1e-3, 1e6);
        let center: Vec3<T> = random.point(r * random.log_between(0.1, 30.0));
        let sphere = Sphere::new(center, T::from_f64(r), SURFACE).expect("a radius");
        let away: Vec3<f64> = random.direction();
        let from: Vec3<T> = rounded(widened(center) + away * (r * random.log_between(1.5, 1e3)));
        let incoming = ray_to(from, widened(center) + random.point::<f64>(0.5 * r));
        let Some(t) = sphere.intersect(&incoming, T::MAX) else {
            continue;
        };
        // Where new rays start: the hit, moved off the surface as the tracer does.
        let hit = sphere.surface_point(&incoming, t);
        let step = hit.normal * hit.offset;
        let mut direction: Vec3<T> = random.direction();
        if direction.dot(hit.normal) < T::ZERO {
            direction = -direction;
        }
        rays += 1;
        let outward = Ray::new(hit.point + step, direction);
        outward_hits += u64::from(sphere.intersect(&outward, T::MAX).is_some());
        let plain = Ray::new(incoming.at(t), direction);
        let least = T::from_f64(textbook::EPSILON);
        textbook_hits +=
            u64::from(textbook::sphere(center, sphere.radius(), &plain, least).is_some());
        // Steeply enough that the chord is longer than the offset.
        let cosine = direction.dot(hit.normal).to_f64();
        if cosine > 0.01 {
            let entering = Ray::new(hit.point - step, -direction);
            inward += 1;
            match sphere.intersect(&entering, T::MAX) {
                Some(t) => {
                    let reach = widened(center).abs().max_component() + r;
                    let off = (t.to_f64() - 2.0 * r * cosine).abs();
                    worst = worst.max(off * cosine / reach);
                }
                None => inward_misses += 1,
            }
        }
    }
    record.count("outward rays that hit", outward_hits, rays);
    record.textbook_share(textbook_hits);
    record.count("inward rays that miss", inward_misses, inward);
    record.error(
        "t off 2r·cos θ, times cos θ, relative to the coordinates",
        worst,
        scaled::<T>(4e-6),
        inward,
    );
}

fn sphere_of_radius_1e6_below_the_camera<T: Number>(record: &mut Record) {
    let mut model = super::shading::dark::<T>();
    model.background.color = grey(0.25);
    model.lights = vec![super::shading::light(vector(20.0, 1e3, 10.0), 1.0, 0.0)];
    let (center, radius) = (vector(0.0, -1_000_001.0, 0.0), T::from_f64(1e6));
    model.parts = vec![Part {
        shape: Shape::Sphere { center, radius },
        material: MaterialDescription {
            ambient: grey(0.0),
            // The whole visible side faces the light: never darker than this.
            diffuse: grey(100.0),
            ..Default::default()
        },
    }];
    let pools = model.build();
    let tracer = Tracer::new(pools.as_scene());
    let colors = record.draw(&tracer);
    let size = tracer.resolution();
    let (mut off_horizon, mut acne, mut of) = (0, 0, 0);
    for (i, color) in colors.iter().enumerate() {
        let (x, y) = (i % usize::from(size.width), i / usize::from(size.width));
        let is_ground = |y: usize| {
            let y = y.clamp(0, usize::from(size.height) - 1);
            let ray = tracer.primary_ray(&tracer.scanline(y as u16), x as u16);
            reference::sphere_crossings(center, radius, &ray).is_some_and(|[near, _]| near > 0.0)
        };
        let seen = *color != grey(0.25);
        // Within one pixel of the horizon either answer is right.
        let may_be = [
            is_ground(y.saturating_sub(1)),
            is_ground(y),
            is_ground(y + 1),
        ];
        off_horizon += u64::from(!may_be.contains(&seen));
        if seen {
            of += 1;
            acne += u64::from(color.r == T::ZERO);
        }
    }
    record.count(
        "pixels on the wrong side of the horizon",
        off_horizon,
        colors.len() as u64,
    );
    record.count("pixels of the ground that shadow themselves", acne, of);
}

fn sphere_behind_the_ray<T: Number>(record: &mut Record) {
    let random = record.random(111);
    let mut hits = 0;
    for _ in 0..RAYS {
        let ratio = 10.0_f64.powi(-1 - random.below(5) as i32);
        let aimed = aim::<T>(&random, ratio, [0.0, 1.0]);
        let away = Ray::new(aimed.ray.origin, -aimed.ray.direction);
        hits += u64::from(aimed.sphere.intersect(&away, T::MAX).is_some());
        hits += u64::from(aimed.sphere.occludes(&away, T::MAX));
    }
    record.count("hits", hits, RAYS);
}

/// Scene text with one object.
fn text_of(object: &str) -> String {
    format!("1\n0 0 0\n4 3\n0 9 0 1 1 1 1 1 1\n0.5\n0\n0 0 0\n{object} 1 1 1 1 1 1 1 1 1 0 1 0 0\n")
}

/// Asserts that a scene with this object is rejected at a column of its line.
fn rejected_at<T: Number>(record: &mut Record, object: &str, column: u32) {
    let mut pools = ScenePools::<T>::new();
    let place = pools
        .parse(text_of(object).as_bytes())
        .err()
        .map(|error| (error.line, error.column));
    let is_empty = pools.as_scene().object_count() == 0;
    record.holds(
        format!("`{object}` is rejected at its place"),
        place == Some((8, column)) && is_empty,
    );
}

fn radius_zero<T: Number>(record: &mut Record) {
    for radius in ["0", "0.0", "-0", "1e-400"] {
        rejected_at::<T>(record, &format!("0 0 0 5 {radius}"), 9);
    }
    let built = Sphere::<T>::new(vector(0.0, 0.0, 5.0), T::ZERO, SURFACE);
    record.holds("no sphere is built", built.is_err());
}

fn radius_negative_or_nan<T: Number>(record: &mut Record) {
    for radius in ["-1", "-1e-30", "nan", "NaN"] {
        rejected_at::<T>(record, &format!("0 0 0 5 {radius}"), 9);
    }
    for radius in [-1.0, -1e-30, f64::NAN, f64::NEG_INFINITY] {
        let built = Sphere::<T>::new(vector(0.0, 0.0, 5.0), T::from_f64(radius), SURFACE);
        record.holds(
            format!("no sphere of radius {radius} is built"),
            built.is_err(),
        );
    }
}

/// Draws tiny spheres with everything a material can have, from afar, from nearby and from inside.
fn draws_tiny_spheres<T: Number>(record: &mut Record, [single, double]: [f64; 2]) {
    let radius = if T::NAME == f32::NAME { single } else { double };
    for distance in [0.0, 0.5, 2.0, 1e10, 1.0 / radius] {
        let mut model = super::shading::dark::<T>();
        model.lights = vec![super::shading::light(vector(radius, radius, 0.0), 1.0, 1.0)];
        model.parts = vec![Part {
            shape: Shape::Sphere {
                center: vector(0.0, 0.0, distance * radius),
                radius: T::from_f64(radius),
            },
            material: MaterialDescription {
                reflection: T::HALF,
                refraction: T::HALF,
                index_of_refraction: T::THREE_HALVES,
                ..matte(0.5, 0.5)
            },
        }];
        model.resolution.width = 16;
        model.resolution.height = 12;
        let pools = model.build();
        record.draw(&Tracer::new(pools.as_scene()));
    }
}

fn radius_whose_square_is_subnormal<T: Number>(record: &mut Record) {
    draws_tiny_spheres::<T>(record, [1e-20, 1e-158]);
}

fn radius_whose_square_is_zero<T: Number>(record: &mut Record) {
    draws_tiny_spheres::<T>(record, [1e-23, 1e-170]);
}

fn radius_whose_square_is_infinite<T: Number>(record: &mut Record) {
    let radius = if T::NAME == f32::NAME {
        "2e19"
    } else {
        "2e154"
    };
    rejected_at::<T>(record, &format!("0 0 0 5 {radius}"), 9);
    let built = Sphere::<T>::new(vector(0.0, 0.0, 5.0), T::MAX, SURFACE);
    record.holds("no sphere is built", built.is_err());
}

fn plane_at_grazing_angles<T: Number>(record: &mut Record) {
    let random = record.random(117);
    let (mut t_off, mut residual, mut rays) = (0.0_f64, 0.0_f64, 0);
    for _ in 0..4 * RAYS {
        let cosine = random.log_between(1e-6, 1e-3);
        let normal: Vec3<T> = random.direction();
        let scale = random.log_between(1e-3, 1e3);
        let plane = Plane::new(
            normal,
            T::from_f64(scale * random.between(-1.0, 1.0)),
            SURFACE,
        )
        .expect("a plane");
        let n = widened(plane.normal());
        let along = n.cross(random.direction()).normalize();
        let direction = along - n * cosine;
        // Above the plane, so that the ray hits it.
        let foot = n * plane.height().to_f64() + along * (scale * random.between(-1.0, 1.0));
        let origin: Vec3<T> = rounded(foot + n * scale);
        let ray = Ray::new(origin, rounded::<T>(direction.normalize()).normalize());
        let exact = reference::plane_crossing(plane.normal(), plane.height(), &ray);
        let (Some(t), Some(exact)) = (plane.intersect(&ray, T::MAX), exact) else {
            continue;
        };
        rays += 1;
        let slope = WideVec::of(plane.normal()).dot(WideVec::of(ray.direction));
        let actual = narrow(slope.abs());
        t_off = t_off.max(narrow(ratio((wide(t) - exact).abs(), exact)) * actual);
        let p = plane.surface_point(&ray, t).point;
        let off = WideVec::of(plane.normal()).dot(WideVec::of(p)) - wide(plane.height());
        let q = widened(p);
        let components = (n.x * q.x).abs() + (n.y * q.y).abs() + (n.z * q.z).abs();
        let bound = 2.0 * unit::<T>() * (components + plane.height().to_f64().abs());
        residual = residual.max(narrow(off.abs()) / bound);
    }
    record.error(
        "relative error of t, times cos θ",
        t_off,
        scaled::<T>(1e-7),
        rays,
    );
    record.error(
        "distance of the hit from the plane, in units of its bound",
        residual,
        1.0,
        rays,
    );
}

fn ray_in_or_parallel_to_a_plane<T: Number>(record: &mut Record) {
    let random = record.random(118);
    let mut hits = 0;
    let mut of = 0;
    for _ in 0..RAYS {
        // Across one axis, so that the products are without rounding.
        let axis = random.below(3);
        let turned = |along: f64, a: f64, b: f64| {
            let mut v = [along, a, b];
            v.rotate_right(axis);
            vector::<T>(v[0], v[1], v[2])
        };
        let height = T::from_f64(random.sign() * random.log_between(1e-6, 1e6));
        let normal = turned(random.sign(), 0.0, 0.0);
        let plane = Plane::new(normal, -height, SURFACE).expect("a plane");
        let angle = random.between(0.0, 7.0);
        let direction = turned(random.sign() * 0.0, libm::cos(angle), libm::sin(angle)).normalize();
        let in_plane = normal * height;
        let (a, b) = (random.point::<f64>(1e3).x, random.point::<f64>(1e3).y);
        let aside = turned(0.0, a, b);
        for origin in [in_plane + aside, in_plane + aside + normal, aside] {
            let ray = Ray::new(origin, direction);
            of += 1;
            hits += u64::from(plane.intersect(&ray, T::MAX).is_some());
            hits += u64::from(plane.occludes(&ray, T::MAX));
        }
    }
    record.count("hits", hits, of);
}

fn plane_seen_from_below<T: Number>(record: &mut Record) {
    let floor = |sign: f64, turned: f64| {
        let mut model = super::shading::dark::<T>();
        model.ambient = T::ONE;
        model.background.color = grey(0.25);
        model.lights = vec![super::shading::light(
            vector(3.0, 4.0 * sign, 5.0),
            0.8,
            0.5,
        )];
        model.parts = vec![Part {
            shape: Shape::Plane {
                normal: vector(0.0, turned, 0.0),
                distance: T::from_f64(turned * sign),
            },
            material: MaterialDescription {
                specular: grey(0.5),
                shininess: T::from_f64(20.0),
                reflection: T::HALF,
                ..matte(0.1, 0.6)
            },
        }];
        model.build()
    };
    let from_above = floor(1.0, 1.0);
    let above = record.draw(&Tracer::new(from_above.as_scene()));
    let lit = above
        .iter()
        .filter(|color| color.r > T::from_f64(0.3))
        .count();
    record.holds("the floor is lit", lit > above.len() / 10);
    for (what, turned) in [("seen from behind", 1.0), ("seen from the front", -1.0)] {
        let pools = floor(-1.0, turned);
        let tracer = Tracer::new(pools.as_scene());
        let width = usize::from(tracer.resolution().width);
        let below = record.draw(&tracer);
        let rows = below.chunks(width).rev().flatten();
        let different = rows.zip(&above).filter(|(a, b)| a != b).count();
        record.count(
            format!("pixels of the ceiling, {what}, that are not the floor's"),
            different as u64,
            above.len() as u64,
        );
    }
}

fn plane_normals_of_any_length<T: Number>(record: &mut Record) {
    for normal in ["0 0 0", "-0 0.0 0", "1e-400 0 0"] {
        rejected_at::<T>(record, &format!("1 {normal} 1"), 3);
    }
    let random = record.random(120);
    let (mut worst, mut refused) = (0.0_f64, 0);
    for _ in 0..RAYS {
        let length = if T::NAME == f32::NAME {
            random.log_between(1e-37, 1e37)
        } else {
            random.log_between(1e-300, 1e300)
        };
        let normal: Vec3<T> = rounded(random.direction::<f64>() * length);
        match Plane::new(normal, T::ZERO, SURFACE) {
            Ok(plane) => {
                let off = WideVec::of(plane.normal()).length() - 1.0;
                worst = worst.max(narrow(off.abs()));
            }
            Err(_) => refused += 1,
        }
    }
    record.count("normals of some length that are refused", refused, RAYS);
    record.error("length of a normal off 1", worst, scaled::<T>(4e-7), RAYS);
}

/// A closed mesh around a place: an icosahedron, stretched, turned, moved and rounded to the scalar.
struct Mesh<T> {
    corners: Vec<Vec3<T>>,
    faces: Vec<[usize; 3]>,
    middle: Vec3<f64>,
    scale: f64,
}

impl<T: Number> Mesh<T> {
    fn random(random: &Random) -> Self {
        let golden = (1.0 + 5_f64.sqrt()) / 2.0;
        let mut corners = Vec::new();
        for (a, b) in [
            (1.0, golden),
            (-1.0, golden),
            (1.0, -golden),
            (-1.0, -golden),
        ] {
            corners.extend([
                Vec3::new(0.0, a, b),
                Vec3::new(a, b, 0.0),
                Vec3::new(b, 0.0, a),
            ]);
        }
        let near = |i: usize, j: usize| {
            let edge: Vec3<f64> = corners[i] - corners[j];
            (edge.dot(edge) - 4.0).abs() < 1e-9
        };
        let mut faces = Vec::new();
        for i in 0..12 {
            for j in i + 1..12 {
                for k in j + 1..12 {
                    if near(i, j) && near(j, k) && near(i, k) {
                        faces.push([i, j, k]);
                    }
                }
            }
        }
        let scale = random.log_between(1e-4, 1e4);
        let stretch = random.point::<f64>(0.3) + Vec3::splat(1.0);
        let middle: Vec3<f64> = random.point(scale * 3.0);
        let turn: Vec3<f64> = random.direction();
        let place = |p: Vec3<f64>| {
            let p = p - turn * (2.0 * p.dot(turn));
            let stretched = Vec3::new(p.x * stretch.x, p.y * stretch.y, p.z * stretch.z);
            rounded(stretched * scale + middle)
        };
        Self {
            corners: corners.into_iter().map(place).collect(),
            faces,
            middle,
            scale,
        }
    }

    fn triangles(&self) -> Vec<Triangle<T>> {
        self.faces
            .iter()
            .map(|face| Triangle::new(face.map(|i| self.corners[i]), SURFACE).expect("a face"))
            .collect()
    }

    /// Somewhere inside, from where there is a wall in every direction.
    fn inside(&self, random: &Random) -> Vec3<T> {
        rounded(self.middle + random.point::<f64>(0.2 * self.scale))
    }

    /// A place on an edge, at a weight between its ends.
    fn on_edge(&self, random: &Random, weight: f64) -> Vec3<f64> {
        let face = self.faces[random.below(20)];
        let start = random.below(3);
        let (a, b) = (face[start], face[(start + 1) % 3]);
        widened(self.corners[a]) * (1.0 - weight) + widened(self.corners[b]) * weight
    }
}

/// How many triangles of meshes rays hit that are aimed at their edges, at weights that are drawn for each:
/// rays that hit none, rays that hit several, and rays that hit none by the textbook's test.
fn rays_at_meshes<T: Number>(random: &Random, weight: impl Fn() -> f64) -> [u64; 3] {
    let [mut none, mut several, mut none_by_textbook] = [0; 3];
    for _ in 0..100 {
        let mesh = Mesh::<T>::random(random);
        let triangles = mesh.triangles();
        for _ in 0..RAYS / 100 {
            let ray = ray_to(mesh.inside(random), mesh.on_edge(random, weight()));
            let meets = |triangle: &&Triangle<T>| triangle.intersect(&ray, T::MAX).is_some();
            match triangles.iter().filter(meets).count() {
                0 => none += 1,
                1 => {}
                _ => several += 1,
            }
            let by_textbook = |triangle: &Triangle<T>| {
                textbook::triangle_crossing(triangle.vertices(), &ray).is_some()
            };
            none_by_textbook += u64::from(!triangles.iter().any(by_textbook));
        }
    }
    [none, several, none_by_textbook]
}

fn rays_at_the_edges_of_a_closed_mesh<T: Number>(record: &mut Record) {
    let random = record.random(121);
    let [leaks, _, by_textbook] =
        rays_at_meshes::<T>(&random, || [0.5, random.between(0.0, 1.0)][random.below(2)]);
    record.count("leaks", leaks, RAYS);
    record.textbook_share(by_textbook);
}

fn rays_at_the_vertices_of_a_closed_mesh<T: Number>(record: &mut Record) {
    let random = record.random(122);
    let [leaks, _, by_textbook] =
        rays_at_meshes::<T>(&random, || if random.below(2) == 0 { 0.0 } else { 1.0 });
    record.count("leaks", leaks, RAYS);
    record.textbook_share(by_textbook);
}

/// The edge itself belongs to both triangles, and a ray at its middle often meets it exactly: rays at other
/// places of an edge meet one triangle.
fn double_hits_on_an_edge<T: Number>(record: &mut Record) {
    let random = record.random(123);
    let [_, several, _] = rays_at_meshes::<T>(&random, || random.between(0.0, 1.0));
    record.count("rays that hit two triangles", several, RAYS);
}

/// A triangle that no constructor makes.
fn built_by_hand<T: Number>(vertices: [Vec3<T>; 3]) -> Triangle<T> {
    let normal = vector(0.0, 0.0, 1.0);
    let [first, ..] = vertices;
    // A ball that no ray misses.
    Triangle::from_parts(
        vertices,
        normal,
        first,
        T::MAX * T::HALF,
        T::EPSILON,
        SURFACE,
    )
}

fn triangle_without_area<T: Number>(record: &mut Record) {
    let random = record.random(124);
    let (mut accepted, mut hits, mut rays) = (0, 0, 0);
    for round in 0..2_000 {
        let scale = random.log_between(1e-4, 1e4);
        let (a, b): (Vec3<T>, Vec3<T>) = (random.point(scale), random.point(scale));
        // Repeated vertices, or three on a line without rounding.
        let step: Vec3<T> = vector(
            random.below(9) as f64 - 4.0,
            random.below(9) as f64 - 4.0,
            random.below(9) as f64 - 4.0,
        );
        let vertices = match round % 5 {
            0 => [a, a, b],
            1 => [a, b, a],
            2 => [a, b, b],
            3 => [a, a, a],
            _ => [step, step * T::TWO, step * T::from_f64(5.0)],
        };
        accepted += u64::from(Triangle::new(vertices, SURFACE).is_ok());
        let triangle = built_by_hand(vertices);
        for _ in 0..10 {
            let weight = random.between(0.0, 1.0);
            let [v1, _, v3] = vertices.map(widened);
            let target = v1 * (1.0 - weight) + v3 * weight;
            let ray = ray_to(random.point(3.0 * scale), target);
            rays += 1;
            hits += u64::from(triangle.intersect(&ray, T::MAX).is_some());
        }
    }
    record.count("triangles without area that are accepted", accepted, 2_000);
    // A test for each ray would cost every scene instructions that only a wrong call of from_parts needs.
    record.share("hits of such triangles built by hand", hits, rays, 0.05);
    rejected_at::<T>(record, "2 0 0 5 1 1 5 2 2 5 0 0 0 0", 3);
    rejected_at::<T>(record, "2 1 2 5 1 2 5 3 2 5 0 0 0 0", 3);
}

/// From the tests of pbrt-v3 and pbrt-v4 (`Triangle.BadCases`): three vertices on a line, which its first test of
/// triangles met.
fn published_bad_case_of_pbrt<T: Number>(record: &mut Record) {
    let vertices = [
        vector::<T>(-1113.45459, -79.049614, -56.2431908),
        vector(-1113.45459, -87.0922699, -56.2431908),
        vector(-1113.45459, -79.2090149, -56.2431908),
    ];
    record.holds("rejected", Triangle::new(vertices, SURFACE).is_err());
    let mut pools = ScenePools::<T>::new();
    let added = pools.as_mut().add_triangle(vertices, matte(1.0, 0.0));
    let direction = vector::<T>(-32.1072998, -183.355865, -144.607635);
    let ray = Ray::new(
        vector(-1081.47925, 99.9999542, 87.7701111),
        direction.normalize(),
    );
    let nearest = Tracer::new(pools.as_scene()).nearest(&ray);
    record.holds("missed", added.is_err() && nearest.is_none());
}

fn sliver_triangle<T: Number>(record: &mut Record) {
    // Without a band, a ray may pass nearer to an edge than the rounding of the coordinates.
    for (seed, aspect, band, bound) in [(1261, 1e-3, 1e-3, None), (1262, 1e-5, 0.0, Some(0.003))] {
        let random = record.random(seed);
        let band = scaled::<T>(band);
        let (mut wrong, mut by_textbook) = (0, 0);
        for _ in 0..RAYS {
            let along: Vec3<f64> = random.direction();
            let across = along.cross(random.direction()).normalize();
            let toward = along.cross(across);
            let scale = random.log_between(1e-3, 1e3);
            let place = toward * (3.0 * scale);
            let corners = [
                place - along * (0.5 * scale),
                place + along * (0.5 * scale),
                place + across * (aspect * scale),
            ];
            let vertices = corners.map(rounded::<T>);
            let Ok(triangle) = Triangle::new(vertices, SURFACE) else {
                wrong += 1;
                continue;
            };
            // Near the sliver, as far above and below as it is wide.
            let [v1, v2, v3] = vertices.map(widened);
            let (a, b) = (random.between(-0.5, 1.5), random.between(-1.0, 2.0));
            let target = v1 + (v2 - v1) * a + (v3 - v1) * b;
            let ray = ray_to(vector(0.0, 0.0, 0.0), target);
            let Some(inside) = reference::least_weight(vertices, &ray) else {
                continue;
            };
            if inside.abs() < band {
                continue;
            }
            let hit = triangle.intersect(&ray, T::MAX).is_some();
            let textbook = textbook::triangle_crossing(vertices, &ray).is_some();
            wrong += u64::from(hit != (inside >= 0.0));
            by_textbook += u64::from(textbook != (inside >= 0.0));
        }
        let what = format!("aspect {aspect:.0e}: rays misclassified");
        match bound {
            None => record.count(what, wrong, RAYS),
            Some(bound) => record.share(what, wrong, RAYS, bound),
        }
        record.textbook_share(by_textbook);
    }
}

fn mesh_scaled_by_powers_of_two<T: Number>(record: &mut Record) {
    let random = record.random(127);
    let (mut different, mut rays, mut hits) = (0, 0, 0);
    for _ in 0..100 {
        let mesh = Mesh::<T>::random(&random);
        let triangles = mesh.triangles();
        let aimed: Vec<_> = (0..RAYS / 100)
            .map(|_| {
                let weight = [0.0, 0.5, random.between(0.0, 1.0)][random.below(3)];
                ray_to(mesh.inside(&random), mesh.on_edge(&random, weight))
            })
            .collect();
        for exponent in [-13, 13] {
            let factor = T::from_f64(2_f64.powi(exponent));
            let scaled: Vec<_> = triangles
                .iter()
                .map(|t| Triangle::new(t.vertices().map(|v| v * factor), SURFACE).expect("a face"))
                .collect();
            for ray in &aimed {
                let larger = Ray::new(ray.origin * factor, ray.direction);
                for (triangle, scaled) in triangles.iter().zip(&scaled) {
                    let expected = triangle.intersect(ray, T::MAX).map(|t| t * factor);
                    hits += u64::from(expected.is_some());
                    different += u64::from(scaled.intersect(&larger, T::MAX) != expected);
                }
                rays += 1;
            }
        }
    }
    record.holds("rays hit", hits >= rays);
    record.count("rays with another hit or t", different, rays);
}

fn long_thin_triangles<T: Number>(record: &mut Record) {
    let random = record.random(171);
    let (mut holes, mut behind, mut rays) = (0, 0, 0);
    for _ in 0..RAYS {
        let half = random.log_between(1e-3, 1e3);
        let length = half * random.log_between(1.0, 1e4);
        let along: Vec3<f64> = random.direction();
        let across = along.cross(random.direction()).normalize();
        let toward = along.cross(across);
        let place = random.direction::<f64>() * half;
        // Two triangles of a wall, and a patch in front of it.
        let corner =
            |a: f64, b: f64| rounded::<T>(place + along * (a * length) + across * (b * half));
        let wall = [
            [corner(-1.0, -1.0), corner(-1.0, 1.0), corner(1.0, 1.0)],
            [corner(-1.0, -1.0), corner(1.0, 1.0), corner(1.0, -1.0)],
        ]
        .map(|vertices| Triangle::new(vertices, SURFACE).expect("a wall"));
        // Where a slanted ray that passes the patch still comes to the wall.
        let (a, b) = (random.between(-0.6, 0.6), random.between(-0.6, 0.6));
        let aimed = place + along * (a * half) + across * (b * half);
        let gap = 64.0 * unit::<T>() * (length + half);
        let patch = [(-1.0, -1.0), (1.0, -1.0), (0.0, 2.0)].map(|(a, b)| {
            rounded::<T>(aimed + toward * gap + (along * a + across * b) * (0.1 * half))
        });
        let Ok(patch) = Triangle::new(patch, SURFACE) else {
            continue;
        };
        let cosine = random.between(0.3, 1.0);
        let sideways = toward.cross(random.direction()).normalize();
        let from = toward * cosine + sideways * (1.0 - cosine * cosine).sqrt();
        let origin = rounded::<T>(aimed + from * (half * random.between(1.0, 10.0)));
        let ray = ray_to(origin, aimed + toward * gap);
        rays += 1;
        let distance = wall.iter().filter_map(|wall| wall.intersect(&ray, T::MAX));
        let nearest = distance.reduce(|a, b| if a < b { a } else { b });
        let in_front = patch.intersect(&ray, T::MAX);
        holes += u64::from(nearest.is_none() || in_front.is_none());
        behind += u64::from(
            nearest
                .zip(in_front)
                .is_some_and(|(wall, patch)| wall <= patch),
        );
    }
    record.count("rays that miss", holes, rays);
    record.count("patches behind the wall", behind, rays);
}

fn hit_in_the_centre_of_a_sphere<T: Number>(record: &mut Record) {
    let random = record.random(173);
    let (mut none, mut without, mut rays) = (0, 0, 0);
    for _ in 0..200 {
        let camera: Vec3<T> = rounded(random.direction::<f64>() * random.log_between(1.0, 1e6));
        let size = camera.abs().max_component().to_f64();
        let radius = T::from_f64(size * unit::<T>() * random.log_between(1e-6, 1.0));
        let mut pools = ScenePools::<T, 1, 0, 0, 1>::new();
        let material = MaterialDescription {
            ambient: grey(0.25),
            reflection: T::HALF,
            ..Default::default()
        };
        pools.as_mut().set_ambient(T::ONE);
        let added = pools.as_mut().add_sphere(camera, radius, material);
        added.expect("a radius");
        let tracer = Tracer::new(pools.as_scene());
        for _ in 0..100 {
            let color = tracer.radiance(Ray::new(camera, random.direction()));
            let channels = [color.r, color.g, color.b];
            rays += 1;
            none += u64::from(!channels.iter().all(|channel| channel.is_finite()));
            without += u64::from(!(color.r >= T::from_f64(0.25)));
        }
    }
    record.count("colours that are none", none, rays);
    record.count("rays that do not see the sphere", without, rays);
}

fn rim_of_a_disc<T: Number>(record: &mut Record) {
    let random = record.random(170);
    let (mut wrong, mut rays) = (0, 0);
    for _ in 0..RAYS {
        let scale = random.log_between(1e-3, 1e3);
        let center = random.direction::<f64>() * (scale * random.between(0.0, 3.0));
        let disc = Disc::new(
            rounded::<T>(center),
            random.direction(),
            T::from_f64(scale),
            SURFACE,
        )
        .expect("a disc");
        let radius = disc.radius().to_f64();
        let n = widened(disc.normal());
        let outward = n.cross(random.direction()).normalize();
        let aimed = widened(disc.center()) + outward * (radius * random.between(0.9, 1.1));
        let cosine = random.log_between(1e-2, 0.99);
        let along = n.cross(random.direction()).normalize();
        let direction = along * (1.0 - cosine * cosine).sqrt() - n * cosine;
        let origin = aimed - direction * (radius * random.between(1.0, 10.0));
        let ray = Ray::new(rounded(origin), rounded::<T>(direction).normalize());
        let crossing = reference::plane_crossing(disc.normal(), disc.height(), &ray);
        let Some(t) = crossing else {
            continue;
        };
        let point = WideVec::of(ray.origin).plus(WideVec::of(ray.direction).times(t));
        let beside = narrow(point.minus(WideVec::of(disc.center())).length()) / radius;
        if (beside - 1.0).abs() > 1e-3 {
            rays += 1;
            let hit = disc.intersect(&ray, T::MAX).is_some();
            wrong += u64::from(hit != (beside < 1.0));
        }
    }
    record.count("rays misclassified", wrong, rays);
}

/// Objects that all pass through (0, 0, 4).
fn through_one_point<T: Number>() -> Vec<Shape<T>> {
    let sphere = |z: f64, radius: f64| Shape::Sphere {
        center: vector(0.0, 0.0, z),
        radius: T::from_f64(radius),
    };
    let v = |x, y| vector(x, y, 4.0);
    vec![
        sphere(5.0, 1.0),
        Shape::Plane {
            normal: vector(0.0, 0.0, 1.0),
            distance: T::from_f64(-4.0),
        },
        Shape::Triangle([v(-1.0, -1.0), v(1.0, -1.0), v(0.0, 2.0)]),
        sphere(6.0, 2.0),
    ]
}

fn coincident_objects<T: Number>(record: &mut Record) {
    let ray = Ray::new(vector(0.0, 0.0, 0.0), vector::<T>(0.0, 0.0, 1.0));
    let shapes = through_one_point::<T>();
    let (mut wrong, mut of) = (0, 0);
    for order in 0..24 {
        // All orders of four, from the digits of a number in factorial base.
        let mut left = shapes.clone();
        let mut number = order;
        let mut model = super::shading::dark::<T>();
        for count in (1..=4).rev() {
            let shape = left.remove(number % count);
            number /= count;
            let material = matte(0.1 * count as f64, 0.0);
            model.parts.push(Part { shape, material });
        }
        model.ambient = T::ONE;
        let pools = model.build();
        let tracer = Tracer::new(pools.as_scene());
        let seen = tracer
            .nearest(&ray)
            .map(|hit| (hit.t, hit.object.info().number));
        let color = record.see(&tracer, ray);
        of += 1;
        let first = T::from_f64(4.0);
        // Spheres come before other shapes, and of these the first in the text.
        let sphere = model
            .parts
            .iter()
            .position(|part| matches!(part.shape, Shape::Sphere { .. }))
            .unwrap_or_default();
        let level = 0.1 * (4 - sphere) as f64;
        wrong += u64::from(seen != Some((first, sphere as u32)) || color != grey(level));
    }
    record.count("orders in which another object is seen", wrong, of);
    // Whole objects in one place, seen from everywhere: the first hides the second.
    for shape in shapes {
        let mut model = super::shading::dark::<T>();
        model.ambient = T::ONE;
        for level in [0.25, 0.75] {
            let material = matte(level, 0.0);
            model.parts.push(Part { shape, material });
        }
        let pools = model.build();
        let tracer = Tracer::new(pools.as_scene());
        let colors = record.draw(&tracer);
        let others = colors
            .iter()
            .filter(|color| color.r > T::from_f64(0.25))
            .count();
        let name = match tracer.scene().objects().next() {
            Some(Object::Sphere(_)) => "sphere",
            Some(Object::Plane(_)) => "plane",
            _ => "triangle",
        };
        record.count(
            format!("pixels that show the second {name}"),
            others as u64,
            colors.len() as u64,
        );
    }
}
