//! The surfaces that rays meet, and where they meet them.

use glam::DVec3;

use crate::{
    ball::Ball,
    description::{Geometry, Shape},
    parallelogram::Parallelogram,
};

/// The kinds of primitive that a ray can meet.
#[derive(Clone, Copy, Debug)]
pub enum Surface {
    /// A flat face.
    Parallelogram(Parallelogram),
    /// A whole sphere.
    Ball(Ball),
}

/// One surface that a ray can meet and the shape it belongs to.
#[derive(Clone, Copy, Debug)]
pub struct Primitive {
    /// Its geometry.
    pub surface: Surface,
    /// Index into [`Scene::shapes`](crate::Scene::shapes).
    pub shape: u32,
}

/// A point on a primitive.
#[derive(Clone, Copy, Debug)]
pub struct SurfacePoint {
    /// Where, in metres.
    pub position: DVec3,
    /// Unit normal of the shape's front side.
    pub normal: DVec3,
    /// Index into [`World::primitives`](crate::World::primitives).
    pub primitive: u32,
}

/// Where a ray landed.
#[derive(Clone, Copy, Debug)]
pub struct Hit {
    /// The point.
    pub point: SurfacePoint,
    /// Distance from the ray's start, metres.
    pub distance: f64,
    /// True if the ray came from the side of the normal.
    pub front: bool,
}

impl Hit {
    /// The normal on the side from which the ray came.
    pub fn facing_normal(&self) -> DVec3 {
        if self.front { self.point.normal } else { -self.point.normal }
    }
}

impl Surface {
    /// Area in square metres.
    pub fn area(&self) -> f64 {
        match self {
            Surface::Parallelogram(face) => face.area(),
            Surface::Ball(ball) => ball.area(),
        }
    }

    pub(crate) fn bounds(&self) -> (DVec3, DVec3) {
        match self {
            Surface::Parallelogram(face) => face.bounds(),
            Surface::Ball(ball) => ball.bounds(),
        }
    }

    /// Distance in metres from any point to the surface.
    pub(crate) fn distance(&self, position: DVec3) -> f64 {
        match self {
            Surface::Parallelogram(face) => face.distance(position),
            Surface::Ball(ball) => ball.distance(position),
        }
    }
}

/// The primitives of a shape.
pub(crate) fn surfaces(shape: &Shape) -> Vec<Surface> {
    let side = if shape.flip_normals { -1.0 } else { 1.0 };
    match &shape.geometry {
        Geometry::Rectangle { to_world } => {
            let m = to_world.matrix3;
            // A normal goes with the inverse transpose, so a mirrored rectangle keeps the side that local +z points to.
            let front = side * m.z_axis;
            vec![Surface::Parallelogram(Parallelogram::new(to_world.translation, m.x_axis, m.y_axis, front))]
        }
        Geometry::Cube { to_world } => {
            let m = to_world.matrix3;
            let axes = [m.x_axis, m.y_axis, m.z_axis];
            (0..6)
                .map(|face| {
                    let outwards = axes[face / 2] * if face % 2 == 0 { 1.0 } else { -1.0 };
                    let (u, v) = (axes[(face / 2 + 1) % 3], axes[(face / 2 + 2) % 3]);
                    Surface::Parallelogram(Parallelogram::new(to_world.translation + outwards, u, v, side * outwards))
                })
                .collect()
        }
        Geometry::Sphere { centre, radius, to_world } => {
            vec![Surface::Ball(Ball { centre: *centre, radius: *radius, axes: *to_world, inwards: shape.flip_normals })]
        }
    }
}
