//! Surfaces under synthetic photons, for the remedies that ask how much surface is there.

use glam::DVec3;
use photonlab_final_gather::{surface_inside, surface_seen};
use photonlab_gather::{GatherPoint, Inside, Kernel, Surroundings};
use photonlab_photometry::Photon;
use photonlab_scene::{Neighbourhood, World, read::read_scene_str};

use crate::reproduce::faces::Face;

/// Surfaces; queries lie on the first one.
pub(super) struct Ground {
    world: World,
    least_cosine: f64,
}

impl Ground {
    /// Of flat faces. Those count as surface at a query whose normals make at least this cosine with its own.
    pub(super) fn of_faces(faces: &[Face], least_cosine: f64) -> anyhow::Result<Self> {
        Self::of_shapes(&faces.iter().map(rectangle).collect::<String>(), least_cosine)
    }

    /// The outside of a sphere around the origin.
    pub(super) fn of_sphere(radius: f64, least_cosine: f64) -> anyhow::Result<Self> {
        let sphere = format!("<shape type=\"sphere\"><float name=\"radius\" value=\"{radius}\"/></shape>");
        Self::of_shapes(&sphere, least_cosine)
    }

    fn of_shapes(shapes: &str, least_cosine: f64) -> anyhow::Result<Self> {
        let xml = format!("<scene version=\"3.0.0\">{shapes}</scene>");
        let scene = read_scene_str(&xml, "atlas", &[]).map_err(|error| anyhow::anyhow!("{error}"))?;
        Ok(Self { world: World::new(scene), least_cosine })
    }

    /// What is around a query.
    pub(super) fn around(&self, at: &GatherPoint) -> Around<'_> {
        let vector = |v: [f32; 3]| DVec3::from(v.map(f64::from));
        Around { ground: self, position: vector(at.position), normal: vector(at.normal) }
    }
}

/// A face as the scene format has it: the square from -1 to 1, its normal to the lit side.
fn rectangle(face: &Face) -> String {
    let [a, b] = face.sides.map(|side| 0.5 * DVec3::from(side));
    let (corner, normal) = (DVec3::from(face.corner), DVec3::from(face.normal));
    let (u, v) = if a.cross(b).dot(normal) > 0.0 { (a, b) } else { (b, a) };
    let middle = corner + a + b;
    let row = |i: usize| format!("{} {} {} {}", u[i], v[i], normal[i], middle[i]);
    format!(
        "<shape type=\"rectangle\"><transform name=\"to_world\"><matrix value=\"{} {} {} 0 0 0 1\"/></transform></shape>",
        row(0),
        row(1),
        row(2)
    )
}

/// The surfaces around a query.
pub(super) struct Around<'g> {
    ground: &'g Ground,
    position: DVec3,
    normal: DVec3,
}

impl Around<'_> {
    fn neighbourhood(&self, radius: f64) -> Neighbourhood {
        let least_cosine = self.ground.least_cosine;
        Neighbourhood { position: self.position, primitive: 0, normal: self.normal, radius, least_cosine }
    }
}

impl<const C: usize> Surroundings<Photon<C>> for Around<'_> {
    fn inside(&self, radius: f64, kernel: Kernel) -> Option<Inside> {
        surface_inside(&self.ground.world, &self.neighbourhood(radius), kernel, |_, front| front)
    }

    fn seen_inside(&self, radius: f64, kernel: Kernel) -> Option<Inside> {
        Some(surface_seen(&self.ground.world, &self.neighbourhood(radius), kernel, |_, front| front))
    }

    fn is_seen(&self, position: [f32; 3], photon: &Photon<C>) -> bool {
        let [there, normal] = [position, photon.normal.unpack()].map(|v| DVec3::from(v.map(f64::from)));
        self.ground.world.see_each_other((self.position, self.normal), (there, normal))
    }
}
