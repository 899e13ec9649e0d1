//! Midship section, largest section and parallel middle body at each of many draughts.
//!
//! Areas A(x) below every draught, and their slopes dA/dx = 2 int (y_u z_v - y_v z_u) / x_u dv (where z = z(v), 2 int
//! (y_u / x_u) z_v dv), are taken at stations shared by all draughts: the knots in u on the highest line, midship, the
//! ends of the hull, and both sides of every corner that a transom or a flat bow gives to A(x). Between stations A(x)
//! is Hermite's cubic; where it may rise above the largest area so found, the root of dA/dx is found from exact areas
//! and slopes.
//!
//! Accuracy: A_M and A_X are exact to rounding (relative 1e-12) where A(x) is smooth. The place of the largest section
//! is known to 1e-7 of L_PP where A(x) has a smooth maximum with a curvature of at least A / L_PP^2, to 1e-6 where the
//! deck is immersed, and exactly at ends. The ends of the parallel middle body are the places where A(x) passes (1 -
//! 1e-6) A_X, known to 1e-6 of L_PP. A second maximum between two stations that neither slopes nor cubics show is not
//! seen.

use super::expansion::Expansion;
use super::piece::StationSpan;
use super::station::Stations;
use crate::hull::{Hull, Immersion};

/// Sections equal to the largest one within this relative difference belong to the parallel middle body.
pub(super) const PARALLEL_TOLERANCE: f64 = 1e-6;

/// Shortest parallel middle body, as a part of L_PP.
pub(super) const PARALLEL_LENGTH: f64 = 0.01;

/// Two areas are equal when they differ by less than this, relative to the larger one.
const ROUNDING: f64 = 1e-13;

/// Shared stations at least over the length.
const STATIONS: usize = 20;

/// Distance of the two sides of a corner, as a part of the length.
const CORNER: f64 = 1e-9;

/// Part of an area by which a cubic between stations may be wrong where it alone shows a maximum.
const INTERPOLATION: f64 = 1e-4;

/// Part of an area by which such a maximum rises above the stations beside it.
const RISE: f64 = 1e-7;

/// Sections below one draught.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Sections {
    /// Area of the section at L_PP / 2 [m^2].
    pub(super) midship: f64,
    /// Largest section area [m^2].
    pub(super) largest: f64,
    /// Its place \[m\].
    pub(super) place: Option<f64>,
    /// Ends of the parallel middle body \[m\].
    pub(super) parallel: Option<[f64; 2]>,
}

/// Area and slope of the areas at one place.
#[derive(Debug, Clone, Copy)]
struct Sample {
    x: f64,
    area: f64,
    slope: f64,
}

/// Hermite's cubic between two samples, in s from 0 to 1.
struct Cubic {
    from: f64,
    width: f64,
    coefficients: [f64; 4],
}

impl Cubic {
    fn new(a: &Sample, b: &Sample) -> Self {
        let width = b.x - a.x;
        let (rise, start, end) = (b.area - a.area, width * a.slope, width * b.slope);
        Self {
            from: a.x,
            width,
            coefficients: [a.area, start, 3.0 * rise - 2.0 * start - end, start + end - 2.0 * rise],
        }
    }

    fn value(&self, x: f64) -> f64 {
        let s = (x - self.from) / self.width;
        let [c0, c1, c2, c3] = self.coefficients;
        c0 + s * (c1 + s * (c2 + s * c3))
    }

    fn bend(&self, x: f64) -> f64 {
        let s = (x - self.from) / self.width;
        (2.0 * self.coefficients[2] + 6.0 * s * self.coefficients[3]) / (self.width * self.width)
    }

    /// The maximum within the interval.
    fn maximum(&self) -> Option<f64> {
        let [_, c1, c2, c3] = self.coefficients;
        // c1 + 2 c2 s + 3 c3 s^2 = 0 with a negative second derivative.
        let discriminant = c2 * c2 - 3.0 * c1 * c3;
        if discriminant <= 0.0 {
            return None;
        }
        let root = discriminant.sqrt();
        let s = if c2 <= 0.0 { c1 / (root - c2) } else { -(c2 + root) / (3.0 * c3) };
        (s > 0.0 && s < 1.0).then_some(self.from + s * self.width)
    }
}

/// What is the same for every draught.
struct Table<'a, const N: usize> {
    stations: &'a Stations<'a, N>,
    /// Places of the shared stations, rising.
    places: Vec<f64>,
    /// L_PP \[m\].
    length: f64,
}

/// Areas along a station shared by all draughts.
struct Shared {
    x: f64,
    expansion: Expansion<2>,
    ends: Vec<[f64; 2]>,
}

/// The sections below each immersion.
pub(super) fn sections<const N: usize>(stations: &Stations<N>, immersions: &[Option<Immersion>]) -> Vec<Sections> {
    let highest = immersions.iter().flatten().map(Immersion::waterline).fold(f64::NEG_INFINITY, f64::max);
    let table = Table::new(stations);
    let shared: Vec<Shared> = table.places.iter().map(|&x| table.share(x, highest)).collect();
    immersions.iter().map(|i| i.as_ref().map_or_else(Sections::default, |i| table.below(i, &shared))).collect()
}

impl<'a, const N: usize> Table<'a, N> {
    fn new(stations: &'a Stations<'a, N>) -> Self {
        let hull = stations.hull;
        let length = hull.particulars().length_between_perpendiculars;
        Self { stations, places: places(hull, length), length }
    }

    fn share(&self, x: f64, highest: f64) -> Shared {
        let mut pieces = self.stations.pieces(x, highest);
        pieces.retain(|piece| matches!(piece.place, StationSpan::Inside(_)));
        let mut at = (f64::NAN, 0.0);
        let expansion = self.stations.expansion(&pieces, false, self.stations.size, |piece, node| {
            if at.0.to_bits() != piece.from.to_bits() {
                at = (piece.from, piece.start);
            }
            self.stations.point(x, piece, node, &mut at.1).areas()
        });
        Shared { x, expansion, ends: self.stations.ends(x, highest) }
    }

    /// Exact area and slope at `x` below `immersion`.
    fn exact(&self, x: f64, immersion: &Immersion) -> Sample {
        let end = immersion.section_end(x);
        let mut pieces = self.stations.pieces(x, end);
        pieces.retain(|piece| matches!(piece.place, StationSpan::Inside(_)));
        let mut at = (f64::NAN, 0.0);
        let [area, slope] = self.stations.integral(&pieces, |piece, node| {
            if at.0.to_bits() != piece.from.to_bits() {
                at = (piece.from, piece.start);
            }
            self.stations.point(x, piece, node, &mut at.1).areas()
        });
        let ends: f64 = self.stations.ends(x, end).iter().map(|end| end[1]).sum();
        Sample { x, area, slope: slope + ends + self.stations.edges(x, end) + self.deck(x, end, immersion) }
    }

    fn sample(&self, shared: &Shared, immersion: &Immersion) -> Sample {
        let (x, end) = (shared.x, immersion.section_end(shared.x));
        if end <= shared.expansion.first_end() {
            return self.exact(x, immersion);
        }
        let [area, slope] = shared.expansion.up_to(end);
        let ends: f64 = shared.ends.iter().filter(|e| e[0] < end).map(|e| e[1]).sum();
        Sample { x, area, slope: slope + ends + self.stations.edges(x, end) + self.deck(x, end, immersion) }
    }

    /// What the rise of the deck adds to the slope of the areas where the section ends at the deck.
    fn deck(&self, x: f64, end: f64, immersion: &Immersion) -> f64 {
        if !immersion.deck_immersed() || end >= immersion.waterline() {
            return 0.0;
        }
        if !self.stations.hull.is_level() && self.stations.hull.deck_height(x) >= immersion.draught() {
            return 0.0;
        }
        let (hull, step) = (self.stations.hull, 1e-5 * self.length);
        let rise = (hull.deck_height(x + step) - hull.deck_height(x - step)) / (2.0 * step);
        hull.length_parameter(x, end).map_or(0.0, |u| 2.0 * hull.surface().eval(u, end)[1] * rise)
    }

    fn below(&self, immersion: &Immersion, shared: &[Shared]) -> Sections {
        let middle = 0.5 * self.length;
        let midship = self.exact(middle, immersion);
        let mut samples: Vec<Sample> = shared
            .iter()
            .map(|s| if s.x.to_bits() == middle.to_bits() { midship } else { self.sample(s, immersion) })
            .collect();
        let mut best = midship;
        let take = |sample: Sample, best: &mut Sample| {
            if sample.area > best.area * (1.0 + ROUNDING) {
                *best = sample;
            }
        };
        samples.iter().for_each(|&sample| take(sample, &mut best));
        for x in self.corners(immersion) {
            let next = samples.partition_point(|sample| sample.x < x);
            let near = samples[next.saturating_sub(1)..samples.len().min(next + 1)].iter();
            if near.clone().all(|sample| (sample.x - x).abs() > CORNER * self.length)
                && near.map(|sample| sample.area).fold(0.0, f64::max) > 0.5 * best.area
            {
                samples.insert(next, self.exact(x, immersion));
                take(samples[next], &mut best);
            }
        }
        if best.area <= 0.0 {
            return Sections { midship: midship.area.max(0.0), ..Sections::default() };
        }
        // Maxima between samples whose slopes have the same sign.
        let mut k = 0;
        while k + 1 < samples.len() {
            let (a, b) = (samples[k], samples[k + 1]);
            k += 1;
            if b.x - a.x <= 1e-3 * self.length || (a.slope > 0.0 && b.slope < 0.0) {
                continue;
            }
            let cubic = Cubic::new(&a, &b);
            let Some(x) = cubic.maximum() else { continue };
            let value = cubic.value(x);
            if value > best.area * (1.0 - INTERPOLATION) && value > a.area.max(b.area) + RISE * best.area {
                samples.insert(k, self.exact(x, immersion));
                take(samples[k], &mut best);
            }
        }
        // Maxima between samples where the slope passes zero; those that may be highest first.
        let mut intervals: Vec<(f64, usize)> =
            samples.windows(2).enumerate().filter_map(|(k, w)| Some((self.bound(&w[0], &w[1])?, k))).collect();
        intervals.sort_by(|a, b| b.0.total_cmp(&a.0));
        for (bound, k) in intervals {
            if bound > best.area * (1.0 + ROUNDING) {
                let top = self.climb(samples[k], samples[k + 1], immersion);
                take(top, &mut best);
            }
        }
        let parallel = self.parallel(&samples, &best, immersion);
        let place = parallel.map_or(best.x, |[aft, fore]| 0.5 * (aft + fore));
        Sections { midship: midship.area, largest: best.area, place: Some(place), parallel }
    }

    /// What A(x) can reach between samples where its slope passes zero from above, when it is concave there.
    fn bound(&self, a: &Sample, b: &Sample) -> Option<f64> {
        let width = b.x - a.x;
        let flat = ROUNDING * a.area.max(b.area);
        if a.slope * width <= flat || -b.slope * width <= flat || width <= CORNER * self.length {
            return None;
        }
        let share = (b.area - a.area - b.slope * width) / ((a.slope - b.slope) * width);
        let reach = if (0.0..=1.0).contains(&share) { share } else { 1.0 };
        Some(a.area.max(b.area).max(a.area + a.slope * width * reach))
    }

    /// The maximum between samples where the slope passes zero from above: Newton's method on the slope with curvatures
    /// from the cubic and then from secants, inside a bracket that bisection keeps.
    fn climb(&self, a: Sample, b: Sample, immersion: &Immersion) -> Sample {
        let cubic = Cubic::new(&a, &b);
        let whole = b.x - a.x;
        let mut best = if a.area > b.area { a } else { b };
        let (mut low, mut high) = (a, b);
        let mut x = cubic.maximum().unwrap_or(0.5 * (a.x + b.x));
        let mut last: Option<Sample> = None;
        for _ in 0..60 {
            let now = self.exact(x, immersion);
            if now.area > best.area {
                best = now;
            }
            if now.slope > 0.0 {
                low = now;
            } else {
                high = now;
            }
            let (bend, apart) = match last {
                Some(last) => ((now.slope - last.slope) / (now.x - last.x), (now.x - last.x).abs()),
                None => (cubic.bend(x), 1e-2 * whole),
            };
            let step = -now.slope / bend;
            let next = x + step;
            let inside = bend < 0.0 && next > low.x && next < high.x;
            // The error after a step of a secant is about the product of this step and the last one.
            if inside && step.abs() * apart <= 1e-8 * whole * whole && step.abs() <= 1e-3 * whole {
                let area = now.area + 0.5 * now.slope * step;
                return Sample { x: next, area: area.max(best.area), slope: 0.0 };
            }
            if now.slope.abs() * whole <= ROUNDING * now.area || high.x - low.x <= 1e-12 * self.length {
                return best;
            }
            // A secant that does not halve the bracket is followed by bisection.
            let poor = last.is_some_and(|last| now.slope.abs() > 0.5 * last.slope.abs());
            x = if inside && !poor { next } else { 0.5 * (low.x + high.x) };
            last = Some(now);
        }
        best
    }

    /// Places below `immersion` where the areas have a corner: the ends of a raked transom or flat bow at the waterline.
    fn corners(&self, immersion: &Immersion) -> Vec<f64> {
        let surface = self.stations.hull.surface();
        let (domain, level) = (surface.u().domain(), self.stations.hull.is_level());
        let top = surface.v().domain().1;
        let end = |u: f64| if level { immersion.waterline() } else { immersion.end(u) };
        [domain.0, domain.1]
            .into_iter()
            .map(|u| (surface.eval(u, end(u)), surface.eval(u, top)))
            .filter(|(at, above)| at[1] > 0.0 && at[0].to_bits() != above[0].to_bits())
            .map(|(at, _)| at[0])
            .collect()
    }

    /// Extent around the largest section of the sections that equal it.
    fn parallel(&self, samples: &[Sample], best: &Sample, immersion: &Immersion) -> Option<[f64; 2]> {
        let enough = best.area * (1.0 - PARALLEL_TOLERANCE);
        let shortest = PARALLEL_LENGTH * self.length;
        let top = Sample { slope: 0.0, ..*best };
        let run = |side: &mut dyn Iterator<Item = &Sample>| {
            let mut inside = top;
            for &sample in side {
                if sample.area < enough {
                    return (inside, Some(sample));
                }
                inside = sample;
            }
            (inside, None)
        };
        let aft = run(&mut samples.iter().rev().filter(|sample| sample.x < best.x));
        let fore = run(&mut samples.iter().filter(|sample| sample.x > best.x));
        let edge = |(inside, outside): (Sample, Option<Sample>), exactly: bool| -> f64 {
            let Some(outside) = outside else { return inside.x };
            if (outside.x - inside.x).abs() <= 2.0 * CORNER * self.length {
                return inside.x;
            }
            let (mut good, mut bad) = (inside, outside);
            for _ in 0..60 {
                // The cubic's passage of the threshold, by bisection.
                let cubic = if good.x < bad.x { Cubic::new(&good, &bad) } else { Cubic::new(&bad, &good) };
                let (mut from, mut to) = (good.x, bad.x);
                for _ in 0..45 {
                    let middle = 0.5 * (from + to);
                    if cubic.value(middle) >= enough {
                        from = middle;
                    } else {
                        to = middle;
                    }
                }
                let x = from;
                if !exactly {
                    return x;
                }
                let now = self.exact(x, immersion);
                let error = (now.area - enough) / now.slope;
                if error.abs() <= 2e-7 * self.length {
                    let corrected = x - error;
                    return corrected.clamp(good.x.min(bad.x), good.x.max(bad.x));
                }
                let before = (bad.x - good.x).abs();
                if now.area >= enough {
                    good = now;
                } else {
                    bad = now;
                }
                // A cubic that does not move both ends is followed by bisection.
                if (bad.x - good.x).abs() > 0.5 * before {
                    let now = self.exact(0.5 * (good.x + bad.x), immersion);
                    if now.area >= enough {
                        good = now;
                    } else {
                        bad = now;
                    }
                }
                if (bad.x - good.x).abs() <= 2e-7 * self.length {
                    break;
                }
            }
            good.x
        };
        if edge(fore, false) - edge(aft, false) < 0.5 * shortest {
            return None;
        }
        let ends = [edge(aft, true), edge(fore, true)];
        (ends[1] - ends[0] >= shortest).then_some(ends)
    }
}

/// Places of the stations shared by all draughts.
fn places(hull: &Hull, length: f64) -> Vec<f64> {
    let surface = hull.surface();
    let top = surface.curve_at_v(surface.v().domain().1);
    let breakpoints = surface.u().breakpoints();
    let parts = STATIONS.div_ceil(breakpoints.len() - 1);
    let mut places = vec![0.5 * length];
    for pair in breakpoints.windows(2) {
        let share = |k: usize| k as f64 / parts as f64;
        places.extend((0..=parts).map(|k| top.eval((1.0 - share(k)) * pair[0] + share(k) * pair[1])[0]));
    }
    for u in [surface.u().domain().0, surface.u().domain().1] {
        let profile: Vec<[f64; 3]> = surface.v().breakpoints().into_iter().map(|v| surface.eval(u, v)).collect();
        let x = profile.iter().map(|point| point[0]);
        places.extend([x.clone().fold(f64::INFINITY, f64::min), x.fold(f64::NEG_INFINITY, f64::max)]);
        // Corners of the areas, and their two sides.
        for point in profile.iter().filter(|point| point[1] > 0.0) {
            places.extend([-CORNER, 0.0, CORNER].map(|side| point[0] + side * length));
        }
    }
    places.sort_by(f64::total_cmp);
    places.dedup_by(|a, b| (*a - *b).abs() <= 0.01 * CORNER * length);
    // Midship is asked for to the bit.
    for x in &mut places {
        if (*x - 0.5 * length).abs() <= 0.01 * CORNER * length {
            *x = 0.5 * length;
        }
    }
    places
}
