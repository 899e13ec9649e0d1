//! Lines of the net of a fit across which the curvature of the surface does not jump, and goes on not to.
//!
//! A fit makes a whole line of its net a double knot where its surface falls below 0 or bends sharply somewhere along it.
//! Elsewhere along the line the curvature of its stations and waterlines is continuous to rounding, though the net would
//! let it jump. Left to themselves, smoothing and signs of curvature use that: a station of a coaster loses a lobe by
//! running into a tangent line that nobody declared. With J the jump of curvature at a crossing and l the length of the
//! crossing line over the mean of the spans beside, the surface departs by J l^2 in a span. Where the start departs by
//! less than [`NIL`] of its greatest half-breadth the line is unbroken, and
//!
//! ```text
//! S = sum over unbroken spans int (J l^2)^2 ds / tr
//! ```
//!
//! is asked for beside the offsets whatever the smoothing is, [`STIFF`] times one reading: there is nothing to be
//! smoothed there. Lines that are declared may break.
//! (Charged in the energy instead, its weight is shared with all that bends: of jumps with 0.036 1/m
//! of root mean square at a waterline of the Series 60 0.043 was left, with a charge of 1e3 0.010, and the weight that is
//! searched for goes with the charge.)
//!
//! Across a knuckle of the net the slope may jump all along it, though the knuckle ends somewhere or the line is a
//! corner of the chart alone, as at the foot of a transom. Where a declared knuckle has ended, and where the start turns
//! by less than [`NO_CORNER`] on a span of a line that none is declared along, it is asked for
//!
//! ```text
//! S' = sum over such spans int (sin(angle) l)^2 ds / tr
//! ```
//!
//! in the same way, and for no jump of curvature, where the start has none or the knuckle has ended. It fades over the
//! span beyond its end. (The surface through the table rings beyond that end, by 2 degrees on a coaster: left as it is
//! where it has a corner already, the fair one had 41.)

use super::cells::{Cells, Combination, Crossing, Fold, Jump, Place, Row, add_square, both};
use super::lines::LineKind;
use super::metric::{Folded, Jumped, Metric};
use crate::numeric::SymmetricBand;
use crate::spline::BsplineSurface;

/// What is asked for beside the offsets, in the size of one reading.
const STIFF: f64 = 1e4;

/// Departure in a span below which a start does not break, over its greatest half-breadth.
const NIL: f64 = 1e-9;

/// Angle \[rad\] by which a start turns at a place and nobody calls it a corner.
const NO_CORNER: f64 = 1e-3;

/// A line is at a knot where it is nearer than this part of the domain.
pub(super) const AT_KNOT: f64 = 1e-6;

/// Slack of the region of a flat \[m\].
const SLACK: f64 = 1e-6;

/// A line along which curvature or slope may jump.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Along {
    /// Its parameter, of the domain.
    pub(super) at: f64,
    /// From and to in x along the ship, in z up a station \[m\].
    pub(super) reach: [f64; 2],
}

/// What a knuckle does on a span of a line of the net.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Knuckle {
    /// None is declared along the line.
    None,
    Runs,
    /// It has ended at the end of the span.
    Fades,
    Ended,
}

/// Where curvature may jump though a fit runs on there.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Breaks {
    /// Lines that are declared or taken: v = constant second, u = constant first.
    pub(super) tangents: [Vec<Along>; 2],
    /// The same along which the slope may break.
    pub(super) knuckles: [Vec<Along>; 2],
}

impl Breaks {
    /// The lines of a kind.
    pub(super) fn of(&mut self, kind: LineKind) -> &mut [Vec<Along>; 2] {
        match kind {
            LineKind::Knuckle => &mut self.knuckles,
            LineKind::Tangent => &mut self.tangents,
        }
    }

    /// Whether one of the declared lines runs along a span of a line of the net, by its points.
    fn declared(lines: &[Vec<Along>; 2], way: usize, at: f64, points: &[[f64; 3]; 6]) -> bool {
        let [low, high] = reach(way, points);
        let along = |line: &Along| line.reach[1].min(high) - line.reach[0].max(low) > SLACK;
        lines[way].iter().any(|line| (line.at - at).abs() <= AT_KNOT && along(line))
    }

    /// What a knuckle that is declared somewhere along a line of the net does on one of its spans.
    fn knuckle(&self, way: usize, at: f64, points: &[[f64; 3]; 6]) -> Knuckle {
        let here: Vec<&Along> = self.knuckles[way].iter().filter(|line| (line.at - at).abs() <= AT_KNOT).collect();
        if here.is_empty() {
            return Knuckle::None;
        }
        if Self::declared(&self.knuckles, way, at, points) {
            return Knuckle::Runs;
        }
        let [low, high] = reach(way, points);
        let beside = |line: &&Along| line.reach[0] <= high + SLACK && low <= line.reach[1] + SLACK;
        if here.iter().any(beside) { Knuckle::Fades } else { Knuckle::Ended }
    }
}

/// From and to of a span of a line of the net, in x along the ship, in z up a station, by its points \[m\].
fn reach(way: usize, points: &[[f64; 3]; 6]) -> [f64; 2] {
    let axis = if way == 1 { 0 } else { 2 };
    let ends = [points[2][axis], points[3][axis]];
    [ends[0].min(ends[1]), ends[0].max(ends[1])]
}

/// Whether a line of the net of a surface (along the ship, `way` 0, or up, 1) lets the curvature jump where, somewhere
/// along it, it does not.
pub(super) fn runs_on(surface: &BsplineSurface<3>, way: usize, at: f64) -> bool {
    let (cells, metric) = (Cells::new(surface), Metric::new(surface));
    let unbroken = Unbroken::new(&cells, &metric, &Breaks::default());
    let mut lines = cells.jumps(way).iter().zip(&unbroken.spans[way]);
    lines.any(|(jump, spans)| (jump.at - at).abs() <= AT_KNOT && spans.contains(&true))
}

/// Spans of the lines of a net: along the ship and up, by line and span.
type Spans = [Vec<Vec<bool>>; 2];

/// Which spans of the lines of a net are unbroken.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Unbroken {
    /// Those that stay so.
    spans: Spans,
    /// Those that are, by the exact metric.
    own: Spans,
    /// Spans of lines across which the slope could jump, where it does not, and the same of their curvature.
    turns: Spans,
    curvatures: Spans,
}

impl Unbroken {
    /// The spans across which a surface has no jump of curvature, but for where it may have one.
    pub(super) fn new(cells: &Cells<'_>, metric: &Metric, breaks: &Breaks) -> Self {
        let nil = NIL * cells.greatest_half_breadth();
        let exact = Metric::new(cells.surface());
        let smooth = |metric: &Metric, way: usize, jump: &Jump, e: usize| {
            let departs = |at: Crossing<'_>| {
                metric.jumped(way, &at).map(|jumped| (jumped.departure(&at) * at.value(jumped.factors)).abs())
            };
            cells.crossings(way, jump, e).filter_map(departs).all(|departs| departs <= nil)
        };
        let own = [0, 1].map(|way: usize| {
            let lines = cells.jumps(way).iter().map(|jump| {
                let spans = (0..cells.count()[1 - way]).map(|e| {
                    !Breaks::declared(&breaks.tangents, way, jump.at, &cells.corners(way, jump.above, e))
                        && smooth(&exact, way, jump, e)
                });
                spans.collect::<Vec<bool>>()
            });
            lines.collect::<Vec<_>>()
        });
        // By the metric in which jumps are charged it may depart by more than by the exact one.
        let mut spans = own.clone();
        for (way, lines) in spans.iter_mut().enumerate() {
            for (jump, line) in cells.jumps(way).iter().zip(lines) {
                for (e, held) in line.iter_mut().enumerate() {
                    *held = *held && smooth(metric, way, jump, e);
                }
            }
        }
        let folds = |holds: &dyn Fn(usize, &Fold, usize) -> bool| {
            [0, 1].map(|way: usize| {
                let lines = cells.folds(way).iter().map(|fold| {
                    let spans = (0..cells.count()[1 - way]).map(|e| holds(way, fold, e));
                    spans.collect::<Vec<bool>>()
                });
                lines.collect::<Vec<_>>()
            })
        };
        let folded =
            |way: usize, fold: &Fold, e: usize, most: f64, departs: &dyn Fn(&Folded, &[Place<'_>; 2]) -> f64| {
                let sides = cells.sides(way, fold, e);
                let mut known = sides
                    .filter_map(|sides| Some(departs(&Folded::new(way, &sides, fold.lengths)?, &sides).abs()))
                    .peekable();
                known.peek().is_some() && known.all(|departs| departs <= most)
            };
        let knuckle =
            |way: usize, fold: &Fold, e: usize| breaks.knuckle(way, fold.at, &cells.corners(way, fold.above, e));
        let turns = folds(&|way, fold, e| match knuckle(way, fold, e) {
            Knuckle::Runs | Knuckle::Fades => false,
            Knuckle::Ended => true,
            Knuckle::None => folded(way, fold, e, NO_CORNER, &|folded, sides| value(&folded.turn, sides)),
        });
        let mut curvatures = turns.clone();
        for (way, lines) in curvatures.iter_mut().enumerate() {
            for (fold, line) in cells.folds(way).iter().zip(lines) {
                for (e, held) in line.iter_mut().enumerate().filter(|(_, held)| **held) {
                    let bow = |folded: &Folded, sides: &[Place<'_>; 2]| {
                        value(&folded.curvature, sides) * folded.length * folded.length
                    };
                    *held = !Breaks::declared(&breaks.tangents, way, fold.at, &cells.corners(way, fold.above, e))
                        && (knuckle(way, fold, e) == Knuckle::Ended || folded(way, fold, e, nil, &bow));
                }
            }
        }
        Self { spans, own, turns, curvatures }
    }

    /// Whether span e of a line is unbroken.
    pub(super) fn has(&self, way: usize, line: usize, e: usize) -> bool {
        self.spans[way][line][e]
    }

    /// S and S'; none where nothing is unbroken.
    pub(super) fn form(&self, cells: &Cells<'_>, metric: &Metric) -> Option<SymmetricBand> {
        let (mut jumps, mut row) = (cells.zeros(), Row::new());
        each(&self.spans, cells, metric, |at, jumped| {
            at.form(jumped.factors, &mut row);
            add_square(&mut jumps, at.weight * jumped.departure(at).powi(2), &row);
        });
        let mut turns = cells.zeros();
        each_fold(&self.turns, cells, |sides, folded| {
            add_square(&mut turns, sides[0].weight * folded.length.powi(2), &both(&folded.turn, sides));
        });
        let mut curvatures = cells.zeros();
        each_fold(&self.curvatures, cells, |sides, folded| {
            add_square(&mut curvatures, sides[0].weight * folded.length.powi(4), &both(&folded.curvature, sides));
        });
        let forms = [jumps, turns, curvatures].into_iter().filter(|form| form.trace() > 0.0);
        forms.fold(None, |sum: Option<SymmetricBand>, form| {
            Some(sum.unwrap_or_else(|| cells.zeros()).plus(STIFF / form.trace(), &form))
        })
    }

    /// The greatest jump of curvature of a surface on the same net where the start has none, whether it stays so or not, and
    /// no line is declared, or where a knuckle has ended \[1/m\]; none where there is no such place.
    pub(super) fn greatest(&self, surface: &BsplineSurface<3>) -> Option<f64> {
        let mut most = None;
        each(&self.own, &Cells::new(surface), &Metric::new(surface), |at, jumped| {
            most = Some(at.value(jumped.factors).abs().max(most.unwrap_or(0.0)));
        });
        each_fold(&self.curvatures, &Cells::new(surface), |sides, folded| {
            most = Some(value(&folded.curvature, sides).abs().max(most.unwrap_or(0.0)));
        });
        most
    }
}

/// Every node of these spans with what jumps there.
fn each(spans: &Spans, cells: &Cells<'_>, metric: &Metric, mut each: impl FnMut(&Crossing<'_>, &Jumped)) {
    for (way, lines) in spans.iter().enumerate() {
        for (jump, spans) in cells.jumps(way).iter().zip(lines) {
            for e in (0..spans.len()).filter(|&e| spans[e]) {
                for at in cells.crossings(way, jump, e) {
                    if let Some(jumped) = metric.jumped(way, &at) {
                        each(&at, &jumped);
                    }
                }
            }
        }
    }
}

/// The sum of a combination on one side of a line and one on the other, for the surface itself.
fn value(factors: &[Combination; 2], sides: &[Place<'_>; 2]) -> f64 {
    sides[0].value(&factors[0]) + sides[1].value(&factors[1])
}

/// Every node of these spans of lines that the slope could jump across, on both sides.
fn each_fold(spans: &Spans, cells: &Cells<'_>, mut each: impl FnMut(&[Place<'_>; 2], &Folded)) {
    for (way, lines) in spans.iter().enumerate() {
        for (fold, spans) in cells.folds(way).iter().zip(lines) {
            for e in (0..spans.len()).filter(|&e| spans[e]) {
                for sides in cells.sides(way, fold, e) {
                    if let Some(folded) = Folded::new(way, &sides, fold.lengths) {
                        each(&sides, &folded);
                    }
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spline::KnotVector;

    /// x = 100 u over four spans, z = 5 v with a double knot at v = 1 of 2, half-breadths y(v) from their blossom.
    fn surface(y: impl Fn([f64; 3]) -> f64) -> BsplineSurface<3> {
        broken(2, y)
    }

    /// The same with a knot of so many times.
    fn broken(times: usize, y: impl Fn([f64; 3]) -> f64) -> BsplineSurface<3> {
        let u = KnotVector::uniform(3, 4).unwrap();
        let v = KnotVector::from_breakpoints(3, &[0.0, 0.5, 1.0, 1.5, 2.0], &[1, times, 1]).unwrap();
        let mut points = Vec::new();
        for s in u.greville() {
            for j in 0..v.basis_count() {
                let t = &v.knots()[j + 1..j + 4];
                points.push([100.0 * s, y([t[0], t[1], t[2]]), 5.0 * (t[0] + t[1] + t[2]) / 3.0]);
            }
        }
        BsplineSurface::new(u, v, points).unwrap()
    }

    fn cube(t: [f64; 3]) -> f64 {
        1e-3 * t.iter().product::<f64>()
    }

    fn unbroken(surface: &BsplineSurface<3>, breaks: &Breaks) -> Unbroken {
        Unbroken::new(&Cells::new(surface), &Metric::new(surface), breaks)
    }

    fn form(unbroken: &Unbroken, surface: &BsplineSurface<3>) -> Option<SymmetricBand> {
        unbroken.form(&Cells::new(surface), &Metric::new(surface))
    }

    /// y = v^3 runs on through the double knot; max(v - 1, 0)^2 added to it jumps by d^2y/dz^2 = 2 / 25 times its size.
    #[test]
    fn a_smooth_surface_stays_smooth() {
        let smooth = surface(cube);
        let found = unbroken(&smooth, &Breaks::default());
        assert_eq!(found.spans, [vec![], vec![vec![true; 4]]]);
        let form = form(&found, &smooth).unwrap();
        let of = |surface: &BsplineSurface<3>| {
            let y: Vec<f64> = surface.points().iter().map(|point| point[1]).collect();
            form.apply(&y).iter().zip(&y).map(|(s, y)| s * y).sum::<f64>()
        };
        let size = 1e-5;
        let kinked = surface(|t| {
            let [a, b, c] = t.map(|t| t - 1.0);
            cube(t) + if t[0] + t[1] + t[2] > 3.0 + 1e-12 { size * (a * b + a * c + b * c) / 3.0 } else { 0.0 }
        });
        assert!(of(&smooth).abs() < 1e-6 * of(&kinked), "{} {}", of(&smooth), of(&kinked));
        assert!(found.greatest(&smooth).is_some_and(|jump| jump < 1e-12), "{:?}", found.greatest(&smooth));
        // At slopes of 6e-4.
        let jump = found.greatest(&kinked).unwrap();
        assert!((jump / (size * 2.0 / 25.0) - 1.0).abs() < 1e-5, "{jump}");
        assert_eq!(unbroken(&kinked, &Breaks::default()).spans[1], vec![vec![false; 4]]);
    }

    /// Across a triple knot max(v - 1, 0) turns the stations by its size over 5, of slopes near 0.
    #[test]
    fn a_knuckle_that_nobody_declared_stays_smooth() {
        let smooth = broken(3, cube);
        let found = unbroken(&smooth, &Breaks::default());
        assert_eq!((&found.turns, &found.curvatures), (&[vec![], vec![vec![true; 4]]], &[vec![], vec![vec![true; 4]]]));
        let form = form(&found, &smooth).unwrap();
        let of = |surface: &BsplineSurface<3>| {
            let y: Vec<f64> = surface.points().iter().map(|point| point[1]).collect();
            form.apply(&y).iter().zip(&y).map(|(s, y)| s * y).sum::<f64>()
        };
        let turned = |size: f64| {
            broken(3, |t| {
                cube(t) + if t.iter().sum::<f64>() > 3.0 { size * (t.iter().sum::<f64>() / 3.0 - 1.0) } else { 0.0 }
            })
        };
        let kinked = turned(1e-4);
        assert!(of(&smooth).abs() < 1e-12 * of(&kinked), "{} {}", of(&smooth), of(&kinked));
        let mut count = 0;
        each_fold(&found.turns, &Cells::new(&kinked), |sides, folded| {
            let turn = value(&folded.turn, sides);
            assert!((turn / (1e-4 / 5.0) - 1.0).abs() < 1e-6, "{turn}");
            assert!((folded.length - 2.5).abs() < 1e-6, "{}", folded.length);
            count += 1;
        });
        assert_eq!(count, 16);
        // More than a thousandth is a corner.
        assert_eq!(unbroken(&turned(0.004), &Breaks::default()).turns[1], vec![vec![true; 4]]);
        assert_eq!(unbroken(&turned(0.006), &Breaks::default()).turns[1], vec![vec![false; 4]]);
        let along = vec![Along { at: 0.5, reach: [30.0, 50.0] }];
        // It fades over the span beyond 50 m, and has ended elsewhere, whatever the start does there.
        for surface in [&smooth, &turned(0.006)] {
            let part = unbroken(surface, &Breaks { knuckles: [vec![], along.clone()], ..Breaks::default() });
            let held = vec![true, false, false, true];
            assert_eq!((&part.turns[1][0], &part.curvatures[1][0]), (&held, &held));
        }
        let part = unbroken(&smooth, &Breaks { tangents: [vec![], along], ..Breaks::default() });
        assert_eq!((&part.turns[1][0], &part.curvatures[1][0]), (&vec![true; 4], &vec![true, false, true, true]));
    }

    #[test]
    fn declared_lines_may_break() {
        let smooth = surface(cube);
        let along =
            |reach: [f64; 2]| Breaks { tangents: [vec![], vec![Along { at: 0.5, reach }]], ..Breaks::default() };
        assert!(form(&unbroken(&smooth, &along([0.0, 100.0])), &smooth).is_none());
        assert_eq!(unbroken(&smooth, &along([30.0, 50.0])).spans[1], vec![vec![true, false, true, true]]);
    }
}
