//! Which wavelengths are drawn.

use photonlab_photometry::{Palette, Response, Spectrum, VISIBLE, Wavelengths};
use photonlab_scene::{Emitter, EnvironmentLight, Scene};

/// A density of wavelengths: no place that a lamp lights in a way that counts is without.
///
/// Each lamp has an even share of the draws, spread as its emission times the response: what every wavelength carries is then
/// of like strength. Wavelengths that no lamp emits, or that the response does not see, are never drawn.
#[derive(Clone, Debug)]
pub struct WavelengthPlan {
    /// Ends of the intervals, nm, rising.
    ends: Vec<f64>,
    /// Probability before each end.
    before: Vec<f64>,
    response: Response,
}

impl WavelengthPlan {
    /// For the lamps of a scene. `None` if nothing that they emit counts.
    pub fn new(scene: &Scene, response: Response) -> Option<Self> {
        let mut emissions = scene.emissions();
        emissions.retain(|emission| !emission.is_black());
        let daylight = Spectrum::Rgb([1.0; 3]);
        let is_map = |e: &Emitter| matches!(e, Emitter::Environment { light: EnvironmentLight::Map(_), .. });
        if scene.emitters.iter().any(is_map) {
            emissions.push(&daylight);
        }
        let ends = grid(&emissions);
        let mut density = vec![0.0; ends.len().saturating_sub(1)];
        for emission in emissions {
            // The largest of three inside: an interval that is not dark all over has a chance, one that is has none.
            let strength = |pair: &[f64]| {
                let places = [0.1, 0.5, 0.9].map(|share| pair[0] + share * (pair[1] - pair[0]));
                let at = places.map(|nm| emission.emission_at(nm) * response.weight(nm));
                at.into_iter().fold(0.0, f64::max) * (pair[1] - pair[0])
            };
            let strengths: Vec<f64> = ends.windows(2).map(strength).collect();
            let total: f64 = strengths.iter().sum();
            if total > 0.0 {
                density.iter_mut().zip(strengths).for_each(|(sum, own)| *sum += own / total);
            }
        }
        let total: f64 = density.iter().sum();
        let mut before = vec![0.0];
        density.iter().for_each(|share| before.push(before[before.len() - 1] + share / total));
        (total > 0.0).then_some(Self { ends, before, response })
    }

    /// The palette of a pass from one number in [0, 1): in each of `C` / 2 like shares of the probability two wavelengths
    /// that mirror each other (Hickernell's baker's transform of a shifted lattice), so that a spectrum which is straight
    /// within a share is summed without error.
    pub fn draw<const C: usize>(&self, xi: f64) -> Palette<C> {
        let drawn: [(f64, f64); C] = std::array::from_fn(|c| {
            let shifted = (c as f64 + xi) / C as f64;
            self.place(1.0 - (2.0 * shifted - 1.0).abs())
        });
        Palette::Wavelengths(Wavelengths::new(drawn.map(|d| d.0), drawn.map(|d| d.1), self.response))
    }

    /// The wavelength (nm) below which a share of the probability lies, and the density (1/nm) there.
    fn place(&self, share: f64) -> (f64, f64) {
        let last = self.ends.len() - 2;
        let mut index = (self.before.partition_point(|&p| p <= share).max(1) - 1).min(last);
        // Rounding can leave the last draw in an interval without probability.
        while self.before[index + 1] <= self.before[index] && index > 0 {
            index -= 1;
        }
        let (start, end) = (self.ends[index], self.ends[index + 1]);
        let probability = self.before[index + 1] - self.before[index];
        let along = ((share - self.before[index]) / probability).clamp(0.0, 1.0);
        (start + along * (end - start), probability / (end - start))
    }
}

/// Every nanometre that any of the emissions spans, and every bend of theirs.
fn grid(emissions: &[&Spectrum]) -> Vec<f64> {
    let mut ends = VISIBLE.to_vec();
    for emission in emissions {
        let [first, last] = match emission {
            Spectrum::Curve(curve) => {
                ends.extend_from_slice(curve.wavelengths());
                curve.range()
            }
            _ => VISIBLE,
        };
        let (from, to) = (first.ceil() as u32, (last.floor() as u32).min(LONGEST_GRID));
        ends.extend((from..=to).map(f64::from));
        ends.extend([first, last]);
    }
    ends.sort_by(f64::total_cmp);
    ends.dedup();
    ends
}

/// Beyond this many nanometres only the bends of a curve divide it.
const LONGEST_GRID: u32 = 20_000;

#[cfg(test)]
mod tests {
    use super::*;
    use photonlab_photometry::{Curve, PEAK_EFFICACY, daylight, sensitivity};
    use std::sync::Arc;

    fn plan(emission: Spectrum, response: Response) -> WavelengthPlan {
        let intensity = emission;
        let lamp = Emitter::Point {
            id: "p".into(),
            position: glam::DVec3::ZERO,
            intensity,
            pattern: photonlab_scene::Pattern::Isotropic,
            medium: None,
        };
        let scene = Scene {
            shapes: vec![],
            emitters: vec![lamp],
            sensors: vec![],
            max_depth: None,
            hides_lamps: false,
            notes: vec![],
            media: vec![],
        };
        WavelengthPlan::new(&scene, response).unwrap()
    }

    /// By midpoints 0.01 nm apart.
    fn lumens(spectrum: impl Fn(f64) -> f64) -> f64 {
        let at = |i: i32| 360.0 + 0.01 * (f64::from(i) + 0.5);
        (0..47_000).map(|i| 0.01 * PEAK_EFFICACY * sensitivity(at(i)) * spectrum(at(i))).sum()
    }

    /// Even draws of the shift make means of developed emission its integrals; a narrow line is not missed.
    #[test]
    fn draws_weigh_to_integrals() {
        let line = Spectrum::Curve(Arc::new(Curve::new(&[(589.0, 0.0), (589.3, 2.0), (589.6, 0.0)]).unwrap()));
        let band = Spectrum::Curve(Arc::new(Curve::new(&[(300.0, 1.0), (1100.0, 3.0)]).unwrap()));
        let cases = [
            (&line, Response::Radiometric, 0.6),
            (&band, Response::Radiometric, 1600.0),
            (&Spectrum::Uniform(1.0), Response::Photometric, lumens(|_| 1.0)),
            (&Spectrum::Rgb([1.0; 3]), Response::Photometric, lumens(daylight)),
        ];
        for (emission, response, integral) in cases {
            let plan = plan(emission.clone(), response);
            let n = 20_000;
            let mean = (0..n)
                .map(|i| {
                    let palette: Palette<8> = plan.draw((f64::from(i) + 0.5) / f64::from(n));
                    palette.develop(palette.emission(emission))[0] / f64::from(n)
                })
                .sum::<f64>();
            assert!((mean / integral - 1.0).abs() < 2e-5, "{emission:?}: {mean} for {integral}");
        }
    }

    /// Infrared is not drawn where only lumens count.
    #[test]
    fn what_does_not_count_is_not_drawn() {
        let band = Spectrum::Curve(Arc::new(Curve::new(&[(300.0, 1.0), (1100.0, 3.0)]).unwrap()));
        let plan = plan(band, Response::Photometric);
        for i in 0..1000 {
            let Palette::Wavelengths(drawn) = plan.draw::<8>(f64::from(i) / 1000.0) else { unreachable!() };
            assert!(drawn.nm.iter().all(|nm| (360.0..=830.0).contains(nm)), "{:?}", drawn.nm);
        }
    }
}
