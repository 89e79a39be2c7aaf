//! All light at a diffuse point.

use photonlab_gather::{
    AreaModel, Bandwidth, CHECK, Estimate, Estimator, GatherPoint, Kernel, NEAR, PhotonMap, Precomputed, Scratch, Tests,
};
use photonlab_sampling::{Optics, Sight, Stream, sample_direct, warp};
use photonlab_scene::{Hit, SurfacePoint, World};

use crate::{
    EyeLimits, Guide, Light, Place, VolumeMaps,
    look::{Lamps, met_by_chance},
    segment,
};

/// A map and the radius with which it is read.
pub struct MapWithRadius<'m, M> {
    /// The photons.
    pub map: &'m M,
    /// Metres.
    pub radius: f64,
}

impl<M> Clone for MapWithRadius<'_, M> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<M> Copy for MapWithRadius<'_, M> {}

/// Shares of the radius with which caustic light is read beside an edge: an eighth leaves a sixty-fourth of the photons.
const SMALLER: [f64; 3] = [0.5, 0.25, 0.125];

/// The maps that final gather reads.
#[derive(Clone, Copy)]
pub struct GatherMaps<'m, const C: usize> {
    /// All photons; `None` if no light is reflected diffusely onto anything.
    pub surface: Option<MapWithRadius<'m, PhotonMap<C>>>,
    /// Photons that came through specular surfaces alone; `None` if there are none.
    pub caustic: Option<MapWithRadius<'m, PhotonMap<C>>>,
    /// Photons in media; `None` if no medium scatters.
    pub volume: Option<VolumeMaps<'m, C>>,
    /// How photons on surfaces are weighed.
    pub kernel: Kernel,
    /// What is known of the surface map where rays land; `None` if they read it themselves.
    pub precomputed: Option<&'m Precomputed<C>>,
}

/// Final gather over maps, or path tracing without.
#[derive(Clone, Copy)]
pub struct Gatherer<'w, const C: usize> {
    /// The scene.
    pub world: &'w World,
    /// Its lamps and coatings.
    pub optics: &'w Optics<C>,
    /// The maps; `None` traces paths.
    pub maps: Option<GatherMaps<'w, C>>,
    /// When a path ends early.
    pub limits: EyeLimits,
    /// False if a ray from a diffuse point can bring nothing but what lamps and the caustic map give: none is sent then.
    pub looks_around: bool,
    /// False if the caller knows what caustic light arrives where a walk starts; elsewhere it comes from the map.
    pub caustics_at_start: bool,
    /// By which the first ray's direction is drawn; `None` draws it by the cosine.
    pub guide: Option<&'w Guide>,
}

impl<const C: usize> Gatherer<'_, C> {
    /// One sample of the irradiance at a surface point on the side of `sight`, each direction weighted as `sight` says;
    /// `used` segments lie between it and the sensor. Point lamps at distance d and cosine c count with weight
    /// 1 / (1 + `share` c / d^2) there; the rest is the caller's. The first bounce draws five numbers: three for the lamp,
    /// two for the direction.
    pub fn irradiance(
        &self,
        at: &SurfacePoint,
        sight: Sight<C>,
        used: u32,
        share: f64,
        stream: &mut Stream,
        scratch: &mut Scratch,
    ) -> Light<C> {
        let mut light = self.known(at, &sight, (used, share), self.caustics_at_start, stream, scratch);
        if self.looks_on(used) {
            let xi = stream.next2();
            stream.leave_prefix();
            let turned = match self.guide {
                Some(guide) => guide.draw(xi, sight.normals.shading),
                None => {
                    let direction = warp::square_to_cosine_hemisphere(xi, sight.normals.shading);
                    self.turned_to_lamp(at, &sight, direction, stream)
                }
            };
            light.add(&self.look(at, sight, used, turned, Lamps::Counted, stream, scratch).light);
        }
        light
    }

    /// One sample of what lamps send straight and of caustic light, where the rest is known: as [`Self::irradiance`], but for what is
    /// reflected diffusely onto the point, and scattered there by media.
    pub fn without_reflected(
        &self,
        at: &SurfacePoint,
        sight: &Sight<C>,
        (used, share): (u32, f64),
        stream: &mut Stream,
        scratch: &mut Scratch,
    ) -> Light<C> {
        let mut light = self.known(at, sight, (used, share), self.caustics_at_start, stream, scratch);
        let direction = warp::square_to_cosine_hemisphere(stream.next2(), sight.normals.shading);
        stream.leave_prefix();
        let cosine = sight.normals.cosine(direction);
        if cosine > 0.0 && self.limits.allows(used + 1) && !self.optics.lamps.are_sampled_alone(self.world) {
            let start = self.start(at, sight, used, direction);
            let landing = segment::follow(self.world, self.optics, &self.limits, start, stream);
            light.irradiance += met_by_chance(&landing, cosine) * sight.weight(cosine);
        }
        light
    }

    /// Light at a point that no ray around is needed for.
    pub(crate) fn known(
        &self,
        at: &SurfacePoint,
        sight: &Sight<C>,
        (used, share): (u32, f64),
        caustics: bool,
        stream: &mut Stream,
        scratch: &mut Scratch,
    ) -> Light<C> {
        let mut light = self.lamps_at(at, sight, used, share, stream);
        if caustics {
            light.add(&self.caustics_at(at, sight, used, scratch));
        }
        light
    }

    /// One sample of direct light, weighted against the rays that may meet the lamp by chance.
    fn lamps_at(&self, at: &SurfacePoint, sight: &Sight<C>, used: u32, share: f64, stream: &mut Stream) -> Light<C> {
        let xi = [stream.next(), stream.next(), stream.next()];
        if !self.limits.allows(used + 1) {
            return Light::default();
        }
        let Some(sample) = sample_direct(self.world, self.optics, at, sight, xi) else {
            return Light::default();
        };
        if !self.limits.allows(used + 1 + sample.panes) {
            return Light::default();
        }
        let cosine = sight.normals.cosine(sample.direction);
        let by_chance = warp::cosine_hemisphere_pdf_solid_angle(cosine);
        let balance = match sample.pdf_solid_angle {
            0.0 => 1.0 / (1.0 + share * sample.point_factor),
            pdf => pdf / (pdf + by_chance),
        };
        Light { irradiance: sample.irradiance * (balance * sight.weight(cosine)), ..Light::default() }
    }

    /// Caustic light, straight from its map. Where the ball would reach over an edge or onto another surface, a smaller one that stays
    /// is read, if there is one that is not too small.
    fn caustics_at(&self, at: &SurfacePoint, sight: &Sight<C>, used: u32, scratch: &mut Scratch) -> Light<C> {
        let Some((maps, caustic)) = self.maps.and_then(|maps| Some((maps, maps.caustic?))) else {
            return Light::default();
        };
        let mut light: Light<C> = self.estimate((&caustic, maps.kernel), at, sight, used, scratch).into();
        let leaves = |radius: f64| self.world.ball_leaves_surface(at, CHECK * radius);
        if light.photons == 0.0 || !leaves(caustic.radius) {
            return light;
        }
        let smaller = SMALLER.iter().map(|share| share * caustic.radius).find(|&radius| !leaves(radius));
        if let Some(radius) = smaller {
            let smaller = MapWithRadius { radius, ..caustic };
            return self.estimate((&smaller, maps.kernel), at, sight, used, scratch).into();
        }
        light.unresolved = light.irradiance;
        light
    }

    /// What a ray gathers where it lands, unless that is too close to where it came from, to an edge or to another
    /// surface: `None` then, and the walk goes on by a further bounce instead. The ball that must stay on the surface is
    /// the one that checks the bias, twice the radius of the one averaged over.
    pub(crate) fn far_landing(
        &self,
        hit: &Hit,
        sight: &Sight<C>,
        distance: f64,
        used: u32,
        scratch: &mut Scratch,
    ) -> Option<Light<C>> {
        let maps = self.maps?;
        let surface = maps.surface?;
        let near =
            distance < 2.0 * surface.radius || self.world.ball_leaves_surface(&hit.point, CHECK * surface.radius);
        if near {
            return None;
        }
        let known = maps.precomputed.filter(|_| sight.is_plain() && self.limits.max_segments.is_none());
        let told = known.and_then(|known| {
            known.near(&self.place(&hit.point, sight).gather_point(), NEAR * surface.radius, scratch)
        });
        let estimate = told.unwrap_or_else(|| self.estimate((&surface, maps.kernel), &hit.point, sight, used, scratch));
        Some(estimate.into())
    }

    /// What the surface map's ball reads at a place, for [`Precomputed`]; `None` where the ball that checks it leaves its surface.
    pub fn precompute(
        &self,
        at: &SurfacePoint,
        sight: &Sight<C>,
        scratch: &mut Scratch,
    ) -> Option<(GatherPoint, Estimate<C>)> {
        let maps = self.maps?;
        let surface = maps.surface?;
        if self.world.ball_leaves_surface(at, CHECK * surface.radius) {
            return None;
        }
        let estimate = self.estimate((&surface, maps.kernel), at, sight, 0, scratch);
        Some((self.place(at, sight).gather_point(), estimate))
    }

    fn place<'p>(&'p self, at: &'p SurfacePoint, sight: &'p Sight<C>) -> Place<'p, C> {
        Place { world: self.world, optics: self.optics, at, sight }
    }

    fn estimate(
        &self,
        (source, kernel): (&MapWithRadius<'_, PhotonMap<C>>, Kernel),
        at: &SurfacePoint,
        sight: &Sight<C>,
        used: u32,
        scratch: &mut Scratch,
    ) -> Estimate<C> {
        let tests =
            Tests { max_segments: self.limits.max_segments.map(|max| max.saturating_sub(used)), ..Tests::default() };
        let bandwidth = Bandwidth::Radius(source.radius);
        // The ball stays on the surface, or what it reads does not count as resolved, so the disc is all there is.
        let estimator = Estimator::new(kernel, AreaModel::Disc);
        self.place(at, sight).estimate(source.map, bandwidth, estimator, &tests, scratch)
    }
}

impl<const C: usize> From<Estimate<C>> for Light<C> {
    fn from(estimate: Estimate<C>) -> Self {
        Light {
            irradiance: estimate.irradiance,
            bias: estimate.bias,
            photons: estimate.photons as f64,
            reads: 1.0,
            ..Light::default()
        }
    }
}
