//! Refracted rays, total internal reflection, and what secondary rays can hit.

use super::stack::Refracted;
use super::{Hit, Tracer, stage};
use crate::accel::{Candidates, Cell, ObjectSet};
use crate::material::Interface;
use crate::ray::{Ray, Side};
use crate::scalar::Scalar;
use crate::stages::Stages;
use crate::vec3::Vec3;

impl<'a, T: Scalar, const STAGES: u64, const STACK: usize> Tracer<'a, T, STAGES, STACK> {
    /// The objects that a secondary ray can hit first that leaves a side in a direction.
    #[inline(always)]
    pub(super) fn near(
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

    /// The refracted ray of a hit, unless it is totally reflected.
    #[inline(always)]
    pub(super) fn refracted(&self, ray: &Ray<T>, hit: &Hit<'a, T>) -> Option<Refracted<T>> {
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
    pub(super) fn refracted_direction(&self, ray: &Ray<T>, hit: &Hit<'a, T>) -> Option<Vec3<T>> {
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

    /// What rays can hit that leave a side of an object.
    #[inline(always)]
    pub(super) fn candidates(&self, side: Side) -> &'a Candidates {
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
}
