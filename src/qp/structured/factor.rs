//! N = L L' by a multifrontal supernodal Cholesky factorisation (Duff & Reid 1983; Liu 1992); the symbolic part is made
//! once.
//!
//! A supernode is a run of columns of L with one pattern below them. Its front is the dense block of these columns, to
//! which the children in the elimination tree add what their elimination leaves. Runs are joined where that adds few
//! zeros (Ashcraft & Grimes 1989), so that the products are of larger blocks.

use super::normal::Normal;
use crate::numeric::dense::{Block, dot, factor_panel, subtract_product};

/// Columns of the remainder of a front that one product updates; entries above its diagonal are computed in vain.
const STRIPE: usize = 64;

/// Neighbours are joined up to this many columns, if at most this part of the joint block is zeros.
const JOINED: [(usize, f64); 4] = [(8, 0.8), (16, 0.5), (48, 0.15), (usize::MAX, 0.05)];

/// Columns `first` up to `end` of L, whose pattern below the diagonal block is `rows`.
struct Supernode {
    first: usize,
    end: usize,
    rows: Vec<u32>,
    /// Zeros in its columns that are stored.
    zeros: usize,
    /// Place of its first value.
    offset: usize,
    /// Supernodes whose remainder enters this front.
    children: Vec<u32>,
}

impl Supernode {
    fn width(&self) -> usize {
        self.end - self.first
    }

    fn height(&self) -> usize {
        self.width() + self.rows.len()
    }
}

/// L, with its pattern and the memory that factoring and solving use.
pub(super) struct Factor {
    size: usize,
    supernodes: Vec<Supernode>,
    values: Vec<f64>,
    /// What the elimination of each supernode leaves for its parent: a lower triangle in a square.
    remainders: Vec<Vec<f64>>,
    /// Memory of remainders that were taken.
    spare: Vec<Vec<f64>>,
    /// Place of a row in the front in hand.
    places: Vec<u32>,
    /// The unknowns of a front while it is solved.
    gathered: Vec<f64>,
}

/// Parent of each column in the elimination tree (Liu 1986), `n` for a root; `upper` is the pattern of the upper
/// triangle by columns.
fn elimination_tree(starts: &[usize], upper: &[usize]) -> Vec<usize> {
    let n = starts.len() - 1;
    let (mut parents, mut ancestors) = (vec![n; n], vec![n; n]);
    for column in 0..n {
        for &row in &upper[starts[column]..starts[column + 1]] {
            let mut node = row;
            while node < column {
                let next = std::mem::replace(&mut ancestors[node], column);
                if next == n {
                    parents[node] = column;
                    break;
                }
                node = next;
            }
        }
    }
    parents
}

/// Supernodes of one column each, joined with the ones before where that pays.
fn supernodes(normal: &Normal) -> Vec<Supernode> {
    let n = normal.starts.len() - 1;
    let (starts, upper) = normal.upper_pattern();
    let parents = elimination_tree(&starts, &upper);
    let mut children: Vec<Vec<u32>> = vec![Vec::new(); n + 1];
    let mut patterns: Vec<Vec<u32>> = Vec::with_capacity(n);
    let mut seen = vec![usize::MAX; n];
    let mut supernodes: Vec<Supernode> = Vec::new();
    for column in 0..n {
        let mut pattern = Vec::new();
        seen[column] = column;
        let mut take = |row: u32| {
            if std::mem::replace(&mut seen[row as usize], column) != column {
                pattern.push(row);
            }
        };
        normal.rows[normal.starts[column]..normal.starts[column + 1]].iter().for_each(|&row| take(row as u32));
        for &child in &children[column] {
            patterns[child as usize].iter().for_each(|&row| take(row));
        }
        pattern.sort_unstable();
        children[parents[column]].push(column as u32);
        let mut node = Supernode {
            first: column,
            end: column + 1,
            rows: pattern.clone(),
            zeros: 0,
            offset: 0,
            children: Vec::new(),
        };
        patterns.push(pattern);
        // The last child ends where its parent begins; the columns between are its own.
        while let Some(last) = supernodes.pop_if(|last| last.rows.first().is_some_and(|&row| (row as usize) < node.end))
        {
            let added = last.width() * (node.height() - last.rows.len());
            let zeros = last.zeros + node.zeros + added;
            let [width, height] = [last.width() + node.width(), last.width() + node.height()];
            let stored = width * height - width * (width - 1) / 2;
            let most = JOINED.iter().find(|(widest, _)| width <= *widest).map_or(0.0, |(_, part)| part * stored as f64);
            if last.end != node.first || zeros as f64 > most {
                supernodes.push(last);
                break;
            }
            node = Supernode { first: last.first, zeros, ..node };
        }
        supernodes.push(node);
    }
    supernodes
}

impl Factor {
    /// The pattern of L for a matrix in elimination order.
    pub(super) fn new(normal: &Normal) -> Self {
        let size = normal.starts.len() - 1;
        let mut supernodes = supernodes(normal);
        let mut owners = vec![0_usize; size];
        let mut offset = 0;
        for (index, node) in supernodes.iter_mut().enumerate() {
            node.offset = offset;
            offset += node.width() * node.height();
            owners[node.first..node.end].fill(index);
        }
        for index in 0..supernodes.len() {
            if let Some(&row) = supernodes[index].rows.first() {
                supernodes[owners[row as usize]].children.push(index as u32);
            }
        }
        let tallest = supernodes.iter().map(Supernode::height).max().unwrap_or(0);
        Self {
            size,
            values: vec![0.0; offset],
            remainders: vec![Vec::new(); supernodes.len()],
            spare: Vec::new(),
            places: vec![0; size],
            gathered: vec![0.0; tallest],
            supernodes,
        }
    }

    /// Factors; false where a pivot is not positive.
    pub(super) fn factor(&mut self, normal: &Normal) -> bool {
        for (index, node) in self.supernodes.iter().enumerate() {
            let [width, height] = [node.width(), node.height()];
            let below = height - width;
            let panel = &mut self.values[node.offset..node.offset + width * height];
            let mut remainder = self.spare.pop().unwrap_or_default();
            remainder.resize(below * below, 0.0);
            (0..below).for_each(|j| remainder[j * below + j..(j + 1) * below].fill(0.0));
            panel.fill(0.0);
            for (place, row) in (node.first..node.end).chain(node.rows.iter().map(|&row| row as usize)).enumerate() {
                self.places[row] = place as u32;
            }
            for (column, values) in panel.chunks_exact_mut(height).enumerate() {
                let entries = normal.starts[node.first + column]..normal.starts[node.first + column + 1];
                for (&row, value) in normal.rows[entries.clone()].iter().zip(&normal.values[entries]) {
                    values[self.places[row] as usize] += value;
                }
            }
            for &child in &node.children {
                let rows = &self.supernodes[child as usize].rows;
                let added = std::mem::take(&mut self.remainders[child as usize]);
                for (j, column) in added.chunks_exact(rows.len().max(1)).enumerate() {
                    let across = self.places[rows[j] as usize] as usize;
                    let target = if across < width {
                        &mut panel[across * height..(across + 1) * height]
                    } else {
                        &mut remainder[(across - width) * below..(across - width + 1) * below]
                    };
                    let up = if across < width { 0 } else { width };
                    for (row, value) in rows[j..].iter().zip(&column[j..]) {
                        target[self.places[*row as usize] as usize - up] += value;
                    }
                }
                self.spare.push(added);
            }
            if factor_panel(panel, [height, width], height, &|_| 0.0).is_err() {
                self.remainders.iter_mut().for_each(|left| *left = Vec::new());
                self.spare.push(remainder);
                return false;
            }
            let under = Block::new(panel, [height, width], height).rows_from(width, below);
            for first in (0..below).step_by(STRIPE) {
                let columns = STRIPE.min(below - first);
                let (tall, short) = (under.rows_from(first, below - first), under.rows_from(first, columns));
                subtract_product(&mut remainder[first * below + first..], below, tall, short.transposed());
            }
            self.remainders[index] = remainder;
        }
        true
    }

    /// Replaces the columns of `right` (n rows each, one after the other) by N^-1 times them.
    pub(super) fn solve(&mut self, right: &mut [f64]) {
        for x in right.chunks_exact_mut(self.size.max(1)) {
            for node in &self.supernodes {
                let [width, height] = [node.width(), node.height()];
                let panel = self.values[node.offset..].chunks_exact(height.max(1)).take(width);
                let (own, below) = self.gathered[..height].split_at_mut(width);
                own.copy_from_slice(&x[node.first..node.end]);
                below.fill(0.0);
                for (j, column) in panel.enumerate() {
                    let value = own[j] / column[j];
                    own[j] = value;
                    own[j + 1..].iter_mut().zip(&column[j + 1..]).for_each(|(x, entry)| *x -= entry * value);
                    below.iter_mut().zip(&column[width..]).for_each(|(x, entry)| *x -= entry * value);
                }
                x[node.first..node.end].copy_from_slice(own);
                node.rows.iter().zip(&*below).for_each(|(&row, change)| x[row as usize] += change);
            }
            for node in self.supernodes.iter().rev() {
                let [width, height] = [node.width(), node.height()];
                let panel = &self.values[node.offset..node.offset + width * height];
                let known = &mut self.gathered[..height];
                known[..width].copy_from_slice(&x[node.first..node.end]);
                known[width..].iter_mut().zip(&node.rows).for_each(|(known, &row)| *known = x[row as usize]);
                for (j, column) in panel.chunks_exact(height.max(1)).enumerate().rev() {
                    known[j] = (known[j] - dot(&column[j + 1..], &known[j + 1..])) / column[j];
                }
                x[node.first..node.end].copy_from_slice(&known[..width]);
            }
        }
    }

    /// The same for many right sides at once, by products of dense blocks.
    pub(super) fn solve_many(&mut self, right: &mut [f64]) {
        let size = self.size.max(1);
        let count = right.len() / size;
        let (mut own, mut below) = (Vec::new(), Vec::new());
        let gather = |node: &Supernode, right: &[f64], own: &mut Vec<f64>| {
            own.clear();
            right.chunks_exact(size).for_each(|x| own.extend_from_slice(&x[node.first..node.end]));
        };
        let scatter = |node: &Supernode, right: &mut [f64], own: &[f64]| {
            let parts = right.chunks_exact_mut(size).zip(own.chunks_exact(node.width()));
            parts.for_each(|(x, own)| x[node.first..node.end].copy_from_slice(own));
        };
        for node in &self.supernodes {
            let [width, height] = [node.width(), node.height()];
            let panel = &self.values[node.offset..node.offset + width * height];
            gather(node, right, &mut own);
            for own in own.chunks_exact_mut(width) {
                for (j, column) in panel.chunks_exact(height).enumerate() {
                    let value = own[j] / column[j];
                    own[j] = value;
                    own[j + 1..].iter_mut().zip(&column[j + 1..]).for_each(|(x, entry)| *x -= entry * value);
                }
            }
            scatter(node, right, &own);
            let deep = height - width;
            if deep > 0 {
                below.clear();
                below.resize(deep * count, 0.0);
                let [panel, own] =
                    [Block::new(&panel[width..], [deep, width], height), Block::new(&own, [width, count], width)];
                subtract_product(&mut below, deep, panel, own);
                for (x, below) in right.chunks_exact_mut(size).zip(below.chunks_exact(deep)) {
                    node.rows.iter().zip(below).for_each(|(&row, change)| x[row as usize] += change);
                }
            }
        }
        for node in self.supernodes.iter().rev() {
            let [width, height] = [node.width(), node.height()];
            let panel = &self.values[node.offset..node.offset + width * height];
            gather(node, right, &mut own);
            let deep = height - width;
            if deep > 0 {
                below.clear();
                right.chunks_exact(size).for_each(|x| below.extend(node.rows.iter().map(|&row| x[row as usize])));
                let [panel, below] =
                    [Block::new(&panel[width..], [deep, width], height), Block::new(&below, [deep, count], deep)];
                subtract_product(&mut own, width, panel.transposed(), below);
            }
            for own in own.chunks_exact_mut(width) {
                for (j, column) in panel.chunks_exact(height).enumerate().rev() {
                    own[j] = (own[j] - dot(&column[j + 1..width], &own[j + 1..])) / column[j];
                }
            }
            scatter(node, right, &own);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::super::sparse::SparseRows;
    use super::*;

    /// Second differences along and across a net of `a` times `b`, and the identity.
    fn energy(a: usize, b: usize) -> SparseRows {
        let mut entries = Vec::new();
        let mut add = |stencil: [(usize, f64); 3]| {
            for (i, p) in stencil {
                for (j, q) in stencil {
                    entries.push((i, j, p * q));
                }
            }
        };
        for i in 0..a {
            for j in 0..b {
                let at = |i: usize, j: usize| i * b + j;
                if i + 2 < a {
                    add([(at(i, j), 1.0), (at(i + 1, j), -2.0), (at(i + 2, j), 1.0)]);
                }
                if j + 2 < b {
                    add([(at(i, j), 1.0), (at(i, j + 1), -2.0), (at(i, j + 2), 1.0)]);
                }
            }
        }
        (0..a * b).for_each(|k| entries.push((k, k, 1.0)));
        SparseRows::from_entries(a * b, a * b, &entries)
    }

    fn normal(a: usize, b: usize) -> (Normal, SparseRows) {
        let quadratic = energy(a, b);
        let none = SparseRows::new(a * b);
        let mut normal = Normal::new(&quadratic, &none, &[]);
        normal.assemble(&quadratic, &none, &[], &[]);
        (normal, quadratic)
    }

    #[test]
    fn solves_what_the_matrix_gives() {
        for (a, b) in [(1, 1), (1, 9), (7, 5), (30, 20), (60, 41)] {
            let (normal, matrix) = normal(a, b);
            let n = a * b;
            let mut factor = Factor::new(&normal);
            for _ in 0..2 {
                assert!(factor.factor(&normal));
                let x: Vec<f64> = (0..2 * n).map(|k| (k as f64 * 0.7).sin()).collect();
                let mut right: Vec<f64> =
                    x.chunks(n).flat_map(|x| (0..n).map(|row| matrix.dot(row, x)).collect::<Vec<_>>()).collect();
                let mut many = right.clone();
                factor.solve(&mut right);
                factor.solve_many(&mut many);
                let apart = right.iter().zip(&many).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
                assert!(apart < 1e-13, "{a} x {b}: {apart:e}");
                let off = x.iter().zip(&right).map(|(x, found)| (x - found).abs()).fold(0.0, f64::max);
                assert!(off < 1e-12, "{a} x {b}: {off:e}");
            }
        }
    }

    #[test]
    fn a_matrix_that_is_not_positive_definite_is_refused_and_the_next_is_factored() {
        let (mut normal, _) = normal(12, 9);
        let mut factor = Factor::new(&normal);
        let place = normal.starts[50];
        let kept = std::mem::replace(&mut normal.values[place], -1.0);
        assert!(!factor.factor(&normal));
        normal.values[place] = kept;
        assert!(factor.factor(&normal));
    }

    #[test]
    fn joined_columns_store_few_zeros() {
        let (normal, _) = normal(40, 30);
        let factor = Factor::new(&normal);
        let zeros: usize = factor.supernodes.iter().map(|node| node.zeros).sum();
        assert!(zeros < factor.values.len() / 4 && factor.supernodes.len() < 400, "{zeros}");
    }
}
