//! The caustic of the ball lens under a lamp above it, cell by cell.

use std::f64::consts::PI;

use photonlab_readout::Cell;
use photonlab_reference::ball_lens::DiscLamp;

use super::{caustic_flux::lens, lab::Lab, ray_curves::Bench};

/// Height of the lamp (m).
const HEIGHT: f64 = 3.0;

/// The floor, of this half-width (m) and so many cells along it, under a lamp of a radius (m); those cells that are wanted, with their truth,
/// each relative to the mean of all.
pub(super) fn under(
    id: &'static str,
    radius: f64,
    (half, cells): (f64, u32),
    wanted: impl Fn(&Cell) -> bool,
) -> anyhow::Result<Bench<1>> {
    let lens = lens();
    // As bright as parallel light of irradiance 1, but for the distance.
    let lamp = DiscLamp { height: HEIGHT, radius, radiance: (HEIGHT / radius).powi(2) / PI };
    let lab = Lab::new(id, &lens.metered_xml(Some(lamp), half, cells as usize), &[])?;
    let edge = 2.0 * half / f64::from(cells);
    let read: Vec<Cell> = Cell::of_meters(&lab.world.scene).into_iter().filter(wanted).collect();
    let truth = read.iter().map(|cell| {
        // The mean over the cell by two Gauss nodes each way.
        let node = |k: u32, i: usize| {
            let side = if k >> i & 1 == 0 { -1.0 } else { 1.0 } / 12f64.sqrt();
            -half + edge * (f64::from(cell.cell[i]) + 0.5 + side)
        };
        let at = |k: u32| lens.irradiance_under(lamp, node(k, 0).hypot(node(k, 1)));
        let mean = (0..4).map(at).sum::<Result<f64, _>>()? / 4.0;
        Ok(mean)
    });
    let truth = truth.collect::<anyhow::Result<Vec<f64>>>()?;
    let scale = truth.iter().sum::<f64>() / truth.len() as f64;
    let truth = truth.into_iter().map(|mean| Some(([mean], scale))).collect();
    Ok(Bench { id, lab, cells: read, truth, noise_of_truth: 0.0, border: Vec::new() })
}
