//! Nearest points and points in a ball; knows nothing about light.
//!
//! A [`KdTree`] takes points and one payload for each, and answers three questions: which points lie in a closed
//! ball ([`KdTree::within`]), which are the k nearest, of all ([`KdTree::nearest`]) or of those that the caller
//! accepts ([`KdTree::nearest_accepted`]), and which lie near a segment of a line ([`KdTree::near_segment`]). Planes are placed by a [`SplitRule`]. Whatever the rule and the
//! [`Instructions`], every answer equals that of the obvious loop over the points in tree order, bit for bit: the
//! `f32` value that [`distance_squared`] computes decides, rounding, overflow and underflow and all, and of points
//! equally far the first in tree order is nearer. The tree depends on the points and the rule alone, never on the
//! number of threads that built it.
//!
//! Points lie in blocks of sixteen, axis by axis, and nodes hold the tight boxes of up to sixteen children, so
//! that one pass of vector instructions tests a block or a node. The k nearest are appended and selected, without
//! a heap. The tree adds about a seventh to the bytes of 16-byte photons, points and payloads.
//!
//! ```
//! use photonlab_kdtree::{KdTree, Neighbours, SplitRule};
//!
//! let points = vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 3.0, 0.0]];
//! let tree = KdTree::build(points, vec!['a', 'b', 'c'], SplitRule::Median)?;
//!
//! let mut near = String::new();
//! tree.within([0.0; 3], 1.0, |index, _| near.push(tree.payloads()[index]));
//! assert_eq!(near, "ab"); // the ball is closed: 'b' lies on its surface
//!
//! let mut found = Neighbours::default();
//! tree.nearest_accepted([0.0; 3], 2, f32::INFINITY, |&name| name != 'a', &mut found);
//! let farthest = found.pop().unwrap();
//! assert_eq!((tree.payloads()[farthest.index], farthest.distance_squared), ('c', 9.0));
//! # Ok::<(), photonlab_kdtree::BuildError>(())
//! ```

mod accept;
mod ball;
mod batch;
mod binned;
mod block;
mod bounds;
mod branch;
mod candidates;
mod columns;
mod distance;
mod error;
mod grow;
mod lanes;
mod median;
mod nearest;
mod neighbours;
mod node;
mod rank;
mod rule;
mod segment;
mod shape;
mod surface_area;
mod sweep;
mod tree;
mod visit_cost;
mod visits;

pub use ball::VisitBlock;
pub use block::BLOCK;
pub use distance::distance_squared;
pub use error::BuildError;
pub use lanes::Instructions;
pub use neighbours::{Neighbour, Neighbours};
pub use rule::{DEFAULT_LEAF_LIMIT, EmptyCost, SplitRule};
pub use segment::segment_distance_squared;
pub use shape::TreeShape;
pub use tree::KdTree;
pub use visit_cost::{Reach, VisitCost};
pub use visits::Visits;
