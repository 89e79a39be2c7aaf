//! What a gather over a disc reads of the caustic.

use std::f64::consts::PI;

use super::BallLens;

impl BallLens {
    /// Mean irradiance over the disc of radius `blur` (m) around a point of the floor at distance `r` (m) from the axis: what a
    /// density estimate over that disc reads on average. The light that passes the ball is left out; the whole disc must lie
    /// in its shadow.
    ///
    /// Each ray that lands at the distance `x` stands for a ring of rays, of which the part of the circle of radius `x` inside the disc
    /// counts. 10 000 rays for each of 20 orders; 1e-3 of the value.
    pub fn blurred_irradiance(&self, r: f64, blur: f64) -> f64 {
        const RAYS: u32 = 10_000;
        let inside = |x: f64| {
            let cosine = (x * x + r * r - blur * blur) / (2.0 * x * r);
            cosine.clamp(-1.0, 1.0).acos() / PI
        };
        let mut sum = 0.0;
        for order in self.orders().take(21) {
            for ray in 0..RAYS {
                let i = 0.5 * PI * (f64::from(ray) + 0.5) / f64::from(RAYS);
                if let Some(x) = order.lands(i) {
                    sum += order.share(i) * (2.0 * i).sin() * inside(x.abs() * self.radius);
                }
            }
        }
        sum * 0.5 * PI / f64::from(RAYS) * (self.radius / blur).powi(2)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A small disc reads the irradiance, and rings of discs around the axis the flux.
    #[test]
    fn small_discs_read_the_irradiance() {
        let lens = BallLens::BENCHMARK;
        for r in [0.1, 0.2, 0.42] {
            let (got, want) = (lens.blurred_irradiance(r, 0.004), lens.irradiance(r));
            assert!((got / want - 1.0).abs() < 5e-3, "{r}: {got} {want}");
        }
        let (got, want) = (lens.blurred_irradiance(1e-6, 0.15), lens.mean_irradiance(0.0, 0.15));
        assert!((got / want - 1.0).abs() < 1e-3, "a disc around the axis: {got} {want}");
        // Over the fold, where the irradiance is infinite, the mean over the disc by rings of equal width.
        let (r, blur, rings) = (0.3258, 0.03, 240);
        let radius = |k: i32| r - blur + 2.0 * blur * f64::from(k) / f64::from(rings);
        let ring = |k: i32| {
            let s: f64 = 0.5 * (radius(k) + radius(k + 1));
            let share = ((s * s + r * r - blur * blur) / (2.0 * s * r)).clamp(-1.0, 1.0).acos() / PI;
            share * (radius(k + 1).powi(2) - radius(k).powi(2)) * lens.mean_irradiance(radius(k), radius(k + 1))
        };
        let by_rings = (0..rings).map(ring).sum::<f64>() / (blur * blur);
        assert!((lens.blurred_irradiance(r, blur) / by_rings - 1.0).abs() < 2e-3, "{by_rings}");
    }
}
