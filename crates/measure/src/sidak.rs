//! Many comparisons, one false-alarm rate.

/// The level of each of `comparisons` independent tests so that all together raise a false alarm with probability
/// `family_level` (Sidak 1967): 1 - (1 - family)^(1/m). Conservative for positively dependent tests.
///
/// # Panics
///
/// If `family_level` is outside (0, 1) or there are no comparisons.
pub fn sidak_level(family_level: f64, comparisons: usize) -> f64 {
    assert!(family_level > 0.0 && family_level < 1.0, "a level lies strictly between 0 and 1, not {family_level}");
    assert!(comparisons > 0, "without comparisons there is no level");
    -((-family_level).ln_1p() / comparisons as f64).exp_m1()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_together_raise_the_family_rate() {
        assert!((sidak_level(0.05, 1) - 0.05).abs() < 1e-16);
        let each = sidak_level(1e-4, 53);
        assert!((1.0 - (1.0 - each).powi(53) - 1e-4).abs() < 1e-15);
        assert!(each > 1e-4 / 53.0); // a little above Bonferroni
    }
}
