//! Trees against the obvious loop, and against themselves.

mod adversarial;
mod brute_force;
mod doors;
mod linear;
mod obvious;
mod segment;
mod threads;
