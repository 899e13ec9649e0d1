//! The loops of a face in the parameters of its surface.

use super::surface::{Chart, Preimage};
use super::{BrepFace, FaceSurface, Samples};
use crate::spline::{length, minus};
use std::collections::HashMap;

/// Changes of a closed parameter that are none, over its length.
const SAME: f64 = 1e-6;

/// From this part of a turn on the shorter way between two points of an edge is not plainly the right one.
const EITHER: f64 = 0.4;

/// Closed edges of a loop that are turned at most.
const MOST_CLOSED: usize = 6;

/// A point of a loop.
#[derive(Debug, Clone, Copy)]
pub(super) struct Corner {
    /// Its index among the points of the body.
    pub(super) id: usize,
    /// Where it lies.
    pub(super) uv: [f64; 2],
    /// The part of an edge that begins here: the edge and the number of its part.
    part: Option<(usize, usize)>,
}

/// A loop in the plane of the parameters, and how often it winds around each of them.
struct Trace {
    corners: Vec<Corner>,
    winding: [i64; 2],
}

/// Loops that enclose a face.
#[derive(Debug)]
pub(super) struct Outline {
    pub(super) loops: Vec<Vec<Corner>>,
    pub(super) left: Option<bool>,
}

impl Outline {
    /// The loops of a face, which may be `off` its surface by so much.
    pub(super) fn of(
        face: &BrepFace,
        chart: &Chart<'_>,
        samples: &mut Samples,
        off: f64,
    ) -> Result<Self, &'static str> {
        let mut traces = Vec::new();
        for edges in face.loops.iter().filter(|edges| !edges.is_empty()) {
            let found = trace(edges, face.left, chart, samples, off)?;
            let turned = (face.left.is_none() && found.winding != [0, 0]).then(|| turned(edges, chart, samples, off));
            traces.push(turned.flatten().unwrap_or(found));
        }
        let loops = if traces.is_empty() {
            vec![whole(chart, samples, &[], face.left)?]
        } else if traces.iter().all(|trace| trace.winding == [0, 0]) {
            traces.into_iter().map(|trace| trace.corners).collect()
        } else {
            unwound(traces, face.left, chart, samples)?
        };
        let mut loops = beside(loops, chart);
        let closed = chart.period.iter().any(Option::is_some);
        let mut left = face.left;
        if let (true, Some(stated), Some(outer)) = (closed, face.left, loops.first()) {
            let found = area(outer) > 0.0;
            // What a loop encloses with its seam lies on both sides of the seam, whatever its direction.
            let has_seam = face.loops.iter().any(|edges| edges.iter().any(|&(k, along)| edges.contains(&(k, !along))));
            left = Some(found);
            if found != stated && !has_seam {
                // All of a ball but what the loops enclose.
                let around = whole(chart, samples, &loops, face.left);
                loops.insert(0, around.map_err(|_| "its loops run the other way round than its inside asks for")?);
                loops = beside(loops, chart);
                left = Some(stated);
            }
        }
        Ok(Self { loops, left })
    }

    /// Least and greatest parameters.
    pub(super) fn bounds(&self) -> [[f64; 2]; 2] {
        let all = || self.loops.iter().flatten().map(|corner| corner.uv);
        let fold =
            |pick: fn(f64, f64) -> f64, start: f64| [0, 1].map(|k: usize| all().map(|uv| uv[k]).fold(start, pick));
        [fold(f64::min, f64::INFINITY), fold(f64::max, f64::NEG_INFINITY)]
    }

    /// Raises the parts of edges to the cells of a grid that they cross.
    pub(super) fn crossed(&self, lines: &[Vec<f64>; 2], parts: &mut [Vec<usize>]) {
        for corners in &self.loops {
            for (a, b) in corners.iter().zip(corners.iter().cycle().skip(1)) {
                if let Some((edge, part)) = a.part {
                    let slot = &mut parts[edge][part];
                    *slot = (*slot).max(cells(lines, a.uv, b.uv));
                }
            }
        }
    }

    /// The outline with the points of seams and poles that the cells of a grid ask for.
    pub(super) fn refined(self, lines: &[Vec<f64>; 2], chart: &Chart<'_>, samples: &mut Samples) -> Self {
        let mut seams: HashMap<[usize; 2], Vec<usize>> = HashMap::new();
        let mut loops = Vec::with_capacity(self.loops.len());
        for corners in &self.loops {
            let mut list = Vec::with_capacity(corners.len());
            for (a, b) in corners.iter().zip(corners.iter().cycle().skip(1)) {
                list.push(*a);
                if a.part.is_some() {
                    continue;
                }
                let known = seams.get(&[b.id, a.id]).filter(|_| a.id != b.id);
                let count = known.map_or_else(|| cells(lines, a.uv, b.uv), |ids| ids.len() + 1);
                let at = |k: usize| [0, 1].map(|i: usize| a.uv[i] + (b.uv[i] - a.uv[i]) * k as f64 / count as f64);
                if a.id == b.id {
                    list.extend((1..count).map(|k| Corner { id: a.id, uv: at(k), part: None }));
                    continue;
                }
                let ids: Vec<usize> = match known {
                    Some(known) => known.iter().rev().copied().collect(),
                    None => seam(at, count, chart, samples, [a.id, b.id]),
                };
                list.extend(ids.iter().enumerate().map(|(k, &id)| Corner { id, uv: at(k + 1), part: None }));
                seams.insert([a.id, b.id], ids);
            }
            loops.push(list);
        }
        Self { loops, left: self.left }
    }
}

/// New points between two corners, and the middles between them.
fn seam(
    at: impl Fn(usize) -> [f64; 2],
    count: usize,
    chart: &Chart<'_>,
    samples: &mut Samples,
    [from, to]: [usize; 2],
) -> Vec<usize> {
    let first = samples.points.len();
    samples.points.extend((1..count).map(|k| chart.point(at(k))));
    let ids: Vec<usize> = (first..samples.points.len()).collect();
    let line: Vec<usize> = std::iter::once(from).chain(ids.iter().copied()).chain([to]).collect();
    for (k, pair) in line.windows(2).enumerate() {
        let [a, b] = [at(k), at(k + 1)];
        let middle = chart.point([0, 1].map(|i: usize| 0.5 * (a[i] + b[i])));
        samples.middles.insert([pair[0].min(pair[1]), pair[0].max(pair[1])], middle);
    }
    ids
}

/// Cells of a grid across which a line leads, at least 1.
fn cells(lines: &[Vec<f64>; 2], a: [f64; 2], b: [f64; 2]) -> usize {
    let across = |k: usize| (place(&lines[k], a[k]) - place(&lines[k], b[k])).abs();
    (across(0).max(across(1)) - 1e-6).ceil().clamp(1.0, 100.0) as usize
}

/// A parameter counted in the cells of its lines.
pub(super) fn place(lines: &[f64], t: f64) -> f64 {
    let last = lines.len() - 2;
    let k = lines.partition_point(|&line| line <= t).saturating_sub(1).min(last);
    let width = lines[k + 1] - lines[k];
    if width > 0.0 { k as f64 + (t - lines[k]) / width } else { k as f64 }
}

/// Twice the area inside, positive where it is to the left.
fn area(corners: &[Corner]) -> f64 {
    let next = corners.iter().cycle().skip(1);
    corners.iter().zip(next).map(|(a, b)| a.uv[0] * b.uv[1] - b.uv[0] * a.uv[1]).sum()
}

/// A loop of edges, point by point.
fn trace(
    edges: &[(usize, bool)],
    left: Option<bool>,
    chart: &Chart<'_>,
    samples: &Samples,
    off: f64,
) -> Result<Trace, &'static str> {
    let mut points: Vec<(usize, (usize, usize))> = Vec::new();
    for &(edge, forward) in edges {
        let line = &samples.edges[edge];
        let last = line.len() - 1;
        if forward {
            points.extend((0..last).map(|k| (line[k], (edge, k))));
        } else {
            points.extend((0..last).map(|k| (line[last - k], (edge, last - 1 - k))));
        }
    }
    let search = |is_narrow: bool, k: usize, near: Option<[f64; 2]>| {
        let point = samples.points[points[k].0];
        if is_narrow { chart.preimage_on_narrow(point, near) } else { chart.preimage(point, near) }
    };
    let begin = |is_narrow: bool| {
        let mut alone = (0..points.len()).map(|k| (k, search(is_narrow, k, None)));
        alone.find(|(_, found)| found.free.is_none()).map(|found| (is_narrow, found))
    };
    let Some((is_narrow, (start, first))) = begin(false).or_else(|| begin(true)) else {
        return Err("its loop is a point");
    };
    let mut corners: Vec<Corner> = Vec::with_capacity(points.len() + 2);
    let mut near = first.uv;
    let mut pole: Option<(usize, Preimage)> = None;
    for step in 0..=points.len() {
        let k = (start + step) % points.len();
        let (id, part) = points[k];
        let mut found = search(is_narrow, k, Some(near));
        let lies = found.distance <= off;
        if !lies {
            return Err("its loops do not lie on its surface");
        }
        if found.free.is_some() {
            pole = pole.or(Some((id, found)));
            continue;
        }
        let past_pole = pole.is_some();
        if let Some((id, Preimage { uv, free: Some(free), .. })) = pole.take() {
            let other = 1 - free;
            let mut leaves = found.uv[free];
            if let Some(period) = chart.period[free] {
                let turn = leaves - near[free];
                // The inside is to the left: at the upper end of v it lies at smaller u, at the upper end of u at larger v.
                let ahead = if (uv[other] > near[other]) == (free == 0) { -1.0 } else { 1.0 };
                let ahead = if left == Some(false) { -ahead } else { ahead };
                if left.is_none() {
                    return Err("its loop meets a pole, and either side of it may be meant");
                }
                if turn.abs() <= SAME * period || turn * ahead < 0.0 {
                    leaves += ahead * period;
                }
            }
            let at = |t: f64| if free == 0 { [t, uv[1]] } else { [uv[0], t] };
            // The part that leaves the pole is the one before this point.
            let before = points[(k + points.len() - 1) % points.len()].1;
            corners.push(Corner { id, uv: at(near[free]), part: None });
            corners.push(Corner { id, uv: at(leaves), part: Some(before) });
            found.uv[free] = leaves;
        }
        // Points of an edge are nearer to each other; past a pole that is missed either way may be meant.
        let jumps = |k: usize| chart.period[k].is_some_and(|period| (found.uv[k] - near[k]).abs() > EITHER * period);
        if !past_pole && (jumps(0) || jumps(1)) {
            return Err("its loop passes a pole, and either side of it may be meant");
        }
        if step == points.len() {
            near = found.uv;
            break;
        }
        corners.push(Corner { id, uv: found.uv, part: Some(part) });
        near = found.uv;
    }
    let winding = [0, 1]
        .map(|k: usize| chart.period[k].map_or(0, |period| ((near[k] - corners[0].uv[k]) / period).round() as i64));
    Ok(Trace { corners, winding })
}

/// A loop that winds around nothing once some of its closed edges are turned, which have no direction by their ends.
fn turned(edges: &[(usize, bool)], chart: &Chart<'_>, samples: &Samples, off: f64) -> Option<Trace> {
    let is_closed = |edge: usize| samples.edges[edge].first() == samples.edges[edge].last();
    let closed: Vec<usize> = (0..edges.len()).filter(|&k| is_closed(edges[k].0)).collect();
    if edges.len() < 2 || closed.len() > MOST_CLOSED {
        return None;
    }
    (1..1_usize << closed.len()).find_map(|choice| {
        let mut list = edges.to_vec();
        for (bit, &k) in closed.iter().enumerate() {
            list[k].1 ^= (choice >> bit) & 1 == 1;
        }
        trace(&list, None, chart, samples, off).ok().filter(|found| found.winding == [0, 0])
    })
}

/// One loop of those that wind around a closed surface: two of them joined by a seam, or one that is joined to a pole.
fn unwound(
    traces: Vec<Trace>,
    left: Option<bool>,
    chart: &Chart<'_>,
    samples: &mut Samples,
) -> Result<Vec<Vec<Corner>>, &'static str> {
    let (winding, plain): (Vec<Trace>, Vec<Trace>) = traces.into_iter().partition(|trace| trace.winding != [0, 0]);
    let axis = usize::from(winding[0].winding[0] == 0);
    let turns: Vec<i64> = winding.iter().map(|trace| trace.winding[axis]).collect();
    let period = chart.period[axis].unwrap_or(1.0);
    let other = 1 - axis;
    if winding.iter().any(|trace| trace.winding[other] != 0) {
        return Err("its loops wind around it in both directions");
    }
    let mut lists = winding.into_iter().map(|trace| trace.corners);
    let joined = match (turns.as_slice(), lists.next(), lists.next()) {
        (&[turn], Some(corners), None) if turn.abs() == 1 => {
            let rises = (turn > 0) == (axis == 0);
            let upward = left.map(|left| rises == left);
            let level = corners[0].uv[other];
            let nearest = chart
                .poles(axis)
                .into_iter()
                .filter(|&pole| upward.is_none_or(|upward| (pole > level) == upward))
                .collect::<Vec<f64>>();
            let pole = match (nearest.as_slice(), upward) {
                ([], _) => return Err("one loop winds around it, and it has no pole there"),
                (&[pole], _) => pole,
                (all, Some(_)) => {
                    all.iter().copied().min_by(|a, b| (a - level).abs().total_cmp(&(b - level).abs())).unwrap_or(level)
                }
                (_, None) => return Err("one loop winds around it, and either side may be meant"),
            };
            to_pole(corners, axis, turn as f64 * period, pole, chart, samples)
        }
        (&[a, b], Some(first), Some(second)) if a.abs() == 1 && a == -b => {
            // Of a torus they cut off two parts.
            if left.is_none() && chart.period[other].is_some() {
                return Err("two loops wind around it, and either part between them may be meant");
            }
            across(first, second, axis, a as f64 * period, left != Some(false), chart)
        }
        _ => return Err("its loops wind around it more than once"),
    };
    Ok(std::iter::once(joined).chain(plain.into_iter().map(|trace| trace.corners)).collect())
}

/// A loop around, on to the pole, along it and back.
fn to_pole(
    mut corners: Vec<Corner>,
    axis: usize,
    turn: f64,
    pole: f64,
    chart: &Chart<'_>,
    samples: &mut Samples,
) -> Vec<Corner> {
    let first = corners[0];
    let place = |t: f64| if axis == 0 { [t, pole] } else { [pole, t] };
    samples.points.push(chart.point(place(first.uv[axis])));
    let id = samples.points.len() - 1;
    let mut end = first.uv;
    end[axis] += turn;
    corners.push(Corner { id: first.id, uv: end, part: None });
    corners.push(Corner { id, uv: place(end[axis]), part: None });
    corners.push(Corner { id, uv: place(first.uv[axis]), part: None });
    corners
}

/// Two loops around, in opposite directions, with a seam between them that is run through twice.
fn across(
    mut first: Vec<Corner>,
    mut second: Vec<Corner>,
    axis: usize,
    turn: f64,
    left: bool,
    chart: &Chart<'_>,
) -> Vec<Corner> {
    let begin = first[0];
    let mut end = begin.uv;
    end[axis] += turn;
    let period = turn.abs();
    // The second one from the corner nearest to the end of the first.
    let gap = |corner: &Corner| {
        let d = (corner.uv[axis] - end[axis]).rem_euclid(period);
        d.min(period - d)
    };
    let nearest = (0..second.len()).min_by(|&a, &b| gap(&second[a]).total_cmp(&gap(&second[b]))).unwrap_or(0);
    for corner in &mut second[..nearest] {
        corner.uv[axis] -= turn;
    }
    second.rotate_left(nearest);
    let shift = ((end[axis] - second[0].uv[axis]) / period).round() * period;
    let other = 1 - axis;
    let lift = chart.period[other].map_or(0.0, |length| {
        // Around a torus the second loop is where it is reached first.
        let side = if ((turn > 0.0) == (axis == 0)) == left { 1.0 } else { -1.0 };
        let rise = second[0].uv[other] - begin.uv[other];
        if rise * side < 0.0 { side * length * (rise.abs() / length).ceil() } else { 0.0 }
    });
    for corner in &mut second {
        corner.uv[axis] += shift;
        corner.uv[other] += lift;
    }
    let start = second[0];
    let mut back = start.uv;
    back[axis] -= turn;
    first.push(Corner { id: begin.id, uv: end, part: None });
    first.extend(second);
    first.push(Corner { id: start.id, uv: back, part: None });
    first
}

/// The whole of a torus from a point of it, with three parts of each seam, which make its points distinct.
fn ring(chart: &Chart<'_>, samples: &mut Samples, [width, height]: [f64; 2]) -> Vec<Corner> {
    let first = samples.points.len();
    let third = |k: usize| k as f64 / 3.0;
    samples.points.extend((0..3).map(|k| chart.point([third(k) * width, 0.0])));
    samples.points.extend((1..3).map(|k| chart.point([0.0, third(k) * height])));
    let along = |k: usize, v: f64| Corner { id: first + k % 3, uv: [third(k) * width, v], part: None };
    let up = |u: f64, k: usize| Corner {
        id: if k.is_multiple_of(3) { first } else { first + 2 + k },
        uv: [u, third(k) * height],
        part: None,
    };
    let there = (0..3).map(|k| along(k, 0.0)).chain((0..3).map(|k| up(width, k)));
    let back = (1..4).rev().map(|k| along(k, height)).chain((1..4).rev().map(|k| up(0.0, k)));
    there.chain(back).collect()
}

/// A parameter u, none of whose period loops cross; 0 without loops.
fn seam_beside(loops: &[Vec<Corner>], period: f64) -> Option<f64> {
    let mut ends: Vec<[f64; 2]> = Vec::new();
    for corners in loops {
        let us = || corners.iter().map(|corner| corner.uv[0]);
        let [low, high] = [us().fold(f64::INFINITY, f64::min), us().fold(f64::NEG_INFINITY, f64::max)];
        let from = low.rem_euclid(period);
        ends.push([from, from + high - low]);
    }
    ends.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let Some(first) = ends.first().copied() else { return Some(0.0) };
    let (mut best, mut reached) = (None::<[f64; 2]>, first[1]);
    for next in ends[1..].iter().copied().chain([[first[0] + period, 0.0]]) {
        let gap = next[0] - reached;
        if gap > 0.0 && best.is_none_or(|[width, _]| gap > width) {
            best = Some([gap, reached + 0.5 * gap]);
        }
        reached = reached.max(next[1]);
    }
    best.map(|[_, at]| at)
}

/// The whole of a surface, which must shrink to points at both ends of v or close in both directions, with its seam beside
/// loops; its inside is to the left unless that is false.
fn whole(
    chart: &Chart<'_>,
    samples: &mut Samples,
    loops: &[Vec<Corner>],
    left: Option<bool>,
) -> Result<Vec<Corner>, &'static str> {
    let mut corners = all_around(chart, samples, loops)?;
    if left == Some(false) {
        corners.reverse();
    }
    Ok(corners)
}

fn all_around(chart: &Chart<'_>, samples: &mut Samples, loops: &[Vec<Corner>]) -> Result<Vec<Corner>, &'static str> {
    if let ([Some(width), Some(height)], true, true) =
        (chart.period, chart.poles(0).is_empty() && chart.poles(1).is_empty(), loops.is_empty())
    {
        return Ok(ring(chart, samples, [width, height]));
    }
    let mut poles = chart.poles(0);
    poles.sort_by(f64::total_cmp);
    poles.dedup_by(|a, b| (*a - *b).abs() < 1e-9);
    let (Some(period), &[low, high], true) = (
        chart.period[0],
        poles.as_slice(),
        matches!(chart.surface, FaceSurface::Revolved { .. } | FaceSurface::Spline(_)),
    ) else {
        return Err("it has no loops, and no poles that close it");
    };
    let [below, above] = [low, high].map(|v| chart.point([0.0, v]));
    if length(minus(below, above)) <= 0.0 {
        return Err("it has no loops, and no poles that close it");
    }
    samples.points.extend([below, above]);
    let (south, north) = (samples.points.len() - 2, samples.points.len() - 1);
    let from = seam_beside(loops, period).ok_or("loops lie all around it")?;
    let to = from + period;
    let corner = |id: usize, u: f64, v: f64| Corner { id, uv: [u, v], part: None };
    Ok(vec![corner(south, from, low), corner(south, to, low), corner(north, to, high), corner(north, from, high)])
}

/// The loops with the largest first, and the others moved by whole turns to where they lie inside it.
fn beside(mut loops: Vec<Vec<Corner>>, chart: &Chart<'_>) -> Vec<Vec<Corner>> {
    let largest = (0..loops.len()).max_by(|&a, &b| area(&loops[a]).abs().total_cmp(&area(&loops[b]).abs()));
    loops.swap(0, largest.unwrap_or(0));
    let Some((outer, inner)) = loops.split_first_mut() else { return loops };
    for corners in inner {
        let steps = |k: usize| chart.period[k].map_or(vec![0.0], |p| [0.0, p, -p, 2.0 * p, -2.0 * p].to_vec());
        let shifts: Vec<[f64; 2]> = steps(0).iter().flat_map(|&u| steps(1).into_iter().map(move |v| [u, v])).collect();
        let at = |shift: &[f64; 2]| [0, 1].map(|k: usize| corners[0].uv[k] + shift[k]);
        if let Some(shift) = shifts.iter().find(|shift| contains(outer, at(shift))) {
            corners.iter_mut().for_each(|corner| corner.uv = [0, 1].map(|k: usize| corner.uv[k] + shift[k]));
        }
    }
    loops
}

/// Whether a point is inside a loop.
fn contains(corners: &[Corner], [x, y]: [f64; 2]) -> bool {
    let next = corners.iter().cycle().skip(1);
    let crossings = corners.iter().zip(next).filter(|(a, b)| {
        let ([ax, ay], [bx, by]) = (a.uv, b.uv);
        (ay > y) != (by > y) && x < ax + (y - ay) / (by - ay) * (bx - ax)
    });
    crossings.count() % 2 == 1
}

#[cfg(test)]
mod tests {
    use super::super::{BrepEdge, SpaceCurve};
    use super::*;

    /// A bow 5 m high and 0.4 mm wide of a body of 60 m, from one side to the other.
    #[test]
    fn a_face_that_is_narrow_all_over_has_an_outline() {
        let half = 2e-4;
        let line = |origin: [f64; 3], along: [f64; 3]| SpaceCurve::Line { origin, along };
        let up = [0.0, 0.0, 5.0];
        let sides = [(line([60.0, -half, 0.0], up), [0.0, 1.0]), (line([60.0, half, 0.0], up), [0.0, 1.0])];
        let vertices = [[60.0, -half, 0.0], [60.0, -half, 5.0], [60.0, half, 5.0], [60.0, half, 0.0]];
        let edges: Vec<BrepEdge> = (0..4)
            .map(|k| {
                let ends = [k, (k + 1) % 4];
                let curve = line(vertices[k], minus(vertices[ends[1]], vertices[k]));
                BrepEdge::new(curve, ends, &vertices, true)
            })
            .collect();
        let sites = vec![vec![0.0, 0.5, 1.0]; 4];
        let mut samples = Samples::of(&vertices, &edges, &sites);
        let surface = FaceSurface::Ruled { sides };
        let face = BrepFace {
            name: String::new(),
            kind: String::new(),
            surface: surface.clone(),
            loops: vec![(0..4).map(|k| (k, true)).collect()],
            left: None,
            part: 0,
        };
        let outline = Outline::of(&face, &Chart::new(&surface, 60.0), &mut samples, 0.06).unwrap();
        assert_eq!((outline.loops.len(), outline.loops[0].len()), (1, 8));
        assert!((area(&outline.loops[0]).abs() - 2.0).abs() < 1e-6);
    }
}
