//! Flux in discs around the axis: the catalogue's E2.

use std::f64::consts::PI;

use super::BallLens;
use super::ray_map::fresnel;
use crate::catalogue::{Case, Draft, Reads};
use crate::mitsuba::{self, Place};
use crate::quadrature::Gauss;

impl BallLens {
    /// Flux straight through the ball (order 1 alone) within `radius` (m) of the axis, in W or lm per unit of the beam's
    /// irradiance. Quadrature, 1e-9.
    pub fn straight_flux_within(&self, radius: f64) -> f64 {
        self.orders().skip(1).take(1).map(|order| self.order_flux(order, radius)).sum()
    }

    /// Share of the light on the ball that leaves it straight through, whatever its direction.
    pub fn straight_share(&self) -> f64 {
        let through = |i: f64| (1.0 - fresnel(i, self.index)).powi(2) * (2.0 * i).sin();
        Gauss::new(16).composite(0.0, 0.5 * PI, 40, through)
    }

    /// The ball in the beam over a black disc of this radius (m) that reads the flux of all orders.
    pub fn flux_case(&self, radius: f64) -> Case {
        let ball =
            mitsuba::sphere("ball", [0.0, 0.0, self.height], self.radius, false, &mitsuba::dielectric(self.index));
        let mut draft = Draft::with(mitsuba::parallel_light([0.0, 0.0, -1.0], &[1.0]) + &ball);
        let place = Place::floor([0.0; 3], [radius; 2]);
        let uncertainty = self.order_remainder() + 1e-8;
        draft.receiver(Reads::Flux, "disk", place, self.flux_within(radius), uncertainty);
        draft.case(format!("screen at {} radii, disc of {radius} m", self.height_in_radii()))
    }
}

/// The catalogue's E2: radius 1 m, index 1.5, four screens, three discs on each.
pub fn cases() -> Vec<Case> {
    let lens = |height| BallLens { radius: 1.0, index: 1.5, height };
    let screens = [1.2, 1.5, 2.0, 3.0].map(lens).into_iter();
    screens.flat_map(|lens| [0.1, 0.3, 0.8].map(|radius| lens.flux_case(radius))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Catalogue E2: distance of the screen, then the flux within 0.02, 0.1, 0.3 and 0.8.
    #[test]
    fn catalogue_values() {
        for (height, values) in [
            (1.2, [0.26164446, 2.2054561, 2.4736157, 2.5974845]),
            (1.5, [0.46465292, 1.172183, 1.9082241, 2.4324496]),
            (2.0, [0.010324396, 0.21384871, 0.94716278, 1.9355209]),
            (3.0, [0.0011573967, 0.028511329, 0.22953871, 0.99689039]),
        ] {
            let lens = BallLens::new(1.0, 1.5, height).expect("valid");
            for (radius, want) in [0.02, 0.1, 0.3, 0.8].into_iter().zip(values) {
                let got = lens.straight_flux_within(radius);
                // The table prints eight digits.
                assert!((got / want - 1.0).abs() < 5e-8, "{height} {radius}: {got} {want}");
            }
            assert!((lens.straight_share() - 0.8355444).abs() < 1e-7, "{}", lens.straight_share());
        }
    }

    /// All orders are more than the first, by what two reflections inside bring at most.
    #[test]
    fn the_scene_reads_all_orders() {
        let lens = BallLens::new(1.0, 1.5, 2.0).expect("valid");
        let (case, straight) = (lens.flux_case(0.8), lens.straight_flux_within(0.8));
        let more = case.expected[0].value[0] - straight;
        assert!(more > 0.0 && more < 0.02 * straight, "{more}");
        mitsuba::assert_balanced(&case.xml);
    }
}
