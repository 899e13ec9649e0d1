//! What is wrong with the offsets of a table.

use super::hulls::Truth;
use crate::partners::Table;
use crate::random::Random;

#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Errors {
    None,
    /// Rounded to multiples \[m\], with the decimals that are written.
    Rounded(f64, usize),
    /// Rounded to eighths of an inch.
    Eighths,
    /// Independent, standard deviation \[m\].
    Noise(f64),
    /// A drawing read askew: every waterline shifted and turned, standard deviations \[m\] at its ends.
    Askew(f64),
    /// A print that stretched: half-breadths by this part, more towards one end, and rounded to mm.
    Stretched(f64),
    /// This number of mistakes among noise of 2 mm: swapped digits, a digit misread, the offset of a neighbour.
    Mistakes(usize),
}

impl Errors {
    pub(super) fn drawn(truth: &Truth, random: &mut Random) -> Self {
        let kind = random.below(12);
        // No one reads a drawing of a small boat to 40 mm.
        let most = 4e-3 * truth.breadth;
        match kind {
            0 | 1 => Self::None,
            2 => Self::Rounded(1e-3, 3),
            3 => Self::Rounded(if truth.breadth > 6.0 { 1e-2 } else { 5e-3 }, 3),
            4 | 5 => Self::Eighths,
            6..=8 => Self::Noise([2e-3_f64, 1e-2, 4e-2][kind - 6].min(most)),
            9 => Self::Askew((3e-3 * (0.5 + 2.0 * random.uniform())).min(most)),
            10 => Self::Stretched(2e-3 * (0.5 + random.uniform())),
            _ => Self::Mistakes(1 + random.below(4)),
        }
    }

    pub(super) fn words(self) -> String {
        match self {
            Self::None => "exact".to_owned(),
            Self::Rounded(quantum, _) => format!("rounded to {:.0} mm", 1e3 * quantum),
            Self::Eighths => "rounded to 1/8 in".to_owned(),
            Self::Noise(sigma) => format!("noise {:.1} mm", 1e3 * sigma),
            Self::Askew(sigma) => format!("askew by {:.1} mm", 1e3 * sigma),
            Self::Stretched(part) => format!("stretched by {:.1} ppt", 1e3 * part),
            Self::Mistakes(1) => "1 mistake".to_owned(),
            Self::Mistakes(count) => format!("{count} mistakes"),
        }
    }

    pub(super) fn decimals(self) -> usize {
        match self {
            Self::None => 7,
            Self::Rounded(_, decimals) => decimals,
            Self::Eighths => 6,
            _ => 3,
        }
    }

    /// Resolution of the writing \[m\]; 0.2 mm where it is exact.
    pub(super) fn resolution(self) -> f64 {
        match self {
            Self::None => 2e-4,
            Self::Rounded(quantum, _) => quantum,
            Self::Eighths => 0.0254 / 8.0,
            _ => 1e-3,
        }
    }

    pub(super) fn apply(self, table: &mut Table, random: &mut Random) {
        let (rows, columns) = (table.x.len(), table.z.len());
        let noise = match self {
            Self::Noise(sigma) => sigma,
            Self::Mistakes(_) => 2e-3,
            _ => 0.0,
        };
        for j in 0..columns {
            let (shift, turn) = (random.normal(), random.normal());
            for i in 0..rows {
                if !table.full(i, j) {
                    continue;
                }
                let s = 2.0 * (table.x[i] - table.x[0]) / (table.x[rows - 1] - table.x[0]) - 1.0;
                let y = &mut table.y[i][j];
                *y += match self {
                    Self::Askew(sigma) => sigma * (shift + s * turn),
                    Self::Stretched(part) => *y * part * (0.5 + 0.5 * s),
                    _ => noise * random.normal(),
                };
                *y = y.max(0.0);
            }
        }
        if let Self::Mistakes(count) = self {
            (0..count).for_each(|_| mistake(table, random));
        }
        let quantum = self.resolution();
        if self != Self::None {
            table.y.iter_mut().flatten().for_each(|y| *y = (*y / quantum).round() * quantum);
        }
    }
}

/// One cell is changed by at least 20 mm.
fn mistake(table: &mut Table, random: &mut Random) {
    for _ in 0..10_000 {
        let (i, j) = (random.below(table.x.len()), random.below(table.z.len()));
        if !table.full(i, j) {
            continue;
        }
        let y = table.y[i][j];
        let digits: Vec<char> = format!("{y:.3}").chars().collect();
        let k = random.below(digits.len() - 1);
        let wrong = match random.below(3) {
            0 if digits[k] != '.' && digits[k + 1] != '.' => {
                let mut swapped = digits;
                swapped.swap(k, k + 1);
                swapped.into_iter().collect::<String>().parse().unwrap_or(y)
            }
            1 => y + [0.02, 0.05, 0.1, -0.03, -0.1][random.below(5)],
            _ if j + 1 < table.z.len() && table.full(i, j + 1) => table.y[i][j + 1],
            _ => y,
        };
        if wrong > 0.0 && (wrong - y).abs() >= 0.02 {
            table.y[i][j] = wrong;
            return;
        }
    }
}
