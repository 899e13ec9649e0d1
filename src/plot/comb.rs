//! Curvature combs on a drawing: teeth at right angles to the drawn curve, on its convex side, their tips joined; all combs of a
//! drawing have one scale, which is printed.

use super::canvas::{Canvas, Pen};
use super::scale::sheet_scale;
use crate::fairing::inspect::Comb;

/// Length of the tooth whose curvature is printed \[mm\].
const STATED: f64 = 10.0;
/// Part of the teeth that are shorter than the usual one.
const QUANTILE: f64 = 0.75;
/// Length of the longest tooth of a drawing \[mm\]; longer ones are cut there.
const LONGEST: f64 = 22.0;
/// Length of the tooth at [`QUANTILE`], as a part of the longest.
const USUAL: f64 = 4.0 / 11.0;
/// Radius of the ring around an inflection \[mm\].
const RING: f64 = 1.1;

/// The scale of the combs of a drawing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct CombScale {
    /// Curvature of a tooth of [`STATED`] millimetres \[1/m\].
    curvature: f64,
    /// The longest tooth \[mm\]; longer ones are cut there.
    longest: f64,
}

/// How the comb of a curve is drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct CombPens {
    pub(super) teeth: Pen,
    pub(super) tips: Pen,
    pub(super) ring: Pen,
}

impl CombScale {
    /// The scale at which most teeth of `combs` are short enough for the drawing.
    pub(super) fn fitting(combs: &[Comb]) -> Self {
        Self::within(combs, LONGEST)
    }

    /// The scale for teeth of `longest` at most \[mm\].
    pub(super) fn within<'a>(combs: impl IntoIterator<Item = &'a Comb>, longest: f64) -> Self {
        let lengths = combs.into_iter().flat_map(|comb| &comb.teeth).map(|tooth| norm(tooth.tooth));
        let mut lengths: Vec<f64> = lengths.filter(|length| length.is_finite()).collect();
        lengths.sort_by(f64::total_cmp);
        let usual = lengths.get((QUANTILE * lengths.len() as f64) as usize).copied().unwrap_or(0.0);
        Self { curvature: sheet_scale(usual, USUAL * longest) * STATED, longest }
    }

    /// For the sheet: `10 mm = 0.02 1/m, teeth cut at 22 mm`.
    pub(super) fn words(&self) -> String {
        let digits = (0..12).find(|&d| {
            let scaled = self.curvature * 10f64.powi(d);
            (scaled - scaled.round()).abs() < 1e-6 * scaled
        });
        let curvature = format!("{:.*}", digits.unwrap_or(6) as usize, self.curvature);
        format!("{STATED:.0} mm = {curvature} 1/m, teeth cut at {:.0} mm", self.longest)
    }

    /// Draws a comb; `at` takes points of the ship to the sheet.
    pub(super) fn draw(&self, canvas: &mut Canvas, comb: &Comb, at: impl Fn([f64; 3]) -> [f64; 2], pens: &CombPens) {
        let feet: Vec<[f64; 2]> = comb.teeth.iter().map(|tooth| at(tooth.at)).collect();
        let mut tips = Vec::with_capacity(feet.len());
        for (k, tooth) in comb.teeth.iter().enumerate() {
            let (a, b) = (feet[k.saturating_sub(1)], feet[(k + 1).min(feet.len() - 1)]);
            let along = [b[0] - a[0], b[1] - a[1]];
            let length = along[0].hypot(along[1]);
            if length < 1e-9 {
                continue;
            }
            let normal = [-along[1] / length, along[0] / length];
            // The drawing may be stretched: it tells the side, the ship the length.
            let far = at(std::array::from_fn(|d| tooth.at[d] + tooth.tooth[d]));
            let outward = (far[0] - feet[k][0]) * normal[0] + (far[1] - feet[k][1]) * normal[1];
            let size = (norm(tooth.tooth) / self.curvature * STATED).min(self.longest).copysign(outward);
            let tip = [feet[k][0] + size * normal[0], feet[k][1] + size * normal[1]];
            canvas.line(feet[k], tip, &pens.teeth);
            tips.push(tip);
        }
        canvas.polyline(&tips, &pens.tips);
    }

    /// Draws the rings around the inflections of a comb.
    pub(super) fn rings(canvas: &mut Canvas, comb: &Comb, at: impl Fn([f64; 3]) -> [f64; 2], pens: &CombPens) {
        for &place in &comb.inflections {
            let [x, y] = at(place);
            let circle: Vec<[f64; 2]> = (0..=24)
                .map(|k| (std::f64::consts::TAU * f64::from(k) / 24.0).sin_cos())
                .map(|(s, c)| [x + RING * c, y + RING * s])
                .collect();
            canvas.polyline(&circle, &pens.ring);
        }
    }
}

fn norm(v: [f64; 3]) -> f64 {
    v.iter().map(|c| c * c).sum::<f64>().sqrt()
}
