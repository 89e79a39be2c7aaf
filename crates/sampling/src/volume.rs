//! What a medium does to light, in the channels in which it is followed.

use photonlab_photometry::{Colour, Palette};
use photonlab_scene::{Medium, Phase};

use crate::Stream;

/// A homogeneous medium.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Volume<const C: usize> {
    /// Extinction coefficient, 1/m.
    pub sigma_t: Colour<C>,
    /// Share of what is extinguished that is scattered.
    pub albedo: Colour<C>,
    /// How.
    pub phase: Phase,
}

/// How far light flies in a medium.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Flight<const C: usize> {
    /// Metres to where it meets the medium's matter; `None` if it passes.
    pub collision: Option<f64>,
    /// A factor of mean one, which makes up for drawing the distance for one channel alone.
    pub factor: Colour<C>,
}

impl<const C: usize> Volume<C> {
    /// From its description.
    pub fn new(medium: &Medium, palette: &Palette<C>) -> Self {
        Self { sigma_t: palette.colour(&medium.sigma_t), albedo: palette.colour(&medium.albedo), phase: medium.phase }
    }

    /// Share of light that passes a distance in metres: the paper's tau between an observer and a point.
    pub fn transmittance(&self, distance: f64) -> Colour<C> {
        self.sigma_t.map(|sigma| if sigma == 0.0 { 1.0 } else { (-sigma * distance).exp() })
    }

    /// True if any light is scattered, not only absorbed.
    pub fn scatters(&self) -> bool {
        !(self.sigma_t * self.albedo).is_zero()
    }

    /// Metres beyond which next to nothing (2e-9) of any light that is scattered passes.
    pub fn depth(&self) -> f64 {
        let least = self.sigma_t.0.into_iter().filter(|&sigma| sigma > 0.0).fold(f64::INFINITY, f64::min);
        20.0 / least
    }

    /// Density per metre with which [`Volume::fly`] collides at a distance, where nothing is nearer.
    pub fn flight_pdf(&self, carried: Colour<C>, distance: f64) -> f64 {
        let total: f64 = carried.0.into_iter().sum();
        (self.transmittance(distance) * self.sigma_t * carried).0.into_iter().sum::<f64>() / total
    }

    /// Share of flights drawn by [`Volume::fly`] that do not collide up to a distance.
    pub fn share_that_flies(&self, carried: Colour<C>, distance: f64) -> f64 {
        let total: f64 = carried.0.into_iter().sum();
        (self.transmittance(distance) * carried).0.into_iter().sum::<f64>() / total
    }

    /// Draws how far light flies of which each channel carries some: by the extinction of a channel that is drawn by what it
    /// carries, weighted against those by which the others would have drawn the same (the balance heuristic).
    pub fn fly(&self, carried: Colour<C>, reach: f64, stream: &mut Stream) -> Flight<C> {
        let total: f64 = carried.0.into_iter().sum();
        if total <= 0.0 {
            return Flight { collision: None, factor: Colour::ZERO };
        }
        let channel = if C == 1 { 0 } else { choose(carried, stream.next() * total) };
        let distance = -(1.0 - stream.next()).ln() / self.sigma_t[channel];
        let collision = (distance < reach).then_some(distance);
        if C == 1 {
            return Flight { collision, factor: Colour::ONE };
        }
        let density = match collision {
            Some(distance) => self.transmittance(distance) * self.sigma_t,
            None => self.transmittance(reach),
        };
        let mixture: f64 = (density * carried).0.into_iter().sum::<f64>() / total;
        Flight { collision, factor: density * (1.0 / mixture) }
    }
}

/// The channel in which a share of what is carried lies.
fn choose<const C: usize>(carried: Colour<C>, mut rest: f64) -> usize {
    let mut chosen = 0;
    for (channel, light) in carried.0.into_iter().enumerate().filter(|(_, light)| *light > 0.0) {
        chosen = channel;
        rest -= light;
        if rest < 0.0 {
            break;
        }
    }
    chosen
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Purpose;

    /// The mean factor of what passes is the transmittance, and of what collides the rest (catalogue F1). 12 comparisons at
    /// |z| < 5.
    #[test]
    fn what_passes_is_the_transmittance() {
        let volume = Volume { sigma_t: Colour([0.0, 0.7, 5.0]), albedo: Colour::ONE, phase: Phase::Isotropic };
        for carried in [Colour([1.0, 1.0, 1.0]), Colour([0.1, 2.0, 0.5])] {
            let mut stream = Stream::new(43, Purpose::Synthetic, 0, 0);
            let n = 400_000;
            let (mut passed, mut squares) = (Colour::<3>::ZERO, Colour::<3>::ZERO);
            for _ in 0..n {
                let Flight { collision, factor } = volume.fly(carried, 0.6, &mut stream);
                if collision.is_none() {
                    passed += factor;
                    squares += factor * factor;
                }
            }
            let expected = volume.transmittance(0.6);
            for c in 0..3 {
                let mean = passed[c] / f64::from(n);
                let error = ((squares[c] / f64::from(n) - mean * mean).max(0.0) / f64::from(n)).sqrt();
                assert!((mean - expected[c]).abs() < 5.0 * error + 1e-12, "{c}: {mean} for {}", expected[c]);
            }
        }
    }
}
