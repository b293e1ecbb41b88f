//! Whether JSON is as a schema in docs/schemas says. Of JSON Schema this knows the words that those schemas have: on
//! any other it panics.

use std::fs;
use std::path::Path;

use serde_json::Value;

/// Panics unless `value` is as docs/schemas/`name`.json says.
pub(crate) fn check(name: &str, value: &Value, printed_by: &str) {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let root = if root.join("docs").is_dir() { root } else { root.parent().expect("the workspace") };
    let schema = fs::read_to_string(root.join(format!("docs/schemas/{name}.json"))).expect("a schema");
    let schema = serde_json::from_str(&schema).expect("JSON");
    if let Err(what) = is_as(&schema, value) {
        panic!("{printed_by}: not as docs/schemas/{name}.json says: {what}\n{value}");
    }
}

/// The faults of `value` by `schema`.
pub(crate) fn is_as(schema: &Value, value: &Value) -> Result<(), String> {
    let words = match schema {
        Value::Bool(true) => return Ok(()),
        Value::Object(words) => words,
        _ => panic!("no schema: {schema}"),
    };
    words.iter().try_for_each(|(word, said)| {
        is_so(word, said, schema, value).map_err(|what| format!("{word}: {what}"))
    })
}

fn is_so(word: &str, said: &Value, schema: &Value, value: &Value) -> Result<(), String> {
    let or = |is_so: bool| if is_so { Ok(()) } else { Err(format!("{value} is not {said}")) };
    let list = || said.as_array().expect("a list");
    let fitting = || list().iter().filter(|schema| is_as(schema, value).is_ok()).count();
    let each = |mut items: &mut dyn Iterator<Item = (&Value, &Value)>| {
        Iterator::try_for_each(&mut items, |(schema, item)| is_as(schema, item))
    };
    let items = value.as_array().map_or(&[][..], Vec::as_slice);
    match word {
        "$schema" | "title" => Ok(()),
        "type" => {
            or(said.as_array().map_or(std::slice::from_ref(said), Vec::as_slice).iter().any(
                |name| match name.as_str().expect("a name") {
                    "null" => value.is_null(),
                    "boolean" => value.is_boolean(),
                    "integer" => value.is_i64() || value.is_u64(),
                    "number" => value.is_number(),
                    "string" => value.is_string(),
                    "array" => value.is_array(),
                    "object" => value.is_object(),
                    name => panic!("no type: {name}"),
                },
            ))
        }
        "const" => or(value == said),
        "enum" => or(list().contains(value)),
        "minItems" => or(!value.is_array() || items.len() as u64 >= said.as_u64().expect("a number")),
        "maxItems" => or(!value.is_array() || items.len() as u64 <= said.as_u64().expect("a number")),
        "prefixItems" => each(&mut list().iter().zip(items)),
        "items" => each(&mut items.iter().map(|item| (said, item))),
        "required" => or(!value.is_object()
            || list().iter().all(|name| value.get(name.as_str().expect("a name")).is_some())),
        "properties" => {
            let fields = said.as_object().expect("fields");
            each(&mut fields.iter().filter_map(|(name, schema)| Some((schema, value.get(name)?))))
        }
        "additionalProperties" => {
            let fields = value.as_object().into_iter().flatten();
            each(
                &mut fields
                    .filter(|(name, _)| schema["properties"].get(name).is_none())
                    .map(|(_, field)| (said, field)),
            )
        }
        "anyOf" => or(fitting() > 0),
        "oneOf" => or(fitting() == 1),
        "allOf" => or(fitting() == list().len()),
        _ => panic!("a word that is not known here: {word} in {schema}"),
    }
}

/// A check that accepts all is none.
#[test]
fn a_value_with_a_wrong_field_is_refused() {
    let schema = serde_json::json!({
        "type": "object",
        "properties": { "a": { "type": ["integer", "null"] }, "b": { "items": { "enum": ["x"] }, "type": "array" } },
        "required": ["a"],
    });
    let fits = |text: &str| is_as(&schema, &serde_json::from_str(text).expect("JSON")).is_ok();
    assert!(fits(r#"{"a":null,"more":1}"#) && fits(r#"{"a":1,"b":["x"]}"#));
    assert!(!fits(r#"{"b":[]}"#) && !fits(r#"{"a":"1"}"#) && !fits(r#"{"a":1,"b":["y"]}"#) && !fits("[]"));
}
