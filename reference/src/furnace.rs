//! The furnace: a closed cavity whose walls all emit and reflect alike.
//!
//! In a closed cavity of any shape every point sees walls in every direction, so with emission `L_e` and reflectance
//! `rho` everywhere the radiance `L = L_e + rho L` is the same everywhere: `L = L_e / (1 - rho)`, `E = pi L`. (Textbook;
//! catalogue entry D2.) Exact. Whatever differs from it near an edge or a corner is bias of the estimator.

use std::f64::consts::PI;

use photonlab_photometry::Colour;

use crate::catalogue::{Case, Draft, Reads};
use crate::mitsuba;
use crate::out_of_range::{OutOfRange, require_albedo, require_positive};

/// A closed cavity of any shape, all of whose walls emit the same radiance and reflect the same share, in `C` channels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Furnace<const C: usize> {
    radiance: Colour<C>,
    reflectance: Colour<C>,
}

impl<const C: usize> Furnace<C> {
    /// Walls that emit `radiance` (W/(m^2 sr) or cd/m^2) and have a `reflectance` in `[0, 1)`.
    pub fn new(radiance: Colour<C>, reflectance: Colour<C>) -> Result<Self, OutOfRange> {
        radiance.0.into_iter().try_for_each(|x| require_positive("radiance", x))?;
        reflectance.0.into_iter().try_for_each(|x| require_albedo("reflectance", x))?;
        Ok(Furnace { radiance, reflectance })
    }

    /// The emitted exitance `M = pi L_e`, in W/m^2 or lm/m^2.
    pub fn exitance(&self) -> Colour<C> {
        self.radiance * PI
    }

    /// Irradiance of every wall: `M / (1 - rho)`, in W/m^2 or lx.
    pub fn irradiance(&self) -> Colour<C> {
        self.exitance() * self.reflectance.map(|rho| 1.0 / (1.0 - rho))
    }

    /// Radiance in every direction at every point: `L_e / (1 - rho)`.
    pub fn total_radiance(&self) -> Colour<C> {
        self.irradiance() * (1.0 / PI)
    }

    /// Irradiance by light that was reflected exactly `n` times since its emission: `M rho^n`.
    pub fn bounce(&self, n: u32) -> Colour<C> {
        self.exitance() * self.reflectance.map(|rho| rho.powi(n as i32))
    }

    /// A cubical furnace as Mitsuba 3 XML, with a radiance meter in the middle looking at each `(u, v)` (half-edges from
    /// its centre) of the face +x.
    pub fn cube_xml(&self, half_edge: f64, meters: &[[f64; 2]]) -> String {
        let wall = mitsuba::diffuse(&self.reflectance.0) + &mitsuba::area_lamp(&self.radiance.0);
        let mut body = mitsuba::inside_cube("furnace", half_edge, &wall);
        for (i, [u, v]) in meters.iter().enumerate() {
            let target = [half_edge, u * half_edge, v * half_edge];
            body += &mitsuba::radiance_meter(&format!("meter-{i}"), [0.0; 3], target);
        }
        mitsuba::scene(&body)
    }
}

/// The catalogue's D2 with an exitance of 1: a sphere that reads its own irradiance, and a cube looked at from its centre
/// towards the middle of a face, an edge and a corner. Then both once more in colour.
pub fn cases() -> Vec<Case> {
    let grey = |rho: f64| Furnace { radiance: Colour([1.0 / PI]), reflectance: Colour([rho]) };
    let mut cases: Vec<Case> =
        [0.0, 0.2, 0.5, 0.8, 0.9].iter().flat_map(|&rho| grey(rho).both(&format!("reflectance {rho}"))).collect();
    let coloured = Furnace { radiance: Colour([1.0, 2.0, 0.5]), reflectance: Colour([0.1, 0.5, 0.9]) };
    cases.extend(coloured.both("three channels"));
    cases
}

impl<const C: usize> Furnace<C> {
    fn both(&self, name: &str) -> [Case; 2] {
        let wall = mitsuba::diffuse(&self.reflectance.0) + &mitsuba::area_lamp(&self.radiance.0);
        let on_sphere = wall.clone() + &mitsuba::irradiance_meter("wall");
        let mut sphere = Draft::with(mitsuba::sphere("furnace", [0.0; 3], 1.0, true, &on_sphere));
        let precision = 1e-12 * self.irradiance().max();
        sphere.expect("wall", Reads::Irradiance, &self.irradiance().0, precision);
        let mut cube = Draft::with(mitsuba::inside_cube("furnace", 0.5, &wall));
        for [u, v] in [[0.0, 0.0], [0.999, 0.0], [0.999, 0.999]] {
            cube.radiance([0.0; 3], [0.5, 0.5 * u, 0.5 * v], &self.total_radiance().0, precision);
        }
        [sphere.case(format!("sphere, {name}")), cube.case(format!("cube, {name}"))]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::{Moments, Random};

    fn furnace() -> Furnace<3> {
        Furnace::new(Colour([1.0, 2.0, 0.5]), Colour([0.0, 0.5, 0.9])).expect("valid")
    }

    #[test]
    fn bounces_sum_to_the_total() {
        let f = furnace();
        for c in 0..3 {
            let sum: f64 = (0..400).map(|n| f.bounce(n)[c]).sum();
            assert!((sum / f.irradiance()[c] - 1.0).abs() < 1e-13);
        }
        assert_eq!(f.irradiance().0.map(|e| e / PI), [1.0, 4.0, 5.000000000000001]);
    }

    /// Random paths in a room that is not a cube, absorbed with probability `1 - rho`: each meets `1 / (1 - rho)` walls.
    /// That is blind to shape; the room's own mean is checked by where the paths start and end instead: flux that leaves
    /// uniformly arrives uniformly. 3 comparisons at 4.5 standard errors.
    #[test]
    fn a_uniform_exitance_arrives_uniformly_in_an_oblong_room() {
        let size = [1.0, 2.0, 5.0];
        let area = |axis: usize| size[(axis + 1) % 3] * size[(axis + 2) % 3];
        let total: f64 = (0..3).map(area).sum();
        let mut random = Random::new(3);
        let mut arrived: [Moments; 3] = Default::default();
        for _ in 0..300_000 {
            let pick = random.unit() * total;
            let from = if pick < area(0) {
                0
            } else if pick < area(0) + area(1) {
                1
            } else {
                2
            };
            let mut p = size.map(|x| random.unit() * x);
            p[from] = 0.0;
            let mut normal = [0.0; 3];
            normal[from] = 1.0;
            let d = random.cosine_around(normal);
            let distance = |i: usize| {
                if d[i] > 0.0 { (size[i] - p[i]) / d[i] } else { -p[i] / d[i] }
            };
            let to = (0..3).filter(|&i| i != from || d[i] > 0.0);
            let to = to.min_by(|&i, &j| distance(i).total_cmp(&distance(j))).expect("closed");
            (0..3).for_each(|i| arrived[i].add(f64::from(i == to)));
        }
        for axis in 0..3 {
            arrived[axis].must_agree("share of the walls across an axis", area(axis) / total);
        }
    }

    #[test]
    fn the_scene_file_carries_the_parameters() {
        let xml = furnace().cube_xml(0.5, &[[0.0, 0.0], [0.5, 0.9]]);
        mitsuba::assert_balanced(&xml);
        assert!(xml.contains("0, 0.5, 0.9") && xml.contains("1, 2, 0.5"), "{xml}");
        assert!(xml.contains("target=\"0.5 0.25 0.45\""), "{xml}");
    }
}
