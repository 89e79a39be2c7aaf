//! What a disc makes of a wave.

use std::f64::consts::PI;

/// `2 J_1(t) / t`, the mean of `cos(t x)` over the unit disc. The Bessel function by its integral over the angle, whose trapezoids converge
/// faster than any power; good to 1e-12.
pub(crate) fn disc_response(t: f64) -> f64 {
    if t < 1e-4 {
        return 1.0 - t * t / 8.0;
    }
    let nodes = 40 + t as u32;
    let at = |i: u32| {
        let angle = PI * (f64::from(i) + 0.5) / f64::from(nodes);
        (angle - t * angle.sin()).cos()
    };
    2.0 * (0..nodes).map(at).sum::<f64>() / (f64::from(nodes) * t)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_response_is_the_catalogues() {
        for (t, h) in [(0.5, 0.96907383), (2.0, 0.57672481), (5.0, -0.13103166)] {
            assert!((disc_response(t) - h).abs() < 1e-8, "{t}");
        }
        assert!((disc_response(1.0001e-4) - disc_response(0.9999e-4)).abs() < 1e-11);
    }
}
