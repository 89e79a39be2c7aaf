//! Numbers on isolux lines: where they fit.

use crate::{
    canvas::{Canvas, DOT, GLYPH},
    isolux::Line,
};

/// Lines shorter than this many pixels bear no number.
const SHORTEST: f64 = 130.0;
/// White around a number, pixels.
const FRAME: f64 = 3.0;
/// Room that numbers leave between each other and to the border, pixels.
const APART: f64 = 8.0;
/// Places of a line between which one is chosen.
const CANDIDATES: usize = 48;

/// A number's box, in pixels.
struct Label {
    text: String,
    centre: [f64; 2],
    half: [f64; 2],
}

/// Numbers of a picture.
pub(crate) struct LineLabels {
    /// Pixels of the picture.
    size: [f64; 2],
    labels: Vec<Label>,
}

impl LineLabels {
    /// Numbers for lines in pixels, each with the text of its level; the longest lines choose first.
    pub(crate) fn new(size: [usize; 2], lines: &[(String, Line)]) -> Self {
        let mut placed = Self { size: size.map(|n| n as f64), labels: Vec::new() };
        let mut order: Vec<usize> = (0..lines.len()).filter(|&i| length(&lines[i].1) >= SHORTEST).collect();
        order.sort_by(|&a, &b| length(&lines[b].1).total_cmp(&length(&lines[a].1)));
        for number in order {
            placed.place(number, lines);
        }
        placed
    }

    /// Puts a number where it hides the least of other lines, if there is room.
    fn place(&mut self, number: usize, lines: &[(String, Line)]) {
        let (text, line) = &lines[number];
        let half = [(text.len() * GLYPH.0 * DOT - DOT) as f64, (GLYPH.1 * DOT) as f64].map(|n| 0.5 * n + FRAME);
        let others = || lines.iter().enumerate().filter(|(i, _)| *i != number).flat_map(|(_, (_, line))| line);
        let step = (line.len() / CANDIDATES).max(1);
        // Half a step from a closed line's start, which lies at a border of the map's own making.
        let candidates = line.iter().skip(step / 2).step_by(step).filter(|&&at| self.has_room(at, half));
        let hidden = |at: &[f64; 2]| others().filter(|place| overlap(*at, **place, half.map(|n| n + FRAME))).count();
        if let Some(&centre) = candidates.min_by_key(|at| hidden(at)) {
            self.labels.push(Label { text: text.clone(), centre, half });
        }
    }

    fn has_room(&self, at: [f64; 2], half: [f64; 2]) -> bool {
        let inside = (0..2).all(|i| at[i] - half[i] >= APART && at[i] + half[i] <= self.size[i] - APART);
        let clear = |label: &Label| !overlap(at, label.centre, [0, 1].map(|i| half[i] + label.half[i] + APART));
        inside && self.labels.iter().all(clear)
    }

    /// Draws the numbers, black on white.
    pub(crate) fn draw(&self, canvas: &mut Canvas) {
        for Label { text, centre, half } in &self.labels {
            let corner = [0, 1].map(|i| (centre[i] - half[i]) as usize);
            canvas.fill(corner, half.map(|n| (2.0 * n) as usize), [255; 3]);
            canvas.text(corner[0] + FRAME as usize, corner[1] + FRAME as usize, text);
        }
    }
}

fn overlap(a: [f64; 2], b: [f64; 2], within: [f64; 2]) -> bool {
    (0..2).all(|i| (a[i] - b[i]).abs() < within[i])
}

fn length(line: &Line) -> f64 {
    line.windows(2).map(|ends| (ends[1][0] - ends[0][0]).hypot(ends[1][1] - ends[0][1])).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_keep_apart_and_inside() {
        let across = |y: f64| (0..=300).map(|x| [f64::from(x), y]).collect::<Line>();
        let lines: Vec<_> = [20.0, 26.0, 32.0, 2.0].iter().map(|&y| (format!("{y}"), across(y))).collect();
        let placed = LineLabels::new([300, 60], &lines);
        assert_eq!(placed.labels.len(), 3, "the number of the line at the border has no room");
        for (i, a) in placed.labels.iter().enumerate() {
            assert!(a.centre[0] - a.half[0] >= APART && a.centre[1] + a.half[1] <= 60.0 - APART);
            for b in &placed.labels[..i] {
                assert!(!overlap(a.centre, b.centre, [0, 1].map(|i| a.half[i] + b.half[i])));
            }
        }
    }
}
