//! Single rays through a part of a hierarchy of spheres, eight boxes or eight spheres at a time.
//!
//! A ray hits a sphere in its box whichever axis is asked (`accel::bvh` of the core: the point that the
//! test reports lies on the sphere but for rounding, which the boxes have a margin for), so that all axes may
//! tell that a box is behind the ray or too far. The core, whose boxes may hold triangles, asks one.

use fearless_simd::prelude::*;
use scanray::Vec3;
use scanray::formula::sphere::{chord, crossings};

use super::Walk;
use super::wide::{WideBvh, WideChild, WideLeaf, WideNode, WidePart};
use crate::packet::lanes::{InLanes, LANES, Mask, Numbers, Rays, Vec3s};

/// The most that may wait to be visited.
pub(super) const MOST_PENDING: usize = 256;

/// A ray that is alone in a part of the hierarchy.
pub(super) struct Single<'w> {
    bvh: &'w WideBvh,
    part: WidePart,
    origin: Vec3,
    direction: Vec3,
    /// How it is compared with boxes, by axis.
    axes: [Axis; 3],
}

#[derive(Clone, Copy)]
struct Axis {
    /// 1 by the component of the direction.
    inverse: f32,
    /// Component of the origin, with the margin for the ray, to compare with the end of a box where the ray
    /// enters it and with the other.
    origin: [f32; 2],
    /// Which end it enters at.
    entry: usize,
}

impl Axis {
    #[inline(always)]
    fn new(inverse: f32, low: f32, high: f32) -> Self {
        if inverse < 0.0 {
            Self {
                inverse,
                origin: [high, low],
                entry: 1,
            }
        } else {
            Self {
                inverse,
                origin: [low, high],
                entry: 0,
            }
        }
    }

    /// The distances at which the ray enters and leaves the slabs between the ends of boxes.
    #[inline(always)]
    fn slabs<S: Simd>(&self, simd: S, ends: &[[f32; LANES]; 2]) -> [Numbers<S>; 2] {
        let entry = self.entry & 1;
        let end = |end: usize| Numbers::from_slice(simd, &ends[end]);
        let [to, from] = self.origin;
        let inverse = Numbers::splat(simd, self.inverse);
        [
            (end(entry) - Numbers::splat(simd, to)) * inverse,
            (end(entry ^ 1) - Numbers::splat(simd, from)) * inverse,
        ]
    }
}

/// A node or a leaf and where the ray enters it, which decides the order.
#[derive(Clone, Copy, Debug)]
struct Pending(i64);

impl Pending {
    const NOTHING: Self = Self(0);

    #[inline(always)]
    fn new(entry: f32, child: WideChild) -> Self {
        // Numbers above 0 have the order of their bits; all others come before them.
        Self(i64::from(entry.to_bits() as i32) << 32 | i64::from(child.0))
    }

    #[inline(always)]
    fn entry(self) -> f32 {
        f32::from_bits((self.0 >> 32) as u32)
    }

    #[inline(always)]
    fn child(self) -> WideChild {
        WideChild(self.0 as u32)
    }
}

/// What a single ray has still to visit, the next one last.
#[derive(Debug)]
pub(in crate::packet) struct PendingParts(Box<[Pending; MOST_PENDING]>);

impl PendingParts {
    pub(in crate::packet) fn new() -> Self {
        Self(Box::new([Pending::NOTHING; MOST_PENDING]))
    }
}

impl<'w> Single<'w> {
    /// A ray of a walk.
    #[inline(always)]
    pub(super) fn new<S: Simd>(
        walk: &Walk<'_, '_, S>,
        rays: &Rays<S>,
        lane: usize,
        bvh: &'w WideBvh,
        part: WidePart,
    ) -> Self {
        let (inverse, low, high) = (&walk.inverse, &walk.low, &walk.high);
        Self {
            bvh,
            part,
            origin: rays.origin.lane(lane),
            direction: rays.direction.lane(lane),
            axes: [
                Axis::new(inverse.x[lane], low.x[lane], high.x[lane]),
                Axis::new(inverse.y[lane], low.y[lane], high.y[lane]),
                Axis::new(inverse.z[lane], low.z[lane], high.z[lane]),
            ],
        }
    }

    /// The subtrees of a node that may have something to hit at `t ≤ t_max`, and where the ray enters
    /// them. `Walk::may_hit`.
    #[inline(always)]
    fn may_hit<S: Simd>(&self, simd: S, node: &WideNode, t_max: f32) -> (Mask<S>, Numbers<S>) {
        let [x, y, z] = &self.axes;
        let x = x.slabs(simd, &node.bounds[0]);
        let y = y.slabs(simd, &node.bounds[1]);
        let z = z.slabs(simd, &node.bounds[2]);
        // Which of two numbers a NaN gives does not matter: its ray hits nothing.
        let entry = x[0].max(y[0]).max(z[0]);
        let exit = x[1].min(y[1]).min(z[1]);
        let hit = entry.simd_le(exit) & exit.simd_ge(0.0) & entry.simd_le(t_max);
        (hit, entry)
    }

    #[inline(always)]
    fn walk<'s, S: Simd>(
        &'s self,
        simd: S,
        pending: &'s mut PendingParts,
        t_max: f32,
    ) -> SingleWalk<'s> {
        let mut walk = SingleWalk {
            ray: self,
            pending,
            len: 0,
        };
        let node = &self.bvh.nodes[self.part.node as usize];
        let (hit, entry) = self.may_hit(simd, node, t_max);
        let hit = hit.to_bitmask() as u32 & u32::from(self.part.children);
        if let Some(nearest) = walk.divide(node, hit, entry) {
            walk.push(Pending::new(f32::NEG_INFINITY, nearest));
        }
        walk
    }

    /// The nearest sphere in the part, as distance and index among all objects, or what is given if that
    /// comes first.
    #[inline(always)]
    pub(super) fn nearest<S: Simd>(
        &self,
        simd: S,
        pending: &mut PendingParts,
        (mut t_max, mut object): (f32, u32),
    ) -> (f32, u32) {
        let mut walk = self.walk(simd, pending, t_max);
        while let Some(leaf) = walk.next_leaf(simd, t_max) {
            let (near, far) = self.crossings(simd, leaf);
            let t = Numbers::select(near.simd_gt(0.0), near, far);
            let hit = t.simd_gt(0.0) & t.simd_le(t_max);
            let mut hit = hit.to_bitmask() as u32;
            if hit == 0 {
                continue;
            }
            let t = t.to_array();
            while hit != 0 {
                let lane = hit.trailing_zeros() as usize % LANES;
                hit &= hit - 1;
                // `Closest::offer`.
                let (t, index) = (t[lane], leaf.index[lane]);
                if t < t_max || (t == t_max && index < object) {
                    (t_max, object) = (t, index);
                }
            }
        }
        (t_max, object)
    }

    /// Whether it hits a sphere in the part that casts a shadow before `t_max`.
    #[inline(always)]
    pub(super) fn is_occluded<S: Simd>(
        &self,
        simd: S,
        pending: &mut PendingParts,
        t_max: f32,
    ) -> bool {
        let mut walk = self.walk(simd, pending, t_max);
        while let Some(leaf) = walk.next_leaf(simd, t_max) {
            let (near, far) = self.crossings(simd, leaf);
            let hit =
                (near.simd_gt(0.0) & near.simd_lt(t_max)) | (far.simd_gt(0.0) & far.simd_lt(t_max));
            if hit.to_bitmask() as u8 & leaf.casts_shadow != 0 {
                return true;
            }
        }
        false
    }

    /// `Sphere::crossings` with those of a leaf: NaN for none.
    #[inline(always)]
    fn crossings<S: Simd>(&self, simd: S, leaf: &WideLeaf) -> (Numbers<S>, Numbers<S>) {
        let row = |row: &[f32; LANES]| Numbers::from_slice(simd, row);
        let [x, y, z] = &leaf.center;
        let center = Vec3s::new(row(x), row(y), row(z));
        let origin = Vec3s::in_every_lane(simd, self.origin);
        let direction = Vec3s::in_every_lane(simd, self.direction);
        let (middle, square) = chord(center, row(&leaf.radius_squared), origin, direction);
        crossings(middle, square)
    }
}

/// The way of a ray through the part, the nearer first.
struct SingleWalk<'w> {
    ray: &'w Single<'w>,
    pending: &'w mut PendingParts,
    len: usize,
}

impl<'w> SingleWalk<'w> {
    #[inline(always)]
    fn push(&mut self, next: Pending) {
        self.pending.0[self.len % MOST_PENDING] = next;
        self.len += 1;
    }

    /// The next leaf with spheres that the ray may hit at `t ≤ t_max`.
    #[inline(always)]
    fn next_leaf<S: Simd>(&mut self, simd: S, t_max: f32) -> Option<&'w WideLeaf> {
        while self.len > 0 {
            self.len -= 1;
            let next = self.pending.0[self.len % MOST_PENDING];
            if next.entry() > t_max {
                continue;
            }
            let mut child = next.child();
            loop {
                if let Some(leaf) = child.leaf() {
                    return Some(&self.ray.bvh.leaves[leaf]);
                }
                let node = &self.ray.bvh.nodes[child.0 as usize];
                let (hit, entry) = self.ray.may_hit(simd, node, t_max);
                match self.divide(node, hit.to_bitmask() as u32, entry) {
                    Some(nearest) => child = nearest,
                    None => break,
                }
            }
        }
        None
    }

    /// The nearest of some subtrees; the others wait.
    #[inline(always)]
    fn divide<S: Simd>(
        &mut self,
        node: &WideNode,
        mut hit: u32,
        entry: Numbers<S>,
    ) -> Option<WideChild> {
        if hit == 0 {
            return None;
        }
        let lane = hit.trailing_zeros() as usize % LANES;
        hit &= hit - 1;
        if hit == 0 {
            return Some(node.children[lane]);
        }
        let entry = entry.to_array();
        let mut nearest = Pending::new(entry[lane], node.children[lane]);
        while hit != 0 {
            let lane = hit.trailing_zeros() as usize % LANES;
            hit &= hit - 1;
            let other = Pending::new(entry[lane], node.children[lane]);
            let is_nearer = other.0 < nearest.0;
            self.push(if is_nearer { nearest } else { other });
            nearest = if is_nearer { other } else { nearest };
        }
        Some(nearest.child())
    }
}
