//! Directions drawn from a luminaire's table.

use glam::DVec3;
use photonlab_scene::luminaire::IntensityTable;

use crate::Stream;

/// A direction in the lamp's own axes; its density per solid angle is the intensity over the flux.
pub(crate) fn draw(table: &IntensityTable, stream: &mut Stream) -> DVec3 {
    let cell = table.choose(stream.next());
    let brightest = cell.brightest();
    // Even over the cell: in C, and in the squared sine of half gamma, which near nadir loses no digits as cos gamma does.
    let [low, high] = cell.gamma.map(|gamma| (0.5 * gamma.to_radians()).sin().powi(2));
    loop {
        let [s, t] = stream.next2();
        let c = cell.c[0] + s * (cell.c[1] - cell.c[0]);
        let gamma = 2.0 * (low + t * (high - low)).sqrt().asin();
        if stream.next() * brightest < cell.intensity(c, gamma.to_degrees()) {
            let (sin_c, cos_c) = c.to_radians().sin_cos();
            let (sin, cos) = gamma.sin_cos();
            return DVec3::new(sin * cos_c, sin * sin_c, -cos);
        }
    }
}
