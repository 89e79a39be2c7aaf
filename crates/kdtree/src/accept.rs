//! Which points count in a query.

/// Says which points count.
pub(crate) trait Accept {
    /// The bits of `mask` whose points count; bit i is that of tree index `first + i`.
    fn ask(&mut self, first: usize, mask: u16) -> u16;
}

/// Every point counts.
pub(crate) struct All;

impl Accept for All {
    #[inline(always)]
    fn ask(&mut self, _: usize, mask: u16) -> u16 {
        mask
    }
}

/// The caller is asked about a block's points together.
pub(crate) struct InBlocks<A>(pub(crate) A);

impl<A: FnMut(usize, u16) -> u16> Accept for InBlocks<A> {
    #[inline(always)]
    fn ask(&mut self, first: usize, mask: u16) -> u16 {
        if mask == 0 { 0 } else { (self.0)(first, mask) & mask }
    }
}

/// The caller is asked about each.
pub(crate) struct Asked<'a, P, A>(pub(crate) &'a [P], pub(crate) A);

impl<P, A: FnMut(&P) -> bool> Accept for Asked<'_, P, A> {
    #[inline(always)]
    fn ask(&mut self, first: usize, mask: u16) -> u16 {
        let (mut left, mut accepted) = (mask, 0);
        while left != 0 {
            let lane = left.trailing_zeros();
            accepted |= u16::from((self.1)(&self.0[first + lane as usize])) << lane;
            left &= left - 1;
        }
        accepted
    }
}
