//! Balls of many sizes, and which of them may hold a point.

use std::collections::HashMap;

use glam::DVec3;

/// An index of balls: each lies in up to eight cubes of a grid as fine as itself, and a point in one cube of each grid.
#[derive(Clone, Debug, Default)]
pub(crate) struct Zones {
    /// The grids in use, by the binary logarithm of a cube's edge.
    levels: Vec<i32>,
    /// Where the balls of each cube stand in `members`.
    cubes: HashMap<u64, [u32; 2]>,
    members: Vec<u32>,
}

impl Zones {
    /// Of centres and positive radii, metres.
    pub(crate) fn new(balls: impl Iterator<Item = (DVec3, f64)>) -> Self {
        let mut entries = Vec::new();
        let mut levels = Vec::new();
        for (number, (centre, radius)) in balls.enumerate() {
            let level = (2.0 * radius).log2().ceil() as i32;
            levels.push(level);
            let [low, high] = [-radius, radius].map(|by| cube(centre + DVec3::splat(by), level));
            for x in low[0]..=high[0] {
                for y in low[1]..=high[1] {
                    for z in low[2]..=high[2] {
                        entries.push((key(level, [x, y, z]), number as u32));
                    }
                }
            }
        }
        levels.sort_unstable();
        levels.dedup();
        entries.sort_unstable();
        // Of two cubes with one key a ball that lies in both is to be met once.
        entries.dedup();
        let mut cubes = HashMap::new();
        let mut first = 0;
        for of_cube in entries.chunk_by(|a, b| a.0 == b.0) {
            let end = first + of_cube.len() as u32;
            cubes.insert(of_cube[0].0, [first, end]);
            first = end;
        }
        Self { levels, cubes, members: entries.into_iter().map(|(_, number)| number).collect() }
    }

    /// All balls that hold a point, and some that do not, in an order that depends on them alone.
    pub(crate) fn around(&self, point: DVec3) -> impl Iterator<Item = usize> {
        let of_level = move |&level: &i32| {
            let range = self.cubes.get(&key(level, cube(point, level))).copied().unwrap_or_default();
            &self.members[range[0] as usize..range[1] as usize]
        };
        self.levels.iter().flat_map(of_level).map(|&number| number as usize)
    }
}

fn cube(point: DVec3, level: i32) -> [i64; 3] {
    (point * f64::from(-level).exp2()).floor().to_array().map(|along| along as i64)
}

/// Cubes that share a key are taken for one, which costs time and nothing else.
fn key(level: i32, cube: [i64; 3]) -> u64 {
    [i64::from(level)].iter().chain(&cube).fold(0, |key: u64, &along| {
        let mixed = (key.rotate_left(21) ^ along as u64).wrapping_mul(0x9E37_79B9_7F4A_7C15);
        mixed ^ (mixed >> 29)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_ball_that_holds_a_point_is_found_once() {
        // A van der Corput-like set of places and radii over four decades.
        let number = |index: u32, by: f64| (f64::from(index) * by).fract();
        let balls: Vec<(DVec3, f64)> = (1..500)
            .map(|index| {
                let at = DVec3::new(number(index, 0.618), number(index, 0.414), number(index, 0.732));
                (8.0 * (at - 0.5), 10f64.powf(-3.0 + 3.5 * number(index, 0.236)))
            })
            .collect();
        let zones = Zones::new(balls.iter().copied());
        let mut found = 0;
        for index in 0..500 {
            let point =
                if index % 2 == 0 { balls[index / 2].0 } else { 7.0 * (DVec3::splat(number(index as u32, 0.3)) - 0.5) };
            let mut around: Vec<usize> = zones.around(point).collect();
            around.sort_unstable();
            assert!(around.is_sorted_by(|a, b| a < b), "once");
            for (ball, (centre, radius)) in balls.iter().enumerate() {
                if (point - centre).length() <= *radius {
                    assert!(around.contains(&ball));
                    found += 1;
                }
            }
        }
        assert!(found > 300, "{found}");
        assert_eq!(Zones::default().around(DVec3::ZERO).count(), 0);
    }
}
