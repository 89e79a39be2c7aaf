//! Words on standard error.

/// Says something on standard error; that nobody can hear it (a full disk, a closed pipe) must not end a run.
macro_rules! say {
    ($($argument:tt)*) => {{
        use std::io::Write as _;
        let _ = writeln!(std::io::stderr(), $($argument)*);
    }};
}
