//! How wide text is, without a font: estimated for a wide sans-serif, so that labels do not collide in any.

/// How much wider bold letters are.
pub(crate) const BOLD: f64 = 1.15;

/// The estimated width of `text` at `size`, in the unit of `size`.
pub(crate) fn width(text: &str, size: f64) -> f64 {
    text.chars().map(em).sum::<f64>() * size
}

fn em(c: char) -> f64 {
    match c {
        'i' | 'j' | 'l' | 't' | 'f' | 'r' | '.' | ',' | ':' | ';' | '\'' | '|' | ' ' | '(' | ')' | '[' | ']' => 0.36,
        '⁰'..='⁹' | '¹' | '²' | '³' | '⁻' => 0.42,
        'm' | 'w' | 'M' | 'W' | '@' | '%' | '×' | '±' | '−' => 0.88,
        'A'..='Z' => 0.70,
        _ => 0.60,
    }
}

/// Breaks `text` at spaces into lines no wider than `most` where its words allow.
pub(crate) fn wrap(text: &str, size: f64, most: f64) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if width(line, size) + width(" ", size) + width(word, size) <= most => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_fit_and_lose_no_word() {
        let text = "relative standard deviation of the illuminance over sixteen replicates";
        let lines = wrap(text, 10.0, 150.0);
        assert!(lines.len() > 1 && lines.iter().all(|line| width(line, 10.0) <= 150.0));
        assert_eq!(lines.join(" "), text);
        assert_eq!(wrap("unbreakable", 10.0, 5.0), ["unbreakable"]);
        assert!(wrap("", 10.0, 5.0).is_empty());
    }
}
