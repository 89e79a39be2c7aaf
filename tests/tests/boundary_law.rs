//! Estimates that know where the surface ends, on synthetic photons and in whole scenes (catalogue B1, B2, B4 with its
//! normal test, B6).

use std::f64::consts::PI;

use glam::DVec3;
use photonlab_gather::{AreaModel, Bandwidth, Estimate, Estimator, Inside, Kernel, Tests};
use photonlab_readout::{Direct, Method};
use photonlab_reference::{edge_laws::HalfPlaneMoments, furnace::Furnace};
use photonlab_tests::{Family, Field, Lab, column, replicates, seed, settings};

/// Search radius in metres; photons per square metre.
const RADIUS: f64 = 0.5;
const DENSITY: f64 = 256.0;

/// Distances from a straight edge in radii.
const PLACES: [f64; 4] = [0.0, 0.25, 0.5, 1.0];

/// Gathers beside the straight edge x = 0 of a field whose irradiance has a slope and a bend away from it, per radius.
fn beside_edge(field: Field, [slope, bend]: [f64; 2], area: AreaModel, bandwidth: Bandwidth) -> [Estimate<1>; 4] {
    let field = field.shaded(|at| 1.0 + slope * at.x / RADIUS + bend * (at.x / RADIUS).powi(2));
    let at = PLACES.map(|t| (DVec3::new(t * RADIUS, 0.0, 0.0), DVec3::Z));
    let estimator = Estimator::new(Kernel::Disc, area);
    field.gather_among(at, bandwidth, estimator, &Tests::default(), |query, radius| {
        let m = HalfPlaneMoments::new(PLACES[query] * RADIUS / radius);
        let second = [[m.across, 0.0, 0.0], [0.0, m.along, 0.0], [0.0; 3]];
        Some(Inside { area: m.area, first: [m.first, 0.0, 0.0], second, open: true })
    })
}

fn lit(stream: &mut photonlab_sampling::Stream) -> Field {
    Field::default().floor(DENSITY, [0.0, -2.5 * RADIUS], [4.0 * RADIUS, 2.5 * RADIUS], stream)
}

/// The clipped area reads even light, and of uneven light what the law says; a linear fit reads the
/// slope too.
#[test]
fn at_a_straight_edge_the_clipped_area_reads_even_light_and_a_linear_fit_a_slope() {
    let mut family = Family::new("clipped at an edge");
    for (slope, bend, area, seed_of) in [
        (0.0, 0.0, AreaModel::Clipped, 1600),
        (0.6, 0.3, AreaModel::Clipped, 1601),
        (0.6, 0.0, AreaModel::Linear, 1602),
        (0.6, 0.3, AreaModel::Linear, 1603),
    ] {
        let rows = replicates(6000, seed(seed_of), |stream| {
            beside_edge(lit(stream), [slope, bend], area, Bandwidth::Radius(RADIUS))
        });
        for (i, t) in PLACES.into_iter().enumerate() {
            // The irradiance and its slope at the query, and the law of light that is 1 there.
            let (here, slope_here) = (1.0 + slope * t + bend * t * t, slope + 2.0 * bend * t);
            let law = HalfPlaneMoments::new(t);
            let read = match area {
                AreaModel::Linear => law.linear(bend / here),
                _ => law.clipped(slope_here / here, bend / here),
            };
            family.mean(format!("{area:?}, slope {slope}, bend {bend}, t = {t}"), &column(&rows, i), here * read);
        }
    }
    family.decide();
}

/// Over the k-th photon's radius the photons inside are even by area on what there is, so that both are unbiased there too.
#[test]
fn at_a_straight_edge_the_nearest_over_the_clipped_area_are_unbiased() {
    let mut family = Family::new("clipped at an edge, nearest");
    let k = 40;
    for (area, seed_of) in [(AreaModel::Clipped, 1610), (AreaModel::Linear, 1611)] {
        let rows = replicates(6000, seed(seed_of), |stream| {
            beside_edge(lit(stream), [0.0; 2], area, Bandwidth::Nearest { k, max_radius: f64::INFINITY })
        });
        for (i, t) in PLACES.into_iter().enumerate() {
            family.mean(format!("{area:?}, t = {t}"), &column(&rows, i), 1.0);
        }
    }
    family.decide();
}

/// A closed room of even light: transport, records, normal test, geometry and estimate together, at and beside edges and
/// corners, with a fixed radius and with the nearest.
#[test]
fn in_a_furnace_both_read_the_truth_up_to_edges_and_corners() {
    let mut family = Family::new("clipped in a furnace");
    let (half_edge, radius) = (2.0, 0.2);
    let furnace =
        Furnace::new(photonlab_photometry::Colour([3.0]), photonlab_photometry::Colour([0.6])).expect("in range");
    let beside = |t: f64| 1.0 - t * radius / half_edge;
    let meters = [
        [beside(0.01), 0.1],
        [beside(0.25), 0.1],
        [beside(0.5), -0.4],
        [beside(0.01), beside(0.01)],
        [beside(0.25), beside(0.5)],
        [beside(1.0), beside(0.5)],
    ];
    let lab = Lab::new(&furnace.cube_xml(half_edge, &meters));
    for (i, (method, area, kernel)) in [
        (Method::Radius { radius: Some(radius) }, AreaModel::Clipped, Kernel::Epanechnikov),
        (Method::Radius { radius: Some(radius) }, AreaModel::Linear, Kernel::Cone),
        (Method::Nearest { k: Some(60) }, AreaModel::Clipped, Kernel::Biweight),
        (Method::Nearest { k: Some(60) }, AreaModel::Linear, Kernel::Gaussian),
    ]
    .into_iter()
    .enumerate()
    {
        let mut settings = settings(method, seed(1620 + i as u32));
        settings.direct = Direct::Photons;
        settings.estimator = Estimator::new(kernel, area);
        let outcome = lab.measure::<1>(settings, 1_500_000, 64, 64);
        for (meter, cell) in meters.iter().zip(&outcome.cells) {
            let expected = 3.0 + 0.6 * furnace.irradiance()[0] / PI;
            family.mean(format!("{}, {area:?}, {kernel:?}, {meter:?}", method.name()), &cell.value[0], expected);
        }
    }
    family.decide();
}

/// Free edges of a rectangle, of a mesh and of a disk under parallel light.
#[test]
fn free_edges_of_rectangles_meshes_and_disks_read_even_light() {
    let mut family = Family::new("clipped at free edges");
    // Two triangles with an uneven diagonal.
    let mesh = "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3\nf 1 3 4\n";
    let sun = r#"<emitter type="directional"><vector name="direction" x="0.3" y="0.1" z="-1"/>
        <rgb name="irradiance" value="2"/></emitter>"#;
    let expected = 2.0 / (1.0f64 + 0.1).sqrt();
    for (i, shape) in ["rectangle", "obj", "disk"].into_iter().enumerate() {
        let file = if shape == "obj" { r#"<string name="filename" value="sheet.obj"/>"# } else { "" };
        let sheet = format!(
            r#"<shape type="{shape}">{file}<bsdf type="diffuse"><rgb name="reflectance" value="0.5"/></bsdf></shape>"#
        );
        let places: [[f64; 2]; 3] = if shape == "disk" {
            [[0.999, 0.0], [0.6, 0.6], [0.0, -0.9]]
        } else {
            [[0.999, 0.2], [0.999, -0.999], [0.85, 0.9]]
        };
        let meters: String = places
            .iter()
            .map(|[x, y]| {
                format!(
                    r#"<sensor type="radiancemeter"><transform name="to_world"><lookat origin="{x} {y} 1" target="{x} {y} 0"
                    up="0 1 0"/></transform><film type="hdrfilm"><integer name="width" value="1"/><integer name="height"
                    value="1"/><rfilter type="box"/></film></sensor>"#
                )
            })
            .collect();
        let lab = Lab::beside("sheet.obj", mesh, &format!("{sun}{sheet}{meters}"));
        for (j, area) in [AreaModel::Clipped, AreaModel::Linear].into_iter().enumerate() {
            let mut settings = settings(Method::Radius { radius: Some(0.3) }, seed(1630 + 2 * i as u32 + j as u32));
            settings.direct = Direct::Photons;
            settings.estimator = Estimator::new(Kernel::Epanechnikov, area);
            let outcome = lab.measure::<1>(settings, 400_000, 64, 64);
            for (place, cell) in places.iter().zip(&outcome.cells) {
                family.mean(format!("{shape}, {area:?}, {place:?}"), &cell.value[0], 0.5 * expected / PI);
            }
        }
    }
    family.decide();
}

/// A floor under parallel light on which a body stands: beside its own edge what is read has an error bar, beside the body it has none,
/// for the floor under it counts as area and gets no light.
#[test]
fn beside_a_body_on_the_floor_nothing_is_certified() {
    let meter = |x: f64, y: f64| {
        format!(
            r#"<sensor type="radiancemeter"><transform name="to_world"><lookat origin="{x} {y} 1" target="{x} {y} 0"
            up="0 1 0"/></transform><film type="hdrfilm"><integer name="width" value="1"/><integer name="height"
            value="1"/><rfilter type="box"/></film></sensor>"#
        )
    };
    // The cube reaches from -0.25 to 0.25; the sun stands high, and its shadow falls away from the meter beside it.
    let scene = format!(
        r#"<scene version="3.0.0"><emitter type="directional"><vector name="direction" x="0" y="0" z="-1"/><rgb name="irradiance" value="2"/></emitter>
        <shape type="rectangle"><bsdf type="diffuse"><rgb name="reflectance" value="0.5"/></bsdf></shape>
        <shape type="cube"><transform name="to_world"><scale value="0.25"/><translate z="0.25"/></transform>
        <bsdf type="diffuse"><rgb name="reflectance" value="0"/></bsdf></shape>
        <shape type="cube"><transform name="to_world"><scale x="0.15" y="0.15" z="0.01"/><translate x="0.6" y="0.6" z="0.01"/></transform>
        <bsdf type="diffuse"><rgb name="reflectance" value="0.5"/></bsdf></shape>{}{}{}{}</scene>"#,
        meter(-0.95, 0.0),
        meter(-0.3, 0.0),
        meter(-0.6, 0.5),
        meter(0.73, 0.6)
    );
    let lab = Lab::new(&scene);
    for (i, method) in [Method::Radius { radius: Some(0.1) }, Method::Nearest { k: Some(400) }].into_iter().enumerate()
    {
        let mut settings = settings(method, seed(1640 + i as u32));
        settings.direct = Direct::Photons;
        settings.estimator = Estimator::new(Kernel::Disc, AreaModel::Clipped);
        let outcome = lab.measure::<1>(settings, 1_000_000, 16, 16);
        let [edge, body, open, book] = [0, 1, 2, 3].map(|cell| &outcome.cells[cell]);
        assert_eq!(edge.astray.mean(), Some(0.0), "at the floor's edge");
        assert_eq!(body.astray.mean(), Some(1.0), "beside the body");
        assert_eq!(open.astray.mean(), Some(0.0), "in the open");
        // The floor below has the same normal, and a part of it is under the book.
        assert_eq!(book.astray.mean(), Some(1.0), "on a book that lies on the floor");
        let read = |cell: &photonlab_readout::CellResult<1>| cell.value[0].mean().unwrap_or(0.0) * PI;
        assert!((read(edge) - 1.0).abs() < edge.half_width(0, 0.9999).unwrap_or(0.0) * PI, "{}", read(edge));
        assert!(read(body) < 0.9, "it lacks what the body hides: {}", read(body));
    }
}
