//! The furnace (catalogue D2): every deviation from an even radiance is an estimator's bias.

use photonlab_photometry::Colour;
use photonlab_readout::{Direct, Method};
use photonlab_reference::{edge_laws, furnace::Furnace};
use photonlab_tests::{Family, Lab, seed, settings};

const HALF_EDGE: f64 = 2.0;

fn furnace() -> Furnace<1> {
    Furnace::new(Colour([3.0]), Colour([0.6])).expect("in range")
}

/// Final gather reads the same radiance in the middle of a face, at its edges and in its corners.
#[test]
fn final_gather_sees_an_even_radiance_up_to_edges_and_corners() {
    let mut family = Family::new("furnace, final gather");
    let places =
        [[0.0, 0.0], [0.5, 0.3], [0.9, 0.0], [0.99, 0.2], [0.9999, 0.0], [0.9, 0.9], [0.99, 0.99], [0.9999, 0.9999]];
    let lab = Lab::new(&furnace().cube_xml(HALF_EDGE, &places));
    let outcome = lab.measure::<1>(settings(Method::FinalGather { radius: None }, seed(600)), 1_000_000, 32, 1 << 15);
    for (place, cell) in places.iter().zip(&outcome.cells) {
        family.reading(format!("{place:?}"), cell, 0, furnace().total_radiance()[0]);
    }
    family.decide();
}

/// The map read at the point itself darkens towards an edge as a half-plane does: transport, records, normal test and
/// estimate together. The law is for points well away from a second edge.
#[test]
fn a_map_read_directly_darkens_at_an_edge_by_the_half_plane_law() {
    let mut family = Family::new("furnace, edge darkening");
    let radius = 0.2;
    let places = [0.05, 0.3, 0.6, 0.9];
    let meters = places.map(|t| [1.0 - t * radius / HALF_EDGE, 0.1]);
    let lab = Lab::new(&furnace().cube_xml(HALF_EDGE, &meters));
    let mut settings = settings(Method::Radius { radius: Some(radius) }, seed(601));
    settings.direct = Direct::Photons;
    let outcome = lab.measure::<1>(settings, 4_000_000, 64, 64);
    for (t, cell) in places.iter().zip(&outcome.cells) {
        // The lamp's own radiance is seen straight; the rest comes from the map.
        let irradiance = furnace().irradiance()[0] * edge_laws::half_plane(*t);
        let expected = 3.0 + 0.6 * irradiance / std::f64::consts::PI;
        family.mean(format!("t = {t}"), &cell.value[0], expected);
        assert!(cell.unresolved_share(0) > 0.0, "a ball over an edge is never certified");
    }
    family.decide();
}
