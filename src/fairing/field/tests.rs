//! The field against closed forms, dense matrices and quadrature.

use super::super::lines::LineCourse;
use super::bent::Bent;
use super::chart::{Chart, Shape};
use super::density::Density;
use super::likelihood::{Cell, Observed, Readings, Roughness, smoothed};
use super::line_errors::LineErrors;
use super::net::{Break, KERNEL, Metric, Net};
use super::observed::{End, Observations};
use super::region::{Bend, Field};
use super::surface::ChartedField;
use crate::hull::{self, OffsetTable, StationOffsets};
use crate::spline::{BsplineCurve, KnotVector, binomial};
use nalgebra::{DMatrix, SymmetricEigen};

const METRIC: Metric = Metric { anisotropy: 1.4, mixed: 0.3 };

fn chart() -> Chart {
    Chart { length: [0.0, 100.0], height: [0.0, 10.0], shape: Shape { keel: 0.1, ends: [0.25, 0.5] } }
}

/// A tangent line, and a knuckle beside a line of the net.
fn breaks() -> Vec<Break> {
    vec![Break { at: 0.3, order: 2, charge: 0.1 }, Break { at: 0.7, order: 1, charge: 0.01 }]
}

/// A smooth field on a net of 12 x 8 spans.
fn wavy() -> (Net, Vec<f64>) {
    field_on(Net::uniform([12, 8], [11.0, 7.0]).unwrap())
}

fn field_on(net: Net) -> (Net, Vec<f64>) {
    let value = |u: f64, v: f64| 8.0 * ((3.3 * u - 0.3).sin() + 0.4 * v * (2.0 * v + 5.0 * u).cos());
    let values = straight(&net).interpolated(value).unwrap();
    (net, values)
}

/// The chart of a net that is not bent.
fn straight(net: &Net) -> Bent {
    let bend = Bend::new([&net.knots[0], &net.knots[1]], |_| [0.0, 1.0]).unwrap();
    let closed = [vec![false; net.shape()[1]], vec![false; net.shape()[1]]];
    let (knots, breaks) = (net.knots.clone(), net.breaks.clone());
    Bent { chart: chart(), bend, knots, corners: Vec::new(), breaks, closed, keel_closed: false }
}

#[test]
fn the_chart_inverts_itself() {
    let chart = chart();
    for k in 0..=50 {
        let t = f64::from(k) / 50.0;
        assert!((chart.u(chart.x(t)) - t).abs() < 1e-13, "{t}");
        assert!((chart.v(chart.z(t)) - t).abs() < 1e-13, "{t}");
    }
    // h'(0) = 1 - c0, h'(1) = 1 - c1, dz/dv at the keel b H.
    assert!((chart.x_slope(0.0) - 75.0).abs() < 1e-12 && (chart.x_slope(1.0) - 50.0).abs() < 1e-12);
    assert!((chart.z_slope(0.0) - 1.0).abs() < 1e-12);
}

/// The grounded determinant differs from the product of the eigenvalues that are not zero by a constant of the net.
#[test]
fn the_grounded_determinant_is_the_pseudo_determinant() {
    let net = Net::uniform([6, 5], [5.0, 4.0]).unwrap();
    let difference = |anisotropy: f64, mixed: f64| {
        let energy = net.energy(Metric { anisotropy, mixed }, None);
        let n = energy.size();
        let dense = DMatrix::from_fn(n, n, |i, j| energy.get(i, j));
        let mut eigenvalues: Vec<f64> = SymmetricEigen::new(dense).eigenvalues.iter().copied().collect();
        eigenvalues.sort_by(f64::total_cmp);
        assert!(eigenvalues[KERNEL - 1].abs() < 1e-6 && eigenvalues[KERNEL] > 1e-3, "{:?}", &eigenvalues[..=KERNEL]);
        let product: f64 = eigenvalues[KERNEL..].iter().map(|e| e.ln()).sum();
        product - net.log_determinant(&energy).unwrap()
    };
    let first = difference(1.0, 1.0);
    for (anisotropy, mixed) in [(0.35, 1.0), (2.8, 1.0), (1.4, 0.03)] {
        assert!((difference(anisotropy, mixed) - first).abs() < 1e-6, "{anisotropy} {mixed}");
    }
}

/// On a net of many spans the energies of long waves are below the rounding of those of short ones. The determinant is as
/// smooth over log a there as on a coarser net.
#[test]
fn a_net_of_many_spans_has_a_determinant_in_every_metric() {
    let determinant = |spans: [usize; 2], anisotropy: f64| {
        let net = Net::uniform(spans, [16.0, 36.0]).unwrap();
        net.log_determinant(&net.energy(Metric { anisotropy, mixed: 1.0 }, None)).unwrap()
    };
    for spans in [[17, 37], [26, 56]] {
        let values: Vec<f64> = [1.0, 2.0, 4.0, 8.0].map(|a| determinant(spans, a)).to_vec();
        let third = values[3] - 3.0 * values[2] + 3.0 * values[1] - values[0];
        let range = values.iter().fold(f64::MIN, |m, v| m.max(*v)) - values.iter().fold(f64::MAX, |m, v| m.min(*v));
        assert!(third.abs() < 0.1 * range, "{spans:?}: {values:?}");
    }
}

/// The restricted likelihood of a net and a weight, and the same from the dense A, but for one constant of the table. Where
/// waterlines have errors in common their covariance is V = I + q L L'.
fn likelihoods(net: &Net, weights: [f64; 2], ratio: Option<f64>) -> Vec<[f64; 2]> {
    let chart = chart();
    let cells: Vec<Cell> = (0..40)
        .map(|k| {
            let (x, z) = (97.0 * f64::from(k % 8) / 7.0 + 1.0, 9.0 * f64::from(k / 8) / 4.0 + 0.4);
            Cell {
                x,
                z,
                y: 5.0 + (0.07 * x).sin() + 0.3 * z + 0.01 * f64::from(k * k % 7),
                scale: 1.0 + 0.1 * f64::from(k % 3),
            }
        })
        .collect();
    let rough = Roughness::new(net, METRIC, None).unwrap();
    let lines = LineErrors::of(LineCourse::Waterline, &cells, |cell| [cell.x, cell.z]).unwrap();
    assert_eq!(lines.lines.len(), 5);
    let common = ratio.map(|ratio| LineErrors { ratio, ..lines });
    let readings = Readings { cells: cells.clone(), inside: Vec::new(), common };
    let observed = Observed::new(net, &chart, &readings);
    let n = cells.len();
    let rows = DMatrix::from_fn(n, net.size(), |i, j| {
        let row = net.row([chart.u(cells[i].x), chart.v(cells[i].z)]);
        row.iter().find(|(column, _)| *column == j).map_or(0.0, |(_, b)| b / cells[i].scale)
    });
    let y = DMatrix::from_fn(n, 1, |i, _| cells[i].y / cells[i].scale);
    let energy = DMatrix::from_fn(net.size(), net.size(), |i, j| rough.matrix.get(i, j));
    let q = ratio.unwrap_or(0.0);
    let along = |i: usize| 2.0 * (cells[i].x - 1.0) / 97.0 - 1.0;
    let shared = |i: usize, j: usize| if i / 8 == j / 8 { q * (1.0 + along(i) * along(j)) } else { 0.0 };
    let own = |i: usize, j: usize| if i == j { 1.0 } else { 0.0 };
    let covariance = DMatrix::from_fn(n, n, |i, j| own(i, j) + shared(i, j) / (cells[i].scale * cells[j].scale));
    let inverse_of = covariance.try_inverse().unwrap();
    let dense = |weight: f64| {
        let weighed = &inverse_of * &rows;
        let inverse = (rows.transpose() * &weighed + &energy * weight).try_inverse().unwrap();
        let a = &inverse_of - &weighed * inverse * weighed.transpose();
        let left = (y.transpose() * &a * &y)[(0, 0)];
        let mut eigenvalues: Vec<f64> = SymmetricEigen::new(a).eigenvalues.iter().copied().collect();
        eigenvalues.sort_by(f64::total_cmp);
        let determinant: f64 = eigenvalues[KERNEL..].iter().map(|e| e.ln()).sum();
        let freedom = (n - KERNEL) as f64;
        freedom * (left / freedom).ln() + freedom - determinant
    };
    let ours = |weight: f64| smoothed(&observed, &rough, weight, 1e-12).unwrap().cost;
    weights.map(|weight| [ours(weight), dense(weight)]).to_vec()
}

/// Weights, nets with and without breaks, and errors that waterlines have in common are compared by the likelihood that dense matrices have.
#[test]
fn the_likelihood_is_that_of_the_dense_matrices() {
    let nets = [Vec::new(), breaks()].map(|breaks| Net::broken([5, 4], [4.0, 3.0], breaks).unwrap());
    let ratios = [None, Some(0.3), Some(30.0)];
    let cases = nets.iter().flat_map(|net| ratios.map(|ratio| (net, ratio)));
    let found: Vec<[f64; 2]> = cases.flat_map(|(net, ratio)| likelihoods(net, [1e-3, 1e-1], ratio)).collect();
    let constant = found[0][0] - found[0][1];
    assert!(found.iter().all(|[ours, dense]| (ours - dense - constant).abs() < 1e-5), "{found:?}");
}

#[test]
fn a_chart_that_is_not_bent_has_the_energy_of_the_net() {
    for breaks in [Vec::new(), breaks()] {
        let (net, mut values) = field_on(Net::broken([12, 8], [11.0, 7.0], breaks).unwrap());
        // What jumps.
        let columns = net.shape()[1];
        values
            .iter_mut()
            .enumerate()
            .for_each(|(k, value)| *value += 0.01 * ((k % columns) * (k % columns) % 7) as f64);
        let bent = straight(&net);
        assert!(bent.bend.is_straight());
        let (own, of_net) =
            (bent.energy(&net, METRIC, None).quadratic(&values), net.energy(METRIC, None).quadratic(&values));
        assert!((own - of_net).abs() < 1e-7 * of_net, "{own} {of_net}");
    }
}

/// Jumps of a break are those of the derivatives on its sides, and a polynomial has none.
#[test]
fn the_jumps_of_a_break_are_those_of_the_derivatives() {
    let net = Net::broken([6, 8], [5.0, 7.0], breaks()).unwrap();
    let knots = &net.knots[1];
    let control: Vec<f64> = (0..knots.basis_count()).map(|k| (k * k % 5) as f64).collect();
    let curve = BsplineCurve::new(knots.clone(), control.iter().map(|&c| [c]).collect()).unwrap();
    let greville = knots.greville();
    for line in breaks() {
        let (first, rows) = line.jumps(knots);
        for (order, row) in (line.order..).zip(&rows) {
            let jump: f64 = row.iter().zip(&control[first..]).map(|(a, c)| a * c).sum();
            let h = 1e-9;
            let [below, above] = [-h, h].map(|h| curve.derivatives::<4>(line.at + h)[order][0]);
            assert!((jump - (above - below)).abs() < 1e-4 * (1.0 + jump.abs()), "{order}: {jump} {}", above - below);
            // The control values of t are the Greville places.
            let none: f64 = row.iter().zip(&greville[first..]).map(|(a, t)| a * t).sum();
            assert!(none.abs() < 1e-9 * row.iter().map(|a| a.abs()).sum::<f64>(), "{order}: {none}");
        }
    }
}

/// A section of a straight side above an arc has its tangent line found to a fifth of a waterline's spacing, and a
/// parabolic hull has none.
#[test]
fn the_upper_end_of_a_bilge_is_found() {
    let mut table = wigley();
    let radius = 2.2;
    for station in &mut table.stations {
        let t = station.station.x / 50.0 - 1.0;
        let breadth = 5.0 * (1.0 - t * t);
        for (cell, z) in station.half_breadths.iter_mut().zip(&table.waterlines) {
            let arc = radius - (radius * radius - (radius - z).max(0.0).powi(2)).sqrt();
            *cell = hull::Cell::from(Some(breadth * (1.0 - 0.45 * arc)));
        }
    }
    let found = ChartedField::new(&Observations::new(&table), [21, 11], 0.0).unwrap();
    assert!(found.lines.iter().any(|line| (line.z - radius).abs() < 0.125), "{:?}", found.lines);
    let none = ChartedField::new(&Observations::new(&wigley()), [21, 11], 0.0).unwrap();
    assert_eq!(none.lines, []);
}

/// A bent chart holds the field to its resolution, and its energy is that of the field within the hull, by a midpoint rule.
#[test]
fn a_bent_chart_has_the_energy_of_the_field_within_the_hull() {
    let metric = Metric { mixed: 1.0, ..METRIC };
    let (net, values) = wavy();
    let chart = chart();
    let field = Field::new(chart, &net, &values).unwrap();
    let ends = |v: f64| [0.04 + 0.03 * (1.0 - v * v), 1.0 - 0.05 * (1.0 - v)];
    let knots = [KnotVector::uniform(5, 36).unwrap(), KnotVector::uniform(5, 16).unwrap()];
    let bend = Bend::new([&knots[0], &knots[1]], ends).unwrap();
    let closed = [vec![false; knots[1].basis_count()], vec![false; knots[1].basis_count()]];
    let bent = Bent { chart, bend, knots, corners: Vec::new(), breaks: Vec::new(), closed, keel_closed: false };
    let y = bent.half_breadths(&field).unwrap();
    let energy = bent.energy(&net, metric, None).quadratic(&y);
    let (mut sum, [rows, columns]) = (0.0, [600, 300]);
    for j in 0..columns {
        let v = (f64::from(j) + 0.5) / f64::from(columns);
        let [from, to] = [bent.bend.u(0.0, v), bent.bend.u(1.0, v)];
        for i in 0..rows {
            let u = (f64::from(i) + 0.5) / f64::from(rows);
            if u < from || u > to {
                continue;
            }
            let spans = [net.knots[0].find_span(u), net.knots[1].find_span(v)];
            let along = net.knots[0].basis_derivatives::<5>(spans[0], u);
            let up = net.knots[1].basis_derivatives::<5>(spans[1], v);
            for k in 0..=4usize {
                let mut value = 0.0;
                for r in 0..6 {
                    for s in 0..6 {
                        let at = (spans[0] - 5 + r) * net.shape()[1] + spans[1] - 5 + s;
                        value += along[4 - k][r] * up[k][s] * values[at];
                    }
                }
                let factor = binomial(4, k) * metric.factor(k);
                let counts = 11f64.powi(1 - 2 * (4 - k as i32)) * 7f64.powi(1 - 2 * k as i32);
                sum += factor * counts * value * value / f64::from(rows * columns);
            }
        }
    }
    assert!((energy - sum).abs() < 0.15 * sum, "{energy} {sum}");
}

/// A table of y = (1 - t^2)(1 - s^2) B/2 with zeros at the perpendiculars and on the keel.
fn wigley() -> OffsetTable {
    let (length, depth) = (100.0, 6.25);
    let mut table = OffsetTable {
        waterlines: (0..11).map(|j| depth * f64::from(j) / 10.0).collect(),
        endings: vec![[None; 2]; 11],
        ..OffsetTable::default()
    };
    for i in 0..21 {
        let t = f64::from(i) / 10.0 - 1.0;
        let mut station = StationOffsets::new(i.to_string(), 0.5 * length * (t + 1.0));
        let value = |z: &f64| 5.0 * (1.0 - t * t) * (1.0 - (1.0 - z / depth).powi(2));
        station.half_breadths = table.waterlines.iter().map(|z| hull::Cell::from(Some(value(z)))).collect();
        table.stations.push(station);
    }
    table
}

#[test]
fn ends_at_perpendiculars_are_exact() {
    let mut seen = Observations::new(&wigley());
    let are_shared = |ends: [End; 2]| matches!(ends, [End::Zero { shared: true, .. }, End::Zero { shared: true, .. }]);
    assert!(seen.waterlines.iter().all(|line| are_shared(line.ends)));
    seen.settle(&seen.zeros());
    assert!(seen.keel_closed);
    assert_eq!(seen.extent, [[0.0, 100.0], [0.0, 6.25]]);
    assert_eq!(seen.waterlines.len(), 10);
    assert!(seen.waterlines.iter().all(|line| line.ends == [End::Closed(0.0), End::Closed(100.0)]));
}

/// The parabolic hull comes back to a tenth of a millimetre between its offsets, with its ends.
#[test]
fn a_parabolic_hull_comes_back() {
    let seen = Observations::new(&wigley());
    let found = ChartedField::new(&seen, [21, 11], 0.0).unwrap();
    let (field, chart) = (&found.field, found.chosen.chart);
    for (x, z) in [(37.0, 1.7), (50.0, 6.0), (8.0, 3.3), (91.0, 2.4)] {
        let (t, s): (f64, f64) = (x / 50.0 - 1.0, 1.0 - z / 6.25);
        let exact = 5.0 * (1.0 - t * t) * (1.0 - s * s);
        let y = field.at([chart.u(x), chart.v(z)]);
        assert!((y - exact).abs() < 1e-4, "{x} {z}: {y} {exact}");
    }
    assert!(found.bent.bend.is_straight() && found.bent.corners.is_empty());
}

/// Where the chart bends over the whole length of the hull, its net misses a field between the knots; halves of
/// its spans miss it by less than a tenth as much.
#[test]
fn spans_that_miss_the_field_are_halved() {
    let (net, values) = wavy();
    let field = Field::new(chart(), &net, &values).unwrap();
    let end = |v: f64| [0.25 * (1.0 - v).powi(2), 1.0];
    let knots = [KnotVector::uniform(5, 48).unwrap(), net.knots[1].clone()];
    let bend = Bend::new([&knots[0], &knots[1]], end).unwrap();
    let open = Bent { bend, knots, ..straight(&net) };
    let misses = |bent: &Bent, most: f64| bent.unresolved(&field, most).unwrap();
    assert!(misses(&straight(&net), 1e-9).is_empty());
    let tried: Vec<f64> = (2..12).map(|k| 0.1f64.powi(k)).collect();
    let most = *tried.iter().rfind(|most| misses(&open, **most).is_empty()).unwrap();
    let halves = misses(&open, 0.1 * most);
    assert!(!halves.is_empty() && halves.iter().all(|v| (v * 16.0 - (v * 16.0).round()).abs() < 1e-12), "{halves:?}");
    let refined = open.refined(&[1, 3, 5, 7, 9, 11, 13, 15].map(|k| f64::from(k) / 16.0)).unwrap();
    assert!(misses(&refined, 0.2 * most).is_empty(), "{most}");
    assert_eq!(refined.knots[1].basis_count(), net.knots[1].basis_count() + 8);
}

/// The energy with a density is that of the net times it where it is nearly constant, and a field that bends in one place has
/// its density there.
#[test]
fn a_density_is_low_where_a_field_bends() {
    let (net, values) = wavy();
    // Wider than the hull, a mean is alike everywhere.
    let density = Density::of(&net, METRIC, &values, 1e3);
    assert!((density.at([0.2, 0.9]) - 1.0).abs() < 1e-3);
    let [alike, own] = [Some(&density), None].map(|density| net.energy(METRIC, density).quadratic(&values));
    assert!((alike / own - 1.0).abs() < 1e-3, "{alike} {own}");
    let bump =
        |u: f64, v: f64| (-80.0 * ((u - 0.3).powi(2) + (v - 0.6).powi(2))).exp() + 1e-3 * (4.0 * u + 3.0 * v).sin();
    let bumped = straight(&net).interpolated(bump).unwrap();
    let density = Density::of(&net, METRIC, &bumped, 1.0);
    assert!(density.at([0.3, 0.6]) < 1e-2 && density.at([0.9, 0.1]) > 10.0);
}

/// A keel above the base and ends that neighbouring waterlines share are readings where the offsets agree.
#[test]
fn zeros_beside_the_hull_are_left_out_where_the_offsets_say_so() {
    let mut table = wigley();
    let ends = |table: &OffsetTable| {
        let found = ChartedField::new(&Observations::new(table), [21, 11], 0.0).unwrap();
        let [aft, forward] = [0, 1].map(|side| found.bent.bend.ends[side].eval(0.8)[0]);
        [found.chosen.chart.x(aft), found.chosen.chart.x(forward)]
    };
    let [aft, forward] = ends(&table);
    assert!(aft.abs() < 1e-9 && (forward - 100.0).abs() < 1e-9, "{aft} {forward}");
    // The last station stands 3 m beyond the stem, with its zeros.
    table.stations[20].station.x = 103.0;
    let [aft, forward] = ends(&table);
    assert!(aft.abs() < 1e-9 && (forward - 100.0).abs() < 0.02, "{aft} {forward}");
}
