//! What each structure is asked.

/// Sums over all queries, by which contestants are compared.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Checksum {
    pub(crate) photons: u64,
    pub(crate) distance: f64,
    pub(crate) flux: f64,
}

impl Checksum {
    pub(crate) fn add(&mut self, photons: usize, distance_squared: f32, flux: [f32; 3]) {
        self.photons += photons as u64;
        self.distance += f64::from(distance_squared).sqrt();
        self.flux += flux.iter().map(|&f| f64::from(f)).sum::<f64>();
    }

    /// Equal but for rounding: sums in `f32` of a few hundred terms, and photons within rounding of the ball's surface.
    pub(crate) fn agrees(&self, other: &Self) -> bool {
        let close = |a: f64, b: f64| (a - b).abs() <= 1e-5 * a.abs().max(b.abs());
        close(self.photons as f64, other.photons as f64)
            && close(self.distance, other.distance)
            && close(self.flux, other.flux)
    }
}

/// A job for each query of a list.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Job {
    /// k-th distance and RGB sum of the k nearest photons.
    Nearest(usize),
    /// RGB sum of the photons within a radius.
    Radius(f32),
    /// Their number.
    Search(f32),
}

/// A structure over one photon set.
pub(crate) trait Contestant {
    fn run(&mut self, job: Job, queries: &[[f32; 3]]) -> Option<Checksum>;
}
