//! Trees against the obvious loop, and against themselves.

mod adversarial;
mod brute_force;
mod obvious;
mod threads;
