//! JSON with one line for each entry of a record's lists.

use std::io::{Result, Write};

use serde::Serialize;
use serde_json::ser::{Formatter, Serializer};

/// Deepest level that has lines of its own: a record's fields, and what they list.
const LINES: usize = 2;

/// The text: as easy to compare line by line as indented JSON, in half the bytes.
pub(crate) fn to_lines(value: &impl Serialize) -> serde_json::Result<Vec<u8>> {
    let mut text = Vec::new();
    value.serialize(&mut Serializer::with_formatter(&mut text, Lines { level: 0, filled: false }))?;
    text.push(b'\n');
    Ok(text)
}

struct Lines {
    level: usize,
    /// True if the list or object that ends next has an entry.
    filled: bool,
}

impl Lines {
    fn begin<W: ?Sized + Write>(&mut self, out: &mut W, bracket: &[u8]) -> Result<()> {
        (self.level, self.filled) = (self.level + 1, false);
        out.write_all(bracket)
    }

    fn entry<W: ?Sized + Write>(&mut self, out: &mut W, first: bool) -> Result<()> {
        let (comma, space): (&[u8], &[u8]) = if first { (b"", b"") } else { (b",", b" ") };
        out.write_all(comma)?;
        if self.level <= LINES { new_line(out, self.level) } else { out.write_all(space) }
    }

    fn end<W: ?Sized + Write>(&mut self, out: &mut W, bracket: &[u8]) -> Result<()> {
        self.level -= 1;
        if self.filled && self.level < LINES {
            new_line(out, self.level)?;
        }
        self.filled = true;
        out.write_all(bracket)
    }
}

fn new_line<W: ?Sized + Write>(out: &mut W, level: usize) -> Result<()> {
    out.write_all(b"\n")?;
    (0..level).try_for_each(|_| out.write_all(b"  "))
}

impl Formatter for Lines {
    fn begin_array<W: ?Sized + Write>(&mut self, out: &mut W) -> Result<()> {
        self.begin(out, b"[")
    }

    fn end_array<W: ?Sized + Write>(&mut self, out: &mut W) -> Result<()> {
        self.end(out, b"]")
    }

    fn begin_array_value<W: ?Sized + Write>(&mut self, out: &mut W, first: bool) -> Result<()> {
        self.entry(out, first)
    }

    fn end_array_value<W: ?Sized + Write>(&mut self, _: &mut W) -> Result<()> {
        self.filled = true;
        Ok(())
    }

    fn begin_object<W: ?Sized + Write>(&mut self, out: &mut W) -> Result<()> {
        self.begin(out, b"{")
    }

    fn end_object<W: ?Sized + Write>(&mut self, out: &mut W) -> Result<()> {
        self.end(out, b"}")
    }

    fn begin_object_key<W: ?Sized + Write>(&mut self, out: &mut W, first: bool) -> Result<()> {
        self.entry(out, first)
    }

    fn begin_object_value<W: ?Sized + Write>(&mut self, out: &mut W) -> Result<()> {
        out.write_all(b": ")
    }

    fn end_object_value<W: ?Sized + Write>(&mut self, _: &mut W) -> Result<()> {
        self.filled = true;
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::{Value, json};

    #[test]
    fn lists_have_a_line_for_each_entry() {
        let value = json!({"a": [{"x": 1, "y": [2, 3]}, {"x": 4}], "b": [], "c": {"d": {"e": 5}}});
        let text = String::from_utf8(to_lines(&value).expect("JSON")).expect("UTF-8");
        let lines = "{\n  \"a\": [\n    {\"x\": 1, \"y\": [2, 3]},\n    {\"x\": 4}\n  ],\n  \"b\": [],\n  \"c\": {\n    \"d\": {\"e\": 5}\n  }\n}\n";
        assert_eq!(text, lines);
        assert_eq!(serde_json::from_str::<Value>(&text).expect("JSON"), value);
    }
}
