//! Ends of surfaces and concave corners, at which the disc is not full.

use photonlab_gather::{AreaModel, Bandwidth, Estimator, Kernel, SAME_SURFACE};
use photonlab_measure::Axis;
use photonlab_reference::edge_laws::HalfPlaneMoments;

use super::{
    ground::Ground,
    mode::{Curve, Law, Mode, Part},
    photons::{NO_TEST, density, map, nearest, read, read_among},
};
use crate::reproduce::{
    edges::{Filter, Place, Search},
    faces::lit,
};

/// How far the faces reach, in search radii: beyond the k-th photon even in the corner of a quadrant.
const REACH: f64 = 4.0;

const LAWS: &str = "edge laws (catalogue B1 to B5, B7)";
const WHOLE: &str = "even light over the surface that is there";

pub(super) fn free_edge(part: &Part) -> anyhow::Result<Mode> {
    at(Place::FreeEdge, "Free edge", true, part)
}

pub(super) fn free_corner(part: &Part) -> anyhow::Result<Mode> {
    at(Place::FreeCorner, "Free corner", true, part)
}

/// The corner of a room: what a test of normals takes away is not given back by the disc.
pub(super) fn room_corner(part: &Part) -> anyhow::Result<Mode> {
    at(Place::RoomCorner, "Corner of three faces: the normal test undershoots", true, part)
}

pub(super) fn thin_wall(part: &Part) -> anyhow::Result<Mode> {
    at(Place::ThinWall, "Thin wall lit from behind", false, part)
}

/// The readings at a place; `clipped` adds those over the surface inside, with both searches.
fn at(place: Place, title: &'static str, clipped: bool, part: &Part) -> anyhow::Result<Mode> {
    let (k, faces) = (part.photons, place.faces(REACH));
    let ground = Ground::of_faces(&faces, f64::from(SAME_SURFACE))?;
    let plain: Vec<(Search, Filter)> = place.curves().to_vec();
    let alone = matches!(place, Place::FreeEdge | Place::FreeCorner);
    let mut curves: Vec<Curve> = plain
        .iter()
        .map(|&(search, filter)| {
            let label = if alone { search.name().to_string() } else { format!("{}, {}", search.name(), filter.name()) };
            let law = move |t| place.law(search, filter, k as u32, t);
            if filter == Filter::All { Curve::off(label, LAWS, law) } else { Curve::on(label, LAWS, law) }
        })
        .collect();
    let over_surface: &[Search] = if clipped { &[Search::Radius, Search::Nearest] } else { &[] };
    let test = if alone { Filter::All } else { Filter::Normal };
    curves.extend(
        over_surface.iter().map(|search| Curve::on(format!("{}, surface inside", search.name()), WHOLE, |_| 1.0)),
    );
    let bandwidth = move |search| match search {
        Search::Radius => Bandwidth::Radius(1.0),
        Search::Nearest => nearest(k),
    };
    Ok(Mode {
        id: place.id(),
        title,
        x: Axis::linear(format!("{} over the search radius", place.distance())),
        y: Axis::linear("reading over the lit faces' irradiance"),
        truth: (place == Place::ThinWall).then(|| ("truth", Box::new(|_| 0.0) as Law)),
        between: true,
        curves,
        trial: Box::new(move |sweep, stream, scratch| {
            let map = map(lit(&faces, density(k), stream))?;
            let mut values = Vec::new();
            for &t in sweep {
                let at = place.query(t);
                for &(search, filter) in &plain {
                    values.push(read(&map, &at, bandwidth(search), &filter.tests(), scratch));
                }
                for &search in over_surface {
                    let around = ground.around(&at);
                    values.push(read_among(&map, &at, bandwidth(search), &test.tests(), &around, scratch));
                }
            }
            Ok(values)
        }),
    })
}

/// Light that rises away from the edge, per search radius, from 1 on it.
const SLOPE: f64 = 1.0;

/// A free edge in light that is not even: the surface inside lies to one side.
pub(super) fn slope(part: &Part) -> anyhow::Result<Mode> {
    let photons = part.photons;
    let faces = Place::FreeEdge.faces(REACH);
    let ground = Ground::of_faces(&faces, f64::from(SAME_SURFACE))?;
    const MOMENTS: &str = "moments of what an edge leaves of the disc (catalogue B1)";
    let irradiance = |t: f64| 1.0 + SLOPE * t;
    let clipped = move |t: f64| HalfPlaneMoments::new(t).clipped(SLOPE / irradiance(t), 0.0);
    let areas = [AreaModel::Disc, AreaModel::Clipped, AreaModel::Linear];
    Ok(Mode {
        id: "edge-slope",
        title: "Free edge in light that rises away from it",
        x: Axis::linear("distance from the edge over the search radius"),
        y: Axis::linear("reading over the irradiance"),
        truth: None,
        between: true,
        curves: vec![
            Curve::off("disc", MOMENTS, move |t| HalfPlaneMoments::new(t).area * clipped(t)),
            Curve::on("surface inside", MOMENTS, clipped),
            Curve::on("surface inside, slope fitted", MOMENTS, |t| HalfPlaneMoments::new(t).linear(0.0)),
        ],
        trial: Box::new(move |sweep, stream, scratch| {
            let mut field = lit(&faces, density(photons), stream);
            for (position, photon) in field.positions.iter().zip(&mut field.photons) {
                photon.flux[0] *= irradiance(f64::from(position[0])) as f32;
            }
            let map = map(field)?;
            let mut values = Vec::new();
            for &t in sweep {
                let at = Place::FreeEdge.query(t);
                let around = ground.around(&at);
                values.extend(areas.map(|area| {
                    let (ball, estimator) = (Bandwidth::Radius(1.0), Estimator::new(Kernel::Disc, area));
                    let read = map.gather_among(&at, ball, estimator, &NO_TEST, &around, scratch);
                    read.irradiance[0] / irradiance(t)
                }));
            }
            Ok(values)
        }),
    })
}
