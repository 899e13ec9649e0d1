//! Boxes around things, in a tree: which of them meet a box.

/// Least and greatest coordinates \[m\].
pub(super) type Bounds = [[f64; 3]; 2];

/// Things below a node that is not divided.
const FEW: usize = 8;

pub(super) struct Node {
    pub(super) bounds: Bounds,
    /// What is below it, in the order of the tree.
    pub(super) range: [usize; 2],
    /// The second of its two nodes, of which the first follows it.
    pub(super) second: Option<usize>,
}

/// A tree of boxes.
pub(super) struct Boxes {
    boxes: Vec<Bounds>,
    pub(super) order: Vec<usize>,
    pub(super) nodes: Vec<Node>,
}

/// The box around points \[m\].
pub(super) fn around(points: impl Iterator<Item = [f64; 3]>) -> Bounds {
    points.fold([[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]], |[low, high], point| {
        [[0, 1, 2].map(|k| low[k].min(point[k])), [0, 1, 2].map(|k| high[k].max(point[k]))]
    })
}

/// A box that is larger by this on all sides.
pub(super) fn widened([low, high]: Bounds, by: f64) -> Bounds {
    [low.map(|c| c - by), high.map(|c| c + by)]
}

pub(super) fn meet(a: &Bounds, b: &Bounds) -> bool {
    (0..3).all(|k| a[0][k] <= b[1][k] && b[0][k] <= a[1][k])
}

impl Boxes {
    pub(super) fn new(boxes: Vec<Bounds>) -> Self {
        let order = (0..boxes.len()).collect();
        let mut tree = Self { boxes, order, nodes: Vec::new() };
        if !tree.order.is_empty() {
            tree.divide([0, tree.order.len()]);
        }
        tree
    }

    fn divide(&mut self, [from, to]: [usize; 2]) {
        let own = self.order[from..to].iter().flat_map(|&k| self.boxes[k]);
        let bounds = around(own);
        let at = self.nodes.len();
        self.nodes.push(Node { bounds, range: [from, to], second: None });
        if to - from <= FEW {
            return;
        }
        let extent = |k: &usize| bounds[1][*k] - bounds[0][*k];
        let axis = (0..3).max_by(|a, b| extent(a).total_cmp(&extent(b))).unwrap_or(0);
        let middle = from + (to - from) / 2;
        let boxes = &self.boxes;
        let place = |k: &usize| boxes[*k][0][axis] + boxes[*k][1][axis];
        self.order[from..to].select_nth_unstable_by((to - from) / 2, |a, b| place(a).total_cmp(&place(b)));
        self.divide([from, middle]);
        self.nodes[at].second = Some(self.nodes.len());
        self.divide([middle, to]);
    }

    /// Those that meet a box, rising.
    pub(super) fn meeting(&self, bounds: &Bounds) -> Vec<usize> {
        let mut found = Vec::new();
        let mut waiting = if self.nodes.is_empty() { Vec::new() } else { vec![0] };
        while let Some(at) = waiting.pop() {
            let node = &self.nodes[at];
            if !meet(&node.bounds, bounds) {
                continue;
            }
            if let Some(second) = node.second {
                waiting.extend([second, at + 1]);
            } else {
                let own = &self.order[node.range[0]..node.range[1]];
                found.extend(own.iter().filter(|k| meet(&self.boxes[**k], bounds)));
            }
        }
        found.sort_unstable();
        found
    }
}
