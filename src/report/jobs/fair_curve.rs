//! Fairing one curve: from a CSV file to the fair curve, its proof and its picture.

use std::fmt::Write;
use std::path::{Path, PathBuf};

use serde_json::Value;

use crate::config::Diagnostic;
use crate::exchange::{NO_MOVE, curve_csv, curve_json, read_curve};
use crate::fairing::curve::{
    Contradictions, CurveMove, CurvePoint, CurveSettings, FairCurve, FairStatus, PRICE, area_and_centroid,
    contradictions, fair_curve,
};
use crate::plot::{CurveSheet, fair_curve_figure};
use crate::report::failure::{Failure, problem};
use crate::report::output::files::OutputFile;
use crate::report::words::page::upward;
use crate::units::Notation;

/// Resolution of the picture \[dots per inch\].
const DOTS_PER_INCH: f64 = 160.0;
/// What points on a straight line may be off it, over the greatest ordinate.
const STRAIGHT: f64 = 1e-9;
/// An abscissa on the command line names a point within this part of the length.
const SAME: f64 = 1e-6;

/// A number to be held.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Kept {
    /// That of the points as given.
    AsGiven,
    /// This one.
    At(f64),
}

/// What is asked for.
#[derive(Debug, Clone, PartialEq)]
pub struct CurveJob {
    /// The file.
    pub path: PathBuf,
    /// Unit of plain numbers.
    pub unit: Notation,
    /// Abscissae of points to be locked \[m\].
    pub locks: Vec<f64>,
    /// Abscissae of knuckles \[m\].
    pub knuckles: Vec<f64>,
    /// Area to be held.
    pub area: Option<Kept>,
    /// Abscissa of its centroid to be held.
    pub centroid: Option<Kept>,
    /// Whether suspects are taken as they are.
    pub keep_suspects: bool,
    /// Everything else; the quantum is that of the file.
    pub settings: CurveSettings,
}

impl CurveJob {
    /// The points of a file in metres, with nothing held and nothing locked.
    #[must_use]
    pub fn new(path: &Path) -> Self {
        Self {
            path: path.to_owned(),
            unit: Notation::Metres,
            locks: Vec::new(),
            knuckles: Vec::new(),
            area: None,
            centroid: None,
            keep_suspects: false,
            settings: CurveSettings::default(),
        }
    }
}

/// A job that was done.
#[derive(Debug, Clone)]
pub struct FairedCurve {
    /// The points as they were used: suspects that are left out have no ordinate.
    pub points: Vec<CurvePoint>,
    /// Suspects, and corners that are shown and not declared.
    #[doc(hidden)]
    pub found: Contradictions,
    /// What came of them.
    pub fair: FairCurve,
    /// What was assumed.
    pub notes: Vec<String>,
    /// Whether ordinates are lengths; else they are areas.
    pub lengths: bool,
    path: PathBuf,
}

fn diagnostic(code: &'static str, path: &Path, line: Option<usize>, message: String, help: String) -> Diagnostic {
    Diagnostic { line, ..problem(code, path, message, help) }
}

/// Reads and fairs.
///
/// # Errors
/// [`Failure::FileSystem`]; [`Failure::Input`] for lines that cannot be understood and points that make no curve;
/// [`Failure::Usage`] for locks where no point is.
pub fn faired_curve(job: &CurveJob) -> Result<FairedCurve, Failure> {
    let path = &job.path;
    let bytes = std::fs::read(path).map_err(|error| Failure::FileSystem { act: "read", path: path.clone(), error })?;
    let input = |code, line, message, help| Failure::Input(vec![diagnostic(code, path, line, message, help)]);
    let text = String::from_utf8(bytes)
        .map_err(|_| input("E341", None, "the file is not text in UTF-8".to_owned(), String::new()))?;
    let table = read_curve(&text, job.unit).map_err(|problems| {
        let of = |p: crate::exchange::CurveProblem| diagnostic("E340", path, p.line, p.message, p.remedy);
        Failure::Input(problems.into_iter().map(of).collect())
    })?;
    let mut points = table.points;
    let length = points[points.len() - 1].x - points[0].x;
    for (list, what) in [(&job.locks, "lock"), (&job.knuckles, "knuckle")] {
        for &x in list {
            let Some(point) = points.iter_mut().find(|point| (point.x - x).abs() <= SAME * length) else {
                return Err(Failure::Usage(format!("--{what} {x}: there is no point at this abscissa")));
            };
            if what == "lock" { point.locked = true } else { point.knuckle = true }
        }
    }
    let mut notes = table.notes;
    notes.extend(closed_ends(&mut points));
    let refused = |error: crate::fairing::curve::CurveError| input("E342", None, error.to_string(), String::new());
    let quantum = table.quantum;
    let found = contradictions(&points, &CurveSettings { quantum, ..job.settings.clone() }).map_err(refused)?;
    let out = if job.keep_suspects { &[][..] } else { &found.suspects };
    out.iter().for_each(|suspect| points[suspect.index].y = None);
    let given = if job.area.is_some() || job.centroid.is_some() {
        area_and_centroid(&points).map_err(refused)?
    } else {
        [0.0; 2]
    };
    let held = |kept: Option<Kept>, given: f64| {
        kept.map(|kept| match kept {
            Kept::AsGiven => given,
            Kept::At(value) => value,
        })
    };
    let settings = CurveSettings {
        quantum,
        area: held(job.area, given[0]),
        centroid: held(job.centroid, given[1]),
        // The slope of a curve of areas is no angle.
        true_curvature: job.settings.true_curvature && table.lengths,
        ..job.settings.clone()
    };
    let mut fair = fair_curve(&points, &settings).map_err(refused)?;
    fair.left_out(out);
    let (lengths, path) = (table.lengths, path.clone());
    Ok(FairedCurve { points, found, fair, notes, lengths, path })
}

/// Locks the ends that are 0 of a curve that is nowhere below: a waterline closes there, a curve of areas begins.
fn closed_ends(points: &mut [CurvePoint]) -> Option<String> {
    let positive = points.iter().all(|point| point.y.is_none_or(|y| y >= 0.0));
    let last = points.len().checked_sub(1)?;
    let mut held = Vec::new();
    for k in [0, last] {
        let point = &mut points[k];
        if positive && point.y == Some(0.0) && point.tolerance.is_none() && !point.locked {
            point.locked = true;
            held.push(format!("x = {}", point.x));
        }
    }
    let ends = held.join(" and ");
    (!held.is_empty()).then(|| format!("closed at {ends}: the 0 there is held; give it a tolerance to let it move"))
}

impl FairedCurve {
    /// An ordinate with its unit.
    fn size(&self, value: f64) -> String {
        if self.lengths { metres(value) } else { format!("{value:.4} m2") }
    }

    /// The longest run of locked points on a straight line that the curvature must leave smoothly at an end.
    fn straight_lock(&self) -> Option<[f64; 2]> {
        let points = &self.fair.points;
        let highest = points.iter().fold(0.0_f64, |most, point| most.max(point.after.abs()));
        let straight = |k: usize| {
            let [a, b, c] = [&points[k - 1], &points[k], &points[k + 1]];
            let chord = a.after + (c.after - a.after) * (b.x - a.x) / (c.x - a.x);
            [a, b, c].iter().all(|point| point.tolerance == Some(0.0)) && (b.after - chord).abs() <= STRAIGHT * highest
        };
        let inside: Vec<usize> = (1..points.len().saturating_sub(1)).filter(|&k| straight(k)).collect();
        let runs = inside.chunk_by(|a, b| a + 1 == *b);
        let [from, to] = runs.max_by_key(|run| run.len()).map(|run| [run[0] - 1, run[run.len() - 1] + 1])?;
        let smooth = |k: usize| !(self.points[k].tangent || self.points[k].knuckle) && k > 0 && k + 1 < points.len();
        (smooth(from) || smooth(to)).then(|| [points[from].x, points[to].x])
    }

    /// The failure that ends the program when the targets were infeasible.
    ///
    /// # Errors
    /// [`Failure::Infeasible`] with the smallest tolerance that would do.
    pub fn verdict(&self) -> Result<(), Failure> {
        if self.fair.status != FairStatus::Infeasible {
            return Ok(());
        }
        let widest = self.fair.points.iter().filter_map(|p| p.tolerance).fold(0.0, f64::max);
        let wider = |factor: f64| {
            let [wide, now] = [factor * widest, widest].map(|value| self.size(value));
            format!("{factor:.4} times as wide, {wide} where they are {now}")
        };
        let beyond = |p: &CurveMove| Some(p.moved()?.abs() / p.tolerance.filter(|tolerance| *tolerance > 0.0)?);
        let most = self.fair.points.iter().filter_map(beyond).fold(0.0, f64::max);
        let keeps = if most <= 1.0 + 1e-6 {
            "is within the tolerances".to_owned()
        } else {
            format!("takes up to {most:.3} times the tolerances")
        };
        let (message, help) = if self.fair.nearest {
            let found = self.fair.diagnosis.as_ref();
            let alone = found.into_iter().flat_map(|found| &found.reaches).filter_map(|reach| {
                let (row, [low, high]) = (self.fair.lines.get(reach.constraint)?, reach.values?);
                let missed = reach.missing.is_some_and(|missing| missing > 0.0);
                let words = row.kind.key().replace('_', " ");
                let target = row.target;
                missed.then(|| format!("; {words} alone could be {low:.6} to {high:.6} where {target:.6} is asked for"))
            });
            let least = found.and_then(|found| found.widening);
            let least = least.map(|factor| format!("; tolerances {} would do", wider(factor))).unwrap_or_default();
            (
                format!("the targets cannot be met within the tolerances{}{least}", alone.collect::<String>()),
                format!("Relax the targets; the curve that was written {keeps} and comes near to them"),
            )
        } else if self.fair.widening.is_finite() {
            (
                format!(
                    "the targets cannot be met within the tolerances, which would have to be {}",
                    wider(self.fair.widening)
                ),
                "Give this tolerance, or relax the targets; the curve that was written takes it.".to_owned(),
            )
        } else {
            (
                "the targets contradict the locks at any tolerance".to_owned(),
                "Unlock a point, or take back the area, the centroid, a slope or the number of inflections; the curve that was \
                 written is without them."
                    .to_owned(),
            )
        };
        Err(Failure::Infeasible(vec![diagnostic("E410", &self.path, None, message, help)]))
    }
}

/// A small length in millimetres, a larger one in metres.
fn metres(value: f64) -> String {
    if value.abs() < 1.0 { format!("{:.3} mm", 1e3 * value) } else { format!("{value:.4} m") }
}

/// The files of `fair-curve`.
///
/// # Errors
/// [`Failure::Internal`] when the picture cannot be drawn.
pub fn fair_curve_files(done: &FairedCurve, figures: bool) -> Result<Vec<OutputFile>, Failure> {
    let json = serde_json::to_string_pretty(&fair_curve_json(done)).map_err(|e| Failure::Internal(e.to_string()))?;
    let mut files = vec![
        OutputFile::text("curve.csv", curve_csv(&done.points, &done.fair)),
        OutputFile::text("fairing.json", json + "\n"),
    ];
    if figures {
        let name = done.path.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default();
        let sheet = CurveSheet { name: &name, given: &done.points, fair: &done.fair, lengths: done.lengths };
        let figure = fair_curve_figure(&sheet).map_err(|error| Failure::Internal(error.to_string()))?;
        let png = figure.to_png(DOTS_PER_INCH).map_err(|error| Failure::Internal(error.to_string()))?;
        files.push(OutputFile::text("fair-curve.svg", figure.as_str().to_owned()));
        files.push(OutputFile { name: "fair-curve.png".to_owned(), contents: png });
    }
    Ok(files)
}

/// `fairing.json`.
#[must_use]
pub fn fair_curve_json(done: &FairedCurve) -> Value {
    curve_json(&done.points, &done.fair, &done.found)
}

/// What is printed.
#[must_use]
pub fn fair_curve_page(done: &FairedCurve) -> String {
    let fair = &done.fair;
    let (rms, most, at) = fair.moves();
    let mut page = String::new();
    let list = |places: &[f64]| places.iter().map(|x| format!("{x:.3}")).collect::<Vec<_>>().join(", ");
    let mut line = |text: String| {
        let _ = writeln!(page, "{text}");
    };
    line(format!("status        {}", fair.status.as_str()));
    line(format!(
        "moves         RMS {}, largest {} at x = {at:.3} m; {} of {} points at their tolerance",
        done.size(rms),
        done.size(most),
        fair.points.iter().filter(|point| point.active && point.tolerance.is_some_and(|t| t > 0.0)).count(),
        fair.points.len()
    ));
    line(format!("noise         {}", done.size(fair.sigma)));
    for suspect in &done.found.suspects {
        let point = &fair.points[suspect.index];
        let what = if point.suspect { "left out; --keep-suspects takes it" } else { "taken as it is" };
        line(format!(
            "suspect       x = {:.3} m: given {}, the others have {} (t = {:.1}); {what}",
            point.x,
            done.size(suspect.value),
            done.size(suspect.expected),
            suspect.score
        ));
    }
    if let Some(corner) = done.found.corners.first() {
        let places: Vec<f64> = done.found.corners.iter().map(|corner| fair.points[corner.index].x).collect();
        line(format!(
            "corners       shown and not declared at x = {} m: with K there (--knuckle) the noise is {} for {}",
            list(&places),
            done.size(corner.noise[1]),
            done.size(corner.noise[0])
        ));
    }
    line(format!("energy        order {}: {:.4e} -> {:.4e}", fair.order, fair.energy[1], fair.energy[0]));
    let [before, after] = &fair.inflections;
    let places = if after.is_empty() { String::new() } else { format!(" at x = {} m", list(after)) };
    line(format!("inflections   {} -> {}{places}", before.len(), after.len()));
    let proved = if fair.least.certified() { "proved" } else { "not proved to be the least" };
    line(format!("  least       {} within the tolerances ({proved})", fair.least.count));
    for place in fair.least.stretches.iter().flat_map(|stretch| &stretch.inflections) {
        line(format!("              one between x = {:.3} and {:.3} m", place.from, place.to));
    }
    for smaller in &fair.least.smaller {
        line(match smaller.factor {
            Some(factor) => format!(
                "              {} need {:.3} times the tolerances at least, whatever the curve",
                smaller.count,
                upward(factor)
            ),
            None => format!("              {} is infeasible at any tolerance: locked points forbid it", smaller.count),
        });
    }
    line(match fair.allowed {
        Some(allowed) if fair.widening.is_infinite() && after.len() > allowed => {
            format!("  allowed     {allowed}, GIVEN UP")
        }
        Some(allowed) => format!("  allowed     {allowed}, price {:.2} sigma^2 (limit {PRICE})", fair.price),
        None => "  allowed     as they come".to_owned(),
    });
    for (count, price) in &fair.refused {
        let price = if price.is_finite() { format!("cost {price:.1} sigma^2") } else { "is infeasible".to_owned() };
        line(format!("              {count} {price}"));
    }
    if let Some([from, to]) = done.straight_lock().filter(|_| fair.refused.iter().any(|(_, price)| price.is_infinite()))
    {
        line(format!(
            "              locked on a straight line from x = {from:.3} to {to:.3} m: with T at both the curvature may jump there"
        ));
    }
    for row in &fair.lines {
        line(format!(
            "{:<13} {:.6} -> {:.6}, target {:.6}; {}",
            row.kind.key(),
            row.before,
            row.after,
            row.target,
            match row.price {
                price if price.is_nan() => "what it costs was not found".to_owned(),
                price if price < NO_MOVE => "costs no moves".to_owned(),
                price => format!("costs {} RMS", done.size(price)),
            }
        ));
    }
    let c = &fair.certificate;
    line(format!(
        "certificate   gap {:.1e}, stationarity {:.1e}, largest violation {:.1e}",
        c.gap, c.stationarity, c.max_violation
    ));
    line(format!("work          {} programs, {} iterations", fair.work[0], fair.work[1]));
    page
}
