//! Curvature along a plane curve: what it says about fairness.
//!
//! The curve is taken at 13 Chebyshev-Lobatto points to a piece (between knots, where it is smooth), with point,
//! direction, curvature kappa and its derivative d(kappa)/ds given by whoever knows the curve. Integrals over a piece
//! are those of Clenshaw and Curtis (1960), exact for polynomials of degree 12; roots and extrema between two points
//! are those of the cubic with the values and slopes at both (error O(h^4)).
//!
//! What counts is told from what does not by one length, the *tolerance*: what can just be seen in the drawing.
//! * A **lobe** is a stretch with one sign of kappa. Its departure is the largest distance of the curve from the chord
//!   of the stretch (kappa l^2 / 8 for constant kappa: kappa integrated twice). While some lobe departs by less than
//!   the tolerance, the least of them is given to its neighbours, which become one; an **inflection** is a border
//!   between the lobes that remain.
//! * A **curvature extremum** is a turning point between two monotone pieces of curvature whose swings count (`pieces.rs`).
//! * A **flat** is a stretch of at least 5 % of the length of the curve that departs by at most the tolerance and in
//!   which |kappa| stays below 1/8 of its mean over the curve, or below a lower bound, halved until that is so. An
//!   inflection inside a flat stands in its middle.
//! * A **knuckle** is a turn of the tangent by more than half a degree at one point. It splits the curve.

use std::f64::consts::PI;

use super::pieces::{height, total_variation, turning_points};

/// Points to a piece.
const NODES: usize = 13;
/// How far the points at the ends of a piece stand inside it, in lengths of the piece: there the curve is that of the
/// piece.
const INSIDE: f64 = 1e-7;
/// Turn of the tangent at a knuckle \[rad\].
const KNUCKLE: f64 = 0.5 * PI / 180.0;
/// Least length of a flat, in lengths of the curve.
const FLAT_LENGTH: f64 = 0.05;
/// Largest curvature of a flat, in mean curvatures of the curve.
const FLAT_CURVATURE: f64 = 0.125;
/// Halvings of the bound on the curvature of a flat.
const FLAT_HALVINGS: u32 = 40;

/// A plane curve at one parameter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Local {
    /// The point \[m\].
    pub point: [f64; 2],
    /// Derivative of the point by the parameter.
    pub velocity: [f64; 2],
    /// kappa \[1/m\].
    pub curvature: f64,
    /// d(kappa)/ds \[1/m^2\].
    pub slope: f64,
}

/// A place on the curve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Place {
    /// Length along the curve from its start \[m\].
    pub s: f64,
    /// The point \[m\].
    pub point: [f64; 2],
}

/// A straight stretch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stretch {
    /// Where it starts.
    pub from: Place,
    /// Where it ends.
    pub to: Place,
}

/// What is found on a curve.
#[derive(Debug, Clone, PartialEq)]
pub struct Findings {
    /// Length \[m\].
    pub length: f64,
    /// int |kappa| ds \[rad\], without the knuckles.
    pub turning: f64,
    /// Batten energy int kappa^2 ds \[1/m\].
    pub bending: f64,
    /// int (d(kappa)/ds)^2 ds [1/m^3].
    pub variation: f64,
    /// kappa where |kappa| is largest \[1/m\], and where.
    pub largest: (f64, Place),
    /// Inflections.
    pub inflections: Vec<Place>,
    /// Curvature extrema.
    pub extrema: Vec<Place>,
    /// Flats.
    pub flats: Vec<Stretch>,
    /// Knuckles.
    pub knuckles: Vec<Place>,
}

/// How fair the curves of a plane are, counted.
///
/// Knuckles split a curve: what is counted is counted between them, and added. A bump counts from a band \[m\] on, the
/// same for all. For inflections that is the depth of a hump from its chord. For monotone pieces it is the height
/// |dk| l^2 / pi^2 of a swing of curvature dk \[1/m\] between turning points an arc length l \[m\] apart. The least is
/// merged first (Farin and Sapidis 1989, "Curvature and the fairness of curves and surfaces").
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Counts {
    /// Inflections: changes of the sign of curvature.
    pub inflections: usize,
    /// Monotone pieces of the signed curvature kappa(s), one at least.
    pub pieces: usize,
    /// Total variation of curvature over its range, int |d kappa| / (max kappa - min kappa) \[-\]: 1 where it is monotone, n
    /// for n equal swings. None where no swing of that range along the whole curve would count.
    pub variation: Option<f64>,
}

impl Counts {
    /// Of the curves in which a plane cuts a hull; `band` is the height from which a bump counts \[m\].
    #[must_use]
    pub fn of(curves: &[Profile], band: f64) -> Self {
        let (mut inflections, mut pieces, mut total, mut length) = (0, 0, 0.0, 0.0);
        let mut range = [f64::INFINITY, f64::NEG_INFINITY];
        for run in curves.iter().flat_map(|curve| curve.runs().0) {
            let course = course(&run);
            inflections += inflections_of(&run, band).len();
            pieces += turning_points(&course, band).len() - 1;
            total += total_variation(&course);
            length += run[run.len() - 1].s - run[0].s;
            range = course.iter().fold(range, |[low, high], point| [low.min(point.1), high.max(point.1)]);
        }
        let change = range[1] - range[0];
        let variation = (change > 0.0 && height(change, length) >= band).then(|| total / change);
        Self { inflections, pieces: pieces.max(1), variation }
    }
}

#[derive(Debug, Clone, Copy)]
struct Node {
    s: f64,
    point: [f64; 2],
    /// Unit tangent.
    tangent: [f64; 2],
    curvature: f64,
    slope: f64,
    /// Weight of the point in integrals over s.
    weight: f64,
    piece: usize,
}

/// A plane curve as a chain of points with curvature.
#[derive(Debug, Clone)]
pub struct Profile {
    nodes: Vec<Node>,
    closed: bool,
}

/// Points cos(k pi / n) on [-1, 1] in ascending order with the weights of Clenshaw and Curtis.
fn clenshaw_curtis() -> [(f64, f64); NODES] {
    let n = NODES - 1;
    std::array::from_fn(|k| {
        let angle = k as f64 * PI / n as f64;
        let mut sum = 1.0;
        for j in 1..=n / 2 {
            let b = if 2 * j == n { 1.0 } else { 2.0 };
            sum -= b / (4.0 * (j * j) as f64 - 1.0) * (2.0 * j as f64 * angle).cos();
        }
        let c = if k == 0 || k == n { 1.0 } else { 2.0 };
        (-angle.cos(), c / n as f64 * sum)
    })
}

fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    (b[0] - a[0]).hypot(b[1] - a[1])
}

/// Value and slope of the cubic with the given values and slopes at the ends of an interval of length `h`, at `r` in
/// [0, 1].
fn hermite(r: f64, h: f64, values: [f64; 2], slopes: [f64; 2]) -> (f64, f64) {
    let (p, q) = (1.0 - r, r);
    let value = p * p * (1.0 + 2.0 * q) * values[0]
        + q * q * (1.0 + 2.0 * p) * values[1]
        + h * p * q * (p * slopes[0] - q * slopes[1]);
    let slope =
        6.0 * p * q * (values[1] - values[0]) / h + p * (p - 2.0 * q) * slopes[0] + q * (q - 2.0 * p) * slopes[1];
    (value, slope)
}

/// Root in [0, 1] of a function with different signs at 0 and 1.
fn bisect(function: impl Fn(f64) -> f64) -> f64 {
    let rising = function(1.0) > 0.0;
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..48 {
        let middle = 0.5 * (low + high);
        if (function(middle) > 0.0) == rising { high = middle } else { low = middle }
    }
    0.5 * (low + high)
}

fn sign(value: f64) -> i8 {
    if value > 0.0 {
        1
    } else if value < 0.0 {
        -1
    } else {
        0
    }
}

/// A stretch with one sign of curvature.
#[derive(Debug, Clone, Copy)]
struct Lobe {
    sign: i8,
    from: f64,
    to: f64,
}

impl Profile {
    /// The curve over the parameter ranges `pieces`, in order and joined end to end; on each it is smooth. Parameters
    /// at which `local` knows no curvature are left out. None when fewer than two points remain.
    #[must_use]
    pub fn sample(pieces: &[[f64; 2]], closed: bool, mut local: impl FnMut(f64) -> Option<Local>) -> Option<Self> {
        let rule = clenshaw_curtis();
        let mut nodes: Vec<Node> = Vec::with_capacity(pieces.len() * NODES);
        for (piece, &[from, to]) in pieces.iter().enumerate() {
            let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
            for (x, weight) in rule {
                let Some(l) = local(middle + half * x.clamp(-1.0 + 2.0 * INSIDE, 1.0 - 2.0 * INSIDE)) else { continue };
                let speed = l.velocity[0].hypot(l.velocity[1]);
                if !(speed > 0.0 && l.curvature.is_finite() && l.slope.is_finite()) {
                    continue;
                }
                let tangent = l.velocity.map(|c| c / speed);
                let s = nodes.last().map_or(0.0, |last: &Node| {
                    let chord = distance(last.point, l.point);
                    let turn = if last.piece == piece { angle(last.tangent, tangent) } else { 0.0 };
                    // The arc over a chord whose ends differ by `turn` in direction.
                    last.s
                        + if turn > 1e-4 {
                            chord * 0.5 * turn / (0.5 * turn).sin()
                        } else {
                            chord * (1.0 + turn * turn / 24.0)
                        }
                });
                let weight = weight * half * speed;
                nodes.push(Node { s, point: l.point, tangent, curvature: l.curvature, slope: l.slope, weight, piece });
            }
        }
        (nodes.len() > 1).then_some(Self { nodes, closed })
    }

    /// Curvature at each place where the coordinate `axis . point` of the curve passes one of `marks`, in order along it.
    #[must_use]
    pub fn curvature_at(&self, axis: [f64; 2], marks: &[f64]) -> Vec<f64> {
        let along = |point: [f64; 2]| axis[0] * point[0] + axis[1] * point[1];
        let mut found: Vec<(f64, f64)> = Vec::new();
        for (k, pair) in self.nodes.windows(2).enumerate() {
            let (a, b) = (along(pair[0].point), along(pair[1].point));
            let last = k + 2 == self.nodes.len();
            for &mark in marks {
                let inside = (a <= mark && mark < b)
                    || (b < mark && mark <= a)
                    || (last && (mark - b).abs() < 1e-12 * b.abs().max(1.0));
                if inside {
                    let r = if (b - a).abs() > 0.0 { ((mark - a) / (b - a)).clamp(0.0, 1.0) } else { 0.0 };
                    found.push((pair[0].s + r * (pair[1].s - pair[0].s), curvature_between(pair, r)));
                }
            }
        }
        found.sort_by(|a, b| a.0.total_cmp(&b.0));
        found.into_iter().map(|(_, curvature)| curvature).collect()
    }

    /// Point, unit tangent and curvature at `count` equal steps of length along the curve, both ends included.
    #[must_use]
    pub fn even(&self, count: usize) -> Vec<([f64; 2], [f64; 2], f64)> {
        let (first, last) = (self.nodes[0].s, self.nodes[self.nodes.len() - 1].s);
        let at = |k: usize| {
            let s = first + (last - first) * k as f64 / (count.max(2) - 1) as f64;
            let after = self.nodes.partition_point(|node| node.s < s).clamp(1, self.nodes.len() - 1);
            let pair = &self.nodes[after - 1..=after];
            let h = pair[1].s - pair[0].s;
            let r = if h > 0.0 { ((s - pair[0].s) / h).clamp(0.0, 1.0) } else { 0.0 };
            let mix = |a: [f64; 2], b: [f64; 2]| [0, 1].map(|d| a[d] + r * (b[d] - a[d]));
            let tangent = mix(pair[0].tangent, pair[1].tangent);
            let length = tangent[0].hypot(tangent[1]).max(f64::MIN_POSITIVE);
            (mix(pair[0].point, pair[1].point), tangent.map(|c| c / length), curvature_between(pair, r))
        };
        (0..count.max(2)).map(at).collect()
    }

    /// What is found on the curve; `tolerance` is the departure that can just be seen \[m\].
    #[must_use]
    pub fn findings(&self, tolerance: f64) -> Findings {
        let sum = |f: &dyn Fn(&Node) -> f64| self.nodes.iter().map(|n| n.weight * f(n)).sum::<f64>();
        let length = sum(&|_| 1.0);
        let turning = sum(&|n| n.curvature.abs());
        let mut largest = &self.nodes[0];
        for node in &self.nodes {
            if node.curvature.abs() > largest.curvature.abs() {
                largest = node;
            }
        }
        let (runs, knuckles) = self.runs();
        let bound = FLAT_CURVATURE * turning / length.max(f64::MIN_POSITIVE);
        let (mut inflections, mut extrema, mut flats) = (Vec::new(), Vec::new(), Vec::new());
        for run in &runs {
            let found = flats_of(run, bound, FLAT_LENGTH * length, tolerance, FLAT_HALVINGS);
            for s in inflections_of(run, tolerance) {
                let inside = found.iter().find(|flat| flat.from.s <= s && s <= flat.to.s);
                inflections.push(place(run, inside.map_or(s, |flat| 0.5 * (flat.from.s + flat.to.s))));
            }
            let closed = self.closed && knuckles.is_empty();
            extrema.extend(extrema_of(run, tolerance, closed).into_iter().map(|s| place(run, s)));
            flats.extend(found);
        }
        Findings {
            length,
            turning,
            bending: sum(&|n| n.curvature * n.curvature),
            variation: sum(&|n| n.slope * n.slope),
            largest: (largest.curvature, Place { s: largest.s, point: largest.point }),
            inflections,
            extrema,
            flats,
            knuckles,
        }
    }

    /// The parts between knuckles, and the knuckles. A closed curve without knuckles starts at its largest curvature.
    fn runs(&self) -> (Vec<Vec<Node>>, Vec<Place>) {
        let mut runs: Vec<Vec<Node>> = vec![Vec::new()];
        let mut knuckles = Vec::new();
        for (k, node) in self.nodes.iter().enumerate() {
            if k > 0 {
                let before = &self.nodes[k - 1];
                if before.piece != node.piece && angle(before.tangent, node.tangent) > KNUCKLE {
                    knuckles.push(Place { s: node.s, point: node.point });
                    runs.push(Vec::new());
                }
            }
            if let Some(run) = runs.last_mut() {
                run.push(*node);
            }
        }
        let (first, last) = (&self.nodes[0], &self.nodes[self.nodes.len() - 1]);
        if self.closed {
            if angle(last.tangent, first.tangent) > KNUCKLE {
                knuckles.push(Place { s: first.s, point: first.point });
            } else if knuckles.is_empty() {
                runs = vec![from_the_largest(&self.nodes)];
            }
        }
        runs.retain(|run| run.len() > 1);
        (runs, knuckles)
    }
}

/// The nodes of a closed curve from the one with the largest curvature around to it again.
fn from_the_largest(nodes: &[Node]) -> Vec<Node> {
    let (mut start, mut most) = (0, -1.0);
    for (k, node) in nodes.iter().enumerate() {
        if node.curvature.abs() > most {
            (start, most) = (k, node.curvature.abs());
        }
    }
    let (length, pieces) = (nodes[nodes.len() - 1].s, nodes[nodes.len() - 1].piece + 1);
    let later = nodes[..=start].iter().map(|n| Node { s: n.s + length, piece: n.piece + pieces, ..*n });
    nodes[start..].iter().copied().chain(later).collect()
}

/// Angle between two unit vectors \[rad\].
fn angle(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] * b[1] - a[1] * b[0]).atan2(a[0] * b[0] + a[1] * b[1]).abs()
}

/// Curvature at `r` in [0, 1] between two neighbours.
fn curvature_between(pair: &[Node], r: f64) -> f64 {
    let h = pair[1].s - pair[0].s;
    if pair[0].piece == pair[1].piece && h > 0.0 {
        hermite(r, h, [pair[0].curvature, pair[1].curvature], [pair[0].slope, pair[1].slope]).0
    } else {
        pair[usize::from(r > 0.5)].curvature
    }
}

/// The point at `s` of a run.
fn place(run: &[Node], s: f64) -> Place {
    let after = run.partition_point(|node| node.s < s).clamp(1, run.len() - 1);
    let (a, b) = (&run[after - 1], &run[after]);
    let h = b.s - a.s;
    if h <= 0.0 {
        return Place { s, point: a.point };
    }
    let r = ((s - a.s) / h).clamp(0.0, 1.0);
    let point = std::array::from_fn(|d| hermite(r, h, [a.point[d], b.point[d]], [a.tangent[d], b.tangent[d]]).0);
    Place { s, point }
}

/// Largest distance of the run between two places from their chord; when they coincide, from them.
fn departure(run: &[Node], from: f64, to: f64) -> f64 {
    let (a, b) = (place(run, from).point, place(run, to).point);
    let chord = distance(a, b);
    let off = |p: [f64; 2]| {
        if chord > 1e-9 * (to - from) {
            ((b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])).abs() / chord
        } else {
            distance(a, p)
        }
    };
    let first = run.partition_point(|node| node.s <= from);
    let inside = run[first..].iter().take_while(|node| node.s < to).map(|node| off(node.point));
    // A stretch between two nodes still has a middle.
    inside.fold(off(place(run, 0.5 * (from + to)).point), f64::max)
}

fn inflections_of(run: &[Node], tolerance: f64) -> Vec<f64> {
    let mut lobes: Vec<Lobe> = Vec::new();
    let mut before: Option<usize> = None;
    let end = run[run.len() - 1].s;
    for (k, node) in run.iter().enumerate() {
        let turn = sign(node.curvature);
        if turn == 0 {
            continue;
        }
        match (lobes.last_mut(), before) {
            (Some(lobe), Some(last)) if lobe.sign != turn => {
                let other = &run[last];
                let h = node.s - other.s;
                let adjacent = last + 1 == k && other.piece == node.piece && h > 0.0;
                let r = if adjacent { bisect(|r| curvature_between(&run[last..=k], r)) } else { 0.5 };
                lobe.to = other.s + r * h;
                let from = lobe.to;
                lobes.push(Lobe { sign: turn, from, to: end });
            }
            (None, _) => lobes.push(Lobe { sign: turn, from: run[0].s, to: end }),
            _ => {}
        }
        before = Some(k);
    }
    let mut heights: Vec<f64> = lobes.iter().map(|lobe| departure(run, lobe.from, lobe.to)).collect();
    while lobes.len() > 1 {
        let (mut least, mut height) = (0, f64::INFINITY);
        for (k, &h) in heights.iter().enumerate() {
            if h < height {
                (least, height) = (k, h);
            }
        }
        if height >= tolerance {
            break;
        }
        let (first, last) = (least.saturating_sub(1), (least + 1).min(lobes.len() - 1));
        let sign = lobes[if least == 0 { last } else { first }].sign;
        let merged = Lobe { sign, from: lobes[first].from, to: lobes[last].to };
        lobes.splice(first..=last, [merged]);
        heights.splice(first..=last, [departure(run, merged.from, merged.to)]);
    }
    lobes.iter().skip(1).map(|lobe| lobe.from).collect()
}

/// Arc length and curvature along a run: its nodes, and the extrema of the cubics between them.
fn course(run: &[Node]) -> Vec<(f64, f64)> {
    let mut points: Vec<(f64, f64)> = vec![(run[0].s, run[0].curvature)];
    for pair in run.windows(2) {
        let h = pair[1].s - pair[0].s;
        if pair[0].piece == pair[1].piece && h > 0.0 && sign(pair[0].slope) * sign(pair[1].slope) < 0 {
            let ends = ([pair[0].curvature, pair[1].curvature], [pair[0].slope, pair[1].slope]);
            let r = bisect(|r| hermite(r, h, ends.0, ends.1).1);
            points.push((pair[0].s + r * h, hermite(r, h, ends.0, ends.1).0));
        }
        points.push((pair[1].s, pair[1].curvature));
    }
    points
}

/// Where the curvature of a run turns; a closed one starts near its largest curvature, where it turns if it does
/// anywhere.
fn extrema_of(run: &[Node], tolerance: f64, closed: bool) -> Vec<f64> {
    let course = course(run);
    let turns = turning_points(&course, tolerance);
    let mut found: Vec<f64> = turns[1..turns.len() - 1].iter().map(|&turn| course[turn].0).collect();
    // Once round a curve there are as many maxima as minima.
    if closed && found.len() % 2 == 1 {
        let ends = [turns[0], turns[turns.len() - 1]].map(|turn| course[turn]);
        found.push(if ends[0].1.abs() > ends[1].1.abs() { ends[0].0 } else { ends[1].0 });
    }
    found
}

/// Maximal stretches of a run with |kappa| at most `bound`; those that bend too much are searched again with half the
/// bound.
fn flats_of(run: &[Node], bound: f64, least: f64, tolerance: f64, halvings: u32) -> Vec<Stretch> {
    let last = run.len() - 1;
    if run[last].s - run[0].s >= least && departure(run, run[0].s, run[last].s) <= tolerance {
        return vec![Stretch { from: place(run, run[0].s), to: place(run, run[last].s) }];
    }
    let low = |k: usize| run[k].curvature.abs() <= bound;
    // Where |kappa| passes the bound between two neighbours.
    let border = |k: usize| {
        let pair = &run[k..k + 2];
        let h = pair[1].s - pair[0].s;
        if pair[0].piece != pair[1].piece || h <= 0.0 {
            return pair[0].s;
        }
        pair[0].s + h * bisect(|r| curvature_between(pair, r).abs() - bound)
    };
    let mut found = Vec::new();
    let mut first = 0;
    while first <= last {
        if !low(first) {
            first += 1;
            continue;
        }
        let mut end = first;
        while end < last && low(end + 1) {
            end += 1;
        }
        let from = if first > 0 { border(first - 1) } else { run[0].s };
        let to = if end < last { border(end) } else { run[last].s };
        if to - from >= least {
            if departure(run, from, to) <= tolerance {
                found.push(Stretch { from: place(run, from), to: place(run, to) });
            } else if halvings > 0 {
                // With the neighbours above the bound, so that the borders of the next search are found.
                let part = &run[first.saturating_sub(1)..=(end + 1).min(last)];
                found.extend(flats_of(part, 0.5 * bound, least, tolerance, halvings - 1));
            }
        }
        first = end + 1;
    }
    found
}
