//! An axis-aligned box.

/// A closed box; `lo <= hi` on every axis, all finite.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Bounds {
    pub(crate) lo: [f32; 3],
    pub(crate) hi: [f32; 3],
}

impl Bounds {
    /// The tight box of at least one point.
    #[cfg(test)]
    pub(crate) fn around(points: impl IntoIterator<Item = [f32; 3]>) -> Self {
        let none = Self { lo: [f32::INFINITY; 3], hi: [f32::NEG_INFINITY; 3] };
        points.into_iter().fold(none, |b, p| Self {
            lo: std::array::from_fn(|axis| b.lo[axis].min(p[axis])),
            hi: std::array::from_fn(|axis| b.hi[axis].max(p[axis])),
        })
    }

    /// Edge lengths; in `f64` a difference of two `f32` cannot overflow.
    pub(crate) fn extent(&self) -> [f64; 3] {
        std::array::from_fn(|axis| f64::from(self.hi[axis]) - f64::from(self.lo[axis]))
    }

    /// The longest edge, the first of several equal ones; none where the box is a single point.
    pub(crate) fn widest_axis(&self) -> Option<usize> {
        let extent = self.extent();
        let widest = (0..3).fold(0, |best, axis| if extent[axis] > extent[best] { axis } else { best });
        (extent[widest] > 0.0).then_some(widest)
    }

    /// Surface area, both sides of a flat box counted.
    pub(crate) fn area(&self) -> f64 {
        let [x, y, z] = self.extent();
        2.0 * (x * y + y * z + z * x)
    }

    /// The two parts on either side of a plane through the box.
    pub(crate) fn cut(&self, axis: usize, at: f32) -> (Self, Self) {
        let (mut low, mut high) = (*self, *self);
        low.hi[axis] = at;
        high.lo[axis] = at;
        (low, high)
    }

    /// Squared distance to the nearest point of the box, zero inside: never above the computed
    /// [`distance_squared`](crate::distance_squared) of any point in the box.
    ///
    /// # Numerics
    ///
    /// The bound is exact in floating point, not just nearly so: a gap on one axis is at most the difference to
    /// a point of the box, and rounding, squaring and adding in the same order all keep `<=`.
    ///
    /// This is the formula's specification; queries compute it for sixteen boxes at once.
    #[cfg(test)]
    pub(crate) fn distance_squared(&self, query: [f32; 3]) -> f32 {
        let nearest = std::array::from_fn(|axis| query[axis].max(self.lo[axis]).min(self.hi[axis]));
        crate::distance_squared(query, nearest)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn measures_itself() {
        let b = Bounds::around([[0.0, 1.0, 5.0], [2.0, -3.0, 5.0]]);
        assert_eq!(b, Bounds { lo: [0.0, -3.0, 5.0], hi: [2.0, 1.0, 5.0] });
        assert_eq!((b.area(), b.widest_axis()), (16.0, Some(1)));
        assert_eq!(Bounds::around([[7.0; 3]]).widest_axis(), None);
        assert_eq!(Bounds::around([[f32::MIN; 3], [f32::MAX; 3]]).widest_axis(), Some(0));
        let (low, high) = b.cut(1, 0.0);
        assert_eq!((low.hi[1], high.lo[1]), (0.0, 0.0));
    }

    fn coordinate() -> impl Strategy<Value = f32> {
        prop_oneof![-2f32..2.0, any::<f32>().prop_filter("finite", |x| x.is_finite()), -1e-20f32..1e-20]
    }

    proptest! {
        /// The promise on which all pruning stands, over the whole range of `f32`.
        #[test]
        fn never_farther_than_a_point_inside(
            a in prop::array::uniform3(coordinate()),
            b in prop::array::uniform3(coordinate()),
            c in prop::array::uniform3(coordinate()),
            query in prop::array::uniform3(coordinate()),
        ) {
            let bounds = Bounds::around([a, b, c]);
            for point in [a, b, c] {
                prop_assert!(bounds.distance_squared(query) <= crate::distance_squared(query, point));
            }
        }
    }
}
