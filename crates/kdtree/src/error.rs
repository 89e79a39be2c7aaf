//! Why a tree cannot be built.

/// Input from which no tree can be built.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum BuildError {
    /// A coordinate is infinite or not a number.
    #[error("point {index} has a coordinate that is not finite")]
    NonFinite {
        /// Where the first such point stands in the order given to `build`.
        index: usize,
    },
    /// There must be one payload for each point.
    #[error("{points} points but {payload} payloads")]
    LengthMismatch {
        /// Number of points given.
        points: usize,
        /// Number of payloads given.
        payload: usize,
    },
    /// Indices are stored in 32 bits; a tree holds at most 2^31 points.
    #[error("{points} points, but a tree holds at most 2147483648")]
    TooMany {
        /// Number of points given.
        points: usize,
    },
    /// The cost of an empty node must be zero or more; infinity is allowed and means "never split".
    #[error("the cost of an empty node is {cost}, which is negative or not a number")]
    EmptyCost {
        /// The cost given.
        cost: f64,
    },
    /// The radius of the queries to come must be zero or more, and finite.
    #[error("the radius of the queries to come is {radius}")]
    Reach {
        /// The radius given.
        radius: f32,
    },
}
