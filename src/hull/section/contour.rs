//! The topology of the contour f = 0: connected chains of graph segments, none missed, none invented.
//!
//! Each patch through which the contour may pass (Bernstein coefficients of both signs) is quartered until f_u or f_v
//! has one sign on each cell, so that the contour is there a set of graphs u(v) or v(u), given completely by the places
//! where it crosses the edges of the cell. The crossings of an edge are isolated once (Descartes' rule) and belong to
//! both cells beside it; where cells of different size meet, those of the smaller cells are used. Segments are chained
//! through them, in time proportional to their number. Cells in which |f| stays below a fraction of the tolerance are
//! not divided further (singular points): there the crossings are joined in the order around the cell.

use super::bernstein::{ORDER, halve, minus, sign_changes};
use super::field::{Field, Patch};
use crate::spline::BsplineSurface;

/// Halvings of a span at most.
const DEPTH: u32 = 24;
/// Integer coordinates to a span.
const UNIT: u64 = 1 << DEPTH;
/// Steepest graph in a cell that is not divided further, in lengths of spans; divided cells may hold steeper ones.
const STEEPEST: f64 = 4.0;
/// Halvings after which steeper graphs are taken as they are.
const PATIENCE: u32 = 3;
/// Cells to a patch before the division of the patch gets a lower limit: a contour along which plane and surface touch.
const CELLS: usize = 4096;

/// In which way a segment can be followed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Running {
    /// f has one direction in s: a graph s(t).
    OverT,
    /// f has one direction in t: a graph t(s).
    OverS,
    /// Both.
    Both,
    /// Straight in the parameters: the cell is within the tolerance of the plane.
    Straight,
}

/// A part of the contour inside one cell.
#[derive(Debug, Clone, Copy)]
pub(super) struct Segment {
    pub patch: usize,
    pub running: Running,
    /// Ranges of s and of t of the cell.
    pub cell: [[f64; 2]; 2],
    /// Crossings at its ends.
    pub ends: [usize; 2],
}

/// A place where the contour crosses an edge.
#[derive(Debug, Clone, Copy)]
struct Crossing {
    /// Which coordinate is constant along the edge.
    fixed: usize,
    /// Its value, in integer units of the whole domain.
    line: u64,
    /// The other coordinate in its span, 0 to 1.
    along: f64,
    segments: [Option<usize>; 2],
}

/// One connected part of the contour: segments with their two ends in the coordinates of their patch, in order.
pub(super) struct Chain {
    pub links: Vec<Link>,
    pub closed: bool,
}

/// A segment as it is passed through.
#[derive(Debug, Clone, Copy)]
pub(super) struct Link {
    pub segment: Segment,
    pub from: [f64; 2],
    pub to: [f64; 2],
}

struct Cell {
    patch: usize,
    span: [u64; 2],
    low: [u64; 2],
    size: u64,
    running: Running,
    /// Whether f grows with s (`OverT`, `Both`) or with t (`OverS`).
    grows: bool,
    corners: [[bool; 2]; 2],
    /// Coefficients along the edges s = low, s = high (over t), t = low, t = high (over s).
    edges: [[f64; ORDER]; 4],
}

struct Edge {
    fixed: usize,
    line: u64,
    start: u64,
    size: u64,
    cell: usize,
    side: usize,
}

/// What the cells of one field are made from.
struct Division<'a> {
    degrees: [usize; 2],
    small: f64,
    deepest: u32,
    cells: &'a mut Vec<Cell>,
}

/// The patches through which the contour passes, and its chains.
pub(super) fn chains(surface: &BsplineSurface<3>, field: &Field, tolerance: f64) -> (Vec<Patch>, Vec<Chain>) {
    let degrees = [field.u.degree, field.v.degree];
    let (mut patches, mut cells) = (Vec::new(), Vec::new());
    for i in 0..field.u.count() {
        for j in 0..field.v.count() {
            let Some(c) = field.coefficients(i, j) else { continue };
            let patch = patches.len();
            patches.push(field.patch(surface, i, j, c));
            let span = [i as u64, j as u64];
            let before = cells.len();
            let mut deepest = DEPTH;
            loop {
                let mut division = Division { degrees, small: 0.05 * tolerance, deepest, cells: &mut cells };
                if division.divide(&c, patch, span, span.map(|k| k * UNIT), 0, before) || deepest <= 5 {
                    break;
                }
                cells.truncate(before);
                deepest = deepest.min(10) - 1;
            }
        }
    }
    let (sides, mut crossings) = crossings(&cells, degrees);
    let mut segments = Vec::new();
    for (cell, sides) in cells.iter().zip(&sides) {
        pair(cell, sides, &crossings, &mut segments);
    }
    for (index, segment) in segments.iter().enumerate() {
        for &end in &segment.ends {
            let places = &mut crossings[end].segments;
            let free = usize::from(places[0].is_some());
            debug_assert!(places[free].is_none());
            places[free] = Some(index);
        }
    }
    (patches, link(&segments, &crossings, &cells))
}

impl Division<'_> {
    /// Adds the cells of a part of a patch; false when there are too many.
    fn divide(
        &mut self,
        c: &[[f64; ORDER]; ORDER],
        patch: usize,
        span: [u64; 2],
        low: [u64; 2],
        depth: u32,
        before: usize,
    ) -> bool {
        let [p, q] = self.degrees;
        let (mut negative, mut largest) = (0, 0.0f64);
        for row in &c[..=p] {
            for &value in &row[..=q] {
                negative += usize::from(minus(value));
                largest = largest.max(value.abs());
            }
        }
        if negative == 0 || negative == (p + 1) * (q + 1) {
            return true;
        }
        let (mut in_s, mut in_t) = (Slopes::default(), Slopes::default());
        for i in 0..=p {
            for j in 0..=q {
                if i < p {
                    in_s.add(c[i + 1][j] - c[i][j]);
                }
                if j < q {
                    in_t.add(c[i][j + 1] - c[i][j]);
                }
            }
        }
        let last = depth >= self.deepest || largest <= self.small;
        let patient = depth < PATIENCE;
        let running = match (in_s.one_sign(), in_t.one_sign()) {
            (true, true) => Some(Running::Both),
            (true, false) if !patient || in_t.largest * (q as f64) <= STEEPEST * in_s.smallest * (p as f64) => {
                Some(Running::OverT)
            }
            (false, true) if !patient || in_s.largest * (p as f64) <= STEEPEST * in_t.smallest * (q as f64) => {
                Some(Running::OverS)
            }
            _ if last => Some(Running::Straight),
            _ => None,
        };
        if let Some(running) = running {
            let mut edges = [[0.0; ORDER]; 4];
            edges[0] = c[0];
            edges[1] = c[p];
            for i in 0..=p {
                edges[2][i] = c[i][0];
                edges[3][i] = c[i][q];
            }
            self.cells.push(Cell {
                patch,
                span,
                low,
                size: UNIT >> depth,
                running,
                grows: if running == Running::OverS { in_t.rises } else { in_s.rises },
                corners: [[minus(c[0][0]), minus(c[0][q])], [minus(c[p][0]), minus(c[p][q])]],
                edges,
            });
            return self.cells.len() - before <= CELLS;
        }
        let half = UNIT >> (depth + 1);
        let mut halves = [*c, *c];
        for j in 0..=q {
            let mut column = [0.0; ORDER];
            for i in 0..=p {
                column[i] = c[i][j];
            }
            let [first, second] = halve(&column, p);
            for i in 0..=p {
                halves[0][i][j] = first[i];
                halves[1][i][j] = second[i];
            }
        }
        for (a, part) in halves.iter().enumerate() {
            let mut quarters = [*part, *part];
            for i in 0..=p {
                let [first, second] = halve(&part[i], q);
                quarters[0][i] = first;
                quarters[1][i] = second;
            }
            for (b, quarter) in quarters.iter().enumerate() {
                let corner = [low[0] + a as u64 * half, low[1] + b as u64 * half];
                if !self.divide(quarter, patch, span, corner, depth + 1, before) {
                    return false;
                }
            }
        }
        true
    }
}

/// Signs and sizes of the differences of coefficients in one direction.
struct Slopes {
    rises: bool,
    falls: bool,
    smallest: f64,
    largest: f64,
}

impl Default for Slopes {
    fn default() -> Self {
        Self { rises: false, falls: false, smallest: f64::INFINITY, largest: 0.0 }
    }
}

impl Slopes {
    fn add(&mut self, difference: f64) {
        self.rises |= difference > 0.0;
        self.falls |= difference < 0.0;
        self.smallest = self.smallest.min(difference.abs());
        self.largest = self.largest.max(difference.abs());
    }

    fn one_sign(&self) -> bool {
        self.rises != self.falls
    }
}

/// The crossings of all edges, and for each cell those of its four sides in increasing order along the side.
fn crossings(cells: &[Cell], degrees: [usize; 2]) -> (Vec<[Vec<usize>; 4]>, Vec<Crossing>) {
    let mut edges = Vec::with_capacity(4 * cells.len());
    for (index, cell) in cells.iter().enumerate() {
        for side in 0..4 {
            let fixed = side / 2;
            let line = cell.low[fixed] + (side % 2) as u64 * cell.size;
            edges.push(Edge { fixed, line, start: cell.low[1 - fixed], size: cell.size, cell: index, side });
        }
    }
    edges.sort_unstable_by_key(|e| (e.fixed, e.line, e.start, e.size, e.side));
    let mut found: Vec<Crossing> = Vec::new();
    // For each edge in sorted order, its crossings when it holds no smaller edge.
    let mut ranges: Vec<Option<[usize; 2]>> = Vec::with_capacity(edges.len());
    let mut roots = Vec::new();
    let inside = |from: usize, edge: &Edge| {
        let end = edge.start + edge.size;
        let (fixed, line) = (edge.fixed, edge.line);
        edges[from..].iter().take_while(move |e| e.fixed == fixed && e.line == line && e.start < end).count()
    };
    let head = |index: usize| {
        let edge = &edges[index];
        let mut first = index;
        while first > 0 && {
            let e = &edges[first - 1];
            e.fixed == edge.fixed && e.line == edge.line && e.start == edge.start
        } {
            first -= 1;
        }
        first
    };
    for (index, edge) in edges.iter().enumerate() {
        let first = head(index);
        let count = inside(first, edge);
        if edges[first..first + count].iter().any(|e| e.size < edge.size) {
            ranges.push(None);
            continue;
        }
        if first < index {
            ranges.push(ranges[first]);
            continue;
        }
        let cell = &cells[edge.cell];
        let start = found.len();
        roots.clear();
        sign_changes(&cell.edges[edge.side], degrees[1 - edge.fixed], &mut roots);
        let offset = (edge.start - cell.span[1 - edge.fixed] * UNIT) as f64;
        for root in &roots {
            let along = (offset + edge.size as f64 * root) / UNIT as f64;
            found.push(Crossing { fixed: edge.fixed, line: edge.line, along, segments: [None; 2] });
        }
        ranges.push(Some([start, found.len()]));
    }
    let mut sides: Vec<[Vec<usize>; 4]> = cells.iter().map(|_| Default::default()).collect();
    for (index, edge) in edges.iter().enumerate() {
        let list = &mut sides[edge.cell][edge.side];
        if let Some([a, b]) = ranges[index] {
            list.extend(a..b);
            continue;
        }
        let first = head(index);
        let mut reached = None;
        for other in first..first + inside(first, edge) {
            if let Some([a, b]) = ranges[other]
                && reached != Some(edges[other].start)
            {
                reached = Some(edges[other].start);
                list.extend(a..b);
            }
        }
    }
    (sides, found)
}

/// The segments of one cell.
fn pair(cell: &Cell, sides: &[Vec<usize>; 4], crossings: &[Crossing], segments: &mut Vec<Segment>) {
    let local = |k: usize| {
        let low = (cell.low[k] - cell.span[k] * UNIT) as f64 / UNIT as f64;
        [low, low + cell.size as f64 / UNIT as f64]
    };
    let bounds = [local(0), local(1)];
    let mut add = |a: usize, b: usize| {
        segments.push(Segment { patch: cell.patch, running: cell.running, cell: bounds, ends: [a, b] });
    };
    if cell.running == Running::Straight {
        let around: Vec<usize> = (sides[2].iter())
            .chain(sides[1].iter())
            .chain(sides[3].iter().rev())
            .chain(sides[0].iter().rev())
            .copied()
            .collect();
        debug_assert!(around.len().is_multiple_of(2));
        let shift = usize::from(cell.corners[0][0]);
        for k in 0..around.len() / 2 {
            add(around[2 * k + shift], around[(2 * k + 1 + shift) % around.len()]);
        }
        return;
    }
    // Along the running coordinate: the side where f is lower and the one where it is higher, bottom and top.
    let over_t = cell.running != Running::OverS;
    let (mut low, mut high, bottom, top) = if over_t {
        (&sides[0], &sides[1], &sides[2], &sides[3])
    } else {
        (&sides[2], &sides[3], &sides[0], &sides[1])
    };
    let mut signs =
        if over_t { [cell.corners[0][0], cell.corners[1][0]] } else { [cell.corners[0][0], cell.corners[0][1]] };
    if !cell.grows {
        std::mem::swap(&mut low, &mut high);
        signs.swap(0, 1);
    }
    let mut open = None;
    let mut visit = |crossing: usize| match open.take() {
        None => open = Some(crossing),
        Some(before) => add(before, crossing),
    };
    bottom.iter().for_each(|&k| visit(k));
    let (mut low, mut high) = (low.iter().peekable(), high.iter().peekable());
    loop {
        // f is lower on the low side: both minus leaves the high side to change, both plus the low side.
        let take_low = match (low.peek(), high.peek()) {
            (None, None) => break,
            (Some(_), None) => true,
            (None, Some(_)) => false,
            (Some(&&a), Some(&&b)) => {
                signs == [false, false] || (signs == [true, false] && crossings[a].along <= crossings[b].along)
            }
        };
        let (list, sign) = if take_low { (&mut low, &mut signs[0]) } else { (&mut high, &mut signs[1]) };
        if let Some(&k) = list.next() {
            visit(k);
        }
        *sign = !*sign;
    }
    top.iter().for_each(|&k| visit(k));
    debug_assert!(open.is_none());
}

/// Chains of segments through shared crossings: open ones first, then loops.
fn link(segments: &[Segment], crossings: &[Crossing], cells: &[Cell]) -> Vec<Chain> {
    let mut span_of = Vec::new();
    for cell in cells {
        if span_of.len() <= cell.patch {
            span_of.resize(cell.patch + 1, [0; 2]);
        }
        span_of[cell.patch] = cell.span;
    }
    let place = |crossing: usize, segment: &Segment| {
        let c = &crossings[crossing];
        let across = (c.line - span_of[segment.patch][c.fixed] * UNIT) as f64 / UNIT as f64;
        if c.fixed == 0 { [across, c.along] } else { [c.along, across] }
    };
    let mut done = vec![false; segments.len()];
    let walk = |first: usize, start: usize, done: &mut [bool]| {
        let mut links = Vec::new();
        let (mut index, mut at) = (first, start);
        loop {
            done[index] = true;
            let segment = segments[index];
            let next = if segment.ends[0] == at { segment.ends[1] } else { segment.ends[0] };
            links.push(Link { segment, from: place(at, &segment), to: place(next, &segment) });
            at = next;
            match crossings[at].segments.iter().flatten().find(|&&s| !done[s]) {
                Some(&s) => index = s,
                None => break,
            }
        }
        Chain { links, closed: at == start }
    };
    let mut chains = Vec::new();
    for (k, crossing) in crossings.iter().enumerate() {
        // The other end of an open chain has been passed already.
        if let [Some(segment), None] = crossing.segments
            && !done[segment]
        {
            chains.push(walk(segment, k, &mut done));
        }
    }
    for (k, segment) in segments.iter().enumerate() {
        if !done[k] {
            chains.push(walk(k, segment.ends[0], &mut done));
        }
    }
    chains
}
