//! The command `photonlab`; see the README for its uses.
#![forbid(unsafe_code)]

fn main() -> std::process::ExitCode {
    photonlab::run(std::env::args_os())
}
