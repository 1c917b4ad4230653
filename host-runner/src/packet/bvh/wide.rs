//! A hierarchy of spheres for single rays: eight boxes a node and eight spheres a leaf, which are tested at once.

use scanray::Vec3;
use scanray::accel::{Bvh, BvhNode, NodeContent};

use super::single::MOST_PENDING;
use super::{LeafObject, PairBvh};
use crate::packet::lanes::LANES;

/// The tree of a scene, collapsed: a node has the subtrees of about three levels below it, and what has at most
/// eight spheres is a leaf. The first node is the root.
#[derive(Debug, Default)]
pub(super) struct WideBvh {
    pub(super) nodes: Vec<WideNode>,
    pub(super) leaves: Vec<WideLeaf>,
}

/// Eight subtrees or fewer; the boxes of those that are not there are hit by no ray.
#[derive(Clone, Debug)]
#[repr(align(64))]
pub(super) struct WideNode {
    /// By axis, the lowest and the highest coordinates of each box.
    pub(super) bounds: [[[f32; LANES]; 2]; 3],
    pub(super) children: [WideChild; LANES],
}

/// Index of a node or, marked, of a leaf.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct WideChild(pub(super) u32);

impl WideChild {
    const LEAF: u32 = 1 << 31;

    /// The leaf, if it is one.
    #[inline(always)]
    pub(super) fn leaf(self) -> Option<usize> {
        (self.0 & Self::LEAF != 0).then_some((self.0 & !Self::LEAF) as usize)
    }
}

/// Some of the subtrees of a node: where a part of the tree begins.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct WidePart {
    pub(super) node: u32,
    /// A bit for each.
    pub(super) children: u8,
}

/// Up to eight spheres. Those that are not there are hit by no ray.
#[derive(Clone, Debug)]
#[repr(align(64))]
pub(super) struct WideLeaf {
    /// The centres, by axis.
    pub(super) center: [[f32; LANES]; 3],
    pub(super) radius_squared: [f32; LANES],
    /// Indices among all objects.
    pub(super) index: [u32; LANES],
    /// A bit for each that casts a shadow.
    pub(super) casts_shadow: u8,
}

impl WideLeaf {
    fn new<'o, 'a: 'o>(objects: impl Iterator<Item = &'o LeafObject<'a>>) -> Self {
        let mut leaf = Self {
            center: [[0.0; LANES]; 3],
            // Less every square is no square.
            radius_squared: [f32::NEG_INFINITY; LANES],
            index: [0; LANES],
            casts_shadow: 0,
        };
        for (lane, object) in objects.enumerate() {
            let Vec3 { x, y, z } = object.bounds.center;
            for (row, coordinate) in leaf.center.iter_mut().zip([x, y, z]) {
                row[lane] = coordinate;
            }
            leaf.radius_squared[lane] = object.bounds.radius_squared;
            leaf.index[lane] = object.index;
            leaf.casts_shadow |= u8::from(object.casts_shadow) << lane;
        }
        leaf
    }
}

impl WideNode {
    fn new(boxes: impl Iterator<Item = [Vec3; 2]>) -> Self {
        let mut node = Self {
            bounds: [[[f32::INFINITY; LANES], [f32::NEG_INFINITY; LANES]]; 3],
            children: [WideChild(0); LANES],
        };
        for (lane, [low, high]) in boxes.enumerate() {
            let axes = [[low.x, high.x], [low.y, high.y], [low.z, high.z]];
            for (rows, ends) in node.bounds.iter_mut().zip(axes) {
                for (row, end) in rows.iter_mut().zip(ends) {
                    row[lane] = end;
                }
            }
        }
        node
    }
}

impl WideBvh {
    /// Collapses a hierarchy, none of whose leaves has more than eight objects, and enters in the pairs which part
    /// of the wide hierarchy each of them is. `pair_of` has the pair of each inner node of the hierarchy, and the first
    /// object of each leaf. Nothing for a hierarchy that is too deep for a walk.
    pub(super) fn new(bvh: Bvh<'_>, pairs: &mut PairBvh<'_>, pair_of: &[u32]) -> Option<Self> {
        let collapse = Collapse::of(bvh);
        let mut new = Self::default();
        // Nodes of the hierarchy that become wide ones, where they are entered, and how deep they are.
        let mut pending = vec![(0, None::<(usize, usize)>, 1)];
        while let Some((root, place, depth)) = pending.pop() {
            // All but one of the subtrees of each node on the way down wait.
            if depth * (LANES - 1) >= MOST_PENDING {
                return None;
            }
            let index = new.nodes.len();
            let (children, within) = collapse.subtrees(root);
            for (node, children) in within {
                pairs.nodes[pair_of[node] as usize].wide = WidePart {
                    node: index as u32,
                    children,
                };
            }
            let boxes = children.iter().map(|child| collapse.bounds(*child));
            new.nodes.push(WideNode::new(boxes));
            for (lane, child) in children.into_iter().enumerate() {
                if collapse.counts[child] as usize > LANES {
                    pending.push((child, Some((index, lane)), depth + 1));
                    continue;
                }
                let part = WidePart {
                    node: index as u32,
                    children: 1 << lane,
                };
                let objects = collapse.leaves_below(child, |node| {
                    pairs.nodes[pair_of[node] as usize].wide = part;
                });
                let objects = objects.iter().flat_map(|(leaf, count)| {
                    &pairs.leaves[pair_of[*leaf] as usize..][..*count as usize]
                });
                new.nodes[index].children[lane] =
                    WideChild(new.leaves.len() as u32 | WideChild::LEAF);
                new.leaves.push(WideLeaf::new(objects));
            }
            if let Some((node, lane)) = place {
                new.nodes[node].children[lane] = WideChild(index as u32);
            }
        }
        Some(new)
    }
}

/// A hierarchy that is collapsed.
struct Collapse<'t> {
    bvh: Bvh<'t>,
    /// Objects below each node.
    counts: Vec<u32>,
}

impl<'t> Collapse<'t> {
    fn of(bvh: Bvh<'t>) -> Self {
        let mut counts = vec![0; bvh.nodes.len()];
        // Children come later.
        for (index, node) in bvh.nodes.iter().enumerate().rev() {
            counts[index] = match node.content() {
                NodeContent::Leaf { count, .. } => count,
                NodeContent::Inner { first, .. } => {
                    counts[first as usize] + counts[first as usize + 1]
                }
            };
        }
        Self { bvh, counts }
    }

    fn bounds(&self, node: usize) -> [Vec3; 2] {
        let node: &BvhNode = &self.bvh.nodes[node];
        [node.low(), node.high()]
    }

    fn half_area(&self, node: usize) -> f32 {
        let [low, high] = self.bounds(node);
        let size = high - low;
        size.x * size.y + size.y * size.z + size.z * size.x
    }

    /// Up to eight nodes that share the objects below a node, from dividing the largest as long as there is
    /// one with more than a leaf holds; and the nodes that were divided, each with the bits of those
    /// below it. A node that is not divided is all there is.
    fn subtrees(&self, root: usize) -> (Vec<usize>, Vec<(usize, u8)>) {
        let mut children = vec![root];
        let mut divided: Vec<(usize, u8)> = Vec::new();
        while children.len() < LANES {
            let large = (0..children.len()).filter(|i| self.counts[children[*i]] as usize > LANES);
            let largest = large.max_by(|i, j| {
                let area = |i: &usize| self.half_area(children[*i]);
                area(i).total_cmp(&area(j))
            });
            let Some(lower) = largest else { break };
            let node = children[lower];
            let NodeContent::Inner { first, .. } = self.bvh.nodes[node].content() else {
                break;
            };
            let upper = children.len();
            children[lower] = first as usize;
            children.push(first as usize + 1);
            for (_, below) in &mut divided {
                *below |= (*below >> lower & 1) << upper;
            }
            divided.push((node, 1 << lower | 1 << upper));
        }
        (children, divided)
    }

    /// The leaves below a node, with their numbers of objects; `inner` is told of the nodes above them.
    fn leaves_below(&self, node: usize, mut inner: impl FnMut(usize)) -> Vec<(usize, u32)> {
        let mut leaves = Vec::new();
        let mut pending = vec![node];
        while let Some(node) = pending.pop() {
            match self.bvh.nodes[node].content() {
                NodeContent::Leaf { count, .. } => leaves.push((node, count)),
                NodeContent::Inner { first, .. } => {
                    inner(node);
                    pending.extend([first as usize + 1, first as usize]);
                }
            }
        }
        leaves
    }
}
