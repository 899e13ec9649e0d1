//! Frames of the mould loft: a station of the hull, or of the surface inside or outside its skin, with bevels.
//!
//! A skin of thickness t lies on the moulded surface S with its unit normal n outward. Its other face is S + s n, with s = t
//! outside and s = -t inside. A frame at x is the section of that face: at each parameter v the parameter u is solved from
//! x(u, v) + s n_x(u, v) = x, so that the thickness is exact however fine the ends. Lines on two sides of a knuckle are cut
//! where they cross, or produced until they meet.
//!
//! The bevel is the angle between the skin and the square of the frame, atan(n_x / sqrt(n_y^2 + n_z^2)): positive where the
//! hull closes in going forward.

use super::form::Hull;

/// Bevels of neighbouring points differ by no more than this \[rad\].
const BEVEL_STEP: f64 = 8e-3;

/// Halvings between two knots, and rounds in which a parameter is found.
const DEEPEST: u32 = 16;
const ROUNDS: usize = 40;

/// Parts of a span of knots in each of which a frame may begin or end.
const PARTS: usize = 8;

/// Heights and breadths nearer to each other are one \[m\].
const ROUNDING: f64 = 1e-7;

/// Halvings by which the end of a frame between two knots is found.
const HALVINGS: usize = 50;

/// Ends nearer to each other than this part of the offset touch.
const TOUCHING: f64 = 1e-2;

/// Parts of a frame that are nowhere further from the centreplane than this part of the breadth are none.
const LEAST: f64 = 1e-5;

/// Lines are produced by this many thicknesses at most.
const PRODUCED: f64 = 6.0;

/// A point of a frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FramePoint {
    /// Half-breadth \[m\].
    pub y: f64,
    /// Height above the base line \[m\].
    pub z: f64,
    /// Bevel \[rad\], positive where the hull closes in going forward.
    pub bevel: f64,
}

impl FramePoint {
    fn between(&self, other: &Self, share: f64) -> Self {
        let mix = |a: f64, b: f64| a + share * (b - a);
        Self { y: mix(self.y, other.y), z: mix(self.z, other.z), bevel: mix(self.bevel, other.bevel) }
    }

    fn distance(&self, other: &Self) -> f64 {
        (self.y - other.y).hypot(self.z - other.z)
    }
}

/// A frame of one side.
#[derive(Debug, Clone, PartialEq)]
pub struct LoftedFrame {
    /// Position forward of AP \[m\].
    pub x: f64,
    /// Lines from the centreplane to the deck at side, or back to the centreplane, the lowest first.
    pub branches: Vec<Vec<FramePoint>>,
}

impl LoftedFrame {
    /// All points, branch by branch.
    pub fn points(&self) -> impl Iterator<Item = &FramePoint> {
        self.branches.iter().flatten()
    }

    fn chords(&self) -> impl Iterator<Item = &[FramePoint]> {
        self.branches.iter().flat_map(|branch| branch.windows(2))
    }

    /// The outermost point at a height; none where the frame does not reach it.
    #[must_use]
    pub fn at_height(&self, z: f64) -> Option<FramePoint> {
        let crossings = self.chords().filter_map(|pair| crossing(pair, z, |p| p.z));
        crossings.max_by(|a, b| a.y.total_cmp(&b.y))
    }

    /// The lowest point at a distance from the centreplane; none where the frame does not reach it.
    #[must_use]
    pub fn at_breadth(&self, y: f64) -> Option<FramePoint> {
        let crossings = self.chords().filter_map(|pair| crossing(pair, y, |p| p.y));
        crossings.min_by(|a, b| a.z.total_cmp(&b.z))
    }
}

/// The point of a chord at which a coordinate has a value.
fn crossing(pair: &[FramePoint], value: f64, of: fn(&FramePoint) -> f64) -> Option<FramePoint> {
    let (a, b) = (of(&pair[0]), of(&pair[1]));
    if (a - value) * (b - value) > 0.0 {
        // An end that rounding leaves off it.
        let near = if (a - value).abs() < (b - value).abs() { 0 } else { 1 };
        return ((of(&pair[near]) - value).abs() <= ROUNDING).then(|| pair[near]);
    }
    let share = if (b - a).abs() > 0.0 { (value - a) / (b - a) } else { 0.0 };
    Some(pair[0].between(&pair[1], share))
}

/// What makes the points of one frame.
struct Lofting<'a> {
    hull: &'a Hull,
    x: f64,
    /// Distance of the lofted surface from the moulded one, outward \[m\].
    offset: f64,
    deviation: f64,
}

impl Lofting<'_> {
    /// The point at parameter v, with the normal a little to one side of it: -1, 0 or 1.
    fn point(&self, v: f64, side: f64) -> Option<FramePoint> {
        let (low, high) = self.hull.surface().v().domain();
        let beside = (v + side * 1e-7 * (high - low)).clamp(low, high);
        let mut x = self.x;
        for _ in 0..ROUNDS {
            let u = self.hull.nearest_length_parameter(x, v);
            let normal = self.hull.outward_normal(u, beside)?;
            let next = self.x - self.offset * normal[0];
            if (next - x).abs() <= 1e-12 * (1.0 + self.x.abs()) {
                let [reached, y, z] = self.hull.surface().eval(u, v);
                // Beyond the ends of the line the nearest place is none of the frame.
                if (reached - x).abs() > 1e-9 * (1.0 + self.x.abs()) {
                    return None;
                }
                let bevel = normal[0].atan2(normal[1].hypot(normal[2]));
                return Some(FramePoint { y: y + self.offset * normal[1], z: z + self.offset * normal[2], bevel });
            }
            x = next;
        }
        None
    }

    /// Points after `from` up to `to`.
    fn refine(&self, from: (f64, FramePoint), to: (f64, FramePoint), depth: u32, list: &mut Vec<FramePoint>) {
        let middle = 0.5 * (from.0 + to.0);
        let found = if depth < DEEPEST { self.point(middle, 0.0) } else { None };
        if let Some(point) = found {
            let chord = from.1.between(&to.1, 0.5);
            let apart = distance_from_chord(&from.1, &to.1, &point);
            let bend = (point.bevel - chord.bevel).abs();
            // A curve that crosses its chord in the middle is not straight.
            if apart > 0.5 * self.deviation || bend > BEVEL_STEP || depth < 2 {
                self.refine(from, (middle, point), depth + 1, list);
                self.refine((middle, point), to, depth + 1, list);
                return;
            }
        }
        list.push(to.1);
    }

    /// Whether the surface has a knuckle at a line of knots.
    fn is_knuckle(&self, v: f64) -> bool {
        self.hull.length_parameter(self.x, v).is_some_and(|u| self.hull.is_knuckle(u, v))
    }

    /// The knots, and places between them at which the frame is looked for; whether each is a knot.
    fn places(&self) -> Vec<(f64, bool)> {
        let knots = self.hull.surface().v().breakpoints();
        let parts = |pair: &[f64]| {
            let (from, width) = (pair[0], pair[1] - pair[0]);
            (0..PARTS).map(move |k| (from + width * k as f64 / PARTS as f64, k == 0)).collect::<Vec<_>>()
        };
        knots.windows(2).flat_map(parts).chain(knots.last().map(|knot| (*knot, true))).collect()
    }

    /// The last parameter from `within` towards `beyond` at which the frame has a point, with this.
    fn end(&self, mut within: f64, mut beyond: f64, mut point: FramePoint) -> (f64, FramePoint) {
        for _ in 0..HALVINGS {
            let middle = 0.5 * (within + beyond);
            match self.point(middle, 0.0) {
                Some(found) => (within, point) = (middle, found),
                None => beyond = middle,
            }
        }
        (within, point)
    }

    /// The lines between knuckles, from the bottom up, of each branch.
    fn branches(&self) -> Vec<Vec<Vec<FramePoint>>> {
        let places = self.places();
        let mut branches: Vec<Vec<Vec<FramePoint>>> = vec![self.bottom().into_iter().collect()];
        let mut piece: Vec<FramePoint> = Vec::new();
        for pair in places.windows(2) {
            let [(first, is_knot), (last, _)] = [pair[0], pair[1]];
            let ends = (self.point(first, 1.0), self.point(last, -1.0));
            let ((low, from), (high, to)) = match ends {
                (Some(from), Some(to)) => ((first, from), (last, to)),
                (None, Some(to)) => (self.end(last, first, to), (last, to)),
                (Some(from), None) => ((first, from), self.end(first, last, from)),
                (None, None) => continue,
            };
            // Above a gap, as between a bulb and the flare, another branch begins.
            if ends.0.is_none() && !piece.is_empty() {
                branches.last_mut().into_iter().for_each(|branch| branch.push(std::mem::take(&mut piece)));
                branches.push(Vec::new());
            }
            if piece.is_empty() {
                piece.push(from);
            } else if is_knot && self.is_knuckle(first) {
                let below = std::mem::replace(&mut piece, vec![from]);
                branches.last_mut().into_iter().for_each(|branch| branch.push(below.clone()));
            }
            self.refine((low, from), (high, to), 0, &mut piece);
        }
        if piece.len() > 1 {
            branches.last_mut().into_iter().for_each(|branch| branch.push(std::mem::take(&mut piece)));
        }
        branches
    }

    /// The flat of bottom, from the centreplane out.
    fn bottom(&self) -> Option<Vec<FramePoint>> {
        let (low, _) = self.hull.surface().v().domain();
        let u = self.hull.length_parameter(self.x, low)?;
        let d = self.hull.surface().derivatives::<2>(u, low);
        let [_, y, z] = d[0][0];
        if y <= 1e-9 * self.hull.particulars().breadth {
            return None;
        }
        // The keel rises by dz/dx; the strip is level athwartships.
        let slope = d[1][0][2] / d[1][0][0];
        let slope = if slope.is_finite() { slope } else { 0.0 };
        let z = z - self.offset * (1.0 + slope * slope).sqrt();
        let bevel = slope.atan();
        Some(vec![FramePoint { y: 0.0, z, bevel }, FramePoint { y, z, bevel }])
    }
}

fn distance_from_chord(from: &FramePoint, to: &FramePoint, point: &FramePoint) -> f64 {
    let (dy, dz) = (to.y - from.y, to.z - from.z);
    let square = dy * dy + dz * dz;
    let share = if square > 0.0 { ((point.y - from.y) * dy + (point.z - from.z) * dz) / square } else { 0.0 };
    (from.y + share * dy - point.y).hypot(from.z + share * dz - point.z)
}

/// Where two straight lines meet: as parts of the first and of the second.
fn meeting([a, b]: [&FramePoint; 2], [c, d]: [&FramePoint; 2]) -> Option<[f64; 2]> {
    let (r, s) = ([b.y - a.y, b.z - a.z], [d.y - c.y, d.z - c.z]);
    let turn = r[0] * s[1] - r[1] * s[0];
    if turn.abs() <= 1e-12 * r[0].hypot(r[1]) * s[0].hypot(s[1]) {
        return None;
    }
    let gap = [c.y - a.y, c.z - a.z];
    Some([(gap[0] * s[1] - gap[1] * s[0]) / turn, (gap[0] * r[1] - gap[1] * r[0]) / turn])
}

/// Two lines on the sides of a knuckle as one: cut where they cross, else produced until they meet.
fn joined(mut below: Vec<FramePoint>, above: Vec<FramePoint>, offset: f64) -> Vec<FramePoint> {
    let within = |parts: &[f64; 2]| parts.iter().all(|part| (0.0..=1.0).contains(part));
    for i in (1..below.len()).rev() {
        for j in 1..above.len() {
            if let Some([part, _]) =
                meeting([&below[i - 1], &below[i]], [&above[j - 1], &above[j]]).filter(|parts| within(parts))
            {
                let corner = below[i - 1].between(&below[i], part);
                below.truncate(i);
                below.push(corner);
                below.push(FramePoint { bevel: above[j].bevel, ..corner });
                below.extend(&above[j..]);
                return below;
            }
        }
    }
    if let (Some(b), Some(c)) = (below.last(), above.first())
        && b.distance(c) <= 1e-9 + TOUCHING * offset.abs()
    {
        below.extend(above);
        return below;
    }
    let reach = PRODUCED * offset.abs();
    // Tangents are those of points that are not too near to the ends.
    let apart = |from: &FramePoint, to: &&FramePoint| from.distance(to) > 1e-9 + TOUCHING * offset.abs();
    if let (Some(b), Some(c)) = (below.last().copied(), above.first().copied())
        && let Some(a) = below.iter().rev().find(|point| apart(&b, point))
        && let Some(d) = above.iter().find(|point| apart(&c, point))
        && let Some([forward, back]) = meeting([a, &b], [d, &c])
    {
        let corner = a.between(&b, forward);
        if forward >= 1.0 && back >= 1.0 && corner.distance(&b) <= reach && corner.distance(&c) <= reach {
            let (before, after) = (FramePoint { bevel: b.bevel, ..corner }, FramePoint { bevel: c.bevel, ..corner });
            below.extend([before, after]);
            below.extend(above);
            return below;
        }
    }
    // Neither crosses the other, nor is there a gap: a line that is short beside the offset is swallowed by the other.
    if long(&below) <= reach && long(&below) <= long(&above) {
        return above;
    }
    if long(&above) > reach {
        below.extend(above);
    }
    below
}

/// A line without the loops that the face inside a bend tighter than its distance makes.
fn without_loops(points: &[FramePoint]) -> Vec<FramePoint> {
    let crossing = |i: usize, j: usize| {
        let parts = meeting([&points[i], &points[i + 1]], [&points[j], &points[j + 1]])?;
        parts.iter().all(|part| (0.0..=1.0).contains(part)).then(|| points[i].between(&points[i + 1], parts[0]))
    };
    let mut kept = Vec::new();
    let mut i = 0;
    while i + 1 < points.len() {
        kept.push(points[i]);
        let loops = (i + 2..points.len().saturating_sub(1)).rev().find_map(|j| Some((j, crossing(i, j)?)));
        if let Some((j, corner)) = loops {
            kept.extend([corner, FramePoint { bevel: points[j + 1].bevel, ..corner }]);
            i = j;
        }
        i += 1;
    }
    kept.extend(points.last());
    kept
}

/// The parts of a line on its side of the centreplane, by at least `least` \[m\] somewhere. A line that begins less than a
/// reach beside the centreplane is produced to it.
fn from_centreplane(points: &[FramePoint], least: f64, reach: f64) -> Vec<Vec<FramePoint>> {
    let mut parts: Vec<Vec<FramePoint>> = vec![Vec::new()];
    for (k, point) in points.iter().enumerate() {
        let before = k.checked_sub(1).map(|before| points[before]);
        if let Some(before) = before.filter(|before| (before.y > 0.0) != (point.y > 0.0)) {
            let share = before.y / (before.y - point.y);
            let at = FramePoint { y: 0.0, ..before.between(point, share) };
            parts.last_mut().into_iter().for_each(|part| part.push(at));
            parts.push(vec![at]);
        }
        parts.last_mut().into_iter().for_each(|part| part.push(*point));
    }
    parts.retain(|part| part.iter().any(|point| point.y > least));
    // Beside the longest, a part that is short beside the offset lies within the skin.
    let longest = parts.iter().map(|part| long(part)).fold(0.0, f64::max);
    parts.retain(|part| long(part) > reach || long(part) >= longest);
    if let Some(&[first, second, ..]) = parts.first().map(Vec::as_slice)
        && first.y > 0.0
        && first.y <= reach
    {
        let share = first.y / (first.y - second.y);
        let produced = first.between(&second, share);
        let falls = share.is_finite() && share <= 0.0 && produced.distance(&first) <= 2.0 * first.y;
        let z = if falls { produced.z } else { first.z };
        parts[0].insert(0, FramePoint { y: 0.0, z, bevel: first.bevel });
    }
    parts
}

/// The length of a line \[m\].
fn long(line: &[FramePoint]) -> f64 {
    line.windows(2).map(|pair| pair[0].distance(&pair[1])).sum()
}

/// The part of a line below a height, produced to it where it ends less than a reach below.
fn below(mut points: Vec<FramePoint>, height: f64, reach: f64) -> Vec<FramePoint> {
    let at = |from: &FramePoint, to: &FramePoint| {
        let share = (height - from.z) / (to.z - from.z);
        FramePoint { z: height, ..from.between(to, share) }
    };
    if let Some(first) = points.iter().position(|point| point.z > height) {
        let end = first.checked_sub(1).map(|last| at(&points[last], &points[first]));
        points.truncate(first);
        points.extend(end);
    } else if let [.., before, last] = points[..]
        && last.z > before.z
        && height - last.z <= reach
    {
        points.push(at(&before, &last));
    }
    points
}

impl Hull {
    /// The frame at `x` \[m\] forward of AP, up to the deck at side, of the surface `offset` \[m\] outward of the moulded one
    /// (negative: inward). Chords are within `deviation` \[m\] of it. None where that surface does not reach.
    #[must_use]
    #[doc(hidden)]
    pub fn lofted_frame(&self, x: f64, offset: f64, deviation: f64) -> Option<LoftedFrame> {
        let lofting = Lofting { hull: self, x, offset, deviation };
        let (least, reach) = (LEAST * self.particulars().breadth, 1e-6 + PRODUCED * offset.abs());
        let lines = |pieces: Vec<Vec<FramePoint>>| {
            let whole = pieces.into_iter().reduce(|below, above| joined(below, above, offset)).unwrap_or_default();
            let whole = if offset.abs() > 0.0 { without_loops(&whole) } else { whole };
            let to_deck = |part| below(part, self.deck_height(x), ROUNDING + 2.0 * offset.abs());
            let parts = from_centreplane(&whole, least, reach).into_iter().map(to_deck);
            parts.filter(|points| points.len() > 1).collect::<Vec<_>>()
        };
        let branches: Vec<Vec<FramePoint>> = lofting.branches().into_iter().flat_map(lines).collect();
        (!branches.is_empty()).then_some(LoftedFrame { x, branches })
    }
}
