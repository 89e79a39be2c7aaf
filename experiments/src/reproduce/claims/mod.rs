//! The claims, one file each.

mod edge_darkening;
mod even_noise;
mod fixed_noisier;
mod knn_bias;
mod rendering_equation;
mod sphere_area;

use photonlab_measure::Record;

use super::context::Context;

/// A claim of the paper that can be put to the test.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Claim {
    SphereArea,
    KnnBias,
    EvenNoise,
    FixedNoisier,
    EdgeDarkening,
    RenderingEquation,
}

impl Claim {
    /// Every claim, in the order of the report.
    pub(super) const ALL: [Claim; 6] = [
        Claim::SphereArea,
        Claim::KnnBias,
        Claim::EvenNoise,
        Claim::FixedNoisier,
        Claim::EdgeDarkening,
        Claim::RenderingEquation,
    ];

    /// The claim's name everywhere.
    pub(super) fn id(self) -> &'static str {
        match self {
            Claim::SphereArea => "sphere-area",
            Claim::KnnBias => "knn-bias",
            Claim::EvenNoise => "even-noise",
            Claim::FixedNoisier => "fixed-noisier",
            Claim::EdgeDarkening => "edge-darkening",
            Claim::RenderingEquation => "rendering-equation",
        }
    }

    /// The text of its definition file.
    pub(super) fn definition(self) -> &'static str {
        match self {
            Claim::SphereArea => include_str!("../../../definitions/sphere-area.toml"),
            Claim::KnnBias => include_str!("../../../definitions/knn-bias.toml"),
            Claim::EvenNoise => include_str!("../../../definitions/even-noise.toml"),
            Claim::FixedNoisier => include_str!("../../../definitions/fixed-noisier.toml"),
            Claim::EdgeDarkening => include_str!("../../../definitions/edge-darkening.toml"),
            Claim::RenderingEquation => include_str!("../../../definitions/rendering-equation.toml"),
        }
    }

    /// Runs its experiment.
    pub(super) fn run(self, context: &Context) -> anyhow::Result<Record> {
        match self {
            Claim::SphereArea => sphere_area::run(context),
            Claim::KnnBias => knn_bias::run(context),
            Claim::EvenNoise => even_noise::run(context),
            Claim::FixedNoisier => fixed_noisier::run(context),
            Claim::EdgeDarkening => edge_darkening::run(context),
            Claim::RenderingEquation => rendering_equation::run(context),
        }
    }
}
