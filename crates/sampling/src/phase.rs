//! By which angle a medium scatters.

use std::f64::consts::PI;

use glam::DVec3;
use photonlab_scene::Phase;

use crate::{Stream, turn, warp};

/// Density per solid angle of scattering by an angle of this cosine, which is also the value of the phase function.
pub fn phase_pdf_solid_angle(phase: Phase, cosine: f64) -> f64 {
    match phase {
        Phase::Isotropic => 1.0 / (4.0 * PI),
        // Henyey and Greenstein 1941.
        Phase::HenyeyGreenstein(g) => {
            let base = 1.0 + g * g - 2.0 * g * cosine;
            (1.0 - g * g) / (4.0 * PI * base * base.sqrt())
        }
    }
}

/// Draws the direction into which light that travels along `direction` is scattered.
pub fn scatter(phase: Phase, direction: DVec3, stream: &mut Stream) -> DVec3 {
    let [xi, turn] = stream.next2();
    let cosine = match phase {
        Phase::Isotropic => return warp::square_to_uniform_sphere([xi, turn]),
        Phase::HenyeyGreenstein(g) => {
            let part = (1.0 - g * g) / (1.0 - g + 2.0 * g * xi);
            ((1.0 + g * g - part * part) / (2.0 * g)).clamp(-1.0, 1.0)
        }
    };
    let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
    let (x, y) = direction.any_orthonormal_pair();
    let (sin, cos) = turn::sin_cos(turn);
    (cosine * direction + sine * (cos * x + sin * y)).normalize()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Purpose;

    /// Legendre moments of the drawn cosine are g^l (catalogue F5), and those of the density too. 32 comparisons at |z| < 5.
    #[test]
    fn moments_are_powers_of_g() {
        let legendre = [
            |x: f64| x,
            |x: f64| 0.5 * (3.0 * x * x - 1.0),
            |x: f64| 0.5 * (5.0 * x * x * x - 3.0 * x),
            |x: f64| (35.0 * x.powi(4) - 30.0 * x * x + 3.0) / 8.0,
        ];
        let axis = DVec3::new(0.6, 0.0, -0.8);
        for g in [-0.5, 0.3, 0.75, 0.9] {
            let phase = Phase::HenyeyGreenstein(g);
            let mut stream = Stream::new(41, Purpose::Synthetic, 0, 0);
            let n = 200_000;
            let cosines: Vec<f64> = (0..n).map(|_| scatter(phase, axis, &mut stream).dot(axis)).collect();
            for (l, polynomial) in legendre.iter().enumerate() {
                let expected = f64::powi(g, l as i32 + 1);
                let mean = cosines.iter().map(|&x| polynomial(x)).sum::<f64>() / f64::from(n);
                let square = cosines.iter().map(|&x| polynomial(x).powi(2)).sum::<f64>() / f64::from(n);
                let error = ((square - mean * mean) / f64::from(n)).sqrt();
                assert!((mean - expected).abs() < 5.0 * error, "g {g}, l {}: {mean} for {expected}", l + 1);
                let steps = 200_000;
                let at = |i: i32| 2.0 * (f64::from(i) + 0.5) / f64::from(steps) - 1.0;
                let of_density: f64 = (0..steps)
                    .map(|i| polynomial(at(i)) * phase_pdf_solid_angle(phase, at(i)) * 4.0 * PI / f64::from(steps))
                    .sum();
                assert!((of_density - expected).abs() < 1e-6, "density, g {g}, l {}: {of_density}", l + 1);
            }
        }
    }
}
