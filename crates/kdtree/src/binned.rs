//! Building by a visit cost, tried at the edges of 32 bins an axis.

use crate::block::BLOCK;
use crate::bounds::Bounds;
use crate::columns::Columns;
use crate::grow::{Choose, Parting};
use crate::lanes::{Instructions, Lanes, Task, dispatch};
use crate::visit_cost::VisitCost;

const BINS: usize = 32;

/// The bin edge of the least cost of both sides.
pub(crate) struct Binned {
    pub(crate) cost: VisitCost,
    pub(crate) instructions: Instructions,
}

impl Choose for Binned {
    /// Earlier candidates win ties: the lower axis, then the lower edge. None where all points share a bin.
    fn choose(&self, points: &Columns, bounds: &Bounds) -> Option<Parting> {
        let extent = bounds.extent();
        let radius = self.cost.reach().map_or(0.0, |reach| reach.radius(extent, points.len()));
        let counts = dispatch(self.instructions, Histograms(points, bounds));
        let mut best: Option<(f64, Parting)> = None;
        for axis in (0..3).filter(|&axis| (counts[axis][0] as usize) < points.len()) {
            let measures = self.measures(extent, axis, radius);
            let mut left = 0;
            for edge in 1..BINS {
                left += counts[axis][edge - 1] as usize;
                // Across a gap the counts stay, so a cost linear in the edge is least at its ends; the sheet's is near it.
                let in_gap = counts[axis][edge - 1] == 0 && counts[axis][edge] == 0;
                if in_gap || left == 0 || left == points.len() {
                    continue;
                }
                let cost = measures[edge] * left as f64 + measures[BINS - edge] * (points.len() - left) as f64;
                if best.is_none_or(|(least, _)| cost < least) {
                    best = Some((cost, Parting { axis, left }));
                }
            }
        }
        best.map(|(_, parting)| parting)
    }
}

impl Binned {
    /// The measures of the box cut along the axis to each number of bins: both sides of every cut are among them.
    fn measures(&self, mut extent: [f64; 3], axis: usize, radius: f64) -> [f64; BINS + 1] {
        let whole = extent[axis];
        let mut measures = [0.0; BINS + 1];
        for (bins, measure) in measures.iter_mut().enumerate() {
            extent[axis] = whole * (bins as f64 / BINS as f64);
            *measure = self.cost.of(extent, radius);
        }
        measures
    }
}

/// Counts the points in each bin along each axis. Extents that are zero or beyond the range of `f32` leave all in the first.
struct Histograms<'a>(&'a Columns<'a>, &'a Bounds);

impl Task for Histograms<'_> {
    type Output = [[u32; BINS]; 3];

    #[inline(always)]
    fn run<L: Lanes>(self) -> [[u32; BINS]; 3] {
        let Self(points, bounds) = self;
        let mut counts = [[0; BINS]; 3];
        for axis in 0..3 {
            let (lo, extent) = (bounds.lo[axis], bounds.hi[axis] - bounds.lo[axis]);
            let scale = BINS as f32 / extent;
            if extent < f32::INFINITY && scale < f32::INFINITY {
                counts[axis] = histogram(points.0[axis], lo, scale);
            } else {
                counts[axis][0] = points.len() as u32;
            }
        }
        counts
    }
}

/// Four counters a bin in turn, for one that is written must not be read at once; and a bin for points at the far end.
#[inline(always)]
fn histogram(column: &[f32], lo: f32, scale: f32) -> [u32; BINS] {
    let mut counters = [[0u32; 4]; BINS + 1];
    let (blocks, rest) = column.as_chunks::<BLOCK>();
    for block in blocks {
        let mut bins = [0; BLOCK];
        for lane in 0..BLOCK {
            bins[lane] = bin(block[lane], lo, scale);
        }
        for lane in 0..BLOCK {
            counters[bins[lane].min(BINS as u32) as usize][lane % 4] += 1;
        }
    }
    for &at in rest {
        counters[bin(at, lo, scale).min(BINS as u32) as usize][0] += 1;
    }
    let mut counts: [u32; BINS] = std::array::from_fn(|bin| counters[bin].iter().sum());
    counts[BINS - 1] += counters[BINS].iter().sum::<u32>();
    counts
}

/// The bin of a coordinate, up to the rounding at its edges: it rises with the coordinate, which is what parting needs.
///
/// A large number added leaves the rounded sum in the last bits; compilers make vectors of that everywhere.
#[inline(always)]
fn bin(at: f32, lo: f32, scale: f32) -> u32 {
    const LARGE: f32 = 12_582_912.0;
    ((at - lo) * scale - 0.5 + LARGE).to_bits().wrapping_sub(LARGE.to_bits())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::columns::{Around, Table};
    use crate::visit_cost::Reach;

    fn choose(points: &[[f32; 3]], cost: VisitCost) -> Option<Parting> {
        let table = Table::of(points, 0..points.len() as u32);
        let bounds = dispatch(Instructions::Portable, Around(table.columns()));
        Binned { cost, instructions: Instructions::Portable }.choose(&table.columns(), &bounds)
    }

    #[test]
    fn cuts_between_clusters_and_leaves_one_bin_alone() {
        let cluster = |x: f32, n: i32| (0..n).map(move |i| [x + 1e-3 * i as f32, 1e-3 * (i % 7) as f32, 0.0]);
        let points: Vec<_> = cluster(0.0, 40).chain(cluster(10.0, 100)).collect();
        for cost in [VisitCost::BallInSpace(Reach::Radius(0.1)), VisitCost::BallOnSheet(Reach::Nearest(10))] {
            assert_eq!(choose(&points, cost), Some(Parting { axis: 0, left: 40 }), "{cost:?}");
        }
        // The extent overflows.
        let far = [[f32::MIN, 0.0, 0.0], [f32::MAX, 0.0, 0.0]];
        assert_eq!(choose(&far, VisitCost::SurfaceArea), None);
    }
}
