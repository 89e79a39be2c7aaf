//! Ray casting against brute force, and self-intersection at every scale.

use std::sync::Arc;

use glam::{DAffine3, DMat3, DVec3};
use photonlab_photometry::Spectrum;
use photonlab_scene::{Bsdf, Frame, Geometry, Mesh, Ray, Scene, Shape, World};

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
    World::new(Scene { shapes, emitters: vec![], sensors: vec![], media: vec![], max_depth: None, notes: vec![] })
}

fn random_shapes(count: usize, scale: f64, numbers: &mut Numbers) -> Vec<Shape> {
    (0..count)
        .map(|i| {
            let centre = numbers.vector() * scale;
            let turn = DMat3::from_axis_angle(numbers.direction(), numbers.next() * 6.0);
            let size = scale * (0.02 + 0.3 * numbers.next());
            let to_world = DAffine3::from_mat3_translation(turn * DMat3::from_diagonal(DVec3::splat(size)), centre);
            let geometry = match i % 6 {
                0 => Geometry::Rectangle { to_world },
                1 => Geometry::Cube { to_world },
                2 => Geometry::Sphere { centre, radius: size, to_world: turn },
                3 => Geometry::Disk { to_world },
                4 => {
                    let frame = Frame { origin: centre, axes: turn };
                    Geometry::Cylinder { frame, radius: 0.5 * size, length: size }
                }
                _ => Geometry::Mesh(Arc::new(box_mesh(&to_world))),
            };
            shape(geometry, i % 2 == 0)
        })
        .collect()
}

/// The cube as twelve triangles, outside in front.
fn box_mesh(to_world: &DAffine3) -> Mesh {
    let corner = |i: u32| DVec3::new(f64::from(i & 1), f64::from(i >> 1 & 1), f64::from(i >> 2 & 1)) * 2.0 - 1.0;
    let squares = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    Mesh {
        vertices: (0..8).map(|i| to_world.transform_point3(corner(i))).collect(),
        faces: squares.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect(),
    }
}

#[test]
fn the_tree_finds_what_brute_force_finds() {
    let mut numbers = Numbers(1);
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
                    assert_eq!(world.unblocked(&ray, None, hit.distance, Some(hit.point.primitive)), 1.0);
                    assert_eq!(world.unblocked(&ray, None, hit.distance * 1.001, None), 0.0);
                }
            }
            assert!(count < 10 || hits > 100, "the rays must meet something for the test to mean anything");
        }
    }
}

#[test]
fn balls_that_leave_their_surface_agree_with_brute_force() {
    let mut numbers = Numbers(2);
    let small = world(random_shapes(4, 1.0, &mut numbers));
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
        let expected = (0..4).filter(|&i| i != own).any(|i| small.distance_to_shape(i, hit.point.position) <= radius);
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
            for geometry in [
                Geometry::Cube { to_world },
                Geometry::Sphere { centre, radius: scale, to_world: DMat3::IDENTITY },
                Geometry::Mesh(Arc::new(box_mesh(&to_world))),
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
    let mesh = world(vec![shape(Geometry::Mesh(Arc::new(Mesh { vertices, faces })), false)]);
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
