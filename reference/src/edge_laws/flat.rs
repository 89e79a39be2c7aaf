//! Flat patches: quadrant, strip, rectangle.

use std::f64::consts::PI;

use super::half_plane;

/// Share of the unit disc inside a quadrant, the query at signed distances `a`, `b` (in search radii) from its two edges,
/// positive on the lit side: the free corner. Exact; 1/4 at the corner itself.
///
/// Inclusion and exclusion of the two segments; what both cut off is the part of the disc beyond the corner, of area
/// `[pi/2 - asin a - asin b]/2 + a b - [a sqrt(1 - a^2) + b sqrt(1 - b^2)]/2` if the corner is inside the disc.
pub fn corner(a: f64, b: f64) -> f64 {
    // Beyond an edge the quadrant is the half-plane less its mirror image.
    if a < 0.0 {
        return half_plane(b) - corner(-a, b);
    }
    if b < 0.0 {
        return half_plane(a) - corner(a, -b);
    }
    let beyond = if a * a + b * b < 1.0 {
        let angle = 0.5 * PI - a.asin() - b.asin();
        let triangles = a * (1.0 - a * a).sqrt() + b * (1.0 - b * b).sqrt();
        (0.5 * angle + a * b - 0.5 * triangles) / PI
    } else {
        0.0
    };
    half_plane(a) + half_plane(b) - 1.0 + beyond
}

/// Share of the unit disc inside a strip of this `width`, the query at distance `d` from one of its edges, both in search
/// radii: the two segments never overlap. Exact.
pub fn strip(width: f64, d: f64) -> f64 {
    half_plane(d) + half_plane(width - d) - 1.0
}

/// Mean of the estimate over a whole lit rectangle of sides `a`, `b`, search radius `r`, all in the same unit:
/// `1 - 4 r (a + b) / (3 pi a b) + r^2 / (2 pi a b)`, the share of the flux that gathering without area correction finds.
/// Exact for `r <= min(a, b)`: the set covariance `(a - |x|)(b - |y|)` averaged over the disc.
///
/// # Panics
/// If `r > min(a, b)`.
pub fn rectangle_mean(a: f64, b: f64, r: f64) -> f64 {
    assert!(r <= a.min(b), "radius {r} exceeds the rectangle {a} x {b}");
    1.0 - 4.0 * r * (a + b) / (3.0 * PI * a * b) + r * r / (2.0 * PI * a * b)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::edge_laws::polar;
    use crate::random::{Moments, Random};

    #[test]
    fn quadrants_agree_with_polar_integration() {
        for a in [0.0, 0.25, 0.5, 0.9, 1.2] {
            for b in [0.0, 0.3, 0.65, 0.8, 1.0] {
                let brute = polar::area(&[(0.0, a), (0.5 * PI, b)]);
                assert!((corner(a, b) - brute).abs() < 1e-8, "{a} {b}: {} {brute}", corner(a, b));
            }
        }
        assert!((corner(0.25, 0.75) - 0.60235029).abs() < 1e-8);
    }

    /// The four quadrants that meet in a point cover the plane, on whichever side the query is.
    #[test]
    fn four_quadrants_make_a_plane() {
        for (a, b) in [(0.3, 0.4), (-0.2, 0.9), (-0.5, -0.1), (1.5, -0.2)] {
            let sum = corner(a, b) + corner(-a, b) + corner(a, -b) + corner(-a, -b);
            assert!((sum - 1.0).abs() < 1e-14, "{a} {b}");
            assert!(corner(a, b) >= 0.0);
        }
    }

    #[test]
    fn strips_agree_with_polar_integration() {
        for (width, d) in [(0.5, 0.125), (1.0, 0.25), (1.5, 0.75), (3.0, 1.0)] {
            let brute = polar::area(&[(0.0, d), (PI, width - d)]);
            assert!((strip(width, d) - brute).abs() < 1e-8, "{width} {d}");
        }
    }

    /// Two comparisons at 4.5 standard errors.
    #[test]
    fn the_mean_over_a_rectangle_agrees_with_random_pairs() {
        let mut random = Random::new(4);
        for (a, b, r) in [(1.0, 1.0, 0.2), (4.0, 0.7, 0.5)] {
            let mut share = Moments::default();
            for _ in 0..400_000 {
                let (x, y) = (random.between(0.0, a), random.between(0.0, b));
                let (s, phi) = (r * random.unit().sqrt(), random.between(0.0, 2.0 * PI));
                let (u, v) = (x + s * phi.cos(), y + s * phi.sin());
                share.add(f64::from((0.0..a).contains(&u) && (0.0..b).contains(&v)));
            }
            share.must_agree("rectangle mean", rectangle_mean(a, b, r));
        }
        assert!((rectangle_mean(2.0, 1.0, 0.1) - 0.9371338).abs() < 1e-8);
    }
}
