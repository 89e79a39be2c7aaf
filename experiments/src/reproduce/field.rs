//! Synthetic photons on planes: fields whose estimate is known without any tracing.

use photonlab_photometry::{PackedDirection, PathClass, Photon};
use photonlab_sampling::{Purpose, Stream};

/// Photons that arrive straight down on a horizontal plane (normal +z) unless moved by the caller.
#[derive(Clone, Debug, Default)]
pub(super) struct Field {
    pub(super) positions: Vec<[f32; 3]>,
    pub(super) photons: Vec<Photon<1>>,
}

impl Field {
    /// A homogeneous Poisson field of `density` photons per square metre on the rectangle [low, high] of the plane z = 0,
    /// each with flux 1 / density, so that the irradiance is 1.
    pub(super) fn uniform(density: f64, low: [f64; 2], high: [f64; 2], stream: &mut Stream) -> Self {
        let size = [high[0] - low[0], high[1] - low[1]];
        let count = poisson(density * size[0] * size[1], stream);
        let mut field = Self::default();
        for _ in 0..count {
            let [u, v] = stream.next2();
            field.push([low[0] + u * size[0], low[1] + v * size[1], 0.0], [0.0, 0.0, 1.0], 1.0 / density);
        }
        field
    }

    /// Adds a photon that arrives against a normal.
    pub(super) fn push(&mut self, position: [f64; 3], normal: [f64; 3], flux: f64) {
        self.positions.push(position.map(|x| x as f32));
        self.photons.push(Photon {
            flux: [flux as f32],
            direction: PackedDirection::pack(normal.map(|x| -x)),
            normal: PackedDirection::pack(normal),
            class: PathClass::Direct,
            segments: 1,
        });
    }
}

/// The stream of one replicate of a claim.
pub(super) fn stream(seed: u64, replicate: u64) -> Stream {
    Stream::new(seed, Purpose::Synthetic, 0, replicate)
}

/// A Poisson number: by waiting times for small means, by halving large ones into independent parts, which is exact.
pub(super) fn poisson(mean: f64, stream: &mut Stream) -> u64 {
    if mean > 30.0 {
        return poisson(0.5 * mean, stream) + poisson(0.5 * mean, stream);
    }
    let (mut count, mut elapsed) = (0, -stream.next().ln());
    while elapsed < mean {
        count += 1;
        elapsed -= stream.next().ln();
    }
    count
}
