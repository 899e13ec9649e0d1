//! What fairing made of a table: errors to the truth, sign changes, residuals, time, and the summary of many tables.

use std::fmt;

use loftsman::internals::fairing::constraint::Constraint;
use loftsman::internals::fairing::outcome::Outcome;
use loftsman::internals::hull::{FitMethod, Hull, OffsetTable};

use super::{Case, Truth, cases};

/// Departure of a hump from its chord over the length of the hull from which it counts.
pub(crate) const SEEN: f64 = 1.0 / 50_000.0;

impl Truth {
    /// Root of the mean square and largest distance of a hull to the truth \[m\].
    pub(crate) fn errors(&self, hull: &Hull) -> [f64; 2] {
        let (mut sum, mut most, mut count) = (0.0, 0.0_f64, 0);
        for i in 0..=200 {
            for j in 0..=100 {
                let at = |k: usize, t: f64| self.from[k] + (self.to[k] - self.from[k]) * t;
                let (x, z) = (at(0, f64::from(i) / 200.0), at(1, f64::from(j) / 100.0));
                if let (Some(a), Some(b)) = ((self.half)(x, z), hull.half_breadth(x, z)) {
                    sum += (a - b).powi(2);
                    most = most.max((a - b).abs());
                    count += 1;
                }
            }
        }
        [(sum / f64::from(count.max(1))).sqrt(), most]
    }

    /// Largest error of the cells of a table \[m\].
    pub(crate) fn largest(&self, table: &OffsetTable) -> f64 {
        let rows = self.clean.stations.iter().zip(&table.stations);
        let cells = rows.flat_map(|(a, b)| a.half_breadths.iter().zip(&b.half_breadths));
        cells.filter_map(|(a, b)| Some((a.value()? - b.value()?).abs())).fold(0.0, f64::max)
    }

    /// Sign changes of the truth itself and of a hull: waterlines, sections, diagonals.
    pub(crate) fn changes(&self, hull: &Hull) -> [[usize; 2]; 3] {
        let other = |x: f64, z: f64| hull.half_breadth(x, z);
        let [from, to] = [self.from, self.to];
        let (mut waterlines, mut sections, mut diagonals) = ([0; 2], [0; 2], [0; 2]);
        let add = |sum: &mut [usize; 2], pair: [usize; 2]| (0..2).for_each(|k| sum[k] += pair[k]);
        let seen = SEEN * self.length;
        let clip = |z: f64| z.clamp(from[1], to[1]);
        for &z in self.clean.waterlines.iter().filter(|&&z| z > from[1]) {
            add(
                &mut waterlines,
                turns([from[0], to[0]], 200, seen, |x| (self.half)(x, clip(z)), |x| other(x, clip(z))),
            );
        }
        let stations = &self.clean.stations;
        for station in &stations[1..stations.len() - 1] {
            let x = station.station.x;
            add(&mut sections, turns([from[1], to[1]], 100, seen, |z| (self.half)(x, z), |z| other(x, z)));
        }
        for part in [0.4, 0.6, 0.8, 1.0] {
            let height = part * self.draught;
            let true_line = |x: f64| along(height, |z| (self.half)(x, z));
            add(&mut diagonals, turns([from[0], to[0]], 200, seen, true_line, |x| along(height, |z| other(x, z))));
        }
        [waterlines, sections, diagonals]
    }

    /// Fairs one table and measures.
    pub(crate) fn measured(&self, case: &Case, seed: u64) -> Measured {
        let table = self.table(case.errors, seed);
        let raw = Hull::fit(&table, &FitMethod::Graded).unwrap().hull;
        let started = cpu_seconds();
        let outcome = case.job(self).run(&table).unwrap_or_else(|error| panic!("{} {seed}: {error}", case.title()));
        let seconds = cpu_seconds() - started;
        let (before, after) = (self.changes(&raw), self.changes(&outcome.after));
        let volume = Constraint::Displacement(0.0).value(&outcome.after);
        let lcb = Constraint::CentreOfBuoyancy(0.0).value(&outcome.after);
        let [a, b] = [self.errors(&raw), self.errors(&outcome.after)];
        Measured {
            rms: [a[0], b[0]],
            most: [a[1], b[1]],
            changes: [0, 1, 2].map(|k| [after[k][0], before[k][1], after[k][1]]),
            volume: (volume / self.volume - 1.0).abs(),
            lcb: (lcb - self.lcb).abs() / self.length,
            seconds,
            largest: self.largest(&table),
            outcome,
        }
    }
}

/// Distance from the centreplane at `height` down a plane of 45 degrees to the hull; none where it leaves the hull
/// otherwise.
fn along(height: f64, half: impl Fn(f64) -> Option<f64>) -> Option<f64> {
    let (mut low, mut high) = (0.0, height);
    let outside = |t: f64| Some(half(height - t)? <= t);
    if !outside(high)? {
        return None;
    }
    for _ in 0..48 {
        let middle = 0.5 * (low + high);
        if outside(middle)? { high = middle } else { low = middle }
    }
    Some(0.5 * (low + high))
}

/// Sign changes of a line of the truth and of the hull, on the same points, between humps that leave their chord by `seen`
/// \[m\] or more.
fn turns(
    [from, to]: [f64; 2],
    count: usize,
    seen: f64,
    truth: impl Fn(f64) -> Option<f64>,
    hull: impl Fn(f64) -> Option<f64>,
) -> [usize; 2] {
    let at = |k: usize| from + (to - from) * (k as f64 / count as f64).clamp(0.0, 1.0);
    let step = (to - from) / count as f64;
    // Where the half-breadth is nothing there is no line.
    let there = |y: Option<f64>| y.filter(|y| *y > -1.0);
    let points: Vec<Option<[f64; 2]>> =
        (0..=count).map(|k| Some([there(truth(at(k)))?, there(hull(at(k)))?])).collect();
    let mut changes = [0; 2];
    for run in points.split(Option::is_none).filter(|run| run.len() > 2) {
        for (which, changes) in changes.iter_mut().enumerate() {
            let y: Vec<f64> = run.iter().flatten().map(|pair| pair[which]).collect();
            let bends: Vec<f64> = y.windows(3).map(|w| w[0] - 2.0 * w[1] + w[2]).collect();
            *changes += sign_changes(step, &y, &bends, seen);
        }
    }
    changes
}

/// Changes of sign of the curvature k between places of a line y between humps that leave their chord by `seen` \[m\] or
/// more.
pub(crate) fn sign_changes(step: f64, y: &[f64], k: &[f64], seen: f64) -> usize {
    let departure = |from: usize, to: usize| {
        let slope = (y[to] - y[from]) / (to - from) as f64;
        let off = (from..=to).map(|i| (y[i] - y[from] - slope * (i - from) as f64).abs()).fold(0.0, f64::max);
        off / (slope / step).hypot(1.0)
    };
    let mut counted: Vec<bool> = Vec::new();
    let mut from = 0;
    while from < k.len() {
        let to = (from..k.len()).find(|&i| (k[i] > 0.0) != (k[from] > 0.0)).unwrap_or(k.len());
        if departure(from, to + 1) >= seen {
            counted.push(k[from] > 0.0);
        }
        from = to;
    }
    counted.windows(2).filter(|pair| pair[0] != pair[1]).count()
}

/// CPU seconds of this thread where the system tells them, else of the clock.
pub(crate) fn cpu_seconds() -> f64 {
    let told = std::fs::read_to_string("/proc/thread-self/schedstat").ok();
    let nanoseconds = told.and_then(|text| text.split_whitespace().next()?.parse::<f64>().ok());
    nanoseconds.map_or_else(
        || std::time::SystemTime::now().duration_since(std::time::UNIX_EPOCH).map_or(0.0, |t| t.as_secs_f64()),
        |nanoseconds| nanoseconds * 1e-9,
    )
}

/// What became of one table.
pub(crate) struct Measured {
    /// Before and after \[m\].
    pub(crate) rms: [f64; 2],
    /// Before and after \[m\].
    pub(crate) most: [f64; 2],
    /// Waterlines, sections, diagonals: truth, before, after.
    pub(crate) changes: [[usize; 3]; 3],
    /// Relative.
    pub(crate) volume: f64,
    /// Over L.
    pub(crate) lcb: f64,
    /// CPU time of the job \[s\].
    pub(crate) seconds: f64,
    /// Largest error of a cell of the table \[m\].
    pub(crate) largest: f64,
    pub(crate) outcome: Outcome,
}

/// The middle and the greatest of a list.
pub(crate) fn spread(list: impl Iterator<Item = f64>) -> [f64; 2] {
    let mut sorted: Vec<f64> = list.collect();
    sorted.sort_by(f64::total_cmp);
    let n = sorted.len();
    if n == 0 { [f64::NAN; 2] } else { [0.5 * (sorted[(n - 1) / 2] + sorted[n / 2]), sorted[n - 1]] }
}

/// Median and worst of what became of the tables of a case.
pub(crate) struct Summary {
    pub(crate) title: String,
    pub(crate) tables: usize,
    /// Before and after \[m\].
    pub(crate) rms: [[f64; 2]; 2],
    /// Before and after \[m\].
    pub(crate) most: [[f64; 2]; 2],
    /// Waterlines, sections, diagonals: truth, before, after.
    pub(crate) changes: [[[f64; 2]; 3]; 3],
    /// Energy after over energy before.
    pub(crate) energy: [f64; 2],
    pub(crate) volume: f64,
    pub(crate) lcb: f64,
    pub(crate) gap: f64,
    pub(crate) programs: f64,
    /// CPU time of the job \[s\].
    pub(crate) seconds: [f64; 2],
    /// Tables whose RMS grew, and whose largest error is beyond that of the interpolation and of the table's own cells.
    pub(crate) worse: [usize; 2],
    /// Jobs that did not end optimal.
    pub(crate) failed: usize,
}

impl Summary {
    /// Fairs the tables of a case with the seeds 1, 2, ...; rounding alone has but one table.
    pub(crate) fn new(case: &Case, seeds: u64) -> Self {
        let truth = (case.truth)();
        let count = if case.errors.is_random() { seeds } else { 1 };
        let list: Vec<Measured> = (1..=count).map(|seed| truth.measured(case, seed)).collect();
        let of = |f: &dyn Fn(&Measured) -> f64| spread(list.iter().map(f));
        Self {
            title: case.title(),
            tables: list.len(),
            rms: [0, 1].map(|k| of(&|m| m.rms[k])),
            most: [0, 1].map(|k| of(&|m| m.most[k])),
            changes: [0, 1, 2].map(|k| [0, 1, 2].map(|i| of(&|m| m.changes[k][i] as f64))),
            energy: of(&|m| m.outcome.energy[1] / m.outcome.energy[0]),
            volume: of(&|m| m.volume)[1],
            lcb: of(&|m| m.lcb)[1],
            gap: of(&|m| m.outcome.faired.solved.certificate.gap.abs())[1],
            programs: of(&|m| m.outcome.faired.programs as f64)[0],
            seconds: of(&|m| m.seconds),
            worse: [
                list.iter().filter(|m| m.rms[1] > m.rms[0]).count(),
                list.iter().filter(|m| m.most[1] > m.most[0].max(m.largest)).count(),
            ],
            failed: list.iter().filter(|m| m.outcome.status != loftsman::internals::qp::Status::Optimal).count(),
        }
    }

    /// Head of the table that [`fmt::Display`] writes a row of.
    pub(crate) fn head() -> &'static str {
        "| case | tables | RMS mm before > after | largest mm before > after | waterlines | sections | diagonals | energy after/before \
         | volume | LCB/L | gap | programs | CPU ms | worse RMS, larger maximum, not optimal |\n|---|---|---|---|---|---|---|---|---|---|---|---|---|---|"
    }
}

impl fmt::Display for Summary {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mm = |[a, b]: [f64; 2], digits: usize| format!("{:.digits$}/{:.digits$}", 1e3 * a, 1e3 * b);
        write!(f, "| {} | {} ", self.title, self.tables)?;
        write!(f, "| {} > {} ", mm(self.rms[0], 2), mm(self.rms[1], 3))?;
        write!(f, "| {} > {} ", mm(self.most[0], 1), mm(self.most[1], 2))?;
        for [truth, before, after] in &self.changes {
            write!(f, "| {} > {} > {}/{} ", truth[0], before[0], after[0], after[1])?;
        }
        write!(f, "| {:.1e}/{:.1e} ", self.energy[0], self.energy[1])?;
        write!(f, "| {:.0e} | {:.0e} | {:.0e} | {} ", self.volume, self.lcb, self.gap, self.programs)?;
        write!(f, "| {} | {} {} {} |", mm(self.seconds, 0), self.worse[0], self.worse[1], self.failed)
    }
}

/// The page of all cases.
pub(crate) fn page(seeds: u64) -> String {
    let mut text = format!(
        "# Fairing against known truths\n\nMade by `LOFTSMAN_REPORT={seeds} cargo test --release --test integration truth::`, {seeds} seeds a case; \
         `cargo bench --bench truth` prints the same rows, with 30. What the hulls and errors are: head of `tests/truth_hulls/mod.rs`. \
         a/b: median and worst case; changes of sign: truth, before, after (median/worst); before: the surface through the table; \
         displacement and LCB of the truth are given to the job; CPU time is that of the machine that made the page.\n\n\
         Column \"worse\" counts the tables on which it is further off than interpolation.\n\n"
    );
    text.push_str(Summary::head());
    text.push('\n');
    for case in cases() {
        text.push_str(&format!("{}\n", Summary::new(&case, seeds)));
    }
    text
}
