//! Where along a ray a density estimate would reach over a surface.

use photonlab_scene::{Ray, World};

/// The pieces of a ray that lie near surfaces.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Stretches {
    /// Start and end of each, metres along the ray, rising.
    near: Vec<[f64; 2]>,
}

impl Stretches {
    /// Those of a ray of a finite length within `reach` of a surface, as far as a window of it tells. A piece is judged by one
    /// ball around all of it; where that meets a surface, the piece is halved, down to a length of `reach`. So what counts as far
    /// is farther than `reach` from every surface, and what counts as near is within twice that. What counts as which depends
    /// on the ray and its length alone, not on the window.
    pub(crate) fn near_surfaces(world: &World, ray: &Ray, length: f64, window: [f64; 2], reach: f64) -> Self {
        let mut found = Self::default();
        found.divide(world, ray, [0.0, length], window, reach);
        found
    }

    fn divide(&mut self, world: &World, ray: &Ray, [start, end]: [f64; 2], window: [f64; 2], reach: f64) {
        let (middle, half) = (0.5 * (start + end), 0.5 * (end - start));
        if start > window[1] || end < window[0] || !world.is_near_surface(ray.at(middle), reach + half) {
            return;
        }
        if half > 0.5 * reach {
            self.divide(world, ray, [start, middle], window, reach);
            self.divide(world, ray, [middle, end], window, reach);
            return;
        }
        match self.near.last_mut() {
            Some(last) if last[1] == start => last[1] = end,
            _ => self.near.push([start, end]),
        }
    }

    /// True if a place on the ray is near a surface.
    pub(crate) fn has(&self, along: f64) -> bool {
        let after = self.near.partition_point(|&[start, _]| start <= along);
        after > 0 && along < self.near[after - 1][1]
    }

    /// True if all places from one to another are.
    pub(crate) fn cover(&self, [start, end]: [f64; 2]) -> bool {
        self.near.iter().any(|&[from, to]| from <= start && end <= to)
    }

    /// True if no place is.
    pub(crate) fn is_empty(&self) -> bool {
        self.near.is_empty()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;
    use photonlab_scene::read::read_scene_str;

    /// Between two walls both ends are near, and a meter's plane that nothing notices is not.
    #[test]
    fn both_ends_between_walls() {
        let wall = |z: f64, bsdf: &str| {
            format!(
                r#"<shape type="rectangle"><transform name="to_world"><scale value="50"/><translate z="{z}"/></transform>
                <bsdf type="{bsdf}"/></shape>"#
            )
        };
        let text = wall(0.0, "diffuse") + &wall(1.0, "diffuse") + &wall(0.5, "null");
        let scene =
            read_scene_str(&format!(r#"<scene version="3.0.0">{text}</scene>"#), "walls", &[]).expect("a scene");
        let world = World::new(scene);
        let ray = Ray::new(DVec3::ZERO, DVec3::Z);
        let near = Stretches::near_surfaces(&world, &ray, 1.0, [0.0, 1.0], 0.05);
        for (along, expected) in [(0.0, true), (0.049, true), (0.11, false), (0.5, false), (0.89, false), (0.96, true)]
        {
            assert_eq!(near.has(along), expected, "{along}: {near:?}");
            let through_window = Stretches::near_surfaces(&world, &ray, 1.0, [along; 2], 0.05);
            assert_eq!(through_window.has(along), expected, "{along}: {through_window:?}");
        }
        assert!(!near.is_empty() && !near.has(1.5));
        assert!(near.cover([0.0, 0.05]) && !near.cover([0.0, 0.2]) && !near.cover([0.0, 1.0]));
        assert!(Stretches::near_surfaces(&world, &ray, 1.0, [0.0, 1.0], 0.6).cover([0.0, 1.0]));
        let between = Ray::new(DVec3::new(0.0, 0.0, 0.5), DVec3::X);
        assert!(Stretches::near_surfaces(&world, &between, 3.0, [0.0, 3.0], 0.1).is_empty());
    }
}
