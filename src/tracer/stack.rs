//! The bounded stacks that stand for the recursion of Whitted's algorithm.

use heapless::Vec;

use crate::accel::ObjectSet;
use crate::color::Color;
use crate::ray::Ray;

/// The frames from the primary hit down to the ray under way, whose depth is their number.
pub(super) type Stack<T, const CAPACITY: usize> = Vec<Level<T>, CAPACITY>;

/// The refracted rays that wait, those of the frames with a negative weight in their order. Few hits
/// have one, so that they would be dead weight in the frames.
pub(super) type Pending<T, const CAPACITY: usize> = Vec<Refracted<T>, CAPACITY>;

/// For each refracted ray that waits, the throughput at its hit, with a cut-off alone: in the frames it
/// would take room without one.
pub(super) type Throughputs<T, const CAPACITY: usize> = Vec<T, CAPACITY>;

/// A hit whose colour waits for a secondary ray.
#[derive(Clone, Copy, Debug)]
pub(super) struct Level<T> {
    /// What is known of the colour so far, not yet clamped.
    pub(super) color: Color<T>,
    /// The coefficient of the ray that is under way; negative, −0 too, while the refracted ray waits.
    pub(super) weight: T,
}

/// A refracted ray that waits until the mirror ray of the same hit is done.
#[derive(Clone, Copy, Debug)]
pub(super) struct Refracted<T> {
    pub(super) ray: Ray<T>,
    /// The objects it can hit first.
    pub(super) candidates: ObjectSet,
    /// What its colour is multiplied with.
    pub(super) weight: T,
}
