//! Which point of a section goes with which point of the next: one list of parameters, the nodes, for all sections.
//!
//! The parameter of a section is the share of its girth. Where the keel line jumps (skeg, dome, stem over a bulb), the
//! sections on the shallow side begin at the parameter at which the last deep section is nearest to their keel: what is
//! below that shrinks to the keel line and is not drawn out over the hull beyond.
//!
//! A point that is put on a node is met to rounding, but moves the lines of the net along the section, each section in
//! its own way; too many of them make waves between the sections. In tables with few points all are put on nodes; in
//! those with many (sections cut from meshes, digitised ones) the corners, and what else would be missed by more than a
//! tolerance. Of all ways to put points on nodes in order, the one with the least sum of squared shifts is taken.

use super::super::limits;
use super::section::Section;

/// Nodes over the greatest number of points of a section.
const DENSITY: f64 = 1.5;

/// Fewest and most nodes.
const LEAST: usize = 61;
const MOST: usize = 121;

/// Nodes closer than this are one.
const SAME: f64 = 1e-9;

/// Sections of up to as many points are met at every point.
const FEW: usize = 40;

/// What others may be missed by, over the greatest half-breadth.
const TOLERANCE: f64 = 2e-5;

/// A turn within [`REACH`] of the girth on both sides that is a corner \[rad\].
const CORNER: f64 = 0.35;
const REACH: f64 = 5e-3;

/// Rounds in which points that are missed are put on nodes, one a gap.
const ROUNDS: usize = 5;

/// A section on the nodes.
#[derive(Debug, Clone)]
pub(super) struct Nodal {
    /// (y, z) at the nodes \[m\].
    pub(super) points: Vec<[f64; 2]>,
    /// Their derivatives with respect to the parameter \[m\].
    pub(super) slopes: Vec<[f64; 2]>,
}

impl Nodal {
    /// A section that is a point.
    pub(super) fn point(at: [f64; 2], nodes: usize) -> Self {
        Self { points: vec![at; nodes], slopes: vec![[0.0; 2]; nodes] }
    }

    /// Control values of half-breadths (0) or heights (1) on [`columns`].
    pub(super) fn control(&self, nodes: &[f64], axis: usize) -> Vec<f64> {
        let mut result = vec![self.points[0][axis]];
        for m in 1..nodes.len() {
            let h = (nodes[m] - nodes[m - 1]) / 3.0;
            result.push(self.points[m - 1][axis] + h * self.slopes[m - 1][axis]);
            result.push(self.points[m][axis] - h * self.slopes[m][axis]);
        }
        result.push(self.points[nodes.len() - 1][axis]);
        result
    }
}

/// Parameter of every point of every section. `jumps` are pairs of neighbouring sections between which the keel jumps.
pub(super) fn parameters(sections: &[Section], jumps: &[[usize; 2]]) -> Vec<Vec<f64>> {
    let plain = |k: usize, start: f64| -> Vec<f64> {
        let girths = sections[k].girths();
        let all = girths[girths.len() - 1].max(f64::MIN_POSITIVE);
        girths.iter().map(|g| start + (1.0 - start) * g / all).collect()
    };
    let mut starts = vec![0.0f64; sections.len()];
    for &[aft, fore] in jumps {
        let (deep, shallow) = if sections[aft].keel() < sections[fore].keel() { (aft, fore) } else { (fore, aft) };
        let keel = sections[shallow].points[0];
        let own = plain(deep, starts[deep]);
        let start = nearest(&sections[deep].points, &own, keel);
        // As far as the keel does not jump again.
        let others: Vec<usize> = jumps.iter().filter(|j| **j != [aft, fore]).flatten().copied().collect();
        let range = if shallow > deep {
            shallow..others.iter().copied().filter(|&k| k > shallow).min().map_or(sections.len(), |k| k + 1)
        } else {
            others.iter().copied().filter(|&k| k < shallow).max().unwrap_or(0)..shallow + 1
        };
        starts[range].iter_mut().for_each(|s| *s = s.max(start));
    }
    (0..sections.len()).map(|k| plain(k, starts[k])).collect()
}

/// Parameter at which a line of points is nearest to a point.
fn nearest(points: &[[f64; 2]], parameters: &[f64], to: [f64; 2]) -> f64 {
    let mut best = (f64::INFINITY, 0.0);
    for (pair, t) in points.windows(2).zip(parameters.windows(2)) {
        let along = [pair[1][0] - pair[0][0], pair[1][1] - pair[0][1]];
        let square = along[0] * along[0] + along[1] * along[1];
        let offset = [to[0] - pair[0][0], to[1] - pair[0][1]];
        let share =
            if square > 0.0 { ((offset[0] * along[0] + offset[1] * along[1]) / square).clamp(0.0, 1.0) } else { 0.0 };
        let distance = (offset[0] - share * along[0]).hypot(offset[1] - share * along[1]);
        if distance < best.0 {
            best = (distance, t[0] + share * (t[1] - t[0]));
        }
    }
    best.1
}

/// What a section may be missed by between its nodes \[m\]: nothing where points are few.
pub(super) fn tolerance(sections: &[Section], breadth: f64) -> f64 {
    let most = sections.iter().map(|s| s.points.len()).max().unwrap_or(0);
    if most <= FEW { 0.0 } else { TOLERANCE * breadth }
}

/// The nodes, 0 to 1: half of them even, half as dense as the points of all sections.
pub(super) fn nodes(parameters: &[Vec<f64>]) -> Vec<f64> {
    let most = parameters.iter().map(Vec::len).max().unwrap_or(0);
    let count = ((most as f64 * DENSITY) as usize).clamp(LEAST, MOST);
    let mut all: Vec<f64> = parameters.iter().flatten().copied().filter(|t| *t > 0.0 && *t < 1.0).collect();
    all.sort_by(f64::total_cmp);
    all.insert(0, 0.0);
    all.push(1.0);
    // Mean of the distribution of the points and of the even one, inverted.
    let ranks = (all.len() - 1) as f64;
    let share = |k: usize| 0.5 * (k as f64 / ranks + all[k]);
    let mut result = Vec::with_capacity(count);
    let mut k = 0;
    for m in 0..count {
        let wanted = m as f64 / (count - 1) as f64;
        while k + 2 < all.len() && share(k + 1) < wanted {
            k += 1;
        }
        let (a, b) = (share(k), share(k + 1));
        let part = if b > a { ((wanted - a) / (b - a)).clamp(0.0, 1.0) } else { 0.0 };
        result.push(all[k] + part * (all[k + 1] - all[k]));
    }
    (result[0], result[count - 1]) = (0.0, 1.0);
    // Points at the same parameter in all sections draw many nodes to it; one is enough.
    result.dedup_by(|later, earlier| *later - *earlier < SAME);
    if let Some(last) = result.last_mut() {
        *last = 1.0;
    }
    result
}

/// The node of each point: rising, the first point on the node nearest to its parameter, the last on the last.
pub(super) fn assign(parameters: &[f64], nodes: &[f64]) -> Vec<usize> {
    let (count, last) = (parameters.len(), nodes.len() - 1);
    let start = (0..nodes.len())
        .filter(|m| m + count <= nodes.len())
        .min_by(|&a, &b| (nodes[a] - parameters[0]).abs().total_cmp(&(nodes[b] - parameters[0]).abs()))
        .unwrap_or(0);
    // costs[m]: least cost with the present point on node start + m.
    let width = last + 1 - start;
    let mut costs = vec![f64::INFINITY; width];
    costs[0] = 0.0;
    let mut from: Vec<Vec<usize>> = vec![vec![0; width]];
    for (k, &own) in parameters.iter().enumerate().skip(1) {
        let mut next = vec![f64::INFINITY; width];
        let mut origin = vec![0; width];
        let mut best = (f64::INFINITY, 0);
        for m in k..width {
            if costs[m - 1] < best.0 {
                best = (costs[m - 1], m - 1);
            }
            if width - m > count - 1 - k && (k + 1 < count || m + 1 == width) {
                let shift = nodes[start + m] - own;
                next[m] = best.0 + shift * shift;
                origin[m] = best.1;
            }
        }
        costs = next;
        from.push(origin);
    }
    let mut result = vec![last; count];
    let mut at = width - 1;
    for k in (0..count).rev() {
        result[k] = start + at;
        at = from[k][at];
    }
    result
}

/// The piecewise cubic through the points of a section over its girth: heights never fall, half-breadths are never
/// negative.
struct Outline {
    girths: Vec<f64>,
    /// Half-breadths and heights, and their slopes.
    values: [Vec<f64>; 2],
    rates: [Vec<f64>; 2],
}

impl Outline {
    fn new(section: &Section) -> Self {
        let girths = section.girths();
        let values = [0, 1].map(|axis| section.points.iter().map(|p| p[axis]).collect::<Vec<f64>>());
        let mut rates = [0, 1].map(|axis| limits::parabolic(&girths, &values[axis]));
        limits::limit(&girths, &values[0], 0.0, &mut rates[0]);
        limits::rise(&girths, &values[1], &mut rates[1]);
        Self { girths, values, rates }
    }

    /// (y, z) and their slopes over the girth.
    fn eval(&self, girth: f64) -> [[f64; 2]; 2] {
        let k = self.girths.partition_point(|g| *g <= girth).clamp(1, self.girths.len() - 1) - 1;
        let h = self.girths[k + 1] - self.girths[k];
        let t = ((girth - self.girths[k]) / h).clamp(0.0, 1.0);
        [0, 1].map(|axis| {
            let (values, rates) = (&self.values[axis], &self.rates[axis]);
            limits::cubic(h, [values[k], values[k + 1]], [rates[k], rates[k + 1]], t)
        })
    }

    /// Ends and corners, of corners within reach of each other the sharpest.
    fn corners(&self) -> Vec<bool> {
        let last = self.girths.len() - 1;
        let reach = REACH * self.girths[last];
        let turn = |k: usize| {
            let place = |girth: f64| self.eval(girth).map(|axis| axis[0]);
            let (p, q, r) =
                (place(self.girths[k] - reach), [self.values[0][k], self.values[1][k]], place(self.girths[k] + reach));
            let (a, b) = ([q[0] - p[0], q[1] - p[1]], [r[0] - q[0], r[1] - q[1]]);
            (a[0] * b[1] - a[1] * b[0]).atan2(a[0] * b[0] + a[1] * b[1]).abs()
        };
        let turns: Vec<f64> = (0..=last).map(|k| if k == 0 || k == last { f64::INFINITY } else { turn(k) }).collect();
        (0..=last)
            .map(|k| {
                let near = |j: &usize| *j != k && (self.girths[*j] - self.girths[k]).abs() < reach;
                let below = (0..k).rev().take_while(near).any(|j| turns[j] >= turns[k]);
                let above = (k + 1..=last).take_while(near).any(|j| turns[j] > turns[k]);
                k == 0 || k == last || (turns[k] > CORNER && !below && !above)
            })
            .collect()
    }
}

/// Girth over the parameter, monotone through points on nodes.
struct Walk {
    nodes: Vec<usize>,
    sites: Vec<f64>,
    girths: Vec<f64>,
    speeds: Vec<f64>,
}

impl Walk {
    /// The speed at every point is that of an even walk, so that the shift of a point to its node stays in the gaps
    /// beside it.
    fn new(assigned: Vec<usize>, nodes: &[f64], girths: Vec<f64>) -> Self {
        let sites: Vec<f64> = assigned.iter().map(|&m| nodes[m]).collect();
        let last = sites.len() - 1;
        let even = (girths[last] - girths[0]) / (sites[last] - sites[0]);
        let mut speeds = vec![even; sites.len()];
        limits::rise(&sites, &girths, &mut speeds);
        Self { nodes: assigned, sites, girths, speeds }
    }

    /// Girth at a parameter and its slope.
    fn eval(&self, v: f64) -> [f64; 2] {
        let k = self.sites.partition_point(|s| *s <= v).clamp(1, self.sites.len() - 1) - 1;
        let width = self.sites[k + 1] - self.sites[k];
        let t = ((v - self.sites[k]) / width).clamp(0.0, 1.0);
        let pair = |list: &[f64]| [list[k], list[k + 1]];
        limits::cubic(width, pair(&self.girths), pair(&self.speeds), t)
    }
}

/// The section on the nodes, within `tolerance` of the outline through its points; with none, on all of them.
pub(super) fn nodal(section: &Section, parameters: &[f64], nodes: &[f64], tolerance: f64) -> Nodal {
    let outline = Outline::new(section);
    let exact = tolerance <= 0.0;
    let mut held = if exact { vec![true; parameters.len()] } else { outline.corners() };
    for round in 0.. {
        let anchors: Vec<usize> = (0..held.len()).filter(|&k| held[k]).collect();
        let own: Vec<f64> = anchors.iter().map(|&k| parameters[k]).collect();
        let girths = anchors.iter().map(|&k| outline.girths[k]).collect();
        let walk = Walk::new(assign(&own, nodes), nodes, girths);
        let result = on_nodes(&outline, &walk, &anchors, nodes);
        if exact || round >= ROUNDS {
            return result;
        }
        let room = nodes.len() - walk.nodes[0] - anchors.len();
        let mut missed: Vec<usize> = Vec::new();
        for m in walk.nodes[0]..nodes.len() - 1 {
            let width = nodes[m + 1] - nodes[m];
            let off = [0.25, 0.5, 0.75].into_iter().any(|share| {
                let there = outline.eval(walk.eval(nodes[m] + share * width)[0]);
                let apart = [0, 1].map(|axis| {
                    let (points, slopes) = (&result.points, &result.slopes);
                    let ends = [points[m][axis], points[m + 1][axis]];
                    limits::cubic(width, ends, [slopes[m][axis], slopes[m + 1][axis]], share)[0] - there[axis][0]
                });
                apart[0].hypot(apart[1]) > tolerance
            });
            if off {
                let (low, high) = (walk.eval(nodes[m])[0], walk.eval(nodes[m + 1])[0]);
                let inside = |k: &usize| !held[*k] && outline.girths[*k] > low && outline.girths[*k] < high;
                let shift = |k: usize| (outline.girths[k] - low).min(high - outline.girths[k]);
                missed.extend((0..held.len()).filter(inside).min_by(|&a, &b| shift(a).total_cmp(&shift(b))));
            }
        }
        if missed.is_empty() || missed.len() > room / 2 {
            return result;
        }
        missed.into_iter().for_each(|k| held[k] = true);
    }
    Nodal::point(section.points[0], nodes.len())
}

fn on_nodes(outline: &Outline, walk: &Walk, anchors: &[usize], nodes: &[f64]) -> Nodal {
    let point = |k: usize| [outline.values[0][k], outline.values[1][k]];
    let mut result = Nodal::point(point(0), nodes.len());
    for (m, &v) in nodes.iter().enumerate().skip(walk.nodes[0]) {
        let [girth, speed] = walk.eval(v);
        let at = outline.eval(girth);
        result.points[m] = match walk.nodes.binary_search(&m) {
            Ok(place) => point(anchors[place]),
            Err(_) => at.map(|a| a[0]),
        };
        result.slopes[m] = at.map(|a| a[1] * speed);
    }
    for axis in 0..2 {
        let values: Vec<f64> = result.points.iter().map(|p| p[axis]).collect();
        let mut slopes: Vec<f64> = result.slopes.iter().map(|p| p[axis]).collect();
        if axis == 0 {
            limits::limit(nodes, &values, 0.0, &mut slopes);
        } else {
            limits::rise(nodes, &values, &mut slopes);
        }
        result.slopes.iter_mut().zip(slopes).for_each(|(s, slope)| s[axis] = slope);
    }
    result
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_get_nodes_of_their_own_in_order() {
        let nodes: Vec<f64> = (0..=10).map(|m| 0.1 * f64::from(m)).collect();
        assert_eq!(assign(&[0.0, 0.31, 0.69, 1.0], &nodes), [0, 3, 7, 10]);
        // Three points at one place part around it.
        assert_eq!(assign(&[0.0, 0.5, 0.5, 0.5, 1.0], &nodes), [0, 4, 5, 6, 10]);
        // A section that begins beyond a jump, and as many points as there is room for.
        assert_eq!(assign(&[0.42, 0.6, 1.0], &nodes), [4, 6, 10]);
        let full: Vec<f64> = (0..11).map(|k| if k == 0 { 0.0 } else { 0.9 + 0.01 * f64::from(k) }).collect();
        assert_eq!(assign(&full, &nodes), (0..11).collect::<Vec<_>>());
    }

    #[test]
    fn a_section_on_the_nodes_meets_its_points_and_does_not_swing() {
        // Flat bottom, bilge as a corner, wall, ledge, wall.
        let points = vec![[0.0, 0.0], [3.0, 0.0], [4.0, 1.0], [4.0, 3.0], [6.0, 3.0], [6.0, 5.0]];
        let section = Section { x: 0.0, station: 0, points };
        let own = parameters(std::slice::from_ref(&section), &[]).remove(0);
        let nodes = nodes(std::slice::from_ref(&own));
        let assigned = assign(&own, &nodes);
        let nodal = nodal(&section, &own, &nodes, 0.0);
        for (&m, p) in assigned.iter().zip(&section.points) {
            assert!(nodal.points[m].iter().zip(p).all(|(a, b)| (a - b).abs() < 1e-15));
        }
        let (y, z) = (nodal.control(&nodes, 0), nodal.control(&nodes, 1));
        assert_eq!(y.len(), 2 * nodes.len());
        assert!(z.windows(2).all(|w| w[1] >= w[0] - 1e-12), "{z:?}");
        assert!(y.iter().all(|y| (-1e-12..=6.0 + 1e-12).contains(y)));
        // With a tolerance the corners are on nodes all the same.
        let loose = super::nodal(&section, &own, &nodes, 1e-3);
        assert!(loose.points[assigned[2]].iter().zip(section.points[2]).all(|(a, b)| (a - b).abs() < 1e-15));
        // The wall is a wall and the ledge a ledge.
        for p in &nodal.points[assigned[2]..=assigned[3]] {
            assert!((p[0] - 4.0).abs() < 1e-12);
        }
        for p in &nodal.points[assigned[3]..=assigned[4]] {
            assert!((p[1] - 3.0).abs() < 1e-12);
        }
    }

    #[test]
    fn beyond_a_jump_the_deep_part_shrinks_to_the_keel() {
        let deep =
            Section { x: 0.0, station: 0, points: vec![[0.0, -2.0], [0.5, -1.0], [0.1, 3.0], [4.0, 5.0], [4.0, 7.0]] };
        let shallow = Section { x: 1.0, station: 1, points: vec![[0.0, 3.0], [4.0, 5.0], [4.0, 7.0]] };
        let girths = deep.girths();
        let own = parameters(&[deep, shallow], &[[0, 1]]);
        assert!((own[1][0] - girths[2] / girths[4]).abs() < 0.02, "{own:?}");
        assert!((own[1][1] - own[0][3]).abs() < 0.02);
    }
}
