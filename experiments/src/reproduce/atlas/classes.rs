//! Path classes counted twice or not at all, and shading normals.

use glam::DVec3;
use photonlab_gather::{AreaModel, Bandwidth, Estimator, Kernel, OpenPlane, PhotonMap, Surroundings};
use photonlab_kdtree::SplitRule;
use photonlab_measure::Axis;
use photonlab_photometry::{PackedDirection, PathClass, Photon};
use photonlab_reference::atlas::{direct_left_out, direct_twice, without_factor};
use photonlab_sampling::Sight;

use super::{
    mode::{Curve, Mode, Part, each},
    photons::{NO_TEST, facing_up, map, read, square},
};

const BALL: Bandwidth = Bandwidth::Radius(1.0);

/// Direct light sampled and in the map, or in neither.
pub(super) fn path_classes(part: &Part) -> anyhow::Result<Mode> {
    let photons = part.photons;
    const SUM: &str = "sum of the classes";
    Ok(Mode {
        id: "path-classes",
        title: "Path classes counted twice or left out",
        x: Axis::linear("share of direct light"),
        y: Axis::linear("reading over the irradiance"),
        truth: None,
        between: true,
        curves: vec![
            Curve::off("direct sampled and from the map", SUM, direct_twice),
            Curve::off("direct neither sampled nor from the map", SUM, direct_left_out),
            Curve::on("direct sampled, the map without it", SUM, |_| 1.0),
        ],
        trial: each(move |share, stream, scratch| {
            let mut field = square(photons, 1.0, stream);
            for photon in &mut field.photons {
                let direct = stream.next() < share;
                photon.class = if direct { PathClass::Direct } else { PathClass::Indirect };
            }
            let at = facing_up([0.0; 3]);
            let (positions, kept): (Vec<_>, Vec<_>) = field
                .positions
                .iter()
                .zip(&field.photons)
                .filter(|(_, photon)| photon.class == PathClass::Indirect)
                .unzip();
            let indirect = PhotonMap::build(positions, kept, SplitRule::Median)?;
            let all = read(&map(field)?, &at, BALL, &NO_TEST, scratch);
            let rest = read(&indirect, &at, BALL, &NO_TEST, scratch);
            Ok([share + all, rest, share + rest])
        }),
    })
}

/// How a smooth surface weighs the photons on its faces.
struct Smooth(Sight<1>);

impl Surroundings<Photon<1>> for Smooth {
    fn weigh(&self, photon: &Photon<1>) -> f64 {
        let vector = |packed: PackedDirection| DVec3::from(packed.unpack().map(f64::from));
        self.0.weight_of_flux(-vector(photon.direction), vector(photon.normal))
    }
}

/// Parallel light on a face that stands for a smooth surface of another normal.
pub(super) fn shading_normals(part: &Part) -> anyhow::Result<Mode> {
    let photons = part.photons;
    /// From the face's normal, degrees.
    const INCIDENCE: f64 = 30.0;
    Ok(Mode {
        id: "shading-normals",
        title: "Shading normals without the photons' factor",
        x: Axis::linear(
            "tilt of the shading normal towards the light, degrees (light 30 degrees from the face's normal)",
        ),
        y: Axis::linear("reading over the smooth surface's irradiance"),
        truth: None,
        between: true,
        curves: vec![
            Curve::off("photons count their flux", "ratio of cosines", |tilt: f64| {
                without_factor(INCIDENCE.to_radians(), tilt.to_radians())
            }),
            Curve::on("photons count by both cosines", "the smooth surface's own", |_| 1.0),
        ],
        trial: each(move |tilt, stream, scratch| {
            let towards = |degrees: f64| {
                let (sine, cosine) = degrees.to_radians().sin_cos();
                DVec3::new(sine, 0.0, cosine)
            };
            let light = towards(INCIDENCE);
            let mut field = square(photons, 1.0, stream);
            for photon in &mut field.photons {
                photon.direction = PackedDirection::pack((-light).to_array());
            }
            let (map, at) = (map(field)?, facing_up([0.0; 3]));
            let mut sight = Sight::meter(DVec3::Z, None);
            sight.normals.shading = towards(tilt);
            // The irradiance of the face is 1.
            let truth = light.dot(sight.normals.shading) / light.z;
            let estimator = Estimator::new(Kernel::Disc, AreaModel::Disc);
            let plain = map.gather_among(&at, BALL, estimator, &NO_TEST, &OpenPlane, scratch).irradiance[0];
            let weighed = map.gather_among(&at, BALL, estimator, &NO_TEST, &Smooth(sight), scratch).irradiance[0];
            Ok([plain / truth, weighed / truth])
        }),
    })
}
