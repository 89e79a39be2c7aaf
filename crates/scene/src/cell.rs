//! Cells of a shape's (u, v) square: points drawn from them, their areas, and which one a point lies in.

use std::f64::consts::PI;

use glam::DVec2;

use crate::{
    primitive::{Surface, SurfacePoint},
    world::World,
};

impl World {
    /// A point drawn uniformly by area from the cell [column, row] of a shape's (u, v) square divided into
    /// columns x rows, from three numbers in [0, 1).
    pub fn point_in_cell(&self, shape: usize, cell: [u32; 2], cells: [u32; 2], xi: [f64; 3]) -> SurfacePoint {
        let (primitive, _) = self.primitive_by_area(shape, xi[2]);
        let within = |axis: usize| (f64::from(cell[axis]) + xi[axis]) / f64::from(cells[axis]);
        let u = within(0);
        let position = match &self.primitives[primitive as usize].surface {
            Surface::Parallelogram(face) => face.point(DVec2::new(u, within(1))),
            Surface::Tube(tube) => tube.point(DVec2::new(u, within(1))),
            Surface::Disk(disk) => {
                let share = |column: u32| disk.share_within(f64::from(column) / f64::from(cells[0]));
                let (near, far) = (share(cell[0]), share(cell[0] + 1));
                disk.point(DVec2::new(disk.u_of_share(near + xi[0] * (far - near)), within(1)))
            }
            Surface::Dish(dish) => {
                let share = |column: u32| dish.share_within(f64::from(column) / f64::from(cells[0]));
                let (near, far) = (share(cell[0]), share(cell[0] + 1));
                dish.point(DVec2::new(dish.u_of_share(near + xi[0] * (far - near)), within(1)))
            }
            // A mesh has one cell.
            Surface::Triangle(face) => face.point([xi[0], xi[1]]),
            Surface::Ball(ball) => {
                let (top, bottom) = (cos_polar(cell[1], cells[1]), cos_polar(cell[1] + 1, cells[1]));
                ball.point(u, top + xi[1] * (bottom - top))
            }
        };
        self.point_on(primitive, position)
    }

    /// Area in square metres of the cell [column, row] of a shape's (u, v) square divided into columns x rows.
    pub fn cell_area(&self, shape: usize, [column, row]: [u32; 2], cells: [u32; 2]) -> f64 {
        let [columns, rows] = cells.map(f64::from);
        if matches!(self.primitives[self.primitives_of(shape).start as usize].surface, Surface::Triangle(_)) {
            return self.area_of(shape) / (columns * rows);
        }
        let of_surface = |p: u32| match &self.primitives[p as usize].surface {
            Surface::Parallelogram(face) => face.area() / (columns * rows),
            Surface::Tube(tube) => tube.area() / (columns * rows),
            Surface::Triangle(face) => face.area() / (columns * rows),
            Surface::Disk(disk) => {
                let share = |column: u32| disk.share_within(f64::from(column) / columns);
                disk.area() * (share(column + 1) - share(column)) / rows
            }
            Surface::Dish(dish) => {
                let share = |column: u32| dish.share_within(f64::from(column) / columns);
                dish.area() * (share(column + 1) - share(column)) / rows
            }
            Surface::Ball(ball) => {
                ball.area() * 0.5 * (cos_polar(row, cells[1]) - cos_polar(row + 1, cells[1])) / columns
            }
        };
        self.primitives_of(shape).map(of_surface).sum()
    }

    /// (u, v) of a point on its primitive.
    pub fn uv(&self, point: &SurfacePoint) -> DVec2 {
        match &self.primitives[point.primitive as usize].surface {
            Surface::Parallelogram(face) => face.uv(point.position),
            Surface::Ball(ball) => ball.uv(point.position),
            Surface::Disk(disk) => disk.uv(point.position),
            Surface::Tube(tube) => tube.uv(point.position),
            Surface::Dish(dish) => dish.uv(point.position),
            Surface::Triangle(_) => DVec2::splat(0.5),
        }
    }
}

/// Cosine of the polar angle at which a sphere's row begins.
fn cos_polar(row: u32, rows: u32) -> f64 {
    (PI * f64::from(row) / f64::from(rows)).cos()
}
