//! Stations and waterlines as people space them.

use super::hulls::Truth;
use crate::random::Random;

/// From `low` to `high`, small numbers more often.
fn count(random: &mut Random, low: f64, high: f64) -> usize {
    (low * (high / low).powf(random.uniform())).round() as usize
}

fn even(count: usize) -> Vec<f64> {
    (0..count).map(|k| k as f64 / (count - 1) as f64).collect()
}

/// To the millimetre, as places are written.
fn written(values: &[f64], [from, to]: [f64; 2]) -> Vec<f64> {
    let mut list: Vec<f64> = values.iter().map(|t| (1e3 * (from + (to - from) * t)).round() / 1e3).collect();
    list.dedup_by(|b, a| *b - *a < 1e-3 * (to - from));
    list
}

/// Words, stations and waterlines: 15 x 6 to 60 x 40.
pub(super) fn drawn(truth: &Truth, random: &mut Random) -> (&'static str, Vec<f64>, Vec<f64>) {
    let [stations, waterlines] = [count(random, 15.0, 60.0), count(random, 6.0, 40.0)];
    let mut x = even(stations);
    let step = 1.0 / (stations - 1) as f64;
    let mut ends = truth.ends;
    let along = match if truth.smoothed { random.below(2) } else { random.below(4) } {
        0 => "even",
        1 => {
            x.iter_mut().for_each(|t| *t += 0.25 * step * (2.0 * random.uniform() - 1.0));
            let last = stations - 1;
            (x[0], x[last]) = (0.0, 1.0);
            "uneven"
        }
        2 => {
            // Half stations in the outermost intervals, one or two of them at each end.
            let halves = 1 + random.below(2);
            let whole = stations - 2 * halves;
            let unit = 1.0 / (whole - 1) as f64;
            x = even(whole);
            x.extend((0..halves).flat_map(|k| [(k as f64 + 0.5) * unit, 1.0 - (k as f64 + 0.5) * unit]));
            x.sort_by(f64::total_cmp);
            "half at ends"
        }
        _ => {
            let length = ends[1] - ends[0];
            ends = [ends[0] + length * 0.08 * random.uniform(), ends[1] - length * 0.08 * random.uniform()];
            "ends cut"
        }
    };
    let mut z = even(waterlines);
    let spacing = match random.below(3) {
        0 => along,
        1 => {
            let power = 1.2 + 0.6 * random.uniform();
            z.iter_mut().for_each(|t| *t = t.powf(power));
            match along {
                "even" => "dense below",
                "uneven" => "uneven, below",
                "half at ends" => "half, below",
                _ => "cut, below",
            }
        }
        _ => {
            // Waterlines near the keel in place of the lowest one.
            let first = z[1];
            z.pop();
            z.insert(1, 0.35 * first);
            z.iter_mut().skip(2).for_each(|t| *t *= 1.0 / (1.0 - first));
            match along {
                "even" => "keel apart",
                "uneven" => "uneven, keel",
                "half at ends" => "half, keel",
                _ => "cut, keel",
            }
        }
    };
    (spacing, written(&x, ends), written(&z, truth.heights))
}
