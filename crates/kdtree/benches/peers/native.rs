//! kiddo with native flags: this bench again, compiled so, in a target folder of its own.

use std::collections::HashMap;
use std::process::Command;

use photonlab_kdtree::SplitRule;

use crate::cases::{Case, cases, typical_radius};
use crate::photons::PhotonSet;
use crate::{clock, kiddo::Kiddo, ours::Ours, race};

const CHILD: &str = "PEERS_CHILD";

/// Seconds by case.
#[derive(Default)]
pub(crate) struct Native(HashMap<String, f64>);

impl Native {
    pub(crate) fn build(&self, set: &str) -> f64 {
        self.0.get(&format!("{set} build")).copied().unwrap_or(f64::NAN)
    }

    pub(crate) fn seconds(&self, set: &str, case: &Case) -> f64 {
        self.0.get(&format!("{set} {}", case.key())).copied().unwrap_or(f64::NAN)
    }
}

pub(crate) fn is_child() -> bool {
    std::env::var_os(CHILD).is_some()
}

/// Runs the child and reads its lines `set case seconds`.
pub(crate) fn ask() -> Native {
    if std::env::var("PEERS_NATIVE").is_ok_and(|value| value == "off") {
        println!("kiddo with native flags: NOT CHECKED (switched off)");
        return Native::default();
    }
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let target = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("peers-native");
    let output = Command::new(cargo)
        .args(["bench", "--quiet", "--package", "photonlab-kdtree", "--bench", "peers"])
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .env("RUSTFLAGS", "-Ctarget-cpu=native")
        .env("CARGO_TARGET_DIR", target)
        .env(CHILD, "1")
        .output();
    match output {
        Ok(output) if output.status.success() => {
            let text = String::from_utf8_lossy(&output.stdout).into_owned();
            Native(text.lines().filter_map(|l| l.rsplit_once(' ')).filter_map(pair).collect())
        }
        Ok(output) => {
            println!("kiddo with native flags: NOT CHECKED ({})", String::from_utf8_lossy(&output.stderr));
            Native::default()
        }
        Err(error) => {
            println!("kiddo with native flags: NOT CHECKED ({error})");
            Native::default()
        }
    }
}

fn pair((key, seconds): (&str, &str)) -> Option<(String, f64)> {
    Some((key.into(), seconds.parse().ok()?))
}

/// The child's part.
pub(crate) fn answer(sets: &[PhotonSet], rounds: usize) {
    for set in sets {
        let build = (0..rounds).map(|_| clock::time(|| Kiddo::build(set)).0).fold(f64::INFINITY, f64::min);
        println!("{} build {build}", set.name);
        let ours = Ours::build(set, SplitRule::default());
        let mut kiddo = Kiddo::build(set);
        for k in [50, 100, 200] {
            for case in cases(k, typical_radius(&ours, set, k)) {
                println!("{} {} {}", set.name, case.key(), race(&mut [&mut kiddo], &case, set, rounds)[0]);
            }
        }
    }
}
