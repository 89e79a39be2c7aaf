//! Text meant to hurt: it must be answered soon, without a panic.

use std::time::{Duration, Instant};

use photonlab_scene::read::{SceneError, read_scene_str};
use proptest::prelude::*;

/// Far more than any of these takes, far less than a quadratic walk would.
const SOON: Duration = Duration::from_secs(20);

#[track_caller]
fn refused(text: &str, fragment: &str) -> SceneError {
    let start = Instant::now();
    let error = read_scene_str(text, "t", &[]).expect_err("a hostile scene");
    assert!(error.to_string().contains(fragment), "{error}");
    assert!(error.to_string().len() < 1000, "a long message");
    assert!(start.elapsed() < SOON, "took {:?}", start.elapsed());
    error
}

#[test]
fn nesting_without_end() {
    let deep = |open: &str| format!("<scene version='3.0.0'>\n{}", open.repeat(1_000_000));
    assert_eq!(refused(&deep("<shape type='cube'>\n"), "more than 64 elements inside each other").line, 65);
    refused(&deep("<a>"), "more than 64 elements");
    refused(&deep("<a xmlns:b='c'>"), "more than 64 elements");
    refused(&deep("<!-- --><a>"), "more than 64 elements");
    let closed = format!("{}{}", "<scene version='3.0.0'>".repeat(100_000), "</scene>".repeat(100_000));
    refused(&closed, "more than 64 elements");
}

#[test]
fn attributes_without_end() {
    let many: String = (0..300_000).map(|number| format!(" a{number}=''")).collect();
    refused(&format!("<scene{many}/>"), "more than 16 attributes");
    let spaces: String = (0..300_000).map(|number| format!(" xmlns:a{number}='b'")).collect();
    refused(&format!("<scene{spaces}/>"), "more than 16 attributes");
    refused(&format!("<scene version='3.0.0'>{}</scene>", "<a/>".repeat(5_000_000)), "more than 4194304 tags");
}

#[test]
fn values_without_end() {
    let long = "1 ".repeat(4_000_000);
    let shape = |inside: &str| format!("<scene version='3.0.0'><shape type='sphere'>{inside}</shape></scene>");
    refused(&shape(&format!("<point name='center' value='{long}'/>")), "holds more than 3 numbers");
    refused(&shape(&format!("<float name='radius' value='{long}'/>")), "is not a number");
    refused(&shape(&format!("<float name='{long}' value='1'/>")), "unknown parameter");
    refused(&shape(&long), "text \"1 1 1");
    refused(&format!("<{} version='3.0.0'/>", "x".repeat(60_000)), "unknown element");
    let wide: String = (0..200_000).map(|number| format!("<float name='r{number}' value='1'/>")).collect();
    refused(&shape(&wide), "unknown parameter \"r0\"");
}

#[test]
fn defaults_that_multiply() {
    let mut laughs = String::from("<scene version='3.0.0'><default name='a0' value='ha'/>");
    for level in 1..60 {
        let below = format!("$a{}", level - 1).repeat(10);
        laughs += &format!("<default name='a{level}' value='{below}'/>");
    }
    refused(&(laughs + "</scene>"), "too many or too long substitutions");
    let empty = format!(
        "<scene version='3.0.0'><default name='a' value=''/><shape type='{}'/></scene>",
        "$a".repeat(3_000_000)
    );
    refused(&empty, "too many or too long substitutions");
}

#[test]
fn entities_are_refused() {
    let bomb = "<!DOCTYPE s [<!ENTITY a 'ha'><!ENTITY b '&a;&a;&a;'>]><scene version='3.0.0'>&b;</scene>";
    refused(bomb, "document type declarations and entities are refused");
    refused("<!DOCTYPE s SYSTEM 'file:///etc/passwd'><scene version='3.0.0'/>", "document type");
}

#[test]
fn odd_bytes() {
    for text in [
        "",
        "<",
        "<>",
        "</>",
        "<!",
        "<!-",
        "<!-->",
        "<?",
        "<?x",
        "<![CDATA[",
        "&",
        "]]>",
        "\0",
        "<scene",
        "<scene version='3",
    ] {
        read_scene_str(text, "t", &[]).expect_err(text);
    }
    refused("<scene version='3.0.0'>\n<shape type='\u{1}'/></scene>", "t:2: scene: not XML");
}

const SAMPLES: [&str; 6] = [
    include_str!("../../../../experiments/scenes/ball-lens.xml"),
    include_str!("../../../../experiments/scenes/ball-lens-lamp.xml"),
    include_str!("../../../../experiments/scenes/cornell-box.xml"),
    include_str!("../../../../experiments/scenes/cube.xml"),
    include_str!("../../../../experiments/scenes/integrating-sphere.xml"),
    include_str!("../../../../experiments/scenes/square-lamp.xml"),
];

/// One change to the text: at a place, over a length, of a kind.
type Change = (usize, usize, u8, char);

fn mutate(text: &str, changes: &[Change]) -> String {
    let mut chars: Vec<char> = text.chars().collect();
    for &(place, length, kind, letter) in changes {
        if chars.is_empty() {
            break;
        }
        let start = place % chars.len();
        let end = (start + length).min(chars.len());
        match kind % 4 {
            0 => chars[start] = letter,
            1 => drop(chars.drain(start..end)),
            2 => {
                let copy = chars[start..end].to_vec();
                chars.splice(start..start, copy);
            }
            _ => {
                let copy = chars[start..end].to_vec();
                let target = (place / 7) % chars.len();
                chars.splice(target..target, copy);
            }
        }
    }
    chars.into_iter().collect()
}

fn letter() -> impl Strategy<Value = char> {
    prop_oneof![
        proptest::sample::select("<>/'\"=$&#-.e0123456789 \n!?[]:xyz\0\u{feff}\u{7f}é".chars().collect::<Vec<_>>()),
        any::<char>()
    ]
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 6000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn mutated_samples_are_answered(
        which in 0..SAMPLES.len(),
        changes in proptest::collection::vec((any::<usize>(), 1..80usize, any::<u8>(), letter()), 1..6),
    ) {
        if let Err(error) = read_scene_str(&mutate(SAMPLES[which], &changes), "t", &[]) {
            prop_assert!(error.line >= 1 && !error.to_string().contains('\n'), "{}", error);
        }
    }

    #[test]
    fn numbers_of_any_kind_are_answered(which in 0..SAMPLES.len(), at in any::<usize>(), number in any::<f64>()) {
        let text = SAMPLES[which];
        let values: Vec<usize> = text.match_indices("value=\"").map(|(start, found)| start + found.len()).collect();
        let start = values[at % values.len()];
        let end = start + text[start..].find('"').expect("a closing quote");
        drop(read_scene_str(&format!("{}{number:e}{}", &text[..start], &text[end..]), "t", &[]));
    }

    #[test]
    fn bytes_of_any_kind_are_answered(bytes in proptest::collection::vec(any::<u8>(), 0..200)) {
        drop(read_scene_str(&String::from_utf8_lossy(&bytes), "t", &[]));
    }
}
