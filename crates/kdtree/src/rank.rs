//! Parting a run of points at a rank along an axis.

use crate::block::BLOCK;
use crate::bounds::Bounds;
use crate::columns::{Columns, ColumnsMut, bounds};
use crate::lanes::{Lanes, Task};

/// Which coordinates go to the left: all up to `below`, and the first `ties` of those that equal `at`.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Threshold {
    below: f32,
    at: f32,
    ties: usize,
}

/// Finds the threshold of the `rank` lowest of `values`, more than none and fewer than all, all from `lo` to `hi`.
///
/// Counting is quicker than moving: the values are counted up to guesses between two that are known to be too low and
/// high enough, drawn from the line through their counts, and every third time halfway in the order of the floats, which
/// ends after 32 of these whatever the values.
#[inline(always)]
fn threshold<L: Lanes>(values: &[f32], lo: f32, hi: f32, rank: usize) -> Threshold {
    let (mut low, mut count_low) = (lo.next_down(), 0);
    let (mut high, mut count_high) = (hi, values.len());
    if values.len() > FAR_FROM_CACHE {
        for guess in sampled_guesses(values, rank) {
            let count = L::count(values, guess);
            if count < rank && guess > low {
                (low, count_low) = (guess, count);
            } else if count >= rank && guess < high {
                (high, count_high) = (guess, count);
            }
        }
    }
    for round in 1.. {
        if low.next_up() >= high {
            return Threshold { below: low, at: high, ties: rank - count_low };
        }
        let guess = if round % 3 == 0 {
            halfway(low, high)
        } else {
            let share = (rank - count_low) as f64 / (count_high - count_low) as f64;
            let line = (f64::from(low) + (f64::from(high) - f64::from(low)) * share) as f32;
            if line > low && line < high { line } else { halfway(low, high) }
        };
        let count = L::count(values, guess);
        match count.cmp(&rank) {
            std::cmp::Ordering::Less => (low, count_low) = (guess, count),
            std::cmp::Ordering::Equal => return Threshold { below: guess, at: guess, ties: 0 },
            std::cmp::Ordering::Greater => (high, count_high) = (guess, count),
        }
    }
    unreachable!("halving the floats between two ends")
}

/// Above this many values, counting them waits for memory, and a sample saves more than it costs.
const FAR_FROM_CACHE: usize = 1 << 16;

/// Values that are likely just below and just above the `rank` lowest: those of a sample, two and a half standard
/// deviations of its rank to either side.
fn sampled_guesses(values: &[f32], rank: usize) -> [f32; 2] {
    const SAMPLE: usize = 1024;
    let mut sample: Vec<f32> = values.iter().step_by(values.len() / SAMPLE).copied().collect();
    sample.sort_unstable_by(f32::total_cmp);
    let place = (rank as f64 / values.len() as f64 * sample.len() as f64) as usize;
    [place.saturating_sub(SAMPLE / 26), (place + SAMPLE / 26).min(sample.len() - 1)].map(|place| sample[place])
}

/// The float halfway between two that are not neighbours, in their order.
fn halfway(low: f32, high: f32) -> f32 {
    let place = |at: f32| {
        let bits = at.to_bits() as i32;
        i64::from(if bits < 0 { i32::MIN - bits } else { bits })
    };
    let middle = ((place(low) + place(high)) >> 1) as i32;
    f32::from_bits(if middle < 0 { i32::MIN - middle } else { middle } as u32)
}

/// Moves the points of `from` to `to`, the `rank` lowest along the axis first, of equal coordinates the earlier; either
/// side keeps its order.
pub(crate) struct Part<'a, 'b> {
    pub(crate) from: Columns<'a>,
    pub(crate) to: ColumnsMut<'b>,
    /// The box of the points.
    pub(crate) bounds: Bounds,
    pub(crate) axis: usize,
    /// More than none and fewer than all.
    pub(crate) rank: usize,
}

impl<'b> Task for Part<'_, 'b> {
    /// Both sides with their tight boxes.
    type Output = [(ColumnsMut<'b>, Bounds); 2];

    #[inline(always)]
    fn run<L: Lanes>(self) -> Self::Output {
        let Self { from, to, bounds: around, axis, rank } = self;
        let threshold = threshold::<L>(from.0[axis], around.lo[axis], around.hi[axis], rank);
        let [mut low, mut high] = to.split_at(rank);
        part::<L>(&from, axis, threshold, &mut low, &mut high);
        let boxes = [bounds::<L>(&low.as_columns()), bounds::<L>(&high.as_columns())];
        [(low, boxes[0]), (high, boxes[1])]
    }
}

/// Blocks whose masks are made at once.
const TILE: usize = 32;

#[inline(always)]
fn part<L: Lanes>(from: &Columns, axis: usize, mut threshold: Threshold, low: &mut ColumnsMut, high: &mut ColumnsMut) {
    let (mut lows, mut highs) = (0, 0);
    let whole = from.0.map(|column| column.as_chunks::<BLOCK>().0);
    let mut masks = [0; TILE];
    for first in (0..whole[axis].len()).step_by(TILE) {
        let tile = whole.map(|blocks| &blocks[first..blocks.len().min(first + TILE)]);
        let masks = &mut masks[..tile[axis].len()];
        let mut count = 0;
        for (mask, coordinates) in masks.iter_mut().zip(tile[axis]) {
            *mask = threshold.left::<L>(coordinates);
            count += mask.count_ones() as usize;
        }
        for column in 0..4 {
            L::part(tile[column], masks, &mut low.0[column][lows..], &mut high.0[column][highs..]);
        }
        lows += count;
        highs += BLOCK * masks.len() - count;
    }

    let rest = from.0.map(|column| column.as_chunks::<BLOCK>().1);
    let mut padded = [f32::NAN; BLOCK];
    padded[..rest[axis].len()].copy_from_slice(rest[axis]);
    let left = threshold.left::<L>(&padded);
    for i in 0..rest[axis].len() {
        let is_left = left >> i & 1 == 1;
        for column in 0..4 {
            if is_left {
                low.0[column][lows] = rest[column][i];
            } else {
                high.0[column][highs] = rest[column][i];
            }
        }
        lows += usize::from(is_left);
        highs += usize::from(!is_left);
    }
}

impl Threshold {
    /// Which of the next sixteen coordinates go to the left.
    #[inline(always)]
    fn left<L: Lanes>(&mut self, coordinates: &[f32; BLOCK]) -> u16 {
        let lanes = L::load(coordinates);
        let below = L::within(lanes, self.below);
        if self.ties == 0 {
            return below;
        }
        let mut tied = L::within(lanes, self.at) & !below;
        let mut beyond = tied;
        while tied != 0 && self.ties > 0 {
            self.ties -= 1;
            tied &= tied - 1;
        }
        beyond ^= tied;
        below | beyond
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::columns::{Around, Table};
    use crate::lanes::{Instructions, dispatch};
    use proptest::prelude::*;

    fn coordinate() -> impl Strategy<Value = f32> {
        let wild = any::<f32>().prop_filter("finite", |x| x.is_finite());
        let few = prop::sample::select(vec![0.0f32, -0.0, 1.0, f32::MAX, f32::MIN, f32::MIN_POSITIVE]);
        prop_oneof![-2f32..2.0, wild, few]
    }

    proptest! {
        #[test]
        fn the_lowest_go_left_and_all_keep_their_order(
            points in prop::collection::vec(prop::array::uniform3(coordinate()), 2..90),
            axis in 0..3usize,
            share in 0.0..1.0,
        ) {
            let rank = 1 + (share * (points.len() - 1) as f64) as usize;
            let mut order: Vec<usize> = (0..points.len()).collect();
            // A stable sort, in which -0 equals 0.
            order.sort_by(|&a, &b| points[a][axis].partial_cmp(&points[b][axis]).unwrap());
            order[..rank].sort_unstable();
            order[rank..].sort_unstable();
            for set in [Instructions::Portable, Instructions::Avx2, Instructions::Avx512].into_iter().filter(|set| set.is_available()) {
                let from = Table::of(&points, 0..points.len() as u32);
                let mut to = Table::like(&from);
                let all = dispatch(set, Around(from.columns()));
                if all.lo[axis] == all.hi[axis] {
                    continue;
                }
                let part = Part { from: from.columns(), to: to.columns_mut(), bounds: all, axis, rank };
                let boxes = dispatch(set, part).map(|(_, bounds)| bounds);
                let to = to.columns();
                for (place, &index) in order.iter().enumerate() {
                    prop_assert_eq!(to.index(place) as usize, index);
                    prop_assert_eq!(to.point(place).map(f32::to_bits), points[index].map(f32::to_bits));
                }
                let around = |of: &[usize]| Bounds::around(of.iter().map(|&i| points[i]));
                prop_assert_eq!(boxes, [around(&order[..rank]), around(&order[rank..])]);
            }
        }
    }

    #[test]
    fn halfway_is_between() {
        for (low, high) in [(-1.0f32, 2.0), (f32::MIN, f32::MAX), (f32::NEG_INFINITY, -1e-30), (0.0, 3e-45)] {
            let middle = halfway(low, high);
            assert!(low < middle && middle < high, "{low} {middle} {high}");
        }
    }
}
