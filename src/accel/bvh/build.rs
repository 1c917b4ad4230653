//! Making the tree, in place.

use core::cell::Cell;

use heapless::VecView;

use super::bounds::{Bounds, along};
use super::{Bvh, BvhNode, NodeContent};
use crate::scalar::Scalar;
use crate::shape::Geometry;

/// Fewer objects make no leaf, so that a tree has fewer nodes than objects.
const SMALLEST_LEAF: usize = 2;

/// More objects make no leaf.
const LARGEST_LEAF: usize = 8;

/// A node may be divided between any two of so many parts of an axis.
const BINS: usize = 16;

/// Builds the tree of the objects of `entries`, which it puts in another order.
///
/// Binned surface-area heuristic (Wald, "On fast Construction of SAH-based Bounding Volume Hierarchies",
/// 2007), breadth first: a node that may still be divided is a leaf, and dividing it appends two
/// leaves. So there is nothing to remember but where a level ends.
pub(in crate::accel) fn build<T: Scalar>(
    geometry: &Geometry<'_, T>,
    entries: &mut [u32],
    nodes: &mut VecView<BvhNode<T>>,
) {
    let builder = Builder {
        geometry,
        entries: Cell::from_mut(entries).as_slice_of_cells(),
    };
    nodes.clear();
    let all = Range {
        first: 0,
        count: builder.entries.len(),
    };
    let (mut depth, mut level_end) = (0, 1);
    let mut last = nodes.push(builder.leaf(all)).map_or(0, |()| 1);
    let mut index = 0;
    while index < last {
        if index == level_end {
            depth += 1;
            level_end = last;
        }
        if let Some(node) = nodes.get_mut(index)
            && let Some((axis, halves)) = builder.divide(node, Bvh::<T>::MAX_DEPTH - depth)
        {
            *node = BvhNode::new(
                node.low(),
                node.high(),
                NodeContent::Inner {
                    first: last as u32,
                    axis,
                },
            );
            for half in halves {
                // There is room, because no leaf has fewer than two objects.
                let _ = nodes.push(builder.leaf(half));
            }
            last += 2;
        }
        index += 1;
    }
}

/// Some of the entries.
#[derive(Clone, Copy)]
struct Range {
    first: usize,
    count: usize,
}

impl Range {
    fn halves(self, lower: usize) -> [Self; 2] {
        [
            Self {
                first: self.first,
                count: lower,
            },
            Self {
                first: self.first + lower,
                count: self.count - lower,
            },
        ]
    }
}

/// Where to divide a node.
#[derive(Clone, Copy)]
struct Cut<T> {
    axis: usize,
    /// The first bin of the upper half.
    bin: usize,
    /// Objects in the lower half.
    lower: usize,
    /// How many tests of objects the two halves are expected to take, times the area of the node.
    cost: T,
}

/// Numbers the bins along an axis.
#[derive(Clone, Copy)]
struct Scale<T> {
    axis: usize,
    low: T,
    factor: T,
}

impl<T: Scalar> Scale<T> {
    /// The bin of a box.
    fn bin(&self, bounds: &Bounds<T>) -> usize {
        let place = (along(bounds.middle(), self.axis) - self.low) * self.factor;
        // Saturates, and takes NaN to 0.
        (place.to_u32() as usize).min(BINS - 1)
    }
}

struct Builder<'b, 'a, T> {
    geometry: &'b Geometry<'a, T>,
    entries: &'b [Cell<u32>],
}

impl<T: Scalar> Builder<'_, '_, T> {
    fn cells(&self, range: Range) -> &[Cell<u32>] {
        self.entries
            .get(range.first..range.first + range.count)
            .unwrap_or_default()
    }

    /// The boxes of some objects.
    fn boxes(&self, range: Range) -> impl Iterator<Item = Bounds<T>> {
        self.cells(range)
            .iter()
            .map(|entry| Bounds::around(self.geometry, entry.get()))
    }

    fn leaf(&self, range: Range) -> BvhNode<T> {
        let bounds = self
            .boxes(range)
            .fold(Bounds::nothing(), Bounds::around_both);
        BvhNode::new(
            bounds.low,
            bounds.high,
            NodeContent::Leaf {
                first: range.first as u32,
                count: range.count as u32,
            },
        )
    }

    /// Divides the objects of a leaf if that pays, and tells along which axis. `levels` more may
    /// follow.
    fn divide(&self, node: &BvhNode<T>, levels: usize) -> Option<(usize, [Range; 2])> {
        let NodeContent::Leaf { first, count } = node.content() else {
            return None;
        };
        let range = Range {
            first: first as usize,
            count: count as usize,
        };
        if range.count < 2 * SMALLEST_LEAF || levels == 0 {
            return None;
        }
        let middles = self.boxes(range).fold(Bounds::nothing(), |middles, b| {
            let middle = b.middle();
            middles.around_both(Bounds {
                low: middle,
                high: middle,
            })
        });
        let scale = |axis| {
            let low = along(middles.low, axis);
            Scale {
                axis,
                low,
                factor: T::from_i32(BINS as i32) / (along(middles.high, axis) - low),
            }
        };
        let cut = (0..3)
            .map(scale)
            .filter(|scale| scale.factor.is_finite() && scale.factor > T::ZERO)
            .filter_map(|scale| self.cheapest_cut(range, &scale))
            .fold(None::<Cut<T>>, |best, cut| match best {
                Some(best) if !(cut.cost < best.cost) => Some(best),
                _ => Some(cut),
            });
        let area = Bounds {
            low: node.low(),
            high: node.high(),
        }
        .half_area();
        match cut {
            // Two boxes are tested in place of all objects.
            Some(cut)
                if range.count <= LARGEST_LEAF
                    && !(cut.cost + area * T::TWO < area * T::from_i32(count as i32)) =>
            {
                None
            }
            Some(cut) if fits(cut.lower.max(range.count - cut.lower), levels - 1) => {
                self.partition(range, &scale(cut.axis), cut.bin);
                Some((cut.axis, range.halves(cut.lower)))
            }
            // Too deep, or all objects are in one place: halve the number.
            _ if range.count > LARGEST_LEAF => Some((0, range.halves(range.count / 2))),
            _ => None,
        }
    }

    /// The best place to divide some objects along an axis, with at least two on each side.
    fn cheapest_cut(&self, range: Range, scale: &Scale<T>) -> Option<Cut<T>> {
        let mut bins = [(0_usize, Bounds::nothing()); BINS];
        for bounds in self.boxes(range) {
            if let Some((count, all)) = bins.get_mut(scale.bin(&bounds)) {
                *count += 1;
                *all = all.around_both(bounds);
            }
        }
        let cost =
            |count: usize, bounds: &Bounds<T>| bounds.half_area() * T::from_i32(count as i32);
        // What is above each bin costs …
        let mut above = [T::ZERO; BINS];
        let (mut count, mut all) = (0, Bounds::nothing());
        for ((bin_count, bounds), above) in bins.iter().zip(&mut above).rev() {
            *above = if count > 0 {
                cost(count, &all)
            } else {
                T::ZERO
            };
            count += bin_count;
            all = all.around_both(*bounds);
        }
        // … and what is below.
        let mut best = None::<Cut<T>>;
        let (mut lower, mut all) = (0, Bounds::nothing());
        for (bin, ((bin_count, bounds), above)) in (1..).zip(bins.iter().zip(above)) {
            lower += bin_count;
            all = all.around_both(*bounds);
            if lower < SMALLEST_LEAF || range.count - lower < SMALLEST_LEAF {
                continue;
            }
            let cost = cost(lower, &all) + above;
            if best.is_none_or(|best| cost < best.cost) {
                best = Some(Cut {
                    axis: scale.axis,
                    bin,
                    lower,
                    cost,
                });
            }
        }
        best
    }

    /// Puts the objects of the lower bins first.
    fn partition(&self, range: Range, scale: &Scale<T>, first_upper_bin: usize) {
        let cells = self.cells(range);
        let mut lower = cells.iter();
        for cell in cells {
            let entry = cell.get();
            if scale.bin(&Bounds::around(self.geometry, entry)) < first_upper_bin
                && let Some(place) = lower.next()
            {
                cell.set(place.get());
                place.set(entry);
            }
        }
    }
}

/// Whether halving `count` objects `levels` times leaves small leaves.
fn fits(count: usize, levels: usize) -> bool {
    count >> levels.min(usize::BITS as usize - 1) <= 1
}
