//! A point at which a map is read, and what the scene around it tells the estimate.

use glam::DVec3;
use photonlab_gather::{
    Bandwidth, Estimate, Estimator, GatherPoint, Inside, Kernel, PhotonMap, SAME_SURFACE, Scratch, Surroundings, Tests,
};
use photonlab_photometry::Photon;
use photonlab_sampling::{Optics, Sight};
use photonlab_scene::{Neighbourhood, RadialWeight, SurfacePoint, World};

/// A surface point and what is seen of it.
#[derive(Clone, Copy)]
pub struct Place<'w, const C: usize> {
    /// The scene.
    pub world: &'w World,
    /// Its coatings.
    pub optics: &'w Optics<C>,
    /// The point.
    pub at: &'w SurfacePoint,
    /// The side from which it is seen, and how its coat weighs light.
    pub sight: &'w Sight<C>,
}

impl<const C: usize> Place<'_, C> {
    /// The point as maps know it: metres from the scene's middle.
    pub fn gather_point(&self) -> GatherPoint {
        let normal = self.sight.normals.geometric.as_vec3().to_array();
        GatherPoint { position: self.world.stored(self.at.position), normal }
    }

    /// The density estimate of what is seen there.
    pub fn estimate(
        &self,
        map: &PhotonMap<C>,
        bandwidth: Bandwidth,
        estimator: Estimator,
        tests: &Tests,
        scratch: &mut Scratch,
    ) -> Estimate<C> {
        let point = self.gather_point();
        if self.sight.is_plain() {
            let around = Around { place: self, weigh: |_: &Photon<C>| 1.0, weighs: false };
            map.gather_among(&point, bandwidth, estimator, tests, &around, scratch)
        } else {
            let vector = |direction: [f32; 3]| DVec3::from(direction.map(f64::from));
            let weigh = |photon: &Photon<C>| {
                self.sight.weight_of_flux(-vector(photon.direction.unpack()), vector(photon.normal.unpack()))
            };
            let around = Around { place: self, weigh, weighs: true };
            map.gather_among(&point, bandwidth, estimator, tests, &around, scratch)
        }
    }
}

/// The answers to what a map asks.
struct Around<'p, const C: usize, W> {
    place: &'p Place<'p, C>,
    weigh: W,
    /// False if the weight is always 1.
    weighs: bool,
}

impl<const C: usize, W: Fn(&Photon<C>) -> f64> Surroundings<Photon<C>> for Around<'_, C, W> {
    fn weighs(&self) -> bool {
        self.weighs
    }

    fn weigh(&self, photon: &Photon<C>) -> f64 {
        (self.weigh)(photon)
    }

    fn inside(&self, radius: f64, kernel: Kernel) -> Option<Inside> {
        let Place { world, optics, .. } = self.place;
        let around = self.neighbourhood(radius)?;
        surface_inside(world, &around, kernel, |primitive, front| optics.stores(world, primitive, front))
    }

    fn seen_inside(&self, radius: f64, kernel: Kernel) -> Option<Inside> {
        let Place { world, optics, .. } = self.place;
        let around = self.neighbourhood(radius)?;
        let stores = |primitive, front| optics.stores(world, primitive, front);
        Some(surface_seen(world, &around, kernel, stores))
    }

    fn is_seen(&self, position: [f32; 3], photon: &Photon<C>) -> bool {
        let Place { world, at, sight, .. } = self.place;
        let vector = |of: [f32; 3]| DVec3::from(of.map(f64::from));
        let there = (world.middle() + vector(position), vector(photon.normal.unpack()));
        world.see_each_other((at.position, sight.normals.geometric), there)
    }
}

impl<const C: usize, W> Around<'_, C, W> {
    /// The ball; `None` if it holds nothing but the point's own surface, without an end.
    fn neighbourhood(&self, radius: f64) -> Option<Neighbourhood> {
        let Place { world, at, sight, .. } = self.place;
        world.ball_leaves_surface(at, radius).then(|| Neighbourhood {
            position: at.position,
            primitive: at.primitive,
            normal: sight.normals.geometric,
            radius,
            least_cosine: f64::from(SAME_SURFACE),
        })
    }
}

/// What [`World::surface_inside`] finds of a kernel, as a map asks for it: exact for flat faces, discs and spheres, and `None` where
/// another curved surface or very many faces are in the ball. Lengths in radii, areas in discs, as [`Inside`] has them.
pub fn surface_inside(
    world: &World,
    around: &Neighbourhood,
    kernel: Kernel,
    stores: impl Fn(u32, bool) -> bool,
) -> Option<Inside> {
    Some(for_a_map(&world.surface_inside(around, &Weight(kernel), stores)?))
}

/// What [`World::surface_seen`] finds of a kernel, as a map asks for it.
pub fn surface_seen(
    world: &World,
    around: &Neighbourhood,
    kernel: Kernel,
    stores: impl Fn(u32, bool) -> bool,
) -> Inside {
    for_a_map(&world.surface_seen(around, &Weight(kernel), stores))
}

fn for_a_map(inside: &photonlab_scene::Inside) -> Inside {
    let second = inside.second.to_cols_array_2d();
    Inside { area: inside.area, first: inside.first.to_array(), second, open: inside.open }
}

/// A kernel as the scene's geometry takes it.
struct Weight(Kernel);

impl RadialWeight for Weight {
    fn weight(&self, t: f64) -> f64 {
        self.0.weight(t)
    }

    fn mass(&self, t: f64) -> f64 {
        self.0.mass(t)
    }

    fn second(&self, t: f64) -> f64 {
        self.0.second(t)
    }
}
