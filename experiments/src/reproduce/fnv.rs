//! A hash that parts scenes.

/// FNV-1a in 64 bits: the same on every machine, and beyond anyone's wishes.
pub(super) fn fnv1a(text: &str) -> u64 {
    text.bytes().fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x100_0000_01b3))
}
