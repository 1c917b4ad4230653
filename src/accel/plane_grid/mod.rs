//! Which objects a ray that leaves a plane can hit, by the place where it starts: the data; how it is
//! found is told in [`build`].

mod build;

pub(super) use build::plane_grid;

use super::ObjectSet;
use crate::scalar::Scalar;
use crate::vec3::Vec3;

/// What the rays can hit that leave a plane, by the place where they start: slabs across two axes.
///
/// A place lies in one slab of either axis, unless it is so far away that it lies in none, where anything
/// may be hit. The sets tell bounded objects apart; planes are in all of them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlaneGrid<T = f32> {
    /// The axis along which the normal is longest: 0, 1 or 2 for x, y or z. The slabs lie across the two
    /// others, in their order.
    pub normal_axis: u8,
    /// Where the slabs begin. (The first reaches another slab's width further down.)
    pub low: [T; 2],
    /// Strips in a unit of length.
    pub density: [T; 2],
    /// The slabs, from the lowest coordinate to the highest.
    pub slabs: [[Slab; Slab::PER_AXIS]; 2],
}

/// What can be hit from a slab of a plane.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Slab {
    /// Objects ahead of mirrored and refracted rays that go up along the axis, and that go down.
    pub ahead: [ObjectSet; 2],
    /// Objects that may stand between the slab and a light.
    pub occluders: ObjectSet,
}

/// A place on a plane: a slab of either axis.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cell<'a> {
    normal_axis: u8,
    slabs: [&'a Slab; 2],
}

impl<T: Scalar> PlaneGrid<T> {
    /// Anything may be hit.
    pub const ALL: Self = Self {
        normal_axis: 0,
        low: [T::ZERO; 2],
        density: [T::ZERO; 2],
        slabs: [[Slab::ALL; Slab::PER_AXIS]; 2],
    };

    /// The slabs in which a place lies.
    #[inline(always)]
    pub(crate) fn cell(&self, place: Vec3<T>) -> Option<Cell<'_>> {
        let [u, v] = across(self.normal_axis, place);
        let slab = |axis: usize, coordinate: T| {
            let index = coordinate
                .minus(self.low[axis])
                .times(self.density[axis])
                .to_i32();
            self.slabs[axis].get(index as usize)
        };
        Some(Cell {
            normal_axis: self.normal_axis,
            slabs: [slab(0, u)?, slab(1, v)?],
        })
    }
}

impl Slab {
    /// The number of slabs across an axis.
    pub const PER_AXIS: usize = 8;

    /// Anything may be hit.
    pub const ALL: Self = Self {
        ahead: [ObjectSet::ALL; 2],
        occluders: ObjectSet::ALL,
    };
}

impl Cell<'_> {
    /// Objects that may stand between it and a light.
    #[inline(always)]
    pub(crate) fn occluders(&self) -> ObjectSet {
        let [u, v] = self.slabs;
        u.occluders.intersection(v.occluders)
    }

    /// Objects ahead of a mirrored or refracted ray.
    #[inline(always)]
    pub(crate) fn ahead<T: Scalar>(&self, direction: Vec3<T>) -> ObjectSet {
        let ahead = |slab: &Slab, component: T| slab.ahead[usize::from(component.is_negative())];
        let [u, v] = across(self.normal_axis, direction);
        ahead(self.slabs[0], u).intersection(ahead(self.slabs[1], v))
    }
}

/// The coordinates along the two other axes.
#[inline(always)]
pub(crate) fn across<T: Scalar>(axis: u8, v: Vec3<T>) -> [T; 2] {
    match axis {
        0 => [v.y, v.z],
        1 => [v.x, v.z],
        _ => [v.x, v.y],
    }
}
