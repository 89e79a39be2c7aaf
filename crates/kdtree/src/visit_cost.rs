//! What a box costs the queries that come: its points, times the chance that a query's ball touches it.

use std::f64::consts::PI;

/// How often a query opens a box, up to a factor that all boxes share.
///
/// A ball of radius r touches a box exactly if its centre lies in the box grown by r, so the chance is the measure of
/// the grown box where queries may lie. For a box of edges a, b, c with volume V and surface S:
///
/// * Queries uniform in space: the measure is the volume of the box rounded by r, by Steiner's formula
///   `V + S r + pi (a + b + c) r^2 + 4/3 pi r^3`: the box, a slab on each face, quarter cylinders along the edges and
///   eighths of a ball at the corners. Where r is small beside the box this is V; the paper's S is the term linear in r.
/// * Queries distributed like the photons: where these lie on a sheet so do the queries, the box is a piece of the sheet
///   with area A and perimeter P, and the measure is the area of the rounded piece, `A + P r + pi r^2`. The piece is taken
///   to be the box's largest face.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum VisitCost {
    /// `S`, eq. 2 of the paper without its empty node: the chance for lines, not balls.
    SurfaceArea,
    /// The voxel-volume heuristic: the volume of the box grown by r to each side, `V + S r + 4 (a + b + c) r^2 + 8 r^3`.
    VoxelVolume(Reach),
    /// Queries uniform in space: `V + S r + pi (a + b + c) r^2 + 4/3 pi r^3`.
    BallInSpace(Reach),
    /// Queries on the sheet of the photons: `A + P r + pi r^2`.
    BallOnSheet(Reach),
}

/// The radius of the queries to come.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Reach {
    /// This radius, in the unit of the coordinates; zero or more, finite.
    Radius(f32),
    /// The radius that holds this many points at the density of the node being cut: of a line, a sheet or a body of
    /// the node's box, whichever radius is largest. Scale drops out.
    Nearest(usize),
}

impl Reach {
    /// The radius for a node of `count` points in a box of these edges.
    pub(crate) fn radius(self, [a, b, c]: [f64; 3], count: usize) -> f64 {
        match self {
            Self::Radius(radius) => radius.into(),
            Self::Nearest(k) => {
                let share = k as f64 / count as f64;
                let line = 0.5 * share * a.max(b).max(c);
                let sheet = (share * largest_face([a, b, c]).0 / PI).sqrt();
                let body = (0.75 * share * a * b * c / PI).cbrt();
                line.max(sheet).max(body)
            }
        }
    }
}

impl VisitCost {
    /// The reach, where the cost has one.
    pub(crate) fn reach(self) -> Option<Reach> {
        match self {
            Self::SurfaceArea => None,
            Self::VoxelVolume(reach) | Self::BallInSpace(reach) | Self::BallOnSheet(reach) => Some(reach),
        }
    }

    /// The measure of a box of these edges, grown by `r`.
    #[inline(always)]
    pub(crate) fn of(self, [a, b, c]: [f64; 3], r: f64) -> f64 {
        let (volume, surface, edges) = (a * b * c, 2.0 * (a * b + b * c + c * a), a + b + c);
        match self {
            Self::SurfaceArea => surface,
            Self::VoxelVolume(_) => volume + r * (surface + r * (4.0 * edges + 8.0 * r)),
            Self::BallInSpace(_) => volume + r * (surface + r * PI * (edges + 4.0 / 3.0 * r)),
            Self::BallOnSheet(_) => {
                let (area, perimeter) = largest_face([a, b, c]);
                area + r * (perimeter + PI * r)
            }
        }
    }
}

/// Area and perimeter.
#[inline(always)]
fn largest_face([a, b, c]: [f64; 3]) -> (f64, f64) {
    let shortest = a.min(b).min(c);
    let (long, wide) = if shortest == a {
        (b, c)
    } else if shortest == b {
        (a, c)
    } else {
        (a, b)
    };
    (long * wide, 2.0 * (long + wide))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn grown_measures_of_known_bodies() {
        let close = |a: f64, b: f64| assert!((a - b).abs() < 1e-12 * b.abs().max(1.0), "{a} {b}");
        let any = Reach::Radius(0.0);
        // A point grows to a ball, a cube or a disc; without growth the box itself is left.
        close(VisitCost::BallInSpace(any).of([0.0; 3], 2.0), 32.0 / 3.0 * PI);
        close(VisitCost::VoxelVolume(any).of([0.0; 3], 2.0), 64.0);
        close(VisitCost::BallOnSheet(any).of([0.0; 3], 2.0), 4.0 * PI);
        close(VisitCost::BallInSpace(any).of([1.0, 2.0, 3.0], 0.0), 6.0);
        close(VisitCost::VoxelVolume(any).of([1.0, 2.0, 3.0], 0.5), 2.0 * 3.0 * 4.0);
        close(VisitCost::BallOnSheet(any).of([1.0, 0.0, 3.0], 1.0), 3.0 + 8.0 + PI);
        close(VisitCost::SurfaceArea.of([1.0, 2.0, 3.0], 9.0), 22.0);
        // A segment grows to a capsule.
        close(VisitCost::BallInSpace(any).of([5.0, 0.0, 0.0], 1.0), 5.0 * PI + 4.0 / 3.0 * PI);
    }

    #[test]
    fn the_reach_holds_k_points() {
        let r = Reach::Nearest(100).radius([1.0; 3], 1_000_000);
        assert!((4.0 / 3.0 * PI * r.powi(3) * 1e6 - 100.0).abs() < 1e-9);
        let r = Reach::Nearest(100).radius([1.0, 0.0, 2.0], 1_000_000);
        assert!((PI * r * r * 5e5 - 100.0).abs() < 1e-9);
        assert_eq!(Reach::Nearest(10).radius([0.0, 4.0, 0.0], 100), 0.2);
        assert_eq!(Reach::Radius(0.25).radius([1.0; 3], 9), 0.25);
    }
}
