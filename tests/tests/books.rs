//! Where the flux went: surfaces against their reflectance, roulette against zero, and everything against the emission.

use photonlab_measure::Replicates;
use photonlab_photometry::Colour;
use photonlab_reference::{ball_lens::BallLens, cube::Cube, furnace::Furnace, integrating_sphere::IntegratingSphere};
use photonlab_scene::Bsdf;
use photonlab_tests::{Family, Lab, scene_text, seed};
use photonlab_trace::{Classes, Ledger, Limits};

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
