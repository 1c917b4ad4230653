//! Nearest hits and shadows by the tree of a large scene.

use super::{Closest, Observer, TestKind, Tracer, stage};
use crate::ray::Ray;
use crate::scalar::Scalar;
use crate::scene::{Needs, Object};
use crate::shape::Surface;
use crate::visibility::Walk;

impl<'a, T: Scalar, const NEEDS: u32, const STACK: usize> Tracer<'a, T, NEEDS, STACK> {
    /// Whether spheres and triangles are found by a tree.
    #[inline(always)]
    pub(super) fn has_tree(&self) -> bool {
        stage(NEEDS, Needs::TREE) && self.scene.tree.is_some()
    }

    /// Makes the closest object of all the closest.
    #[inline(never)]
    pub(super) fn closest_in_tree(
        &self,
        ray: &Ray<T>,
        closest: &mut Closest<T>,
        observer: &mut impl Observer<T>,
    ) {
        let before_triangles = self.scene.spheres.len() + self.scene.planes.len();
        let mut walk = Walk::new(self.scene.tree, ray);
        while let Some(leaf) = walk.next_leaf(closest.t, || observer.test(TestKind::Box)) {
            for entry in leaf {
                if !entry.is_triangle() {
                    if stage(NEEDS, Needs::SPHERES)
                        && let Some(sphere) = self.scene.spheres.get(entry.index())
                    {
                        observer.test_object(Object::Sphere(sphere), ray, closest.t);
                        if let Some(t) = sphere.meet(ray) {
                            closest.offer(t, entry.index(), self.is_before(sphere.surface()));
                        }
                    }
                } else if stage(NEEDS, Needs::TRIANGLES)
                    && let Some(triangle) = self.scene.triangles.get(entry.index())
                {
                    observer.test_object(Object::Triangle(triangle), ray, closest.t);
                    let index = before_triangles + entry.index();
                    if let Some((t, place)) = triangle.intersect(ray, closest.t)
                        && closest.offer(t, index, self.is_before(triangle.surface()))
                    {
                        closest.place = place;
                    }
                }
            }
        }
        if stage(NEEDS, Needs::PLANES) {
            for (index, plane) in (self.scene.spheres.len()..).zip(self.scene.planes) {
                observer.test_object(Object::Plane(plane), ray, closest.t);
                if let Some(t) = plane.meet(ray) {
                    closest.offer(t, index, self.is_before(plane.surface()));
                }
            }
        }
    }

    /// Whether an object that casts a shadow lies on the ray within `0 < t < t_max`.
    #[inline(never)]
    pub(super) fn occluded_in_tree(
        &self,
        ray: &Ray<T>,
        t_max: T,
        casts_shadow: impl Fn(Surface) -> bool,
        observer: &mut impl Observer<T>,
    ) -> bool {
        let mut walk = Walk::new(self.scene.tree, ray);
        while let Some(leaf) = walk.next_leaf(t_max, || observer.test(TestKind::Box)) {
            for entry in leaf {
                if !entry.is_triangle() {
                    if stage(NEEDS, Needs::SPHERES)
                        && let Some(sphere) = self.scene.spheres.get(entry.index())
                    {
                        observer.test_object(Object::Sphere(sphere), ray, t_max);
                        if sphere.occludes(ray, t_max) && casts_shadow(sphere.surface()) {
                            return true;
                        }
                    }
                } else if stage(NEEDS, Needs::TRIANGLES)
                    && let Some(triangle) = self.scene.triangles.get(entry.index())
                {
                    observer.test_object(Object::Triangle(triangle), ray, t_max);
                    if triangle.occludes(ray, t_max) && casts_shadow(triangle.surface()) {
                        return true;
                    }
                }
            }
        }
        stage(NEEDS, Needs::PLANES)
            && self.scene.planes.iter().any(|plane| {
                observer.test_object(Object::Plane(plane), ray, t_max);
                plane.occludes(ray, t_max) && casts_shadow(plane.surface())
            })
    }
}
