//! Seeds of the tests.

/// The variable that moves every test to another set of seeds.
const VARIABLE: &str = "PHOTONLAB_TEST_SEED";

/// The seed of one test: its own number, in the set that the environment asks for (0 unless it does).
///
/// # Panics
/// If the variable is set to something that is no whole number: a test on seeds that nobody asked for proves nothing.
pub fn seed(own: u32) -> u64 {
    let set = std::env::var(VARIABLE).map_or(0, |text| match text.parse::<u32>() {
        Ok(set) => set,
        Err(_) => panic!("{VARIABLE}={text}: not a whole number"),
    });
    u64::from(set) << 32 | u64::from(own)
}
