//! Fresnel's formulae for smooth interfaces, unpolarised light.

use glam::DVec3;

/// Share of unpolarised light that a smooth interface reflects, and the cosine of the refracted ray (zero under total
/// reflection). `cosine` is that of the incident ray, `relative_index` the far side's index over the near side's.
pub fn fresnel_dielectric(cosine: f64, relative_index: f64) -> (f64, f64) {
    let sine2_beyond = (1.0 - cosine * cosine).max(0.0) / (relative_index * relative_index);
    if sine2_beyond >= 1.0 {
        return (1.0, 0.0);
    }
    let beyond = (1.0 - sine2_beyond).sqrt();
    let s = (cosine - relative_index * beyond) / (cosine + relative_index * beyond);
    let p = (relative_index * cosine - beyond) / (relative_index * cosine + beyond);
    (0.5 * (s * s + p * p), beyond)
}

/// Share of unpolarised light that a metal of complex index `eta` - i `k` (relative to the medium before it) reflects at
/// an incident cosine (Born and Wolf, section 14.2).
pub fn fresnel_conductor(cosine: f64, eta: f64, k: f64) -> f64 {
    let cosine2 = cosine * cosine;
    let sine2 = (1.0 - cosine2).max(0.0);
    let t0 = eta * eta - k * k - sine2;
    let a2b2 = (t0 * t0 + 4.0 * eta * eta * k * k).sqrt();
    let a = (0.5 * (a2b2 + t0)).max(0.0).sqrt();
    let s = ((a2b2 + cosine2) - 2.0 * a * cosine) / ((a2b2 + cosine2) + 2.0 * a * cosine);
    let t3 = 2.0 * a * cosine * sine2;
    let t4 = a2b2 * cosine2 + sine2 * sine2;
    let p = if t4 + t3 > 0.0 { s * (t4 - t3) / (t4 + t3) } else { s };
    0.5 * (s + p)
}

/// Share of diffuse light that an interface reflects: the mean of [`fresnel_dielectric`] weighted by the cosine. In closed
/// form above one (Egan and Hilgeman, "Optical Properties of Inhomogeneous Materials", 1979); below one by the law that
/// radiance over squared index passes both ways alike: 1 - f(1/n) = (1 - f(n)) / n^2.
pub fn diffuse_fresnel(relative_index: f64) -> f64 {
    let n = relative_index;
    if n < 1.0 {
        return 1.0 - n * n * (1.0 - diffuse_fresnel(1.0 / n));
    }
    if n - 1.0 < 1e-2 {
        return diffuse_fresnel_by_quadrature(n);
    }
    let (n2, n4) = (n * n, n.powi(4));
    0.5 + (n - 1.0) * (3.0 * n + 1.0) / (6.0 * (n + 1.0).powi(2))
        + n2 * (n2 - 1.0).powi(2) / (n2 + 1.0).powi(3) * ((n - 1.0) / (n + 1.0)).ln()
        - 2.0 * n * n2 * (n2 + 2.0 * n - 1.0) / ((n2 + 1.0) * (n4 - 1.0))
        + 8.0 * n4 * (n4 + 1.0) / ((n2 + 1.0) * (n4 - 1.0).powi(2)) * n.ln()
}

/// The same by the midpoint rule in the cosine: the closed form loses its digits near one.
fn diffuse_fresnel_by_quadrature(relative_index: f64) -> f64 {
    let steps = 2000;
    let at = |i: i32| (f64::from(i) + 0.5) / f64::from(steps);
    // The square bunches the points where light grazes and the share rises steeply.
    (0..steps)
        .map(|i| at(i).powi(2))
        .zip(0..)
        .map(|(c, i)| 4.0 * at(i) * c * fresnel_dielectric(c, relative_index).0)
        .sum::<f64>()
        / f64::from(steps)
}

/// The ray that an interface refracts, given the incident ray's direction, the normal on its side and both cosines.
pub(crate) fn refracted(
    direction: DVec3,
    normal: DVec3,
    cosine: f64,
    cosine_beyond: f64,
    relative_index: f64,
) -> DVec3 {
    ((direction + cosine * normal) / relative_index - cosine_beyond * normal).normalize()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fresnel_at_known_angles() {
        let (normal, _) = fresnel_dielectric(1.0, 1.5);
        assert!((normal - 0.04).abs() < 1e-12);
        // At Brewster's angle only the s component is reflected: ((n^2 - 1) / (n^2 + 1))^2 / 2.
        let brewster = (1.5f64).atan().cos();
        let (share, _) = fresnel_dielectric(brewster, 1.5);
        assert!((share - 0.5 * (1.25f64 / 3.25).powi(2)).abs() < 1e-12);
        assert_eq!(fresnel_dielectric(0.5, 1.0 / 1.5).0, 1.0);
        assert_eq!(fresnel_dielectric(0.0, 1.5).0, 1.0);
    }

    #[test]
    fn fresnel_is_the_same_from_both_sides() {
        for i in 1..100 {
            let cosine = f64::from(i) / 100.0;
            let (share, beyond) = fresnel_dielectric(cosine, 1.5);
            let (back, cosine_back) = fresnel_dielectric(beyond, 1.0 / 1.5);
            assert!((share - back).abs() < 1e-12 && (cosine_back - cosine).abs() < 1e-12);
        }
    }

    #[test]
    fn a_metal_without_absorption_is_glass_and_one_without_index_reflects_all() {
        for i in 0..=50 {
            let cosine = f64::from(i) / 50.0;
            let glass = fresnel_dielectric(cosine, 1.5).0;
            assert!((fresnel_conductor(cosine, 1.5, 0.0) - glass).abs() < 1e-12);
            assert!((fresnel_conductor(cosine, 0.0, 1.0) - 1.0).abs() < 1e-12);
        }
        // Normal incidence: ((n - 1)^2 + k^2) / ((n + 1)^2 + k^2).
        let (eta, k) = (0.2, 3.9);
        let normal = ((eta - 1.0f64).powi(2) + k * k) / ((eta + 1.0f64).powi(2) + k * k);
        assert!((fresnel_conductor(1.0, eta, k) - normal).abs() < 1e-12);
    }

    #[test]
    fn diffuse_share_agrees_with_quadrature() {
        for n in [1.005, 1.02, 1.33, 1.5, 2.4] {
            let quadrature = diffuse_fresnel_by_quadrature(n);
            assert!((diffuse_fresnel(n) - quadrature).abs() < 2e-6, "{n}: {} {quadrature}", diffuse_fresnel(n));
        }
        let inside = diffuse_fresnel_by_quadrature(1.0 / 1.5);
        assert!((diffuse_fresnel(1.0 / 1.5) - inside).abs() < 1e-4);
    }
}
