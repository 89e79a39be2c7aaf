//! Building by a visit cost, tried at the edges of 32 bins an axis.

use crate::bounds::Bounds;
use crate::grow::{Choose, Parting};
use crate::item::Item;
use crate::visit_cost::VisitCost;

const BINS: usize = 32;

/// The bin edge of the least cost of both sides.
pub(crate) struct Binned(pub(crate) VisitCost);

impl Choose for Binned {
    /// Earlier candidates win ties: the lower axis, then the lower edge. None where all points share a bin.
    fn choose(&self, items: &[Item], bounds: &Bounds) -> Option<Parting> {
        let extent = bounds.extent();
        let radius = self.0.reach().map_or(0.0, |reach| reach.radius(extent, items.len()));
        let counts = histograms(items, bounds);
        let mut best: Option<(f64, Parting)> = None;
        for axis in 0..3 {
            let mut left = 0;
            for edge in 1..BINS {
                left += counts[axis][edge - 1] as usize;
                // Across a gap the counts stay, so a cost linear in the edge is least at its ends; the sheet's is near it.
                let in_gap = counts[axis][edge - 1] == 0 && counts[axis][edge] == 0;
                if in_gap || left == 0 || left == items.len() {
                    continue;
                }
                let (mut low, mut high) = (extent, extent);
                low[axis] *= edge as f64 / BINS as f64;
                high[axis] *= (BINS - edge) as f64 / BINS as f64;
                let cost = self.0.of(low, radius) * left as f64 + self.0.of(high, radius) * (items.len() - left) as f64;
                if best.is_none_or(|(least, _)| cost < least) {
                    best = Some((cost, Parting { axis, left }));
                }
            }
        }
        best.map(|(_, parting)| parting)
    }
}

/// Points in each bin along each axis. Extents beyond the range of `f32` leave all in the first.
fn histograms(items: &[Item], bounds: &Bounds) -> [[u32; BINS]; 3] {
    let mut counts = [[0; BINS]; 3];
    let scale: [f32; 3] = std::array::from_fn(|axis| BINS as f32 / (bounds.hi[axis] - bounds.lo[axis]));
    for item in items {
        for axis in 0..3 {
            // A conversion takes NaN, of an axis without extent, to zero.
            let bin = ((item[axis] - bounds.lo[axis]) * scale[axis]) as u32;
            counts[axis][(bin as usize).min(BINS - 1)] += 1;
        }
    }
    counts
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::item::{bounds, item};
    use crate::visit_cost::Reach;

    fn choose(points: &[[f32; 3]], cost: VisitCost) -> Option<Parting> {
        let items: Vec<Item> = (0..points.len() as u32).map(|i| item(points, i)).collect();
        Binned(cost).choose(&items, &bounds(&items))
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
