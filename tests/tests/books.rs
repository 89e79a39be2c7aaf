//! Where the flux went: surfaces against their reflectance, roulette against zero, and everything against the emission.

use photonlab_measure::{Replicates, welch_test};
use photonlab_photometry::{Channels, Colour};
use photonlab_reference::{
    ball_lens::BallLens,
    catalogue,
    cube::Cube,
    furnace::Furnace,
    integrating_sphere::IntegratingSphere,
    pane::{Pane, Polarisation},
};
use photonlab_scene::Bsdf;
use photonlab_tests::{Family, Lab, scene_file, scene_text, seed};
use photonlab_trace::{Classes, Ledger, Limits, SurfaceBook};

/// Independent passes of one scene.
const PASSES: u32 = 64;

fn coloured_sphere() -> String {
    let (flux, reflectance) = (Colour([1.0, 2.0, 3.0]), Colour([0.8, 0.4, 0.2]));
    IntegratingSphere::new(1.0, [0.2, 0.0, -0.5], flux, reflectance).expect("in range").xml()
}

fn ledgers<const C: usize>(lab: &Lab, photons: u64, seed: u64) -> Vec<Ledger<C>> {
    (0..PASSES).map(|pass| lab.trace::<C>(photons, seed, pass, Classes::NONE).ledger).collect()
}

/// What a surface sends back is its reflectance times what arrives; the two are counted apart, ray by ray.
fn judge_reflection<const C: usize>(family: &mut Family, xml: &str, photons: u64, seed: u64) {
    let lab = Lab::new(xml);
    let ledgers = ledgers::<C>(&lab, photons, seed);
    for (index, shape) in lab.world.scene.shapes.iter().enumerate() {
        let Bsdf::Diffuse { reflectance } = &shape.bsdf else {
            continue;
        };
        let reflectance = Colour::<C>::from_rgb(reflectance.rgb().expect("no curve"));
        for channel in 0..C {
            let rho = reflectance[channel];
            let difference = |ledger: &Ledger<C>| {
                let book = &ledger.surfaces[index];
                let absorbed = (1.0 - rho) * book.incident[channel];
                let error = book.absorbed[channel] - absorbed;
                assert!(error.abs() <= 1e-9 * absorbed.max(1e-300), "{}: absorbed {error} too much", shape.id);
                (book.incident[channel] - book.outgoing[channel] - absorbed) / ledger.emitted[channel]
            };
            let measured: Replicates = ledgers.iter().map(difference).collect();
            // A black surface sends nothing back, which needs no statistics.
            if rho == 0.0 {
                assert_eq!(measured.mean(), Some(0.0), "{}", shape.id);
            } else {
                family.mean(format!("{}, channel {channel}: flux kept", shape.id), &measured, 0.0);
            }
        }
    }
}

#[test]
fn a_cubes_walls_keep_what_they_do_not_reflect() {
    let mut family = Family::new("reflected flux, cube");
    judge_reflection::<1>(&mut family, &Cube::BENCHMARK.xml(&[]), 4000, seed(400));
    family.decide();
}

#[test]
fn a_coloured_spheres_wall_keeps_what_it_does_not_reflect() {
    let mut family = Family::new("reflected flux, sphere");
    judge_reflection::<3>(&mut family, &coloured_sphere(), 4000, seed(401));
    family.decide();
}

#[test]
fn every_surface_of_the_cornell_box_keeps_what_it_does_not_reflect() {
    let mut family = Family::new("reflected flux, Cornell box");
    judge_reflection::<3>(&mut family, &scene_text("cornell-box.xml"), 4000, seed(402));
    family.decide();
}

#[test]
fn the_floor_below_a_ball_lens_keeps_what_it_does_not_reflect() {
    let mut family = Family::new("reflected flux, ball lens");
    judge_reflection::<1>(&mut family, &BallLens::BENCHMARK.xml(0.5, 0.6, 8), 4000, seed(403));
    family.decide();
}

/// Roulette gives back in the mean what it takes, in every channel.
#[test]
fn roulette_changes_no_channels_mean() {
    let mut family = Family::new("roulette");
    let mut judge = |name: &str, roulette: Vec<Replicates>| {
        for (channel, balance) in roulette.iter().enumerate() {
            family.mean(format!("{name}, channel {channel}"), balance, 0.0);
        }
    };
    fn balance<const C: usize>(ledgers: &[Ledger<C>]) -> Vec<Replicates> {
        let of = |c: usize| ledgers.iter().map(|l| l.total().roulette()[c] / l.emitted[c]).collect();
        (0..C).map(of).collect()
    }
    judge("cube", balance(&ledgers::<1>(&Lab::new(&Cube::BENCHMARK.xml(&[])), 4000, seed(410))));
    judge("sphere", balance(&ledgers::<3>(&Lab::new(&coloured_sphere()), 4000, seed(411))));
    judge("Cornell box", balance(&ledgers::<3>(&Lab::new(&scene_text("cornell-box.xml")), 4000, seed(412))));
    judge("ball lens", balance(&ledgers::<1>(&Lab::new(&BallLens::BENCHMARK.xml(0.5, 0.6, 8)), 4000, seed(413))));
    family.decide();
}

/// Emitted + roulette = absorbed + escaped + cut off to rounding, with and without limits on the path.
#[test]
fn all_flux_is_accounted_for() {
    fn judge<const C: usize>(name: &str, xml: &str) {
        let lab = Lab::new(xml);
        for max_segments in [None, Some(1), Some(2), Some(5)] {
            let limits = Limits { max_segments, max_specular: 3 };
            let ledger = lab.trace_within::<C>(20_000, seed(420), 0, Classes::NONE, limits).ledger;
            let total = ledger.total();
            for channel in 0..C {
                let (emitted, accounted) = (ledger.emitted[channel], total.accounted()[channel]);
                assert!((accounted / emitted - 1.0).abs() < 1e-10, "{name} {max_segments:?}: {emitted} {accounted}");
                let at_surfaces: f64 = ledger.surfaces.iter().map(|book| book.absorbed[channel]).sum();
                assert!(
                    (at_surfaces - total.absorbed[channel]).abs() < 1e-10 * emitted,
                    "{name}: surfaces {at_surfaces}"
                );
            }
            let cut = total.cut_off.max();
            assert_eq!(
                cut > 0.0,
                max_segments.is_some() || name == "ball lens",
                "{name} {max_segments:?}: cut off {cut}"
            );
        }
    }
    let furnace = Furnace::new(Colour([1.0]), Colour([0.7])).expect("in range").cube_xml(1.0, &[]);
    judge::<1>("cube", &Cube::BENCHMARK.xml(&[]));
    judge::<3>("sphere", &coloured_sphere());
    judge::<3>("Cornell box", &scene_text("cornell-box.xml"));
    judge::<1>("ball lens", &BallLens::BENCHMARK.xml(0.5, 0.6, 8));
    judge::<1>("furnace", &furnace);
}

/// A limit of n segments leaves the bounces up to n - 1 and books the rest as cut off.
#[test]
fn a_path_limit_is_obeyed_to_the_segment() {
    let lab = Lab::new(&coloured_sphere());
    for max in [1, 2, 7] {
        let limits = Limits { max_segments: Some(max), ..Limits::default() };
        let traced = lab.trace_within::<3>(20_000, seed(430), 0, Classes::ALL, limits);
        let longest = traced.photons.iter().map(|photon| u32::from(photon.segments)).max();
        assert_eq!(longest, Some(max));
    }
}

/// Photons of each of [`PASSES`] passes of every scene.
const FEW: u64 = 32;

/// What is one flux counted in two ways, in one scene: to rounding where no chance is between them, else by Student's t of
/// each surface and channel, the least likely of which is compared (Sidak).
fn judge_books<const C: usize>(family: &mut Family, name: &str, lab: &Lab, seed: u64) {
    let scene = &lab.world.scene;
    let limits = Limits { max_segments: scene.max_depth, ..Limits::default() };
    let trace = |pass| lab.trace_within::<C>(FEW.max(lab.lamps() as u64), seed, pass, Classes::NONE, limits).ledger;
    let ledgers: Vec<Ledger<C>> = (0..PASSES).map(trace).collect();
    let mut p_values = Vec::new();
    let mut compare = |what: String, differences: Vec<f64>| {
        // What is zero but for rounding needs no statistics.
        let p = if differences.iter().all(|d| d.abs() < 1e-9) {
            1.0
        } else {
            let differences: Replicates = differences.into_iter().collect();
            let zero: Replicates = [0.0, 0.0].into_iter().collect();
            welch_test(&differences, &zero).map_or(f64::NAN, |test| test.p_value)
        };
        p_values.push((p, what));
    };
    for channel in 0..C {
        // A channel in which a pass emits nothing has no books.
        let lit: Vec<&Ledger<C>> = ledgers.iter().filter(|ledger| ledger.emitted[channel] > 0.0).collect();
        for ledger in &lit {
            let (emitted, total) = (ledger.emitted[channel], ledger.total());
            let same = |what: &str, a: f64, b: f64| {
                assert!((a - b).abs() <= 1e-9 * emitted.max(a.abs()), "{name}, channel {channel}: {what}: {a}, {b}");
            };
            same("fates", total.accounted()[channel], emitted);
            if scene.media.is_empty() {
                let sum =
                    |of: fn(&SurfaceBook<C>) -> Colour<C>| ledger.surfaces.iter().map(|b| of(b)[channel]).sum::<f64>();
                same("absorbed at surfaces", sum(|book| book.absorbed), total.absorbed[channel]);
                // Every segment starts at a lamp or a surface and ends at one, outside, or at the path's limit.
                let (starts, ends) = (emitted + sum(|b| b.outgoing), sum(|b| b.incident) + total.escaped[channel]);
                same("segments", starts, ends + total.cut_off[channel]);
            }
        }
        let of = |difference: &dyn Fn(&Ledger<C>) -> f64| -> Vec<f64> {
            lit.iter().map(|ledger| difference(ledger) / ledger.emitted[channel]).collect()
        };
        compare(format!("roulette, channel {channel}"), of(&|ledger| ledger.total().roulette()[channel]));
        for (index, shape) in scene.shapes.iter().enumerate() {
            let left = |ledger: &Ledger<C>| {
                let book = &ledger.surfaces[index];
                book.incident[channel] - book.outgoing[channel] - book.absorbed[channel]
            };
            compare(format!("{}, channel {channel}", shape.id), of(&left));
        }
    }
    let count = p_values.len() as f64;
    let (p, what) = p_values.into_iter().min_by(|a, b| a.0.total_cmp(&b.0)).expect("roulette at least");
    family.compare(name, -(count * (-p).ln_1p()).exp_m1(), format!("{what}: p = {p:.1e} of {count}"));
}

fn judge_scene(family: &mut Family, name: &str, lab: &Lab, seed: u64) {
    match lab.channels() {
        Channels::Grey => judge_books::<1>(family, name, lab, seed),
        Channels::Rgb => judge_books::<3>(family, name, lab, seed),
        Channels::Spectral => unreachable!("no scene here has spectra"),
    }
}

/// Flux that arrives, leaves, is absorbed and escapes, each counted apart, in every scene of the project and the catalogue.
#[test]
fn the_books_of_every_scene_agree() {
    let mut family = Family::new("books of every scene");
    let mut number = 500_000;
    let mut judge = |name: &str, lab: &Lab| {
        judge_scene(&mut family, name, lab, seed(number));
        number += 1;
    };
    for file in ["ball-lens-lamp", "ball-lens", "cornell-box", "cube", "integrating-sphere", "square-lamp"] {
        judge(file, &Lab::open(&scene_file(&format!("{file}.xml"))));
    }
    let folder = tempfile::tempdir().expect("a folder");
    for entry in catalogue::ALL {
        for case in (entry.cases)() {
            let path = folder.path().join("scene.xml");
            std::fs::write(&path, &case.xml).expect("written");
            for (name, text) in &case.files {
                std::fs::write(folder.path().join(name), text).expect("written");
            }
            judge(&format!("{} {}", entry.id, case.name), &Lab::open(&path));
        }
    }
    family.decide();
}

/// Where methods fail: walls that absorb a thousandth, spheres in spheres, rooms a millimetre and a kilometre wide.
#[test]
fn the_books_of_hard_scenes_agree() {
    let mut family = Family::new("books of hard scenes");
    let sphere = |radius: f64, reflectance: f64| {
        let lamp = [0.2 * radius, 0.0, -0.5 * radius];
        IntegratingSphere::new(radius, lamp, Colour([1.0]), Colour([reflectance])).expect("in range").xml()
    };
    let ball = |radius: f64, coating: &str| {
        format!("<shape type=\"sphere\"><float name=\"radius\" value=\"{radius}\"/>{coating}</shape>")
    };
    let glass = |inside: f64, outside: f64| {
        format!(
            "<bsdf type=\"dielectric\"><float name=\"int_ior\" value=\"{inside}\"/>\
             <float name=\"ext_ior\" value=\"{outside}\"/></bsdf>"
        )
    };
    let matte = "<bsdf type=\"diffuse\"><rgb name=\"reflectance\" value=\"0.8\"/></bsdf>";
    let inwards = format!("<boolean name=\"flip_normals\" value=\"true\"/>{matte}");
    let nested = format!(
        "<scene version=\"3.0.0\"><emitter type=\"point\"><point name=\"position\" x=\"0.8\" y=\"0\" z=\"0.1\"/></emitter>\
         {}{}{}{}</scene>",
        ball(1.0, &inwards),
        ball(0.6, &glass(1.5, 1.0)),
        ball(0.4, &glass(1.33, 1.5)),
        ball(0.2, matte)
    );
    let scenes = [
        ("walls of 0.999", sphere(1.0, 0.999)),
        ("a millimetre wide", sphere(1e-3, 0.8)),
        ("a kilometre wide", sphere(1e3, 0.8)),
        ("spheres in spheres", nested),
    ];
    for (number, (name, xml)) in scenes.iter().enumerate() {
        let lab = Lab::new(xml);
        judge_scene(&mut family, name, &lab, seed(440 + number as u32));
        // What arrives on the wall of an integrating sphere in all is the flux over 1 - rho.
        let rho: f64 = [0.999, 0.8, 0.8, 0.0][number];
        if rho > 0.0 {
            let ledgers = ledgers::<1>(&lab, 250, seed(450 + number as u32));
            let incident: Replicates = ledgers.iter().map(|l| l.surfaces[0].incident[0] / l.emitted[0]).collect();
            family.mean(format!("{name}: incident"), &incident, 1.0 / (1.0 - rho));
        }
    }
    family.decide();
}

/// A square light guide 100 widths long passes what a pane passes: total reflection at its sides keeps the angle to its ends.
#[test]
fn a_light_guide_of_a_hundred_widths_passes_what_a_pane_does() {
    let mut family = Family::new("light guide");
    let end = |z: f64, half: f64, turn: &str, on_it: &str| {
        format!(
            "<shape type=\"rectangle\"><transform name=\"to_world\"><scale value=\"{half}\"/>{turn}\
             <translate z=\"{z}\"/></transform>{on_it}</shape>"
        )
    };
    let lamp = "<emitter type=\"area\"><rgb name=\"radiance\" value=\"1\"/></emitter>";
    let black = "<bsdf type=\"diffuse\"><rgb name=\"reflectance\" value=\"0\"/></bsdf>";
    let guide = "<shape type=\"cube\"><transform name=\"to_world\"><scale x=\"0.5\" y=\"0.5\" z=\"50\"/></transform>\
                 <bsdf type=\"dielectric\"><float name=\"int_ior\" value=\"1.5\"/><float name=\"ext_ior\" value=\"1\"/></bsdf></shape>";
    // The lamp is narrower than the guide and the black plates are wider, each a micrometre from the next: to slip out
    // sideways light would have to cross a tenth in that gap, which one ray in 10^10 does.
    let (plate, lamp) = (end(-50.000002, 0.6, "", black), end(-50.000001, 0.4, "", lamp));
    let receiver = end(50.000001, 0.6, "<rotate x=\"1\" angle=\"180\"/>", black);
    let lab = Lab::new(&format!("<scene version=\"3.0.0\">{plate}{lamp}{receiver}{guide}</scene>"));
    let limits = Limits { max_specular: 1_000_000, ..Limits::default() };
    let passed = (0..PASSES).map(|pass| {
        let ledger = lab.trace_within::<1>(1000, seed(460), pass, Classes::NONE, limits).ledger;
        let (total, emitted) = (ledger.total(), ledger.emitted[0]);
        assert_eq!(total.cut_off[0], 0.0, "nothing is trapped for good");
        assert_eq!(total.escaped[0], 0.0, "nothing leaves through the sides");
        ledger.surfaces[2].incident[0] / emitted
    });
    let passed: Replicates = passed.collect();
    family.mean("passed", &passed, Pane::new(1.5).expect("an index").diffuse_transmittance(Polarisation::Reset));
    family.decide();
}
