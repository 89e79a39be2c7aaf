//! Small pictures and their path-traced controls.

use photonlab_readout::{Cell, Wanted};
use photonlab_scene::Film;

use super::{
    lab::Lab,
    ray_curves::{Bench, CONFIDENCE},
    strategy::Strategy,
};

const CORNELL_BOX: &str = include_str!("../../scenes/cornell-box.xml");
const AJAR: &str = include_str!("../../scenes/ajar.xml");
/// Pixels brighter than this many times the picture's mean show the lamp.
const LAMP: f64 = 8.0;

/// The Cornell box.
pub(super) fn cornell_box(size: u32, seed: u64, points: u64) -> anyhow::Result<Bench<3>> {
    controlled("cornell-box", Lab::new("cornell-box.xml", CORNELL_BOX, &[])?, size, seed, points)
}

/// The dark half of a room that is lit past the end of a wall.
pub(super) fn ajar(size: u32, seed: u64, points: u64) -> anyhow::Result<Bench<1>> {
    controlled("ajar", Lab::new("ajar.xml", AJAR, &[])?, size, seed, points)
}

/// A small picture against a path-traced control, relative to the control's mean, the lamp left out.
fn controlled<const C: usize>(
    id: &'static str,
    mut lab: Lab,
    size: u32,
    seed: u64,
    points: u64,
) -> anyhow::Result<Bench<C>> {
    lab.world.scene.sensors[0].film = Film { width: size, height: size };
    let cells = Cell::of_sensor(&lab.world.scene, 0);
    let wanted = Wanted { samples: Some(points), ..Wanted::default() };
    let control = lab.read::<C>(&cells, Strategy::PATH.settings(seed), &wanted, CONFIDENCE)?;
    let pixels: Vec<[f64; C]> =
        control.cells.iter().map(|cell| std::array::from_fn(|c| cell.value[c].mean().unwrap_or(0.0))).collect();
    let mean_of = |pixels: &[[f64; C]]| pixels.iter().flatten().sum::<f64>() / (C * pixels.len()) as f64;
    let all = mean_of(&pixels);
    let shows_lamp = |pixel: &[f64; C]| pixel.iter().any(|&l| l > LAMP * all);
    let rest: Vec<[f64; C]> = pixels.iter().copied().filter(|pixel| !shows_lamp(pixel)).collect();
    let scale = mean_of(&rest);
    let dark = pixels.iter().map(|pixel| !shows_lamp(pixel));
    let noises = control
        .cells
        .iter()
        .zip(dark)
        .filter(|(_, dark)| *dark)
        .flat_map(|(cell, _)| cell.value.each_ref().map(|value| value.std_error().unwrap_or(0.0) / scale));
    let noise_of_truth = noises.map(|noise| noise * noise).sum::<f64>() / (C * rest.len()) as f64;
    let truth = pixels.iter().map(|pixel| (!shows_lamp(pixel)).then_some((*pixel, scale))).collect();
    Ok(Bench { id, lab, cells, truth, noise_of_truth, border: Vec::new() })
}
