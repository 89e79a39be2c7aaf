//! From the angle of incidence on the ball to the place on the floor.

use std::f64::consts::PI;

/// Unpolarised reflectance of a smooth interface from vacuum into index `n`, `i` the angle of incidence in `[0, pi/2]`.
pub(super) fn fresnel(i: f64, n: f64) -> f64 {
    let (sine, cosine) = i.sin_cos();
    let inside = (n * n - sine * sine).sqrt();
    let s = (cosine - inside) / (cosine + inside);
    let p = (n * n * cosine - inside) / (n * n * cosine + inside);
    0.5 * (s * s + p * p)
}

/// One order of the ball's rays, as functions of the angle of incidence `i` in `[0, pi/2]`; lengths in ball radii.
#[derive(Clone, Copy)]
pub(super) struct Order {
    /// 0 reflected outside, `p` refracted in and out with `p - 1` reflections inside.
    pub(super) p: u32,
    /// Refractive index of the ball.
    pub(super) n: f64,
    /// Height of the centre above the floor.
    pub(super) h: f64,
}

impl Order {
    /// Share of the incident flux.
    pub(super) fn share(&self, i: f64) -> f64 {
        let f = fresnel(i, self.n);
        if self.p == 0 { f } else { (1.0 - f).powi(2) * f.powi(self.p as i32 - 1) }
    }

    /// Angle by which the ray is turned towards the axis.
    pub(super) fn deviation(&self, i: f64) -> f64 {
        let p = f64::from(self.p);
        2.0 * i - 2.0 * p * (i.sin() / self.n).asin() + (p - 1.0) * PI
    }

    /// Derivative of the deviation.
    fn deviation_slope(&self, i: f64) -> f64 {
        let sine = i.sin() / self.n;
        2.0 - 2.0 * f64::from(self.p) * i.cos() / (self.n * (1.0 - sine * sine).sqrt())
    }

    /// Signed distance from the axis on the floor, if the ray comes down.
    pub(super) fn lands(&self, i: f64) -> Option<f64> {
        let (sine, cosine) = self.deviation(i).sin_cos();
        (cosine > 0.0).then(|| (i.sin() - self.h * sine) / cosine)
    }

    /// `(x - radius) cos theta`: zero where the ray lands at the signed distance `radius`, and smooth everywhere.
    pub(super) fn offset(&self, i: f64, radius: f64) -> f64 {
        let (sine, cosine) = self.deviation(i).sin_cos();
        i.sin() - self.h * sine - radius * cosine
    }

    /// `dx/di cos^2 theta`: zero at a fold of the caustic, and smooth everywhere.
    pub(super) fn stretch(&self, i: f64) -> f64 {
        let (sine, cosine) = self.deviation(i).sin_cos();
        i.cos() * cosine + (i.sin() * sine - self.h) * self.deviation_slope(i)
    }

    /// Zeros in `(0, pi/2)` of a function that oscillates no faster than the deviation, ascending.
    pub(super) fn zeros(&self, f: impl Fn(f64) -> f64) -> Vec<f64> {
        let steps = 400 + 60 * self.p;
        let at = |k: u32| 0.5 * PI * f64::from(k) / f64::from(steps);
        let mut before = f(0.0);
        let mut zeros = Vec::new();
        for k in 1..=steps {
            let here = f(at(k));
            if (before < 0.0) != (here < 0.0) {
                zeros.push(bisect(&f, at(k - 1), at(k)));
            }
            before = here;
        }
        zeros
    }
}

fn bisect(f: impl Fn(f64) -> f64, mut a: f64, mut b: f64) -> f64 {
    let negative = f(a) < 0.0;
    for _ in 0..60 {
        let middle = 0.5 * (a + b);
        if (f(middle) < 0.0) == negative { a = middle } else { b = middle }
    }
    0.5 * (a + b)
}
