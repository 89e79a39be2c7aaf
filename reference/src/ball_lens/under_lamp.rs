//! The ball under a disc lamp: irradiance of the floor by rays followed backwards.
//!
//! A ray from a point of the floor at the angle `alpha` from the line to the ball's centre, `D` away, passes that at
//! `b = D sin alpha`; each order leaves turned by its deviation, with the same `b`, and sees the lamp's radiance, times the order's share,
//! where it meets the lamp (radiance over the square of the index is constant along a ray, and both ends are in air). The
//! irradiance is the integral of that times the cosine over the ball's cone: 8000 midpoints in the angle of incidence, in the
//! azimuth by the ends of what meets the lamp; eight orders. 1e-3 of the value.

use std::f64::consts::PI;

use super::BallLens;
use crate::mitsuba::{self, Place};
use crate::out_of_range::{OutOfRange, require};
use crate::vector::{Vector, along, dot};

/// A disc around the axis that shines downwards evenly.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DiscLamp {
    /// Height over the floor (m), above the ball.
    pub height: f64,
    /// Radius (m).
    pub radius: f64,
    /// Radiance, in W/(m^2 sr) or cd/m^2.
    pub radiance: f64,
}

impl DiscLamp {
    pub(super) fn xml(&self) -> String {
        let place = Place::floor([0.0, 0.0, self.height], [self.radius; 2]).turned();
        let on_it = mitsuba::diffuse(&[0.0]) + &mitsuba::area_lamp(&[self.radiance]);
        mitsuba::flat("disk", "lamp", place, &on_it)
    }
}

impl BallLens {
    /// Irradiance of the floor at distance `x` (m) from the axis under a lamp, in W/m^2 or lx; an error unless the ball hides
    /// the whole lamp from that point.
    pub fn irradiance_under(&self, lamp: DiscLamp, x: f64) -> Result<f64, OutOfRange> {
        const INCIDENCES: u32 = 8000;
        let centre = [-x, 0.0, self.height];
        let distance = dot(centre, centre).sqrt();
        let axis = centre.map(|c| c / distance);
        for turn in 0..64 {
            let (sine, cosine) = (2.0 * PI * f64::from(turn) / 64.0).sin_cos();
            let to = [lamp.radius * cosine - x, lamp.radius * sine, lamp.height];
            let passes = (distance.powi(2) - dot(centre, to).powi(2) / dot(to, to)).sqrt();
            require(passes < self.radius, "x", x, "in the ball's full shadow")?;
        }
        let mut sum = 0.0;
        for incidence in 0..INCIDENCES {
            let i = 0.5 * PI * (f64::from(incidence) + 0.5) / f64::from(INCIDENCES);
            let b = self.radius * i.sin();
            let alpha = (b / distance).asin();
            // The integral of the cosine over the azimuth from 0 to phi.
            let cosines = |phi: f64| alpha.cos() * axis[2] * phi - alpha.sin() * axis[0] * phi.sin();
            for order in self.orders().take(8) {
                let angle = alpha - order.deviation(i);
                let seen = lamp.seen(centre, axis, angle, b).map(cosines);
                let solid_angle = b * self.radius * i.cos() / (distance * distance * alpha.cos());
                sum += 2.0 * order.share(i) * (seen[1] - seen[0]) * solid_angle;
            }
        }
        Ok(lamp.radiance * sum * 0.5 * PI / f64::from(INCIDENCES))
    }
}

impl DiscLamp {
    /// From which azimuth to which, in `[0, pi]`, rays at this angle to the `axis` of their cone, passing the ball's `centre` at `b`,
    /// meet the lamp; all places relative to the point of the floor. By symmetry the distance from the lamp's middle grows or
    /// falls all the way from 0 to pi.
    fn seen(&self, centre: Vector, axis: Vector, angle: f64, b: f64) -> [f64; 2] {
        let aside = [axis[2], 0.0, -axis[0]];
        let meets = |phi: f64| {
            let lateral = [phi.cos() * aside[0], phi.sin(), phi.cos() * aside[2]];
            let turned = |angle: f64| along(axis.map(|c| angle.cos() * c), angle.sin(), lateral);
            let (out, from) = (turned(angle), along(centre, b, turned(angle + 0.5 * PI)));
            let at = along(from, (self.height - from[2]) / out[2], out);
            out[2] > 0.0 && (at[0] - centre[0]).hypot(at[1]) < self.radius
        };
        let (first, last) = (meets(0.0), meets(PI));
        let (mut before, mut after) = (0.0, PI);
        for _ in 0..if first == last { 0 } else { 40 } {
            let middle = 0.5 * (before + after);
            if meets(middle) == first { before = middle } else { after = middle }
        }
        match (first, last) {
            (true, true) => [0.0, PI],
            (false, false) => [0.0; 2],
            (true, false) => [0.0, before],
            (false, true) => [after, PI],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::checks::through_ball;
    use super::*;
    use crate::random::{Moments, Random};

    /// From very far a small lamp is parallel light.
    #[test]
    fn a_far_lamp_is_parallel_light() {
        let (lens, height, radius) = (BallLens::BENCHMARK, 2000.0f64, 12.0f64);
        let lamp = DiscLamp { height, radius, radiance: height * height / (PI * radius * radius) };
        for x in [0.1, 0.2, 0.42] {
            let (got, want) = (lens.irradiance_under(lamp, x).expect("hidden"), lens.irradiance(x));
            assert!((got / want - 1.0).abs() < 0.01, "{x}: {got} {want}");
        }
        assert!(lens.irradiance_under(lamp, 0.6).is_err(), "beside the ball");
    }

    /// Directions drawn at points of the floor and followed through the ball: 3 comparisons at 4.5 standard errors.
    #[test]
    fn drawn_directions_agree() {
        let (lens, mut random) = (BallLens::BENCHMARK, Random::new(86));
        let lamp = DiscLamp { height: 3.0, radius: 0.2, radiance: 1.0 };
        for x in [0.05, 0.2, 0.35] {
            let mut found = Moments::default();
            for _ in 0..400_000 {
                let d = random.cosine_around([0.0, 0.0, 1.0]);
                let start = [x / lens.radius, 0.0, -lens.height_in_radii()];
                let (p, d) = through_ball(lens.index, start, d, &mut random);
                let up = (lamp.height - lens.height) / lens.radius;
                let at = along(p, (up - p[2]) / d[2], d);
                let meets = d[2] > 0.0 && at[0].hypot(at[1]) * lens.radius < lamp.radius;
                found.add(if meets { PI * lamp.radiance } else { 0.0 });
            }
            found.must_agree(&format!("at {x}"), lens.irradiance_under(lamp, x).expect("hidden"));
        }
    }

    /// On the axis the azimuth does not matter: a quadrature in the angle alone.
    #[test]
    fn on_the_axis_one_angle_is_enough() {
        let (lens, lamp) = (BallLens::BENCHMARK, DiscLamp { height: 3.0, radius: 0.2, radiance: 1.0 });
        let steps = 400_000;
        let one = |step: i32| -> f64 {
            let alpha = (f64::from(step) + 0.5) / f64::from(steps) * (lens.radius / lens.height).asin();
            let i = (lens.height * alpha.sin() / lens.radius).asin();
            let seen = lens.orders().take(8).map(|order| {
                // Away from the axis at the height of the lamp, in the plane of the ray.
                let angle = alpha - order.deviation(i);
                let (r, z) = (lens.radius * i.sin() * angle.cos(), lens.height - lens.radius * i.sin() * angle.sin());
                let at = r + (lamp.height - z) * angle.tan();
                if angle.cos() > 0.0 && at.abs() < lamp.radius { order.share(i) } else { 0.0 }
            });
            seen.sum::<f64>() * 2.0 * PI * alpha.sin() * alpha.cos()
        };
        let want = (0..steps).map(one).sum::<f64>() * (lens.radius / lens.height).asin() / f64::from(steps);
        let got = lens.irradiance_under(lamp, 0.0).expect("hidden");
        assert!((got / want - 1.0).abs() < 1e-3, "{got} {want}");
    }
}
