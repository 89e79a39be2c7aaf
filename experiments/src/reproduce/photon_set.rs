//! Photon sets on which trees are tried, in random order: the first are for the tree, the last for its queries.

use photonlab_photometry::Palette;
use photonlab_readout::trace_pass;
use photonlab_sampling::{Optics, Sought, Stream};
use photonlab_trace::Classes;

use super::{field::stream, lab::Lab, strategy::Strategy};

const CUBE: &str = include_str!("../../scenes/cube.xml");
const CORNELL_BOX: &str = include_str!("../../scenes/cornell-box.xml");
const BALL_LENS: &str = include_str!("../../scenes/ball-lens.xml");

/// How photons lie.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum PhotonSet {
    /// Traced: six evenly lit walls.
    Cube,
    /// Traced: walls, and boxes at an angle to the axes.
    CornellBox,
    /// Traced: a floor with a caustic.
    BallLens,
    /// Uniform on the unit square of the plane z = 0.
    Sheet,
    /// Uniform in the unit cube.
    Volume,
}

impl PhotonSet {
    /// In figures and tables.
    pub(super) fn title(self) -> &'static str {
        match self {
            Self::Cube => "CUBE",
            Self::CornellBox => "Cornell box",
            Self::BallLens => "ball lens",
            Self::Sheet => "sheet",
            Self::Volume => "volume",
        }
    }

    /// `count` positions that share no path with another replicate's. A sample of one pass: paths stay whole in number,
    /// not in order.
    pub(super) fn draw(self, count: usize, seed: u64, replicate: u64) -> anyhow::Result<Vec<[f32; 3]>> {
        let random = &mut stream(seed, replicate);
        let place = |x: f64| x as f32;
        match self {
            Self::Cube => traced("cube.xml", CUBE, count, seed, replicate, random),
            Self::CornellBox => traced("cornell-box.xml", CORNELL_BOX, count, seed, replicate, random),
            Self::BallLens => traced("ball-lens.xml", BALL_LENS, count, seed, replicate, random),
            Self::Sheet => Ok((0..count).map(|_| [place(random.next()), place(random.next()), 0.0]).collect()),
            Self::Volume => Ok((0..count).map(|_| [(); 3].map(|()| place(random.next()))).collect()),
        }
    }
}

/// Stored photons of one pass of a scene, in random order.
fn traced(
    name: &str,
    xml: &str,
    count: usize,
    seed: u64,
    replicate: u64,
    random: &mut Stream,
) -> anyhow::Result<Vec<[f32; 3]>> {
    let lab = Lab::new(name, xml, &[])?;
    let optics = Optics::<3>::new(&lab.world, Palette::Channels);
    let settings = Strategy::NEAREST_DIRECT_VIEW.settings(seed);
    let pass =
        |paths| trace_pass(&lab.world, &optics, &settings, (Sought::AsEmitted, Classes::ALL), replicate as u32, paths);
    let mut paths = (count as u64).max(1024);
    loop {
        let mut positions = pass(paths)?.positions;
        if positions.len() >= count {
            shuffle(&mut positions, random);
            positions.truncate(count);
            return Ok(positions);
        }
        anyhow::ensure!(!positions.is_empty(), "{name}: no photon was stored");
        // A little more than in proportion, for the next number is as random as this one.
        paths = (1.05 * paths as f64 * count as f64 / positions.len() as f64) as u64;
    }
}

/// Fisher and Yates.
fn shuffle(positions: &mut [[f32; 3]], random: &mut Stream) {
    for last in (1..positions.len()).rev() {
        positions.swap(last, (random.next() * (last + 1) as f64) as usize);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sets_have_the_count_asked_for_and_differ_by_replicate() {
        for set in [PhotonSet::Cube, PhotonSet::BallLens, PhotonSet::Sheet, PhotonSet::Volume] {
            let [first, again, other] = [0, 0, 1].map(|replicate| set.draw(3000, 7, replicate).unwrap());
            assert_eq!(first.len(), 3000, "{set:?}");
            assert_eq!(first, again, "{set:?}");
            assert_ne!(first, other, "{set:?}");
        }
    }
}
