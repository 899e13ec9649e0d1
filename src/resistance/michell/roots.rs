//! Few linear forms whose squares have the sum of those of many.
//!
//! ```text
//! G = sum over k of a_k a_k' = R R' + E,     trace E <= 1e-8 trace G
//! ```
//!
//! by Cholesky factors with the greatest diagonal entry first (Harbrecht, Peters and Schneider 2012). E is positive semidefinite,
//! so that d'Ed <= trace E |d|^2. G itself is never formed: a column of it costs as much as a pass over the forms. The waves of a
//! ship at Froude numbers of displacement ships leave some tens of columns.

/// Trace that is left over that of G.
const LEFT: f64 = 1e-8;

/// The columns of R, each as long as a form; none where all forms vanish.
pub(in super::super) fn roots(forms: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let count = forms.first().map_or(0, Vec::len);
    let mut diagonal = vec![0.0; count];
    for form in forms {
        diagonal.iter_mut().zip(form).for_each(|(sum, a)| *sum += a * a);
    }
    let least = LEFT * diagonal.iter().sum::<f64>();
    let mut roots: Vec<Vec<f64>> = Vec::new();
    while roots.len() < count {
        let left: f64 = diagonal.iter().map(|d| d.max(0.0)).sum();
        let first = diagonal.iter().enumerate().max_by(|a, b| a.1.total_cmp(b.1).then(b.0.cmp(&a.0)));
        let Some((pivot, &most)) = first.filter(|(_, most)| **most > 0.0 && left > least) else { break };
        let mut column = vec![0.0; count];
        let mut add = |factor: f64, values: &[f64]| {
            column.iter_mut().zip(values).for_each(|(sum, value)| *sum += factor * value);
        };
        forms.iter().for_each(|form| add(form[pivot], form));
        roots.iter().for_each(|root| add(-root[pivot], root));
        let size = most.sqrt();
        column.iter_mut().for_each(|value| *value /= size);
        diagonal.iter_mut().zip(&column).for_each(|(d, value)| *d -= value * value);
        diagonal[pivot] = 0.0;
        roots.push(column);
    }
    roots
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of 300 forms over 40 values that lie in a space of 7 dimensions, 7 remain, with the same sum of squares.
    #[test]
    fn as_many_remain_as_there_are_dimensions() {
        let own = |k: usize, i: usize| (0.3 + 0.1 * (k * i) as f64 + k as f64).sin();
        let form = |n: usize| -> Vec<f64> {
            (0..40).map(|i| (0..7).map(|k| (1.0 + (n * (k + 2)) as f64).cos() * own(k, i)).sum()).collect()
        };
        let forms: Vec<Vec<f64>> = (0..300).map(form).collect();
        let found = roots(&forms);
        assert_eq!(found.len(), 7);
        let change: Vec<f64> = (0..40).map(|i| (0.9 * i as f64).cos()).collect();
        let squares = |forms: &[Vec<f64>]| -> f64 {
            let of = |form: &Vec<f64>| form.iter().zip(&change).map(|(a, d)| a * d).sum::<f64>();
            forms.iter().map(|form| of(form).powi(2)).sum()
        };
        assert!((squares(&found) / squares(&forms) - 1.0).abs() < 1e-11);
        assert!(roots(&[]).is_empty() && roots(&[vec![0.0; 4]]).is_empty());
    }
}
