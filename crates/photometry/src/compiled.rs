//! Code compiled once for every number of channels, in the crate that it belongs to.

use std::any::Any;

/// Of implementations for each number of channels, the one whose type is `T`, such as `&'static dyn Tracer<C>`.
///
/// A function over `const C: usize` is compiled again in every crate that calls it. One that only looks up a trait object
/// here is compiled where its implementations stand.
///
/// # Panics
/// If none of them is of that type: `C` is no number of [`crate::Channels`].
pub fn compiled<T: Copy + 'static>(all: &[&'static dyn Any]) -> T {
    let found = all.iter().find_map(|one| one.downcast_ref::<T>()).copied();
    found.expect("light has one, three or WAVELENGTHS channels")
}
