//! A table that the smoother made fair, as text.

use std::fmt;
use std::path::{Path, PathBuf};
use std::str::FromStr;

use super::Table;
use super::net::Net;
use super::smoother::{CHART, cross_validated};

/// At the head x from and length, z from and height \[m\], numbers of spans along and across; then the net, the shorter
/// direction along the rows.
#[derive(Debug, Clone)]
pub(crate) struct FairNet(Net);

impl FairNet {
    /// Where the committed net of a table of `tests/data` lies.
    pub(crate) fn path(folder: &str) -> PathBuf {
        Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/truth").join(format!("{folder}.net"))
    }

    /// The committed net of a table of `tests/data`.
    pub(crate) fn committed(folder: &str) -> Self {
        let text = std::fs::read_to_string(Self::path(folder)).unwrap();
        text.parse().unwrap_or_else(|error| panic!("{folder}: {error}"))
    }

    /// The table made fair by the smoother.
    pub(crate) fn of(table: &Table) -> Self {
        Self(cross_validated(table).0)
    }

    /// y(x, z).
    pub(crate) fn value(&self, x: f64, z: f64) -> f64 {
        self.0.value(x, z)
    }

    /// From where to where it is known: x, z.
    pub(crate) fn extent(&self) -> [[f64; 2]; 2] {
        [0, 1].map(|k| [self.0.origin[k], self.0.origin[k] + self.0.size[k]])
    }
}

impl fmt::Display for FairNet {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Net { origin, size, .. } = &self.0;
        let [along, across] = self.0.spans();
        writeln!(f, "{},{},{},{},{along},{across}", origin[0], size[0], origin[1], size[1])?;
        for row in self.0.values.chunks(self.0.counts()[1]) {
            let cells: Vec<String> = row.iter().map(|y| format!("{y:.7}")).collect();
            writeln!(f, "{}", cells.join(","))?;
        }
        Ok(())
    }
}

impl FromStr for FairNet {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let numbers = |line: &str| -> Result<Vec<f64>, String> {
            line.split(',').map(|cell| cell.parse().map_err(|error| format!("{cell}: {error}"))).collect()
        };
        let mut lines = text.lines();
        let head = numbers(lines.next().unwrap_or_default())?;
        let [x, length, z, height, along, across] = head[..] else {
            return Err("six numbers are at the head".to_owned());
        };
        let mut net = Net::over([x, z], [length, height], CHART, [along as usize, across as usize]);
        for line in lines {
            net.values.extend(numbers(line)?);
        }
        if net.values.len() == net.len() { Ok(Self(net)) } else { Err(format!("{} values", net.values.len())) }
    }
}
