//! A ball of triangles with bumps.

use std::f64::consts::TAU;

use super::random::Random;
use super::{floor, material};

/// The triangles of an icosahedron.
pub(super) const FEWEST: u32 = 20;

const CENTER: [f64; 3] = [0.0, 0.6, 4.5];
const RADIUS: f64 = 1.5;

/// The vertices of an icosahedron: cyclic exchanges of (0, ±1, ±φ).
fn vertices() -> [[f64; 3]; 12] {
    let golden = (1.0 + 5.0_f64.sqrt()) / 2.0;
    std::array::from_fn(|i| {
        let sign = |bit: usize| if i >> bit & 1 == 0 { 1.0 } else { -1.0 };
        let mut vertex = [0.0, sign(0), sign(1) * golden];
        vertex.rotate_right(i / 4);
        vertex
    })
}

/// Its faces: three vertices that are neighbours of each other.
fn faces(vertices: &[[f64; 3]; 12]) -> Vec<[usize; 3]> {
    let is_edge = |a: usize, b: usize| {
        let squared: f64 = (0..3)
            .map(|i| (vertices[a][i] - vertices[b][i]).powi(2))
            .sum();
        // The square of an edge is 4, that of the next larger distance above 10.
        squared < 5.0
    };
    let triples =
        (0..12).flat_map(|a| (a + 1..12).flat_map(move |b| (b + 1..12).map(move |c| [a, b, c])));
    triples
        .filter(|[a, b, c]| is_edge(*a, *b) && is_edge(*b, *c) && is_edge(*a, *c))
        .collect()
}

/// The lines of a floor and a mesh of at most `count` triangles. Vertices that triangles share have the
/// same digits.
pub(super) fn objects(count: u32, random: &mut Random) -> Vec<String> {
    let steps = (count / FEWEST).isqrt();
    let waves: Vec<_> = (0..6)
        .map(|_| {
            let mut numbers = || [(); 3].map(|()| random.between(-7.0, 7.0));
            (numbers(), random.between(0.0, TAU))
        })
        .collect();
    let vertex = |direction: [f64; 3]| {
        let length = direction.iter().map(|x| x * x).sum::<f64>().sqrt();
        let unit = direction.map(|x| x / length);
        let bump: f64 = waves
            .iter()
            .map(|(wave, phase)| (dot(*wave, unit) + phase).sin())
            .sum();
        let radius = RADIUS * (1.0 + 0.02 * bump);
        let [x, y, z] = std::array::from_fn(|i| CENTER[i] + radius * unit[i]);
        format!("{x:.6} {y:.6} {z:.6}")
    };
    let vertices = vertices();
    let material = material([0.8, 0.6, 0.4], 0.2);
    let mut objects = vec![floor(0.0)];
    for face in faces(&vertices) {
        // A face's corners in the order of their index, so that an edge has the same points from both
        // sides.
        let [a, b, c] = face.map(|corner| vertices[corner]);
        let point = |i: u32, j: u32| {
            let (i, j, k) = (f64::from(i), f64::from(j), f64::from(steps - i - j));
            vertex(std::array::from_fn(|axis| {
                a[axis] * k + b[axis] * i + c[axis] * j
            }))
        };
        for i in 0..steps {
            for j in 0..steps - i {
                let (here, right, up) = (point(i, j), point(i + 1, j), point(i, j + 1));
                objects.push(format!("2 {here} {right} {up} 0 0 0 0 {material}"));
                if i + j + 1 < steps {
                    let across = point(i + 1, j + 1);
                    objects.push(format!("2 {right} {across} {up} 0 0 0 0 {material}"));
                }
            }
        }
    }
    objects
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests {
    use std::collections::HashMap;

    use super::*;

    /// Every edge has two triangles.
    #[test]
    fn the_mesh_is_closed() {
        for (count, triangles) in [(20, 20), (79, 20), (80, 80), (1000, 980), (20_480, 20_480)] {
            let objects = objects(count, &mut Random::new(3));
            assert_eq!(objects.len(), 1 + triangles);
            let mut edges = HashMap::new();
            for object in &objects[1..] {
                let numbers: Vec<&str> = object.split(' ').collect();
                let corners =
                    [&numbers[1..4], &numbers[4..7], &numbers[7..10]].map(|c| c.join(" "));
                for (from, to) in [(0, 1), (1, 2), (2, 0)] {
                    let mut edge = [corners[from].clone(), corners[to].clone()];
                    edge.sort();
                    *edges.entry(edge).or_insert(0) += 1;
                }
            }
            assert_eq!(edges.len(), triangles * 3 / 2);
            assert!(edges.values().all(|triangles| *triangles == 2));
        }
    }
}
