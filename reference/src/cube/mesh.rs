//! A line graded towards its ends: the nodes of the radiosity solution along half an edge.

use crate::quadrature::Gauss;

/// Nodes on `0 < s <= 1`, the distance from an edge of the face in half-edges; the face's middle is at `s = 1`.
///
/// Panels shrink towards the edge by a constant ratio, because the solution behaves like `s^0.7` there. On the last
/// panel `[0, s1]` the nodes are graded once more by `s = s1 x^3`, which makes that power nearly a polynomial in `x`.
pub(crate) struct Mesh {
    /// Distances of the nodes from the edge, grouped by panel, the panel at the edge first.
    pub(crate) s: Vec<f64>,
    /// Quadrature weights; they sum to 1.
    pub(crate) weight: Vec<f64>,
    /// Nodes per panel.
    pub(crate) order: usize,
    /// Panel ends, ascending from 0 to 1.
    pub(crate) ends: Vec<f64>,
    rule: Gauss,
    barycentric: Vec<f64>,
}

impl Mesh {
    /// `order` nodes on each of `levels + 1` panels whose ends are the powers of `ratio`.
    pub(crate) fn new(order: usize, levels: usize, ratio: f64) -> Self {
        let rule = Gauss::new(order);
        let mut ends = vec![0.0];
        ends.extend((0..=levels).rev().map(|k| ratio.powi(k as i32)));
        let (mut s, mut weight) = (Vec::new(), Vec::new());
        for p in 0..=levels {
            let (near, far) = (ends[p], ends[p + 1]);
            for (&x, &w) in rule.nodes.iter().zip(&rule.weights) {
                let cubic = p == 0;
                s.push(if cubic { far * x * x * x } else { near + (far - near) * x });
                weight.push(if cubic { 3.0 * far * x * x * w } else { (far - near) * w });
            }
        }
        let barycentric = (0..order)
            .map(|i| {
                let others = (0..order).filter(|&j| j != i);
                others.map(|j| 1.0 / (rule.nodes[i] - rule.nodes[j])).product()
            })
            .collect();
        Mesh { s, weight, order, ends, rule, barycentric }
    }

    /// Number of nodes.
    pub(crate) fn len(&self) -> usize {
        self.s.len()
    }

    /// Number of panels.
    pub(crate) fn panels(&self) -> usize {
        self.ends.len() - 1
    }

    /// Adds `factor` times the Lagrange basis of panel `p` at distance `s` to `out`, one entry per node of the panel.
    pub(crate) fn add_basis(&self, p: usize, s: f64, factor: f64, out: &mut [f64]) {
        let (near, far) = (self.ends[p], self.ends[p + 1]);
        let x = if p == 0 { (s / far).max(0.0).cbrt() } else { (s - near) / (far - near) };
        // Barycentric form of the second kind (Berrut and Trefethen, SIAM Review 46, 2004).
        if let Some(hit) = self.rule.nodes.iter().position(|&node| node == x) {
            out[hit] += factor;
            return;
        }
        let terms = self.rule.nodes.iter().zip(&self.barycentric).map(|(node, b)| b / (x - node));
        let sum: f64 = terms.clone().sum();
        for (o, term) in out.iter_mut().zip(terms) {
            *o += factor * term / sum;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn weights_integrate_the_edge_power() {
        let mesh = Mesh::new(8, 6, 0.3);
        for power in [0.0, 0.6, 1.0, 2.5] {
            let terms = mesh.s.iter().zip(&mesh.weight).map(|(s, w): (&f64, _)| w * s.powf(power));
            let got: f64 = terms.sum();
            assert!((got * (power + 1.0) - 1.0).abs() < 1e-9, "s^{power}: {got}");
        }
    }

    #[test]
    fn the_basis_reproduces_the_edge_power() {
        let mesh = Mesh::new(8, 6, 0.3);
        for p in 0..mesh.panels() {
            for x in [0.01, 0.3, 0.77, 1.0] {
                let s = mesh.ends[p] + (mesh.ends[p + 1] - mesh.ends[p]) * x;
                let mut basis = vec![0.0; mesh.order];
                mesh.add_basis(p, s, 1.0, &mut basis);
                let nodes = &mesh.s[p * mesh.order..(p + 1) * mesh.order];
                let got: f64 = basis.iter().zip(nodes).map(|(b, s)| b * s.powf(0.7)).sum();
                assert!((got - s.powf(0.7)).abs() < 1e-5, "panel {p}, s = {s}: {got}");
            }
        }
    }
}
