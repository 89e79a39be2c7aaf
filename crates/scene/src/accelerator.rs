//! Which primitives may lie on a ray or near a point.

use glam::{DVec3, Vec3A};
use obvhs::{
    BvhBuildParams,
    aabb::Aabb,
    bvh2::{Bvh2, builder::build_bvh2},
    cwbvh::{CwBvh, bvh2_to_cwbvh::bvh2_to_cwbvh},
    ray::{Ray as BoxRay, RayHit},
};

use crate::ray::Ray;

/// In the accelerator's own coordinates, in which the scene spans [-1, 1], boxes are grown by this much: more than
/// its single precision can lose.
const BOX_MARGIN: f32 = 1e-5;

/// Up to this many primitives a loop is faster than the tree (measured on the project's scenes).
const LOOP_LIMIT: usize = 8;

/// A hierarchy of boxes around primitives, or none where a loop over all of them is faster.
pub(crate) struct Accelerator {
    centre: DVec3,
    half_extent: f64,
    primitives: u32,
    tree: Option<Tree>,
}

/// One hierarchy in two forms: eight-wide for rays, binary for neighbourhoods.
struct Tree {
    boxes: Bvh2,
    wide: CwBvh,
}

impl Accelerator {
    /// From each primitive's smallest and largest coordinates.
    pub(crate) fn new(bounds: &[(DVec3, DVec3)]) -> Self {
        let (low, high) = whole(bounds);
        let centre = 0.5 * (low + high);
        let half_extent = (0.5 * (high - low).max_element()).max(f64::MIN_POSITIVE);
        let local = |x: DVec3| Vec3A::from(((x - centre) / half_extent).as_vec3());
        let boxes = |&(low, high): &(DVec3, DVec3)| Aabb::new(local(low) - BOX_MARGIN, local(high) + BOX_MARGIN);
        let tree = (bounds.len() > LOOP_LIMIT).then(|| Tree::new(&bounds.iter().map(boxes).collect::<Vec<_>>()));
        Self { centre, half_extent, primitives: bounds.len() as u32, tree }
    }

    /// Offers the primitives near a ray to `test(primitive, reach) -> reach`, nearest boxes first. Reach starts at `limit`,
    /// in metres along the ray, and boxes beyond it are left out.
    pub(crate) fn along(&self, ray: &Ray, limit: f64, mut test: impl FnMut(u32, f64) -> f64) {
        let mut reach = limit;
        let Some(tree) = &self.tree else {
            for primitive in 0..self.primitives {
                reach = test(primitive, reach);
            }
            return;
        };
        // The walk starts where the ray enters the scene's bounding sphere, so that a far-away eye costs no digits, and
        // never less than a hundredth before the ray itself: the tree leaves out boxes that end within 1e-4.
        let offset = (ray.origin - self.centre) / self.half_extent;
        let entry = (-offset.dot(ray.direction) - 1.75).max(-0.01);
        let local = |t: f64| (((t / self.half_extent) - entry) as f32).next_up();
        let start = offset + entry * ray.direction;
        // Adding zero turns -0 into 0: the tree takes the sign of -0 for negative in one place and not in another, and then
        // finds nothing.
        let direction = Vec3A::from(ray.direction.as_vec3()) + Vec3A::ZERO;
        let box_ray = BoxRay::new(start.as_vec3().into(), direction, 0.0, local(reach));
        tree.wide.ray_traverse(box_ray, &mut RayHit::none(), |_, i| {
            reach = test(tree.wide.primitive_indices[i], reach);
            local(reach)
        });
    }

    /// True if any primitive whose box is within `radius` metres of a point passes the test.
    pub(crate) fn any_near(&self, point: DVec3, radius: f64, mut test: impl FnMut(u32) -> bool) -> bool {
        let Some(tree) = &self.tree else {
            return (0..self.primitives).any(test);
        };
        let local = Vec3A::from(((point - self.centre) / self.half_extent).as_vec3());
        let reach = (radius / self.half_extent) as f32 * (1.0 + 1e-6) + BOX_MARGIN;
        let mut found = false;
        tree.boxes.aabb_traverse(Aabb::new(local - reach, local + reach), |tree, node| {
            let node = &tree.nodes[node as usize];
            let leaf = node.first_index as usize..(node.first_index + node.prim_count) as usize;
            found = found || leaf.into_iter().any(|i| test(tree.primitive_indices[i]));
            !found
        });
        found
    }
}

impl Tree {
    fn new(boxes: &[Aabb]) -> Self {
        let parameters = BvhBuildParams { max_prims_per_leaf: 1, ..BvhBuildParams::medium_build() };
        let boxes = build_bvh2(boxes, parameters, &mut Default::default());
        let wide = bvh2_to_cwbvh(&boxes, 3, true, false);
        Self { boxes, wide }
    }
}

/// Smallest and largest coordinates of all; zeros for none.
pub(crate) fn whole(bounds: &[(DVec3, DVec3)]) -> (DVec3, DVec3) {
    let union = |a: (DVec3, DVec3), b: (DVec3, DVec3)| (a.0.min(b.0), a.1.max(b.1));
    bounds.iter().copied().reduce(union).unwrap_or((DVec3::ZERO, DVec3::ZERO))
}
