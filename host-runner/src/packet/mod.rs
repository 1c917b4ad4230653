//! Eight rays at a time: the pictures of `Tracer<f32>`, to the bit, on machines with wide vectors.
//!
//! The core follows one ray after the other, depth first. Here all rays of one depth are traced
//! together, eight in a vector: the primary rays of a stretch of a row, then the rays that their hits
//! cast, and so on. Hits are sorted by object before they are shaded, so that the lanes of a vector
//! agree about what to do and stay full; the colours then go back up, in the order in which the core
//! adds them. Where a batch is full before all rays of a depth are cast, it is traced to its end at
//! once, which bounds the memory at any depth.
//!
//! A lane has the bits of the core, because it calls the core's own [formulas](scanray::formula), a lane does not know
//! of its neighbours, and the rays of a vector leave the same side, so that they are tested against the core's own
//! candidates. In a scene with a hierarchy all objects are candidates and the rays of a vector are neighbours that
//! may leave any sides ([`bvh`]). What decides between formulas as which function of the core does is named beside it.
//!
//! A new shape has its functions in a file of [`shapes`] and stands in the list there.

mod batch;
mod bvh;
mod lanes;
mod shade;
mod shapes;
#[cfg(test)]
mod tests;

use std::sync::{Mutex, MutexGuard, PoisonError};

use fearless_simd::Level;
use fearless_simd::prelude::*;
use scanray::accel::Candidates;
use scanray::formula::{camera, shading};
use scanray::shape::ObjectInfo;
use scanray::{
    Background, Color, Material, Resolution, Stages, Tracer, accel::ObjectSet, ray::Side,
    tracer::Scanline,
};

use crate::host_tracer::SampleRow;

use batch::{Batch, CAPACITY, MOST_LIGHTS, NOTHING, NOWHERE};
use bvh::PacketBvh;
use lanes::{Colors, InLanes, Indices, LANES, Mask, Numbers, Rays, Vec3s};
use shapes::{Among, Intersection, LaneObject, Shapes};

/// Traces eight rays at a time through a scene, which it has made lists of.
#[derive(Debug)]
pub(crate) struct PacketTracer<'a, const STACK: usize> {
    tracer: Tracer<'a, f32, { Stages::ALL.union(Stages::BVH).bits() }, STACK>,
    level: Level,
    shapes: Shapes<'a>,
    /// All objects, in the order of their numbers.
    objects: Vec<Target<'a>>,
    /// All shapes of the scene have lanes, and no light is on a surface, which lanes do not ask; otherwise the core draws it.
    has_lanes: bool,
    /// Of a large scene.
    bvh: Option<PacketBvh<'a>>,
    /// Of threads that do not trace at the moment.
    idle: Mutex<Vec<Workspace>>,
}

/// What a thread needs to trace.
#[derive(Debug)]
struct Workspace {
    /// One for each depth.
    batches: Vec<Batch>,
    /// A 0 for each object, to count hits.
    counts: Vec<u32>,
}

/// An object with what shading needs to know of it.
#[derive(Debug)]
struct Target<'a> {
    object: LaneObject<'a>,
    material: Option<&'a Material>,
    casts_shadow: bool,
    /// Of its front and its back.
    reach: [&'a Candidates; 2],
    /// What rays can hit that leave them in any direction: those of a vector have several.
    near: [ObjectSet; 2],
}

impl<'a, const STACK: usize> PacketTracer<'a, STACK> {
    /// A tracer of the same pictures.
    pub(crate) fn new(
        tracer: Tracer<'a, f32, { Stages::ALL.union(Stages::BVH).bits() }, STACK>,
    ) -> Self {
        let scene = *tracer.scene();
        let material = |surface: ObjectInfo| scene.materials().get(surface.material as usize);
        let reach = |side: Side| {
            scene
                .accel()
                .sides()
                .get(side.index())
                .unwrap_or(&Candidates::ALL)
        };
        let mut packets = Self {
            tracer,
            level: Level::new(),
            shapes: Shapes::default(),
            objects: Vec::with_capacity(scene.object_count()),
            has_lanes: !scene.has_light_on_surface(),
            bvh: None,
            idle: Mutex::default(),
        };
        let objects = (0..scene.object_count()).filter_map(|index| scene.object(index));
        for (index, object) in (0..).zip(objects) {
            let material = material(object.info());
            let casts_shadow = material.is_none_or(Material::casts_shadow);
            let Some(object) = LaneObject::of(object) else {
                packets.has_lanes = false;
                break;
            };
            packets.shapes.add(object.clone(), index, casts_shadow);
            let sides = [true, false].map(|front| reach(Side::new(index, front)));
            packets.objects.push(Target {
                object,
                material,
                casts_shadow,
                reach: sides,
                near: sides.map(Candidates::near_in_any_direction),
            });
        }
        if packets.has_lanes {
            packets.bvh = PacketBvh::new(&packets, bvh::FEWEST_FOR_SINGLES);
        }
        packets
    }

    /// The linear colours at a place in pixels of a row: those of `Tracer::sample_observed`.
    pub(crate) fn sample_row(&self, places: SampleRow, colors: &mut [Color]) {
        let scene = self.tracer.scene();
        let is_bvh_missing = scene.accel().bvh().is_some()
            && (self.bvh.is_none() || scene.lights().len() > MOST_LIGHTS);
        if !self.has_lanes || is_bvh_missing {
            return self.row_by_core(places, colors);
        }
        // Not on SSE 4.2, too: each level is compiled for itself, and takes a fifth of the time that building the program takes.
        #[cfg(target_arch = "x86_64")]
        if let Some(simd) = self.level.as_avx2() {
            return self.row_on(simd, places, colors);
        }
        #[cfg(target_arch = "aarch64")]
        if let Some(simd) = self.level.as_neon() {
            return self.row_on(simd, places, colors);
        }
        self.row_by_core(places, colors);
    }

    fn row_by_core(&self, places: SampleRow, colors: &mut [Color]) {
        // Without wide vectors the core is the fastest, and less to compile.
        let SampleRow { x, step, y, at } = places;
        let scanline = self.tracer.scanline_at(y, at);
        for (x, color) in (x..=u16::MAX).step_by(step.into()).zip(colors) {
            *color = self.tracer.sample_observed(&scanline, x, at, &mut ());
        }
    }

    /// [`PacketTracer::sample_row`] with vectors.
    fn row_on<S: Simd>(&self, simd: S, places: SampleRow, colors: &mut [Color]) {
        let mut workspace = self.workspaces().pop().unwrap_or_else(|| Workspace {
            batches: (0..=self.tracer.max_depth())
                .map(|_| Batch::new())
                .collect(),
            counts: vec![0; self.objects.len()],
        });
        let scanline = self.tracer.scanline_at(places.y, places.at);
        for (stretch, colors) in colors.chunks_mut(CAPACITY).enumerate() {
            simd.vectorize(
                #[inline(always)]
                || {
                    let start = stretch * CAPACITY;
                    self.stretch(simd, &mut workspace, places, start, &scanline, colors);
                },
            );
        }
        self.workspaces().push(workspace);
    }

    fn workspaces(&self) -> MutexGuard<'_, Vec<Workspace>> {
        self.idle.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Traces the places of a row from the one numbered `start` on, as many as a batch holds.
    #[inline(always)]
    fn stretch<S: Simd>(
        &self,
        simd: S,
        Workspace { batches, counts }: &mut Workspace,
        places: SampleRow,
        start: usize,
        scanline: &Scanline,
        colors: &mut [Color],
    ) {
        let Resolution { width, height } = self.tracer.resolution();
        let origin = Vec3s::in_every_lane(simd, self.tracer.scene().camera().position);
        let batch = &mut batches[0];
        for at in (0..colors.len()).step_by(LANES) {
            // `Camera::ray_at`.
            let of = i32::from(places.at.of);
            let column = Numbers::from_fn(simd, |lane| {
                let pixel =
                    i32::from(places.x) + (start + at + lane) as i32 * i32::from(places.step);
                let column = pixel * of + i32::from(places.at.column);
                (2 * column + 1 - i32::from(width) * of) as f32
            });
            let direction = camera::direction(
                column,
                Numbers::splat(simd, (i32::from(height) * of) as f32),
                Numbers::splat(simd, scanline.image_plane_y()),
            );
            batch.origin.store(at, origin);
            batch.direction.store(at, direction);
        }
        batch.leaves[..colors.len()].fill(NOWHERE);
        batch.len = colors.len();
        self.trace(simd, batches, counts, scanline.visible());
        for (at, color) in colors.iter_mut().enumerate() {
            let [r, g, b] = batches[0].color.get(at);
            *color = Color::new(r, g, b);
        }
    }

    /// Traces a batch of rays to the end and finds their colours. The batches below are empty before
    /// and after; their number is that of further secondary rays that may follow one another.
    fn trace<S: Simd>(
        &self,
        simd: S,
        batches: &mut [Batch],
        counts: &mut [u32],
        visible: ObjectSet,
    ) {
        simd.vectorize(
            #[inline(always)]
            || {
                let Some((batch, below)) = batches.split_first_mut() else {
                    return;
                };
                let mut at = 0;
                while at < batch.len {
                    at += match &self.bvh {
                        Some(bvh) if bvh.has_singles() => {
                            self.hit_by_bvh::<S, true>(simd, bvh, batch, at)
                        }
                        Some(bvh) => self.hit_by_bvh::<S, false>(simd, bvh, batch, at),
                        None => self.hit(simd, batch, at, visible),
                    };
                }
                batch.group(simd, counts);
                let groups = std::mem::take(&mut batch.groups);
                if let Some(bvh) = &self.bvh {
                    if bvh.has_singles() {
                        self.cast_shadows::<S, true>(simd, bvh, batch, &groups);
                    } else {
                        self.cast_shadows::<S, false>(simd, bvh, batch, &groups);
                    }
                }
                for group in &groups {
                    for start in group.range.clone().step_by(LANES) {
                        if let Some(next) = below.first()
                            && next.is_full()
                        {
                            self.trace(simd, below, counts, visible);
                            below[0].add_to(simd, batch);
                        }
                        let lanes = batch.lanes(start..group.range.end);
                        self.shade(simd, group.object, batch, &lanes, below.first_mut());
                    }
                }
                if let Some(next) = below.first()
                    && next.len > 0
                {
                    self.trace(simd, below, counts, visible);
                    below[0].add_to(simd, batch);
                }
                batch.groups = groups;
                batch.clamp(simd);
            },
        )
    }

    /// Finds the nearest hits of the next rays of a batch that leave the same side, up to eight, and the
    /// colours of those without; returns their number. `Tracer::closest` and `Tracer::background`.
    fn hit<S: Simd>(&self, simd: S, batch: &mut Batch, at: usize, visible: ObjectSet) -> usize {
        simd.vectorize(
            #[inline(always)]
            || {
                let rays = Rays {
                    origin: batch.origin.load(simd, at),
                    direction: batch.direction.load(simd, at),
                };
                let leaves = batch.leaves[at];
                let candidates = match self.objects.get(leaves as usize >> 1) {
                    Some(target) => target.near[leaves as usize & 1],
                    None => visible,
                };
                let mut closest = Closest::none(simd);
                let among = Among::Set(candidates);
                self.shapes
                    .hit(simd, &rays, leaves >> 1, among, &mut closest);
                self.keep(simd, &closest, rays.direction, batch, at);
                let sides = Indices::from_slice(simd, &batch.leaves[at..at + LANES]);
                let same = sides.simd_eq(leaves).to_bitmask().trailing_ones() as usize;
                same.min(batch.len - at)
            },
        )
    }

    /// Puts the nearest hits of eight rays into a batch, and the colours of those that hit nothing.
    #[inline(always)]
    fn keep<S: Simd>(
        &self,
        simd: S,
        closest: &Closest<S>,
        direction: Vec3s<S>,
        batch: &mut Batch,
        at: usize,
    ) {
        closest
            .object
            .store_slice(&mut batch.object[at..at + LANES]);
        batch::store(&mut batch.t, at, closest.t);
        if closest.object.simd_eq(NOTHING).any_true() {
            let colors = self.background(simd, direction);
            batch.color.store(at, colors);
        }
    }

    /// `Tracer::background`.
    #[inline(always)]
    fn background<S: Simd>(&self, simd: S, direction: Vec3s<S>) -> Colors<S> {
        let Background { color, sky } = self.tracer.scene().background();
        if sky {
            shading::sky(direction.y)
        } else {
            Colors::in_every_lane(simd, color.clamp())
        }
    }
}

/// The closest intersection of each ray so far. `Closest` of the core.
#[derive(Clone, Copy)]
struct Closest<S: Simd> {
    t: Numbers<S>,
    object: Indices<S>,
}

impl<S: Simd> Closest<S> {
    #[inline(always)]
    fn none(simd: S) -> Self {
        Self {
            t: Numbers::splat(simd, f32::MAX),
            object: Indices::splat(simd, NOTHING),
        }
    }

    /// Takes the intersections with an object that come first. `Closest::offer` of the core.
    #[inline(always)]
    fn offer(&mut self, simd: S, intersection: &Intersection<S>, object: u32) {
        let t = intersection.t;
        let first = Indices::splat(simd, object).simd_lt(self.object);
        let closer = t.simd_lt(self.t) | (t.simd_eq(self.t) & first);
        let closer: Mask<S> = intersection.lanes & t.simd_gt(0.0) & closer;
        self.t = Numbers::select(closer, t, self.t);
        self.object = closer.select(Indices::splat(simd, object), self.object);
    }
}
