//! Light that is read at the point itself: density estimates, and direct light beside them.

use photonlab_final_gather::{Light, Place, Spot};
use photonlab_gather::{Bandwidth, CHECK, Estimator, Scratch, Tests};
use photonlab_photometry::Colour;
use photonlab_sampling::sample_direct;

use crate::{
    Direct, Method,
    look::{Look, Seed},
};

impl<const C: usize> Look<'_, C> {
    /// The density estimate at the point itself, within `radius` metres or of the nearest photons, of which the bias counts `told` times.
    pub(crate) fn read_map(&self, spot: &Spot<C>, radius: f64, told: f64, scratch: &mut Scratch) -> Light<C> {
        let Some(map) = &self.maps.surface else {
            return Light::default();
        };
        let bandwidth = match self.settings.method {
            Method::Nearest { .. } => Bandwidth::Nearest { k: self.k, max_radius: f64::INFINITY },
            _ => Bandwidth::Radius(radius),
        };
        let tests = Tests {
            max_segments: self.settings.limits.max_segments.map(|max| max.saturating_sub(spot.used)),
            ..Tests::default()
        };
        let place = Place { world: self.world, optics: self.optics, at: &spot.at, sight: &spot.sight };
        let estimator = Estimator { tells_bias: told > 0.0, ..self.settings.estimator };
        let found = place.estimate(map, bandwidth, estimator, &tests, scratch);
        let astray = !found.remedied && self.world.ball_leaves_surface(&spot.at, CHECK * found.radius);
        let unresolved = found.photons > 0 && astray;
        let brightness = found.irradiance.mean();
        let counted = self.settings.estimator.kernel.variance_factor() / (found.photons as f64).max(1.0);
        let noise = brightness * brightness * counted;
        Light {
            irradiance: found.irradiance,
            bias: found.bias * told,
            noise,
            noise_of_bias: noise * self.settings.estimator.area.noise_of_bias(found.remedied),
            // A linear fit may read less than nothing, which is no less uncertain.
            unresolved: if unresolved { found.irradiance.map(f64::abs) } else { Colour::ZERO },
            photons: found.photons as f64,
            reads: 1.0,
            glints: 0.0,
            astray: f64::from(u8::from(astray)),
            remedied: f64::from(u8::from(found.remedied)),
        }
    }

    /// How much the bias counts that a sample tells; zero if it tells none. The mean over all samples is 1.
    pub(crate) fn told(&self, sample: u64) -> f64 {
        if self.told_of == 0 {
            return 0.0;
        }
        let telling = self.samples.div_ceil(self.told_of);
        if sample.is_multiple_of(self.told_of) { self.samples as f64 / telling as f64 } else { 0.0 }
    }

    /// Direct light at a point by rays to lamps, if it is not read from the map.
    pub(crate) fn sampled_direct(&self, spot: &Spot<C>, seed: &Seed<'_>) -> Colour<C> {
        let Spot { at, sight, used } = spot;
        if self.settings.direct != Direct::Sampled || !self.limits().allows(used + 1) {
            return Colour::ZERO;
        }
        let rays = self.settings.rays_per_sample();
        let of_ray = |ray| {
            let mut stream = self.ray_stream(seed, ray);
            let xi = [stream.next(), stream.next(), stream.next()];
            let direct = sample_direct(self.world, self.optics, at, sight, xi)
                .filter(|direct| self.limits().allows(used + 1 + direct.panes));
            direct.map_or(Colour::ZERO, |d| {
                let weight = sight.weight(sight.normals.cosine(d.direction));
                d.irradiance * (weight / (1.0 + seed.share * d.point_factor))
            })
        };
        (0..rays).map(of_ray).fold(Colour::ZERO, |sum, one| sum + one) * (1.0 / f64::from(rays))
    }
}
