//! All points in a closed ball.

use crate::tree::KdTree;
use crate::visits::{Meter, Unmetered, Visits};
use crate::walk::{Collector, walk};

/// Passes on every point within a fixed reach.
struct Ball<V> {
    radius_squared: f32,
    visit: V,
}

impl<V: FnMut(usize, f32)> Collector for Ball<V> {
    const NEAR_FIRST: bool = false;

    #[inline]
    fn reach(&self) -> f32 {
        self.radius_squared
    }

    #[inline]
    fn offer(&mut self, index: usize, distance_squared: f32) {
        (self.visit)(index, distance_squared);
    }
}

impl<P: Copy + Send + Sync> KdTree<P> {
    /// Calls `visit(tree index, squared distance)` for every point of the closed ball, by rising tree index.
    ///
    /// In the ball are the points whose [`distance_squared`](crate::distance_squared) to `query` is at most
    /// `radius * radius`, both as computed in `f32`. So a point exactly at a representable radius along an axis
    /// is inside, an infinite radius takes every point, radius zero takes the points at computed distance zero,
    /// and a radius whose square overflows or vanishes acts as infinity or zero. A negative or NaN radius, or a
    /// query with a NaN coordinate, takes nothing; an infinite coordinate is infinitely far from every point. Does not allocate.
    pub fn within(&self, query: [f32; 3], radius: f32, visit: impl FnMut(usize, f32)) {
        self.within_metered(query, radius, visit, &mut Unmetered);
    }

    /// [`within`](Self::within), telling what the walk cost.
    pub fn within_counted(&self, query: [f32; 3], radius: f32, visit: impl FnMut(usize, f32)) -> Visits {
        let mut visits = Visits::default();
        self.within_metered(query, radius, visit, &mut visits);
        visits
    }

    fn within_metered(&self, query: [f32; 3], radius: f32, visit: impl FnMut(usize, f32), meter: &mut impl Meter) {
        if radius >= 0.0 {
            let mut ball = Ball { radius_squared: radius * radius, visit };
            walk(&self.nodes, &self.points, query, &mut ball, meter);
        }
    }
}
