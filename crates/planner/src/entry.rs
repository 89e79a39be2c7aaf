//! Who enters the race.

use std::time::Instant;

use crate::{
    Candidate, Forecast, Planner,
    candidate::Heat,
    field::Field,
    plan::{Standing, Why},
};

/// What starts slowly enters where the best of the others still needs so many seconds.
const LATE: f64 = 5.0;

impl<'p, 'c, const C: usize> Planner<'p, 'c, C> {
    /// Lets candidates run their first passes: at once, or after a look at those before them, if they enter at all.
    pub(crate) fn enter_all(&self, field: &mut Field<'p, 'c, C>, candidates: &[Candidate], start: Instant) {
        // Who was dropped for the sake of a first that then proved slower may enter again.
        let may_win = |forecast: Forecast| field.best().is_some_and(|best| forecast.low <= best.high);
        let runs = |number: usize| field.trials.iter().any(|trial| trial.number == number);
        let waits = |(number, standing): (usize, &Standing)| match standing {
            Standing::NotRaced(Why::DoneSoon | Why::KinIsBehind | Why::StartsSlowly) => true,
            Standing::Foretold(forecast) => !runs(number) && may_win(*forecast),
            Standing::OutOfReach | Standing::NotRaced(Why::NoTimeLeft | Why::Failed) => false,
        };
        let waiting: Vec<bool> = field.standings.iter().enumerate().map(waits).collect();
        let in_heat = |heat: Heat| {
            let all = candidates.iter().copied().enumerate();
            all.filter(|(number, it)| waiting[*number] && it.heat() == heat).collect::<Vec<_>>()
        };
        let mut slow_ones_entered = false;
        for (number, candidate) in in_heat(Heat::First) {
            if field.is_decided() {
                return;
            }
            self.enter_unless_late(field, (number, candidate), start);
            // What starts slowly and then is quick is tried before what hardly ever wins.
            if !slow_ones_entered && field.soonest().is_some_and(|best| best.low > LATE) {
                in_heat(Heat::IfTimeIsLeft)
                    .into_iter()
                    .for_each(|entrant| self.enter_unless_late(field, entrant, start));
                slow_ones_entered = true;
            }
        }
        field.halve();
        let kin_is_left = field.trials.is_empty()
            || field.trials.iter().any(|trial| trial.candidate.settings.method.is_direct_view());
        let time_is_left = field.best().is_none_or(|best| best.seconds > LATE);
        let kin = (Heat::IfKinIsLeft, kin_is_left, Why::KinIsBehind);
        let slow = (Heat::IfTimeIsLeft, time_is_left, Why::StartsSlowly);
        for (heat, enters, why_not) in [kin].into_iter().chain((!slow_ones_entered).then_some(slow)) {
            for (number, candidate) in in_heat(heat) {
                if enters {
                    self.enter_unless_late(field, (number, candidate), start);
                } else {
                    field.standings[number] = Standing::NotRaced(why_not);
                }
            }
        }
    }

    /// One runs however late it is.
    fn enter_unless_late(&self, field: &mut Field<'p, 'c, C>, entrant: (usize, Candidate), start: Instant) {
        if field.is_late() && !field.trials.is_empty() {
            field.standings[entrant.0] = Standing::NotRaced(Why::NoTimeLeft);
        } else {
            field.enter(entrant.0, self.trial(entrant, 1.0, start));
        }
    }
}
