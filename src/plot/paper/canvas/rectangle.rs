//! Rectangles on a sheet, and what of a line or an area lies inside one.

use super::number;

/// A rectangle on the sheet [mm].
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::plot) struct Rectangle {
    pub(in crate::plot) left: f64,
    pub(in crate::plot) top: f64,
    pub(in crate::plot) right: f64,
    pub(in crate::plot) bottom: f64,
}

impl Rectangle {
    pub(in crate::plot) const fn new(left: f64, top: f64, right: f64, bottom: f64) -> Self {
        Self { left, top, right, bottom }
    }

    pub(in crate::plot) fn width(&self) -> f64 {
        self.right - self.left
    }

    pub(in crate::plot) fn height(&self) -> f64 {
        self.bottom - self.top
    }

    pub(in crate::plot) fn overlaps(&self, other: &Self) -> bool {
        self.left < other.right && other.left < self.right && self.top < other.bottom && other.top < self.bottom
    }

    pub(in crate::plot) fn contains(&self, other: &Self) -> bool {
        self.left <= other.left && other.right <= self.right && self.top <= other.top && other.bottom <= self.bottom
    }

    /// How far it is from a place in a direction of length 1 to its edges \[mm\]; nothing for a place outside.
    pub(in crate::plot) fn room(&self, from: [f64; 2], direction: [f64; 2]) -> f64 {
        let to_edge = |d: usize, low: f64, high: f64| {
            let end = if direction[d] > 0.0 { high } else { low };
            if direction[d] == 0.0 { f64::INFINITY } else { (end - from[d]) / direction[d] }
        };
        to_edge(0, self.left, self.right).min(to_edge(1, self.top, self.bottom)).max(0.0)
    }

    /// Place and size, as an element of SVG has them.
    pub(super) fn attributes(&self) -> String {
        let [x, y, width, height] = [self.left, self.top, self.width(), self.height()].map(number);
        format!("x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\"")
    }

    pub(in crate::plot) fn grown(&self, margin: f64) -> Self {
        Self::new(self.left - margin, self.top - margin, self.right + margin, self.bottom + margin)
    }
}

/// The pieces of a line inside a rectangle.
pub(super) fn inside(points: &[[f64; 2]], r: &Rectangle) -> Vec<Vec<[f64; 2]>> {
    let mut pieces: Vec<Vec<[f64; 2]>> = Vec::new();
    let mut open = false;
    for pair in points.windows(2) {
        let [a, b] = [pair[0], pair[1]];
        // Liang and Barsky (1984): the part of the segment inside the four half-planes.
        let (mut enter, mut leave) = (0.0f64, 1.0f64);
        for (start, step, low, high) in [(a[0], b[0] - a[0], r.left, r.right), (a[1], b[1] - a[1], r.top, r.bottom)] {
            if step.abs() < 1e-12 {
                if start < low || start > high {
                    enter = f64::INFINITY;
                }
            } else {
                let (t, s) = ((low - start) / step, (high - start) / step);
                enter = enter.max(t.min(s));
                leave = leave.min(t.max(s));
            }
        }
        if enter > leave {
            open = false;
            continue;
        }
        let at = |t: f64| {
            if t <= 0.0 {
                a
            } else if t >= 1.0 {
                b
            } else {
                [0, 1].map(|d| a[d] + t * (b[d] - a[d]))
            }
        };
        match pieces.last_mut().filter(|_| open && enter <= 0.0) {
            Some(piece) => piece.push(at(leave)),
            None => pieces.push(vec![at(enter), at(leave)]),
        }
        open = leave >= 1.0;
    }
    pieces
}

/// The part of a polygon inside a rectangle (Sutherland and Hodgman 1974).
pub(super) fn area_inside(points: &[[f64; 2]], r: &Rectangle) -> Vec<[f64; 2]> {
    let sides = [(0, 1.0, r.left), (0, -1.0, -r.right), (1, 1.0, r.top), (1, -1.0, -r.bottom)];
    sides.into_iter().fold(points.to_vec(), |polygon, (d, sign, limit)| {
        let beyond = |p: &[f64; 2]| sign * p[d] - limit;
        let mut part = Vec::with_capacity(polygon.len() + 2);
        for (k, p) in polygon.iter().enumerate() {
            let q = &polygon[(k + 1) % polygon.len()];
            let (a, b) = (beyond(p), beyond(q));
            if a >= 0.0 {
                part.push(*p);
            }
            if (a < 0.0) != (b < 0.0) {
                let t = a / (a - b);
                part.push([0, 1].map(|d| p[d] + t * (q[d] - p[d])));
            }
        }
        part
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_and_areas_are_cut_off_at_a_window() {
        let window = Rectangle::new(0.0, 0.0, 2.0, 2.0);
        let line = [[-1.0, 1.0], [1.0, 1.0], [1.0, 3.0], [1.5, 3.0], [1.5, 0.5]];
        assert_eq!(inside(&line, &window), [vec![[0.0, 1.0], [1.0, 1.0], [1.0, 2.0]], vec![[1.5, 2.0], [1.5, 0.5]]]);
        assert!(inside(&[[3.0, 0.0], [3.0, 2.0]], &window).is_empty());
        let corner = area_inside(&[[1.0, 1.0], [3.0, 1.0], [3.0, 3.0], [1.0, 3.0]], &window);
        assert_eq!(corner, [[1.0, 1.0], [2.0, 1.0], [2.0, 2.0], [1.0, 2.0]]);
        assert!(area_inside(&[[3.0, 3.0], [4.0, 3.0], [4.0, 4.0]], &window).is_empty());
    }
}
