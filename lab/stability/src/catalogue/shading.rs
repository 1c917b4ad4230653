//! Cases 29 to 52: local colour, shadows, where secondary rays start, reflection and refraction.

use scanray::{
    Background, Color, Light, MaterialDescription, Ray, Resolution, Scalar, ScenePools, Tracer,
    Vec3,
    tracer::{Observer, RayKind, WorkCount},
};

use super::cases;
use super::record::{Record, Tier, grey, ray_to, rounded, scaled, vector, widened};
use crate::Number;
use crate::reference::{self, WideVec, narrow, ratio, wide};
use crate::scenes::{self, Model, Part, Shape};
use crate::settled::{channels, level_distance, levels, settled_color};
use crate::textbook::{self, Textbook};

cases! { Shading:
    29 sphere_shadows_itself: "radius 1e-3 to 1e6: acne 0";
    30 plane_shadows_itself: "scale 1e-3 to 1e5: acne 0";
    31 shell_of_1e_3_radii: "leaks 0";
    32 shell_of_1e_4_radii: "coordinates up to 10 radii: leaks 0";
    33 sphere_resting_on_a_plane: "the contact shadow is within 1 pixel";
    34 light_on_a_surface: "finite";
    35 light_inside_an_opaque_sphere: "everything outside is in shadow";
    36 light_exactly_at_the_hit: "guarded: does not light it, and is finite";
    37 occluder_beyond_the_light: "lit";
    38 light_behind_the_surface: "ambient light alone";
    39 light_of_intensity_1e30: "clamped";
    40 facing_mirrors_of_coefficient_1: "at most max_depth + 1 rays, and the partial sum of the series";
    41 mirrors_of_0_9_at_depth_16: "the default scene with mirrors: tier A; the room of mirrors: tier B";
    42 length_of_directions: "off 1 by at most 2e-7 at any depth";
    43 objects_of_index_1: "settled pixels as without, at most 1 level off";
    44 index_next_to_1: "index 1.0001 and 0.9999: total reflection misclassified 0";
    45 critical_angle: "decided right at ± 1e-5 of its sine";
    46 diamond_beyond_the_critical_angle: "no refracted ray";
    47 nested_glass_and_water_with_a_common_wall: "no overflow; the first of two coincident walls is met, the other not";
    48 glass_at_any_depth: "at max_depth 0, 1 and the deepest: within the ray bound, and what a clipped path adds is black";
    49 index_of_refraction_zero_negative_or_nan: "rejected where there is refraction";
    50 shininess: "0 gives 1, powers are monotone and off by at most 0.02/255";
    51 ends_of_the_phong_base: "0, 1 and the number below 1";
    72 light_next_to_a_surface: "on a ceiling, a wall of triangles and a sphere, and 1e-7 to 1e-3 before and behind them: all of the floor is lit or none, and all of it on the surface";
    52 reflection_and_refraction_above_1: "clamped at each level";
}

/// Rays of a statistical case.
const RAYS: u64 = 20_000;

/// A black room without objects and lights.
pub(super) fn dark<T: Scalar>() -> Model<T> {
    Model {
        camera: vector(0.0, 0.0, 0.0),
        resolution: Resolution {
            width: 160,
            height: 120,
        },
        ambient: T::ZERO,
        background: Background {
            color: Color::BLACK,
            sky: false,
        },
        lights: Vec::new(),
        parts: Vec::new(),
    }
}

/// A grey light.
pub(super) fn light<T: Scalar>(position: Vec3<T>, diffuse: f64, specular: f64) -> Light<T> {
    Light {
        position,
        diffuse: grey(diffuse),
        specular: grey(specular),
    }
}

/// A surface that shows only whether a light reaches it: any light makes it white.
fn detector<T: Scalar>() -> MaterialDescription<T> {
    MaterialDescription {
        diffuse: grey(1e6),
        ..Default::default()
    }
}

/// A surface that is white by itself.
fn glowing<T: Scalar>() -> MaterialDescription<T> {
    MaterialDescription {
        ambient: grey(1.0),
        ..Default::default()
    }
}

fn sphere<T: Scalar>(center: Vec3<T>, radius: T, material: MaterialDescription<T>) -> Part<T> {
    let shape = Shape::Sphere { center, radius };
    Part { shape, material }
}

fn plane<T: Scalar>(normal: Vec3<T>, distance: f64, material: MaterialDescription<T>) -> Part<T> {
    let distance = T::from_f64(distance);
    let shape = Shape::Plane { normal, distance };
    Part { shape, material }
}

fn is_black<T: Scalar>(color: Color<T>) -> bool {
    color == Color::BLACK
}

fn sphere_shadows_itself<T: Number>(record: &mut Record) {
    let random = record.random(129);
    let (mut acne, mut by_textbook, mut lit) = (0, 0, 0);
    while lit < RAYS {
        let r = random.log_between(1e-3, 1e6);
        let mut model = dark::<T>();
        let center: Vec3<T> = random.point(r * random.log_between(0.1, 10.0));
        let around = |least: f64| {
            let away: Vec3<f64> = random.direction();
            rounded::<T>(widened(center) + away * (r * random.log_between(least, 1e3)))
        };
        let radius = T::from_f64(r);
        model.camera = around(1.5);
        let lamp = around(1.5);
        model.lights = vec![light(lamp, 1.0, 0.0)];
        model.parts = vec![sphere(center, radius, detector())];
        let aside: Vec3<f64> = random.point(0.5 * r);
        let ray = ray_to(model.camera, widened(center) + aside);
        let Some([t, _]) = reference::sphere_crossings(center, radius, &ray) else {
            continue;
        };
        let point = WideVec::of(ray.origin).plus(WideVec::of(ray.direction).times(t));
        let normal = point.minus(WideVec::of(center)).unit();
        let toward = WideVec::of(lamp).minus(point).unit();
        if narrow(normal.dot(toward)) < 0.01 {
            continue;
        }
        lit += 1;
        let pools = model.build();
        acne += u64::from(is_black(record.see(&Tracer::new(pools.as_scene()), ray)));
        by_textbook += u64::from(is_black(Textbook::new(pools.as_scene(), 0).radiance(&ray)));
    }
    record.share("lit places that are in their own shadow", acne, lit, 0.0);
    record.textbook_share(by_textbook);
}

fn plane_shadows_itself<T: Number>(record: &mut Record) {
    let random = record.random(130);
    let (mut acne, mut by_textbook, mut lit, mut wrong_side) = (0, 0, 0, 0);
    for _ in 0..RAYS {
        let scale = random.log_between(1e-3, 1e5);
        let mut model = dark::<T>();
        let normal: Vec3<T> = random.direction();
        let distance = scale * random.between(-1.0, 1.0);
        model.parts = vec![plane(normal, distance, detector())];
        let pools = model.build();
        let floor = pools.as_scene().planes()[0];
        let n = widened(floor.normal());
        let above = |height: f64| {
            let along =
                n.cross(random.direction()).normalize() * (scale * random.between(0.0, 3.0));
            rounded::<T>(n * (floor.height().to_f64() + height * scale) + along)
        };
        model.camera = above(random.log_between(0.03, 10.0));
        let lamp = above(random.log_between(0.03, 10.0));
        model.lights = vec![light(lamp, 1.0, 0.0)];
        let target = widened(above(0.0));
        let ray = ray_to(model.camera, target);
        let pools = model.build();
        let floor = pools.as_scene().planes()[0];
        let Some(t) = floor.intersect(&ray, T::MAX) else {
            continue;
        };
        lit += 1;
        acne += u64::from(is_black(record.see(&Tracer::new(pools.as_scene()), ray)));
        by_textbook += u64::from(is_black(Textbook::new(pools.as_scene(), 0).radiance(&ray)));
        // The origin by itself: a ray is not told that it leaves the plane.
        let hit = floor.surface_point(&ray, t);
        let side = |point: Vec3<T>| {
            WideVec::of(floor.normal()).dot(WideVec::of(point)) - wide(floor.height())
        };
        let step = hit.normal * hit.offset;
        wrong_side += u64::from(!(side(hit.point + step) > 0.0));
        wrong_side += u64::from(!(side(hit.point - step) < 0.0));
    }
    record.share("lit places that are in their own shadow", acne, lit, 0.0);
    record.textbook_share(by_textbook);
    record.count("origins of new rays on the wrong side", wrong_side, 2 * lit);
}

/// Leaks through the shell between two spheres: rays that come from outside through an invisible outer
/// sphere and do not hit the inner one, and places of the inner sphere that a light outside reaches
/// through an opaque outer one.
fn shell<T: Number>(record: &mut Record, seed: u64, thickness: f64) {
    let random = record.random(seed);
    let (mut leaks, mut by_textbook, mut rays) = (0, 0, 0);
    let (mut lit, mut lit_by_textbook, mut shadows) = (0, 0, 0);
    for _ in 0..RAYS {
        let r = random.log_between(1e-3, 1e6);
        let center: Vec3<T> = random.point(r * random.log_between(0.1, 9.0));
        let c = widened(center);
        let [outer, inner] = [r, r * (1.0 - thickness)].map(T::from_f64);
        let aside = random.direction::<f64>() * (0.9 * r * random.between(0.0, 1.0));

        let mut model = dark::<T>();
        model.ambient = T::ONE;
        model.parts = vec![
            sphere(center, outer, scenes::invisible()),
            sphere(center, inner, glowing()),
        ];
        model.camera =
            rounded(c + random.direction::<f64>() * (r * random.log_between(1.5, 100.0)));
        let ray = ray_to(model.camera, c + aside);
        let pools = model.build();
        rays += 1;
        leaks += u64::from(is_black(record.see(&Tracer::new(pools.as_scene()), ray)));
        by_textbook += u64::from(is_black(Textbook::new(pools.as_scene(), 5).radiance(&ray)));

        let away: Vec3<f64> = random.direction();
        let mut model = dark::<T>();
        // In the middle of the shell, looking at the inner sphere beneath.
        model.camera = rounded(c + away * (r * (1.0 - 0.5 * thickness)));
        let lamp = c + (away + random.point::<f64>(0.3)) * (r * random.log_between(2.0, 100.0));
        model.lights = vec![light(rounded(lamp), 1.0, 0.0)];
        model.parts = vec![
            sphere(center, outer, detector()),
            sphere(center, inner, detector()),
        ];
        let ray = ray_to(model.camera, c + away * (0.5 * r));
        let pools = model.build();
        shadows += 1;
        lit += u64::from(!is_black(record.see(&Tracer::new(pools.as_scene()), ray)));
        let textbook = Textbook::new(pools.as_scene(), 0).radiance(&ray);
        lit_by_textbook += u64::from(!is_black(textbook));
    }
    record.share("rays that leak past the inner sphere", leaks, rays, 0.0);
    record.textbook_share(by_textbook);
    record.share(
        "shadows that leak through the outer sphere",
        lit,
        shadows,
        0.0,
    );
    record.textbook_share(lit_by_textbook);
}

fn shell_of_1e_3_radii<T: Number>(record: &mut Record) {
    shell::<T>(record, 131, 1e-3);
}

fn shell_of_1e_4_radii<T: Number>(record: &mut Record) {
    shell::<T>(record, 132, 1e-4);
}

fn sphere_resting_on_a_plane<T: Number>(record: &mut Record) {
    for (scale, what) in [(1.0, "scale 1"), (1e-3, "scale 1e-3"), (1e3, "scale 1e3")] {
        let mut model = dark::<f64>();
        model.lights = vec![light(vector(3.0 * scale, 4.0 * scale, scale), 1.0, 0.0)];
        model.parts = vec![
            plane(vector(0.0, 1.0, 0.0), scale, detector()),
            sphere(
                vector(0.0, -0.5 * scale, 2.5 * scale),
                0.5 * scale,
                detector(),
            ),
        ];
        let (pools, exact) = (model.rounded::<T>().build(), model.build());
        let colors = record.draw(&Tracer::new(pools.as_scene()));
        let exact = Tracer::new(exact.as_scene());
        let (width, height) = (160_i32, 120_i32);
        let expected: Vec<bool> = (0..height as u16)
            .flat_map(|y| (0..width as u16).map(move |x| (x, y)))
            .map(|(x, y)| is_black(exact.pixel(x, y)))
            .collect();
        let at = |x: i32, y: i32| {
            expected[(y.clamp(0, height - 1) * width + x.clamp(0, width - 1)) as usize]
        };
        let mut wrong = 0;
        for (i, color) in colors.iter().enumerate() {
            let (x, y) = (i as i32 % width, i as i32 / width);
            let in_shadow = is_black(*color);
            let near = (-1..=1).flat_map(|dy| (-1..=1).map(move |dx| (dx, dy)));
            let mut may_be = near.map(|(dx, dy)| at(x + dx, y + dy));
            wrong += u64::from(!may_be.any(|expected| expected == in_shadow));
        }
        record.count(
            format!("{what}: pixels more than 1 pixel from where light or shadow is"),
            wrong,
            colors.len() as u64,
        );
    }
}

/// A room with a lamp somewhere: a floor, a glass sphere, a triangle.
fn room<T: Scalar>(lamp: Vec3<T>) -> Model<T> {
    let material = MaterialDescription {
        specular: grey(0.5),
        shininess: T::from_f64(20.0),
        reflection: T::from_f64(0.2),
        ambient: grey(0.1),
        diffuse: grey(0.6),
        ..Default::default()
    };
    let glass = MaterialDescription {
        refraction: T::from_f64(0.7),
        index_of_refraction: T::THREE_HALVES,
        ..material
    };
    let mut model = dark::<T>();
    model.ambient = T::ONE;
    model.lights = vec![light(lamp, 1.0, 1.0)];
    model.parts = vec![
        plane(vector(0.0, 1.0, 0.0), 1.0, material),
        sphere(vector(0.0, 0.0, 4.0), T::ONE, glass),
        Part {
            shape: Shape::Triangle([
                vector(1.0, -1.0, 3.0),
                vector(2.0, 1.0, 4.0),
                vector(3.0, -1.0, 5.0),
            ]),
            material,
        },
    ];
    model
}

fn light_on_a_surface<T: Number>(record: &mut Record) {
    // On the floor, on the sphere, on an edge and on a vertex of the triangle, and in the camera.
    for (x, y, z) in [
        (0.5, -1.0, 3.0),
        (0.0, 0.0, 3.0),
        (0.0, 1.0, 4.0),
        (1.5, 0.0, 3.5),
        (2.0, 1.0, 4.0),
        (0.0, 0.0, 0.0),
    ] {
        let pools = room(vector::<T>(x, y, z)).build();
        record.draw(&Tracer::new(pools.as_scene()));
    }
}

fn light_next_to_a_surface<T: Number>(record: &mut Record) {
    let corner = |x: f64, z: f64| vector::<T>(x, 2.0, z);
    let triangle = |corners| Part {
        shape: Shape::Triangle(corners),
        material: detector(),
    };
    let ceilings = [
        (
            "plane",
            vec![plane(vector(0.0, -1.0, 0.0), 2.0, detector())],
        ),
        (
            "triangles",
            vec![
                triangle([
                    corner(-99.0, -99.0),
                    corner(99.0, -99.0),
                    corner(99.0, 99.0),
                ]),
                triangle([
                    corner(-99.0, -99.0),
                    corner(99.0, 99.0),
                    corner(-99.0, 99.0),
                ]),
            ],
        ),
        (
            "sphere",
            vec![sphere(vector(0.3, 2.5, 2.7), T::HALF, detector())],
        ),
    ];
    for (what, ceiling) in ceilings {
        let (mut uneven, mut dark_below) = (0, 0);
        let outside = [0.0, 1e-7, 1e-6, 3e-6, 1e-5, 1e-4, 1e-3];
        for above in outside.iter().flat_map(|above| [-above, *above]) {
            let mut model = dark::<T>();
            model.lights = vec![light(vector(0.3, 2.0 + above, 2.7), 1.0, 0.0)];
            model.parts = ceiling.clone();
            model
                .parts
                .push(plane(vector(0.0, 1.0, 0.0), 1.0, detector()));
            let pools = model.build();
            let colors = record.draw(&Tracer::new(pools.as_scene()));
            // The floor alone, as far as the triangles go.
            let floor = &colors[colors.len() * 11 / 20..];
            let dark = floor.iter().filter(|color| is_black(**color)).count();
            uneven += dark.min(floor.len() - dark) as u64;
            dark_below += u64::from(above <= 0.0 && dark > 0);
        }
        let pixels = 2 * outside.len() as u64 * 8640;
        record.count(format!("{what}: pixels unlike most"), uneven, pixels);
        let lights = outside.len() as u64 + 1;
        record.count(
            format!("{what}: lights in the room that do not light it"),
            dark_below,
            lights,
        );
    }
}

fn light_inside_an_opaque_sphere<T: Number>(record: &mut Record) {
    let mut model = dark::<T>();
    model.lights = vec![light(vector(0.1, -0.4, 3.2), 1.0, 1.0)];
    model.parts = vec![
        plane(vector(0.0, 1.0, 0.0), 1.0, detector()),
        sphere(vector(0.0, -0.5, 3.0), T::HALF, detector()),
        sphere(vector(1.5, -0.5, 3.0), T::HALF, detector()),
    ];
    let pools = model.build();
    let colors = record.draw(&Tracer::new(pools.as_scene()));
    let lit = colors.iter().filter(|color| !is_black(**color)).count();
    record.count("pixels that are lit", lit as u64, colors.len() as u64);
    // The same lamp beside the sphere lights most of the floor.
    model.lights[0].position = vector(-2.0, 0.4, 2.0);
    let pools = model.build();
    let colors = record.draw(&Tracer::new(pools.as_scene()));
    let lit = colors.iter().filter(|color| !is_black(**color)).count();
    record.holds("a lamp outside lights the floor", lit > colors.len() / 10);
}

fn light_exactly_at_the_hit<T: Number>(record: &mut Record) {
    let mut wrong = 0;
    let mut of = 0;
    let material = MaterialDescription {
        specular: grey(1.0),
        ..detector()
    };
    for (x, y) in [(0.0, 0.0), (0.25, 0.0), (-0.5, 0.75), (1.0, 1.0)] {
        let mut model = dark::<T>();
        model.parts = vec![plane(vector(0.0, 0.0, -1.0), 4.0, material)];
        let ray = ray_to(model.camera, Vec3::new(x, y, 4.0));
        let pools = model.build();
        let wall = pools.as_scene().planes()[0];
        let Some(t) = wall.intersect(&ray, T::MAX) else {
            continue;
        };
        let hit = wall.surface_point(&ray, t);
        // At the hit itself, and where its shadow ray starts.
        for lamp in [hit.point, hit.point + hit.normal * hit.offset] {
            model.lights = vec![light(lamp, 1.0, 1.0)];
            let pools = model.build();
            of += 1;
            wrong += u64::from(!is_black(record.see(&Tracer::new(pools.as_scene()), ray)));
        }
    }
    record.count("lights in the hit that light it", wrong, of);
}

fn occluder_beyond_the_light<T: Number>(record: &mut Record) {
    let random = record.random(137);
    let (mut dark_places, mut lit_places) = (0, 0);
    for _ in 0..RAYS / 4 {
        let scale = random.log_between(1e-3, 1e4);
        let point = vector::<f64>(0.3, -1.0, 2.0) * scale;
        let toward = (random.direction::<f64>() + Vec3::new(0.0, 1.2, 0.0)).normalize();
        let lamp = point + toward * (2.0 * scale);
        let mut model = dark::<T>();
        model.lights = vec![light(rounded(lamp), 1.0, 0.0)];
        // A tenth of the way beyond the light, then a tenth before it.
        for (along, is_lit) in [(1.2, true), (0.8, false)] {
            let center = point + toward * (2.0 * scale * along);
            model.parts = vec![
                plane(vector(0.0, 1.0, 0.0), scale, detector()),
                sphere(rounded(center), T::from_f64(0.2 * scale), detector()),
            ];
            // From just above the place, so that nothing is in the way.
            model.camera = rounded(point + Vec3::new(0.001, 0.01, -0.002) * scale);
            let pools = model.build();
            let ray = ray_to(model.camera, point);
            let seen = record.see(&Tracer::new(pools.as_scene()), ray);
            if is_lit {
                dark_places += u64::from(is_black(seen));
            } else {
                lit_places += u64::from(!is_black(seen));
            }
        }
    }
    record.count(
        "places in the shadow of what is beyond the light",
        dark_places,
        RAYS / 4,
    );
    record.count(
        "places lit in spite of what is before the light",
        lit_places,
        RAYS / 4,
    );
}

fn light_behind_the_surface<T: Number>(record: &mut Record) {
    let (mut wrong, mut of) = (0, 0);
    for lamp in [(0.0, -1.1, 4.0), (3.0, -9.0, 1.0), (0.0, -1.0, 4.0)] {
        let mut model = dark::<T>();
        model.ambient = T::HALF;
        let material = MaterialDescription {
            ambient: grey(0.5),
            specular: grey(1.0),
            ..detector()
        };
        model.lights = vec![light(vector(lamp.0, lamp.1, lamp.2), 1.0, 1.0)];
        model.parts = vec![plane(vector(0.0, 1.0, 0.0), 1.0, material)];
        let pools = model.build();
        for color in record.draw(&Tracer::new(pools.as_scene())) {
            of += 1;
            wrong += u64::from(!is_black(color) && color != grey(0.25));
        }
    }
    record.count("pixels other than ambient light and background", wrong, of);
}

fn light_of_intensity_1e30<T: Number>(record: &mut Record) {
    // Products of such intensities with such materials leave the range of the scalar.
    let largest = if T::NAME == f32::NAME { 1e30 } else { 1e300 };
    for intensity in [1e30, largest] {
        for level in [0.5, 1.0, 1e30, largest] {
            let mut model = room(vector::<T>(1.0, 3.0, 1.0));
            model.lights[0].diffuse = grey(intensity);
            model.lights[0].specular = grey(intensity);
            model.ambient = T::from_f64(intensity);
            for part in &mut model.parts {
                part.material.diffuse = grey(level);
                part.material.specular = grey(level);
                part.material.ambient = Color::new(T::ZERO, T::from_f64(level), T::ONE);
                part.material.reflection = T::from_f64(level);
            }
            let pools = model.build();
            let colors = record.draw(&Tracer::new(pools.as_scene()));
            let white = colors.iter().filter(|color| **color == grey(1.0)).count();
            record.holds(
                format!("intensity {intensity:.0e} on {level:.0e} shows white"),
                white > 100,
            );
        }
    }
}

/// The sum of a material's ambient colour over `depth + 1` meetings with mirrors of a coefficient, clamped
/// at every level from the last one.
fn mirror_series(ambient: f64, coefficient: f64, depth: usize) -> f64 {
    let mut sum = 0.0;
    for _ in 0..=depth {
        sum = f64::min(ambient + coefficient * sum, 1.0);
    }
    sum
}

fn facing_mirrors_of_coefficient_1<T: Number>(record: &mut Record) {
    let (mut rays_off, mut worst, mut of) = (0, 0.0_f64, 0);
    for (ambient, coefficient) in [
        (0.1, 0.5),
        (0.02, 0.9),
        (0.05, 1.0),
        (0.25, 1.0),
        (0.3, 2.0),
    ] {
        let mut model = dark::<T>();
        model.ambient = T::ONE;
        for side in [1.0, -1.0] {
            let material = MaterialDescription {
                ambient: grey(ambient),
                reflection: T::from_f64(coefficient),
                ..Default::default()
            };
            model
                .parts
                .push(plane(vector(0.0, 0.0, side), 1.0, material));
        }
        let pools = model.build();
        let tracer = Tracer::new(pools.as_scene()).with_stack::<16>();
        for depth in 0..=16 {
            let tracer = tracer.with_max_depth(depth).expect("a frame a level");
            for pixel in [(11, 7), (80, 60), (159, 119)] {
                let mut work = WorkCount::default();
                let color = record.pixel_watched(&tracer, pixel, &mut work);
                // Without lights there are no shadow rays.
                rays_off += u64::from(work.rays() != depth as u64 + 1);
                let expected = mirror_series(ambient, coefficient, depth);
                for channel in channels(color) {
                    worst = worst.max((channel - expected).abs());
                }
                of += 1;
            }
        }
    }
    record.count("pixels of other than max_depth + 1 rays", rays_off, of);
    record.error("colour off the partial sum", worst, scaled::<T>(2e-6), of);
}

fn mirrors_of_0_9_at_depth_16<T: Number>(record: &mut Record) {
    let mut model = Model::of(&scenes::load::<f64>("default").as_scene());
    model.resolution = Resolution {
        width: 160,
        height: 120,
    };
    for part in &mut model.parts {
        part.material.reflection = 0.9;
    }
    record.tier::<T, 16>(&model, 1.0, Tier::A, "the default scene with mirrors");
    let mut model = Model::of(&scenes::load::<f64>("mirror-room").as_scene());
    model.resolution = Resolution {
        width: 80,
        height: 60,
    };
    record.tier::<T, 16>(&model, 1.0, Tier::B, "the room of mirrors");
}

/// The worst of what was seen.
#[derive(Default)]
struct Lengths {
    off: f64,
    deepest: usize,
    rays: u64,
    infinite: u64,
}

impl<T: Scalar> Observer<T> for Lengths {
    fn ray(&mut self, _: RayKind, depth: usize, ray: &Ray<T>) {
        self.rays += 1;
        self.infinite += u64::from(!(ray.origin.is_finite() && ray.direction.is_finite()));
        self.deepest = self.deepest.max(depth);
        let length = WideVec::of(ray.direction).length();
        self.off = self.off.max(narrow((length - 1.0).abs()));
    }
}

fn length_of_directions<T: Number>(record: &mut Record) {
    const DEPTH: usize = 16;
    for name in scenes::names() {
        let pools: ScenePools<T> = scenes::load(&name);
        let size = Resolution {
            width: 40,
            height: 30,
        };
        let tracer = Tracer::new(pools.as_scene())
            .with_resolution(size)
            .with_stack::<DEPTH>()
            .with_max_depth(DEPTH)
            .expect("a frame a level");
        let mut lengths = Lengths::default();
        for y in 0..size.height {
            for x in 0..size.width {
                record.pixel_watched(&tracer, (x, y), &mut lengths);
            }
        }
        record.error(
            format!("{name}: length off 1"),
            lengths.off,
            scaled::<T>(2e-7),
            lengths.rays,
        );
        record.count_in(
            &name,
            "rays without a place or direction",
            lengths.infinite,
            lengths.rays,
        );
        record.holds(
            format!("{name}: rays go deep, but no deeper than 16"),
            (4..=DEPTH).contains(&lengths.deepest),
        );
    }
}

/// Greatest depth at which a ray was cast.
#[derive(Default)]
struct Deepest(usize);

impl<T> Observer<T> for Deepest {
    fn ray(&mut self, kind: RayKind, depth: usize, _: &Ray<T>) {
        if kind != RayKind::Shadow {
            self.0 = self.0.max(depth);
        }
    }
}

/// The published scene with one mirror only, the floor, so that no path is longer than a few rays.
fn shallow_scene<T: Number>() -> Model<T> {
    let mut model = Model::of(&scenes::load::<T>("default").as_scene());
    model.resolution = Resolution {
        width: 80,
        height: 60,
    };
    for part in &mut model.parts {
        if !matches!(part.shape, Shape::Plane { .. }) {
            part.material.reflection = T::ZERO;
        }
    }
    model
}

/// Objects that nothing shows: spheres around the camera, in the middle of the picture and around
/// everything, planes and a triangle across the view.
fn invisible_parts<T: Scalar>() -> Vec<(&'static str, Part<T>)> {
    let material = scenes::invisible();
    let ball = |x, y, z, radius| sphere(vector(x, y, z), T::from_f64(radius), material);
    vec![
        ("sphere around the camera", ball(0.1, 0.2, 0.1, 1.1)),
        ("sphere in sight", ball(0.9, 0.3, 2.2, 0.8)),
        ("huge sphere around everything", ball(1.0, 2.0, 3.0, 500.0)),
        (
            "plane across the view",
            plane(vector(0.0, 0.0, 1.0), -1.2, material),
        ),
        (
            "slanted plane",
            plane(vector(1.0, 0.3, -0.5), 1.0, material),
        ),
        (
            "triangle across the view",
            Part {
                shape: Shape::Triangle([
                    vector(-3.0, -0.8, 1.3),
                    vector(4.0, -0.9, 1.1),
                    vector(0.3, 4.0, 2.7),
                ]),
                material,
            },
        ),
    ]
}

fn objects_of_index_1<T: Number>(record: &mut Record) {
    const DEPTH: usize = 24;
    let exact = shallow_scene::<f64>().build();
    let exact = Tracer::new(exact.as_scene());
    let size = exact.resolution();
    let pixels = || (0..size.height).flat_map(|y| (0..size.width).map(move |x| (x, y)));
    let expected: Vec<_> = pixels().map(|pixel| settled_color(&exact, pixel)).collect();
    let all: Vec<_> = invisible_parts()
        .into_iter()
        .map(|(_, part)| part)
        .collect();
    let groups = invisible_parts()
        .into_iter()
        .map(|(name, part)| (name, vec![part]))
        .chain([("all of them", all)]);
    for (name, parts) in groups {
        let mut model = shallow_scene::<T>();
        // Not at the end, so that the numbers of the others change too.
        model.parts.splice(2..2, parts);
        let pools = model.build();
        let tracer = Tracer::new(pools.as_scene())
            .with_stack::<DEPTH>()
            .with_max_depth(DEPTH)
            .expect("a frame a level");
        let mut deepest = Deepest::default();
        let (mut settled, mut changed) = (0, 0);
        for (pixel, expected) in pixels().zip(&expected) {
            let actual = record.pixel_watched(&tracer, pixel, &mut deepest);
            if let Some(expected) = expected {
                settled += 1;
                let distance = level_distance(levels(actual), levels(*expected));
                changed += u64::from(distance > 1);
            }
        }
        record.count_in(
            name,
            "settled pixels changed by more than 1 level",
            changed,
            settled,
        );
        // A clipped path would be darker: the comparison holds only without any.
        record.holds(
            format!("{name}: something is crossed, and no path is clipped"),
            (2..DEPTH).contains(&deepest.0) && settled > 4_700,
        );
    }
    // Straight through to the bit, and without a shadow.
    let random = record.random(143);
    let (mut bent, mut shadows, mut rays) = (0, 0, 0);
    for (_, part) in invisible_parts::<T>() {
        let mut model = shallow_scene::<T>();
        model.parts = vec![part];
        let pools = model.build();
        let tracer = Tracer::new(pools.as_scene());
        model.parts.clear();
        let empty = model.build();
        let nothing = Tracer::new(empty.as_scene());
        for _ in 0..RAYS / 6 {
            let ray = Ray::new(random.point(3.0), random.direction());
            rays += 1;
            shadows += u64::from(tracer.occluded(&ray, T::MAX));
            // The sky depends on the direction alone, so that any bend would change its bits.
            bent += u64::from(record.see(&tracer, ray) != nothing.radiance(ray));
        }
    }
    record.count("rays that are bent by a bit", bent, rays);
    record.count("shadow rays that are stopped", shadows, rays);
}

/// A surface of an index ahead, seen from inside or from outside, before a white background: white where a ray
/// is refracted, black where it is totally reflected.
fn surface_of_index<T: Number>(index: f64, from_inside: bool) -> Model<T> {
    let mut model = dark::<T>();
    model.background.color = grey(1.0);
    let side = if from_inside { 1.0 } else { -1.0 };
    let material = MaterialDescription {
        refraction: T::ONE,
        index_of_refraction: T::from_f64(index),
        ..Default::default()
    };
    model.parts = vec![plane(vector(0.0, 0.0, side), -side, material)];
    model
}

fn index_next_to_1<T: Number>(record: &mut Record) {
    for (seed, index, from_inside) in [(1441, 1.000_1, true), (1442, 0.999_9, false)] {
        let random = record.random(seed);
        let model = surface_of_index::<T>(index, from_inside);
        let pools = model.build();
        let tracer = Tracer::new(pools.as_scene());
        // Snell's sine beyond the surface is `beyond` times the sine before it.
        let exact_index = wide(T::from_f64(index));
        let beyond = if from_inside {
            exact_index
        } else {
            ratio(wide(T::ONE), exact_index)
        };
        let critical = {
            let sine = ratio(wide(T::ONE), beyond);
            narrow((wide(T::ONE) - sine * sine).sqrt())
        };
        let (mut wrong, mut by_textbook) = (0, 0);
        for _ in 0..RAYS {
            let (cosine, turn) = (
                critical * random.between(0.0, 2.0),
                random.between(0.0, 7.0),
            );
            let sine = (1.0 - cosine * cosine).sqrt();
            let direction = Vec3::new(sine * libm::cos(turn), sine * libm::sin(turn), cosine);
            let ray = Ray::new(model.camera, rounded::<T>(direction).normalize());
            let d = WideVec::of(ray.direction).unit();
            let across = d.cross(WideVec::of(vector::<T>(0.0, 0.0, 1.0))).length();
            let is_refracted = across * beyond <= 1.0;
            wrong += u64::from(is_black(record.see(&tracer, ray)) == is_refracted);
            let normal = vector(0.0, 0.0, -1.0);
            let eta = if from_inside {
                T::from_f64(index)
            } else {
                T::ONE / T::from_f64(index)
            };
            let textbook = textbook::refract(ray.direction, normal, eta).is_some();
            by_textbook += u64::from(textbook != is_refracted);
        }
        record.count(format!("index {index}: rays misclassified"), wrong, RAYS);
        record.textbook_share(by_textbook);
    }
}

fn critical_angle<T: Number>(record: &mut Record) {
    let band = scaled::<T>(1e-5).max(1e-13);
    for index in [1.000_1, 1.01, 1.333, 1.5, 2.4] {
        let model = surface_of_index::<T>(index, true);
        let pools = model.build();
        let tracer = Tracer::new(pools.as_scene());
        // The index as the scalar has it.
        let critical = 1.0 / T::from_f64(index).to_f64();
        let (mut wrong, mut of) = (0, 0);
        for step in 1..2_000 {
            let turn = f64::from(step);
            for (sine, is_refracted) in [(critical - band, true), (critical + band, false)] {
                if sine >= 1.0 {
                    continue;
                }
                let d = Vec3::new(
                    sine * libm::cos(turn),
                    sine * libm::sin(turn),
                    (1.0 - sine * sine).sqrt(),
                );
                let ray = Ray::new(model.camera, rounded::<T>(d));
                of += 1;
                wrong += u64::from(is_black(record.see(&tracer, ray)) == is_refracted);
            }
        }
        record.count(
            format!("index {index}: rays at ± {band:.0e} misclassified"),
            wrong,
            of,
        );
    }
}

fn diamond_beyond_the_critical_angle<T: Number>(record: &mut Record) {
    let random = record.random(146);
    let index = 2.417;
    let mut model = dark::<T>();
    model.background.color = grey(1.0);
    let diamond = MaterialDescription {
        refraction: T::ONE,
        index_of_refraction: T::from_f64(index),
        ..Default::default()
    };
    let (center, radius) = (vector::<T>(0.0, 0.0, 0.0), T::ONE);
    model.parts = vec![sphere(center, radius, diamond)];
    let pools = model.build();
    let tracer = Tracer::new(pools.as_scene());
    let (mut refracted, mut rays) = (0, 0);
    while rays < RAYS {
        // From inside, past the centre farther than the sphere's inverse index.
        let origin = random.direction::<T>() * T::from_f64(random.between(0.0, 0.95));
        let ray = Ray::new(origin, random.direction());
        let beside = narrow(reference::beside(center, &ray));
        if beside < 1.0 / index + 1e-4 || beside > 0.999 {
            continue;
        }
        rays += 1;
        let mut work = WorkCount::default();
        let color = tracer.radiance_observed(ray, scanray::accel::ObjectSet::ALL, &mut work);
        refracted += u64::from(work.refracted_rays != 0 || !is_black(color));
    }
    record.count("refracted rays", refracted, rays);
}

fn nested_glass_and_water_with_a_common_wall<T: Number>(record: &mut Record) {
    let transparent = |index: f64, blue: f64| MaterialDescription {
        refraction: T::from_f64(0.9),
        reflection: T::from_f64(0.1),
        index_of_refraction: T::from_f64(index),
        ambient: Color::new(T::ZERO, T::ZERO, T::from_f64(blue)),
        ..Default::default()
    };
    let ball = |radius, material| sphere(vector(0.0, 0.0, 4.0), T::from_f64(radius), material);
    let draw = |record: &mut Record, parts: Vec<Part<T>>| {
        let mut model = dark::<T>();
        model.ambient = T::HALF;
        model.background.sky = true;
        model.parts = parts;
        let pools = model.build();
        let tracer = Tracer::new(pools.as_scene())
            .with_stack::<12>()
            .with_max_depth(12)
            .expect("a frame a level");
        let tracer = tracer.with_resolution(Resolution {
            width: 64,
            height: 48,
        });
        record.draw(&tracer)
    };
    let (glass, water) = (transparent(1.5, 0.1), transparent(1.333, 0.2));
    draw(
        record,
        vec![
            ball(1.5, glass),
            ball(1.4, transparent(1.0 / 1.5, 0.0)),
            ball(1.3, water),
        ],
    );
    // A common wall: whichever comes first in the file is met, and the ray that leaves it starts beyond
    // the other one.
    let first_glass = draw(record, vec![ball(1.5, glass), ball(1.5, water)]);
    let glass_alone = draw(record, vec![ball(1.5, glass)]);
    let water_alone = draw(record, vec![ball(1.5, water)]);
    let of = first_glass.len() as u64;
    let different =
        |a: &[Color<T>], b: &[Color<T>]| a.iter().zip(b).filter(|(a, b)| a != b).count() as u64;
    record.count(
        "glass then water: pixels other than of glass alone",
        different(&first_glass, &glass_alone),
        of,
    );
    let first_water = draw(record, vec![ball(1.5, water), ball(1.5, glass)]);
    record.count(
        "water then glass: pixels other than of water alone",
        different(&first_water, &water_alone),
        of,
    );
    record.holds(
        "glass is not water",
        different(&glass_alone, &water_alone) > 100,
    );
}

fn glass_at_any_depth<T: Number>(record: &mut Record) {
    const DEEPEST: usize = 32;
    let mut model = dark::<T>();
    model.ambient = T::ONE;
    model.background.color = grey(0.5);
    let glass = MaterialDescription {
        refraction: T::ONE,
        index_of_refraction: T::THREE_HALVES,
        ambient: grey(0.125),
        ..Default::default()
    };
    model.parts = vec![sphere(vector(0.0, 0.0, 4.0), T::ONE, glass)];
    let pools = model.build();
    let tracer = Tracer::new(pools.as_scene())
        .with_stack::<DEEPEST>()
        .with_resolution(Resolution {
            width: 40,
            height: 30,
        });
    // Through the middle: the front, the back, the background.
    let ray = Ray::new(model.camera, vector::<T>(0.0, 0.0, 1.0));
    for (depth, expected) in [(0, 0.125), (1, 0.25), (2, 0.75), (DEEPEST, 0.75)] {
        let tracer = tracer.with_max_depth(depth).expect("a frame a level");
        record.draw(&tracer);
        let color = record.see(&tracer, ray);
        record.holds(
            format!("depth {depth}: the middle is {expected}"),
            color == grey(expected),
        );
    }
    record.holds(
        "a depth beyond the stack is an error",
        tracer.with_max_depth(DEEPEST + 1).is_err(),
    );
}

fn index_of_refraction_zero_negative_or_nan<T: Number>(record: &mut Record) {
    let with = |refraction: &str, index: &str| {
        format!(
            "1\n0 0 0\n4 3\n0 9 0 1 1 1 1 1 1\n1\n0\n0 0 0\n0 0 0 5 1 1 1 1 1 1 1 1 1 1 0 1 {refraction} {index}\n"
        )
    };
    for index in ["0", "-0", "1e-400", "-1", "-1e-30", "nan", "inf", "-inf"] {
        let text = with("0.5", index);
        let error = ScenePools::<T>::new().parse(text.as_bytes()).err();
        // Column of the last word of the object's line.
        let line = text.lines().nth(7).unwrap_or_default();
        let column = line.len() - index.len() + 1;
        record.holds(
            format!("index {index} is rejected at its place"),
            error.is_some_and(|e| (e.line, e.column as usize) == (8, column)),
        );
    }
    let without = ScenePools::<T>::new().parse(with("0", "0").as_bytes());
    record.holds("index 0 is accepted without refraction", without.is_ok());
}

/// Powers by the routine that the tracer takes for an exponent.
fn power<T: Number>(base: T, exponent: f64) -> T {
    let whole = exponent as u32;
    let is_squared = f64::from(whole) == exponent && whole <= u32::from(T::MAX_SQUARED_EXPONENT);
    if is_squared {
        scanray::formula::shading::power(scanray::real::Real(base), whole as u16).0
    } else {
        base.powf(T::from_f64(exponent))
    }
}

fn shininess<T: Number>(record: &mut Record) {
    let random = record.random(150);
    for exponent in [0.0, 1.0, 2.5, 50.0, 1000.0, 1000.5, 65_535.0] {
        let mut bases: Vec<T> = (0..RAYS)
            .map(|_| {
                // Bases next to 1 are the ones that large exponents still show.
                let below = random.log_between(1e-8, 1.0);
                T::from_f64(1.0 - below)
            })
            .collect();
        bases.sort_by(|a, b| a.to_f64().total_cmp(&b.to_f64()));
        let (mut worst, mut falls, mut before) = (0.0_f64, 0, 0.0);
        for base in bases {
            let actual = power(base, exponent).to_f64();
            let whole = wide(base).powi(exponent as i32);
            let exact = match exponent - exponent.floor() {
                0.0 => whole,
                // Half more.
                _ => whole * wide(base).sqrt(),
            };
            worst = worst.max((actual - narrow(exact)).abs() * 255.0);
            // Rounding may lower a power of the polynomial by a unit; no display shows it.
            falls += u64::from(actual < before - scaled::<T>(1e-6));
            before = actual;
        }
        record.error(
            format!("exponent {exponent}: error in levels"),
            worst,
            0.02,
            RAYS,
        );
        record.count(
            format!("exponent {exponent}: powers that fall"),
            falls,
            RAYS,
        );
    }
    for base in [0.0, 1e-30, 0.5, 1.0] {
        record.holds(
            format!("{base} to the power of 0 is 1"),
            power(T::from_f64(base), 0.0) == T::ONE,
        );
    }
    // Through the tracer: a highlight of shininess 0 is as strong everywhere.
    let mut model = dark::<T>();
    model.lights = vec![light(vector(0.0, 3.0, 0.0), 0.0, 0.5)];
    let material = MaterialDescription {
        specular: grey(0.5),
        ..Default::default()
    };
    model.parts = vec![plane(vector(0.0, 1.0, 0.0), 1.0, material)];
    let pools = model.build();
    let colors = record.draw(&Tracer::new(pools.as_scene()));
    let other = colors
        .iter()
        .filter(|color| !is_black(**color) && **color != grey(0.25))
        .count();
    let shown = colors.iter().filter(|color| **color == grey(0.25)).count();
    record.count(
        "pixels of another highlight than a quarter",
        other as u64,
        colors.len() as u64,
    );
    record.holds("the highlight shows", shown > 1_000);
}

fn ends_of_the_phong_base<T: Number>(record: &mut Record) {
    let below_one = T::ONE - T::EPSILON * T::HALF;
    for exponent in [0.5, 1.0, 50.0, 1000.0, 1000.5, 65_535.0, 1e7] {
        record.holds(
            format!("0 to the power of {exponent} is 0"),
            power(T::ZERO, exponent) == T::ZERO,
        );
        record.holds(
            format!("1 to the power of {exponent} is 1"),
            power(T::ONE, exponent) == T::ONE,
        );
        let exact = libm::exp(exponent * libm::log1p(below_one.to_f64() - 1.0));
        let off = (power(below_one, exponent).to_f64() - exact).abs() * 255.0;
        record.error(
            format!("the number below 1 to the power of {exponent}: error in levels"),
            off,
            0.02,
            1,
        );
    }
}

fn reflection_and_refraction_above_1<T: Number>(record: &mut Record) {
    // A sheet that adds what it mirrors and what is behind it, seen in a mirror of a half: the sheet's
    // colour, more than 1, is clamped before it is halved.
    let mut model = dark::<T>();
    model.ambient = T::ONE;
    model.background.color = grey(0.75);
    let sheet = MaterialDescription {
        reflection: T::ONE,
        refraction: T::ONE,
        index_of_refraction: T::ONE,
        ambient: grey(0.125),
        ..Default::default()
    };
    let half = MaterialDescription {
        reflection: T::HALF,
        ..Default::default()
    };
    let place = |z: f64, material| sphere(vector(0.0, 0.0, z), T::ONE, material);
    model.parts = vec![place(4.0, half), place(-4.0, sheet)];
    let pools = model.build();
    let tracer = Tracer::new(pools.as_scene());
    let ahead = Ray::new(model.camera, vector::<T>(0.0, 0.0, 1.0));
    let behind = Ray::new(model.camera, vector::<T>(0.0, 0.0, -1.0));
    let sheet_alone = record.see(&tracer, behind);
    record.holds("the sheet is clamped to 1", sheet_alone == grey(1.0));
    let mirrored = record.see(&tracer, ahead);
    record.holds(
        "its mirror picture is clamped before it is halved",
        mirrored == grey(0.5),
    );
    for coefficient in [2.0, 1e10, 1e30] {
        let mut model = room(vector::<T>(1.0, 3.0, 1.0));
        for part in &mut model.parts {
            part.material.reflection = T::from_f64(coefficient);
            part.material.refraction = T::from_f64(coefficient);
            part.material.index_of_refraction = T::THREE_HALVES;
        }
        model.resolution = Resolution {
            width: 40,
            height: 30,
        };
        let pools = model.build();
        record.draw(&Tracer::new(pools.as_scene()));
    }
}
