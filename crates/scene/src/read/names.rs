//! Quoting the file's words in messages, and putting the likeliest correction first.

/// Longest piece of the file that a message repeats, in characters.
const QUOTE_LIMIT: usize = 48;
/// Most names that a message lists.
const LIST_LIMIT: usize = 24;

/// The text in quotes, cut to a readable length, with control characters escaped.
pub(crate) fn quote(text: &str) -> String {
    let mut chars = text.chars();
    let shown: String = chars.by_ref().take(QUOTE_LIMIT).collect();
    let rest = if chars.next().is_some() { "..." } else { "" };
    format!("\"{}{rest}\"", shown.escape_debug())
}

/// The names, those most like `wanted` first, separated by commas; `(none)` if there are none.
pub(super) fn nearest_first<'n>(wanted: &str, names: impl IntoIterator<Item = &'n str>) -> String {
    let mut ranked: Vec<(usize, &str)> = names.into_iter().map(|name| (distance(wanted, name), name)).collect();
    ranked.sort();
    ranked.dedup();
    if ranked.is_empty() {
        return "(none)".to_owned();
    }
    let more = if ranked.len() > LIST_LIMIT { ", ..." } else { "" };
    let shown: Vec<String> = ranked.iter().take(LIST_LIMIT).map(|(_, name)| shortened(name)).collect();
    shown.join(", ") + more
}

fn shortened(name: &str) -> String {
    let quoted = quote(name);
    quoted[1..quoted.len() - 1].to_owned()
}

/// Levenshtein distance over the first characters of both, small and capital letters alike.
fn distance(a: &str, b: &str) -> usize {
    let fold = |text: &str| text.chars().take(QUOTE_LIMIT).map(|c| c.to_ascii_lowercase()).collect::<Vec<char>>();
    let (a, b) = (fold(a), fold(b));
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, from) in a.iter().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, to) in b.iter().enumerate() {
            let replaced = diagonal + usize::from(from != to);
            diagonal = row[j + 1];
            row[j + 1] = replaced.min(diagonal + 1).min(row[j] + 1);
        }
    }
    row[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distance_counts_edits() {
        assert_eq!(distance("kitten", "sitting"), 3);
        assert_eq!(distance("", "abc"), 3);
        assert_eq!(distance("Radius", "radius"), 0);
    }

    #[test]
    fn the_likeliest_name_comes_first() {
        assert_eq!(nearest_first("raduis", ["center", "to_world", "radius"]), "radius, center, to_world");
        assert_eq!(nearest_first("x", []), "(none)");
    }

    #[test]
    fn quotes_are_short_and_on_one_line() {
        assert_eq!(quote("a\nb"), "\"a\\nb\"");
        assert!(quote(&"x".repeat(1000)).len() < 60);
    }
}
