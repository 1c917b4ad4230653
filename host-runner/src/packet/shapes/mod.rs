//! The shapes that have lanes: what the tracer of eight rays asks of each, and the one list of them.
//!
//! A shape implements [`LaneShape`] in a file of its own and stands in [`lane_shapes!`]; nothing else here knows of it.
//! Scenes with a shape that does not are drawn by the core.

mod disc;
mod plane;
mod sphere;
mod triangle;

use std::borrow::Borrow;
use std::fmt::Debug;

use fearless_simd::prelude::*;
use scanray::shape::{Disc, Plane, Sphere, Triangle};
use scanray::{Vec3, accel::ObjectSet, shape::Object};

use super::Closest;
use super::lanes::{Indices, Mask, Numbers, Rays, Vec3s};

/// Eight rays and a shape: `Primitive` of the core. The formulas are the core's; which lanes they hold for is decided here.
pub(super) trait LaneShape: Sized {
    /// It is found by the hierarchy of a large scene.
    const HAS_BOUNDS: bool;
    /// It is all of its sphere, whose crossings are its own.
    const IS_ITS_BOUNDS: bool;
    /// A ray that leaves it cannot hit it again.
    const IS_FLAT: bool;

    /// How one of a scene is held: by a reference, unless the scene has but its numbers.
    type Held<'a>: Borrow<Self> + Clone + Debug + Send + Sync;

    /// The object, if it is of this shape.
    fn of(object: Object<'_>) -> Option<Self::Held<'_>>;

    /// What tests of what has bounds begin with: a sphere around it, or whatever they take it for. A leaf of a hierarchy has it at hand.
    fn bounds(&self) -> Bounds;

    /// The nearest intersections ahead; `None` where no lane has any. `Primitive::hit`.
    fn intersections<S: Simd>(
        &self,
        simd: S,
        bounds: Bounds,
        rays: &Rays<S>,
    ) -> Option<Intersection<S>>;

    /// The lanes that hit it within `0 < t < t_max`; `None` where none does. `Primitive::occludes`.
    #[inline(always)]
    fn occluded<S: Simd>(
        &self,
        simd: S,
        bounds: Bounds,
        rays: &Rays<S>,
        t_max: Numbers<S>,
    ) -> Option<Mask<S>> {
        let Intersection { lanes, t } = self.intersections(simd, bounds, rays)?;
        Some(lanes & t.simd_gt(0.0) & t.simd_lt(t_max))
    }

    /// The points of hits, projected back from where the distances lead to. `Primitive::point`.
    fn points<S: Simd>(&self, simd: S, places: Vec3s<S>) -> Point<S>;
}

/// A sphere.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Bounds {
    pub(super) center: Vec3,
    pub(super) radius_squared: f32,
}

/// Where rays hit an object.
#[derive(Clone, Copy)]
pub(super) struct Intersection<S: Simd> {
    /// The lanes that may; what the others have does not count.
    pub(super) lanes: Mask<S>,
    /// Distance; not above 0 or NaN for none.
    pub(super) t: Numbers<S>,
}

/// A point of a surface for each ray: `SurfacePoint` of the core.
#[derive(Clone, Copy)]
pub(super) struct Point<S: Simd> {
    pub(super) point: Vec3s<S>,
    pub(super) normal: Vec3s<S>,
    pub(super) offset: Numbers<S>,
}

/// The objects that rays leave, which flat ones of them cannot hit again.
pub(super) trait Left<S: Simd>: Copy {
    /// All rays leave the object of an index.
    fn is_left_by_all(self, index: u32) -> bool;

    /// Of some lanes those that leave another object.
    fn others(self, lanes: Mask<S>, index: u32) -> Mask<S>;
}

/// The same for all rays.
impl<S: Simd> Left<S> for u32 {
    #[inline(always)]
    fn is_left_by_all(self, index: u32) -> bool {
        self == index
    }

    #[inline(always)]
    fn others(self, lanes: Mask<S>, _: u32) -> Mask<S> {
        lanes
    }
}

/// Any objects.
impl<S: Simd> Left<S> for Indices<S> {
    #[inline(always)]
    fn is_left_by_all(self, _: u32) -> bool {
        false
    }

    #[inline(always)]
    fn others(self, lanes: Mask<S>, index: u32) -> Mask<S> {
        lanes & !self.simd_eq(index)
    }
}

/// Which objects rays are tested against.
#[derive(Clone, Copy)]
pub(super) enum Among {
    /// The members of a set.
    Set(ObjectSet),
    /// What no hierarchy holds.
    Unbounded,
}

macro_rules! lane_shapes {
    ($($list:ident: $shape:ident),* $(,)?) => {
        /// The objects of a scene, by shape.
        #[derive(Debug, Default)]
        pub(super) struct Shapes<'a> {
            $($list: List<'a, $shape>,)*
        }

        /// An object of any shape that has lanes.
        #[derive(Clone, Debug)]
        pub(super) enum LaneObject<'a> {
            $($shape(<$shape as LaneShape>::Held<'a>),)*
        }

        impl<'a> LaneObject<'a> {
            /// The object, if its shape has lanes.
            pub(super) fn of(object: Object<'a>) -> Option<Self> {
                $(if let Some(held) = $shape::of(object) {
                    return Some(Self::$shape(held));
                })*
                None
            }
        }

        impl<'a> Shapes<'a> {
            /// Adds an object of an index.
            pub(super) fn add(&mut self, object: LaneObject<'a>, index: u32, casts_shadow: bool) {
                match object {
                    $(LaneObject::$shape(held) => self.$list.add(held, index, casts_shadow),)*
                }
            }
        }

        /// Does something with the list of each shape.
        macro_rules! with_each_list {
            ($shapes:expr, $it:ident => $do:expr) => {
                $({ let $it = &$shapes.$list; $do })*
            };
        }

        /// Does something with an object of any shape.
        macro_rules! with_object {
            ($object:expr, $it:ident => $do:expr) => {
                match $object {
                    $(LaneObject::$shape(held) => {
                        let $it: &$shape = held.borrow();
                        $do
                    })*
                }
            };
        }
    };
}

// The one list.
lane_shapes! {
    spheres: Sphere,
    planes: Plane,
    triangles: Triangle,
    discs: Disc,
}

/// The objects of a shape.
#[derive(Debug)]
struct List<'a, O: LaneShape>(Vec<Listed<O::Held<'a>>>);

/// An object among those of its shape.
#[derive(Debug)]
struct Listed<H> {
    held: H,
    /// Its index among all objects.
    index: u32,
    /// The set of it alone.
    alone: ObjectSet,
    casts_shadow: bool,
}

impl<O: LaneShape> Default for List<'_, O> {
    fn default() -> Self {
        Self(Vec::new())
    }
}

impl<'a, O: LaneShape> List<'a, O> {
    fn add(&mut self, held: O::Held<'a>, index: u32, casts_shadow: bool) {
        self.0.push(Listed {
            held,
            index,
            alone: ObjectSet::NONE.with(index as usize),
            casts_shadow,
        });
    }

    /// The objects that rays are tested against, with their indices, and whether they cast shadows.
    #[inline(always)]
    fn among(&self, among: Among) -> impl Iterator<Item = (&O, u32, bool)> {
        let (all, set) = match among {
            Among::Set(set) => (&*self.0, set),
            Among::Unbounded if O::HAS_BOUNDS => (&[][..], ObjectSet::ALL),
            Among::Unbounded => (&*self.0, ObjectSet::ALL),
        };
        all.iter()
            .filter(move |listed| set.intersection(listed.alone) != ObjectSet::NONE)
            .map(|listed| (listed.held.borrow(), listed.index, listed.casts_shadow))
    }

    #[inline(always)]
    fn hit<S: Simd>(
        &self,
        simd: S,
        rays: &Rays<S>,
        left: impl Left<S>,
        among: Among,
        closest: &mut Closest<S>,
    ) {
        for (shape, index, _) in self.among(among) {
            offer(simd, (shape, shape.bounds(), index), rays, left, closest);
        }
    }

    #[inline(always)]
    fn occlude<S: Simd>(
        &self,
        simd: S,
        rays: &Rays<S>,
        left: impl Left<S>,
        t_max: Numbers<S>,
        among: Among,
        occluded: &mut Mask<S>,
    ) {
        for (shape, index, casts_shadow) in self.among(among) {
            if !casts_shadow {
                continue;
            }
            // Others take less than to ask first.
            if !O::IS_ITS_BOUNDS && O::HAS_BOUNDS && occluded.all_true() {
                break;
            }
            let object = (shape, shape.bounds(), index);
            occlude(simd, object, rays, left, t_max, occluded);
        }
    }

    /// How many there are; nothing if they have bounds and are no spheres.
    fn spheres(&self) -> Option<usize> {
        let count = self.0.len();
        match (O::IS_ITS_BOUNDS, O::HAS_BOUNDS) {
            (true, _) => Some(count),
            (false, true) if count > 0 => None,
            _ => Some(0),
        }
    }
}

impl Shapes<'_> {
    /// How many there are if all that have bounds are spheres, else 0.
    pub(super) fn spheres_alone(&self) -> usize {
        let mut spheres = Some(0);
        with_each_list!(self, list => spheres = spheres.zip(list.spheres()).map(|(a, b)| a + b));
        spheres.unwrap_or(0)
    }

    /// Offers objects to rays.
    #[inline(always)]
    pub(super) fn hit<S: Simd>(
        &self,
        simd: S,
        rays: &Rays<S>,
        left: impl Left<S>,
        among: Among,
        closest: &mut Closest<S>,
    ) {
        with_each_list!(self, list => list.hit(simd, rays, left, among, closest));
    }

    /// Adds the lanes in which an object casts a shadow before `t_max`.
    #[inline(always)]
    pub(super) fn occlude<S: Simd>(
        &self,
        simd: S,
        rays: &Rays<S>,
        left: impl Left<S>,
        t_max: Numbers<S>,
        among: Among,
        occluded: &mut Mask<S>,
    ) {
        with_each_list!(self, list => list.occlude(simd, rays, left, t_max, among, occluded));
    }
}

/// Offers an object to rays.
#[inline(always)]
fn offer<S: Simd, O: LaneShape>(
    simd: S,
    (shape, bounds, index): (&O, Bounds, u32),
    rays: &Rays<S>,
    left: impl Left<S>,
    closest: &mut Closest<S>,
) {
    if O::IS_FLAT && left.is_left_by_all(index) {
        return;
    }
    if let Some(mut intersection) = shape.intersections(simd, bounds, rays) {
        if O::IS_FLAT {
            intersection.lanes = left.others(intersection.lanes, index);
        }
        closest.offer(simd, &intersection, index);
    }
}

/// Adds the lanes in which an object casts a shadow before `t_max`.
#[inline(always)]
fn occlude<S: Simd, O: LaneShape>(
    simd: S,
    (shape, bounds, index): (&O, Bounds, u32),
    rays: &Rays<S>,
    left: impl Left<S>,
    t_max: Numbers<S>,
    occluded: &mut Mask<S>,
) {
    if O::IS_FLAT && left.is_left_by_all(index) {
        return;
    }
    if let Some(mut lanes) = shape.occluded(simd, bounds, rays, t_max) {
        if O::IS_FLAT {
            lanes = left.others(lanes, index);
        }
        *occluded |= lanes;
    }
}

impl LaneObject<'_> {
    /// The points of hits, projected back from where the distances lead to.
    #[inline(always)]
    pub(super) fn points<S: Simd>(&self, simd: S, places: Vec3s<S>) -> Point<S> {
        with_object!(self, shape => shape.points(simd, places))
    }
}

/// An object in a leaf of a hierarchy: it has bounds.
#[derive(Clone, Debug)]
pub(super) struct LeafObject<'a> {
    /// At hand, so that most tests end without a look at the object.
    pub(super) bounds: Bounds,
    object: LaneObject<'a>,
    /// Its index among all objects.
    pub(super) index: u32,
    pub(super) casts_shadow: bool,
}

impl<'a> LeafObject<'a> {
    pub(super) fn new(object: LaneObject<'a>, index: u32, casts_shadow: bool) -> Self {
        Self {
            bounds: with_object!(&object, shape => shape.bounds()),
            object,
            index,
            casts_shadow,
        }
    }

    /// Offers it to rays.
    #[inline(always)]
    pub(super) fn hit<S: Simd>(
        &self,
        simd: S,
        rays: &Rays<S>,
        left: impl Left<S>,
        closest: &mut Closest<S>,
    ) {
        with_object!(&self.object, shape => if has_bounds(shape) {
            offer(simd, (shape, self.bounds, self.index), rays, left, closest);
        });
    }

    /// Adds the lanes in which it casts a shadow before `t_max`.
    #[inline(always)]
    pub(super) fn occlude<S: Simd>(
        &self,
        simd: S,
        rays: &Rays<S>,
        left: impl Left<S>,
        t_max: Numbers<S>,
        occluded: &mut Mask<S>,
    ) {
        if !self.casts_shadow {
            return;
        }
        with_object!(&self.object, shape => if has_bounds(shape) {
            let object = (shape, self.bounds, self.index);
            occlude(simd, object, rays, left, t_max, occluded);
        });
    }
}

/// Leaves hold nothing else: there is no code for it.
#[inline(always)]
fn has_bounds<O: LaneShape>(_: &O) -> bool {
    O::HAS_BOUNDS
}
