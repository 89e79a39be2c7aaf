//! Ray casting against brute force, and self-intersection at every scale.

use std::sync::Arc;

use glam::{DAffine3, DMat3, DVec3};
use photonlab_photometry::Spectrum;
use photonlab_scene::{Bsdf, Frame, Geometry, LensBody, Mesh, Ray, Scene, Shape, Surface, World};

/// SplitMix64 (Steele et al. 2014): good enough to place shapes and rays.
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    fn vector(&mut self) -> DVec3 {
        DVec3::new(self.next(), self.next(), self.next()) * 2.0 - 1.0
    }

    fn direction(&mut self) -> DVec3 {
        loop {
            let v = self.vector();
            if v.length_squared() > 1e-4 && v.length_squared() < 1.0 {
                return v.normalize();
            }
        }
    }
}

fn shape(geometry: Geometry, flip_normals: bool) -> Shape {
    Shape {
        id: "s".into(),
        geometry,
        flip_normals,
        bsdf: Bsdf::Diffuse { reflectance: Spectrum::Uniform(0.5) },
        radiance: None,
        boundary: None,
    }
}

fn world(shapes: Vec<Shape>) -> World {
    World::new(Scene {
        shapes,
        emitters: vec![],
        sensors: vec![],
        media: vec![],
        max_depth: None,
        hides_lamps: false,
        notes: vec![],
    })
}

fn random_shapes(count: usize, scale: f64, numbers: &mut Numbers) -> Vec<Shape> {
    (0..count)
        .map(|i| {
            let centre = numbers.vector() * scale;
            let turn = DMat3::from_axis_angle(numbers.direction(), numbers.next() * 6.0);
            let size = scale * (0.02 + 0.3 * numbers.next());
            let to_world = DAffine3::from_mat3_translation(turn * DMat3::from_diagonal(DVec3::splat(size)), centre);
            let squeeze = DAffine3::from_scale(DVec3::new(1.0, 0.3 + numbers.next(), 1.0));
            let frame = Frame { origin: centre, axes: turn };
            let geometry = match i % 9 {
                0 => Geometry::Rectangle { to_world },
                1 => Geometry::Cube { to_world },
                2 => Geometry::Sphere { centre, radius: size, to_world: turn },
                3 => Geometry::Disk { to_world: to_world * squeeze },
                4 => Geometry::Cylinder { frame, radius: 0.5 * size, length: size },
                5 => Geometry::Paraboloid { frame, focal_length: 0.4 * size, rim: size },
                6 => Geometry::Lens { frame, lens: lens(size) },
                7 => Geometry::Mesh(Arc::new(icosphere(1, &to_world))),
                _ => Geometry::Mesh(Arc::new(box_mesh(&to_world))),
            };
            shape(geometry, (i / 9) % 2 == 0)
        })
        .collect()
}

/// Thick, with both faces bulging, around half its thickness.
fn round_lens(size: f64) -> LensBody {
    LensBody { curvatures: [0.6 / size, -0.4 / size], thickness: size, rim: 0.8 * size }
}

/// A meniscus, so that one face is hollow.
fn lens(size: f64) -> LensBody {
    LensBody { curvatures: [0.5 / size, 0.8 / size], thickness: 0.3 * size, rim: 0.9 * size }
}

/// An icosahedron whose triangles are halved along each edge a number of times, on the unit sphere, normals outwards.
fn icosphere(halvings: u32, to_world: &DAffine3) -> Mesh {
    let golden = 0.5 * (1.0 + 5f64.sqrt());
    let mut points: Vec<DVec3> = Vec::new();
    for (a, b) in [(1.0, golden), (-1.0, golden), (1.0, -golden), (-1.0, -golden)] {
        points.extend([DVec3::new(0.0, a, b), DVec3::new(a, b, 0.0), DVec3::new(b, 0.0, a)].map(|p| p.normalize()));
    }
    // The faces are the triples of neighbours.
    let near = |a: usize, b: usize| (points[a] - points[b]).length() < 1.1;
    let mut faces = Vec::new();
    for a in 0..12 {
        for b in a + 1..12 {
            for c in b + 1..12 {
                if near(a, b) && near(b, c) && near(a, c) {
                    let out = (points[b] - points[a]).cross(points[c] - points[a]).dot(points[a]) > 0.0;
                    faces.push(if out { [a, b, c] } else { [a, c, b] });
                }
            }
        }
    }
    assert_eq!(faces.len(), 20);
    let mut middles = std::collections::HashMap::new();
    for _ in 0..halvings {
        let mut finer = Vec::new();
        for [a, b, c] in faces {
            let [ab, bc, ca] = [(a, b), (b, c), (c, a)].map(|(p, q)| {
                *middles.entry((p.min(q), p.max(q))).or_insert_with(|| {
                    points.push((points[p] + points[q]).normalize());
                    points.len() - 1
                })
            });
            finer.extend([[a, ab, ca], [b, bc, ab], [c, ca, bc], [ab, bc, ca]]);
        }
        faces = finer;
    }
    let vertices = points.iter().map(|p| to_world.transform_point3(*p)).collect();
    Mesh { vertices, faces: faces.into_iter().map(|f| f.map(|i| i as u32)).collect(), smooth: None }
}

/// The cube as twelve triangles, outside in front.
fn box_mesh(to_world: &DAffine3) -> Mesh {
    let corner = |i: u32| DVec3::new(f64::from(i & 1), f64::from(i >> 1 & 1), f64::from(i >> 2 & 1)) * 2.0 - 1.0;
    let squares = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    Mesh {
        vertices: (0..8).map(|i| to_world.transform_point3(corner(i))).collect(),
        faces: squares.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect(),
        smooth: None,
    }
}

#[test]
fn the_tree_finds_what_brute_force_finds() {
    let mut numbers = Numbers(1);
    let mut kinds = [0; 9];
    for scale in [1e-3, 1.0, 1e3] {
        for count in [1, 3, 12, 60, 400] {
            let world = world(random_shapes(count, scale, &mut numbers));
            let mut hits = 0;
            for _ in 0..3000 {
                let far = if numbers.next() < 0.2 { 50.0 } else { 1.5 };
                let origin = numbers.vector() * far * scale;
                let mut along = numbers.vector() * scale - origin;
                // Parallel light comes with components that are zero, of either sign, or nearly so.
                for axis in 0..3 {
                    if numbers.next() < 0.2 {
                        along[axis] = [0.0, -0.0, 1e-300, -1e-300, -1e-12][(numbers.next() * 5.0) as usize];
                    }
                }
                if along.length_squared() == 0.0 {
                    continue;
                }
                let ray = Ray::new(origin, along.normalize());
                let (fast, slow) =
                    (world.cast(&ray, None, f64::INFINITY), world.cast_brute_force(&ray, None, f64::INFINITY));
                assert_eq!(
                    fast.map(|h| (h.point.primitive, h.distance)),
                    slow.map(|h| (h.point.primitive, h.distance))
                );
                if let Some(hit) = fast {
                    hits += 1;
                    kinds[world.primitives[hit.point.primitive as usize].shape as usize % 9] += 1;
                    let off = world.primitives[hit.point.primitive as usize].surface.distance(hit.point.position);
                    assert!(off < 1e-12 * far * scale, "a hit lies on its surface: {off}");
                    assert_eq!(world.unblocked(&ray, None, hit.distance, Some(hit.point.primitive)), 1.0);
                    assert_eq!(world.unblocked(&ray, None, hit.distance * 1.001, None), 0.0);
                }
            }
            assert!(count < 10 || hits > 100, "the rays must meet something for the test to mean anything");
        }
    }
    assert!(kinds.iter().all(|&hits| hits > 300), "every kind of surface is met: {kinds:?}");
}

/// A ray through a curved surface meets it as often as one that restarts where it lands; through masks the light that is
/// left is the product of all.
#[test]
fn masks_are_crossed_as_often_as_a_ray_that_goes_on_lands() {
    let mut numbers = Numbers(7);
    for scale in [1e-3, 1.0, 1e3] {
        let mut shapes = random_shapes(27, scale, &mut numbers);
        for shape in &mut shapes {
            let surface = Box::new(shape.bsdf.clone());
            shape.bsdf = Bsdf::Mask { opacity: 0.5, surface };
        }
        let world = world(shapes);
        let mut twice = [0; 9];
        for _ in 0..8000 {
            let ray = Ray::towards(numbers.vector() * 3.0 * scale, numbers.vector() * scale);
            let (mut walk, mut from, mut open) = (ray, None, 1.0);
            let mut crossed = vec![0; world.scene.shapes.len()];
            while let Some(hit) = world.cast(&walk, from, f64::INFINITY) {
                (walk, from) = (Ray::new(hit.point.position, ray.direction), Some(hit.point.primitive));
                crossed[world.primitives[hit.point.primitive as usize].shape as usize] += 1;
                open *= 0.5;
            }
            crossed.iter().enumerate().filter(|(_, n)| **n >= 2).for_each(|(shape, _)| twice[shape % 9] += 1);
            assert_eq!(world.unblocked(&ray, None, 100.0 * scale, None), open);
        }
        assert!([1, 2, 4, 5, 6, 7, 8].iter().all(|&kind| twice[kind] > 20), "{twice:?}");
    }
}

/// Areas by the small quadrilaterals between points drawn evenly by area, whose areas are alike.
#[test]
fn areas_agree_with_quadrature() {
    let mut numbers = Numbers(8);
    for shape in random_shapes(9, 1.0, &mut numbers) {
        let world = world(vec![shape]);
        for p in 0..world.primitives.len() as u32 {
            let surface = world.primitives[p as usize].surface;
            if let Surface::Triangle(_) = surface {
                continue;
            }
            let n = 200;
            let at = |i: usize, j: usize| surface.point_by_area([i as f64 / n as f64, j as f64 / n as f64]);
            let cell = |i: usize, j: usize| {
                let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
                0.5 * ((b - a).cross(c - a).length() + (c - a).cross(d - a).length())
            };
            let whole: f64 = (0..n * n).map(|k| cell(k / n, k % n)).sum();
            assert!((whole / surface.area() - 1.0).abs() < 2e-3, "{surface:?}: {whole} {}", surface.area());
            let somewhere = cell(n / 2, n / 3) * (n * n) as f64;
            assert!((somewhere / surface.area() - 1.0).abs() < 0.02, "even by area: {surface:?}");
        }
    }
}

#[test]
fn balls_that_leave_their_surface_agree_with_brute_force() {
    let mut numbers = Numbers(2);
    let small = world(random_shapes(8, 1.0, &mut numbers));
    assert!(small.primitives.len() > 8, "the tree must be in use");
    let mut seen = [0, 0];
    for _ in 0..20_000 {
        let ray = Ray::towards(numbers.vector() * 3.0, numbers.vector());
        let Some(hit) = small.cast(&ray, None, f64::INFINITY) else {
            continue;
        };
        let radius = 0.2 * numbers.next();
        let alone = |index: usize| {
            let one = world(vec![small.scene.shapes[index].clone()]);
            one.ball_leaves_surface(&hit.point, radius)
        };
        // A neighbour counts if a shape on its own, seen from a point that is not on it, is within the radius.
        let own = small.primitives[hit.point.primitive as usize].shape as usize;
        let expected = (0..8).filter(|&i| i != own).any(|i| small.distance_to_shape(i, hit.point.position) <= radius);
        let found = small.ball_leaves_surface(&hit.point, radius);
        if expected {
            assert!(found);
        } else if small.primitives_of(own).len() == 1 && own == 0 {
            assert_eq!(found, alone(0));
        }
        seen[usize::from(found)] += 1;
    }
    assert!(seen[0] > 200 && seen[1] > 200, "{seen:?}");
}

/// Light in a closed room must not leak and must not be caught by the wall it leaves: every ray from a wall lands on
/// another wall (or, in a sphere, on the sphere again), at every scale and far from the origin.
#[test]
fn rays_from_walls_stay_in_the_room() {
    let mut numbers = Numbers(3);
    for scale in [1e-3, 1e-2, 1.0, 30.0, 1e3] {
        for offset in [0.0, 20.0] {
            let centre = DVec3::new(0.3, -0.7, 0.2) * offset * scale;
            let turn = DMat3::from_axis_angle(DVec3::new(0.6, 0.0, 0.8), 0.7);
            let to_world = DAffine3::from_mat3_translation(turn * DMat3::from_diagonal(DVec3::splat(scale)), centre);
            let frame = Frame { origin: centre - 0.5 * scale * turn.z_axis, axes: turn };
            for geometry in [
                Geometry::Cube { to_world },
                Geometry::Sphere { centre, radius: scale, to_world: DMat3::IDENTITY },
                Geometry::Mesh(Arc::new(box_mesh(&to_world))),
                Geometry::Mesh(Arc::new(icosphere(3, &to_world))),
                Geometry::Lens { frame, lens: round_lens(scale) },
            ] {
                let room = world(vec![shape(geometry, true)]);
                for _ in 0..2000 {
                    let mut ray = Ray::new(centre, numbers.direction());
                    let mut from = None;
                    for bounce in 0..3 {
                        let hit = room.cast(&ray, from, f64::INFINITY).expect("the room is closed");
                        assert!(hit.front, "seen from inside, a wall shows its front");
                        assert!(hit.distance > 0.0 && hit.distance < 4.0 * scale);
                        from = Some(hit.point.primitive);
                        // Many grazing rays in a row would end within rounding of an edge.
                        let grazing = if bounce == 0 { 1e-4 } else { 1.0 };
                        let side = hit.point.normal.cross(numbers.direction()).normalize();
                        let direction = (side + grazing * numbers.next().max(0.01) * hit.point.normal).normalize();
                        ray = Ray::new(hit.point.position, direction);
                    }
                }
            }
        }
    }
}

#[test]
fn cells_are_drawn_uniformly_by_area() {
    let mut numbers = Numbers(4);
    let to_world = DAffine3::from_scale(DVec3::new(1.0, 2.0, 1.0));
    let room = world(vec![
        shape(Geometry::Sphere { centre: DVec3::ZERO, radius: 2.0, to_world: DMat3::IDENTITY }, false),
        shape(Geometry::Cube { to_world }, false),
    ]);
    let n = 200_000;
    // Cell [0, 0] of two rows is the upper half: by Archimedes the mean height over it is R / 2.
    let mean_height = (0..n)
        .map(|_| room.point_in_cell(0, [0, 0], [1, 2], [numbers.next(), numbers.next(), numbers.next()]).position.z)
        .sum::<f64>()
        / f64::from(n);
    assert!((mean_height - 1.0).abs() < 5.0 * 2.0 / (12f64.sqrt() * f64::from(n).sqrt()));
    // Of the box 2 x 4 x 2 the two small faces have 8 of 40 square metres.
    let small = (0..n)
        .filter(|_| {
            let p = room.point_in_cell(1, [0, 0], [1, 1], [numbers.next(), numbers.next(), numbers.next()]);
            p.normal.y.abs() > 0.5
        })
        .count() as f64
        / f64::from(n);
    assert!((small - 0.2).abs() < 5.0 * (0.2f64 * 0.8 / f64::from(n)).sqrt());
}

/// A flat square of many triangles, and of one parallelogram, leave a ball the same room.
#[test]
fn a_flat_mesh_is_one_surface() {
    let mut numbers = Numbers(5);
    let n = 20;
    let at = |i: u32| f64::from(i) / f64::from(n) * 2.0 - 1.0;
    let vertices = (0..=n).flat_map(|j| (0..=n).map(move |i| DVec3::new(at(i), at(j), 0.0))).collect();
    let corner = |i: u32, j: u32| j * (n + 1) + i;
    let faces = (0..n)
        .flat_map(|j| (0..n).map(move |i| (i, j)))
        .flat_map(|(i, j)| {
            let [a, b, c, d] = [corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)];
            [[a, b, c], [a, c, d]]
        })
        .collect();
    let to_world = DAffine3::IDENTITY;
    let mesh = world(vec![shape(Geometry::Mesh(Arc::new(Mesh { vertices, faces, smooth: None })), false)]);
    let square = world(vec![shape(Geometry::Rectangle { to_world }, false)]);
    let mut seen = [0, 0];
    for _ in 0..2000 {
        let ray = Ray::new(DVec3::new(numbers.next() * 2.0 - 1.0, numbers.next() * 2.0 - 1.0, 1.0), DVec3::NEG_Z);
        let radius = numbers.next();
        let leaves = [&mesh, &square].map(|world| {
            let hit = world.cast(&ray, None, f64::INFINITY).expect("it is there");
            assert!(hit.front);
            world.ball_leaves_surface(&hit.point, radius)
        });
        assert_eq!(leaves[0], leaves[1], "{ray:?} {radius}");
        seen[usize::from(leaves[0])] += 1;
    }
    assert!(seen[0] > 100 && seen[1] > 100, "{seen:?}");
}

/// The inside of a tube that shines inwards is seen through its open ends, not through its wall, and so with a hollow dish.
#[test]
fn a_surface_hides_its_own_inside() {
    let frame = Frame { origin: DVec3::ZERO, axes: DMat3::IDENTITY };
    let far_wall = DVec3::new(-1.0, 0.0, 0.5);
    for (geometry, flip) in [
        (Geometry::Cylinder { frame, radius: 1.0, length: 1.0 }, true),
        (Geometry::Sphere { centre: DVec3::new(0.0, 0.0, 0.5), radius: 1.0, to_world: DMat3::IDENTITY }, true),
        (Geometry::Paraboloid { frame, focal_length: 0.5, rim: 2.0 }, false),
    ] {
        let world = world(vec![shape(geometry, flip)]);
        let sees = |from: DVec3| {
            let ray = Ray::towards(from, far_wall);
            world.unblocked(&ray, None, (far_wall - from).length(), Some(0))
        };
        assert_eq!(sees(DVec3::new(3.0, 0.2, 0.4)), 0.0, "{:?}", world.scene.shapes[0].geometry);
        assert_eq!(sees(DVec3::new(0.3, 0.2, 0.6)), 1.0, "{:?}", world.scene.shapes[0].geometry);
    }
}
