//! Building by the median rule.

use crate::bounds::Bounds;
use crate::columns::Columns;
use crate::grow::{Choose, Parting};

/// Always the median along the widest axis.
pub(crate) struct Median;

impl Choose for Median {
    fn choose(&self, _: &Columns, _: &Bounds) -> Option<Parting> {
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::grow::build;

    #[test]
    fn halves_along_the_widest_axis_whatever_repeats() {
        // All but one point share the only coordinate that varies.
        let mut points = vec![[0.0, 4.0, 1.0]; 63];
        points.insert(5, [0.0, 9.0, 1.0]);
        let (root, order) = build(&points, 1, &Median);
        // The far half holds the lone point; halves of equal points are not cut further.
        assert_eq!(order.columns().index(63), 5);
        assert_eq!(root.leaves(), 7);
    }

    #[test]
    fn equal_coordinates_part_by_original_index() {
        // Every tenth point lies apart; the cut falls among the equal others.
        let points: Vec<[f32; 3]> = (0..5000).map(|i| [f32::from(u8::from(i % 10 == 0)), 0.0, 0.0]).collect();
        let (_, order) = build(&points, 2560, &Median);
        let mut equal = (0..5000).filter(|i| i % 10 != 0);
        let low: Vec<u32> = equal.by_ref().take(2560).collect();
        let mut found: Vec<u32> = (0..2560).map(|place| order.columns().index(place)).collect();
        found.sort_unstable();
        assert_eq!(found, low);
    }
}
