//! Ranges of the data behind the methods.
//!
//! Holtrop and Mennen print ranges by type of ship (Int. Shipbuilding Progress 25, 1978): C_P 0.55 to 0.85, L/B 3.9 to
//! 9.5, Fn to 0.45. For the sets of 1982 and 1984 handbooks quote L/B to 14.9, B/T 2.1 to 4.0, and Fn to 0.80 for that of
//! 1984. Michell's theory has no data: C_B above 0.6 and L/B below 5 are where slenderness is doubtful by custom.

use super::components::Method;

/// A range that a figure leaves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Range {
    /// Symbol of the parameter.
    pub symbol: &'static str,
    /// Its value.
    pub value: f64,
    /// Least and greatest value of the data.
    pub limits: [f64; 2],
}

impl std::fmt::Display for Range {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let [low, high] = self.limits;
        let data = match (low > 0.0, high.is_finite()) {
            (true, true) => format!("{low} to {high}"),
            (true, false) => format!("{low} or more"),
            _ => format!("to {high}"),
        };
        write!(f, "{} {:.3}, data {data}", self.symbol, self.value)
    }
}

/// The ranges of a method that a ship at a Froude number leaves: L/B, B/T, C_P, C_B on the length of the waterline.
#[must_use]
pub fn outside(method: Method, froude: f64, [lb, bt, cp, cb]: [f64; 4]) -> Vec<Range> {
    let holtrop = |most: f64| {
        vec![("Fn", froude, [0.0, most]), ("C_P", cp, [0.55, 0.85]), ("L/B", lb, [3.9, 14.9]), ("B/T", bt, [2.1, 4.0])]
    };
    let ranges = match method {
        Method::Holtrop1982 => holtrop(0.45),
        Method::Holtrop1984 => holtrop(0.80),
        Method::Michell => vec![("C_B", cb, [0.0, 0.6]), ("L/B", lb, [5.0, f64::INFINITY])],
        Method::Ittc57 => Vec::new(),
    };
    let left = ranges.into_iter().filter(|(_, value, [low, high])| !(low..=high).contains(&value));
    left.map(|(symbol, value, limits)| Range { symbol, value, limits }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_method_names_what_leaves_its_data() {
        let symbols = |method, froude, form| -> Vec<&str> {
            outside(method, froude, form).iter().map(|range| range.symbol).collect()
        };
        let ship = [6.0, 3.0, 0.6, 0.55];
        assert!(symbols(Method::Holtrop1982, 0.3, ship).is_empty());
        assert_eq!(symbols(Method::Holtrop1982, 0.5, ship), ["Fn"]);
        assert!(symbols(Method::Holtrop1984, 0.5, ship).is_empty());
        assert_eq!(symbols(Method::Holtrop1984, 0.9, [3.0, 5.0, 0.5, 0.4]), ["Fn", "C_P", "L/B", "B/T"]);
        assert_eq!(symbols(Method::Michell, 0.3, [4.0, 3.0, 0.8, 0.7]), ["C_B", "L/B"]);
        assert!(symbols(Method::Ittc57, 9.0, [1.0; 4]).is_empty());
        let text = outside(Method::Holtrop1982, 0.5, ship)[0].to_string();
        assert_eq!(text, "Fn 0.500, data to 0.45");
    }
}
