//! Colours: one that few photons carry, and wavelengths in bins.

use photonlab_gather::{AreaModel, Bandwidth, PhotonMap, Tests};
use photonlab_kdtree::SplitRule;
use photonlab_measure::Axis;
use photonlab_photometry::{Photon, sensitivity};
use photonlab_reference::{
    atlas::{bin_reading, rare_by_nearest, rare_by_radius},
    fixed_radius_law::poisson_variance,
};
use photonlab_sampling::Stream;

use super::{
    mode::{Curve, Mode, Part, each},
    photons::{density, facing_up, nearest, reach_of_nearest, square},
};

/// The line of sodium, nanometres.
const LINE: f64 = 589.3;
/// Where the rare colour stands.
const BLUE: usize = 2;

/// Irradiance 1 in red and in blue, the share of photons that are blue given.
fn red_and_blue(photons: f64, share: f64, stream: &mut Stream) -> anyhow::Result<PhotonMap<3>> {
    let field = square(photons, reach_of_nearest(photons), stream);
    let coloured = |photon: &Photon<1>, blue: bool| {
        let (red, blue) = if blue { (0.0, 1.0 / share) } else { (1.0 / (1.0 - share), 0.0) };
        let flux = [red, 0.0, blue].map(|x| (x / density(photons)) as f32);
        let &Photon { direction, normal, class, segments, .. } = photon;
        Photon { flux, direction, normal, class, segments }
    };
    let photons = field.photons.iter().map(|photon| coloured(photon, stream.next() < share)).collect();
    Ok(PhotonMap::build(field.positions, photons, SplitRule::Median)?)
}

/// Lamps of unlike power and colour: photons follow the flux, and the weak colour has few.
pub(super) fn ratio(part: &Part) -> anyhow::Result<Mode> {
    let k = part.photons;
    let share = |ratio: f64| 1.0 / (1.0 + ratio);
    Ok(Mode {
        id: "colour-ratio",
        title: "Extreme ratio of colours",
        x: Axis::log("red photons for each blue one"),
        y: Axis::log("squared error of blue over its irradiance squared"),
        truth: None,
        between: true,
        curves: vec![
            Curve::off("k nearest of all colours", "binomial share of the k nearest", move |ratio| {
                rare_by_nearest(k as u32, share(ratio))
            }),
            Curve::off("fixed radius", "sum of rare photons (catalogue A1)", move |ratio| {
                rare_by_radius(k, share(ratio))
            }),
            Curve::on("photons in every colour, fixed radius", "count (catalogue A1)", move |_| poisson_variance(k)),
        ],
        trial: each(move |ratio, stream, scratch| {
            let at = facing_up([0.0; 3]);
            let rare = red_and_blue(k, share(ratio), stream)?;
            let ball = Bandwidth::Radius(1.0);
            let mut error = |map: &PhotonMap<3>, search| {
                let read = map.gather(&at, search, AreaModel::Disc, &Tests::default(), scratch).irradiance[BLUE];
                (read - 1.0).powi(2)
            };
            let (of_nearest, of_ball) = (error(&rare, nearest(k)), error(&rare, ball));
            let mut all = square(k, 1.0, stream);
            let each = |photon: &Photon<1>| {
                let &Photon { direction, normal, class, segments, flux: [flux] } = photon;
                Photon { flux: [flux; 3], direction, normal, class, segments }
            };
            let photons = all.photons.iter().map(each).collect();
            let map = PhotonMap::build(std::mem::take(&mut all.positions), photons, SplitRule::Median)?;
            Ok([of_nearest, of_ball, error(&map, ball)])
        }),
    })
}

/// A line whose bin's middle is weighed by the eye in its place.
pub(super) fn bins(_: &Part) -> anyhow::Result<Mode> {
    Ok(Mode {
        id: "wavelength-bins",
        title: "Sodium line in bins of wavelength",
        x: Axis::log("width of a bin, nm"),
        y: Axis::linear("lumens read over the truth"),
        truth: None,
        between: true,
        curves: vec![
            Curve::off("eye at the bin's middle", "mean over all places of the bins", |width| bin_reading(LINE, width)),
            Curve::on("eye at the photon's wavelength", "the line itself", |_| 1.0),
        ],
        trial: each(|width, stream, _| {
            let truth = sensitivity(LINE);
            let middle = LINE + width * (stream.next() - 0.5);
            Ok([sensitivity(middle) / truth, sensitivity(LINE) / truth])
        }),
    })
}
