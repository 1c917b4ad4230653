//! Eight rays through the hierarchy of a large scene: `Walk` of the core and what the core's tracer does with it.
//!
//! A box is visited if any of the rays may hit it, so that each ray is offered more than the core
//! offers it; what it hits is the same. Far down in a hierarchy of many spheres the rays part: those that are
//! nearly alone in a subtree leave the vector and go on one by one ([`single`]), through the same subtree in
//! another layout ([`wide`]).

mod single;
#[cfg(test)]
mod tests;
mod wide;

use fearless_simd::prelude::*;
use scanray::accel::{Bvh, BvhNode, NodeContent};
use scanray::{Vec3, number::Number};

use self::single::{PendingParts, Single};
use self::wide::{WideBvh, WidePart};
use super::batch::{Batch, Group, NOTHING};
use super::lanes::{InLanes, Indices, LANES, Mask, Numbers, Rays, Vec3s, first_lanes};
use super::shade::{TowardLight, hits};
use super::shapes::{Among, LeafObject};
use super::{Closest, PacketTracer};

/// The hierarchy of a scene in other layouts.
#[derive(Debug)]
pub(super) struct PacketBvh<'a> {
    pairs: PairBvh<'a>,
    /// For single rays, if there are many spheres and nothing else: other objects are tested one at a time, by eight
    /// rays sooner than by one.
    wide: Option<WideBvh>,
}

/// For eight rays: a node has the boxes of its children, so that two are tested at once, subtrees are in one place,
/// and leaves have with them what the tests of objects begin with.
#[derive(Debug, Default)]
struct PairBvh<'a> {
    /// Index and count of the root, as of the halves of a pair.
    root: (u32, u8),
    nodes: Vec<Pair>,
    leaves: Vec<LeafObject<'a>>,
}

/// Two nodes.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
struct Pair {
    low: [Vec3; 2],
    high: [Vec3; 2],
    /// Index of a pair or of the first object of a leaf.
    first: [u32; 2],
    /// Objects of a leaf; 0 for a pair.
    count: [u8; 2],
    /// The axis along which the first lies below the other.
    axis: u8,
    /// The same subtree.
    wide: WidePart,
}

/// So many rays of a vector do not go on together where there is a hierarchy for single ones.
const FEW: u32 = 3;

/// In a hierarchy of fewer spheres the rays of a vector had better stay together.
pub(super) const FEWEST_FOR_SINGLES: usize = 4096;

impl<'a> PacketBvh<'a> {
    /// Whether single rays have a hierarchy of their own.
    pub(super) fn has_singles(&self) -> bool {
        self.wide.is_some()
    }

    /// The hierarchy of a scene that has one; nothing if there are leaves of more objects than a vector has lanes,
    /// which the scene's own builder does not make. Single rays have a hierarchy if there are `fewest_for_singles`
    /// spheres.
    pub(super) fn new<const STACK: usize>(
        packets: &PacketTracer<'a, STACK>,
        fewest_for_singles: usize,
    ) -> Option<Self> {
        let bvh = packets.tracer.scene().accel().bvh();
        let is_small = |node: &BvhNode| match node.content() {
            NodeContent::Leaf { count, .. } => count as usize <= LANES,
            NodeContent::Inner { .. } => true,
        };
        if !bvh.is_some() || !bvh.nodes.iter().all(is_small) {
            return None;
        }
        let (mut pairs, pair_of) = PairBvh::new(packets, bvh);
        let spheres = packets.shapes.spheres_alone();
        let wide = (spheres > 0 && spheres >= fewest_for_singles)
            .then(|| WideBvh::new(bvh, &mut pairs, &pair_of));
        Some(Self {
            pairs,
            wide: wide.flatten(),
        })
    }
}

impl<'a> PairBvh<'a> {
    /// The hierarchy in this layout, and for each of its nodes the index of the pair or of the first object of the
    /// leaf.
    fn new<const STACK: usize>(
        packets: &PacketTracer<'a, STACK>,
        bvh: Bvh<'_>,
    ) -> (Self, Vec<u32>) {
        let mut new = Self::default();
        let mut place_of = vec![0; bvh.nodes.len()];
        // Nodes of the hierarchy whose place in a pair is to be filled in, depth first.
        let mut pending = vec![(0, None)];
        while let Some((node, place)) = pending.pop() {
            let (first, count) = match bvh.nodes[node].content() {
                NodeContent::Leaf { first, count } => {
                    let start = new.leaves.len() as u32;
                    let entries = &bvh.entries[first as usize..][..count as usize];
                    new.leaves.extend(entries.iter().map(|entry| {
                        let target = &packets.objects[*entry as usize];
                        LeafObject::new(target.object.clone(), *entry, target.casts_shadow)
                    }));
                    (start, count as u8)
                }
                NodeContent::Inner { first, axis } => {
                    let children = [first, first + 1].map(|child| &bvh.nodes[child as usize]);
                    let index = new.nodes.len();
                    new.nodes.push(Pair {
                        low: children.map(|child| child.low()),
                        high: children.map(|child| child.high()),
                        first: [0; 2],
                        count: [0; 2],
                        axis: axis as u8,
                        wide: WidePart::default(),
                    });
                    pending.push((first as usize + 1, Some((index, 1))));
                    pending.push((first as usize, Some((index, 0))));
                    (index as u32, 0)
                }
            };
            place_of[node] = first;
            match place {
                Some((pair, half)) => {
                    new.nodes[pair].first[half] = first;
                    new.nodes[pair].count[half] = count;
                }
                None => new.root = (first, count),
            }
        }
        (new, place_of)
    }
}

/// A walk of eight rays through a hierarchy.
struct Walk<'w, 'a, S: Simd> {
    bvh: &'w PacketBvh<'a>,
    inverse: Vec3s<S>,
    /// The origins, moved by the margin for the rays, to compare with the lowest and the highest
    /// coordinates of boxes.
    low: Vec3s<S>,
    high: Vec3s<S>,
    leading: Leading<S>,
    /// Whether most rays hit the upper one of two nodes first, by axis.
    upper_first: [usize; 3],
    /// What is still to be visited, the next one last.
    pending: &'w mut WaitingPairs,
    len: usize,
}

/// Room for what walks have still to visit: they do not begin with clearing it.
#[derive(Debug)]
pub(super) struct WalkRoom {
    pairs: Box<WaitingPairs>,
    parts: PendingParts,
}

type WaitingPairs = [Pending; Bvh::<f32>::MAX_DEPTH + 1];

impl WalkRoom {
    pub(super) fn new() -> Self {
        Self {
            pairs: Box::default(),
            parts: PendingParts::new(),
        }
    }
}

/// A pair or a leaf, and the rays that may hit something in it, a bit for each.
#[derive(Clone, Copy, Debug, Default)]
struct Pending {
    first: u32,
    /// Objects of a leaf; 0 for a pair.
    count: u8,
    rays: u8,
}

/// Where a walk comes to.
enum Visit<'w, 'a> {
    /// Objects that some of the rays may hit.
    Leaf(&'w [LeafObject<'a>]),
    /// A part of the hierarchy that only a few of the rays may hit, a bit for each.
    Few(&'w WideBvh, WidePart, u8),
}

/// The axis of the largest component of each direction.
#[derive(Clone, Copy)]
enum Leading<S: Simd> {
    /// The same for all rays.
    Same(usize),
    /// The rays with x, and of the others those with y.
    Mixed(Mask<S>, Mask<S>),
}

impl<'w, 'a, S: Simd> Walk<'w, 'a, S> {
    #[inline(always)]
    fn new(
        bvh: &'w PacketBvh<'a>,
        pending: &'w mut WaitingPairs,
        rays: &Rays<S>,
        active: Mask<S>,
    ) -> Self {
        let (o, d) = (rays.origin, rays.direction);
        let one = d.x.constant(1.0);
        let size = o.abs();
        let margin = (size.x + size.y + size.z) * one.constant(64.0 * Numbers::<S>::ULP);
        let margin = Vec3s::splat(margin);
        let most = |mask: Mask<S>| {
            let negative = (mask & active).to_bitmask().count_ones();
            usize::from(2 * negative > active.to_bitmask().count_ones())
        };
        let size = d.abs();
        let x = size.x.simd_gt(size.y) & size.x.simd_gt(size.z);
        let y = size.y.simd_gt(size.z);
        let is_same = |mask: Mask<S>| (mask | !active).all_true();
        let leading = if is_same(x) {
            Leading::Same(0)
        } else if is_same(y & !x) {
            Leading::Same(1)
        } else if is_same(!(x | y)) {
            Leading::Same(2)
        } else {
            Leading::Mixed(x, y)
        };
        pending[0] = Pending {
            first: bvh.pairs.root.0,
            count: bvh.pairs.root.1,
            rays: active.to_bitmask() as u8,
        };
        Self {
            bvh,
            inverse: Vec3s::new(one / d.x, one / d.y, one / d.z),
            low: o + margin,
            high: o - margin,
            leading,
            upper_first: [
                most(d.x.simd_lt(0.0)),
                most(d.y.simd_lt(0.0)),
                most(d.z.simd_lt(0.0)),
            ],
            pending,
            len: 1,
        }
    }

    /// The next place with objects that one of the rays of a mask may hit at `t ≤ t_max`. `SINGLES`: whether there is
    /// a hierarchy for single rays.
    #[inline(always)]
    fn next<const SINGLES: bool>(
        &mut self,
        simd: S,
        t_max: Numbers<S>,
        active: Mask<S>,
    ) -> Option<Visit<'w, 'a>> {
        let pairs = &self.bvh.pairs;
        while self.len > 0 {
            self.len -= 1;
            let Pending {
                mut first,
                mut count,
                mut rays,
            } = self.pending[self.len];
            while count == 0 {
                let pair = &pairs.nodes[first as usize];
                if SINGLES
                    && let Some(wide) = &self.bvh.wide
                    && rays.count_ones() <= FEW
                {
                    rays &= active.to_bitmask() as u8;
                    return Some(Visit::Few(wide, pair.wide, rays));
                }
                let lower = self.may_hit(simd, pair.low[0], pair.high[0], t_max) & active;
                let upper = self.may_hit(simd, pair.low[1], pair.high[1], t_max) & active;
                let hit = |half: usize| [lower, upper][half].to_bitmask() as u8;
                let half = match (lower.any_true(), upper.any_true()) {
                    (false, false) => break,
                    (true, false) => 0,
                    (false, true) => 1,
                    (true, true) => {
                        let near = self.upper_first[usize::from(pair.axis)];
                        let far = near ^ 1;
                        self.pending[self.len] = Pending {
                            first: pair.first[far],
                            count: pair.count[far],
                            rays: if SINGLES { hit(far) } else { 0 },
                        };
                        self.len += 1;
                        near
                    }
                };
                (first, count) = (pair.first[half], pair.count[half]);
                if SINGLES {
                    rays = hit(half);
                }
            }
            if count > 0 {
                let leaf = &pairs.leaves[first as usize..][..usize::from(count)];
                return Some(Visit::Leaf(leaf));
            }
        }
        None
    }

    /// The rays that may hit something in a box.
    #[inline(always)]
    fn may_hit(&self, simd: S, low: Vec3, high: Vec3, t_max: Numbers<S>) -> Mask<S> {
        // Which of two numbers a NaN gives does not matter: its ray hits nothing.
        let slab = |low: f32, high: f32, from: Numbers<S>, to: Numbers<S>, inverse: Numbers<S>| {
            let a = (Numbers::splat(simd, low) - from) * inverse;
            let b = (Numbers::splat(simd, high) - to) * inverse;
            [a.min(b), a.max(b)]
        };
        let x = slab(low.x, high.x, self.low.x, self.high.x, self.inverse.x);
        let y = slab(low.y, high.y, self.low.y, self.high.y, self.inverse.y);
        let z = slab(low.z, high.z, self.low.z, self.high.z, self.inverse.z);
        let entry = x[0].max(y[0]).max(z[0]);
        let exit = x[1].min(y[1]).min(z[1]);
        let [leading_entry, leading_exit] = match self.leading {
            Leading::Same(0) => x,
            Leading::Same(1) => y,
            Leading::Same(_) => z,
            Leading::Mixed(by_x, by_y) => {
                let select =
                    |i: usize| Numbers::select(by_x, x[i], Numbers::select(by_y, y[i], z[i]));
                [select(0), select(1)]
            }
        };
        entry.simd_le(exit) & leading_exit.simd_ge(0.0) & leading_entry.simd_le(t_max)
    }
}

/// The numbers of the bits of a mask.
#[inline(always)]
fn bits(mut mask: u8) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let lane = mask.trailing_zeros() as usize;
        mask &= mask.wrapping_sub(1);
        (lane < LANES).then_some(lane)
    })
}

impl<S: Simd> Closest<S> {
    /// Takes what some rays hit that go on one by one, if that comes first.
    #[inline(always)]
    fn offer_singly<'w>(
        &mut self,
        simd: S,
        lanes: u8,
        single: impl Fn(usize) -> Single<'w>,
        pending: &mut PendingParts,
    ) {
        let mut t = self.t.to_array();
        let mut object: [u32; LANES] = self.object.into();
        for lane in bits(lanes) {
            let known = (t[lane], object[lane]);
            (t[lane], object[lane]) = single(lane).nearest(simd, pending, known);
        }
        self.t = Numbers::from_array(simd, t);
        self.object = Indices::simd_from(simd, object);
    }
}

impl<const STACK: usize> PacketTracer<'_, STACK> {
    /// `hit`, for rays that may leave any sides. `Tracer::closest_in_bvh`.
    pub(super) fn hit_by_bvh<S: Simd, const SINGLES: bool>(
        &self,
        simd: S,
        bvh: &PacketBvh<'_>,
        batch: &mut Batch,
        at: usize,
    ) -> usize {
        simd.vectorize(
            #[inline(always)]
            || {
                let rays = Rays {
                    origin: batch.origin.load(simd, at),
                    direction: batch.direction.load(simd, at),
                };
                let count = (batch.len - at).min(LANES);
                let active = first_lanes(simd, count);
                let leaves = Indices::from_slice(simd, &batch.leaves[at..at + LANES]) >> 1;
                let mut closest = Closest::none(simd);
                self.shapes
                    .hit(simd, &rays, leaves, Among::Unbounded, &mut closest);
                let WalkRoom { pairs, parts } = &mut batch.room;
                let mut walk = Walk::new(bvh, pairs, &rays, active);
                while let Some(visit) = walk.next::<SINGLES>(simd, closest.t, active) {
                    let objects = match visit {
                        Visit::Leaf(objects) => objects,
                        Visit::Few(wide, part, lanes) => {
                            let single = |lane| Single::new(&walk, &rays, lane, wide, part);
                            closest.offer_singly(simd, lanes, single, parts);
                            continue;
                        }
                    };
                    for object in objects {
                        object.hit(simd, &rays, leaves, &mut closest);
                    }
                }
                self.keep(simd, &closest, rays.direction, batch, at);
                count
            },
        )
    }

    /// Finds out which lights reach what the rays of a batch hit, eight neighbours at a time: many small
    /// objects are hit by fewer rays each than a vector has lanes.
    pub(super) fn cast_shadows<S: Simd, const SINGLES: bool>(
        &self,
        simd: S,
        bvh: &PacketBvh<'_>,
        batch: &mut Batch,
        groups: &[Group],
    ) {
        simd.vectorize(
            #[inline(always)]
            || {
                for group in groups {
                    let target = &self.objects[group.object as usize];
                    for start in group.range.clone().step_by(LANES) {
                        let lanes = batch.lanes(start..group.range.end);
                        let rays = batch.rays(simd, &lanes);
                        let hits = hits(simd, target, batch, &lanes, &rays);
                        batch.outside.scatter(&lanes, hits.outside);
                        batch.normal.scatter(&lanes, hits.normal);
                    }
                }
                for at in (0..batch.len).step_by(LANES) {
                    let objects = Indices::from_slice(simd, &batch.object[at..at + LANES]);
                    let valid = first_lanes(simd, (batch.len - at).min(LANES));
                    let valid = valid & !objects.simd_eq(NOTHING);
                    let origin = batch.outside.load(simd, at);
                    let normal = batch.normal.load(simd, at);
                    let mut lit = [0; LANES];
                    for (number, light) in self.tracer.scene().lights().iter().enumerate() {
                        // As in `local_color`.
                        let toward = TowardLight::new(simd, light, origin, normal);
                        let facing = valid & toward.is_facing();
                        if !facing.any_true() {
                            continue;
                        }
                        let (shadow, distance, _) = toward.shadow(origin);
                        let occluded = self.occluded_by_bvh::<S, SINGLES>(
                            simd,
                            bvh,
                            &shadow,
                            &mut batch.room,
                            objects,
                            distance,
                            facing,
                        );
                        let reached = (!occluded).to_bitmask();
                        for (lane, lit) in lit.iter_mut().enumerate() {
                            *lit |= ((reached >> lane & 1) as u32) << number;
                        }
                    }
                    batch.lit[at..at + LANES].copy_from_slice(&lit);
                }
            },
        )
    }

    /// The lanes of a mask whose rays, which leave objects, hit one that casts a shadow before `t_max`, and all
    /// others. `Tracer::occluded_in_bvh`.
    #[expect(clippy::too_many_arguments)]
    fn occluded_by_bvh<S: Simd, const SINGLES: bool>(
        &self,
        simd: S,
        bvh: &PacketBvh<'_>,
        rays: &Rays<S>,
        room: &mut WalkRoom,
        leaves: Indices<S>,
        t_max: Numbers<S>,
        lanes: Mask<S>,
    ) -> Mask<S> {
        simd.vectorize(
            #[inline(always)]
            || {
                let mut occluded = !lanes;
                let among = Among::Unbounded;
                self.shapes
                    .occlude(simd, rays, leaves, t_max, among, &mut occluded);
                let WalkRoom { pairs, parts } = room;
                let mut walk = Walk::new(bvh, pairs, rays, lanes);
                while !occluded.all_true()
                    && let Some(visit) = walk.next::<SINGLES>(simd, t_max, !occluded)
                {
                    let objects = match visit {
                        Visit::Leaf(objects) => objects,
                        Visit::Few(wide, part, lanes) => {
                            for lane in bits(lanes) {
                                let single = Single::new(&walk, rays, lane, wide, part);
                                if single.is_occluded(simd, parts, t_max[lane]) {
                                    occluded |= Mask::from_bitmask(simd, 1 << lane);
                                }
                            }
                            continue;
                        }
                    };
                    for object in objects {
                        object.occlude(simd, rays, leaves, t_max, &mut occluded);
                    }
                }
                occluded
            },
        )
    }
}
