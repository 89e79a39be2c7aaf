//! Paths and stored photons per second of CPU time on one thread, in the Cornell box: in grey, in RGB, by wavelength, and
//! without storing. Best of several rounds in turn. `RATE_PATHS` sets the paths of a round (400 000), `RATE_ROUNDS` the
//! rounds (5).

use photonlab_photometry::{Palette, Photon, Response, WAVELENGTHS};
use photonlab_sampling::{EmissionPlan, Optics, PassOptics, Sought};
use photonlab_scene::{World, read::read_scene_str};
use photonlab_trace::{Classes, Job, Limits, trace};

const SCENE: &str = include_str!("../../../experiments/scenes/cornell-box.xml");

/// A number from the environment.
fn setting(name: &str, default: u64) -> u64 {
    std::env::var(name).ok().and_then(|value| value.parse().ok()).unwrap_or(default)
}

/// The Cornell box in grey, as it is, or with a lamp by wavelength.
fn scene(lamp_and_walls: impl Fn(&str) -> String) -> World {
    let xml: String = SCENE.lines().map(|line| lamp_and_walls(line) + "\n").collect();
    World::new(read_scene_str(&xml, "cornell-box.xml", &[]).expect("the project's own scene"))
}

/// A line with its colour replaced by the mean of the three channels.
fn grey(line: &str) -> String {
    let Some((before, rest)) = line.split_once("<rgb ") else { return line.into() };
    let (inside, after) = rest.split_once("/>").expect("an end");
    let value = inside.split("value=\"").nth(1).expect("a value").trim_end_matches('"');
    let numbers: Vec<f64> = value.split(',').map(|x| x.trim().parse().expect("a number")).collect();
    let mean = numbers.iter().sum::<f64>() / numbers.len() as f64;
    let name = inside.split("value=").next().expect("a name");
    format!("{before}<rgb {name} value=\"{mean}\"/>{after}")
}

/// The same with the lamp's colour as a spectrum.
fn by_wavelength(line: &str) -> String {
    line.replace(
        "<rgb name=\"radiance\" value=\"18.387, 13.9873, 6.75357\"/>",
        "<spectrum name=\"radiance\" value=\"360:1, 830:2\"/>",
    )
}

struct Rate {
    name: &'static str,
    bytes: usize,
    paths: u64,
    stored: usize,
    seconds: f64,
}

fn race<const C: usize>(name: &'static str, world: &World, optics: &Optics<C>, keep: Classes, rates: &mut Vec<Rate>) {
    let paths = setting("RATE_PATHS", 400_000);
    let plan = EmissionPlan::new(&optics.lamps, paths, Sought::AsEmitted).expect("a lamp");
    let job = Job { seed: 1, pass: 0, limits: Limits::default(), keep };
    let start = cpu_seconds();
    let traced = trace(world, optics, &plan, &job).expect("walls that absorb");
    let seconds = cpu_seconds() - start;
    let bytes = size_of::<Photon<C>>() + size_of::<[f32; 3]>();
    match rates.iter_mut().find(|rate| rate.name == name) {
        Some(rate) => rate.seconds = rate.seconds.min(seconds),
        None => rates.push(Rate { name, bytes, paths, stored: traced.photons.len(), seconds }),
    }
}

fn main() {
    rayon::ThreadPoolBuilder::new().num_threads(1).build_global().expect("the first pool");
    let (as_it_is, in_grey, spectral) = (scene(|line| line.into()), scene(grey), scene(by_wavelength));
    let rgb = Optics::<3>::new(&as_it_is, Palette::Channels);
    let one = Optics::<1>::new(&in_grey, Palette::Channels);
    let waves = PassOptics::<WAVELENGTHS>::new(&spectral, Response::Radiometric).expect("a lamp that counts");
    let mut rates = Vec::new();
    for _ in 0..setting("RATE_ROUNDS", 5) {
        race("RGB", &as_it_is, &rgb, Classes::ALL, &mut rates);
        race("RGB, nothing stored", &as_it_is, &rgb, Classes::NONE, &mut rates);
        race("grey", &in_grey, &one, Classes::ALL, &mut rates);
        race("by wavelength", &spectral, waves.any(), Classes::ALL, &mut rates);
    }
    for Rate { name, bytes, paths, stored, seconds } in rates {
        println!(
            "{name:<20} {:.3} M paths/s, {:.3} M photons stored/s, {bytes} bytes a photon",
            paths as f64 / seconds / 1e6,
            stored as f64 / seconds / 1e6,
        );
    }
}

#[allow(unsafe_code)] // The standard library has no CPU clock.
fn cpu_seconds() -> f64 {
    let mut at = libc::timespec { tv_sec: 0, tv_nsec: 0 };
    // SAFETY: the call writes one `timespec`, which `at` is.
    unsafe { libc::clock_gettime(libc::CLOCK_PROCESS_CPUTIME_ID, &mut at) };
    at.tv_sec as f64 + 1e-9 * at.tv_nsec as f64
}
