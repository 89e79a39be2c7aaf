//! Draws of directions against their densities and against independent laws (catalogue section G, F5, E1): rough
//! surfaces of both kinds from normal to grazing incidence, both sides of glass, coats, sheets, phase functions.

use std::f64::consts::{PI, TAU};

use glam::DVec3;
use photonlab_measure::Replicates;
use photonlab_photometry::Colour;
use photonlab_reference::{
    medium::phase::HenyeyGreenstein,
    pane::{Pane, Polarisation},
    scattering::{
        fresnel,
        ggx::{Shadowing, directional_albedo},
        rough_dielectric,
    },
};
use photonlab_sampling::{
    FacetMaterial, Facets, Matte, Purpose, Rough, Specular, Stream, phase_pdf_solid_angle, scatter, warp,
};
use photonlab_scene::{Hit, Microfacets, Normals, Phase, Ray, Roughness, SurfacePoint, World, read::read_scene_str};
use photonlab_tests::{Family, seed};

/// Draws of one chi-square test, and of the set that lays its cells.
const DRAWS: usize = 20_000;
/// Cells along the cosine on each side of the surface, and around the normal.
const RINGS: usize = 10;
const TURNS: usize = 8;
/// Where the parts of a cell end over which its density is integrated.
const EDGES: [f64; 7] = [0.0, 0.001, 0.03, 0.5, 0.97, 0.999, 1.0];

const KINDS: [Microfacets; 2] = [Microfacets::Ggx, Microfacets::Beckmann];
const ALPHAS: [f64; 4] = [0.01, 0.1, 0.4, 1.0];
/// Angles of incidence, degrees.
const ANGLES: [f64; 5] = [0.0, 30.0, 60.0, 80.0, 89.0];
/// Crown glass from the air and from inside.
const INDICES: [f64; 2] = [1.5, 1.0 / 1.5];

fn stream(own: u32) -> Stream {
    Stream::new(seed(own), Purpose::Synthetic, 0, 0)
}

fn towards(degrees: f64) -> DVec3 {
    let (sin, cos) = degrees.to_radians().sin_cos();
    DVec3::new(sin, 0.0, cos)
}

fn rough(facets: Microfacets, alpha: f64, material: FacetMaterial<1>) -> Rough<1> {
    Rough { facets: Facets::new(Roughness { facets, alpha }), material }
}

fn mirror() -> FacetMaterial<1> {
    // Of index zero all is reflected at any angle.
    FacetMaterial::Conductor { eta: Colour::ZERO, k: Colour::ONE, reflectance: Colour::ONE }
}

fn glass(relative_index: f64) -> FacetMaterial<1> {
    FacetMaterial::Dielectric { relative_index, reflectance: Colour::ONE, transmittance: Colour::ONE }
}

fn draw(rough: &Rough<1>, w: DVec3, stream: &mut Stream) -> Option<(DVec3, f64)> {
    let xi = [stream.next(), stream.next(), stream.next()];
    rough.draw(w, xi).map(|draw| (draw.v, draw.share[0]))
}

/// Cells of directions: rings of the cosine on each side of z = 0 times sectors, cut where draws of their own lie.
struct Cells {
    rings: Vec<f64>,
    turns: Vec<f64>,
}

impl Cells {
    fn of(draws: &[DVec3]) -> Self {
        let cut = |mut along: Vec<f64>, parts: usize, ends: [f64; 2]| -> Vec<f64> {
            along.sort_by(f64::total_cmp);
            // Of few draws each is a cut: they lie where the lobe is.
            let parts = parts.min(along.len());
            let inner = (1..parts).map(|i| along[i * along.len() / parts]);
            let mut cuts: Vec<f64> = std::iter::once(ends[0]).chain(inner).chain([ends[1]]).collect();
            cuts.dedup();
            cuts
        };
        let side = |up: bool| draws.iter().filter(|v| (v.z > 0.0) == up).map(|v| v.z).collect();
        let mut rings = cut(side(false), RINGS, [-1.0, 0.0]);
        rings.extend(&cut(side(true), RINGS, [0.0, 1.0])[1..]);
        let turns = cut(draws.iter().map(|v| v.y.atan2(v.x)).collect(), TURNS, [-PI, PI]);
        Self { rings, turns }
    }

    fn count(&self) -> usize {
        (self.rings.len() - 1) * (self.turns.len() - 1)
    }

    fn place(&self, v: DVec3) -> usize {
        let among = |cuts: &[f64], x: f64| cuts[1..cuts.len() - 1].partition_point(|&cut| cut <= x);
        among(&self.rings, v.z) * (self.turns.len() - 1) + among(&self.turns, v.y.atan2(v.x))
    }

    /// The integral of a density over each cell: in parts that crowd to its edges, where draws were that it is cut at, each
    /// halved until halves agree with the whole.
    fn integrals(&self, pdf: &impl Fn(DVec3) -> f64) -> Vec<f64> {
        let parts = |[a, b]: [f64; 2]| {
            let at = move |share: f64| a + share * (b - a);
            EDGES.windows(2).map(move |pair| [at(pair[0]), at(pair[1])])
        };
        let over = |z: [f64; 2], turn: [f64; 2]| -> f64 {
            let cells = parts(z).flat_map(|z| parts(turn).map(move |turn| (z, turn)));
            cells.map(|(z, turn)| integral(pdf, z, turn, gauss(pdf, z, turn), 20)).sum()
        };
        let cells =
            self.rings.windows(2).flat_map(|z| self.turns.windows(2).map(move |t| ([z[0], z[1]], [t[0], t[1]])));
        cells.map(|(z, turn)| over(z, turn)).collect()
    }
}

/// Gauss's rule of three by three points over a cell of cosine and turn.
fn gauss(pdf: &impl Fn(DVec3) -> f64, z: [f64; 2], turn: [f64; 2]) -> f64 {
    let rule = [(-0.6f64.sqrt(), 5.0 / 18.0), (0.0, 8.0 / 18.0), (0.6f64.sqrt(), 5.0 / 18.0)];
    let at = |[a, b]: [f64; 2], x: f64| 0.5 * (a + b) + 0.5 * (b - a) * x;
    let mut sum = 0.0;
    for (x, weight) in rule {
        let cos = at(z, x);
        let sin = (1.0 - cos * cos).max(0.0).sqrt();
        for (y, other) in rule {
            let (s, c) = at(turn, y).sin_cos();
            sum += weight * other * pdf(DVec3::new(sin * c, sin * s, cos));
        }
    }
    sum * (z[1] - z[0]) * (turn[1] - turn[0])
}

fn integral(pdf: &impl Fn(DVec3) -> f64, z: [f64; 2], turn: [f64; 2], whole: f64, depth: u32) -> f64 {
    let (zm, tm) = (0.5 * (z[0] + z[1]), 0.5 * (turn[0] + turn[1]));
    let parts = [
        ([z[0], zm], [turn[0], tm]),
        ([z[0], zm], [tm, turn[1]]),
        ([zm, z[1]], [turn[0], tm]),
        ([zm, z[1]], [tm, turn[1]]),
    ];
    let values = parts.map(|(z, turn)| gauss(pdf, z, turn));
    let sum: f64 = values.iter().sum();
    if depth == 0 || (sum - whole).abs() < 1e-8 + 1e-4 * sum.abs() {
        return sum;
    }
    parts.into_iter().zip(values).map(|((z, turn), value)| integral(pdf, z, turn, value, depth - 1)).sum()
}

/// Chi-square of draws against a density, those that are lost in a cell of their own.
fn judge(family: &mut Family, what: String, draw: &mut impl FnMut() -> Option<DVec3>, pdf: &impl Fn(DVec3) -> f64) {
    let layout: Vec<DVec3> = (0..DRAWS / 4).filter_map(|_| draw()).collect();
    let cells = Cells::of(&layout);
    let mut observed = vec![0; cells.count() + 1];
    for _ in 0..DRAWS {
        observed[draw().map_or(cells.count(), |v| cells.place(v))] += 1;
    }
    let mut expected: Vec<f64> = cells.integrals(pdf).iter().map(|p| p * DRAWS as f64).collect();
    let lost = DRAWS as f64 - expected.iter().sum::<f64>();
    // The density of what is kept integrates to at most one, up to the quadrature.
    assert!(lost > -1e-3 * DRAWS as f64, "{what}: the density integrates to {}", 1.0 - lost / DRAWS as f64);
    expected.push(lost.max(0.0));
    let total: f64 = expected.iter().sum();
    expected.iter_mut().for_each(|count| *count *= DRAWS as f64 / total);
    if lost.abs() < 1e-3 * DRAWS as f64 && observed[cells.count()] == 0 {
        observed.pop();
        expected.pop();
        let total: f64 = expected.iter().sum();
        expected.iter_mut().for_each(|count| *count *= DRAWS as f64 / total);
    }
    family.counts(what, &observed, &expected);
}

/// Every rough mirror and both sides of rough glass: where draws fall is their density, and radiance seen is density times
/// the share that is handed on.
#[test]
fn rough_surfaces_draw_by_their_density() {
    let mut family = Family::new("rough surfaces, densities");
    let mut stream = stream(900);
    for kind in KINDS {
        for alpha in ALPHAS {
            let [air, inside] = INDICES.map(|index| (format!("glass {index:.2}"), glass(index)));
            for (name, material) in [("mirror".to_string(), mirror()), air, inside] {
                let rough = rough(kind, alpha, material);
                for angle in ANGLES {
                    let w = towards(angle);
                    let what = format!("{kind:?} {alpha}, {name}, {angle} degrees");
                    judge(&mut family, what.clone(), &mut || draw(&rough, w, &mut stream).map(|d| d.0), &|v| {
                        rough.pdf_solid_angle(w, v)
                    });
                    for _ in 0..200 {
                        let xi = [stream.next(), stream.next(), stream.next()];
                        let Some(drawn) = rough.draw(w, xi) else { continue };
                        let seen = rough.eval(w, drawn.v)[0];
                        let by_draw = rough.pdf_solid_angle(w, drawn.v) * drawn.share[0] * drawn.compression;
                        assert!((seen - by_draw).abs() <= 1e-9 * by_draw, "{what}: {seen} seen, {by_draw} drawn");
                    }
                }
            }
        }
    }
    family.decide();
}

/// The shares that rough mirrors and rough glass send back and let through, against quadrature of independent formulae.
#[test]
fn rough_surfaces_hand_on_what_the_integrals_say() {
    let mut family = Family::new("rough surfaces, shares");
    let mut stream = stream(901);
    for alpha in [0.1, 0.4, 1.0] {
        for angle in [0.0, 30.0, 60.0, 80.0] {
            let w = towards(angle);
            let mut mean = |material, truth: f64, side: fn(f64) -> bool, what: &str| {
                let rough = rough(Microfacets::Ggx, alpha, material);
                let mut one =
                    || draw(&rough, w, &mut stream).map_or(0.0, |(v, share)| if side(v.z) { share } else { 0.0 });
                let blocks: Replicates = (0..200).map(|_| (0..500).map(|_| one()).sum::<f64>() / 500.0).collect();
                family.mean(format!("{what} alpha {alpha}, {angle} degrees"), &blocks, truth);
            };
            mean(mirror(), directional_albedo(w.z, alpha, Shadowing::Separable), |z| z > 0.0, "mirror");
            for index in INDICES {
                let shares = rough_dielectric::shares(w.z, alpha, index);
                mean(glass(index), shares.reflected, |z| z > 0.0, "reflected");
                mean(glass(index), shares.transmitted, |z| z < 0.0, "transmitted");
            }
        }
    }
    family.decide();
}

/// f(w, v) is symmetric on one side of a rough surface and, over the index squared, through it, for every kind and angle.
#[test]
fn rough_surfaces_are_reciprocal() {
    let mut stream = stream(902);
    let turned = |d: DVec3| DVec3::new(d.x, d.y, -d.z);
    let mut joined = [0; 2];
    for kind in KINDS {
        for alpha in ALPHAS {
            for index in INDICES {
                let (near, far) = (rough(kind, alpha, glass(index)), rough(kind, alpha, glass(1.0 / index)));
                let metal = rough(kind, alpha, mirror());
                for angle in ANGLES {
                    let w = towards(angle);
                    for _ in 0..300 {
                        // Drawn, so that narrow lobes are met.
                        let Some((v, _)) = draw(&near, w, &mut stream) else { continue };
                        let there = near.eval(w, v)[0] / v.z.abs();
                        let back = if v.z > 0.0 {
                            near.eval(v, w)[0] / w.z
                        } else {
                            far.eval(turned(v), turned(w))[0] / w.z / (index * index)
                        };
                        joined[usize::from(v.z < 0.0)] += 1;
                        let same = |a: f64, b: f64| (a - b).abs() <= 1e-6 * a.max(b).max(1.0);
                        assert!(same(there, back), "{kind:?} {alpha} {index} {angle}: {there} {back}");
                        if v.z > 0.0 {
                            let (there, back) = (metal.eval(w, v)[0] / v.z, metal.eval(v, w)[0] / w.z);
                            assert!(same(there, back), "mirror {kind:?} {alpha} {angle}: {there} {back}");
                        }
                    }
                }
            }
        }
    }
    assert!(joined.iter().all(|&pairs| pairs > 5000), "{joined:?}");
}

/// Smooth glass, from either side, thin panes: how often they mirror is Fresnel's share; beyond the critical angle always.
#[test]
fn smooth_glass_mirrors_fresnels_share() {
    let mut family = Family::new("smooth glass");
    let mut stream = stream(903);
    let hit = flat_hit();
    let mut judge = |what: String, specular: Specular<1>, angle: f64, reflected: f64| {
        let ray = Ray::new(DVec3::ZERO, -towards(angle));
        let mut back = 0;
        for _ in 0..DRAWS {
            let onward = specular.draw(&ray, &hit, &mut stream).expect("a flat surface loses nothing");
            back += u64::from(onward.ray.direction.z > 0.0);
        }
        if reflected >= 1.0 {
            assert_eq!(back, DRAWS as u64, "{what}: total reflection");
        } else {
            family.proportion(what, back, DRAWS as u64, reflected);
        }
    };
    for angle in ANGLES {
        let cosine = towards(angle).z;
        let (reflectance, transmittance) = (Colour::ONE, Colour::ONE);
        for relative_index in INDICES {
            let smooth = Specular::Dielectric { relative_index, reflectance, transmittance };
            let what = format!("index {relative_index:.2}, {angle} degrees");
            judge(what, smooth, angle, fresnel::unpolarised(cosine, relative_index));
        }
        let thin = Specular::Thin { relative_index: 1.5, reflectance, transmittance };
        let through = Pane::new(1.5).expect("an index").transmittance(cosine, Polarisation::Reset);
        judge(format!("thin pane, {angle} degrees"), thin, angle, 1.0 - through);
    }
    family.decide();
}

/// The plane z = 0 met from above.
fn flat_hit() -> Hit {
    let xml = "<scene version=\"3.0.0\"><shape type=\"rectangle\"/><emitter type=\"constant\"/></scene>";
    let world = World::new(read_scene_str(xml, "plane", &[]).expect("a scene"));
    let ray = Ray::new(DVec3::new(0.1, 0.2, 1.0), -DVec3::Z);
    let hit = world.cast(&ray, None, f64::INFINITY).expect("the rectangle");
    let SurfacePoint { normal, .. } = hit.point;
    assert_eq!((normal, hit.front), (DVec3::Z, true));
    hit
}

/// Light leaves bare bodies by the cosine on the side drawn, and bodies under a coat by what the coat lets out.
#[test]
fn matte_bodies_send_light_out_by_their_law() {
    let mut family = Family::new("matte bodies");
    let mut stream = stream(904);
    let up = Normals::flat(DVec3::Z);
    let bare = Matte::<1>::bare(Colour([0.5]));
    let lambert = |v: DVec3| warp::cosine_hemisphere_pdf_solid_angle(v.z);
    judge(&mut family, "bare".into(), &mut || bare.leave(&up, &mut stream).map(|out| out.0), &lambert);
    for index in [1.1, 1.5, 2.5] {
        let coated = Matte::<1>::coated(Colour([0.5]), Colour::ONE, index, true);
        let whole = 1.0 - fresnel::diffuse(index);
        let law =
            |v: DVec3| if v.z > 0.0 { (1.0 - fresnel::unpolarised(v.z, index)) * v.z / (PI * whole) } else { 0.0 };
        let mut out = || coated.leave(&up, &mut stream).map(|out| out.0);
        judge(&mut family, format!("under a coat of index {index}"), &mut out, &law);
    }
    let hit = flat_hit();
    for angle in ANGLES {
        let coated = Matte::<1>::coated(Colour([0.5]), Colour::ONE, 1.5, true);
        let ray = Ray::new(DVec3::ZERO, -towards(angle));
        let mirrored = (0..DRAWS).filter(|_| coated.enter(&ray, &hit, &mut stream).0).count() as u64;
        let truth = fresnel::unpolarised(towards(angle).z, 1.5);
        family.proportion(format!("mirrored by the coat, {angle} degrees"), mirrored, DRAWS as u64, truth);
    }
    let (back, beyond) = (Colour([0.5, 0.2, 0.0]), Colour([0.1, 0.6, 0.3]));
    let sheet = Matte::<3>::transmitting(back, beyond);
    let mut sides: [[Vec<f64>; 3]; 2] = Default::default();
    for _ in 0..DRAWS {
        let (crosses, factor) = sheet.side(&mut stream);
        for channel in 0..3 {
            let flux = (back[channel] + beyond[channel]) * factor[channel];
            sides[0][channel].push(if crosses { 0.0 } else { flux });
            sides[1][channel].push(if crosses { flux } else { 0.0 });
        }
    }
    for (side, share) in sides.iter().zip([back, beyond]) {
        for channel in 0..3 {
            let flux: Replicates = side[channel].iter().copied().collect();
            let what = format!("sheet, channel {channel}, share {}", share[channel]);
            if share[channel] == 0.0 {
                assert_eq!(flux.mean(), Some(0.0), "{what}");
            } else {
                family.mean(what, &flux, share[channel]);
            }
        }
    }
    family.decide();
}

/// Phase functions: drawn angles against the catalogue's F5, around the axis evenly, and the density itself.
#[test]
fn media_scatter_by_their_phase_function() {
    let mut family = Family::new("phase functions");
    let mut stream = stream(905);
    let axis = DVec3::new(0.48, -0.36, 0.8);
    let (x, y) = axis.any_orthonormal_pair();
    for g in [-0.9, -0.3, 0.0, 0.3, 0.75, 0.99] {
        let law = HenyeyGreenstein::new(g).expect("in range");
        let phase = if g == 0.0 { Phase::Isotropic } else { Phase::HenyeyGreenstein(g) };
        let mut observed = vec![0; 20 * TURNS];
        for _ in 0..DRAWS {
            let v = scatter(phase, axis, &mut stream);
            let share = law.cumulative(v.dot(axis));
            let turn = v.dot(y).atan2(v.dot(x)) / TAU + 0.5;
            let place = |x: f64, cells: usize| ((x * cells as f64) as usize).min(cells - 1);
            observed[place(share, 20) * TURNS + place(turn, TURNS)] += 1;
        }
        let even = vec![DRAWS as f64 / observed.len() as f64; observed.len()];
        family.counts(format!("g = {g}"), &observed, &even);
        for mu in [-1.0, -0.5, 0.0, 0.3, 0.9, 1.0] {
            let (ours, theirs) = (phase_pdf_solid_angle(phase, mu), law.density(mu));
            assert!((ours / theirs - 1.0).abs() < 1e-9, "{g} {mu}: {ours} {theirs}");
        }
    }
    family.decide();
}
