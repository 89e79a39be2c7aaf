//! CPU time of this process: a build runs on a thread of its pool, and while anything is timed no other thread works.

/// Seconds of CPU time that `work` takes, and its result.
pub(crate) fn time<T>(work: impl FnOnce() -> T) -> (f64, T) {
    let start = now();
    let result = std::hint::black_box(work());
    (now() - start, result)
}

#[allow(unsafe_code)] // The standard library has no CPU clock.
fn now() -> f64 {
    let mut at = libc::timespec { tv_sec: 0, tv_nsec: 0 };
    // SAFETY: the call writes one `timespec`, which `at` is.
    unsafe { libc::clock_gettime(libc::CLOCK_PROCESS_CPUTIME_ID, &mut at) };
    at.tv_sec as f64 + 1e-9 * at.tv_nsec as f64
}
