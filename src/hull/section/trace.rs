//! From a chain of graph segments to a curve: quintic Hermite arcs between points of the contour.
//!
//! Position, first and second derivatives with respect to the running coordinate are exact at both ends of an arc
//! (implicit differentiation of f = 0). Inside, the arc is compared with points of the contour at the same parameter
//! and divided until the distance is below 0.7 of the tolerance; the error of an arc of length h is P^(6) (tau (1 -
//! tau))^3 h^6 / 720.

use super::bernstein::Arc;
use super::contour::{Chain, Link, Running};
use super::field::{Node, Patch};

/// Degree of the arcs.
const DEGREE: usize = 5;
/// Steepest graph that is followed over a coordinate when the other one would do as well.
const STEEPEST: f64 = 3.0;
/// Divisions of a segment at most.
const DEEPEST: u32 = 48;
/// Divisions of one segment of the contour in all: a bound on the work where rounding leaves nothing to converge to.
const MOST_DIVISIONS: usize = 4000;
/// Parts into which an arc with too large an error is divided at most.
const MOST_PARTS: usize = 6;
/// Share of the tolerance that the error at the compared points may have; the rest is for the points between them.
const SHARE: f64 = 0.7;

/// The arcs of a chain; parameters run on from 0 in units of the parameters of the surface.
pub(super) fn trace(chain: &Chain, patches: &[Patch], tolerance: f64) -> Vec<Arc<3>> {
    let mut tracer = Tracer { arcs: Vec::new(), at: 0.0, tolerance, divisions: 0 };
    for link in &chain.links {
        let patch = &patches[link.segment.patch];
        let (a, b) = (patch.node(link.from), patch.node(link.to));
        tracer.divisions = 0;
        tracer.segment(patch, link, &a, &b, 0);
    }
    let arcs = &mut tracer.arcs;
    for k in 1..arcs.len() {
        arcs[k].points[0] = arcs[k - 1].points[DEGREE];
    }
    if chain.closed
        && let (Some(first), Some(last)) = (arcs.first().map(|a| a.points[0]), arcs.last_mut())
    {
        last.points[DEGREE] = first;
    }
    tracer.arcs
}

struct Tracer {
    arcs: Vec<Arc<3>>,
    at: f64,
    tolerance: f64,
    /// Divisions of the segment at hand.
    divisions: usize,
}

/// What one arc is a graph over.
#[derive(Clone, Copy, PartialEq)]
enum Mode {
    /// Over coordinate 0 (s) or 1 (t).
    Over(usize),
    Straight,
}

impl Tracer {
    fn segment(&mut self, patch: &Patch, link: &Link, a: &Node, b: &Node, depth: u32) {
        let extent = [b.st[0] - a.st[0], b.st[1] - a.st[1]];
        if extent[0].abs().max(extent[1].abs()) <= 1e-15 {
            return;
        }
        let Some(mode) = self.mode(patch, link.segment.running, a, b, depth) else {
            // Steep over either coordinate: halve the larger extent.
            self.divisions += 1;
            let fixed = usize::from(extent[1].abs() > extent[0].abs());
            let middle = self.middle(patch, link, Mode::Over(fixed), a, b, 0.5);
            let node = patch.node(middle);
            self.segment(patch, link, a, &node, depth + 1);
            self.segment(patch, link, &node, b, depth + 1);
            return;
        };
        let (length, points) = match mode {
            Mode::Over(k) if extent[k].abs() > 1e-15 => (extent[k].abs() * patch.size[k], arc(a, b, mode)),
            _ => ((extent[0] * patch.size[0]).hypot(extent[1] * patch.size[1]), arc(a, b, Mode::Straight)),
        };
        let arc = Arc { degree: DEGREE, low: self.at, high: self.at + length, points };
        let short = apart(a.point, b.point) <= 0.5 * self.tolerance;
        if short || depth >= DEEPEST || self.divisions >= MOST_DIVISIONS {
            self.push(arc);
            return;
        }
        let error = |tau: f64| {
            let st = self.middle(patch, link, mode, a, b, tau);
            (apart(patch.point(st), arc.at(tau)), st)
        };
        let limit = SHARE * self.tolerance;
        let (at_middle, middle) = error(0.5);
        let worst = if at_middle > limit { at_middle } else { at_middle.max(error(0.22).0).max(error(0.78).0) };
        if worst > limit {
            self.divisions += 1;
            // Where plane and surface nearly touch, the contour is not determined to the tolerance; any line close to the
            // plane will do.
            if mode != Mode::Straight && straight(patch, a, b, 0.25 * self.tolerance) {
                let mut link = *link;
                link.segment.running = Running::Straight;
                self.segment(patch, &link, a, b, depth + 1);
                return;
            }
            // The error falls with the sixth power of the length.
            let parts = ((worst / (0.7 * limit)).powf(1.0 / 6.0).ceil() as usize).clamp(2, MOST_PARTS);
            let mut from = *a;
            for k in 1..parts {
                let st =
                    if 2 * k == parts { middle } else { self.middle(patch, link, mode, a, b, k as f64 / parts as f64) };
                let node = patch.node(st);
                self.segment(patch, link, &from, &node, depth + 1);
                from = node;
            }
            self.segment(patch, link, &from, b, depth + 1);
            return;
        }
        self.push(arc);
    }

    fn push(&mut self, mut arc: Arc<3>) {
        // Parameters must grow, however short the arc.
        let least = 1e-14 * (1.0 + self.at);
        arc.high = arc.high.max(arc.low + least);
        self.at = arc.high;
        self.arcs.push(arc);
    }

    /// The coordinate to follow; none when the graph is too steep over both.
    fn mode(&self, patch: &Patch, running: Running, a: &Node, b: &Node, depth: u32) -> Option<Mode> {
        let steepness = |k: usize| {
            let over = |n: &Node| {
                if n.slope[1 - k] == 0.0 { f64::INFINITY } else { (n.slope[k] / n.slope[1 - k]).abs() }
            };
            let (x, y) = (over(a), over(b));
            if x > y { x } else { y }
        };
        let straight = |limit: f64| straight(patch, a, b, limit);
        let (over_s, over_t) = (steepness(0), steepness(1));
        match running {
            Running::Straight => Some(Mode::Straight),
            // Where f_s or f_t vanishes at an end (the plane touches the surface along a line) the slopes say nothing.
            _ if !(over_s.is_finite() || over_t.is_finite()) && straight(1e-3 * self.tolerance) => Some(Mode::Straight),
            Running::OverT if over_t.is_finite() || depth < 8 => Some(Mode::Over(1)),
            Running::OverS if over_s.is_finite() || depth < 8 => Some(Mode::Over(0)),
            Running::Both if over_s.min(over_t) <= STEEPEST => Some(Mode::Over(usize::from(over_t <= over_s))),
            _ if straight(0.25 * self.tolerance) || depth >= DEEPEST || self.divisions >= MOST_DIVISIONS => {
                Some(Mode::Straight)
            }
            Running::OverT => Some(Mode::Over(1)),
            Running::OverS => Some(Mode::Over(0)),
            Running::Both => None,
        }
    }

    /// The point of the contour at the fraction `r` of the running coordinate.
    fn middle(&self, patch: &Patch, link: &Link, mode: Mode, a: &Node, b: &Node, r: f64) -> [f64; 2] {
        let line = [a.st[0] + r * (b.st[0] - a.st[0]), a.st[1] + r * (b.st[1] - a.st[1])];
        let Mode::Over(k) = mode else { return line };
        let other = 1 - k;
        let ends = if link.segment.running == Running::Both {
            let (x, y) = (a.st[other], b.st[other]);
            if x <= y { [x, y] } else { [y, x] }
        } else {
            link.segment.cell[other]
        };
        // Cubic Hermite guess.
        let h = b.st[k] - a.st[k];
        let (ga, gb) = (-a.slope[k] / a.slope[other] * h, -b.slope[k] / b.slope[other] * h);
        let bump = r * (1.0 - r);
        let rise = b.st[other] - a.st[other];
        let guess = line[other] + bump * ((1.0 - r) * (ga - rise) - r * (gb - rise));
        patch.solve(k, line[k], ends, guess)
    }
}

/// Whether f stays within `limit` on the straight line between two points in the parameters.
fn straight(patch: &Patch, a: &Node, b: &Node, limit: f64) -> bool {
    [0.12, 0.3, 0.5, 0.7, 0.88].iter().all(|&r| {
        let st = [a.st[0] + r * (b.st[0] - a.st[0]), a.st[1] + r * (b.st[1] - a.st[1])];
        patch.distance(st).abs() <= limit
    })
}

fn apart(a: [f64; 3], b: [f64; 3]) -> f64 {
    ((a[0] - b[0]).powi(2) + (a[1] - b[1]).powi(2) + (a[2] - b[2]).powi(2)).sqrt()
}

/// Bezier points of the quintic with the position and two derivatives of the contour at both ends.
fn arc(a: &Node, b: &Node, mode: Mode) -> [[f64; 3]; DEGREE + 3] {
    let (first_a, second_a) = derivatives(a, a, b, mode);
    let (first_b, second_b) = derivatives(b, a, b, mode);
    let mut points = [[0.0; 3]; DEGREE + 3];
    for d in 0..3 {
        points[0][d] = a.point[d];
        points[1][d] = a.point[d] + first_a[d] / 5.0;
        points[2][d] = a.point[d] + 0.4 * first_a[d] + second_a[d] / 20.0;
        points[3][d] = b.point[d] - 0.4 * first_b[d] + second_b[d] / 20.0;
        points[4][d] = b.point[d] - first_b[d] / 5.0;
        points[5][d] = b.point[d];
    }
    points
}

/// First and second derivative of the contour at `n` with respect to the fraction of the running coordinate from `a` to
/// `b`.
fn derivatives(n: &Node, a: &Node, b: &Node, mode: Mode) -> ([f64; 3], [f64; 3]) {
    let extent = [b.st[0] - a.st[0], b.st[1] - a.st[1]];
    let (mut first, mut second) = (extent, [0.0; 2]);
    if let Mode::Over(k) = mode {
        let other = 1 - k;
        let inverse = 1.0 / n.slope[other];
        let g = -n.slope[k] * inverse;
        let bend = -(n.bend[2 * k] + 2.0 * n.bend[1] * g + n.bend[2 * other] * g * g) * inverse;
        if g.is_finite() && bend.is_finite() {
            first[other] = g * extent[k];
            second[other] = bend * extent[k] * extent[k];
        }
    }
    let mut result = ([0.0; 3], [0.0; 3]);
    for d in 0..3 {
        result.0[d] = n.first[0][d] * first[0] + n.first[1][d] * first[1];
        result.1[d] = n.second[0][d] * first[0] * first[0]
            + 2.0 * n.second[1][d] * first[0] * first[1]
            + n.second[2][d] * first[1] * first[1]
            + n.first[0][d] * second[0]
            + n.first[1][d] * second[1];
    }
    result
}
