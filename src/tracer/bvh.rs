//! Nearest hits and shadows by the bounding-volume hierarchy of a large scene.

use super::intersect::Closest;
use super::{Observer, TestKind, Tracer, any_stage, stage};
use crate::accel::Walk;
use crate::ray::{Ray, RayEnd};
use crate::scalar::Scalar;
use crate::shape::{self, ListedShape, Primitive, for_each_shape};
use crate::stages::Stages;

impl<'a, T: Scalar, const STAGES: u64, const STACK: usize> Tracer<'a, T, STAGES, STACK> {
    /// Whether bounded objects are found by a hierarchy.
    #[inline(always)]
    pub(super) fn has_bvh(&self) -> bool {
        stage(STAGES, Stages::BVH) && self.scene.accel.bvh.is_some()
    }

    /// Makes the closest object of all the closest.
    #[inline(never)]
    pub(super) fn closest_in_bvh(
        &self,
        ray: &Ray<T>,
        closest: &mut Closest<T>,
        observer: &mut impl Observer<T>,
    ) {
        let mut walk = Walk::new(self.scene.accel.bvh, ray);
        while let Some(leaf) = walk.next_leaf(closest.t, || observer.test(TestKind::Box)) {
            for entry in leaf {
                let index = *entry as usize;
                let mut within = index;
                macro_rules! offer_bounded {
                    ([$($shape:ident)*]) => {
                        $(if stage(STAGES, <shape::$shape<T> as Primitive<T>>::STAGE) {
                            let all = <shape::$shape<T>>::all(&self.scene.geometry);
                            if <shape::$shape<T> as Primitive<T>>::IS_BOUNDED
                                && let Some(object) = all.get(within)
                            {
                                observer.test_object(object.object(), ray, closest.t);
                                self.offer(index, object, ray, closest);
                                continue;
                            }
                            within = within.wrapping_sub(all.len());
                        })*
                    };
                }
                for_each_shape!(offer_bounded);
                if any_stage(STAGES, Stages::STORED_SHAPES)
                    && let Some(object) = self.scene.geometry.stored.get(within)
                {
                    self.offer_stored(index, object, ray, closest, observer);
                }
                let _ = within;
            }
        }
        // What has no box.
        if stage(STAGES, Stages::PLANES) {
            let first = self.scene.geometry.spheres.len();
            for (index, plane) in (first..).zip(self.scene.geometry.planes) {
                observer.test_object(plane.object(), ray, closest.t);
                self.offer(index, plane, ray, closest);
            }
        }
    }

    /// Whether an object that casts a shadow lies on the ray before its end.
    #[inline(never)]
    pub(super) fn occluded_in_bvh(
        &self,
        ray: &Ray<T>,
        end: &RayEnd<T>,
        observer: &mut impl Observer<T>,
    ) -> bool {
        let mut walk = Walk::new(self.scene.accel.bvh, ray);
        while let Some(leaf) = walk.next_leaf(end.distance, || observer.test(TestKind::Box)) {
            for entry in leaf {
                let index = *entry as usize;
                let mut within = index;
                macro_rules! occluded_by_bounded {
                    ([$($shape:ident)*]) => {
                        $(if stage(STAGES, <shape::$shape<T> as Primitive<T>>::STAGE) {
                            let all = <shape::$shape<T>>::all(&self.scene.geometry);
                            if <shape::$shape<T> as Primitive<T>>::IS_BOUNDED
                                && let Some(object) = all.get(within)
                            {
                                observer.test_object(object.object(), ray, end.distance);
                                if self.is_occluded_by(index, object, ray, end) {
                                    return true;
                                }
                                continue;
                            }
                            within = within.wrapping_sub(all.len());
                        })*
                    };
                }
                for_each_shape!(occluded_by_bounded);
                if any_stage(STAGES, Stages::STORED_SHAPES)
                    && let Some(object) = self.scene.geometry.stored.get(within)
                    && self.is_occluded_by_stored(index, object, ray, end, observer)
                {
                    return true;
                }
                let _ = within;
            }
        }
        let first = self.scene.geometry.spheres.len();
        stage(STAGES, Stages::PLANES)
            && (first..)
                .zip(self.scene.geometry.planes)
                .any(|(index, plane)| {
                    observer.test_object(plane.object(), ray, end.distance);
                    self.is_occluded_by(index, plane, ray, end)
                })
    }
}
