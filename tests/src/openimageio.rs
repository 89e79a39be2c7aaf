//! OpenImageIO's command line.

use std::{path::Path, process::Command};

/// `idiff` and `oiiotool`.
pub struct OpenImageIo(());

/// What a tool answered.
#[derive(Clone, Debug)]
pub struct Said {
    /// Its exit status.
    pub status: i32,
    /// Both outputs.
    pub text: String,
}

impl OpenImageIo {
    /// The tools, or none: then it is said aloud that `what` was not checked.
    pub fn find(what: &str) -> Option<Self> {
        let works = |tool: &str| Command::new(tool).arg("--help").output().is_ok();
        if works("idiff") && works("oiiotool") {
            return Some(Self(()));
        }
        // Straight to the terminal: the test harness hides what a passing test prints.
        use std::io::Write;
        let _ = writeln!(
            std::io::stderr(),
            "NOT CHECKED: {what} by OpenImageIO: idiff and oiiotool are missing (Debian: openimageio-tools)"
        );
        None
    }

    /// `idiff` over all channels: 0 equal within the threshold, 1 and 2 not, 4 a file is missing.
    pub fn compare(&self, threshold: f64, a: &Path, b: &Path) -> Said {
        let limits = ["-fail", &threshold.to_string(), "-warn", &threshold.to_string()].map(str::to_string);
        run(Command::new("idiff").args(["-v", "-a"]).args(limits).args([a, b]))
    }

    /// The RMS difference as `idiff` prints it.
    pub fn rms_difference(&self, a: &Path, b: &Path) -> f64 {
        let said = self.compare(1e9, a, b);
        let number = said.text.split("RMS error = ").nth(1).and_then(|rest| rest.split_whitespace().next());
        number.and_then(|text| text.parse().ok()).unwrap_or_else(|| panic!("no RMS error in: {}", said.text))
    }

    /// How many samples are NaN, over all channels, by `oiiotool --stats`.
    pub fn nan_count(&self, image: &Path) -> u64 {
        let said = run(Command::new("oiiotool").arg("--stats").arg(image));
        let line = said.text.lines().find_map(|line| line.split("Stats NanCount:").nth(1));
        let line = line.unwrap_or_else(|| panic!("no NanCount in: {}", said.text));
        line.split_whitespace().filter_map(|word| word.parse::<u64>().ok()).sum()
    }
}

fn run(command: &mut Command) -> Said {
    let output = command.output().expect("the tool was found before");
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    Said { status: output.status.code().unwrap_or(-1), text: text(&output.stdout) + &text(&output.stderr) }
}
