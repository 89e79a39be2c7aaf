//! A look over the raw text before it is parsed, for what would cost too much to parse.
//!
//! The parser takes time quadratic in the attributes of one tag and in nested namespaces, and the walks after it call
//! themselves for nested elements. On text that the parser accepts this scan sees the same markup; on other text the
//! parser stops with an error no later than the scan loses its way.

use super::error::Fault;

/// Deepest nesting of elements, through includes.
pub(super) const DEPTH_LIMIT: usize = 64;
/// Most tags, comments and attributes in all files of a scene.
pub(super) const MARKUP_LIMIT: usize = 1 << 22;
/// Most attributes of one tag; no tag of the format has more than five.
const ATTRIBUTE_LIMIT: usize = 16;

/// Something refused, and the byte at which it starts.
#[derive(Debug)]
pub(super) struct Refusal {
    pub(super) offset: usize,
    pub(super) fault: Fault,
}

/// Counts the tags, comments and attributes of `text`, or refuses it.
pub(super) fn scan(text: &str) -> Result<usize, Refusal> {
    let (mut at, mut depth, mut count) = (0, 0usize, 0);
    while let Some(offset) = text[at..].find('<').map(|found| at + found) {
        let markup = &text[offset..];
        count += 1;
        let length = if markup.starts_with("<!--") {
            past(markup, 4, "-->")
        } else if markup.starts_with("<![CDATA[") {
            past(markup, 9, "]]>")
        } else if markup.starts_with("<?") {
            past(markup, 2, "?>")
        } else if markup.starts_with("<!") {
            return refuse_declaration(offset, markup).map(|()| count);
        } else if markup.starts_with("</") {
            depth = depth.saturating_sub(1);
            past(markup, 2, ">")
        } else {
            let tag = Tag::scan(markup);
            count += tag.attributes;
            depth += usize::from(!tag.closed);
            check(depth, tag.attributes, count).map_err(|fault| Refusal { offset, fault })?;
            tag.length
        };
        let Some(length) = length else { break };
        at = offset + length;
    }
    Ok(count)
}

/// An opening tag, as far as the scan looks at it.
struct Tag {
    /// Bytes up to and including the closing bracket, if there is one.
    length: Option<usize>,
    attributes: usize,
    closed: bool,
}

impl Tag {
    fn scan(markup: &str) -> Tag {
        let (mut quote, mut attributes) = (None, 0);
        for (at, &byte) in markup.as_bytes().iter().enumerate() {
            match (quote, byte) {
                (Some(open), _) if open == byte => quote = None,
                (Some(_), _) => {}
                (None, b'"' | b'\'') => quote = Some(byte),
                (None, b'=') => attributes += 1,
                (None, b'>') => {
                    let closed = markup.as_bytes()[at - 1] == b'/';
                    return Tag { length: Some(at + 1), attributes, closed };
                }
                _ => {}
            }
        }
        Tag { length: None, attributes, closed: false }
    }
}

/// Length of the markup up to and including `end`, looked for from byte `from`.
fn past(markup: &str, from: usize, end: &str) -> Option<usize> {
    markup[from..].find(end).map(|found| from + found + end.len())
}

fn refuse_declaration(offset: usize, markup: &str) -> Result<(), Refusal> {
    if !markup.starts_with("<!DOCTYPE") && !markup.starts_with("<!ENTITY") {
        return Ok(());
    }
    let fault = Fault::new(
        "document type declarations and entities are refused",
        "remove the <!DOCTYPE ...>; use default and include instead",
    );
    Err(Refusal { offset, fault })
}

fn check(depth: usize, attributes: usize, count: usize) -> Result<(), Fault> {
    if depth > DEPTH_LIMIT {
        return Err(Fault::new(format!("more than {DEPTH_LIMIT} elements inside each other"), "nest less deeply"));
    }
    if attributes > ATTRIBUTE_LIMIT {
        return Err(Fault::new(format!("more than {ATTRIBUTE_LIMIT} attributes"), "remove those it does not take"));
    }
    check_count(count)
}

/// Checks the tags, comments and attributes counted so far against the limit.
pub(super) fn check_count(count: usize) -> Result<(), Fault> {
    if count > MARKUP_LIMIT {
        let what = format!("more than {MARKUP_LIMIT} tags, comments and attributes");
        return Err(Fault::new(what, "use a smaller scene"));
    }
    Ok(())
}
