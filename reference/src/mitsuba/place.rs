//! Where a flat shape stands: the unit square or disc of the format, scaled, turned and moved.

use crate::vector::{Vector, along, cross, unit};

/// A rectangle or an ellipse in space.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place {
    /// Its middle (m).
    pub(crate) centre: Vector,
    /// Its front side faces this way.
    pub(crate) normal: Vector,
    /// Direction of its second axis, made perpendicular to the normal.
    pub(crate) up: Vector,
    /// Half-edges or half-axes (m): along `up x normal`, and along `up`.
    pub(crate) half: [f64; 2],
}

impl Place {
    /// A square or circle; which way its edges run does not matter.
    pub(crate) fn facing(normal: Vector, centre: Vector, half: f64) -> Self {
        let up = if normal[2].abs() > 0.9 { [0.0, 1.0, 0.0] } else { [0.0, 0.0, 1.0] };
        Place { centre, normal, up, half: [half; 2] }
    }

    /// A rectangle with edges along x and y, facing +z.
    pub(crate) fn floor(centre: Vector, half: [f64; 2]) -> Self {
        Place { centre, normal: [0.0, 0.0, 1.0], up: [0.0, 1.0, 0.0], half }
    }

    /// The same facing the other way.
    pub(crate) fn turned(self) -> Self {
        Place { normal: self.normal.map(|x| -x), ..self }
    }

    /// The six faces of a box between two opposite corners, facing inwards: the lower and upper one of x, then y, then z.
    pub(crate) fn inside_box(from: Vector, to: Vector) -> [Place; 6] {
        let middle = [0, 1, 2].map(|i| 0.5 * (from[i] + to[i]));
        std::array::from_fn(|face| {
            let (axis, upper) = (face / 2, face % 2 == 1);
            let (mut centre, mut normal, mut up) = (middle, [0.0; 3], [0.0; 3]);
            centre[axis] = if upper { to[axis] } else { from[axis] };
            normal[axis] = if upper { -1.0 } else { 1.0 };
            let (other, up_axis) = if axis == 2 { (0, 1) } else { (1 - axis, 2) };
            up[up_axis] = 1.0;
            let half = [other, up_axis].map(|i| 0.5 * (to[i] - from[i]));
            Place { centre, normal, up, half }
        })
    }

    /// The two half-axes as vectors (m), in the order of `half`.
    pub(crate) fn axes(&self) -> [Vector; 2] {
        let first = unit(cross(self.up, self.normal));
        let second = unit(cross(self.normal, first));
        [first.map(|x| x * self.half[0]), second.map(|x| x * self.half[1])]
    }

    /// The point at `(u, v)`, in half-axes from the middle.
    pub(crate) fn point(&self, u: f64, v: f64) -> Vector {
        let [first, second] = self.axes();
        along(along(self.centre, u, first), v, second)
    }

    /// As the format's `to_world`.
    pub(crate) fn to_world(self) -> String {
        let Place { centre: c, normal, up, half: [a, b] } = self;
        let target = along(c, 1.0, normal);
        let words = |v: Vector| v.map(|x| x.to_string()).join(" ");
        format!(
            "<transform name=\"to_world\"><scale x=\"{a}\" y=\"{b}\"/><lookat origin=\"{}\" target=\"{}\" up=\"{}\"/></transform>",
            words(c),
            words(target),
            words(up)
        )
    }
}

/// A flat shape of this type (`rectangle` or `disk`).
pub(crate) fn flat(shape: &str, id: &str, place: Place, on_it: &str) -> String {
    format!("  <shape type=\"{shape}\" id=\"{id}\">{}{on_it}</shape>\n", place.to_world())
}

#[test]
fn axes_and_points_are_where_the_format_puts_them() {
    let place = Place { centre: [1.0, 2.0, 3.0], normal: [0.0, 2.0, 0.0], up: [0.0, 1.0, 1.0], half: [2.0, 0.5] };
    assert_eq!(place.axes(), [[-2.0, 0.0, 0.0], [0.0, 0.0, 0.5]]);
    assert_eq!(place.point(0.5, -1.0), [0.0, 2.0, 2.5]);
    let faces = Place::inside_box([0.0; 3], [2.0, 4.0, 6.0]);
    for (face, place) in faces.iter().enumerate() {
        let (axis, corner) = (face / 2, place.point(1.0, -1.0));
        assert_eq!(corner[axis], if face % 2 == 1 { [2.0, 4.0, 6.0][axis] } else { 0.0 });
        assert!((0..3).all(|i| corner[i] == 0.0 || corner[i] == [2.0, 4.0, 6.0][i]), "{face} {corner:?}");
    }
    assert_eq!(Place::floor([0.0; 3], [3.0, 4.0]).axes(), [[3.0, 0.0, 0.0], [0.0, 4.0, 0.0]]);
}
