//! What is divided by where the surface does not fill the ball's disc.

use crate::{AreaModel, Estimator, Kernel};

/// Integrals of a kernel over the surface inside a ball: lengths in radii from the point, areas in discs pi r^2. On a flat
/// surface without an edge in the ball the area is 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Inside {
    /// The weighed area.
    pub area: f64,
    /// The integral of the offset from the point.
    pub first: [f64; 3],
    /// The integral of the offset times itself.
    pub second: [[f64; 3]; 3],
    /// True if nothing in the ball can hide a part of this surface from light.
    pub open: bool,
}

/// The factor, linear in a photon's offset from the point, that makes its kernel one for the surface that is there: a
/// boundary kernel (Jones, "Simple boundary correction for kernel density estimation", 1993).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Correction {
    constant: f64,
    /// Per radius.
    slope: [f64; 3],
}

/// The area in a ball must grow at least as this power of the disc's: it is 1 beside an edge or in a corner, and above 0.65 near one. In
/// a strip narrower than both balls it is 1/2, and of a face that both hold whole 0: these look the same to both, however uneven
/// their light.
const LEAST_GROWTH: f64 = 0.6;

/// Those for two balls around a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Corrections {
    pub(crate) wide: Correction,
    pub(crate) narrow: Correction,
    /// True if nothing can hide a part of the surface in them, and the wide one holds enough more of it to tell a bias.
    pub(crate) tells: bool,
}

impl Correction {
    const NONE: Self = Self { constant: 1.0, slope: [0.0; 3] };

    /// Those for two radii, the larger one first, whose ball holds all that the other's does; `None` if both discs are whole, where the plain estimate will do.
    pub(crate) fn pair<P>(
        estimator: Estimator,
        normal: [f32; 3],
        radii: [f64; 2],
        around: &impl Surroundings<P>,
    ) -> Option<Corrections> {
        let kernel = estimator.kernel;
        let ask = |radius| {
            if estimator.area.hides() { around.seen_inside(radius, kernel) } else { around.inside(radius, kernel) }
        };
        let wide = if estimator.area.asks() { ask(radii[0]) } else { None }?;
        let of = |inside: &Inside| Self::new(estimator.area, normal, inside);
        let narrow = ask(radii[1]);
        // Areas in discs of each ball's own.
        let discs = (radii[0] / radii[1]).powi(2);
        let growth = discs * wide.area / narrow.map_or(1.0, |narrow| narrow.area);
        let narrow = narrow.map_or(Self::NONE, |narrow| of(&narrow));
        let tells = wide.open && growth >= discs.powf(LEAST_GROWTH);
        let wide = if estimator.tells_bias { of(&wide) } else { Self::NONE };
        Some(Corrections { wide, narrow, tells })
    }

    /// For a surface of which `inside` is in the ball.
    fn new(area: AreaModel, normal: [f32; 3], inside: &Inside) -> Self {
        let clipped = Self { constant: inside.area.recip(), slope: [0.0; 3] };
        match area {
            AreaModel::Disc | AreaModel::Sphere | AreaModel::Flattened => Self::NONE,
            AreaModel::Clipped | AreaModel::Visible => clipped,
            AreaModel::Linear => Self::linear(normal, inside).unwrap_or(clipped),
        }
    }

    /// The weights of a local linear fit's value at the point: the plane a + b.u over the surface whose moments with the
    /// kernel up to the first are the photons' own. `None` where the surface inside is a point or a line.
    fn linear(normal: [f32; 3], inside: &Inside) -> Option<Self> {
        let axes = tangents(normal.map(f64::from));
        let second = axes.map(|axis| inside.second.map(|row| dot(row, axis)));
        let [x, y] = axes.map(|axis| dot(inside.first, axis));
        let [xx, xy, yy] = [dot(second[0], axes[0]), dot(second[0], axes[1]), dot(second[1], axes[1])];
        // The first row of the inverse of the matrix of moments, by its cofactors.
        let spread = xx * yy - xy * xy;
        let [along_x, along_y] = [y * xy - x * yy, x * xy - y * xx];
        let determinant = inside.area * spread + x * along_x + y * along_y;
        if determinant <= 1e-9 * inside.area * (xx + yy).powi(2) {
            return None;
        }
        let slope = std::array::from_fn(|i| (along_x * axes[0][i] + along_y * axes[1][i]) / determinant);
        Some(Self { constant: spread / determinant, slope })
    }

    /// True if it is the same everywhere.
    #[inline(always)]
    pub(crate) fn is_constant(&self) -> bool {
        self.slope == [0.0; 3]
    }

    /// Its slope over lengths in metres, of a ball of a radius.
    #[inline(always)]
    pub(crate) fn slope_over(&self, radius: f64) -> [f32; 3] {
        self.slope.map(|slope| (slope / radius) as f32)
    }

    /// The factor at an offset in radii.
    #[inline(always)]
    pub(crate) fn at(&self, offset: [f64; 3]) -> f64 {
        self.constant + dot(self.slope, offset)
    }
}

/// What a map must know of the surfaces around a point. It asks its caller, who has the geometry.
pub trait Surroundings<P> {
    /// False if every photon counts in full, whatever [`weigh`](Self::weigh) says.
    fn weighs(&self) -> bool {
        true
    }

    /// How much a photon counts: what passes a coat.
    fn weigh(&self, _photon: &P) -> f64 {
        1.0
    }

    /// What of the surface is in a ball around the point; `None` if it fills the disc, or nothing is known of it.
    fn inside(&self, _radius: f64, _kernel: Kernel) -> Option<Inside> {
        None
    }

    /// The same of what the point sees.
    fn seen_inside(&self, _radius: f64, _kernel: Kernel) -> Option<Inside> {
        None
    }

    /// True if the point sees a photon at a place, metres as the map has them.
    fn is_seen(&self, _position: [f32; 3], _photon: &P) -> bool {
        true
    }
}

/// A flat surface without an end, on which every photon counts in full.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct OpenPlane;

impl<P> Surroundings<P> for OpenPlane {
    fn weighs(&self) -> bool {
        false
    }
}

#[inline(always)]
fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Two unit vectors across a unit normal and each other (Duff et al., "Building an orthonormal basis, revisited", 2017).
fn tangents([x, y, z]: [f64; 3]) -> [[f64; 3]; 2] {
    let sign = 1.0f64.copysign(z);
    let a = -1.0 / (sign + z);
    let b = x * y * a;
    [[1.0 + sign * x * x * a, sign * b, -sign * x], [b, sign + y * y * a, -y]]
}
