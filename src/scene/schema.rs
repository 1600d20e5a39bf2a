//! The JSON schema of scene files, for editors.
//!
//! It says what a scene may look like; what no schema can say (unique names, a step not longer
//! than the run, an inertia that a body can have) only `check` finds.

use schemars::generate::SchemaSettings;
use serde_json::Value;

use crate::scene::description::Scene;

/// The JSON schema (draft-07) of a scene file, as pretty JSON with a newline at the end.
#[must_use]
pub fn schema() -> String {
    let generator = SchemaSettings::draft07().into_generator();
    let mut value = generator.into_root_schema_for::<Scene>().to_value();
    without_null(&mut value);
    // `{:#}` on a JSON value is infallible pretty printing.
    format!("{value:#}\n")
}

/// Removes null, which TOML does not have: an optional key is one that may be left out.
fn without_null(value: &mut Value) {
    match value {
        Value::Object(object) => {
            if object.get("default").is_some_and(Value::is_null) {
                object.remove("default");
            }
            object.remove("format");
            object.values_mut().for_each(without_null);
            if let Some(Value::Array(types)) = object.get_mut("type") {
                types.retain(|kind| kind != "null");
                if let [kind] = &types[..] {
                    let kind = kind.clone();
                    object.insert("type".to_owned(), kind);
                }
            }
            if let Some(Value::Array(choices)) = object.get_mut("anyOf") {
                choices.retain(|choice| choice.get("type").is_none_or(|kind| kind != "null"));
                if let [Value::Object(choice)] = &choices[..] {
                    let choice = choice.clone();
                    object.remove("anyOf");
                    if choice.contains_key("$ref") {
                        // Draft-07 readers ignore what stands beside a `$ref`.
                        object.insert("allOf".to_owned(), Value::Array(vec![choice.into()]));
                    } else {
                        object.extend(choice);
                    }
                }
            }
        }
        Value::Array(items) => items.iter_mut().for_each(without_null),
        _ => {}
    }
}
