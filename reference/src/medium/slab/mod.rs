//! A slab of scattering medium between clear space: how much comes back and how much goes through.
//!
//! By adding and doubling (van de Hulst 1980; Prahl 1995): a layer so thin that light scatters in it at most once is put on
//! its like, again and again, until it has the slab's optical thickness. Light is averaged over the azimuth and
//! described at Gauss nodes in the cosine; the directions asked for join as nodes of weight 0. By reciprocity
//! the share of a beam that comes back is the radiance in its direction under uniform diffuse light. (Catalogue entry F7.)
//!
//! Precision 1e-7: initial layer 2^-30 of the thickness, 32 nodes, the phase function's series cut at degree 63.

mod doubling;

use std::f64::consts::PI;

use crate::catalogue::{Case, Draft};
use crate::medium::phase::HenyeyGreenstein;
use crate::mitsuba::{self, Medium, Place};
use crate::out_of_range::{OutOfRange, require, require_positive};

/// A slab of optical thickness `thickness` with albedo and mean cosine of scattering.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slab {
    thickness: f64,
    albedo: f64,
    asymmetry: f64,
}

/// Shares of the incident light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shares {
    /// Comes back.
    pub reflected: f64,
    /// Goes through, scattered or not.
    pub transmitted: f64,
}

/// What a slab does to a beam of each cosine asked for, and to diffuse light.
#[derive(Clone, Debug, PartialEq)]
pub struct SlabShares {
    /// In the order of the cosines.
    pub beams: Vec<Shares>,
    /// Lambertian light.
    pub diffuse: Shares,
}

impl Slab {
    /// A slab with `albedo` in `[0, 1]` and `asymmetry` between -0.75 and 0.75, beyond which the series would be cut short.
    pub fn new(thickness: f64, albedo: f64, asymmetry: f64) -> Result<Self, OutOfRange> {
        require_positive("thickness", thickness)?;
        require((0.0..=1.0).contains(&albedo), "albedo", albedo, "between 0 and 1")?;
        require(asymmetry.abs() <= 0.75, "asymmetry", asymmetry, "between -0.75 and 0.75")?;
        Ok(Slab { thickness, albedo, asymmetry })
    }

    /// Reflected and transmitted shares for beams at these cosines of incidence, in `(0, 1]`, and for diffuse light.
    pub fn shares(&self, cosines: &[f64]) -> SlabShares {
        let phase = HenyeyGreenstein::new(self.asymmetry).expect("checked on construction");
        doubling::shares(self.thickness, self.albedo, phase, 32, cosines)
    }

    /// How far from its rim a slab of finite width has to be lit and read to be like an endless one to 4 exp(-14): light
    /// that wanders sideways dies away at the rate `pi / (thickness + 2 * 0.71 / (1 - g))` (diffusion between the
    /// extrapolated boundaries, at albedo 1).
    pub fn margin(&self) -> f64 {
        14.0 / PI * (self.thickness + 1.42 / (1.0 - self.asymmetry))
    }

    fn medium(&self) -> Medium {
        Medium { extinction: 1.0, albedo: self.albedo, asymmetry: self.asymmetry }
    }

    fn name(&self) -> String {
        format!("thickness {}, albedo {}, g {}", self.thickness, self.albedo, self.asymmetry)
    }

    /// A beam at this cosine on the slab, and a meter below that reads the transmitted irradiance.
    fn beam_case(&self, cosine: f64) -> Case {
        let mut draft = self.over_meter();
        let sine = (1.0 - cosine * cosine).sqrt();
        draft.add(&mitsuba::parallel_light([sine, 0.0, -cosine], &[1.0]));
        let through = cosine * self.shares(&[cosine]).beams[0].transmitted;
        self.add_meter(&mut draft, through);
        draft.case(format!("beam at {cosine}, {}", self.name()))
    }

    /// Uniform light of radiance 1 from above: the slab shows the reflected share of each direction, and the meter below
    /// reads the diffuse transmittance.
    fn diffuse_case(&self, cosines: &[f64]) -> Case {
        let mut draft = self.over_meter();
        draft.add(&mitsuba::constant_light(&[1.0]));
        self.add_meter(&mut draft, PI * self.shares(cosines).diffuse.transmitted);
        self.look_at_it(&mut draft, cosines, |beam| beam.reflected);
        draft.case(format!("diffuse, {}", self.name()))
    }

    /// A lamp of radiance 1 under the whole slab, black else: the slab shows each direction its transmitted share, by
    /// reciprocity with a beam that comes from there. The sensors follow the order of the cosines.
    pub fn lit_from_behind(&self, cosines: &[f64]) -> Case {
        let mut draft = self.over_meter();
        let place = Place::floor([0.0, 0.0, -0.5 * GAP], [2.0 * self.margin(); 2]);
        draft.add(&mitsuba::flat("rectangle", "lamp", place, &mitsuba::area_lamp(&[1.0])));
        self.look_at_it(&mut draft, cosines, |beam| beam.transmitted);
        draft.case(format!("lit from behind, {}", self.name()))
    }

    /// Uniform light of radiance 1 from above on the slab over black: it shows each direction its reflected share. The
    /// sensors follow the order of the cosines.
    pub fn lit_from_above(&self, cosines: &[f64]) -> Case {
        let mut draft = self.over_meter();
        draft.add(&mitsuba::constant_light(&[1.0]));
        self.look_at_it(&mut draft, cosines, |beam| beam.reflected);
        draft.case(format!("lit from above, {}", self.name()))
    }

    /// Radiance meters above the slab's middle that look down at it at these cosines.
    fn look_at_it(&self, draft: &mut Draft, cosines: &[f64], share: impl Fn(&Shares) -> f64) {
        for (&mu, beam) in cosines.iter().zip(&self.shares(cosines).beams) {
            let from = [2.0 * (1.0 - mu * mu).sqrt(), 0.0, self.thickness + 2.0 * mu];
            draft.radiance(from, [0.0, 0.0, self.thickness], &[share(beam)], 4.0 * (-14f64).exp());
        }
    }

    fn over_meter(&self) -> Draft {
        tray(self.thickness, 2.0 * self.margin(), self.medium())
    }

    fn add_meter(&self, draft: &mut Draft, value: f64) {
        let place = Place::floor([0.0, 0.0, -0.5 * GAP], [self.margin(); 2]);
        draft.square(place, PI * 4.0 * (-14f64).exp(), |_| value);
    }
}

/// Depth of the black tray under a slab (m).
const GAP: f64 = 0.01;

/// A block of medium from z = 0 up to `thickness`, with this half-width, on a flat black tray that keeps light away from
/// below. Directions that the tray's rim hides are below 1e-6 of the light.
pub(crate) fn tray(thickness: f64, half_width: f64, medium: Medium) -> Draft {
    let (w, z) = (half_width, 0.5 * thickness);
    let mut draft = Draft::with(mitsuba::fog_block([0.0, 0.0, z], [w, w, z], medium));
    for wall in &Place::inside_box([-w, -w, -GAP], [w, w, 0.0])[..5] {
        draft.wall(*wall);
    }
    draft
}

/// The catalogue's F7.
pub fn cases() -> Vec<Case> {
    let mut cases = Vec::new();
    for thickness in [1.0, 2.0] {
        for albedo in [0.5, 0.9, 0.99, 1.0] {
            for asymmetry in [0.0, 0.75] {
                let slab = Slab { thickness, albedo, asymmetry };
                cases.extend([slab.beam_case(1.0), slab.beam_case(0.5), slab.diffuse_case(&[1.0, 0.5])]);
            }
        }
    }
    cases
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::{Moments, Random};

    /// Catalogue F7: thickness, albedo, g, then R and T at 1, at 0.5 and for diffuse light.
    const TABLE: [(f64, f64, f64, [f64; 6]); 7] = [
        (1.0, 0.5, 0.0, [0.099119186, 0.44605839, 0.14975384, 0.2302852, 0.13416517, 0.30670882]),
        (1.0, 0.9, 0.75, [0.055946824, 0.82791736, 0.17103869, 0.62234188, 0.1383592, 0.68854764]),
        (1.0, 1.0, 0.0, [0.34132876, 0.65867124, 0.49837553, 0.50162447, 0.44659401, 0.55340599]),
        (2.0, 0.5, 0.75, [0.018452286, 0.30533059, 0.050481642, 0.10368528, 0.043226529, 0.17667841]),
        (2.0, 0.9, 0.75, [0.097394639, 0.6609577, 0.23356949, 0.41589043, 0.19109023, 0.50181606]),
        (2.0, 0.99, 0.0, [0.49748876, 0.46569915, 0.63401635, 0.32586707, 0.58800004, 0.3733475]),
        (2.0, 1.0, 0.75, [0.16317606, 0.83682394, 0.37501676, 0.62498324, 0.30404023, 0.69595977]),
    ];

    #[test]
    fn catalogue_values_and_conservation() {
        for (thickness, albedo, asymmetry, values) in TABLE {
            let shares = Slab::new(thickness, albedo, asymmetry).expect("valid").shares(&[1.0, 0.5]);
            let got = [shares.beams[0], shares.beams[1], shares.diffuse];
            for (i, s) in got.into_iter().enumerate() {
                let (r, t) = (s.reflected - values[2 * i], s.transmitted - values[2 * i + 1]);
                assert!(r.abs() < 1e-7 && t.abs() < 1e-7, "{thickness} {albedo} {asymmetry} {i}: {r:e} {t:e}");
                let sum = s.reflected + s.transmitted;
                assert!(albedo < 1.0 || (sum - 1.0).abs() < 1e-7, "{sum}");
            }
        }
        assert!(Slab::new(1.0, 0.5, 0.9).is_err());
    }

    /// Random walks with directions in space, for a slab that scatters forwards: 4 comparisons at 4.5 standard errors.
    #[test]
    fn random_walks_agree() {
        let (slab, mut random) = (Slab::new(2.0, 0.9, 0.75).expect("valid"), Random::new(57));
        let phase = HenyeyGreenstein::new(0.75).expect("valid");
        for (mu, shares) in [1.0, 0.5].into_iter().zip(slab.shares(&[1.0, 0.5]).beams) {
            let [mut back, mut through]: [Moments; 2] = Default::default();
            for _ in 0..100_000 {
                let (mut depth, mut cosine, mut weight) = (0.0, mu, 1.0);
                loop {
                    depth += cosine * random.gap();
                    if !(0.0..=2.0).contains(&depth) {
                        break;
                    }
                    weight *= 0.9;
                    // The new direction's cosine against the slab's normal: turned by the angle, at a random azimuth.
                    let (turn, azimuth) = (phase.quantile(random.unit()), random.between(0.0, 2.0 * PI));
                    let sines = ((1.0 - turn * turn) * (1.0 - cosine * cosine)).max(0.0).sqrt();
                    cosine = cosine * turn + sines * azimuth.cos();
                }
                back.add(if depth < 0.0 { weight } else { 0.0 });
                through.add(if depth > 2.0 { weight } else { 0.0 });
            }
            back.must_agree("reflected", shares.reflected);
            through.must_agree("transmitted", shares.transmitted);
        }
    }

    #[test]
    fn the_scenes_carry_the_parameters() {
        let slab = Slab::new(2.0, 0.9, 0.75).expect("valid");
        let case = slab.diffuse_case(&[1.0]);
        mitsuba::assert_balanced(&case.xml);
        assert!(case.xml.contains("type=\"hg\"><float name=\"g\" value=\"0.75\""), "{}", case.xml);
        assert!((case.expected[1].value[0] - 0.097394639).abs() < 1e-7);
        let [behind, above] = [slab.lit_from_behind(&[1.0, 0.5]), slab.lit_from_above(&[1.0, 0.5])];
        mitsuba::assert_balanced(&behind.xml);
        mitsuba::assert_balanced(&above.xml);
        assert!((behind.expected[1].value[0] - 0.41589043).abs() < 1e-7);
        assert!((above.expected[0].value[0] - 0.097394639).abs() < 1e-7);
    }

    /// A medium that scatters nothing leaves what no collision took, and shows nothing of its own.
    #[test]
    fn without_scattering_only_the_transmittance_is_left() {
        let slab = Slab::new(1.5, 0.0, 0.0).expect("valid");
        for (mu, beam) in [1.0f64, 0.5, 0.1].into_iter().zip(slab.shares(&[1.0, 0.5, 0.1]).beams) {
            let through = crate::rendering_equation::transmittance(1.5, mu);
            assert!((beam.transmitted - through).abs() < 1e-7 && beam.reflected.abs() < 1e-12, "{mu}: {beam:?}");
        }
    }
}
