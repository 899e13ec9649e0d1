//! The scene of the viewer of a report: sides of hulls as grids with curvature, curves of planes, combs; as one JSON
//! object.
//!
//! Port side alone; lengths in metres to a tenth of a millimetre, curvatures to four digits. `midship` is L_PP/2;
//! `full` the Gaussian and mean curvature of the full colours; `hulls` are in the order they were given; each has
//! `name`, `rows` (points of a column), `points` (x, y, z, column by column from aft, keel to deck), `normals` of the surface at
//! them, `gaussian` and `mean` (as long as there are points; 0 where there is no tangent plane), `curves` by kind as lists of x, y, z, and
//! `combs` by kind as `feet` and `teeth`, the tooth in 1/m.

use serde_json::{Value, json};

use crate::fairing::inspect::{Comb, SurfaceMap, combs, kind};
use crate::hull::{Cut, Hull};

/// Points of the grid along and around.
const GRID: [usize; 2] = [121, 33];
/// Teeth of a comb.
const TEETH: usize = 61;
/// Chords leave the curves by at most this part of the breadth.
const DEVIATION: f64 = 1e-4;
/// Share of the grid whose curvature the full colours hold.
const SHARE: f64 = 0.95;

fn rounded(value: f64) -> f64 {
    let value = (1e4 * value).round() / 1e4;
    if value.is_finite() { value + 0.0 } else { 0.0 }
}

/// A normal to a hundred-thousandth, which is finer than reflections show; 0 where there is none.
fn normal(normal: Option<[f64; 3]>) -> [f64; 3] {
    normal.unwrap_or_default().map(|c| if c.is_finite() { (1e5 * c).round() / 1e5 + 0.0 } else { 0.0 })
}

/// Four digits.
fn short(value: f64) -> f64 {
    let text = format!("{value:.3e}");
    text.parse().ok().filter(|v: &f64| v.is_finite()).unwrap_or(0.0)
}

fn flat(points: impl IntoIterator<Item = [f64; 3]>) -> Vec<f64> {
    points.into_iter().flatten().map(rounded).collect()
}

const KINDS: [&str; 4] = ["station", "waterline", "buttock", "diagonal"];

/// The scene of hulls cut by `cuts`; `tolerance` is the departure that can be seen \[m\].
#[must_use]
pub fn scene_json(hulls: &[(&str, &Hull)], cuts: &[Cut], tolerance: f64) -> Value {
    let maps: Vec<SurfaceMap> = hulls.iter().map(|(_, hull)| SurfaceMap::new(hull, GRID[0], GRID[1])).collect();
    // One scale of colours for all.
    let full = [0, 1].map(|which| maps.iter().map(|map| map.size(which, SHARE)).fold(0.0, f64::max));
    let list: Vec<Value> = hulls
        .iter()
        .zip(&maps)
        .map(|((name, hull), map)| {
            let curvature = |which: usize| -> Vec<f64> {
                map.points.iter().map(|p| short(p.curvature.map_or(0.0, |c| c[which]))).collect()
            };
            let found = combs(hull, cuts, TEETH, tolerance);
            let deviation = DEVIATION * hull.particulars().breadth;
            let curves: serde_json::Map<String, Value> =
                KINDS.iter().map(|of| ((*of).to_owned(), json!(curves(hull, cuts, of, deviation)))).collect();
            let teeth: serde_json::Map<String, Value> =
                KINDS.iter().map(|of| ((*of).to_owned(), json!(teeth(&found, of)))).collect();
            json!({
                "name": name,
                "rows": map.rows,
                "points": flat(map.points.iter().map(|p| p.at)),
                "normals": map.points.iter().flat_map(|p| normal(p.normal)).collect::<Vec<_>>(),
                "gaussian": curvature(0),
                "mean": curvature(1),
                "curves": curves,
                "combs": teeth,
            })
        })
        .collect();
    let midship = hulls.first().map_or(0.0, |(_, hull)| 0.5 * hull.particulars().length_between_perpendiculars);
    json!({ "midship": rounded(midship), "full": full.map(short), "hulls": list })
}

fn curves(hull: &Hull, cuts: &[Cut], of: &str, deviation: f64) -> Vec<Vec<f64>> {
    let cuts = cuts.iter().filter(|cut| kind(cut) == of);
    let branches = cuts.flat_map(|cut| hull.section(*cut, 1e-6).branches);
    branches.map(|branch| flat(branch.polyline(deviation))).collect()
}

fn teeth(combs: &[Comb], of: &str) -> Vec<Value> {
    let combs = combs.iter().filter(|comb| kind(&comb.cut) == of);
    combs
        .map(|comb| {
            json!({
                "feet": flat(comb.teeth.iter().map(|tooth| tooth.at)),
                "teeth": comb.teeth.iter().flat_map(|tooth| tooth.tooth).map(short).collect::<Vec<_>>(),
                "rings": flat(comb.inflections.iter().copied()),
            })
        })
        .collect()
}
