//! Sets of objects: one word.

use core::ops::Range;

/// A set of objects of a scene, by their index among all: spheres first, then planes, then triangles.
///
/// The first 31 are told apart; those beyond are in it all together or not at all.
// One bit each, the first object's the highest: counting leading zeros is an instruction of most cores.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ObjectSet(u32);

/// The bit of the first object.
const FIRST: u32 = 1 << (u32::BITS - 1);

impl ObjectSet {
    /// Number of objects that a set tells apart.
    pub const TOLD_APART: usize = u32::BITS as usize - 1;

    /// Every object.
    pub const ALL: Self = Self(u32::MAX);

    /// No object.
    pub const NONE: Self = Self(0);

    /// The set of a number: for baked scenes.
    pub const fn from_bits(bits: u32) -> Self {
        Self(bits)
    }

    /// The set as a number: the highest bit is the first object's.
    pub const fn bits(self) -> u32 {
        self.0
    }

    const fn bit(index: usize) -> u32 {
        let place = if index < Self::TOLD_APART {
            index
        } else {
            Self::TOLD_APART
        };
        FIRST >> place
    }

    /// Whether the object of an index is in it.
    pub const fn contains(self, index: usize) -> bool {
        self.0 & Self::bit(index) != 0
    }

    /// The set with the object of an index.
    #[must_use]
    pub const fn with(self, index: usize) -> Self {
        Self(self.0 | Self::bit(index))
    }

    /// What is in either set.
    #[must_use]
    pub const fn union(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    /// What is in this set but not in the other.
    #[must_use]
    pub const fn without(self, other: Self) -> Self {
        Self(self.0 & !other.0)
    }

    /// What is in both sets.
    #[must_use]
    pub const fn intersection(self, other: Self) -> Self {
        Self(self.0 & other.0)
    }

    /// The indices of its members in ascending order, in a scene of `count` objects. Of a set that was not
    /// made for the scene some may be `count` or larger.
    pub fn members(self, count: usize) -> impl Iterator<Item = usize> {
        let told_apart =
            (0..count.min(Self::TOLD_APART)).filter(move |index| self.contains(*index));
        let beyond = (Self::TOLD_APART..count).filter(move |index| self.contains(*index));
        told_apart.chain(beyond)
    }

    /// A walk through its members; `many` is false only where all objects are told apart.
    #[inline(always)]
    pub(crate) fn members_among(self, many: bool) -> Members {
        Members {
            left: self.0 & !Self::bit(Self::TOLD_APART),
            many,
            beyond: if many && self.contains(Self::TOLD_APART) {
                Self::TOLD_APART
            } else {
                usize::MAX
            },
        }
    }
}

/// A walk through the members of a set.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Members {
    /// Those told apart that are left.
    left: u32,
    many: bool,
    /// The next of those beyond; the largest number if there are none.
    beyond: usize,
}

impl Members {
    /// Visits the members that are objects of one shape, which `object` finds by their index, as long as
    /// `visit` gives false; tells whether it gave true. One call for each shape, in their order, whose objects
    /// have the indices from `start` to `end`; unless there may be `several`, there is no loop.
    #[inline(always)]
    pub(crate) fn walk<O>(
        &mut self,
        Range { start, end }: Range<usize>,
        several: bool,
        object: impl Fn(usize) -> Option<O>,
        mut visit: impl FnMut(usize, O) -> bool,
    ) -> bool {
        if self.is_over() {
            return false;
        }
        loop {
            // The lowest bit is that of the objects beyond: at the end its place is no index of an object told apart, and
            // it keeps a compiler from asking whether there is a bit at all.
            let mut index = (self.left | 1).leading_zeros() as usize;
            // With many objects that place is an index.
            let is_at_end = self.many && self.left == 0;
            let member = match object(index) {
                Some(member) if !is_at_end => member,
                _ => {
                    // If the shape has objects beyond those told apart, nothing else is left.
                    if !self.many || self.beyond >= end {
                        return false;
                    }
                    index = self.beyond.max(start);
                    self.beyond = index + 1;
                    match object(index) {
                        Some(member) => member,
                        None => return false,
                    }
                }
            };
            if visit(index, member) {
                return true;
            }
            self.left &= !(FIRST >> (self.left | 1).leading_zeros());
            // Out of a loop for a single object a compiler would move all of its tests but the ray, and so before the
            // question whether it is a member.
            if !several || self.is_over() {
                return false;
            }
        }
    }

    /// Whether nothing is left for any shape, as far as that is known at once.
    #[inline(always)]
    fn is_over(&self) -> bool {
        !self.many && self.left == 0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn members(set: ObjectSet, count: usize) -> std::vec::Vec<usize> {
        set.members(count).collect()
    }

    #[test]
    fn tells_the_first_objects_apart_and_holds_those_beyond_together() {
        let set = ObjectSet::NONE.with(0).with(5).with(30);
        assert_eq!(members(set, 40), [0, 5, 30]);
        assert!(set.contains(5) && !set.contains(6) && !set.contains(31) && !set.contains(39));
        let beyond = set.with(33);
        assert_eq!(members(beyond, 34), [0, 5, 30, 31, 32, 33]);
        assert!(beyond.contains(31) && beyond.contains(1000));
        assert_eq!(members(ObjectSet::NONE, 40), []);
        assert_eq!(
            members(ObjectSet::ALL, 40),
            (0..40).collect::<std::vec::Vec<_>>()
        );
    }
}
