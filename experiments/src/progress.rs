//! A progress bar on standard error.

use std::{
    io::{IsTerminal, stderr},
    time::Duration,
};

use indicatif::{ProgressBar, ProgressStyle};
use photonlab_readout::{Ends, Observer};

/// Shows passes, time and error while a run goes on; silent unless standard error is a terminal.
pub(crate) struct Progress {
    bar: ProgressBar,
    target: Option<f64>,
}

impl Progress {
    pub(crate) fn new(ends: &Ends) -> Self {
        let bar = match (stderr().is_terminal(), ends.passes) {
            (false, _) => ProgressBar::hidden(),
            (true, Some(passes)) => ProgressBar::new(passes),
            (true, None) => ProgressBar::new_spinner(),
        };
        let style = "{elapsed_precise} {wide_bar} pass {pos} {msg}";
        bar.set_style(ProgressStyle::with_template(style).unwrap_or_else(|_| ProgressStyle::default_bar()));
        Self { bar, target: ends.target_error }
    }
}

impl Observer for Progress {
    fn pass_done(&self, passes: u64, _elapsed: Duration, error: Option<f64>) {
        self.bar.set_position(passes);
        if let Some(error) = error {
            let wanted = self.target.map_or(String::new(), |target| format!(" (wanted {:.3} %)", 100.0 * target));
            self.bar.set_message(format!("error {:.3} %{wanted}", 100.0 * error));
        }
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}
