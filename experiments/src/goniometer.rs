//! `photonlab measure --ies`: what a goniometer reads, as a luminaire file.

use std::f64::consts::{PI, TAU};
use std::path::{Path, PathBuf};

use photonlab_measure::Measurement;
use photonlab_photometry::Channels;
use photonlab_scene::luminaire::{IntensityTable, write_lm63};
use photonlab_scene::{Film, Meter, Receiver};

use crate::{
    Failure,
    command::{Options, UnitsName},
    image::is_writable,
    interrupt::write_whole,
    loaded::Loaded,
};

/// A file to be written from the readings of one goniometer.
pub(crate) struct LuminaireFile {
    path: PathBuf,
    sensor: String,
    film: Film,
}

impl LuminaireFile {
    /// Checks that there is one goniometer among the sensors that are read, and that its numbers can be candela.
    pub(crate) fn new(path: &Path, loaded: &Loaded, sensors: &[usize], options: &Options) -> Result<Self, Failure> {
        let fail = |what: &str| Err(Failure::usage(format!("--ies {}: {what}", path.display())));
        let all = sensors.iter().map(|&index| &loaded.world.scene.sensors[index]);
        let goniometers: Vec<_> =
            all.filter(|s| matches!(s.receiver, Receiver::Meter(Meter::Intensitymeter { .. }))).collect();
        let [goniometer] = goniometers[..] else {
            return match goniometers.len() {
                0 => fail("no goniometer is read; add a <sensor type=\"intensitymeter\"> to the scene"),
                more => fail(&format!("{more} goniometers are read; choose one by --sensor ID")),
            };
        };
        if path.extension().is_none_or(|extension| !extension.eq_ignore_ascii_case("ies")) {
            return fail("a luminaire file's name ends in .ies");
        }
        if options.units != UnitsName::Photometric {
            return fail("a luminaire file is in candela; add --units photometric if the scene's lamps are in lumens");
        }
        if loaded.needs.channels == Channels::Rgb {
            return fail("the scene has colours and a luminaire file has none; make its lamps and coatings grey");
        }
        is_writable(path)?;
        Ok(Self { path: path.into(), sensor: goniometer.id.clone(), film: goniometer.film })
    }

    /// Writes the table that has the flux counted in every cell.
    pub(crate) fn write(&self, measurement: &Measurement) -> Result<(), Failure> {
        let of_sensor = measurement.readings.iter().filter(|reading| reading.sensor == self.sensor);
        let [columns, rows] = [self.film.width, self.film.height].map(|count| count as usize);
        let flux: Vec<f64> = of_sensor
            .map(|reading| {
                let edge = |row: u32| (PI * f64::from(row) / rows as f64).cos();
                let solid_angle = TAU / columns as f64 * (edge(reading.cell[1]) - edge(reading.cell[1] + 1));
                reading.value.unwrap_or(0.0) * solid_angle
            })
            .collect();
        let table = IntensityTable::from_cells(columns, rows, &flux);
        let table =
            table.map_err(|error| Failure::usage(format!("the luminaire of sensor `{}` {error}", self.sensor)))?;
        let how = format!("photonlab, {} photons, {columns} x {rows} cells", measurement.photons);
        let labels = [("TEST", how.as_str()), ("MANUFAC", "none"), ("LUMINAIRE", measurement.scene.as_str())];
        write_whole(&self.path, write_lm63(&table, &labels).as_bytes())?;
        Ok(())
    }
}
