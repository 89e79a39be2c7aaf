//! nanoflann, in a C++ program of our own that this bench compiles where its header is installed.

use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;

use crate::cases::Case;
use crate::photons::PhotonSet;

/// Seconds by case.
#[derive(Default)]
pub(crate) struct Nanoflann(HashMap<String, f64>);

impl Nanoflann {
    pub(crate) fn seconds(&self, case: &Case) -> f64 {
        self.0.get(&case.key()).copied().unwrap_or(f64::NAN)
    }
}

fn program() -> Option<&'static Path> {
    static PROGRAM: OnceLock<Option<PathBuf>> = OnceLock::new();
    PROGRAM.get_or_init(compile).as_deref()
}

fn compile() -> Option<PathBuf> {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("benches/peers/nanoflann.cpp");
    let program = Path::new(env!("CARGO_TARGET_TMPDIR")).join("peers-nanoflann");
    let flags = ["-O3", "-march=native", "-std=c++17", "-o"];
    let status = Command::new("c++").args(flags).arg(&program).arg(source).status().ok()?;
    status.success().then_some(program)
}

pub(crate) fn is_installed() -> bool {
    program().is_some()
}

/// Every job of `k` and `radius`, asked of a tree of the set.
pub(crate) fn measure(set: &PhotonSet, k: usize, radius: f32, rounds: usize) -> Nanoflann {
    let Some(program) = program() else { return Nanoflann::default() };
    let file = Path::new(env!("CARGO_TARGET_TMPDIR")).join("peers-photons.bin");
    let rows = [&set.points, &set.payload, &set.random, &set.coherent];
    let bytes: Vec<u8> = rows.into_iter().flatten().flatten().flat_map(|value| value.to_ne_bytes()).collect();
    std::fs::write(&file, bytes).expect("the target folder takes files");
    let numbers = [set.points.len(), set.random.len(), set.coherent.len(), k, rounds].map(|n| n.to_string());
    let output = Command::new(program).arg(file).args(numbers).arg(radius.to_string()).output().expect("just compiled");
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    let pair = |line: &str| Some((line.split_once(' ')?.0.into(), line.split_once(' ')?.1.parse().ok()?));
    Nanoflann(text.lines().filter_map(pair).collect())
}
