//! One bounce inside the cube: the irradiance at a point of a face from the exitance of all six.
//!
//! Lengths in half-edges. A function with the cube's symmetry is known by its values on the nodes of a quarter face,
//! counted by their distances from the two nearest edges. The irradiance at a point is the integral of exitance times
//!
//! - `4 / (pi (4 + d^2)^2)` over the opposite face, `d` the offset along the face: smooth, plain quadrature;
//! - `a z / (pi (a^2 + z^2 + y^2)^2)` over each neighbour, `a` the point's distance from the shared edge, `z` the
//!   source's distance from it and `y` the offset along it: nearly singular where `a` and `z` are small.
//!
//! Near a singularity the exitance is replaced by its interpolant and the kernel is integrated by the substitutions
//! `y = c sinh t` with `c^2 = a^2 + z^2`, and `z = a sinh t`, in which it is as smooth as `1 / cosh^3`.

use std::f64::consts::PI;

use super::mesh::Mesh;
use crate::quadrature::Gauss;

/// Beyond this `t` a kernel like `1 / cosh^3 t` has nothing left in double precision.
const TAIL: f64 = 14.0;

/// Distances from an edge are kept above this many half-edges, so that a value at the edge is the limit.
pub(crate) const AT_EDGE: f64 = 1e-12;

/// How a face's far half relates to its near one: 1 the same, -1 the opposite.
#[derive(Clone, Copy)]
pub(crate) struct Mirror {
    /// Away from the shared edge.
    pub(crate) across: f64,
    /// Along the shared edge.
    pub(crate) along: f64,
}

/// A face that is the same in all four quarters.
pub(crate) const EVEN: Mirror = Mirror { across: 1.0, along: 1.0 };

/// The one-bounce operator on a mesh.
pub(crate) struct Operator {
    mesh: Mesh,
    fine: Gauss,
}

impl Operator {
    /// The operator on this mesh.
    pub(crate) fn new(mesh: Mesh) -> Self {
        Operator { mesh, fine: Gauss::new(12) }
    }

    /// Number of unknowns: pairs of nodes, order ignored, since the two axes of a face are alike.
    pub(crate) fn unknowns(&self) -> usize {
        self.mesh.len() * (self.mesh.len() + 1) / 2
    }

    /// The distances from the two nearest edges of every unknown.
    pub(crate) fn points(&self) -> impl Iterator<Item = [f64; 2]> {
        let s = &self.mesh.s;
        (0..s.len()).flat_map(move |i| (0..=i).map(move |j| [s[i], s[j]]))
    }

    /// The share of a face that each unknown stands for; they sum to 1.
    pub(crate) fn shares(&self) -> Vec<f64> {
        let w = &self.mesh.weight;
        let share = |i: usize, j: usize| w[i] * w[j] * if i == j { 1.0 } else { 2.0 };
        (0..w.len()).flat_map(|i| (0..=i).map(move |j| share(i, j))).collect()
    }

    /// The weights with which the unknowns' exitances add up to the irradiance at the point with distances `s` from
    /// its two nearest edges, both in `[0, 1]`.
    pub(crate) fn row(&self, s: [f64; 2]) -> Vec<f64> {
        let n = self.mesh.len();
        let s = s.map(|x| x.max(AT_EDGE));
        let mut square = vec![0.0; n * n];
        self.add_opposite(s, 1.0, &mut square);
        for [across, along] in [s, [s[1], s[0]]] {
            self.add_neighbour(across, along, EVEN, &mut square);
            self.add_neighbour(2.0 - across, along, EVEN, &mut square);
        }
        self.fold(&square)
    }

    /// A square of weights for all pairs of nodes, as weights for the pairs whose order does not matter.
    pub(crate) fn fold(&self, square: &[f64]) -> Vec<f64> {
        let n = self.mesh.len();
        let both = |i: usize, j: usize| {
            if i == j { square[i * n + i] } else { square[i * n + j] + square[j * n + i] }
        };
        (0..n).flat_map(|i| (0..=i).map(move |j| both(i, j))).collect()
    }

    /// The mesh along half an edge.
    pub(crate) fn mesh(&self) -> &Mesh {
        &self.mesh
    }

    /// Adds the opposite face, even in its first coordinate; in its second the far half is `mirror` times the near one.
    pub(crate) fn add_opposite(&self, s: [f64; 2], mirror: f64, square: &mut [f64]) {
        let Mesh { s: nodes, weight, .. } = &self.mesh;
        for (i, row) in square.chunks_exact_mut(nodes.len()).enumerate() {
            for du in [s[0] - nodes[i], 2.0 - s[0] - nodes[i]] {
                for (j, value) in row.iter_mut().enumerate() {
                    for (dv, sign) in [(s[1] - nodes[j], 1.0), (2.0 - s[1] - nodes[j], mirror)] {
                        let r2 = 4.0 + du * du + dv * dv;
                        *value += sign * weight[i] * weight[j] * 4.0 / (PI * r2 * r2);
                    }
                }
            }
        }
    }

    /// Adds a neighbouring face for a point at distance `a` from the shared edge, `along` from that edge's nearer end.
    /// Rows of `square` belong to the distance from the shared edge.
    pub(crate) fn add_neighbour(&self, a: f64, along: f64, mirror: Mirror, square: &mut [f64]) {
        let Mesh { s: nodes, weight, order, .. } = &self.mesh;
        let n = nodes.len();
        let mut line = vec![0.0; n];
        let close = self.mesh.ends[1] * 4.0 > a;
        if close {
            self.add_strip_at_edge(a, along, mirror, square);
        }
        for (i, row) in square.chunks_exact_mut(n).enumerate() {
            let near_half = (!close || i >= *order).then_some((nodes[i], 1.0));
            for (z, sign) in near_half.into_iter().chain([(2.0 - nodes[i], mirror.across)]) {
                self.line(a.hypot(z), along, mirror.along, &mut line);
                let factor = sign * weight[i] * a * z / PI;
                row.iter_mut().zip(&line).for_each(|(value, x)| *value += factor * x);
            }
        }
    }

    /// The neighbour's panel at the shared edge, when the point is as close to that edge: `z = a sinh t`.
    fn add_strip_at_edge(&self, a: f64, along: f64, mirror: Mirror, square: &mut [f64]) {
        let (order, n) = (self.mesh.order, self.mesh.len());
        let mut line = vec![0.0; n];
        let mut basis = vec![0.0; order];
        self.segments(0.0, (self.mesh.ends[1] / a).asinh(), |t, weight| {
            let (z, c) = (a * t.sinh(), a * t.cosh());
            self.line(c, along, mirror.along, &mut line);
            basis.fill(0.0);
            self.mesh.add_basis(0, z, weight * a * z * c / PI, &mut basis);
            for (i, b) in basis.iter().enumerate() {
                let row = &mut square[i * n..(i + 1) * n];
                row.iter_mut().zip(&line).for_each(|(value, x)| *value += b * x);
            }
        });
    }

    /// Weights along a line parallel to the shared edge: the integral over the whole edge of the basis function of
    /// each node (and of its mirror image, times `mirror`) over `(c^2 + y^2)^2`.
    fn line(&self, c: f64, along: f64, mirror: f64, out: &mut [f64]) {
        out.fill(0.0);
        for (centre, sign) in [(along, 1.0), (2.0 - along, mirror)] {
            for p in 0..self.mesh.panels() {
                let nodes = p * self.mesh.order..(p + 1) * self.mesh.order;
                if self.is_near(p, c, centre) {
                    self.add_peak(p, c, centre, sign, &mut out[nodes]);
                } else {
                    for i in nodes {
                        let y = self.mesh.s[i] - centre;
                        let r2 = c * c + y * y;
                        out[i] += sign * self.mesh.weight[i] / (r2 * r2);
                    }
                }
            }
        }
    }

    /// True if the pole of the kernel at `centre + i c` spoils the plain rule on panel `p`: it lies within the ellipse
    /// around the panel whose axes add up to `rho` half-lengths; the rule's error falls like `rho^(-2 order)`.
    fn is_near(&self, p: usize, c: f64, centre: f64) -> bool {
        let (near, far) = (self.mesh.ends[p], self.mesh.ends[p + 1]);
        let half = 0.5 * (far - near);
        let (x, y) = ((centre - 0.5 * (near + far)) / half, c / half);
        let focus = |f: f64| ((x - f) * (x - f) + y * y).sqrt();
        let sum = 0.5 * (focus(1.0) + focus(-1.0));
        sum + (sum * sum - 1.0).max(0.0).sqrt() < if p == 0 { 20.0 } else { 4.5 }
    }

    fn add_peak(&self, p: usize, c: f64, centre: f64, sign: f64, out: &mut [f64]) {
        let (near, far) = (self.mesh.ends[p], self.mesh.ends[p + 1]);
        let from = ((near - centre) / c).asinh().max(-TAIL);
        let to = ((far - centre) / c).asinh().min(TAIL);
        if from >= to {
            return;
        }
        self.segments(from, to, |t, weight| {
            let cosh = c * t.cosh();
            let s = (centre + c * t.sinh()).clamp(near, far);
            self.mesh.add_basis(p, s, sign * weight / (cosh * cosh * cosh), out);
        });
    }

    /// Calls `f` with the nodes and weights of a composite rule from `from` to `to` with pieces at most 1.5 long.
    fn segments(&self, from: f64, to: f64, mut f: impl FnMut(f64, f64)) {
        let pieces = ((to - from) / 1.5).ceil().max(1.0);
        let step = (to - from) / pieces;
        for piece in 0..pieces as usize {
            for (x, w) in self.fine.nodes.iter().zip(&self.fine.weights) {
                f(from + step * (piece as f64 + x), step * w);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A closed cavity receives from itself what it sends: the weights are nowhere made to sum to 1, so that the sum
    /// measures the error of the quadrature.
    #[test]
    fn a_uniform_exitance_comes_back() {
        for (order, levels, ratio) in [(8, 6, 0.3), (8, 4, 0.2)] {
            let operator = Operator::new(Mesh::new(order, levels, ratio));
            for s in [1.0, 0.5, 0.1, 0.01, 0.002, 1e-3, 1e-4, 1e-6, 0.0] {
                for t in [1.0, 0.63, 0.05, 0.002, 1e-4, 0.0] {
                    let sum: f64 = operator.row([s, t]).iter().sum();
                    assert!((sum - 1.0).abs() < 1e-6, "{ratio} {s} {t}: {:e}", sum - 1.0);
                }
            }
        }
    }
}
