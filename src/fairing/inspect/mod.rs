//! Inspection of a hull: what its stations, waterlines, buttocks and diagonals, its net and its surface say about
//! fairness.
//!
//! Section curves are [`Hull::section`]'s, connected and in order; their curvature is that of the surface
//! (`contour.rs`), and what is counted on them is defined in `profile.rs`. One length tells what is seen from what is
//! not: the tolerance, which is the resolution of the drawing times its scale ([`Resolution`]). A lesser bump does not
//! show on paper.
//!
//! Accuracy: curvature to rounding; lengths and energies of a piece to the Clenshaw-Curtis rule of 13 points (1e-10 for
//! smooth pieces); places of inflections and extrema O(h^4) in the distance of these points. Where the half-breadth
//! shrinks to nothing, as at the end stations of a table, the surface can turn within microns of the centreplane, which
//! says nothing about fairness. A curve whose half-breadth is below B/1000 all along is therefore not counted, and of
//! other curves the ends where it is are left out if they are longer than B/50; both are reported. Limit: at the edge of a
//! narrow flat of bottom near the ends a fitted surface may turn within centimetres. Such turns count, and rule the
//! sums of squared curvature; the reports name the curve that holds more than half of such a sum, with the place of its
//! turn, and give the median over the curves beside the sum. Cost: one section and about 30 evaluations of third
//! derivatives for each patch that it crosses.

mod comb;
mod contour;
mod curvature;
mod map;
mod pieces;
mod polygon;
mod profile;
mod regions;
mod stations;

pub use comb::{Comb, Tooth, combs};
pub use curvature::{CurvatureAt, CurvatureRange, SurfaceMeasures};
pub use map::{KnotLine, MapBreak, MapPoint, SurfaceMap};
pub use polygon::{NetLine, ON_CHORD, PolygonSigns, Side, changes_and_enclosed, net_signs, polygon_signs};
pub use profile::{Counts, Findings, Local, Place, Profile, Stretch};
pub use regions::gaussian_regions;

use crate::hull::{
    Cut, Face, Hull, StationNumbers, default_buttocks, default_diagonals, default_stations, default_waterlines,
};
use contour::{Breadth, Locator, Trace};

/// Deviation of the section curves from surface and plane \[m\], in lengths between perpendiculars.
const SECTION: f64 = 1e-11;
/// The same where inflections are counted and no curvature is asked for.
const COUNTED: f64 = 1e-8;

/// Half-breadths below this are none, in moulded breadths.
const NO_BREADTH: f64 = 1e-3;
/// Longest end without breadth that still counts, in moulded breadths.
const LONGEST_END: f64 = 0.02;

/// What can be seen in a drawing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Resolution {
    /// The least departure from a batten that is seen on paper \[m\].
    pub on_paper: f64,
    /// n of the scale 1 : n.
    pub scale: f64,
}

impl Resolution {
    /// 0.1 mm on a drawing that is at most 2.5 m long: the scale is the largest of 1:10, 25, 50, 100, 200, 500 at which
    /// a ship of `length` \[m\] fits.
    #[must_use]
    pub fn for_length(length: f64) -> Self {
        let scales = [10.0, 25.0, 50.0, 100.0, 200.0, 500.0];
        let scale = scales.into_iter().find(|scale| length / scale <= 2.5).unwrap_or(500.0);
        Self { on_paper: 1e-4, scale }
    }

    /// The least departure that is seen, on the ship \[m\].
    #[must_use]
    pub fn tolerance(&self) -> f64 {
        self.on_paper * self.scale
    }
}

/// The planes of an inspection.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Planes {
    /// x of the stations \[m\].
    pub stations: Vec<f64>,
    /// z of the waterlines \[m\].
    pub waterlines: Vec<f64>,
    /// y of the buttocks \[m\].
    pub buttocks: Vec<f64>,
    /// Heights of the diagonals on the centreplane \[m\].
    pub diagonals: Vec<f64>,
    /// Angle of the diagonals below the horizontal \[rad\].
    pub diagonal_angle: f64,
    /// Other planes.
    pub others: Vec<Cut>,
}

impl Planes {
    /// The stations, waterlines and buttocks of a table of offsets of the hull, and the diagonals of
    /// [`default_diagonals`].
    #[must_use]
    pub fn with_defaults(hull: &Hull) -> Self {
        let (diagonals, diagonal_angle) = default_diagonals(hull);
        Self {
            stations: default_stations(hull, StationNumbers::default()).into_iter().map(|station| station.x).collect(),
            waterlines: default_waterlines(hull),
            buttocks: default_buttocks(hull),
            diagonals,
            diagonal_angle,
            others: Vec::new(),
        }
    }

    /// The planes in order: stations, waterlines, buttocks, diagonals, others.
    #[must_use]
    pub fn cuts(&self) -> Vec<Cut> {
        let stations = self.stations.iter().map(|&x| Cut::Station { x });
        let waterlines = self.waterlines.iter().map(|&z| Cut::Waterline { z });
        let buttocks = self.buttocks.iter().map(|&y| Cut::Buttock { y });
        let diagonals = self.diagonals.iter().map(|&height| Cut::Diagonal { height, angle: self.diagonal_angle });
        stations.chain(waterlines).chain(buttocks).chain(diagonals).chain(self.others.iter().copied()).collect()
    }
}

/// A flat of a curve in space.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Flat {
    /// Where it starts \[m\].
    pub from: [f64; 3],
    /// Where it ends \[m\].
    pub to: [f64; 3],
    /// Its length \[m\].
    pub length: f64,
}

/// What is found on one connected curve of one plane.
#[derive(Debug, Clone, PartialEq)]
pub struct CurveReport {
    /// The plane.
    pub cut: Cut,
    /// Which of the curves of the plane on the side of the hull, from 1.
    pub branch: usize,
    /// Length \[m\].
    pub length: f64,
    /// int |kappa| ds \[rad\].
    pub turning: f64,
    /// Inflections \[m\].
    pub inflections: Vec<[f64; 3]>,
    /// Curvature extrema \[m\].
    pub extrema: Vec<[f64; 3]>,
    /// kappa where |kappa| is largest \[1/m\], positive where the curve is convex outward.
    pub largest: CurvatureAt,
    /// Largest |difference of kappa| between neighbouring ordinates \[1/m\]: stations, or waterlines on stations. None
    /// when the curve passes fewer than two.
    pub step: Option<f64>,
    /// int kappa^2 ds \[1/m\].
    pub bending: f64,
    /// int (d(kappa)/ds)^2 ds [1/m^3].
    pub variation: f64,
    /// Flats.
    pub flats: Vec<Flat>,
    /// Knuckles \[m\].
    pub knuckles: Vec<[f64; 3]>,
    /// Length of the ends that have no breadth and were left out of everything above \[m\].
    pub without_breadth: f64,
}

/// What is found on a hull.
#[derive(Debug, Clone, PartialEq)]
pub struct Inspection {
    /// The least departure that counts \[m\].
    pub tolerance: f64,
    /// Curves: stations, waterlines, buttocks, diagonals, other planes, in the order of [`Planes`].
    pub curves: Vec<CurveReport>,
    /// Planes that do not cut the side of the hull, or along which it lies in the plane.
    pub empty: Vec<Cut>,
    /// Planes whose section has a curve that was not counted: the half-breadth is below B/1000 all along.
    pub narrow: Vec<Cut>,
    /// Signs of the control polygon.
    pub net: Vec<PolygonSigns>,
    /// Curvature of the surface.
    pub surface: SurfaceMeasures,
}

/// Whether a plane is that of a station or a waterline, of which a table consists.
#[must_use]
pub(super) fn is_of_table(cut: &Cut) -> bool {
    matches!(cut, Cut::Station { .. } | Cut::Waterline { .. })
}

/// The word for the kind of a plane.
#[must_use]
pub fn kind(cut: &Cut) -> &'static str {
    match cut {
        Cut::Station { .. } => "station",
        Cut::Waterline { .. } => "waterline",
        Cut::Buttock { .. } => "buttock",
        Cut::Diagonal { .. } => "diagonal",
        Cut::Plane { .. } => "plane",
    }
}

impl Inspection {
    /// Inspects a hull; `tolerance` is the departure that can just be seen \[m\].
    #[must_use]
    pub fn new(hull: &Hull, planes: &Planes, tolerance: f64) -> Self {
        let (curves, empty, narrow) = curves(hull, planes, tolerance);
        let net = net_signs(hull.surface(), ON_CHORD * tolerance);
        Self { tolerance, curves, empty, narrow, net, surface: SurfaceMeasures::of(hull) }
    }
}

/// The curves of an inspection before it is said what can be seen of them.
#[derive(Debug, Clone)]
pub struct Traced(Vec<(Cut, Vec<Profile>)>);

impl Traced {
    /// Traces the curves of each plane that has some, in the order of [`Planes`].
    #[must_use]
    pub fn new(hull: &Hull, planes: &Planes) -> Self {
        let locator = Locator::new(hull.surface());
        let profiles =
            |cut: Cut| traces(hull, &locator, cut, COUNTED).0.into_iter().map(|trace| trace.1.profile).collect();
        let list = planes.cuts().into_iter().map(|cut| (cut, profiles(cut)));
        Self(list.filter(|(_, profiles): &(Cut, Vec<Profile>)| !profiles.is_empty()).collect())
    }

    /// What counts on each plane; `band` is the height from which a bump does \[m\].
    #[must_use]
    pub fn counts(&self, band: f64) -> Vec<(Cut, Counts)> {
        self.0.iter().map(|(cut, profiles)| (*cut, Counts::of(profiles, band))).collect()
    }
}

/// Curves; planes that have none; planes of which one was not counted.
fn curves(hull: &Hull, planes: &Planes, tolerance: f64) -> (Vec<CurveReport>, Vec<Cut>, Vec<Cut>) {
    let locator = Locator::new(hull.surface());
    let (mut curves, mut empty, mut narrow) = (Vec::new(), Vec::new(), Vec::new());
    for cut in planes.cuts() {
        let (found, thin) = inspect_plane(hull, &locator, cut, planes, tolerance);
        if thin {
            narrow.push(cut);
        } else if found.is_empty() {
            empty.push(cut);
        }
        curves.extend(found);
    }
    (curves, empty, narrow)
}

/// The curves of a plane on the side with their numbers from 1, and whether one was not counted for want of breadth.
/// They keep to surface and plane to within `close` lengths between perpendiculars.
fn traces(hull: &Hull, locator: &Locator, cut: Cut, close: f64) -> (Vec<(usize, Trace)>, bool) {
    let Some((normal, _)) = cut.plane() else { return (Vec::new(), false) };
    let close = close * hull.particulars().length_between_perpendiculars;
    let section = hull.section(cut, close);
    // What lies on the side; the flats of the body are flat.
    let branches = section.branches.iter().filter(|branch| branch.face == Face::Side);
    let moulded = hull.particulars().breadth;
    // A buttock has one half-breadth, whichever was asked for.
    let breadth = (!matches!(cut, Cut::Buttock { .. }))
        .then_some(Breadth { least: NO_BREADTH * moulded, longest: LONGEST_END * moulded });
    let (mut found, mut thin) = (Vec::new(), false);
    for (number, branch) in (1..).zip(branches) {
        // The traced curve may stand off the surface by its tolerance; a hundred of them is another place.
        let Some(trace) = Trace::new(locator, branch, normal, 100.0 * close, breadth, hull.follows_net(cut)) else {
            let narrow = |b: Breadth| branch.curve.points().iter().all(|point| point[1].abs() < b.least);
            thin |= breadth.is_some_and(narrow);
            continue;
        };
        found.push((number, trace));
    }
    (found, thin)
}

/// What is found on the curves of a plane, and whether one was not counted.
fn inspect_plane(
    hull: &Hull,
    locator: &Locator,
    cut: Cut,
    planes: &Planes,
    tolerance: f64,
) -> (Vec<CurveReport>, bool) {
    let across = matches!(cut, Cut::Station { .. });
    let (traces, thin) = traces(hull, locator, cut, SECTION);
    let mut reports = Vec::new();
    for (branch, trace) in traces {
        let (axis, offset) = trace.coordinate(if across { 2 } else { 0 });
        let ordinates = if across { &planes.waterlines } else { &planes.stations };
        let marks: Vec<f64> = ordinates.iter().map(|mark| mark - offset).collect();
        let along = trace.profile.curvature_at(axis, &marks);
        let step = along.windows(2).map(|pair| (pair[1] - pair[0]).abs()).reduce(f64::max);
        let found = trace.profile.findings(tolerance);
        let space = |places: &[Place]| places.iter().map(|place| trace.space(place.point)).collect();
        reports.push(CurveReport {
            cut,
            branch,
            length: found.length,
            turning: found.turning,
            inflections: space(&found.inflections),
            extrema: space(&found.extrema),
            largest: CurvatureAt { value: found.largest.0, at: trace.space(found.largest.1.point) },
            step,
            bending: found.bending,
            variation: found.variation,
            flats: found
                .flats
                .iter()
                .map(|flat| Flat {
                    from: trace.space(flat.from.point),
                    to: trace.space(flat.to.point),
                    length: flat.to.s - flat.from.s,
                })
                .collect(),
            knuckles: space(&found.knuckles),
            without_breadth: trace.left_out,
        });
    }
    (reports, thin)
}
