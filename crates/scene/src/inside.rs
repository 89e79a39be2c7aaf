//! How much surface lies inside a ball around a point, weighed by the distance from its centre: what a density estimate
//! must divide by where a surface ends, and the first and second moments that tell a slope.

use std::f64::consts::{FRAC_PI_8, PI, TAU};

use glam::{DMat3, DVec2, DVec3};

use crate::{
    ball::Ball,
    disk::Disk,
    hidden::{Around, Face},
    parallelogram::Parallelogram,
    primitive::Surface,
    tube::Tube,
    world::World,
};

/// Nodes and weights of the Gauss-Legendre rule with five points on [-1, 1]: exact up to degree nine.
const GAUSS: [(f64, f64); 5] = [
    (-0.906_179_845_938_664, 0.236_926_885_056_189_1),
    (-0.538_469_310_105_683_1, 0.478_628_670_499_366_5),
    (0.0, 0.568_888_888_888_888_9),
    (0.538_469_310_105_683_1, 0.478_628_670_499_366_5),
    (0.906_179_845_938_664, 0.236_926_885_056_189_1),
];

/// Planes nearer to the centre than this share of the radius are one with the plane of the centre, and corners nearer to a side
/// than this are on it.
const SAME_PLANE: f64 = 1e-6;

/// Nearer to the foot of a plane than this share of the radius, a quotient is taken for its limit.
const AT_THE_FOOT: f64 = 1e-6;

/// A weight that depends on `t`, the squared distance over the squared radius, with the integrals that flat surfaces need.
pub trait RadialWeight {
    /// The weight.
    fn weight(&self, t: f64) -> f64;
    /// Its integral from 0 to `t`: the weighed area of a disc over the area of the whole one.
    fn mass(&self, t: f64) -> f64;
    /// The integral of `t` times the weight from 0 to `t`.
    fn second(&self, t: f64) -> f64;
}

/// The ball, and what counts as surface in it.
#[derive(Clone, Copy, Debug)]
pub struct Neighbourhood {
    /// The ball's centre.
    pub position: DVec3,
    /// The primitive on which the centre lies.
    pub primitive: u32,
    /// Unit normal on the side that is read.
    pub normal: DVec3,
    /// The ball's radius, metres.
    pub radius: f64,
    /// Surfaces count whose normal, on one of their sides, makes at least this cosine with that one.
    pub least_cosine: f64,
}

/// Integrals of a weight over the surface inside a ball, lengths in radii from its centre, areas in discs of that radius.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Inside {
    /// The weighed area.
    pub area: f64,
    /// The integral of the offset.
    pub first: DVec3,
    /// The integral of the offset times itself.
    pub second: DMat3,
    /// True if nothing in the ball can hide a part of this surface.
    pub open: bool,
}

/// More surfaces than this in a ball are not looked at: on a dense mesh every estimate would take longer than all the rest.
const MOST_SURFACES: usize = 64;

impl Inside {
    const NOTHING: Self = Self { area: 0.0, first: DVec3::ZERO, second: DMat3::ZERO, open: true };

    fn add(&mut self, other: &Inside) {
        self.area += other.area;
        self.first += other.first;
        self.second += other.second;
    }
}

impl World {
    /// Integrals of a weight over all surface inside a ball of which a side passes the test of normals and `counts`, as
    /// it does for a primitive's number and whether its front side is meant. Exact for flat faces and circles, whether
    /// their planes go through the centre or not, and for the sphere on which the centre lies; within 1e-4 discs for
    /// the cylinder on which it lies, and for weights that are no polynomials of `t`. Surface under another body counts too, but is
    /// not [`Inside::open`]. `None` if a curved surface other than these is in the ball, or a face that lies in the centre's
    /// own, since which of the two light meets cannot be told, or more than 64 surfaces.
    pub fn surface_inside(
        &self,
        around: &Neighbourhood,
        weight: &impl RadialWeight,
        counts: impl Fn(u32, bool) -> bool,
    ) -> Option<Inside> {
        let mut sum = Inside::NOTHING;
        let mut faces = Vec::new();
        let (mut seen, mut bent) = (0, false);
        let unknown = self.any_in_ball(around.position, around.radius, |index| {
            let surface = &self.primitives[index as usize].surface;
            let own = index == around.primitive;
            seen += 1;
            let one = match surface {
                Surface::Ball(ball) if own => Some(on_ball(ball, around, weight)),
                Surface::Tube(tube) if own => Some(on_tube(tube, around, weight)),
                Surface::Ball(_) | Surface::Tube(_) | Surface::Dish(_) => {
                    bent = true;
                    return counts(index, true) || counts(index, false);
                }
                Surface::Parallelogram(_) | Surface::Triangle(_) | Surface::Disk(_) => {
                    let normal = surface.normal(around.position);
                    let cosine = normal.dot(around.normal);
                    let front = cosine >= around.least_cosine && counts(index, true);
                    let back = -cosine >= around.least_cosine && counts(index, false);
                    let counts = own || front || back;
                    let corners = outline(surface).unwrap_or_default();
                    faces.push(Face { corners, normal, counts });
                    if !own && self.lies_in_own(surface, around) {
                        None
                    } else if counts {
                        on_flat(surface, normal, around, weight)
                    } else {
                        Some(Inside::NOTHING)
                    }
                }
            };
            seen > MOST_SURFACES || one.inspect(|one| sum.add(one)).is_none()
        });
        if unknown {
            return None;
        }
        // On a curved surface nothing else may be near.
        let tolerance = SAME_PLANE * around.radius;
        let plane = Around { centre: around.position, normal: around.normal, radius: around.radius, tolerance };
        sum.open = !bent && (seen == 1 || faces.len() == seen && plane.lies_open(&faces));
        Some(sum)
    }

    /// True if a flat surface overlaps the one on which the centre lies, in one plane: no side of either parts them.
    fn lies_in_own(&self, other: &Surface, around: &Neighbourhood) -> bool {
        let own = &self.primitives[around.primitive as usize].surface;
        let (Some(here), Some(there)) = (outline(own), outline(other)) else { return false };
        let tolerance = SAME_PLANE * around.radius;
        let normal = own.normal(around.position);
        there.iter().all(|corner| (*corner - around.position).dot(normal).abs() <= tolerance)
            && !parts(&here, &there, normal, tolerance)
            && !parts(&there, &here, normal, tolerance)
    }
}

/// The corners of a flat surface, or of what is around it.
fn outline(surface: &Surface) -> Option<Vec<DVec3>> {
    let of = |face: &Parallelogram| {
        let (c, u, v) = (face.centre, face.edge_u, face.edge_v);
        vec![c - u - v, c + u - v, c + u + v, c - u + v]
    };
    match surface {
        Surface::Parallelogram(face) => Some(of(face)),
        Surface::Disk(disk) => Some(of(&disk.around)),
        Surface::Triangle(face) => Some(face.corners.to_vec()),
        Surface::Ball(_) | Surface::Tube(_) | Surface::Dish(_) => None,
    }
}

/// True if one side of the first outline has all of the second beyond it.
fn parts(first: &[DVec3], second: &[DVec3], normal: DVec3, tolerance: f64) -> bool {
    (0..first.len()).any(|i| {
        let (from, to, inside) = (first[i], first[(i + 1) % first.len()], first[(i + 2) % first.len()]);
        let across = (to - from).cross(normal).normalize_or_zero();
        let outwards = if (inside - from).dot(across) > 0.0 { -across } else { across };
        second.iter().all(|corner| (*corner - from).dot(outwards) >= -tolerance)
    })
}

/// `None` for an ellipse.
fn on_flat(surface: &Surface, normal: DVec3, around: &Neighbourhood, weight: &impl RadialWeight) -> Option<Inside> {
    let scaled = |corner: DVec3| (corner - around.position) / around.radius;
    match surface {
        Surface::Parallelogram(_) | Surface::Triangle(_) => {
            let corners: Vec<DVec3> = outline(surface)?.into_iter().map(scaled).collect();
            Some(in_polygon(&corners, normal, weight))
        }
        Surface::Disk(disk) => {
            disk.circle_radius().map(|rim| in_circle(disk, rim / around.radius, scaled(disk.around.centre), weight))
        }
        Surface::Ball(_) | Surface::Tube(_) | Surface::Dish(_) => None,
    }
}

/// Integrals over the part of a plane inside the unit ball, gathered along its boundary by the theorems of Green and Gauss:
/// with `M` the weight's mass, y the offset from the plane's foot and n the outward normal of the boundary, the area is the
/// integral of (M - M(foot)) / (2 y^2) y.n ds, and since the weight times y is the gradient of (M - M(1)) / 2, which
/// vanishes where the ball ends, so are the other moments. Of the ball's own circle only the angle is needed.
struct Boundary<'w, W> {
    weight: &'w W,
    /// Squared distance of the plane.
    t_foot: f64,
    area: f64,
    trace: f64,
    first: DVec2,
    /// The integral of y times the potential times n: xx, yy, xy.
    outer: [f64; 3],
}

impl<'w, W: RadialWeight> Boundary<'w, W> {
    fn new(weight: &'w W, t_foot: f64) -> Self {
        Self { weight, t_foot, area: 0.0, trace: 0.0, first: DVec2::ZERO, outer: [0.0; 3] }
    }

    /// Adds a piece of the surface's own edge at `y`, `n` being its normal times its length.
    fn edge(&mut self, y: DVec2, n: DVec2) {
        let d2 = y.length_squared();
        let t = self.t_foot + d2;
        let turn = y.dot(n);
        if d2 > AT_THE_FOOT * AT_THE_FOOT {
            self.sector(t, 0.5 * turn / d2);
        } else {
            self.area += 0.5 * turn * self.weight.weight(self.t_foot);
        }
        let potential = 0.5 * (self.weight.mass(t.min(1.0)) - self.weight.mass(1.0));
        self.first += potential * n;
        self.outer[0] += potential * y.x * n.x;
        self.outer[1] += potential * y.y * n.y;
        self.outer[2] += potential * y.x * n.y;
    }

    /// Adds an angle of the ball's circle, seen from the foot.
    fn arc(&mut self, angle: f64) {
        self.sector(1.0, 0.5 * angle);
    }

    /// Adds a sector from the foot out to `t`, by half its angle.
    fn sector(&mut self, t: f64, half_angle: f64) {
        let mass = self.weight.mass(t.min(1.0)) - self.weight.mass(self.t_foot);
        let second = self.weight.second(t.min(1.0)) - self.weight.second(self.t_foot);
        self.area += half_angle * mass;
        self.trace += half_angle * (second - self.t_foot * mass);
    }

    /// The integrals in space, for the foot and two axes of the plane.
    fn in_space(&self, foot: DVec3, [a, b]: [DVec3; 2]) -> Inside {
        let spread = 0.5 * (self.outer[0] + self.outer[1] - self.trace);
        let [xx, yy, xy] = [self.outer[0] - spread, self.outer[1] - spread, self.outer[2]];
        let along = self.first.x * a + self.first.y * b;
        let dyad = |p: DVec3, q: DVec3| DMat3::from_cols(p * q.x, p * q.y, p * q.z);
        let plane = dyad(a, a) * xx + dyad(b, b) * yy + (dyad(a, b) + dyad(b, a)) * xy;
        let second = dyad(foot, foot) * self.area + dyad(foot, along) + dyad(along, foot) + plane;
        Inside { area: self.area / PI, first: (foot * self.area + along) / PI, second: second * (1.0 / PI), open: true }
    }
}

fn in_polygon<W: RadialWeight>(corners: &[DVec3], normal: DVec3, weight: &W) -> Inside {
    let height = corners[0].dot(normal);
    let reach2 = 1.0 - height * height;
    if reach2 <= 0.0 {
        return Inside::NOTHING;
    }
    let (a, b) = normal.any_orthonormal_pair();
    let flat: Vec<DVec2> = corners.iter().map(|corner| DVec2::new(corner.dot(a), corner.dot(b))).collect();
    let next = |i: usize| flat[(i + 1) % flat.len()];
    let twice_area: f64 = (0..flat.len()).map(|i| (flat[i] - flat[0]).perp_dot(next(i) - flat[0])).sum();
    let mut boundary = Boundary::new(weight, height * height);
    for i in 0..flat.len() {
        // Counter-clockwise, whichever way the corners run.
        let (from, to) = if twice_area > 0.0 { (flat[i], next(i)) } else { (next(i), flat[i]) };
        side(from, to, reach2, &mut boundary);
    }
    boundary.in_space(height * normal, [a, b])
}

/// One side of a polygon: what of it is inside the circle, and the angles of what is not.
fn side<W: RadialWeight>(from: DVec2, to: DVec2, reach2: f64, boundary: &mut Boundary<'_, W>) {
    let angle = |p: DVec2, q: DVec2| p.perp_dot(q).atan2(p.dot(q));
    let Some(along) = (to - from).try_normalize() else { return };
    let outwards = DVec2::new(along.y, -along.x);
    let distance = from.dot(outwards);
    let at = |x: f64| distance * outwards + x * along;
    let half_chord2 = reach2 - distance * distance;
    let half_chord = half_chord2.max(0.0).sqrt();
    let (low, high) = (from.dot(along).max(-half_chord), to.dot(along).min(half_chord));
    if half_chord2 <= 0.0 || low >= high {
        return boundary.arc(angle(from, to));
    }
    if low > from.dot(along) {
        boundary.arc(angle(from, at(low)));
    }
    if high < to.dot(along) {
        boundary.arc(angle(at(high), to));
    }
    // Weights may have a kink where the distance is least.
    let middle = 0.0f64.clamp(low, high);
    for (low, high) in [(low, middle), (middle, high)] {
        quadrature(low, high, |x, length| boundary.edge(at(x), length * outwards));
    }
}

fn in_circle<W: RadialWeight>(disk: &Disk, rim: f64, centre: DVec3, weight: &W) -> Inside {
    let normal = disk.around.normal;
    let height = centre.dot(normal);
    let reach2 = 1.0 - height * height;
    if reach2 <= 0.0 {
        return Inside::NOTHING;
    }
    let (a, b) = normal.any_orthonormal_pair();
    let centre = DVec2::new(centre.dot(a), centre.dot(b));
    let distance = centre.length();
    let mut boundary = Boundary::new(weight, height * height);
    // The rim is inside where the cosine of its azimuth, from the line beyond the centre, is at most this.
    let cosine = (reach2 - distance * distance - rim * rim) / (2.0 * distance * rim);
    let on_rim = |azimuth: f64| centre + rim * DVec2::from_angle(azimuth);
    if cosine > -1.0 {
        let nearest = (-centre).to_angle();
        let half = if cosine >= 1.0 { PI } else { PI - cosine.acos() };
        let pieces = (half / FRAC_PI_8).ceil();
        for piece in 0..pieces as u32 {
            let between = [f64::from(piece), f64::from(piece + 1)].map(|i| half * i / pieces);
            for side in [-1.0, 1.0] {
                quadrature(between[0], between[1], |offset, width| {
                    let azimuth = nearest + side * offset;
                    boundary.edge(on_rim(azimuth), width * rim * DVec2::from_angle(azimuth));
                });
            }
        }
        if cosine < 1.0 {
            let [enters, leaves] = [-half, half].map(|offset| on_rim(nearest + offset).to_angle());
            boundary.arc((enters - leaves).rem_euclid(TAU));
        }
    } else if distance < rim {
        boundary.arc(TAU);
    }
    boundary.in_space(height * normal, [a, b])
}

/// Of the sphere the ball cuts a cap on which the area within a chord is that of the flat disc (Archimedes); the test of
/// normals ends it where the chord's angle does.
fn on_ball(ball: &Ball, around: &Neighbourhood, weight: &impl RadialWeight) -> Inside {
    let curvature2 = (around.radius / ball.radius).powi(2);
    let reach = (2.0 * (1.0 - around.least_cosine) / curvature2).min(1.0);
    let mut across = 0.0;
    quadrature(0.0, reach, |t, width| across += width * weight.weight(t) * t * (1.0 - 0.25 * curvature2 * t));
    let n = around.normal;
    let tangent = DMat3::IDENTITY - DMat3::from_cols(n * n.x, n * n.y, n * n.z);
    Inside { area: weight.mass(reach), first: DVec3::ZERO, second: tangent * (0.5 * across), open: true }
}

/// Of a cylinder's wall, strip by strip along the axis; strips are told by the chord across, the sine of an angle.
fn on_tube(tube: &Tube, around: &Neighbourhood, weight: &impl RadialWeight) -> Inside {
    let (radius, z) = (tube.radius / around.radius, tube.frame.local(around.position).z);
    let ends = [-z / around.radius, (tube.length - z) / around.radius];
    let axis = tube.frame.axes * DVec3::Z;
    let across = axis.cross(around.normal);
    let widest = (radius * (2.0 * (1.0 - around.least_cosine)).sqrt()).min(1.0);
    // Strips change their kind where the ball leaves an end of the wall.
    let mut kinks = ends.map(|end| (1.0 - end * end).max(0.0).sqrt().min(widest).asin());
    kinks.sort_by(f64::total_cmp);
    let mut sums = [0.0; 4];
    for (low, high) in [(0.0, kinks[0]), (kinks[0], kinks[1]), (kinks[1], widest.asin())] {
        for half in [(low, 0.5 * (low + high)), (0.5 * (low + high), high)] {
            quadrature(half.0, half.1, |angle, width| {
                let (chord, longest) = angle.sin_cos();
                let slant = (1.0 - (0.5 * chord / radius).powi(2)).sqrt();
                let strip = 2.0 * width * longest / (slant * PI);
                for (low, high) in [(ends[0].max(-longest), 0.0), (0.0, ends[1].min(longest))] {
                    quadrature(low, high, |z, length| {
                        let one = strip * length * weight.weight((chord * chord + z * z).min(1.0));
                        let sideways = chord * slant;
                        let moments = [one, one * z, one * z * z, one * sideways * sideways];
                        sums.iter_mut().zip(moments).for_each(|(sum, moment)| *sum += moment);
                    });
                }
            });
        }
    }
    let dyad = |p: DVec3| DMat3::from_cols(p * p.x, p * p.y, p * p.z);
    Inside { area: sums[0], first: axis * sums[1], second: dyad(axis) * sums[2] + dyad(across) * sums[3], open: true }
}

/// Offers the rule's points of an interval with their widths.
fn quadrature(low: f64, high: f64, mut at: impl FnMut(f64, f64)) {
    if low >= high {
        return;
    }
    let (middle, half) = (0.5 * (low + high), 0.5 * (high - low));
    GAUSS.iter().for_each(|(node, weight)| at(middle + half * node, half * weight));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{frame::Frame, triangle::Triangle};

    struct Disc;
    impl RadialWeight for Disc {
        fn weight(&self, _: f64) -> f64 {
            1.0
        }
        fn mass(&self, t: f64) -> f64 {
            t
        }
        fn second(&self, t: f64) -> f64 {
            0.5 * t * t
        }
    }

    /// 3 (1 - sqrt t), which is no polynomial.
    struct Cone;
    impl RadialWeight for Cone {
        fn weight(&self, t: f64) -> f64 {
            3.0 * (1.0 - t.sqrt())
        }
        fn mass(&self, t: f64) -> f64 {
            3.0 * t - 2.0 * t * t.sqrt()
        }
        fn second(&self, t: f64) -> f64 {
            1.5 * t * t - 1.2 * t * t * t.sqrt()
        }
    }

    /// Points of a surface even by area, each tested.
    fn thrown(surface: &Surface, around: &Neighbourhood, weight: &impl RadialWeight) -> Inside {
        let n = 1500;
        let each = surface.area() / (PI * around.radius * around.radius * f64::from(n * n));
        let even = |i: u32| (f64::from(i) + 0.5) / f64::from(n);
        let mut sum = Inside::NOTHING;
        for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
            let point = surface.point_by_area([even(i), even(j)]);
            let x = (point - around.position) / around.radius;
            if x.length_squared() <= 1.0 && surface.normal(point).dot(around.normal) >= around.least_cosine {
                let w = each * weight.weight(x.length_squared());
                sum.add(&Inside {
                    area: w,
                    first: w * x,
                    second: DMat3::from_cols(x * x.x, x * x.y, x * x.z) * w,
                    open: true,
                });
            }
        }
        sum
    }

    /// Along two axes across the normal, which is what an estimate uses.
    fn must_agree(what: &str, got: &Inside, thrown: &Inside, normal: DVec3) {
        let (a, b) = normal.any_orthonormal_pair();
        let parts = |inside: &Inside| {
            let second = [a, b].map(|axis| inside.second * axis);
            [
                inside.area,
                inside.first.dot(a),
                inside.first.dot(b),
                a.dot(second[0]),
                b.dot(second[0]),
                b.dot(second[1]),
            ]
        };
        for (index, (got, thrown)) in parts(got).into_iter().zip(parts(thrown)).enumerate() {
            assert!((got - thrown).abs() < 1e-3, "{what}, moment {index}: {got}, by points {thrown}");
        }
    }

    fn check(what: &str, surface: &Surface, position: DVec3, normal: DVec3, radius: f64) {
        let around = Neighbourhood { position, primitive: 0, normal, radius, least_cosine: 0.5 };
        let of = |surface: &Surface, around: &Neighbourhood| match surface {
            Surface::Ball(ball) => [Some(on_ball(ball, around, &Disc)), Some(on_ball(ball, around, &Cone))],
            Surface::Tube(tube) => [Some(on_tube(tube, around, &Disc)), Some(on_tube(tube, around, &Cone))],
            flat => [on_flat(flat, normal, around, &Disc), on_flat(flat, normal, around, &Cone)],
        };
        let [disc, cone] = of(surface, &around);
        must_agree(&format!("{what}, disc"), &disc.expect("known"), &thrown(surface, &around, &Disc), normal);
        must_agree(&format!("{what}, cone"), &cone.expect("known"), &thrown(surface, &around, &Cone), normal);
    }

    #[test]
    fn flat_faces_agree_with_points_thrown_on_them() {
        let (u, v) = (DVec3::new(0.9, 0.3, -0.2), DVec3::new(-0.1, 0.7, 0.4));
        let face = Parallelogram::new(DVec3::new(0.2, -0.5, 1.0), u, v, u.cross(v));
        let n = face.normal;
        let surface = Surface::Parallelogram(face);
        // In the middle, on an edge, in a corner, near both, and with all of it inside.
        for (uv, radius) in
            [([0.5, 0.5], 0.3), ([0.0, 0.4], 0.5), ([1.0, 1.0], 0.6), ([0.1, 0.2], 0.5), ([0.6, 0.3], 3.0)]
        {
            check(&format!("{uv:?}"), &surface, face.point(DVec2::from(uv)), n, radius);
        }
        // Off the plane, above the face and beside it.
        for uv in [[0.3, 0.8], [1.2, 0.5]] {
            check(&format!("above {uv:?}"), &surface, face.point(DVec2::from(uv)) + 0.2 * n, n, 0.6);
        }
        let corners = [DVec3::new(0.1, 0.2, 0.3), DVec3::new(1.4, 0.1, 0.2), DVec3::new(0.6, 1.1, 0.9)];
        for turned in [corners, [corners[0], corners[2], corners[1]]] {
            let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalize();
            let face = Surface::Triangle(Triangle { corners: turned, normal, edges: [true; 3] });
            check("triangle", &face, (corners[0] + 2.0 * corners[1] + corners[2]) / 4.0, normal, 0.5);
        }
    }

    #[test]
    fn faces_that_share_a_side_are_apart_and_others_overlap() {
        let square = |x: f64, y: f64| {
            [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(|[u, v]| DVec3::new(x + u, y + v, 0.0))
        };
        let apart = |a: &[DVec3], b: &[DVec3]| parts(a, b, DVec3::Z, 1e-9) || parts(b, a, DVec3::Z, 1e-9);
        assert!(apart(&square(0.0, 0.0), &square(1.0, 0.3)) && apart(&square(0.0, 0.0), &square(0.2, -1.0)));
        assert!(!apart(&square(0.0, 0.0), &square(0.9, 0.3)) && !apart(&square(0.0, 0.0), &square(0.0, 0.0)));
        let mut turned = square(1.0, 0.0);
        turned.reverse();
        assert!(apart(&square(0.0, 0.0), &turned));
    }

    #[test]
    fn circles_agree_with_points_thrown_on_them() {
        let (u, v) = (DVec3::new(0.6, 0.0, 0.8), DVec3::Y);
        let disk = Disk::new(DVec3::new(0.3, 0.1, -0.2), u, v, u.cross(v));
        let (surface, n) = (Surface::Disk(disk), disk.around.normal);
        for (uv, radius) in
            [([0.0, 0.0], 0.4), ([1.0, 0.3], 0.7), ([0.8, 0.6], 0.5), ([0.5, 0.9], 1.2), ([0.2, 0.1], 4.0)]
        {
            check(&format!("{uv:?}"), &surface, disk.point(DVec2::from(uv)), n, radius);
        }
        check("above", &surface, disk.point(DVec2::new(0.9, 0.2)) + 0.2 * n, n, 0.5);
    }

    #[test]
    fn spheres_and_cylinders_agree_with_points_thrown_on_them() {
        let ball = Ball { centre: DVec3::X, radius: 0.8, axes: glam::DMat3::IDENTITY, inwards: true };
        let at = ball.point(0.3, 0.2);
        for radius in [0.3, 0.8, 1.1] {
            check("ball", &Surface::Ball(ball), at, ball.normal(at), radius);
        }
        let frame = Frame { origin: DVec3::Z, axes: DMat3::from_rotation_x(0.7) };
        let tube = Tube { frame, radius: 0.5, length: 1.0, inwards: false };
        for (uv, radius) in [([0.2, 0.5], 0.3), ([0.7, 0.0], 0.4), ([0.9, 0.3], 0.5), ([0.1, 0.6], 0.9)] {
            let at = tube.point(DVec2::from(uv));
            check(&format!("tube {uv:?}"), &Surface::Tube(tube), at, tube.normal(at), radius);
        }
    }
}
