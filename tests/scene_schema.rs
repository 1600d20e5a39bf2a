//! The JSON schema agrees with what the simulator reads: shipped scenes are valid, mistakes that a
//! schema can express are not.
//!
//! The validator below knows the keywords that the schema uses and fails on any other, so that a
//! keyword can never be passed over. (The crates that know all of JSON schema pull in some 75
//! others.)
#![cfg(feature = "cli")]
#![allow(clippy::unwrap_used, reason = "a test that cannot go on should stop")]

use std::fs;
use std::path::Path;

use ga_physics::scene;
use serde_json::Value;

/// Whether `value` is valid against `schema`, a part of `root`.
fn valid(root: &Value, schema: &Value, value: &Value) -> bool {
    let Value::Object(keywords) = schema else { panic!("not a schema: {schema}") };
    keywords.iter().all(|(keyword, argument)| {
        let any =
            |schemas: &Value| -> usize { schemas.as_array().unwrap().iter().filter(|s| valid(root, s, value)).count() };
        let length = argument.as_u64().map(|n| usize::try_from(n).unwrap());
        match keyword.as_str() {
            "$schema" | "title" | "description" | "default" | "definitions" => true,
            "$ref" => {
                let pointer = argument.as_str().unwrap().strip_prefix('#').unwrap();
                valid(root, root.pointer(pointer).unwrap(), value)
            }
            "type" => match argument.as_str().unwrap() {
                "object" => value.is_object(),
                "array" => value.is_array(),
                "number" => value.is_number(),
                "integer" => value.is_i64() || value.is_u64(),
                "string" => value.is_string(),
                "boolean" => value.is_boolean(),
                other => panic!("unknown type {other}"),
            },
            "const" => value == argument,
            "allOf" => any(argument) == argument.as_array().unwrap().len(),
            "anyOf" => any(argument) > 0,
            "oneOf" => any(argument) == 1,
            "minimum" => value.as_f64().is_none_or(|x| x >= argument.as_f64().unwrap()),
            "maximum" => value.as_f64().is_none_or(|x| x <= argument.as_f64().unwrap()),
            "exclusiveMinimum" => value.as_f64().is_none_or(|x| x > argument.as_f64().unwrap()),
            "minLength" => value.as_str().is_none_or(|text| text.chars().count() >= length.unwrap()),
            "minItems" => value.as_array().is_none_or(|items| items.len() >= length.unwrap()),
            "maxItems" => value.as_array().is_none_or(|items| items.len() <= length.unwrap()),
            "items" => value.as_array().is_none_or(|items| items.iter().all(|item| valid(root, argument, item))),
            "required" => value.as_object().is_none_or(|object| {
                let keys = argument.as_array().unwrap().iter();
                keys.map(|key| key.as_str().unwrap()).all(|key| object.contains_key(key))
            }),
            "properties" => value.as_object().is_none_or(|object| {
                let properties = argument.as_object().unwrap().iter();
                properties
                    .filter_map(|(key, schema)| Some((schema, object.get(key)?)))
                    .all(|(schema, item)| valid(root, schema, item))
            }),
            "additionalProperties" => {
                assert_eq!(argument, &Value::Bool(false));
                let known = keywords.get("properties").unwrap();
                value.as_object().is_none_or(|o| o.keys().all(|key| known.get(key).is_some()))
            }
            other => panic!("the validator does not know `{other}`"),
        }
    })
}

fn is_valid(text: &str) -> bool {
    let schema: Value = serde_json::from_str(&scene::schema()).unwrap();
    let value: Value = toml::from_str(text).unwrap();
    valid(&schema, &schema, &value)
}

#[test]
fn shipped_scenes_are_valid() {
    let scenes = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes");
    let mut count = 0;
    for entry in fs::read_dir(scenes).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|e| e == "toml") {
            assert!(is_valid(&fs::read_to_string(&path).unwrap()), "{}", path.display());
            count += 1;
        }
    }
    assert!(count >= 4, "{count} scenes");
}

#[test]
fn the_schema_beside_the_scenes_is_current() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes/scene.schema.json");
    if std::env::var_os("UPDATE_GOLDEN").is_some() {
        fs::write(&path, scene::schema()).unwrap();
    }
    // As values: the order of keys is no part of the schema.
    let on_disk: Value = serde_json::from_str(&fs::read_to_string(&path).unwrap()).unwrap();
    let current: Value = serde_json::from_str(&scene::schema()).unwrap();
    assert_eq!(on_disk, current, "run UPDATE_GOLDEN=1 cargo test --test scene_schema");
}

#[test]
fn what_is_read_is_valid_and_what_is_not_is_not() {
    let body = |rest: &str| format!("[[body]]\nname = \"a\"\nmass_kg = 1\n{rest}");
    let force = |rest: &str| format!("{}[[force]]\n{rest}", body("shape.box.size_m = [1, 1, 1]\n"));
    let joint = |rest: &str| format!("{}[[joint]]\n{rest}", body("shape.box.size_m = [1, 1, 1]\n"));
    let good = [
        String::new(),
        "record_hz = 60\nformulation = \"rotor\"\n[solver]\nscalar = \"f32\"\n".into(),
        body("inertia_kg_m2 = [1, 2, 3]\n"),
        body("inertia_kg_m2 = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]\n"),
        body("shape.pyramid = { base_m = 1, height_m = 1 }\norientation.rotor = [1, 0, 0, 0]\n"),
        force("at_point = { body = \"a\", force_world_n = [1, 0, 0] }\n"),
        force("linear_drag = { body = \"a\", k_kg_s = 1 }\n"),
        force("torque = { body = \"a\", torque_world_n_m = [0, 0, 1] }\n"),
        force("spring = { a = \"a\", to_m = [0, 0, 3], stiffness_n_m = 1 }\n"),
        joint("ball = { a = \"a\", point_m = [0, 0, 1] }\n"),
        joint("hinge = { a = \"a\", point_m = [0, 0, 1], axis = [0, 1, 0] }\n"),
        joint("distance = { a = \"a\", at_a_body_m = [0, 0, 1], to_m = [0, 0, 2], length_m = 1 }\n"),
        body("formulation = \"matrix\"\nshape.cone = { radius_m = 1, height_m = 1 }\n"),
    ];
    let bad = [
        "dt_s = -1".into(),
        "formulation = \"dual\"\n".into(),
        "gravity_m_s2 = [0, -9.81]\n".into(),
        "colour = 1\n".into(),
        "[contact]\nrestitution = 1.5\n".into(),
        "[solver]\nscaler = \"f32\"\n".into(),
        "[[body]]\nmass_kg = 1\n".into(),
        body("scale = 0\nshape.box.size_m = [1, 1, 1]\n"),
        body("inertia_kg_m2 = [1, 2]\n"),
        body("shape.box.size = [1, 1, 1]\n"),
        body("shape = \"box\"\n"),
        body("shape.box.size_m = [1, 1, 1]\nshape.pyramid = { base_m = 1, height_m = 1 }\n"),
        body("shape.tetrahedron.vertices_m = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]\n"),
        force(""),
        force("at_point = { body = \"a\" }\n"),
        force("linear_drag = { body = \"a\", k_kg_s = -1 }\n"),
        force("torque = { body = \"a\" }\n"),
        joint(""),
        joint("ball = { a = \"a\" }\n"),
        joint("hinge = { a = \"a\", point_m = [0, 0, 1] }\n"),
        joint("distance = { a = \"a\", to_m = [0, 0, 2], length_m = 0 }\n"),
        body("shape.ball.radius_m = -1\n"),
    ];
    let complete = |text: &str| match text.strip_prefix("dt_s") {
        Some(_) => format!("duration_s = 1\n{text}"),
        None => format!("duration_s = 1\ndt_s = 0.01\n{text}"),
    };
    let reads = |text: &str| scene::parse(scene::SceneSource::from_text("a.toml", text, &[])).is_ok();
    for text in good.map(|text| complete(&text)) {
        assert!(is_valid(&text), "should be valid:\n{text}");
        assert!(reads(&text), "should be read:\n{text}");
    }
    for text in bad.map(|text| complete(&text)) {
        assert!(!is_valid(&text), "should not be valid:\n{text}");
        assert!(!reads(&text), "should not be read:\n{text}");
    }
}

#[test]
fn every_key_is_described_and_no_table_is_open() {
    fn walk(schema: &Value, place: &str) {
        if let Some(properties) = schema.get("properties").and_then(Value::as_object) {
            assert_eq!(schema.get("additionalProperties"), Some(&Value::Bool(false)), "{place}");
            for (key, property) in properties {
                // A kind's own key is described by the kind, one level up or behind its `$ref`.
                let described = property.get("description").or(schema.get("description"));
                assert!(described.is_some(), "{place}.{key} has no description");
            }
        }
        match schema {
            Value::Object(object) => {
                object.iter().for_each(|(key, inner)| walk(inner, &format!("{place}.{key}")));
            }
            Value::Array(items) => items.iter().for_each(|item| walk(item, place)),
            _ => {}
        }
    }
    let schema: Value = serde_json::from_str(&scene::schema()).unwrap();
    assert_eq!(schema["$schema"], "http://json-schema.org/draft-07/schema#");
    walk(&schema, "");
}
