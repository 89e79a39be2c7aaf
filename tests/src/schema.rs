//! The part of JSON Schema that `measure.schema.json` uses.

use serde_json::Value;

/// The first violation of a schema by a value, with its place.
pub fn violation(schema: &Value, value: &Value) -> Option<String> {
    Checker { root: schema }.check(schema, value, "measurement")
}

struct Checker<'s> {
    root: &'s Value,
}

impl Checker<'_> {
    fn check(&self, schema: &Value, value: &Value, at: &str) -> Option<String> {
        if let Some(reference) = schema["$ref"].as_str() {
            let target = self.root.pointer(&reference[1..]).expect("a reference to something in the schema");
            return self.check(target, value, at);
        }
        let kinds: Vec<&str> = match &schema["type"] {
            Value::String(kind) => vec![kind],
            Value::Array(kinds) => kinds.iter().filter_map(Value::as_str).collect(),
            _ => Vec::new(),
        };
        if !kinds.is_empty() && !kinds.iter().any(|kind| is_a(kind, value)) {
            return Some(format!("{at}: {value} is not {}", kinds.join(" or ")));
        }
        if schema["enum"].as_array().is_some_and(|words| !words.contains(value)) {
            return Some(format!("{at}: {value} is not among {}", schema["enum"]));
        }
        if let (Some(least), Some(number)) = (schema["minimum"].as_f64(), value.as_f64())
            && number < least
        {
            return Some(format!("{at}: {number} is below {least}"));
        }
        match value {
            Value::Object(fields) => self.check_fields(schema, fields, at),
            Value::Array(items) => self.check_items(schema, items, at),
            _ => None,
        }
    }

    fn check_fields(&self, schema: &Value, fields: &serde_json::Map<String, Value>, at: &str) -> Option<String> {
        let mut required = schema["required"].as_array().into_iter().flatten().filter_map(Value::as_str);
        if let Some(missing) = required.find(|name| !fields.contains_key(*name)) {
            return Some(format!("{at}: no {missing}"));
        }
        // An object without listed properties is a map from any name.
        let known = schema["properties"].as_object()?;
        fields.iter().find_map(|(name, value)| match known.get(name) {
            Some(property) => self.check(property, value, &format!("{at}.{name}")),
            None => Some(format!("{at}: {name} is unknown to the schema")),
        })
    }

    fn check_items(&self, schema: &Value, items: &[Value], at: &str) -> Option<String> {
        let count = items.len() as u64;
        if schema["minItems"].as_u64().is_some_and(|least| count < least)
            || schema["maxItems"].as_u64().is_some_and(|most| count > most)
        {
            return Some(format!("{at}: {count} items"));
        }
        let each = schema.get("items")?;
        items.iter().enumerate().find_map(|(i, item)| self.check(each, item, &format!("{at}[{i}]")))
    }
}

fn is_a(kind: &str, value: &Value) -> bool {
    match kind {
        "object" => value.is_object(),
        "array" => value.is_array(),
        "string" => value.is_string(),
        "integer" => value.is_i64() || value.is_u64(),
        "number" => value.is_number(),
        "boolean" => value.is_boolean(),
        "null" => value.is_null(),
        other => panic!("the schema uses a type that this check does not know: {other}"),
    }
}
