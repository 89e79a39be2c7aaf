//! Lanes as AVX-512 registers.
#![allow(unsafe_code)] // Intrinsics; the peers bench measures 1.5 to 3 times the portable lanes.

use std::arch::x86_64::*;

use super::{Lanes, portable::Portable};
use crate::block::Block;
use crate::node::Node;

/// Only to be named inside [`dispatch`](super::dispatch), which has asked the processor: that is what makes every
/// `unsafe` below sound. The pointers are those of arrays as long as the load or store.
pub(crate) struct Avx512;

/// Adds the squares of three differences, in the order of [`distance_squared`](crate::distance_squared).
#[inline]
#[target_feature(enable = "avx512f")]
fn sum_of_squares([x, y, z]: [__m512; 3]) -> __m512 {
    let xy = _mm512_add_ps(_mm512_mul_ps(x, x), _mm512_mul_ps(y, y));
    _mm512_add_ps(xy, _mm512_mul_ps(z, z))
}

/// How many values are at most `limit`, counted in lanes.
#[inline]
#[target_feature(enable = "avx512f")]
fn count_many(blocks: &[[f32; 16]], limit: f32) -> u32 {
    let (limit, one) = (_mm512_set1_ps(limit), _mm512_set1_epi32(1));
    let mut counts = [_mm512_setzero_si512(); 4];
    let (fours, rest) = blocks.as_chunks::<4>();
    for four in fours {
        for i in 0..4 {
            let mask = _mm512_cmp_ps_mask::<_CMP_LE_OQ>(unsafe { _mm512_loadu_ps(four[i].as_ptr()) }, limit);
            counts[i] = _mm512_mask_add_epi32(counts[i], mask, counts[i], one);
        }
    }
    for (i, block) in rest.iter().enumerate() {
        let mask = _mm512_cmp_ps_mask::<_CMP_LE_OQ>(unsafe { _mm512_loadu_ps(block.as_ptr()) }, limit);
        counts[i] = _mm512_mask_add_epi32(counts[i], mask, counts[i], one);
    }
    let sum = |a, b| _mm512_add_epi32(a, b);
    _mm512_reduce_add_epi32(sum(sum(counts[0], counts[1]), sum(counts[2], counts[3]))) as u32
}

/// As many lanes as there is room for.
#[inline]
#[target_feature(enable = "avx512f")]
fn store_some(room: &mut [f32], lanes: __m512) {
    unsafe {
        if room.len() >= 16 {
            _mm512_storeu_ps(room.as_mut_ptr(), lanes);
        } else {
            _mm512_mask_storeu_ps(room.as_mut_ptr(), (1 << room.len()) - 1, lanes);
        }
    }
}

impl Lanes for Avx512 {
    type Floats = __m512;

    #[inline(always)]
    fn to_points(block: &Block, query: &[f32; 3]) -> __m512 {
        unsafe {
            let gap =
                |axis: usize| _mm512_sub_ps(_mm512_set1_ps(query[axis]), _mm512_load_ps(block.axes[axis].as_ptr()));
            sum_of_squares([gap(0), gap(1), gap(2)])
        }
    }

    #[inline(always)]
    fn to_boxes(node: &Node, query: &[f32; 3]) -> __m512 {
        unsafe {
            let gap = |axis: usize| {
                let at = _mm512_set1_ps(query[axis]);
                let above = _mm512_max_ps(at, _mm512_load_ps(node.lo[axis].as_ptr()));
                _mm512_sub_ps(at, _mm512_min_ps(above, _mm512_load_ps(node.hi[axis].as_ptr())))
            };
            sum_of_squares([gap(0), gap(1), gap(2)])
        }
    }

    #[inline(always)]
    fn within(lanes: __m512, reach: f32) -> u16 {
        unsafe { _mm512_cmp_ps_mask::<_CMP_LE_OQ>(lanes, _mm512_set1_ps(reach)) }
    }

    #[inline(always)]
    fn store(lanes: __m512) -> [f32; 16] {
        let mut values = [0.0; 16];
        unsafe { _mm512_storeu_ps(values.as_mut_ptr(), lanes) };
        values
    }

    #[inline(always)]
    fn greater(keys: &[u32; 16], mask: u16, key: u32) -> u16 {
        unsafe {
            let keys = _mm512_loadu_si512(keys.as_ptr().cast());
            _mm512_mask_cmpgt_epu32_mask(mask, keys, _mm512_set1_epi32(key as i32))
        }
    }

    /// Compressed in the register and stored whole: compressing stores are many times slower on Zen 4.
    #[inline(always)]
    fn compress(lanes: __m512, mask: u16, first: u32, values: &mut [f32; 16], indices: &mut [u32; 16]) {
        unsafe {
            let numbers = _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
            let numbers = _mm512_add_epi32(numbers, _mm512_set1_epi32(first as i32));
            _mm512_storeu_ps(values.as_mut_ptr(), _mm512_maskz_compress_ps(mask, lanes));
            _mm512_storeu_si512(indices.as_mut_ptr().cast(), _mm512_maskz_compress_epi32(mask, numbers));
        }
    }

    #[inline(always)]
    fn count(values: &[f32], limit: f32) -> usize {
        let (blocks, rest) = values.as_chunks::<16>();
        let full: u32 = if blocks.len() < 16 {
            blocks.iter().map(|block| Self::within(Self::load(block), limit).count_ones()).sum()
        } else {
            unsafe { count_many(blocks, limit) }
        };
        full as usize + Portable::count(rest, limit)
    }

    #[inline(always)]
    fn load(values: &[f32; 16]) -> __m512 {
        unsafe { _mm512_loadu_ps(values.as_ptr()) }
    }

    #[inline(always)]
    fn compress_indices(indices: &[u32; 16], mask: u16, kept: &mut [u32; 16]) {
        unsafe {
            let indices = _mm512_loadu_si512(indices.as_ptr().cast());
            _mm512_storeu_si512(kept.as_mut_ptr().cast(), _mm512_maskz_compress_epi32(mask, indices));
        }
    }

    #[inline(always)]
    fn part(values: &[[f32; 16]], masks: &[u16], low: &mut [f32], high: &mut [f32]) {
        let (mut lows, mut highs) = (0, 0);
        for (values, &mask) in values.iter().zip(masks) {
            unsafe {
                let lanes = Self::load(values);
                store_some(&mut low[lows..], _mm512_maskz_compress_ps(mask, lanes));
                store_some(&mut high[highs..], _mm512_maskz_compress_ps(!mask, lanes));
            }
            lows += mask.count_ones() as usize;
            highs += mask.count_zeros() as usize;
        }
    }

    #[inline(always)]
    fn min(a: __m512, b: __m512) -> __m512 {
        unsafe { _mm512_min_ps(a, b) }
    }

    #[inline(always)]
    fn max(a: __m512, b: __m512) -> __m512 {
        unsafe { _mm512_max_ps(a, b) }
    }

    #[inline(always)]
    fn prefetch<T>(items: &[T]) {
        Portable::prefetch(items);
    }

    #[inline(always)]
    fn add_rows<const N: usize>(sums: &mut [__m512; N], values: &[f32], mask: u16) {
        if N > 4 {
            let mut arrays = sums.map(Self::store);
            Portable::add_rows(&mut arrays, values, mask);
            *sums = arrays.map(|array| Self::load(&array));
            return;
        }
        // Each bit spread over the N floats of its row: 16 N bits.
        let spread = const {
            let (mut spread, mut row) = (0u64, 0);
            while row < 16 && N <= 4 {
                spread |= 1 << (row * N);
                row += 1;
            }
            spread
        };
        let (blocks, _) = values.as_chunks::<16>();
        unsafe {
            let firsts = _pdep_u64(u64::from(mask), spread);
            let floats = if N == 4 { (firsts << 4).wrapping_sub(firsts) } else { firsts * ((1 << N) - 1) };
            for (i, (sum, block)) in sums.iter_mut().zip(blocks).enumerate() {
                let mask = (floats >> (16 * i)) as u16;
                *sum = _mm512_mask_add_ps(*sum, mask, *sum, Self::load(block));
            }
        }
    }
}
