//! JSON has no infinity and no NaN: whoever writes one is told where.

use serde_json::{Number, Value};

/// A number that JSON cannot hold. (serde_json would write `null` in silence.)
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{field} is {value}: JSON cannot hold it; say what failed instead")]
pub struct NotFinite {
    /// Where the number stands, e.g. `comparisons[2].measured.low`.
    pub field: String,
    /// The number.
    pub value: f64,
}

/// A number for a row of a record; refuses what JSON cannot hold.
///
/// `serde_json::json!(f64::NAN)` gives `null`: use this for computed numbers.
pub fn json_number(field: &str, value: f64) -> Result<Value, NotFinite> {
    Number::from_f64(value).map(Value::Number).ok_or_else(|| NotFinite { field: field.to_owned(), value })
}

/// Accepts finite numbers; the error names the field as `at.name`, or `name` at the top.
pub(crate) fn finite(at: &str, name: &str, value: f64) -> Result<(), NotFinite> {
    if value.is_finite() {
        return Ok(());
    }
    let field = if at.is_empty() { name.to_owned() } else { format!("{at}.{name}") };
    Err(NotFinite { field, value })
}

/// As [`finite`]; what is absent is fine.
pub(crate) fn finite_if_some(at: &str, name: &str, value: Option<f64>) -> Result<(), NotFinite> {
    value.map_or(Ok(()), |x| finite(at, name, x))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_error_names_the_field() {
        assert!(finite("a", "b", 1.0).is_ok());
        assert_eq!(finite("a", "b", f64::NAN).unwrap_err().field, "a.b");
        assert_eq!(json_number("visits", f64::INFINITY).unwrap_err().field, "visits");
        assert_eq!(json_number("visits", 2.5).unwrap(), serde_json::json!(2.5));
    }
}
