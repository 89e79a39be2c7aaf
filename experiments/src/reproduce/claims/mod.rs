//! The claims, one file each.

mod even_noise;
mod figure_1;
mod final_gather_rays;
mod fixed_noisier;
mod knn_bias;
mod sphere_area;
mod view_independence;

use photonlab_measure::Record;

use super::context::Context;

/// A claim of the paper that can be put to the test.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Claim {
    SphereArea,
    KnnBias,
    EvenNoise,
    FixedNoisier,
    FinalGatherRays,
    ViewIndependence,
    Figure1,
}

impl Claim {
    /// Every claim, in the order of the report.
    pub(super) const ALL: [Claim; 7] = [
        Claim::SphereArea,
        Claim::KnnBias,
        Claim::EvenNoise,
        Claim::FixedNoisier,
        Claim::FinalGatherRays,
        Claim::ViewIndependence,
        Claim::Figure1,
    ];

    /// The claim's name everywhere.
    pub(super) fn id(self) -> &'static str {
        match self {
            Claim::SphereArea => "sphere-area",
            Claim::KnnBias => "knn-bias",
            Claim::EvenNoise => "even-noise",
            Claim::FixedNoisier => "fixed-noisier",
            Claim::FinalGatherRays => "final-gather-rays",
            Claim::ViewIndependence => "view-independence",
            Claim::Figure1 => "figure-1",
        }
    }

    /// The text of its definition file.
    pub(super) fn definition(self) -> &'static str {
        match self {
            Claim::SphereArea => include_str!("../../../definitions/sphere-area.toml"),
            Claim::KnnBias => include_str!("../../../definitions/knn-bias.toml"),
            Claim::EvenNoise => include_str!("../../../definitions/even-noise.toml"),
            Claim::FixedNoisier => include_str!("../../../definitions/fixed-noisier.toml"),
            Claim::FinalGatherRays => include_str!("../../../definitions/final-gather-rays.toml"),
            Claim::ViewIndependence => include_str!("../../../definitions/view-independence.toml"),
            Claim::Figure1 => include_str!("../../../definitions/figure-1.toml"),
        }
    }

    /// Runs its experiment.
    pub(super) fn run(self, context: &Context) -> anyhow::Result<Record> {
        match self {
            Claim::SphereArea => sphere_area::run(context),
            Claim::KnnBias => knn_bias::run(context),
            Claim::EvenNoise => even_noise::run(context),
            Claim::FixedNoisier => fixed_noisier::run(context),
            Claim::FinalGatherRays => final_gather_rays::run(context),
            Claim::ViewIndependence => view_independence::run(context),
            Claim::Figure1 => figure_1::run(context),
        }
    }
}
