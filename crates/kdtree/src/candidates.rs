//! Append and select: points that may be among the k nearest.
//!
//! Candidates are appended to `k + k/4` places without order. When these are full, a distance is sought that at
//! least k candidates do not exceed, it becomes the reach, and what lies beyond is dropped. So each candidate costs
//! a few vector operations where a heap costs a branchy walk, and ties cost no more than other points.

use crate::block::BLOCK;
use crate::lanes::Lanes;

/// Candidates in the order of arrival.
#[derive(Clone, Debug, Default)]
pub(crate) struct Candidates {
    pub(crate) distances: Vec<f32>,
    pub(crate) indices: Vec<u32>,
    len: usize,
    /// Tree indices of candidates at the reach, while ties are resolved.
    tied: Vec<u32>,
}

/// Where to cut off.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Limit {
    /// At this distance: a number of candidates as wanted is not beyond.
    At(f32),
    /// At this distance, with too many candidates at exactly it.
    Tied(f32),
}

impl Candidates {
    /// Places for `k` points before the first selection.
    pub(crate) fn places(k: usize) -> usize {
        k + (k / 4).max(2 * BLOCK)
    }

    pub(crate) fn len(&self) -> usize {
        self.len
    }

    pub(crate) fn clear(&mut self) {
        self.len = 0;
    }

    /// Appends the masked lanes, which are the points from tree index `first` on.
    #[inline(always)]
    pub(crate) fn append<L: Lanes>(&mut self, first: usize, mask: u16, distances: L::Floats) {
        let at = self.len;
        if self.distances.len().min(self.indices.len()) < at + BLOCK {
            self.grow();
        }
        let values = self.distances[at..].first_chunk_mut().expect("grown");
        let indices = self.indices[at..].first_chunk_mut().expect("grown");
        L::compress(distances, mask, first as u32, values, indices);
        self.len += mask.count_ones() as usize;
    }

    #[cold]
    fn grow(&mut self) {
        // Whole blocks, for the last candidates are read as one.
        let room = (2 * self.len).max(256).next_multiple_of(BLOCK) + BLOCK;
        self.distances.resize(room, 0.0);
        self.indices.resize(room, 0);
    }

    /// Drops candidates of which none is among the `k` nearest, until `k` to `most` are left; returns the new
    /// reach, which none of them exceeds. There must be more than `most`.
    #[inline(always)]
    pub(crate) fn select<L: Lanes>(&mut self, k: usize, most: usize) -> f32 {
        match self.limit::<L>(k, most) {
            Limit::At(reach) => {
                self.keep::<L>(reach);
                reach
            }
            Limit::Tied(reach) => {
                self.keep::<L>(reach);
                self.keep_first_tied(k, reach);
                reach
            }
        }
    }

    /// Seeks by interpolation, which on a sheet lit evenly is right at once, then by halving the floats.
    #[inline(always)]
    fn limit<L: Lanes>(&self, k: usize, most: usize) -> Limit {
        const INTERPOLATIONS: usize = 8;
        let values = &self.distances[..self.len];
        let greatest = values.iter().fold(0, |greatest, d| greatest.max(d.to_bits()));
        // As bits: fewer than k do not exceed `low` (-1 is below all), more than `most` do not exceed `high`.
        let (mut low, mut low_count) = (-1i64, 0);
        let (mut high, mut high_count) = (i64::from(greatest), self.len);
        let wanted = k as f32 + 0.5 * (most - k) as f32;
        for round in 0.. {
            if high - low <= 1 {
                break;
            }
            let guess = if round < INTERPOLATIONS && greatest < f32::INFINITY.to_bits() {
                let (from, to) = (f32::from_bits(low.max(0) as u32), f32::from_bits(high as u32));
                let share = (wanted - low_count as f32) / (high_count - low_count) as f32;
                i64::from((from + (to - from) * share).to_bits()).clamp(low + 1, high - 1)
            } else {
                (low + high) / 2
            };
            let reach = f32::from_bits(guess as u32);
            let count = L::count(values, reach);
            if count < k {
                (low, low_count) = (guess, count);
            } else if count > most {
                (high, high_count) = (guess, count);
            } else {
                return Limit::At(reach);
            }
        }
        Limit::Tied(f32::from_bits(high as u32))
    }

    /// Drops candidates beyond `reach`; the others keep their order.
    #[inline(always)]
    fn keep<L: Lanes>(&mut self, reach: f32) {
        let mut kept = 0;
        for from in (0..self.len).step_by(BLOCK) {
            let distances = *self.distances[from..].first_chunk::<BLOCK>().expect("there is room for a block more");
            let indices = *self.indices[from..].first_chunk::<BLOCK>().expect("there is room for a block more");
            let valid = u16::MAX >> (BLOCK - (self.len - from).min(BLOCK));
            let mask = L::within(L::load(&distances), reach) & valid;
            let values = self.distances[kept..].first_chunk_mut().expect("not beyond from");
            let numbers = self.indices[kept..].first_chunk_mut().expect("not beyond from");
            L::compress(L::load(&distances), mask, 0, values, &mut [0; BLOCK]);
            L::compress_indices(&indices, mask, numbers);
            kept += mask.count_ones() as usize;
        }
        self.len = kept;
    }

    /// Keeps every candidate nearer than `reach` and, of those at it, as many of the lowest tree indices as make k.
    #[cold]
    fn keep_first_tied(&mut self, k: usize, reach: f32) {
        let candidates = || self.distances[..self.len].iter().zip(&self.indices[..self.len]);
        let nearer = candidates().filter(|&(&d, _)| d < reach).count();
        self.tied.clear();
        self.tied.extend(candidates().filter(|&(&d, _)| d == reach).map(|(_, &index)| index));
        let (_, &mut last, _) = self.tied.select_nth_unstable(k - nearer - 1);
        let mut kept = 0;
        for i in 0..self.len {
            let (distance, index) = (self.distances[i], self.indices[i]);
            if distance < reach || index <= last {
                (self.distances[kept], self.indices[kept]) = (distance, index);
                kept += 1;
            }
        }
        self.len = kept;
    }

    /// Rises with distance, then tree index.
    pub(crate) fn key(&self, i: usize) -> u64 {
        u64::from(self.distances[i].to_bits()) << 32 | u64::from(self.indices[i])
    }

    pub(crate) fn swap_remove(&mut self, i: usize) -> (u32, f32) {
        self.len -= 1;
        self.distances.swap(i, self.len);
        self.indices.swap(i, self.len);
        (self.indices[self.len], self.distances[self.len])
    }

    pub(crate) fn sort(&mut self) {
        let mut keys: Vec<u64> = (0..self.len).map(|i| self.key(i)).collect();
        keys.sort_unstable();
        for (i, key) in keys.into_iter().enumerate() {
            (self.distances[i], self.indices[i]) = (f32::from_bits((key >> 32) as u32), key as u32);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lanes::Portable;
    use proptest::prelude::*;

    fn of(values: &[f32]) -> Candidates {
        let mut candidates = Candidates::default();
        for (first, chunk) in values.chunks(BLOCK).enumerate() {
            let mut lanes = [f32::NAN; BLOCK];
            lanes[..chunk.len()].copy_from_slice(chunk);
            let mask = u16::MAX >> (BLOCK - chunk.len());
            candidates.append::<Portable>(first * BLOCK, mask, lanes);
        }
        candidates
    }

    /// The last block is read whole, wherever the candidates end.
    #[test]
    fn any_number_of_candidates_can_be_selected_from() {
        let values: Vec<f32> = (0..3000u16).map(|i| f32::from(i * 7 % 3000)).collect();
        for count in 2..values.len() {
            let mut candidates = Candidates::default();
            for (first, value) in values[..count].iter().enumerate() {
                candidates.append::<Portable>(first, 1, [*value; BLOCK]);
            }
            candidates.select::<Portable>(1, 1);
            assert_eq!(candidates.len(), 1, "{count}");
        }
    }

    proptest! {
        #[test]
        fn the_k_least_by_value_then_index(
            values in prop::collection::vec(
                prop_oneof![
                    0f32..4.0, (0u8..3).prop_map(f32::from), Just(f32::INFINITY), 0f32..1e-40, 1e37f32..3e38,
                ],
                2..300,
            ),
            k in any::<prop::sample::Index>(),
            slack in 0usize..3,
        ) {
            let k = 1 + k.index(values.len() - 1);
            let most = (k + slack).min(values.len() - 1);
            let mut candidates = of(&values);
            let reach = candidates.select::<Portable>(k, most);
            prop_assert!((k..=most.max(k)).contains(&candidates.len()));
            prop_assert!(candidates.indices[..candidates.len()].is_sorted(), "stable");
            candidates.sort();
            let mut expected: Vec<(u32, u32)> = values.iter().zip(0..).map(|(v, i)| (v.to_bits(), i)).collect();
            expected.sort_unstable();
            for (i, &(bits, index)) in expected[..candidates.len()].iter().enumerate() {
                prop_assert_eq!((candidates.distances[i].to_bits(), candidates.indices[i]), (bits, index));
                prop_assert!(candidates.distances[i] <= reach);
            }
        }
    }
}
