//! Scenes read by experiments as the command would read them.

use photonlab_photometry::Response;
use photonlab_readout::{
    Cell, ErrorOver, Outcome, ReadError, Schedule, Session, Settings, Silent, Source, Target, Wanted,
};
use photonlab_sampling::PassOptics;
use photonlab_scene::{
    Needs, World,
    read::{read_scene, read_scene_str},
};

/// A scene ready for repeated reading.
pub(super) struct Lab {
    pub(super) world: World,
    pub(super) needs: Needs,
}

impl Lab {
    /// Reads a scene from its text.
    pub(super) fn new(name: &str, xml: &str, defines: &[(&str, &str)]) -> anyhow::Result<Self> {
        let defines: Vec<_> = defines.iter().map(|(name, value)| (name.to_string(), value.to_string())).collect();
        let scene = read_scene_str(xml, name, &defines).map_err(|error| anyhow::anyhow!("{error}"))?;
        Ok(Self { needs: Needs::of(&scene), world: World::new(scene) })
    }

    /// Reads a scene from a file.
    pub(super) fn open(path: &std::path::Path) -> anyhow::Result<Self> {
        let scene = read_scene(path, &[]).map_err(|error| anyhow::anyhow!("{error}"))?;
        Ok(Self { needs: Needs::of(&scene), world: World::new(scene) })
    }

    /// Reads cells.
    pub(super) fn read<const C: usize>(
        &self,
        cells: &[Cell],
        settings: Settings,
        wanted: &Wanted,
        confidence: f64,
    ) -> Result<Outcome<C>, ReadError> {
        self.read_from(cells, settings, wanted, confidence, &Source::Trace)
    }

    /// Reads cells with photons from a saved map, or traced.
    pub(super) fn read_from<const C: usize>(
        &self,
        cells: &[Cell],
        settings: Settings,
        wanted: &Wanted,
        confidence: f64,
        source: &Source<'_, C>,
    ) -> Result<Outcome<C>, ReadError> {
        let optics = PassOptics::new(&self.world, Response::Radiometric)?;
        let is_image = cells.first().is_some_and(|cell| matches!(cell.target, Target::Pixel { .. }));
        let error_over = if is_image { ErrorOver::Image } else { ErrorOver::Worst };
        let session =
            Session { world: &self.world, optics: &optics, needs: &self.needs, settings, confidence, error_over };
        let schedule = Schedule::new(wanted, cells.len(), &session.demands());
        session.run(cells, &schedule, source, &Silent)
    }
}
