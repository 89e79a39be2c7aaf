//! What the floor's reflection can add.

use std::f64::consts::PI;

use super::BallLens;
use super::flux::integrate_where;

impl BallLens {
    /// Share of the flux reflected by the floor on the axis that the ball sends back to the floor, all orders.
    ///
    /// A ray that leaves the axis point at the angle `alpha` passes the centre at `b = H sin alpha` and leaves the ball
    /// turned by the deviation; it returns if it then points down. Good to 1e-6. Off the axis the share is smaller (tested
    /// by random rays, not proven).
    pub fn floor_return(&self) -> f64 {
        let h = self.height_in_radii();
        let share = |order: super::ray_map::Order| {
            let down = |i: f64| (i.sin() / h).asin() - order.deviation(i);
            let mut ends = vec![0.0, 0.5 * PI];
            ends.extend(order.zeros(|i| down(i).cos()));
            integrate_where(order, |i| down(i).cos() < 0.0, &mut ends)
        };
        self.orders().map(share).sum::<f64>() / (h * h)
    }

    /// A bound on what a floor of this reflectance adds by its own reflection to the flux within `radius` (m).
    ///
    /// With `q = reflectance * floor_return`: the floor's irradiance is at most 1 from the beam, of which by reciprocity at
    /// most `q` comes back per bounce and area, and at most the ball's share of the beam, `pi R^2`, of which at most `q`
    /// comes back per bounce; so `q / (1 - q) pi (radius^2 + R^2)`.
    pub fn floor_return_bound(&self, radius: f64, reflectance: f64) -> f64 {
        let q = reflectance * self.floor_return();
        q / (1.0 - q) * PI * (radius * radius + self.radius * self.radius)
    }
}
