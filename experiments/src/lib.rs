//! The command `photonlab`: renders, measures, and puts one paper's claims to the test.
//!
//! Every verb has a file. [`run`] is the whole program; the binary only calls it.
#![forbid(unsafe_code)]

#[macro_use]
mod say;

mod canvas;
mod certificate;
mod chart;
mod chart_reference;
mod chosen;
mod command;
mod cpu_clock;
mod exr_header;
mod failure;
mod false_colour;
mod fixed_command;
mod goniometer;
mod illuminance_map;
mod image;
mod interrupt;
mod isolux;
mod ladder;
mod levels;
mod line_labels;
mod loaded;
mod map;
mod measure;
mod number;
mod plan;
mod planned;
mod progress;
mod reads;
mod render;
mod reproduce;
mod system;

use std::{ffi::OsString, process::ExitCode};

use clap::Parser;

use command::{Command, Photonlab};
pub use failure::Failure;

/// Runs the program on command-line arguments, the program's name first.
pub fn run(arguments: impl IntoIterator<Item = OsString>) -> ExitCode {
    let parsed = match Photonlab::try_parse_from(arguments) {
        Ok(parsed) => parsed,
        Err(error) => {
            // Help and version go to standard output with status 0, everything else to standard error with status 2.
            let _ = error.print();
            return ExitCode::from(if error.use_stderr() { 2 } else { 0 });
        }
    };
    interrupt::install();
    let result = match parsed.command {
        Command::Measure(arguments) => measure::measure(&arguments),
        Command::Reproduce(arguments) => reproduce::reproduce(&arguments),
        Command::Render(arguments) => render::render(&arguments),
        Command::Plan(arguments) => plan::plan(&arguments),
        Command::Chart(arguments) => chart::chart(&arguments),
        Command::Map(arguments) => map::map(&arguments),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            say!("{failure}");
            failure.status()
        }
    }
}
