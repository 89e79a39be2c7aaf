//! A closed room with walls of one reflectance: the mean irradiance.
//!
//! The walls absorb what the lamp sends: `Phi = (1 - rho) S E`, with `S` the area and `E` the mean irradiance of all
//! walls, whatever the room's shape and wherever the lamp. The reflected part is `E - Phi / S = Phi rho / (S (1 - rho))`.
//! In a cube with the lamp in its centre each face has the same mean. (Energy; catalogue entry I2.) Exact for the mean;
//! at single points the irradiance differs.

use crate::catalogue::{Case, Draft, Reads};
use crate::mitsuba::{self, Place};
use crate::out_of_range::{OutOfRange, require_albedo, require_positive};

/// A room with an isotropic point lamp.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClosedRoom {
    area: f64,
    flux: f64,
    reflectance: f64,
}

impl ClosedRoom {
    /// A room of total wall `area` (m^2), lamp `flux` (W or lm) and diffuse `reflectance`.
    pub fn new(area: f64, flux: f64, reflectance: f64) -> Result<Self, OutOfRange> {
        require_positive("area", area)?;
        require_positive("flux", flux)?;
        require_albedo("reflectance", reflectance)?;
        Ok(ClosedRoom { area, flux, reflectance })
    }

    /// Mean irradiance of all walls, in W/m^2 or lx.
    pub fn mean_irradiance(&self) -> f64 {
        self.flux / (self.area * (1.0 - self.reflectance))
    }

    /// Its reflected part.
    pub fn mean_indirect(&self) -> f64 {
        self.mean_irradiance() * self.reflectance
    }

    /// The room as a cube with the lamp in its centre, and a meter on each of its six faces.
    pub fn cube_case(&self) -> Case {
        let half = 0.5 * (self.area / 6.0).sqrt();
        let intensity = self.flux / (4.0 * std::f64::consts::PI);
        let mut draft = Draft::with(mitsuba::point_lamp([0.0; 3], &[intensity]));
        let value = self.mean_irradiance();
        for place in Place::inside_box([-half; 3], [half; 3]) {
            let wall = mitsuba::diffuse(&[self.reflectance]);
            draft.metered(Reads::Irradiance, place, &wall, value, 1e-12 * value);
        }
        draft.case(format!("reflectance {}", self.reflectance))
    }
}

/// The catalogue's I2: edge 4 m, 10 000 lm.
pub fn cases() -> Vec<Case> {
    [0.0, 0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95]
        .map(|reflectance| ClosedRoom { area: 96.0, flux: 10_000.0, reflectance }.cube_case())
        .to_vec()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cube::Cube;
    use crate::random::{Moments, Random};

    #[test]
    fn catalogue_values() {
        for (rho, want) in [(0.0, 0.0), (0.05, 5.4824561), (0.5, 104.16667), (0.9, 937.5), (0.95, 1979.1667)] {
            let got = ClosedRoom::new(96.0, 1e4, rho).expect("valid").mean_indirect();
            assert!((got - want).abs() < 1e-4, "{rho}: {got}");
        }
    }

    /// The radiosity solution of the cube does not know about energy.
    #[test]
    fn the_solved_cube_has_this_mean() {
        let cube = Cube::new(2.0, 1e4 / (4.0 * std::f64::consts::PI), 0.7).expect("valid");
        let room = ClosedRoom::new(96.0, 1e4, 0.7).expect("valid");
        assert!((cube.solve().mean() / room.mean_irradiance() - 1.0).abs() < 1e-6);
    }

    /// Random paths in an oblong room with the lamp in a corner: 2 comparisons at 4.5 standard errors.
    #[test]
    fn random_paths_in_another_room_agree() {
        let (mut random, size, rho) = (Random::new(5), [1.0, 2.0, 5.0], 0.5);
        let room = ClosedRoom::new(34.0, 1.0, rho).expect("valid");
        let (mut total, mut indirect) = (Moments::default(), Moments::default());
        for _ in 0..100_000 {
            let (mut p, mut d, mut hits) = ([0.2, 0.3, 0.1], random.direction(), 0.0);
            loop {
                let distance = |i: usize| if d[i] > 0.0 { (size[i] - p[i]) / d[i] } else { -p[i] / d[i] };
                let axis = (0..3).min_by(|&i, &j| distance(i).total_cmp(&distance(j))).expect("three axes");
                let t = distance(axis);
                p = [0, 1, 2].map(|i| (p[i] + t * d[i]).clamp(0.0, size[i]));
                p[axis] = if d[axis] > 0.0 { size[axis] } else { 0.0 };
                hits += 1.0;
                if random.unit() > rho {
                    break;
                }
                let mut normal = [0.0; 3];
                normal[axis] = -d[axis].signum();
                d = random.cosine_around(normal);
                // Rounding must not send the path back through the wall it starts from.
                d[axis] = d[axis].abs().max(1e-12) * normal[axis];
            }
            total.add(hits / 34.0);
            indirect.add((hits - 1.0) / 34.0);
        }
        total.must_agree("mean irradiance", room.mean_irradiance());
        indirect.must_agree("reflected part", room.mean_indirect());
    }
}
