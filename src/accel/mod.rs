//! Who can hit whom: objects that a ray cannot hit are not tested. (Large scenes: [`Bvh`].)
//!
//! The tracer asks for the *candidates* of a ray that leaves a given place (a row of the camera, a side
//! of an object, a side towards the lights) and tests only those. A set of candidates may be too large,
//! never too small: with all objects as candidates the picture has the same bits. That holds because an
//! object is excluded only if geometry keeps it away by a margin that is far more than all rounding in
//! the tracer:
//!
//! * Origins lie within a few units of rounding (of the coordinates) of their surface, directions within
//!   a few units of rounding (in radians) of where they point, and the tests report a hit for rays that
//!   pass an object at a few units of rounding of the distance to it: all together well below 32 units.
//! * The margin is 128 units of rounding of `f32` of every length and coordinate that is involved, and
//!   1/4096 of the radii (`margin`). `f64` uses the same.
//!
//! Unbounded planes are excluded only where the argument does not depend on how far away they are hit.

mod bvh;
mod candidates;
pub(crate) mod highlights;
mod object_set;
mod plane_grid;
mod row;
mod sides;

pub(crate) use bvh::Walk;
pub use bvh::{Bvh, BvhNode, NodeContent};
pub use candidates::{Candidates, Octant};
pub(crate) use object_set::Members;
pub use object_set::ObjectSet;
pub(crate) use plane_grid::Cell;
pub use plane_grid::{PlaneGrid, Slab};
pub(crate) use row::visible_in_row;

use heapless::VecView;

use crate::light::Light;
use crate::material::Material;
use crate::scalar::Scalar;
use crate::shape::{
    Geometry, Object,
    margin::{margin, size},
};

/// What is derived from a scene, so that rays need not be tested against all of it. Without any of it the picture has the same
/// bits.
///
/// It belongs to the objects, the light positions and the materials that it was derived from, and [`Scene`](crate::Scene)
/// drops it when any of them changes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Accel<'a, T = f32> {
    /// By [`Side::index`](crate::ray::Side::index); where there is no entry, anything may be hit. If there are any, the materials' own
    /// [`Material::faint_alignment`] belong to the scene, too.
    pub(crate) sides: &'a [Candidates],
    /// By the plane's index among planes; where there is no entry, what `sides` says may be hit.
    pub(crate) grids: &'a [PlaneGrid<T>],
    /// Of a large scene, what its bounded objects are found by.
    pub(crate) bvh: Bvh<'a, T>,
    /// No light is near a surface; if that is not known, each shadow ray asks.
    pub(crate) lights_are_clear: bool,
}

impl<'a, T> Accel<'a, T> {
    /// Nothing is known.
    pub const NONE: Self = Self {
        sides: &[],
        grids: &[],
        bvh: Bvh::NONE,
        lights_are_clear: false,
    };

    /// For baked scenes alone: nothing checks that it belongs to the scene.
    #[doc(hidden)]
    pub const fn from_parts(
        sides: &'a [Candidates],
        grids: &'a [PlaneGrid<T>],
        nodes: &'a [BvhNode<T>],
        entries: &'a [u32],
        lights_are_clear: bool,
    ) -> Self {
        Self {
            sides,
            grids,
            bvh: Bvh { nodes, entries },
            lights_are_clear,
        }
    }

    /// The materials' own [`Material::faint_alignment`] belong to the scene's lights and ambient light.
    #[inline(always)]
    pub(crate) const fn knows_faint(&self) -> bool {
        !self.sides.is_empty()
    }

    /// What rays can hit that leave each side of each object, by [`Side::index`](crate::ray::Side::index); where there is no
    /// entry, anything.
    pub const fn sides(&self) -> &'a [Candidates] {
        self.sides
    }

    /// Whether it is known that no light is so near to a surface that rounding may decide on which side.
    pub const fn lights_are_clear(&self) -> bool {
        self.lights_are_clear
    }

    /// What rays can hit that leave each plane, by place.
    pub const fn grids(&self) -> &'a [PlaneGrid<T>] {
        self.grids
    }
}

impl<'a, T: Copy> Accel<'a, T> {
    /// The bounding-volume hierarchy of a large scene.
    pub const fn bvh(&self) -> Bvh<'a, T> {
        self.bvh
    }
}

/// All that is derived from.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Source<'a, T> {
    pub(crate) geometry: Geometry<'a, T>,
    pub(crate) lights: &'a [Light<T>],
    /// Of which it matters alone which cast shadows.
    pub(crate) materials: &'a [Material<T>],
}

impl<T: Scalar> Source<'_, T> {
    /// Whether no light is near a surface.
    pub(crate) fn are_lights_clear(&self) -> bool {
        self.lights.iter().all(|light| {
            let mut objects = self.geometry.objects();
            objects.all(|object| !object.is_near(light.position))
        })
    }
}

/// Room for what is derived.
#[doc(hidden)]
#[derive(Debug)]
pub struct AccelMut<'p, T> {
    /// For all objects or none: with too little room nothing is derived.
    pub(crate) sides: &'p mut VecView<[Candidates; 2]>,
    /// As many as planes.
    pub(crate) grids: &'p mut VecView<PlaneGrid<T>>,
    /// As many as entries.
    pub(crate) nodes: &'p mut VecView<BvhNode<T>>,
    pub(crate) entries: &'p mut VecView<u32>,
    pub(crate) lights_are_clear: &'p mut bool,
}

impl<T: Scalar> AccelMut<'_, T> {
    /// Forgets everything.
    pub(crate) fn clear(&mut self) {
        self.sides.clear();
        self.grids.clear();
        self.nodes.clear();
        self.entries.clear();
        *self.lights_are_clear = false;
    }

    /// Finds out whether no light is near a surface.
    pub(crate) fn find_clear_lights(&mut self, source: &Source<'_, T>) {
        *self.lights_are_clear = source.are_lights_clear();
    }

    /// Derives what there is room for: lists of candidates and plane grids.
    pub(crate) fn find_candidates(&mut self, source: &Source<'_, T>) {
        self.sides.clear();
        self.grids.clear();
        if source.geometry.count() > self.sides.capacity() {
            return;
        }
        for object in source.geometry.objects() {
            // There is room for all.
            let _ = self.sides.push(sides::sides(source, object));
        }
        for plane in source.geometry.planes {
            if self
                .grids
                .push(plane_grid::plane_grid(source, plane))
                .is_err()
            {
                break;
            }
        }
    }

    /// Builds the hierarchy of a large scene, if there is room for all of its bounded objects.
    pub(crate) fn build_bvh(&mut self, geometry: &Geometry<'_, T>) {
        self.nodes.clear();
        self.entries.clear();
        let capacity = self.entries.capacity();
        let mut bounded = 0;
        for (index, object) in (0..).zip(geometry.objects()) {
            if object.is_bounded() {
                bounded += 1;
                // `extend` could panic, as far as the compiler knows.
                let _ = self.entries.push(index);
            }
        }
        if bounded < Bvh::<T>::FEWEST_OBJECTS || bounded > capacity {
            self.entries.clear();
            return;
        }
        bvh::build(geometry, self.entries, self.nodes);
    }
}

/// The set of the objects for which something holds.
fn collect<T: Scalar>(
    geometry: &Geometry<'_, T>,
    mut holds: impl FnMut(Object<'_, T>) -> bool,
) -> ObjectSet {
    const END: usize = ObjectSet::TOLD_APART;
    let count = geometry.count();
    let mut set = ObjectSet::NONE;
    for index in 0..count.min(END) {
        if geometry.object(index).is_some_and(&mut holds) {
            set = set.with(index);
        }
    }
    if count > END {
        // What is not told apart is in every set.
        set = set.with(END);
    }
    set
}
