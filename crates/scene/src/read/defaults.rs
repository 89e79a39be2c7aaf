//! `default` and `$name`: values that the caller may replace.

use std::collections::{HashMap, HashSet};

use super::error::Fault;
use super::names::{nearest_first, quote};

/// Longest name of a default, in bytes.
const NAME_LIMIT: usize = 64;
/// Most substitutions in a scene.
const COUNT_LIMIT: usize = 1 << 20;
/// Most bytes that substitutions of a scene write.
const LENGTH_LIMIT: usize = 1 << 26;

/// The values known so far, and those that the caller wants instead.
pub(super) struct Defaults {
    defines: HashMap<String, String>,
    values: HashMap<String, String>,
    /// The caller's names that stood somewhere without a default.
    bare: HashSet<String>,
    substitutions: usize,
    written: usize,
}

impl Defaults {
    /// With what the caller defines (`-D NAME=VALUE`).
    pub(super) fn new(defines: &[(String, String)]) -> Result<Self, Fault> {
        let mut map = HashMap::new();
        for (name, value) in defines {
            if map.insert(name.clone(), value.clone()).is_some() {
                return Err(Fault::new(format!("-D {} is given twice", quote(name)), "give it once"));
            }
        }
        Ok(Defaults { defines: map, values: HashMap::new(), bare: HashSet::new(), substitutions: 0, written: 0 })
    }

    /// Meets `<default name value>`: the caller's value wins, then the first of the file, as in Mitsuba. Returns the
    /// value that is kept.
    pub(super) fn define(&mut self, name: &str, value: &str) -> Result<&str, Fault> {
        if name.is_empty() || name.len() > NAME_LIMIT {
            return Err(Fault::new(
                "the name is empty or too long",
                format!("give one of 1 to {NAME_LIMIT} characters"),
            ));
        }
        let kept = self.defines.get(name).map_or(value, String::as_str);
        Ok(self.values.entry(name.to_owned()).or_insert_with(|| kept.to_owned()))
    }

    /// True if the caller gave this value.
    pub(super) fn is_given(&self, name: &str) -> bool {
        self.defines.contains_key(name)
    }

    /// The text with every `$name` replaced; what the caller gives needs no default, as in Mitsuba.
    pub(super) fn substitute(&mut self, text: &str) -> Result<String, Fault> {
        let mut pieces = text.split('$');
        let mut result = pieces.next().unwrap_or_default().to_owned();
        for piece in pieces {
            let known = |name: &str| self.defines.get_key_value(name).or_else(|| self.values.get_key_value(name));
            let (name, value) = leading_name(known, piece).ok_or_else(|| self.unknown(piece))?;
            if !self.values.contains_key(name) {
                self.bare.insert(name.to_owned());
            }
            self.substitutions += 1;
            self.written += value.len() + piece.len();
            if self.substitutions > COUNT_LIMIT || self.written > LENGTH_LIMIT {
                return Err(Fault::new("too many or too long substitutions", "use fewer or shorter defaults"));
            }
            result.push_str(value);
            result.push_str(&piece[name.len()..]);
        }
        Ok(result)
    }

    fn unknown(&self, piece: &str) -> Fault {
        let wanted = piece.split(|c| !is_word(c)).next().unwrap_or_default();
        let known = nearest_first(wanted, self.values.keys().map(String::as_str));
        Fault::new(
            format!("{} has no default before this line", quote(&format!("${wanted}"))),
            format!("add a <default> above it, or give it by -D; defined so far: {known}"),
        )
    }

    fn is_met(&self, name: &str) -> bool {
        self.values.contains_key(name) || self.bare.contains(name)
    }

    /// Checks, after the whole scene, that every define of the caller had a default to replace.
    pub(super) fn check_used(&self) -> Result<(), Fault> {
        let mut unused: Vec<&str> = self.defines.keys().map(String::as_str).filter(|name| !self.is_met(name)).collect();
        unused.sort_unstable();
        let Some(name) = unused.first() else {
            return Ok(());
        };
        let known = nearest_first(name, self.values.keys().map(String::as_str));
        Err(Fault::new(
            format!("-D {} names no default of this scene", quote(name)),
            format!("defaults that it has: {known}"),
        ))
    }
}

/// The longest known name that `text` starts with, and its value. A letter or digit after it means that another name
/// was meant (Mitsuba would paste the value and the rest together).
fn leading_name<'v>(
    known: impl Fn(&str) -> Option<(&'v String, &'v String)>,
    text: &str,
) -> Option<(&'v str, &'v str)> {
    let longest = (1..=NAME_LIMIT.min(text.len())).rev();
    let (name, value) = longest.filter_map(|end| known(text.get(..end)?)).next()?;
    (!text[name.len()..].starts_with(is_word)).then_some((name, value))
}

fn is_word(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}
