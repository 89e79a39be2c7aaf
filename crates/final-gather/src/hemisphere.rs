//! Rays over a hemisphere, one in each stratum, and how the irradiance that they find changes from place to place.

use std::f64::consts::{PI, TAU};

use glam::{DVec2, DVec3};
use photonlab_photometry::Colour;
use photonlab_sampling::warp::Frame;

/// Strata of equal cosine-weighted solid angle: rows by polar angle, columns by azimuth.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Strata {
    pub(crate) rows: u32,
    pub(crate) columns: u32,
}

/// What one stratum's ray found.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Found<const C: usize> {
    /// Radiance times pi: the irradiance, were all directions alike.
    pub(crate) irradiance: Colour<C>,
    /// To what it met, metres; may be infinite.
    pub(crate) distance: f64,
}

/// How irradiance changes: per radian of a turn of the normal around an axis and per metre along it, for the axes x, y and z.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Gradients<const C: usize> {
    pub(crate) turn: [Colour<C>; 3],
    pub(crate) shift: [Colour<C>; 3],
}

impl Strata {
    /// As many strata as there are rays, about as wide as high: pi times as many columns as rows, as far as the number can be divided.
    pub(crate) fn new(rays: u32) -> Self {
        let wanted = (f64::from(rays) / PI).sqrt();
        let off = |rows: &u32| (f64::from(*rows) / wanted).ln().abs();
        let divides = |rows: &u32| rays.is_multiple_of(*rows);
        let rows = (1..=rays).filter(divides).min_by(|a, b| off(a).total_cmp(&off(b))).unwrap_or(1);
        Self { rows, columns: rays / rows }
    }

    /// The direction of a stratum's ray, from two numbers.
    pub(crate) fn direction(&self, number: u32, xi: [f64; 2], frame: &Frame) -> DVec3 {
        let (row, column) = (number / self.columns, number % self.columns);
        let sine_squared = (f64::from(row) + xi[0]) / f64::from(self.rows);
        let azimuth = TAU * (f64::from(column) + xi[1]) / f64::from(self.columns);
        let across = sine_squared.sqrt() * DVec2::from_angle(azimuth);
        frame.world(across.extend((1.0 - sine_squared).max(0.0).sqrt()))
    }

    /// The stratum of a unit vector in the frame's axes; `None` below its horizon.
    pub(crate) fn number_of(&self, local: DVec3) -> Option<usize> {
        let row = (local.truncate().length_squared() * f64::from(self.rows)) as u32;
        let column = (local.truncate().to_angle().rem_euclid(TAU) / TAU * f64::from(self.columns)) as u32;
        let number = row.min(self.rows - 1) * self.columns + column.min(self.columns - 1);
        (local.z > 0.0).then_some(number as usize)
    }

    /// Gradients from the rays of all strata, in their order (Ward and Heckbert, "Irradiance gradients", 1992). A step to the side moves
    /// the border of two strata by the distance of what lies nearer; a turn towards a direction makes its cosine greater.
    pub(crate) fn gradients<const C: usize>(&self, found: &[Found<C>], frame: &Frame) -> Gradients<C> {
        let (rows, columns) = (self.rows as usize, self.columns as usize);
        let of = |row: usize, column: usize| found[row * columns + column];
        let step = |from: Found<C>, to: Found<C>| {
            let rise = (to.irradiance - from.irradiance) * (1.0 / PI);
            rise * (1.0 / to.distance.min(from.distance))
        };
        let sine = |row: usize| (row as f64 / rows as f64).sqrt();
        // The integral of the tangent over the squared sine, up to a row's border; and what directions over a column's width have of
        // that in its middle, on average.
        let below = |row: usize| {
            let sine = sine(row);
            sine.asin() - sine * (1.0 - sine * sine).max(0.0).sqrt()
        };
        let half_width = PI / columns as f64;
        let towards_middle = half_width.sin() / half_width;
        let mut gradients = Gradients { turn: [Colour::ZERO; 3], shift: [Colour::ZERO; 3] };
        for column in 0..columns {
            let middle = TAU * (column as f64 + 0.5) / columns as f64;
            let (along, across) = (around(frame, middle), around(frame, middle + 0.5 * PI));
            let edge = around(frame, TAU * column as f64 / columns as f64 + 0.5 * PI);
            let before = (column + columns - 1) % columns;
            let (mut outward, mut sideways, mut tilt) = (Colour::ZERO, Colour::ZERO, Colour::ZERO);
            for row in 0..rows {
                let here = of(row, column);
                if row > 0 {
                    let border = sine(row);
                    let weight = TAU / columns as f64 * border * (1.0 - border * border);
                    outward += step(of(row - 1, column), here) * weight;
                }
                sideways += step(of(row, before), here) * (sine(row + 1) - sine(row));
                tilt += here.irradiance * ((below(row + 1) - below(row)) / columns as f64);
            }
            let tilt = tilt * towards_middle;
            for axis in 0..3 {
                gradients.shift[axis] += outward * along[axis] + sideways * edge[axis];
                gradients.turn[axis] += tilt * across[axis];
            }
        }
        gradients
    }
}

/// The unit vector in the tangent plane at an azimuth.
fn around(frame: &Frame, azimuth: f64) -> DVec3 {
    frame.world(DVec2::from_angle(azimuth).extend(0.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Irradiance and gradients that 20 000 rays find under a plane at height `h` whose radiance is `radiance(x, y)`.
    fn under_a_plane(at: DVec3, normal: DVec3, radiance: impl Fn(f64, f64) -> f64) -> (f64, Gradients<1>) {
        let (h, strata, frame) = (2.0, Strata { rows: 80, columns: 250 }, Frame::around(normal));
        let found: Vec<Found<1>> = (0..20_000)
            .map(|number| {
                let direction = strata.direction(number, [0.5; 2], &frame);
                let distance = if direction.z > 0.0 { (h - at.z) / direction.z } else { f64::INFINITY };
                let met = at + distance * direction;
                let seen = if distance.is_finite() { radiance(met.x, met.y) } else { 0.0 };
                Found { irradiance: Colour([PI * seen]), distance }
            })
            .collect();
        let mean = found.iter().map(|one| one.irradiance.0[0]).sum::<f64>() / 20_000.0;
        (mean, strata.gradients(&found, &frame))
    }

    #[test]
    fn the_gradients_are_those_of_differences() {
        let radiance = |x: f64, y: f64| (-(x - 0.7).powi(2) - 0.5 * (y + 0.4).powi(2)).exp() + 0.2;
        let (at, normal) = (DVec3::new(0.1, 0.2, 0.0), DVec3::Z);
        let (_, found) = under_a_plane(at, normal, radiance);
        let step = 1e-2;
        for (axis, along) in [DVec3::X, DVec3::Y].into_iter().enumerate() {
            let [less, more] = [-step, step].map(|by| under_a_plane(at + by * along, normal, radiance).0);
            let by_shift = (more - less) / (2.0 * step);
            assert!(
                (found.shift[axis].0[0] - by_shift).abs() < 0.01 * by_shift.abs() + 0.003,
                "{axis} {by_shift} {found:?}"
            );
            let turned = |by: f64| under_a_plane(at, glam::DQuat::from_axis_angle(along, by) * normal, radiance).0;
            let by_turn = (turned(step) - turned(-step)) / (2.0 * step);
            assert!(
                (found.turn[axis].0[0] - by_turn).abs() < 0.01 * by_turn.abs() + 0.003,
                "{axis} {by_turn} {found:?}"
            );
        }
    }

    /// Half of the sky is bright: a turn towards it by an angle brings as much of it as its sine, however few the strata are.
    #[test]
    fn the_turn_of_few_rays_is_right_on_average() {
        for rays in [8, 16, 64, 256] {
            let (strata, frame) = (Strata::new(rays), Frame::around(DVec3::Z));
            let parts = 64;
            let mut turn = 0.0;
            for part in 0..parts * parts {
                let xi = [part / parts, part % parts].map(|of| (f64::from(of) + 0.5) / f64::from(parts));
                let found: Vec<Found<1>> = (0..rays)
                    .map(|number| {
                        let bright = strata.direction(number, xi, &frame).x > 0.0;
                        Found { irradiance: Colour([f64::from(u8::from(bright))]), distance: 1.0 }
                    })
                    .collect();
                turn += strata.gradients(&found, &frame).turn[1].0[0] / f64::from(parts * parts);
            }
            // The bright half's share is (1 + sin(angle)) / 2.
            let off = turn / 0.5 - 1.0;
            assert!(off.abs() < 0.11 && (rays < 64 || off.abs() < 0.02), "{rays} rays: {turn}");
        }
    }

    #[test]
    fn strata_are_as_many_as_rays() {
        for (rays, rows) in [(1, 1), (7, 1), (16, 2), (48, 4), (64, 4), (256, 8)] {
            let strata = Strata::new(rays);
            assert_eq!((strata.rows, strata.rows * strata.columns), (rows, rays));
        }
    }
}
