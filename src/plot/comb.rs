//! Curvature combs on a drawing: teeth at right angles to the drawn curve, on its convex side, their tips joined; all
//! combs of one kind of line have one scale, which is printed. Teeth that are longer than there is room for are left
//! out, the line of the tips is interrupted there, and an arrow in the direction of the longest of them says so; its
//! curvature may be written beside it.

use super::canvas::{Canvas, Pen};
use super::scale::sheet_scale;
use crate::fairing::inspect::Comb;

/// Length of the tooth whose curvature is printed \[mm\].
const STATED: f64 = 10.0;
/// Length of the longest tooth of a plan \[mm\].
pub(super) const LONGEST: f64 = 18.0;
/// Every so many teeth are drawn; the tips of all are joined.
const DRAWN: usize = 3;
/// Radius of the ring around an inflection \[mm\].
const RING: f64 = 1.1;
/// Sides of the head of an arrow \[mm\].
const HEAD: f64 = 1.6;

/// The scale of the combs of a drawing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct CombScale {
    /// Curvature of a tooth of [`STATED`] millimetres \[1/m\].
    curvature: f64,
    /// The longest tooth \[mm\].
    longest: f64,
}

/// What was drawn of a comb.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct DrawnComb {
    /// The lines of the tips.
    pub(super) tips: Vec<Vec<[f64; 2]>>,
    /// The teeth, foot and tip.
    pub(super) teeth: Vec<[[f64; 2]; 2]>,
    /// Arrows for teeth that had to be left out, foot and point, with the largest curvature of those \[1/m\].
    pub(super) cut: Vec<([[f64; 2]; 2], f64)>,
}

/// How the comb of a curve is drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct CombPens {
    pub(super) teeth: Pen,
    pub(super) tips: Pen,
    pub(super) ring: Pen,
    /// Arrows for teeth that are left out.
    pub(super) cut: Pen,
}

impl CombScale {
    /// The scale at which the part `share` of the teeth of `combs` is no longer than `length` \[mm\].
    pub(super) fn fitting<'a>(combs: impl IntoIterator<Item = &'a Comb>, share: f64, length: f64) -> Self {
        Self { curvature: sheet_scale(usual(combs, share), length) * STATED, longest: LONGEST }
    }

    /// The one of two scales that has the shorter teeth.
    pub(super) fn coarser(self, other: Self) -> Self {
        if other.curvature > self.curvature { other } else { self }
    }

    /// This scale on a drawing that has room for teeth of `longest` \[mm\].
    pub(super) fn within(self, longest: f64) -> Self {
        Self { longest, ..self }
    }

    /// For the sheet: `10 mm = 0.02 1/m`.
    pub(super) fn words(&self) -> String {
        let digits = (0..12).find(|&d| {
            let scaled = self.curvature * 10f64.powi(d);
            (scaled - scaled.round()).abs() < 1e-6 * scaled
        });
        format!("{STATED:.0} mm = {:.*} 1/m", digits.unwrap_or(6) as usize, self.curvature)
    }

    /// Draws a comb; `at` takes points of the ship to the sheet.
    pub(super) fn draw(
        &self,
        canvas: &mut Canvas,
        comb: &Comb,
        at: impl Fn([f64; 3]) -> [f64; 2],
        pens: &CombPens,
    ) -> DrawnComb {
        let feet: Vec<[f64; 2]> = comb.teeth.iter().map(|tooth| at(tooth.at)).collect();
        let mut tips: Vec<[f64; 2]> = Vec::with_capacity(feet.len());
        let mut longest: Option<(f64, [[f64; 2]; 2])> = None;
        let mut drawn = DrawnComb::default();
        let end = |canvas: &mut Canvas, drawn: &mut DrawnComb, longest: &mut Option<(f64, [[f64; 2]; 2])>| {
            if let Some((size, ends)) = longest.take() {
                arrow(canvas, ends, &pens.cut);
                drawn.cut.push((ends, size * self.curvature / STATED));
            }
        };
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
            let size = norm(tooth.tooth) / self.curvature * STATED;
            let tip = |size: f64| [0, 1].map(|d| feet[k][d] + size.copysign(outward) * normal[d]);
            let longest_here = self.longest.min(canvas.room(feet[k], normal.map(|c| c * 1f64.copysign(outward))));
            if size > longest_here {
                canvas.polyline(&tips, &pens.tips);
                drawn.tips.push(std::mem::take(&mut tips));
                if longest.is_none_or(|(most, _)| size > most) {
                    longest = Some((size, [feet[k], tip(longest_here)]));
                }
                continue;
            }
            end(canvas, &mut drawn, &mut longest);
            if k % DRAWN == 0 {
                canvas.line(feet[k], tip(size), &pens.teeth);
                drawn.teeth.push([feet[k], tip(size)]);
            }
            tips.push(tip(size));
        }
        canvas.polyline(&tips, &pens.tips);
        end(canvas, &mut drawn, &mut longest);
        drawn.tips.push(tips);
        drawn.tips.retain(|line| line.len() > 1);
        drawn
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

/// An arrow for the teeth that are left out.
fn arrow(canvas: &mut Canvas, [from, to]: [[f64; 2]; 2], pen: &Pen) {
    let along = [to[0] - from[0], to[1] - from[1]];
    let length = along[0].hypot(along[1]).max(1e-9);
    let [x, y] = along.map(|c| HEAD * c / length);
    canvas.line(from, to, pen);
    canvas.polyline(&[[to[0] - x - 0.4 * y, to[1] - y + 0.4 * x], to, [to[0] - x + 0.4 * y, to[1] - y - 0.4 * x]], pen);
}

/// Curvature that the part `share` of the teeth does not pass \[1/m\].
fn usual<'a>(combs: impl IntoIterator<Item = &'a Comb>, share: f64) -> f64 {
    let lengths = combs.into_iter().flat_map(|comb| &comb.teeth).map(|tooth| norm(tooth.tooth));
    let mut lengths: Vec<f64> = lengths.filter(|length| length.is_finite()).collect();
    lengths.sort_by(f64::total_cmp);
    lengths.get((share * lengths.len() as f64) as usize).copied().unwrap_or(0.0)
}

fn norm(v: [f64; 3]) -> f64 {
    v.iter().map(|c| c * c).sum::<f64>().sqrt()
}
