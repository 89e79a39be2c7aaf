//! Rows and their geometric means.

use crate::cases::Case;

/// One case: our rate, those of the others, and our advantage over the better kiddo.
pub(crate) struct Row {
    group: String,
    ratio: f64,
}

impl Row {
    pub(crate) fn build(set: &str, [ours, kiddo]: [f64; 2], native: f64) -> Self {
        let ratio = kiddo.min(native) / ours;
        println!("{set:8} build: ours {ours:.3} s, kiddo {kiddo:.3}, kiddo native {native:.3}; ratio {ratio:.2}");
        Self { group: "build".into(), ratio }
    }

    /// `best` in the order ours, kiddo, grid; `others` native kiddo, nanoflann. Seconds; NaN is not measured.
    pub(crate) fn queries(set: &str, case: &Case, asked: usize, best: Vec<f64>, [native, nanoflann]: [f64; 2]) -> Self {
        let rate = |seconds: f64| asked as f64 / seconds / 1e3;
        // `min` passes over NaN.
        let ratio = best[1].min(native) / best[0];
        println!(
            "{set:8} {:7} {:3} {:9}: ours {:6.0} k/s, kiddo {:4.0}, kiddo native {:4.0}, grid {:5.0}, nanoflann {:4.0}; \
             ratio {ratio:5.2}",
            case.family(),
            case.k,
            format!("{:?}", case.order),
            rate(best[0]),
            rate(best[1]),
            rate(native),
            rate(best[2]),
            rate(nanoflann),
        );
        if best[2] < best[0] {
            println!("    the grid is {:.2} times as fast", best[0] / best[2]);
        }
        Self { group: format!("{} {}", case.family(), format!("{:?}", case.order).to_lowercase()), ratio }
    }
}

#[derive(Default)]
pub(crate) struct Report(Vec<Row>);

impl Report {
    pub(crate) fn add(&mut self, row: Row) {
        self.0.push(row);
    }

    fn mean(&self, group: &str) -> f64 {
        let logs: Vec<f64> = self.0.iter().filter(|row| row.group == group).map(|row| row.ratio.ln()).collect();
        (logs.iter().sum::<f64>() / logs.len() as f64).exp()
    }

    pub(crate) fn finish(&self) {
        let m = |group| self.mean(group);
        println!("search only: random {:.2}, coherent {:.2}", m("search random"), m("search coherent"));
        println!(
            "geometric mean ratio to kiddo: nearest random {:.2}, nearest coherent {:.2}, radius random {:.2}, \
             radius coherent {:.2}, build {:.2}",
            m("nearest random"),
            m("nearest coherent"),
            m("radius random"),
            m("radius coherent"),
            m("build")
        );
    }
}
