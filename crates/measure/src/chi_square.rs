//! Do counts follow the expected counts?

use statrs::distribution::{ChiSquared, ContinuousCDF};

/// Cells with a smaller expected count are merged: below it the chi-square law is a poor approximation.
const THIN: f64 = 5.0;

/// The result of a chi-square test of goodness of fit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ChiSquare {
    /// Sum of (observed - expected)^2 / expected over the merged cells.
    pub statistic: f64,
    /// Merged cells minus one.
    pub degrees_of_freedom: usize,
    /// Probability of a statistic at least as large if the expectation is right.
    pub p_value: f64,
}

/// Why counts cannot be tested.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ChiSquareError {
    /// The two lists differ in length.
    #[error("{observed} observed cells, {expected} expected ones")]
    Length {
        /// Observed cells.
        observed: usize,
        /// Expected cells.
        expected: usize,
    },
    /// An expected count is negative or not finite.
    #[error("cell {cell} expects {count}")]
    BadCount {
        /// Index of the cell.
        cell: usize,
        /// Its expected count.
        count: f64,
    },
    /// The law used takes the total as given: both must have the same.
    #[error("{observed} counts observed, {expected} expected: totals must agree to 1e-6")]
    Totals {
        /// Sum of observed counts.
        observed: f64,
        /// Sum of expected counts.
        expected: f64,
    },
    /// After merging thin cells fewer than two remain.
    #[error("too few counts: after merging cells that expect fewer than 5, fewer than two remain")]
    TooFew,
}

/// Pearson's chi-square test of `observed` counts against `expected` counts of the same total.
///
/// Cells are taken in the order of their expected counts, smallest first, and pooled until each pool expects at
/// least 5. A count in a cell that expects exactly zero refutes at once: p-value 0.
pub fn chi_square_test(observed: &[u64], expected: &[f64]) -> Result<ChiSquare, ChiSquareError> {
    check(observed, expected)?;
    let cells = merge_thin(observed, expected);
    if cells.len() < 2 {
        return Err(ChiSquareError::TooFew);
    }
    let degrees_of_freedom = cells.len() - 1;
    let impossible = observed.iter().zip(expected).any(|(&o, &e)| o > 0 && e == 0.0);
    if impossible {
        return Ok(ChiSquare { statistic: f64::INFINITY, degrees_of_freedom, p_value: 0.0 });
    }
    let statistic = cells.iter().map(|(o, e)| (o - e).powi(2) / e).sum();
    let law = ChiSquared::new(degrees_of_freedom as f64).expect("at least one degree of freedom");
    Ok(ChiSquare { statistic, degrees_of_freedom, p_value: law.sf(statistic) })
}

fn check(observed: &[u64], expected: &[f64]) -> Result<(), ChiSquareError> {
    if observed.len() != expected.len() {
        return Err(ChiSquareError::Length { observed: observed.len(), expected: expected.len() });
    }
    if let Some(cell) = expected.iter().position(|&e| !(e >= 0.0 && e.is_finite())) {
        return Err(ChiSquareError::BadCount { cell, count: expected[cell] });
    }
    let total_observed = observed.iter().sum::<u64>() as f64;
    let total_expected = expected.iter().sum::<f64>();
    if (total_observed - total_expected).abs() > 1e-6 * total_observed.max(1.0) {
        return Err(ChiSquareError::Totals { observed: total_observed, expected: total_expected });
    }
    Ok(())
}

/// Pools of (observed, expected), each expecting at least [`THIN`].
fn merge_thin(observed: &[u64], expected: &[f64]) -> Vec<(f64, f64)> {
    let mut order: Vec<usize> = (0..expected.len()).collect();
    order.sort_by(|&a, &b| expected[a].total_cmp(&expected[b]));
    let mut pools: Vec<(f64, f64)> = Vec::new();
    let mut pool = (0.0, 0.0);
    for cell in order {
        pool = (pool.0 + observed[cell] as f64, pool.1 + expected[cell]);
        if pool.1 >= THIN {
            pools.push(std::mem::take(&mut pool));
        }
    }
    // The rest is thin only if every cell together is: sizes grow, so at most the last pool is left open.
    if pool.1 > 0.0 || pool.0 > 0.0 {
        match pools.last_mut() {
            Some(last) => *last = (last.0 + pool.0, last.1 + pool.1),
            None => pools.push(pool),
        }
    }
    pools
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Mendel's peas (Fisher 1936): 315, 108, 101, 32 against 9:3:3:1; statistic 0.470, p = 0.925.
    #[test]
    fn mendels_peas() {
        let expected = [9.0, 3.0, 3.0, 1.0].map(|share| share * 556.0 / 16.0);
        let test = chi_square_test(&[315, 108, 101, 32], &expected).unwrap();
        assert!((test.statistic - 0.470024).abs() < 1e-5);
        assert_eq!(test.degrees_of_freedom, 3);
        assert!((test.p_value - 0.925426).abs() < 1e-5);
    }

    #[test]
    fn thin_cells_are_pooled() {
        let expected = [1.0, 50.0, 2.0, 2.5, 44.5];
        let test = chi_square_test(&[3, 50, 2, 1, 44], &expected).unwrap();
        assert_eq!(test.degrees_of_freedom, 2);
        assert!((test.statistic - (0.5f64.powi(2) / 5.5 + 0.25 / 44.5)).abs() < 1e-12);
    }

    #[test]
    fn the_impossible_refutes() {
        assert_eq!(chi_square_test(&[1, 9, 10], &[0.0, 10.0, 10.0]).unwrap().p_value, 0.0);
    }

    #[test]
    fn what_cannot_be_tested_is_refused() {
        assert_eq!(chi_square_test(&[1, 2], &[1.5, 1.5]), Err(ChiSquareError::TooFew));
        assert!(matches!(chi_square_test(&[10], &[5.0, 5.0]), Err(ChiSquareError::Length { .. })));
        assert!(matches!(chi_square_test(&[10, 10], &[10.0, 11.0]), Err(ChiSquareError::Totals { .. })));
        assert!(matches!(chi_square_test(&[10, 10], &[10.0, f64::NAN]), Err(ChiSquareError::BadCount { cell: 1, .. })));
    }
}
