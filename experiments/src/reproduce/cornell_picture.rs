//! A picture of the Cornell box and its path-traced control.

use photonlab_readout::{Cell, Wanted};
use photonlab_scene::Film;

use super::{
    lab::Lab,
    ray_curves::{Bench, CONFIDENCE},
    strategy::Strategy,
};

const CORNELL_BOX: &str = include_str!("../../scenes/cornell-box.xml");
/// Pixels brighter than this many times the picture's mean show the lamp.
const LAMP: f64 = 8.0;

/// A small picture against a path-traced control, relative to the control's mean, the lamp left out.
pub(super) fn cornell_box(size: u32, seed: u64, points: u64) -> anyhow::Result<Bench<3>> {
    let mut lab = Lab::new("cornell-box.xml", CORNELL_BOX, &[])?;
    lab.world.scene.sensors[0].film = Film { width: size, height: size };
    let cells = Cell::of_sensor(&lab.world.scene, 0);
    let wanted = Wanted { samples: Some(points), ..Wanted::default() };
    let control = lab.read::<3>(&cells, Strategy::PATH.settings(seed), &wanted, CONFIDENCE)?;
    let pixels: Vec<[f64; 3]> =
        control.cells.iter().map(|cell| std::array::from_fn(|c| cell.value[c].mean().unwrap_or(0.0))).collect();
    let mean_of = |pixels: &[[f64; 3]]| pixels.iter().flatten().sum::<f64>() / (3 * pixels.len()) as f64;
    let all = mean_of(&pixels);
    let shows_lamp = |pixel: &[f64; 3]| pixel.iter().any(|&l| l > LAMP * all);
    let rest: Vec<[f64; 3]> = pixels.iter().copied().filter(|pixel| !shows_lamp(pixel)).collect();
    let scale = mean_of(&rest);
    let truth = pixels.iter().map(|pixel| (!shows_lamp(pixel)).then_some((*pixel, scale))).collect();
    Ok(Bench { id: "cornell-box", lab, cells, truth, border: Vec::new() })
}
