//! `catalogue`: every scene whose answer is known, against that answer.

use photonlab_measure::{Group, Record, Verdict};
use photonlab_reference::catalogue::{ALL, Entry, WITHOUT_SCENE};

use crate::{
    by_channels,
    reproduce::{
        case_charts::CaseCharts,
        case_judgement::{Round, Tally, compare},
        case_reading::{CONFIDENCE, Rule, put_down, read},
        context::{Context, Findings},
        lab::Lab,
    },
};

pub(super) fn run(context: &Context) -> anyhow::Result<Record> {
    let rule: Rule = context.parameters()?;
    let folder = context.folder("scenes")?;
    let mut found = Findings { seeds: vec![rule.seed], ..Findings::default() };
    let mut charts = CaseCharts::new();
    let mut all = Tally::default();
    let asked = |entry: &&Entry| context.entries.is_empty() || context.entries.iter().any(|id| id == entry.id);
    let entries: Vec<&Entry> = ALL.iter().filter(asked).collect();
    for (place, entry) in entries.iter().enumerate() {
        let (mut tally, before) = (Tally::default(), found.comparisons.len());
        let cases = (entry.cases)();
        for (number, case) in cases.iter().enumerate() {
            say!("       {} {}", entry.id, case.name);
            let path = folder.join(format!("{}-{number}.xml", entry.id));
            put_down(case, &path)?;
            let lab = match Lab::open(&path) {
                Ok(lab) => lab,
                Err(error) => {
                    tally.unread.push(format!("{} {} ({error})", entry.id, case.name));
                    continue;
                }
            };
            let along = place as f64 + 0.6 + 0.8 * (number as f64 + 0.5) / cases.len() as f64;
            // Scenes of one shape would deviate alike if they shared their random numbers.
            let entry_number = ALL.iter().position(|one| one.id == entry.id).unwrap_or(0);
            let seed = rule.seed + 10_000 * (entry_number as u64 + 1) + 10 * number as u64;
            let mut read_once = |round: Round, seed: u64| -> anyhow::Result<Tally> {
                let mut tally = Tally::default();
                for meter in by_channels!(lab.needs.channels, read(&lab, &rule, seed))? {
                    compare(&lab, &rule, (entry, case, round), &meter, along, &mut found, &mut tally, &mut charts)?;
                }
                Ok(tally)
            };
            let mut of_case = read_once(Round::First, seed)?;
            if !of_case.wrong.is_empty() {
                of_case.read_again(read_once(Round::Again, seed + 5)?);
            }
            tally.add(of_case);
        }
        let title = format!("{} {}", entry.id, entry.title);
        found.groups.push(Group { title, summary: tally.words(), comparisons: found.comparisons.len() - before });
        all.add(tally);
    }
    if context.entries.is_empty() {
        found.groups.extend(WITHOUT_SCENE.iter().map(|bare| Group {
            title: format!("{} {}", bare.id, bare.title),
            summary: format!("no scene: {}", bare.why),
            comparisons: 0,
        }));
    }
    found.figures = charts.figures(&entries, &rule);
    conclude(context, found, &all)
}

fn conclude(context: &Context, found: Findings, tally: &Tally) -> anyhow::Result<Record> {
    let intervals = found.comparisons.iter().filter(|c| c.measured.is_some()).count();
    let of = if context.entries.is_empty() { String::new() } else { format!("of {}: ", context.entries.join(", ")) };
    let chance = (1.0 - CONFIDENCE) * intervals as f64;
    let reason = format!("{of}{}; of {intervals} intervals {chance:.2} would miss by chance", tally.words());
    let short = tally.wide + tally.unread.len();
    let verdict = match (tally.wrong.is_empty(), short) {
        (false, _) => Verdict::DoesNotHold,
        (true, 0) if tally.costly == 0 && tally.unrepeated.is_empty() => Verdict::Holds,
        (true, _) if 2 * (tally.right + tally.dark) >= tally.readings() + tally.unread.len() => {
            Verdict::HoldsWithinLimits
        }
        (true, _) => Verdict::NotMeasured,
    };
    Ok(context.record(found, verdict, reason))
}
