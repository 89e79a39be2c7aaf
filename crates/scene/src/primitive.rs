//! The surfaces that rays meet, and where they meet them.

use glam::{DVec2, DVec3};

use crate::{
    ball::Ball,
    description::{Geometry, LensBody, Shape},
    dish::{Dish, Section},
    disk::Disk,
    frame::Frame,
    normals::Normals,
    parallelogram::Parallelogram,
    ray::Ray,
    triangle::Triangle,
    tube::Tube,
};

/// The kinds of primitive that a ray can meet.
#[derive(Clone, Copy, Debug)]
pub enum Surface {
    /// A flat face.
    Parallelogram(Parallelogram),
    /// A whole sphere.
    Ball(Ball),
    /// A flat disk.
    Disk(Disk),
    /// A cylinder's wall.
    Tube(Tube),
    /// A face of a mesh.
    Triangle(Triangle),
    /// A cap of a sphere or a paraboloid.
    Dish(Dish),
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
    /// Unit normal of the smooth surface that a mesh stands for; `normal` itself elsewhere.
    pub shading: DVec3,
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

    /// Both normals on that side.
    pub fn facing_normals(&self) -> Normals {
        let side = if self.front { 1.0 } else { -1.0 };
        Normals { geometric: side * self.point.normal, shading: side * self.point.shading }
    }
}

impl Surface {
    /// Area in square metres.
    pub fn area(&self) -> f64 {
        match self {
            Surface::Parallelogram(face) => face.area(),
            Surface::Ball(ball) => ball.area(),
            Surface::Disk(disk) => disk.area(),
            Surface::Tube(tube) => tube.area(),
            Surface::Triangle(face) => face.area(),
            Surface::Dish(dish) => dish.area(),
        }
    }

    pub(crate) fn bounds(&self) -> (DVec3, DVec3) {
        match self {
            Surface::Parallelogram(face) => face.bounds(),
            Surface::Ball(ball) => ball.bounds(),
            Surface::Disk(disk) => disk.bounds(),
            Surface::Tube(tube) => tube.bounds(),
            Surface::Triangle(face) => face.bounds(),
            Surface::Dish(dish) => dish.bounds(),
        }
    }

    /// Distance in metres from any point to the surface.
    pub fn distance(&self, position: DVec3) -> f64 {
        match self {
            Surface::Parallelogram(face) => face.distance(position),
            Surface::Ball(ball) => ball.distance(position),
            Surface::Disk(disk) => disk.distance(position),
            Surface::Tube(tube) => tube.distance(position),
            Surface::Triangle(face) => face.distance(position),
            Surface::Dish(dish) => dish.distance(position),
        }
    }

    /// Distance along a ray beyond `t_min` to where it meets the surface. A ray that starts here never meets a flat surface
    /// again, whatever the scale.
    pub(crate) fn intersect(&self, ray: &Ray, t_min: f64, starts_here: bool) -> Option<f64> {
        match self {
            Surface::Ball(ball) => ball.intersect(ray, t_min, starts_here),
            Surface::Tube(tube) => tube.intersect(ray, t_min, starts_here),
            Surface::Dish(dish) => dish.intersect(ray, t_min, starts_here),
            Surface::Parallelogram(_) | Surface::Disk(_) | Surface::Triangle(_) if starts_here => None,
            Surface::Parallelogram(face) => face.intersect(ray, t_min).map(|(t, _)| t),
            Surface::Disk(disk) => disk.intersect(ray, t_min),
            Surface::Triangle(face) => face.intersect(ray, t_min),
        }
    }

    /// Unit normal of the front side at a point of the surface.
    pub fn normal(&self, position: DVec3) -> DVec3 {
        match self {
            Surface::Parallelogram(face) => face.normal,
            Surface::Disk(disk) => disk.around.normal,
            Surface::Triangle(face) => face.normal,
            Surface::Ball(ball) => ball.normal(position),
            Surface::Tube(tube) => tube.normal(position),
            Surface::Dish(dish) => dish.normal(position),
        }
    }

    /// The point of the surface that a ray landed on, without the error of the ray's length.
    pub(crate) fn project(&self, landed: DVec3) -> DVec3 {
        let on_plane = |on: DVec3, normal: DVec3| landed - normal * normal.dot(landed - on);
        match self {
            Surface::Parallelogram(face) => on_plane(face.centre, face.normal),
            Surface::Disk(disk) => on_plane(disk.around.centre, disk.around.normal),
            Surface::Triangle(face) => on_plane(face.corners[0], face.normal),
            Surface::Ball(ball) => ball.project(landed),
            Surface::Tube(tube) => tube.project(landed),
            Surface::Dish(dish) => dish.project(landed),
        }
    }

    /// True if a point of its front side can be hidden by the rest of it: a surface that shines inwards, seen from outside.
    pub(crate) fn hides_itself(&self) -> bool {
        match self {
            Surface::Parallelogram(_) | Surface::Disk(_) | Surface::Triangle(_) => false,
            Surface::Ball(ball) => ball.inwards,
            Surface::Tube(tube) => tube.inwards,
            Surface::Dish(_) => true,
        }
    }

    /// A point even by area, from two numbers in [0, 1).
    pub fn point_by_area(&self, xi: [f64; 2]) -> DVec3 {
        match self {
            Surface::Parallelogram(face) => face.point(DVec2::from(xi)),
            Surface::Disk(disk) => disk.point(DVec2::new(disk.u_of_share(xi[0]), xi[1])),
            Surface::Tube(tube) => tube.point(DVec2::from(xi)),
            Surface::Dish(dish) => dish.point(DVec2::new(dish.u_of_share(xi[0]), xi[1])),
            Surface::Triangle(face) => face.point(xi),
            Surface::Ball(ball) => ball.point(xi[0], 1.0 - 2.0 * xi[1]),
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
        Geometry::Disk { to_world } => {
            let m = to_world.matrix3;
            vec![Surface::Disk(Disk::new(to_world.translation, m.x_axis, m.y_axis, side * m.z_axis))]
        }
        Geometry::Cylinder { frame, radius, length } => {
            let (radius, length) = (*radius, *length);
            vec![Surface::Tube(Tube { frame: *frame, radius, length, inwards: shape.flip_normals })]
        }
        Geometry::Mesh(mesh) => mesh.triangles(shape.flip_normals).into_iter().map(Surface::Triangle).collect(),
        Geometry::Paraboloid { frame, focal_length, rim } => vec![Surface::Dish(Dish {
            frame: *frame,
            section: Section::Parabola,
            curvature: 0.5 / focal_length,
            rim: *rim,
            front_up: !shape.flip_normals,
        })],
        Geometry::Lens { frame, lens } => lens_faces(frame, lens, shape.flip_normals),
    }
}

/// Its two faces and the rim between them.
fn lens_faces(frame: &Frame, lens: &LensBody, inwards: bool) -> Vec<Surface> {
    let face = |index: usize| Dish {
        frame: Frame { origin: frame.world(index as f64 * lens.thickness * DVec3::Z), ..*frame },
        section: Section::Circle,
        curvature: lens.curvatures[index],
        rim: lens.rim,
        front_up: (index == 1) != inwards,
    };
    let faces = [face(0), face(1)];
    let from = faces[0].sag(lens.rim);
    let length = lens.thickness + faces[1].sag(lens.rim) - from;
    let frame = Frame { origin: frame.world(from * DVec3::Z), ..*frame };
    let rim = Tube { frame, radius: lens.rim, length, inwards };
    vec![Surface::Dish(faces[0]), Surface::Dish(faces[1]), Surface::Tube(rim)]
}
