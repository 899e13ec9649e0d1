//! Knuckles and tangent lines at the stations: heights, half-breadths, and where they go beyond their ends.
//!
//! They come from the lines of the table (a cubic spline through their points, read at the stations) and from marked
//! points, which are joined from station to station in order of height. Every line runs over the whole length of the
//! net. Beyond an end that lies on the centreplane or the keel it runs in the keel line, beyond one on the upper edge
//! in that; else it keeps its share of the height of the section, and the surface is smooth across it there.

use super::profile::{Profile, SectionPoint};
use crate::hull::cell::{FeatureLine, LineKind};
use crate::spline::{BsplineCurve, KnotVector};

/// Distance in parts of depth and breadth within which a point of a section is taken as the point of a line.
const SNAP: f64 = 2e-3;

/// The same for a point that is marked as one of a line.
const NEAR_MARK: f64 = 2e-2;

/// Distance in parts of depth and breadth within which a line ends on the keel, the centreplane or the upper edge.
const ENDS_ON: f64 = 2e-2;

/// A line at every station.
#[derive(Debug, Clone)]
pub(super) struct Line {
    /// Name, for notes.
    pub(super) name: String,
    /// What it is where it is active.
    pub(super) kind: LineKind,
    /// Height at each station \[m\].
    pub(super) z: Vec<f64>,
    /// Half-breadth \[m\] where the line is a line of the hull; none where it only goes on as a line of the net.
    pub(super) y: Vec<Option<f64>>,
}

/// Sizes of the hull, for tolerances \[m\].
#[derive(Debug, Clone, Copy)]
pub(in crate::hull::fit) struct Size {
    pub(in crate::hull::fit) depth: f64,
    pub(in crate::hull::fit) breadth: f64,
}

/// All lines between keel and upper edge, from below; heights do not fall from line to line at any station.
pub(super) fn lines(given: &[FeatureLine], profiles: &[Profile], size: Size, notes: &mut Vec<String>) -> Vec<Line> {
    let mut result: Vec<Line> = Vec::new();
    for line in given {
        // A line on the centreplane is a profile, not a knuckle.
        if line.points.iter().all(|p| p[1] <= 1e-6 * size.breadth) {
            continue;
        }
        let at: Vec<Option<SectionPoint>> = profiles.iter().map(|p| at_station(line, p, size)).collect();
        let ends = [line.points[0], line.points[line.points.len() - 1]].map(|p| p[1] <= ENDS_ON * size.breadth);
        match complete(line.name.clone(), line.kind, &at, ends, profiles, size) {
            Some(line) => result.push(line),
            None => notes.push(format!("line {} meets fewer than two stations and was left out", line.name)),
        }
    }
    for kind in [LineKind::Knuckle, LineKind::Tangent] {
        let mut single = 0;
        for (number, chain) in chains(profiles, &result, kind, size).into_iter().enumerate() {
            let name = format!("{} {}", if kind == LineKind::Knuckle { "knuckle" } else { "tangent line" }, number + 1);
            match complete(name, kind, &chain, [false; 2], profiles, size) {
                Some(line) => result.push(line),
                None => single += 1,
            }
        }
        if single > 0 {
            notes.push(format!("{single} marked points belong to no line of two stations; their marks were not used"));
        }
    }
    order(&mut result, profiles, notes);
    result
}

/// The point of a line of the table at a station: the marked point of the section near it, or any that is very near, else
/// that of the line. None beyond its ends and on keel or upper edge.
fn at_station(line: &FeatureLine, profile: &Profile, size: Size) -> Option<SectionPoint> {
    let [y, z] = point_at(&line.points, profile.x)?;
    // Sections may have been made from the line by going straight from point to point.
    let straight = straight_at(&line.points, profile.x).unwrap_or([y, z]);
    let distance = |p: &SectionPoint| {
        let reach = if p.mark == Some(line.kind) { NEAR_MARK } else { SNAP };
        let to = |[y, z]: [f64; 2]| {
            let across = p.y.map_or(f64::INFINITY, |own| (own - y).abs() / size.breadth);
            across.max((p.z - z).abs() / size.depth) / reach
        };
        to([y, z]).min(to(straight))
    };
    let near = profile.points.iter().min_by(|a, b| distance(a).total_cmp(&distance(b))).filter(|p| distance(p) <= 1.0);
    let point = near.copied().unwrap_or(SectionPoint { z, y: Some(y.max(0.0)), mark: Some(line.kind) });
    (point.z > profile.keel() && point.z < profile.top()).then_some(point)
}

/// (y, z) of a line at `x`: cubic spline from four points on, straight below.
fn point_at(points: &[[f64; 3]], x: f64) -> Option<[f64; 2]> {
    let (first, last) = (points.first()?, points.last()?);
    let slack = 1e-9 * (last[0] - first[0]).abs();
    if x < first[0] - slack || x > last[0] + slack {
        return None;
    }
    let rising: Vec<&[f64; 3]> = {
        let mut kept: Vec<&[f64; 3]> = Vec::new();
        for point in points {
            if kept.last().is_none_or(|last| point[0] > last[0] + slack) {
                kept.push(point);
            }
        }
        kept
    };
    let sites: Vec<f64> = rising.iter().map(|p| p[0]).collect();
    let values: Vec<[f64; 2]> = rising.iter().map(|p| [p[1], p[2]]).collect();
    if values.len() < 2 {
        return None;
    }
    let knots = KnotVector::averaged(if values.len() > 3 { 3 } else { 1 }, &sites).ok()?;
    Some(BsplineCurve::interpolate(knots, &sites, &values).ok()?.eval(x))
}

/// (y, z) at `x` straight between the points of a line.
fn straight_at(points: &[[f64; 3]], x: f64) -> Option<[f64; 2]> {
    let pair = points.windows(2).find(|w| w[0][0] <= x && x <= w[1][0] && w[1][0] > w[0][0])?;
    let t = (x - pair[0][0]) / (pair[1][0] - pair[0][0]);
    Some([1, 2].map(|d| pair[0][d] + t * (pair[1][d] - pair[0][d])))
}

/// Marked points that belong to no line yet, joined from station to station.
fn chains(profiles: &[Profile], known: &[Line], kind: LineKind, size: Size) -> Vec<Vec<Option<SectionPoint>>> {
    let mut chains: Vec<Vec<Option<SectionPoint>>> = Vec::new();
    for (station, profile) in profiles.iter().enumerate() {
        let (keel, top) = (profile.keel(), profile.top());
        let free = |p: &SectionPoint| !known.iter().any(|line| (line.z[station] - p.z).abs() <= SNAP * size.depth);
        let points: Vec<SectionPoint> = profile
            .points
            .iter()
            .filter(|p| p.mark == Some(kind) && p.y.is_some() && p.z > keel && p.z < top && free(p))
            .copied()
            .collect();
        let open: Vec<usize> = (0..chains.len()).filter(|&c| station > 0 && chains[c][station - 1].is_some()).collect();
        let mut taken = vec![None; points.len()];
        if open.len() == points.len() {
            taken.iter_mut().zip(&open).for_each(|(slot, &c)| *slot = Some(c));
        } else {
            // The nearest pairs first.
            let distance = |c: usize, p: &SectionPoint| {
                chains[c][station - 1].map_or(f64::INFINITY, |q| {
                    (p.z - q.z).abs() / size.depth
                        + (p.y.unwrap_or(0.0) - q.y.unwrap_or(0.0)).abs() / size.breadth.max(1e-9)
                })
            };
            let mut pairs: Vec<(f64, usize, usize)> = open
                .iter()
                .flat_map(|&c| points.iter().enumerate().map(move |(k, p)| (c, k, p)))
                .map(|(c, k, p)| (distance(c, p), c, k))
                .collect();
            pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
            for (_, c, k) in pairs {
                if taken[k].is_none() && !taken.contains(&Some(c)) {
                    taken[k] = Some(c);
                }
            }
        }
        for (point, chain) in points.iter().zip(taken) {
            let chain = chain.unwrap_or_else(|| {
                chains.push(vec![None; profiles.len()]);
                chains.len() - 1
            });
            chains[chain][station] = Some(*point);
        }
        chains.sort_by(|a, b| {
            let height = |c: &[Option<SectionPoint>]| c[station].map_or(f64::INFINITY, |p| p.z);
            height(a).total_cmp(&height(b))
        });
    }
    chains
}

/// Carries a line on to all stations; none when it is known at fewer than two.
fn complete(
    name: String,
    kind: LineKind,
    at: &[Option<SectionPoint>],
    on_centreplane: [bool; 2],
    profiles: &[Profile],
    size: Size,
) -> Option<Line> {
    let first = at.iter().position(Option::is_some)?;
    let last = at.iter().rposition(Option::is_some)?;
    if first == last {
        return None;
    }
    let share = |k: usize, on_centreplane: bool| {
        let (keel, top) = (profiles[k].keel(), profiles[k].top());
        let z = at[k].map_or(keel, |p| p.z);
        let near = if on_centreplane { 0.5 * (top - keel) } else { ENDS_ON * size.depth };
        if z - keel <= near {
            0.0
        } else if top - z <= near {
            1.0
        } else {
            (z - keel) / (top - keel)
        }
    };
    let (before, after) = (share(first, on_centreplane[0]), share(last, on_centreplane[1]));
    let inner = |k: usize| {
        // Between stations that have it, a line keeps its share, linearly from one to the next.
        let (a, b) = (at[..k].iter().rposition(Option::is_some)?, k + at[k..].iter().position(Option::is_some)?);
        let share = |j: usize| {
            let (keel, top) = (profiles[j].keel(), profiles[j].top());
            at[j].map_or(0.0, |p| if top > keel { (p.z - keel) / (top - keel) } else { 0.0 })
        };
        let t = (profiles[k].x - profiles[a].x) / (profiles[b].x - profiles[a].x);
        Some(share(a) + t * (share(b) - share(a)))
    };
    let z = (0..at.len())
        .map(|k| {
            let (keel, top) = (profiles[k].keel(), profiles[k].top());
            let share = if k < first {
                before
            } else if k > last {
                after
            } else {
                inner(k).unwrap_or(0.0)
            };
            at[k].map_or(keel + share * (top - keel), |p| p.z)
        })
        .collect();
    Some(Line { name, kind, z, y: at.iter().map(|p| p.and_then(|p| p.y)).collect() })
}

/// Sorts lines from below and keeps them in that order at every station: lines of the net give way to lines of the hull.
fn order(lines: &mut [Line], profiles: &[Profile], notes: &mut Vec<String>) {
    let count = profiles.len();
    let below = |a: &Line, b: &Line| -> f64 {
        let both: Vec<usize> = (0..count).filter(|&k| a.y[k].is_some() && b.y[k].is_some()).collect();
        let over = if both.is_empty() { (0..count).collect() } else { both };
        over.iter().map(|&k| a.z[k] - b.z[k]).sum()
    };
    lines.sort_by(|a, b| below(a, b).total_cmp(&0.0));
    for (k, profile) in profiles.iter().enumerate() {
        let mut crossed = None;
        let mut floor = profile.keel();
        for line in lines.iter_mut() {
            if line.y[k].is_some() {
                if line.z[k] < floor {
                    line.y[k] = None;
                    crossed = Some(line.name.clone());
                } else {
                    floor = line.z[k];
                }
            }
        }
        if let Some(name) = crossed {
            notes.push(format!(
                "line {name} crosses another one near x = {:.3} m and was not followed there",
                profile.x
            ));
        }
        let mut floor = profile.keel();
        for j in 0..lines.len() {
            if lines[j].y[k].is_none() {
                let ceiling = lines[j + 1..].iter().find(|l| l.y[k].is_some()).map_or(profile.top(), |l| l.z[k]);
                lines[j].z[k] = lines[j].z[k].max(floor).min(ceiling);
            }
            floor = lines[j].z[k];
        }
    }
}
