//! What a chart's runs are judged by: two long runs by methods that have little in common.

use std::time::Duration;

use photonlab_planner::Candidate;
use photonlab_readout::{Cell, Ends, ErrorOver, Method, Outcome, Session, Settings, Silent};

use crate::{Failure, chart::Kept, ladder::Ladder, loaded::read_failure};

/// Wall time of each, over that of a charted method's longest run.
const LONGER: f64 = 10.0;
/// A seed that no charted run has.
const SEED: u64 = 1_000_003;
/// Passes that fit into the time.
const PASSES: f64 = 64.0;

/// What a run read, cell by cell and channel by channel.
pub(crate) struct Values(Vec<f64>);

impl Values {
    pub(crate) fn of<const C: usize>(outcome: &Outcome<C>) -> Self {
        let channels = 0..outcome.results;
        let of_cell = |cell: &photonlab_readout::CellResult<C>| {
            let value = |channel: usize| cell.value[channel].mean().unwrap_or(f64::NAN);
            channels.clone().map(value).collect::<Vec<_>>()
        };
        Self(outcome.cells.iter().flat_map(of_cell).collect())
    }

    /// The worst relative error of a meter, or the RMS of an image over its mean; `None` where the truth is dark or either is unknown.
    pub(crate) fn error(&self, truth: &Values, over: ErrorOver) -> Option<f64> {
        let pairs = || self.0.iter().zip(&truth.0);
        let error = match over {
            ErrorOver::Worst => {
                let lit = pairs().filter(|(_, truth)| **truth > 0.0);
                lit.map(|(value, truth)| (value / truth - 1.0).abs()).reduce(f64::max)?
            }
            ErrorOver::Image => {
                let count = truth.0.len() as f64;
                let squares = pairs().map(|(value, truth)| (value - truth).powi(2)).sum::<f64>() / count;
                squares.sqrt() / (truth.0.iter().sum::<f64>() / count)
            }
        };
        error.is_finite().then_some(error)
    }
}

/// Methods that err alike.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    FinalGather,
    DirectView,
    Paths,
    Counts,
}

impl Kind {
    fn of(method: Method) -> Self {
        match method {
            Method::FinalGather { .. } => Kind::FinalGather,
            Method::Nearest { .. } | Method::Radius { .. } | Method::Adaptive => Kind::DirectView,
            Method::Path => Kind::Paths,
            Method::Bins => Kind::Counts,
        }
    }
}

/// One long run.
pub(crate) struct Reference {
    kind: Kind,
    title: String,
    pub(crate) values: Values,
    /// `None` where its passes say nothing of it.
    half_width: Option<f64>,
}

/// The best for most, and the best of another kind for those of its own.
pub(crate) struct References(Vec<Reference>);

impl References {
    /// By what the charted runs say of their own error bars and times.
    pub(crate) fn of<const C: usize>(
        session: &Session<'_, C>,
        cells: &[Cell],
        ladders: &[Ladder<Kept>],
    ) -> Result<Self, Failure> {
        // Seconds to an error bar of one, by the longest run.
        let merit = |ladder: &Ladder<Kept>| {
            let rung = ladder.rungs.last()?;
            let bars: Vec<f64> = rung.runs.iter().flatten().filter_map(|run| run.bar).collect();
            let square = bars.iter().map(|bar| bar * bar).sum::<f64>() / bars.len() as f64;
            let merit = square * rung.seconds;
            merit.is_finite().then_some((merit, rung.seconds, ladder.candidate))
        };
        // A cache's sites stay where they are, and its error with them.
        let mut ranked: Vec<_> =
            ladders.iter().filter(|ladder| !ladder.candidate.settings.aids.cache).filter_map(merit).collect();
        ranked.sort_by(|a, b| a.0.total_cmp(&b.0));
        let Some(&(_, seconds, best)) = ranked.first() else {
            return Err(Failure::Running(anyhow::anyhow!("no method found light to chart")));
        };
        let kind = |candidate: &Candidate| Kind::of(candidate.settings.method);
        let other = ranked.iter().find(|(.., candidate)| kind(candidate) != kind(&best));
        let mut references = Vec::new();
        for (seconds, candidate) in [Some((seconds, best)), other.map(|&(_, s, c)| (s, c))].into_iter().flatten() {
            references.push(long_run(session, cells, candidate, LONGER * seconds.max(0.2))?);
        }
        Ok(Self(references))
    }

    /// That of another kind, if there is one.
    pub(crate) fn for_judging(&self, candidate: &Candidate) -> &Reference {
        let kind = Kind::of(candidate.settings.method);
        self.0.iter().find(|reference| reference.kind != kind).unwrap_or(&self.0[0])
    }

    /// Half-width of the wider one, if any is above zero.
    pub(crate) fn widest(&self) -> Option<f64> {
        let known = self.0.iter().filter_map(|reference| reference.half_width);
        known.filter(|width| *width > 0.0 && width.is_finite()).reduce(f64::max)
    }

    /// Who they are, and how wide.
    pub(crate) fn words(&self) -> String {
        let of = |reference: &Reference| match reference.half_width {
            Some(width) => format!("{} (± {:.3} %)", reference.title, 100.0 * width),
            None => format!("{} (± unknown)", reference.title),
        };
        match &self.0[..] {
            [one] => format!("judged by a long run of {}, the only kind of method that reads this", of(one)),
            all => {
                format!("judged by a long run of {}, and what is of that kind by one of {}", of(&all[0]), of(&all[1]))
            }
        }
    }
}

fn long_run<const C: usize>(
    session: &Session<'_, C>,
    cells: &[Cell],
    candidate: Candidate,
    seconds: f64,
) -> Result<Reference, Failure> {
    let session = Session { settings: Settings { seed: SEED, ..candidate.settings }, ..*session };
    let mut scale = 1.0;
    let ends = Ends { passes: None, target_error: None, time_limit: Some(Duration::from_secs_f64(seconds)) };
    // Passes as long as some fit into the time, by the time of shorter ones.
    let mut ongoing = loop {
        let schedule = candidate.schedule(cells.len(), &session.demands(), scale, ends);
        let mut ongoing = session.begin(cells, &schedule).map_err(read_failure)?;
        ongoing.pass().map_err(read_failure)?;
        let took = ongoing.pass().map_err(read_failure)?.as_secs_f64();
        if took * PASSES * 2.0 >= seconds || scale >= 1e6 {
            break ongoing;
        }
        scale *= (seconds / (took * PASSES)).clamp(2.0, 16.0);
    };
    ongoing.pass().map_err(read_failure)?;
    let outcome = ongoing.go_on(&Silent).map_err(read_failure)?;
    let half_width = outcome.error(session.error_over, session.confidence);
    Ok(Reference {
        kind: Kind::of(candidate.settings.method),
        title: candidate.title(),
        values: Values::of(&outcome),
        half_width,
    })
}
