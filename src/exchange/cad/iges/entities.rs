//! The entities of a closed solid: vertices (502), edges (504) on curves (126), and for each face its surface (128),
//! its loop (508) and itself (510); the shell of the faces (514) and the solid (186).

use super::super::real;
use super::colour;
use crate::hull::{Edge, Solid, SolidFace};

/// An entity with its directory.
pub(super) struct Entity {
    pub(super) kind: usize,
    pub(super) form: usize,
    pub(super) colour: usize,
    /// Whether another entity needs it to be.
    pub(super) dependent: bool,
    /// At most eight characters.
    pub(super) label: String,
    /// Its parameters, the number of its kind first.
    pub(super) parameters: Vec<String>,
}

/// Entities in the order of the directory.
struct List {
    entities: Vec<Entity>,
}

impl List {
    /// Adds an entity and returns its directory number.
    fn add(&mut self, kind: usize, form: usize, parameters: Vec<String>) -> usize {
        let all = [vec![kind.to_string()], parameters].concat();
        let dependent = kind != 186;
        self.entities.push(Entity { kind, form, colour: 0, dependent, label: String::new(), parameters: all });
        2 * self.entities.len() - 1
    }
}

/// The numbers of integers, as parameters.
fn whole<const N: usize>(numbers: [usize; N]) -> Vec<String> {
    numbers.iter().map(ToString::to_string).collect()
}

/// Entity 126.
fn curve(edge: &Edge, scale: f64) -> Vec<String> {
    let curve = &edge.curve;
    let (knots, points) = (curve.knots(), curve.points());
    let closed = usize::from(edge.from == edge.to);
    let mut list = whole([points.len() - 1, knots.degree(), 0, closed, 1, 0]);
    list.extend(knots.knots().iter().map(|&knot| real(knot)));
    list.extend(std::iter::repeat_n("1.".to_owned(), points.len()));
    list.extend(points.iter().flatten().map(|&coordinate| real(coordinate * scale)));
    let (a, b) = knots.domain();
    // The normal of a plane curve, which this need not be.
    list.extend([a, b, 0.0, 0.0, 0.0].map(real));
    list
}

/// Entity 128; points run with u fastest.
fn surface(face: &SolidFace, scale: f64) -> Vec<String> {
    let surface = &face.surface;
    let [rows, columns] = surface.shape();
    let (u, v) = (surface.u(), surface.v());
    let mut list = whole([rows - 1, columns - 1, u.degree(), v.degree(), 0, 0, 1, 0, 0]);
    list.extend(u.knots().iter().chain(v.knots()).map(|&knot| real(knot)));
    list.extend(std::iter::repeat_n("1.".to_owned(), rows * columns));
    for j in 0..columns {
        for i in 0..rows {
            list.extend(surface.point(i, j).map(|coordinate| real(coordinate * scale)));
        }
    }
    let ((a, b), (c, d)) = (u.domain(), v.domain());
    list.extend([a, b, c, d].map(real));
    list
}

/// The entities of a solid, its coordinates multiplied by `scale`.
pub(super) fn entities(solid: &Solid, scale: f64) -> Vec<Entity> {
    let mut list = List { entities: Vec::new() };
    let mut vertices = whole([solid.vertices.len()]);
    vertices.extend(solid.vertices.iter().flatten().map(|&coordinate| real(coordinate * scale)));
    let vertices = list.add(502, 1, vertices);
    let curves: Vec<usize> = solid.edges.iter().map(|edge| list.add(126, 0, curve(edge, scale))).collect();
    let mut edges = whole([solid.edges.len()]);
    for (edge, &curve) in solid.edges.iter().zip(&curves) {
        edges.extend(whole([curve, vertices, edge.from + 1, vertices, edge.to + 1]));
    }
    let edges = list.add(504, 1, edges);
    let mut shell = whole([solid.faces.len()]);
    for face in &solid.faces {
        let own = list.add(128, 0, surface(face, scale));
        let mut boundary = whole([face.boundary.len()]);
        for &(edge, along) in &face.boundary {
            // An edge, its sense, and no curves in the parameters.
            boundary.extend(whole([0, edges, edge + 1, usize::from(along), 0]));
        }
        let boundary = list.add(508, 1, boundary);
        let number = list.add(510, 1, whole([own, 1, 1, boundary]));
        if let Some(entity) = list.entities.last_mut() {
            entity.colour = colour(face.region);
            entity.label = face
                .name
                .replace("hull ", "")
                .replace("topsides ", "top ")
                .chars()
                .take(8)
                .collect::<String>()
                .to_uppercase();
        }
        shell.extend(whole([number, 1]));
    }
    let shell = list.add(514, 1, shell);
    list.add(186, 0, whole([shell, 1, 0]));
    list.entities
}
