//! Which objects a ray that leaves a plane can meet, by the place where it starts: the data; how it is
//! found is told in `visibility`.

use super::ObjectSet;
use crate::scalar::Scalar;
use crate::vec3::Vec3;

/// What the rays can meet that leave a plane, by the place where they start: strips across two axes.
///
/// A place lies in one strip of either axis, unless it is so far away that it lies in none, where anything
/// may be met. The sets tell bounded objects apart; planes are in all of them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Zones<T = f32> {
    /// The axis along which the normal is longest: 0, 1 or 2 for x, y or z. The strips lie across the two
    /// others, in their order.
    pub normal_axis: u8,
    /// Where the strips begin. (The first reaches another strip's width further down.)
    pub low: [T; 2],
    /// Strips in a unit of length.
    pub density: [T; 2],
    /// The strips, from the lowest coordinate to the highest.
    pub strips: [[Strip; Strip::PER_AXIS]; 2],
}

/// What can be met from a strip of a plane.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Strip {
    /// Objects ahead of mirrored and refracted rays that go up along the axis, and that go down.
    pub ahead: [ObjectSet; 2],
    /// Objects that may stand between the strip and a light.
    pub occluders: ObjectSet,
}

/// A place on a plane: a strip of either axis.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Zone<'a> {
    normal_axis: u8,
    strips: [&'a Strip; 2],
}

impl<T: Scalar> Zones<T> {
    /// Anything may be met.
    pub const ALL: Self = Self {
        normal_axis: 0,
        low: [T::ZERO; 2],
        density: [T::ZERO; 2],
        strips: [[Strip::ALL; Strip::PER_AXIS]; 2],
    };

    /// The strips in which a place lies.
    #[inline(always)]
    pub(crate) fn zone(&self, place: Vec3<T>) -> Option<Zone<'_>> {
        let [u, v] = across(self.normal_axis, place);
        let strip = |axis: usize, coordinate: T| {
            let index = coordinate
                .minus(self.low[axis])
                .times(self.density[axis])
                .to_i32();
            self.strips[axis].get(index as usize)
        };
        Some(Zone {
            normal_axis: self.normal_axis,
            strips: [strip(0, u)?, strip(1, v)?],
        })
    }
}

impl Strip {
    /// The number of strips across an axis.
    pub const PER_AXIS: usize = 8;

    /// Anything may be met.
    pub const ALL: Self = Self {
        ahead: [ObjectSet::ALL; 2],
        occluders: ObjectSet::ALL,
    };
}

impl Zone<'_> {
    /// Objects that may stand between it and a light.
    #[inline(always)]
    pub(crate) fn occluders(&self) -> ObjectSet {
        let [u, v] = self.strips;
        u.occluders.intersection(v.occluders)
    }

    /// Objects ahead of a mirrored or refracted ray.
    #[inline(always)]
    pub(crate) fn ahead<T: Scalar>(&self, direction: Vec3<T>) -> ObjectSet {
        let ahead = |strip: &Strip, component: T| strip.ahead[usize::from(component.is_negative())];
        let [u, v] = across(self.normal_axis, direction);
        ahead(self.strips[0], u).intersection(ahead(self.strips[1], v))
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
