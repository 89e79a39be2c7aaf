//! Places where a gather ball is not filled by one flat surface, with the laws of what it reads there.

use std::f64::consts::FRAC_PI_2;

use photonlab_gather::{GatherPoint, Tests};
use photonlab_reference::{
    edge_laws::{self, ConcaveCorner},
    nearest_law::{self, Counted, in_field},
};

use super::faces::Face;

/// A place, described by one distance `t` in search radii. All its faces have the irradiance 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Place {
    /// A plane that ends, the query at distance t from its edge.
    FreeEdge,
    /// A plane that ends at two edges, the query at distance t from both.
    FreeCorner,
    /// Two planes that meet at 90 degrees, the query at distance t from the edge.
    Crease,
    /// A slab of thickness t lit on its other side, the query on the dark one.
    ThinWall,
    /// Three planes that meet at right angles, the query at distance t from the two others.
    RoomCorner,
}

/// Which photons count.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Filter {
    All,
    /// Those on surfaces turned like the query's.
    Normal,
    /// Those that arrived on the query's side.
    Side,
}

/// How photons are sought.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Search {
    Radius,
    Nearest,
}

impl Filter {
    pub(super) fn tests(self) -> Tests {
        Tests { normal: self == Filter::Normal, side: self == Filter::Side, max_segments: None }
    }

    pub(super) fn name(self) -> &'static str {
        match self {
            Filter::All => "no test",
            Filter::Normal => "normal test",
            Filter::Side => "side test",
        }
    }
}

impl Search {
    pub(super) fn name(self) -> &'static str {
        match self {
            Search::Radius => "fixed radius",
            Search::Nearest => "k nearest",
        }
    }
}

impl Place {
    pub(super) const ALL: [Place; 5] =
        [Place::FreeEdge, Place::FreeCorner, Place::Crease, Place::ThinWall, Place::RoomCorner];

    pub(super) fn id(self) -> &'static str {
        match self {
            Place::FreeEdge => "free-edge",
            Place::FreeCorner => "free-corner",
            Place::Crease => "crease",
            Place::ThinWall => "thin-wall",
            Place::RoomCorner => "room-corner",
        }
    }

    pub(super) fn name(self) -> &'static str {
        match self {
            Place::FreeEdge => "free edge",
            Place::FreeCorner => "free corner",
            Place::Crease => "concave 90-degree crease",
            Place::ThinWall => "thin wall lit from behind",
            Place::RoomCorner => "concave corner of three faces",
        }
    }

    /// What `t` is, in search radii.
    pub(super) fn distance(self) -> &'static str {
        match self {
            Place::FreeEdge | Place::Crease => "distance from the edge",
            Place::FreeCorner => "distance from both edges",
            Place::ThinWall => "thickness of the wall",
            Place::RoomCorner => "distance from the two other faces",
        }
    }

    /// The curves that tell something about this place.
    pub(super) fn curves(self) -> &'static [(Search, Filter)] {
        use {Filter::*, Search::*};
        match self {
            Place::FreeEdge | Place::FreeCorner => &[(Radius, All), (Nearest, All)],
            Place::Crease | Place::RoomCorner => &[(Radius, All), (Nearest, All), (Radius, Normal), (Nearest, Normal)],
            Place::ThinWall => &[(Radius, All), (Nearest, All), (Radius, Normal), (Radius, Side)],
        }
    }

    /// The lit faces, reaching `reach` metres from the edge, corner or query.
    pub(super) fn faces(self, reach: f64) -> Vec<Face> {
        let along = |axis: usize, from: f64| {
            let mut side = [0.0; 3];
            side[axis] = reach - from;
            side
        };
        // The face with normal `normal` whose sides run along axes `a` and `b` from `from`.
        let face = |normal: usize, [a, b]: [usize; 2], from: [f64; 2]| {
            let (mut corner, mut up) = ([0.0; 3], [0.0; 3]);
            (corner[a], corner[b], up[normal]) = (from[0], from[1], 1.0);
            Face { corner, sides: [along(a, from[0]), along(b, from[1])], normal: up }
        };
        match self {
            Place::FreeEdge => vec![face(2, [0, 1], [0.0, -reach])],
            Place::FreeCorner => vec![face(2, [0, 1], [0.0; 2])],
            Place::Crease => vec![face(2, [0, 1], [0.0, -reach]), face(0, [2, 1], [0.0, -reach])],
            Place::ThinWall => vec![Face { normal: [0.0, 0.0, -1.0], ..face(2, [0, 1], [-reach; 2]) }],
            Place::RoomCorner => {
                vec![face(2, [0, 1], [0.0; 2]), face(0, [2, 1], [0.0; 2]), face(1, [0, 2], [0.0; 2])]
            }
        }
    }

    /// The query at distance `t`, in metres.
    pub(super) fn query(self, t: f64) -> GatherPoint {
        let position = match self {
            Place::FreeEdge | Place::Crease => [t, 0.0, 0.0],
            Place::FreeCorner | Place::RoomCorner => [t, t, 0.0],
            Place::ThinWall => [0.0, 0.0, t],
        };
        GatherPoint { position: position.map(|x| x as f32), normal: [0.0, 0.0, 1.0] }
    }

    /// The mean reading at distance `t` in units of the search radius (k nearest: of sqrt(k / (pi density))), with k - 1
    /// photons counted.
    pub(super) fn law(self, search: Search, filter: Filter, k: u32, t: f64) -> f64 {
        let all = filter == Filter::All;
        let counted = Counted::AllButLast;
        match (self, search) {
            (Place::FreeEdge, Search::Radius) => edge_laws::half_plane(t),
            (Place::FreeEdge, Search::Nearest) => nearest_law::half_plane(k, t, counted).mean,
            (Place::FreeCorner, Search::Radius) => edge_laws::corner(t, t),
            (Place::FreeCorner, Search::Nearest) => nearest_law::corner(k, t, counted).mean,
            (Place::Crease, Search::Radius) if all => edge_laws::crease(t, FRAC_PI_2, 1.0, 1.0).total(),
            (Place::Crease, Search::Nearest) if all => nearest_law::crease(k, t, FRAC_PI_2, counted).mean,
            (Place::Crease, _) => Place::FreeEdge.law(search, Filter::All, k, t),
            (Place::ThinWall, Search::Radius) if all => edge_laws::thin_wall(t),
            (Place::ThinWall, Search::Nearest) if all => nearest_law::thin_wall(k, t, counted).mean,
            (Place::ThinWall, _) => 0.0,
            (Place::RoomCorner, Search::Radius) if all => room_corner(t),
            (Place::RoomCorner, Search::Nearest) if all => {
                // `x` photons of the flat field fill a disc of radius sqrt(x / k) in units of the flat field's radius.
                let expected = |x: f64| x * room_corner(t * (f64::from(k) / x).sqrt());
                let kink = f64::from(k) * t * t;
                in_field(k, counted, expected, &[kink, 2.0 * kink]).mean
            }
            (Place::RoomCorner, _) => Place::FreeCorner.law(search, Filter::All, k, t),
        }
    }
}

fn room_corner(t: f64) -> f64 {
    ConcaveCorner::new(t, t, 1.0, [1.0, 1.0]).total()
}
