//! Gather rays guided by the photons near their start.

use glam::DVec3;
use photonlab_gather::{GatherPoint, PhotonMap, Scratch};
use photonlab_photometry::PathClass;
use photonlab_sampling::warp::Frame;

use crate::hemisphere::Strata;

/// Strata of the hemisphere, equal by the cosine: rows by polar angle, columns by azimuth.
const STRATA: Strata = Strata { rows: 4, columns: 8 };
const COUNT: usize = (STRATA.rows * STRATA.columns) as usize;

/// Photons that are asked at each place.
const PHOTONS: usize = 128;

/// The share of the rays that no photon guides: a direction is drawn with half its usual density at least.
pub const UNGUIDED: f64 = 0.5;

/// From where the reflected light comes to a few places, by the photons near them (Jensen, "Importance driven path tracing using the
/// photon map", 1995). Rays drawn so are weighed by the density of the cosine over theirs, so that their mean is the same whatever
/// the photons say, and wherever they start.
pub struct Guide {
    /// Sums of the strata's probabilities, up to and with each.
    sums: [f32; COUNT],
}

impl Guide {
    /// Of the photons nearest to each place, which has a shading normal besides; `None` if none of them was reflected diffusely on its way.
    pub fn new<const C: usize>(
        map: &PhotonMap<C>,
        places: impl IntoIterator<Item = (GatherPoint, DVec3)>,
        scratch: &mut Scratch,
    ) -> Option<Self> {
        let mut shares = [0.0; COUNT];
        for (at, shading) in places {
            let frame = Frame::around(shading);
            map.each_nearest(&at, PHOTONS, scratch, |photon| {
                let from = -DVec3::from(photon.direction.unpack().map(f64::from));
                if photon.class == PathClass::Indirect
                    && let Some(stratum) = STRATA.number_of(frame.local(from))
                {
                    shares[stratum] += photon.flux().mean();
                }
            });
        }
        let all: f64 = shares.iter().sum();
        if all <= 0.0 {
            return None;
        }
        let mut sum = 0.0;
        let sums = shares.map(|share| {
            sum += UNGUIDED / COUNT as f64 + (1.0 - UNGUIDED) * share / all;
            sum as f32
        });
        Some(Self { sums })
    }

    /// A direction around a shading normal from two numbers, and the density of the cosine over that by which it was drawn.
    pub fn draw(&self, [first, second]: [f64; 2], shading: DVec3) -> (DVec3, f64) {
        let sum = |stratum: usize| f64::from(self.sums[stratum]);
        let all = sum(COUNT - 1);
        let stratum = self.sums.partition_point(|&sum| f64::from(sum) <= first * all).min(COUNT - 1);
        let below = if stratum == 0 { 0.0 } else { sum(stratum - 1) };
        let probability = (sum(stratum) - below) / all;
        let within = ((first - below / all) / probability).clamp(0.0, 1.0);
        let direction = STRATA.direction(stratum as u32, [within, second], &Frame::around(shading));
        (direction, 1.0 / (COUNT as f64 * probability))
    }
}

#[cfg(test)]
mod tests {
    use photonlab_kdtree::SplitRule;
    use photonlab_photometry::{PackedDirection, Photon};

    use super::*;

    fn guide(directions: &[(DVec3, PathClass)]) -> Option<Guide> {
        let photon = |&(from, class): &(DVec3, PathClass)| Photon::<1> {
            flux: [1.0],
            direction: PackedDirection::pack((-from).to_array()),
            normal: PackedDirection::pack([0.0, 0.0, 1.0]),
            class,
            segments: 2,
        };
        let places = vec![[0.0; 3]; directions.len()];
        let map = PhotonMap::build(places, directions.iter().map(photon).collect(), SplitRule::Median).expect("finite");
        let at = GatherPoint { position: [0.0; 3], normal: [0.0, 0.0, 1.0] };
        Guide::new(&map, [(at, DVec3::Z)], &mut Scratch::default())
    }

    /// Weighed rays integrate anything as rays of the cosine do, and half of them come from where the photons came.
    #[test]
    fn guided_rays_keep_every_mean_and_go_where_the_light_is() {
        let from = DVec3::new(0.5, 0.3, 0.4).normalize();
        let guide = guide(&[(from, PathClass::Indirect), (-DVec3::X + DVec3::Z, PathClass::Direct)]).expect("light");
        let (n, frame) = (512, Frame::around(DVec3::Z));
        let [mut whole, mut tilt, mut near] = [0.0; 3];
        for i in 0..n {
            for j in 0..n {
                let xi = [i, j].map(|i| (f64::from(i) + 0.5) / f64::from(n));
                let (direction, share) = guide.draw(xi, DVec3::Z);
                assert!((direction.length() - 1.0).abs() < 1e-12 && direction.z >= 0.0 && share <= 2.0 + 1e-9);
                whole += share;
                tilt += share * (direction.x + 2.0 * direction.z);
                near += f64::from(u8::from(
                    STRATA.number_of(frame.local(direction)) == STRATA.number_of(frame.local(from)),
                ));
            }
        }
        let count = f64::from(n * n);
        // The mean of z by the cosine is 2/3.
        assert!((whole / count - 1.0).abs() < 1e-3, "{}", whole / count);
        assert!((tilt / count - 4.0 / 3.0).abs() < 2e-3, "{}", tilt / count);
        assert!((near / count - (0.5 + 0.5 / 32.0)).abs() < 0.01, "{}", near / count);
    }

    #[test]
    fn without_reflected_light_nothing_guides() {
        assert!(guide(&[]).is_none());
        assert!(guide(&[(DVec3::Z, PathClass::Direct), (DVec3::Z, PathClass::Caustic)]).is_none());
    }
}
