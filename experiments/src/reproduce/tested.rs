//! Progressive radii at one point, kept or shrunk by a test of the photons, or shrunk by a schedule.

use std::f64::consts::TAU;

use photonlab_measure::chi_square_test;
use photonlab_readout::SHRINK;
use photonlab_sampling::Stream;

use super::field::poisson;

/// Photons that a pass sends into the first disc, on average, where the irradiance is 1.
pub(super) const PHOTONS: f64 = 50.0;
/// Equal parts of the disc: quadrants of an inner disc and of a ring.
const PARTS: usize = 8;
/// Passes before the first look at counts.
const FIRST_LOOK: u32 = 8;
/// What a failed test leaves of a radius.
const LEFT: f64 = 0.8;

/// The irradiance around the point, where it is 1; lengths in first radii.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Light {
    Even,
    Slope,
    Bend,
    Edge,
}

impl Light {
    pub(super) const ALL: [Light; 4] = [Light::Even, Light::Slope, Light::Bend, Light::Edge];

    pub(super) fn title(self) -> &'static str {
        match self {
            Light::Even => "even light",
            Light::Slope => "a slope",
            Light::Bend => "a bend",
            Light::Edge => "half a first radius beside an edge",
        }
    }

    fn at(self, x: f64, y: f64) -> f64 {
        match self {
            Light::Even => 1.0,
            Light::Slope => 1.0 + 0.5 * x,
            Light::Bend => 1.0 + 0.5 * (x * x + y * y),
            Light::Edge => {
                if x < 0.5 {
                    1.0
                } else {
                    0.2
                }
            }
        }
    }

    /// The largest in the first disc.
    fn most(self) -> f64 {
        match self {
            Light::Even | Light::Edge => 1.0,
            Light::Slope | Light::Bend => 1.5,
        }
    }
}

/// How radii go from pass to pass.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Rule {
    /// As pass^(-SHRINK): this program's own.
    Shrinking,
    /// Kept until a chi-squared test of this level finds the light uneven (after Lin et al., "CPPM: chi-squared progressive photon
    /// mapping", 2020).
    Tested { level: f64 },
}

/// Counts in the parts of the disc since the radius last changed.
#[derive(Default)]
struct Counts {
    parts: [u64; PARTS],
    passes: u32,
}

/// The squared errors of the mean after several numbers of passes, ascending, and the last radius.
pub(super) fn squared_errors(light: Light, rule: Rule, passes: &[u32], stream: &mut Stream) -> Vec<f64> {
    let (mut radius, mut sum, mut counts, mut errors) = (1.0, 0.0, Counts::default(), Vec::new());
    for pass in 1..=passes.last().copied().unwrap_or(0) {
        if rule == Rule::Shrinking {
            radius = f64::from(pass).powf(-SHRINK);
        }
        let found = counts.add_pass(light, radius, stream);
        sum += found as f64 / (PHOTONS * radius * radius);
        if let Rule::Tested { level } = rule
            && counts.refute(level)
        {
            (radius, counts) = (LEFT * radius, Counts::default());
        }
        if passes.contains(&pass) {
            errors.push((sum / f64::from(pass) - 1.0).powi(2));
        }
    }
    errors.push(radius);
    errors
}

impl Counts {
    /// Independent photons of one pass in the disc; how many there are.
    fn add_pass(&mut self, light: Light, radius: f64, stream: &mut Stream) -> u64 {
        let mut found = 0;
        for _ in 0..poisson(PHOTONS * light.most() * radius * radius, stream) {
            let [share, turn] = stream.next2();
            let (across, azimuth) = (radius * share.sqrt(), TAU * turn);
            if stream.next() * light.most() < light.at(across * azimuth.cos(), across * azimuth.sin()) {
                let part = 4 * usize::from(share >= 0.5) + (4.0 * turn) as usize % 4;
                self.parts[part] += 1;
                found += 1;
            }
        }
        self.passes += 1;
        found
    }

    /// True if it is time for a look and the counts are uneven.
    fn refute(&self, level: f64) -> bool {
        let looks = self.passes >= FIRST_LOOK
            && (self.passes / FIRST_LOOK).is_power_of_two()
            && self.passes.is_multiple_of(FIRST_LOOK);
        let even = [self.parts.iter().sum::<u64>() as f64 / PARTS as f64; PARTS];
        looks && chi_square_test(&self.parts, &even).is_ok_and(|test| test.p_value < level)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reproduce::field::stream;

    #[test]
    fn even_light_keeps_its_radius_and_an_edge_does_not() {
        let last = |light, number| {
            let rule = Rule::Tested { level: 0.001 };
            squared_errors(light, rule, &[256], &mut stream(1, number)).last().copied().expect("a radius")
        };
        let kept = (0..50).filter(|&number| last(Light::Even, number) == 1.0).count();
        assert!(kept >= 45, "{kept}");
        assert!((0..50).all(|number| last(Light::Edge, number) < 0.75));
    }
}
