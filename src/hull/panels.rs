//! Panels of the wetted surface of one side of a hull below a draught, for programs that compute the flow about it.
//!
//! Vertices lie on the surface. Lines u = constant divide the hull along into equal parts of arc, measured as the mean
//! over lines of equal share of the immersed part; each is divided by equal parts of its own girth up to the waterline.
//! Corners of the surface (knots of multiplicity p) are lines of the panels, and so are the places where the waterline
//! crosses one or leaves through the keel. The flat of bottom, the transom and a flat bow are strips from the
//! centreplane to the side. There is no lid.
//!
//! A quadrilateral is kept while its corners leave their mean plane by at most a stated part of its longer diagonal, or
//! by what rounding makes of it; others become two triangles, cut along the shorter diagonal. With a part of 0 every
//! panel is planar. The volume is
//!
//! ```text
//! V = 2 sum of the integrals of y n_y over the panels,
//! ```
//!
//! to which neither the waterplane nor the centreplane contributes. With panels of size h it and the area are off by
//! O(h^2).

use super::form::{AFLOAT, Hull};
use super::immersion::{Immersion, UpperEnd};
use super::vertices::Known;
use crate::spline::{KnotVector, cross, dot, length, minus};

/// Half-breadths below this part of the greatest are on the centreplane.
const CENTREPLANE: f64 = 1e-9;

/// Corners within this part of the longer diagonal of their mean plane are in it but for rounding.
const PLANAR: f64 = 1e-12;

/// Intervals of each span in which lengths of arc are measured.
const SAMPLES: usize = 12;

/// Shares of the immersed part of a line u = constant, by the mean of which the hull is divided along.
const SHARES: [f64; 5] = [0.0, 0.25, 0.5, 0.75, 1.0];

/// Most panels.
pub const MOST_PANELS: usize = 200_000;

/// Why there are no panels.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum PanelError {
    /// Nothing is below the draught.
    #[error("draught {draught} m is not above the lowest point of the hull, {bottom} m")]
    NothingImmersed {
        /// The draught \[m\].
        draught: f64,
        /// The lowest point \[m\].
        bottom: f64,
    },
    /// The deck is below the waterline.
    #[error(
        "at draught {draught} m the deck at side is immersed near x = {x} m; the wetted surface must end at the waterline"
    )]
    DeckImmersed {
        /// The draught \[m\].
        draught: f64,
        /// A place where it is \[m\].
        x: f64,
    },
    /// The panels are too small for the hull.
    #[error("panels of {size} m would be more than {MOST_PANELS}")]
    TooMany {
        /// The size that was asked for \[m\].
        size: f64,
    },
}

/// How the panels are made.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PanelSettings {
    /// The draught above the base line \[m\].
    pub draught: f64,
    /// Length of the sides of panels, at most about \[m\].
    pub size: f64,
    /// What corners of a quadrilateral leave their mean plane by at most, over its longer diagonal; 0: they are in it
    /// to rounding.
    pub flatness: f64,
}

/// Panels of one side, y >= 0, normals out of the body into the water.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PanelMesh {
    /// Vertices \[m\], each once; z = 0 is the waterline.
    pub vertices: Vec<[f64; 3]>,
    /// Corners of each panel; a triangle has its last one twice.
    pub panels: Vec<[usize; 4]>,
}

/// Measures of panels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PanelReport {
    /// Panels of one side.
    pub panels: usize,
    /// Triangles among them.
    pub triangles: usize,
    /// What corners leave the mean plane of their panel by at most \[m\].
    pub unevenness: f64,
    /// Longest side of a panel \[m\].
    pub longest: f64,
    /// Volume of both sides \[m^3\].
    pub volume: f64,
    /// Area of both sides \[m^2\].
    pub area: f64,
}

/// What the corners of a quadrilateral leave the plane through their middles by \[m\].
fn unevenness([a, b, c, d]: [[f64; 3]; 4]) -> f64 {
    let normal = cross(minus(c, a), minus(d, b));
    let size = length(normal);
    if size > 0.0 { 0.5 * (dot(normal, minus(b, a)) / size).abs() } else { 0.0 }
}

/// Where a knot vector makes corners, inside its domain.
fn corners(knots: &KnotVector) -> Vec<f64> {
    let breaks = knots.breakpoints();
    let inner = &breaks[1..breaks.len() - 1];
    inner.iter().copied().filter(|&t| knots.multiplicity(t) >= knots.degree()).collect()
}

/// One of the samples of an interval; its ends exactly.
fn sample(interval: &[f64], part: usize) -> f64 {
    let (from, to) = (interval[0], interval[1]);
    if part == SAMPLES { to } else { from + (to - from) * part as f64 / SAMPLES as f64 }
}

/// Parameters that cut [from, to] into `parts` of equal length by the lengths of arc `along`, at rising parameters.
fn equal_parts(along: &[(f64, f64)], parts: usize) -> Vec<f64> {
    let (first, last) = (along[0], along[along.len() - 1]);
    let mut cuts = vec![first.0];
    for k in 1..parts {
        let wanted = first.1 + (last.1 - first.1) * k as f64 / parts as f64;
        let next = along.partition_point(|&(_, length)| length < wanted).clamp(1, along.len() - 1);
        let ((t0, s0), (t1, s1)) = (along[next - 1], along[next]);
        let share = if s1 > s0 { (wanted - s0) / (s1 - s0) } else { k as f64 / parts as f64 };
        cuts.push(t0 + share.clamp(0.0, 1.0) * (t1 - t0));
    }
    cuts.push(last.0);
    cuts
}

/// The immersed part of a hull, as its panels see it.
struct Wetted<'a> {
    hull: &'a Hull,
    immersion: Immersion<'a>,
    draught: f64,
    slack: f64,
    /// Half-breadths up to this are 0.
    centreplane: f64,
    /// Corners in v.
    corners: Vec<f64>,
}

impl Wetted<'_> {
    fn point(&self, u: f64, v: f64) -> [f64; 3] {
        let [x, y, z] = self.hull.surface().eval(u, v);
        let afloat = z >= self.draught - self.slack;
        [x, if y <= self.centreplane { 0.0 } else { y }, if afloat { 0.0 } else { z - self.draught }]
    }

    /// The v at which the line `u` leaves the water; its keel where that is afloat to rounding.
    fn end(&self, u: f64) -> f64 {
        let (lowest, _) = self.hull.surface().v().domain();
        let keel = self.hull.surface().eval(u, lowest)[2];
        if keel >= self.draught - self.slack { lowest } else { self.immersion.end(u).max(lowest) }
    }

    /// Ends of the immersed stretches of the hull in u, and the lines between that panels must have.
    fn stretches(&self) -> Vec<Vec<f64>> {
        let surface = self.hull.surface();
        let mut runs: Vec<Vec<f64>> = Vec::new();
        let along = corners(surface.u());
        let meets = |u: f64| self.corners.iter().any(|&v| (surface.eval(u, v)[2] - self.draught).abs() <= self.slack);
        for piece in self.immersion.pieces() {
            match runs.last_mut() {
                Some(run) if run[run.len() - 1].to_bits() == piece.from.to_bits() => {
                    let border = run.len() - 1;
                    let kept =
                        border > 0 && (along.iter().any(|u| (u - piece.from).abs() < 1e-12) || meets(piece.from));
                    if border > 0 && !kept {
                        run[border] = piece.to;
                    } else {
                        run.push(piece.to);
                    }
                }
                _ => runs.push(vec![piece.from, piece.to]),
            }
        }
        runs
    }

    /// Lengths of arc along the hull over [from, to]: the mean, by parameter, and the greatest of the whole.
    fn along(&self, from: f64, to: f64) -> (Vec<(f64, f64)>, f64) {
        let surface = self.hull.surface();
        let (lowest, _) = surface.v().domain();
        let mut us: Vec<f64> = surface.u().breakpoints().into_iter().filter(|&u| u > from && u < to).collect();
        us.insert(0, from);
        us.push(to);
        let mut line = Vec::new();
        let mut last = [[0.0; 3]; SHARES.len()];
        let mut sums = [0.0; SHARES.len()];
        for (k, pair) in us.windows(2).enumerate() {
            for part in usize::from(k > 0)..=SAMPLES {
                let u = sample(pair, part);
                let end = self.end(u);
                let points = SHARES.map(|share| self.point(u, lowest + share * (end - lowest)));
                if !line.is_empty() {
                    for (sum, (p, q)) in sums.iter_mut().zip(points.iter().zip(&last)) {
                        *sum += length(minus(*p, *q));
                    }
                }
                last = points;
                line.push((u, sums.iter().sum::<f64>() / SHARES.len() as f64));
            }
        }
        (line, sums.into_iter().fold(0.0, f64::max))
    }

    /// The bands of a line u = constant, from the keel over the corners to the waterline: lengths of arc by v.
    fn bands(&self, u: f64) -> Vec<Vec<(f64, f64)>> {
        let surface = self.hull.surface();
        let (lowest, _) = surface.v().domain();
        let end = self.end(u);
        let breaks = surface.v().breakpoints();
        let mut bounds = vec![lowest];
        // A corner that is afloat to rounding ends where the line does.
        let afloat = |v: f64| surface.eval(u, v)[2] >= self.draught - self.slack;
        bounds.extend(self.corners.iter().map(|&v| if v >= end || afloat(v) { end } else { v }));
        bounds.push(end);
        bounds
            .windows(2)
            .map(|band| {
                let inner = breaks.iter().copied().filter(|&v| v > band[0] && v < band[1]);
                let ends: Vec<f64> = [band[0]].into_iter().chain(inner).chain([band[1]]).collect();
                let mut line = vec![(band[0], 0.0)];
                let mut last = self.point(u, band[0]);
                let mut sum = 0.0;
                for pair in ends.windows(2) {
                    for part in 1..=SAMPLES {
                        let v = sample(pair, part);
                        let point = self.point(u, v);
                        sum += length(minus(point, last));
                        last = point;
                        line.push((v, sum));
                    }
                }
                line
            })
            .collect()
    }
}

/// Builds panels, each vertex once.
struct Builder {
    mesh: PanelMesh,
    known: Known,
    flatness: f64,
}

impl Builder {
    fn vertex(&mut self, point: [f64; 3]) -> usize {
        self.known.place(&mut self.mesh.vertices, point)
    }

    /// A panel from its different corners; none from fewer than three, and none on the centreplane.
    fn panel(&mut self, points: &[[f64; 3]]) {
        if points.iter().all(|point| point[1] <= 0.0) {
            return;
        }
        let mut places: Vec<usize> = points.iter().map(|&point| self.vertex(point)).collect();
        places.dedup();
        if places.len() > 1 && places[0] == places[places.len() - 1] {
            places.pop();
        }
        match places[..] {
            [a, b, c] => self.mesh.panels.push([a, b, c, c]),
            [a, b, c, d] => {
                let [p, q, r, s] = [a, b, c, d].map(|k| self.mesh.vertices[k]);
                let diagonals = [length(minus(r, p)), length(minus(s, q))];
                let even = unevenness([p, q, r, s]) <= self.flatness * diagonals[0].max(diagonals[1]);
                if even {
                    self.mesh.panels.push([a, b, c, d]);
                } else if diagonals[0] <= diagonals[1] {
                    self.panel(&[p, q, r]);
                    self.panel(&[p, r, s]);
                } else {
                    self.panel(&[q, r, s]);
                    self.panel(&[q, s, p]);
                }
            }
            _ => {}
        }
    }

    /// Panels from the centreplane to a line, `across` of them, the line run so that the normals point out.
    fn strip(&mut self, line: &[[f64; 3]], across: usize) {
        let point = |p: [f64; 3], k: usize| [p[0], p[1] * (k as f64 / across as f64), p[2]];
        for pair in line.windows(2) {
            for k in 0..across {
                self.panel(&[point(pair[0], k), point(pair[1], k), point(pair[1], k + 1), point(pair[0], k + 1)]);
            }
        }
    }
}

/// The hull below a draught, at which its deck at side is dry everywhere.
fn immersed(hull: &Hull, draught: f64) -> Result<Immersion<'_>, PanelError> {
    let nothing = PanelError::NothingImmersed { draught, bottom: hull.bottom() };
    let slack = AFLOAT * (hull.top() - hull.bottom());
    if draught <= hull.bottom() + slack {
        return Err(nothing);
    }
    let immersion = Immersion::new(hull, draught).ok_or(nothing)?;
    for piece in immersion.pieces() {
        let middle = 0.5 * (piece.from + piece.to);
        let top = hull.surface().eval(middle, immersion.end(middle));
        if piece.upper == UpperEnd::Deck || top[2] < draught - slack {
            return Err(PanelError::DeckImmersed { draught, x: top[0] });
        }
    }
    Ok(immersion)
}

/// Whether a hull has a wetted surface that ends at the waterline at this draught.
///
/// # Errors
/// [`PanelError`] when nothing is immersed or the deck is.
pub fn floats_at(hull: &Hull, draught: f64) -> Result<(), PanelError> {
    immersed(hull, draught).map(|_| ())
}

impl PanelMesh {
    /// Panels of the side y >= 0 below a draught (see the head).
    ///
    /// # Errors
    /// [`PanelError`] when nothing is immersed, the deck is, or there would be too many.
    pub fn new(hull: &Hull, settings: &PanelSettings) -> Result<Self, PanelError> {
        let (draught, size) = (settings.draught, settings.size);
        let slack = AFLOAT * (hull.top() - hull.bottom());
        let immersion = immersed(hull, draught)?;
        let surface = hull.surface();
        let breadth = surface.points().iter().map(|p| p[1].abs()).fold(0.0, f64::max);
        let centreplane = CENTREPLANE * breadth;
        let wetted = Wetted { hull, immersion, draught, slack, centreplane, corners: corners(surface.v()) };
        let whole = |length: f64| {
            let parts = (length / size).ceil().max(1.0);
            if parts <= MOST_PANELS as f64 { Ok(parts as usize) } else { Err(PanelError::TooMany { size }) }
        };
        let mut builder =
            Builder { mesh: Self::default(), known: Known::default(), flatness: settings.flatness.max(PLANAR) };
        let (aft, fore) = surface.u().domain();
        for run in wetted.stretches() {
            let mut columns = Vec::new();
            for pair in run.windows(2) {
                let (line, longest) = wetted.along(pair[0], pair[1]);
                let cuts = equal_parts(&line, whole(longest)?);
                columns.extend_from_slice(&cuts[usize::from(!columns.is_empty())..]);
            }
            let bands: Vec<Vec<Vec<(f64, f64)>>> = columns.iter().map(|&u| wetted.bands(u)).collect();
            let girth = |k: usize| bands.iter().map(|column| column[k].last().map_or(0.0, |l| l.1)).fold(0.0, f64::max);
            let parts: Vec<usize> = (0..wetted.corners.len() + 1).map(|k| whole(girth(k))).collect::<Result<_, _>>()?;
            let rows: usize = parts.iter().sum();
            let grid: Vec<Vec<[f64; 3]>> = columns
                .iter()
                .zip(&bands)
                .map(|(&u, bands)| {
                    let mut points = Vec::with_capacity(rows + 1);
                    for (k, (band, &parts)) in bands.iter().zip(&parts).enumerate() {
                        let cuts = equal_parts(band, parts);
                        points.extend(cuts.iter().skip(usize::from(k > 0)).map(|&v| wetted.point(u, v)));
                    }
                    points
                })
                .collect();
            let last = grid.len() - 1;
            // The lines of points that the strips across end on, run so that the normals point out.
            let bottom: Vec<[f64; 3]> = grid.iter().rev().map(|column| column[0]).collect();
            let mut strips = vec![bottom];
            if columns[0] <= aft {
                strips.push(grid[0].clone());
            }
            if columns[last] >= fore {
                strips.push(grid[last].iter().rev().copied().collect());
            }
            let across = whole(strips.iter().flatten().map(|point| point[1]).fold(0.0, f64::max))?;
            let strip_panels: usize = across * strips.iter().map(Vec::len).sum::<usize>();
            if builder.mesh.panels.len() + last * rows + strip_panels > MOST_PANELS {
                return Err(PanelError::TooMany { size });
            }
            for i in 0..last {
                for j in 0..rows {
                    builder.panel(&[grid[i][j], grid[i][j + 1], grid[i + 1][j + 1], grid[i + 1][j]]);
                }
            }
            for strip in &strips {
                builder.strip(strip, across);
            }
        }
        Ok(builder.mesh.compact())
    }

    /// The same without vertices that no panel has.
    fn compact(self) -> Self {
        let mut places = vec![usize::MAX; self.vertices.len()];
        let mut mesh = Self::default();
        for panel in &self.panels {
            mesh.panels.push(panel.map(|k| {
                if places[k] == usize::MAX {
                    places[k] = mesh.vertices.len();
                    mesh.vertices.push(self.vertices[k]);
                }
                places[k]
            }));
        }
        mesh
    }

    /// Measures the panels, quadrilaterals as two triangles.
    #[must_use]
    pub fn report(&self) -> PanelReport {
        let mut report = PanelReport {
            panels: self.panels.len(),
            triangles: 0,
            unevenness: 0.0,
            longest: 0.0,
            volume: 0.0,
            area: 0.0,
        };
        for panel in &self.panels {
            let corners = panel.map(|k| self.vertices[k]);
            let [a, b, c, d] = corners;
            if panel[2] == panel[3] {
                report.triangles += 1;
            } else {
                report.unevenness = report.unevenness.max(unevenness(corners));
            }
            for (p, q) in [(a, b), (b, c), (c, d), (d, a)] {
                report.longest = report.longest.max(length(minus(p, q)));
            }
            for [p, q, r] in [[a, b, c], [a, c, d]] {
                let normal = cross(minus(q, p), minus(r, p));
                report.area += length(normal);
                report.volume += normal[1] * (p[1] + q[1] + r[1]) / 3.0;
            }
        }
        report
    }
}

#[cfg(test)]
mod tests;
