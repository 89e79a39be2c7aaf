//! A rectangular Lambertian lamp above a parallel floor.
//!
//! A rectangle with one corner straight above the point, of sides `a`, `b` at height `h`, sends it the share
//! `F = 1/(2 pi) [A/s(A) atan(B/s(A)) + B/s(B) atan(A/s(B))]` of its exitance, `A = a/h`, `B = b/h`,
//! `s(x) = sqrt(1 + x^2)`: Lambert's boundary integral over its four edges (Howell's catalogue B-3; catalogue entry C2).
//! `F` is odd in `a` and `b`, so any rectangle is a signed sum over its four corners. Exact to rounding (1e-14).

use std::f64::consts::PI;

use crate::catalogue::{Case, Draft, Reads};
use crate::mitsuba::{self, Place};
use crate::out_of_range::{OutOfRange, require_positive};
use crate::quadrature::Gauss;

/// A rectangle parallel to the floor z = 0, its middle above the origin, radiating downwards, black itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RectangularLamp {
    size: [f64; 2],
    height: f64,
    radiance: f64,
}

impl RectangularLamp {
    /// The benchmark: edge 1 m, one metre above the floor, radiance 10.
    pub const SQUARE: RectangularLamp = RectangularLamp { size: [1.0, 1.0], height: 1.0, radiance: 10.0 };

    /// A lamp of edges `size` along x and y (m) at `height` (m) with `radiance` in W/(m^2 sr) or cd/m^2.
    pub fn new(size: [f64; 2], height: f64, radiance: f64) -> Result<Self, OutOfRange> {
        size.into_iter().try_for_each(|x| require_positive("size", x))?;
        require_positive("height", height)?;
        require_positive("radiance", radiance)?;
        Ok(RectangularLamp { size, height, radiance })
    }

    /// The lamp's flux: `pi L` times its area, in W or lm.
    pub fn flux(&self) -> f64 {
        PI * self.radiance * self.size[0] * self.size[1]
    }

    /// Irradiance of the floor at `(x, y)` in metres from the point under the lamp's middle, in W/m^2 or lx.
    pub fn irradiance(&self, x: f64, y: f64) -> f64 {
        let ends = |i: usize, p: f64| [-0.5, 0.5].map(|half| (half * self.size[i] - p) / self.height);
        let ([x0, x1], [y0, y1]) = (ends(0, x), ends(1, y));
        let share = corner(x1, y1) - corner(x0, y1) - corner(x1, y0) + corner(x0, y0);
        PI * self.radiance * share
    }

    /// Mean irradiance over the floor's rectangle between two opposite corners (m).
    ///
    /// Gauss quadrature, 24 nodes on pieces no longer than half the height: better than 1e-12.
    pub fn mean_irradiance(&self, from: [f64; 2], to: [f64; 2]) -> f64 {
        let rule = Gauss::new(24);
        let area = (to[0] - from[0]) * (to[1] - from[1]);
        let pieces = |i: usize| (2.0 * (to[i] - from[i]).abs() / self.height).ceil().max(1.0) as usize;
        let row = |x: f64| rule.composite(from[1], to[1], pieces(1), |y| self.irradiance(x, y));
        rule.composite(from[0], to[0], pieces(0), row) / area
    }

    /// The scene as Mitsuba 3 XML: lamp, floor `[-2, 2]^2` of this reflectance, and a camera between them whose
    /// `cells` by `cells` pixels are equal cells of the floor over `[-half_width, half_width]^2`.
    pub fn xml(&self, floor_reflectance: f64, half_width: f64, cells: usize) -> String {
        let floor = mitsuba::rectangle("floor", "<scale value=\"2\"/>", &mitsuba::diffuse(&[floor_reflectance]));
        let ([a, b], h) = (self.size.map(|x| 0.5 * x), self.height);
        let lamp = mitsuba::rectangle(
            "lamp",
            &format!("<scale x=\"{a}\" y=\"{b}\"/><rotate x=\"1\" angle=\"180\"/><translate z=\"{h}\"/>"),
            &(mitsuba::diffuse(&[0.0]) + &mitsuba::area_lamp(&[self.radiance])),
        );
        mitsuba::scene(&(mitsuba::floor_camera(0.95 * h, half_width, cells) + &floor + &lamp))
    }
}

/// The parallel part of the catalogue's C2: 2 by 1 m, 1.5 m above the floor, 1000 lm/m^2; square meters of half-edge
/// 0.05 m, and the flux on the half `[-1, 0] x [-0.5, 0.5]` of the floor right below the lamp.
pub fn cases() -> Vec<Case> {
    let lamp = RectangularLamp { size: [2.0, 1.0], height: 1.5, radiance: 1000.0 / PI };
    let place = Place::floor([0.0, 0.0, lamp.height], lamp.size.map(|x| 0.5 * x)).turned();
    let on_it = mitsuba::diffuse(&[0.0]) + &mitsuba::area_lamp(&[lamp.radiance]);
    let (mut points, mut flux) =
        [(); 2].map(|()| Draft::with(mitsuba::flat("rectangle", "lamp", place, &on_it))).into();
    for [x, y] in [[-1.0, -0.5], [0.0, 0.0], [-0.5, -0.25], [2.0, 0.0], [2.0, 1.5], [-1.0, -1.5]] {
        points.square(Place::floor([x, y, 0.0], [0.05; 2]), 1e-9, |p| lamp.irradiance(p[0], p[1]));
    }
    let mean = lamp.mean_irradiance([-1.0, -0.5], [0.0, 0.5]);
    flux.receiver(Reads::Flux, "rectangle", Place::floor([-0.5, 0.0, 0.0], [0.5; 2]), mean, 1e-9);
    vec![points.case("irradiance"), flux.case("flux")]
}

/// Share of the exitance of a rectangle `[0, a] x [0, b]` at height 1 that a parallel element below its corner receives
/// per unit area; odd in `a` and in `b`.
fn corner(a: f64, b: f64) -> f64 {
    let (sa, sb) = ((1.0 + a * a).sqrt(), (1.0 + b * b).sqrt());
    (a / sa * (b / sa).atan() + b / sb * (a / sb).atan()) / (2.0 * PI)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The definition: `L` times the integral of both cosines over distance squared, on the lamp's area.
    fn by_area(lamp: &RectangularLamp, x: f64, y: f64) -> f64 {
        let (rule, h) = (Gauss::new(16), lamp.height);
        let kernel = |u: f64, v: f64| {
            let r2 = (u - x).powi(2) + (v - y).powi(2) + h * h;
            h * h / (r2 * r2)
        };
        let [a, b] = lamp.size.map(|s| 0.5 * s);
        let row = |u: f64| rule.composite(-b, b, 8, |v| kernel(u, v));
        lamp.radiance * rule.composite(-a, a, 8, row)
    }

    #[test]
    fn the_closed_form_is_the_integral() {
        for (size, height) in [([1.0, 1.0], 1.0), ([2.0, 1.0], 1.5), ([0.3, 4.0], 0.4)] {
            let lamp = RectangularLamp::new(size, height, 10.0).expect("valid");
            for (x, y) in [(0.0, 0.0), (0.5, 0.5), (1.0, -0.3), (0.15, 2.5), (-3.0, 1.0)] {
                let (got, brute) = (lamp.irradiance(x, y), by_area(&lamp, x, y));
                assert!((got / brute - 1.0).abs() < 1e-11, "{size:?} ({x}, {y}): {got} {brute}");
            }
        }
    }

    #[test]
    fn known_values() {
        let under = RectangularLamp::SQUARE.irradiance(0.0, 0.0);
        assert!((under - 7.522746884541).abs() < 1e-12, "{under}");
        // Catalogue C2: [0, 2] x [0, 1] at height 1.5, as a share of the exitance.
        let lamp = RectangularLamp::new([2.0, 1.0], 1.5, 1.0 / PI).expect("valid");
        for (x, y, share) in [(0.0, 0.0, 0.20907124), (1.0, 0.5, 0.12235966), (2.0, 0.0, 0.046884983)] {
            assert!((lamp.irradiance(x, y) - share).abs() < 1e-8);
        }
    }

    /// Catalogue C2: the share of the 2000 lm that falls on the half of the floor right below the lamp.
    #[test]
    fn the_catalogue_flux() {
        let flux = cases()[1].expected[0].value[0];
        assert!((flux / 2000.0 - 0.087967464).abs() < 1e-8, "{flux}");
    }

    #[test]
    fn the_mean_over_a_cell_is_the_mean_of_points() {
        let lamp = RectangularLamp::SQUARE;
        let (from, to, n) = ([-0.2, 0.1], [1.3, 0.9], 400);
        let at = |i: usize, k: usize| from[i] + (to[i] - from[i]) * (k as f64 + 0.5) / n as f64;
        let sum: f64 = (0..n * n).map(|k| lamp.irradiance(at(0, k / n), at(1, k % n))).sum();
        let mean = lamp.mean_irradiance(from, to);
        assert!((mean * (n * n) as f64 / sum - 1.0).abs() < 3e-6);
        // A floor without end catches all the flux; what falls further than R is h^2 / R^2 of it, R between a square's
        // half edge and half diagonal.
        let wide = 20.0;
        let caught = lamp.mean_irradiance([-wide, -wide], [wide, wide]) * 4.0 * wide * wide;
        let lost = (1.0 - caught / lamp.flux()) * wide * wide;
        assert!((0.5..1.0).contains(&lost), "{lost}");
    }

    #[test]
    fn the_scene_file_carries_the_parameters() {
        let xml = RectangularLamp::SQUARE.xml(0.5, 1.5, 128);
        mitsuba::assert_balanced(&xml);
        assert!(xml.contains("115.305113") && xml.contains("scale x=\"0.5\" y=\"0.5\""), "{xml}");
        assert!(RectangularLamp::new([1.0, 0.0], 1.0, 1.0).is_err());
    }
}
