//! Three-vectors, as far as the scenes here need them.

pub(crate) type Vector = [f64; 3];

pub(crate) fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(crate) fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// `a + t b`.
pub(crate) fn along(a: Vector, t: f64, b: Vector) -> Vector {
    [0, 1, 2].map(|i| a[i] + t * b[i])
}

pub(crate) fn length(v: Vector) -> f64 {
    dot(v, v).sqrt()
}

pub(crate) fn unit(v: Vector) -> Vector {
    v.map(|x| x / length(v))
}
