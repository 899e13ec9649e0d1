//! The values of a blend over weights and changes of dimensions, by polynomials instead of integrals.
//!
//! Below T a cell of a blend has a volume that is a cubic of the weights, and a moment that is a quartic; where the waterline
//! crosses cells that differ, values are smooth. So quantities are integrated on the blends of a lattice of weights, and
//! between them they are polynomials (Lagrange's on the simplex, Nicolaides 1972). Free dimensions follow from the affine laws:
//! volumes grow as L B T, centres as L and T, BM as B^2/T, tangents of half angles as B/L, coefficients stay. The
//! polynomials guide searches alone; what is answered is integrated.

use super::super::quantity::{Quantity, Reference, value_of};
use super::super::request::{Origin, Target};
use super::Dimension;
use super::weights::{Blending, Failed, Mix, mixed};

/// Degree of the polynomials for two hulls, for three, and for more.
const DEGREES: [usize; 3] = [4, 3, 2];

/// The integrated values on the lattice.
pub(super) struct Model {
    degree: usize,
    /// Multiples of 1/degree that are the weights of each point.
    lattice: Vec<Vec<usize>>,
    /// Values at each point: the length of coefficients, then those of `quantities`.
    values: Vec<Vec<f64>>,
    quantities: Vec<Quantity>,
    /// Reference of the blends; its length is that of the first point.
    reference: Reference,
}

/// Every way to write `total` as a sum of `count` numbers.
fn sums(count: usize, total: usize) -> Vec<Vec<usize>> {
    if count == 1 {
        return vec![vec![total]];
    }
    let with = |first: usize| {
        sums(count - 1, total - first).into_iter().map(move |mut rest| {
            rest.insert(0, first);
            rest
        })
    };
    (0..=total).flat_map(with).collect()
}

/// The polynomial that is 1 at the point of the lattice and 0 at its others.
fn lagrange(degree: usize, point: &[usize], weights: &[f64]) -> f64 {
    let scale = degree as f64;
    let of = |(count, weight): (&usize, &f64)| {
        (0..*count).map(|j| (scale * weight - j as f64) / (j as f64 + 1.0)).product::<f64>()
    };
    point.iter().zip(weights).map(of).product()
}

/// Tangents of angles stand for angles, which are smooth in them.
fn smooth(quantity: Quantity, value: f64) -> f64 {
    match quantity {
        Quantity::HalfAngleOfEntrance | Quantity::HalfAngleOfRun => value.to_radians().tan(),
        _ => value,
    }
}

impl Model {
    /// Integrates on the lattice; none where no law says what a dimension that is free does to a quantity.
    ///
    /// # Errors
    /// [`Failed`] where a blend of the lattice is no hull, or does not float at its draught.
    pub(super) fn new(blending: &Blending<'_>, quantities: &[Quantity]) -> Result<Option<Self>, Failed> {
        if !blending.free.is_empty() && quantities.contains(&Quantity::WettedSurface) {
            return Ok(None);
        }
        let count = blending.hulls.len();
        let degree = DEGREES[(count.max(2) - 2).min(2)];
        let lattice = sums(count, degree);
        // BM is KM less KB.
        let mut quantities = quantities.to_vec();
        if quantities.contains(&Quantity::Km) && !quantities.contains(&Quantity::Kb) {
            quantities.push(Quantity::Kb);
        }
        let mut references = Vec::new();
        let mut values = Vec::new();
        for point in &lattice {
            let weights: Vec<f64> = point.iter().map(|part| *part as f64 / degree as f64).collect();
            let hull = mixed(blending.hulls, &weights)?;
            let Some(reference) = Reference::of(&hull, blending.conventions) else { return Err(Failed::Infeasible) };
            let of = |quantity: &Quantity| smooth(*quantity, value_of(*quantity, &hull, &reference));
            values.push(std::iter::once(reference.length).chain(quantities.iter().map(of)).collect());
            references.push(reference);
        }
        let Some(&reference) = references.first() else { return Err(Failed::Infeasible) };
        Ok(Some(Self { degree, lattice, values, quantities, reference }))
    }

    /// The reference and the values of the quantities at a mix.
    fn at(&self, mix: &Mix, free: &[Dimension]) -> (Reference, Vec<f64>) {
        let mut sum = vec![0.0; 1 + self.quantities.len()];
        for (point, values) in self.lattice.iter().zip(&self.values) {
            let part = lagrange(self.degree, point, &mix.weights);
            sum.iter_mut().zip(values).for_each(|(sum, value)| *sum += part * value);
        }
        let [mut l, mut b, mut z] = [1.0; 3];
        for (dimension, change) in free.iter().zip(&mix.changes) {
            match dimension {
                Dimension::Length => l = change.exp(),
                Dimension::Breadth => b = change.exp(),
                Dimension::Draught => z = change.exp(),
            }
        }
        let height = self.quantities.iter().position(|q| *q == Quantity::Kb).map_or(0.0, |k| sum[1 + k]);
        let of = |(quantity, value): (&Quantity, &f64)| match quantity {
            Quantity::Volume => l * b * z * value,
            Quantity::Lcb | Quantity::Lcf => l * value,
            Quantity::Kb => z * value,
            Quantity::Km => z * height + b * b / z * (value - height),
            Quantity::HalfAngleOfEntrance | Quantity::HalfAngleOfRun => (b / l * value).atan().to_degrees(),
            _ => *value,
        };
        let values = self.quantities.iter().zip(&sum[1..]).map(of).collect();
        let own = self.reference;
        let reference = Reference {
            length: l * sum[0],
            between: l * own.between,
            breadth: b * own.breadth,
            draught: z * own.draught,
            ..own
        };
        (reference, values)
    }

    /// The values of `quantities` at a mix, with the reference and the targets that are stated for them.
    pub(super) fn reached(
        &self,
        blending: &Blending<'_>,
        mix: &Mix,
        quantities: &[Quantity],
    ) -> Option<(Reference, Vec<f64>, Vec<Target>)> {
        let (reference, all) = self.at(mix, blending.free);
        let value = |quantity: &Quantity| {
            let place = self.quantities.iter().position(|own| own == quantity)?;
            Some(all[place])
        };
        let values = quantities.iter().map(value).collect::<Option<Vec<f64>>>()?;
        let targets = quantities.iter().map(|&quantity| {
            let value = blending.request.stated(quantity, &reference)?;
            Some(Target { quantity, value, origin: Origin::Given })
        });
        Some((reference, values, targets.collect::<Option<Vec<_>>>()?))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The lattice of three weights in thirds has ten points, and a cubic is reproduced.
    #[test]
    fn cubics_are_their_polynomials() {
        let lattice = sums(3, 3);
        assert_eq!(lattice.len(), 10);
        let cubic = |w: &[f64]| 2.0 * w[0].powi(3) - w[1] * w[2] * w[0] + 3.0 * w[2] * w[2] + 0.5;
        let of = |weights: &[f64]| -> f64 {
            let at = |point: &Vec<usize>| cubic(&point.iter().map(|part| *part as f64 / 3.0).collect::<Vec<_>>());
            lattice.iter().map(|point| lagrange(3, point, weights) * at(point)).sum()
        };
        for weights in [[0.2, 0.3, 0.5], [0.9, 0.1, 0.0], [0.0, 1.0, 0.0]] {
            assert!((of(&weights) - cubic(&weights)).abs() < 1e-13);
        }
    }
}
