//! A hash grid of cells as wide as the radius, positions and payload in cell order, sixteen photons at once.

use crate::contestant::{Checksum, Contestant, Job};
use crate::photons::PhotonSet;

/// Rows of cells are hashed by y and z and run on along x, so that three neighbours are one run of photons. Rows may
/// share cells: the distance decides, and runs that overlap are joined.
pub(crate) struct Grid {
    radius: f32,
    lo: [f32; 3],
    cells: [usize; 3],
    /// Where each cell's photons begin, and the end.
    begins: Vec<u32>,
    /// x, y, z, red, green, blue, each padded by sixteen.
    lanes: [Vec<f32>; 6],
}

/// Places where rows may begin.
const ROWS: usize = 1 << 21;

fn row(y: usize, z: usize) -> usize {
    (y.wrapping_mul(73_856_093) ^ z.wrapping_mul(19_349_663)).wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 43
}

impl Grid {
    pub(crate) fn build(set: &PhotonSet, radius: f32) -> Self {
        let end =
            |pick: fn(f32, f32) -> f32, axis: usize| set.points.iter().map(|p| p[axis]).reduce(pick).unwrap_or(0.0);
        let lo: [f32; 3] = std::array::from_fn(|axis| end(f32::min, axis));
        let cells = std::array::from_fn(|axis| ((end(f32::max, axis) - lo[axis]) / radius) as usize + 1);
        let mut grid = Self { radius, lo, cells, begins: vec![], lanes: Default::default() };
        let number = |point: &[f32; 3]| {
            let [x, y, z] = std::array::from_fn(|axis| ((point[axis] - lo[axis]) / radius) as usize);
            row(y, z) + x
        };
        let mut begins = vec![0u32; ROWS + cells[0] + 2];
        set.points.iter().for_each(|point| begins[number(point) + 2] += 1);
        (1..begins.len()).for_each(|i| begins[i] += begins[i - 1]);
        grid.lanes = std::array::from_fn(|_| vec![f32::NAN; set.points.len() + 16]);
        for (point, payload) in set.points.iter().zip(&set.payload) {
            let at = &mut begins[number(point) + 1];
            let values = point.iter().chain(payload);
            grid.lanes.iter_mut().zip(values).for_each(|(lane, &value)| lane[*at as usize] = value);
            *at += 1;
        }
        grid.begins = begins;
        grid
    }

    /// Photons in the ball and, where asked, their RGB sum.
    #[inline(always)]
    fn within<const SUM: bool>(&self, query: [f32; 3]) -> (usize, [f32; 3]) {
        let span = |axis: usize| {
            let cell = ((query[axis] - self.lo[axis]) / self.radius).floor() as i64;
            let last = self.cells[axis] as i64 - 1;
            (cell - 1).clamp(0, last) as usize..=(cell + 1).clamp(0, last) as usize
        };
        let (mut count, mut sums) = ([0u32; 16], [[0f32; 16]; 3]);
        let (mut runs, mut found) = ([(0, 0); 9], 0);
        for z in span(2) {
            for y in span(1) {
                let row = row(y, z);
                let run = (self.begins[row + span(0).start()], self.begins[row + span(0).end() + 1]);
                runs[found] = run;
                found += usize::from(run.0 < run.1);
            }
        }
        let runs = &mut runs[..found];
        runs.sort_unstable();
        let mut done = 0;
        for &(from, end) in &*runs {
            for first in (from.max(done)..end).step_by(16) {
                self.block::<SUM>(query, first as usize, end as usize, &mut count, &mut sums);
            }
            done = done.max(end);
        }
        (count.iter().sum::<u32>() as usize, sums.map(|lanes| lanes.iter().sum()))
    }

    #[inline(always)]
    fn block<const SUM: bool>(
        &self,
        query: [f32; 3],
        first: usize,
        end: usize,
        count: &mut [u32; 16],
        sums: &mut [[f32; 16]; 3],
    ) {
        let [x, y, z, red, green, blue] =
            self.lanes.each_ref().map(|lane| lane[first..].first_chunk::<16>().expect("padded"));
        let left = (end - first) as u32;
        let mut inside = [0u32; 16];
        for i in 0..16 {
            let (dx, dy, dz) = (query[0] - x[i], query[1] - y[i], query[2] - z[i]);
            let near = (dx * dx + dy * dy) + dz * dz <= self.radius * self.radius;
            inside[i] = if near & ((i as u32) < left) { u32::MAX } else { 0 };
        }
        for i in 0..16 {
            count[i] += inside[i] & 1;
        }
        if SUM && inside != [0; 16] {
            for (sum, values) in sums.iter_mut().zip([red, green, blue]) {
                for i in 0..16 {
                    sum[i] += f32::from_bits(values[i].to_bits() & inside[i]);
                }
            }
        }
    }

    #[inline(always)]
    fn ask<const SUM: bool>(&self, queries: &[[f32; 3]]) -> Checksum {
        let mut sum = Checksum::default();
        for &query in queries {
            let (count, flux) = self.within::<SUM>(query);
            sum.add(if SUM { 0 } else { count }, 0.0, flux);
        }
        sum
    }
}

/// The same, compiled for AVX-512.
#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512bw,avx512dq,avx512vl")]
fn ask_avx512<const SUM: bool>(grid: &Grid, queries: &[[f32; 3]]) -> Checksum {
    grid.ask::<SUM>(queries)
}

#[allow(unsafe_code)] // Runs code for instructions that were asked for first.
fn ask<const SUM: bool>(grid: &Grid, queries: &[[f32; 3]]) -> Checksum {
    #[cfg(target_arch = "x86_64")]
    if photonlab_kdtree::Instructions::Avx512.is_available() {
        // SAFETY: the processor has the features.
        return unsafe { ask_avx512::<SUM>(grid, queries) };
    }
    grid.ask::<SUM>(queries)
}

impl Contestant for Grid {
    fn run(&mut self, job: Job, queries: &[[f32; 3]]) -> Option<Checksum> {
        match job {
            Job::Nearest(_) => None,
            Job::Radius(_) => Some(ask::<true>(self, queries)),
            Job::Search(_) => Some(ask::<false>(self, queries)),
        }
    }
}
