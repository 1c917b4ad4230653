//! The leaves that a ray can hit.

use heapless::Vec;

use super::{Bvh, BvhNode, NodeContent};
use crate::ray::Ray;
use crate::scalar::Scalar;
use crate::vec3::Vec3;

/// A walk of a ray through a hierarchy, from leaf to leaf, roughly in the order in which the ray hits them.
pub(crate) struct Walk<'a, T> {
    bvh: Bvh<'a, T>,
    axes: [Axis<T>; 3],
    /// The axis of the largest component of the direction.
    leading: usize,
    /// Nodes to visit, the next one last. A step down leaves one node behind.
    nodes: Vec<u32, { Bvh::<f32>::MAX_DEPTH + 1 }>,
}

/// The component of a ray along an axis.
#[derive(Clone, Copy)]
struct Axis<T> {
    /// 1 by the component of the direction.
    inverse: T,
    /// Component of the origin, to be compared with the coordinate where the ray enters a box and with the one where it
    /// leaves it: the margin for the ray is in it.
    origin: [T; 2],
    /// Which of the lowest and the highest coordinate of a box the ray hits first.
    entry: usize,
}

impl<'a, T: Scalar> Walk<'a, T> {
    #[inline]
    pub(crate) fn new(bvh: Bvh<'a, T>, ray: &Ray<T>) -> Self {
        let (o, d) = (ray.origin, ray.direction);
        let size = o.x.abs() + o.y.abs() + o.z.abs();
        let margin = size * (T::EPSILON * T::from_i32(64));
        let axis = |origin: T, direction: T| {
            let inverse = T::ONE / direction;
            let (lower, upper) = (origin - margin, origin + margin);
            // The sign of the inverse, because −0 has none that shows.
            let is_downward = inverse < T::ZERO;
            Axis {
                inverse,
                origin: if is_downward {
                    [lower, upper]
                } else {
                    [upper, lower]
                },
                entry: usize::from(is_downward),
            }
        };
        let Vec3 { x, y, z } = d.abs();
        let mut nodes = Vec::new();
        if bvh.is_some() {
            // There is room.
            let _ = nodes.push(0);
        }
        Self {
            bvh,
            axes: [axis(o.x, d.x), axis(o.y, d.y), axis(o.z, d.z)],
            leading: if x > y && x > z {
                0
            } else if y > z {
                1
            } else {
                2
            },
            nodes,
        }
    }

    /// The next leaf with objects that the ray may hit at `t ≤ t_max`. `tested` is told of every box.
    #[inline]
    pub(crate) fn next_leaf(&mut self, t_max: T, mut tested: impl FnMut()) -> Option<&'a [u32]> {
        loop {
            let node = self.bvh.nodes.get(self.nodes.pop()? as usize)?;
            tested();
            if !self.may_hit(node, t_max) {
                continue;
            }
            match node.content() {
                NodeContent::Leaf { first, count } => {
                    let entries = self.bvh.entries.get(first as usize..)?;
                    return entries.get(..count as usize);
                }
                NodeContent::Inner { first, axis } => {
                    let upper_first = self.axes.get(axis)?.entry as u32;
                    // The depth of the hierarchy is bounded, so that there is room.
                    let _ = self.nodes.push(first + 1 - upper_first);
                    let _ = self.nodes.push(first + upper_first);
                }
            }
        }
    }

    /// Whether the ray may hit something in the box at `0 < t ≤ t_max`.
    #[inline(always)]
    fn may_hit(&self, node: &BvhNode<T>, t_max: T) -> bool {
        let slab = |axis: &Axis<T>, bounds: &[T; 2]| {
            let (entry, exit) = (axis.entry & 1, !axis.entry & 1);
            [
                (bounds[entry] - axis.origin[0]) * axis.inverse,
                (bounds[exit] - axis.origin[1]) * axis.inverse,
            ]
        };
        let ([x, y, z], [of_x, of_y, of_z]) = (&self.axes, node.bounds());
        let (x, y, z) = (slab(x, of_x), slab(y, of_y), slab(z, of_z));
        // Comparisons with NaN keep what is there.
        let later = |a: T, b: T| if b > a { b } else { a };
        let earlier = |a: T, b: T| if b < a { b } else { a };
        let entry = later(later(x[0], y[0]), z[0]);
        let exit = earlier(earlier(x[1], y[1]), z[1]);
        let [leading_entry, leading_exit] = match self.leading {
            0 => x,
            1 => y,
            _ => z,
        };
        !(entry > exit || leading_exit < T::ZERO || leading_entry > t_max)
    }
}
