//! Every way for a scene to be wrong, with the line and the words of the answer. Most of them stand in `broken.txt`.

use photonlab_scene::read::read_scene_str;

use super::read_body;

const CASES: &str = include_str!("broken.txt");

struct Case {
    body: String,
    /// Start of the message: file, line and element.
    start: String,
    fragment: &'static str,
}

/// The cases of the file; its head says how they are written.
fn cases() -> Vec<Case> {
    let (mut cases, mut around) = (Vec::new(), None);
    let text = CASES.split_once("\n\n").expect("a head").1;
    for piece in text.split_inclusive('\n').collect::<Vec<_>>().chunk_by(|_, next| !is_mark(next)) {
        let (mark, body) = (piece[0].trim(), piece[1..].concat());
        if let Some(pair) = mark.strip_prefix("% around ") {
            around = pair.split_once(" ... ");
        } else if mark.starts_with('%') {
            around = None;
        } else if let Some(case) = mark.strip_prefix("@ ") {
            let (place, fragment) = case.split_once(" | ").expect("a message");
            let (line, element) = place.split_once(' ').expect("a line and an element");
            let body = body.trim_end();
            let body = match around {
                Some((open, close)) => format!("{open}\n{body}\n{close}"),
                None => body.to_owned(),
            };
            cases.push(Case { body, start: format!("test.xml:{line}: {element}: "), fragment });
        }
    }
    cases
}

fn is_mark(line: &str) -> bool {
    line.starts_with("@ ") || line.starts_with("% ")
}

#[test]
fn broken_scenes_are_answered_with_line_and_words() {
    let cases = cases();
    assert_eq!(cases.len(), CASES.lines().filter(|line| line.starts_with("@ ")).count());
    assert!(cases.len() >= 180, "{} cases", cases.len());
    let mut wrong = Vec::new();
    for Case { body, start, fragment } in &cases {
        let shown = match read_body(body, &[]) {
            Ok(_) => "accepted".to_owned(),
            Err(error) => error.to_string(),
        };
        let says_it = shown.starts_with(start) && shown.contains(fragment);
        if !says_it || shown.contains('\n') || !shown.contains("; ") {
            wrong.push(format!("{body}\n  gave   {shown}\n  wanted {start}{fragment}"));
        }
    }
    assert!(wrong.is_empty(), "{} wrong:\n{}", wrong.len(), wrong.join("\n"));
}

#[test]
fn roots_and_versions() {
    for (text, fragment) in [
        ("<scene/>", "t:1: scene: attribute version is missing"),
        ("<scene version='0.6.0'/>", "t:1: scene: version \"0.6.0\" is older than Mitsuba 2"),
        ("<scene version='4.0.0'/>", "newer"),
        ("<scene version='three'/>", "is not a version"),
        ("<scene version='3.0.0.0'/>", "is not a version"),
        ("<scene version=''/>", "is not a version"),
        ("<scene version='3.0.0' units='mm'/>", "unknown attribute \"units\""),
        ("<shape type='cube'/>", "t:1: shape: the root element is not scene"),
        ("<html/>", "unknown element \"html\""),
        ("<m:scene xmlns:m='http://x' version='3.0.0'/>", "namespaces"),
        ("<!DOCTYPE scene [<!ENTITY a 'b'>]>\n<scene version='3.0.0'/>", "t:1: scene: document type"),
        ("\n\n<!DOCTYPE scene>\n<scene version='3.0.0'/>", "t:3: scene: document type"),
    ] {
        let error = read_scene_str(text, "t", &[]).expect_err(text).to_string();
        assert!(error.contains(fragment), "{text}: {error}");
    }
}

#[test]
fn defines_name_defaults() {
    let body = "<default name='rho' value='1'/><default name='sigmas' value='1'/>";
    for (defines, fragment) in [
        (&[("sigma", "1")][..], "test.xml:1: default: -D \"sigma\" names no default of this scene"),
        (&[("sigma", "1")], "defaults that it has: sigmas, rho"),
        (&[("rho", "1"), ("rho", "1")], "-D \"rho\" is given twice"),
        (&[("", "1")], "names no default"),
    ] {
        let error = read_body(body, defines).expect_err("a wrong define").to_string();
        assert!(error.contains(fragment), "{error}");
    }
    let body = "<default name='r' value='1'/>\n<shape type='$r'/>";
    let error = read_body(body, &[("r", "ball")]).expect_err("no ball");
    assert_eq!(
        error.to_string(),
        "test.xml:3: shape: unknown shape \"ball\"; use one of ply, cube, disk, lens, obj, sphere, cylinder, rectangle, paraboloid"
    );
}
