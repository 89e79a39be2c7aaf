//! A picture of one face of CUBE and its truth.

use photonlab_readout::Cell;

use super::{cube_field::CubeField, lab::Lab, ray_curves::Bench};

const CUBE: &str = include_str!("../../scenes/cube.xml");
/// Pixels across and down.
const SIZE: u32 = 32;
/// A camera in the centre whose picture is one face.
const CAMERA: &str = r#"<sensor type="perspective" id="face"><float name="fov" value="90"/>
    <transform name="to_world"><lookat origin="0 0 0" target="5 0 0" up="0 0 1"/></transform>
    <film type="hdrfilm"><integer name="width" value="32"/><integer name="height" value="32"/><rfilter type="box"/></film></sensor>"#;
/// Points along each side of a pixel over which the truth is averaged.
const POINTS: u32 = 8;

/// One face against the radiosity solution, relative to its mean.
pub(super) fn cube_face() -> anyhow::Result<Bench<1>> {
    let lab = Lab::new("cube.xml", &CUBE.replace("</scene>", &format!("{CAMERA}</scene>")), &[])?;
    let sensor = lab.world.scene.sensors.len() - 1;
    let cells = Cell::of_sensor(&lab.world.scene, sensor);
    let field = CubeField::new();
    let along = |pixel: u32, point: u32| {
        2.0 * (f64::from(pixel) + (f64::from(point) + 0.5) / f64::from(POINTS)) / f64::from(SIZE) - 1.0
    };
    let luminance = |[column, row]: [u32; 2]| {
        let points = (0..POINTS * POINTS).map(|n| (along(column, n % POINTS), along(row, n / POINTS)));
        let sum: f64 = points.map(|(u, v)| field.illuminance(u, v)).sum();
        sum / f64::from(POINTS * POINTS) * field.cube().reflectance() / std::f64::consts::PI
    };
    let truth: Vec<f64> = cells.iter().map(|cell| luminance(cell.cell)).collect();
    let mean = truth.iter().sum::<f64>() / truth.len() as f64;
    let is_border = |&number: &usize| cells[number].cell.iter().any(|&at| at == 0 || at == SIZE - 1);
    let border = (0..cells.len()).filter(is_border).collect();
    let truth = truth.into_iter().map(|l| Some(([l], mean))).collect();
    Ok(Bench { id: "cube", lab, truth, noise_of_truth: 0.0, border, cells })
}
