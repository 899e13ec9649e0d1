//! Which way the lines of a hull bend: signs of curvature over the surface, and which of their changes are noise.
//!
//! The curvature of a waterline has the sign of x_u y_uu - x_uu y_u, that of a line across of z_v y_vv - z_vv y_v:
//! linear forms of the half-breadths, without approximation. On a rectangular chart they are the second differences of
//! the control net, whose signs bound the sign changes of every waterline and station (variation diminishing, de Boor
//! 2001, chapter XI); on other charts they are taken at the Greville points of the second derivatives.
//!
//! The raw signs of a smoothed net fall into lobes (neighbours of one sign). With s = D c over a lobe and C the
//! posterior covariance sigma^2 N^-1, a lobe whose statistic s'(D C D')^-1 s (Wald 1943) is below the 99.9 % point of
//! chi-square with as many degrees of freedom as it has forms is noise: it takes the sign around it. At each change
//! that remains one form is left free.
//!
//! A flat has signs of noise only: straight parts are found beforehand and kept straight ([`super::breaks`]). Tried
//! without success on a parallel middle body that was not: a price eight times as high (24 to 36 changes of sign
//! instead of 42, but 1.6 times the RMS on S-shaped hulls), a net as dense as the offsets (36), lobes below a hundredth
//! of their line's largest value taken for flat.

use super::model::Row;
use super::smoothing::{Smoothed, Smoother};
use super::surface::{FairSurface, basis_row};
use nalgebra::{DMatrix, DVector};
use std::collections::BTreeMap;

/// Normal deviate of the 99.9 % point.
const DEVIATE: f64 = 3.090_232_306;

/// Lobes with a form this many standard deviations from 0 are real; the joint test is not needed.
const CLEAR: f64 = 7.0;

/// The greatest lobe that is tested jointly; a larger one is judged by its clearest forms.
const JOINT: usize = 160;

/// Linear forms on a grid, with the direction in which their signs may change.
#[derive(Debug, Clone)]
pub struct SignForms {
    /// Forms along u (waterlines) or v (lines across).
    pub along_u: bool,
    /// Numbers of forms in u and v; v runs fastest.
    pub shape: [usize; 2],
    /// The forms over all control values.
    pub rows: Vec<Row>,
}

/// A sign for each form: -1 or 1 where it is imposed, 0 where it is free.
#[derive(Debug, Clone, PartialEq)]
pub struct Pattern {
    /// Signs of all forms after noise is taken out, without free places: -1, 1, or 0 for forms of nothing.
    pub signs: Vec<i8>,
    /// What is imposed.
    pub imposed: Vec<i8>,
    /// Lobes of noise that took the sign around them.
    pub flipped: Vec<Vec<usize>>,
}

/// The forms of waterlines and of lines across.
#[must_use]
pub fn sign_forms(surface: &FairSurface) -> [SignForms; 2] {
    if surface.plain {
        [differences(surface, true), differences(surface, false)]
    } else {
        [sampled(surface, true), sampled(surface, false)]
    }
}

/// Second differences of the net along one direction: coefficients of the second derivative.
fn differences(surface: &FairSurface, along_u: bool) -> SignForms {
    let net = surface.hull.surface();
    let [rows, columns] = net.shape();
    let knots = if along_u { net.u() } else { net.v() };
    let (p, t) = (knots.degree(), knots.knots());
    let count = if along_u { rows } else { columns };
    let mut lines: Vec<[f64; 3]> = Vec::new();
    for i in 0..count.saturating_sub(2) {
        // c'_i = p (c_i+1 - c_i) / (t_i+p+1 - t_i+1); once more with degree p - 1 over the inner knots. Nothing where
        // the support is a point: across a knuckle there is no slope, across a tangent line no second derivative.
        let over = |factor: usize, support: f64| if support > 0.0 { factor as f64 / support } else { 0.0 };
        let first = |k: usize| over(p, t[k + p + 1] - t[k + 1]);
        let second = over(p - 1, t[i + p + 1] - t[i + 2]);
        let (a, b) = (first(i), first(i + 1));
        lines.push([second * a, -second * (a + b), second * b]);
    }
    let shape = if along_u { [lines.len(), columns] } else { [rows, lines.len()] };
    let mut forms = Vec::with_capacity(shape[0] * shape[1]);
    for i in 0..shape[0] {
        for j in 0..shape[1] {
            let line = if along_u { lines[i] } else { lines[j] };
            let place = |k: usize| if along_u { (i + k) * columns + j } else { i * columns + j + k };
            forms.push(normalised((0..3).map(|k| (place(k), line[k])).collect()));
        }
    }
    SignForms { along_u, shape, rows: forms }
}

/// Numerators of curvature at the Greville points of the second derivative along the line, and of the net across it.
fn sampled(surface: &FairSurface, along_u: bool) -> SignForms {
    let net = surface.hull.surface();
    let sites = |knots: &crate::spline::KnotVector, bent: bool| -> Vec<f64> {
        if !bent {
            return knots.greville();
        }
        // One site a control value of the second derivative: means of p - 2 inner knots, kept off the knots themselves.
        let (p, t) = (knots.degree(), knots.knots());
        let inner = &t[2..t.len() - 2];
        let width = (p - 2).max(1);
        let mut sites: Vec<f64> = inner
            .windows(width)
            .skip(1)
            .take(inner.len().saturating_sub(width + 1))
            .map(|w| w.iter().sum::<f64>() / width as f64)
            .collect();
        let breaks = knots.breakpoints();
        sites.extend(breaks.windows(2).map(|w| 0.5 * (w[0] + w[1])));
        sites.sort_by(f64::total_cmp);
        let slack = 1e-9 * (breaks[breaks.len() - 1] - breaks[0]);
        sites.dedup_by(|a, b| (*a - *b).abs() < slack);
        sites
    };
    let (us, vs) = (sites(net.u(), along_u), sites(net.v(), !along_u));
    let mut forms = Vec::with_capacity(us.len() * vs.len());
    for &u in &us {
        for &v in &vs {
            let d = net.derivatives::<3>(u, v);
            let (first, second, ratio) = if along_u {
                ([1, 0], [2, 0], [d[1][0][0], d[2][0][0]])
            } else {
                ([0, 1], [0, 2], [d[0][1][2], d[0][2][2]])
            };
            let bend = basis_row(net, [u, v], second);
            let slope = basis_row(net, [u, v], first);
            let row: Row = bend
                .iter()
                .zip(&slope)
                .map(|((i, b), (_, s))| (*i, ratio[0] * b - ratio[1] * s))
                .filter(|(_, value)| *value != 0.0)
                .collect();
            forms.push(normalised(row));
        }
    }
    SignForms { along_u, shape: [us.len(), vs.len()], rows: forms }
}

fn normalised(mut row: Row) -> Row {
    let size = row.iter().fold(0.0_f64, |size, (_, value)| size.max(value.abs()));
    if size > 0.0 {
        row.iter_mut().for_each(|(_, value)| *value /= size);
    }
    row
}

/// Values of the forms and their standard deviations in units of sigma.
struct Judged {
    values: Vec<f64>,
    deviations: Vec<f64>,
    rows: Vec<Row>,
}

fn judge(forms: &SignForms, smoother: &Smoother, smoothed: &Smoothed) -> Judged {
    let inverse = smoothed.factor.inverse_band();
    let all = smoother.reduced.expand(&smoothed.free);
    let mut judged = Judged { values: Vec::new(), deviations: Vec::new(), rows: Vec::new() };
    for form in &forms.rows {
        let (row, _) = smoother.reduced.row(form);
        let variance = inverse.quadratic_form(row.iter().copied());
        judged.values.push(super::model::value(form, &all));
        judged.deviations.push(variance.max(0.0).sqrt());
        judged.rows.push(row);
    }
    judged
}

/// 99.9 % point of chi-square with k degrees of freedom (Wilson & Hilferty 1931).
pub(super) fn chi_square_limit(k: usize) -> f64 {
    let k = k as f64;
    let c = 2.0 / (9.0 * k);
    k * (1.0 - c + DEVIATE * c.sqrt()).powi(3)
}

/// The signs of a smoothed net with lobes of noise taken out.
#[must_use]
pub fn pattern(forms: &SignForms, smoother: &Smoother, smoothed: &Smoothed, sigma: f64) -> Pattern {
    let judged = judge(forms, smoother, smoothed);
    let count = judged.values.len();
    let scale = judged.values.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
    let raw: Vec<i8> = (0..count)
        .map(|k| match judged.values[k] {
            _ if judged.rows[k].is_empty() || judged.deviations[k] <= 0.0 => 0,
            s if s.abs() <= 1e-12 * scale => 0,
            s if s > 0.0 => 1,
            _ => -1,
        })
        .collect();
    let mut signs = raw.clone();
    let mut flipped = Vec::new();
    let mut real = vec![false; count];
    let mut known: BTreeMap<Vec<usize>, f64> = BTreeMap::new();
    loop {
        let lobes = lobes(&signs, forms.shape);
        let own = |sign: i8| signs.iter().filter(|&&s| s == sign).count();
        let mut weakest: Option<(f64, Vec<usize>)> = None;
        for lobe in lobes {
            if real[lobe[0]] || own(signs[lobe[0]]) == signs.iter().filter(|&&s| s != 0).count() {
                continue;
            }
            // A lobe that took in others is judged by its own forms: those whose raw sign it has.
            let genuine: Vec<usize> = lobe.iter().copied().filter(|&k| raw[k] == signs[k]).collect();
            let ratio = *known.entry(genuine).or_insert_with_key(|genuine| evidence(genuine, &judged, smoothed, sigma));
            if ratio >= 1.0 {
                lobe.iter().for_each(|&k| real[k] = true);
            } else if weakest.as_ref().is_none_or(|(least, _)| ratio < *least) {
                weakest = Some((ratio, lobe));
            }
        }
        let Some((_, lobe)) = weakest else { break };
        let sign = -signs[lobe[0]];
        for &k in &lobe {
            signs[k] = sign;
        }
        // Neighbours that merge with it are judged anew.
        real.iter_mut().for_each(|r| *r = false);
        flipped.push(lobe);
        if flipped.len() > 4 * count {
            break;
        }
    }
    let imposed = freed(&signs, &judged, forms);
    Pattern { signs, imposed, flipped }
}

/// Statistic of a lobe over its limit.
fn evidence(lobe: &[usize], judged: &Judged, smoothed: &Smoothed, sigma: f64) -> f64 {
    let z = |k: usize| judged.values[k].abs() / (sigma * judged.deviations[k]).max(f64::MIN_POSITIVE);
    let clearest = lobe.iter().map(|&k| z(k)).fold(0.0, f64::max);
    if clearest >= CLEAR {
        return clearest / CLEAR * 2.0;
    }
    let mut members = lobe.to_vec();
    if members.len() > JOINT {
        members.sort_by(|&a, &b| z(b).total_cmp(&z(a)));
        members.truncate(JOINT);
    }
    let limit = chi_square_limit(members.len());
    // C over the lobe: columns N^-1 d of its forms.
    let n = smoothed.free.len();
    let m = members.len();
    let mut half = DMatrix::zeros(n, m);
    for (column, &k) in members.iter().enumerate() {
        let mut right = vec![0.0; n];
        judged.rows[k].iter().for_each(|&(i, value)| right[i] += value);
        smoothed.factor.forward(&mut right);
        half.set_column(column, &DVector::from_vec(right));
    }
    let mut covariance = half.tr_mul(&half) * (sigma * sigma);
    let mean = covariance.trace() / m as f64;
    for k in 0..m {
        covariance[(k, k)] += 1e-10 * mean;
    }
    let s = DVector::from_iterator(m, members.iter().map(|&k| judged.values[k]));
    match covariance.cholesky() {
        Some(factor) => s.dot(&factor.solve(&s)) / limit,
        None => clearest * clearest / limit,
    }
}

/// Connected sets of forms of one sign.
fn lobes(signs: &[i8], [rows, columns]: [usize; 2]) -> Vec<Vec<usize>> {
    let mut seen = vec![false; signs.len()];
    let mut lobes = Vec::new();
    for first in 0..signs.len() {
        if seen[first] || signs[first] == 0 {
            continue;
        }
        seen[first] = true;
        let (mut lobe, mut next) = (vec![first], 0);
        while next < lobe.len() {
            let (i, j) = (lobe[next] / columns, lobe[next] % columns);
            next += 1;
            let mut visit = |i: usize, j: usize| {
                let k = i * columns + j;
                if !seen[k] && signs[k] == signs[first] {
                    seen[k] = true;
                    lobe.push(k);
                }
            };
            if i > 0 {
                visit(i - 1, j);
            }
            if i + 1 < rows {
                visit(i + 1, j);
            }
            if j > 0 {
                visit(i, j - 1);
            }
            if j + 1 < columns {
                visit(i, j + 1);
            }
        }
        lobes.push(lobe);
    }
    lobes
}

/// The signs with one free form at each change along the line: of the two beside it the one nearer to 0.
fn freed(signs: &[i8], judged: &Judged, forms: &SignForms) -> Vec<i8> {
    let [rows, columns] = forms.shape;
    let mut imposed = signs.to_vec();
    let z = |k: usize| judged.values[k].abs() / judged.deviations[k].max(f64::MIN_POSITIVE);
    let (lines, length) = if forms.along_u { (columns, rows) } else { (rows, columns) };
    for line in 0..lines {
        let place = |k: usize| if forms.along_u { k * columns + line } else { line * columns + k };
        let mut last: Option<usize> = None;
        for k in (0..length).map(place) {
            if signs[k] == 0 {
                continue;
            }
            if let Some(before) = last
                && signs[before] != signs[k]
            {
                imposed[if z(before) < z(k) { before } else { k }] = 0;
            }
            last = Some(k);
        }
    }
    imposed
}
