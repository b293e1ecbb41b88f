//! JSON Schemas, from what the program prints. A schema has every field and type that occurred; a field that was not
//! always there is not required, and one that a later version adds is allowed. The committed file is compared with a fresh
//! one, so no field comes, goes or changes its type without a change that a person reviews.

use std::collections::BTreeMap;
use std::env;
use std::fs;
use std::path::Path;

use serde_json::{Map, Value, json};

/// What values are like.
#[derive(Clone, PartialEq, Eq, Default, Debug)]
pub(crate) struct Shape {
    /// Names of the simple types that occurred.
    simple: Vec<&'static str>,
    items: Option<Box<Shape>>,
    object: Option<Object>,
}

#[derive(Clone, PartialEq, Eq, Default, Debug)]
struct Object {
    /// Each with whether it was always there.
    fields: BTreeMap<String, (Shape, bool)>,
}

impl Shape {
    /// Of all these values.
    pub(crate) fn of<'a>(values: impl IntoIterator<Item = &'a Value>) -> Self {
        values.into_iter().map(Self::one).reduce(Self::or).unwrap_or_default()
    }

    fn one(value: &Value) -> Self {
        let simple = |name| Self { simple: vec![name], ..Self::default() };
        match value {
            Value::Null => simple("null"),
            Value::Bool(_) => simple("boolean"),
            Value::Number(number) if number.is_f64() => simple("number"),
            Value::Number(_) => simple("integer"),
            Value::String(_) => simple("string"),
            Value::Array(items) => Self { items: Some(Box::new(Self::of(items))), ..Self::default() },
            Value::Object(fields) => {
                let fields = fields.iter().map(|(name, value)| (name.clone(), (Self::one(value), true)));
                Self { object: Some(Object { fields: fields.collect() }), ..Self::default() }
            }
        }
    }

    fn or(mut self, other: Self) -> Self {
        self.simple.extend(other.simple);
        self.simple.sort_unstable();
        self.simple.dedup();
        self.items = match (self.items, other.items) {
            (Some(one), Some(other)) => Some(Box::new(one.or(*other))),
            (one, other) => one.or(other),
        };
        self.object = match (self.object, other.object) {
            (Some(one), Some(other)) => Some(one.or(other)),
            (one, other) => one.or(other),
        };
        self
    }

    fn schema(&self) -> Value {
        let mut types: Vec<&str> = self.simple.clone();
        // A whole number is a number, too.
        if types.contains(&"number") {
            types.retain(|name| *name != "integer");
        }
        let mut schema = Map::new();
        if let Some(items) = &self.items {
            types.push("array");
            schema.insert("items".to_owned(), items.schema());
        }
        if let Some(Object { fields }) = &self.object {
            types.push("object");
            let required = fields.iter().filter(|(_, (_, is_always))| *is_always).map(|(name, _)| name);
            let properties = fields.iter().map(|(name, (shape, _))| (name.clone(), shape.schema()));
            schema.insert("required".to_owned(), required.cloned().collect());
            schema.insert("properties".to_owned(), Value::Object(properties.collect()));
        }
        let types = if let [one] = types[..] { json!(one) } else { json!(types) };
        if types != json!([]) {
            schema.insert("type".to_owned(), types);
        }
        Value::Object(schema)
    }
}

impl Object {
    fn or(mut self, other: Self) -> Self {
        for (name, (_, is_always)) in &mut self.fields {
            *is_always &= other.fields.contains_key(name);
        }
        for (name, (shape, is_always)) in other.fields {
            let known = self.fields.remove(&name);
            let merged =
                known.map_or((shape.clone(), false), |(known, both)| (known.or(shape), both && is_always));
            self.fields.insert(name, merged);
        }
        self
    }
}

/// The command that writes the schemas anew.
const RENEW: &str = "SCHEMAS_UPDATE=always cargo test --workspace schema";

/// The committed schema of this name is that of these values.
pub(crate) fn is_up_to_date(name: &str, title: &str, values: &[Value]) {
    let mut schema = Map::new();
    schema.insert("$schema".to_owned(), json!("https://json-schema.org/draft/2020-12/schema"));
    schema.insert("title".to_owned(), json!(title));
    if let Value::Object(fields) = Shape::of(values).schema() {
        schema.extend(fields);
    }
    let fresh = serde_json::to_string_pretty(&schema).expect("JSON") + "\n";
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let root = if root.join("docs").is_dir() { root } else { root.parent().expect("the workspace") };
    let path = root.join(format!("docs/schemas/{name}.json"));
    if env::var_os("SCHEMAS_UPDATE").is_some_and(|value| value == "always") {
        fs::write(&path, fresh).expect("a file that can be written");
        return;
    }
    // A checkout may have changed the ends of lines.
    let committed = fs::read_to_string(&path).unwrap_or_default().replace("\r\n", "\n");
    assert!(
        committed == fresh,
        "what is printed is not as docs/schemas/{name}.json says. If that is meant, write it anew with\n    {RENEW}\nand let \
         schema_version grow if a field has gone or changed"
    );
}
