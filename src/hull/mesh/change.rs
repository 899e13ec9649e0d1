//! Changes of the triangles of half a body: an edge is flipped, split or collapsed, a vertex moved.

use super::Region;
use super::body::Site;
use super::half::{Face, Half, doubled};
use crate::spline::{dot, length, minus};

/// Normals of triangles that replace others turn by less than the arc of this cosine.
const TURN: f64 = 0.5;

/// Distances of the middle of an edge from its ends, over its length.
const NEAR: f64 = 0.05;
const FAR: f64 = 0.97;

/// Parts of the way to its goal that a vertex is moved by, the first that serves.
const SHARES: [f64; 3] = [1.0, 0.5, 0.2];

fn along_normal(sum: [f64; 3], normal: [f64; 3]) -> bool {
    dot(sum, normal) > TURN * length(sum) * length(normal)
}

impl Half<'_> {
    /// Whether triangles may stand in place of others: normals as before, and no farther from the surface than allowed
    /// or before.
    fn may_replace(&self, new: &[Face], old: &[Face]) -> bool {
        let sum = |region: Region| {
            let own = old.iter().filter(|face| face.0 == region);
            own.fold([0.0; 3], |sum, face| {
                let normal = doubled(self.corners(face.1));
                [sum[0] + normal[0], sum[1] + normal[1], sum[2] + normal[2]]
            })
        };
        if !new.iter().all(|face| along_normal(sum(face.0), doubled(self.corners(face.1)))) {
            return false;
        }
        // Sides that stay are as far off as before, and new ones are looked at from one of their triangles.
        let stays = |a: usize, b: usize| old.iter().any(|(_, corners)| corners.contains(&a) && corners.contains(&b));
        let off = new.iter().map(|&face| self.off_at(face, |a, b| a < b && !stays(a, b))).fold(0.0, f64::max);
        off <= self.allowed || off <= old.iter().map(|&face| self.off(face)).fold(0.0, f64::max)
    }

    /// Turns the edge a b between two triangles into the other diagonal where that makes their least angle greater.
    pub(super) fn flip(&mut self, a: usize, b: usize) -> bool {
        let ([f, g], count) = self.beside(a, b);
        if count != 2 || self.is_feature(a, b) {
            return false;
        }
        let (Some((forward, c)), Some((_, d))) = (self.third(f, a, b), self.third(g, a, b)) else { return false };
        let (c, d) = if forward { (c, d) } else { (d, c) };
        if c == d || self.beside(c, d).1 > 0 || (self.on_centreplane(c) && self.on_centreplane(d)) {
            return false;
        }
        let (Some(first), Some(second)) = (self.faces[f], self.faces[g]) else { return false };
        let new = [(first.0, [a, d, c]), (first.0, [d, b, c])];
        let before = self.sine(first.1).min(self.sine(second.1));
        let after = self.sine(new[0].1).min(self.sine(new[1].1));
        if after <= before + 1e-6 || !self.may_replace(&new, &[first, second]) {
            return false;
        }
        self.take(f);
        self.take(g);
        new.into_iter().for_each(|face| self.push(face));
        true
    }

    /// A point of the edge a b about halfway, on the surface; none where its parameters give none.
    fn between(&self, a: usize, b: usize) -> Option<([f64; 3], Site)> {
        let ([f, g], count) = self.beside(a, b);
        let region_of = |k: usize| Some(self.faces.get(k).copied().flatten()?.0);
        let mut region = region_of(f)?;
        // Edges of the side are those of the side, whatever face is beyond.
        if [a, b].iter().all(|&v| self.sites[v].region == Region::Hull) && region_of(g) == Some(Region::Hull) {
            region = Region::Hull;
        }
        let on = |v: usize| self.body.site_on(&self.sites[v], region, self.on_centreplane(v));
        let (p, q) = (on(a), on(b));
        let (from, to) = match (p.is_point(), q.is_point()) {
            (true, _) => (p.middle(), q.nearest(p.middle())),
            (_, true) => (p.nearest(q.middle()), q.middle()),
            _ => (p.nearest(q.middle()), q.nearest(p.nearest(q.middle()))),
        };
        let border = count == 1;
        let (mut low, mut high, mut share) = (0.0, 1.0, 0.5);
        let mut found = None;
        for _ in 0..6 {
            let place = [0, 1].map(|k| from[k] + share * (to[k] - from[k]));
            let mut point = self.body.point(region, place);
            if border {
                point[1] = 0.0;
            }
            let [s, t] = [a, b].map(|v| length(minus(point, self.points[v])));
            found = Some((point, Site::at(region, place)));
            if s < 0.6 * t {
                low = share;
            } else if t < 0.6 * s {
                high = share;
            } else {
                break;
            }
            share = 0.5 * (low + high);
        }
        let (point, site) = found?;
        let ends = [a, b].map(|v| length(minus(point, self.points[v])) / self.distance(a, b));
        // Parameters that are no measure of lengths at all.
        if ends.iter().any(|share| !(NEAR..=FAR).contains(share)) {
            return None;
        }
        Some((if border { point } else { self.lifted(point) }, site))
    }

    /// The face that closes the body beside an edge of the side, where it ends at the centreplane: which it is, its
    /// end, and the next vertex on the centreplane.
    fn narrow_end(&self, beside: &[usize], a: usize, b: usize) -> Option<(Region, usize, usize)> {
        let tip = if self.on_centreplane(a) { a } else { b };
        if self.on_centreplane(a) == self.on_centreplane(b) || beside.len() != 2 {
            return None;
        }
        let (region, corners) = beside.iter().filter_map(|&f| self.faces[f]).find(|face| face.0 != Region::Hull)?;
        let next = corners.into_iter().find(|&v| v != a && v != b)?;
        (self.on_centreplane(next) && self.beside(tip, next).1 == 1).then_some((region, tip, next))
    }

    /// Puts a vertex on the edge a b. Where that is an edge of a face that closes the body, which is narrower than the
    /// deviation there, the face ends at the vertex.
    pub(super) fn split(&mut self, a: usize, b: usize) -> Option<usize> {
        let (beside, count) = self.beside(a, b);
        if count > 2 {
            return None;
        }
        let beside = &beside[..count];
        let (mut point, mut site) = self.between(a, b)?;
        if point[1] <= self.deviation
            && let Some((region, tip, next)) = self.narrow_end(beside, a, b)
        {
            let (p, q) = (minus(point, self.points[tip]), minus(self.points[next], self.points[tip]));
            if dot(p, q) >= dot(q, q) {
                let along = |v: usize| self.body.site_on(&self.sites[v], region, self.on_centreplane(v)).middle()[0];
                let place = self.body.edge_place(region, 0.5 * (along(tip) + along(next)));
                (point, site) = (self.body.side(place), Site::at(Region::Hull, place));
            }
            point[1] = 0.0;
        }
        let old: Vec<Face> = beside.iter().filter_map(|&f| self.faces[f]).collect();
        let size = 0.5 * (self.sizes[a] + self.sizes[b]);
        let (p, q) = (self.forms[a], self.forms[b]);
        let form = [0, 1, 2].map(|r| [0, 1, 2].map(|c| 0.5 * (p[r][c] + q[r][c])));
        let middle = self.push_vertex(point, site, size, form);
        let halves = |&(region, corners): &Face| {
            [a, b].map(|from| (region, corners.map(|v| if v == from { middle } else { v })))
        };
        let mut new: Vec<Face> = old.iter().flat_map(halves).collect();
        // The half between the tip and the vertex has no breadth.
        new.retain(|(_, corners)| !corners.iter().all(|&v| self.on_centreplane(v)));
        // Halves that are turned over would fold the mesh.
        let sound = new.iter().all(|half| {
            let whole =
                old.iter().find(|face| face.0 == half.0 && half.1.iter().all(|v| *v == middle || face.1.contains(v)));
            whole.is_some_and(|face| dot(doubled(self.corners(half.1)), doubled(self.corners(face.1))) > 0.0)
        });
        if !sound {
            self.points.pop();
            self.sites.pop();
            self.sizes.pop();
            self.forms.pop();
            self.around.pop();
            return None;
        }
        beside.iter().for_each(|&f| self.take(f));
        new.into_iter().for_each(|face| self.push(face));
        Some(middle)
    }

    /// Distance of a vertex from the line between two others \[m\].
    fn beside_line(&self, v: usize, a: usize, b: usize) -> f64 {
        let (p, q) = (minus(self.points[v], self.points[a]), minus(self.points[b], self.points[a]));
        let squared = dot(q, q);
        let share = if squared > 0.0 { (dot(p, q) / squared).clamp(0.0, 1.0) } else { 0.0 };
        length([0, 1, 2].map(|k| p[k] - share * q[k]))
    }

    /// Whether the foot of a vertex on the line between two others lies between them.
    pub(super) fn is_between(&self, v: usize, a: usize, b: usize) -> bool {
        let (p, q) = (minus(self.points[v], self.points[a]), minus(self.points[b], self.points[a]));
        (0.0..dot(q, q)).contains(&dot(p, q))
    }

    /// Whether the vertex may be taken out along the edge to b, as far as the edges of the body go.
    fn may_leave(&self, a: usize, b: usize) -> bool {
        let features = self.feature_ring(a);
        match features[..] {
            [] => true,
            [p, q] if p == b || q == b => {
                let other = if p == b { q } else { p };
                self.beside_line(a, other, b) <= 0.5 * self.deviation
            }
            // The end of a face that closes the body is narrower than the deviation: it may end farther in.
            [p, q] => {
                let ends = |tip: usize| self.on_centreplane(tip) && self.beside(tip, b).1 == 1;
                self.on_centreplane(b) && self.points[a][1] <= self.deviation && (ends(p) || ends(q))
            }
            _ => false,
        }
    }

    /// Draws vertex a to b where that keeps the mesh a surface, its edges no longer than `longest` of their wanted
    /// lengths, and `better` says so of the least angles at a before and after.
    pub(super) fn collapse(&mut self, a: usize, b: usize, longest: f64, better: impl Fn(f64, f64) -> bool) -> bool {
        let (beside, count) = self.beside(a, b);
        if count == 0 || count > 2 || !self.may_leave(a, b) {
            return false;
        }
        let (ring, other) = (self.ring(a), self.ring(b));
        let opposite = |v: usize| beside[..count].iter().any(|&f| self.faces[f].is_some_and(|(_, c)| c.contains(&v)));
        if ring.iter().any(|v| *v != b && other.contains(v) && !opposite(*v)) {
            return false;
        }
        let border = self.on_centreplane(a);
        for &v in ring.iter().filter(|&&v| v != b && !opposite(v)) {
            let kept = border && self.on_centreplane(v) && self.beside(a, v).1 == 1;
            if self.on_centreplane(b) && self.on_centreplane(v) && !kept {
                return false;
            }
            if self.relative_length(b, v) > longest {
                return false;
            }
        }
        let old: Vec<Face> = self.around[a].iter().filter_map(|&f| self.faces[f]).collect();
        let new: Vec<Face> = old
            .iter()
            .filter(|(_, corners)| !corners.contains(&b))
            .map(|&(region, corners)| (region, corners.map(|v| if v == a { b } else { v })))
            .collect();
        if new.is_empty() {
            return false;
        }
        // A triangle that has all its corners on the centreplane is on both sides.
        if new.iter().any(|(_, corners)| corners.iter().all(|&v| self.on_centreplane(v))) {
            return false;
        }
        let least = |list: &[Face]| list.iter().map(|face| self.sine(face.1)).fold(f64::INFINITY, f64::min);
        if !better(least(&old), least(&new)) || !self.may_replace(&new, &old) {
            return false;
        }
        for f in self.around[a].clone() {
            self.take(f);
        }
        new.into_iter().for_each(|face| self.push(face));
        true
    }

    /// Moves a vertex to where the triangles around it are better, on the surface and on its edge of the body: towards
    /// the middle of its neighbours, or with `each` towards one of them.
    pub(super) fn relax(&mut self, v: usize, each: bool) -> bool {
        if !self.sites[v].is_point() || self.around[v].is_empty() {
            return false;
        }
        let features = self.feature_ring(v);
        let ring = match features[..] {
            [] => self.ring(v),
            [p, q] => vec![p, q],
            _ => return false,
        };
        let own = self.sites[v];
        let place = own.middle();
        let on =
            |other: usize| self.body.site_on(&self.sites[other], own.region, self.on_centreplane(other)).nearest(place);
        if !features.is_empty() {
            // Along a line of the parameters, or not at all.
            let line = (0..2).any(|k| ring.iter().all(|&other| on(other)[k].to_bits() == place[k].to_bits()));
            if !line || ring.iter().any(|&other| self.sites[other].region != own.region) {
                return false;
            }
        }
        let goals: Vec<[f64; 2]> = if each {
            ring.iter().map(|&other| on(other)).collect()
        } else {
            let (mut sum, mut weight) = ([0.0; 2], 0.0);
            for &other in &ring {
                let share = self.distance(v, other);
                let at = on(other);
                sum = [sum[0] + share * at[0], sum[1] + share * at[1]];
                weight += share;
            }
            if weight <= 0.0 {
                return false;
            }
            vec![sum.map(|c| c / weight)]
        };
        let faces: Vec<Face> = self.around[v].iter().filter_map(|&f| self.faces[f]).collect();
        let least = |half: &Self| faces.iter().map(|face| half.sine(face.1)).fold(f64::INFINITY, f64::min);
        let before = least(self);
        let normals: Vec<[f64; 3]> = faces.iter().map(|face| doubled(self.corners(face.1))).collect();
        // Sides opposite to the vertex stay; the others are looked at from one of their triangles.
        let off = |half: &Self| faces.iter().map(|&face| half.off_at(face, |a, _| a == v)).fold(0.0, f64::max);
        let (point, border) = (self.points[v], self.on_centreplane(v));
        let mut old_off = None;
        let tries = goals.into_iter().flat_map(|goal| SHARES.map(|share| (goal, share)));
        for (goal, share) in tries {
            let at = [0, 1].map(|k| place[k] + share * (goal[k] - place[k]));
            let mut new = self.body.point(own.region, at);
            if border {
                new[1] = 0.0;
            } else {
                new = self.lifted(new);
            }
            self.points[v] = new;
            self.sites[v] = Site::at(own.region, at);
            let sound = least(self) > before + 1e-4
                && faces
                    .iter()
                    .zip(&normals)
                    .all(|(face, normal)| along_normal(*normal, doubled(self.corners(face.1))));
            if sound {
                let new_off = off(self);
                if new_off <= self.allowed {
                    return true;
                }
                self.points[v] = point;
                self.sites[v] = own;
                let limit = *old_off.get_or_insert_with(|| off(self));
                if new_off <= limit {
                    self.points[v] = new;
                    self.sites[v] = Site::at(own.region, at);
                    return true;
                }
            }
            self.points[v] = point;
            self.sites[v] = own;
        }
        false
    }
}
