//! The figures of split rules held against one another.

use photonlab_measure::{Axis, FigureData, Interval, Point, Series, SeriesKind};

use super::{
    cpu_clock::CPU_SECONDS,
    search::Cost,
    split_rules::RULES,
    split_times::BuildTimes,
    split_trials::{Plan, Tried},
};

/// All figures; `times` are CPU seconds per query by set and rule.
pub(super) fn figures(
    plan: &Plan,
    all: &[Vec<Tried>],
    times: &[Vec<[f64; 2]>],
    builds: &BuildTimes,
    confidence: f64,
) -> Vec<FigureData> {
    let middle = plan.k.len() / 2;
    let chart = Chart { plan, all, confidence };
    vec![
        chart.by_set("tested", "Photons tested by split rule", "photons tested, over the median's", middle, |cost| {
            cost.tested
        }),
        chart.by_set("nodes", "Nodes opened by split rule", "nodes opened, over the median's", middle, |cost| {
            cost.nodes
        }),
        chart.by_count("neighbours", "k nearest", "k", plan.k, 0),
        chart.by_count(
            "radii",
            "fixed radii",
            "photons that the radius typically holds",
            plan.radius_counts,
            plan.k.len(),
        ),
        build(builds),
        chart.query_time(times),
    ]
}

struct Chart<'a> {
    plan: &'a Plan<'a>,
    all: &'a [Vec<Tried>],
    confidence: f64,
}

impl Chart<'_> {
    /// The trials at the most photons of each set.
    fn largest(&self) -> impl Iterator<Item = &[Tried]> {
        self.all.iter().map(|tried| &tried[tried.len() - RULES.len()..])
    }

    fn sets(&self) -> Vec<&'static str> {
        self.largest().map(|set| set[0].set.title()).collect()
    }

    fn ratio(&self, set: &[Tried], rule: usize, search: usize, of: fn(&Cost) -> f64) -> Option<Interval> {
        set[rule].ratio(&set[0], search..search + 1, of, self.confidence)
    }

    fn caption(&self, what: &str) -> String {
        format!(
            "{what} {} photons, {} replicates of {} queries, each at a photon of the same kind; bars: {:.3} % intervals \
             each, as in the table.",
            self.plan.photons.iter().max().unwrap_or(&0),
            self.plan.replicates,
            self.plan.queries,
            100.0 * self.confidence
        )
    }

    fn by_set(&self, id: &str, title: &str, y: &str, search: usize, of: fn(&Cost) -> f64) -> FigureData {
        let series = (1..RULES.len()).map(|rule| {
            let at = |set: usize| set as f64 + 1.0 + 0.12 * (rule as f64 - 3.0);
            let points = self.largest().enumerate();
            let points = points.filter_map(|(i, set)| Some(Point::measured(at(i), self.ratio(set, rule, search, of)?)));
            Series { label: RULES[rule].name.into(), kind: SeriesKind::Measured, points: points.collect() }
        });
        let what = format!(
            "Search for the {}; all trees have leaves of sixteen photons on average. Below 1 is fewer than the median's.",
            self.plan.names()[search]
        );
        FigureData {
            id: id.into(),
            title: title.into(),
            caption: self.caption(&what),
            x: Axis::named("photon set", self.sets()),
            y: Axis::log(y),
            series: series.collect(),
        }
    }

    /// The paper's cost over what is asked for.
    fn by_count(&self, id: &str, asked: &str, x: &str, counts: &[usize], first: usize) -> FigureData {
        const PAPER: usize = 1;
        let ends = [0.9 * counts[0] as f64, 1.1 * counts[counts.len() - 1] as f64];
        let series = self.largest().enumerate().map(|(number, set)| {
            // Side by side, for bars at one place hide one another.
            let aside = 1.06_f64.powf(number as f64 - 1.5);
            let points = counts.iter().enumerate().filter_map(|(i, &count)| {
                let ratio = self.ratio(set, PAPER, first + i, |cost| cost.tested)?;
                Some(Point::measured(count as f64 * aside, ratio))
            });
            Series { label: set[0].set.title().into(), kind: SeriesKind::Measured, points: points.collect() }
        });
        FigureData {
            id: id.into(),
            title: format!("Photons tested by the paper's cost, {asked}"),
            caption: self.caption("Exact sweep; all trees have leaves of sixteen photons on average. Marks of one place stand side by side."),
            x: Axis::log(x),
            y: Axis::log("photons tested, over the median's"),
            series: series.chain([as_good(ends)]).collect(),
        }
    }

    fn query_time(&self, times: &[Vec<[f64; 2]>]) -> FigureData {
        let series = (0..RULES.len()).map(|rule| {
            let at = |set: usize| set as f64 + 1.0 + 0.12 * (rule as f64 - 2.5);
            let points = times.iter().enumerate().map(|(set, times)| Point::new(at(set), 1e6 * times[rule][0]));
            Series { label: RULES[rule].name.into(), kind: SeriesKind::Measured, points: points.collect() }
        });
        FigureData {
            id: "query-time".into(),
            title: format!("Time of a query for the {}", self.plan.names()[self.plan.k.len() / 2]),
            caption: format!(
                "{} photons; queries in random order, one thread, best of several rounds, the rules in turn. The \
                 exact sweep's leaves straddle the blocks of sixteen in which photons are stored. No bars: no \
                 verdict rests on it. {CPU_SECONDS}.",
                self.plan.photons.iter().max().unwrap_or(&0)
            ),
            x: Axis::named("photon set", self.sets()),
            y: Axis::linear("CPU microseconds a query"),
            series: series.collect(),
        }
    }
}

fn build(times: &BuildTimes) -> FigureData {
    let series = RULES.iter().enumerate().map(|(rule, named)| {
        let point = |(i, &n): (usize, &usize)| Point::new(n as f64, 1e9 * times.best(rule, i) / n as f64);
        let points = times.photons.iter().enumerate().map(point).collect();
        Series { label: named.name.into(), kind: SeriesKind::Measured, points }
    });
    FigureData {
        id: "build".into(),
        title: format!("Time to build the tree, {}", times.set.title()),
        caption: format!(
            "One thread, best of {} rounds, the rules in turn. No bars: no verdict rests on it. {CPU_SECONDS}.",
            times.rounds[0][0].len()
        ),
        x: Axis::log("photons"),
        y: Axis::log("CPU nanoseconds a photon"),
        series: series.collect(),
    }
}

/// Where a rule is as good as the median.
fn as_good(ends: [f64; 2]) -> Series {
    let points = ends.map(|x| Point::new(x, 1.0)).into();
    Series { label: "as many as the median".into(), kind: SeriesKind::Reference, points }
}
