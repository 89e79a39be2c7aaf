//! The scene made ready for rays: where a ray lands, what lies near a point, how large a cell is.

use glam::DVec3;

use crate::{
    accelerator::{Accelerator, whole},
    bsdf::Bsdf,
    description::{Geometry, Scene, Shape},
    medium::Boundary,
    mesh::SAME_SURFACE,
    primitive::{Hit, Primitive, Surface, SurfacePoint, surfaces},
    ray::Ray,
    sensor::Receiver,
    tube::FLAT_SHARE,
};

/// A ray that starts on no known surface ignores what is nearer than this times its origin's largest coordinate.
/// Rays that start on a primitive never meet that (flat) primitive again, whatever the scale.
const NEAREST: f64 = 1e-11;

/// Share of the distance to a point on a surface that can hide parts of itself within which it does not hide that one.
const OWN: f64 = 1e-6;

/// A scene with its primitives and their accelerator.
pub struct World {
    /// The description it was made from.
    pub scene: Scene,
    /// Every surface that a ray can meet.
    pub primitives: Vec<Primitive>,
    /// First primitive of each shape, and one past the last of all.
    first_primitive: Vec<u32>,
    /// Area of all primitives before each, and of all at the end, square metres.
    area_before: Vec<f64>,
    /// Primitives that no ray notices.
    inert: Vec<bool>,
    /// Shapes that carry a meter.
    metered: Vec<bool>,
    bounds: (DVec3, DVec3),
    accelerator: Accelerator,
}

impl World {
    /// Prepares a scene.
    pub fn new(scene: Scene) -> Self {
        let mut primitives = Vec::new();
        let mut first_primitive = vec![0];
        for (index, shape) in scene.shapes.iter().enumerate() {
            primitives.extend(surfaces(shape).into_iter().map(|surface| Primitive { surface, shape: index as u32 }));
            first_primitive.push(primitives.len() as u32);
        }
        let mut area_before = vec![0.0];
        primitives.iter().for_each(|p| area_before.push(area_before[area_before.len() - 1] + p.surface.area()));
        let bounds: Vec<_> = primitives.iter().map(|p| p.surface.bounds()).collect();
        let mut metered = vec![false; scene.shapes.len()];
        for sensor in &scene.sensors {
            if let Receiver::Meter(meter) = &sensor.receiver
                && let Some(shape) = meter.shape()
            {
                metered[shape] = true;
            }
        }
        let is_inert = |shape: usize| {
            let Shape { bsdf, boundary, .. } = &scene.shapes[shape];
            *bsdf == Bsdf::Null && boundary.is_none() && !metered[shape]
        };
        let inert = primitives.iter().map(|p| is_inert(p.shape as usize)).collect();
        Self {
            scene,
            primitives,
            first_primitive,
            area_before,
            inert,
            metered,
            bounds: whole(&bounds),
            accelerator: Accelerator::new(&bounds),
        }
    }

    /// Smallest and largest coordinates of all surfaces, metres; zeros for a scene without surfaces.
    pub fn bounds(&self) -> (DVec3, DVec3) {
        self.bounds
    }

    /// Smallest and largest coordinates of a shape, metres.
    pub fn bounds_of(&self, shape: usize) -> (DVec3, DVec3) {
        let each = self.primitives_of(shape).map(|primitive| self.primitives[primitive as usize].surface.bounds());
        each.reduce(|a, b| (a.0.min(b.0), a.1.max(b.1))).unwrap_or_default()
    }

    /// A position in the single precision of photons and trees, relative to the middle of the scene: a room keeps its
    /// digits however far from the origin of its coordinates it stands.
    pub fn stored(&self, position: DVec3) -> [f32; 3] {
        (position - self.middle()).as_vec3().to_array()
    }

    /// The middle of the box around all surfaces, metres.
    pub fn middle(&self) -> DVec3 {
        0.5 * (self.bounds.0 + self.bounds.1)
    }

    /// The primitives of a shape, as indices.
    pub fn primitives_of(&self, shape: usize) -> std::ops::Range<u32> {
        self.first_primitive[shape]..self.first_primitive[shape + 1]
    }

    /// Area in square metres of a shape.
    pub fn area_of(&self, shape: usize) -> f64 {
        let range = self.primitives_of(shape);
        self.area_before[range.end as usize] - self.area_before[range.start as usize]
    }

    /// The primitive of a shape in which a share of the shape's area lies, in [0, 1), and the share of that primitive's own
    /// area which is left: chosen evenly by area from an even number.
    pub fn primitive_by_area(&self, shape: usize, share: f64) -> (u32, f64) {
        let range = self.primitives_of(shape);
        let sums = &self.area_before[range.start as usize..=range.end as usize];
        let wanted = sums[0] + share * (sums[sums.len() - 1] - sums[0]);
        let index = sums.partition_point(|&sum| sum <= wanted).clamp(1, sums.len() - 1) - 1;
        let rest = (wanted - sums[index]) / (sums[index + 1] - sums[index]);
        (range.start + index as u32, rest.clamp(0.0, 1.0f64.next_down()))
    }

    /// Distance in metres from a point to a shape.
    pub fn distance_to_shape(&self, shape: usize, position: DVec3) -> f64 {
        let each = self.primitives_of(shape).map(|p| self.primitives[p as usize].surface.distance(position));
        each.fold(f64::INFINITY, f64::min)
    }

    /// The shape that a primitive belongs to.
    pub fn shape_of(&self, primitive: u32) -> &Shape {
        &self.scene.shapes[self.primitives[primitive as usize].shape as usize]
    }

    /// True if a primitive's shape carries a meter: photons are stored there whatever the coating.
    pub fn is_metered(&self, primitive: u32) -> bool {
        self.metered[self.primitives[primitive as usize].shape as usize]
    }

    /// The medium beyond a primitive on the side of its normal, or on its back, where light came from or is in `current`.
    pub fn medium_beside(&self, primitive: u32, front: bool, current: Option<u32>) -> Option<u32> {
        match self.shape_of(primitive).boundary {
            Some(Boundary { interior, exterior }) => {
                if front {
                    exterior
                } else {
                    interior
                }
            }
            None => current,
        }
    }

    /// The nearest surface along a ray that starts on `from` (or on no surface), up to a distance.
    pub fn cast(&self, ray: &Ray, from: Option<u32>, limit: f64) -> Option<Hit> {
        let t_min = NEAREST * ray.origin.abs().max_element();
        let mut best: Option<(f64, u32)> = None;
        self.accelerator.along(ray, limit, |index, reach| {
            if let Some(t) = self.meet(ray, index, from, t_min)
                && t < reach
            {
                best = Some((t, index));
                return t;
            }
            reach
        });
        best.map(|(distance, primitive)| self.hit(ray, distance, primitive))
    }

    /// Every primitive tested in turn: the specification of [`World::cast`], kept for tests.
    pub fn cast_brute_force(&self, ray: &Ray, from: Option<u32>, limit: f64) -> Option<Hit> {
        let t_min = NEAREST * ray.origin.abs().max_element();
        let mut best: Option<(f64, u32)> = None;
        for index in 0..self.primitives.len() as u32 {
            if let Some(t) = self.meet(ray, index, from, t_min)
                && t < best.map_or(limit, |(t, _)| t)
            {
                best = Some((t, index));
            }
        }
        best.map(|(distance, primitive)| self.hit(ray, distance, primitive))
    }

    /// The share of light that passes between a point on `from` and a point at `distance` along the ray on `to`: 0 if a
    /// surface stands between, and the product of what masks leave open if none but masks do.
    pub fn unblocked(&self, ray: &Ray, from: Option<u32>, distance: f64, to: Option<u32>) -> f64 {
        let limit = distance * (1.0 - NEAREST);
        let t_min = NEAREST * ray.origin.abs().max_element();
        let mut open = 1.0;
        self.accelerator.along(ray, limit, |index, reach| {
            let goal = to == Some(index);
            if open > 0.0 && !(goal && self.is_end(index, 0.0, distance)) {
                let before = if goal { reach.min(distance * (1.0 - OWN)) } else { reach };
                open *= self.open_share(ray, index, from, t_min, before);
            }
            if open > 0.0 { reach } else { 0.0 }
        });
        open
    }

    /// True if a ray that is to end on a primitive at a distance has not met another part of that before, which hides the end.
    pub fn is_end(&self, primitive: u32, met: f64, distance: f64) -> bool {
        met >= distance * (1.0 - OWN) || !self.primitives[primitive as usize].surface.hides_itself()
    }

    /// Share of light that one primitive lets through up to a distance; a ray can cross a curved one several times.
    fn open_share(&self, ray: &Ray, index: u32, from: Option<u32>, t_min: f64, reach: f64) -> f64 {
        let (mut open, mut reached) = (1.0, 0.0);
        let (mut rest, mut from) = (*ray, from);
        while let Some(t) = self.meet(&rest, index, from, t_min)
            && reached + t < reach
        {
            open *= self.openness(index);
            if open == 0.0 {
                break;
            }
            reached += t;
            (rest, from) = (Ray::new(ray.at(reached), ray.direction), Some(index));
        }
        open
    }

    /// Share of light that goes through a primitive as if it were not there.
    pub fn openness(&self, primitive: u32) -> f64 {
        match self.shape_of(primitive).bsdf {
            Bsdf::Mask { opacity, .. } => 1.0 - opacity,
            Bsdf::Null => 1.0,
            _ => 0.0,
        }
    }

    /// True if a closed ball around a point on a primitive reaches over that primitive's edge or onto another one:
    /// where a density estimate would average over something else than the point's own surface.
    pub fn ball_leaves_surface(&self, point: &SurfacePoint, radius: f64) -> bool {
        let surface = &self.primitives[point.primitive as usize].surface;
        let leaves = match surface {
            Surface::Parallelogram(face) => face.distance_to_edge(point.position) < radius,
            Surface::Disk(disk) => disk.distance_to_edge(point.position) < radius,
            Surface::Triangle(face) => face.distance_to_edge(point.position) < radius,
            // Up to the sphere's own radius the ball cuts a cap of area pi r^2 from it (Archimedes), whose normals stay
            // within 60 degrees; beyond, a normal test or the far side spoils the area.
            Surface::Ball(ball) => ball.radius < radius,
            Surface::Tube(tube) => tube.distance_to_edge(point.position) < radius || FLAT_SHARE * tube.radius < radius,
            Surface::Dish(dish) => dish.distance_to_edge(point.position) < radius || dish.flat_within() < radius,
        };
        if leaves {
            return true;
        }
        self.accelerator.any_near(point.position, radius, |index| {
            index != point.primitive
                && !self.inert[index as usize]
                && self.primitives[index as usize].surface.distance(point.position) <= radius
                && !self.goes_on_as(point, index, radius)
        })
    }

    /// True if any primitive that rays notice and that reaches into a closed ball passes the test.
    pub(crate) fn any_in_ball(&self, position: DVec3, radius: f64, mut test: impl FnMut(u32) -> bool) -> bool {
        self.accelerator.any_near(position, radius, |index| {
            !self.inert[index as usize]
                && self.primitives[index as usize].surface.distance(position) <= radius
                && test(index)
        })
    }

    /// True if a surface lies within a closed ball, anything but one that leaves light and media as they are.
    pub fn is_near_surface(&self, position: DVec3, radius: f64) -> bool {
        self.accelerator.any_near(position, radius, |index| {
            let shape = self.shape_of(index);
            (shape.bsdf != Bsdf::Null || shape.boundary.is_some())
                && self.primitives[index as usize].surface.distance(position) <= radius
        })
    }

    /// True if a face near a point belongs to the same mesh, lies nearly in the point's plane, and does not end within the
    /// ball.
    fn goes_on_as(&self, point: &SurfacePoint, index: u32, radius: f64) -> bool {
        let (here, there) = (&self.primitives[point.primitive as usize], &self.primitives[index as usize]);
        let Surface::Triangle(face) = &there.surface else { return false };
        here.shape == there.shape
            && face.normal.dot(point.normal) >= SAME_SURFACE
            && face.distance_to_edge(point.position) >= radius
            && (face.corners[0] - point.position).dot(point.normal).abs() <= radius
    }

    /// The surface point of a primitive at a position on it.
    pub fn point_on(&self, primitive: u32, position: DVec3) -> SurfacePoint {
        let Primitive { surface, shape } = &self.primitives[primitive as usize];
        let normal = surface.normal(position);
        let shading = match (surface, &self.scene.shapes[*shape as usize]) {
            (Surface::Triangle(triangle), Shape { geometry: Geometry::Mesh(mesh), flip_normals, .. }) => {
                let face = primitive - self.first_primitive[*shape as usize];
                mesh.shading_normal(face as usize, triangle, position, *flip_normals)
            }
            _ => normal,
        };
        SurfacePoint { position, normal, shading, primitive }
    }

    fn meet(&self, ray: &Ray, index: u32, from: Option<u32>, t_min: f64) -> Option<f64> {
        if self.inert[index as usize] {
            return None;
        }
        self.primitives[index as usize].surface.intersect(ray, t_min, from == Some(index))
    }

    fn hit(&self, ray: &Ray, distance: f64, primitive: u32) -> Hit {
        let position = self.primitives[primitive as usize].surface.project(ray.at(distance));
        let point = self.point_on(primitive, position);
        Hit { point, distance, front: point.normal.dot(ray.direction) < 0.0 }
    }
}
