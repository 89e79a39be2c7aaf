//! Gauss-Legendre quadrature, the only numerical integration here.

use std::f64::consts::PI;

use crate::mitsuba::Place;
use crate::vector::Vector;

/// The Gauss-Legendre rule with `n` nodes on `[0, 1]`: exact for polynomials of degree `2n - 1`.
///
/// Nodes by Newton's iteration on the Legendre recurrence (Press et al., "Numerical Recipes", section 4.6); good to a
/// few units in the last place for the orders used here (below 100).
#[derive(Clone, Debug)]
pub(crate) struct Gauss {
    /// Nodes in `(0, 1)`, ascending.
    pub(crate) nodes: Vec<f64>,
    /// Weights; they sum to 1.
    pub(crate) weights: Vec<f64>,
}

impl Gauss {
    /// The rule with `n` nodes, `n >= 1`.
    pub(crate) fn new(n: usize) -> Self {
        let (mut nodes, mut weights) = (vec![0.0; n], vec![0.0; n]);
        for i in 0..n {
            let mut x = -(PI * (i as f64 + 0.75) / (n as f64 + 0.5)).cos();
            let mut slope = 1.0;
            for _ in 0..100 {
                let (value, derivative) = legendre(n, x);
                slope = derivative;
                let step = value / derivative;
                x -= step;
                if step.abs() < 1e-16 {
                    break;
                }
            }
            nodes[i] = 0.5 * (1.0 + x);
            weights[i] = 1.0 / ((1.0 - x * x) * slope * slope);
        }
        Gauss { nodes, weights }
    }

    /// The integral of `f` from `a` to `b`.
    pub(crate) fn integrate(&self, a: f64, b: f64, mut f: impl FnMut(f64) -> f64) -> f64 {
        let points = self.nodes.iter().zip(&self.weights);
        (b - a) * points.map(|(x, w)| w * f(a + (b - a) * x)).sum::<f64>()
    }

    /// The integral of `f` from `a` to `b` in `panels` equal pieces.
    pub(crate) fn composite(&self, a: f64, b: f64, panels: usize, mut f: impl FnMut(f64) -> f64) -> f64 {
        let step = (b - a) / panels as f64;
        let from = |i: usize| a + step * i as f64;
        (0..panels).map(|i| self.integrate(from(i), from(i + 1), &mut f)).sum()
    }
}

/// The mean over a flat rectangle of a function of the point: 8 by 8 nodes, for functions that are smooth over it.
pub(crate) fn mean_over(place: Place, f: impl Fn(Vector) -> f64) -> f64 {
    let rule = Gauss::new(8);
    rule.integrate(0.0, 1.0, |u| rule.integrate(0.0, 1.0, |v| f(place.point(2.0 * u - 1.0, 2.0 * v - 1.0))))
}

/// The Legendre polynomial of degree `n` at `x` and its derivative.
fn legendre(n: usize, x: f64) -> (f64, f64) {
    let (mut before, mut value) = (0.0, 1.0);
    for k in 0..n {
        let k = k as f64;
        (before, value) = (value, ((2.0 * k + 1.0) * x * value - k * before) / (k + 1.0));
    }
    (value, n as f64 * (x * value - before) / (x * x - 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn powers_are_exact_up_to_the_promised_degree() {
        for n in 1..20 {
            let rule = Gauss::new(n);
            for degree in 0..2 * n {
                let got = rule.integrate(0.0, 1.0, |x| x.powi(degree as i32));
                assert!((got * (degree as f64 + 1.0) - 1.0).abs() < 1e-13, "{n} {degree} {got}");
            }
        }
    }
}
