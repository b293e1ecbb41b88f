//! JSON Schemas of what is printed, made of the types that are printed.

use schemars::transform::{Transform, transform_subschemas};
use schemars::{JsonSchema, Schema, generate::SchemaSettings};
use serde_json::Value;

/// The schema of a type as it is printed. It allows fields that it does not name, as a later version may have them.
pub fn of<T: JsonSchema + ?Sized>(title: &str) -> Schema {
    let settings = SchemaSettings::draft2020_12().for_serialize();
    let settings = settings.with(|settings| settings.inline_subschemas = true).with_transform(Plain);
    let mut schema = settings.into_generator().into_root_schema_for::<T>();
    schema.insert("title".to_owned(), title.into());
    schema
}

/// Takes out what is about Rust, or about reading: doc comments, defaults, widths of numbers, and that no other field
/// is read. Words of which each has a schema become one list.
#[derive(Clone, Debug)]
struct Plain;

impl Transform for Plain {
    fn transform(&mut self, schema: &mut Schema) {
        for about_rust in ["title", "description", "default", "format", "minimum", "maximum"] {
            schema.remove(about_rust);
        }
        for about_reading in ["additionalProperties", "unevaluatedProperties"] {
            if schema.get(about_reading) == Some(&Value::Bool(false)) {
                schema.remove(about_reading);
            }
        }
        transform_subschemas(self, schema);
        if let Some(words) = schema.get("oneOf").and_then(words) {
            schema.remove("oneOf");
            schema.insert("type".to_owned(), "string".into());
            schema.insert("enum".to_owned(), words);
        }
    }
}

/// The words, if each of the schemas is of one word or of several.
fn words(schemas: &Value) -> Option<Value> {
    let words = |schema: &Value| {
        let word = schema.get("const").map(|word| vec![word.clone()]);
        word.or_else(|| schema.get("enum")?.as_array().cloned())
    };
    let words: Option<Vec<Vec<Value>>> = schemas.as_array()?.iter().map(words).collect();
    Some(words?.concat().into())
}

/// Gives types the schema of what they are written as.
#[macro_export]
macro_rules! written_as {
    ($($printed:ty as $written:ty),*) => {$(
        impl ::schemars::JsonSchema for $printed {
            fn inline_schema() -> bool {
                true
            }

            fn schema_name() -> ::std::borrow::Cow<'static, str> {
                <$written>::schema_name()
            }

            fn json_schema(generator: &mut ::schemars::SchemaGenerator) -> ::schemars::Schema {
                <$written>::json_schema(generator)
            }
        }
    )*};
}
