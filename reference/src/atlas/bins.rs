//! Light in bins of wavelength.

use crate::eye::sensitivity;
use crate::quadrature::Gauss;

/// Lumens read of one spectral line over the truth, if light is kept in bins of this width and each bin is weighed by the eye's
/// sensitivity at its middle: the mean over all places of the bins' ends, `int V(line + u) du / (width V(line))` over half a width on either
/// side (nanometres). V is linear between rows 5 nm apart, and so are the pieces; good to 1e-9.
pub fn bin_reading(line: f64, width: f64) -> f64 {
    let (low, high) = (line - 0.5 * width, line + 0.5 * width);
    let mut ends = vec![low];
    let mut row = (low / 5.0).floor() * 5.0 + 5.0;
    while row < high {
        ends.push(row);
        row += 5.0;
    }
    ends.push(high);
    let rule = Gauss::new(2);
    let pieces = ends.windows(2).map(|piece| rule.integrate(piece[0], piece[1], sensitivity));
    pieces.sum::<f64>() / (width * sensitivity(line))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn many_places_of_the_bins_agree() {
        for (line, width) in [(589.3, 3.0), (589.3, 80.0), (450.0, 40.0)] {
            let n = 100_000;
            let place = |i: usize| line + width * ((i as f64 + 0.5) / n as f64 - 0.5);
            let mean = (0..n).map(|i| sensitivity(place(i))).sum::<f64>() / n as f64 / sensitivity(line);
            assert!((bin_reading(line, width) / mean - 1.0).abs() < 1e-7, "{line} {width}");
        }
    }
}
