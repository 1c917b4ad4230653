//! Which objects a ray that leaves a surface can hit: the data; how it is found is told in [`super::sides`].

use super::ObjectSet;
use crate::scalar::Scalar;
use crate::vec3::Vec3;

/// The eight octants by the signs of the components of a direction; ±0 belongs to either side.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Octant(u8);

impl Octant {
    /// All of them, in the order of their indices.
    pub const ALL: [Self; 8] = [
        Self(0),
        Self(1),
        Self(2),
        Self(3),
        Self(4),
        Self(5),
        Self(6),
        Self(7),
    ];

    /// The octant of a direction.
    #[inline(always)]
    pub fn of<T: Scalar>(direction: Vec3<T>) -> Self {
        let sign = |component: T| component.is_negative() as u8;
        Self(sign(direction.x) | sign(direction.y) << 1 | sign(direction.z) << 2)
    }

    /// Whether its directions have components ≤ 0 along x, y and z; ≥ 0 otherwise.
    pub const fn is_negative(self) -> [bool; 3] {
        [self.0 & 1 != 0, self.0 & 2 != 0, self.0 & 4 != 0]
    }

    /// Its place in [`Octant::ALL`].
    #[inline(always)]
    pub const fn index(self) -> usize {
        self.0 as usize
    }
}

/// What rays can hit that leave one side of an object.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Candidates {
    /// Objects that a mirrored or refracted ray can hit first, by the octant of its direction.
    pub near: [ObjectSet; 8],
    /// Objects that may stand between this side and a light.
    pub occluders: ObjectSet,
    /// No light reaches this side.
    pub shadowed: bool,
}

impl Candidates {
    /// Anything may be hit.
    pub const ALL: Self = Self {
        near: [ObjectSet::ALL; 8],
        occluders: ObjectSet::ALL,
        shadowed: false,
    };

    /// Objects that a mirrored or refracted ray of a direction can hit first.
    #[inline(always)]
    pub fn near<T: Scalar>(&self, direction: Vec3<T>) -> ObjectSet {
        // The index is below 8.
        self.near[Octant::of(direction).index() & 7]
    }

    /// Objects that a mirrored or refracted ray of any direction can hit first.
    pub fn near_in_any_direction(&self) -> ObjectSet {
        self.near
            .iter()
            .fold(ObjectSet::NONE, |all, octant| all.union(*octant))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn directions_belong_to_the_octant_of_their_signs() {
        for octant in Octant::ALL {
            let signed = |is_negative| if is_negative { -0.5_f32 } else { 0.5 };
            let [x, y, z] = octant.is_negative().map(signed);
            assert_eq!(Octant::of(Vec3::new(x, y, z)), octant);
        }
        assert_eq!(Octant::of(Vec3::new(0.0_f64, -0.0, -1.0)).index(), 6);
    }
}
