//! Runs every mutant: copies the tree, makes one change at a time, and asks the test that it names, on five sets of seeds.
//!
//! `cargo run --release -p photonlab-tests --bin mutants [NAME...]`; status 1 if a mutant survives, cannot be made or
//! does not compile, or if a named test fails on the unchanged tree.
#![forbid(unsafe_code)]

use std::{
    fs,
    path::{Path, PathBuf},
    process::{Command, ExitCode, Output},
    time::Instant,
};

use anyhow::{Context, Result, bail};
use photonlab_tests::Mutant;

/// Sets of seeds on which a test must notice its mutant.
const SEEDS: u32 = 5;

fn main() -> Result<ExitCode> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..").canonicalize()?;
    let wanted: Vec<String> = std::env::args().skip(1).collect();
    let mut mutants = Mutant::all(&root.join("tests/mutants")).map_err(|error| anyhow::anyhow!("{error}"))?;
    mutants.retain(|mutant| wanted.is_empty() || wanted.contains(&mutant.name));
    if mutants.is_empty() {
        bail!("no mutant of that name");
    }
    let copy = tempfile::tempdir()?;
    let bench = Bench { tree: copy.path().join("photonlab"), target: root.join("target/mutants") };
    copy_tree(&root, &bench.tree)?;
    let mut sound = bench.check_unchanged(&mutants)?;
    for mutant in &mutants {
        let start = Instant::now();
        let verdict = bench.try_out(mutant)?;
        let killed = verdict == Verdict::Killed;
        sound &= killed;
        println!("{:<9} {:<32} {:>4.0} s  {}", verdict.word(), mutant.name, start.elapsed().as_secs_f64(), mutant.what);
    }
    Ok(if sound { ExitCode::SUCCESS } else { ExitCode::from(1) })
}

#[derive(Clone, Debug, PartialEq, Eq)]
enum Verdict {
    /// Its test failed on every set of seeds.
    Killed,
    /// Its test passed on this set of seeds.
    Survived(u32),
    /// It could not be made or compiled.
    Broken(String),
}

impl Verdict {
    fn word(&self) -> String {
        match self {
            Verdict::Killed => "killed".into(),
            Verdict::Survived(seeds) => format!("survived (seeds {seeds})"),
            Verdict::Broken(what) => format!("broken: {what}"),
        }
    }
}

/// A copy of the tree and the folder that its builds share.
struct Bench {
    tree: PathBuf,
    target: PathBuf,
}

impl Bench {
    /// The named tests must pass before any change, or their failing means nothing.
    fn check_unchanged(&self, mutants: &[Mutant]) -> Result<bool> {
        let mut tests: Vec<_> = mutants.iter().map(|m| (m.test_file.as_str(), m.test.as_str())).collect();
        tests.sort_unstable();
        tests.dedup();
        let mut sound = true;
        for (file, test) in tests {
            self.build(file).with_context(|| format!("the unchanged test {file} does not build"))?;
            for seeds in 0..SEEDS {
                let said = self.test(file, test, seeds)?;
                if !said.status.success() {
                    println!("failed    {file} {test} on the unchanged tree (seeds {seeds})\n{}", text(&said));
                    sound = false;
                }
            }
        }
        Ok(sound)
    }

    fn try_out(&self, mutant: &Mutant) -> Result<Verdict> {
        let before = match mutant.apply(&self.tree) {
            Ok(before) => before,
            Err(error) => return Ok(Verdict::Broken(error.to_string())),
        };
        let verdict = self.verdict(mutant);
        for (file, text) in before {
            fs::write(self.tree.join(file), text)?;
        }
        verdict
    }

    fn verdict(&self, mutant: &Mutant) -> Result<Verdict> {
        if let Err(error) = self.build(&mutant.test_file) {
            return Ok(Verdict::Broken(format!("{error:#}")));
        }
        for seeds in 0..SEEDS {
            if self.test(&mutant.test_file, &mutant.test, seeds)?.status.success() {
                return Ok(Verdict::Survived(seeds));
            }
        }
        Ok(Verdict::Killed)
    }

    fn build(&self, file: &str) -> Result<()> {
        let said = self.cargo(file).arg("--no-run").output()?;
        if said.status.success() { Ok(()) } else { bail!("{}", text(&said)) }
    }

    /// Runs one test by its exact name; a name that no test has is an error, since it would pass without a look.
    fn test(&self, file: &str, test: &str, seeds: u32) -> Result<Output> {
        let mut command = self.cargo(file);
        let said = command.args(["--", "--exact", test]).env("PHOTONLAB_TEST_SEED", seeds.to_string()).output()?;
        if !text(&said).contains("running 1 test") {
            bail!("{file} has no test {test}:\n{}", text(&said));
        }
        Ok(said)
    }

    /// True if a test needs the command built, which takes most of the time of a build.
    fn runs_the_program(&self, file: &str) -> bool {
        let source = self.tree.join("tests/tests").join(file).with_extension("rs");
        fs::read_to_string(source).is_ok_and(|text| text.contains("photonlab-under-test"))
    }

    fn cargo(&self, file: &str) -> Command {
        let mut command = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
        command.current_dir(&self.tree).env("CARGO_TARGET_DIR", &self.target);
        // One line changes from build to build: what it does not reach is kept, which takes a tenth of the time.
        for (setting, value) in [("INCREMENTAL", "true"), ("CODEGEN_UNITS", "64"), ("DEBUG", "0")] {
            command.env(format!("CARGO_PROFILE_RELEASE_{setting}"), value);
        }
        command.args(["test", "--release", "--quiet", "-p", "photonlab-tests", "--test", file]);
        if !self.runs_the_program(file) {
            command.arg("--no-default-features");
        }
        command
    }
}

fn text(said: &Output) -> String {
    String::from_utf8_lossy(&said.stdout).into_owned() + &String::from_utf8_lossy(&said.stderr)
}

/// Copies what git knows or would know, so that no build output travels along.
fn copy_tree(from: &Path, to: &Path) -> Result<()> {
    let listed = Command::new("git")
        .args(["ls-files", "-z", "--cached", "--others", "--exclude-standard"])
        .current_dir(from)
        .output()
        .context("git lists the files of the tree")?;
    if !listed.status.success() {
        bail!("git ls-files: {}", text(&listed));
    }
    for name in String::from_utf8(listed.stdout)?.split_terminator('\0') {
        let (source, copy) = (from.join(name), to.join(name));
        if source.is_file() {
            fs::create_dir_all(copy.parent().unwrap_or(to))?;
            fs::copy(&source, &copy).with_context(|| format!("copying {name}"))?;
        }
    }
    Ok(())
}
