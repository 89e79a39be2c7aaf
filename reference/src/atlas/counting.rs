//! Light that is counted twice or not at all, and photons drawn anew.

/// Reading, over its own irradiance, of one side of a thin sheet whose other side has `ratio` times as much, if photons of both
/// sides count: `1 + ratio`.
pub fn both_sides(ratio: f64) -> f64 {
    1.0 + ratio
}

/// Reading where the share `direct` of the light is direct and counted twice, sampled and from the map: `1 + direct`.
pub fn direct_twice(direct: f64) -> f64 {
    1.0 + direct
}

/// Reading where it is counted neither sampled nor from the map: `1 - direct`.
pub fn direct_left_out(direct: f64) -> f64 {
    1.0 - direct
}

/// Share of photons that differ from those of one thread if each of `threads` threads draws an equal part of them from a stream of its own:
/// all but the first one's, `1 - 1 / threads`.
pub fn thread_bound(threads: f64) -> f64 {
    1.0 - 1.0 / threads
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Sums by hand.
    #[test]
    fn sums_are_sums() {
        let (direct, indirect) = (0.75, 0.25);
        assert_eq!(direct_twice(direct), 2.0 * direct + indirect);
        assert_eq!(direct_left_out(direct), indirect);
        assert_eq!(both_sides(9.0) * 0.1, 0.1 + 0.9);
        assert_eq!((thread_bound(1.0), thread_bound(4.0)), (0.0, 0.75));
    }
}
