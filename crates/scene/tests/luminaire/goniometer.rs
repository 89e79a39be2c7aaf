//! Tables from counted flux.

use photonlab_scene::luminaire::{Cell, IntensityTable, Symmetry, write_lm63};

use super::samples::{ies, rotational};

/// The exact flux of a table in the cells of a goniometer, from pieces that no angle of the table divides.
fn flux_in_cells(table: &IntensityTable, columns: usize, rows: usize) -> Vec<f64> {
    let divided = |count: usize, whole: f64, angles: &[f64]| {
        let mut edges: Vec<f64> = (0..=count).map(|i| whole * i as f64 / count as f64).chain(angles.to_vec()).collect();
        edges.sort_by(f64::total_cmp);
        edges.dedup_by(|a, b| (*a - *b).abs() < 1e-9);
        edges
    };
    let (c, gamma) = (divided(columns, 360.0, table.c()), divided(rows, 180.0, table.gamma()));
    let mut flux = vec![0.0; columns * rows];
    for c in c.windows(2).map(|pair| [pair[0], pair[1]]) {
        for gamma in gamma.windows(2).map(|pair| [pair[0], pair[1]]) {
            let inside = |[low, high]: [f64; 2]| [low + 1e-9 * (high - low), high - 1e-9 * (high - low)];
            let corners = inside(c).map(|c| inside(gamma).map(|gamma| table.intensity(c, gamma)));
            let place =
                |[low, high]: [f64; 2], count: usize, whole: f64| (0.5 * (low + high) / whole * count as f64) as usize;
            let index = place(gamma, rows, 180.0) * columns + place(c, columns, 360.0);
            flux[index] += Cell { c, gamma, corners }.flux();
        }
    }
    flux
}

fn wings() -> IntensityTable {
    let gamma = [0.0, 20.0, 55.0, 70.0, 100.0, 180.0];
    let planes = [
        [90.0, 80.0, 60.0, 20.0, 10.0, 5.0],
        [90.0, 110.0, 300.0, 120.0, 50.0, 8.0],
        [90.0, 70.0, 30.0, 25.0, 20.0, 8.0],
    ];
    IntensityTable::new(Symmetry::AboutC90, &[-90.0, 10.0, 90.0], &gamma, planes.as_flattened()).expect("a table")
}

/// A table with light everywhere comes back with the flux of every cell, whatever the grid.
#[test]
fn every_cell_keeps_its_flux() {
    for (table, columns, rows) in [
        (rotational(&[0.0, 180.0], &[100.0, 100.0]), 1, 2),
        (rotational(&[0.0, 90.0, 180.0], &[100.0, 30.0, 1.0]), 1, 18),
        (wings(), 2, 3),
        (wings(), 24, 18),
        (wings(), 7, 31),
    ] {
        let flux = flux_in_cells(&table, columns, rows);
        let made = IntensityTable::from_cells(columns, rows, &flux).expect("a table");
        let counted: f64 = flux.iter().sum();
        assert!((made.flux() / counted - 1.0).abs() < 1e-12, "{} {counted}", made.flux());
        for (cell, (made, counted)) in flux_in_cells(&made, columns, rows).iter().zip(&flux).enumerate() {
            let off = (made - counted).abs() / table.flux();
            assert!(off < 2e-9, "{columns} x {rows}, cell {cell}: {made} {counted}");
        }
        assert_eq!(ies(&write_lm63(&made, &[])).table, made);
    }
}

/// Light that ends inside a cell: no table of these angles has the flux of every cell without negative values, but the whole
/// flux is kept, and none of it goes farther than two cells beyond.
#[test]
fn a_sharp_end_keeps_the_whole_flux() {
    let beam = rotational(&[0.0, 33.0, 33.001], &[100.0, 100.0, 0.0]);
    let (columns, rows) = (8, 36);
    let flux = flux_in_cells(&beam, columns, rows);
    let made = IntensityTable::from_cells(columns, rows, &flux).expect("a table");
    assert!((made.flux() / flux.iter().sum::<f64>() - 1.0).abs() < 1e-12);
    let ends = 35.0 + 2.0 * 5.0;
    assert!((0..720).all(|c| made.intensity(0.5 * f64::from(c), ends + 1e-9) == 0.0));
    assert!((0..720).all(|c| made.intensity(0.5 * f64::from(c), 0.0) > 90.0));
}

/// Where the table is even it is even again: nothing rings.
#[test]
fn even_light_stays_even() {
    let even = rotational(&[0.0, 180.0], &[7.0, 7.0]);
    let made = IntensityTable::from_cells(5, 9, &flux_in_cells(&even, 5, 9)).expect("a table");
    for plane in 0..made.c().len() {
        assert!(made.plane(plane).iter().all(|candela| (candela / 7.0 - 1.0).abs() < 1e-12));
    }
    assert!(IntensityTable::from_cells(5, 9, &[0.0; 45]).expect_err("dark").to_string().contains("emits nothing"));
}
