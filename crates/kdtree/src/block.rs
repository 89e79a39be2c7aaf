//! Sixteen points as they are stored.

/// Points in a block, the `f32` lanes of the widest vector register: tree indices from a multiple of it to the next.
pub const BLOCK: usize = 16;

/// Sixteen points, axis by axis; lanes beyond the last point of a tree are NaN, which is within no reach.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub(crate) struct Block {
    pub(crate) axes: [[f32; BLOCK]; 3],
}

impl Block {
    /// The block of up to sixteen points.
    pub(crate) fn of(points: impl IntoIterator<Item = [f32; 3]>) -> Self {
        let mut block = Self { axes: [[f32::NAN; BLOCK]; 3] };
        for (lane, point) in points.into_iter().enumerate() {
            for axis in 0..3 {
                block.axes[axis][lane] = point[axis];
            }
        }
        block
    }

    pub(crate) fn point(&self, lane: usize) -> [f32; 3] {
        self.axes.map(|axis| axis[lane])
    }
}

/// By bits, so that padding equals padding.
impl PartialEq for Block {
    fn eq(&self, other: &Self) -> bool {
        self.axes.map(|axis| axis.map(f32::to_bits)) == other.axes.map(|axis| axis.map(f32::to_bits))
    }
}

/// The lanes of block `block` that hold points of `range`, as bits.
#[inline(always)]
pub(crate) fn lanes_in(range: &std::ops::Range<usize>, block: usize) -> u16 {
    let first = block * BLOCK;
    let skip = range.start.saturating_sub(first);
    let end = (range.end - first).min(BLOCK);
    ((u32::from(u16::MAX) >> (BLOCK - end)) as u16) & (u16::MAX << skip)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn is_three_cache_lines_and_padded_with_nan() {
        assert_eq!((size_of::<Block>(), align_of::<Block>()), (192, 64));
        let block = Block::of([[1.0, 2.0, 3.0]]);
        assert_eq!(block.point(0), [1.0, 2.0, 3.0]);
        assert!(block.point(1)[0].is_nan());
        let same = block;
        assert!(block == same);
    }

    #[test]
    fn a_range_may_share_its_first_and_last_block() {
        assert_eq!(lanes_in(&(16..32), 1), u16::MAX);
        assert_eq!(lanes_in(&(18..40), 1), 0xfffc);
        assert_eq!(lanes_in(&(18..40), 2), 0x00ff);
        assert_eq!(lanes_in(&(5..6), 0), 0x0020);
    }
}
