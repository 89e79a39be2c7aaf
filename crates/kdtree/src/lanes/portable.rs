//! Lanes as arrays, which compilers turn into the vector instructions they may use.

use super::Lanes;
use crate::block::Block;
use crate::node::Node;

/// No instruction set assumed.
pub(crate) struct Portable;

/// Every value goes to both sides and stays where the place is then taken: no branch is to be guessed.
#[inline(always)]
fn deal(values: &[f32; 16], mask: u16, low: &mut [f32; 16], high: &mut [f32; 16]) {
    let (mut lows, mut highs) = (0, 0);
    for (lane, &value) in values.iter().enumerate() {
        low[lows & 15] = value;
        high[highs & 15] = value;
        let is_low = usize::from(mask >> lane & 1);
        lows += is_low;
        highs += 1 - is_low;
    }
}

impl Lanes for Portable {
    type Floats = [f32; 16];

    #[inline(always)]
    fn to_points(block: &Block, query: &[f32; 3]) -> [f32; 16] {
        let mut distances = [0.0; 16];
        for lane in 0..16 {
            let dx = query[0] - block.axes[0][lane];
            let dy = query[1] - block.axes[1][lane];
            let dz = query[2] - block.axes[2][lane];
            distances[lane] = ((dx * dx) + (dy * dy)) + (dz * dz);
        }
        distances
    }

    #[inline(always)]
    fn to_boxes(node: &Node, query: &[f32; 3]) -> [f32; 16] {
        let mut distances = [0.0; 16];
        for lane in 0..16 {
            let gap = |axis: usize| {
                // Comparisons rather than `max` and `min`, which pay for NaN that cannot occur here.
                let (lo, hi) = (node.lo[axis][lane], node.hi[axis][lane]);
                let above = if query[axis] > lo { query[axis] } else { lo };
                query[axis] - if above < hi { above } else { hi }
            };
            let (dx, dy, dz) = (gap(0), gap(1), gap(2));
            distances[lane] = ((dx * dx) + (dy * dy)) + (dz * dz);
        }
        distances
    }

    #[inline(always)]
    fn within(lanes: [f32; 16], reach: f32) -> u16 {
        let mut bits = [0u16; 16];
        for lane in 0..16 {
            bits[lane] = if lanes[lane] <= reach { 1 << lane } else { 0 };
        }
        bits.iter().fold(0, |mask, bit| mask | bit)
    }

    #[inline(always)]
    fn store(lanes: [f32; 16]) -> [f32; 16] {
        lanes
    }

    #[inline(always)]
    fn greater(keys: &[u32; 16], mask: u16, key: u32) -> u16 {
        let mut bits = [0u16; 16];
        for lane in 0..16 {
            bits[lane] = if keys[lane] > key { 1 << lane } else { 0 };
        }
        bits.iter().fold(0, |all, bit| all | bit) & mask
    }

    #[inline(always)]
    fn compress(lanes: [f32; 16], mut mask: u16, first: u32, values: &mut [f32; 16], indices: &mut [u32; 16]) {
        let mut next = 0;
        while mask != 0 {
            let lane = mask.trailing_zeros() as usize;
            values[next & 15] = lanes[lane];
            indices[next & 15] = first + lane as u32;
            next += 1;
            mask &= mask - 1;
        }
    }

    #[inline(always)]
    fn count(values: &[f32], limit: f32) -> usize {
        values.iter().map(|&value| u32::from(value <= limit)).sum::<u32>() as usize
    }

    #[inline(always)]
    fn load(values: &[f32; 16]) -> [f32; 16] {
        *values
    }

    #[inline(always)]
    fn compress_indices(indices: &[u32; 16], mut mask: u16, kept: &mut [u32; 16]) {
        let mut next = 0;
        while mask != 0 {
            kept[next & 15] = indices[mask.trailing_zeros() as usize];
            next += 1;
            mask &= mask - 1;
        }
    }

    #[inline(always)]
    fn part(values: &[[f32; 16]], masks: &[u16], low: &mut [f32], high: &mut [f32]) {
        let (mut lows, mut highs) = (0, 0);
        for (values, &mask) in values.iter().zip(masks) {
            let (low, high) = (&mut low[lows..], &mut high[highs..]);
            if let (Some(low), Some(high)) = (low.first_chunk_mut(), high.first_chunk_mut()) {
                deal(values, mask, low, high);
            } else {
                let (mut below, mut above) = ([0.0; 16], [0.0; 16]);
                deal(values, mask, &mut below, &mut above);
                low.iter_mut().zip(below).for_each(|(low, value)| *low = value);
                high.iter_mut().zip(above).for_each(|(high, value)| *high = value);
            }
            lows += mask.count_ones() as usize;
            highs += mask.count_zeros() as usize;
        }
    }

    #[inline(always)]
    fn min(a: [f32; 16], b: [f32; 16]) -> [f32; 16] {
        let mut least = b;
        for lane in 0..16 {
            least[lane] = if a[lane] < b[lane] { a[lane] } else { b[lane] };
        }
        least
    }

    #[inline(always)]
    fn max(a: [f32; 16], b: [f32; 16]) -> [f32; 16] {
        let mut greatest = b;
        for lane in 0..16 {
            greatest[lane] = if a[lane] > b[lane] { a[lane] } else { b[lane] };
        }
        greatest
    }

    #[inline(always)]
    #[cfg_attr(target_arch = "x86_64", allow(unsafe_code))] // A hint, for random queries wait for memory.
    fn prefetch<T>(items: &[T]) {
        #[cfg(target_arch = "x86_64")]
        for line in (0..size_of_val(items)).step_by(64) {
            use std::arch::x86_64::{_MM_HINT_T0, _mm_prefetch};
            // SAFETY: every x86-64 processor has the instruction, and a hint touches no memory.
            unsafe { _mm_prefetch::<_MM_HINT_T0>(items.as_ptr().cast::<i8>().wrapping_add(line)) };
        }
        #[cfg(not(target_arch = "x86_64"))]
        let _ = items;
    }

    #[inline(always)]
    fn add_rows<const N: usize>(sums: &mut [[f32; 16]; N], values: &[f32], mut mask: u16) {
        let sums = sums.as_flattened_mut();
        while mask != 0 {
            let row = mask.trailing_zeros() as usize * N;
            for (sum, value) in sums[row..row + N].iter_mut().zip(&values[row..row + N]) {
                *sum += value;
            }
            mask &= mask - 1;
        }
    }
}
