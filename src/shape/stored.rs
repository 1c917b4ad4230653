//! Shapes that few scenes have: their numbers stand one after another in one list, whatever their kinds, so that a scene does
//! not grow with the number of kinds, and each object takes no more room than its own numbers.

use super::{Disc, Kind, ObjectInfo, Primitive, for_each_stored_shape};
use crate::scalar::Scalar;

/// Where the numbers of an object are, and what they are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StoredEntry {
    pub(crate) kind: Kind,
    /// Index of the first of its numbers.
    pub(crate) first: u32,
    pub(crate) info: ObjectInfo,
}

impl StoredEntry {
    /// For baked scenes.
    #[doc(hidden)]
    pub const fn from_parts(kind: Kind, first: u32, info: ObjectInfo) -> Self {
        Self { kind, first, info }
    }
}

/// The objects of all shapes that are stored by their numbers, in the order of the text.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stored<'a, T = f32> {
    pub(crate) entries: &'a [StoredEntry],
    pub(crate) numbers: &'a [T],
}

/// An object that is stored by its numbers; [`Object::shape`](super::Object::shape) tells what it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StoredObject<'a, T = f32> {
    pub(crate) entry: &'a StoredEntry,
    /// All numbers of the scene.
    pub(crate) numbers: &'a [T],
}

/// A shape that is stored by its numbers.
pub(crate) trait StoredShape<T: Scalar>: Primitive<T> {
    /// How many numbers it has.
    const NUMBERS: usize;

    /// Writes its numbers into a list of so many.
    fn write(&self, numbers: &mut [T]);

    /// The shape whose numbers are first in a list; some that no ray hits if there are too few.
    fn read(numbers: &[T], info: ObjectInfo) -> Self;

    /// The shape of an object of its kind.
    #[inline(always)]
    fn of(object: StoredObject<'_, T>) -> Self {
        let StoredObject { entry, numbers } = object;
        let numbers = numbers.get(entry.first as usize..).unwrap_or_default();
        Self::read(numbers, entry.info)
    }
}

macro_rules! conversions {
    ([$($shape:ident)*]) => {
        $(
            /// The shape, if it is one; otherwise what it is.
            impl<T: Scalar> TryFrom<StoredObject<'_, T>> for $shape<T> {
                type Error = Kind;

                fn try_from(object: StoredObject<'_, T>) -> Result<Self, Kind> {
                    match object.entry.kind {
                        Kind::$shape => Ok(Self::of(object)),
                        other => Err(other),
                    }
                }
            }
        )*
    };
}
for_each_stored_shape!(conversions);

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

    /// The object of an index among these.
    #[inline(always)]
    pub const fn get(&self, index: usize) -> Option<StoredObject<'a, T>> {
        if index < self.entries.len() {
            Some(StoredObject {
                entry: &self.entries[index],
                numbers: self.numbers,
            })
        } else {
            None
        }
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
