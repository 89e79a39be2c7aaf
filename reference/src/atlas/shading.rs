//! Photons on a surface whose shading normal is not its own.

/// Reading over the truth if photons are flux per area of the surface itself but the light is asked for by the shading normal: parallel
/// light at the angle `incidence` from the surface's normal, the shading normal tilted by `tilt` towards it (radians): `cos i / cos (i - tilt)`.
/// Exact (Veach, "Robust Monte Carlo Methods for Light Transport Simulation", 1997, section 5.3).
pub fn without_factor(incidence: f64, tilt: f64) -> f64 {
    incidence.cos() / (incidence - tilt).cos()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// In vectors.
    #[test]
    fn vectors_agree() {
        for (i, tilt) in [(0.5, 0.3), (0.5, -0.6), (1.1, 0.9_f64)] {
            let (from, shading) = ([f64::sin(i), f64::cos(i)], [tilt.sin(), tilt.cos()]);
            let truth = from[0] * shading[0] + from[1] * shading[1];
            assert!((without_factor(i, tilt) - from[1] / truth).abs() < 1e-12);
        }
        assert_eq!(without_factor(0.4, 0.0), 1.0);
    }
}
