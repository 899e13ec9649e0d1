//! How strongly a table is faired: one dial from the surface through the table to the smoothest that its tolerances have.
//!
//! At grade g, 0 < g <= 10, the weight of the energy and the price of an inflection are those of the default, 5, times
//!
//! ```text
//! weight 10^(0.6 (g - 5)) below 5,  10^(0.3 (g - 5)) above,    price 10^(0.6 (g - 5)).
//! ```
//!
//! From 5 on, a hull with many inflections for its proved least loses more of them ([`Few`]): what these may cost rises by
//! 10^(0.6 (g - 5)), and the factor on the least falls from 1.5 to 1.15.
//!
//! The weight is never less than that whose residuals are the rounding of the table. Grade 0 is of another kind: the fair
//! surface within half the resolution of the table. Where weight and price rise alike above 5, more and more offsets stop
//! at their tolerance and lines bend about them: a Series 60 had 44, 44 and 61 changes of sign at 5, 8 and 10, and has 37,
//! 34 and 34. With a price of 10^(g - 5) it has 30 at 10, but Series 60 Cb 0.60 has 13 times the energy.

use std::fmt;

/// Powers of ten a grade: of the weight below the default and above it, and of the price.
const WEIGHT: [f64; 2] = [0.6, 0.3];
const PRICE: f64 = 0.6;

/// Factors on the least inflections above which a hull has many, at the default and at the top of the dial, and how many
/// more are none too many.
const NEAR_LEAST: [f64; 2] = [1.5, 1.15];
const MORE: f64 = 2.0;

/// Grades with a name.
const NAMED: [(&str, f64); 4] = [("raw", 0.0), ("light", 3.0), ("fair", 5.0), ("smooth", 8.0)];

/// A grade of the dial, from 0 to 10.
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd)]
pub struct Fairness(f64);

impl Fairness {
    /// The names of grades.
    pub const NAMES: [&'static str; 4] = [NAMED[0].0, NAMED[1].0, NAMED[2].0, NAMED[3].0];

    /// The grade; none outside 0 to 10.
    #[must_use]
    pub fn new(grade: f64) -> Option<Self> {
        (0.0..=10.0).contains(&grade).then_some(Self(grade))
    }

    /// The whole grades, from 0 to 10.
    #[must_use]
    pub fn whole() -> [Self; 11] {
        std::array::from_fn(|grade| Self(grade as f64))
    }

    /// The grade of a name.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        NAMED.iter().find(|(known, _)| *known == name).map(|(_, grade)| Self(*grade))
    }

    /// The grade.
    #[must_use]
    pub fn grade(self) -> f64 {
        self.0
    }

    /// Whether the surface goes through the table.
    #[must_use]
    pub fn is_raw(self) -> bool {
        self.0 <= 0.0
    }

    /// Whether a hull is expected to be fairer for it.
    #[must_use]
    pub fn promises_a_fairer_hull(self) -> bool {
        self >= Self::default()
    }

    /// Factor on the proved least inflections above which a hull has many, and 2 more: 1.5 at the default to 1.15 at
    /// the top; none below the default.
    #[must_use]
    pub fn near_least(self) -> Option<f64> {
        let above = (self.0 - Self::default().0) / (10.0 - Self::default().0);
        self.promises_a_fairer_hull().then_some(NEAR_LEAST[0] + above * (NEAR_LEAST[1] - NEAR_LEAST[0]))
    }

    /// When inflections are few; none below the default.
    #[must_use]
    #[doc(hidden)]
    pub fn few(self) -> Option<Few> {
        let dearer = 10f64.powf(PRICE * (self.0 - Self::default().0));
        self.near_least().map(|near_least| Few { near_least, dearer })
    }

    /// The weight over that of the default.
    #[must_use]
    pub fn on_the_weight(self) -> f64 {
        let above = self.0 - Self::default().0;
        10f64.powf(WEIGHT[usize::from(above > 0.0)] * above)
    }

    /// The price of an inflection over that of the default.
    #[must_use]
    pub fn on_the_price(self) -> f64 {
        10f64.powf(PRICE * (self.0 - Self::default().0))
    }
}

/// When the inflections of a hull are few.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Few {
    /// Greatest factor on the proved least of them, and 2 more.
    pub near_least: f64,
    /// Factor on what one may cost to be removed where there are more.
    pub dearer: f64,
}

/// Whether a hull with this many inflections has many for its proved least: more than `factor` times those, and 2.
#[must_use]
pub(super) fn far_above(count: usize, least: usize, factor: f64) -> bool {
    count as f64 > factor * least as f64 + MORE
}

impl Default for Fairness {
    fn default() -> Self {
        Self(5.0)
    }
}

impl fmt::Display for Fairness {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match NAMED.iter().find(|(_, grade)| (grade - self.0).abs() < 1e-12) {
            Some((name, grade)) => write!(f, "{grade} ({name})"),
            None => write!(f, "{}", self.0),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn grades_have_names_and_factors() {
        assert!(Fairness::new(-0.1).is_none() && Fairness::new(10.1).is_none() && Fairness::new(f64::NAN).is_none());
        assert_eq!(Fairness::named("smooth"), Fairness::new(8.0));
        let factors = |grade: f64| {
            let fairness = Fairness::new(grade).unwrap();
            [fairness.on_the_weight().log10(), fairness.on_the_price().log10()]
        };
        for (grade, [weight, price]) in [(3.0, [-1.2, -1.2]), (5.0, [0.0, 0.0]), (10.0, [1.5, 3.0])] {
            let found = factors(grade);
            assert!((found[0] - weight).abs() < 1e-12 && (found[1] - price).abs() < 1e-12, "{grade} {found:?}");
        }
        assert!(Fairness::new(4.9).unwrap().few().is_none());
        for (grade, near_least, dearer) in [(5.0, 1.5, 1.0), (10.0, 1.15, 1e3)] {
            let few = Fairness::new(grade).unwrap().few().unwrap();
            assert!(
                (few.near_least - near_least).abs() < 1e-12 && (few.dearer / dearer - 1.0).abs() < 1e-12,
                "{few:?}"
            );
        }
        let words = [0.0, 5.0, 6.5].map(|grade| Fairness::new(grade).unwrap().to_string());
        assert_eq!(words, ["0 (raw)", "5 (fair)", "6.5"]);
    }
}
