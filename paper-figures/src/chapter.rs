//! Words beside the claims.

use pulldown_cmark::{Event, HeadingLevel, Parser, Tag, TagEnd, html::push_html};
use serde::Serialize;

/// A text of the report, in Markdown. Its first heading is its title.
#[derive(Clone, Copy, Debug)]
pub struct Chapter<'a> {
    /// Its anchor on the page.
    pub id: &'a str,
    /// Markdown. Links to files lead nowhere from a page that travels alone, so of these the words stay; HTML is shown as it is written.
    pub text: &'a str,
}

/// A chapter ready to be written.
#[derive(Serialize)]
pub(crate) struct ChapterPage<'a> {
    id: &'a str,
    title: String,
    html: String,
}

impl<'a> ChapterPage<'a> {
    pub(crate) fn new(chapter: &Chapter<'a>) -> Self {
        let (title, text) = match chapter.text.trim_start().split_once('\n') {
            Some((first, rest)) if first.starts_with("# ") => (first[2..].trim().to_string(), rest),
            _ => (chapter.id.to_string(), chapter.text),
        };
        let (mut html, mut links) = (String::new(), Vec::new());
        push_html(&mut html, Parser::new(text).filter_map(|event| on_the_page(event, &mut links)));
        Self { id: chapter.id, title, html }
    }
}

/// Headings one level deeper, below the chapter's own; only links that lead out stay links. `links` are the open ones, whether they do.
fn on_the_page<'t>(event: Event<'t>, links: &mut Vec<bool>) -> Option<Event<'t>> {
    match event {
        Event::Html(text) | Event::InlineHtml(text) => Some(Event::Text(text)),
        Event::Start(Tag::Heading { classes, attrs, level, .. }) => {
            Some(Event::Start(Tag::Heading { level: deeper(level), id: None, classes, attrs }))
        }
        Event::End(TagEnd::Heading(level)) => Some(Event::End(TagEnd::Heading(deeper(level)))),
        Event::Start(Tag::Link { ref dest_url, .. }) => {
            links.push(dest_url.starts_with("https://") || dest_url.starts_with("http://"));
            links.last().is_some_and(|leads_out| *leads_out).then_some(event)
        }
        Event::End(TagEnd::Link) => links.pop().is_some_and(|leads_out| leads_out).then_some(event),
        Event::Start(Tag::Image { .. }) | Event::End(TagEnd::Image) => None,
        other => Some(other),
    }
}

fn deeper(level: HeadingLevel) -> HeadingLevel {
    HeadingLevel::try_from(level as usize + 1).unwrap_or(HeadingLevel::H6)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_text_becomes_a_chapter() {
        let text = "# Bias\n\nSee [out](https://example.org), not [here](here.md).\n\n## Of <b>scenes</b>\n";
        let page = ChapterPage::new(&Chapter { id: "bias", text });
        assert_eq!(page.title, "Bias");
        assert!(
            page.html.contains("<a href=\"https://example.org\">out</a>") && !page.html.contains("here.md"),
            "{}",
            page.html
        );
        assert!(page.html.contains("<h3>") && page.html.contains("&lt;b&gt;scenes"), "{}", page.html);
    }
}
