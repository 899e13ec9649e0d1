//! Extrusions of an archive: profiles in a plane, moved along a line, with caps.

use super::super::surfaces::whole;
use super::chunks::class;
use super::cursor::{Cursor, Object};
use super::curves::{Budget, Run, interval};
use crate::hull::{Brep, BrepEdge, BrepFace, FaceSurface, Motion};
use crate::spline::{cross, length, minus};

/// How the format calls it.
const KIND: &str = "ON_Extrusion";

/// An extrusion with its profiles in space.
struct Extrusion {
    /// Where the profiles lie: a point of the plane, and its x and y.
    plane: [[f64; 3]; 3],
    profiles: Vec<Run>,
    along: [f64; 3],
    caps: [bool; 2],
}

/// Its fields, with profiles in the plane z = 0; none where they cannot be read, or its ends are cut askew.
fn fields(data: Cursor<'_>, budget: &mut Budget) -> Option<Extrusion> {
    let mut inside = { data }.anonymous()?;
    let [1, minor] = [inside.int()?, inside.int()?] else { return None };
    let profile = inside.object()?;
    let (from, to): ([f64; 3], [f64; 3]) = (inside.reals()?, inside.reals()?);
    let [start, end] = interval(&mut inside)?;
    let up: [f64; 3] = inside.reals()?;
    let has_normal = [inside.flag()?, inside.flag()?];
    let normals: [[f64; 3]; 2] = [inside.reals()?, inside.reals()?];
    let askew = |(has, [x, y, _]): (bool, [f64; 3])| has && x.abs().max(y.abs()) > 0.0;
    if has_normal.into_iter().zip(normals).any(askew) {
        return None;
    }
    // The domain along the path, and whether the parameters are exchanged.
    inside.take(16 + 1)?;
    let count = if minor >= 1 { inside.int()? } else { 1 };
    let profiles = if count > 1 { budget.parts(&profile)? } else { vec![budget.curve(&profile)?] };
    let closed = profiles.iter().all(is_closed);
    let caps = if minor >= 2 { [inside.flag()?, inside.flag()?] } else { [closed; 2] };
    let path = minus(to, from);
    let size = length(path);
    let x = cross(up, path).map(|c| c / size);
    let origin = [0, 1, 2].map(|k: usize| from[k] + start * path[k]);
    let is_sound = size > 0.0 && (closed || caps == [false; 2]);
    let along = path.map(|c| (end - start) * c);
    is_sound.then_some(Extrusion { plane: [origin, x, up], profiles, along, caps })
}

fn is_closed(Run { curve, range: [a, b], .. }: &Run) -> bool {
    let [from, middle, to] = [*a, 0.5 * (a + b), *b].map(|t| curve.point(t));
    length(minus(from, to)) <= 1e-6 * length(minus(from, middle))
}

/// Adds the faces of an extrusion to a body; none where it cannot be read.
pub(super) fn read(object: &Object<'_>, body: &mut Brep, budget: &mut Budget) -> Option<()> {
    if object.class != class::EXTRUSION {
        return None;
    }
    let Extrusion { plane: [origin, x, y], profiles, along, caps } = fields(object.data.inside, budget)?;
    // The third column counts nothing: the profiles lie in z = 0.
    let placed = Motion([0, 1, 2].map(|k| [x[k], y[k], 0.0, origin[k]]));
    let mut rings = [Vec::new(), Vec::new()];
    for Run { curve, range, .. } in profiles {
        let profile = curve.moved(&placed);
        for (ring, share) in rings.iter_mut().zip([0.0, 1.0]) {
            let motion =
                Motion([0, 1, 2].map(|k| {
                    [0, 1, 2, 3].map(|j| if j == 3 { share * along[k] } else { f64::from(u8::from(j == k)) })
                }));
            let curve = profile.moved(&motion);
            let first = body.vertices.len();
            body.vertices.extend(range.map(|t| curve.point(t)));
            ring.push(vec![(body.edges.len(), true)]);
            body.edges.push(BrepEdge { ends: [first, first + 1], curve, range });
        }
        let surface = FaceSurface::Extruded { profile, along };
        whole(&surface, [range, [0.0, 1.0]], KIND, body)?;
    }
    for ((loops, share), has) in rings.into_iter().zip([0.0, 1.0]).zip(caps) {
        if !has {
            continue;
        }
        let origin = [0, 1, 2].map(|k: usize| origin[k] + share * along[k]);
        let (part, left) = (body.faces.len(), Some(share > 0.0));
        let name = format!("cap {}", part + 1);
        body.faces.push(BrepFace {
            name,
            kind: KIND.to_owned(),
            surface: FaceSurface::Plane { origin, x, y },
            loops,
            left,
            part,
        });
    }
    Some(())
}
