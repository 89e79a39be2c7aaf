//! Sixteen lanes at once, in the instructions that the machine has.
//!
//! Every instruction set computes the same bits: the operations and their order are those of the scalar formulas,
//! and none is fused.

#[cfg(target_arch = "x86_64")]
mod avx2;
#[cfg(target_arch = "x86_64")]
mod avx512;
mod instructions;
mod portable;

pub use instructions::Instructions;
pub(crate) use instructions::{Task, dispatch};
#[cfg(test)]
pub(crate) use portable::Portable;

use crate::block::Block;
use crate::node::Node;

/// Operations on sixteen lanes; bit i of a mask is lane i.
pub(crate) trait Lanes {
    /// Sixteen `f32`.
    type Floats: Copy;

    /// [`distance_squared`](crate::distance_squared) of each point of a block.
    fn to_points(block: &Block, query: &[f32; 3]) -> Self::Floats;

    /// Squared distance to the nearest point of each child's box, never above the computed one of any point in it.
    fn to_boxes(node: &Node, query: &[f32; 3]) -> Self::Floats;

    /// Which lanes are at most `reach`; never a NaN.
    fn within(lanes: Self::Floats, reach: f32) -> u16;

    /// The lanes as an array.
    fn store(lanes: Self::Floats) -> [f32; 16];

    /// Which of the masked keys are greater than `key`.
    fn greater(keys: &[u32; 16], mask: u16, key: u32) -> u16;

    /// Moves the masked lanes to the front of `values`, and their numbers, counted from `first`, to that of
    /// `indices`. What follows them there is overwritten too.
    fn compress(lanes: Self::Floats, mask: u16, first: u32, values: &mut [f32; 16], indices: &mut [u32; 16]);

    /// How many values are at most `limit`.
    fn count(values: &[f32], limit: f32) -> usize;

    /// The values as lanes.
    fn load(values: &[f32; 16]) -> Self::Floats;

    /// Moves the masked values to the front of `kept`, overwriting what follows.
    fn compress_indices(indices: &[u32; 16], mask: u16, kept: &mut [u32; 16]);

    /// Moves the values whose bits are set, sixteen a mask, to the front of `low`, and the others to the front of `high`,
    /// either in their order. There must be room; of the fifteen values that follow there, any are overwritten.
    fn part(values: &[[f32; 16]], masks: &[u16], low: &mut [f32], high: &mut [f32]);

    /// The lesser of each pair of lanes.
    fn min(a: Self::Floats, b: Self::Floats) -> Self::Floats;

    /// The greater of each pair of lanes.
    fn max(a: Self::Floats, b: Self::Floats) -> Self::Floats;

    /// Asks for the cache lines of `items`, which will be read soon.
    fn prefetch<T>(items: &[T]);

    /// Adds row i of `values` to row i of `sums` where bit i is set; both hold sixteen rows of `N`, one after another.
    fn add_rows<const N: usize>(sums: &mut [Self::Floats; N], values: &[f32], mask: u16);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bounds::Bounds;
    use proptest::prelude::*;

    /// The bits of every operation on one block, one node and one list.
    struct Everything<'a>(&'a Block, &'a Node, [f32; 3], f32, &'a [f32]);

    impl Task for Everything<'_> {
        type Output = (Vec<u32>, Vec<usize>);

        #[inline(always)]
        fn run<L: Lanes>(self) -> Self::Output {
            let Self(block, node, query, reach, list) = self;
            let (points, boxes) = (L::to_points(block, &query), L::to_boxes(node, &query));
            let mask = L::within(points, reach);
            let keys = L::store(boxes).map(f32::to_bits);
            let (mut values, mut indices, mut kept) = ([0.0; 16], [0; 16], [0; 16]);
            L::compress(points, mask, 77, &mut values, &mut indices);
            L::compress_indices(&keys, mask, &mut kept);
            let set = 2 * mask.count_ones() as usize;
            let (mut roomy, mut low, mut high) = ([0.0; 48], vec![0.0; set], vec![0.0; 32 - set]);
            let both = [L::store(points), L::store(boxes)];
            L::part(&both, &[mask; 2], &mut low, &mut high);
            L::part(&both, &[mask; 2], &mut roomy, &mut [0.0; 48]);
            let count = mask.count_ones() as usize;
            let zero = L::load(&[0.0; 16]);
            let (mut three, mut five) = ([zero; 3], [zero; 5]);
            L::add_rows(&mut three, list, mask);
            L::add_rows(&mut five, list, mask);
            let floats = L::store(points).into_iter().chain(L::store(boxes)).chain(values[..count].to_vec());
            let floats = floats.chain(roomy[..set].to_vec()).chain(low).chain(high);
            let floats = floats.chain(L::store(L::min(points, boxes))).chain(L::store(L::max(points, boxes)));
            let sums = three.into_iter().chain(five).flat_map(L::store);
            let mut bits: Vec<u32> = floats.chain(sums).map(f32::to_bits).collect();
            bits.extend(indices[..count].iter().chain(&kept[..count]));
            let greater = L::greater(&keys, mask, keys[3]).into();
            (bits, vec![mask.into(), L::within(boxes, reach).into(), greater, L::count(list, reach)])
        }
    }

    fn coordinate() -> impl Strategy<Value = f32> {
        prop_oneof![-2f32..2.0, any::<f32>().prop_filter("finite", |x| x.is_finite()), -1e-20f32..1e-20, Just(-0.0f32)]
    }

    proptest! {
        #[test]
        fn every_instruction_set_computes_the_scalar_bits(
            points in prop::collection::vec(prop::array::uniform3(coordinate()), 16),
            others in prop::collection::vec(prop::array::uniform3(coordinate()), 16),
            query in prop::array::uniform3(coordinate()),
            reach in prop_oneof![0f32..9.0, Just(f32::INFINITY)],
            list in prop::collection::vec(0f32..9.0, 85),
        ) {
            let block = Block::of(points.iter().copied());
            let mut node = Node::new(0, 1);
            let boxes = points.iter().zip(&others).map(|(&a, &b)| Bounds::around([a, b])).collect::<Vec<_>>();
            boxes.iter().for_each(|bounds| node.push(bounds, 1, false));
            let run = |set| dispatch(set, Everything(&block, &node, query, reach, &list));
            let (bits, masks) = run(Instructions::Portable);
            for lane in 0..16 {
                prop_assert_eq!(bits[lane], crate::distance_squared(query, points[lane]).to_bits());
                prop_assert_eq!(bits[16 + lane], boxes[lane].distance_squared(query).to_bits());
            }
            for set in [Instructions::Avx2, Instructions::Avx512].into_iter().filter(|set| set.is_available()) {
                prop_assert_eq!((&bits, &masks), (&run(set).0, &run(set).1), "{:?}", set);
            }
        }
    }
}
