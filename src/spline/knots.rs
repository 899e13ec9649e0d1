//! Knot vectors and the B-spline basis over them (Piegl & Tiller 1997, chapter 2; de Boor 2001, chapter IX).

/// The highest degree of a spline.
pub const MAX_DEGREE: usize = 7;

/// Why data do not make a spline.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SplineError {
    /// Degree outside 1 to [`MAX_DEGREE`].
    #[error("degree {0} is outside 1 to {MAX_DEGREE}")]
    Degree(usize),
    /// Knots that are not finite, decrease, are not clamped or repeat too often.
    #[error("knot {index} ({value}): {problem}")]
    Knot {
        /// Index of the knot, from 0.
        index: usize,
        /// Its value.
        value: f64,
        /// What is wrong with it.
        problem: &'static str,
    },
    /// A number of points that does not fit the knots.
    #[error("{found} control points, expected {expected}")]
    PointCount {
        /// Number found.
        found: usize,
        /// Number that the knots ask for.
        expected: usize,
    },
    /// A control point that is not finite.
    #[error("control point {0} is not finite")]
    NotFinite(usize),
    /// Data sites that do not determine the spline (Schoenberg-Whitney condition).
    #[error("the data sites do not determine the spline: no site belongs to basis function {column}")]
    Undetermined {
        /// The basis function without data.
        column: usize,
    },
}

/// A clamped, non-decreasing sequence of knots with a degree.
#[derive(Debug, Clone, PartialEq)]
pub struct KnotVector {
    degree: usize,
    knots: Vec<f64>,
}

impl KnotVector {
    /// Takes the full sequence of knots, `basis functions + degree + 1` of them.
    ///
    /// # Errors
    /// [`SplineError`] when the degree is outside 1 to [`MAX_DEGREE`], a knot is not finite, the sequence decreases, an end
    /// is not `degree + 1` fold or an interior knot is more than `degree` fold.
    pub fn new(degree: usize, knots: Vec<f64>) -> Result<Self, SplineError> {
        if !(1..=MAX_DEGREE).contains(&degree) {
            return Err(SplineError::Degree(degree));
        }
        let bad = |index: usize, problem| {
            Err(SplineError::Knot { index, value: knots.get(index).copied().unwrap_or(f64::NAN), problem })
        };
        if knots.len() < 2 * (degree + 1) {
            return bad(knots.len(), "too few knots");
        }
        if let Some(index) = knots.iter().position(|t| !t.is_finite()) {
            return bad(index, "not finite");
        }
        if let Some(index) = knots.windows(2).position(|w| w[1] < w[0]) {
            return bad(index + 1, "smaller than the knot before it");
        }
        let (first, last) = (knots[0], knots[knots.len() - 1]);
        if knots[degree] > first {
            return bad(degree, "the start is not clamped");
        }
        if knots[knots.len() - 1 - degree] < last {
            return bad(knots.len() - 1 - degree, "the end is not clamped");
        }
        // More than `degree` equal knots inside (or degree + 1 at an end) would split the spline.
        let inner = &knots[1..knots.len() - 1];
        if let Some(index) = inner.windows(degree + 1).position(|w| w[0] >= w[degree]) {
            return bad(index + 1, "repeated more often than the degree allows");
        }
        Ok(Self { degree, knots })
    }

    /// Clamped knots from increasing breakpoints; `multiplicities` belong to the interior breakpoints.
    ///
    /// # Errors
    /// As [`KnotVector::new`]; also when the number of multiplicities is not the number of interior breakpoints.
    pub fn from_breakpoints(degree: usize, breakpoints: &[f64], multiplicities: &[usize]) -> Result<Self, SplineError> {
        if breakpoints.len() < 2 || multiplicities.len() + 2 != breakpoints.len() {
            return Err(SplineError::PointCount { found: multiplicities.len() + 2, expected: breakpoints.len() });
        }
        let last = breakpoints.len() - 1;
        let mut knots = Vec::new();
        for (index, &at) in breakpoints.iter().enumerate() {
            let times = if index == 0 || index == last { degree + 1 } else { multiplicities[index - 1] };
            knots.extend(std::iter::repeat_n(at, times));
        }
        Self::new(degree, knots)
    }

    /// Clamped knots on [0, 1] with `spans` equal spans.
    ///
    /// # Errors
    /// As [`KnotVector::new`]; also when `spans` is 0.
    pub fn uniform(degree: usize, spans: usize) -> Result<Self, SplineError> {
        let breakpoints: Vec<f64> = (0..=spans).map(|k| k as f64 / spans.max(1) as f64).collect();
        Self::from_breakpoints(degree, &breakpoints, &vec![1; spans.saturating_sub(1)])
    }

    /// The degree p.
    #[must_use]
    pub fn degree(&self) -> usize {
        self.degree
    }

    /// All knots with their multiplicities.
    #[must_use]
    pub fn knots(&self) -> &[f64] {
        &self.knots
    }

    /// Number of basis functions, that is of control points.
    #[must_use]
    pub fn basis_count(&self) -> usize {
        self.knots.len() - self.degree - 1
    }

    /// First and last knot.
    #[must_use]
    pub fn domain(&self) -> (f64, f64) {
        (self.knots[0], self.knots[self.knots.len() - 1])
    }

    /// The distinct knots in increasing order.
    #[must_use]
    pub fn breakpoints(&self) -> Vec<f64> {
        let mut breaks = self.knots.clone();
        breaks.dedup_by(|a, b| a <= b);
        breaks
    }

    /// Indices k of the spans [t_k, t_k+1] of positive length, in order.
    #[must_use]
    pub fn spans(&self) -> Vec<usize> {
        (self.degree..self.basis_count()).filter(|&k| self.knots[k] < self.knots[k + 1]).collect()
    }

    /// The index k with t_k <= t < t_k+1 (the last span of positive length is closed); the basis functions k - p ..= k
    /// are the ones that do not vanish there. `t` outside the domain is taken to its nearest end.
    #[must_use]
    pub fn find_span(&self, t: f64) -> usize {
        let inside = &self.knots[self.degree..=self.basis_count()];
        let above = inside.partition_point(|&knot| knot <= t);
        let mut span = (self.degree + above).saturating_sub(1).clamp(self.degree, self.basis_count() - 1);
        while self.knots[span] >= self.knots[span + 1] {
            span -= 1;
        }
        span
    }

    /// Greville abscissae, the means of `degree` successive knots: the site that belongs to each control point.
    #[must_use]
    pub fn greville(&self) -> Vec<f64> {
        let p = self.degree;
        let (a, b) = self.domain();
        let count = self.basis_count();
        (0..count)
            .map(|i| match i {
                0 => a,
                i if i + 1 == count => b,
                i => self.knots[i + 1..=i + p].iter().sum::<f64>() / p as f64,
            })
            .collect()
    }

    /// Values of the `degree + 1` basis functions span - p ..= span at `t`; the rest of the array is 0.
    #[must_use]
    pub fn basis(&self, span: usize, t: f64) -> [f64; MAX_DEGREE + 1] {
        let (p, k) = (self.degree, &self.knots);
        let mut values = [0.0; MAX_DEGREE + 1];
        values[0] = 1.0;
        for j in 1..=p {
            let mut saved = 0.0;
            for r in 0..j {
                let (right, left) = (k[span + r + 1], k[span + 1 + r - j]);
                let term = values[r] / (right - left);
                values[r] = saved + (right - t) * term;
                saved = (t - left) * term;
            }
            values[j] = saved;
        }
        values
    }

    /// Values and derivatives of order 0 to N - 1 of the basis functions span - p ..= span at `t`:
    /// `result[order][function]`. Orders above the degree are 0.
    #[must_use]
    pub fn basis_derivatives<const N: usize>(&self, span: usize, t: f64) -> [[f64; MAX_DEGREE + 1]; N] {
        let (p, k) = (self.degree, &self.knots);
        // ndu[j][r]: basis values in the upper triangle, knot differences in the lower (Piegl & Tiller A2.3).
        let mut ndu = [[0.0; MAX_DEGREE + 1]; MAX_DEGREE + 1];
        ndu[0][0] = 1.0;
        for j in 1..=p {
            let mut saved = 0.0;
            for r in 0..j {
                let (right, left) = (k[span + r + 1], k[span + 1 + r - j]);
                ndu[j][r] = right - left;
                let term = ndu[r][j - 1] / ndu[j][r];
                ndu[r][j] = saved + (right - t) * term;
                saved = (t - left) * term;
            }
            ndu[j][j] = saved;
        }
        let mut result = [[0.0; MAX_DEGREE + 1]; N];
        for r in 0..=p {
            if N > 0 {
                result[0][r] = ndu[r][p];
            }
            let mut a = [[0.0; MAX_DEGREE + 1]; 2];
            a[0][0] = 1.0;
            let (mut s1, mut s2) = (0, 1);
            for order in 1..N.min(p + 1) {
                let mut d = 0.0;
                let rk = r as isize - order as isize;
                let pk = p - order;
                if r >= order {
                    a[s2][0] = a[s1][0] / ndu[pk + 1][rk as usize];
                    d = a[s2][0] * ndu[rk as usize][pk];
                }
                let j1 = if rk >= -1 { 1 } else { (-rk) as usize };
                let j2 = if r as isize - 1 <= pk as isize { order - 1 } else { p - r };
                for j in j1..=j2 {
                    let column = (rk + j as isize) as usize;
                    a[s2][j] = (a[s1][j] - a[s1][j - 1]) / ndu[pk + 1][column];
                    d += a[s2][j] * ndu[column][pk];
                }
                if r <= pk {
                    a[s2][order] = -a[s1][order - 1] / ndu[pk + 1][r];
                    d += a[s2][order] * ndu[r][pk];
                }
                result[order][r] = d;
                std::mem::swap(&mut s1, &mut s2);
            }
        }
        let mut factor = p as f64;
        for (order, row) in result.iter_mut().enumerate().skip(1) {
            if order > p {
                break;
            }
            for value in row.iter_mut() {
                *value *= factor;
            }
            factor *= (p - order) as f64;
        }
        result
    }
}
