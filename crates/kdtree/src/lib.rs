//! Nearest points and points in a ball; knows nothing about light.
//!
//! A [`KdTree`] takes points and one payload for each, and answers two questions: which points lie in a closed
//! ball ([`KdTree::within`]) and which are the k nearest that the caller accepts ([`KdTree::nearest`]). Planes
//! are placed by a [`SplitRule`]: the median, or the surface-area cost of the paper's eq. 2. Whatever the rule,
//! every answer equals that of the obvious loop over all points, bit for bit, ties included: the `f32` value
//! that [`distance_squared`] computes decides, rounding, overflow and underflow and all. The tree depends on the
//! points and the rule alone, never on the number of threads that built it.
//!
//! ```
//! use photonlab_kdtree::{KdTree, SplitRule};
//!
//! let points = vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 3.0, 0.0]];
//! let tree = KdTree::build(points, vec!['a', 'b', 'c'], SplitRule::Median)?;
//!
//! let mut near = String::new();
//! tree.within([0.0; 3], 1.0, |index, _| near.push(tree.payloads()[index]));
//! assert_eq!(near, "ab"); // the ball is closed: 'b' lies on its surface
//!
//! let mut found = Vec::new();
//! tree.nearest([0.0; 3], 2, f32::INFINITY, |&name| name != 'a', &mut found);
//! assert_eq!(tree.original_index(found[1].index), 2);
//! assert_eq!(found[1].distance_squared, 9.0);
//! # Ok::<(), photonlab_kdtree::BuildError>(())
//! ```

#![forbid(unsafe_code)]

mod ball;
mod bounds;
mod branch;
mod distance;
mod error;
mod median;
mod nearest;
mod node;
mod rule;
mod shape;
mod surface_area;
mod sweep;
mod tree;
mod visits;
mod walk;

pub use distance::distance_squared;
pub use error::BuildError;
pub use nearest::Neighbour;
pub use rule::{DEFAULT_LEAF_LIMIT, EmptyCost, SplitRule};
pub use shape::TreeShape;
pub use tree::KdTree;
pub use visits::Visits;
