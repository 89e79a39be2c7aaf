//! The scene made ready for rays: where a ray lands, what lies near a point, how large a cell is.

use glam::{DVec2, DVec3, Vec3A};
use obvhs::{
    BvhBuildParams,
    aabb::Aabb,
    bvh2::{Bvh2, builder::build_bvh2},
    cwbvh::{CwBvh, bvh2_to_cwbvh::bvh2_to_cwbvh},
    ray::{Ray as BoxRay, RayHit},
};

use crate::{
    ball::Ball,
    description::{Bsdf, Geometry, Scene, Shape},
    parallelogram::Parallelogram,
    ray::Ray,
};

/// A ray that starts on no known surface ignores what is nearer than this times its origin's largest coordinate.
/// Rays that start on a primitive never meet that (flat) primitive again, whatever the scale.
const NEAREST: f64 = 1e-11;

/// In the accelerator's own coordinates, in which the scene spans [-1, 1], boxes are grown by this much: more than
/// its single precision can lose.
const BOX_MARGIN: f32 = 1e-5;

/// Up to this many primitives a loop is faster than the tree (measured on the project's scenes).
const LOOP_LIMIT: usize = 8;

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
    /// Index into [`Scene::shapes`].
    pub shape: u32,
}

/// A point on a primitive.
#[derive(Clone, Copy, Debug)]
pub struct SurfacePoint {
    /// Where, in metres.
    pub position: DVec3,
    /// Unit normal of the shape's front side.
    pub normal: DVec3,
    /// Index into [`World::primitives`].
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

/// A scene with its primitives and their accelerator.
pub struct World {
    /// The description it was made from.
    pub scene: Scene,
    /// Every surface that a ray can meet.
    pub primitives: Vec<Primitive>,
    /// First primitive of each shape, and one past the last of all.
    first_primitive: Vec<u32>,
    centre: DVec3,
    half_extent: f64,
    bounds: (DVec3, DVec3),
    /// Absent where a loop over all primitives is faster.
    tree: Option<Tree>,
}

/// One hierarchy of boxes in two forms: eight-wide for rays, binary for neighbourhoods.
struct Tree {
    boxes: Bvh2,
    wide: CwBvh,
}

impl Tree {
    fn new(boxes: &[Aabb]) -> Self {
        let parameters = BvhBuildParams { max_prims_per_leaf: 1, ..BvhBuildParams::medium_build() };
        let boxes = build_bvh2(boxes, parameters, &mut Default::default());
        let wide = bvh2_to_cwbvh(&boxes, 3, true, false);
        Self { boxes, wide }
    }
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
        let bounds = primitives.iter().map(|p| p.surface.bounds()).reduce(|a, b| (a.0.min(b.0), a.1.max(b.1)));
        let bounds = bounds.unwrap_or((DVec3::ZERO, DVec3::ZERO));
        let centre = 0.5 * (bounds.0 + bounds.1);
        let half_extent = (0.5 * (bounds.1 - bounds.0).max_element()).max(f64::MIN_POSITIVE);
        let local_boxes: Vec<Aabb> = primitives
            .iter()
            .map(|p| {
                let (low, high) = p.surface.bounds();
                let local = |x: DVec3| Vec3A::from(((x - centre) / half_extent).as_vec3());
                Aabb::new(local(low) - BOX_MARGIN, local(high) + BOX_MARGIN)
            })
            .collect();
        let tree = (primitives.len() > LOOP_LIMIT).then(|| Tree::new(&local_boxes));
        Self { scene, primitives, first_primitive, centre, half_extent, bounds, tree }
    }

    /// Smallest and largest coordinates of all surfaces, metres; zeros for a scene without surfaces.
    pub fn bounds(&self) -> (DVec3, DVec3) {
        self.bounds
    }

    /// The primitives of a shape, as indices.
    pub fn primitives_of(&self, shape: usize) -> std::ops::Range<u32> {
        self.first_primitive[shape]..self.first_primitive[shape + 1]
    }

    /// The shape that a primitive belongs to.
    pub fn shape_of(&self, primitive: u32) -> &Shape {
        &self.scene.shapes[self.primitives[primitive as usize].shape as usize]
    }

    /// What the surface does to light that arrives on one of its sides; `None` where it absorbs everything.
    pub fn coating(&self, primitive: u32, front: bool) -> Option<&Bsdf> {
        match (&self.shape_of(primitive).bsdf, front) {
            (Bsdf::TwoSided { front, .. }, true) => Some(front),
            (Bsdf::TwoSided { back, .. }, false) => Some(back),
            (bsdf @ Bsdf::Dielectric { .. }, _) => Some(bsdf),
            (bsdf, true) => Some(bsdf),
            (_, false) => None,
        }
    }

    /// The nearest surface along a ray that starts on `from` (or on no surface), up to a distance.
    pub fn cast(&self, ray: &Ray, from: Option<u32>, limit: f64) -> Option<Hit> {
        let mut best: Option<(f64, u32)> = None;
        self.visit(ray, limit, |t_min, index, reach| {
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

    /// True if nothing stands between a point on `from` and a point at `distance` along the ray on `to`.
    pub fn sees(&self, ray: &Ray, from: Option<u32>, distance: f64, to: Option<u32>) -> bool {
        let limit = distance * (1.0 - NEAREST);
        let mut clear = true;
        self.visit(ray, limit, |t_min, index, reach| {
            if !clear || to == Some(index) {
                return if clear { reach } else { 0.0 };
            }
            match self.meet(ray, index, from, t_min) {
                Some(t) if t < reach => {
                    clear = false;
                    0.0
                }
                _ => reach,
            }
        });
        clear
    }

    /// True if a closed ball around a point on a primitive reaches over that primitive's edge or onto another one:
    /// where a density estimate would average over something else than the point's own surface.
    pub fn ball_leaves_surface(&self, point: &SurfacePoint, radius: f64) -> bool {
        if let Surface::Parallelogram(face) = &self.primitives[point.primitive as usize].surface
            && face.distance_to_edge(point.position) < radius
        {
            return true;
        }
        let reaches = |index: u32| {
            index != point.primitive && self.primitives[index as usize].surface.distance(point.position) <= radius
        };
        let Some(tree) = &self.tree else {
            return (0..self.primitives.len() as u32).any(reaches);
        };
        let local = ((point.position - self.centre) / self.half_extent).as_vec3();
        let reach = (radius / self.half_extent) as f32 * (1.0 + 1e-6) + BOX_MARGIN;
        let around = Aabb::new(Vec3A::from(local) - reach, Vec3A::from(local) + reach);
        let mut found = false;
        tree.boxes.aabb_traverse(around, |tree, node| {
            let node = &tree.nodes[node as usize];
            let leaf = node.first_index as usize..(node.first_index + node.prim_count) as usize;
            found = found || leaf.into_iter().any(|i| reaches(tree.primitive_indices[i]));
            !found
        });
        found
    }

    /// A point drawn uniformly by area from the cell [column, row] of a shape's (u, v) square divided into
    /// columns x rows, from three numbers in [0, 1).
    pub fn point_in_cell(&self, shape: usize, cell: [u32; 2], cells: [u32; 2], xi: [f64; 3]) -> SurfacePoint {
        let range = self.primitives_of(shape);
        let primitive = self.choose_by_area(range, xi[2]);
        let u = (f64::from(cell[0]) + xi[0]) / f64::from(cells[0]);
        let position = match &self.primitives[primitive as usize].surface {
            Surface::Parallelogram(face) => {
                face.point(DVec2::new(u, (f64::from(cell[1]) + xi[1]) / f64::from(cells[1])))
            }
            Surface::Ball(ball) => {
                let polar = |row: u32| (std::f64::consts::PI * f64::from(row) / f64::from(cells[1])).cos();
                let (top, bottom) = (polar(cell[1]), polar(cell[1] + 1));
                ball.point(u, top + xi[1] * (bottom - top))
            }
        };
        self.point_on(primitive, position)
    }

    /// Area in square metres of the cells in a row of a shape's (u, v) square divided into columns x rows.
    pub fn cell_area(&self, shape: usize, row: u32, cells: [u32; 2]) -> f64 {
        let of_surface = |p: u32| match &self.primitives[p as usize].surface {
            Surface::Parallelogram(face) => face.area() / f64::from(cells[1]),
            Surface::Ball(ball) => {
                let polar = |row: u32| (std::f64::consts::PI * f64::from(row) / f64::from(cells[1])).cos();
                ball.area() * 0.5 * (polar(row) - polar(row + 1))
            }
        };
        self.primitives_of(shape).map(of_surface).sum::<f64>() / f64::from(cells[0])
    }

    /// (u, v) of a point on its primitive.
    pub fn uv(&self, point: &SurfacePoint) -> DVec2 {
        match &self.primitives[point.primitive as usize].surface {
            Surface::Parallelogram(face) => face.uv(point.position),
            Surface::Ball(ball) => ball.uv(point.position),
        }
    }

    /// The surface point of a primitive at a position on it.
    pub fn point_on(&self, primitive: u32, position: DVec3) -> SurfacePoint {
        let normal = match &self.primitives[primitive as usize].surface {
            Surface::Parallelogram(face) => face.normal,
            Surface::Ball(ball) => ball.normal(position),
        };
        SurfacePoint { position, normal, primitive }
    }

    fn choose_by_area(&self, range: std::ops::Range<u32>, xi: f64) -> u32 {
        let area = |p: u32| self.primitives[p as usize].surface.area();
        let mut rest = xi * range.clone().map(area).sum::<f64>();
        for p in range.clone() {
            rest -= area(p);
            if rest < 0.0 {
                return p;
            }
        }
        range.end - 1
    }

    /// Offers the primitives near a ray to `test(t_min, primitive, reach) -> reach`, nearest boxes first.
    fn visit(&self, ray: &Ray, limit: f64, mut test: impl FnMut(f64, u32, f64) -> f64) {
        let t_min = NEAREST * ray.origin.abs().max_element();
        let mut reach = limit;
        let Some(tree) = &self.tree else {
            for index in 0..self.primitives.len() as u32 {
                reach = test(t_min, index, reach);
            }
            return;
        };
        // The walk starts where the ray enters the scene's bounding sphere, so that a far-away eye costs no digits, and
        // never less than a hundredth before the ray itself: the accelerator leaves out boxes that end within 1e-4.
        let offset = (ray.origin - self.centre) / self.half_extent;
        let entry = (-offset.dot(ray.direction) - 1.75).max(-0.01);
        let local = |t: f64| (((t / self.half_extent) - entry) as f32).next_up();
        let start = offset + entry * ray.direction;
        let box_ray = BoxRay::new(start.as_vec3().into(), ray.direction.as_vec3().into(), 0.0, local(reach));
        tree.wide.ray_traverse(box_ray, &mut RayHit::none(), |_, i| {
            reach = test(t_min, tree.wide.primitive_indices[i], reach);
            local(reach)
        });
    }

    fn meet(&self, ray: &Ray, index: u32, from: Option<u32>, t_min: f64) -> Option<f64> {
        let starts_here = from == Some(index);
        match &self.primitives[index as usize].surface {
            Surface::Parallelogram(_) if starts_here => None,
            Surface::Parallelogram(face) => face.intersect(ray, t_min).map(|(t, _)| t),
            Surface::Ball(ball) => ball.intersect(ray, t_min, starts_here),
        }
    }

    fn hit(&self, ray: &Ray, distance: f64, primitive: u32) -> Hit {
        let position = match &self.primitives[primitive as usize].surface {
            Surface::Parallelogram(face) => {
                let landed = ray.at(distance);
                landed - face.normal * face.normal.dot(landed - face.centre)
            }
            Surface::Ball(ball) => ball.project(ray.at(distance)),
        };
        let point = self.point_on(primitive, position);
        Hit { point, distance, front: point.normal.dot(ray.direction) < 0.0 }
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

    fn bounds(&self) -> (DVec3, DVec3) {
        match self {
            Surface::Parallelogram(face) => face.bounds(),
            Surface::Ball(ball) => ball.bounds(),
        }
    }

    fn distance(&self, position: DVec3) -> f64 {
        match self {
            Surface::Parallelogram(face) => face.distance(position),
            Surface::Ball(ball) => ball.distance(position),
        }
    }
}

fn surfaces(shape: &Shape) -> Vec<Surface> {
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
