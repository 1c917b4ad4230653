//! What a ray hits first, and whether anything stands between a hit and a light: every candidate is tested.

use super::observer::Observer;
use super::{Tracer, any_stage, stage};
use crate::accel::{Cell, Members, ObjectSet};
use crate::material::Material;
use crate::ray::{Ray, RayEnd};
use crate::scalar::Scalar;
use crate::shape::{
    self, Geometry, Kind, ListedShape, Object, ObjectInfo, Primitive, Stored, StoredObject,
    StoredShape, SurfacePoint, for_each_shape, for_each_stored_shape,
    light_on_surface::{is_before, is_near},
};
use crate::stages::Stages;

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
pub(super) struct Closest<T> {
    /// Distance along the ray; the largest number if there is no intersection yet.
    pub(super) t: T,
    /// Index of the object among all objects; beyond all if there is none.
    pub(super) index: usize,
}

impl<T: Scalar> Closest<T> {
    pub(super) const NONE: Self = Self {
        t: T::MAX,
        index: usize::MAX,
    };

    /// Takes a hit if it comes before the closest so far: of two at exactly the same distance that of the smaller index,
    /// whatever the order in which they are offered.
    #[inline(always)]
    pub(super) fn offer(&mut self, t: T, index: usize) {
        if t.is_before(self.t) || (t == self.t && index < self.index) {
            (self.t, self.index) = (t, index);
        }
    }
}

impl<'a, T: Scalar, const STAGES: u64, const STACK: usize> Tracer<'a, T, STAGES, STACK> {
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
    pub(super) fn closest(
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
                if let Some(t) = object.hit(ray, closest.t)
                    && t.is_before(closest.t)
                    && !self.is_left::<P>(ray, index)
                {
                    (closest.t, closest.index) = (t, index);
                }
                false
            },
        );
        first + all.len()
    }

    /// Makes a stored object the closest if it is.
    #[inline(always)]
    pub(super) fn offer_stored(
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
    pub(super) fn offer<P: Primitive<T>>(
        &self,
        index: usize,
        object: &P,
        ray: &Ray<T>,
        closest: &mut Closest<T>,
    ) {
        if let Some(t) = object.hit(ray, closest.t)
            && !self.is_left::<P>(ray, index)
        {
            closest.offer(t, index);
        }
    }

    /// Whether a stored object casts a shadow on a ray.
    #[inline(always)]
    pub(super) fn is_occluded_by_stored(
        &self,
        index: usize,
        object: StoredObject<'_, T>,
        ray: &Ray<T>,
        end: &RayEnd<T>,
        observer: &mut impl Observer<T>,
    ) -> bool {
        macro_rules! of_kind {
            ([$($shape:ident)*]) => {
                match object.entry.kind {
                    $(Kind::$shape if stage(STAGES, <shape::$shape<T> as Primitive<T>>::STAGE) => {
                        observer.test_object(Object::Stored(object), ray, end.distance);
                        self.is_occluded_by(index, &<shape::$shape<T>>::of(object), ray, end)
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
        let end = RayEnd {
            distance: t_max,
            light: None,
        };
        self.occluded_observed(ray, &end, all, &mut ())
    }

    #[inline(always)]
    pub(super) fn occluded_observed(
        &self,
        ray: &Ray<T>,
        end: &RayEnd<T>,
        candidates: ObjectSet,
        observer: &mut impl Observer<T>,
    ) -> bool {
        if self.has_bvh() {
            return self.occluded_in_bvh(ray, end, observer);
        }
        let mut members = self.members(self.without_left(ray, candidates));
        let mut first = 0;
        macro_rules! occluded_by_each {
            ([$($shape:ident)*]) => {
                $(
                    if self.occluded_by::<shape::$shape<T>>(first, &mut members, ray, end, observer) {
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
                |index, object| self.is_occluded_by_stored(index, object, ray, end, observer),
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
        end: &RayEnd<T>,
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
                observer.test_object(object.object(), ray, end.distance);
                self.is_occluded_by(index, object, ray, end)
            },
        )
    }

    /// The objects of the shapes that are compiled.
    #[inline(always)]
    pub(super) fn geometry(&self) -> Geometry<'a, T> {
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
    pub(super) fn is_occluded_by<P: Primitive<T>>(
        &self,
        index: usize,
        object: &P,
        ray: &Ray<T>,
        end: &RayEnd<T>,
    ) -> bool {
        let near = if stage(STAGES, Stages::LIGHT_ON_SURFACE) && !self.scene.accel.lights_are_clear
        {
            end.light.filter(|light| is_near(object, *light))
        } else {
            None
        };
        let occludes = match near {
            Some(light) if !P::IS_FLAT => object.occludes_near(ray, light, end.distance),
            // Whatever the distances are: a flat shape is crossed ahead, and the light lies beyond.
            _ => {
                let within = near.map_or(end.distance, |_| T::MAX);
                object.occludes(ray, within)
                    && near.is_none_or(|light| is_before(object, light, ray.direction))
            }
        };
        occludes
            && !self.is_left::<P>(ray, index)
            && self
                .material(object.info())
                .is_none_or(Material::casts_shadow)
    }

    /// The point of a hit, its material, and the cell of a plane grid that it lies in.
    #[inline(always)]
    pub(super) fn hit_point(
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
                        let point = object.point(ray, closest.t);
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
                        <shape::$shape<T>>::of(object).point(ray, closest.t)
                    })*
                    _ => return None,
                }
            };
        }
        Some((for_each_stored_shape!(of_kind), object.entry.info, None))
    }
}
