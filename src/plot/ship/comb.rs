//! Curvature combs on a drawing: teeth at right angles to the drawn curve, on its convex side, their tips joined; all
//! combs of one kind of line have one scale, which is printed. Teeth that are longer than there is room for are left
//! out, the line of the tips is interrupted there, and an arrow in the direction of the longest of them says so; its
//! curvature may be written beside it. Where arrows or rings would stand on each other the largest is drawn, and the sheet
//! says how many are not.

use crate::fairing::inspect::Comb;
use crate::plot::paper::canvas::{Canvas, Pen, Rectangle};
use crate::plot::paper::label::meet;
use crate::plot::paper::scale::sheet_scale;

/// Length of the tooth whose curvature is printed \[mm\].
const STATED: f64 = 10.0;
/// Length of the longest tooth of a plan \[mm\].
pub(in crate::plot) const LONGEST: f64 = 18.0;
/// Every so many teeth are drawn; the tips of all are joined.
const DRAWN: usize = 3;
/// Radius of the ring around an inflection \[mm\].
const RING: f64 = 1.1;
/// Sides of the head of an arrow \[mm\].
const HEAD: f64 = 1.6;
/// Shorter arrows tell no direction \[mm\].
const LEAST_ARROW: f64 = 2.5;
/// Least distance of the points of arrows, which have their curvature beside them, and of the centres of rings that can
/// be told apart \[mm\].
const ARROWS_APART: f64 = 4.0;
const RINGS_APART: f64 = 1.8;
/// Fewest teeth in a row whose tips are joined where neighbours are left out.
const LEAST_RUN: usize = 4;

/// The scale of the combs of a drawing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::plot) struct CombScale {
    /// Curvature of a tooth of [`STATED`] millimetres \[1/m\].
    curvature: f64,
    /// The longest tooth \[mm\].
    longest: f64,
}

/// What was drawn of a comb.
#[derive(Debug, Clone, PartialEq, Default)]
pub(in crate::plot) struct DrawnComb {
    /// The lines of the tips.
    pub(in crate::plot) tips: Vec<Vec<[f64; 2]>>,
    /// The teeth, foot and tip.
    pub(in crate::plot) teeth: Vec<[[f64; 2]; 2]>,
    /// Arrows for teeth that had to be left out, which are not drawn yet.
    pub(in crate::plot) cut: Vec<CutTeeth>,
}

/// Foot and point of the arrow for teeth that had to be left out, and the largest curvature of those \[1/m\].
pub(in crate::plot) type CutTeeth = ([[f64; 2]; 2], f64);

/// How the comb of a curve is drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::plot) struct CombPens {
    pub(in crate::plot) teeth: Pen,
    pub(in crate::plot) tips: Pen,
    pub(in crate::plot) ring: Pen,
    /// Arrows for teeth that are left out.
    pub(in crate::plot) cut: Pen,
}

impl CombScale {
    /// The scale at which the part `share` of the teeth of `combs` is no longer than `length` \[mm\].
    pub(in crate::plot) fn fitting<'a>(combs: impl IntoIterator<Item = &'a Comb>, share: f64, length: f64) -> Self {
        Self { curvature: sheet_scale(usual(combs, share), length) * STATED, longest: LONGEST }
    }

    /// The scale at which teeth along half the length of the lines of `combs` are no longer than `length` \[mm\].
    pub(in crate::plot) fn halfway<'a>(combs: impl IntoIterator<Item = &'a Comb>, length: f64) -> Self {
        Self { curvature: sheet_scale(median_along(combs), length) * STATED, longest: LONGEST }
    }

    /// The one of two scales that has the shorter teeth.
    pub(in crate::plot) fn coarser(self, other: Self) -> Self {
        if other.curvature > self.curvature { other } else { self }
    }

    /// The one of two scales that has the longer teeth.
    pub(in crate::plot) fn finer(self, other: Self) -> Self {
        if other.curvature < self.curvature { other } else { self }
    }

    /// This scale on a drawing that has room for teeth of `longest` \[mm\].
    pub(in crate::plot) fn within(self, longest: f64) -> Self {
        Self { longest, ..self }
    }

    /// For the sheet: `10 mm = 0.02 1/m`.
    pub(in crate::plot) fn words(&self) -> String {
        let digits = (0..12).find(|&d| {
            let scaled = self.curvature * 10f64.powi(d);
            (scaled - scaled.round()).abs() < 1e-6 * scaled
        });
        format!("{STATED:.0} mm = {:.*} 1/m", digits.unwrap_or(6) as usize, self.curvature)
    }

    /// Draws a comb inside `bounds`; `at` takes points of the ship to the sheet.
    pub(in crate::plot) fn draw(
        &self,
        canvas: &mut Canvas,
        comb: &Comb,
        at: impl Fn([f64; 3]) -> [f64; 2],
        pens: &CombPens,
        bounds: &Rectangle,
    ) -> DrawnComb {
        let feet: Vec<[f64; 2]> = comb.teeth.iter().map(|tooth| at(tooth.at)).collect();
        let mut longest: Option<(f64, [[f64; 2]; 2])> = None;
        let mut drawn = DrawnComb::default();
        let mut runs: Vec<Vec<(usize, [f64; 2])>> = vec![Vec::new()];
        let end = |drawn: &mut DrawnComb, longest: &mut Option<(f64, [[f64; 2]; 2])>| {
            if let Some((size, ends)) = longest.take() {
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
            let longest_here = self.longest.min(bounds.room(feet[k], normal.map(|c| c * 1f64.copysign(outward))));
            if size > longest_here {
                runs.push(Vec::new());
                if longest.is_none_or(|(most, _)| size > most) {
                    longest = Some((size, [feet[k], tip(longest_here)]));
                }
                continue;
            }
            end(&mut drawn, &mut longest);
            if let Some(run) = runs.last_mut() {
                run.push((k, tip(size)));
            }
        }
        end(&mut drawn, &mut longest);
        // A few teeth between such as are left out tell nothing.
        let whole = runs.len() == 1;
        for run in runs.iter().filter(|run| run.len() > 1 && (whole || run.len() >= LEAST_RUN)) {
            for &(k, tip) in run.iter().filter(|(k, _)| k % DRAWN == 0) {
                canvas.line(feet[k], tip, &pens.teeth);
                drawn.teeth.push([feet[k], tip]);
            }
            let tips: Vec<[f64; 2]> = run.iter().map(|(_, tip)| *tip).collect();
            canvas.polyline(&tips, &pens.tips);
            drawn.tips.push(tips);
        }
        drawn
    }

    /// Draws the rings around the inflections of a comb.
    pub(in crate::plot) fn rings(canvas: &mut Canvas, comb: &Comb, at: impl Fn([f64; 3]) -> [f64; 2], pens: &CombPens) {
        comb.inflections.iter().for_each(|&place| canvas.ring(at(place), RING, &pens.ring));
    }
}

/// Draws rings around those of `places` that keep apart, the first of several, and returns these and the others.
pub(in crate::plot) fn draw_rings(canvas: &mut Canvas, places: &[[f64; 2]], pen: &Pen) -> [Vec<[f64; 2]>; 2] {
    let mut drawn: Vec<[f64; 2]> = Vec::new();
    let mut left = Vec::new();
    for &place in places {
        if drawn.iter().any(|other| distance(*other, place) < RINGS_APART) {
            left.push(place);
        } else {
            canvas.ring(place, RING, pen);
            drawn.push(place);
        }
    }
    [drawn, left]
}

/// Of arrows for teeth that are left out, those that keep apart from each other and from `others`, the largest curvature
/// first; they, and the feet of the others.
pub(in crate::plot) fn arrows_apart(cut: Vec<CutTeeth>, others: &[CutTeeth]) -> (Vec<CutTeeth>, Vec<[f64; 2]>) {
    let mut sorted = cut;
    sorted.sort_by(|a, b| b.1.total_cmp(&a.1));
    let (mut kept, mut left): (Vec<CutTeeth>, Vec<[f64; 2]>) = (Vec::new(), Vec::new());
    for (ends, curvature) in sorted {
        let near = |other: &[[f64; 2]; 2]| distance(other[1], ends[1]) < ARROWS_APART || meet(*other, ends);
        let short = distance(ends[0], ends[1]) < LEAST_ARROW;
        if short || kept.iter().chain(others).any(|(other, _)| near(other)) {
            left.push(ends[0]);
        } else {
            kept.push((ends, curvature));
        }
    }
    (kept, left)
}

/// Draws arrows for teeth that are left out.
pub(in crate::plot) fn draw_arrows(canvas: &mut Canvas, cut: &[CutTeeth], pen: &Pen) {
    cut.iter().for_each(|(ends, _)| arrow(canvas, *ends, pen));
}

fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
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

/// The length of tooth that half the length of the lines has less of.
fn median_along<'a>(combs: impl IntoIterator<Item = &'a Comb>) -> f64 {
    let mut parts: Vec<[f64; 2]> = Vec::new();
    for comb in combs {
        for pair in comb.teeth.windows(2) {
            let along = norm(std::array::from_fn(|d| pair[1].at[d] - pair[0].at[d]));
            parts.push([0.5 * (norm(pair[0].tooth) + norm(pair[1].tooth)), along]);
        }
    }
    parts.retain(|part| part.iter().all(|value| value.is_finite()));
    parts.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let mut left = 0.5 * parts.iter().map(|part| part[1]).sum::<f64>();
    let half = parts.iter().find(|part| {
        left -= part[1];
        left <= 0.0
    });
    half.map_or(0.0, |part| part[0])
}

fn norm(v: [f64; 3]) -> f64 {
    v.iter().map(|c| c * c).sum::<f64>().sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fairing::inspect::Tooth;
    use crate::hull::Cut;

    #[test]
    fn combs_stay_inside_their_bounds() {
        // A line along x whose curvature rises to far more than there is room for, and falls again.
        let tooth = |k: i32| {
            let x = f64::from(k);
            Tooth { at: [x, 0.0, 0.0], tooth: [0.0, 20.0 / (1.0 + 0.05 * (x - 40.0).powi(2)), 0.0] }
        };
        let comb = Comb { cut: Cut::Waterline { z: 0.0 }, teeth: (0..80).map(tooth).collect(), inflections: vec![] };
        let scale = CombScale { curvature: 10.0, longest: LONGEST };
        let bounds = Rectangle::new(0.0, 24.0, 90.0, 40.0);
        let pen = Pen::new(0.1, "#000000");
        let pens = CombPens { teeth: pen, tips: pen, ring: pen, cut: pen };
        let at = |p: [f64; 3]| [p[0] + 5.0, 30.0 - p[1]];
        let drawn = scale.draw(&mut Canvas::new(100.0, 60.0), &comb, at, &pens, &bounds);
        assert_eq!((drawn.tips.len(), drawn.cut.len()), (2, 1));
        let ends = drawn.cut.iter().map(|(ends, _)| ends[1]);
        for [x, y] in drawn.tips.concat().into_iter().chain(ends) {
            assert!(bounds.grown(1e-9).contains(&Rectangle::new(x, y, x, y)), "{x} {y}");
        }
        assert!((drawn.cut[0].1 - 20.0).abs() < 1e-9);
    }

    #[test]
    fn arrows_and_rings_that_would_overlap_are_left_out() {
        let arrow = |x: f64, y: f64| [[x, 0.0], [x, y]];
        let cut = vec![
            (arrow(0.0, 10.0), 1.0),
            (arrow(1.0, 10.0), 3.0),
            (arrow(9.0, 10.0), 2.0),
            ([[5.0, 5.0], [12.0, 5.0]], 0.5),
            (arrow(30.0, 1.0), 9.0),
        ];
        let (kept, left) = arrows_apart(cut, &[]);
        assert_eq!(kept, [(arrow(1.0, 10.0), 3.0), (arrow(9.0, 10.0), 2.0)]);
        assert_eq!(left, [[30.0, 0.0], [0.0, 0.0], [5.0, 5.0]]);
        let (kept, left) = arrows_apart(kept, &[(arrow(9.5, 10.0), 1.0)]);
        assert_eq!((kept.len(), left.len()), (1, 1));
        let mut canvas = Canvas::new(50.0, 50.0);
        let places = [[5.0, 5.0], [5.5, 5.0], [9.0, 5.0]];
        let [drawn, left] = draw_rings(&mut canvas, &places, &Pen::new(0.1, "#000000"));
        assert_eq!((drawn, left), (vec![[5.0, 5.0], [9.0, 5.0]], vec![[5.5, 5.0]]));
    }
}
