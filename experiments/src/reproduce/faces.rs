//! Uniformly lit faces in space, made of independent photons.

use photonlab_sampling::Stream;

use super::field::{Field, poisson};

/// A rectangle lit on one side.
#[derive(Clone, Copy, Debug)]
pub(super) struct Face {
    /// Metres.
    pub(super) corner: [f64; 3],
    /// Metres, at right angles.
    pub(super) sides: [[f64; 3]; 2],
    /// On the lit side.
    pub(super) normal: [f64; 3],
}

impl Face {
    /// Adds a Poisson field of `density` photons per square metre that arrive against the normal, each with flux
    /// 1 / density, so that the irradiance is 1.
    fn light(&self, density: f64, stream: &mut Stream, field: &mut Field) {
        let length = |v: [f64; 3]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
        let [a, b] = self.sides;
        for _ in 0..poisson(density * length(a) * length(b), stream) {
            let [u, v] = stream.next2();
            let position = std::array::from_fn(|i| self.corner[i] + u * a[i] + v * b[i]);
            field.push(position, self.normal, 1.0 / density);
        }
    }
}

/// All faces lit with irradiance 1.
pub(super) fn lit(faces: &[Face], density: f64, stream: &mut Stream) -> Field {
    let mut field = Field::default();
    faces.iter().for_each(|face| face.light(density, stream, &mut field));
    field
}
