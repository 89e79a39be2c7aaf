//! Final gather in an integrating sphere: how its variance falls with the rays, down to what the photons leave.
//!
//! A lamp in the centre of a diffuse sphere of 1 m and reflectance `rho` sends `N` independent photons of equal flux, which end at each hit with
//! the probability `1 - rho`. All hits are even over the wall and independent, and each photon has a geometric number of them,
//! so that with `n` rays that gather within a radius `r`:
//!
//! - a photon's hits have the mean `1 / (1 - rho)` and the variance `rho / (1 - rho)^2`: all of them together, which is what infinitely
//!   many rays find, have the relative variance `rho / N`;
//! - a ball holds the share `q = r^2 / 4` of the wall: one estimate with a kernel of variance factor `c` has the relative variance
//!   `(c / q - 1) (1 - rho) / N + rho / N`.
//!
//! A ray that lands within `2 r`, which the share `p = r^2` does, goes on by a further bounce instead, with its direct light known.
//! Two rays that find the same photons have what infinitely many find in common, so that the variance is `plateau + rest / n`.
//! Irradiance is in units of the direct one, 1, so that the whole is `1 / (1 - rho)`. (Derived here; the even hits are catalogue entry D1's.)

/// A sphere, its photons and how they are gathered.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GatheredSphere {
    /// In (0, 1).
    pub reflectance: f64,
    /// Emitted, independent.
    pub photons: f64,
    /// Of gathering, m, below 1.
    pub radius: f64,
    /// Mean of the squared weight of the kernel over its ball, 1 for a disc.
    pub variance_factor: f64,
}

impl GatheredSphere {
    /// Irradiance of the wall.
    pub fn irradiance(&self) -> f64 {
        1.0 / (1.0 - self.reflectance)
    }

    /// The variance of the irradiance that infinitely many rays read, exactly.
    pub fn plateau(&self) -> f64 {
        let Self { reflectance: rho, photons, .. } = *self;
        let near = self.near();
        // The mean of all rays is v = (1 - p) s + p (1 + rho v) for the photons' own s.
        let of_photons = (1.0 - near) / (1.0 - near * rho);
        (rho * of_photons * self.irradiance()).powi(2) * rho / photons
    }

    /// The variance of the irradiance that `rays` rays read, exactly.
    pub fn variance(&self, rays: f64) -> f64 {
        self.plateau() + (self.of_one_ray() - self.plateau()) / rays
    }

    fn of_one_ray(&self) -> f64 {
        let Self { reflectance: rho, photons, radius, variance_factor } = *self;
        let (near, whole) = (self.near(), self.irradiance());
        let share = 0.25 * radius * radius;
        let relative = ((variance_factor / share - 1.0) * (1.0 - rho) + rho) / photons;
        let of_estimate = whole * whole * (1.0 + relative);
        // The second moment m of what a ray finds: m = (1 - p) E[L^2] + p E[(1 + rho X)^2].
        let known = 1.0 + 2.0 * rho * whole;
        let second = ((1.0 - near) * of_estimate + near * known) / (1.0 - near * rho * rho);
        rho * rho * (second - whole * whole)
    }

    /// Share of rays that land too near to gather.
    fn near(&self) -> f64 {
        self.radius * self.radius
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::{Moments, Random};

    /// Photons on a sphere, caps around random points of it, the near ones passed on: mean and variance.
    #[test]
    fn a_simulation_has_this_variance() {
        let law = GatheredSphere { reflectance: 0.6, photons: 200.0, radius: 0.4, variance_factor: 1.0 };
        for rays in [1u32, 10, 300] {
            let (mut mean, mut square) = (Moments::default(), Moments::default());
            let mut random = Random::new(u64::from(rays));
            for _ in 0..if rays > 100 { 4000 } else { 20_000 } {
                let mut hits = Vec::new();
                for _ in 0..law.photons as u32 {
                    hits.push(random.direction());
                    while random.unit() < law.reflectance {
                        hits.push(random.direction());
                    }
                }
                let mut sum = 0.0;
                for _ in 0..rays {
                    let mut weight = law.reflectance;
                    while random.unit() < law.near() {
                        sum += weight;
                        weight *= law.reflectance;
                    }
                    let at = random.direction();
                    let apart = |hit: &[f64; 3]| (0..3).map(|i| (hit[i] - at[i]).powi(2)).sum::<f64>();
                    let found = hits.iter().filter(|hit| apart(hit) <= law.radius * law.radius).count();
                    sum += weight * found as f64 / law.photons / (0.25 * law.radius * law.radius);
                }
                let off = 1.0 + sum / f64::from(rays) - law.irradiance();
                mean.add(off);
                square.add(off * off / law.variance(f64::from(rays)));
            }
            mean.must_agree("mean", 0.0);
            square.must_agree("squared error over the law", 1.0);
            assert!(square.error() < 0.03, "it says something: {}", square.error());
        }
    }
}
