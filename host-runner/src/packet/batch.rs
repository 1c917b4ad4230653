//! Rays of one depth that wait to be traced, and what becomes of them.

use std::ops::Range;

use fearless_simd::prelude::*;

use super::bvh::WalkRoom;
use super::lanes::{Colors, InLanes, Indices, LANES, Mask, Numbers, Rays, Three, clamp};

/// Rays that a batch holds.
pub(super) const CAPACITY: usize = 512;

/// Lights that [`Batch::lit`] tells apart.
pub(super) const MOST_LIGHTS: usize = 32;

/// A number for each ray. Whole vectors are loaded and stored, so that the last rays need room behind
/// them.
type Column<E> = Box<[E; CAPACITY + LANES]>;

/// Nothing is hit.
pub(super) const NOTHING: u32 = u32::MAX >> 1;

/// The side that primary rays leave: `Side::NOWHERE`.
pub(super) const NOWHERE: u32 = u32::MAX;

fn column<E: Copy + Default + std::fmt::Debug>() -> Column<E> {
    let column: Box<[E]> = vec![E::default(); CAPACITY + LANES].into();
    column.try_into().expect("it has this length")
}

/// A vector or a colour for each ray.
#[derive(Debug)]
pub(super) struct Columns([Column<f32>; 3]);

impl Columns {
    fn new() -> Self {
        Self([column(), column(), column()])
    }

    #[inline(always)]
    pub(super) fn load<S: Simd, V: Three<S>>(&self, simd: S, at: usize) -> V {
        let [x, y, z] = &self.0;
        V::from_three([load(simd, x, at), load(simd, y, at), load(simd, z, at)])
    }

    #[inline(always)]
    pub(super) fn store<S: Simd>(&mut self, at: usize, v: impl Three<S>) {
        let [x, y, z] = &mut self.0;
        let v = v.three();
        store(x, at, v[0]);
        store(y, at, v[1]);
        store(z, at, v[2]);
    }

    #[inline(always)]
    fn gather<S: Simd, V: Three<S>>(&self, simd: S, at: &Lanes) -> V {
        let [x, y, z] = &self.0;
        V::from_three([at.gather(simd, x), at.gather(simd, y), at.gather(simd, z)])
    }

    /// Stores the vectors of some lanes.
    #[inline(always)]
    pub(super) fn scatter<S: Simd>(&mut self, lanes: &Lanes, vectors: impl Three<S>) {
        if lanes.is_run && lanes.count == LANES {
            self.store(lanes.rays[0] as usize, vectors);
        } else {
            let [x, y, z] = vectors.three();
            for (lane, ray) in lanes.rays[..lanes.count].iter().enumerate() {
                let v = [x[lane], y[lane], z[lane]];
                for (column, component) in self.0.iter_mut().zip(v) {
                    column[*ray as usize] = component;
                }
            }
        }
    }

    pub(super) fn get(&self, at: usize) -> [f32; 3] {
        self.0.each_ref().map(|column| column[at])
    }
}

#[inline(always)]
pub(super) fn load<S: Simd>(simd: S, column: &Column<f32>, at: usize) -> Numbers<S> {
    Numbers::from_slice(simd, &column[at..at + LANES])
}

#[inline(always)]
pub(super) fn store<S: Simd>(column: &mut Column<f32>, at: usize, numbers: Numbers<S>) {
    numbers.store_slice(&mut column[at..at + LANES]);
}

/// Up to eight rays of a batch, anywhere in it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lanes {
    /// The rays; lanes beyond the last repeat one.
    rays: [u32; LANES],
    pub(super) count: usize,
    /// The rays follow one another, so that vectors can be loaded and stored.
    is_run: bool,
}

impl Lanes {
    #[inline(always)]
    fn gather<S: Simd>(&self, simd: S, column: &Column<f32>) -> Numbers<S> {
        if self.is_run {
            load(simd, column, self.rays[0] as usize)
        } else {
            // Not `map`, which may be left outside.
            let mut numbers = [0.0; LANES];
            for (number, ray) in numbers.iter_mut().zip(&self.rays) {
                *number = column[*ray as usize];
            }
            Numbers::from_array(simd, numbers)
        }
    }
}

/// The rays that hit one object: a range of [`Batch::order`].
#[derive(Clone, Debug)]
pub(super) struct Group {
    pub(super) object: u32,
    pub(super) range: Range<usize>,
}

/// Rays of one depth, column by column.
#[derive(Debug)]
pub(super) struct Batch {
    pub(super) len: usize,
    pub(super) origin: Columns,
    pub(super) direction: Columns,
    /// The side a ray leaves, as `Side::index` of the object's index among all objects.
    pub(super) leaves: Column<u32>,
    /// The ray of the batch above whose hit cast the ray.
    parent: Column<u32>,
    /// What the ray's colour is multiplied with there.
    weight: Column<f32>,
    /// The object it hits, or [`NOTHING`].
    pub(super) object: Column<u32>,
    pub(super) t: Column<f32>,
    pub(super) color: Columns,
    /// In a scene with a hierarchy, where shadow rays start from what it hits, and the normal there; no normal for no
    /// rays.
    pub(super) outside: Columns,
    pub(super) normal: Columns,
    /// Which lights reach it: a bit for each.
    pub(super) lit: Column<u32>,
    /// The rays that hit something, object by object.
    order: Column<u32>,
    pub(super) groups: Vec<Group>,
    /// Neighbours that hit the same object, and which that is.
    runs: Vec<(u32, Range<u32>)>,
    /// In a scene with a hierarchy.
    pub(super) room: WalkRoom,
}

impl Batch {
    pub(super) fn new() -> Self {
        Self {
            len: 0,
            origin: Columns::new(),
            direction: Columns::new(),
            leaves: column(),
            parent: column(),
            weight: column(),
            object: column(),
            t: column(),
            color: Columns::new(),
            outside: Columns::new(),
            normal: Columns::new(),
            lit: column(),
            order: column(),
            groups: Vec::new(),
            runs: Vec::with_capacity(CAPACITY),
            room: WalkRoom::new(),
        }
    }

    /// There may not be room for the rays that eight hits cast.
    pub(super) fn is_full(&self) -> bool {
        self.len > CAPACITY - 2 * LANES
    }

    /// Adds the rays of some lanes, among those of `parents`.
    #[inline(always)]
    pub(super) fn push<S: Simd>(
        &mut self,
        rays: &Rays<S>,
        leaves: Indices<S>,
        weight: f32,
        parents: &Lanes,
        lanes: Mask<S>,
    ) {
        let lanes = lanes.to_bitmask();
        let count = lanes.count_ones() as usize;
        let at = self.len;
        self.origin.store(at, rays.origin);
        self.direction.store(at, rays.direction);
        leaves.store_slice(&mut self.leaves[at..at + LANES]);
        self.parent[at..at + LANES].copy_from_slice(&parents.rays);
        self.weight[at..at + LANES].fill(weight);
        if lanes != (1 << count) - 1 {
            // Close the gaps.
            for (to, lane) in (0..LANES).filter(|lane| lanes >> lane & 1 != 0).enumerate() {
                let (from, to) = (at + lane, at + to);
                for column in self.origin.0.iter_mut().chain(&mut self.direction.0) {
                    column[to] = column[from];
                }
                self.leaves[to] = self.leaves[from];
                self.parent[to] = self.parent[from];
            }
        }
        self.len += count;
    }

    /// Sorts the rays by the object they hit. `counts` holds a 0 for each object, before and after.
    #[inline(always)]
    pub(super) fn group<S: Simd>(&mut self, simd: S, counts: &mut [u32]) {
        self.groups.clear();
        self.find_runs(simd);
        for (object, run) in &self.runs {
            if let Some(count) = counts.get_mut(*object as usize) {
                if *count == 0 {
                    self.groups.push(Group {
                        object: *object,
                        range: 0..0,
                    });
                }
                *count += run.len() as u32;
            }
        }
        let mut start = 0;
        for group in &mut self.groups {
            let count = &mut counts[group.object as usize];
            group.range = start..start + *count as usize;
            *count = start as u32;
            start = group.range.end;
        }
        for (object, run) in &self.runs {
            if let Some(place) = counts.get_mut(*object as usize) {
                let slots = &mut self.order[*place as usize..][..run.len()];
                for (slot, ray) in slots.iter_mut().zip(run.start..) {
                    *slot = ray;
                }
                *place += run.len() as u32;
            }
        }
        for group in &self.groups {
            counts[group.object as usize] = 0;
        }
    }

    /// Finds the runs of neighbours that hit the same object.
    #[inline(always)]
    fn find_runs<S: Simd>(&mut self, simd: S) {
        self.runs.clear();
        let mut start = 0;
        for at in (0..self.len).step_by(LANES) {
            let objects = Indices::from_slice(simd, &self.object[at..at + LANES]);
            let next = Indices::from_slice(simd, &self.object[at + 1..at + 1 + LANES]);
            let mut ends = !objects.simd_eq(next).to_bitmask() & ((1 << LANES) - 1);
            if self.len - at <= LANES {
                // Whatever comes after the last ray, it ends a run.
                let last = 1 << (self.len - at - 1);
                ends = ends & (last - 1) | last;
            }
            while ends != 0 {
                let last = at + ends.trailing_zeros() as usize;
                ends &= ends - 1;
                let run = start..last as u32 + 1;
                start = run.end;
                self.runs.push((self.object[last], run));
            }
        }
    }

    /// The next rays of a range of the order.
    #[inline(always)]
    pub(super) fn lanes(&self, range: Range<usize>) -> Lanes {
        let count = range.len().min(LANES);
        let mut rays = [0; LANES];
        rays.copy_from_slice(&self.order[range.start..range.start + LANES]);
        let (first, last) = (rays[0], rays[count - 1]);
        let is_run = last - first == count as u32 - 1;
        if count < LANES {
            rays[count..].fill(last);
        }
        Lanes {
            rays,
            count,
            is_run,
        }
    }

    #[inline(always)]
    pub(super) fn rays<S: Simd>(&self, simd: S, lanes: &Lanes) -> Rays<S> {
        if lanes.is_run {
            let at = lanes.rays[0] as usize;
            return Rays {
                origin: self.origin.load(simd, at),
                direction: self.direction.load(simd, at),
            };
        }
        Rays {
            origin: self.origin.gather(simd, lanes),
            direction: self.direction.gather(simd, lanes),
        }
    }

    #[inline(always)]
    pub(super) fn distances<S: Simd>(&self, simd: S, lanes: &Lanes) -> Numbers<S> {
        lanes.gather(simd, &self.t)
    }

    /// The lanes that a light of a number below 32 reaches.
    #[inline(always)]
    pub(super) fn lit<S: Simd>(&self, simd: S, lanes: &Lanes, light: usize) -> Mask<S> {
        let mut lit = [0; LANES];
        for (lit, ray) in lit.iter_mut().zip(&lanes.rays) {
            *lit = self.lit[*ray as usize] >> light & 1;
        }
        Indices::simd_from(simd, lit).simd_eq(1)
    }

    /// Lets rays hit nothing.
    pub(super) fn forget(&mut self, lanes: &Lanes) {
        for ray in &lanes.rays[..lanes.count] {
            self.object[*ray as usize] = NOTHING;
        }
    }

    /// Adds the colours of the rays to those of the hits that cast them, mirror rays first as they were
    /// cast, and removes them.
    #[inline(always)]
    pub(super) fn add_to<S: Simd>(&mut self, simd: S, above: &mut Self) {
        let neighbors = Indices::simd_from(simd, [0, 1, 2, 3, 4, 5, 6, 7]);
        for at in (0..self.len).step_by(LANES) {
            let count = (self.len - at).min(LANES);
            let first = self.parent[at];
            let parents = Indices::from_slice(simd, &self.parent[at..at + LANES]);
            if count == LANES && parents.simd_eq(neighbors + first).all_true() {
                let color: Colors<S> = self.color.load(simd, at);
                let sum: Colors<S> = above.color.load(simd, first as usize);
                let weight = load(simd, &self.weight, at);
                above.color.store(first as usize, sum + color * weight);
                continue;
            }
            for ray in at..at + count {
                let parent = self.parent[ray] as usize;
                for (sum, color) in above.color.0.iter_mut().zip(&self.color.0) {
                    sum[parent] += color[ray] * self.weight[ray];
                }
            }
        }
        self.len = 0;
    }

    /// Clamps the colours of hits; those of the background stay as they are.
    #[inline(always)]
    pub(super) fn clamp<S: Simd>(&mut self, simd: S) {
        for at in (0..self.len).step_by(LANES) {
            let color: Colors<S> = self.color.load(simd, at);
            let object = Indices::from_slice(simd, &self.object[at..at + LANES]);
            let clamped = Colors::select(object.simd_eq(NOTHING), color, clamp(color));
            self.color.store(at, clamped);
        }
    }
}
