//! Linear functionals of the half-breadths, as rows over the net.
//!
//! With S(u, v) = (x(u, v), y(u, v), z(u, v)), J = x_u z_v - x_v z_u and both sides counted,
//!
//! volume = 2 int int y J dv du, moments the same with x or z in the integrand, waterplane area = 2 int y dx on the line
//! z(u, v) = T, section area = 2 int y dz on the line x(u, v) = X.
//!
//! On a level hull, z = z(v), J is x_u z_v, the waterline v = v_T, and the integrands of volume, waterplane and their
//! moments are piecewise polynomials in (u, v): Gauss-Legendre rules that are exact for their degree are used on every
//! span and on the part of the last span below the waterline, so that these rows are exact to rounding. The integrand
//! of a section area is algebraic; see `area`. Where the deck at side is immersed the body ends at the deck, the
//! integrands in u are smooth but no polynomials, and the relative error is about 1e-10. So it is on hulls that are not
//! level where the waterline crosses them; see `charted`.
//!
//! Rows and values come from one enumeration of weights, [`Functional::row`] storing what [`Functional::value`] sums up.

use super::area::section_weights;
use super::charted;
use super::charted::{Arm, Moment};
use super::form::Hull;
use super::immersion::{Immersion, UpperEnd};
use crate::numeric::gauss_legendre;
use crate::spline::{BsplineCurve, MAX_DEGREE};

/// Nodes a piece in u where the body ends at the deck.
const DECK_NODES: usize = 16;

/// A number that is linear in the half-breadths of the net.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Functional {
    /// Displaced volume, both sides [m^3].
    Volume,
    /// First moment of the volume about x = 0 [m^4].
    LongitudinalMoment,
    /// First moment of the volume about z = 0 [m^4].
    VerticalMoment,
    /// Area of the section at `x`, both sides [m^2].
    SectionArea {
        /// Position forward of AP \[m\].
        x: f64,
    },
    /// Waterplane area, both sides [m^2].
    WaterplaneArea,
    /// First moment of the waterplane about x = 0 [m^3].
    WaterplaneMoment,
}

impl Functional {
    /// The row r over the net with value = sum_ij r_ij y_ij, `u` slowest, for the body below `draught` \[m\].
    ///
    /// The row is zero below the lowest line of the hull and for a draught that is not a number. Above the deck it is
    /// that of the whole body closed at the deck, without a waterplane; at the lowest line the waterplane is the flat
    /// of bottom.
    #[must_use]
    pub fn row(&self, hull: &Hull, draught: f64) -> Vec<f64> {
        let columns = hull.surface().shape()[1];
        let mut row = vec![0.0; hull.surface().points().len()];
        self.weights(hull, draught, &mut |i, first, weights| {
            for (target, weight) in row[i * columns + first..].iter_mut().zip(weights) {
                *target += weight;
            }
        });
        row
    }

    /// The value for the hull as it is, below `draught` \[m\].
    #[must_use]
    pub fn value(&self, hull: &Hull, draught: f64) -> f64 {
        let columns = hull.surface().shape()[1];
        let points = hull.surface().points();
        let mut value = 0.0;
        self.weights(hull, draught, &mut |i, first, weights| {
            value += points[i * columns + first..].iter().zip(weights).map(|(p, w)| w * p[1]).sum::<f64>();
        });
        value
    }

    /// Enumerates the weights of the net: `sink(i, j, w)` adds w_k to the weight of the point (i, j + k).
    fn weights(&self, hull: &Hull, draught: f64, sink: &mut dyn FnMut(usize, usize, &[f64])) {
        match *self {
            Self::SectionArea { x } => section_weights(hull, x, draught, sink),
            Self::WaterplaneArea => waterplane_weights(hull, draught, Arm::One, sink),
            Self::WaterplaneMoment => waterplane_weights(hull, draught, Arm::Length, sink),
            Self::Volume => volume_weights(hull, draught, Moment::None, sink),
            Self::LongitudinalMoment => volume_weights(hull, draught, Moment::Length, sink),
            Self::VerticalMoment => volume_weights(hull, draught, Moment::Height, sink),
        }
    }
}

/// A node in v: the basis functions first ..= first + q, z and the weight times z_v.
struct NodeV {
    first: usize,
    basis: [f64; MAX_DEGREE + 1],
    z: f64,
    weight: f64,
}

/// Gauss nodes, `count` a span, of the v below `end`.
fn nodes_below(hull: &Hull, heights: &BsplineCurve<1>, end: f64, count: usize) -> Vec<NodeV> {
    let knots = hull.surface().v();
    let mut nodes = Vec::new();
    for span in knots.spans() {
        let (from, to) = (knots.knots()[span], knots.knots()[span + 1].min(end));
        if to <= from {
            break;
        }
        let first = span - knots.degree();
        let heights = &heights.points()[first..=span];
        for (v, weight) in gauss_legendre(count).on(from, to) {
            let [basis, slopes] = knots.basis_derivatives::<2>(span, v);
            let sum = |row: &[f64]| row.iter().zip(heights).map(|(b, h)| b * h[0]).sum::<f64>();
            nodes.push(NodeV { first, basis, z: sum(&basis), weight: weight * sum(&slopes) });
        }
    }
    nodes
}

fn volume_weights(hull: &Hull, draught: f64, moment: Moment, sink: &mut dyn FnMut(usize, usize, &[f64])) {
    let Some(heights) = hull.heights() else { return charted::volume_weights(hull, draught, moment, sink) };
    let Some(immersion) = Immersion::new(hull, draught) else { return };
    let surface = hull.surface();
    let (knots, p, q) = (surface.u(), surface.u().degree(), surface.v().degree());
    let columns = surface.shape()[1];
    // Degrees 2p - 1 (with x: 3p - 1) in u and 3q - 1 (with x or z: 4q - 1) in v.
    let exact_u = if moment == Moment::Length { (3 * p).div_ceil(2) } else { p };
    let count_v = if moment == Moment::None { (3 * q).div_ceil(2) } else { 2 * q };
    let whole = nodes_below(hull, heights, immersion.waterline(), count_v);
    let (mut x, mut slope, mut line) = (vec![0.0; columns], vec![0.0; columns], vec![0.0; columns]);
    let mut scaled = vec![0.0; columns];
    for piece in immersion.pieces() {
        let count_u = if piece.upper == UpperEnd::Deck { exact_u.max(DECK_NODES) } else { exact_u };
        for (u, weight) in gauss_legendre(count_u).on(piece.from, piece.to) {
            let [basis, slopes] = knots.basis_derivatives::<2>(piece.span, u);
            let first = piece.span - p;
            x.fill(0.0);
            slope.fill(0.0);
            for i in 0..=p {
                let row = &surface.points()[(first + i) * columns..(first + i + 1) * columns];
                for ((x, slope), point) in x.iter_mut().zip(&mut slope).zip(row) {
                    *x += basis[i] * point[0];
                    *slope += slopes[i] * point[0];
                }
            }
            let clipped;
            let nodes = match piece.upper {
                UpperEnd::Waterline => &whole,
                UpperEnd::Deck => {
                    clipped = nodes_below(hull, heights, immersion.end(u), count_v);
                    &clipped
                }
            };
            line.fill(0.0);
            for node in nodes {
                let at = |values: &[f64]| -> f64 {
                    node.basis[..=q].iter().zip(&values[node.first..]).map(|(b, c)| b * c).sum()
                };
                let arm = match moment {
                    Moment::None => 1.0,
                    Moment::Length => at(&x),
                    Moment::Height => node.z,
                };
                let factor = 2.0 * weight * node.weight * at(&slope) * arm;
                for (target, b) in line[node.first..].iter_mut().zip(&node.basis[..=q]) {
                    *target += factor * b;
                }
            }
            for (i, b) in basis[..=p].iter().enumerate() {
                for (target, value) in scaled.iter_mut().zip(&line) {
                    *target = b * value;
                }
                sink(first + i, 0, &scaled);
            }
        }
    }
}

pub(super) fn waterplane_weights(hull: &Hull, draught: f64, arm: Arm, sink: &mut dyn FnMut(usize, usize, &[f64])) {
    if !hull.is_level() {
        return charted::waterplane_weights(hull, draught, arm, sink);
    }
    let Some(immersion) = Immersion::new(hull, draught) else { return };
    if immersion.above() {
        return;
    }
    let surface = hull.surface();
    let (knots, p, q) = (surface.u(), surface.u().degree(), surface.v().degree());
    let v = immersion.waterline();
    let span_v = surface.v().find_span(v);
    let across = surface.v().basis(span_v, v);
    let line = surface.curve_at_v(v);
    // Degrees 2p - 1, with x 3p - 1, with y^2 4p - 1.
    let count = match arm {
        Arm::One => p,
        Arm::Length => (3 * p).div_ceil(2),
        Arm::BreadthSquared => 2 * p,
    };
    let mut scaled = [0.0; MAX_DEGREE + 1];
    for piece in immersion.pieces().iter().filter(|piece| piece.upper == UpperEnd::Waterline) {
        let first = piece.span - p;
        for (u, weight) in gauss_legendre(count).on(piece.from, piece.to) {
            let [basis, slopes] = knots.basis_derivatives::<2>(piece.span, u);
            let points = &line.points()[first..=piece.span];
            let sum = |row: &[f64], axis: usize| row.iter().zip(points).map(|(b, c)| b * c[axis]).sum::<f64>();
            let arm = match arm {
                Arm::One => 1.0,
                Arm::Length => sum(&basis, 0),
                Arm::BreadthSquared => sum(&basis, 1).powi(2),
            };
            let factor = 2.0 * weight * sum(&slopes, 0) * arm;
            for (i, along) in basis[..=p].iter().enumerate() {
                for (target, b) in scaled.iter_mut().zip(&across) {
                    *target = factor * along * b;
                }
                sink(first + i, span_v - q, &scaled[..=q]);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hull::PrincipalParticulars;
    use crate::spline::{BsplineSurface, KnotVector};

    /// A hull with a raked, bulging stem, a raked stern, a flat of bottom, a transom and a deck with sheer.
    fn hull(sheer: f64) -> Hull {
        let u = KnotVector::new(3, vec![0.0, 0.0, 0.0, 0.0, 0.3, 0.5, 0.5, 0.8, 1.0, 1.0, 1.0, 1.0]).unwrap();
        let v = KnotVector::new(3, vec![0.0, 0.0, 0.0, 0.0, 0.4, 0.7, 1.0, 1.0, 1.0, 1.0]).unwrap();
        let (gu, gv) = (u.greville(), v.greville());
        let mut points = Vec::new();
        for &s in &gu {
            for &t in &gv {
                let (stern, stem) = (3.0 - 6.0 * t, 95.0 + 8.0 * (7.0 * t).sin() + 4.0 * t);
                let x = stern + (stem - stern) * (1.0 - (1.0 - s).powi(2)).mul_add(0.6, 0.4 * s);
                let y =
                    8.0 * (1.0 - s * s) * (0.15 + s).min(1.0) * (0.3 + 0.7 * t) + 0.2 * (5.0 * s + 3.0 * t).sin().abs();
                points.push([x, y, 9.0 * t * (0.4 + 0.6 * t)]);
            }
        }
        let deck = BsplineCurve::new(
            KnotVector::new(2, vec![0.0, 0.0, 0.0, 0.6, 1.0, 1.0, 1.0]).unwrap(),
            vec![[-5.0, 9.0 - 0.5 * sheer], [20.0, 9.0 - sheer], [60.0, 9.0 - sheer], [110.0, 9.0]],
        )
        .unwrap();
        let particulars = PrincipalParticulars {
            length_between_perpendiculars: 100.0,
            breadth: 16.0,
            draught: Some(5.0),
            depth: 9.0,
        };
        Hull::new("test", particulars, BsplineSurface::new(u, v, points).unwrap(), deck).unwrap()
    }

    /// Composite Simpson rule with `pieces` intervals.
    fn simpson(from: f64, to: f64, pieces: usize, function: impl Fn(f64) -> f64) -> f64 {
        let step = (to - from) / pieces as f64;
        let end = |k: usize| function(from + step * k as f64);
        let middle = |k: usize| function(from + step * (k as f64 + 0.5));
        (0..pieces).map(|k| (end(k) + 4.0 * middle(k) + end(k + 1)) * step / 6.0).sum()
    }

    const ALL: [Functional; 8] = [
        Functional::Volume,
        Functional::LongitudinalMoment,
        Functional::VerticalMoment,
        Functional::WaterplaneArea,
        Functional::WaterplaneMoment,
        Functional::SectionArea { x: 50.0 },
        Functional::SectionArea { x: 102.0 },
        Functional::SectionArea { x: -1.0 },
    ];

    #[test]
    fn rows_times_the_net_are_the_values() {
        for hull in [hull(0.0), hull(2.0)] {
            for draught in [0.0, 0.7, 3.0, 5.0, 8.0, 9.0, 12.0] {
                for functional in ALL {
                    let row = functional.row(&hull, draught);
                    let product: f64 = row.iter().zip(hull.surface().points()).map(|(r, p)| r * p[1]).sum();
                    let value = functional.value(&hull, draught);
                    assert!(
                        (product - value).abs() <= 1e-13 * value.abs(),
                        "{functional:?} {draught}: {product} {value}"
                    );
                }
            }
        }
    }

    #[test]
    fn values_are_those_of_brute_force() {
        let hull = hull(0.0);
        let surface = hull.surface();
        for draught in [0.9, 3.3, 7.1] {
            let v_end = hull.height_parameter(draught).unwrap();
            let over = |kernel: fn(f64, f64) -> f64| {
                let (us, mut vs) = (surface.u().breakpoints(), surface.v().breakpoints());
                vs.retain(|&v| v < v_end);
                vs.push(v_end);
                let mut sum = 0.0;
                for a in us.windows(2) {
                    for b in vs.windows(2) {
                        sum += simpson(a[0], a[1] - 1e-15, 80, |u| {
                            simpson(b[0], b[1] - 1e-15, 80, |v| {
                                let d = surface.derivatives::<2>(u, v);
                                let [x, y, z] = d[0][0];
                                2.0 * y * d[1][0][0] * d[0][1][2] * kernel(x, z)
                            })
                        });
                    }
                }
                sum
            };
            for (functional, kernel) in [
                (Functional::Volume, (|_, _| 1.0) as fn(f64, f64) -> f64),
                (Functional::LongitudinalMoment, |x, _| x),
                (Functional::VerticalMoment, |_, z| z),
            ] {
                let (value, brute) = (functional.value(&hull, draught), over(kernel));
                assert!((value - brute).abs() < 1e-8 * brute, "{functional:?} {draught}: {value} {brute}");
            }
            let line = |kernel: fn(f64) -> f64| {
                surface
                    .u()
                    .breakpoints()
                    .windows(2)
                    .map(|a| {
                        simpson(a[0], a[1] - 1e-15, 200, |u| {
                            let d = surface.derivatives::<2>(u, v_end);
                            2.0 * d[0][0][1] * d[1][0][0] * kernel(d[0][0][0])
                        })
                    })
                    .sum::<f64>()
            };
            let (area, moment) = (line(|_| 1.0), line(|x| x));
            assert!((Functional::WaterplaneArea.value(&hull, draught) - area).abs() < 1e-9 * area);
            assert!((Functional::WaterplaneMoment.value(&hull, draught) - moment).abs() < 1e-9 * moment);
        }
    }

    #[test]
    fn sections_are_those_of_brute_force() {
        for hull in [hull(0.0), hull(2.0)] {
            for x in [-2.0, -1.0, 2.5, 30.0, 50.0, 77.7, 96.0, 99.0, 102.0, 103.3] {
                for draught in [2.0, 5.0, 8.5, 20.0] {
                    let value = Functional::SectionArea { x }.value(&hull, draught);
                    let top = draught.min(hull.deck_height(x));
                    let brute = simpson(0.0, top, 4_000, |z| 2.0 * hull.half_breadth(x, z).unwrap_or(0.0));
                    assert!((value - brute).abs() < 5e-4 * brute + 4e-3, "{x} {draught}: {value} {brute}");
                }
            }
        }
    }

    #[test]
    fn sections_integrate_to_the_volume() {
        // The sum over x of section areas against the integral over the parameters: two independent routes.
        for (hull, tolerance) in [(hull(0.0), 1e-5), (hull(2.0), 1e-5)] {
            for draught in [1.0, 5.0, 8.5, 20.0] {
                let volume = Functional::Volume.value(&hull, draught);
                let sum = simpson(-4.0, 108.0, 400, |x| Functional::SectionArea { x }.value(&hull, draught));
                assert!((volume - sum).abs() < tolerance * volume, "{draught}: {volume} {sum}");
            }
        }
    }

    #[test]
    fn below_the_keel_and_for_no_number_there_is_nothing() {
        let hull = hull(0.0);
        for draught in [-1.0, f64::NAN, f64::NEG_INFINITY] {
            for functional in ALL {
                assert!(functional.row(&hull, draught).iter().all(|&weight| weight == 0.0));
            }
        }
        assert!(Functional::Volume.value(&hull, 0.0).abs() < 1e-12);
        let flat = simpson(0.0, 1.0, 2000, |u| {
            let d = hull.surface().derivatives::<2>(u, 0.0);
            2.0 * d[0][0][1] * d[1][0][0]
        });
        assert!((Functional::WaterplaneArea.value(&hull, 0.0) - flat).abs() < 1e-6 * flat);
        let whole = Functional::Volume.value(&hull, 9.0);
        assert!((Functional::Volume.value(&hull, f64::INFINITY) - whole).abs() < 1e-12 * whole);
        assert!(Functional::WaterplaneArea.value(&hull, 9.5).abs() < 1e-300);
    }
}
