//! The shapes that have lanes: what the tracer of eight rays asks of each, and the one list of them.
//!
//! A shape implements [`LaneShape`] in a file of its own and stands in [`for_each_shape!`]; nothing else here knows of it.
//! Scenes with a shape that does not are drawn by the core.

mod plane;
mod sphere;
mod triangle;

use fearless_simd::prelude::*;
use scanray::shape::{Plane, Sphere, Triangle};
use scanray::{Vec3, accel::ObjectSet, shape::Object};

use super::Closest;
use super::batch::{Batch, Lanes};
use super::lanes::{Indices, Mask, Numbers, Rays, Vec3s};

/// The one list of the shapes that have lanes, with the names of their lists: calls a macro with it.
macro_rules! for_each_shape {
    ($then:ident $($with:tt)*) => {
        $then! { [Sphere spheres, Plane planes, Triangle triangles] $($with)* }
    };
}

/// Eight rays and a shape: `Primitive` of the core. The formulas are the core's; which lanes they hold for is decided here.
pub(super) trait LaneShape: Sized {
    /// It is found by the hierarchy of a large scene.
    const HAS_BOUNDS: bool;
    /// It is all of its sphere, whose crossings are its own.
    const IS_ITS_BOUNDS: bool;
    /// A ray that leaves it cannot hit it again.
    const IS_FLAT: bool;

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
        let Intersection { lanes, t, .. } = self.intersections(simd, bounds, rays)?;
        Some(lanes & t.simd_gt(0.0) & t.simd_lt(t_max))
    }

    /// The points where rays of a batch hit it. `Primitive::point`.
    fn points<S: Simd>(&self, simd: S, rays: &Rays<S>, batch: &Batch, lanes: &Lanes) -> Point<S>;
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
    /// Where on it, if [`LaneShape::points`] needs that: weights of the second and third vertex of a triangle.
    pub(super) place: Option<[Numbers<S>; 2]>,
}

/// A point of a surface for each ray: `SurfacePoint` of the core.
#[derive(Clone, Copy)]
pub(super) struct Point<S: Simd> {
    pub(super) point: Vec3s<S>,
    pub(super) normal: Vec3s<S>,
    pub(super) offset: Numbers<S>,
}

/// An object among those of its shape.
#[derive(Clone, Copy, Debug)]
struct Listed<'a, O> {
    shape: &'a O,
    /// Its index among all objects.
    index: u32,
    casts_shadow: bool,
}

macro_rules! shapes {
    ([$($shape:ident $list:ident),*]) => {
        /// The objects of a scene, by shape.
        #[derive(Debug, Default)]
        pub(super) struct Shapes<'a> {
            $($list: Vec<Listed<'a, $shape>>,)*
        }
    };
}
for_each_shape!(shapes);

impl<'a> Shapes<'a> {
    /// Adds an object of an index, unless its shape has no lanes.
    pub(super) fn add(&mut self, object: Object<'a>, index: u32, casts_shadow: bool) -> bool {
        macro_rules! list {
            ([$($shape:ident $list:ident),*]) => {
                match object {
                    $(Object::$shape(shape) => self.$list.push(Listed { shape, index, casts_shadow }),)*
                    _ => return false,
                }
            };
        }
        for_each_shape!(list);
        true
    }

    /// How many there are if all that have bounds are spheres, else 0.
    pub(super) fn spheres_alone(&self) -> usize {
        let mut spheres = 0;
        macro_rules! count {
            ([$($shape:ident $list:ident),*]) => {
                $(
                    if $shape::IS_ITS_BOUNDS {
                        spheres += self.$list.len();
                    } else if $shape::HAS_BOUNDS && !self.$list.is_empty() {
                        return 0;
                    }
                )*
            };
        }
        for_each_shape!(count);
        spheres
    }

    /// Offers what rays can hit that all leave the same object, or none.
    #[inline(always)]
    pub(super) fn hit<S: Simd>(
        &self,
        simd: S,
        rays: &Rays<S>,
        leaves: u32,
        candidates: ObjectSet,
        closest: &mut Closest<S>,
    ) {
        macro_rules! offer {
            ([$($shape:ident $list:ident),*]) => {
                $(
                    for listed in among(&self.$list, candidates) {
                        if $shape::IS_FLAT && listed.index == leaves {
                            continue;
                        }
                        let intersection = listed.shape.intersections(simd, listed.shape.bounds(), rays);
                        if let Some(intersection) = intersection {
                            closest.offer(simd, &intersection, listed.index);
                        }
                    }
                )*
            };
        }
        for_each_shape!(offer);
    }

    /// Adds the lanes in which an object casts a shadow before `t_max`, of rays that all leave the same object.
    #[inline(always)]
    pub(super) fn occlude<S: Simd>(
        &self,
        simd: S,
        rays: &Rays<S>,
        leaves: u32,
        t_max: Numbers<S>,
        candidates: ObjectSet,
        occluded: &mut Mask<S>,
    ) {
        macro_rules! occlude {
            ([$($shape:ident $list:ident),*]) => {
                $(
                    for listed in among(&self.$list, candidates) {
                        if !listed.casts_shadow || $shape::IS_FLAT && listed.index == leaves {
                            continue;
                        }
                        // Others take less than to ask first.
                        if !$shape::IS_ITS_BOUNDS && $shape::HAS_BOUNDS && occluded.all_true() {
                            break;
                        }
                        let bounds = listed.shape.bounds();
                        if let Some(lanes) = listed.shape.occluded(simd, bounds, rays, t_max) {
                            *occluded |= lanes;
                        }
                    }
                )*
            };
        }
        for_each_shape!(occlude);
    }

    /// Offers what no hierarchy holds, to rays that may leave any objects.
    #[inline(always)]
    pub(super) fn hit_unbounded<S: Simd>(
        &self,
        simd: S,
        rays: &Rays<S>,
        leaves: Indices<S>,
        closest: &mut Closest<S>,
    ) {
        macro_rules! offer {
            ([$($shape:ident $list:ident),*]) => {
                $(
                    if !$shape::HAS_BOUNDS {
                        for listed in &self.$list {
                            let object = (listed.shape, Bounds::default(), listed.index);
                            offer_one(simd, object, rays, leaves, closest);
                        }
                    }
                )*
            };
        }
        for_each_shape!(offer);
    }

    /// Adds the lanes in which what no hierarchy holds casts a shadow before `t_max`.
    #[inline(always)]
    pub(super) fn occlude_unbounded<S: Simd>(
        &self,
        simd: S,
        rays: &Rays<S>,
        leaves: Indices<S>,
        t_max: Numbers<S>,
        occluded: &mut Mask<S>,
    ) {
        macro_rules! occlude {
            ([$($shape:ident $list:ident),*]) => {
                $(
                    if !$shape::HAS_BOUNDS {
                        for listed in &self.$list {
                            if listed.casts_shadow {
                                let object = (listed.shape, Bounds::default(), listed.index);
                                occlude_by_one(simd, object, rays, leaves, t_max, occluded);
                            }
                        }
                    }
                )*
            };
        }
        for_each_shape!(occlude);
    }
}

/// The members of a set.
#[inline(always)]
fn among<'l, 'a, O>(
    list: &'l [Listed<'a, O>],
    set: ObjectSet,
) -> impl Iterator<Item = &'l Listed<'a, O>> {
    list.iter()
        .filter(move |listed| set.contains(listed.index as usize))
}

/// Offers an object to rays that may leave any objects.
#[inline(always)]
fn offer_one<S: Simd, O: LaneShape>(
    simd: S,
    (shape, bounds, index): (&O, Bounds, u32),
    rays: &Rays<S>,
    leaves: Indices<S>,
    closest: &mut Closest<S>,
) {
    if let Some(mut intersection) = shape.intersections(simd, bounds, rays) {
        if O::IS_FLAT {
            intersection.lanes &= !leaves.simd_eq(index);
        }
        closest.offer(simd, &intersection, index);
    }
}

/// Adds the lanes in which an object casts a shadow before `t_max`, of rays that may leave any objects.
#[inline(always)]
fn occlude_by_one<S: Simd, O: LaneShape>(
    simd: S,
    (shape, bounds, index): (&O, Bounds, u32),
    rays: &Rays<S>,
    leaves: Indices<S>,
    t_max: Numbers<S>,
    occluded: &mut Mask<S>,
) {
    if let Some(mut lanes) = shape.occluded(simd, bounds, rays, t_max) {
        if O::IS_FLAT {
            lanes &= !leaves.simd_eq(index);
        }
        *occluded |= lanes;
    }
}

/// The points where rays of a batch hit an object.
#[inline(always)]
pub(super) fn point<S: Simd>(
    simd: S,
    object: Object<'_>,
    rays: &Rays<S>,
    batch: &Batch,
    lanes: &Lanes,
) -> Point<S> {
    macro_rules! point {
        ([$($shape:ident $list:ident),*]) => {
            match object {
                $(Object::$shape(shape) => shape.points(simd, rays, batch, lanes),)*
                _ => unreachable!("scenes of other shapes are drawn by the core"),
            }
        };
    }
    for_each_shape!(point)
}

/// An object in a leaf of a hierarchy.
#[derive(Clone, Copy, Debug)]
pub(super) struct LeafObject<'a> {
    /// At hand, so that most tests end without a look at the object.
    pub(super) bounds: Bounds,
    object: Object<'a>,
    /// Its index among all objects.
    pub(super) index: u32,
    pub(super) casts_shadow: bool,
}

impl<'a> LeafObject<'a> {
    pub(super) fn new(object: Object<'a>, index: u32, casts_shadow: bool) -> Self {
        macro_rules! bounds {
            ([$($shape:ident $list:ident),*]) => {
                match object {
                    $(Object::$shape(shape) => shape.bounds(),)*
                    _ => Bounds::default(),
                }
            };
        }
        Self {
            bounds: for_each_shape!(bounds),
            object,
            index,
            casts_shadow,
        }
    }

    /// Offers it to rays that may leave any objects.
    #[inline(always)]
    pub(super) fn hit<S: Simd>(
        &self,
        simd: S,
        rays: &Rays<S>,
        leaves: Indices<S>,
        closest: &mut Closest<S>,
    ) {
        macro_rules! offer {
            ([$($shape:ident $list:ident),*]) => {
                match self.object {
                    $(
                        Object::$shape(shape) if $shape::HAS_BOUNDS => {
                            offer_one(simd, (shape, self.bounds, self.index), rays, leaves, closest)
                        }
                    )*
                    _ => {}
                }
            };
        }
        for_each_shape!(offer);
    }

    /// Adds the lanes in which it casts a shadow before `t_max`.
    #[inline(always)]
    pub(super) fn occlude<S: Simd>(
        &self,
        simd: S,
        rays: &Rays<S>,
        leaves: Indices<S>,
        t_max: Numbers<S>,
        occluded: &mut Mask<S>,
    ) {
        macro_rules! occlude {
            ([$($shape:ident $list:ident),*]) => {
                match self.object {
                    $(
                        Object::$shape(shape) if $shape::HAS_BOUNDS => {
                            let object = (shape, self.bounds, self.index);
                            occlude_by_one(simd, object, rays, leaves, t_max, occluded)
                        }
                    )*
                    _ => {}
                }
            };
        }
        if self.casts_shadow {
            for_each_shape!(occlude);
        }
    }
}
