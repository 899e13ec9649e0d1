//! Tables of known hulls drawn at random from a seed: the hull, the places of its stations and waterlines, and the
//! errors of its offsets. The same seed and number give the same table for ever.

mod errors;
mod hulls;
mod measured;
mod places;

use std::fmt::Write;

use loftsman::internals::exchange::read_table;
use loftsman::internals::hull::OffsetTable;
use loftsman::internals::units::Notation;

use crate::partners::{Table, lines};
use crate::random::Random;
use errors::Errors;
use hulls::Truth;

pub(crate) use hulls::{made_fair, text_of_made_fair};
pub(crate) use measured::{Measured, Summary};

/// A table with its truth.
pub(crate) struct Draw {
    number: u64,
    truth: Truth,
    spacing: &'static str,
    errors: Errors,
    pub(crate) table: OffsetTable,
    pub(crate) lines: Vec<lines::Line>,
    samples: Vec<Vec<f64>>,
}

impl Draw {
    pub(crate) fn new(seed: u64, number: u64) -> Self {
        let mut random = Random(seed.wrapping_mul(0x5851_F42D_4C95_7F2D).wrapping_add(number));
        let truth = Truth::drawn(&mut random);
        // A table of less than eight lines shows no hull: other places, then.
        for _ in 0..50 {
            let (spacing, x, z) = places::drawn(&truth, &mut random);
            let errors = Errors::drawn(&truth, &mut random);
            let half = |x: &f64| z.iter().map(|z| truth.half_breadth(*x, *z).unwrap_or(f64::NAN)).collect();
            let mut clean = Table { y: x.iter().map(half).collect(), x, z };
            let lines = lines::lines(&clean);
            if lines.len() < 8 {
                continue;
            }
            errors.apply(&mut clean, &mut random);
            let text = text(&clean, errors, random.below(3) == 0);
            let name = format!("draw-{number}.csv");
            let mut table = read_table(&name, text.as_bytes()).unwrap_or_else(|problems| panic!("{problems:?}")).table;
            if errors == Errors::Eighths && random.below(2) == 0 {
                table.form.notation = Notation::FeetInchesEighths;
                table.form.decimals = None;
            }
            let samples = lines::samples(&lines, |x, z| truth.half_breadth(x, z).unwrap_or(f64::NAN));
            return Self { number, truth, spacing, errors, table, lines, samples };
        }
        panic!("draw {number} of seed {seed}: {} has no table", truth.name);
    }

    pub(crate) fn title(&self) -> String {
        let [rows, columns] = [self.table.stations.len(), self.table.waterlines.len()];
        let errors = self.errors.words();
        format!("{:4} {:15} {:14} {rows:2} x {columns:2} {errors:22}", self.number, self.truth.name, self.spacing)
    }
}

/// The table as people write it; what is outside the hull is left empty, or written as 0 beside an offset.
fn text(table: &Table, errors: Errors, zeros: bool) -> String {
    let mut text = "x_from_AP_m".to_owned();
    table.z.iter().for_each(|z| write!(text, ",{z}").unwrap());
    for (i, x) in table.x.iter().enumerate() {
        write!(text, "\n{x}").unwrap();
        for j in 0..table.z.len() {
            let beside = (i > 0 && table.full(i - 1, j)) || (i + 1 < table.x.len() && table.full(i + 1, j));
            match table.y[i][j] {
                y if y.is_finite() => write!(text, ",{y:.*}", errors.decimals()).unwrap(),
                _ if zeros && beside => text.push_str(",0"),
                _ => text.push(','),
            }
        }
    }
    text.push('\n');
    text
}
