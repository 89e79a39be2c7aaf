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

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;
    use std::sync::Arc;

    use glam::DMat3;
    use photonlab_measure::chi_square_test;
    use photonlab_photometry::{Colour, Palette, Spectrum};
    use photonlab_scene::luminaire::{Cell, Symmetry};
    use photonlab_scene::{Emitter, Pattern, Scene, World};

    use super::*;
    use crate::{Lamps, LightDraw, Purpose};

    /// Parts of a cell each way.
    const PARTS: usize = 3;

    fn table(symmetry: Symmetry, c: &[f64], gamma: &[f64], intensity: &[f64]) -> IntensityTable {
        IntensityTable::new(symmetry, c, gamma, intensity).expect("a table")
    }

    fn tables() -> [IntensityTable; 5] {
        let wide = [10.0, 0.0, 5.0, 0.0, 40.0, 1.0];
        let narrow: Vec<f64> = (0..=8).map(|i| 1e4 * (-f64::from(i * i) / 6.0).exp()).collect();
        let fine: Vec<f64> = (0..=8).map(|i| 1e-3 * f64::from(i)).collect();
        let rough: Vec<f64> = (0..5 * 7).map(|i| f64::from(i * i * 7 % 31)).collect();
        [
            table(Symmetry::Rotational, &[0.0], &[0.0, 180.0], &[1.0, 0.0]),
            table(Symmetry::None, &[0.0, 120.0, 300.0], &[0.0, 180.0], &wide),
            // A beam of a hundredth of a degree, around nadir.
            table(Symmetry::Rotational, &[0.0], &fine, &narrow),
            table(
                Symmetry::None,
                &[5.0, 15.0, 100.0, 101.0, 300.0],
                &[30.0, 60.0, 61.0, 90.0, 120.0, 179.0, 180.0],
                &rough,
            ),
            // Light upwards alone, whose first cell is dark.
            table(Symmetry::Quadrant, &[0.0, 90.0], &[90.0, 135.0, 180.0], &[0.0, 0.0, 3.0, 0.0, 0.0, 3.0]),
        ]
    }

    /// Where the angles of a table divide into parts.
    fn divided(angles: &[f64]) -> Vec<f64> {
        let between = |pair: &[f64]| {
            let (low, step) = (pair[0], (pair[1] - pair[0]) / PARTS as f64);
            (0..PARTS).map(move |part| low + part as f64 * step).collect::<Vec<f64>>()
        };
        angles.windows(2).flat_map(between).chain(angles.last().copied()).collect()
    }

    /// Counts of draws in parts of the table's cells against the parts' closed integrals: 5 tests at 1e-6 each.
    #[test]
    fn draws_fall_where_the_flux_goes() {
        let mut stream = Stream::new(29, Purpose::Synthetic, 0, 0);
        for table in tables() {
            let (c, gamma) = (divided(table.c()), divided(table.gamma()));
            let mut expected = Vec::new();
            for i in 1..c.len() {
                for j in 1..gamma.len() {
                    let (c, gamma) = ([c[i - 1], c[i]], [gamma[j - 1], gamma[j]]);
                    // A hair inside, where the cell's own corners count: at 360 degrees the table is at 0.
                    let inside = |[low, high]: [f64; 2]| [low + 1e-9 * (high - low), high - 1e-9 * (high - low)];
                    let corners = inside(c).map(|c| inside(gamma).map(|gamma| table.intensity(c, gamma)));
                    expected.push(Cell { c, gamma, corners }.flux());
                }
            }
            let flux: f64 = expected.iter().sum();
            assert!((flux / table.flux() - 1.0).abs() < 1e-7, "parts add up to the whole: {flux} {table:?}");
            let n = 300_000;
            expected.iter_mut().for_each(|part| *part *= f64::from(n) / flux);
            let mut observed = vec![0u64; expected.len()];
            for _ in 0..n {
                let d = draw(&table, &mut stream);
                let angle = d.y.atan2(d.x).to_degrees().rem_euclid(360.0);
                let height = d.x.hypot(d.y).atan2(-d.z).to_degrees();
                let place = |angles: &[f64], x: f64| angles.partition_point(|a| *a <= x).clamp(1, angles.len() - 1) - 1;
                observed[place(&c, angle) * (gamma.len() - 1) + place(&gamma, height)] += 1;
            }
            let p = chi_square_test(&observed, &expected).expect("enough counts").p_value;
            assert!(p > 1e-6, "{table:?}: p = {p}");
        }
    }

    /// A lamp of this table at 2 m above the origin, turned about x by a quarter if asked for.
    fn world(table: IntensityTable, intensity: f64, to_world: DMat3) -> (World, Lamps<1>) {
        let pattern = Pattern::Table { table: Arc::new(table), to_world };
        let emitter = Emitter::Point {
            id: "lamp".into(),
            position: 2.0 * DVec3::Z,
            intensity: Spectrum::Uniform(intensity),
            pattern,
            medium: None,
        };
        let (shapes, sensors, notes) = (vec![], vec![], vec![]);
        let world = World::new(Scene {
            shapes,
            emitters: vec![emitter],
            sensors,
            media: Vec::new(),
            max_depth: None,
            hides_lamps: false,
            notes,
        });
        let lamps = Lamps::new(&world, &Palette::Channels);
        (world, lamps)
    }

    #[test]
    fn an_even_lamp_of_1000_cd_emits_4000_pi_lm_and_lights_by_distance_squared() {
        let even = table(Symmetry::Rotational, &[0.0], &[0.0, 90.0, 180.0], &[1000.0; 3]);
        let (world, lamps) = world(even, 1000.0, DMat3::IDENTITY);
        assert!((lamps.total_flux()[0] / (4000.0 * PI) - 1.0).abs() < 1e-13);
        let seen = LightDraw::new(&world, &lamps, DVec3::ZERO, [0.5; 3]).expect("light");
        assert!((seen.radiance_over_pdf[0] - 250.0).abs() < 1e-9, "1000 cd from 2 m are 250 lx");
        assert!((seen.point_emission - 1.0).abs() < 1e-13);
    }

    #[test]
    fn a_lamp_lights_what_its_nadir_turns_to() {
        let down = table(Symmetry::Rotational, &[0.0], &[0.0, 60.0], &[1000.0, 0.0]);
        let turned = DMat3::from_cols(DVec3::X, DVec3::Z, DVec3::NEG_Y);
        for (to_world, below, beside) in [(DMat3::IDENTITY, Some(250.0), None), (turned, None, Some(250.0))] {
            let (world, lamps) = world(down.clone(), 1000.0, to_world);
            let seen = |from: DVec3| {
                let draw: Option<LightDraw<1>> = LightDraw::new(&world, &lamps, from, [0.5; 3]);
                draw.map(|draw| draw.radiance_over_pdf).map(|Colour([lux])| lux)
            };
            assert_eq!((seen(DVec3::ZERO), seen(DVec3::new(0.0, 2.0, 2.0))), (below, beside));
            assert_eq!(seen(4.0 * DVec3::Z), None, "dark above");
        }
    }
}
