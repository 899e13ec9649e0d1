//! The JSON Schema of the design file, of the method file and of the job file (draft 2020-12), made from their lists of
//! keys.
//!
//! Keys are case-insensitive for the program; an editor sees them in their house spelling.

use serde_json::{Map, Value, json};

use super::job::JOB_KEYS;
use super::keys::{FIGURES, KEYS, Key, Kind};
use super::method::METHOD_KEYS;
use super::table_keys::TABLE_KEYS;

fn number_or_text(examples: &[&str]) -> Value {
    json!({ "type": ["number", "string"], "examples": examples })
}

fn value_schema(kind: Kind) -> Value {
    match kind {
        Kind::Text => json!({ "type": "string" }),
        Kind::Integer(from, to) => json!({ "type": "integer", "minimum": from, "maximum": to }),
        Kind::Number => number_or_text(&["2.5 %"]),
        Kind::Length => number_or_text(&["32250 mm", "62 ft 3 in", "3-4-5+"]),
        Kind::Angle => number_or_text(&["12 deg"]),
        Kind::RawAngle => number_or_text(&["0.13 rad", "7.5 deg"]),
        Kind::Density => number_or_text(&["1025 kg/m3"]),
        Kind::Displacement => number_or_text(&["4050 t", "3951 m3"]),
        Kind::FractionOrLength => number_or_text(&["80 %", "3.2 m"]),
        Kind::Word(words) => json!({ "enum": words }),
        Kind::NumberOrWord(words) => json!({ "anyOf": [{ "type": ["number", "string"] }, { "enum": words }] }),
        Kind::CentreOfBuoyancy => json!({ "type": "string", "examples": ["+0.8 %", "41.0 m AP", "auto"] }),
        Kind::Interval => {
            json!({ "type": "array", "items": { "type": ["number", "string"] }, "minItems": 2, "maxItems": 2 })
        }
        Kind::Positions => json!({ "anyOf": [
            { "type": "array", "items": { "type": ["number", "string"] }, "minItems": 1 },
            { "type": ["number", "string"], "examples": ["1:9:1", "0,5,...,30"] },
            {
                "type": "object",
                "properties": {
                    "from": { "type": ["number", "string"] },
                    "to": { "type": ["number", "string"] },
                    "step": { "type": ["number", "string"] }
                },
                "required": ["from", "to", "step"],
                "additionalProperties": false
            }
        ] }),
        Kind::Numbers => json!({ "type": "array", "items": { "type": "number" } }),
        Kind::Switch => json!({ "type": "boolean" }),
        Kind::Area => json!({ "type": "number", "exclusiveMinimum": 0 }),
        Kind::OrWord(inner, words) => json!({ "anyOf": [value_schema(*inner), { "enum": words }] }),
        Kind::Names => json!({ "type": "array", "items": { "type": ["number", "string"] } }),
        Kind::NamedLengths => json!({ "type": "object", "additionalProperties": { "type": ["number", "string"] } }),
        Kind::SectionAreas => json!({
            "type": ["array", "string"],
            "items": { "type": "array", "items": { "type": "number" }, "minItems": 2, "maxItems": 3 }
        }),
        Kind::Phrases(_) => json!({ "type": ["array", "string"], "items": { "type": "string" } }),
        Kind::NamedAngles(_) => json!({ "type": "object", "additionalProperties": { "type": ["number", "string"] } }),
        Kind::NamedCounts(_) => {
            json!({ "type": "object", "additionalProperties": { "type": "integer", "minimum": 0, "maximum": 99 } })
        }
        Kind::Shell => json!({
            "type": "object",
            "properties": { "thickness": { "type": ["number", "string"] }, "factor": { "type": ["number", "string"] } },
            "minProperties": 1,
            "maxProperties": 1,
            "additionalProperties": false
        }),
        Kind::Figures => {
            let mut names: Vec<&str> = FIGURES.to_vec();
            names.extend(["all", "none"]);
            json!({ "anyOf": [{ "enum": names }, { "type": "array", "items": { "enum": names }, "uniqueItems": true }] })
        }
    }
}

/// The schema of one table of a file with `keys`: its keys and the tables in it.
fn table_schema(keys: &'static [Key], word: &str, table: &str) -> Value {
    let mut properties = Map::new();
    for key in keys.iter().filter(|key| key.table == table) {
        properties.insert(key.name.to_owned(), key_schema(key, word));
    }
    let inside = |key: &&Key| -> Option<&'static str> {
        let rest = match table {
            "" => key.table,
            _ => key.table.strip_prefix(table)?.strip_prefix('.')?,
        };
        rest.split('.').next().filter(|word| !word.is_empty())
    };
    for key in keys {
        if let Some(child) = inside(&key)
            && !properties.contains_key(child)
        {
            let path = if table.is_empty() { child.to_owned() } else { format!("{table}.{child}") };
            properties.insert(child.to_owned(), table_schema(keys, word, &path));
        }
    }
    json!({ "type": "object", "properties": properties, "additionalProperties": false })
}

fn key_schema(key: &Key, word: &str) -> Value {
    let mut schema = value_schema(key.kind);
    if let Some(object) = schema.as_object_mut() {
        let mut description = key.description.to_owned();
        if !key.families.is_empty() {
            description.push_str(&format!(" {word} {} only.", key.families.join(", ")));
        }
        object.insert("description".into(), Value::String(description));
    }
    schema
}

/// The JSON Schema of the design file.
#[must_use]
pub fn design_schema() -> Value {
    let description =
        "A ship's hull in numbers. Plain numbers are SI units and degrees; keys may be written in upper or lower case.";
    file_schema(KEYS, "Family", "loftsman design file", description)
}

/// The JSON Schema of the method file.
#[must_use]
pub fn method_schema() -> Value {
    let description = "How a table of offsets becomes a surface. Plain numbers are metres; keys may be written in upper or lower case.";
    file_schema(METHOD_KEYS, "Method", "loftsman method file", description)
}

/// The JSON Schema of the job file.
#[must_use]
pub fn job_schema() -> Value {
    let description =
        "How a table of offsets is to be faired. Plain numbers are metres; keys may be written in upper or lower case.";
    file_schema(JOB_KEYS, "Job", "loftsman job file", description)
}

/// The JSON Schema of the conventions beside a table of offsets or a body.
#[must_use]
pub fn conventions_schema() -> Value {
    let description = "What a table of offsets or a body does not say of itself. Plain numbers are metres; keys may be written in upper or \
                       lower case.";
    let mut schema = file_schema(TABLE_KEYS, "Conventions", "loftsman conventions of a table", description);
    let number = json!({"type": "number"});
    let points = |of: usize| json!({"type": "array", "items": {"type": "array", "items": number, "minItems": of, "maxItems": of}});
    let others = json!({
        "endings": {
            "type": "object",
            "description": "Profiles of stern and stem, as lists of [z, x] [m].",
            "properties": {"stern": points(2), "stem": points(2)},
            "additionalProperties": false,
        },
        "transom": {
            "type": "object",
            "description": "Plane of the transom: x = x + slope z [m].",
            "properties": {"x": number, "slope": number},
            "additionalProperties": false,
        },
        "line": {
            "type": "array",
            "description": "Knuckles and tangent lines, as lists of [x, y, z] [m].",
            "items": {
                "type": "object",
                "properties": {"name": {"type": "string"}, "kind": {"enum": ["knuckle", "tangent"]}, "points": points(3)},
                "additionalProperties": false,
            },
        },
    });
    if let (Some(Value::Object(own)), Value::Object(others)) = (schema.get_mut("properties"), others) {
        own.extend(others);
    }
    schema
}

fn file_schema(keys: &'static [Key], word: &str, title: &str, description: &str) -> Value {
    let mut schema = table_schema(keys, word, "");
    if let Some(object) = schema.as_object_mut() {
        object.insert("$schema".into(), json!("https://json-schema.org/draft/2020-12/schema"));
        object.insert("title".into(), json!(title));
        object.insert("description".into(), json!(description));
    }
    schema
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_key_stands_in_the_schema_with_its_description() {
        for (schema, keys) in [(design_schema(), KEYS), (method_schema(), METHOD_KEYS), (job_schema(), JOB_KEYS)] {
            for key in keys {
                let mut at = &schema;
                for word in key.table.split('.').filter(|w| !w.is_empty()) {
                    at = &at["properties"][word];
                    assert_eq!(at["additionalProperties"], json!(false), "{}", key.path());
                }
                let found = at["properties"][key.name]["description"].as_str().unwrap();
                assert!(found.starts_with(key.description), "{}", key.path());
            }
            assert_eq!(schema["$schema"], "https://json-schema.org/draft/2020-12/schema");
        }
    }
}
