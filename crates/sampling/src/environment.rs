//! Light from all around: its radiance by direction, and directions drawn by it.

use std::f64::consts::{PI, TAU};

use glam::{DMat3, DVec3};
use photonlab_photometry::Colour;
use photonlab_scene::{EnvironmentLight, Sky, SkyMap};

use crate::{Stream, warp};

/// An environment ready for draws. Directions point from the scene outwards, to where the light comes from.
#[derive(Clone, Debug)]
pub struct Environment<const C: usize> {
    kind: Kind<C>,
    /// Integral of radiance over all directions, W/m^2 or lx.
    pub total: Colour<C>,
}

#[derive(Clone, Debug)]
enum Kind<const C: usize> {
    /// The same from everywhere.
    Constant(Colour<C>),
    /// The upper half of a sky, drawn evenly.
    Sky { radiance: Colour<C>, sky: Sky },
    /// A picture of all directions, drawn by its brightness.
    Map(Table<C>),
}

/// A picture in azimuth and polar angle, bilinear as in Mitsuba: columns have their centres half a column from the edge, the
/// first and last row stand at the poles.
#[derive(Clone, Debug)]
struct Table<const C: usize> {
    columns: usize,
    rows: usize,
    pixels: Vec<Colour<C>>,
    /// From the world to the picture's own axes.
    to_local: DMat3,
    /// Running sum of the cells' weights; the cells lie between pixels.
    cumulative: Vec<f64>,
}

impl<const C: usize> Environment<C> {
    /// Prepares an environment.
    pub fn new(light: &EnvironmentLight) -> Self {
        match light {
            EnvironmentLight::Constant { radiance } => {
                let radiance = Colour::from_rgb(*radiance);
                Self { kind: Kind::Constant(radiance), total: radiance * (4.0 * PI) }
            }
            EnvironmentLight::Sky { radiance, sky } => {
                let radiance = Colour::from_rgb(*radiance);
                Self { kind: Kind::Sky { radiance, sky: *sky }, total: radiance * sky.integral() }
            }
            EnvironmentLight::Map(map) => {
                let table = Table::new(map);
                Self { total: table.total(), kind: Kind::Map(table) }
            }
        }
    }

    /// Radiance that comes from a direction.
    pub fn radiance(&self, direction: DVec3) -> Colour<C> {
        match &self.kind {
            Kind::Constant(radiance) => *radiance,
            Kind::Sky { radiance, sky } => *radiance * sky.relative_luminance(direction),
            Kind::Map(table) => table.radiance(direction),
        }
    }

    /// A direction, from two numbers.
    pub fn draw(&self, xi: [f64; 2]) -> DVec3 {
        match &self.kind {
            Kind::Constant(_) => warp::square_to_uniform_sphere(xi),
            Kind::Sky { sky, .. } => warp::square_to_uniform_cone(xi, sky.zenith, 1.0),
            Kind::Map(table) => table.draw(xi),
        }
    }

    /// Density per solid angle of [`Environment::draw`].
    pub fn pdf_solid_angle(&self, direction: DVec3) -> f64 {
        match &self.kind {
            Kind::Constant(_) => 1.0 / (4.0 * PI),
            Kind::Sky { sky, .. } => {
                if direction.dot(sky.zenith) > 0.0 {
                    1.0 / TAU
                } else {
                    0.0
                }
            }
            Kind::Map(table) => table.pdf_solid_angle(direction),
        }
    }

    /// A direction and what a photon from there carries over the mean: radiance over density and total.
    pub fn emit(&self, stream: &mut Stream) -> (DVec3, Colour<C>) {
        let direction = self.draw(stream.next2());
        let over_pdf = self.radiance(direction) * (1.0 / self.pdf_solid_angle(direction));
        let share = |c: usize| if self.total[c] > 0.0 { over_pdf[c] / self.total[c] } else { 0.0 };
        (direction, Colour(std::array::from_fn(share)))
    }
}

impl<const C: usize> Table<C> {
    fn new(map: &SkyMap) -> Self {
        let (columns, rows) = (map.width, map.height);
        let pixels: Vec<Colour<C>> = map.pixels.iter().map(|&p| Colour::from_rgb(p.map(f64::from))).collect();
        let mut table = Self { columns, rows, pixels, to_local: map.to_world.transpose(), cumulative: Vec::new() };
        let mut sum = 0.0;
        for row in 0..table.bands() {
            let solid_angle = table.band_solid_angle(row) / columns as f64;
            for column in 0..columns {
                let corners = table.corners(column, row);
                let mean = corners.iter().map(|c| c.mean()).sum::<f64>() / 4.0;
                sum += mean * solid_angle;
                table.cumulative.push(sum);
            }
        }
        table
    }

    /// Bands of cells between rows; a single row makes one band.
    fn bands(&self) -> usize {
        self.rows.max(2) - 1
    }

    /// Polar angles between which a band lies.
    fn band(&self, row: usize) -> (f64, f64) {
        let step = PI / self.bands() as f64;
        (row as f64 * step, (row as f64 + 1.0) * step)
    }

    fn band_solid_angle(&self, row: usize) -> f64 {
        let (low, high) = self.band(row);
        TAU * (low.cos() - high.cos())
    }

    /// Pixels at a cell's corners: upper left, upper right, lower left, lower right.
    fn corners(&self, column: usize, row: usize) -> [Colour<C>; 4] {
        let next = (column + 1) % self.columns;
        let (above, below) = (row, (row + 1).min(self.rows - 1));
        [(column, above), (next, above), (column, below), (next, below)]
            .map(|(column, row)| self.pixels[row * self.columns + column])
    }

    /// Cell of a direction, and where in it, in [0, 1)^2; along v by the polar angle.
    fn place(&self, direction: DVec3) -> (usize, usize, f64, f64) {
        let local = self.to_local * direction;
        let turn = local.x.atan2(-local.z) / TAU;
        let u = (turn - turn.floor()) * self.columns as f64 - 0.5;
        let polar = local.y.clamp(-1.0, 1.0).acos();
        let column = (u.floor() as i64).rem_euclid(self.columns as i64) as usize;
        let row = ((polar / PI * self.bands() as f64) as usize).min(self.bands() - 1);
        let (low, high) = self.band(row);
        (column, row, u - u.floor(), ((polar - low) / (high - low)).clamp(0.0, 1.0))
    }

    fn radiance(&self, direction: DVec3) -> Colour<C> {
        let (column, row, s, t) = self.place(direction);
        let [a, b, c, d] = self.corners(column, row);
        (a * (1.0 - s) + b * s) * (1.0 - t) + (c * (1.0 - s) + d * s) * t
    }

    fn weight(&self) -> f64 {
        self.cumulative.last().copied().unwrap_or(0.0)
    }

    /// Evenly over the solid angle of a cell that is drawn by its mean brightness.
    fn draw(&self, xi: [f64; 2]) -> DVec3 {
        let wanted = xi[0] * self.weight();
        let cell = self.cumulative.partition_point(|&sum| sum <= wanted).min(self.cumulative.len() - 1);
        let (column, row) = (cell % self.columns, cell / self.columns);
        // What choosing the cell leaves of the first number is as good as a number of its own.
        let before = if cell > 0 { self.cumulative[cell - 1] } else { 0.0 };
        let along = ((wanted - before) / (self.cumulative[cell] - before)).clamp(0.0, 1.0);
        let (low, high) = self.band(row);
        let cos = low.cos() + xi[1] * (high.cos() - low.cos());
        let azimuth = TAU * (column as f64 + 0.5 + along) / self.columns as f64;
        let sin = (1.0 - cos * cos).max(0.0).sqrt();
        self.to_local.transpose() * DVec3::new(sin * azimuth.sin(), cos, -sin * azimuth.cos())
    }

    fn pdf_solid_angle(&self, direction: DVec3) -> f64 {
        let (column, row, ..) = self.place(direction);
        let cell = row * self.columns + column;
        let before = if cell > 0 { self.cumulative[cell - 1] } else { 0.0 };
        let share = (self.cumulative[cell] - before) / self.weight();
        share * self.columns as f64 / self.band_solid_angle(row)
    }

    /// Integral over all directions, exact for the bilinear picture: over a band, of the part that grows with the polar
    /// angle t, the integral of (t - low) sin t is sin high - sin low - (high - low) cos high.
    fn total(&self) -> Colour<C> {
        let mut total = Colour::ZERO;
        for row in 0..self.bands() {
            let (low, high) = self.band(row);
            let whole = low.cos() - high.cos();
            let lower = (high.sin() - low.sin() - (high - low) * high.cos()) / (high - low);
            for column in 0..self.columns {
                let [a, b, c, d] = self.corners(column, row);
                total += ((a + b) * (0.5 * (whole - lower)) + (c + d) * (0.5 * lower)) * (TAU / self.columns as f64);
            }
        }
        total
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Purpose;
    use photonlab_scene::SkyLaw;

    fn picture() -> EnvironmentLight {
        let (width, height) = (7, 5);
        let pixel = |i: usize| [(i % 3) as f32, 0.1 + (i % 5) as f32, ((i * i) % 11) as f32 * 0.3];
        let pixels = (0..width * height).map(pixel).collect();
        let to_world = DMat3::from_axis_angle(DVec3::new(0.6, 0.0, 0.8), 0.7);
        EnvironmentLight::Map(SkyMap { width, height, pixels, to_world })
    }

    fn all() -> [EnvironmentLight; 3] {
        let law = SkyLaw::General { kind: 12, sun: DVec3::new(0.6, 0.0, 0.8) };
        let sky = Sky { zenith: DVec3::new(0.0, 0.6, 0.8), law };
        let constant = EnvironmentLight::Constant { radiance: [1.0, 2.0, 3.0] };
        [constant, EnvironmentLight::Sky { radiance: [1.0; 3], sky }, picture()]
    }

    /// Means over draws and over uniform directions, weighted by their densities: the total, and a first moment. 18
    /// comparisons at |z| < 5, false alarm 1e-5 in all.
    #[test]
    fn draws_densities_and_totals_agree() {
        let n = 400_000;
        for light in all() {
            let environment = Environment::<3>::new(&light);
            let mut stream = Stream::new(29, Purpose::Synthetic, 0, 0);
            for c in 0..3 {
                for test in [|_: DVec3| 1.0, |d: DVec3| d.x - 0.5 * d.y] {
                    let (mut drawn, mut weighed) = ([0.0; 2], [0.0; 2]);
                    for _ in 0..n {
                        let (d, share) = environment.emit(&mut stream);
                        let x = test(d) * share[c] * environment.total[c];
                        let d = warp::square_to_uniform_sphere(stream.next2());
                        let y = test(d) * environment.radiance(d)[c] * 4.0 * PI;
                        drawn = [drawn[0] + x, drawn[1] + x * x];
                        weighed = [weighed[0] + y, weighed[1] + y * y];
                    }
                    let mean = |s: [f64; 2]| s[0] / f64::from(n);
                    let error2 = |s: [f64; 2]| (s[1] / f64::from(n) - mean(s).powi(2)).max(0.0) / f64::from(n);
                    let z = (mean(drawn) - mean(weighed)) / (error2(drawn) + error2(weighed)).sqrt().max(1e-9);
                    assert!(z.abs() < 5.0, "{light:?} {c}: {} {}", mean(drawn), mean(weighed));
                }
            }
        }
    }

    /// The density integrates to one, and is that of the draws, by uniform directions: |z| < 5.
    #[test]
    fn the_density_is_one() {
        for light in all() {
            let environment = Environment::<3>::new(&light);
            let mut stream = Stream::new(31, Purpose::Synthetic, 0, 0);
            let n = 200_000;
            let (mut sum, mut squares) = (0.0, 0.0);
            for _ in 0..n {
                let p = environment.pdf_solid_angle(warp::square_to_uniform_sphere(stream.next2())) * 4.0 * PI;
                sum += p;
                squares += p * p;
            }
            let mean = sum / f64::from(n);
            let error = ((squares / f64::from(n) - mean * mean).max(0.0) / f64::from(n)).sqrt();
            assert!((mean - 1.0).abs() < 5.0 * error + 1e-12, "{light:?} {mean} {error}");
        }
    }
}
