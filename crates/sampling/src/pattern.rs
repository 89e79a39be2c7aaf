//! How the intensity of a lamp at a point depends on direction.

use std::f64::consts::{PI, TAU};

use glam::DVec3;
use photonlab_scene::Pattern;

use crate::{Stream, tabulated, turn, warp};

/// Intensity in a direction over the lamp's stated intensity.
pub(crate) fn relative(pattern: &Pattern, direction: DVec3) -> f64 {
    match pattern {
        Pattern::Isotropic => 1.0,
        Pattern::Cosine { axis, exponent } => direction.dot(*axis).max(0.0).powf(*exponent),
        Pattern::Spot { axis, beam, cutoff } => in_spot(direction.angle_between(*axis), *beam, *cutoff),
        Pattern::Table { table, to_world } => {
            table.intensity_along(to_world.transpose() * direction) / table.brightest()
        }
    }
}

/// Mitsuba's falloff: even inside the beam, then linear in the angle down to the cutoff.
fn in_spot(angle: f64, beam: f64, cutoff: f64) -> f64 {
    if angle >= cutoff {
        0.0
    } else if angle <= beam {
        1.0
    } else {
        (cutoff - angle) / (cutoff - beam)
    }
}

/// Its integral over all directions, sr.
pub(crate) fn integral(pattern: &Pattern) -> f64 {
    match pattern {
        Pattern::Isotropic => 4.0 * PI,
        Pattern::Cosine { exponent, .. } => TAU / (exponent + 1.0),
        Pattern::Spot { beam, cutoff, .. } => {
            let even = 1.0 - beam.cos();
            let falling = if cutoff > beam {
                // Of (cutoff - t) sin t from beam to cutoff.
                ((cutoff - beam) * beam.cos() - (cutoff.sin() - beam.sin())) / (cutoff - beam)
            } else {
                0.0
            };
            TAU * (even + falling)
        }
        Pattern::Table { table, .. } => table.flux() / table.brightest(),
    }
}

/// A direction in proportion to the intensity: its density per solid angle is [`relative`] over [`integral`].
pub(crate) fn draw(pattern: &Pattern, stream: &mut Stream) -> DVec3 {
    match pattern {
        Pattern::Isotropic => warp::square_to_uniform_sphere(stream.next2()),
        Pattern::Cosine { axis, exponent } => {
            let [xi, turn] = stream.next2();
            let cos = xi.powf(1.0 / (exponent + 1.0));
            let sin = (1.0 - cos * cos).max(0.0).sqrt();
            let (s, c) = turn::sin_cos(turn);
            warp::Frame::around(*axis).world(DVec3::new(sin * c, sin * s, cos))
        }
        Pattern::Spot { axis, beam, cutoff } => loop {
            let direction = warp::square_to_uniform_cone(stream.next2(), *axis, 1.0 - cutoff.cos());
            // Even over the cone, kept in proportion to the falloff.
            if cutoff == beam || stream.next() < in_spot(direction.angle_between(*axis), *beam, *cutoff) {
                return direction;
            }
        },
        Pattern::Table { table, to_world } => *to_world * tabulated::draw(table, stream),
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use glam::DMat3;
    use photonlab_scene::luminaire::{IntensityTable, Symmetry};

    use super::*;
    use crate::Purpose;

    /// A tilted street lamp: two wings, dark above 100 degrees.
    fn table() -> Pattern {
        let gamma = [0.0, 20.0, 55.0, 70.0, 100.0];
        let intensity = [[90.0, 80.0, 60.0, 20.0, 0.0], [90.0, 110.0, 300.0, 120.0, 5.0], [90.0, 70.0, 30.0, 0.0, 0.0]];
        let table = IntensityTable::new(Symmetry::AboutC90, &[-90.0, 10.0, 90.0], &gamma, intensity.as_flattened());
        let to_world = DMat3::from_euler(glam::EulerRot::XYZ, 0.3, -0.2, 1.0);
        Pattern::Table { table: Arc::new(table.expect("a table")), to_world }
    }

    fn patterns() -> [Pattern; 6] {
        let axis = DVec3::new(0.6, 0.0, -0.8);
        [
            table(),
            Pattern::Isotropic,
            Pattern::Cosine { axis, exponent: 1.0 },
            Pattern::Cosine { axis, exponent: 12.5 },
            Pattern::Spot { axis, beam: 0.2, cutoff: 0.5 },
            Pattern::Spot { axis, beam: 0.3, cutoff: 0.3 },
        ]
    }

    #[test]
    fn integrals_agree_with_quadrature() {
        for pattern in patterns() {
            let (rings, turns) = (4000, 200);
            let mut sum = 0.0;
            for ring in 0..rings {
                let cos = 1.0 - 2.0 * (f64::from(ring) + 0.5) / f64::from(rings);
                let sin = (1.0 - cos * cos).sqrt();
                for turn in 0..turns {
                    let phi = TAU * (f64::from(turn) + 0.5) / f64::from(turns);
                    sum += relative(&pattern, DVec3::new(sin * phi.cos(), sin * phi.sin(), cos));
                }
            }
            let quadrature = sum * 4.0 * PI / f64::from(rings * turns);
            assert!((integral(&pattern) / quadrature - 1.0).abs() < 4e-3, "{pattern:?} {quadrature}");
        }
    }

    /// Mean cosine to the axis and mean of a second function of the draws against uniform directions weighted by the
    /// pattern: 12 comparisons at |z| < 5, false alarm 7e-6 in all.
    #[test]
    fn draws_follow_the_intensity() {
        let mut stream = Stream::new(23, Purpose::Synthetic, 0, 0);
        let n = 400_000;
        for pattern in patterns() {
            for test in [|d: DVec3| d.dot(DVec3::new(0.6, 0.0, -0.8)), |d: DVec3| d.x * d.x + 0.3 * d.y] {
                let (mut drawn, mut weighed) = ([0.0; 2], [0.0; 2]);
                for _ in 0..n {
                    let x = test(draw(&pattern, &mut stream));
                    let d = warp::square_to_uniform_sphere(stream.next2());
                    let y = test(d) * relative(&pattern, d) * 4.0 * PI / integral(&pattern);
                    drawn = [drawn[0] + x, drawn[1] + x * x];
                    weighed = [weighed[0] + y, weighed[1] + y * y];
                }
                let mean = |s: [f64; 2]| s[0] / f64::from(n);
                let error2 = |s: [f64; 2]| (s[1] / f64::from(n) - mean(s).powi(2)) / f64::from(n);
                let z = (mean(drawn) - mean(weighed)) / (error2(drawn) + error2(weighed)).sqrt();
                assert!(z.abs() < 5.0, "{pattern:?}: {} {}", mean(drawn), mean(weighed));
            }
        }
    }
}
