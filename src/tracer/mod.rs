//! The tracer: from a ray to a linear colour.

mod bvh;
mod cutoff;
mod observer;
mod shade;
mod stack;

pub use observer::{Intersection, LightAtHit, Observer, RayCount, RayKind, TestKind, WorkCount};

use core::fmt;

use crate::accel::{Candidates, Cell, Members, ObjectSet, visible_in_row};
use crate::background::Background;
use crate::camera::{Resolution, Subpixel};
use crate::color::Color;
use crate::material::{Interface, Material};
use crate::ray::{Ray, Side};
use crate::scalar::Scalar;
use crate::scene::Scene;
use crate::shape::{
    self, Barycentric, Geometry, Kind, ListedShape, Object, ObjectInfo, Primitive, Stored,
    StoredObject, StoredShape, SurfacePoint, for_each_shape, for_each_stored_shape,
};
use crate::stages::Stages;
use crate::vec3::Vec3;
use stack::{Level, Pending, Refracted, Stack, Throughputs};

/// How many secondary rays may follow one another unless the tracer is told otherwise.
pub const DEFAULT_MAX_DEPTH: usize = 5;

/// Every stage of a small scene, and the hierarchy.
const ALL_AND_BVH: u64 = Stages::ALL.union(Stages::BVH).bits();

/// Whether a stage is compiled.
#[inline(always)]
const fn stage(needs: u64, stage: Stages) -> bool {
    Stages::from_bits(needs).contains(stage)
}

/// Whether any stage of several is compiled.
#[inline(always)]
const fn any_stage(needs: u64, stages: Stages) -> bool {
    stages.without(Stages::from_bits(needs)).bits() != stages.bits()
}

/// Traces rays through a scene.
///
/// `STAGES` are the stages that are compiled, `STACK` is the number of frames that stand for the
/// recursion. Neither is written by hand: [`Tracer::new`] compiles all stages that a small scene may need for
/// [`DEFAULT_MAX_DEPTH`], [`tracer_for!`](crate::tracer_for) those that a `static` scene needs, and
/// methods change the rest. For pools with room for a hierarchy there is [`Tracer::with_bvh`].
///
/// ```
/// use scanray::{ScenePools, Tracer};
///
/// let mut pools: ScenePools = ScenePools::new();
/// # #[cfg(feature = "parser")]
/// pools.parse(include_bytes!("../../scenes/default.txt"))?;
/// let tracer = Tracer::new(pools.as_scene());
/// let deeper = tracer.with_stack::<16>().with_max_depth(16)?;
/// assert_eq!(deeper.max_depth(), 16);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Tracer<
    'a,
    T = f32,
    const STAGES: u64 = { Stages::ALL.bits() },
    const STACK: usize = DEFAULT_MAX_DEPTH,
> {
    /// Its resolution is that of the picture.
    scene: Scene<'a, T>,
    max_depth: usize,
    /// Of no effect without [`Stages::CUTOFF`].
    cutoff: T,
}

/// `max_depth` is larger than the stack the tracer was compiled for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DepthError {
    /// What was asked for.
    pub max_depth: usize,
    /// What there are frames for.
    pub stack: usize,
}

impl fmt::Display for DepthError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "a maximum depth of {} needs more than the {} stack frames compiled in (Tracer::with_stack)",
            self.max_depth, self.stack
        )
    }
}

impl core::error::Error for DepthError {}

/// A scene needs stages that the tracer was compiled without.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MissingStages(pub Stages);

impl fmt::Display for MissingStages {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "the scene needs stages that are not compiled in: {}",
            self.0
        )
    }
}

impl core::error::Error for MissingStages {}

/// An intersection of a ray with a surface, ready for shading.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Hit<'a, T> {
    /// The side the ray comes from.
    facing: Side,
    /// What rays can hit that leave that side.
    candidates: &'a Candidates,
    /// The cell of the plane's grid, if it lies in one.
    cell: Option<Cell<'a>>,
    material: &'a Material<T>,
    /// Unit normal on the side the ray comes from.
    normal: Vec3<T>,
    /// `−normal·direction`, at least 0.
    cosine: T,
    /// The geometric normal faces the ray.
    entering: bool,
    /// Where rays start that stay on the side the ray comes from.
    outside: Vec3<T>,
    /// Where rays start that pass the surface.
    inside: Vec3<T>,
}

/// What the pixels of a row have in common: a caller that draws row by row computes it once.
#[derive(Clone, Copy, Debug)]
pub struct Scanline<T = f32> {
    image_plane_y: T,
    visible: ObjectSet,
}

impl<T: Scalar> Scanline<T> {
    /// The objects that primary rays of the row can hit.
    pub fn visible(&self) -> ObjectSet {
        self.visible
    }

    /// `y` of its primary rays before normalisation.
    pub fn image_plane_y(&self) -> T {
        self.image_plane_y
    }
}

/// The object a ray hits first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nearest<'a, T = f32> {
    /// Distance along the ray, greater than 0.
    pub t: T,
    /// What is there.
    pub object: Object<'a, T>,
    /// The object's index among all objects.
    pub index: usize,
}

/// The closest intersection so far.
#[derive(Clone, Copy)]
struct Closest<T> {
    /// Distance along the ray; the largest number if there is no intersection yet.
    t: T,
    /// Index of the object among all objects; beyond all if there is none.
    index: usize,
    /// Where on it, if it is a triangle.
    place: Barycentric<T>,
}

impl<T: Scalar> Closest<T> {
    const NONE: Self = Self {
        t: T::MAX,
        index: usize::MAX,
        place: Barycentric::ZERO,
    };

    /// Takes a hit if it comes before the closest so far, and tells whether it did: of two at exactly the same distance that of the smaller index,
    /// whatever the order in which they are offered.
    #[inline(always)]
    fn offer(&mut self, t: T, index: usize) -> bool {
        let is_closer = t.is_before(self.t) || (t == self.t && index < self.index);
        if is_closer {
            (self.t, self.index) = (t, index);
        }
        is_closer
    }
}

impl<'a, T: Scalar> Tracer<'a, T> {
    /// A tracer with all stages but the hierarchy, [`DEFAULT_MAX_DEPTH`] and the scene's own resolution.
    pub const fn new(scene: Scene<'a, T>) -> Self {
        Self::with_stages(scene)
    }
}

impl<'a, T: Scalar, const STACK: usize> Tracer<'a, T, { Stages::ALL.bits() }, STACK> {
    /// The same tracer, to draw large scenes the faster way: by the hierarchy that the scene has if its pools
    /// have room for one ([`ScenePools`](crate::ScenePools)). Without this every ray is tested against
    /// every object of such a scene, with the same bits; other scenes are drawn as before.
    ///
    /// A [cut-off](Tracer::with_cutoff) is asked for after the hierarchy.
    pub const fn with_bvh(self) -> Tracer<'a, T, ALL_AND_BVH, STACK> {
        Tracer {
            scene: self.scene,
            max_depth: self.max_depth,
            cutoff: self.cutoff,
        }
    }
}

impl<'a, T: Scalar, const STAGES: u64, const STACK: usize> Tracer<'a, T, STAGES, STACK> {
    /// Bytes of each of the `STACK` frames, with room for the refracted ray of each, which are on the call
    /// stack while a ray is traced.
    pub const FRAME_BYTES: usize = size_of::<Level<T>>() + size_of::<Refracted<T>>();

    /// Stages and stack as the type says, unchecked: stages the scene needs beyond `STAGES` are simply
    /// not drawn.
    #[doc(hidden)]
    pub const fn with_stages(scene: Scene<'a, T>) -> Self {
        Self {
            scene,
            max_depth: if STACK < DEFAULT_MAX_DEPTH {
                STACK
            } else {
                DEFAULT_MAX_DEPTH
            },
            cutoff: T::ZERO,
        }
    }

    /// The same tracer with `FRAMES` frames; the maximum depth shrinks with them if it must.
    pub const fn with_stack<const FRAMES: usize>(self) -> Tracer<'a, T, STAGES, FRAMES> {
        Tracer {
            scene: self.scene,
            max_depth: if self.max_depth < FRAMES {
                self.max_depth
            } else {
                FRAMES
            },
            cutoff: self.cutoff,
        }
    }

    /// The same tracer with another maximum depth: 0 casts primary rays alone.
    ///
    /// # Errors
    ///
    /// [`DepthError`] when the stack has fewer frames.
    pub const fn with_max_depth(mut self, max_depth: usize) -> Result<Self, DepthError> {
        if max_depth > STACK {
            return Err(DepthError {
                max_depth,
                stack: STACK,
            });
        }
        self.max_depth = max_depth;
        Ok(self)
    }

    /// The same tracer with another size of the picture; what is seen keeps its height.
    pub const fn with_resolution(mut self, resolution: Resolution) -> Self {
        self.scene.resolution = resolution;
        self
    }

    /// The scene.
    pub const fn scene(&self) -> &Scene<'a, T> {
        &self.scene
    }

    /// Size of the picture.
    #[inline(always)]
    pub const fn resolution(&self) -> Resolution {
        self.scene.resolution
    }

    /// How many secondary rays may follow one another.
    pub const fn max_depth(&self) -> usize {
        self.max_depth
    }

    /// The stages that are compiled.
    pub const fn stages(&self) -> Stages {
        Stages::from_bits(STAGES)
    }

    /// No pixel casts more rays than this: a full binary tree of secondary rays, and from each hit one
    /// shadow ray a light.
    pub fn max_rays_per_pixel(&self) -> u64 {
        let hits = (2_u64 << self.max_depth.min(40)) - 1;
        hits.saturating_mul(1 + self.scene.lights.len() as u64)
    }

    /// The object a ray hits first; of several at exactly the same distance the first in the file.
    pub fn nearest(&self, ray: &Ray<T>) -> Option<Nearest<'a, T>> {
        let all = self.without_flat(ray.leaves.object() as usize, ObjectSet::ALL);
        let closest = self.closest(ray, all, &mut ());
        Some(Nearest {
            t: closest.t,
            object: self.scene.object(closest.index)?,
            index: closest.index,
        })
    }

    /// The members of a set, by their indices.
    #[inline(always)]
    fn members(&self, set: ObjectSet) -> Members {
        set.members_among(stage(STAGES, Stages::MANY_OBJECTS))
    }

    #[inline(always)]
    fn closest(
        &self,
        ray: &Ray<T>,
        candidates: ObjectSet,
        observer: &mut impl Observer<T>,
    ) -> Closest<T> {
        let mut closest = Closest::NONE;
        if self.has_bvh() {
            self.closest_in_bvh(ray, &mut closest, observer);
            return closest;
        }
        let mut members = self.members(self.without_left(ray, candidates));
        let mut first = 0;
        macro_rules! closest_of_each {
            ([$($shape:ident)*]) => {
                $(first = self.closest_of::<shape::$shape<T>>(first, &mut members, ray, &mut closest, observer);)*
            };
        }
        for_each_shape!(closest_of_each);
        if any_stage(STAGES, Stages::STORED_SHAPES) {
            let stored = &self.scene.geometry.stored;
            members.walk(
                first..first + stored.entries.len(),
                true,
                |index| stored.get(index.wrapping_sub(first)),
                |index, object| {
                    self.offer_stored(index, object, ray, &mut closest, observer);
                    false
                },
            );
        }
        let _ = first;
        closest
    }

    /// Makes the closest of the members of one shape, whose indices begin at `first`, the closest; gives the index behind
    /// them.
    #[inline(always)]
    fn closest_of<P: ListedShape<T>>(
        &self,
        first: usize,
        members: &mut Members,
        ray: &Ray<T>,
        closest: &mut Closest<T>,
        observer: &mut impl Observer<T>,
    ) -> usize {
        if !stage(STAGES, P::STAGE) {
            return first;
        }
        let all = P::all(&self.scene.geometry);
        members.walk(
            first..first + all.len(),
            stage(STAGES, P::SEVERAL),
            |index| all.get(index.wrapping_sub(first)),
            |index, object| {
                observer.test_object(object.object(), ray, closest.t);
                // Indices ascend: of two at one distance the first stays.
                if let Some((t, place)) = object.hit(ray, closest.t)
                    && t.is_before(closest.t)
                    && !self.is_left::<P>(ray, index)
                {
                    (closest.t, closest.index) = (t, index);
                    if P::HAS_PLACE {
                        closest.place = place;
                    }
                }
                false
            },
        );
        first + all.len()
    }

    /// Makes a stored object the closest if it is.
    #[inline(always)]
    fn offer_stored(
        &self,
        index: usize,
        object: StoredObject<'_, T>,
        ray: &Ray<T>,
        closest: &mut Closest<T>,
        observer: &mut impl Observer<T>,
    ) {
        macro_rules! of_kind {
            ([$($shape:ident)*]) => {
                match object.entry.kind {
                    $(Kind::$shape if stage(STAGES, <shape::$shape<T> as Primitive<T>>::STAGE) => {
                        observer.test_object(Object::Stored(object), ray, closest.t);
                        self.offer(index, &<shape::$shape<T>>::of(object), ray, closest);
                    })*
                    _ => {}
                }
            };
        }
        for_each_stored_shape!(of_kind)
    }

    /// Makes an object the closest if it is.
    #[inline(always)]
    fn offer<P: Primitive<T>>(
        &self,
        index: usize,
        object: &P,
        ray: &Ray<T>,
        closest: &mut Closest<T>,
    ) {
        if let Some((t, place)) = object.hit(ray, closest.t)
            && !self.is_left::<P>(ray, index)
            && closest.offer(t, index)
            && P::HAS_PLACE
        {
            closest.place = place;
        }
    }

    /// Whether a stored object casts a shadow on a ray.
    #[inline(always)]
    fn is_occluded_by_stored(
        &self,
        index: usize,
        object: StoredObject<'_, T>,
        ray: &Ray<T>,
        t_max: T,
        observer: &mut impl Observer<T>,
    ) -> bool {
        macro_rules! of_kind {
            ([$($shape:ident)*]) => {
                match object.entry.kind {
                    $(Kind::$shape if stage(STAGES, <shape::$shape<T> as Primitive<T>>::STAGE) => {
                        observer.test_object(Object::Stored(object), ray, t_max);
                        self.is_occluded_by(index, &<shape::$shape<T>>::of(object), ray, t_max)
                    })*
                    _ => false,
                }
            };
        }
        for_each_stored_shape!(of_kind)
    }

    /// Whether an object that casts shadows lies on the ray within `0 < t < t_max`.
    pub fn occluded(&self, ray: &Ray<T>, t_max: T) -> bool {
        let all = self.without_flat(ray.leaves.object() as usize, ObjectSet::ALL);
        self.occluded_observed(ray, t_max, all, &mut ())
    }

    #[inline(always)]
    fn occluded_observed(
        &self,
        ray: &Ray<T>,
        t_max: T,
        candidates: ObjectSet,
        observer: &mut impl Observer<T>,
    ) -> bool {
        if self.has_bvh() {
            return self.occluded_in_bvh(ray, t_max, observer);
        }
        let mut members = self.members(self.without_left(ray, candidates));
        let mut first = 0;
        macro_rules! occluded_by_each {
            ([$($shape:ident)*]) => {
                $(
                    if self.occluded_by::<shape::$shape<T>>(first, &mut members, ray, t_max, observer) {
                        return true;
                    }
                    first += shape::$shape::all(&self.scene.geometry).len();
                )*
            };
        }
        for_each_shape!(occluded_by_each);
        if any_stage(STAGES, Stages::STORED_SHAPES) {
            let stored = &self.scene.geometry.stored;
            return members.walk(
                first..first + stored.entries.len(),
                true,
                |index| stored.get(index.wrapping_sub(first)),
                |index, object| self.is_occluded_by_stored(index, object, ray, t_max, observer),
            );
        }
        let _ = first;
        false
    }

    /// Whether a member of one shape, whose indices begin at `first`, casts a shadow.
    #[inline(always)]
    fn occluded_by<P: ListedShape<T>>(
        &self,
        first: usize,
        members: &mut Members,
        ray: &Ray<T>,
        t_max: T,
        observer: &mut impl Observer<T>,
    ) -> bool {
        if !stage(STAGES, P::STAGE) {
            return false;
        }
        let all = P::all(&self.scene.geometry);
        members.walk(
            first..first + all.len(),
            stage(STAGES, P::SEVERAL),
            |index| all.get(index.wrapping_sub(first)),
            |index, object| {
                observer.test_object(object.object(), ray, t_max);
                self.is_occluded_by(index, object, ray, t_max)
            },
        )
    }

    /// The objects of the shapes that are compiled.
    #[inline(always)]
    fn geometry(&self) -> Geometry<'a, T> {
        let mut geometry = self.scene.geometry;
        if !any_stage(STAGES, Stages::STORED_SHAPES) {
            geometry.stored = Stored::NONE;
        }
        geometry
    }

    /// Whether an object of a flat shape is the one that the ray leaves, which it cannot hit again whatever rounding says.
    /// Those that are told apart are not among the candidates.
    #[inline(always)]
    pub(super) fn is_left<P: Primitive<T>>(&self, ray: &Ray<T>, index: usize) -> bool {
        P::IS_FLAT && stage(STAGES, Stages::MANY_OBJECTS) && ray.leaves.object() as usize == index
    }

    /// Candidates without the object that the ray leaves, if it is flat.
    #[inline(always)]
    fn without_left(&self, ray: &Ray<T>, candidates: ObjectSet) -> ObjectSet {
        // What is known of its sides leaves it out already.
        if self.scene.accel.sides.is_empty() {
            self.without_flat(ray.leaves.object() as usize, candidates)
        } else {
            candidates
        }
    }

    /// Candidates without an object that is told apart, if it is flat.
    // Scenes that were loaded or baked do not come here.
    #[cold]
    #[inline(never)]
    fn without_flat(&self, index: usize, candidates: ObjectSet) -> ObjectSet {
        let is_flat = self.geometry().is_flat(index);
        if is_flat && index < ObjectSet::TOLD_APART {
            candidates.without(ObjectSet::NONE.with(index))
        } else {
            candidates
        }
    }

    /// Whether an object casts a shadow on a ray.
    #[inline(always)]
    fn is_occluded_by<P: Primitive<T>>(
        &self,
        index: usize,
        object: &P,
        ray: &Ray<T>,
        t_max: T,
    ) -> bool {
        object.occludes(ray, t_max)
            && !self.is_left::<P>(ray, index)
            && self
                .material(object.info())
                .is_none_or(Material::casts_shadow)
    }

    /// The point of a hit, its material, and the cell of a plane grid that it lies in.
    #[inline(always)]
    fn hit_point(
        &self,
        ray: &Ray<T>,
        closest: &Closest<T>,
    ) -> Option<(SurfacePoint<T>, ObjectInfo, Option<Cell<'a>>)> {
        let mut index = closest.index;
        macro_rules! among {
            ([$($shape:ident)*]) => {
                $(if stage(STAGES, <shape::$shape<T> as Primitive<T>>::STAGE) {
                    let all = <shape::$shape<T>>::all(&self.scene.geometry);
                    if let Some(object) = all.get(index) {
                        let point = object.point(ray, closest.t, closest.place);
                        let cell = match <shape::$shape<T> as Primitive<T>>::KIND {
                            Kind::Plane => self
                                .scene
                                .accel
                                .grids
                                .get(index)
                                .and_then(|grid| grid.cell(point.point)),
                            _ => None,
                        };
                        return Some((point, Primitive::info(object), cell));
                    }
                    index = index.wrapping_sub(all.len());
                })*
            };
        }
        for_each_shape!(among);
        if !any_stage(STAGES, Stages::STORED_SHAPES) {
            return None;
        }
        let object = self.scene.geometry.stored.get(index)?;
        macro_rules! of_kind {
            ([$($shape:ident)*]) => {
                match object.entry.kind {
                    $(Kind::$shape if stage(STAGES, <shape::$shape<T> as Primitive<T>>::STAGE) => {
                        <shape::$shape<T>>::of(object).point(ray, closest.t, closest.place)
                    })*
                    _ => return None,
                }
            };
        }
        Some((for_each_stored_shape!(of_kind), object.entry.info, None))
    }

    /// What rays can hit that leave a side of an object.
    #[inline(always)]
    fn candidates(&self, side: Side) -> &'a Candidates {
        #[cold]
        #[inline(never)]
        fn anything() -> &'static Candidates {
            &Candidates::ALL
        }
        match self.scene.accel.sides.get(side.index()) {
            Some(candidates) => candidates,
            None => anything(),
        }
    }

    #[inline(always)]
    fn material(&self, info: ObjectInfo) -> Option<&'a Material<T>> {
        self.scene.materials.get(info.material as usize)
    }

    /// The linear colour that a ray from outside the scene sees.
    pub fn radiance(&self, ray: Ray<T>) -> Color<T> {
        self.radiance_observed(ray, ObjectSet::ALL, &mut ())
    }

    /// [`Tracer::radiance`] of a ray that hits one of the candidates first if it hits anything, watched.
    ///
    /// Depth first over the tree of reflected and refracted rays (Whitted 1980), so that a hit's colour
    /// is clamped as soon as its secondary rays are known, as the recursive form would. The stack holds
    /// one frame a level, and there is no recursion.
    #[inline(always)]
    pub fn radiance_observed(
        &self,
        ray: Ray<T>,
        candidates: ObjectSet,
        observer: &mut impl Observer<T>,
    ) -> Color<T> {
        let mut stack = Stack::<T, STACK>::new();
        let mut pending = Pending::<T, STACK>::new();
        let mut ray = ray;
        let mut candidates = candidates;
        let mut kind = RayKind::Primary;
        let mut throughput = T::ONE;
        let mut allowance = self.cutoff;
        let mut throughputs = Throughputs::<T, STACK>::new();
        loop {
            observer.ray(kind, stack.len(), &ray);
            // What is known of the colour of the ray under way, whether that is a sum still to be clamped, and
            // whether a refracted ray of the same hit waits.
            let mut color;
            let (mut is_sum, mut refracts) = (false, false);
            match self.hit(&ray, candidates, observer) {
                None => color = self.background(ray.direction),
                Some(hit) => {
                    let mut weight = T::ZERO;
                    if stack.len() < self.max_depth {
                        let material = hit.material.description();
                        let mut shows = |weight| self.shows(throughput, weight, &mut allowance);
                        if stage(STAGES, Stages::REFLECTION) && shows(material.reflection) {
                            weight = material.reflection;
                        }
                        // The mirror ray is cast first, and the refracted one kept for later.
                        if stage(STAGES, Stages::REFRACTION)
                            && material.refraction.is_positive()
                            && shows(material.refraction)
                            && let Some(refracted) = self.refracted(&ray, &hit)
                        {
                            // There is room for it and for the frame, because `max_depth ≤ STACK`.
                            refracts = pending.push(refracted).is_ok();
                            if stage(STAGES, Stages::CUTOFF) {
                                let _ = throughputs.push(throughput);
                            }
                        }
                    }
                    color = self.local_color(&ray, &hit, stack.len(), observer);
                    observer.local_color(color);
                    if stage(STAGES, Stages::REFLECTION) && weight.is_positive() {
                        let _ = stack.push(Level {
                            color,
                            weight: if refracts { -weight } else { weight },
                        });
                        kind = RayKind::Reflected;
                        let direction = ray.direction.reflect_at(hit.normal, hit.cosine);
                        candidates = self.near(hit.candidates, hit.cell, direction);
                        ray = Ray {
                            origin: hit.outside,
                            direction,
                            leaves: hit.facing,
                        };
                        if stage(STAGES, Stages::CUTOFF) {
                            throughput = throughput * weight;
                        }
                        continue;
                    }
                    is_sum = true;
                }
            }
            // Hand the colour up, to the first hit that has a ray left to cast.
            loop {
                if is_sum {
                    if stage(STAGES, Stages::REFRACTION)
                        && refracts
                        && let Some(refracted) = pending.pop()
                    {
                        let weight = refracted.weight;
                        let _ = stack.push(Level { color, weight });
                        if stage(STAGES, Stages::CUTOFF)
                            && let Some(at_hit) = throughputs.pop()
                        {
                            throughput = at_hit * weight;
                        }
                        kind = RayKind::Refracted;
                        ray = refracted.ray;
                        candidates = refracted.candidates;
                        break;
                    }
                    color = color.clamp();
                }
                observer.result(color);
                let Some(frame) = stack.pop() else {
                    return color;
                };
                color = frame.color + color * frame.weight.abs();
                is_sum = true;
                refracts = frame.weight.is_negative();
            }
        }
    }

    /// The objects that a secondary ray can hit first that leaves a side in a direction.
    #[inline(always)]
    fn near(
        &self,
        candidates: &Candidates,
        cell: Option<Cell<'_>>,
        direction: Vec3<T>,
    ) -> ObjectSet {
        let near = candidates.near(direction);
        match cell {
            Some(cell) if stage(STAGES, Stages::PLANES) => near.intersection(cell.ahead(direction)),
            _ => near,
        }
    }

    /// The nearest hit, projected back onto its surface and turned to face the ray.
    #[inline(always)]
    fn hit(
        &self,
        ray: &Ray<T>,
        candidates: ObjectSet,
        observer: &mut impl Observer<T>,
    ) -> Option<Hit<'a, T>> {
        let closest = self.closest(ray, candidates, observer);
        let (point, info, cell) = self.hit_point(ray, &closest)?;
        let slope = ray.direction.component_along(point.normal);
        let entering = slope.is_zero_or_negative();
        let normal = if entering {
            point.normal
        } else {
            -point.normal
        };
        let facing = Side::new(closest.index as u32, entering);
        let hit = Hit {
            facing,
            candidates: self.candidates(facing),
            cell,
            material: self.material(info)?,
            normal,
            cosine: slope.abs(),
            entering,
            outside: point.point.moved_along(normal, point.offset),
            inside: point.point.moved_along(normal, -point.offset),
        };
        observer.intersection(&Intersection {
            side: hit.facing,
            number: info.number,
            t: closest.t,
            point: point.point,
            normal,
            material: hit.material.description(),
        });
        Some(hit)
    }

    /// The refracted ray of a hit, unless it is totally reflected.
    #[inline(always)]
    fn refracted(&self, ray: &Ray<T>, hit: &Hit<'a, T>) -> Option<Refracted<T>> {
        let direction = self.refracted_direction(ray, hit)?;
        let leaves = hit.facing.opposite();
        Some(Refracted {
            ray: Ray {
                origin: hit.inside,
                direction,
                leaves,
            },
            candidates: self.near(self.candidates(leaves), hit.cell, direction),
            weight: hit.material.description().refraction,
        })
    }

    /// Direction beyond the surface; `None` at total internal reflection.
    #[inline(always)]
    fn refracted_direction(&self, ray: &Ray<T>, hit: &Hit<'a, T>) -> Option<Vec3<T>> {
        // Index 1 passes straight through, to the bit.
        if !stage(STAGES, Stages::BENDING)
            || hit.material.description().index_of_refraction.is_one()
        {
            return Some(ray.direction);
        }
        let Interface { eta, bend } = if hit.entering {
            hit.material.entering()
        } else {
            hit.material.leaving()
        };
        ray.direction.refract_at(hit.normal, hit.cosine, eta, bend)
    }

    #[inline(always)]
    fn background(&self, direction: Vec3<T>) -> Color<T> {
        let background = &self.scene.background;
        if stage(STAGES, Stages::SKY)
            && (!stage(STAGES, Stages::PLAIN_BACKGROUND) || background.sky)
        {
            Background::sky(direction)
        } else {
            background.color.clamp()
        }
    }

    /// What the pixels of a row have in common.
    pub fn scanline(&self, y: u16) -> Scanline<T> {
        let image_plane_y = self.scene.camera.image_plane_y(self.scene.resolution, y);
        let half_width = self.scene.camera.half_width(self.scene.resolution);
        self.scanline_of(image_plane_y, half_width)
    }

    /// What the samples at a place in the pixels of a row have in common.
    pub fn scanline_at(&self, y: u16, at: Subpixel) -> Scanline<T> {
        let image_plane_y = self
            .scene
            .camera
            .image_plane_y_at(self.scene.resolution, y, at);
        let half_width = self.scene.camera.half_width_at(self.scene.resolution, at);
        self.scanline_of(image_plane_y, half_width)
    }

    #[inline(always)]
    fn scanline_of(&self, image_plane_y: T, half_width: T) -> Scanline<T> {
        Scanline {
            image_plane_y,
            visible: visible_in_row(
                &self.geometry(),
                &self.scene.camera,
                image_plane_y,
                half_width,
            ),
        }
    }

    /// The primary ray of a pixel; `x` must lie in the picture.
    #[inline(always)]
    pub fn primary_ray(&self, scanline: &Scanline<T>, x: u16) -> Ray<T> {
        self.primary_ray_at(scanline, x, Subpixel::CENTER)
    }

    /// The primary ray through a place in a pixel, for the scanline of that place.
    #[inline(always)]
    pub fn primary_ray_at(&self, scanline: &Scanline<T>, x: u16, at: Subpixel) -> Ray<T> {
        self.scene
            .camera
            .ray_at(self.scene.resolution, scanline.image_plane_y, x, at)
    }

    /// The linear colour of a pixel, each channel in 0…1: a pure function of scene, settings and
    /// coordinates.
    pub fn pixel(&self, x: u16, y: u16) -> Color<T> {
        self.pixel_observed(&self.scanline(y), x, &mut ())
    }

    /// A pixel of a row, watched.
    #[inline(always)]
    pub fn pixel_observed(
        &self,
        scanline: &Scanline<T>,
        x: u16,
        observer: &mut impl Observer<T>,
    ) -> Color<T> {
        self.sample_observed(scanline, x, Subpixel::CENTER, observer)
    }

    /// The linear colour at a place in a pixel, for the scanline of that place, watched.
    #[inline(always)]
    pub fn sample_observed(
        &self,
        scanline: &Scanline<T>,
        x: u16,
        at: Subpixel,
        observer: &mut impl Observer<T>,
    ) -> Color<T> {
        self.radiance_observed(
            self.primary_ray_at(scanline, x, at),
            scanline.visible,
            observer,
        )
    }
}

macro_rules! specialize {
    ($scalar:ty) => {
        impl<'a, const STAGES: u64, const STACK: usize> Tracer<'a, $scalar, STAGES, STACK> {
            /// The same tracer with only the stages of `KEPT`, for a scene that is known on the device
            /// but whose needs are known before.
            ///
            /// # Errors
            ///
            /// [`MissingStages`] when the scene needs more.
            pub const fn specialize<const KEPT: u64>(
                self,
            ) -> Result<Tracer<'a, $scalar, KEPT, STACK>, MissingStages> {
                let mut needs = self.scene.stages();
                if self.cutoff > 0.0 {
                    needs = needs.union(Stages::CUTOFF);
                }
                let missing = needs.without(Stages::from_bits(KEPT));
                if !missing.is_empty() {
                    return Err(MissingStages(missing));
                }
                Ok(Tracer {
                    scene: self.scene,
                    max_depth: self.max_depth,
                    cutoff: self.cutoff,
                })
            }
        }
    };
}

specialize!(f32);
specialize!(f64);

/// A tracer for a `static` scene with only the stages the scene needs, or for pools with those that a scene in them
/// can need.
///
/// `tracer_for!(SCENE)` compiles what the scene needs and frames for [`DEFAULT_MAX_DEPTH`];
/// `tracer_for!(SCENE, stack = 8)` has 8 frames; `tracer_for!(SCENE, cutoff = 1.0 / 256.0)` has a
/// [cut-off](Tracer::with_cutoff), with a stack or without; `tracer_for!(SCENE, stages = S)` compiles
/// exactly the stages `S`:
///
/// ```
/// # use scanray::*;
/// static EMPTY: Scene<'static> = Scene::EMPTY
///     .with_resolution(Resolution { width: 4, height: 3 })
///     .with_background(Background { color: Color::new(0.5, 0.5, 1.0), sky: true });
/// let tracer = tracer_for!(EMPTY);
/// assert_eq!(tracer.stages(), Stages::SKY);
/// let same = tracer_for!(EMPTY, stages = Stages::SKY);
/// # assert_eq!(tracer.pixel(1, 1), same.pixel(1, 1));
/// let faster = tracer_for!(EMPTY, cutoff = 1.0 / 256.0, stack = 8);
/// # assert_eq!(tracer.pixel(1, 1), faster.pixel(1, 1));
/// # assert_eq!((faster.cutoff(), faster.max_depth()), (1.0 / 256.0, 5));
/// ```
///
/// It does not compile when the scene needs a stage more, and the error names it: "the scene needs the
/// stage `sky`, which is left out".
///
/// ```compile_fail,E0080
/// # use scanray::*;
/// # static EMPTY: Scene<'static> = Scene::EMPTY
/// #     .with_resolution(Resolution { width: 4, height: 3 })
/// #     .with_background(Background { color: Color::new(0.5, 0.5, 1.0), sky: true });
/// let tracer = tracer_for!(EMPTY, stages = Stages::SPHERES);
/// ```
///
/// `tracer_for!(pools, in Pools)` is for a scene in pools whose type is `Pools`, with a stack or without: with room
/// for 31 objects and fewer its loops are shorter than those of [`Tracer::new`], which draws a scene of any size.
///
/// ```
/// # use scanray::*;
/// type Pools = ScenePools<f32, 12, 4, 15>;
/// let mut pools = Pools::new();
/// # #[cfg(feature = "parser")]
/// pools.parse(include_bytes!("../../scenes/default.txt"))?;
/// let tracer = tracer_for!(pools, in Pools);
/// assert!(!tracer.stages().contains(Stages::MANY_OBJECTS));
/// # assert_eq!(tracer.pixel(400, 300), Tracer::new(pools.as_scene()).pixel(400, 300));
/// let deeper = tracer_for!(pools, in Pools, stack = 8);
/// # assert_eq!(deeper.with_max_depth(8)?.max_depth(), 8);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// Pools of another type do not compile:
///
/// ```compile_fail,E0308
/// # use scanray::*;
/// let pools = ScenePools::<f32, 12, 4, 15>::new();
/// let tracer = tracer_for!(pools, in ScenePools<f32, 12, 4, 0>);
/// ```
#[macro_export]
macro_rules! tracer_for {
    ($pools:ident, in $type:ty) => {
        $crate::tracer_for!($pools, in $type, stack = $crate::DEFAULT_MAX_DEPTH)
    };
    ($pools:ident, in $type:ty, stack = $stack:expr) => {
        $crate::Tracer::<'_, _, { <$type>::STAGES.bits() }, { $stack }>::with_stages(
            // The type is that of the pools, or this does not compile.
            <$type>::as_scene(&$pools),
        )
    };
    ($scene:path) => {
        $crate::tracer_for!($scene, stack = $crate::DEFAULT_MAX_DEPTH)
    };
    ($scene:path, stack = $stack:expr) => {
        $crate::tracer_for!($scene, stages = $scene.stages(), stack = $stack)
    };
    ($scene:path, cutoff = $cutoff:expr) => {
        $crate::tracer_for!($scene, cutoff = $cutoff, stack = $crate::DEFAULT_MAX_DEPTH)
    };
    ($scene:path, cutoff = $cutoff:expr, stack = $stack:expr) => {
        $crate::tracer_for!(
            $scene,
            stages = $scene.stages().union($crate::Stages::CUTOFF),
            stack = $stack
        )
        .with_compiled_cutoff($cutoff)
    };
    ($scene:path, stages = $stages:expr) => {
        $crate::tracer_for!($scene, stages = $stages, stack = $crate::DEFAULT_MAX_DEPTH)
    };
    ($scene:path, stages = $stages:expr, stack = $stack:expr) => {{
        const STAGES: $crate::Stages = $stages;
        // An item, so that `cargo check` looks at it too.
        const _: () = $scene.stages().require(STAGES);
        $crate::Tracer::<'static, _, { STAGES.bits() }, { $stack }>::with_stages($scene)
    }};
}
