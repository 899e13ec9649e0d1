//! Offset tables: half-breadths at stations and waterlines, heights at buttocks, endings.
//!
//! Half-breadths are values of the surface, exact to 1e-12 m. Heights are found on the station's section, which keeps
//! 1e-11 m from the surface, and are exact to that over the slope of the section.

use super::cell::{Cell, Entry, FeatureLine, OutlinePoint, StatedParticulars, TransomPlane};
use super::chart::{coordinate, turns};
use super::form::Hull;
use super::section::{Cut, Face, Section, curve_sign_changes};
use super::table_form::TableForm;
use crate::spline::BsplineCurve;

/// A station of an offset table.
#[derive(Debug, Clone, PartialEq)]
pub struct OffsetStation {
    /// Number or name, as it is written over the column.
    pub name: String,
    /// Position forward of AP \[m\].
    pub x: f64,
}

impl OffsetStation {
    /// Whether its name is its place in metres, to 5 mm.
    #[must_use]
    pub fn is_named_by_place(&self) -> bool {
        self.name.parse::<f64>().is_ok_and(|x| (x - self.x).abs() < 5e-3)
    }

    /// The station in a sentence: `station 5` of a table whose stations have names; `station at x = 35 m` where the
    /// name is the place, which would be taken for the number of another station of a drawing. 0 is AP either way.
    #[must_use]
    pub fn words(&self) -> String {
        let name = &self.name;
        if self.is_named_by_place() && self.x.abs() >= 5e-3 {
            format!("station at x = {name} m")
        } else {
            format!("station {name}")
        }
    }
}

/// What belongs to a station besides its half-breadths. Values are absent where there is no hull.
#[derive(Debug, Clone, PartialEq)]
pub struct StationOffsets {
    /// The station.
    pub station: OffsetStation,
    /// Half-breadth at each waterline of the table \[m\]; absent beyond the ends of the waterline and above the deck.
    pub half_breadths: Vec<Cell>,
    /// Height at each buttock of the table \[m\]: the lowest point of the body there; absent where the body is narrower.
    pub heights: Vec<Cell>,
    /// Height of the lowest point on the centreplane: keel line, stem or stern profile \[m\].
    pub keel_height: Option<f64>,
    /// Half-breadth of the flat of bottom \[m\]; 0 where the keel is a line.
    pub flat_of_bottom: Option<f64>,
    /// Height at which the flat of side begins \[m\].
    pub flat_of_side: Option<f64>,
    /// Height of the deck at side, or of the upper edge of the section \[m\].
    pub deck_height: Option<f64>,
    /// Half-breadth at the deck at side \[m\].
    pub deck_half_breadth: Option<f64>,
    /// Height of the deck on the centreline \[m\].
    pub deck_centre_height: Option<f64>,
    /// The section as points from keel to deck, for tables that give sections instead of a grid; one list a branch (a
    /// bulb and the flare above it are two).
    pub outlines: Vec<Vec<OutlinePoint>>,
}

impl StationOffsets {
    /// What the table says of it on a waterline, by index.
    #[must_use]
    pub fn entry(&self, waterline: usize) -> Entry {
        self.half_breadths.get(waterline).map_or(Entry::Absent, |cell| cell.entry)
    }

    /// Its offset on a waterline \[m\]; none where there is none, or none that is finite.
    #[must_use]
    pub fn half_breadth(&self, waterline: usize) -> Option<f64> {
        match self.entry(waterline) {
            Entry::Given(y) if y.is_finite() => Some(y),
            _ => None,
        }
    }

    /// Whether a waterline, at height `z` \[m\], lies above its deck at side; where the table has none, whether all is
    /// blank from there on above an offset with breadth.
    #[must_use]
    pub fn ends_below(&self, waterline: usize, z: f64) -> bool {
        let below = self.half_breadths.iter().take(waterline);
        self.half_breadth(waterline).is_none()
            && match self.deck_height {
                Some(deck) => deck < z,
                None => {
                    below.filter_map(Cell::value).any(|y| y > 0.0)
                        && self.half_breadths.iter().skip(waterline).all(|cell| matches!(cell.entry, Entry::Absent))
                }
            }
    }

    /// The half-breadth that continues its side above the deck \[m\]: of the deck, or of the highest offset below a
    /// waterline.
    #[must_use]
    pub fn edge_half_breadth(&self, waterline: usize) -> Option<f64> {
        let below = self.half_breadths.iter().take(waterline);
        self.deck_half_breadth.or_else(|| below.rev().find_map(Cell::value))
    }

    /// A station without any offsets.
    #[must_use]
    pub fn new(name: impl Into<String>, x: f64) -> Self {
        Self {
            station: OffsetStation { name: name.into(), x },
            half_breadths: Vec::new(),
            heights: Vec::new(),
            keel_height: None,
            flat_of_bottom: None,
            flat_of_side: None,
            deck_height: None,
            deck_half_breadth: None,
            deck_centre_height: None,
            outlines: Vec::new(),
        }
    }
}

/// Offsets of a hull. Lengths from AP forward, heights above the base line, half-breadths from the centreplane, in
/// metres.
///
/// Stations rise in x, waterlines in z, buttocks in y, whatever the order they were written in; `form` remembers that.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct OffsetTable {
    /// Name of the ship; empty when the table has none.
    pub name: String,
    /// Main dimensions that the table states.
    pub stated: StatedParticulars,
    /// Heights of the waterlines \[m\].
    pub waterlines: Vec<f64>,
    /// Distances of the buttocks from the centreplane \[m\].
    pub buttocks: Vec<f64>,
    /// The stations with their offsets.
    pub stations: Vec<StationOffsets>,
    /// Ends of each waterline: x at the stern and at the stem profile \[m\]; none where the table does not give them,
    /// outside the surface and above the deck there. As many as waterlines.
    pub endings: Vec<[Option<f64>; 2]>,
    /// Knuckles and tangent lines.
    pub lines: Vec<FeatureLine>,
    /// The plane of the transom.
    pub transom: Option<TransomPlane>,
    /// How the table was written.
    #[doc(hidden)]
    pub form: TableForm,
}

/// Waterlines at which the ends of the immersed hull are looked for.
const ENDS: usize = 101;

impl OffsetTable {
    /// Number of points of sections.
    #[must_use]
    pub fn point_count(&self) -> usize {
        self.stations.iter().flat_map(|station| &station.outlines).map(Vec::len).sum()
    }

    /// The highest waterline with breadth, where one above it has zeros alone: the hull closes between them.
    #[must_use]
    pub fn closes_above(&self) -> Option<usize> {
        let given = |j: usize| self.stations.iter().filter_map(move |station| station.half_breadth(j));
        let highest = (0..self.waterlines.len()).rev().find(|&j| given(j).any(|y| y > 0.0))?;
        (highest + 1..self.waterlines.len()).any(|j| given(j).next().is_some()).then_some(highest)
    }

    /// The station of the only offset of a waterline, where it is between zeros at the two stations beside it that stand nearer
    /// than it is large: no waterline, but an error of the table or of the program that cut it.
    #[must_use]
    pub fn lone_offset(&self, waterline: usize) -> Option<usize> {
        let at = |k: usize| Some((self.stations.get(k)?.station.x, self.stations[k].half_breadth(waterline)?));
        let mut positive = (0..self.stations.len()).filter(|&k| at(k).is_some_and(|(_, y)| y > 0.0));
        let (only, None) = (positive.next()?, positive.next()) else { return None };
        let (x, y) = at(only)?;
        let beside = [at(only.checked_sub(1)?)?, at(only + 1)?];
        beside.iter().all(|&(other, zero)| zero <= 0.0 && (other - x).abs() < y).then_some(only)
    }

    /// Lifts the offsets of a hull at the given stations, waterlines and buttocks.
    #[must_use]
    pub fn from_hull(hull: &Hull, stations: &[OffsetStation], waterlines: &[f64], buttocks: &[f64]) -> Self {
        Self {
            name: hull.name().to_owned(),
            stated: hull.particulars().into(),
            waterlines: waterlines.to_vec(),
            buttocks: buttocks.to_vec(),
            stations: stations.iter().map(|station| lift(hull, station, waterlines, buttocks)).collect(),
            endings: waterlines.iter().map(|&z| ends(hull, z)).collect(),
            ..Self::default()
        }
    }

    /// The offsets at [`default_stations`], [`default_waterlines`] and [`default_buttocks`], without stations that no
    /// waterline meets.
    #[must_use]
    pub fn with_defaults(hull: &Hull) -> Self {
        let mut table = Self::from_hull(
            hull,
            &default_stations(hull, StationNumbers::default()),
            &default_waterlines(hull),
            &default_buttocks(hull),
        );
        table.stations.retain(|station| station.half_breadths.iter().any(|cell| cell.value().is_some()));
        table
    }
}

impl OffsetTable {
    /// Half-breadths of the hull below a draught at `count` stations, at equal distances from its aftmost to its
    /// foremost immersed point, and at `count` waterlines, at equal distances from its lowest point to the draught; 0
    /// where there is no hull. None when nothing is below the draught.
    #[must_use]
    pub fn of_immersed(hull: &Hull, draught: f64, count: usize) -> Option<Self> {
        let count = count.max(2);
        let low = hull.bottom();
        let share = |k: usize, n: usize| k as f64 / (n - 1) as f64;
        let waterlines: Vec<f64> = (0..count).map(|k| low + (draught - low) * share(k, count)).collect();
        // A bulb may reach beyond the waterline: the ends of all waterlines.
        let ends = (0..ENDS).filter_map(|k| hull.endings(low + (draught - low) * share(k, ENDS)));
        let [aft, fore] = ends.reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])])?;
        if draught <= low || fore <= aft {
            return None;
        }
        let at = |x: f64, z: f64| breadth(hull, x, z).unwrap_or(0.0);
        let stations = (0..count).map(|k| {
            let x = aft + (fore - aft) * share(k, count);
            let half_breadths = waterlines.iter().map(|&z| Cell::from(Some(at(x, z)))).collect();
            StationOffsets { half_breadths, ..StationOffsets::new(k.to_string(), x) }
        });
        let stations = stations.collect();
        Some(Self { name: hull.name().to_owned(), waterlines, stations, ..Self::default() })
    }
}

/// Ends of the waterline at `z` below the deck at side; an end within 1e-12 of L_PP of AP is at AP.
fn ends(hull: &Hull, z: f64) -> [Option<f64>; 2] {
    let slack = 1e-12 * (hull.top() - hull.bottom());
    let dust = 1e-12 * hull.particulars().length_between_perpendiculars;
    let Some(ends) = hull.endings(z) else { return [None; 2] };
    ends.map(|x| (z <= hull.deck_height(x) + slack).then_some(if x.abs() < dust { 0.0 } else { x }))
}

/// A half-breadth of the body |y| <= y(x, z): 0 where the surface is beyond the centreplane.
fn positive(y: f64) -> f64 {
    if y > 0.0 { y } else { 0.0 }
}

fn breadth(hull: &Hull, x: f64, z: f64) -> Option<f64> {
    hull.half_breadth(x, z).map(positive)
}

fn lift(hull: &Hull, station: &OffsetStation, waterlines: &[f64], buttocks: &[f64]) -> StationOffsets {
    let x = station.x;
    let deck = hull.deck_height(x);
    let slack = 1e-12 * (hull.top() - hull.bottom());
    let half_breadths =
        waterlines.iter().map(|&z| Cell::from(if z <= deck + slack { breadth(hull, x, z) } else { None })).collect();
    let keel_height = keel_height(hull, x).filter(|&z| z <= deck + slack);
    let section = hull.section(Cut::Station { x }, 0.0);
    let heights =
        buttocks.iter().map(|&y| Cell::from(if y <= 0.0 { keel_height } else { height_at(&section, y) })).collect();
    let on_deck = keel_height.and_then(|_| breadth(hull, x, deck.min(upper_edge(hull, x))));
    StationOffsets {
        half_breadths,
        heights,
        keel_height,
        flat_of_bottom: keel_point(hull, x).map(|point| positive(point[1])),
        deck_height: on_deck.map(|_| deck),
        deck_half_breadth: on_deck,
        ..StationOffsets::new(station.name.clone(), x)
    }
}

/// The point of the keel line, the lower edge of the surface, at `x`; none beyond its ends.
fn keel_point(hull: &Hull, x: f64) -> Option<[f64; 3]> {
    let v = hull.surface().v().domain().0;
    Some(hull.surface().eval(hull.length_parameter(x, v)?, v))
}

/// Height of the upper edge of the surface at `x`; the top of the hull where it does not reach so far.
fn upper_edge(hull: &Hull, x: f64) -> f64 {
    let v = hull.surface().v().domain().1;
    if hull.is_level() {
        return hull.top();
    }
    hull.length_parameter(x, v).map_or(hull.top(), |u| hull.surface().eval(u, v)[2])
}

/// Height of the lowest point of the surface at `x` \[m\]; none beyond its ends.
#[must_use]
pub fn keel_height(hull: &Hull, x: f64) -> Option<f64> {
    if let Some([_, _, z]) = keel_point(hull, x) {
        return Some(z);
    }
    let (a, b) = hull.surface().u().domain();
    let mut heights: Vec<f64> = Vec::new();
    for u in [a, b] {
        let edge = hull.surface().curve_at_u(u);
        // An upright end is at its x to rounding.
        let rounding = 1e-13 * hull.particulars().length_between_perpendiculars;
        let gap = |p: &[f64; 3]| if u > a { p[0] - x } else { x - p[0] };
        let gaps =
            edge.points().iter().map(gap).map(|g| [if g.abs() <= rounding { f64::MIN_POSITIVE } else { g }]).collect();
        let Ok(gap) = BsplineCurve::new(edge.knots().clone(), gaps) else { continue };
        heights.extend(curve_sign_changes(&gap).into_iter().map(|v| edge.eval(v)[2]));
    }
    heights.into_iter().min_by(f64::total_cmp)
}

/// The lowest height at which the section is `y` wide.
fn height_at(section: &Section, y: f64) -> Option<f64> {
    let mut heights = Vec::new();
    for branch in &section.branches {
        let curve = &branch.curve;
        if branch.face == Face::Side {
            let gaps = curve.points().iter().map(|p| [p[1] - y]).collect();
            let Ok(gap) = BsplineCurve::new(curve.knots().clone(), gaps) else { continue };
            heights.extend(curve_sign_changes(&gap).into_iter().map(|t| curve.eval(t)[2]));
        }
        let points = curve.points();
        let (a, b) = (points[0], points[points.len() - 1]);
        if branch.face != Face::Side && a[1] <= y && y <= b[1] {
            // Lines across.
            heights.push(a[2]);
        }
        // A section that starts as wide as that.
        if (a[1] - y).abs() <= 1e-11 {
            heights.push(a[2]);
        }
    }
    heights.into_iter().min_by(f64::total_cmp)
}

/// The largest of 1, 2, 2.5 and 5 times a power of ten that is not above `value`; the steps of grids.
fn nice_step(value: f64) -> f64 {
    let decade = 10f64.powf(value.log10().floor());
    [5.0, 2.5, 2.0].into_iter().find(|m| m * decade <= value * (1.0 + 1e-9)).unwrap_or(1.0) * decade
}

/// How the stations of a ship are numbered.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct StationNumbers {
    /// Equal spaces between the perpendiculars.
    pub spaces: u32,
    /// Whether 0 is FP and numbers rise aft; else 0 is AP and they rise forward.
    pub from_forward: bool,
}

impl Default for StationNumbers {
    fn default() -> Self {
        Self { spaces: 20, from_forward: false }
    }
}

impl StationNumbers {
    /// Distance of full stations in a length between perpendiculars \[m\].
    #[must_use]
    pub fn spacing(&self, length: f64) -> f64 {
        length / f64::from(self.spaces)
    }

    /// The number of the station that is this many spaces forward of AP.
    #[must_use]
    pub fn number(&self, spaces_from_aft: f64) -> f64 {
        if self.from_forward { f64::from(self.spaces) - spaces_from_aft } else { spaces_from_aft }
    }

    /// Where numbers count from.
    #[must_use]
    pub fn zero(&self) -> &'static str {
        if self.from_forward { "FP" } else { "AP" }
    }
}

/// Default stations: equal spaces between the perpendiculars, half stations in the two spaces at each end, and the extreme
/// ends of the hull where they overhang.
#[must_use]
pub fn default_stations(hull: &Hull, numbers: StationNumbers) -> Vec<OffsetStation> {
    let length = hull.particulars().length_between_perpendiculars;
    let spaces = f64::from(numbers.spaces);
    let halves = [0.5, 1.5, spaces - 1.5, spaces - 0.5];
    let mut stations: Vec<OffsetStation> = (0..=numbers.spaces)
        .map(f64::from)
        .chain(halves)
        .map(|k| OffsetStation { name: format!("{}", numbers.number(k)), x: length * k / spaces })
        .collect();
    let (a, b) = hull.surface().u().domain();
    let ends = |u: f64, fold: fn(f64, f64) -> f64, start: f64| {
        let edge = hull.surface().curve_at_u(u);
        let (from, to) = edge.knots().domain();
        // Extremes of the profile: at its ends or where x'(v) changes sign.
        let turns = coordinate(&edge, 0, 0.0).map(|x| turns(&x)).unwrap_or_default();
        turns.into_iter().chain([from, to]).map(|v| edge.eval(v)[0]).fold(start, fold)
    };
    let (aft, forward) = (ends(a, f64::min, f64::INFINITY), ends(b, f64::max, f64::NEG_INFINITY));
    if aft < -1e-6 * length {
        stations.push(OffsetStation { name: "aft end".to_owned(), x: aft });
    }
    if forward > (1.0 + 1e-6) * length {
        stations.push(OffsetStation { name: "fore end".to_owned(), x: forward });
    }
    stations.sort_by(|p, q| p.x.total_cmp(&q.x));
    stations
}

/// Default waterlines \[m\]: multiples of a step of 1, 2, 2.5 or 5 times a power of ten, at least seven to the design
/// draught, up to the highest point of the deck; half the step in the first space; the bottom and the design draught
/// itself (other lines nearer to it than a fifth of the step are left out). Where no draught is stated, at least seven to
/// [`Hull::reference_height`].
#[must_use]
pub fn default_waterlines(hull: &Hull) -> Vec<f64> {
    let draught = hull.particulars().draught;
    // A hull that hardly draws water has no more lines than one that does.
    let step = nice_step((hull.reference_height() / 7.0).max((hull.top() - hull.bottom()) / 200.0));
    let highest = hull.deck().points().iter().map(|p| p[1]).fold(f64::NEG_INFINITY, f64::max).min(hull.top());
    let bottom = hull.bottom();
    let first = (bottom / step).ceil() as i64;
    let last = ((highest + 1e-9 * step) / step).floor() as i64;
    let mut lines = vec![bottom];
    let mut add = |z: f64| {
        if z > bottom + 0.2 * step
            && z <= highest + 1e-9 * step
            && draught.is_none_or(|draught| (z - draught).abs() > 0.2 * step)
        {
            lines.push(z);
        }
    };
    add((first as f64 + 0.5) * step);
    (first..=last).for_each(|k| add(k as f64 * step));
    lines.extend(draught.filter(|&draught| draught > bottom && draught <= highest));
    lines.sort_by(f64::total_cmp);
    lines.dedup_by(|a, b| (*a - *b).abs() <= 1e-9 * step);
    lines
}

/// Heights of the default diagonals on the centreplane \[m\], and their angle below the horizontal \[rad\]: through 0.7, 1
/// and 1.3 T, as far as that is below D, parallel to the line from there to the bilge, atan(T / (B/2)). Where no draught is
/// stated, through 0.5, 0.7 and 0.9 of [`Hull::reference_height`] in place of T.
#[must_use]
pub fn default_diagonals(hull: &Hull) -> (Vec<f64>, f64) {
    let (p, height) = (hull.particulars(), hull.reference_height());
    let parts = if p.draught.is_some() { [0.7, 1.0, 1.3] } else { [0.5, 0.7, 0.9] };
    let heights = parts.into_iter().map(|part| part * height).filter(|&height| height < p.depth).collect();
    (heights, height.atan2(0.5 * p.breadth))
}

/// Default buttocks \[m\]: multiples of a step of 1, 2, 2.5 or 5 times a power of ten inside the half-breadth, at least
/// four.
#[must_use]
pub fn default_buttocks(hull: &Hull) -> Vec<f64> {
    let half = 0.5 * hull.particulars().breadth;
    let step = nice_step(half / 4.5);
    (1..).map(|k| f64::from(k) * step).take_while(|&y| y < half - 0.2 * step).collect()
}

#[cfg(test)]
mod tests {
    use super::super::PrincipalParticulars;
    use super::*;
    use crate::spline::{BsplineSurface, KnotVector};

    /// y = 4 (1 - (x/50 - 1)^2) (0.25 + 0.75 z / 10) with a stem that rakes 3 m over the height and a flat of bottom.
    fn hull() -> Hull {
        let (u, v) = (KnotVector::uniform(2, 1).unwrap(), KnotVector::uniform(1, 1).unwrap());
        let mut points = Vec::new();
        for (i, breadth) in [0.0, 8.0, 0.0].into_iter().enumerate() {
            for (stem, share, z) in [(100.0, 0.25, 0.0), (103.0, 1.0, 10.0)] {
                points.push([0.5 * stem * i as f64, breadth * share, z]);
            }
        }
        let deck = BsplineCurve::new(KnotVector::uniform(1, 1).unwrap(), vec![[0.0, 9.0], [103.0, 10.0]]).unwrap();
        let particulars =
            PrincipalParticulars { length_between_perpendiculars: 100.0, breadth: 8.0, draught: Some(6.3), depth: 9.0 };
        Hull::new("test", particulars, BsplineSurface::new(u, v, points).unwrap(), deck).unwrap()
    }

    #[test]
    fn beyond_the_centreplane_is_no_hull() {
        let hull = hull();
        let points =
            hull.surface().points().iter().map(|p| [p[0], if p[2] > 0.0 { p[1] } else { -5e-6 }, p[2]]).collect();
        let surface = BsplineSurface::new(hull.surface().u().clone(), hull.surface().v().clone(), points).unwrap();
        let hull = Hull::new("test", *hull.particulars(), surface, hull.deck().clone()).unwrap();
        let table = OffsetTable::from_hull(&hull, &[OffsetStation { name: "5".to_owned(), x: 50.0 }], &[0.0, 5.0], &[]);
        let station = &table.stations[0];
        assert_eq!((station.half_breadths[0].value(), station.flat_of_bottom), (Some(0.0), Some(0.0)));
        assert!(station.half_breadths[1].value().unwrap() > 1.0);
    }

    fn breadth(x: f64, z: f64) -> f64 {
        let a = x / (100.0 + 0.3 * z);
        16.0 * a * (1.0 - a) * (0.25 + 0.075 * z)
    }

    #[test]
    fn offsets_are_the_surface() {
        let hull = hull();
        let table = OffsetTable::with_defaults(&hull);
        assert_eq!(table.stations.len(), 26);
        for column in &table.stations {
            let x = column.station.x;
            for (&z, y) in table.waterlines.iter().zip(column.half_breadths.iter().map(Cell::value)) {
                let inside = x <= 100.0 + 0.3 * z + 1e-12 && z <= 9.0 + x / 103.0 + 1e-12;
                assert_eq!(y.is_some(), inside, "{x} {z}");
                if let Some(y) = y {
                    assert!((y - breadth(x, z)).abs() < 1e-12, "{x} {z} {y}");
                }
            }
            for (&y, z) in table.buttocks.iter().zip(column.heights.iter().map(Cell::value)) {
                match z {
                    Some(z) if z > 0.0 => assert!((breadth(x, z) - y).abs() < 1e-10, "{x} {y} {z}"),
                    Some(_) => assert!(breadth(x, 0.0) >= y),
                    None => assert!(breadth(x, 9.0 + x / 103.0) < y + 1e-9, "{x} {y}"),
                }
            }
            let deck = column.deck_height.unwrap();
            assert!((deck - 9.0 - x / 103.0).abs() < 1e-12);
            assert!((column.deck_half_breadth.unwrap() - breadth(x, deck)).abs() < 1e-12);
            let keel = column.keel_height.unwrap();
            assert!((keel - ((x - 100.0) / 0.3).max(0.0)).abs() < 1e-10, "{x} {keel}");
        }
        let last = &table.stations[25];
        assert_eq!(last.station.name, "fore end");
        assert!((last.station.x - 103.0).abs() < 1e-12);
        for (&z, ends) in table.waterlines.iter().zip(&table.endings) {
            // The deck at side is 9 m high at AP and 10 m at the stem.
            assert_eq!(ends[0], (z <= 9.0).then_some(0.0), "{z}");
            assert!((ends[1].unwrap() - 100.0 - 0.3 * z).abs() < 1e-10);
        }
    }

    #[test]
    fn default_lines_are_round_numbers_and_the_draught() {
        let hull = hull();
        let lines = default_waterlines(&hull);
        let expected = [0.0, 0.25, 0.5, 1.0, 1.5, 2.0, 2.5, 3.0, 3.5, 4.0, 4.5, 5.0, 5.5, 6.0, 6.3, 6.5];
        for (line, expected) in lines.iter().zip(expected) {
            assert!((line - expected).abs() < 1e-12, "{lines:?}");
        }
        assert!((lines[lines.len() - 1] - 10.0).abs() < 1e-12);
        assert_eq!(default_buttocks(&hull).len(), 7);
        assert_eq!(default_stations(&hull, StationNumbers::default())[1].name, "0.5");
        for (value, step) in [(0.9, 0.5), (1.0, 1.0), (2.4, 2.0), (2.6, 2.5), (7.0, 5.0), (30.0, 25.0)] {
            assert!((nice_step(value) - step).abs() < 1e-12, "{value}");
        }
    }
}
