//! The irradiance cache: reflected light, looked for at few places and told of all between.

use crate::{Light, Record, Site, Spot, zones::Zones};

/// The greatest [difference](Site::difference) at which a site stands for a spot.
pub const ACCURACY: f64 = 0.2;

/// The bias is told by sites up to so many times as different.
const CHECK: f64 = 2.0;

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
    pub fn cover(&self, spot: &Spot<C>) -> bool {
        self.zones.around(spot.at.position).any(|number| self.sites[number].difference(spot, ACCURACY).is_some())
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
        Zones::new(self.sites.iter().map(|site| (site.spot.at.position, CHECK * ACCURACY * site.reach)))
    }

    /// The reflected light at a spot, from a record of each site; `None` where no site stands for it.
    ///
    /// Each counts with the weight 1 - difference / accuracy, which ends in nothing at the border of its zone, so that no seam shows. With
    /// gradients the error of a mean over sites grows with the square of their distance where light is smooth, and in proportion to it
    /// where it bends sharply: that of a mean with twice the zones, less this one, is three times the bias or once.
    pub fn tell(&self, spot: &Spot<C>, records: &[Record<C>]) -> Option<Light<C>> {
        let mut sums = [(Light::<C>::default(), 0.0); 2];
        for number in self.zones.around(spot.at.position) {
            let site = &self.sites[number];
            let Some(difference) = site.difference(spot, CHECK * ACCURACY) else { continue };
            let told = records[number].told(site, spot);
            for ((light, weights), bound) in sums.iter_mut().zip([ACCURACY, CHECK * ACCURACY]) {
                let weight = 1.0 - difference / bound;
                if weight > 0.0 {
                    light.add(&told.over(1.0 / weight));
                    *weights += weight;
                }
            }
        }
        let [near, far] = sums.map(|(light, weights)| (weights > 0.0).then(|| light.over(weights)));
        let (mut light, far) = (near?, far?);
        light.bias += far.irradiance - light.irradiance;
        Some(light)
    }
}
