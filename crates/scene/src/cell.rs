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
        let range = self.primitives_of(shape);
        let primitive = self.choose_by_area(range, xi[2]);
        let u = (f64::from(cell[0]) + xi[0]) / f64::from(cells[0]);
        let position = match &self.primitives[primitive as usize].surface {
            Surface::Parallelogram(face) => {
                face.point(DVec2::new(u, (f64::from(cell[1]) + xi[1]) / f64::from(cells[1])))
            }
            Surface::Ball(ball) => {
                let (top, bottom) = (cos_polar(cell[1], cells[1]), cos_polar(cell[1] + 1, cells[1]));
                ball.point(u, top + xi[1] * (bottom - top))
            }
        };
        self.point_on(primitive, position)
    }

    /// Area in square metres of the cells in a row of a shape's (u, v) square divided into columns x rows.
    pub fn cell_area(&self, shape: usize, row: u32, cells: [u32; 2]) -> f64 {
        let of_surface = |p: u32| match &self.primitives[p as usize].surface {
            Surface::Parallelogram(face) => face.area() / f64::from(cells[1]),
            Surface::Ball(ball) => ball.area() * 0.5 * (cos_polar(row, cells[1]) - cos_polar(row + 1, cells[1])),
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
}

/// Cosine of the polar angle at which a sphere's row begins.
fn cos_polar(row: u32, rows: u32) -> f64 {
    (PI * f64::from(row) / f64::from(rows)).cos()
}
