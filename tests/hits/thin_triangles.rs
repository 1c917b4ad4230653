//! Long thin triangles: they keep their order and have no holes, also in `f32`.

use scanray::parser::FromDecimal;
use scanray::{Color, Scalar, ScenePools, Tracer};

type Pools<T> = ScenePools<T, 0, 0, 4, 4, 1, 4>;

/// What comes before the objects: the camera looks along +z from the origin, all light is ambient.
const HEAD: &str = "0 0 0\n160 120\n0 50 -50 1 1 1 1 1 1\n1\n0\n0 0 0\n";
/// A material of a colour of its own light.
const RED: &str = "0 0 0 0 0 0 1 0 0 0 50 0 0";
const GREEN: &str = "0 0 0 0 0 0 0 1 0 0 50 0 0";

/// A wall at x = 1 that goes as far as `end` along z both ways, in two triangles.
fn wall(end: i32) -> String {
    format!(
        "2 1 -1 -{end} 1 1 -{end} 1 1 {end} 0 0 0 0 {RED}\n\
         2 1 -1 -{end} 1 1 {end} 1 -1 {end} 0 0 0 0 {RED}\n"
    )
}

/// The numbers of red and of green pixels; nothing else is drawn but black.
fn colors<T: Scalar + FromDecimal>(objects: &str) -> (usize, usize) {
    let text = format!("{}\n{HEAD}{objects}", objects.lines().count());
    let mut pools = Pools::<T>::new();
    pools.parse(text.as_bytes()).expect("a scene");
    let tracer = Tracer::new(pools.as_scene());
    let (mut red, mut green) = (0, 0);
    for y in 0..120 {
        for x in 0..160 {
            let color = tracer.pixel(x, y);
            let is = |r, g| color == Color::new(T::from_i32(r), T::from_i32(g), T::ZERO);
            red += usize::from(is(1, 0));
            green += usize::from(is(0, 1));
            assert!(is(0, 0) || is(1, 0) || is(0, 1), "{color:?} at {x}, {y}");
        }
    }
    (red, green)
}

#[test]
fn a_long_wall_of_two_triangles_has_no_holes() {
    // In f64 no pixel is close to an edge.
    assert_eq!(colors::<f64>(&wall(6000)), (6060, 0));
    for end in [10, 100, 1000, 6000, 10_000, 60_000] {
        assert_eq!(
            colors::<f32>(&wall(end)),
            colors::<f64>(&wall(end)),
            "{end}"
        );
    }
}

#[test]
fn what_hangs_before_a_long_wall_is_never_behind_it() {
    let decal = format!(
        "2 0.99 -0.9 0.9 0.99 0.9 0.9 0.99 0.9 3 0 0 0 0 {GREEN}\n\
         2 0.99 -0.9 0.9 0.99 0.9 3 0.99 -0.9 3 0 0 0 0 {GREEN}\n"
    );
    let (_, alone) = colors::<f64>(&decal);
    for end in [10, 100, 1000, 10_000] {
        let objects = wall(end) + &decal;
        let (red, green) = colors::<f32>(&objects);
        assert_eq!((red, green), colors::<f64>(&objects), "{end}");
        assert_eq!(green, alone, "{end}");
        assert!(green > 500);
    }
}
