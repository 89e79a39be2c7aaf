//! A picture of all directions, ready for draws.

use std::f64::consts::{PI, TAU};

use glam::{DMat3, DVec3};
use photonlab_photometry::{Colour, Palette, Spectrum};
use photonlab_scene::SkyMap;

/// A picture in azimuth and polar angle, bilinear as in Mitsuba: columns have their centres half a column from the edge, the
/// first and last row stand at the poles.
#[derive(Clone, Debug)]
pub(crate) struct Table<const C: usize> {
    columns: usize,
    rows: usize,
    pixels: Vec<Colour<C>>,
    /// From the world to the picture's own axes.
    to_local: DMat3,
    /// Running sum of the cells' weights; the cells lie between pixels.
    cumulative: Vec<f64>,
}

impl<const C: usize> Table<C> {
    pub(crate) fn new(map: &SkyMap, palette: &Palette<C>) -> Self {
        let (columns, rows) = (map.width, map.height);
        let emission = |pixel: &[f32; 3]| palette.emission(&Spectrum::Rgb(pixel.map(f64::from)));
        let pixels: Vec<Colour<C>> = map.pixels.iter().map(emission).collect();
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

    /// The largest of the pixels, in each channel.
    pub(crate) fn brightest(&self) -> Colour<C> {
        self.pixels.iter().fold(Colour::ZERO, |most, pixel| Colour(std::array::from_fn(|c| most[c].max(pixel[c]))))
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

    pub(crate) fn radiance(&self, direction: DVec3) -> Colour<C> {
        let (column, row, s, t) = self.place(direction);
        let [a, b, c, d] = self.corners(column, row);
        (a * (1.0 - s) + b * s) * (1.0 - t) + (c * (1.0 - s) + d * s) * t
    }

    fn weight(&self) -> f64 {
        self.cumulative.last().copied().unwrap_or(0.0)
    }

    /// Evenly over the solid angle of a cell that is drawn by its mean brightness.
    pub(crate) fn draw(&self, xi: [f64; 2]) -> DVec3 {
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

    pub(crate) fn pdf_solid_angle(&self, direction: DVec3) -> f64 {
        let (column, row, ..) = self.place(direction);
        let cell = row * self.columns + column;
        let before = if cell > 0 { self.cumulative[cell - 1] } else { 0.0 };
        let share = (self.cumulative[cell] - before) / self.weight();
        share * self.columns as f64 / self.band_solid_angle(row)
    }

    /// Integral over all directions, exact for the bilinear picture: over a band, of the part that grows with the polar
    /// angle t, the integral of (t - low) sin t is sin high - sin low - (high - low) cos high.
    pub(crate) fn total(&self) -> Colour<C> {
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
