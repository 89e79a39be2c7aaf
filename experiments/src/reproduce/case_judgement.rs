//! Readings of scenes with known answers against those answers, and how many came out how.

use photonlab_measure::{Comparison, Expected, Interval, Row, normal_quantile};
use photonlab_reference::catalogue::{Case, Entry, Expected as Answer, Reads};

use super::{
    case_charts::CaseCharts,
    case_reading::{Attempt, CONFIDENCE, MeterReadings, Rule},
    context::Findings,
    lab::Lab,
};

/// Share of an answer that rounding may cost in sums of millions of terms.
const ROUNDING: f64 = 1e-9;

/// How many readings came out how.
#[derive(Default)]
pub(super) struct Tally {
    pub(super) right: usize,
    /// Nothing found where nothing is expected.
    pub(super) dark: usize,
    /// Wider than wanted, which only more paths than [`Rule::most_paths`] would mend.
    pub(super) costly: usize,
    pub(super) wide: usize,
    /// First readings by other ways that hold the answer.
    confirmed: usize,
    pub(super) wrong: Vec<String>,
    /// Misses that a second reading of the scene did not repeat.
    pub(super) unrepeated: Vec<String>,
    pub(super) unread: Vec<String>,
    /// The largest deviation from an answer in standard errors, and the largest half-width over the wanted one.
    farthest: f64,
    widest: f64,
}

/// Which reading of a scene it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Round {
    First,
    /// With other random numbers, after an interval has missed.
    Again,
}

/// What is being read.
struct Reading<'c> {
    entry: &'c Entry,
    case: &'c Case,
    round: Round,
    answer: &'c Answer,
    channel: &'static str,
    truth: f64,
    precision: f64,
    most_paths: f64,
}

/// One meter's readings against its answer.
#[expect(clippy::too_many_arguments, reason = "what was read, and where the findings go")]
pub(super) fn compare(
    lab: &Lab,
    rule: &Rule,
    (entry, case, round): (&Entry, &Case, Round),
    meter: &MeterReadings,
    along: f64,
    found: &mut Findings,
    tally: &mut Tally,
    charts: &mut CaseCharts,
) -> anyhow::Result<()> {
    let id = &lab.world.scene.sensors[meter.cell.sensor].id;
    let answer = case.expected.iter().find(|answer| &answer.sensor == id);
    let answer = answer.ok_or_else(|| anyhow::anyhow!("{} {}: no answer for {id}", entry.id, case.name))?;
    let channels = meter.reading.measured.len();
    for channel in 0..channels {
        let reading = Reading {
            entry,
            case,
            round,
            answer,
            channel: if channels == 1 { "" } else { [" R", " G", " B"][channel] },
            truth: answer.value[channel.min(answer.value.len() - 1)],
            precision: meter.precision,
            most_paths: rule.most_paths,
        };
        reading.judge(&meter.reading, channel, found, tally);
        meter.others.iter().for_each(|other| reading.confirm(other, channel, found, tally));
        if let Some(m) = meter.reading.measured[channel].filter(|_| reading.truth > 0.0) {
            charts.add(meter.reading.way, along, m, reading.truth, meter.precision);
        }
    }
    Ok(())
}

impl Reading<'_> {
    /// The reading that counts: does its interval hold the answer, and is it as narrow as wanted?
    fn judge(&self, attempt: &Attempt, channel: usize, found: &mut Findings, tally: &mut Tally) {
        let measured = attempt.measured[channel];
        let label = self.label(attempt);
        let mut comparison = self.comparison(&label, measured);
        let width = measured.map(|m| m.half_width() / self.truth).filter(|width| width.is_finite());
        tally.widest = tally.widest.max(width.unwrap_or(0.0) / self.precision);
        tally.farthest = tally.farthest.max(measured.map_or(0.0, |m| self.deviation(m).abs()));
        let note = match (comparison.holds, measured) {
            (_, None) if self.truth <= self.answer.uncertainty => {
                tally.dark += 1;
                "nothing found where nothing is expected".into()
            }
            (_, None) => {
                tally.unread.push(label.clone());
                "too little found".into()
            }
            (Some(false), Some(m)) => {
                tally.wrong.push(label.clone());
                self.words(m)
            }
            (_, Some(m)) if width.is_none_or(|width| width <= self.precision) => {
                tally.right += 1;
                self.words(m)
            }
            (_, Some(m)) => {
                let needed = attempt.paths_to(self.precision);
                if needed > self.most_paths {
                    tally.costly += 1
                } else {
                    tally.wide += 1
                }
                let (done, wanted) = (attempt.paths as f64, 100.0 * self.precision);
                format!("{}; {done:.1e} paths, {wanted} % would need {needed:.1e}", self.words(m))
            }
        };
        comparison = comparison.with_note(note);
        found.rows.push(self.row(attempt, measured));
        found.comparisons.push(comparison);
    }

    /// A first reading by another way, wider as a rule: does its interval hold the answer?
    fn confirm(&self, attempt: &Attempt, channel: usize, found: &mut Findings, tally: &mut Tally) {
        let measured = attempt.measured[channel];
        let Some(m) = measured else { return };
        let label = self.label(attempt);
        let comparison = self.comparison(&label, measured).with_note(format!("confirmation: {}", self.words(m)));
        match comparison.holds {
            Some(false) => tally.wrong.push(label),
            _ => tally.confirmed += 1,
        }
        found.comparisons.push(comparison);
    }

    fn label(&self, attempt: &Attempt) -> String {
        let (entry, case, sensor) = (self.entry.id, &self.case.name, &self.answer.sensor);
        let again = if self.round == Round::Again { "again: " } else { "" };
        format!("{again}{entry} {case}, {sensor}{}, {}", self.channel, attempt.way.words())
    }

    fn comparison(&self, label: &str, measured: Option<Interval>) -> Comparison {
        let unit = match self.answer.reads {
            Reads::Irradiance => "W/m^2",
            Reads::Radiance => "W/(m^2 sr)",
            Reads::Flux => "W",
        };
        let uncertainty = self.answer.uncertainty.max(ROUNDING * self.truth);
        let expected = Expected::within(self.truth, uncertainty, "closed form or quadrature");
        Comparison::judge(label, unit, expected, measured)
    }

    /// Distance from the answer in standard errors, less what the answer itself is uncertain by.
    fn deviation(&self, measured: Interval) -> f64 {
        let error = measured.half_width() / normal_quantile(0.5 + 0.5 * CONFIDENCE);
        let apart = measured.value - self.truth;
        let beyond = (apart.abs() - self.answer.uncertainty.max(ROUNDING * self.truth)).max(0.0);
        if beyond > 0.0 { apart.signum() * beyond / error } else { 0.0 }
    }

    fn words(&self, measured: Interval) -> String {
        let width = 100.0 * measured.half_width() / self.truth;
        let width = if width.is_finite() { format!("half-width {width:.3} %, ") } else { String::new() };
        format!("{width}{:+.1} standard errors", self.deviation(measured))
    }

    fn row(&self, attempt: &Attempt, measured: Option<Interval>) -> Row {
        Row::from([
            ("reading".into(), self.label(attempt).into()),
            ("expected".into(), self.truth.into()),
            ("measured".into(), measured.map(|m| m.value).into()),
            ("half_width".into(), measured.map(|m| m.half_width()).into()),
            ("wanted".into(), (self.precision * self.truth).into()),
            ("paths".into(), attempt.paths.into()),
        ])
    }
}

impl Tally {
    /// A scene's second reading decides; what the first alone has missed is named.
    pub(super) fn read_again(&mut self, again: Tally) {
        let is_repeated = |label: &String| again.wrong.iter().any(|other| other.ends_with(label.as_str()));
        self.unrepeated = std::mem::take(&mut self.wrong).into_iter().filter(|label| !is_repeated(label)).collect();
        self.wrong = again.wrong;
        self.unread.extend(again.unread);
        (self.farthest, self.widest) = (self.farthest.max(again.farthest), self.widest.max(again.widest));
    }

    pub(super) fn readings(&self) -> usize {
        self.right + self.dark + self.costly + self.wide
    }

    pub(super) fn add(&mut self, other: Tally) {
        self.right += other.right;
        self.dark += other.dark;
        self.costly += other.costly;
        self.wide += other.wide;
        self.confirmed += other.confirmed;
        self.wrong.extend(other.wrong);
        self.unrepeated.extend(other.unrepeated);
        self.unread.extend(other.unread);
        self.farthest = self.farthest.max(other.farthest);
        self.widest = self.widest.max(other.widest);
    }

    /// What came out, in one line.
    pub(super) fn words(&self) -> String {
        let some = |list: &[String]| list.iter().take(8).cloned().collect::<Vec<_>>().join("; ");
        let mut words = vec![format!("{} readings hold the answer with the wanted half-width", self.right)];
        let mut count = |number: usize, what: &str| {
            if number > 0 {
                words.push(format!("{number} {what}"));
            }
        };
        count(self.dark, "find nothing where nothing is expected");
        count(self.wide, "hold it with a wider one");
        count(
            self.costly,
            "hold it with a wider one, since the wanted one would need more paths than the definition asks for",
        );
        count(self.confirmed, "wider readings by other ways confirm it");
        let lists = [
            (&self.wrong, "do not hold it"),
            (&self.unrepeated, "missed it once and not again with other random numbers"),
            (&self.unread, "found too little"),
        ];
        for (list, what) in lists {
            if !list.is_empty() {
                words.push(format!("{} {what}: {}", list.len(), some(list)));
            }
        }
        let (far, wide) = (self.farthest, self.widest);
        format!("{}; farthest {far:.1} standard errors, widest {wide:.2} times the wanted half-width", words.join(", "))
    }
}

#[cfg(test)]
mod tests {
    use super::Tally;

    #[test]
    fn a_miss_that_is_repeated_stays_one() {
        let of = |labels: &[&str]| labels.iter().map(ToString::to_string).collect::<Vec<_>>();
        let mut first = Tally { wrong: of(&["I2 a, meter-0, path", "I2 a, meter-1, path"]), ..Tally::default() };
        first.read_again(Tally { wrong: of(&["again: I2 a, meter-1, path"]), ..Tally::default() });
        assert_eq!(first.wrong, ["again: I2 a, meter-1, path"]);
        assert_eq!(first.unrepeated, ["I2 a, meter-0, path"]);
        assert!(first.words().contains("1 do not hold it") && first.words().contains("1 missed it once"));
    }
}
