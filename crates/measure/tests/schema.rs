//! The JSON of `measure` against the schema that users are given.

use std::collections::BTreeMap;

use photonlab_measure::{FluxBook, FluxLedger, Measurement, Need, Place, Reading, Replicates, Stopped};
use photonlab_photometry::Quantity;
use serde_json::Value;

fn place(cell: [u32; 2]) -> Place {
    Place { sensor: "floor".into(), quantity: Quantity::Illuminance, cell, channel: "Y".into() }
}

fn example() -> Measurement {
    let maps: Replicates = [892.1, 893.5, 892.9, 892.6].into_iter().collect();
    let book = FluxBook {
        emitted: vec![628318.5],
        absorbed: vec![628317.5],
        escaped: vec![0.0],
        cut_off: vec![1.0],
        roulette: vec![0.0],
    };
    let measured = Reading::from_replicates(place([0, 0]), &maps, 0.95, Some(0.4)).unwrap();
    Measurement {
        scene: "cube.xml".into(),
        method: "final-gather".into(),
        command: None,
        seed: 7,
        threads: 2,
        photons: 1_000_000,
        seconds: 1.25,
        peak_bytes: None,
        stopped: Stopped::Target,
        channels: vec!["Y".into()],
        needs: vec![Need { need: "one channel".into(), reason: "every colour is grey".into() }],
        ledger: FluxLedger { total: book.clone(), classes: BTreeMap::from([("direct".into(), book)]) },
        readings: vec![
            measured.with_support(400.0, Some(0.05)).unwrap(),
            Reading::nothing(place([1, 0]), "no photon within the radius"),
        ],
    }
}

/// The part of JSON Schema that `measure.schema.json` uses; the first violation, with its place.
fn violation(root: &Value, schema: &Value, value: &Value, at: &str) -> Option<String> {
    if let Some(reference) = schema["$ref"].as_str() {
        return violation(root, root.pointer(&reference[1..]).expect("a reference that exists"), value, at);
    }
    let kinds: Vec<&str> = match &schema["type"] {
        Value::String(kind) => vec![kind],
        Value::Array(kinds) => kinds.iter().filter_map(Value::as_str).collect(),
        _ => vec![],
    };
    if !kinds.is_empty() && !kinds.iter().any(|kind| is_of_type(value, kind)) {
        return Some(format!("{at}: {value} is not {kinds:?}"));
    }
    if let Some(words) = schema["enum"].as_array()
        && !words.contains(value)
    {
        return Some(format!("{at}: {value} is not one of {words:?}"));
    }
    if value.as_f64() < schema["minimum"].as_f64() && value.is_number() {
        return Some(format!("{at}: {value} is too small"));
    }
    violation_in_object(root, schema, value, at).or_else(|| violation_in_list(root, schema, value, at))
}

fn violation_in_object(root: &Value, schema: &Value, value: &Value, at: &str) -> Option<String> {
    let object = value.as_object()?;
    let required = schema["required"].as_array().into_iter().flatten().filter_map(Value::as_str);
    if let Some(missing) = required.into_iter().find(|key| !object.contains_key(*key)) {
        return Some(format!("{at}: {missing} is missing"));
    }
    let properties = schema["properties"].as_object()?;
    object.iter().find_map(|(key, item)| match properties.get(key) {
        Some(property) => violation(root, property, item, &format!("{at}.{key}")),
        None => Some(format!("{at}: {key} is not in the schema")),
    })
}

fn violation_in_list(root: &Value, schema: &Value, value: &Value, at: &str) -> Option<String> {
    let list = value.as_array()?;
    let length = Some(list.len() as u64);
    if length < schema["minItems"].as_u64() || schema["maxItems"].as_u64().is_some_and(|most| length > Some(most)) {
        return Some(format!("{at}: {} items", list.len()));
    }
    list.iter().enumerate().find_map(|(i, item)| violation(root, &schema["items"], item, &format!("{at}[{i}]")))
}

fn is_of_type(value: &Value, kind: &str) -> bool {
    match kind {
        "object" => value.is_object(),
        "array" => value.is_array(),
        "string" => value.is_string(),
        "integer" => value.is_u64() || value.is_i64(),
        "number" => value.is_number(),
        "boolean" => value.is_boolean(),
        "null" => value.is_null(),
        other => panic!("a type this test does not know: {other}"),
    }
}

fn check(value: &Value) -> Option<String> {
    let schema: Value = serde_json::from_str(include_str!("../measure.schema.json")).unwrap();
    violation(&schema, &schema, value, "measurement")
}

#[test]
fn a_measurement_satisfies_the_schema_and_comes_back() {
    let text = example().to_json().unwrap();
    assert_eq!(check(&serde_json::from_str(&text).unwrap()), None);
    assert_eq!(serde_json::from_str::<Measurement>(&text).unwrap(), example());
    let with_command = Measurement { command: Some("photonlab measure cube.xml".into()), ..example() };
    assert_eq!(check(&serde_json::to_value(with_command).unwrap()), None);
}

/// The check itself must notice: one field dropped, one of a wrong type, one unknown.
#[test]
fn the_check_notices_violations() {
    let good = serde_json::to_value(example()).unwrap();
    for key in ["scene", "stopped", "ledger"] {
        let mut bad = good.clone();
        bad.as_object_mut().unwrap().remove(key);
        assert!(check(&bad).is_some_and(|v| v.contains(key)));
    }
    for (pointer, value) in [
        ("/readings/0/unit", Value::from("lux")),
        ("/readings/0/cell", Value::from(vec![1])),
        ("/readings/1/certified", Value::Null),
        ("/ledger/emitted/0", Value::Null),
        ("/threads", Value::from(0)),
    ] {
        let mut bad = good.clone();
        *bad.pointer_mut(pointer).unwrap() = value;
        assert!(check(&bad).is_some(), "{pointer}");
    }
}

#[test]
fn the_readings_fields_stand_in_the_schemas_order() {
    let schema: Value = serde_json::from_str(include_str!("../measure.schema.json")).unwrap();
    let text = serde_json::to_string(&example().readings[0]).unwrap();
    let required = schema.pointer("/properties/readings/items/required").unwrap().as_array().unwrap();
    let places: Vec<usize> = required.iter().map(|key| text.find(&format!("{key}:")).unwrap()).collect();
    assert!(places.is_sorted(), "{text}");
}

#[test]
fn a_number_json_cannot_hold_is_refused_by_name() {
    let mut bad = example();
    bad.ledger.classes.get_mut("direct").unwrap().escaped[0] = f64::NAN;
    assert_eq!(bad.to_json().unwrap_err().field, "ledger.classes.direct.escaped[0]");
    let mut bad = example();
    bad.readings[1].radius = Some(f64::INFINITY);
    assert_eq!(bad.to_json().unwrap_err().field, "readings[1].radius");
}
