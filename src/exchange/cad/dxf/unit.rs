//! The unit of length of a DXF file: $INSUNITS of its header, or a comment of its first lines.

/// Metres in the units of $INSUNITS, from 1: inch, foot, mile, millimetre, centimetre, metre, kilometre, microinch, mil,
/// yard, angstrom, nanometre, micron, decimetre, decametre, hectometre, gigametre, astronomical unit, light year,
/// parsec, and foot, inch, yard and mile of the US survey.
const UNITS: [f64; 24] = [
    0.0254,
    0.3048,
    1609.344,
    1e-3,
    1e-2,
    1.0,
    1e3,
    2.54e-8,
    2.54e-5,
    0.9144,
    1e-10,
    1e-9,
    1e-6,
    0.1,
    10.0,
    100.0,
    1e9,
    149_597_870_700.0,
    9_460_730_472_580_800.0,
    3.085_677_581_491_367e16,
    1200.0 / 3937.0,
    100.0 / 3937.0,
    3600.0 / 3937.0,
    6_336_000.0 / 3937.0,
];

/// Words of a comment `UNITS: ...`.
const WORDS: [(&str, f64); 10] = [
    ("MILLIMETRE", 1e-3),
    ("MILLIMETER", 1e-3),
    ("CENTIMETRE", 1e-2),
    ("CENTIMETER", 1e-2),
    ("METRE", 1.0),
    ("METER", 1.0),
    ("INCH", 0.0254),
    ("FEET", 0.3048),
    ("FOOT", 0.3048),
    ("MM", 1e-3),
];

/// Metres in the unit of a code of $INSUNITS; none of 0, which is no unit, and of codes that are not known.
pub(super) fn of_code(code: i64) -> Option<f64> {
    usize::try_from(code).ok()?.checked_sub(1).and_then(|k| UNITS.get(k)).copied()
}

/// Metres in the unit of a comment, as `UNITS: METRES, FULL SIZE`.
pub(super) fn of_comment(comment: &str) -> Option<f64> {
    let upper = comment.to_ascii_uppercase();
    let (_, rest) = upper.split_once("UNITS:")?;
    let word = rest.split([',', ';']).next()?.trim();
    WORDS.iter().find(|(name, _)| word.starts_with(name)).map(|(_, unit)| *unit)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_are_those_of_the_format() {
        for (code, metres) in [(1, 0.0254), (2, 0.3048), (4, 1e-3), (6, 1.0), (14, 0.1), (21, 0.304_800_609_6)] {
            assert!((of_code(code).unwrap() / metres - 1.0).abs() < 1e-9, "{code}");
        }
        assert!([0, -1, 25, i64::MAX].into_iter().all(|code| of_code(code).is_none()));
        let comment = of_comment("UNITS: MILLIMETRES, FULL SIZE").unwrap();
        assert!((comment - 1e-3).abs() < 1e-18);
        assert_eq!((of_comment("UNITS: ELLS"), of_comment("metres")), (None, None));
    }
}
