//! The nearest points found, and the memory in which they are found.

/// A point found near a query.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Neighbour {
    /// Where the point stands in tree order.
    pub index: usize,
    /// Its [`distance_squared`](crate::distance_squared) to the query, in the square of the coordinates' unit.
    pub distance_squared: f32,
}

/// What [`KdTree::nearest`](crate::KdTree::nearest) found, in memory that the next query reuses.
///
/// The order is that of the walk, which depends on the tree and the query alone, not on the instructions or on
/// earlier queries; [`sort`](Self::sort) puts the nearest first. Consecutive queries that lie close together are
/// faster with the same memory: the last answer bounds the next. They may go to different trees.
#[derive(Clone, Debug, Default)]
pub struct Neighbours {
    pub(crate) candidates: crate::candidates::Candidates,
    /// Children still to open: the bits of the least distance, over the node's number.
    pub(crate) pending: Vec<u64>,
    pub(crate) last: Option<Last>,
}

/// A query with its full answer.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Last {
    pub(crate) query: [f32; 3],
    pub(crate) k: usize,
    pub(crate) farthest_squared: f32,
}

impl Neighbours {
    /// Number of points found.
    pub fn len(&self) -> usize {
        self.candidates.len()
    }

    /// Whether none was found.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Tree indices of the points.
    pub fn indices(&self) -> &[u32] {
        &self.candidates.indices[..self.len()]
    }

    /// Squared distances of the points, in the order of `indices`.
    pub fn distances_squared(&self) -> &[f32] {
        &self.candidates.distances[..self.len()]
    }

    /// The points.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = Neighbour> {
        let pairs = self.indices().iter().zip(self.distances_squared());
        pairs.map(|(&index, &distance_squared)| Neighbour { index: index as usize, distance_squared })
    }

    /// The greatest squared distance: that of the k-th nearest, where k were found.
    pub fn farthest_squared(&self) -> Option<f32> {
        // The bits of floats that are not negative sort as the floats do.
        self.distances_squared().iter().map(|d| d.to_bits()).max().map(f32::from_bits)
    }

    /// The farthest point, of equally far ones that of the highest tree index.
    pub fn farthest(&self) -> Option<Neighbour> {
        self.iter().max_by_key(|found| (found.distance_squared.to_bits(), found.index))
    }

    /// Takes out the [`farthest`](Self::farthest) point; the last one takes its place.
    pub fn pop(&mut self) -> Option<Neighbour> {
        let farthest = (0..self.len()).max_by_key(|&i| self.candidates.key(i))?;
        let (index, distance_squared) = self.candidates.swap_remove(farthest);
        Some(Neighbour { index: index as usize, distance_squared })
    }

    /// Orders by rising distance and, where that is equal, rising tree index. Allocates.
    pub fn sort(&mut self) {
        self.candidates.sort();
    }
}
