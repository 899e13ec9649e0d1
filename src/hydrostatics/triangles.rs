//! Hydrostatics of a body of triangles at all draughts in one pass.
//!
//! Integrals over the body become integrals over its skin below the waterline (divergence theorem), of quantities that
//! neither the waterplane nor a transom or a deck contributes to:
//!
//! ```text
//! V = int y n_y dS,   M_x = int x y n_y dS,   M_z = int z y n_y dS,
//! A_W = int y dx,   along the waterline;
//! moments int x y dx, int x^2 y dx, int y^2/2 dx, int y^3/3 dx;
//! I_T = int y^3/3 dx - (int y^2/2 dx)^2 / A_W,
//! A(x) = int y dz   along the section.
//! ```
//!
//! All are exact for the polyhedron, and continuous where a draught meets vertices. A triangle is added once to the
//! draughts above it, cut by those that cross it, and not seen by those below: O(triangles log draughts + cuts). Level
//! triangles at a draught are immersed if they face down. Meshes of surfaces come in pairs, the finer with every edge
//! halved, and their sums are extrapolated. The largest section is the largest of [`STATIONS`] sections, with a
//! parabola through its neighbours.

pub(super) mod closure;

use super::conventions::Conventions;
use super::row::Hydrostatics;
use super::sections::Sections;
use super::table::{CurvesOfForm, row};
use super::volume::Body;
use super::waterplane::Waterplane;
use crate::hull::{PrincipalParticulars, TriangleMesh};
use crate::spline::{cross, length, minus};

/// Sections among which the largest is looked for.
const STATIONS: usize = 200;

/// A draught as near to the highest point as this part of the depth is at it. It is taken below the vertices that are as
/// near, by the second: a row of vertices at the waterline has errors of rounding.
const TOP: [f64; 2] = [1e-5, 1e-9];

/// Vertices as near to a draught as this part of the depth are at it, which is what coordinates of 32 bits are good for.
const SEAM: f64 = 1e-6;

/// Centre of buoyancy off the centreplane, over the breadth, from which a remark says so.
const ASYMMETRIC: f64 = 1e-4;

/// Cosine of the angle to the x axis within which triangles of the after body that face aft are of the transom.
const TRANSOM: f64 = 0.9;

/// Sums over the skin below a draught.
#[derive(Debug, Clone, Copy, Default)]
struct Skin {
    volume: f64,
    moment_x: f64,
    moment_y: f64,
    moment_z: f64,
    aft: f64,
    area: f64,
    transom: f64,
    lateral: f64,
    lateral_x: f64,
    lateral_z: f64,
}

impl Skin {
    /// Sums over one triangle of area vector `normal` / 2.
    fn of(corners: [[f64; 3]; 3], normal: [f64; 3], kind: &Kind) -> Self {
        let [a, b, c] = corners;
        let sum = [0, 1, 2].map(|k| a[k] + b[k] + c[k]);
        let product = |k: usize| (sum[k] * sum[1] + a[k] * a[1] + b[k] * b[1] + c[k] * c[1]) / 24.0;
        let volume = normal[1] * sum[1] / 6.0;
        let area = 0.5 * length(normal);
        let side = 0.25 * normal[1] * kind.side;
        Self {
            volume,
            moment_x: normal[1] * product(0),
            moment_y: 0.5 * normal[1] * product(1),
            moment_z: normal[1] * product(2),
            aft: if kind.aft { volume } else { 0.0 },
            area,
            transom: if kind.transom { 0.5 * normal[0].abs() } else { 0.0 },
            lateral: side,
            lateral_x: side * sum[0] / 3.0,
            lateral_z: side * sum[2] / 3.0,
        }
    }

    /// Adds `factor` times another.
    fn add(&mut self, other: &Self, factor: f64) {
        self.volume += factor * other.volume;
        self.moment_x += factor * other.moment_x;
        self.moment_y += factor * other.moment_y;
        self.moment_z += factor * other.moment_z;
        self.aft += factor * other.aft;
        self.area += factor * other.area;
        self.transom += factor * other.transom;
        self.lateral += factor * other.lateral;
        self.lateral_x += factor * other.lateral_x;
        self.lateral_z += factor * other.lateral_z;
    }
}

/// What is the same for all of a triangle.
struct Kind {
    /// Aft of midship.
    aft: bool,
    /// Of the transom.
    transom: bool,
    /// 1 to port, -1 to starboard.
    side: f64,
}

/// Sums along a waterline.
#[derive(Debug, Clone, Copy)]
struct WaterlineSums {
    area: f64,
    moment: f64,
    second: f64,
    across: f64,
    transverse: f64,
    least: [f64; 2],
    greatest: [f64; 2],
}

impl Default for WaterlineSums {
    fn default() -> Self {
        let (least, greatest) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        Self { area: 0.0, moment: 0.0, second: 0.0, across: 0.0, transverse: 0.0, least, greatest }
    }
}

impl WaterlineSums {
    fn add(&mut self, [a, b]: [[f64; 3]; 2]) {
        let ([x0, y0], [x1, y1]) = ([a[0], a[1]], [b[0], b[1]]);
        let dx = x1 - x0;
        self.area += dx * (y0 + y1) / 2.0;
        self.moment += dx * (x0 * (2.0 * y0 + y1) + x1 * (y0 + 2.0 * y1)) / 6.0;
        self.second += dx * (x0 * x0 * (3.0 * y0 + y1) + 2.0 * x0 * x1 * (y0 + y1) + x1 * x1 * (y0 + 3.0 * y1)) / 12.0;
        self.across += dx * (y0 * y0 + y0 * y1 + y1 * y1) / 6.0;
        self.transverse += dx * (y0 + y1) * (y0 * y0 + y1 * y1) / 12.0;
        for (k, (p, q)) in [(x0, x1), (y0, y1)].into_iter().enumerate() {
            self.least[k] = self.least[k].min(p).min(q);
            self.greatest[k] = self.greatest[k].max(p).max(q);
        }
    }
}

/// The part of a triangle on one side of a plane.
struct Clipped {
    corners: [[f64; 3]; 4],
    count: usize,
    /// Where the edges of the triangle cross the plane upward and downward.
    crossing: Option<[[f64; 3]; 2]>,
}

impl Clipped {
    /// The part where `height` is not positive.
    fn new(triangle: &[[f64; 3]; 3], height: impl Fn([f64; 3]) -> f64) -> Self {
        let mut part = Self { corners: [[0.0; 3]; 4], count: 0, crossing: None };
        let (mut up, mut down) = (None, None);
        for (k, &p) in triangle.iter().enumerate() {
            let q = triangle[(k + 1) % 3];
            let (here, there) = (height(p), height(q));
            if here <= 0.0 {
                part.put(p);
            }
            if (here <= 0.0) != (there <= 0.0) {
                // From the lower end, so that neighbours find the same point.
                let (low, high, from, to) = if here <= 0.0 { (p, q, here, there) } else { (q, p, there, here) };
                let share = from / (from - to);
                let point = [0, 1, 2].map(|i| low[i] + share * (high[i] - low[i]));
                part.put(point);
                if here <= 0.0 { up = Some(point) } else { down = Some(point) }
            }
        }
        part.crossing = up.zip(down).map(|(up, down)| [up, down]);
        part
    }

    fn put(&mut self, point: [f64; 3]) {
        if let Some(slot) = self.corners.get_mut(self.count) {
            *slot = point;
            self.count += 1;
        }
    }

    /// The part as triangles.
    fn triangles(&self) -> impl Iterator<Item = [[f64; 3]; 3]> + '_ {
        (2..self.count).map(|k| [self.corners[0], self.corners[k - 1], self.corners[k]])
    }
}

/// Areas of the sections at rising places below each draught.
struct Areas<'a> {
    places: Vec<f64>,
    draughts: &'a [f64],
    /// By place, then by draught: what begins at a draught and stays, and what that draught alone has.
    steps: Vec<Vec<[f64; 2]>>,
}

impl<'a> Areas<'a> {
    fn new(places: Vec<f64>, draughts: &'a [f64]) -> Self {
        let steps = vec![vec![[0.0; 2]; draughts.len() + 1]; places.len()];
        Self { places, draughts, steps }
    }

    fn add(&mut self, corners: [[f64; 3]; 3]) {
        let [least, greatest] =
            [f64::min, f64::max].map(|pick| pick(pick(corners[0][0], corners[1][0]), corners[2][0]));
        let first = self.places.partition_point(|&x| x <= least);
        for (k, &x) in self.places.iter().enumerate().skip(first).take_while(|(_, x)| **x <= greatest) {
            // Vertices on the plane are forward of it.
            let forward = corners.map(|p| p[0] >= x);
            let (mut up, mut down) = (None, None);
            for i in 0..3 {
                let j = (i + 1) % 3;
                if forward[i] != forward[j] {
                    let (aft, fore) = if forward[i] { (corners[j], corners[i]) } else { (corners[i], corners[j]) };
                    let share = (x - aft[0]) / (fore[0] - aft[0]);
                    let point = [aft[1] + share * (fore[1] - aft[1]), aft[2] + share * (fore[2] - aft[2])];
                    if forward[j] { up = Some(point) } else { down = Some(point) }
                }
            }
            let Some((a, b)) = up.zip(down) else { continue };
            let area = |a: [f64; 2], b: [f64; 2]| 0.5 * (a[0] + b[0]) * (a[1] - b[1]);
            let (low, high) = (a[1].min(b[1]), a[1].max(b[1]));
            let whole = self.draughts.partition_point(|&t| t < high);
            self.steps[k][whole][0] += area(a, b);
            let from = self.draughts.partition_point(|&t| t <= low);
            for (step, &t) in self.steps[k][from..whole.max(from)].iter_mut().zip(&self.draughts[from..]) {
                let share = (t - a[1]) / (b[1] - a[1]);
                let cut = [a[0] + share * (b[0] - a[0]), t];
                step[1] += if a[1] < b[1] { area(a, cut) } else { area(cut, b) };
            }
        }
    }

    /// The area of each section below the draught number `at`.
    fn below(&self, at: usize) -> Vec<f64> {
        self.steps.iter().map(|steps| steps[..=at].iter().map(|s| s[0]).sum::<f64>() + steps[at][1]).collect()
    }
}

/// The greatest of values over equal steps, and where it is: between neighbours by a parabola. Where values go on level
/// beside it there is a corner, and the greatest is one of them.
fn greatest(places: &[f64], values: &[f64]) -> Option<(f64, f64)> {
    let at = (0..values.len()).max_by(|&a, &b| values[a].total_cmp(&values[b]).then(b.cmp(&a)))?;
    if values[at] <= 0.0 {
        return None;
    }
    if at == 0 || at + 1 == values.len() {
        return Some((places[at], values[at]));
    }
    let [a, b, c] = [values[at - 1], values[at], values[at + 1]];
    let bend = a - 2.0 * b + c;
    // The parabola falls by b - c - bend from the higher neighbour to the one beyond it.
    let (higher, beyond) = if c >= a { (c, values.get(at + 2)) } else { (a, at.checked_sub(2).map(|k| &values[k])) };
    let is_corner = beyond.is_some_and(|beyond| higher - beyond < 0.5 * (b - higher - bend));
    let shift = if bend < 0.0 && !is_corner { 0.5 * (a - c) / bend } else { 0.0 };
    Some((places[at] + shift * (places[at + 1] - places[at]), b - 0.25 * (a - c) * shift))
}

/// What one pass over the triangles of a mesh gives for a draught.
struct Sums {
    skin: Skin,
    line: WaterlineSums,
    midship: f64,
    areas: Vec<f64>,
}

/// One pass for all levels, which rise.
fn sums(mesh: &TriangleMesh, levels: &[f64], places: &[f64], midship: f64) -> Vec<Sums> {
    let mut areas = Areas::new(places.to_vec(), levels);
    let mut middle = Areas::new(vec![midship], levels);
    let mut skins = vec![[Skin::default(); 2]; levels.len() + 1];
    let mut lines = vec![WaterlineSums::default(); levels.len()];
    for corners in mesh.corners() {
        areas.add(corners);
        middle.add(corners);
        // Volumes aft and forward of midship need no face between: its normal has no y.
        let ahead = corners.map(|p| p[0] > midship);
        if ahead == [false; 3] || ahead == [true; 3] {
            add_skin(corners, !ahead[0], levels, &mut skins);
        } else {
            for (sign, aft) in [(1.0, true), (-1.0, false)] {
                let half = Clipped::new(&corners, |p| sign * (p[0] - midship));
                half.triangles().for_each(|part| add_skin(part, aft, levels, &mut skins));
            }
        }
        let [low, high] = [f64::min, f64::max].map(|pick| pick(pick(corners[0][2], corners[1][2]), corners[2][2]));
        let from = levels.partition_point(|&t| t < low);
        for (line, &t) in lines[from..].iter_mut().zip(&levels[from..]).take_while(|(_, t)| **t < high) {
            if let Some(cut) = Clipped::new(&corners, |p| p[2] - t).crossing {
                line.add(cut);
            }
        }
    }
    let mut below = Skin::default();
    let each = lines.into_iter().enumerate().map(|(at, line)| {
        below.add(&skins[at][0], 1.0);
        let mut skin = below;
        skin.add(&skins[at][1], 1.0);
        Sums { skin, line, midship: middle.below(at)[0], areas: areas.below(at) }
    });
    each.collect()
}

impl Sums {
    /// 4/3 of the finer less 1/3 of the coarser; extents of the finer.
    fn extrapolated(coarser: &Self, finer: Self) -> Self {
        let of = |coarse: f64, fine: f64| (4.0 * fine - coarse) / 3.0;
        let mut skin = Skin::default();
        skin.add(&finer.skin, 4.0 / 3.0);
        skin.add(&coarser.skin, -1.0 / 3.0);
        let (a, b) = (coarser.line, finer.line);
        let line = WaterlineSums {
            area: of(a.area, b.area),
            moment: of(a.moment, b.moment),
            second: of(a.second, b.second),
            across: of(a.across, b.across),
            transverse: of(a.transverse, b.transverse),
            ..b
        };
        let areas = coarser.areas.iter().zip(&finer.areas).map(|(&a, &b)| of(a, b)).collect();
        Self { skin, line, midship: of(coarser.midship, finer.midship), areas }
    }
}

impl CurvesOfForm {
    /// One row for each of `draughts` [m above the base line], in any order, of a body of triangles that are turned
    /// outward, both sides of it (see the head of the module). Angles of the waterline's ends and the parallel body are
    /// not defined. A draught that is not a finite number gives an empty row with a remark and draught 0; one at the
    /// highest point is just below it.
    ///
    /// `finer` is a mesh of the same surfaces with every edge halved, where there is one: what is of second order in
    /// both is then extrapolated.
    #[must_use]
    #[doc(hidden)]
    pub fn of_triangles(
        mesh: &TriangleMesh,
        finer: Option<&TriangleMesh>,
        particulars: &PrincipalParticulars,
        draughts: &[f64],
        conventions: &Conventions,
    ) -> Self {
        let mut sorted: Vec<f64> = draughts.iter().filter(|t| t.is_finite()).map(|t| t + 0.0).collect();
        sorted.sort_by(f64::total_cmp);
        sorted.dedup();
        let bounds = finer.unwrap_or(mesh).bounds().unwrap_or_default();
        let depth = bounds[1][2] - bounds[0][2];
        let near_top = |t: f64| (t - bounds[1][2]).abs() <= TOP[0] * depth;
        let heights = [Some(mesh), finer].into_iter().flatten().flat_map(|mesh| mesh.vertices.iter().map(|v| v[2]));
        let lowest = heights.clone().filter(|&z| near_top(z)).fold(bounds[1][2], f64::min);
        let seams = over_seams(&sorted, heights, depth);
        let level = |(&t, &over): (&f64, &f64)| if near_top(t) { lowest - TOP[1] * depth } else { over };
        let levels: Vec<f64> = sorted.iter().zip(&seams).map(level).collect();
        let midship = 0.5 * particulars.length_between_perpendiculars;
        let length = bounds[1][0] - bounds[0][0];
        let places: Vec<f64> =
            (0..STATIONS).map(|k| bounds[0][0] + length * (k as f64 + 0.5) / STATIONS as f64).collect();
        let mut found = sums(mesh, &levels, &places, midship);
        if let Some(finer) = finer {
            let fine = sums(finer, &levels, &places, midship);
            found = found.iter().zip(fine).map(|(coarse, fine)| Sums::extrapolated(coarse, fine)).collect();
        }
        let rows: Vec<Hydrostatics> = sorted
            .iter()
            .zip(&found)
            .map(|(&draught, sums)| {
                let largest = greatest(&places, &sums.areas);
                let sections = Sections {
                    midship: sums.midship,
                    largest: largest.map_or(0.0, |(_, area)| area),
                    place: largest.map(|(x, _)| x),
                    parallel: None,
                };
                let (body, plane) = (sums.skin.body(), sums.line.waterplane());
                let beside = Some(sums.skin.moment_y / body.volume)
                    .filter(|y| body.volume > 0.0 && y.abs() > ASYMMETRIC * (bounds[1][1] - bounds[0][1]));
                let row = row(particulars, draught, conventions, &body, &plane, &sections);
                // The moment of the weight on the centreplane and of the buoyancy beside it.
                let heel = beside.zip(row.gm_transverse.filter(|gm| *gm > 0.0)).map(|(y, gm)| (y / gm).atan());
                let remark = if near_top(draught) { None } else { remark(draught, &bounds) };
                let remark = remark.or_else(|| beside.map(|y| off_centreplane(y, heel)));
                Hydrostatics { remark, transverse_centre: beside, heel: heel.map(f64::to_degrees), ..row }
            })
            .collect();
        let found = |draught: &f64| {
            let at = sorted.binary_search_by(|t| t.total_cmp(&(draught + 0.0))).ok()?;
            rows.get(at).cloned()
        };
        let empty = |draught: &f64| Hydrostatics {
            remark: Some(format!("draught {draught} is not a finite number; nothing is computed")),
            ..Hydrostatics::default()
        };
        let rows = draughts.iter().map(|draught| found(draught).unwrap_or_else(|| empty(draught))).collect();
        Self { conventions: *conventions, rows }
    }
}

/// Draughts, which rise, above the vertices that are as good as at them, where these vertices differ from each other: parts that
/// are joined there end and begin within errors of rounding, and count once. Beside a row of equal heights a draught stays.
fn over_seams(draughts: &[f64], heights: impl Iterator<Item = f64>, depth: f64) -> Vec<f64> {
    let near = SEAM * depth;
    let mut ends = vec![[f64::INFINITY, f64::NEG_INFINITY]; draughts.len()];
    for z in heights {
        let from = draughts.partition_point(|&t| t < z - near);
        for (end, _) in ends[from..].iter_mut().zip(&draughts[from..]).take_while(|(_, t)| **t <= z + near) {
            *end = [end[0].min(z), end[1].max(z)];
        }
    }
    let over = |([low, high], &t): ([f64; 2], &f64)| if low < high { high + TOP[1] * depth } else { t };
    ends.into_iter().zip(draughts).map(over).collect()
}

/// Centre of buoyancy \[m\] and heel \[rad\] of a body that is not symmetrical.
fn off_centreplane(y: f64, heel: Option<f64>) -> String {
    let side = if y > 0.0 { "port" } else { "starboard" };
    let heel =
        heel.map(|heel| format!(", which heels it by {:.2} degrees", heel.to_degrees().abs())).unwrap_or_default();
    format!("centre of buoyancy YCB {y:.3} m, to {side} of the centreplane{heel}")
}

fn remark(draught: f64, bounds: &[[f64; 3]; 2]) -> Option<String> {
    if draught <= bounds[0][2] {
        return Some(format!("draught below the lowest point of the body, {:.3} m; nothing is immersed", bounds[0][2]));
    }
    (draught >= bounds[1][2])
        .then(|| format!("draught above the top of the body, {:.3} m; no waterplane", bounds[1][2]))
}

/// Adds the part of a triangle below each draught.
fn add_skin(corners: [[f64; 3]; 3], aft: bool, draughts: &[f64], skins: &mut [[Skin; 2]]) {
    let [a, b, c] = corners;
    let normal = cross(minus(b, a), minus(c, a));
    let size = length(normal);
    let kind = Kind {
        aft,
        transom: aft && normal[0] < -TRANSOM * size,
        side: if a[1] + b[1] + c[1] < 0.0 { -1.0 } else { 1.0 },
    };
    let [low, high] = [f64::min, f64::max].map(|pick| pick(pick(a[2], b[2]), c[2]));
    let level_deck = low.to_bits() == high.to_bits() && normal[2] > 0.0;
    let whole = draughts.partition_point(|&t| t < high || (level_deck && t <= high));
    skins[whole][0].add(&Skin::of(corners, normal, &kind), 1.0);
    let from = draughts.partition_point(|&t| t <= low);
    for (skin, &t) in skins[from.min(whole)..whole].iter_mut().zip(&draughts[from.min(whole)..]) {
        for piece in Clipped::new(&corners, |p| p[2] - t).triangles() {
            let normal = cross(minus(piece[1], piece[0]), minus(piece[2], piece[0]));
            skin[1].add(&Skin::of(piece, normal, &kind), 1.0);
        }
    }
}

impl Skin {
    fn body(&self) -> Body {
        Body {
            volume: self.volume,
            moment_x: self.moment_x,
            moment_z: self.moment_z,
            aft: Some(self.aft),
            side: self.area,
            ends: 0.0,
            transom: self.transom,
            bottom: 0.0,
            lateral: self.lateral,
            lateral_x: self.lateral_x,
            lateral_z: self.lateral_z,
        }
    }
}

impl WaterlineSums {
    fn waterplane(&self) -> Waterplane {
        if self.area <= 0.0 {
            return Waterplane::default();
        }
        Waterplane {
            area: self.area,
            moment: self.moment,
            second: self.second,
            // About the waterplane's own axis: a body may lie beside the centreplane.
            transverse: self.transverse - self.across * self.across / self.area,
            aft: self.least[0],
            length: self.greatest[0] - self.least[0],
            breadth: self.greatest[1] - self.least[1],
            entrance: None,
            run: None,
        }
    }
}

#[cfg(test)]
mod tests;
