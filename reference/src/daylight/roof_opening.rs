//! The sky component in a black room under an opening in its thin roof.
//!
//! At the point `(x, y)` of the floor the opening's element `dA`, `h` above and at distance `r`, brings
//! `L(h/r) (h/r)^2 / r^2 dA`, `h/r` the sine of its elevation. The sky component is that in parts of the
//! unobstructed horizontal illuminance. Under a uniform sky it is the rectangle's share of [`crate::square_lamp`]; a
//! glazed opening multiplies the integrand by the pane's transmittance ([`crate::pane`]). (Definition; catalogue entries
//! I4 and, for the list of such cases in CIE 171:2006, I5.) Gauss quadrature, 1e-12.

use crate::catalogue::{Case, Draft};
use crate::daylight::sky::Sky;
use crate::mitsuba::{self, Place};
use crate::out_of_range::{OutOfRange, require_positive};
use crate::pane::{Pane, Polarisation};
use crate::quadrature::Gauss;

/// A rectangular opening `height` above the floor, its middle above the origin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RoofOpening {
    size: [f64; 2],
    height: f64,
    glazing: Option<Pane>,
}

impl RoofOpening {
    /// An opening of edges `size` (m) along x and y at `height` (m), with a clear pane in it or none.
    pub fn new(size: [f64; 2], height: f64, glazing: Option<Pane>) -> Result<Self, OutOfRange> {
        size.into_iter().try_for_each(|x| require_positive("size", x))?;
        require_positive("height", height)?;
        Ok(RoofOpening { size, height, glazing })
    }

    /// Illuminance of the floor at `(x, y)` for a zenith luminance of 1.
    pub fn illuminance(&self, sky: Sky, x: f64, y: f64) -> f64 {
        let (rule, h) = (Gauss::new(20), self.height);
        let [a, b] = self.size.map(|s| 0.5 * s);
        let pieces = |size: f64| (2.0 * size / h).ceil() as usize;
        let element = |u: f64, v: f64| {
            let r2 = (u - x).powi(2) + (v - y).powi(2) + h * h;
            let sine = h / r2.sqrt();
            let through = self.glazing.map_or(1.0, |pane| pane.transmittance(sine, Polarisation::Reset));
            through * sky.luminance(sine) * sine * sine / r2
        };
        rule.composite(-a, a, pieces(self.size[0]), |u| rule.composite(-b, b, pieces(self.size[1]), |v| element(u, v)))
    }

    /// The sky component at `(x, y)`, a share of the unobstructed horizontal illuminance.
    pub fn sky_component(&self, sky: Sky, x: f64, y: f64) -> f64 {
        self.illuminance(sky, x, y) / sky.horizontal_illuminance()
    }

    /// A black room of half-width `half` under a sky that would give 10 000 lx on open ground, with square meters of
    /// half-edge 0.1 m at these points; a portal in the opening if its light is `aimed`, which changes no answer.
    fn case(&self, sky: Sky, half: f64, at: &[[f64; 2]], aimed: bool) -> Case {
        let scale = 10_000.0 / sky.horizontal_illuminance();
        let mut draft = Draft::with(sky_xml(sky, scale));
        // The floor proper lies a little below the meters.
        for wall in &Place::inside_box([-half, -half, -0.01], [half, half, self.height])[..5] {
            draft.wall(*wall);
        }
        self.add_roof(&mut draft, half);
        if let Some(pane) = self.glazing {
            let place = Place::floor([0.0, 0.0, self.height], self.size.map(|s| 0.5 * s));
            draft.add(&mitsuba::flat("rectangle", "pane", place, &mitsuba::thin_dielectric(pane.index())));
        }
        if aimed {
            // Above the pane, which would keep the light from it, and so near that nothing comes in between.
            let place = Place::floor([0.0, 0.0, self.height + ABOVE], self.size.map(|s| 0.5 * s)).turned();
            draft.add(&mitsuba::flat("rectangle", "portal", place, mitsuba::PORTAL));
        }
        for &[x, y] in at {
            let place = Place::floor([x, y, 0.0], [0.1; 2]);
            draft.square(place, 1e-6, |p| scale * self.illuminance(sky, p[0], p[1]));
        }
        let glazed = if self.glazing.is_some() { ", glazed" } else { "" };
        draft.case(format!("{sky:?}{glazed}"))
    }

    /// Four black rectangles around the opening, facing down.
    fn add_roof(&self, draft: &mut Draft, half: f64) {
        let [a, b] = self.size.map(|s| 0.5 * s);
        for side in [-1.0, 1.0] {
            let strips = [
                ([side * 0.5 * (half + a), 0.0], [0.5 * (half - a), half]),
                ([0.0, side * 0.5 * (half + b)], [a, 0.5 * (half - b)]),
            ];
            for ([x, y], size) in strips {
                draft.wall(Place::floor([x, y, self.height], size).turned());
            }
        }
    }
}

/// The sky as an emitter with this zenith luminance.
fn sky_xml(sky: Sky, zenith: f64) -> String {
    match sky {
        Sky::Uniform => mitsuba::constant_light(&[zenith]),
        Sky::Overcast => mitsuba::sky(None, zenith),
        Sky::CieType1 => mitsuba::sky(Some(1), zenith),
    }
}

/// Height of the portal above the opening (m).
const ABOVE: f64 = 1e-6;

/// The catalogue's I4, its sky aimed through a portal.
pub fn cases() -> Vec<Case> {
    cases_with(true)
}

/// The same without portals.
pub fn cases_without_portals() -> Vec<Case> {
    cases_with(false)
}

/// The catalogue's I4: 1 by 1 m, 3 m above the floor of a room 4 m wide, three skies; then glazed with index 1.5.
fn cases_with(aimed: bool) -> Vec<Case> {
    let at = [[0.0, 0.0], [0.5, 0.5], [1.0, 0.0], [1.75, 1.75]];
    let skies = [Sky::Uniform, Sky::Overcast, Sky::CieType1];
    let open = RoofOpening { size: [1.0, 1.0], height: 3.0, glazing: None };
    let glazed = RoofOpening { glazing: Pane::new(1.5).ok(), ..open };
    [open, glazed].iter().flat_map(|opening| skies.map(|sky| opening.case(sky, 2.0, &at, aimed))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::{Moments, Random};
    use crate::square_lamp::RectangularLamp;

    const OPENING: RoofOpening = RoofOpening { size: [1.0, 1.0], height: 3.0, glazing: None };

    /// Catalogue I4, in per cent.
    #[test]
    fn catalogue_values() {
        for (x, y, values) in [
            (0.0, 0.0, [3.4106795, 4.3589826, 4.355889]),
            (0.5, 0.5, [3.0829397, 3.8775086, 3.8920046]),
            (1.0, 0.0, [2.7989156, 3.46682, 3.4936356]),
            (1.75, 1.75, [1.2579696, 1.3764333, 1.41663]),
        ] {
            for (sky, want) in [Sky::Uniform, Sky::Overcast, Sky::CieType1].into_iter().zip(values) {
                let got = 100.0 * OPENING.sky_component(sky, x, y);
                assert!((got - want).abs() < 1e-7, "{sky:?} {x} {y}: {got}");
            }
        }
    }

    #[test]
    fn a_uniform_sky_is_a_lamp_in_the_opening() {
        let lamp = RectangularLamp::new([2.0, 0.5], 1.3, 1.0).expect("valid");
        let opening = RoofOpening::new([2.0, 0.5], 1.3, None).expect("valid");
        for (x, y) in [(0.0, 0.0), (1.0, 0.3), (-2.0, 1.0)] {
            let (got, want) = (opening.illuminance(Sky::Uniform, x, y), lamp.irradiance(x, y));
            assert!((got / want - 1.0).abs() < 1e-12, "{x} {y}");
        }
        assert!(RoofOpening::new([1.0, 0.0], 1.0, None).is_err());
    }

    /// Directions drawn at the point that pass the opening: 3 comparisons at 4.5 standard errors.
    #[test]
    fn drawn_directions_agree() {
        let mut random = Random::new(72);
        let glazed = RoofOpening { glazing: Pane::new(1.5).ok(), ..OPENING };
        for (opening, sky) in [(OPENING, Sky::Overcast), (OPENING, Sky::CieType1), (glazed, Sky::Overcast)] {
            let (mut mean, at) = (Moments::default(), [1.0, 0.2]);
            for _ in 0..400_000 {
                let d = random.cosine_around([0.0, 0.0, 1.0]);
                let passes = (0..2).all(|i| (at[i] + 3.0 * d[i] / d[2]).abs() < 0.5);
                let pane = opening.glazing.map_or(1.0, |pane| pane.transmittance(d[2], Polarisation::Reset));
                let luminance = pane * sky.luminance(d[2]);
                mean.add(if passes { std::f64::consts::PI * luminance } else { 0.0 });
            }
            mean.must_agree("illuminance", opening.illuminance(sky, at[0], at[1]));
        }
    }

    #[test]
    fn the_scenes_carry_the_parameters() {
        let cases = cases();
        mitsuba::assert_balanced(&cases[4].xml);
        assert!(cases[4].xml.contains("value=\"overcast\"") && cases[4].xml.contains("thindielectric"));
        // On the axis 3.41 % of 10 000 lx, a little less over the meter.
        let reading = cases[0].expected[0].value[0];
        assert!((340.0..341.06).contains(&reading), "{reading}");
    }
}
