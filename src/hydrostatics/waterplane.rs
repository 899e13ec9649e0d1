//! The waterplane at one draught.
//!
//! Area 2 int y dx, its moments 2 int x y dx and 2 int x^2 y dx and the transverse second moment (2/3) int y^3 dx are
//! integrals of piecewise polynomials in u, exact to rounding. Length and breadth are extents of the part where y > 0.
//! The half angles of entrance and run are atan(|y_u| / |x_u|) at the ends; at a transom that of the side there. The angle of
//! entrance leaves out the local shape of the stem (ITTC 2017, Symbols and Terminology: i_E), and a bow that is cut off broad
//! has none: see [`entrance_angle`].

use crate::hull::{Hull, Immersion, Piece, UpperEnd};
use crate::numeric::gauss_legendre;
use crate::spline::{BsplineCurve, MAX_DEGREE};

/// A bow is cut off, and has no angle of entrance, where its waterline ends with more than this part of its breadth.
const SQUARE_BOW: f64 = 0.1;

/// The local shape of a stem has less than this part of the breadth of its waterline.
const LOCAL: f64 = 0.02;

/// It turns by more than this \[deg\].
const LOCAL_TURN: f64 = 30.0;

/// The rule in u, the same for every draught: one entry a span.
pub(super) struct Rule {
    spans: Vec<SpanRule>,
    count: usize,
}

struct SpanRule {
    span: usize,
    from: f64,
    to: f64,
    nodes: Vec<RuleNode>,
}

struct RuleNode {
    weight: f64,
    value: [f64; MAX_DEGREE + 1],
    slope: [f64; MAX_DEGREE + 1],
}

impl Rule {
    /// Second moments are of degree 4p - 1.
    pub(super) fn new(hull: &Hull) -> Self {
        let knots = hull.surface().u();
        let count = 2 * knots.degree();
        let spans = knots
            .spans()
            .into_iter()
            .map(|span| {
                let (from, to) = (knots.knots()[span], knots.knots()[span + 1]);
                SpanRule { span, from, to, nodes: rule_nodes(hull, span, from, to, count) }
            })
            .collect();
        Self { spans, count }
    }
}

fn rule_nodes(hull: &Hull, span: usize, from: f64, to: f64, count: usize) -> Vec<RuleNode> {
    gauss_legendre(count)
        .on(from, to)
        .map(|(u, weight)| {
            let [value, slope] = hull.surface().u().basis_derivatives::<2>(span, u);
            RuleNode { weight, value, slope }
        })
        .collect()
}

/// Integrals over the waterplane, both sides, and its extents.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Waterplane {
    /// Area [m^2].
    pub(super) area: f64,
    /// Moment about x = 0 [m^3].
    pub(super) moment: f64,
    /// Second moment about x = 0 [m^4].
    pub(super) second: f64,
    /// Transverse second moment [m^4].
    pub(super) transverse: f64,
    /// x of its aft end \[m\].
    pub(super) aft: f64,
    /// Length \[m\].
    pub(super) length: f64,
    /// Breadth \[m\].
    pub(super) breadth: f64,
    /// Half angle of entrance \[deg\].
    pub(super) entrance: Option<f64>,
    /// Half angle of run \[deg\].
    pub(super) run: Option<f64>,
}

/// Area of the flat of bottom [m^2].
pub(super) fn bottom_area(hull: &Hull, rule: &Rule) -> f64 {
    let lowest = hull.surface().curve_at_v(hull.surface().v().domain().0);
    rule.spans.iter().map(|span| integrate(&lowest, span.span, &span.nodes)[0]).sum::<f64>() * 2.0
}

/// int y dx, int x y dx, int x^2 y dx, int y^3 dx and the largest y over some nodes of a span.
fn integrate(line: &BsplineCurve<3>, span: usize, nodes: &[RuleNode]) -> [f64; 5] {
    let p = line.knots().degree();
    let points = &line.points()[span - p..=span];
    let mut sums = [0.0; 5];
    for node in nodes {
        let (mut x, mut y, mut along) = (0.0, 0.0, 0.0);
        for ((point, value), slope) in points.iter().zip(&node.value).zip(&node.slope) {
            x += value * point[0];
            y += value * point[1];
            along += slope * point[0];
        }
        let area = node.weight * along * y;
        sums[0] += area;
        sums[1] += area * x;
        sums[2] += area * x * x;
        sums[3] += area * y * y;
        sums[4] = y.max(sums[4]);
    }
    sums
}

/// The waterplane of an immersion; zero above the deck.
pub(super) fn waterplane(hull: &Hull, immersion: &Immersion, rule: &Rule) -> Waterplane {
    if immersion.above() {
        return Waterplane::default();
    }
    let line = hull.surface().curve_at_v(immersion.waterline());
    let mut sums = [0.0; 5];
    let mut best = 0.0f64;
    let mut best_piece = None;
    let mut wet: Option<[(usize, f64); 2]> = None;
    let mut take = |span: usize, from: f64, to: f64, nodes: &[RuleNode]| {
        let part = integrate(&line, span, nodes);
        for (sum, value) in sums.iter_mut().zip(&part) {
            *sum += value;
        }
        // A span on which every control value is zero has no waterplane.
        if line.points()[span - line.knots().degree()..=span].iter().all(|point| point[1] <= 0.0) {
            return;
        }
        let start = wet.map_or((span, from), |ends| ends[0]);
        wet = Some([start, (span, to)]);
        let top = part[4].max(line.eval(from)[1]).max(line.eval(to)[1]);
        if best_piece.is_none() || top > best {
            best = top;
            best_piece = Some((from, to));
        }
    };
    if immersion.deck_immersed() {
        for &Piece { span, from, to, upper, .. } in immersion.pieces() {
            if upper == UpperEnd::Waterline {
                take(span, from, to, &rule_nodes(hull, span, from, to, rule.count));
            }
        }
    } else {
        for span in &rule.spans {
            take(span.span, span.from, span.to, &span.nodes);
        }
    }
    let Some([aft, fore]) = wet else { return Waterplane::default() };
    let (y, slope) = (|u: f64| line.eval(u)[1], |u: f64| line.derivatives::<2>(u)[1][1]);
    let breadth = best_piece.map_or(0.0, |(from, to)| 2.0 * largest(y, slope, from, to, best));
    Waterplane {
        area: 2.0 * sums[0],
        moment: 2.0 * sums[1],
        second: 2.0 * sums[2],
        transverse: 2.0 / 3.0 * sums[3],
        aft: line.eval(aft.1)[0],
        length: line.eval(fore.1)[0] - line.eval(aft.1)[0],
        breadth,
        entrance: entrance_angle(
            |u| y(u).max(0.0),
            |u| half_angle(&line, if u < fore.1 { (line.knots().find_span(u), u) } else { fore }),
            [fore.1, aft.1],
            0.5 * breadth,
        ),
        run: half_angle(&line, aft),
    }
}

/// The largest y near [from, to], at least `known`: the roots of its slope between samples, by bisection.
pub(super) fn largest(y: impl Fn(f64) -> f64, slope: impl Fn(f64) -> f64, from: f64, to: f64, known: f64) -> f64 {
    const SAMPLES: usize = 8;
    let mut best = known;
    for k in 0..SAMPLES {
        let at = |k: usize| from + (to - from) * k as f64 / SAMPLES as f64;
        let (mut low, mut high) = (at(k), at(k + 1));
        if slope(low) < 0.0 || slope(high) > 0.0 {
            continue;
        }
        // The value is settled to rounding when the place is to its square root.
        for _ in 0..30 {
            let middle = 0.5 * (low + high);
            if slope(middle) > 0.0 {
                low = middle;
            } else {
                high = middle;
            }
        }
        best = best.max(y(0.5 * (low + high)));
    }
    best
}

/// The half angle of entrance \[deg\] of a waterline of the given half-breadth \[m\] that goes from the fore end `ends[0]` to the
/// aft end `ends[1]` of its parameter; none where it ends broader than [`SQUARE_BOW`].
///
/// Where the tangent at the end is more than [`LOCAL_TURN`] steeper than the one at which the waterline is [`LOCAL`] broad, the
/// end is the local shape of the stem (a siding, a bar, a radius), and the angle is taken behind it.
pub(super) fn entrance_angle(
    y: impl Fn(f64) -> f64,
    angle: impl Fn(f64) -> Option<f64>,
    ends: [f64; 2],
    half_breadth: f64,
) -> Option<f64> {
    const HALVINGS: i32 = 40;
    let [fore, aft] = ends;
    if y(fore) > SQUARE_BOW * half_breadth {
        return None;
    }
    let at_end = angle(fore)?;
    let at = |share: f64| fore + (aft - fore) * share;
    let reaches = |share: f64| y(at(share)) >= LOCAL * half_breadth;
    let Some(mut out) = (0..=HALVINGS).rev().map(|k| 0.5f64.powi(k)).find(|&share| reaches(share)) else {
        return Some(at_end);
    };
    let mut within = 0.5 * out;
    for _ in 0..HALVINGS {
        let middle = 0.5 * (within + out);
        if reaches(middle) {
            out = middle;
        } else {
            within = middle;
        }
    }
    let behind = angle(at(out)).filter(|behind| at_end - behind > LOCAL_TURN);
    Some(behind.unwrap_or(at_end))
}

/// Angle between the waterline and the centreplane at its end \[deg\]; where the first derivative vanishes, from the
/// second.
fn half_angle(line: &BsplineCurve<3>, (span, u): (usize, f64)) -> Option<f64> {
    let p = line.knots().degree();
    let rows = line.knots().basis_derivatives::<3>(span, u);
    let points = &line.points()[span - p..=span];
    let size = points.iter().map(|point| point[0].abs().max(point[1].abs())).fold(0.0, f64::max);
    for row in &rows[1..] {
        let (mut x, mut y) = (0.0, 0.0);
        for (b, point) in row.iter().zip(points) {
            x += b * point[0];
            y += b * point[1];
        }
        if x.abs().max(y.abs()) > 1e-9 * size {
            return Some(y.abs().atan2(x.abs()).to_degrees());
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The angle of entrance of a waterline of 10 m half-breadth, by its half-breadth at a distance from its fore end, which
    /// is at u = 1.
    fn angle_of(y: impl Fn(f64) -> f64) -> Option<f64> {
        let line = |u: f64| y(100.0 * (1.0 - u));
        let slope = |u: f64| (line(u - 1e-9) - line(u)) / 1e-7;
        entrance_angle(line, |u| Some(slope(u).atan().to_degrees()), [1.0, 0.0], 10.0)
    }

    #[test]
    fn the_local_shape_of_a_stem_is_no_entrance() {
        let wedge = 12f64.to_radians().tan();
        let near =
            |found: Option<f64>, angle: f64| assert!((found.unwrap() - angle).abs() < 0.05, "{found:?} for {angle}");
        near(angle_of(|s| wedge * s), 12.0);
        // A stem of 50 mm radius, a siding of 0.1 m at right angles, and a bow that is an ellipse throughout.
        near(angle_of(|s| if s < 0.05 { (s * (0.1 - s)).max(0.0).sqrt() } else { 0.05 + wedge * (s - 0.05) }), 12.0);
        near(angle_of(|s| (1e7 * s).min(0.1 + wedge * s)), 12.0);
        near(angle_of(|s| (s * (100.0 - s)).max(0.0).sqrt() / 5.0), 90.0);
        // A bow that is cut off square has none.
        assert_eq!(angle_of(|s| 4.0 + 0.1 * s), None);
    }
}
