//! What fairing made of a draw, beside the partners, and the summary of many.

use std::fmt;
use std::panic::{AssertUnwindSafe, catch_unwind};

use loftsman::internals::fairing::job::Job;

use super::Draw;
use crate::partners::{self, Table, lines};
use crate::truth_hulls::measure::cpu_seconds;

/// A partner: its RMS \[mm\] and the RMS of its curvature.
type Partner = [f64; 2];

/// One draw, faired as by a user who says nothing.
pub(crate) struct Measured {
    /// RMS off the truth over all lines \[mm\], and what became of their shape; why there is no hull.
    outcome: Result<(f64, lines::Shape), String>,
    /// Interpolation, smoother, likelihood.
    partners: Option<[Partner; 3]>,
    /// Whether the smoother made the truth.
    smoothed: bool,
    /// \[mm\]
    resolution: f64,
    seconds: f64,
}

impl Measured {
    pub(crate) fn new(draw: &Draw, with_partners: bool) -> Self {
        let started = cpu_seconds();
        let outcome = catch_unwind(AssertUnwindSafe(|| Job::default().run(&draw.table)));
        let seconds = cpu_seconds() - started;
        let resolution = 1e3 * draw.errors.resolution();
        let table = Table::from(&draw.table);
        let seen = lines::seen(&table.x, resolution);
        let measure = |samples: &[Vec<f64>]| {
            (1e3 * lines::rms(samples, &draw.samples), lines::shape(&draw.lines, samples, &draw.samples, seen))
        };
        let outcome = match outcome {
            Ok(Ok(outcome)) => {
                let half = |x: f64, z: f64| outcome.after.half_breadth(x, z).unwrap_or(f64::NAN);
                Ok(measure(&lines::samples(&draw.lines, half)))
            }
            Ok(Err(error)) => Err(error.to_string()),
            Err(_) => Err("panic".to_owned()),
        };
        let partners = with_partners.then(|| {
            [partners::interpolation, partners::smoother, partners::likelihood].map(|partner| {
                let (rms, shape) = measure(&partner(&table, &draw.lines).samples);
                [rms, shape.curvature]
            })
        });
        Self { outcome, partners, smoothed: draw.truth.smoothed, resolution, seconds }
    }

    /// The least of the partners that count: RMS \[mm\] or curvature.
    fn best(&self, which: usize) -> Option<f64> {
        let [interpolation, smoother, likelihood] = self.partners?.map(|partner| partner[which]);
        let smoother = if self.smoothed { f64::INFINITY } else { smoother };
        Some(interpolation.min(smoother).min(likelihood))
    }

    /// RMS over that of the best partner or half the resolution, and the same of curvature.
    fn ratios(&self) -> Option<[f64; 2]> {
        let (rms, shape) = self.outcome.as_ref().ok()?;
        // The curvature of straight lines is no measure.
        let curvature = self.best(1).map_or(f64::NAN, |best| shape.curvature / best);
        Some([rms / self.best(0)?.max(0.5 * self.resolution), curvature])
    }
}

/// The row of a draw, after its title.
impl fmt::Display for Measured {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.outcome {
            Err(error) => write!(f, "refused: {error}")?,
            Ok((rms, shape)) => {
                let [waterlines, stations] = shape.signs;
                write!(f, "ours {rms:8.2} mm, signs {waterlines:+4} {stations:+4}, pieces {:+3}", shape.pieces)?;
                write!(f, ", variation {:5.2}", shape.variation)?;
            }
        }
        if let Some([interpolation, smoother, likelihood]) = self.partners.map(|partners| partners.map(|p| p[0])) {
            write!(f, ", partners {interpolation:7.2} {smoother:7.2} {likelihood:7.2} mm")?;
        }
        if let Some([rms, curvature]) = self.ratios() {
            let mark = if rms > 1.1 { " !" } else { "" };
            write!(f, ", ratio {rms:5.2}, of curvature {curvature:5.2}{mark}")?;
        }
        write!(f, ", {:.1} s", self.seconds)
    }
}

/// The summary of many draws.
pub(crate) struct Summary<'a>(pub(crate) &'a [Measured]);

/// Median, share above 1.1 in percent, worst of what are numbers.
fn spread(mut values: Vec<f64>) -> Option<[f64; 3]> {
    values.retain(|value| !value.is_nan());
    values.sort_by(f64::total_cmp);
    let above = values.iter().filter(|value| **value > 1.1).count();
    Some([values.get(values.len() / 2).copied()?, 100.0 * above as f64 / values.len() as f64, *values.last()?])
}

impl fmt::Display for Summary<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let all = self.0;
        let faired: Vec<&(f64, lines::Shape)> = all.iter().filter_map(|m| m.outcome.as_ref().ok()).collect();
        write!(f, "{} draws", all.len())?;
        for (k, name) in ["ratio to the best partner", "ratio of curvature"].into_iter().enumerate() {
            if let Some([median, above, worst]) = spread(all.iter().filter_map(|m| Some(m.ratios()?[k])).collect()) {
                write!(f, "; {name} median {median:.2}, above 1.1 {above:.0} %, worst {worst:.2}")?;
            }
        }
        let signs = faired.iter().filter(|(_, shape)| shape.signs.iter().any(|beyond| *beyond > 2)).count();
        let pieces = faired.iter().filter(|(_, shape)| shape.pieces > 1).count();
        let seconds: f64 = all.iter().map(|m| m.seconds).sum();
        let slowest = all.iter().map(|m| m.seconds).fold(0.0, f64::max);
        write!(
            f,
            "; more than 2 changes of sign beyond the truth's on {signs}, more than 1 monotone piece on {pieces}"
        )?;
        write!(f, "; refused {}; {seconds:.0} s of CPU, slowest {slowest:.1} s", all.len() - faired.len())
    }
}
