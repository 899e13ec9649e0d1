//! Numbers in files: the shortest decimal that reads back the same, and nothing that is not finite.

use serde_json::Value;

use crate::units::guarded;

/// The nearest multiple of 10^-decimals, for numbers that people read: what is beyond is rounding of how it was computed.
pub(super) fn to_decimals(value: f64, decimals: usize) -> f64 {
    let unit = 10f64.powi(decimals as i32);
    (value * unit).round() / unit
}

/// The number, or null; a negative zero is zero.
pub(super) fn json_number(value: Option<f64>) -> Value {
    value.and_then(|value| serde_json::Number::from_f64(value + 0.0)).map_or(Value::Null, Value::Number)
}

/// The number, or an empty cell; a negative zero is zero.
pub(super) fn cell(value: Option<f64>) -> String {
    match value {
        Some(value) if value.is_finite() => format!("{}", value + 0.0),
        _ => String::new(),
    }
}

/// One CSV line with quotes where they are needed; no text of it is a formula.
pub(super) fn line(fields: &[String]) -> String {
    let quote = |field: &String| {
        let field = guarded(field);
        if field.contains([',', '"', '\n', '\r']) {
            format!("\"{}\"", field.replace('"', "\"\""))
        } else {
            field.into_owned()
        }
    };
    let mut line = fields.iter().map(quote).collect::<Vec<_>>().join(",");
    line.push('\n');
    line
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_that_is_not_finite_is_written() {
        assert_eq!(cell(Some(f64::NAN)), "");
        assert_eq!(cell(Some(-0.0)), "0");
        assert_eq!(cell(Some(0.1)), "0.1");
        assert_eq!(json_number(Some(f64::INFINITY)), Value::Null);
        assert_eq!(json_number(Some(-0.0)).to_string(), "0.0");
        assert_eq!(line(&["=a,b".into(), "-1.5".into(), "-".into()]), "\"'=a,b\",-1.5,-\n");
        assert_eq!(line(&["a,b".into(), "c\"d".into(), "e".into()]), "\"a,b\",\"c\"\"d\",e\n");
    }
}
