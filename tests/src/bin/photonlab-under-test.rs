//! The program that the whole-program tests run: the command `photonlab`, line for line what `experiments/src/main.rs` is.
//! It is built here as well because cargo hands tests the path of a binary of their own package alone; one found by
//! searching a folder may be an old one.
#![forbid(unsafe_code)]

fn main() -> std::process::ExitCode {
    photonlab::run(std::env::args_os())
}
