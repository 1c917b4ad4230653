//! Shapes that few scenes have: their numbers stand one after another in one list, whatever their kinds, so that a scene does
//! not grow with the number of kinds, and each object takes no more room than its own numbers.

use super::{Disc, Kind, Object, Primitive, Surface, for_each_stored_shape};
use crate::scalar::Scalar;

/// Where the numbers of an object are, and what they are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StoredEntry {
    pub(crate) kind: Kind,
    /// Index of the first of its numbers.
    pub(crate) first: u32,
    pub(crate) surface: Surface,
}

impl StoredEntry {
    /// For baked scenes.
    #[doc(hidden)]
    pub const fn from_parts(kind: Kind, first: u32, surface: Surface) -> Self {
        Self {
            kind,
            first,
            surface,
        }
    }
}

/// The objects of all shapes that are stored by their numbers, in the order of the text.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stored<'a, T = f32> {
    pub(crate) entries: &'a [StoredEntry],
    pub(crate) numbers: &'a [T],
}

/// A shape that is stored by its numbers.
pub(crate) trait StoredShape<T: Scalar>: Primitive<T> {
    /// How many numbers it has.
    const NUMBERS: usize;

    /// Writes its numbers into a list of so many.
    fn write(&self, numbers: &mut [T]);

    /// The shape of as many numbers.
    fn read(numbers: &[T], surface: Surface) -> Option<Self>;

    /// The shape of an entry.
    #[inline(always)]
    fn of(stored: &Stored<'_, T>, entry: &StoredEntry) -> Option<Self> {
        let numbers = stored.numbers.get(entry.first as usize..)?;
        Self::read(numbers.get(..Self::NUMBERS)?, entry.surface)
    }
}

impl<'a, T> Stored<'a, T> {
    /// No objects.
    pub const NONE: Self = Self {
        entries: &[],
        numbers: &[],
    };

    /// For baked scenes: entries, and the numbers that they point to.
    #[doc(hidden)]
    pub const fn from_parts(entries: &'a [StoredEntry], numbers: &'a [T]) -> Self {
        Self { entries, numbers }
    }

    /// Number of objects of a kind.
    pub const fn count_of(&self, kind: Kind) -> usize {
        let mut count = 0;
        let mut i = 0;
        while i < self.entries.len() {
            if self.entries[i].kind as u8 == kind as u8 {
                count += 1;
            }
            i += 1;
        }
        count
    }
}

impl<T: Scalar> Stored<'_, T> {
    /// The object of an entry; `None` if its numbers are missing.
    pub(crate) fn object<'o>(&self, entry: &StoredEntry) -> Option<Object<'o, T>> {
        macro_rules! of_kind {
            ([$($shape:ident)*]) => {
                match entry.kind {
                    $(Kind::$shape => $shape::of(self, entry).map(Object::$shape),)*
                    _ => None,
                }
            };
        }
        for_each_stored_shape!(of_kind)
    }
}
