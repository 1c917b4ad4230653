//! Pictures that can be computed by hand: one lit plane, one lit sphere, the sky.

use crate::common::sampling::{bits, channels};
use crate::common::scenes::{Model, Part, Shape};
use scanray::{
    Background, Color, Light, MaterialDescription, Ray, Resolution, Scalar, Tracer, Vec3,
    tracer::DepthError,
};

const SIZE: Resolution = Resolution {
    width: 40,
    height: 30,
};

fn vector<T: Scalar>([x, y, z]: [f64; 3]) -> Vec3<T> {
    Vec3::new(T::from_f64(x), T::from_f64(y), T::from_f64(z))
}

fn color<T: Scalar>([r, g, b]: [f64; 3]) -> Color<T> {
    Color::new(T::from_f64(r), T::from_f64(g), T::from_f64(b))
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn add(a: [f64; 3], b: [f64; 3], factor: f64) -> [f64; 3] {
    [0, 1, 2].map(|i| a[i] + b[i] * factor)
}

fn unit(a: [f64; 3]) -> [f64; 3] {
    add([0.0; 3], a, 1.0 / dot(a, a).sqrt())
}

/// Direction of a pixel's ray, by the contract.
fn direction(x: u16, y: u16) -> [f64; 3] {
    let (w, h) = (f64::from(SIZE.width), f64::from(SIZE.height));
    unit([
        (2.0 * f64::from(x) + 1.0 - w) / h,
        (h - 1.0 - 2.0 * f64::from(y)) / h,
        1.0,
    ])
}

/// An empty scene in front of a sky.
fn empty<T: Scalar>() -> Model<T> {
    Model {
        camera: vector([0.0; 3]),
        resolution: SIZE,
        ambient: T::ONE,
        background: Background {
            color: Color::BLACK,
            sky: true,
        },
        lights: Vec::new(),
        parts: Vec::new(),
    }
}

#[track_caller]
fn assert_close<T: Scalar>(
    actual: Color<T>,
    expected: [f64; 3],
    tolerance: f64,
    place: (u16, u16),
) {
    for (a, e) in channels(actual).into_iter().zip(expected) {
        assert!(
            (a - e).abs() <= tolerance,
            "{place:?}: {actual:?} instead of {expected:?}"
        );
    }
}

fn pixels() -> impl Iterator<Item = (u16, u16)> {
    (0..SIZE.height).flat_map(|y| (0..SIZE.width).map(move |x| (x, y)))
}

#[test]
fn a_depth_beyond_the_stack_is_an_error() {
    let pools = empty::<f32>().build();
    let tracer = Tracer::new(pools.as_scene());
    assert_eq!(tracer.max_depth(), 5);
    assert!(tracer.with_max_depth(5).is_ok());
    assert_eq!(
        tracer.with_max_depth(6).map(|_| ()),
        Err(DepthError {
            max_depth: 6,
            stack: 5
        })
    );
    let shallow = tracer.with_stack::<2>();
    assert_eq!(shallow.max_depth(), 2);
    assert!(shallow.with_max_depth(3).is_err());
}

#[test]
fn nothing_shows_the_sky_or_the_background() {
    let mut model = empty::<f64>();
    let pools = model.build();
    let tracer = Tracer::new(pools.as_scene());
    for (x, y) in pixels() {
        let s = 0.5 * (direction(x, y)[1] + 1.0);
        let expected = [1.0 - s + 0.5 * s, 1.0 - s + 0.7 * s, 1.0];
        assert_close(tracer.pixel(x, y), expected, 1e-14, (x, y));
    }
    model.background = Background {
        color: color([0.25, 7.0, 0.0]),
        sky: false,
    };
    let pools = model.build();
    let tracer = Tracer::new(pools.as_scene());
    for (x, y) in pixels() {
        assert_eq!(
            bits(tracer.pixel(x, y)),
            bits(color::<f64>([0.25, 1.0, 0.0]))
        );
    }
}

const AMBIENT: f64 = 0.2;
const LIGHT: [f64; 3] = [1.5, 2.0, -0.5];
const LIGHT_DIFFUSE: [f64; 3] = [0.9, 0.7, 0.5];
const LIGHT_SPECULAR: [f64; 3] = [0.5, 0.6, 0.7];
const DIFFUSE: [f64; 3] = [0.3, 0.5, 0.7];
const SPECULAR: [f64; 3] = [0.6, 0.4, 0.2];
const AMBIENT_COLOR: [f64; 3] = [0.5, 0.25, 1.0];

fn lit_scene<T: Scalar>(shape: Shape<T>, shininess: f64) -> Model<T> {
    let mut model = empty::<T>();
    model.ambient = T::from_f64(AMBIENT);
    model.lights.push(Light {
        position: vector(LIGHT),
        specular: color(LIGHT_SPECULAR),
        diffuse: color(LIGHT_DIFFUSE),
    });
    model.parts.push(Part {
        shape,
        material: MaterialDescription {
            diffuse: color(DIFFUSE),
            specular: color(SPECULAR),
            ambient: color(AMBIENT_COLOR),
            shininess: T::from_f64(shininess),
            ..Default::default()
        },
    });
    model
}

/// Local colour by the contract: of a point seen along `d`, with the facing normal `n`, unshadowed.
fn local_color(point: [f64; 3], n: [f64; 3], d: [f64; 3], shininess: f64) -> [f64; 3] {
    let l = unit(add(LIGHT, point, -1.0));
    let facing = dot(n, l);
    [0, 1, 2].map(|i| {
        let mut sum = AMBIENT * AMBIENT_COLOR[i];
        if facing > 0.0 {
            sum += LIGHT_DIFFUSE[i] * DIFFUSE[i] * facing;
            let r = add(add([0.0; 3], n, 2.0 * facing), l, -1.0);
            let alignment = -dot(r, d);
            if alignment > 0.0 {
                sum += LIGHT_SPECULAR[i] * SPECULAR[i] * alignment.powf(shininess);
            }
        }
        sum.clamp(0.0, 1.0)
    })
}

fn a_plane_is_lit_by_hand<T: Scalar>(tolerance: f64) {
    // The floor below, seen from above, and the same with its normal turned away.
    for (normal, distance) in [([0.0, 1.0, 0.0], 1.0), ([0.0, -1.0, 0.0], -1.0)] {
        for shininess in [0.0, 1.0, 2.5, 20.0, 50.0, 300.5] {
            let shape = Shape::Plane {
                normal: vector(normal),
                distance: T::from_f64(distance),
            };
            let pools = lit_scene(shape, shininess).build();
            let tracer = Tracer::new(pools.as_scene());
            for (x, y) in pixels() {
                let d = direction(x, y);
                if d[1] < 0.0 {
                    let point = add([0.0; 3], d, -1.0 / d[1]);
                    let expected = local_color(point, [0.0, 1.0, 0.0], d, shininess);
                    assert_close(tracer.pixel(x, y), expected, tolerance, (x, y));
                }
            }
        }
    }
}

#[test]
fn a_plane_is_lit_by_hand_in_single_precision() {
    a_plane_is_lit_by_hand::<f32>(1e-4);
}

#[test]
fn a_plane_is_lit_by_hand_in_double_precision() {
    a_plane_is_lit_by_hand::<f64>(1e-12);
}

fn a_sphere_is_lit_by_hand<T: Scalar>(tolerance: f64) {
    let (center, radius) = ([0.3, -0.1, 3.0], 1.2);
    for shininess in [1.0, 30.0, 10.25] {
        let shape = Shape::Sphere {
            center: vector(center),
            radius: T::from_f64(radius),
        };
        let pools = lit_scene(shape, shininess).build();
        let tracer = Tracer::new(pools.as_scene());
        let mut compared = 0;
        for (x, y) in pixels() {
            let d = direction(x, y);
            let along = dot(center, d);
            let beside_squared = dot(center, center) - along * along;
            let t = along - (radius * radius - beside_squared).sqrt();
            if !t.is_finite() {
                continue;
            }
            let point = add([0.0; 3], d, t);
            let normal = unit(add(point, center, -1.0));
            let to_light = unit(add(LIGHT, point, -1.0));
            // At its terminator the sphere's own shadow begins, to within rounding.
            if dot(normal, to_light).abs() > 1e-3 && dot(normal, d) < -0.05 {
                let expected = local_color(point, normal, d, shininess);
                assert_close(tracer.pixel(x, y), expected, tolerance, (x, y));
                compared += 1;
            }
        }
        assert!(compared > 80, "{compared}");
    }
}

#[test]
fn a_sphere_is_lit_by_hand_in_single_precision() {
    a_sphere_is_lit_by_hand::<f32>(1e-4);
}

#[test]
fn a_sphere_is_lit_by_hand_in_double_precision() {
    a_sphere_is_lit_by_hand::<f64>(1e-12);
}

/// Shadows: between the hit and the light, not beyond it, and not of index 1.
#[test]
fn only_what_lies_before_the_light_casts_a_shadow() {
    let floor = Shape::Plane {
        normal: vector([0.0, 1.0, 0.0]),
        distance: 1.0_f32,
    };
    // Below the camera's right, where the floor is seen at (1.5, -1, 3).
    let seen = unit([1.5, -1.0, 3.0]);
    let ray = Ray::new(vector([0.0; 3]), vector::<f32>(seen));
    let point = add([0.0; 3], seen, -1.0 / seen[1]);
    let lit = local_color(point, [0.0, 1.0, 0.0], seen, 1.0);
    let dark = [0, 1, 2].map(|i| AMBIENT * AMBIENT_COLOR[i]);
    let to_light = add(LIGHT, point, -1.0);
    for (along, index, expected) in [
        (0.5, 0.0, dark),
        (0.5, 1.5, dark),
        (0.5, 1.0, lit),
        (0.9, 0.0, dark),
        (1.1, 0.0, lit),
        (1.5, 0.0, lit),
        (-0.5, 0.0, lit),
    ] {
        let mut model = lit_scene(floor, 1.0);
        model.parts.push(Part {
            shape: Shape::Sphere {
                center: vector(add(point, to_light, along)),
                radius: 0.1,
            },
            material: MaterialDescription {
                index_of_refraction: index,
                ..Default::default()
            },
        });
        let pools = model.build();
        let actual = Tracer::new(pools.as_scene()).radiance(ray);
        for (a, e) in channels(actual).into_iter().zip(expected) {
            assert!(
                (a - e).abs() < 1e-4,
                "sphere at {along}, index {index}: {actual:?}"
            );
        }
    }
}

/// Refraction by Snell's law: straight through a sheet of glass of two planes, but moved aside.
#[test]
fn a_sheet_of_glass_moves_what_is_behind_it() {
    let (index, thickness) = (1.5, 0.4);
    let mut model = empty::<f64>();
    let glass = MaterialDescription {
        refraction: 1.0,
        index_of_refraction: index,
        ..Default::default()
    };
    for (normal, distance) in [([0.0, 0.0, -1.0], 1.0), ([0.0, 0.0, 1.0], -1.0 - thickness)] {
        model.parts.push(Part {
            shape: Shape::Plane {
                normal: vector(normal),
                distance,
            },
            material: glass,
        });
    }
    // A wall behind the glass, whose edge tells where the ray comes out.
    model.parts.push(Part {
        shape: Shape::Triangle([
            vector([-50.0, -50.0, 3.0]),
            vector([-50.0, 50.0, 3.0]),
            vector([50.0, 50.0, 3.0]),
        ]),
        material: MaterialDescription {
            ambient: color([1.0, 0.0, 0.0]),
            ..Default::default()
        },
    });
    let pools = model.build();
    let tracer = Tracer::new(pools.as_scene());
    let mut red = 0;
    for (x, y) in pixels() {
        let d = direction(x, y);
        let sine = (1.0 - d[2] * d[2]).sqrt() / index;
        let (outside, inside) = (
            (1.0 - d[2] * d[2]).sqrt() / d[2],
            sine / (1.0 - sine * sine).sqrt(),
        );
        let aside = if outside > 0.0 { inside / outside } else { 1.0 };
        // Where the ray hits the wall, in units of its slopes x/z and y/z.
        let reach = 3.0 - thickness + thickness * aside;
        let (px, py) = (d[0] / d[2] * reach, d[1] / d[2] * reach);
        if (px - py).abs() < 1e-9 {
            continue;
        }
        let expected = if px < py { 1.0 } else { 0.0 };
        red += u32::from(px < py);
        let [_, green, _] = channels(tracer.pixel(x, y));
        assert_eq!(green == 0.0, expected == 1.0, "({x}, {y})");
    }
    assert!(red > 400 && red < 800);
}
