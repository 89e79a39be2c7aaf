//! A square glass guide: flux out of its far end.
//!
//! Reflection at the sides keeps the size of each component of a direction, so the guide unfolds: a ray that enters at the
//! angle `theta` from the axis meets both ends at `theta` outside, whatever its way, and its side faces at an angle whose
//! sine exceeds `1 / n` if `n^2 - 1` is at least the square of its component across them. For `n >= sqrt 2` all that
//! enters is guided (numerical aperture 1), and of it both ends and all passes between them let
//! `(1 - R)^2 (1 + R^2 + ...) = (1 - R) / (1 + R)` through, `R(theta)` Fresnel's reflectance, unpolarised anew at each end.
//! (Textbook; Snyder and Love, "Optical Waveguide Theory", chapter 1, for rays in guides.) Gauss quadrature, 1e-10.

use std::f64::consts::PI;

use crate::quadrature::Gauss;
use crate::scattering::fresnel;

/// A guide `[-a, a]^2` wide from z = 0 on, and a point lamp on its axis before it whose intensity goes as a power of the
/// cosine to +z.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightGuide {
    /// Half the width `a` (m).
    pub half_width: f64,
    /// Refractive index, at least sqrt 2.
    pub index: f64,
    /// Distance of the lamp from the end (m).
    pub distance: f64,
    /// Exponent of the lamp's cosine.
    pub exponent: f64,
    /// Flux of the lamp (W or lm).
    pub flux: f64,
}

impl LightGuide {
    /// `light-guide.xml`.
    pub const SCENE: LightGuide =
        LightGuide { half_width: 0.005, index: 1.5, distance: 0.005, exponent: 4.0, flux: 1000.0 };

    /// Flux that meets the near end, in W or lm.
    pub fn incident(&self) -> f64 {
        self.over_the_end(|_| 1.0)
    }

    /// Flux out of the far end, in W or lm, however long the guide is.
    pub fn transmitted(&self) -> f64 {
        self.over_the_end(|cosine| {
            let reflected = fresnel::unpolarised(cosine, self.index);
            (1.0 - reflected) / (1.0 + reflected)
        })
    }

    /// The lamp's light on the near end with this weight for each cosine.
    fn over_the_end(&self, weight: impl Fn(f64) -> f64) -> f64 {
        let (rule, d) = (Gauss::new(16), self.distance);
        let on_axis = self.flux * (self.exponent + 1.0) / (2.0 * PI);
        let element = |x: f64, y: f64| {
            let r = (x * x + y * y + d * d).sqrt();
            weight(d / r) * on_axis * (d / r).powf(self.exponent + 1.0) / (r * r)
        };
        let quadrant =
            rule.composite(0.0, self.half_width, 4, |x| rule.composite(0.0, self.half_width, 4, |y| element(x, y)));
        4.0 * quadrant
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::{Moments, Random};
    use crate::vector::{Vector, along, unit};

    /// Without its power of the cosine the lamp in the middle of a cube's face sends a sixth of its light through each.
    #[test]
    fn a_cube_s_face_gets_a_sixth() {
        let even = LightGuide { exponent: 0.0, flux: 2.0, ..LightGuide::SCENE };
        assert!((even.incident() - 2.0 / 3.0).abs() < 1e-10, "{}", even.incident());
        let clear = LightGuide { index: 1.0 + 1e-12, ..LightGuide::SCENE };
        assert!((clear.transmitted() / clear.incident() - 1.0).abs() < 1e-9);
    }

    /// Rays followed from wall to wall through a guide of 20 widths: 2 comparisons at 4.5 standard errors.
    #[test]
    fn followed_rays_agree() {
        let (guide, mut random) = (LightGuide::SCENE, Random::new(81));
        let (mut met, mut out) = (Moments::default(), Moments::default());
        for _ in 0..60_000 {
            let cosine = random.unit().powf(1.0 / (guide.exponent + 1.0));
            let (sine, phi) = ((1.0 - cosine * cosine).sqrt(), random.between(0.0, 2.0 * PI));
            let d = [sine * phi.cos(), sine * phi.sin(), cosine];
            let p = along([0.0, 0.0, -guide.distance], guide.distance / cosine, d);
            let meets = p[0].abs().max(p[1].abs()) < guide.half_width;
            met.add(if meets { guide.flux } else { 0.0 });
            let passes = meets && comes_out(&guide, 20.0, p, d, &mut random);
            out.add(if passes { guide.flux } else { 0.0 });
        }
        met.must_agree("flux on the near end", guide.incident());
        out.must_agree("flux out of the far end", guide.transmitted());
    }

    /// Whether the far end is where a ray that meets the near one from outside leaves the glass.
    fn comes_out(guide: &LightGuide, widths: f64, mut p: Vector, mut d: Vector, random: &mut Random) -> bool {
        let (a, far) = (guide.half_width, 2.0 * widths * guide.half_width);
        if random.unit() < fresnel::unpolarised(d[2], guide.index) {
            return false;
        }
        d = unit([d[0] / guide.index, d[1] / guide.index, {
            (1.0 - (d[0] * d[0] + d[1] * d[1]) / (guide.index * guide.index)).sqrt()
        }]);
        loop {
            let planes = [(-a, a), (-a, a), (0.0, far)];
            let reach = |axis: usize| {
                let to = if d[axis] > 0.0 { planes[axis].1 } else { planes[axis].0 };
                (to - p[axis]) / d[axis]
            };
            let axis = (0..3).min_by(|&i, &j| reach(i).total_cmp(&reach(j))).expect("three axes");
            p = along(p, reach(axis), d);
            if random.unit() >= fresnel::unpolarised(d[axis].abs(), 1.0 / guide.index) {
                return axis == 2 && d[2] > 0.0;
            }
            d[axis] = -d[axis];
        }
    }
}
