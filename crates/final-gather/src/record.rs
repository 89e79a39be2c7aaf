//! Where an irradiance cache looks around, and what it finds there.

use glam::DVec3;
use photonlab_gather::Scratch;
use photonlab_sampling::{Sight, Stream, warp::Frame};
use photonlab_scene::{SurfacePoint, World};

use crate::{
    Gatherer, Light,
    cache::WIDEST,
    hemisphere::{Found, Gradients, Strata},
    parting::is_parted,
};

/// Of a place's neighbours only those stand on its surface, as far as a cache is concerned, that lie so near the plane between both
/// normals, over their distance: no step, no parallel shelf. On planes and spheres it is zero.
pub(crate) const OFF_PLANE: f64 = 0.02;

/// A place whose reflected light stands for that around it.
#[derive(Clone, Copy, Debug)]
pub struct Spot<const C: usize> {
    /// The point.
    pub at: SurfacePoint,
    /// The side from which it is seen.
    pub sight: Sight<C>,
    /// Segments between it and the sensor.
    pub used: u32,
}

/// A spot and how far it may stand for others.
#[derive(Clone, Copy, Debug)]
pub struct Site<const C: usize> {
    /// Where it is.
    pub spot: Spot<C>,
    /// The light around changes over about this length: the harmonic mean distance of what is seen from there (Ward et al. 1988), made
    /// longer where sites would stand closer than spots are read, and shorter where a neighbour's is. Metres.
    pub reach: f64,
    /// The share of the gradients that is believed: less than 1 where the reach was made longer.
    pub(crate) trust: f64,
    /// True if something stands between parts of the surface around: only what sees the site is told of then.
    pub(crate) parted: bool,
}

/// What the rays of one pass found at a site.
#[derive(Clone, Copy, Debug)]
pub struct Record<const C: usize> {
    pub(crate) light: Light<C>,
    pub(crate) gradients: Gradients<C>,
}

impl<const C: usize> Spot<C> {
    /// True if its light can stand for that of others: light that arrives under all angles counts alike.
    pub fn is_plain(&self) -> bool {
        self.sight.is_plain()
    }

    pub(crate) fn normal(&self) -> DVec3 {
        self.sight.normals.geometric
    }

    /// The point and the normal of its side.
    pub(crate) fn place(&self) -> (DVec3, DVec3) {
        (self.at.position, self.normal())
    }
}

impl<const C: usize> Site<C> {
    /// Looks how far things are that are seen from a spot.
    ///
    /// No reach is shorter than `least`, nor longer than `most`, metres.
    pub fn new(
        spot: Spot<C>,
        gatherer: &Gatherer<'_, C>,
        rays: u32,
        [least, most]: [f64; 2],
        stream: &mut Stream,
    ) -> Self {
        let (strata, frame) = (Strata::new(rays), Frame::around(spot.normal()));
        let nearness: f64 = (0..rays)
            .map(|number| {
                let direction = strata.direction(number, stream.next2(), &frame);
                1.0 / gatherer.first_distance(&spot.at, &spot.sight, spot.used, direction, stream)
            })
            .sum();
        let seen = f64::from(rays) / nearness;
        let reach = seen.min(most).max(least);
        let parted = is_parted(gatherer.world, &spot, reach * WIDEST);
        Self { spot, reach, trust: (seen / reach).min(1.0), parted }
    }

    /// No longer than a length.
    pub(crate) fn shorten(&mut self, to: f64) {
        self.reach = self.reach.min(to);
    }

    /// How much the light here can differ from that of a spot, by Ward's split sphere: the distance over the reach plus the root of what the
    /// cosine between both normals lacks. `None` if the spot lies on another surface or side, or in another medium.
    pub fn difference(&self, spot: &Spot<C>, bound: f64) -> Option<f64> {
        let offset = spot.at.position - self.spot.at.position;
        let (distance, mean) = (offset.length(), self.spot.normal() + spot.normal());
        let by_distance = distance / self.reach;
        let difference = by_distance + (1.0 - self.spot.normal().dot(spot.normal())).max(0.0).sqrt();
        let near = difference < bound && offset.dot(mean).abs() <= OFF_PLANE * distance * mean.length();
        let alike = self.spot.used == spot.used && self.spot.sight.medium == spot.sight.medium;
        (near && alike).then_some(difference)
    }

    /// The same where the site stands for the spot: nothing stands between them.
    pub fn stands_for(&self, spot: &Spot<C>, bound: f64, world: &World) -> Option<f64> {
        let difference = self.difference(spot, bound)?;
        let between = |from: &Spot<C>, to: &Spot<C>| !world.see_each_other(from.place(), to.place());
        (!self.parted || !between(&self.spot, spot)).then_some(difference)
    }

    /// Looks around with as many rays.
    pub fn measure(
        &self,
        gatherer: &Gatherer<'_, C>,
        rays: u32,
        stream: &mut Stream,
        scratch: &mut Scratch,
    ) -> Record<C> {
        let (strata, frame) = (Strata::new(rays), Frame::around(self.spot.normal()));
        let Spot { at, sight, used } = &self.spot;
        let mut light = Light::default();
        let found: Vec<_> = (0..rays)
            .map(|number| {
                let direction = strata.direction(number, stream.next2(), &frame);
                let seen = gatherer.reflected(at, *sight, *used, direction, stream, scratch);
                light.add(&seen.light);
                Found { irradiance: seen.light.irradiance, distance: seen.distance }
            })
            .collect();
        Record { light: light.over(f64::from(rays)), gradients: strata.gradients(&found, &frame) }
    }
}

impl<const C: usize> Record<C> {
    /// The light that the record's site tells of a spot.
    pub(crate) fn told(&self, site: &Site<C>, spot: &Spot<C>) -> Light<C> {
        let (step, turn) = (spot.at.position - site.spot.at.position, site.spot.normal().cross(spot.normal()));
        let mut light = self.light;
        for axis in 0..3 {
            light.irradiance +=
                (self.gradients.shift[axis] * step[axis] + self.gradients.turn[axis] * turn[axis]) * site.trust;
        }
        light
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn spot(position: DVec3, normal: DVec3, medium: Option<u32>) -> Spot<1> {
        let at = SurfacePoint { position, normal, shading: normal, primitive: 0 };
        Spot { at, sight: Sight::meter(normal, medium), used: 1 }
    }

    #[test]
    fn a_site_stands_for_its_own_surface_alone() {
        let site = Site { spot: spot(DVec3::ZERO, DVec3::Z, None), reach: 2.0, trust: 1.0, parted: false };
        let difference = |position: [f64; 3], normal: DVec3, medium| {
            site.difference(&spot(DVec3::from(position), normal.normalize(), medium), 0.2)
        };
        assert_eq!(difference([0.3, 0.0, 0.0], DVec3::Z, None), Some(0.15));
        assert_eq!(difference([0.5, 0.0, 0.0], DVec3::Z, None), None, "too far");
        assert_eq!(difference([0.1, 0.0, 0.0], -DVec3::Z, None), None, "the other side");
        assert_eq!(difference([0.1, 0.0, 0.02], DVec3::Z, None), None, "a step up");
        assert_eq!(difference([0.0, 0.0, -0.001], DVec3::Z, None), None, "a shelf below");
        assert_eq!(difference([0.1, 0.0, 0.0], DVec3::Z, Some(0)), None, "another medium");
        // On a ball of radius 10 m through the site the chord is at right angles to the mean of both normals.
        let turn: f64 = 0.02;
        let on_ball = [10.0 * turn.sin(), 0.0, 10.0 * (turn.cos() - 1.0)];
        let along = DVec3::new(turn.sin(), 0.0, turn.cos());
        assert!(difference(on_ball, along, None).is_some());
        let deeper = Spot { used: 2, ..spot(DVec3::ZERO, DVec3::Z, None) };
        assert_eq!(site.difference(&deeper, 0.2), None, "of a path of another length");
    }
}
