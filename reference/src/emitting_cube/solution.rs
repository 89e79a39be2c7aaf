//! The operators of even and odd light, and what they give.

use std::f64::consts::PI;

use super::{OutOfRange, require_albedo};
use crate::cube::mesh::Mesh;
use crate::cube::operator::{AT_EDGE, EVEN, Mirror, Operator};

/// A face of the cube.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Face {
    /// z = 1, which emits.
    Ceiling,
    /// One of the four upright ones.
    Wall,
    /// z = 0.
    Floor,
}

/// The operators of a unit cube, for any reflectance.
pub struct EmittingCube {
    /// Even and odd on the finer mesh, then on the other.
    parts: [[Part; 2]; 2],
}

/// The irradiance for one reflectance, per unit of the ceiling's exitance.
pub struct EmittingCubeSolution<'a> {
    cube: &'a EmittingCube,
    reflectance: f64,
    /// Node values in the order of the cube's parts.
    values: [[Vec<f64>; 2]; 2],
    error_bound: f64,
}

impl EmittingCube {
    /// Sets up the operators: some seconds in an optimised build.
    #[allow(clippy::new_without_default)] // A default that takes seconds would surprise.
    pub fn new() -> Self {
        let both = |order, levels, ratio| [1.0, -1.0].map(|sign| Part::new(Mesh::new(order, levels, ratio), sign));
        std::thread::scope(|scope| {
            let other = scope.spawn(move || both(6, 4, 0.2));
            EmittingCube { parts: [both(6, 5, 0.25), other.join().expect("no panic on the other mesh")] }
        })
    }

    /// The irradiance when all faces have this reflectance, in `[0, 1)`.
    pub fn solve(&self, reflectance: f64) -> Result<EmittingCubeSolution<'_>, OutOfRange> {
        require_albedo("reflectance", reflectance)?;
        let values = self.parts.each_ref().map(|parts| parts.each_ref().map(|part| part.solve(reflectance)));
        let mut solution = EmittingCubeSolution { cube: self, reflectance, values, error_bound: 0.0 };
        for face in [Face::Ceiling, Face::Wall, Face::Floor] {
            for x in [0.5, 0.3, 0.1, 0.01, 0.001] {
                for y in [0.5, 0.2, 0.01, 0.001, 0.9, 0.99, 0.999] {
                    let [a, b] = [0, 1].map(|mesh| solution.on_mesh(mesh, face, x, y));
                    solution.error_bound = solution.error_bound.max((a - b).abs());
                }
            }
        }
        Ok(solution)
    }
}

impl EmittingCubeSolution<'_> {
    /// Irradiance at a point, per unit of the ceiling's exitance: `(x, y)` on floor and ceiling, `(x, z)` on a wall, all in
    /// `[0, 1]`.
    pub fn irradiance(&self, face: Face, x: f64, y_or_z: f64) -> f64 {
        self.on_mesh(0, face, x, y_or_z)
    }

    /// Mean irradiance of a face, per unit of the ceiling's exitance.
    pub fn mean(&self, face: Face) -> f64 {
        let [even, odd] = [0, 1].map(|p| self.cube.parts[0][p].means(&self.values[0][p]));
        match face {
            Face::Ceiling => even[0] + odd[0],
            Face::Floor => even[0] - odd[0],
            Face::Wall => even[1],
        }
    }

    /// The largest difference of the two meshes over 105 points, down to a thousandth of the edge from a corner: an upper
    /// estimate of the finer one's error, per unit of the ceiling's exitance.
    pub fn error_bound(&self) -> f64 {
        self.error_bound
    }

    fn on_mesh(&self, mesh: usize, face: Face, x: f64, y: f64) -> f64 {
        let [even, odd] =
            [0, 1].map(|p| self.cube.parts[mesh][p].at(self.reflectance, &self.values[mesh][p], face, x, y));
        let lower = face == Face::Floor || face == Face::Wall && y < 0.5;
        if lower { even - odd } else { even + odd }
    }
}

/// Light with one parity: on floor and lower walls it is `sign` times that on ceiling and upper walls.
struct Part {
    operator: Operator,
    sign: f64,
    rows: Vec<Vec<f64>>,
    direct: Vec<f64>,
}

impl Part {
    fn new(mesh: Mesh, sign: f64) -> Self {
        let mut part = Part { operator: Operator::new(mesh), sign, rows: Vec::new(), direct: Vec::new() };
        let s = part.operator.mesh().s.clone();
        let ceiling: Vec<[f64; 2]> = part.operator.points().collect();
        let walls = s.iter().flat_map(|&z| s.iter().map(move |&x| [x, z]));
        part.direct = ceiling.iter().map(|&p| part.direct_ceiling(p)).collect();
        let on_walls: Vec<f64> = walls.clone().map(|p| part.direct_wall(p)).collect();
        part.direct.extend(on_walls);
        part.rows = ceiling.iter().map(|&p| part.ceiling_row(p)).collect();
        part.rows.extend(walls.map(|p| part.wall_row(p)).collect::<Vec<_>>());
        part
    }

    /// Weights of all unknowns, first the ceiling's, then the wall's, in the irradiance of the ceiling at distances `s`
    /// (half-edges) from its edges.
    fn ceiling_row(&self, s: [f64; 2]) -> Vec<f64> {
        let n = self.operator.mesh().len();
        let (mut cap, mut wall) = (vec![0.0; n * n], vec![0.0; n * n]);
        self.operator.add_opposite(s, 1.0, &mut cap);
        cap.iter_mut().for_each(|x| *x *= self.sign);
        let mirror = Mirror { across: self.sign, along: 1.0 };
        for [across, along] in [s, [s[1], s[0]]] {
            self.operator.add_neighbour(across, along, mirror, &mut wall);
            self.operator.add_neighbour(2.0 - across, along, mirror, &mut wall);
        }
        [self.operator.fold(&cap), wall].concat()
    }

    /// The same for a wall at the distances `[x, z]` from the nearer upright edge and from the ceiling, `z <= 1`.
    fn wall_row(&self, [x, z]: [f64; 2]) -> Vec<f64> {
        let n = self.operator.mesh().len();
        let (mut cap, mut floor) = (vec![0.0; n * n], vec![0.0; n * n]);
        self.operator.add_neighbour(z, x, EVEN, &mut cap);
        self.operator.add_neighbour(2.0 - z, x, EVEN, &mut floor);
        cap.iter_mut().zip(&floor).for_each(|(c, f)| *c += self.sign * f);
        // Of the other walls the rows of weights run over x; the unknowns are stored with z first.
        let mut wall = vec![0.0; n * n];
        self.operator.add_opposite([x, z], self.sign, &mut wall);
        let mirror = Mirror { across: 1.0, along: self.sign };
        self.operator.add_neighbour(x, z, mirror, &mut wall);
        self.operator.add_neighbour(2.0 - x, z, mirror, &mut wall);
        let turned = (0..n * n).map(|k| wall[k % n * n + k / n]);
        self.operator.fold(&cap).into_iter().chain(turned).collect()
    }

    /// Half of what a ceiling of exitance 1 gives, and half of `sign` times what such a floor gives.
    fn direct_ceiling(&self, [a, b]: [f64; 2]) -> f64 {
        let ends = |s: f64| [s, 2.0 - s];
        let corners = ends(a).into_iter().flat_map(|u| ends(b).map(|v| parallel(u, v)));
        0.5 * self.sign * corners.sum::<f64>()
    }

    fn direct_wall(&self, [x, z]: [f64; 2]) -> f64 {
        let from = |c: f64| upright(x, c) + upright(2.0 - x, c);
        0.5 * (from(z) + self.sign * from(2.0 - z))
    }

    /// Iterates `E = E_direct + rho K E`, with the uniform mode of even light removed exactly from each residual.
    fn solve(&self, rho: f64) -> Vec<f64> {
        let mut irradiance = self.direct.clone();
        for _ in 0..200 {
            let residual: Vec<f64> = (0..irradiance.len())
                .map(|i| self.direct[i] - irradiance[i] + rho * dot(&self.rows[i], &irradiance))
                .collect();
            let [cap, wall] = self.means(&residual);
            let uniform = if self.sign > 0.0 { rho / (1.0 - rho) * (cap + 2.0 * wall) / 3.0 } else { 0.0 };
            irradiance.iter_mut().zip(&residual).for_each(|(e, r)| *e += r + uniform);
            if residual.iter().all(|r| r.abs() < 1e-13) {
                break;
            }
        }
        irradiance
    }

    /// Means over ceiling and upper wall.
    fn means(&self, values: &[f64]) -> [f64; 2] {
        let (shares, weight) = (self.operator.shares(), &self.operator.mesh().weight);
        let n = weight.len();
        let (cap, wall) = values.split_at(shares.len());
        let wall = wall.iter().enumerate().map(|(k, x)| x * weight[k / n] * weight[k % n]);
        [dot(&shares, cap), wall.sum()]
    }

    /// This part's irradiance on the face's upper counterpart.
    fn at(&self, rho: f64, values: &[f64], face: Face, x: f64, y: f64) -> f64 {
        let edge = |t: f64| (2.0 * t.min(1.0 - t)).max(AT_EDGE);
        let s = [edge(x), edge(y)];
        match face {
            Face::Wall => self.direct_wall(s) + rho * dot(&self.wall_row(s), values),
            _ => self.direct_ceiling(s) + rho * dot(&self.ceiling_row(s), values),
        }
    }
}

/// Share of a rectangle `u` by `v` at distance 2 (the opposite face, in half-edges), seen from below its corner.
fn parallel(u: f64, v: f64) -> f64 {
    let [a, b] = [u, v].map(|x| 0.5 * x);
    let (sa, sb) = (1f64.hypot(a), 1f64.hypot(b));
    (a / sa * (b / sa).atan() + b / sb * (a / sb).atan()) / (2.0 * PI)
}

/// Share of a rectangle `u` wide and 2 deep that starts at the edge shared with the wall, `c` away from the point.
fn upright(u: f64, c: f64) -> f64 {
    let far = c.hypot(2.0);
    ((u / c).atan() - c / far * (u / far).atan()) / (2.0 * PI)
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}
