//! What rays can hit that leave a plane, by the place where they start.
//!
//! Planes have no bounds, so that a side of one hits nearly everything. But the lower coordinates of an
//! object tell whether it lies behind a ray that goes up along the axis, and the upper ones likewise; and
//! an object stands between a place and a light only inside the wedge from the light to the slab in which
//! the place lies. Both are found for slabs of a bounded part of the plane, so that the margins can be
//! relative to its size; from elsewhere anything may be hit.

use super::{PlaneGrid, Slab, across};
use crate::accel::{ObjectSet, Source, collect, margin, size};
use crate::light::Light;
use crate::scalar::Scalar;
use crate::shape::{BoundingSphere, Plane};
use crate::vec3::Vec3;

/// How much larger the part of the plane with slabs is than what the objects span.
fn widening<T: Scalar>() -> T {
    T::THREE_HALVES
}

/// The grid of a plane.
pub(in crate::accel) fn plane_grid<T: Scalar>(
    scene: &Source<'_, T>,
    plane: &Plane<T>,
) -> PlaneGrid<T> {
    let Some(part) = Part::of(scene, plane) else {
        return PlaneGrid::ALL;
    };
    let slabs = |axis: Axis| {
        let mut slabs = [Slab::ALL; Slab::PER_AXIS];
        for (slab, number) in slabs.iter_mut().zip(0..) {
            *slab = part.slab(scene, axis, number);
        }
        slabs
    };
    PlaneGrid {
        normal_axis: part.normal_axis,
        low: part.low,
        density: part.step.map(|step| T::ONE / step),
        slabs: [slabs(Axis::First), slabs(Axis::Second)],
    }
}

/// One of the two axes with slabs.
#[derive(Clone, Copy)]
enum Axis {
    First,
    Second,
}

impl Axis {
    const BOTH: [Self; 2] = [Self::First, Self::Second];

    /// What belongs to it.
    fn of<E>(self, [first, second]: [E; 2]) -> E {
        match self {
            Self::First => first,
            Self::Second => second,
        }
    }
}

/// A part of a plane, divided into slabs.
struct Part<'p, T> {
    plane: &'p Plane<T>,
    normal_axis: u8,
    low: [T; 2],
    /// Widths of a slab.
    step: [T; 2],
    /// No coordinates of a place in it add up to more.
    size: T,
}

impl<'p, T: Scalar> Part<'p, T> {
    /// The part around the bounded objects; `None` if there are none or they span nothing.
    fn of(scene: &Source<'_, T>, plane: &'p Plane<T>) -> Option<Self> {
        let n = plane.normal().abs();
        let normal_axis = if n.x > n.y && n.x > n.z {
            0
        } else if n.y > n.z {
            1
        } else {
            2
        };
        let [(low_u, step_u, u), (low_v, step_v, v)] = Axis::BOTH.map(|axis| {
            let (mut low, mut high) = (T::MAX, -T::MAX);
            for bounds in scene
                .geometry
                .objects()
                .filter_map(|it| it.bounding_sphere())
            {
                let center = axis.of(across(normal_axis, bounds.center));
                high = (center + bounds.radius).max(high);
                low = -((bounds.radius - center).max(-low));
            }
            let middle = (low + high) * T::HALF;
            let half = (high - low) * T::HALF * widening();
            let step = (half + half) / T::from_i32(Slab::PER_AXIS as i32);
            // The first slab reaches a step further down.
            (middle - half, step, middle.abs() + half + step)
        });
        // n·p = height, so this bounds the third coordinate; the normal's largest component is over ½.
        let third = T::TWO * (plane.height().abs() + u + v);
        let size = u + v + third;
        (step_u > T::ZERO && step_v > T::ZERO && size.is_finite()).then_some(Self {
            plane,
            normal_axis,
            low: [low_u, low_v],
            step: [step_u, step_v],
            size,
        })
    }

    /// The coordinate along an axis where a slab begins.
    fn border(&self, axis: Axis, number: i32) -> T {
        let steps = if number == 0 { -1 } else { number };
        axis.of(self.low) + axis.of(self.step) * T::from_i32(steps)
    }

    /// What can be hit from a slab.
    fn slab(&self, scene: &Source<'_, T>, axis: Axis, number: i32) -> Slab {
        let (from, to) = (self.border(axis, number), self.border(axis, number + 1));
        let along = |bounds: &BoundingSphere<T>| axis.of(across(self.normal_axis, bounds.center));
        Slab {
            ahead: [
                self.collect(scene, |bounds, reach| !(along(bounds) + reach < from)),
                self.collect(scene, |bounds, reach| !(along(bounds) - reach > to)),
            ],
            occluders: self.collect(scene, |bounds, reach| {
                scene.lights.iter().any(|light| {
                    !(self.is_outside(light, axis, [from, to], bounds, reach)
                        || self.is_outside(light, axis, [to, from], bounds, reach))
                })
            }),
        }
    }

    /// The objects with a sphere, whose radius a margin is added to, for which something holds, and those
    /// without one.
    fn collect(
        &self,
        scene: &Source<'_, T>,
        holds: impl Fn(&BoundingSphere<T>, T) -> bool,
    ) -> ObjectSet {
        collect(&scene.geometry, |object| {
            object.bounding_sphere().is_none_or(|bounds| {
                let margin = margin(self.size + size(bounds.center), bounds.radius);
                holds(&bounds, bounds.radius + margin)
            })
        })
    }

    /// The place in the middle of the part but for its coordinate along an axis.
    fn place(&self, axis: Axis, coordinate: T) -> Vec3<T> {
        let middle = |other: Axis| {
            let steps = T::from_i32(Slab::PER_AXIS as i32) * T::HALF;
            other.of(self.low) + other.of(self.step) * steps
        };
        let [u, v] = match axis {
            Axis::First => [coordinate, middle(Axis::Second)],
            Axis::Second => [middle(Axis::First), coordinate],
        };
        let (n, height) = (self.plane.normal(), self.plane.height());
        match self.normal_axis {
            0 => Vec3::new((height - n.y * u - n.z * v) / n.x, u, v),
            1 => Vec3::new(u, (height - n.x * u - n.z * v) / n.y, v),
            _ => Vec3::new(u, v, (height - n.x * u - n.y * v) / n.z),
        }
    }

    /// Whether a sphere lies beyond the first of two borders as the light sees it: beyond the plane through
    /// that border and the light, on whose other side all rays from the slab to the light stay.
    fn is_outside(
        &self,
        light: &Light<T>,
        axis: Axis,
        [border, other]: [T; 2],
        bounds: &BoundingSphere<T>,
        reach: T,
    ) -> bool {
        let place = self.place(axis, border);
        let to_place = place - light.position;
        // The border's direction: in the plane, and across the axis.
        let [u, v] = match axis {
            Axis::First => [T::ONE, T::ZERO],
            Axis::Second => [T::ZERO, T::ONE],
        };
        let unit = match self.normal_axis {
            0 => Vec3::new(T::ZERO, u, v),
            1 => Vec3::new(u, T::ZERO, v),
            _ => Vec3::new(u, v, T::ZERO),
        };
        let Some((direction, _)) = self.plane.normal().cross(unit).try_normalize() else {
            return false;
        };
        let wall = to_place.cross(direction);
        let length = wall.dot(wall).sqrt();
        // A light that is seen from the border at a low angle makes the wall's direction uncertain.
        if !(length * T::from_i32(4) > size(to_place)) {
            return false;
        }
        let height = |point: Vec3<T>| wall.dot(point - light.position) / length;
        let margin = margin(size(light.position), T::ZERO);
        let (slab, bounds) = (height(self.place(axis, other)), height(bounds.center));
        (slab > margin && bounds < -(reach + margin)) || (slab < -margin && bounds > reach + margin)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::Color;
    use crate::ray::Ray;
    use crate::shape::{Geometry, ObjectInfo, Sphere};

    /// [`PlaneGrid::cell`] cuts numbers off towards 0: places of up to a step below the first border have the first slab, too.
    #[test]
    fn every_place_with_a_cell_has_what_shades_it_among_its_occluders() {
        let info = ObjectInfo {
            material: 0,
            number: 0,
        };
        let mut below_the_first_border = 0;
        for turn in 0..3 {
            // The axes exchanged in turn, so that the slabs lie across each pair of them.
            let turned = |x: f32, y: f32, z: f32| match turn {
                0 => Vec3::new(x, y, z),
                1 => Vec3::new(y, z, x),
                _ => Vec3::new(z, x, y),
            };
            let plane = Plane::new(turned(0.0, 1.0, 0.0), 0.0, info).unwrap();
            let sphere = |x, y, z| Sphere::new(turned(x, y, z), 0.1, info).unwrap();
            let spheres = [
                sphere(-1.0, 1.2, 0.0),
                sphere(1.0, 0.5, 0.9),
                sphere(0.0, 0.3, -1.0),
                sphere(0.2, 1.5, 1.1),
            ];
            let light = |x, z| Light {
                position: turned(x, 10.0, z),
                specular: Color::BLACK,
                diffuse: Color::BLACK,
            };
            for light in [light(5.0, 0.0), light(-6.0, 2.0), light(0.5, 7.0)] {
                let geometry = Geometry {
                    spheres: &spheres,
                    planes: core::slice::from_ref(&plane),
                    ..Geometry::NONE
                };
                let scene = Source {
                    geometry,
                    lights: &[light],
                    materials: &[],
                };
                let grid = plane_grid(&scene, &plane);
                for (column, row) in (-60..60).flat_map(|row| (-60..60).map(move |x| (x, row))) {
                    let coordinates = [column, row].map(|steps| steps as f32 / 20.0);
                    let place = turned(coordinates[0], 0.0, coordinates[1]);
                    let Some(cell) = grid.cell(place) else {
                        continue;
                    };
                    let (direction, _) = (light.position - place).try_normalize().unwrap();
                    let ray = Ray::new(place, direction);
                    for (index, sphere) in spheres.iter().enumerate() {
                        if sphere.intersect(&ray, f32::MAX).is_none() {
                            continue;
                        }
                        assert!(
                            cell.occluders().contains(index),
                            "sphere {index} shades {place:?} from {light:?}"
                        );
                        let [u, v] = across(grid.normal_axis, place);
                        below_the_first_border += usize::from(u < grid.low[0] || v < grid.low[1]);
                    }
                }
            }
        }
        assert!(below_the_first_border > 0);
    }
}
