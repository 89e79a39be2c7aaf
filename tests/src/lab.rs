//! Scenes traced and read in this process, as the command does it.

use std::path::{Path, PathBuf};

use photonlab_gather::Estimator;
use photonlab_photometry::{Channels, Palette, Response};
use photonlab_planner::{Candidate, Forecast, Planner};
use photonlab_readout::{
    Aids, Cell, CellResult, Direct, Ends, ErrorOver, Method, Outcome, Schedule, Session, Settings, Silent, Source,
    Target, Wanted,
};
use photonlab_sampling::{EmissionPlan, Optics, PassOptics, Sought};
use photonlab_scene::{
    Needs, World,
    read::{read_scene, read_scene_str},
};
use photonlab_trace::{Classes, Job, Limits, Traced, trace};

/// A floor below a lamp, with a meter on it; nothing else reflects: direct light alone.
pub const LAMP_OVER_FLOOR: &str = r#"<scene version="3.0.0">
  <shape type="rectangle" id="floor"><bsdf type="diffuse"><rgb name="reflectance" value="0.5"/></bsdf>
    <sensor type="irradiancemeter" id="E"/></shape>
  <shape type="rectangle" id="lamp">
    <transform name="to_world"><rotate x="1" angle="180"/><translate z="1"/></transform>
    <bsdf type="diffuse"><rgb name="reflectance" value="0"/></bsdf>
    <emitter type="area"><rgb name="radiance" value="1"/></emitter>
  </shape>
</scene>"#;

/// Confidence of the intervals that may end a run.
const CONFIDENCE: f64 = 0.95;

/// A scene ready for photons and readings.
pub struct Lab {
    /// The scene.
    pub world: World,
    needs: Needs,
}

/// How a race ended.
pub struct Raced<const C: usize> {
    /// How many entered.
    pub entrants: usize,
    /// Those of the winner.
    pub settings: Settings,
    /// What was foretold of it.
    pub forecast: Option<Forecast>,
    /// What it found.
    pub outcome: Outcome<C>,
}

impl Lab {
    /// Reads a scene from its text.
    ///
    /// # Panics
    /// If the text is no scene.
    pub fn new(xml: &str) -> Self {
        let scene = read_scene_str(xml, "test scene", &[]).unwrap_or_else(|error| panic!("{error}\n{xml}"));
        Self { needs: Needs::of(&scene), world: World::new(scene) }
    }

    /// Reads a scene from its file, with what that names.
    ///
    /// # Panics
    /// If the file is no scene.
    pub fn open(path: &Path) -> Self {
        let scene = read_scene(path, &[]).unwrap_or_else(|error| panic!("{error}"));
        Self { needs: Needs::of(&scene), world: World::new(scene) }
    }

    /// Reads a scene's elements in a folder with one more file.
    ///
    /// # Panics
    /// If they are no scene.
    pub fn beside(file: &str, text: &str, elements: &str) -> Self {
        let folder = tempfile::tempdir().expect("a folder");
        std::fs::write(folder.path().join(file), text).expect("written");
        let path = folder.path().join("scene.xml");
        std::fs::write(&path, format!("<scene version=\"3.0.0\">{elements}</scene>")).expect("written");
        Self::open(&path)
    }

    /// The same scene with all maps and light of all path classes, needed or not.
    pub fn with_everything(mut self) -> Self {
        for need in
            [&mut self.needs.direct, &mut self.needs.caustic, &mut self.needs.indirect, &mut self.needs.in_scattering]
        {
            *need = true;
        }
        self
    }

    /// What is left out of the scene, by name.
    pub fn left_out(&self) -> Vec<&str> {
        self.needs.left_out.iter().map(|need| need.need.as_str()).collect()
    }

    /// The channels that the scene needs.
    pub fn channels(&self) -> Channels {
        self.needs.channels
    }

    /// The number of its lamps: a pass has at least as many photons.
    pub fn lamps(&self) -> usize {
        Optics::<1>::new(&self.world, Palette::Channels).lamps.lamps.len()
    }

    /// Follows the photons of one pass.
    pub fn trace<const C: usize>(&self, photons: u64, seed: u64, pass: u32, keep: Classes) -> Traced<C> {
        self.trace_within(photons, seed, pass, keep, Limits::default())
    }

    /// Follows the photons of one pass up to limits; positions are the scene's own, not the map's.
    pub fn trace_within<const C: usize>(
        &self,
        photons: u64,
        seed: u64,
        pass: u32,
        keep: Classes,
        limits: Limits,
    ) -> Traced<C> {
        self.trace_for(Sought::All, photons, Job { seed, pass, limits, keep })
    }

    /// Follows the photons of one pass that seek some light; positions are the scene's own, not the map's.
    pub fn trace_for<const C: usize>(&self, sought: Sought, photons: u64, job: Job) -> Traced<C> {
        self.follow(sought, photons, job, |plan| plan)
    }

    /// The same of photons that are evenly spread over what their lamps emit.
    pub fn trace_spread<const C: usize>(&self, sought: Sought, photons: u64, job: Job) -> Traced<C> {
        self.follow(sought, photons, job, |plan| plan.spread(job.seed, job.pass))
    }

    fn follow<const C: usize>(
        &self,
        sought: Sought,
        photons: u64,
        job: Job,
        drawn: impl FnOnce(EmissionPlan<C>) -> EmissionPlan<C>,
    ) -> Traced<C> {
        let optics = Optics::new(&self.world, Palette::Channels);
        let plan = drawn(EmissionPlan::new(&optics.lamps, photons, sought).expect("photons for every lamp"));
        let mut traced = trace(&self.world, &optics, &plan, &job).expect("a scene that absorbs");
        let middle = self.world.middle().to_array();
        for position in &mut traced.positions {
            *position = std::array::from_fn(|axis| (f64::from(position[axis]) + middle[axis]) as f32);
        }
        traced
    }

    /// Reads every meter.
    pub fn measure<const C: usize>(&self, settings: Settings, photons: u64, passes: u64, spp: u64) -> Outcome<C> {
        self.measure_as(Response::Radiometric, settings, photons, passes, spp)
    }

    /// Reads every meter in watts or lumens.
    pub fn measure_as<const C: usize>(
        &self,
        response: Response,
        settings: Settings,
        photons: u64,
        passes: u64,
        spp: u64,
    ) -> Outcome<C> {
        self.read(&Cell::of_meters(&self.world.scene), response, settings, photons, passes, spp)
    }

    /// Reads every pixel of the first sensor.
    pub fn render<const C: usize>(&self, settings: Settings, photons: u64, passes: u64, spp: u64) -> Outcome<C> {
        self.read(&Cell::of_sensor(&self.world.scene, 0), Response::Radiometric, settings, photons, passes, spp)
    }

    /// Lets methods race to a wanted error over all meters, and goes on with the first.
    pub fn race<const C: usize>(&self, settings: &[Settings], target: f64) -> Raced<C> {
        let cells = Cell::of_meters(&self.world.scene);
        let optics = PassOptics::new(&self.world, Response::Radiometric).expect("lamps that count");
        let session = self.session(&optics, settings[0], ErrorOver::Worst);
        let candidates = Candidate::of(settings, &session);
        let (cells, trusts) = (&cells, &|_: &CellResult<C>| true);
        let planner = Planner { session, cells, target, time_limit: None, patience: None, trusts };
        let plan = planner.race(&candidates).expect("a scene that can be read");
        let (settings, forecast) = (plan.settings(), plan.forecast);
        let entrants = plan.entrants.len();
        Raced { entrants, settings, forecast, outcome: plan.go_on(&Silent).expect("a scene that can be read") }
    }

    /// Reads every meter in passes of so many photons and points, looking at the run after each of some before it goes on.
    pub fn measure_looking<const C: usize>(&self, settings: Settings, counts: [u64; 3], looks: u64) -> Outcome<C> {
        let [photons, passes, samples] = counts;
        let cells = Cell::of_meters(&self.world.scene);
        let optics = PassOptics::new(&self.world, Response::Radiometric).expect("lamps that count");
        let session = self.session(&optics, settings, ErrorOver::Worst);
        let ends = Ends { passes: Some(passes), target_error: None, time_limit: None };
        let schedule = Schedule::of_passes(photons, samples, ends, &session.demands());
        let mut ongoing = session.begin(&cells, &schedule).expect("a scene that can be read");
        for _ in 0..looks {
            ongoing.pass().expect("a pass");
            let _ = (ongoing.error(), ongoing.error_after(1000));
        }
        ongoing.go_on(&Silent).expect("a scene that can be read")
    }

    fn session<'s, const C: usize>(
        &'s self,
        optics: &'s PassOptics<C>,
        settings: Settings,
        error_over: ErrorOver,
    ) -> Session<'s, C> {
        let (world, needs) = (&self.world, &self.needs);
        Session { world, optics, needs, settings, confidence: CONFIDENCE, error_over }
    }

    fn read<const C: usize>(
        &self,
        cells: &[Cell],
        response: Response,
        settings: Settings,
        photons: u64,
        passes: u64,
        samples: u64,
    ) -> Outcome<C> {
        let optics = PassOptics::new(&self.world, response).expect("lamps that count");
        let is_image = cells.first().is_some_and(|cell| matches!(cell.target, Target::Pixel { .. }));
        let error_over = if is_image { ErrorOver::Image } else { ErrorOver::Worst };
        let session = self.session(&optics, settings, error_over);
        let wanted =
            Wanted { photons: Some(photons), passes: Some(passes), samples: Some(samples), ..Wanted::default() };
        let schedule = Schedule::new(&wanted, cells.len(), &session.demands());
        session.run(cells, &schedule, &Source::Trace, &Silent).expect("a scene that can be read")
    }
}

/// A method's settings as the command sets them when nothing else is asked for.
pub fn settings(method: Method, seed: u64) -> Settings {
    Settings {
        method,
        direct: Direct::Sampled,
        estimator: Estimator::default(),
        gather_rays: 1,
        aids: Aids::default(),
        draws: method.usual_draws(),
        seed,
        limits: Limits::default(),
    }
}

/// The path of one of the project's scenes.
pub fn scene_file(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../experiments/scenes").join(name)
}

/// The text of one of the project's scenes.
pub fn scene_text(name: &str) -> String {
    let path = scene_file(name);
    std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}
