//! A hierarchy of boxes around the spheres and triangles of a large scene: the data; how it is built and
//! walked is told in [`super`].

use crate::scalar::Scalar;
use crate::vec3::Vec3;

/// A view of a bounding-volume hierarchy in pools or in flash.
///
/// Invariants, which its walk relies on: there are no nodes, or the first is the root; the children of a node
/// come later than it, side by side; no leaf is more than [`Bvh::MAX_DEPTH`] steps from the root; every
/// bounded object of the scene is in one leaf.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bvh<'a, T = f32> {
    /// Boxes.
    pub nodes: &'a [BvhNode<T>],
    /// The indices of the objects in the leaves, leaf by leaf.
    pub entries: &'a [u32],
}

impl<T> Bvh<'_, T> {
    /// The largest number of steps from the root to a leaf.
    pub const MAX_DEPTH: usize = 31;

    /// With fewer bounded objects than this a hierarchy does not pay, and none is built.
    pub const FEWEST_OBJECTS: usize = 48;

    /// No hierarchy: every object of a set is tested.
    pub const NONE: Self = Self {
        nodes: &[],
        entries: &[],
    };

    /// Whether there is a hierarchy.
    #[inline(always)]
    pub const fn is_some(&self) -> bool {
        !self.nodes.is_empty()
    }
}

/// A box that holds what rays can hit of the objects below, with a margin for the rounding of their
/// tests.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BvhNode<T = f32> {
    /// The lowest and the highest coordinate of each axis.
    bounds: [[T; 2]; 3],
    first: u32,
    /// The number of entries of a leaf; otherwise the axis, marked.
    kind: u32,
}

/// What is in the box of a node.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NodeContent {
    /// Objects.
    Leaf {
        /// Index of the first of them in [`Bvh::entries`].
        first: u32,
        /// Their number, at least 1.
        count: u32,
    },
    /// Two nodes.
    Inner {
        /// Index of the first of them in [`Bvh::nodes`]; the other one follows it.
        first: u32,
        /// The axis along which the first lies below the other: 0, 1 or 2 for x, y or z.
        axis: usize,
    },
}

impl<T: Scalar> BvhNode<T> {
    const INNER: u32 = 1 << 31;

    /// A node from what [`BvhNode::low`], [`BvhNode::high`] and [`BvhNode::content`] tell of it.
    pub const fn new(low: Vec3<T>, high: Vec3<T>, content: NodeContent) -> Self {
        let (first, kind) = match content {
            NodeContent::Leaf { first, count } => (first, count),
            NodeContent::Inner { first, axis } => (first, axis as u32 | Self::INNER),
        };
        Self {
            bounds: [[low.x, high.x], [low.y, high.y], [low.z, high.z]],
            first,
            kind,
        }
    }

    /// The corner of the lowest coordinates.
    pub const fn low(&self) -> Vec3<T> {
        let [[x, _], [y, _], [z, _]] = self.bounds;
        Vec3::new(x, y, z)
    }

    /// The corner of the highest coordinates.
    pub const fn high(&self) -> Vec3<T> {
        let [[_, x], [_, y], [_, z]] = self.bounds;
        Vec3::new(x, y, z)
    }

    /// The lowest and the highest coordinate of each axis.
    #[inline(always)]
    pub(crate) const fn bounds(&self) -> &[[T; 2]; 3] {
        &self.bounds
    }

    /// What is in it.
    #[inline(always)]
    pub const fn content(&self) -> NodeContent {
        let (first, kind) = (self.first, self.kind);
        if kind & Self::INNER == 0 {
            NodeContent::Leaf { first, count: kind }
        } else {
            NodeContent::Inner {
                first,
                axis: (kind & !Self::INNER) as usize,
            }
        }
    }
}
