//! What is precomputed of a knot vector: where each span starts, how to find the span of a parameter in constant time,
//! and the reciprocals of the knot differences that the basis recurrence divides by.

use super::basis::basis_orders;

/// Breakpoints that one bucket may hold for the search without branches.
const PER_BUCKET: usize = 2;

/// A span of a cubic.
#[derive(Debug)]
pub(super) struct Cubic {
    /// Where the span starts.
    pub start: f64,
    /// Index of the first basis function that does not vanish there.
    pub first: usize,
    /// Coefficients of (t - start)^0 .. ^3 of the four basis functions.
    pub powers: [[f64; 4]; 4],
}

/// A bucket of the search for spans.
#[derive(Debug, Clone, Copy)]
struct Bucket {
    /// Number of starts in the buckets before.
    before: usize,
    /// The next `PER_BUCKET` starts, infinite behind the last one.
    near: [f64; PER_BUCKET],
}

/// The spans of positive length of a knot vector.
#[derive(Debug)]
pub(super) struct SpanTable {
    origin: f64,
    end: f64,
    scale: f64,
    /// One entry more than there are buckets.
    buckets: Vec<Bucket>,
    /// Starts of the spans and the end of the domain.
    starts: Vec<f64>,
    /// Index of the knot at which each span starts, for the whole knot vector.
    knot_index: Vec<u32>,
    /// For each span the reciprocals 1 / (t_{k+r+1} - t_{k+1+r-j}), j = 1 ..= p, r = 0 .. j, at `j (j - 1) / 2 + r`.
    reciprocals: Vec<f64>,
    per_span: usize,
    /// For degree 3, the polynomials of each span.
    cubics: Vec<Cubic>,
    crowded: bool,
}

impl SpanTable {
    /// The table of checked clamped knots.
    pub(super) fn new(degree: usize, knots: &[f64]) -> Self {
        let last = knots.len() - degree - 1;
        let mut spans: Vec<usize> = (degree..last).filter(|&k| knots[k] < knots[k + 1]).collect();
        let (origin, end) = (knots[0], knots[knots.len() - 1]);
        // The end of the domain counts as a span of its own, with the functions of the last one.
        let starts: Vec<f64> = spans.iter().map(|&k| knots[k]).chain([end]).collect();
        spans.extend(spans.last().copied());
        let per_span = degree * (degree + 1) / 2;
        let mut reciprocals = Vec::with_capacity(per_span * spans.len());
        for &k in &spans {
            for j in 1..=degree {
                for r in 0..j {
                    reciprocals.push(1.0 / (knots[k + r + 1] - knots[k + 1 + r - j]));
                }
            }
        }
        // Equal spans need one bucket each; graded ones get up to 16, until no bucket holds more than two starts.
        let mut buckets = spans.len() - 1;
        let (mut scale, mut before, mut crowded);
        loop {
            scale = buckets as f64 / (end - origin);
            before = vec![0u32; buckets + 1];
            for &start in &starts {
                before[bucket(start, origin, scale, buckets) + 1] += 1;
            }
            crowded = before.iter().any(|&count| count as usize > PER_BUCKET);
            for b in 1..=buckets {
                before[b] += before[b - 1];
            }
            if !crowded || buckets >= 16 * spans.len() {
                break;
            }
            buckets *= 2;
        }
        let cubics = if degree == 3 {
            let span = |((&k, &start), reciprocals): ((&usize, &f64), &[f64])| {
                let [value, first, second, third] = basis_orders::<4, 4>(&knots[k - 2..], reciprocals, start);
                let powers = [value, first, second.map(|c| c / 2.0), third.map(|c| c / 6.0)];
                Cubic { start, first: k - 3, powers }
            };
            spans.iter().zip(&starts).zip(reciprocals.chunks_exact(per_span)).map(span).collect()
        } else {
            Vec::new()
        };
        let near = |low: usize| std::array::from_fn(|k| starts.get(low + k).copied().unwrap_or(f64::INFINITY));
        let buckets = before.iter().map(|&low| Bucket { before: low as usize, near: near(low as usize) }).collect();
        let knot_index = spans.iter().map(|&k| k as u32).collect();
        Self { origin, end, scale, buckets, starts, knot_index, reciprocals, per_span, cubics, crowded }
    }

    /// Number of spans of positive length.
    pub(super) fn len(&self) -> usize {
        self.knot_index.len() - 1
    }

    /// The number of the span that holds `t`, counted over the spans of positive length. Parameters outside the domain
    /// belong to its first or last span; the end of the domain is a span of its own behind the last one.
    #[inline(always)]
    pub(super) fn locate(&self, t: f64) -> usize {
        // Rounding is monotone: a start in an earlier bucket is below t, a start in a later one above it.
        let b = bucket(t, self.origin, self.scale, self.buckets.len() - 1);
        let count = if self.crowded {
            self.search(b, t)
        } else {
            let Bucket { before, near } = self.buckets[b];
            before + usize::from(near[0] <= t) + usize::from(near[1] <= t)
        };
        count.max(1) - 1
    }

    #[cold]
    fn search(&self, b: usize, t: f64) -> usize {
        let (low, high) = (self.buckets[b].before, self.buckets[b + 1].before);
        low + self.starts[low..high].partition_point(|&start| start <= t)
    }

    /// `t` taken to the nearest end of the domain; NaN stays NaN.
    #[inline(always)]
    pub(super) fn clamp(&self, t: f64) -> f64 {
        if t < self.origin {
            self.origin
        } else if t > self.end {
            self.end
        } else {
            t
        }
    }

    /// The spans of a cubic, the end of the domain included; empty for other degrees.
    #[inline(always)]
    pub(super) fn cubics(&self) -> &[Cubic] {
        &self.cubics
    }

    /// Index of the knot at which span `number` starts.
    #[inline]
    pub(super) fn knot_index(&self, number: usize) -> usize {
        self.knot_index[number] as usize
    }

    /// The number of the span of positive length that starts at knot `index`, or the one before it.
    pub(super) fn number_of(&self, index: usize) -> usize {
        self.knot_index[..self.len()].partition_point(|&k| k as usize <= index).max(1) - 1
    }

    /// The reciprocals of span `number`.
    #[inline]
    pub(super) fn reciprocals(&self, number: usize) -> &[f64] {
        &self.reciprocals[number * self.per_span..(number + 1) * self.per_span]
    }
}

/// The bucket of `t`; a negative product and NaN become 0 in the conversion.
#[inline]
fn bucket(t: f64, origin: f64, scale: f64, buckets: usize) -> usize {
    (((t - origin) * scale) as u32 as usize).min(buckets - 1)
}
