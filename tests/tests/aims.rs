//! Photons aimed at what is specular, and evenly spread ones, bring the light that photons bring that leave as their lamp shines, each by
//! itself.

use photonlab_measure::{Replicates, welch_test};
use photonlab_photometry::PathClass;
use photonlab_sampling::Sought;
use photonlab_tests::{Family, Lab, seed};
use photonlab_trace::{Classes, Job, Limits, Traced};

const PASSES: u32 = 48;
const PHOTONS: u64 = 8000;

/// Glass balls whose own balls overlap, and a mirror, over a floor.
const BENCH: &str = r#"<shape type="rectangle" id="floor"><transform name="to_world"><scale value="2"/></transform>
    <bsdf type="diffuse"><rgb name="reflectance" value="0.3"/></bsdf></shape>
    <shape type="sphere" id="left"><point name="center" x="0" y="0" z="1"/><float name="radius" value="0.3"/>
    <bsdf type="dielectric"/></shape>
    <shape type="sphere" id="right"><point name="center" x="0.6" y="0.1" z="1.2"/><float name="radius" value="0.25"/>
    <bsdf type="dielectric"/></shape>
    <shape type="disk" id="mirror"><transform name="to_world"><scale value="0.4"/><rotate x="1" angle="50"/>
    <translate x="0.3" y="0.4" z="1"/></transform><bsdf type="twosided"><bsdf type="conductor"/></bsdf></shape>"#;

fn lamps() -> Vec<(&'static str, String)> {
    let point = |extra: &str| {
        format!(
            r#"<emitter type="point"><point name="position" x="0.2" y="-0.3" z="2.5"/>{extra}
            <rgb name="intensity" value="3"/></emitter>"#
        )
    };
    let area = r#"<bsdf type="diffuse"><rgb name="reflectance" value="0"/></bsdf>
        <emitter type="area"><rgb name="radiance" value="5"/></emitter>"#;
    let tilted = r#"<transform name="to_world"><scale value="0.4"/><rotate x="1" angle="130"/>
        <translate x="-0.5" y="-0.8" z="2"/></transform>"#;
    vec![
        ("point", point("")),
        ("cosine", point(r#"<vector name="direction" x="0.3" y="0.2" z="-1"/><float name="exponent" value="6"/>"#)),
        (
            "spot",
            r#"<emitter type="spot"><transform name="to_world"><lookat origin="0.2 -0.3 2.5" target="0.4 0 1" up="1 0 0"/>
            </transform><float name="cutoff_angle" value="15"/><float name="beam_width" value="5"/>
            <rgb name="intensity" value="9"/></emitter>"#
                .into(),
        ),
        (
            "parallel",
            r#"<emitter type="directional"><vector name="direction" x="0.4" y="0.3" z="-1"/>
            <rgb name="irradiance" value="2"/></emitter>"#
                .into(),
        ),
        ("environment", r#"<emitter type="constant"><rgb name="radiance" value="2"/></emitter>"#.into()),
        ("rectangle", format!(r#"<shape type="rectangle">{tilted}{area}</shape>"#)),
        (
            "sphere",
            format!(
                r#"<shape type="sphere"><point name="center" x="-0.6" y="-0.6" z="2"/><float name="radius" value="0.5"/>{area}</shape>"#
            ),
        ),
        ("faces", format!(r#"<shape type="obj"><string name="filename" value="wedge.obj"/>{tilted}{area}</shape>"#)),
        ("two", format!(r#"{}<shape type="cube">{tilted}{area}</shape>"#, point(""))),
    ]
}

/// A mesh with an edge, both faces shining to one side.
const WEDGE: &str = "v -1 -1 0\nv 1 -1 0\nv 1 1 0.7\nv -1 1 0\nf 1 2 3\nf 1 3 4\n";

/// What is compared: flux sent out, flux that arrives at each shape, caustic flux that the floor keeps and its moment.
const FIGURES: [&str; 7] = ["emitted", "floor", "left", "right", "mirror", "caustic", "moment of the caustic"];

fn figures(traced: &Traced<1>) -> [f64; 7] {
    let arrives = |shape: usize| traced.ledger.surfaces[shape].incident[0];
    let photons = traced.positions.iter().zip(&traced.photons);
    let caustic: Vec<_> = photons.filter(|(_, photon)| photon.class == PathClass::Caustic).collect();
    let sum = |weight: fn(&[f32; 3]) -> f64| caustic.iter().map(|(p, photon)| weight(p) * photon.flux().0[0]).sum();
    let moment = |p: &[f32; 3]| f64::from(p[0]) - 0.3 * f64::from(p[1]);
    [traced.ledger.emitted[0], arrives(0), arrives(1), arrives(2), arrives(3), sum(|_| 1.0), sum(moment)]
}

fn found(seed: u32, trace: impl Fn(Job) -> Traced<1>) -> [Replicates; 7] {
    let all: Vec<[f64; 7]> = (0..PASSES)
        .map(|pass| {
            let job = Job { seed: photonlab_tests::seed(seed), pass, limits: Limits::default(), keep: Classes::ALL };
            figures(&trace(job))
        })
        .collect();
    std::array::from_fn(|i| all.iter().map(|figures| figures[i]).collect())
}

#[test]
fn aimed_and_spread_photons_bring_the_same_light() {
    let mut family = Family::new("aimed and spread photons");
    for (number, (name, lamp)) in lamps().into_iter().enumerate() {
        let lab = Lab::beside("wedge.obj", WEDGE, &format!("{BENCH}{lamp}"));
        let seed = 1700 + 4 * number as u32;
        let plain = found(seed, |job| lab.trace_for(Sought::AsEmitted, PHOTONS, job));
        let others = [
            ("aimed", found(seed + 1, |job| lab.trace_for(Sought::All, PHOTONS, job))),
            ("aimed alone", found(seed + 2, |job| lab.trace_for(Sought::Caustics, PHOTONS, job))),
            ("spread", found(seed + 3, |job| lab.trace_spread(Sought::All, PHOTONS, job))),
        ];
        for (how, other) in others {
            for (what, (other, plain)) in FIGURES.iter().zip(other.iter().zip(&plain)) {
                let p_value = welch_test(other, plain).map_or(f64::NAN, |test| test.p_value);
                let (a, b) = (other.mean(), plain.mean());
                family.compare(format!("{name}, {how}: {what}"), p_value, format!("{a:?} for {b:?}"));
            }
        }
    }
    family.decide();
}

/// Under a small lamp a small lens gets many times its share of the photons, and of caustic light as many times more.
#[test]
fn a_small_lens_gets_more_photons() {
    let lab = Lab::new(&format!(
        r#"<scene version="3.0.0">{BENCH}<emitter type="point"><point name="position" x="0" y="0" z="5"/></emitter></scene>"#
    ));
    let caustic = |sought| {
        let job = Job { seed: seed(1790), pass: 0, limits: Limits::default(), keep: Classes::ALL };
        let traced = lab.trace_for::<1>(sought, 20_000, job);
        traced.photons.iter().filter(|photon| photon.class == PathClass::Caustic).count()
    };
    let plain = caustic(Sought::AsEmitted);
    assert!(caustic(Sought::All) > 10 * plain && caustic(Sought::Caustics) > 30 * plain, "{plain}");
}
