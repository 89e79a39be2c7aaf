//! Two plano-convex lenses that gather the light of a lamp on their axis onto a disc.
//!
//! By symmetry every ray from the axis stays in a plane through it, so the whole condenser is a drawing: circles, flat faces
//! and rims as lines, at each of which a ray splits into its reflected and refracted part by Snell and Fresnel (unpolarised
//! anew each time). All parts down to 1e-7 of a ray are followed, ghosts included. (Law of refraction; Born and Wolf, section
//! 1.5.) Summed over 100 000 rays even in the flux of the lamp; precision 1e-4 of the gathered flux.

use crate::scattering::fresnel;

/// A lens around the axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lens {
    /// Place of the first vertex on the axis (m).
    pub vertex: f64,
    /// Curvatures of both faces (1/m), positive if the centre lies towards +z.
    pub curvatures: [f64; 2],
    /// Thickness at the axis (m).
    pub thickness: f64,
    /// Radius of the cylindrical rim (m).
    pub rim: f64,
}

/// A lamp in the origin that shines by the cosine towards +z, two lenses, and a black disc before a larger one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Condenser {
    /// The lenses.
    pub lenses: [Lens; 2],
    /// Their refractive index.
    pub index: f64,
    /// Height and radius of the two discs (m), the nearer one first.
    pub discs: [[f64; 2]; 2],
    /// Flux of the lamp (W or lm).
    pub flux: f64,
}

/// A point or a direction in the drawing: along the axis, and away from it with a sign.
type Flat = [f64; 2];

/// A ray on its way.
#[derive(Clone, Copy)]
struct Part {
    at: Flat,
    along: Flat,
    inside: bool,
    share: f64,
}

/// What a ray meets.
enum Met {
    Glass { normal: Flat },
    Disc(usize),
}

impl Condenser {
    /// `condenser.xml`.
    pub const SCENE: Condenser = Condenser {
        lenses: [
            Lens { vertex: 0.07, curvatures: [0.0, -25.0], thickness: 0.015, rim: 0.03 },
            Lens { vertex: 0.1, curvatures: [25.0, 0.0], thickness: 0.015, rim: 0.03 },
        ],
        index: 1.5,
        discs: [[0.185, 0.005], [0.186, 0.03]],
        flux: 1000.0,
    };

    /// Flux on the front of the near disc, and of the far one beside it, in W or lm.
    pub fn gathered(&self) -> [f64; 2] {
        const RAYS: u32 = 100_000;
        let mut sums = [0.0; 2];
        for ray in 0..RAYS {
            let sine = ((f64::from(ray) + 0.5) / f64::from(RAYS)).sqrt();
            let along = [(1.0 - sine * sine).sqrt(), sine];
            self.follow(Part { at: [0.0; 2], along, inside: false, share: self.flux / f64::from(RAYS) }, &mut sums);
        }
        sums
    }

    fn follow(&self, mut part: Part, sums: &mut [f64; 2]) {
        let least = 1e-7 * part.share;
        let mut waiting = Vec::new();
        loop {
            let met = self.meets(&part);
            match met {
                Some((_, Met::Disc(disc))) if part.along[0] > 0.0 => sums[disc] += part.share,
                Some((at, Met::Glass { normal })) => {
                    let [reflected, refracted] = self.split(&part, at, normal);
                    waiting.extend([reflected, refracted].into_iter().flatten().filter(|p| p.share > least));
                }
                Some((_, Met::Disc(_))) | None => {}
            }
            let Some(next) = waiting.pop() else { return };
            part = next;
        }
    }

    /// The nearest thing on the ray, and where.
    fn meets(&self, part: &Part) -> Option<(Flat, Met)> {
        let ([z, x], [dz, dx]) = (part.at, part.along);
        let mut nearest: Option<(f64, Met)> = None;
        let mut meet = |t: f64, met: Met| {
            if t > 1e-9 && nearest.as_ref().is_none_or(|(best, _)| t < *best) {
                nearest = Some((t, met));
            }
        };
        for lens in &self.lenses {
            for (face, c) in lens.curvatures.into_iter().enumerate() {
                // c (x^2 + z^2) = 2 z from the vertex.
                let from = [z - lens.vertex - face as f64 * lens.thickness, x];
                let (b, q) = (c * dot(from, part.along) - dz, c * dot(from, from) - 2.0 * from[0]);
                let root = (b * b - c * q).max(0.0).sqrt();
                let hits = if c == 0.0 { [-0.5 * q / b; 2] } else { [(-b - root) / c, (-b + root) / c] };
                for t in hits.into_iter().filter(|_| b * b > c * q) {
                    let on = [from[0] + t * dz, from[1] + t * dx];
                    if on[1].abs() < lens.rim && c * on[0] < 1.0 {
                        meet(t, Met::Glass { normal: [c * on[0] - 1.0, c * on[1]] });
                    }
                }
            }
            let sag = |c: f64| c * lens.rim * lens.rim / (1.0 + (1.0 - (c * lens.rim).powi(2)).sqrt());
            let [first, second] = lens.curvatures.map(sag);
            for side in [-1.0, 1.0] {
                let t = (side * lens.rim - x) / dx;
                let on = z + t * dz - lens.vertex;
                if first < on && on < lens.thickness + second {
                    meet(t, Met::Glass { normal: [0.0, 1.0] });
                }
            }
        }
        for (disc, [height, radius]) in self.discs.into_iter().enumerate() {
            let t = (height - z) / dz;
            if (x + t * dx).abs() < radius {
                meet(t, Met::Disc(disc));
            }
        }
        nearest.map(|(t, met)| ([z + t * dz, x + t * dx], met))
    }

    /// The reflected part, and the refracted one unless reflection is total.
    fn split(&self, part: &Part, at: Flat, normal: Flat) -> [Option<Part>; 2] {
        let towards = -dot(part.along, normal);
        let scale = towards.signum() / dot(normal, normal).sqrt();
        let (normal, cosine) = (normal.map(|x| scale * x), scale * towards);
        let relative = if part.inside { 1.0 / self.index } else { self.index };
        let reflected = fresnel::unpolarised(cosine, relative);
        let turned = |a: f64, b: f64| [0, 1].map(|i| a * part.along[i] + b * normal[i]);
        let mirrored = Part { at, along: turned(1.0, 2.0 * cosine), share: part.share * reflected, ..*part };
        let beyond = 1.0 - (1.0 - cosine * cosine) / (relative * relative);
        let refracted = (beyond > 0.0).then(|| Part {
            at,
            along: turned(1.0 / relative, cosine / relative - beyond.sqrt()),
            inside: !part.inside,
            share: part.share * (1.0 - reflected),
        });
        [Some(mirrored), refracted]
    }
}

fn dot(a: Flat, b: Flat) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::{Moments, Random};
    use crate::vector::{self, Vector, unit};

    /// Rays in space by spheres, planes and a cylinder, with random choice between reflection and refraction: 2 comparisons
    /// at 4.5 standard errors.
    #[test]
    fn rays_in_space_agree() {
        let (condenser, mut random) = (Condenser::SCENE, Random::new(85));
        let mut found: [Moments; 2] = Default::default();
        for _ in 0..400_000 {
            let disc = ends(&condenser, random.cosine_around([0.0, 0.0, 1.0]), &mut random);
            (0..2).for_each(|i| found[i].add(if disc == Some(i) { condenser.flux } else { 0.0 }));
        }
        for (moments, flux) in found.iter().zip(condenser.gathered()) {
            moments.must_agree("flux on a disc", flux);
        }
    }

    /// A plane plate of thickness `t` brings the lamp `t (1 - 1 / n)` nearer and lets `(1 - R) / (1 + R)` through, near enough up
    /// to 0.1 radians.
    #[test]
    fn a_plate_lets_through_what_it_must() {
        let plate = Lens { vertex: 1.0, curvatures: [0.0; 2], thickness: 0.03, rim: 0.5 };
        let away = Lens { vertex: 10.0, ..plate };
        let one = Condenser { lenses: [plate, away], discs: [[1.1, 0.1], [9.0, 1e-6]], ..Condenser::SCENE };
        let sine2 = 0.01 / (0.01 + 1.09f64.powi(2));
        let want = one.flux * sine2 * 0.96 / 1.04;
        assert!((one.gathered()[0] / want - 1.0).abs() < 2e-3, "{} {want}", one.gathered()[0]);
    }

    /// The disc on which a ray from the lamp ends.
    fn ends(condenser: &Condenser, mut d: Vector, random: &mut Random) -> Option<usize> {
        let (mut p, mut inside) = ([0.0; 3], false);
        loop {
            let mut best = (f64::INFINITY, None);
            let on = |t: f64| vector::along(p, t, d);
            for lens in &condenser.lenses {
                for (face, c) in lens.curvatures.into_iter().enumerate() {
                    let vertex = lens.vertex + face as f64 * lens.thickness;
                    let (centre, radius) = ([0.0, 0.0, vertex + 1.0 / c], 1.0 / c);
                    let hits = if c == 0.0 {
                        vec![(vertex - p[2]) / d[2]]
                    } else {
                        let from = vector::along(p, -1.0, centre);
                        let (b, q) = (vector::dot(from, d), vector::dot(from, from) - radius * radius);
                        let root = (b * b - q).sqrt();
                        vec![-b - root, -b + root]
                    };
                    for t in hits {
                        let q = on(t);
                        let near = (q[2] - vertex).abs() < 0.5 / c.abs().max(1e-9);
                        if t > 1e-9 && t < best.0 && near && q[0].hypot(q[1]) < lens.rim {
                            let normal = if c == 0.0 { [0.0, 0.0, 1.0] } else { unit(vector::along(q, -1.0, centre)) };
                            best = (t, Some(normal));
                        }
                    }
                }
                let (a, b) = (d[0] * d[0] + d[1] * d[1], p[0] * d[0] + p[1] * d[1]);
                let root = (b * b - a * (p[0] * p[0] + p[1] * p[1] - lens.rim * lens.rim)).sqrt();
                for t in [(-b - root) / a, (-b + root) / a] {
                    let height = |face: usize| {
                        let c = lens.curvatures[face];
                        let bulge = if c == 0.0 { 0.0 } else { (1.0 - (1.0 - (c * lens.rim).powi(2)).sqrt()) / c };
                        lens.vertex + face as f64 * lens.thickness + bulge
                    };
                    if t > 1e-9 && t < best.0 && (height(0)..height(1)).contains(&on(t)[2]) {
                        best = (t, Some(unit([on(t)[0], on(t)[1], 0.0])));
                    }
                }
            }
            for (disc, [height, radius]) in condenser.discs.into_iter().enumerate() {
                let t = (height - p[2]) / d[2];
                let q = on(t);
                if t > 1e-9 && t < best.0 && q[0].hypot(q[1]) < radius {
                    return (d[2] > 0.0).then_some(disc);
                }
            }
            let (t, normal) = best;
            let normal = normal?;
            p = on(t);
            let facing = if vector::dot(d, normal) < 0.0 { normal } else { normal.map(|x| -x) };
            let (eta, cosine) = (if inside { condenser.index } else { 1.0 / condenser.index }, -vector::dot(d, facing));
            if random.unit() < fresnel::unpolarised(cosine, 1.0 / eta) {
                d = unit(vector::along(d, 2.0 * cosine, facing));
            } else {
                let far = (1.0 - eta * eta * (1.0 - cosine * cosine)).sqrt();
                d = unit(vector::along(d.map(|x| eta * x), eta * cosine - far, facing));
                inside = !inside;
            }
        }
    }
}
