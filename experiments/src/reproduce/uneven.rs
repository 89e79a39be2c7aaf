//! Photon fields of uneven density, read at one point.

use std::f64::consts::PI;

use photonlab_gather::{AreaModel, Bandwidth, GatherPoint, PhotonMap, Tests};
use photonlab_kdtree::SplitRule;
use photonlab_measure::Replicates;
use photonlab_reference::{
    edge_laws::half_plane,
    fixed_radius_law::poisson_variance,
    nearest_law::{Counted, RelativeMoments, in_field},
};
use photonlab_sampling::Stream;

use super::{field::Field, field::poisson, trials::Trials};

/// How the density changes around the query at the origin of the plane z = 0.
#[derive(Clone, Copy, Debug)]
pub(super) enum Shape {
    /// Not at all.
    Flat,
    /// As exp(slope x); in 1/m, not 0.
    Ramp { slope: f64 },
    /// To `ratio` times the query's, beyond a straight line at this distance in metres.
    Step { distance: f64, ratio: f64 },
}

/// A Poisson field of photons of equal flux, with irradiance 1 at the query.
#[derive(Clone, Copy, Debug)]
pub(super) struct Uneven {
    /// Photons per square metre at the query.
    pub(super) density: f64,
    pub(super) shape: Shape,
}

/// Repeated estimates at the query.
#[derive(Clone, Debug)]
pub(super) struct Reading {
    /// Mean and variance relative to the irradiance at the query, as the laws have it.
    pub(super) law: RelativeMoments,
    /// The estimate over the irradiance.
    pub(super) mean: Replicates,
    /// Squared deviation from the law's mean over the square of that mean: the square of the relative noise.
    pub(super) square: Replicates,
}

impl Uneven {
    /// Reads independent fields.
    pub(super) fn read(&self, bandwidth: Bandwidth, trials: &Trials) -> anyhow::Result<Reading> {
        let at = GatherPoint { position: [0.0; 3], normal: [0.0, 0.0, 1.0] };
        let (law, half) = (self.law(bandwidth), self.half(bandwidth));
        let columns = trials.run(|stream, scratch| {
            let field = self.field(half, stream);
            let map = PhotonMap::build(field.positions, field.photons, SplitRule::Median)?;
            let value = map.gather(&at, bandwidth, AreaModel::Disc, &Tests::default(), scratch).irradiance[0];
            Ok(vec![value, (value / law.mean - 1.0).powi(2)])
        })?;
        let column = |index: usize| columns.get(index).copied().unwrap_or_default();
        Ok(Reading { law, mean: column(0), square: column(1) })
    }

    /// Photons expected within `radius`.
    pub(super) fn expected(&self, radius: f64) -> f64 {
        let flat = self.density * PI * radius * radius;
        flat * match self.shape {
            Shape::Flat => 1.0,
            Shape::Ramp { slope } => exponential_mean(slope * radius),
            Shape::Step { distance, ratio } => {
                let own = half_plane(distance / radius);
                own + ratio * (1.0 - own)
            }
        }
    }

    /// Mean and variance of the estimate relative to the irradiance at the query.
    pub(super) fn law(&self, bandwidth: Bandwidth) -> RelativeMoments {
        match bandwidth {
            Bandwidth::Radius(radius) => {
                let expected = self.expected(radius);
                let mean = expected / (self.density * PI * radius * radius);
                RelativeMoments { mean, variance: poisson_variance(expected) * mean * mean }
            }
            Bandwidth::Nearest { k, .. } => {
                let kink = match self.shape {
                    Shape::Step { distance, .. } => self.density * PI * distance * distance,
                    Shape::Flat | Shape::Ramp { .. } => 0.0,
                };
                let expected = |x: f64| self.expected((x / (PI * self.density)).sqrt());
                in_field(k as u32, Counted::AllButLast, expected, &[kink])
            }
        }
    }

    /// Half the side of a square that holds all that the search can find (the k nearest but once in 10^12 fields).
    pub(super) fn half(&self, bandwidth: Bandwidth) -> f64 {
        match bandwidth {
            Bandwidth::Radius(radius) => 1.01 * radius,
            Bandwidth::Nearest { k, .. } => {
                let certain = k as f64 + 8.0 * (k as f64).sqrt() + 30.0;
                let mut half = (k as f64 / (PI * self.density)).sqrt();
                while self.expected(half) < certain {
                    half *= 1.05;
                }
                half
            }
        }
    }

    /// Photons on a square of this half side around the query.
    pub(super) fn field(&self, half: f64, stream: &mut Stream) -> Field {
        match self.shape {
            Shape::Flat => Field::uniform(self.density, [-half; 2], [half; 2], stream),
            Shape::Ramp { slope } => self.ramp(slope, half, stream),
            Shape::Step { distance, ratio } => {
                let edge = distance.min(half);
                let mut field = Field::uniform(self.density, [-edge, -half], [half, half], stream);
                let beyond = Field::uniform(self.density * ratio, [-half, -half], [-edge, half], stream);
                for position in beyond.positions {
                    field.push(position.map(f64::from), [0.0, 0.0, 1.0], 1.0 / self.density);
                }
                field
            }
        }
    }

    fn ramp(&self, slope: f64, half: f64, stream: &mut Stream) -> Field {
        let (low, high) = ((-slope * half).exp(), (slope * half).exp());
        let count = poisson(self.density * 2.0 * half * (high - low) / slope, stream);
        let mut field = Field::default();
        for _ in 0..count {
            let [u, v] = stream.next2();
            let x = (low + u * (high - low)).ln() / slope;
            field.push([x, (2.0 * v - 1.0) * half, 0.0], [0.0, 0.0, 1.0], 1.0 / self.density);
        }
        field
    }
}

/// Mean of exp(s x) over the unit disc: 2 I_1(s) / s with the modified Bessel function, by its series.
fn exponential_mean(s: f64) -> f64 {
    let square = 0.25 * s * s;
    let (mut sum, mut term, mut m) = (0.0, 1.0, 0.0);
    while term > 1e-17 * sum {
        sum += term;
        m += 1.0;
        term *= square / (m * (m + 1.0));
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 2 I_1(1) = 1.13031820798497, 2 I_1(3) / 3 = 2.63558043876.
    #[test]
    fn the_mean_over_the_disc_is_a_bessel_function() {
        assert!((exponential_mean(1.0) - 1.13031820798497).abs() < 1e-13);
        assert!((exponential_mean(3.0) - 7.906_741_3 / 3.0).abs() < 1e-6, "{}", 3.0 * exponential_mean(3.0));
        assert_eq!(exponential_mean(0.0), 1.0);
    }
}
