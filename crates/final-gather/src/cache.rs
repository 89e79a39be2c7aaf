//! The irradiance cache: reflected light, looked for at few places and told of all between.

use photonlab_photometry::Colour;
use photonlab_scene::World;

use crate::{Light, Record, Site, Spot, zones::Zones};

/// The greatest [difference](Site::difference) at which a site stands for a spot.
pub const ACCURACY: f64 = 0.2;

/// The bias is told by sites up to so many times as different: by three times as much where light is smooth.
const CHECK: f64 = 2.0;

/// How far a site's zone reaches over its reach at most.
pub(crate) const WIDEST: f64 = CHECK * ACCURACY;

/// Places of records, before anything is measured there.
#[derive(Clone, Debug, Default)]
pub struct Sites<const C: usize> {
    sites: Vec<Site<C>>,
    zones: Zones,
}

impl<const C: usize> Sites<C> {
    /// The sites, in the order in which they were added.
    pub fn all(&self) -> &[Site<C>] {
        &self.sites
    }

    /// True if some site stands for a spot.
    pub fn cover(&self, spot: &Spot<C>, world: &World) -> bool {
        let stands = |number: usize| self.sites[number].stands_for(spot, ACCURACY, world).is_some();
        self.zones.around(spot.at.position).any(stands)
    }

    /// Adds sites. Where one sees things near, its neighbours do not believe them to be far: none reaches farther than another and the
    /// way to it (Krivanek, Bouatouch, Pattanaik and Zara, "Making radiance and irradiance caching practical", 2006).
    pub fn add(&mut self, more: impl IntoIterator<Item = Site<C>>) {
        self.sites.extend(more);
        let zones = self.zones();
        for number in 0..self.sites.len() {
            let (at, reach) = (self.sites[number].spot.at.position, self.sites[number].reach);
            for other in zones.around(at) {
                let other = &mut self.sites[other];
                other.shorten(reach + (other.spot.at.position - at).length());
            }
        }
        self.zones = self.zones();
    }

    fn zones(&self) -> Zones {
        Zones::new(self.sites.iter().map(|site| (site.spot.at.position, WIDEST * site.reach)))
    }

    /// The reflected light at a spot, from a record of each site; `None` where no site stands for it.
    ///
    /// Each counts with the weight 1 - difference / accuracy, which ends in nothing at the border of its zone, so that no seam shows. With
    /// gradients the error of a mean over sites grows with the square of their distance where light is smooth, and in proportion to it
    /// where it bends sharply: that of a mean with twice the zones, less this one, is three times the bias or once. Where one site
    /// alone stands in both they say nothing: the square of the difference, which is the most by which light changes, stands for the
    /// share by which a slope goes wrong.
    pub fn tell(&self, spot: &Spot<C>, records: &[Record<C>], world: &World) -> Option<Light<C>> {
        let mut sums = [(Light::<C>::default(), 0.0); 2];
        let (mut standing, mut last) = (0, 0.0);
        for number in self.zones.around(spot.at.position) {
            let site = &self.sites[number];
            let Some(difference) = site.stands_for(spot, WIDEST, world) else { continue };
            (standing, last) = (standing + 1, difference);
            let told = records[number].told(site, spot);
            for ((light, weights), bound) in sums.iter_mut().zip([ACCURACY, WIDEST]) {
                let weight = 1.0 - difference / bound;
                if weight > 0.0 {
                    light.add(&told.over(1.0 / weight));
                    *weights += weight;
                }
            }
        }
        let [near, far] = sums.map(|(light, weights)| (weights > 0.0).then(|| light.over(weights)));
        let (mut light, far) = (near?, far?);
        if standing == 1 {
            // A bound has no sign: it adds to what the landings' own bias says.
            let bound = light.irradiance * (last * last);
            light.bias += Colour(std::array::from_fn(|c| bound.0[c].copysign(light.bias.0[c])));
        } else {
            light.bias += far.irradiance - light.irradiance;
        }
        Some(light)
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;
    use photonlab_sampling::Sight;
    use photonlab_scene::{SurfacePoint, read::read_scene_str};

    use super::*;
    use crate::hemisphere::Gradients;

    fn spot(x: f64, y: f64) -> Spot<1> {
        let (position, normal) = (DVec3::new(x, y, 0.0), DVec3::Z);
        let at = SurfacePoint { position, normal, shading: normal, primitive: 0 };
        Spot { at, sight: Sight::meter(normal, None), used: 1 }
    }

    fn nothing() -> World {
        World::new(read_scene_str(r#"<scene version="3.0.0"></scene>"#, "nothing", &[]).expect("a scene"))
    }

    /// Sites 10 cm apart that tell the light `f` and its slope.
    fn cache(f: impl Fn(f64, f64) -> (f64, [f64; 2])) -> (Sites<1>, Vec<Record<1>>) {
        let places: Vec<(f64, f64)> =
            (-20..=20).flat_map(|i| (-20..=20).map(move |j| (0.1 * f64::from(i), 0.1 * f64::from(j)))).collect();
        let mut sites = Sites::default();
        sites.add(places.iter().map(|&(x, y)| Site { spot: spot(x, y), reach: 1.0, trust: 1.0, parted: false }));
        let record = |&(x, y): &(f64, f64)| {
            let (value, slope) = f(x, y);
            let shift = [Colour([slope[0]]), Colour([slope[1]]), Colour::ZERO];
            let light = Light { irradiance: Colour([value]), ..Light::default() };
            Record { light, gradients: Gradients { turn: [Colour::ZERO; 3], shift } }
        };
        (sites, places.iter().map(record).collect())
    }

    #[test]
    fn a_slope_is_told_exactly_and_a_bend_with_three_times_its_bias() {
        let (sites, records) = cache(|x, y| (3.0 + x - 2.0 * y, [1.0, -2.0]));
        let told = sites.tell(&spot(0.234, -0.155), &records, &nothing()).expect("covered");
        assert!((told.irradiance.0[0] - 3.544).abs() < 1e-12 && told.bias.0[0].abs() < 1e-12, "{told:?}");
        let (sites, records) = cache(|x, y| (x * x + y * y, [2.0 * x, 2.0 * y]));
        let (mut bias, mut stated) = (0.0, 0.0);
        for step in 0..100 {
            let (x, y) = (0.01 * f64::from(step) - 0.5, 0.3 - 0.007 * f64::from(step));
            let told = sites.tell(&spot(x, y), &records, &nothing()).expect("covered");
            bias += told.irradiance.0[0] - (x * x + y * y);
            stated += told.bias.0[0];
        }
        assert!(bias < 0.0 && (stated / bias - 3.0).abs() < 0.3, "{stated} {bias}");
    }

    #[test]
    fn nothing_is_told_where_no_site_is() {
        let (sites, records) = cache(|_, _| (1.0, [0.0; 2]));
        assert!(sites.cover(&spot(1.9, 1.9), &nothing()) && !sites.cover(&spot(2.5, 0.0), &nothing()));
        assert!(sites.tell(&spot(2.5, 0.0), &records, &nothing()).is_none());
        assert!(Sites::<1>::default().tell(&spot(0.0, 0.0), &[], &nothing()).is_none());
    }

    /// No second opinion is no proof: where one site tells of a place alone, the square of the difference bounds its slope's error.
    #[test]
    fn a_lone_site_says_how_wrong_it_may_be() {
        let mut sites = Sites::default();
        sites.add([Site { spot: spot(0.0, 0.0), reach: 1.0, trust: 1.0, parted: false }]);
        let (_, records) = cache(|_, _| (2.0, [0.0; 2]));
        let told = sites.tell(&spot(0.1, 0.0), &records[..1], &nothing()).expect("covered");
        assert!((told.irradiance.0[0] - 2.0).abs() < 1e-12 && (told.bias.0[0] - 2.0 * 0.01).abs() < 1e-12, "{told:?}");
    }

    #[test]
    fn a_short_reach_shortens_its_neighbours() {
        let mut sites = Sites::default();
        let site = |x: f64, reach: f64| Site { spot: spot(x, 0.0), reach, trust: 1.0, parted: false };
        sites.add([site(0.0, 1.0), site(0.2, 0.1), site(5.0, 1.0)]);
        let reaches: Vec<f64> = sites.all().iter().map(|site| site.reach).collect();
        assert!((reaches[0] - 0.3).abs() < 1e-12 && reaches[1..] == [0.1, 1.0], "{reaches:?}");
    }
}
