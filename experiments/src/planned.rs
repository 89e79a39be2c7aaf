//! Reading with the method that the options name, or with the one that a race finds.

use std::time::Duration;

use photonlab_planner::{Candidate, Forecast, Plan, Planner, PlanningError};
use photonlab_readout::{Cell, Ends, MapFile, Outcome, Session, Settings, Source};

use crate::{
    Failure,
    certificate::{is_blind, is_clear_of_edges},
    command::Options,
    loaded::{read_failure, schedule, wanted, warn_of_idle_aids},
    measure::unreadable,
    progress::Progress,
};

/// Reads cells; by which settings, and what was found.
pub(crate) fn read<const C: usize>(
    options: &Options,
    session: &Session<'_, C>,
    cells: &[Cell],
    map: Option<&MapFile<C>>,
) -> Result<(Settings, Outcome<C>), Failure> {
    let wanted = wanted(options, map)?;
    if let Some(target) = wanted.target_error.filter(|_| options.is_planned()) {
        let plan = race(options, session, cells, (target, None))?;
        warn_of_idle_aids(session);
        say!("note: {}", announcement(&plan, target));
        let ends = Ends { passes: None, target_error: Some(target), time_limit: wanted.time_limit };
        let settings = plan.settings();
        return Ok((settings, plan.go_on(&Progress::new(&ends)).map_err(read_failure)?));
    }
    let schedule = schedule(session, &wanted, cells.len());
    let source = map.map_or(Source::Trace, Source::Map);
    let outcome = session.run(cells, &schedule, &source, &Progress::new(&schedule.ends)).map_err(read_failure)?;
    Ok((session.settings, outcome))
}

/// Lets the methods that read these cells and use every option given race to a wanted error, with so much patience for pilots.
pub(crate) fn race<'c, const C: usize>(
    options: &Options,
    session: &Session<'c, C>,
    cells: &'c [Cell],
    (target, patience): (f64, Option<Duration>),
) -> Result<Plan<'c, C>, Failure> {
    let candidates = candidates(options, session, cells)?;
    let time_limit = options.wanted().time_limit;
    let planner = Planner { session: *session, cells, target, time_limit, patience, trusts: &is_clear_of_edges };
    planner.race(&candidates).map_err(|error| match error {
        PlanningError::Read(error) => read_failure(error),
        PlanningError::NoCandidate => {
            Failure::usage("no method reads all that is asked for; --sensor ID reads one sensor by itself")
        }
    })
}

/// The methods that read these cells, use every option given and find all light.
pub(crate) fn candidates<const C: usize>(
    options: &Options,
    session: &Session<'_, C>,
    cells: &[Cell],
) -> Result<Vec<Candidate>, Failure> {
    let mut settings = options.all_settings(&session.world.scene)?;
    let finds_all = |settings: &Settings| !is_blind(session.world, session.needs, settings);
    settings.retain(|settings| unreadable(cells, settings).is_none() && finds_all(settings));
    Ok(Candidate::of(&settings, session))
}

/// What was chosen, and why, in a line.
fn announcement<const C: usize>(plan: &Plan<'_, C>, target: f64) -> String {
    let chosen = plan.entrants[plan.chosen].candidate;
    let (title, raced, seconds) = (chosen.title(), plan.raced(), plan.pilots.as_secs_f64());
    let Some(forecast) = plan.forecast else {
        return format!(
            "auto takes {title}: {raced} methods ran {} s, and of none can be foretold that it reaches {}",
            brief(seconds),
            percent(target)
        );
    };
    let time = interval(&forecast);
    match raced {
        1 => format!("auto takes {title}; to {}: {time}", percent(target)),
        _ => format!(
            "auto takes {title}, the soonest of {raced} that raced for {} s; to {}: {time}",
            brief(seconds),
            percent(target)
        ),
    }
}

/// A share as the user writes it.
pub(crate) fn percent(share: f64) -> String {
    let text = format!("{:.6}", 100.0 * share);
    format!("{}%", text.trim_end_matches('0').trim_end_matches('.'))
}

/// A time with its interval.
pub(crate) fn interval(forecast: &Forecast) -> String {
    format!("{} s ({} to {})", brief(forecast.seconds), brief(forecast.low), brief(forecast.high))
}

/// Two digits are all that is known of a time to come.
fn brief(seconds: f64) -> String {
    let decimals = (1.0 - seconds.max(1e-3).log10().floor()).max(0.0) as usize;
    format!("{seconds:.decimals$}")
}
