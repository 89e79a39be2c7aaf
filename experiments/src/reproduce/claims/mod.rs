//! The claims, one file each.

mod billions;
mod catalogue;
mod caustics;
mod convergence;
mod cost;
mod coverage;
mod edge_darkening;
mod even_noise;
mod figure_1;
mod final_gather_edges;
mod final_gather_rays;
mod fine_detail;
mod fixed_noisier;
mod gather_aids;
mod illuminance_maps;
mod interior;
mod irradiance_cache;
mod kd_memory;
mod knn_bias;
mod needs;
mod planner;
mod range_search;
mod rendering_equation;
mod speed_accuracy;
mod sphere_area;
mod split_cost;
mod split_quadratic;
mod stop_rule;
mod tested_radii;
mod view_independence;

use photonlab_measure::Record;

use super::{atlas, context::Context};

/// A claim of the paper that can be put to the test.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Claim {
    SphereArea,
    KnnBias,
    EvenNoise,
    FixedNoisier,
    EdgeDarkening,
    FinalGatherEdges,
    FinalGatherRays,
    Billions,
    SplitCost,
    SplitQuadratic,
    StopRule,
    RangeSearch,
    KdMemory,
    ViewIndependence,
    Interior,
    IrradianceCache,
    Caustics,
    FineDetail,
    RenderingEquation,
    Figure1,
    Catalogue,
    Atlas,
    Coverage,
    Convergence,
    Cost,
    GatherAids,
    TestedRadii,
    Needs,
    Planner,
    SpeedAccuracy,
    IlluminanceMaps,
}

impl Claim {
    /// Every claim of the paper, in the order of the report. The catalogue, the atlas, the coverage, the convergence, the cost, the gather aids, the tested radii, the
    /// needs, the planner, the speeds and the illuminance maps are run when they are asked for.
    pub(super) const ALL: [Claim; 20] = [
        Claim::SphereArea,
        Claim::KnnBias,
        Claim::EvenNoise,
        Claim::FixedNoisier,
        Claim::EdgeDarkening,
        Claim::FinalGatherEdges,
        Claim::FinalGatherRays,
        Claim::Billions,
        Claim::SplitCost,
        Claim::SplitQuadratic,
        Claim::StopRule,
        Claim::RangeSearch,
        Claim::KdMemory,
        Claim::ViewIndependence,
        Claim::Interior,
        Claim::IrradianceCache,
        Claim::Caustics,
        Claim::FineDetail,
        Claim::RenderingEquation,
        Claim::Figure1,
    ];

    /// The claim's name everywhere.
    pub(super) fn id(self) -> &'static str {
        match self {
            Claim::SphereArea => "sphere-area",
            Claim::KnnBias => "knn-bias",
            Claim::EvenNoise => "even-noise",
            Claim::FixedNoisier => "fixed-noisier",
            Claim::EdgeDarkening => "edge-darkening",
            Claim::FinalGatherEdges => "final-gather-edges",
            Claim::FinalGatherRays => "final-gather-rays",
            Claim::Billions => "billions",
            Claim::SplitCost => "split-cost",
            Claim::SplitQuadratic => "split-quadratic",
            Claim::StopRule => "stop-rule",
            Claim::RangeSearch => "range-search",
            Claim::KdMemory => "kd-memory",
            Claim::ViewIndependence => "view-independence",
            Claim::Interior => "interior",
            Claim::IrradianceCache => "irradiance-cache",
            Claim::Caustics => "caustics",
            Claim::FineDetail => "fine-detail",
            Claim::RenderingEquation => "rendering-equation",
            Claim::Figure1 => "figure-1",
            Claim::Catalogue => "catalogue",
            Claim::Coverage => "coverage",
            Claim::Convergence => "convergence",
            Claim::Atlas => "atlas",
            Claim::Cost => "cost",
            Claim::GatherAids => "gather-aids",
            Claim::TestedRadii => "tested-radii",
            Claim::Needs => "needs",
            Claim::Planner => "planner",
            Claim::SpeedAccuracy => "speed-accuracy",
            Claim::IlluminanceMaps => "illuminance-maps",
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
            Claim::FinalGatherEdges => include_str!("../../../definitions/final-gather-edges.toml"),
            Claim::FinalGatherRays => include_str!("../../../definitions/final-gather-rays.toml"),
            Claim::Billions => include_str!("../../../definitions/billions.toml"),
            Claim::SplitCost => include_str!("../../../definitions/split-cost.toml"),
            Claim::SplitQuadratic => include_str!("../../../definitions/split-quadratic.toml"),
            Claim::StopRule => include_str!("../../../definitions/stop-rule.toml"),
            Claim::RangeSearch => include_str!("../../../definitions/range-search.toml"),
            Claim::KdMemory => include_str!("../../../definitions/kd-memory.toml"),
            Claim::ViewIndependence => include_str!("../../../definitions/view-independence.toml"),
            Claim::Interior => include_str!("../../../definitions/interior.toml"),
            Claim::IrradianceCache => include_str!("../../../definitions/irradiance-cache.toml"),
            Claim::Caustics => include_str!("../../../definitions/caustics.toml"),
            Claim::FineDetail => include_str!("../../../definitions/fine-detail.toml"),
            Claim::RenderingEquation => include_str!("../../../definitions/rendering-equation.toml"),
            Claim::Figure1 => include_str!("../../../definitions/figure-1.toml"),
            Claim::Catalogue => include_str!("../../../definitions/catalogue.toml"),
            Claim::Coverage => include_str!("../../../definitions/coverage.toml"),
            Claim::Convergence => include_str!("../../../definitions/convergence.toml"),
            Claim::Atlas => include_str!("../../../definitions/atlas.toml"),
            Claim::Cost => include_str!("../../../definitions/cost.toml"),
            Claim::GatherAids => include_str!("../../../definitions/gather-aids.toml"),
            Claim::TestedRadii => include_str!("../../../definitions/tested-radii.toml"),
            Claim::Needs => include_str!("../../../definitions/needs.toml"),
            Claim::Planner => include_str!("../../../definitions/planner.toml"),
            Claim::SpeedAccuracy => include_str!("../../../definitions/speed-accuracy.toml"),
            Claim::IlluminanceMaps => include_str!("../../../definitions/illuminance-maps.toml"),
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
            Claim::FinalGatherEdges => final_gather_edges::run(context),
            Claim::FinalGatherRays => final_gather_rays::run(context),
            Claim::Billions => billions::run(context),
            Claim::SplitCost => split_cost::run(context),
            Claim::SplitQuadratic => split_quadratic::run(context),
            Claim::StopRule => stop_rule::run(context),
            Claim::RangeSearch => range_search::run(context),
            Claim::KdMemory => kd_memory::run(context),
            Claim::ViewIndependence => view_independence::run(context),
            Claim::Interior => interior::run(context),
            Claim::IrradianceCache => irradiance_cache::run(context),
            Claim::Caustics => caustics::run(context),
            Claim::FineDetail => fine_detail::run(context),
            Claim::RenderingEquation => rendering_equation::run(context),
            Claim::Figure1 => figure_1::run(context),
            Claim::Catalogue => catalogue::run(context),
            Claim::Coverage => coverage::run(context),
            Claim::Convergence => convergence::run(context),
            Claim::Atlas => atlas::run(context),
            Claim::Cost => cost::run(context),
            Claim::GatherAids => gather_aids::run(context),
            Claim::TestedRadii => tested_radii::run(context),
            Claim::Needs => needs::run(context),
            Claim::Planner => planner::run(context),
            Claim::SpeedAccuracy => speed_accuracy::run(context),
            Claim::IlluminanceMaps => illuminance_maps::run(context),
        }
    }
}
