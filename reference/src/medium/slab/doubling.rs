//! Adding and doubling: operators on radiances at the nodes.

use super::{Shares, SlabShares};
use crate::medium::phase::HenyeyGreenstein;
use crate::quadrature::Gauss;

/// A square matrix by rows. `m[i][j]` times the radiance that falls in at node `j` gives the radiance that comes out at
/// node `i`; weights and cosines of integration are included.
type Matrix = Vec<Vec<f64>>;

/// The layer is doubled this often.
const DOUBLINGS: i32 = 30;

/// A layer: what it reflects, what it transmits scattered, and the share that passes each node untouched.
///
/// The untouched light is kept apart, so that the scattered part, tiny at first, loses no digits.
struct Layer {
    reflected: Matrix,
    scattered: Matrix,
    untouched: Vec<f64>,
}

/// See [`super::Slab::shares`].
pub(super) fn shares(
    thickness: f64,
    albedo: f64,
    phase: HenyeyGreenstein,
    order: usize,
    cosines: &[f64],
) -> SlabShares {
    let rule = Gauss::new(order);
    let mu: Vec<f64> = rule.nodes.iter().chain(cosines).copied().collect();
    let weight: Vec<f64> = rule.weights.iter().copied().chain(cosines.iter().map(|_| 0.0)).collect();
    let mut layer = thin(thickness * 2f64.powi(-DOUBLINGS), albedo, phase, 2 * order - 1, &mu, &weight);
    for _ in 0..DOUBLINGS {
        layer = doubled(&layer);
    }
    let beam = |i: usize| Shares {
        reflected: layer.reflected[i].iter().sum(),
        transmitted: layer.untouched[i] + layer.scattered[i].iter().sum::<f64>(),
    };
    let mut diffuse = Shares { reflected: 0.0, transmitted: 0.0 };
    for i in 0..order {
        let (flux, share) = (2.0 * weight[i] * mu[i], beam(i));
        diffuse.reflected += flux * share.reflected;
        diffuse.transmitted += flux * share.transmitted;
    }
    SlabShares { beams: (order..mu.len()).map(beam).collect(), diffuse }
}

/// A layer of optical thickness `depth` in which light scatters at most once, to second order in `depth`: a path into the
/// layer and out of it at the cosines `m` and `n` is attenuated as if it turned around in the middle.
fn thin(depth: f64, albedo: f64, phase: HenyeyGreenstein, degree: usize, mu: &[f64], weight: &[f64]) -> Layer {
    let entry = |i: usize, j: usize, sign: f64| {
        let (m, n) = (mu[i], mu[j]);
        let mean = phase.azimuthal_mean(m, sign * n, degree);
        0.5 * albedo * mean * weight[j] * depth / m * (-0.5 * depth * (1.0 / m + 1.0 / n)).exp()
    };
    let matrix = |sign: f64| (0..mu.len()).map(|i| (0..mu.len()).map(|j| entry(i, j, sign)).collect()).collect();
    Layer {
        reflected: matrix(-1.0),
        scattered: matrix(1.0),
        untouched: mu.iter().map(|m| (-depth / m).exp()).collect(),
    }
}

/// Two such layers. With `R`, `T` and `D` for reflected, scattered and untouched, and `S = (1 - RR)^-1 - 1` for the light
/// that went to and fro between the layers, the scattered part is `D T + T D + T T + (D + T) S (D + T)`.
fn doubled(layer: &Layer) -> Layer {
    let (r, t, d) = (&layer.reflected, &layer.scattered, &layer.untouched);
    let n = d.len();
    let total = with_diagonal(t, d);
    let rr = product(r, r);
    let between = to_and_fro(&rr);
    let between_total = product(&between, &total);
    let around = product(&total, &between_total);
    let tt = product(t, t);
    let scattered =
        (0..n).map(|i| (0..n).map(|j| (d[i] + d[j]) * t[i][j] + tt[i][j] + around[i][j]).collect()).collect();
    // R + (D + T) (1 + S) R (D + T).
    let returned = product(r, &total);
    let again = product(&between, &returned);
    let inner: Matrix = (0..n).map(|i| (0..n).map(|j| returned[i][j] + again[i][j]).collect()).collect();
    let out = product(&total, &inner);
    let reflected = (0..n).map(|i| (0..n).map(|j| r[i][j] + out[i][j]).collect()).collect();
    Layer { reflected, scattered, untouched: d.iter().map(|x| x * x).collect() }
}

fn with_diagonal(t: &Matrix, d: &[f64]) -> Matrix {
    let mut total = t.clone();
    total.iter_mut().zip(d).enumerate().for_each(|(i, (row, d))| row[i] += d);
    total
}

fn product(a: &Matrix, b: &Matrix) -> Matrix {
    let n = a.len();
    let mut c = vec![vec![0.0; n]; n];
    for i in 0..n {
        for k in 0..n {
            for j in 0..n {
                c[i][j] += a[i][k] * b[k][j];
            }
        }
    }
    c
}

/// `(1 - A)^-1 A`, by Gauss's elimination; `1 - A` is diagonally heavy, so that no pivoting is needed.
fn to_and_fro(a: &Matrix) -> Matrix {
    let n = a.len();
    let mut left = a.clone();
    left.iter_mut().flatten().for_each(|x| *x = -*x);
    (0..n).for_each(|i| left[i][i] += 1.0);
    let mut right = a.clone();
    for k in 0..n {
        for i in (0..n).filter(|&i| i != k) {
            let factor = left[i][k] / left[k][k];
            for j in 0..n {
                left[i][j] -= factor * left[k][j];
                right[i][j] -= factor * right[k][j];
            }
        }
    }
    (0..n).for_each(|i| right[i].iter_mut().for_each(|x| *x /= left[i][i]));
    right
}

#[test]
fn elimination_solves_its_equation() {
    let a: Matrix = vec![vec![0.2, 0.1, 0.0], vec![0.3, 0.4, 0.05], vec![0.0, 0.2, 0.1]];
    let s = to_and_fro(&a);
    let a_s = product(&a, &s);
    for i in 0..3 {
        for j in 0..3 {
            assert!((s[i][j] - a_s[i][j] - a[i][j]).abs() < 1e-14);
        }
    }
}
