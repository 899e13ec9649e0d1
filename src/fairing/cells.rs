//! The cells of a net and the lines between them: bases at Gauss nodes, and sums of squares over them.
//!
//! Everything is measured in parameters that run from 0 to 1. What is summed are combinations of partial derivatives of
//! the half-breadth,
//!
//! ```text
//! sum_st c_st d^(s+t) y / du^s dv^t,
//! ```
//!
//! with s and t the orders along the ship and up.

use crate::numeric::{SymmetricBand, gauss_legendre};
use crate::spline::{BsplineSurface, KnotVector, MAX_DEGREE};

/// Orders of derivatives, 0 to 3.
pub(super) const ORDERS: usize = 4;

/// Functions of one direction that live on a span at most.
const LOCAL: usize = MAX_DEGREE + 1;

/// Factors c_st of partial derivatives.
pub(super) type Combination = [[f64; ORDERS]; ORDERS];

/// A linear form of the control values: the index of each, and its factor.
pub(super) type Row = Vec<(usize, f64)>;

/// Values and derivatives of the basis functions of a span at one place.
struct Node {
    weight: f64,
    basis: [[f64; LOCAL]; ORDERS],
}

impl Node {
    fn new(knots: &KnotVector, span: usize, at: f64, weight: f64) -> Self {
        let length = knots.domain().1 - knots.domain().0;
        let mut basis = knots.basis_derivatives::<ORDERS>(span, at);
        let mut scale = 1.0;
        for row in &mut basis {
            row.iter_mut().for_each(|value| *value *= scale);
            scale *= length;
        }
        Self { weight: weight / length, basis }
    }
}

/// A line of a cubic net inside its domain that leaves one continuous derivative.
pub(super) struct Jump {
    /// Its parameter, of the domain.
    pub(super) at: f64,
    /// Index of the span above it.
    pub(super) above: usize,
    /// First control value of the rows.
    first: usize,
    /// The value, the first derivative, and the jump of the second.
    rows: [Vec<f64>; 3],
    /// Mean length of the spans beside it.
    length: f64,
}

/// A line of a net inside its domain that leaves no continuous derivative.
pub(super) struct Fold {
    /// Its parameter, of the domain.
    pub(super) at: f64,
    /// Index of the span above it.
    pub(super) above: usize,
    /// At the line from below and from above, of weight 1.
    sides: [Node; 2],
    /// Lengths of the spans beside it.
    pub(super) lengths: [f64; 2],
}

/// One direction of the net.
struct Spans {
    /// Gauss nodes of each span.
    nodes: Vec<Vec<Node>>,
    lengths: Vec<f64>,
    /// First basis function on each span.
    first: Vec<usize>,
    jumps: Vec<Jump>,
    folds: Vec<Fold>,
    degree: usize,
}

impl Spans {
    fn new(knots: &KnotVector) -> Self {
        let breaks = knots.breakpoints();
        let (from, to) = knots.domain();
        let degree = knots.degree();
        let rule = gauss_legendre(degree + 1);
        let spans: Vec<usize> = breaks.windows(2).map(|w| knots.find_span(0.5 * (w[0] + w[1]))).collect();
        let lengths: Vec<f64> = breaks.windows(2).map(|w| (w[1] - w[0]) / (to - from)).collect();
        let nodes = breaks.windows(2).zip(&spans).map(|(w, &span)| {
            let nodes = rule.on(w[0], w[1]).map(|(t, weight)| Node::new(knots, span, t, weight));
            nodes.collect()
        });
        let nodes = nodes.collect();
        let inside = (1..spans.len()).filter(|&f| degree == 3 && knots.multiplicity(breaks[f]) == degree - 1);
        let jumps = inside.map(|above| {
            let first = spans[above - 1] - degree;
            let mut rows = [0, 1, 2].map(|_| vec![0.0; spans[above] - first + 1]);
            for (span, sign) in [(spans[above - 1], -1.0), (spans[above], 1.0)] {
                let node = Node::new(knots, span, breaks[above], 0.0);
                for k in 0..=degree {
                    let place = span - degree - first + k;
                    rows[0][place] = node.basis[0][k];
                    rows[1][place] = node.basis[1][k];
                    rows[2][place] += sign * node.basis[2][k];
                }
            }
            Jump {
                at: (breaks[above] - from) / (to - from),
                above,
                first,
                rows,
                length: 0.5 * (lengths[above - 1] + lengths[above]),
            }
        });
        let jumps = jumps.collect();
        let folds = (1..spans.len()).filter(|&f| knots.multiplicity(breaks[f]) >= degree).map(|above| Fold {
            at: (breaks[above] - from) / (to - from),
            above,
            sides: [spans[above - 1], spans[above]].map(|span| Node::new(knots, span, breaks[above], to - from)),
            lengths: [lengths[above - 1], lengths[above]],
        });
        let folds = folds.collect();
        Self { nodes, jumps, folds, first: spans.iter().map(|span| span - degree).collect(), lengths, degree }
    }

    /// How far apart control values of one row may be.
    fn reach(&self) -> usize {
        let least = if self.folds.is_empty() { self.degree } else { 2 * self.degree };
        self.jumps.iter().map(|jump| jump.rows[0].len() - 1).fold(least, usize::max)
    }
}

/// The cells of a net.
pub(super) struct Cells<'a> {
    surface: &'a BsplineSurface<3>,
    spans: [Spans; 2],
}

/// A Gauss node of a cell.
pub(super) struct Place<'c> {
    nodes: [&'c Node; 2],
    degrees: [usize; 2],
    first: [usize; 2],
    columns: usize,
    /// Its weight of the integral over the unit square.
    pub(super) weight: f64,
    /// The point of the surface and its derivatives by order along the ship, order up, and axis \[m\].
    pub(super) derivatives: [[[f64; 3]; ORDERS]; ORDERS],
}

impl Place<'_> {
    /// The value of a combination for the surface itself.
    pub(super) fn value(&self, factors: &Combination) -> f64 {
        let pairs = factors.iter().flatten().zip(self.derivatives.iter().flatten());
        pairs.map(|(factor, point)| factor * point[1]).sum()
    }

    /// The combination as a form of the control values, written to `row`.
    pub(super) fn form(&self, factors: &Combination, row: &mut Row) {
        let [u, v] = self.nodes;
        row.clear();
        for i in 0..=self.degrees[0] {
            let mut along = [0.0; ORDERS];
            for (s, line) in factors.iter().enumerate() {
                along.iter_mut().zip(line).for_each(|(sum, factor)| *sum += factor * u.basis[s][i]);
            }
            for j in 0..=self.degrees[1] {
                let value = along.iter().zip(&v.basis).map(|(factor, basis)| factor * basis[j]).sum();
                row.push(((self.first[0] + i) * self.columns + self.first[1] + j, value));
            }
        }
    }
}

/// A node on a line across which the second derivative may jump; t is the parameter that crosses the line, s the other.
pub(super) struct Crossing<'c> {
    jump: &'c Jump,
    node: &'c Node,
    degree: usize,
    first: usize,
    /// Steps in the list of control values from one to the next in t and in s.
    steps: [usize; 2],
    /// Its weight of the integral along the line, and the mean length of the spans beside the line.
    pub(super) weight: f64,
    pub(super) length: f64,
    /// d/ds, d/dt and the jump of d^2/dt^2 of the surface there \[m\].
    pub(super) by_s: [f64; 3],
    pub(super) by_t: [f64; 3],
    pub(super) jumped: [f64; 3],
}

impl Crossing<'_> {
    /// Calls `each` with the index of every control value, and its factors of d/ds, d/dt and the jump.
    fn factors(&self, mut each: impl FnMut(usize, [f64; 3])) {
        let [value, slope, second] = &self.jump.rows;
        for i in 0..value.len() {
            for j in 0..=self.degree {
                let [basis, derivative] = [self.node.basis[0][j], self.node.basis[1][j]];
                let place = (self.jump.first + i) * self.steps[0] + (self.first + j) * self.steps[1];
                each(place, [value[i] * derivative, slope[i] * basis, second[i] * basis]);
            }
        }
    }

    /// factors[0] dy/ds + factors[1] dy/dt + factors[2] times the jump, for the surface itself.
    pub(super) fn value(&self, factors: [f64; 3]) -> f64 {
        factors[0] * self.by_s[1] + factors[1] * self.by_t[1] + factors[2] * self.jumped[1]
    }

    /// The same as a form of the control values, written to `row`.
    pub(super) fn form(&self, factors: [f64; 3], row: &mut Row) {
        row.clear();
        self.factors(|place, own| row.push((place, (0..3).map(|k| factors[k] * own[k]).sum())));
        row.sort_unstable_by_key(|entry| entry.0);
    }
}

impl<'a> Cells<'a> {
    pub(super) fn new(surface: &'a BsplineSurface<3>) -> Self {
        Self { surface, spans: [Spans::new(surface.u()), Spans::new(surface.v())] }
    }

    /// The surface.
    pub(super) fn surface(&self) -> &'a BsplineSurface<3> {
        self.surface
    }

    /// How many cells there are along the ship and up.
    pub(super) fn count(&self) -> [usize; 2] {
        [0, 1].map(|k: usize| self.spans[k].lengths.len())
    }

    /// Every cell, up the ship first.
    pub(super) fn all(&self) -> impl Iterator<Item = [usize; 2]> + use<> {
        let [rows, columns] = self.count();
        (0..rows).flat_map(move |e| (0..columns).map(move |f| [e, f]))
    }

    /// The area of a cell, of the unit square.
    pub(super) fn area(&self, [e, f]: [usize; 2]) -> f64 {
        self.spans[0].lengths[e] * self.spans[1].lengths[f]
    }

    /// Points of span e of a line of the net, below the span `above` across it, and of the far edges of the cells beside
    /// it, at its ends \[m\].
    pub(super) fn corners(&self, way: usize, above: usize, e: usize) -> [[f64; 3]; 6] {
        let knots = [self.surface.u(), self.surface.v()];
        let (across, along) = (knots[way].breakpoints(), knots[1 - way].breakpoints());
        let at = |t: f64, s: f64| if way == 0 { self.surface.eval(t, s) } else { self.surface.eval(s, t) };
        std::array::from_fn(|k| at(across[above - 1 + k / 2], along[e + k % 2]))
    }

    /// The greatest half-breadth of the net \[m\].
    pub(super) fn greatest_half_breadth(&self) -> f64 {
        self.surface.points().iter().map(|point| point[1]).fold(0.0, f64::max)
    }

    /// A form of zeros into which every row of this net fits.
    pub(super) fn zeros(&self) -> SymmetricBand {
        let [rows, columns] = self.surface.shape();
        SymmetricBand::zeros(rows * columns, self.spans[0].reach() * columns + self.spans[1].reach())
    }

    /// The Gauss nodes of a cell.
    pub(super) fn places(&self, [e, f]: [usize; 2]) -> impl Iterator<Item = Place<'_>> {
        let nodes = self.spans[0].nodes[e].iter().flat_map(move |u| self.spans[1].nodes[f].iter().map(move |v| [u, v]));
        nodes.map(move |nodes| self.place([e, f], nodes))
    }

    fn place<'c>(&'c self, [e, f]: [usize; 2], nodes: [&'c Node; 2]) -> Place<'c> {
        let [u, v] = &self.spans;
        let first = [u.first[e], v.first[f]];
        let mut derivatives = [[[0.0; 3]; ORDERS]; ORDERS];
        for i in 0..=u.degree {
            // Derivatives by v along one line of control points.
            let mut line = [[0.0; 3]; ORDERS];
            for j in 0..=v.degree {
                let point = self.surface.point(first[0] + i, first[1] + j);
                for (sum, basis) in line.iter_mut().zip(&nodes[1].basis) {
                    (0..3).for_each(|axis| sum[axis] += basis[j] * point[axis]);
                }
            }
            for (sums, basis) in derivatives.iter_mut().zip(&nodes[0].basis) {
                for (sum, line) in sums.iter_mut().zip(&line) {
                    (0..3).for_each(|axis| sum[axis] += basis[i] * line[axis]);
                }
            }
        }
        let [rows, columns] = [u.degree, v.degree];
        let weight = nodes[0].weight * nodes[1].weight;
        Place { nodes, degrees: [rows, columns], first, columns: self.surface.shape()[1], weight, derivatives }
    }

    /// The lines across which the second derivative along the ship (`way` 0) or up (1) may jump.
    pub(super) fn jumps(&self, way: usize) -> &[Jump] {
        &self.spans[way].jumps
    }

    /// The lines across which the slope along the ship (`way` 0) or up (1) may jump.
    pub(super) fn folds(&self, way: usize) -> &[Fold] {
        &self.spans[way].folds
    }

    /// The Gauss nodes of span e of a line of [`Self::folds`], from below and from above.
    pub(super) fn sides<'c>(&'c self, way: usize, fold: &'c Fold, e: usize) -> impl Iterator<Item = [Place<'c>; 2]> {
        let other = &self.spans[1 - way];
        other.nodes[e].iter().map(move |node| {
            [0, 1].map(|side: usize| {
                let (across, end) = (fold.above - 1 + side, &fold.sides[side]);
                if way == 0 { self.place([across, e], [end, node]) } else { self.place([e, across], [node, end]) }
            })
        })
    }

    /// The Gauss nodes of span e of a line of [`Self::jumps`].
    pub(super) fn crossings<'c>(&'c self, way: usize, jump: &'c Jump, e: usize) -> impl Iterator<Item = Crossing<'c>> {
        let other = &self.spans[1 - way];
        let columns = self.surface.shape()[1];
        let steps = if way == 0 { [columns, 1] } else { [1, columns] };
        other.nodes[e].iter().map(move |node| {
            let zero = [0.0; 3];
            let mut found = Crossing {
                jump,
                node,
                degree: other.degree,
                first: other.first[e],
                steps,
                weight: node.weight,
                length: jump.length,
                by_s: zero,
                by_t: zero,
                jumped: zero,
            };
            let mut sums = [zero; 3];
            found.factors(|place, factors| {
                for (sum, factor) in sums.iter_mut().zip(factors) {
                    (0..3).for_each(|axis| sum[axis] += factor * self.surface.points()[place][axis]);
                }
            });
            [found.by_s, found.by_t, found.jumped] = sums;
            found
        })
    }
}

/// The sum of a combination on one side of a line and one on the other as a form of the control values.
pub(super) fn both(factors: &[Combination; 2], sides: &[Place<'_>; 2]) -> Row {
    let (mut all, mut other) = (Row::new(), Row::new());
    sides[0].form(&factors[0], &mut all);
    sides[1].form(&factors[1], &mut other);
    all.append(&mut other);
    all.sort_unstable_by_key(|entry| entry.0);
    all.dedup_by(|next, kept| {
        let same = next.0 == kept.0;
        if same {
            kept.1 += next.1;
        }
        same
    });
    all
}

/// Adds weight times the square of a form; the indices of the row rise.
pub(super) fn add_square(energy: &mut SymmetricBand, weight: f64, row: &[(usize, f64)]) {
    for (k, &(i, left)) in row.iter().enumerate() {
        let left = weight * left;
        if left != 0.0 {
            row[..=k].iter().for_each(|&(j, right)| energy.add(i, j, left * right));
        }
    }
}
