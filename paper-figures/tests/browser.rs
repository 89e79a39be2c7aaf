//! The committed records' report in a real browser, as wide as a desk's screen and a phone's: nothing sticks out, nothing is missing, and
//! the console is silent.

use std::{
    fs,
    path::{Path, PathBuf},
    process::Command,
};

use photonlab_measure::Record;
use photonlab_paper_figures::{Chapter, ReportEntry, report};

/// What tells what is wrong with a page, from within.
const AUDIT: &str = include_str!("audit.html");
/// Pixels across.
const WIDTHS: [u32; 2] = [1280, 390];

#[test]
fn the_report_fits_screens_and_misses_nothing() {
    let Some(browser) = Browser::find("the report in a browser") else { return };
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../experiments/records");
    let files = fs::read_dir(&folder).expect("the committed records").map(|file| file.expect("an entry").path());
    let mut files: Vec<PathBuf> = files.filter(|path| path.extension().is_some_and(|e| e == "json")).collect();
    files.sort();
    let records: Vec<Record> = files.iter().map(|path| Record::load(path).expect("a record")).collect();
    assert!(records.len() > 20, "{} records", records.len());
    let entries = records.iter().map(|record| ReportEntry::load(record, &folder)).collect::<Result<Vec<_>, _>>();
    let chapters = [
        Chapter { id: "published", text: include_str!("../../experiments/PUBLISHED.md") },
        Chapter { id: "methodology", text: include_str!("../../experiments/METHODOLOGY.md") },
        Chapter { id: "bias", text: include_str!("../../experiments/BIAS.md") },
    ];
    let page = report(&entries.expect("every picture"), &chapters).expect("a report");
    for width in WIDTHS {
        let found = browser.faults(&page, width);
        assert!(found.is_empty(), "{width} pixels: {found:#?}");
    }
}

/// The audit is no use if it finds nothing.
#[test]
fn a_broken_page_is_told() {
    let Some(browser) = Browser::find("the audit of pages") else { return };
    let page =
        |body: &str| format!("<!DOCTYPE html><html><head><meta charset=\"utf-8\"></head><body>{body}</body></html>");
    assert_eq!(
        browser.faults(&page("<p>Nothing wrong.</p><figure><svg width=\"9\" height=\"9\"></svg></figure>"), 390),
        [""; 0]
    );
    for (body, fault) in [
        ("<div style=\"width: 500px\">wide</div>", "sticks out"),
        ("<div style=\"overflow: auto\"><div style=\"width: 500px\">wide</div></div>", "scrolls"),
        ("<svg width=\"50\" height=\"20\"><text x=\"30\" y=\"15\">a long label</text></svg>", "leaves its figure"),
        ("<img src=\"no.png\" alt=\"\">", "missing"),
        ("<figure><figcaption>Alone</figcaption></figure>", "is empty"),
        ("<a href=\"#nowhere\">there</a>", "leads nowhere"),
        ("<script>console.error('broken')</script>", "broken"),
    ] {
        let found = browser.faults(&page(body), 390);
        assert!(found.iter().any(|told| told.contains(fault)), "{body}: {found:?}");
    }
}

/// Chromium without a window.
struct Browser(&'static str);

impl Browser {
    /// One that runs, or none: then it is said aloud that `what` was not checked.
    fn find(what: &str) -> Option<Self> {
        let runs = |name: &&str| Command::new(name).arg("--version").output().is_ok_and(|said| said.status.success());
        let found = ["chromium", "chromium-browser", "google-chrome"].into_iter().find(runs);
        if found.is_none() {
            // Straight to the terminal: the test harness hides what a passing test prints.
            use std::io::Write;
            let _ = writeln!(std::io::stderr(), "NOT CHECKED: {what}: no Chromium is installed (Debian: chromium)");
        }
        found.map(Self)
    }

    /// Opens a page in a frame of so many pixels across, which is narrower than any window of the browser may be; what is wrong with it.
    fn faults(&self, page: &str, width: u32) -> Vec<String> {
        let folder = tempfile::tempdir().expect("a folder");
        let audited = page.replacen("</body>", &format!("{AUDIT}</body>"), 1);
        fs::write(folder.path().join("page.html"), audited).expect("written");
        let frame = format!(
            "<!DOCTYPE html><html><body style=\"margin: 0\"><pre id=\"told\"></pre><script>addEventListener('message', e => \
             {{ document.getElementById('told').textContent = e.data; }});</script><iframe src=\"page.html\" style=\"border: 0\" \
             width=\"{width}\" height=\"900\"></iframe></body></html>"
        );
        let path = folder.path().join("frame.html");
        fs::write(&path, frame).expect("written");
        let said = Command::new(self.0)
            .args(["--headless", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--enable-logging=stderr"])
            .args(["--virtual-time-budget=30000", "--window-size=1400,1000", "--dump-dom"])
            .arg(format!("--user-data-dir={}", folder.path().join("profile").display()))
            .arg(format!("file://{}", path.display()))
            .output()
            .expect("the browser was found before");
        let (dom, log) = (String::from_utf8_lossy(&said.stdout), String::from_utf8_lossy(&said.stderr));
        let told = dom.split_once("<pre id=\"told\">").and_then(|(_, rest)| rest.split_once("</pre>"));
        let Some((told, _)) = told.filter(|(told, _)| told.contains("audited")) else {
            return vec![format!("the page was not audited: {log}")];
        };
        let faults = told.lines().filter(|line| *line != "audited" && !line.is_empty());
        faults.chain(log.lines().filter(|line| line.contains(":CONSOLE"))).map(str::to_owned).collect()
    }
}
