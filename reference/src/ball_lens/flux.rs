//! Flux and irradiance on the floor.

use std::f64::consts::PI;

use super::BallLens;
use super::ray_map::{Order, fresnel};
use crate::quadrature::Gauss;

/// Orders summed; the flux of all later ones is [`BallLens::order_remainder`].
const ORDERS: u32 = 60;

/// A circle on the floor where the map from rays to radii turns back: the irradiance is infinite on one side of it, like
/// one over the square root of the distance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fold {
    /// The order of the rays: 1 straight through, `p` with `p - 1` reflections inside.
    pub order: u32,
    /// Radius of the circle in metres.
    pub radius: f64,
}

impl BallLens {
    /// Flux on the floor within `radius` (m) of the axis, all orders and the light that passes the ball, in W or lm per
    /// unit of the beam's irradiance; the floor's own reflection left out.
    ///
    /// Precision: quadrature 1e-9, and at most [`BallLens::order_remainder`] is missing.
    pub fn flux_within(&self, radius: f64) -> f64 {
        let passing = (radius * radius - self.radius * self.radius).max(0.0);
        let through: f64 = self.orders().map(|order| self.order_flux(order, radius)).sum();
        PI * passing + through
    }

    /// Mean irradiance between two radii (m) on the floor, from [`BallLens::flux_within`].
    pub fn mean_irradiance(&self, inner: f64, outer: f64) -> f64 {
        (self.flux_within(outer) - self.flux_within(inner)) / (PI * (outer * outer - inner * inner))
    }

    /// Irradiance of the floor at distance `r > 0` (m) from the axis, per unit of the beam's: the sum over all rays that
    /// land there of their share times `b db / (r dr)`, plus 1 outside the ball's shadow.
    ///
    /// Infinite at a [`Fold`] and, for most heights, finite towards the axis; good to 1e-6 away from folds.
    pub fn irradiance(&self, r: f64) -> f64 {
        let rho = r / self.radius;
        let mut sum = if r > self.radius { 1.0 } else { 0.0 };
        for order in self.orders() {
            for side in [rho, -rho] {
                for i in order.zeros(|i| order.offset(i, side)) {
                    let cosine = order.deviation(i).cos();
                    if cosine > 0.0 {
                        let stretch = order.stretch(i).abs() / (cosine * cosine);
                        sum += order.share(i) * i.sin() * i.cos() / (rho * stretch);
                    }
                }
            }
        }
        sum
    }

    /// The folds of the first `orders` orders (from 1), within `reach` metres of the axis, by order.
    pub fn folds(&self, orders: u32, reach: f64) -> Vec<Fold> {
        let mut folds = Vec::new();
        for order in self.orders().skip(1).take(orders as usize) {
            for i in order.zeros(|i| order.stretch(i)) {
                let radius = order.lands(i).map(|x| x.abs() * self.radius);
                if let Some(radius) = radius.filter(|&radius| radius <= reach) {
                    folds.push(Fold { order: order.p, radius });
                }
            }
        }
        folds
    }

    /// Flux of all orders left out, wherever it goes: the integral of `(1 - F) F^60` over the ball's shadow; 4e-7 for the
    /// benchmark, where 0.785 fall on the ball.
    pub fn order_remainder(&self) -> f64 {
        let left = |i: f64| {
            let f = fresnel(i, self.index);
            (1.0 - f) * f.powi(ORDERS as i32) * i.sin() * i.cos()
        };
        2.0 * PI * self.radius * self.radius * Gauss::new(16).composite(0.0, 0.5 * PI, 400, left)
    }

    /// The orders that are summed.
    pub(super) fn orders(&self) -> impl Iterator<Item = Order> {
        let (n, h) = (self.index, self.height_in_radii());
        (0..=ORDERS).map(move |p| Order { p, n, h })
    }

    /// Flux of one order within `radius` metres: the integral of its share over the rays that land there.
    pub(super) fn order_flux(&self, order: Order, radius: f64) -> f64 {
        let rho = radius / self.radius;
        let lands = |i: f64| order.lands(i).is_some_and(|x| x.abs() < rho);
        let mut ends = vec![0.0, 0.5 * PI];
        ends.extend(order.zeros(|i| order.offset(i, rho)));
        ends.extend(order.zeros(|i| order.offset(i, -rho)));
        ends.extend(order.zeros(|i| order.deviation(i).cos()));
        let flux = integrate_where(order, lands, &mut ends);
        PI * self.radius * self.radius * flux
    }
}

/// The order's share, integrated over the part of the shadow (area `d sin^2 i`) where `keep` holds; it may change only at
/// `ends`.
pub(super) fn integrate_where(order: Order, keep: impl Fn(f64) -> bool, ends: &mut [f64]) -> f64 {
    let rule = Gauss::new(16);
    ends.sort_by(f64::total_cmp);
    let mut sum = 0.0;
    for pair in ends.windows(2) {
        if keep(0.5 * (pair[0] + pair[1])) {
            let pieces = 1.0 + ((pair[1] - pair[0]) * f64::from(order.p + 1) * 8.0).floor();
            let area = |i: f64| order.share(i) * 2.0 * i.sin() * i.cos();
            sum += rule.composite(pair[0], pair[1], pieces as usize, area);
        }
    }
    sum
}
