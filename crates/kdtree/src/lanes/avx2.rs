//! Lanes as pairs of AVX registers.
#![allow(unsafe_code)] // Intrinsics, for compilers make no masks of comparisons: see the peers bench.

use std::arch::x86_64::*;

use super::{Lanes, portable::Portable};
use crate::block::Block;
use crate::node::Node;

/// Only to be named inside [`dispatch`](super::dispatch), which has asked the processor: that is what makes every
/// `unsafe` below sound. The pointers are those of arrays as long as the loads or stores.
pub(crate) struct Avx2;

/// For each mask of eight lanes the numbers of the masked ones, a byte each, the lowest first. A table rather than `pext`,
/// which is slow before Zen 3.
static MASKED_LANES: [[u8; 8]; 256] = {
    let mut table = [[0; 8]; 256];
    let mut mask = 0;
    while mask < 256 {
        let (mut lane, mut next) = (0, 0);
        while lane < 8 {
            if mask >> lane & 1 == 1 {
                table[mask][next] = lane as u8;
                next += 1;
            }
            lane += 1;
        }
        mask += 1;
    }
    table
};

/// For each mask of eight rows of `N` floats, the mask of the floats.
const fn masked_floats<const N: usize>() -> [u32; 256] {
    let mut table = [0; 256];
    let mut mask = 0;
    while mask < 256 {
        let mut row = 0;
        while row < 8 {
            if mask >> row & 1 == 1 {
                table[mask] |= ((1 << N) - 1) << (row * N);
            }
            row += 1;
        }
        mask += 1;
    }
    table
}

/// Adds the squares of three differences, in the order of [`distance_squared`](crate::distance_squared).
#[inline]
#[target_feature(enable = "avx2")]
fn sum_of_squares([x, y, z]: [__m256; 3]) -> __m256 {
    let xy = _mm256_add_ps(_mm256_mul_ps(x, x), _mm256_mul_ps(y, y));
    _mm256_add_ps(xy, _mm256_mul_ps(z, z))
}

/// The numbers of the masked lanes, the lowest first.
#[inline]
#[target_feature(enable = "avx2")]
fn masked_lanes(mask: u16) -> __m256i {
    let lanes = u64::from_le_bytes(MASKED_LANES[usize::from(mask & 0xff)]);
    _mm256_cvtepu8_epi32(_mm_cvtsi64_si128(lanes as i64))
}

/// All bits of a lane where bit i of the low byte of `mask` is set.
#[inline]
#[target_feature(enable = "avx2")]
fn spread(mask: u32) -> __m256 {
    let bits = _mm256_setr_epi32(1, 2, 4, 8, 16, 32, 64, 128);
    let chosen = _mm256_and_si256(_mm256_set1_epi32(mask as i32), bits);
    _mm256_castsi256_ps(_mm256_cmpeq_epi32(chosen, bits))
}

/// Squared distances of eight points, from lane `first` on.
#[inline]
#[target_feature(enable = "avx2")]
fn eight_points(block: &Block, query: &[f32; 3], first: usize) -> __m256 {
    let gap = |axis: usize| unsafe {
        _mm256_sub_ps(_mm256_set1_ps(query[axis]), _mm256_load_ps(block.axes[axis][first..].as_ptr()))
    };
    sum_of_squares([gap(0), gap(1), gap(2)])
}

/// Squared distances of eight boxes, from lane `first` on.
#[inline]
#[target_feature(enable = "avx2")]
fn eight_boxes(node: &Node, query: &[f32; 3], first: usize) -> __m256 {
    let gap = |axis: usize| unsafe {
        let at = _mm256_set1_ps(query[axis]);
        let above = _mm256_max_ps(at, _mm256_load_ps(node.lo[axis][first..].as_ptr()));
        _mm256_sub_ps(at, _mm256_min_ps(above, _mm256_load_ps(node.hi[axis][first..].as_ptr())))
    };
    sum_of_squares([gap(0), gap(1), gap(2)])
}

/// Which of eight keys are greater than `key`, as a mask of whole lanes.
#[inline]
#[target_feature(enable = "avx2")]
fn eight_greater(keys: &[u32; 8], key: u32) -> __m256 {
    // The sign bit turned over makes signed comparisons of unsigned numbers.
    let turned = |x: __m256i| _mm256_xor_si256(x, _mm256_set1_epi32(i32::MIN));
    let keys = turned(unsafe { _mm256_loadu_si256(keys.as_ptr().cast()) });
    _mm256_castsi256_ps(_mm256_cmpgt_epi32(keys, turned(_mm256_set1_epi32(key as i32))))
}

/// The masks of two halves as one.
#[inline]
#[target_feature(enable = "avx2")]
fn bits([low, high]: [__m256; 2]) -> u16 {
    (_mm256_movemask_ps(low) | _mm256_movemask_ps(high) << 8) as u16
}

/// Moves the masked lanes to the front of `kept`, overwriting others as far as there is room.
#[inline]
#[target_feature(enable = "avx2,popcnt")]
fn pack(lanes: [__m256; 2], mask: u16, kept: &mut [f32]) {
    let next = (mask & 0xff).count_ones() as usize;
    let low = _mm256_permutevar8x32_ps(lanes[0], masked_lanes(mask));
    let high = _mm256_permutevar8x32_ps(lanes[1], masked_lanes(mask >> 8));
    unsafe {
        if kept.len() >= 16 {
            _mm256_storeu_ps(kept.as_mut_ptr(), low);
            _mm256_storeu_ps(kept[next..][..8].as_mut_ptr(), high);
        } else {
            let mut packed = [0.0; 16];
            _mm256_storeu_ps(packed.as_mut_ptr(), low);
            _mm256_storeu_ps(packed[next..][..8].as_mut_ptr(), high);
            kept.copy_from_slice(&packed[..kept.len()]);
        }
    }
}

// Neither iterators nor closures of other functions may carry registers here: they are compiled without AVX.
impl Lanes for Avx2 {
    type Floats = [__m256; 2];

    #[inline(always)]
    fn to_points(block: &Block, query: &[f32; 3]) -> [__m256; 2] {
        unsafe { [eight_points(block, query, 0), eight_points(block, query, 8)] }
    }

    #[inline(always)]
    fn to_boxes(node: &Node, query: &[f32; 3]) -> [__m256; 2] {
        unsafe { [eight_boxes(node, query, 0), eight_boxes(node, query, 8)] }
    }

    #[inline(always)]
    fn within(lanes: [__m256; 2], reach: f32) -> u16 {
        unsafe {
            let reach = _mm256_set1_ps(reach);
            bits([_mm256_cmp_ps::<_CMP_LE_OQ>(lanes[0], reach), _mm256_cmp_ps::<_CMP_LE_OQ>(lanes[1], reach)])
        }
    }

    #[inline(always)]
    fn store(lanes: [__m256; 2]) -> [f32; 16] {
        let mut values = [0.0; 16];
        unsafe {
            _mm256_storeu_ps(values.as_mut_ptr(), lanes[0]);
            _mm256_storeu_ps(values[8..].as_mut_ptr(), lanes[1]);
        }
        values
    }

    #[inline(always)]
    fn greater(keys: &[u32; 16], mask: u16, key: u32) -> u16 {
        let (halves, _) = keys.as_chunks::<8>();
        unsafe { bits([eight_greater(&halves[0], key), eight_greater(&halves[1], key)]) & mask }
    }

    #[inline(always)]
    fn compress(lanes: [__m256; 2], mask: u16, first: u32, values: &mut [f32; 16], indices: &mut [u32; 16]) {
        unsafe {
            let (low, high) = (masked_lanes(mask), masked_lanes(mask >> 8));
            let next = (mask & 0xff).count_ones() as usize;
            let numbers = |lanes: __m256i, first: u32| _mm256_add_epi32(lanes, _mm256_set1_epi32(first as i32));
            _mm256_storeu_ps(values.as_mut_ptr(), _mm256_permutevar8x32_ps(lanes[0], low));
            _mm256_storeu_ps(values[next..][..8].as_mut_ptr(), _mm256_permutevar8x32_ps(lanes[1], high));
            _mm256_storeu_si256(indices.as_mut_ptr().cast(), numbers(low, first));
            _mm256_storeu_si256(indices[next..][..8].as_mut_ptr().cast(), numbers(high, first.wrapping_add(8)));
        }
    }

    #[inline(always)]
    fn count(values: &[f32], limit: f32) -> usize {
        let (blocks, rest) = values.as_chunks::<16>();
        let mut full = 0;
        for block in blocks {
            full += Self::within(Self::load(block), limit).count_ones() as usize;
        }
        full + Portable::count(rest, limit)
    }

    #[inline(always)]
    fn load(values: &[f32; 16]) -> [__m256; 2] {
        unsafe { [_mm256_loadu_ps(values.as_ptr()), _mm256_loadu_ps(values[8..].as_ptr())] }
    }

    #[inline(always)]
    fn compress_indices(indices: &[u32; 16], mask: u16, kept: &mut [u32; 16]) {
        let next = (mask & 0xff).count_ones() as usize;
        unsafe {
            let low = _mm256_loadu_si256(indices.as_ptr().cast());
            let high = _mm256_loadu_si256(indices[8..].as_ptr().cast());
            let low = _mm256_permutevar8x32_epi32(low, masked_lanes(mask));
            let high = _mm256_permutevar8x32_epi32(high, masked_lanes(mask >> 8));
            _mm256_storeu_si256(kept.as_mut_ptr().cast(), low);
            _mm256_storeu_si256(kept[next..][..8].as_mut_ptr().cast(), high);
        }
    }

    #[inline(always)]
    fn part(values: &[[f32; 16]], masks: &[u16], low: &mut [f32], high: &mut [f32]) {
        let (mut lows, mut highs) = (0, 0);
        for i in 0..values.len() {
            let (lanes, mask) = (Self::load(&values[i]), masks[i]);
            unsafe {
                pack(lanes, mask, &mut low[lows..]);
                pack(lanes, !mask, &mut high[highs..]);
            }
            lows += mask.count_ones() as usize;
            highs += mask.count_zeros() as usize;
        }
    }

    #[inline(always)]
    fn min(a: [__m256; 2], b: [__m256; 2]) -> [__m256; 2] {
        unsafe { [_mm256_min_ps(a[0], b[0]), _mm256_min_ps(a[1], b[1])] }
    }

    #[inline(always)]
    fn max(a: [__m256; 2], b: [__m256; 2]) -> [__m256; 2] {
        unsafe { [_mm256_max_ps(a[0], b[0]), _mm256_max_ps(a[1], b[1])] }
    }

    #[inline(always)]
    fn prefetch<T>(items: &[T]) {
        Portable::prefetch(items);
    }

    #[inline(always)]
    fn add_rows<const N: usize>(sums: &mut [[__m256; 2]; N], values: &[f32], mask: u16) {
        if N > 4 {
            let mut arrays = [[0.0; 16]; N];
            for row in 0..N {
                arrays[row] = Self::store(sums[row]);
            }
            Portable::add_rows(&mut arrays, values, mask);
            for row in 0..N {
                sums[row] = Self::load(&arrays[row]);
            }
            return;
        }
        let table: &[u32; 256] = const { if N > 4 { &[0; 256] } else { &masked_floats::<N>() } };
        let (blocks, _) = values.as_chunks::<8>();
        // Eight rows are N registers, and so are the next eight.
        let floats = [table[usize::from(mask & 0xff)], table[usize::from(mask >> 8)]];
        for place in 0..2 * N {
            let (sum, mask) = (&mut sums[place / 2][place % 2], floats[place / N] >> (8 * (place % N)));
            unsafe {
                let more = _mm256_add_ps(*sum, _mm256_loadu_ps(blocks[place].as_ptr()));
                *sum = _mm256_blendv_ps(*sum, more, spread(mask));
            }
        }
    }
}
