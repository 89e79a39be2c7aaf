//! A prism in a narrow beam: deviation and dispersion.
//!
//! With the apex angle `A` and the incidence `i`: `sin r = sin i / n`, `sin e = n sin(A - r)`, and the beam is turned by
//! `i + e - A`. (Snell twice; Born and Wolf, section 4.7.2; catalogue entry E6.) Exact to rounding.

use crate::catalogue::{Case, Draft, Reads};
use crate::mitsuba::{self, Place};
use crate::out_of_range::{OutOfRange, require};
use crate::scattering::fresnel;
use crate::vector::{Vector, along};

/// Index of the glass N-BK7 at this wavelength (micrometres): Sellmeier's formula with the manufacturer's coefficients.
pub fn bk7(wavelength: f64) -> f64 {
    let l2 = wavelength * wavelength;
    let terms = [(1.03961212, 0.00600069867), (0.231792344, 0.0200179144), (1.01046945, 103.560653)];
    (1.0 + terms.iter().map(|(b, c)| b * l2 / (l2 - c)).sum::<f64>()).sqrt()
}

/// Cauchy's two-term index at this wavelength (micrometres).
pub fn cauchy(a: f64, b: f64, wavelength: f64) -> f64 {
    a + b / (wavelength * wavelength)
}

/// An equilateral prism and the angle of incidence of the beam.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prism {
    index: f64,
    incidence: f64,
}

/// Apex angle, edge and half width of the slit, distance of the screen, half-edge of what shades all but the slit, and its
/// distance before the prism: radians and metres. Little larger than they must be, since photons are sent all over them.
const APEX: f64 = std::f64::consts::FRAC_PI_3;
const EDGE: f64 = 0.2;
const SLIT: f64 = 0.03;
const SCREEN: f64 = 0.3;
const SHADE: f64 = 0.35;
const BEFORE: f64 = 0.15;

impl Prism {
    /// A 60-degree prism of this refractive index, lit at `incidence` (radians) so that the beam comes out at the other
    /// face.
    pub fn new(index: f64, incidence: f64) -> Result<Self, OutOfRange> {
        require(index > 1.0 && index < 2.0, "index", index, "above 1 and below 2")?;
        let prism = Prism { index, incidence };
        require(incidence > 0.0 && prism.exit().is_finite(), "incidence", incidence, "such that the beam comes out")?;
        Ok(prism)
    }

    /// Angle inside against the first normal.
    fn inside(&self) -> f64 {
        (self.incidence.sin() / self.index).asin()
    }

    /// Angle of exit against the second normal; NaN for total reflection.
    fn exit(&self) -> f64 {
        (self.index * (APEX - self.inside()).sin()).asin()
    }

    /// The angle by which the beam is turned, in radians.
    pub fn deviation(&self) -> f64 {
        self.incidence + self.exit() - APEX
    }

    /// Share of unpolarised light that passes both faces, polarisation forgotten between them.
    pub fn transmittance(&self) -> f64 {
        let lost = [self.incidence, self.exit()].map(|angle| fresnel::unpolarised(angle.cos(), self.index));
        (1.0 - lost[0]) * (1.0 - lost[1])
    }

    /// Where the middle ray leaves the second face, in metres from the apex: by the sine rule in the triangle of the apex
    /// and both points of passage, the first one in the middle of its face.
    fn exit_from_apex(&self) -> f64 {
        let inside = self.inside();
        0.5 * EDGE * inside.cos() / (APEX - inside).cos()
    }

    /// Two flux meters that meet on the middle of the beam, 0.3 m behind the prism, perpendicular to it. Each reads half
    /// of what passes the slit of 4 SLIT^2 and the prism; an index off by 1e-4 moves 1e-3 of it from one to the other.
    ///
    /// Apex up (+z); the base is black, so that no light returns from inside.
    fn case(&self, name: String) -> Case {
        let tilt = self.incidence - 0.5 * APEX;
        let direction = |angle: f64| [angle.cos(), 0.0, angle.sin()];
        let beam = direction(tilt);
        let mut draft = Draft::with(mitsuba::parallel_light(beam, &[1.0]));
        let half_face = [SLIT * 2.0, 0.5 * EDGE];
        let glass = mitsuba::dielectric(self.index);
        // Up along both faces, from the base's ends to the apex in the origin.
        let ups = [-1.0, 1.0].map(|side| [-side * (0.5 * APEX).sin(), 0.0, (0.5 * APEX).cos()]);
        for (i, up) in ups.into_iter().enumerate() {
            let normal = if i == 0 { [-up[2], 0.0, up[0]] } else { [up[2], 0.0, -up[0]] };
            let place = Place { centre: along([0.0; 3], -0.5 * EDGE, up), normal, up, half: half_face };
            draft.add(&mitsuba::flat("rectangle", &format!("face-{i}"), place, &glass));
        }
        draft.wall(Place::floor([0.0, 0.0, -EDGE * (0.5 * APEX).cos()], [0.5 * EDGE, half_face[0]]));
        let entrance = along([0.0; 3], -0.5 * EDGE, ups[0]);
        slit(&mut draft, along(entrance, -BEFORE, beam), beam);

        let (leaves, out) = (along([0.0; 3], -self.exit_from_apex(), ups[1]), direction(tilt - self.deviation()));
        let (centre, across) = (along(leaves, SCREEN, out), [-out[2], 0.0, out[0]]);
        let half_flux = 0.5 * self.transmittance() * 4.0 * SLIT * SLIT;
        for side in [-1.0, 1.0] {
            let half = [2.0 * SLIT; 2];
            let place =
                Place { centre: along(centre, side * half[1], across), normal: out.map(|x| -x), up: across, half };
            draft.receiver(Reads::Flux, "rectangle", place, half_flux, 1e-9 * half_flux);
        }
        draft.case(name)
    }
}

/// A black screen of half-edge `SHADE` across the light with a square opening of half-edge `SLIT`.
fn slit(draft: &mut Draft, centre: Vector, beam: Vector) {
    let (normal, up) = (beam.map(|x| -x), [-beam[2], 0.0, beam[0]]);
    let (long, side) = (0.5 * (SHADE - SLIT), 0.5 * (SHADE + SLIT));
    for sign in [-1.0, 1.0] {
        draft.wall(Place { centre: along(centre, sign * side, up), normal, up, half: [SHADE, long] });
        let centre = along(centre, sign * side, [0.0, 1.0, 0.0]);
        draft.wall(Place { centre, normal, up, half: [long, SLIT] });
    }
}

/// The catalogue's E6: N-BK7, 50 degrees, seven wavelengths (nm).
pub fn cases() -> Vec<Case> {
    [404.7, 435.8, 486.1, 546.1, 587.6, 656.3, 706.5]
        .map(|nm: f64| {
            let prism = Prism { index: bk7(nm / 1000.0), incidence: 50f64.to_radians() };
            prism.case(format!("{nm} nm"))
        })
        .to_vec()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::{Moments, Random};
    use crate::vector::dot;

    #[test]
    fn catalogue_values() {
        let deviation = |n: f64| Prism::new(n, 50f64.to_radians()).expect("valid").deviation();
        let d_line = deviation(bk7(0.5876));
        for (nm, n, degrees, position, by_cauchy) in [
            (404.7, 1.5302344, 39.834943, 0.02062304, 39.835785),
            (486.1, 1.5223787, 39.141181, 0.0085118877, 39.140819),
            (587.6, 1.5167984, 38.653498, 0.0, 38.650524),
            (706.5, 1.512893, 38.314611, -0.005914755, 38.325118),
        ] {
            let index = bk7(nm / 1000.0);
            assert!((index - n).abs() < 1e-7, "{nm}: {index}");
            assert!((deviation(index).to_degrees() - degrees).abs() < 1e-6, "{nm}");
            assert!(((deviation(index) - d_line).tan() - position).abs() < 1e-9, "{nm}");
            assert!((deviation(cauchy(1.5046, 0.0042, nm / 1000.0)).to_degrees() - by_cauchy).abs() < 1e-6, "{nm}");
        }
        assert!(Prism::new(1.5, 0.1).is_err(), "totally reflected");
    }

    /// Least deviation: `n = sin((A + D) / 2) / sin(A / 2)`, where the path is symmetric.
    #[test]
    fn least_deviation_gives_the_index_back() {
        let n = bk7(0.5876);
        let prism = Prism::new(n, (n * (0.5 * APEX).sin()).asin()).expect("valid");
        let back = (0.5 * (APEX + prism.deviation())).sin() / (0.5 * APEX).sin();
        assert!((back - n).abs() < 1e-12);
        assert!((prism.exit_from_apex() - 0.5 * EDGE).abs() < 1e-12);
    }

    /// Rays through the two faces by Snell's law in vectors; both halves of the beam meet where the meters do: 2
    /// comparisons at 4.5 standard errors, weighted by the transmittance of the rays.
    #[test]
    fn traced_rays_agree() {
        let prism = Prism::new(bk7(0.4358), 50f64.to_radians()).expect("valid");
        let case = prism.case("test".into());
        let (tilt, mut random) = (prism.incidence - 0.5 * APEX, Random::new(35));
        let (sine, cosine) = (0.5 * APEX).sin_cos();
        let (first, second) = ([-cosine, 0.0, sine], [cosine, 0.0, sine]);
        let out = {
            let angle = tilt - prism.deviation();
            [angle.cos(), 0.0, angle.sin()]
        };
        let across = [-out[2], 0.0, out[0]];
        let middle = dot(along([0.0; 3], -prism.exit_from_apex(), [-sine, 0.0, cosine]), across);
        let mut halves: [Moments; 2] = Default::default();
        for _ in 0..20_000 {
            let d = [tilt.cos(), 0.0, tilt.sin()];
            let start =
                along([-0.5 * EDGE * sine, 0.0, -0.5 * EDGE * cosine], random.between(-SLIT, SLIT), [-d[2], 0.0, d[0]]);
            let (p, d) = refract(start, d, first, 1.0 / prism.index);
            let (p, d) = refract(p, d, second.map(|x| -x), prism.index);
            assert!(dot(d, out) > 1.0 - 1e-14);
            let side = usize::from(dot(p, across) > middle);
            let flux = prism.transmittance() * 4.0 * SLIT * SLIT;
            (0..2).for_each(|i| halves[i].add(if i == side { flux } else { 0.0 }));
        }
        for (half, expected) in halves.iter().zip(&case.expected) {
            half.must_agree("half of the beam", expected.value[0]);
        }
    }

    /// Meets the plane through the origin with this normal, facing the ray or, for the exit, along it, and refracts.
    fn refract(p: Vector, d: Vector, normal: Vector, eta: f64) -> (Vector, Vector) {
        let cosine = -dot(d, normal);
        let p = along(p, -dot(p, normal) / dot(d, normal), d);
        let far = (1.0 - eta * eta * (1.0 - cosine * cosine)).sqrt();
        (p, along(d.map(|x| eta * x), eta * cosine - far, normal))
    }
}
