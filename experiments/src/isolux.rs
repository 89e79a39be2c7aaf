//! Isolux lines: where a map of cells crosses a level.

use std::collections::BTreeMap;

/// A line's places, in cells from the map's top left corner; a closed one ends where it starts.
pub(crate) type Line = Vec<[f64; 2]>;

/// Values of cells, row 0 on top.
pub(crate) struct Grid {
    pub(crate) width: usize,
    pub(crate) height: usize,
    pub(crate) values: Vec<f64>,
}

/// A side of a square of four neighbouring nodes: its first node, and whether it runs along a row.
type Side = (usize, usize, bool);

impl Grid {
    /// The value at a place in cells: bilinear between the cells' centres, even from the outermost ones to the border.
    pub(crate) fn at(&self, [x, y]: [f64; 2]) -> f64 {
        let split = |at: f64, count: usize| {
            let at = (at - 0.5).clamp(0.0, (count - 1) as f64);
            let low = (at as usize).min(count.saturating_sub(2));
            (low, (low + 1).min(count - 1), at - low as f64)
        };
        let ((left, right, s), (top, bottom, t)) = (split(x, self.width), split(y, self.height));
        let along = |row: usize| {
            let [a, b] = [left, right].map(|column| self.values[row * self.width + column]);
            a + s * (b - a)
        };
        along(top) + t * (along(bottom) - along(top))
    }

    /// The lines along which [`Grid::at`] is `level`, by marching squares: straight within a square of four cells' centres.
    pub(crate) fn isolux(&self, level: f64) -> Vec<Line> {
        let mut neighbours: BTreeMap<Side, Vec<Side>> = BTreeMap::new();
        for row in 0..=self.height {
            for column in 0..=self.width {
                for [a, b] in self.crossings(column, row, level) {
                    neighbours.entry(a).or_default().push(b);
                    neighbours.entry(b).or_default().push(a);
                }
            }
        }
        let lines = joined(neighbours);
        lines.iter().map(|line| line.iter().map(|&side| self.crossing(side, level)).collect()).collect()
    }

    /// Nodes are the cells' centres, and beside the outermost ones the border, so that lines reach it.
    fn node(&self, column: usize, row: usize) -> ([f64; 2], f64) {
        let place = |node: usize, count: usize| (node as f64 - 0.5).clamp(0.0, count as f64);
        let place = [place(column, self.width), place(row, self.height)];
        (place, self.at(place))
    }

    /// The pairs of sides that a line joins within the square whose top left node is given.
    fn crossings(&self, column: usize, row: usize, level: f64) -> Vec<[Side; 2]> {
        let corners = [(0, 0), (1, 0), (1, 1), (0, 1)].map(|(right, down)| self.node(column + right, row + down).1);
        let above = corners.map(|value| value >= level);
        let sides = [(column, row, true), (column + 1, row, false), (column, row + 1, true), (column, row, false)];
        let crossed: Vec<Side> = (0..4).filter(|&i| above[i] != above[(i + 1) % 4]).map(|i| sides[i]).collect();
        match crossed[..] {
            [a, b] => vec![[a, b]],
            // Of a saddle the middle tells which two opposite corners hang together.
            [top, right, bottom, left] => {
                let middle = corners.iter().sum::<f64>() / 4.0 >= level;
                if above[0] == middle { vec![[top, right], [bottom, left]] } else { vec![[left, top], [right, bottom]] }
            }
            _ => Vec::new(),
        }
    }

    /// Where a side crosses a level.
    fn crossing(&self, (column, row, along_row): Side, level: f64) -> [f64; 2] {
        let (right, down) = if along_row { (1, 0) } else { (0, 1) };
        let ((from, low), (to, high)) = (self.node(column, row), self.node(column + right, row + down));
        let share = (level - low) / (high - low);
        std::array::from_fn(|axis| from[axis] + share * (to[axis] - from[axis]))
    }
}

/// Chains of neighbours: first those with two ends, then closed ones.
fn joined(mut neighbours: BTreeMap<Side, Vec<Side>>) -> Vec<Vec<Side>> {
    let mut chains = Vec::new();
    while let Some(start) = first(&neighbours) {
        let mut chain = vec![start];
        let mut here = start;
        while let Some(next) = neighbours.get_mut(&here).and_then(Vec::pop) {
            let back = neighbours.get_mut(&next).expect("neighbours know each other");
            back.swap_remove(back.iter().position(|&side| side == here).expect("neighbours know each other"));
            chain.push(next);
            here = next;
        }
        neighbours.retain(|_, others| !others.is_empty());
        chains.push(chain);
    }
    chains
}

/// An end, or if there is none any side.
fn first(neighbours: &BTreeMap<Side, Vec<Side>>) -> Option<Side> {
    let end = neighbours.iter().find(|(_, others)| others.len() == 1);
    end.or_else(|| neighbours.iter().next()).map(|(&side, _)| side)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grid(width: usize, height: usize, value: impl Fn(f64, f64) -> f64) -> Grid {
        let values = (0..width * height).map(|i| value((i % width) as f64 + 0.5, (i / width) as f64 + 0.5)).collect();
        Grid { width, height, values }
    }

    /// Chords of a circle of radius r within squares of side 1 lie at most 1 / (4 r) inside it.
    #[test]
    fn a_cone_has_a_closed_circle_of_the_right_radius() {
        let cone = grid(64, 48, |x, y| 100.0 - (x - 32.3).hypot(y - 24.1));
        let lines = cone.isolux(80.0);
        assert_eq!(lines.len(), 1);
        assert_eq!(lines[0].first(), lines[0].last());
        for [x, y] in &lines[0] {
            assert!(((x - 32.3).hypot(y - 24.1) - 20.0).abs() < 0.02, "({x}, {y})");
        }
        let length: f64 =
            lines[0].windows(2).map(|ends| (ends[1][0] - ends[0][0]).hypot(ends[1][1] - ends[0][1])).sum();
        assert!((length / (40.0 * std::f64::consts::PI) - 1.0).abs() < 0.005, "{length}");
    }

    #[test]
    fn a_plateau_has_none() {
        let plateau = grid(8, 6, |_, _| 5.0);
        assert!([4.0, 5.0, 6.0].iter().all(|&level| plateau.isolux(level).is_empty()));
    }

    /// Along a slope the line is straight and goes from border to border, and every place on it has the level.
    #[test]
    fn a_slope_has_one_line_from_border_to_border() {
        let slope = grid(8, 6, |x, _| x);
        let lines = slope.isolux(3.2);
        assert_eq!(lines.len(), 1);
        assert!(lines[0].iter().all(|&place| (place[0] - 3.2).abs() < 1e-12 && (slope.at(place) - 3.2).abs() < 1e-12));
        let mut ends = [lines[0][0][1], lines[0].last().expect("two ends")[1]];
        ends.sort_by(f64::total_cmp);
        assert_eq!(ends, [0.0, 6.0]);
    }

    /// Two high cells that touch at a corner are one island where the middle is high, else two.
    #[test]
    fn the_middle_decides_a_saddle() {
        let islands = |low: f64, level: f64| {
            let high = |x: f64, y: f64| (x.floor(), y.floor()) == (1.0, 1.0) || (x.floor(), y.floor()) == (2.0, 2.0);
            grid(4, 4, |x, y| if high(x, y) { 1.0 } else { low }).isolux(level).len()
        };
        assert_eq!((islands(0.0, 0.4), islands(0.0, 0.6)), (1, 2));
    }
}
