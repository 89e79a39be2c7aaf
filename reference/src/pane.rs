//! A window pane: a plane-parallel dielectric sheet with all reflections inside it, incoherent.
//!
//! One interface reflects `R`; a single crossing of the sheet passes `tau`. The series of reflections inside gives
//! `T = (1 - R)^2 tau / (1 - R^2 tau^2)`, without absorption `(1 - R) / (1 + R)`. With `R` the unpolarised mean at each
//! interface this is what a tracer without polarisation converges to; the truth for polarised light is the mean of
//! `T` for both polarisations, which is up to 0.03 higher. (Textbook; catalogue entry E1.) Exact to rounding; the mean over
//! diffuse incidence by quadrature, 1e-10.

use std::f64::consts::PI;

use crate::catalogue::{Case, Draft};
use crate::mitsuba::{self, Place};
use crate::out_of_range::{OutOfRange, require};
use crate::quadrature::Gauss;
use crate::scattering::fresnel;

/// A clear pane in vacuum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pane {
    index: f64,
}

/// What happens to polarisation at an interface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Polarisation {
    /// Forgotten: every interface sees unpolarised light, as renderers without polarisation have it.
    Reset,
    /// Kept, as in nature.
    Kept,
}

impl Pane {
    /// A pane of this refractive index, above 1.
    pub fn new(index: f64) -> Result<Self, OutOfRange> {
        require(index > 1.0 && index.is_finite(), "index", index, "finite and above 1")?;
        Ok(Pane { index })
    }

    /// The refractive index.
    pub fn index(&self) -> f64 {
        self.index
    }

    /// Transmitted share at this cosine of incidence for unpolarised light, without absorption.
    pub fn transmittance(&self, cosine: f64, polarisation: Polarisation) -> f64 {
        let through = |r: f64| (1.0 - r) / (1.0 + r);
        match polarisation {
            Polarisation::Reset => through(fresnel::unpolarised(cosine, self.index)),
            Polarisation::Kept => fresnel::polarised(cosine, self.index).map(through).iter().sum::<f64>() / 2.0,
        }
    }

    /// Transmitted share with the absorption coefficient `absorption` (1/m) over the `thickness` (m), polarisation reset.
    pub fn absorbing_transmittance(&self, cosine: f64, absorption: f64, thickness: f64) -> f64 {
        let inside = (1.0 - (1.0 - cosine * cosine) / (self.index * self.index)).sqrt();
        let (r, tau) = (fresnel::unpolarised(cosine, self.index), (-absorption * thickness / inside).exp());
        (1.0 - r).powi(2) * tau / (1.0 - r * r * tau * tau)
    }

    /// Transmitted share of diffuse (Lambertian) light.
    pub fn diffuse_transmittance(&self, polarisation: Polarisation) -> f64 {
        2.0 * Gauss::new(40).composite(0.0, 1.0, 8, |mu| mu * self.transmittance(mu, polarisation))
    }

    /// The pane over a meter in parallel light of irradiance 1 (on a perpendicular plane) at this angle from the
    /// vertical (degrees): a glass plate if `plate`, else an infinitely thin pane.
    pub fn parallel_case(&self, degrees: f64, plate: bool) -> Case {
        let (sine, cosine) = degrees.to_radians().sin_cos();
        let mut draft = self.start(plate, HALF_IN_BEAM);
        draft.add(&mitsuba::parallel_light([sine, 0.0, -cosine], &[1.0]));
        let value = cosine * self.transmittance(cosine, Polarisation::Reset);
        let uncertainty = 1e-12 + self.lateral_loss(cosine, HALF_IN_BEAM);
        draft.square(Place::floor([0.0; 3], [0.5; 2]), uncertainty, |_| value);
        draft.case(format!("{degrees} degrees, {}", name(plate)))
    }

    /// The pane as the lid of a closed black tray under an environment of radiance 1, and a meter in the tray. Without its
    /// floor the tray would let light in from below, which the pane reflects onto the meter.
    pub fn diffuse_case(&self, plate: bool) -> Case {
        let mut draft = self.start(plate, HALF);
        draft.add(&mitsuba::constant_light(&[1.0]));
        for wall in &Place::inside_box([-HALF, -HALF, -GAP], [HALF, HALF, GAP])[..5] {
            draft.wall(*wall);
        }
        let value = PI * self.diffuse_transmittance(Polarisation::Reset);
        // Directions that miss the lid: cos^2 < (gap / distance to the wall)^2.
        let missed = PI * (GAP / (HALF - 0.5)).powi(2);
        draft.square(Place::floor([0.0; 3], [0.5; 2]), missed + self.lateral_loss(0.0, HALF), |_| value);
        draft.case(format!("diffuse, {}", name(plate)))
    }

    fn start(&self, plate: bool, half: f64) -> Draft {
        if plate {
            let size = [half, half, 0.5 * THICKNESS];
            let centre = [0.0, 0.0, GAP + 0.5 * THICKNESS];
            Draft::with(mitsuba::block("pane", centre, size, &mitsuba::dielectric(self.index)))
        } else {
            let place = Place::floor([0.0, 0.0, GAP], [half; 2]);
            Draft::with(mitsuba::flat("rectangle", "pane", place, &mitsuba::thin_dielectric(self.index)))
        }
    }

    /// What light that wanders inside the plate up to its rim before it comes down could add to the reading, relative to
    /// light that falls on the pane: `R^k` after the `k` crossings that lead there, averaged over incidence.
    fn lateral_loss(&self, cosine: f64, half: f64) -> f64 {
        let inside = (1.0 - (1.0 - cosine * cosine) / (self.index * self.index)).sqrt();
        let per_crossing = THICKNESS * (1.0 - inside * inside).sqrt() / inside;
        let crossings = (half - 0.5) / per_crossing;
        // Near grazing incidence 1 - R falls to zero in proportion to the cosine, and so does the light let in.
        let kept = |mu: f64| 2.0 * mu * fresnel::unpolarised(mu, self.index).powf(crossings - 1.0);
        if cosine > 0.0 { kept(cosine) } else { Gauss::new(40).composite(0.0, 1.0, 50, kept) }
    }
}

/// Half-edge of the pane under an environment and in parallel light, which a wider one would waste, its height above the
/// meter, and the plate's thickness, in metres.
const HALF: f64 = 5.0;
const HALF_IN_BEAM: f64 = 1.0;
const GAP: f64 = 0.005;
const THICKNESS: f64 = 0.005;

fn name(plate: bool) -> &'static str {
    if plate { "glass plate" } else { "thin pane" }
}

/// The catalogue's E1: index 1.5, nine angles and diffuse light, each through a plate and through a thin pane.
pub fn cases() -> Vec<Case> {
    let pane = Pane { index: 1.5 };
    let mut cases = Vec::new();
    for plate in [true, false] {
        let angles = [0.0, 15.0, 30.0, 45.0, 60.0, 70.0, 75.0, 80.0, 85.0];
        cases.extend(angles.map(|degrees| pane.parallel_case(degrees, plate)));
        cases.push(pane.diffuse_case(plate));
    }
    cases
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::{Moments, Random};

    const PANE: Pane = Pane { index: 1.5 };

    #[test]
    fn catalogue_values() {
        for (angle, kept, reset) in [
            (0.0f64, 0.92307692, 0.92307692),
            (30.0, 0.92073444, 0.92026553),
            (60.0, 0.84812841, 0.83623246),
            (75.0, 0.61814852, 0.59609205),
            (85.0, 0.24693058, 0.24007964),
            (89.0, 0.050678959, 0.050318143),
        ] {
            let cosine = angle.to_radians().cos();
            assert!((PANE.transmittance(cosine, Polarisation::Kept) - kept).abs() < 1e-8, "{angle}");
            assert!((PANE.transmittance(cosine, Polarisation::Reset) - reset).abs() < 1e-8, "{angle}");
        }
        assert!((PANE.diffuse_transmittance(Polarisation::Reset) - 0.84455594).abs() < 1e-8);
        assert!((PANE.diffuse_transmittance(Polarisation::Kept) - 0.8509383).abs() < 1e-8);
        assert!(Pane::new(1.0).is_err());
    }

    /// The series summed ray by ray.
    #[test]
    fn the_series_of_reflections_agrees() {
        for (cosine, absorption) in [(1.0, 0.0), (0.5, 30.0), (0.1, 5.0)] {
            let inside = (1.0 - (1.0 - cosine * cosine) / 2.25f64).sqrt();
            let (r, tau) = (fresnel::unpolarised(inside, 1.0 / 1.5), (-absorption * 0.02 / inside).exp());
            let sum: f64 = (0..400).map(|m| (1.0 - r).powi(2) * tau * (r * tau).powi(2 * m)).sum();
            assert!((PANE.absorbing_transmittance(cosine, absorption, 0.02) - sum).abs() < 1e-13);
        }
        let clear = PANE.absorbing_transmittance(0.3, 0.0, 1.0);
        assert!((clear - PANE.transmittance(0.3, Polarisation::Reset)).abs() < 1e-15);
    }

    /// Photons that choose at each interface, diffuse incidence: 1 comparison at 4.5 standard errors.
    #[test]
    fn photons_agree() {
        let (mut random, mut through) = (Random::new(22), Moments::default());
        for _ in 0..300_000 {
            let r = fresnel::unpolarised(random.cosine_around([0.0, 0.0, 1.0])[2], 1.5);
            let (mut crossings, mut inside) = (0, random.unit() > r);
            while inside {
                crossings += 1;
                inside = random.unit() < r;
            }
            through.add(f64::from(crossings % 2 == 1));
        }
        through.must_agree("diffuse transmittance", PANE.diffuse_transmittance(Polarisation::Reset));
    }

    #[test]
    fn the_scenes_carry_the_parameters() {
        let case = PANE.parallel_case(60.0, true);
        assert!(case.xml.contains("name=\"int_ior\" value=\"1.5\"") && case.xml.contains("directional"));
        assert!((case.expected[0].value[0] - 0.5 * 0.83623246).abs() < 1e-8);
        assert!(PANE.diffuse_case(false).xml.contains("thindielectric"));
    }
}
