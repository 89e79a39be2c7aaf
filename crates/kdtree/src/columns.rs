//! Points while a tree is built.

use crate::block::BLOCK;
use crate::bounds::Bounds;
use crate::lanes::{Lanes, Task};

/// A run of points: a column for each coordinate, and one for the bits of the index in the order given.
#[derive(Clone, Copy)]
pub(crate) struct Columns<'a>(pub(crate) [&'a [f32]; 4]);

/// The same, to be written.
pub(crate) struct ColumnsMut<'a>(pub(crate) [&'a mut [f32]; 4]);

/// All points, in columns.
pub(crate) struct Table([Vec<f32>; 4]);

/// The column of indices.
pub(crate) const INDEX: usize = 3;

impl Table {
    /// The points of these indices, in this order.
    pub(crate) fn of(points: &[[f32; 3]], indices: impl ExactSizeIterator<Item = u32>) -> Self {
        let mut columns: [Vec<f32>; 4] = std::array::from_fn(|_| Vec::with_capacity(indices.len()));
        let [xs, ys, zs, bits] = &mut columns;
        for index in indices {
            let [x, y, z] = points[index as usize];
            xs.push(x);
            ys.push(y);
            zs.push(z);
            bits.push(f32::from_bits(index));
        }
        Self(columns)
    }

    /// As many points as `other` has, of no meaning yet.
    pub(crate) fn like(other: &Self) -> Self {
        Self(std::array::from_fn(|column| vec![0.0; other.0[column].len()]))
    }

    pub(crate) fn columns(&self) -> Columns<'_> {
        Columns(self.0.each_ref().map(|column| &column[..]))
    }

    pub(crate) fn columns_mut(&mut self) -> ColumnsMut<'_> {
        ColumnsMut(self.0.each_mut().map(|column| &mut column[..]))
    }
}

impl Columns<'_> {
    pub(crate) fn len(&self) -> usize {
        self.0[INDEX].len()
    }

    /// The point in this place.
    pub(crate) fn point(&self, place: usize) -> [f32; 3] {
        std::array::from_fn(|axis| self.0[axis][place])
    }

    /// Where the point in this place stood in the order given.
    pub(crate) fn index(&self, place: usize) -> u32 {
        self.0[INDEX][place].to_bits()
    }
}

impl<'a> ColumnsMut<'a> {
    pub(crate) fn len(&self) -> usize {
        self.0[INDEX].len()
    }

    pub(crate) fn as_columns(&self) -> Columns<'_> {
        Columns(self.0.each_ref().map(|column| &**column))
    }

    pub(crate) fn copy_from(&mut self, other: &Columns) {
        for (to, from) in self.0.iter_mut().zip(other.0) {
            to.copy_from_slice(from);
        }
    }

    pub(crate) fn split_at(self, left: usize) -> [Self; 2] {
        let [x, y, z, index] = self.0.map(|column| column.split_at_mut(left));
        [Self([x.0, y.0, z.0, index.0]), Self([x.1, y.1, z.1, index.1])]
    }
}

/// The tight box of at least one point.
#[inline(always)]
pub(crate) fn bounds<L: Lanes>(run: &Columns) -> Bounds {
    let mut bounds = Bounds { lo: [0.0; 3], hi: [0.0; 3] };
    for axis in 0..3 {
        (bounds.lo[axis], bounds.hi[axis]) = range::<L>(run.0[axis]);
    }
    bounds
}

/// The least and the greatest value. Sixteen at once, or each minimum would wait for the one before.
#[inline(always)]
fn range<L: Lanes>(column: &[f32]) -> (f32, f32) {
    let (blocks, rest) = column.as_chunks::<BLOCK>();
    let mut padded = [column[0]; BLOCK];
    padded[..rest.len()].copy_from_slice(rest);
    let mut lo = L::load(if rest.is_empty() { &blocks[0] } else { &padded });
    let mut hi = lo;
    for block in blocks {
        let block = L::load(block);
        (lo, hi) = (L::min(lo, block), L::max(hi, block));
    }
    let (lo, hi) = (L::store(lo), L::store(hi));
    let lesser = |a: f32, b: f32| if b < a { b } else { a };
    let greater = |a: f32, b: f32| if b > a { b } else { a };
    (fold(lo, lesser), fold(hi, greater))
}

/// All lanes as one, in halves.
#[inline(always)]
fn fold(lanes: [f32; BLOCK], with: impl Fn(f32, f32) -> f32) -> f32 {
    let eight: [f32; 8] = std::array::from_fn(|i| with(lanes[i], lanes[i + 8]));
    let four: [f32; 4] = std::array::from_fn(|i| with(eight[i], eight[i + 4]));
    with(with(four[0], four[2]), with(four[1], four[3]))
}

/// Finds the tight box.
pub(crate) struct Around<'a>(pub(crate) Columns<'a>);

impl Task for Around<'_> {
    type Output = Bounds;

    #[inline(always)]
    fn run<L: Lanes>(self) -> Bounds {
        bounds::<L>(&self.0)
    }
}
