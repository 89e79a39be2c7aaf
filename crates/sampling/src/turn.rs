//! Sine and cosine of a part of a turn.

use std::f64::consts::TAU;

/// Sine and cosine of `2 pi` times a number of turns, at least zero, to 4e-15: Taylor's series after reduction to an eighth of a turn, which is exact.
/// Unlike the system's functions it has the same bits on every system, and no call.
#[inline]
pub(crate) fn sin_cos(turns: f64) -> (f64, f64) {
    let quarter = (4.0 * turns + 0.5) as i64;
    let x = TAU * (turns - 0.25 * quarter as f64);
    let square = x * x;
    let series = |terms: [f64; 8]| terms.into_iter().rev().fold(0.0, |sum, term| sum * square + term);
    let sine = x * series(SINE);
    let cosine = series(COSINE);
    match quarter & 3 {
        0 => (sine, cosine),
        1 => (cosine, -sine),
        2 => (-sine, -cosine),
        _ => (-cosine, sine),
    }
}

/// `(-1)^k / (2 k + 1)!`
const SINE: [f64; 8] = terms(1);
/// `(-1)^k / (2 k)!`
const COSINE: [f64; 8] = terms(0);

const fn terms(first: u32) -> [f64; 8] {
    let mut terms = [1.0; 8];
    let mut k = 1;
    while k < 8 {
        let last = (2 * k as u32 + first) as f64;
        terms[k] = -terms[k - 1] / (last * (last - 1.0));
        k += 1;
    }
    terms
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_the_systems_sine_and_cosine() {
        for i in 0..3000 {
            let turns = f64::from(i) / 2711.0;
            let (sine, cosine) = sin_cos(turns);
            let (expected_sine, expected_cosine) = (TAU * turns).sin_cos();
            assert!((sine - expected_sine).abs() < 4e-15 && (cosine - expected_cosine).abs() < 4e-15, "{turns}");
            assert!((sine * sine + cosine * cosine - 1.0).abs() < 2e-15, "{turns}");
        }
        assert_eq!([0.0, 0.25, 0.5, 0.75].map(sin_cos), [(0.0, 1.0), (1.0, 0.0), (0.0, -1.0), (-1.0, 0.0)]);
    }
}
