//! What a query cost, for experiments.

/// Nodes opened and points tested by one query.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Visits {
    /// Nodes opened, leaves included. A node whose box was tested and found out of reach is not counted.
    pub nodes: usize,
    /// Leaves among the nodes opened.
    pub leaves: usize,
    /// Points whose distance was computed.
    pub points: usize,
}

/// Is told of each node that a walk opens.
pub(crate) trait Meter {
    fn inner(&mut self);
    fn leaf(&mut self, points: usize);
}

/// Counts nothing, at no cost.
pub(crate) struct Unmetered;

impl Meter for Unmetered {
    #[inline]
    fn inner(&mut self) {}

    #[inline]
    fn leaf(&mut self, _points: usize) {}
}

impl Meter for Visits {
    fn inner(&mut self) {
        self.nodes += 1;
    }

    fn leaf(&mut self, points: usize) {
        self.nodes += 1;
        self.leaves += 1;
        self.points += points;
    }
}
