//! A quasi-random point set for photons: Sobol's sequence, scrambled.

use crate::Stream;

/// Dimensions: as many as a stream takes for its leading numbers.
pub(crate) const DIMENSIONS: usize = Stream::PREFIX;

/// Degree, inner coefficients and first direction numbers of the primitive polynomials of all dimensions but the first (Joe and Kuo,
/// "Constructing Sobol sequences with better two-dimensional projections", SIAM J. Sci. Comput. 2008).
const POLYNOMIALS: [(usize, u32, [u32; 3]); DIMENSIONS - 1] =
    [(1, 0, [1, 0, 0]), (2, 1, [1, 3, 0]), (3, 1, [1, 3, 1]), (3, 2, [1, 1, 1])];

/// The columns of the generating matrices, those of all dimensions for one bit of the index side by side.
static COLUMNS: [[u32; DIMENSIONS]; 32] = columns();

const fn columns() -> [[u32; DIMENSIONS]; 32] {
    let mut all = [[0; DIMENSIONS]; 32];
    let mut bit = 0;
    while bit < 32 {
        all[bit][0] = 1 << (31 - bit);
        let mut axis = 1;
        while axis < DIMENSIONS {
            let (degree, inner, first) = POLYNOMIALS[axis - 1];
            all[bit][axis] = if bit < degree {
                first[bit] << (31 - bit)
            } else {
                let mut column = all[bit - degree][axis] ^ (all[bit - degree][axis] >> degree);
                let mut term = 1;
                while term < degree {
                    if (inner >> (degree - 1 - term)) & 1 == 1 {
                        column ^= all[bit - term][axis];
                    }
                    term += 1;
                }
                column
            };
            axis += 1;
        }
        bit += 1;
    }
    all
}

/// Point number `index` with each coordinate scrambled by a seed of its own: of the points that agree in their leading bits each
/// half stays whole, and which half is which is up to chance (Owen, "Randomly permuted (t,m,s)-nets and (t,s)-sequences", 1995), by a
/// hash of the leading bits (Laine and Karras, "Stratified sampling for stochastic transparency", EGSR 2011). Every point is uniform
/// by itself, and points of two seeds are independent. Beyond 2^32 points a new set begins.
pub(crate) fn point(index: u64, seeds: &[u32; DIMENSIONS]) -> [f64; DIMENSIONS] {
    let mut words = [0u32; DIMENSIONS];
    let mut rest = index as u32;
    while rest != 0 {
        let column = &COLUMNS[rest.trailing_zeros() as usize];
        for (word, bits) in words.iter_mut().zip(column) {
            *word ^= bits;
        }
        rest &= rest - 1;
    }
    let set = ((index >> 32) as u32).wrapping_mul(0x9E37_79B9);
    std::array::from_fn(|axis| {
        let scrambled = scrambled(words[axis], seeds[axis] ^ set);
        (f64::from(scrambled) + 0.5) / 4_294_967_296.0
    })
}

/// The hash works from the lowest bit up, so it is given the bits in reverse.
fn scrambled(word: u32, seed: u32) -> u32 {
    let mut bits = word.reverse_bits();
    bits ^= bits.wrapping_mul(0x3d20_adea);
    bits = bits.wrapping_add(seed);
    bits = bits.wrapping_mul((seed >> 16) | 1);
    bits ^= bits.wrapping_mul(0x0552_6c56);
    bits ^= bits.wrapping_mul(0x53a2_2864);
    bits.reverse_bits()
}

#[cfg(test)]
mod tests {
    use super::*;

    const SEEDS: [u32; DIMENSIONS] = [0x1234_5678, 0x9abc_def1, 77, 0xdead_beef, 0x0bad_cafe];

    /// Each of 2^m equal intervals of each axis has one of 2^m points, and so has each box of the first two axes that is an
    /// elementary interval: what makes the set a digital net, and what scrambling must keep.
    #[test]
    fn every_elementary_interval_has_its_point() {
        for (first, seeds) in [(0u64, [0; DIMENSIONS]), (0, SEEDS), (3 << 10, SEEDS)] {
            let points: Vec<_> = (first..first + 1024).map(|index| point(index, &seeds)).collect();
            for axis in 0..DIMENSIONS {
                let mut cells: Vec<_> = points.iter().map(|x| (1024.0 * x[axis]) as usize).collect();
                cells.sort_unstable();
                assert!(cells.into_iter().eq(0..1024), "axis {axis}");
            }
            for across in 0..=10 {
                let (columns, rows) = (1 << across, 1 << (10 - across));
                let place = |x: &[f64; DIMENSIONS]| {
                    (f64::from(columns) * x[0]) as usize * rows as usize + (f64::from(rows) * x[1]) as usize
                };
                let mut cells: Vec<_> = points.iter().map(place).collect();
                cells.sort_unstable();
                assert!(cells.into_iter().eq(0..1024), "{columns} x {rows}");
            }
        }
    }

    /// Published numbers (Joe and Kuo's table for these polynomials), without scrambling.
    #[test]
    fn the_first_points_are_sobols() {
        let unscrambled = |index| {
            let mut words = [0u32; DIMENSIONS];
            (0..32).filter(|bit| index >> bit & 1 == 1).for_each(|bit| {
                words.iter_mut().zip(&COLUMNS[bit]).for_each(|(word, bits)| *word ^= bits);
            });
            words.map(|word| f64::from(word) / 4_294_967_296.0)
        };
        assert_eq!(unscrambled(1), [0.5; DIMENSIONS]);
        assert_eq!(unscrambled(2), [0.25, 0.75, 0.75, 0.75, 0.25]);
        assert_eq!(unscrambled(4), [0.125, 0.625, 0.375, 0.125, 0.125]);
    }

    /// The mean over seeds of an indicator that no interval of powers of two fits, and its spread, which must be far below chance's.
    #[test]
    fn means_are_unbiased_and_closer_than_random_ones() {
        let (n, sets) = (256u64, 400u32);
        let inside = |x: &[f64; DIMENSIONS]| f64::from(u8::from((x[0] - 0.4).hypot(x[1] - 0.6) < 0.3));
        let truth = std::f64::consts::PI * 0.09;
        let means: Vec<f64> = (0..sets)
            .map(|set| {
                let mut stream = Stream::new(5, crate::Purpose::Synthetic, set, 0);
                let seeds = std::array::from_fn(|_| (stream.next() * 4_294_967_296.0) as u32);
                (0..n).map(|index| inside(&point(index, &seeds))).sum::<f64>() / n as f64
            })
            .collect();
        let mean = means.iter().sum::<f64>() / f64::from(sets);
        let variance = means.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / f64::from(sets - 1);
        assert!((mean - truth).abs() < 4.0 * (variance / f64::from(sets)).sqrt(), "{mean} for {truth}");
        assert!(variance < 0.1 * truth * (1.0 - truth) / n as f64, "{variance}");
    }
}
