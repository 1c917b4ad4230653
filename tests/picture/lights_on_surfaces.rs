//! A light on a surface, or next to one, gives an even picture: a surface does not stand before a light that lies on it, and
//! rounding does not decide pixel by pixel.

use scanray::parser::FromDecimal;
use scanray::{Color, Scalar, ScenePools, Tracer};

type Pools<T, const BVH: usize> = ScenePools<T, 4, 4, 128, 4, 1, 32, BVH>;

const WIDTH: u16 = 80;
const HEIGHT: u16 = 60;

/// A light there, a floor at y = −1, and objects; all surfaces are grey.
fn text(light: [f64; 3], objects: &[String]) -> String {
    let [x, y, z] = light;
    let material = "0.7 0.7 0.7 0 0 0 0.1 0.1 0.1 0 50 0 0";
    let floor = "1 0 1 0 1".to_owned();
    let all: Vec<String> = objects
        .iter()
        .chain([&floor])
        .map(|object| format!("{object} {material}"))
        .collect();
    format!(
        "{}\n0 0 0\n{WIDTH} {HEIGHT}\n{x:e} {y:e} {z:e} 1 1 1 1 1 1\n1\n0\n0 0 0\n{}\n",
        all.len(),
        all.join("\n")
    )
}

/// The pixels that show the floor in the lower half of a picture.
fn floor<T: Scalar + FromDecimal>(text: &str, prepared: bool) -> Vec<Color<T>> {
    let mut pools = Box::new(Pools::<T, 128>::new());
    pools.parse(text.as_bytes()).expect("a scene");
    let scene = if prepared {
        pools.as_scene()
    } else {
        pools.as_scene().without_accel()
    };
    let tracer = Tracer::new(scene).with_bvh();
    let lower = HEIGHT / 2 + 2..HEIGHT;
    lower
        .flat_map(|y| (0..WIDTH).map(move |x| (x, y)))
        .map(|(x, y)| tracer.pixel(x, y))
        .collect()
}

/// How many pixels of the floor are lit as they are without the objects, and how many are in shadow.
fn lit_and_dark<T: Scalar + FromDecimal>(light: [f64; 3], objects: &[String]) -> (usize, usize) {
    let open = floor::<T>(&text(light, &[]), true);
    let prepared = floor::<T>(&text(light, objects), true);
    assert_eq!(
        prepared,
        floor(&text(light, objects), false),
        "not prepared"
    );
    let ambient = T::from_f64(0.1);
    let dark = prepared.iter().filter(|color| color.r == ambient).count();
    let lit = prepared.iter().zip(&open).filter(|(a, b)| a == b).count();
    assert_eq!(dark + lit, open.len());
    assert!(open.iter().all(|color| color.r > ambient));
    (lit, dark)
}

/// Lights next to a place on a surface, along its normal: how far outside of the room that they light.
const OUTSIDE: [f64; 14] = [
    -1e-2, -1e-3, -1e-4, -1e-5, -1e-6, -1e-7, 0.0, 1e-7, 1e-6, 3e-6, 1e-5, 1e-4, 1e-3, 1e-2,
];

/// Each light is in the room or outside, for all pixels; at the surface it is in the room.
fn assert_even<T: Scalar + FromDecimal>(
    what: &str,
    place: [f64; 3],
    outward: [f64; 3],
    rounding: f64,
    objects: &[String],
) {
    let pixels = floor::<T>(&text(place, &[]), true).len();
    for outside in OUTSIDE {
        let light = [0, 1, 2].map(|i| place[i] + outward[i] * outside);
        let (lit, dark) = lit_and_dark::<T>(light, objects);
        let what = format!(
            "{what}, {outside:e} outside: {lit} lit, {dark} dark, {}",
            T::NAME
        );
        assert!(lit == pixels || dark == pixels, "{what}");
        if outside <= 0.0 {
            assert_eq!(lit, pixels, "{what}");
        }
        if outside >= rounding {
            assert_eq!(dark, pixels, "{what}");
        }
    }
}

fn both(what: &str, place: [f64; 3], outward: [f64; 3], rounding: f64, objects: &[String]) {
    assert_even::<f32>(what, place, outward, rounding, objects);
    assert_even::<f64>(what, place, outward, rounding, objects);
}

#[test]
fn on_a_ceiling() {
    let ceiling = ["1 0 -1 0 2".to_owned()];
    both("ceiling", [0.3, 2.0, 2.7], [0.0, 1.0, 0.0], 1e-5, &ceiling);
    both(
        "ceiling",
        [-30.0, 2.0, 400.0],
        [0.0, 1.0, 0.0],
        1e-3,
        &ceiling,
    );
}

#[test]
fn on_a_ceiling_that_is_not_level() {
    // A plane through the light that leaves the floor that is seen on one side.
    let length = (0.01_f64 * 0.01 + 1.0 + 0.001 * 0.001).sqrt();
    let outward = [0.01, 1.0, 0.001].map(|component| component / length);
    let place = [0.3, 2.0, 2.7];
    let height: f64 = (0..3).map(|i| outward[i] * place[i]).sum();
    let [x, y, z] = outward;
    let ceiling = [format!("1 {x} {y} {z} {}", -height)];
    // Where both pass the floor again is out of the picture.
    both("slanted ceiling", place, outward, 1e-5, &ceiling);
}

/// A ceiling of triangles, so large that the floor in the picture is below it: `cells` by `cells` squares.
fn triangles(cells: i32) -> Vec<String> {
    let corner = |i: i32, j: i32| {
        let at = |i: i32| f64::from(2 * i - cells) / f64::from(cells) * 3000.0;
        format!("{} 2 {}", at(i) + 0.37, at(j) + 0.21)
    };
    (0..cells)
        .flat_map(|i| (0..cells).map(move |j| (i, j)))
        .flat_map(|(i, j)| {
            let [a, b, c, d] = [
                corner(i, j),
                corner(i + 1, j),
                corner(i + 1, j + 1),
                corner(i, j + 1),
            ];
            [
                format!("2 {a} {b} {c} 0 0 0 0"),
                format!("2 {a} {c} {d} 0 0 0 0"),
            ]
        })
        .collect()
}

#[test]
fn on_triangles() {
    // With a hierarchy and without.
    for cells in [1, 6] {
        // Their rounding is that of their largest coordinate.
        let objects = triangles(cells);
        both(
            "triangles",
            [0.3, 2.0, 2.7],
            [0.0, 1.0, 0.0],
            1e-2,
            &objects,
        );
    }
}

#[test]
fn on_a_sphere() {
    let sphere = ["0 0 1.5 3 0.5".to_owned()];
    // Below it, where all of the floor is on the light's side; outside is within the sphere.
    both(
        "below a sphere",
        [0.0, 1.0, 3.0],
        [0.0, 1.0, 0.0],
        1e-5,
        &sphere,
    );
    // On its top it is behind the sphere for all of the floor, but for the horizon.
    for above in [0.0, 1e-7, 1e-6] {
        let (lit, dark) = lit_and_dark::<f32>([0.0, 2.0 + above, 3.0], &sphere);
        assert!(lit == 0 && dark > 1000, "{above}: {lit} lit");
    }
}
