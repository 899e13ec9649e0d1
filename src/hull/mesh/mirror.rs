//! Half a mesh and its mirror image as one.

use super::body::Site;
use super::half::{Face, Half, least_sine};
use super::{HullMesh, LEAST_ANGLE, Region, SharpCorner};

/// Places to which a vertex of the centreplane may be moved.
const TRIES: usize = 12;

/// Triangles across the centreplane in place of a pair that meets there: their corners, by vertex and side.
type Across = [[(usize, usize); 3]; 2];

impl Half<'_> {
    /// The corners of a triangle of a face that closes the body, from the side that it has on the centreplane on.
    fn at_centreplane(&self, (region, corners): Face) -> Option<[usize; 3]> {
        let side = |k: usize| self.on_centreplane(corners[k]) && self.on_centreplane(corners[(k + 1) % 3]);
        let k = (0..3).find(|&k| region != Region::Hull && side(k))?;
        Some([0, 1, 2].map(|j| corners[(k + j) % 3]))
    }

    /// The least sine of the two triangles that stand across the centreplane in place of one and its image.
    fn across_sine(&self, [a, b, c]: [usize; 3]) -> f64 {
        let [x, y, z] = self.points[c];
        let sine = |v: usize| least_sine([self.points[v], [x, -y, z], [x, y, z]]).0;
        if self.is_between(c, a, b) { sine(a).min(sine(b)) } else { 0.0 }
    }

    /// What a triangle at the centreplane becomes with its image, where the other diagonal of the two is the better one.
    fn across(&self, face: Face) -> Option<Across> {
        let [a, b, c] = self.at_centreplane(face)?;
        let sine = self.sine(face.1);
        // The other side runs from b to a.
        (sine < LEAST_ANGLE.sin() && self.across_sine([a, b, c]) > sine)
            .then_some([[(a, 0), (c, 1), (c, 0)], [(b, 0), (c, 0), (c, 1)]])
    }

    /// Moves vertices along the centreplane to where the triangles of a narrow end of a face can be made across it.
    pub(super) fn open_ends(&mut self) {
        for f in 0..self.faces.len() {
            let Some(face) = self.faces[f] else { continue };
            let Some([a, b, c]) = self.at_centreplane(face) else { continue };
            let (sine, at) = least_sine(self.corners(face.1));
            let bound = LEAST_ANGLE.sin();
            let tip = face.1[at];
            if sine >= bound || tip == c || self.across_sine([a, b, c]) >= bound {
                continue;
            }
            let moved = if tip == a { b } else { a };
            let next = match self.feature_ring(moved)[..] {
                [p, q] if p == tip => q,
                [p, q] if q == tip => p,
                _ => continue,
            };
            let along = |v: usize| self.body.site_on(&self.sites[v], face.0, self.on_centreplane(v)).middle()[0];
            let (from, to) = (along(c), along(next));
            let (old_point, old_site) = (self.points[moved], self.sites[moved]);
            let others: Vec<Face> =
                self.around[moved].iter().filter(|&&g| g != f).filter_map(|&g| self.faces[g]).collect();
            let mut best = (bound, None);
            for k in 1..TRIES {
                let place = [from + (to - from) * k as f64 / TRIES as f64, 0.0];
                let [x, _, z] = self.body.point(face.0, place);
                self.points[moved] = [x, 0.0, z];
                let turned = self.is_between(moved, tip, next);
                let least = others.iter().map(|face| self.sine(face.1)).fold(self.across_sine([a, b, c]), f64::min);
                if turned && least > best.0 {
                    best = (least, Some((self.points[moved], Site::at(face.0, place))));
                }
            }
            (self.points[moved], self.sites[moved]) = best.1.unwrap_or((old_point, old_site));
        }
    }
}

/// The whole of a mesh of which the half to port is given, vertices on the centreplane once.
pub(super) fn whole(half: &Half) -> HullMesh {
    let mut mesh = HullMesh::default();
    let mut places = vec![[usize::MAX; 2]; half.points.len()];
    for &(_, corners) in half.faces.iter().flatten() {
        for v in corners {
            if places[v][0] == usize::MAX {
                let [x, y, z] = half.points[v];
                mesh.vertices.push([x, y, z]);
                places[v] = [mesh.vertices.len() - 1; 2];
                if y > 0.0 {
                    mesh.vertices.push([x, -y, z]);
                    places[v][1] = mesh.vertices.len() - 1;
                }
            }
        }
    }
    for wanted in Region::ALL {
        for (f, face) in half.faces.iter().enumerate() {
            let Some((region, corners)) = *face else { continue };
            if region != wanted {
                continue;
            }
            let [a, b, c] = corners;
            let pair = half.across((region, corners));
            match pair {
                Some(pair) => {
                    mesh.triangles.extend(pair.map(|t| (region, t.map(|(v, side)| places[v][side]))));
                }
                None => {
                    mesh.triangles.push((region, [places[a][0], places[b][0], places[c][0]]));
                    mesh.triangles.push((region, [places[a][1], places[c][1], places[b][1]]));
                }
            }
            let (sine, at) = least_sine(half.corners(corners));
            let v = corners[at];
            if sine < LEAST_ANGLE.sin()
                && let Some(angle) = half.sharp_corner(f, v)
                && angle < LEAST_ANGLE
            {
                for side in if half.on_centreplane(v) { 0..1 } else { 0..2 } {
                    mesh.sharp_corners.push(SharpCorner { vertex: places[v][side], region, angle });
                }
            }
        }
    }
    mesh
}
