//! Places for names on curves: on the curve itself, clear of other curves and of other text.

use super::canvas::{Anchor, Canvas, Rectangle, TextStyle};

/// Whether a segment passes through a rectangle.
fn crosses(r: &Rectangle, a: [f64; 2], b: [f64; 2]) -> bool {
    // Liang and Barsky (1984): the part of the segment inside the four half-planes.
    let (mut enter, mut leave) = (0.0f64, 1.0f64);
    for (start, step, low, high) in [(a[0], b[0] - a[0], r.left, r.right), (a[1], b[1] - a[1], r.top, r.bottom)] {
        if step.abs() < 1e-12 {
            if start < low || start > high {
                return false;
            }
        } else {
            let (t, s) = ((low - start) / step, (high - start) / step);
            enter = enter.max(t.min(s));
            leave = leave.min(t.max(s));
        }
    }
    enter <= leave
}

/// Where a name is wanted on its curve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Preference {
    /// Part of the length of the curve.
    pub(super) part: f64,
    /// Crossings with other curves that it may cover at most.
    pub(super) crossings: usize,
    /// Whether it may stand beside its curve, where there is no clear place on it.
    pub(super) beside: bool,
}

/// Keeps the text of a drawing apart, and off the curves.
#[derive(Debug, Default)]
pub(super) struct LabelPlacer {
    curves: Vec<Vec<[f64; 2]>>,
    taken: Vec<Rectangle>,
}

impl LabelPlacer {
    /// Curves that names keep off.
    pub(super) fn add_curve(&mut self, points: &[[f64; 2]]) {
        self.curves.push(points.to_vec());
    }

    /// A place that is taken.
    pub(super) fn take(&mut self, place: Rectangle) {
        self.taken.push(place);
    }

    /// How many curves there are.
    pub(super) fn curve_count(&self) -> usize {
        self.curves.len()
    }

    fn crossings(&self, place: &Rectangle, own: Option<usize>) -> usize {
        self.curves
            .iter()
            .enumerate()
            .filter(|(k, _)| Some(*k) != own)
            .map(|(_, curve)| curve.windows(2).filter(|w| crosses(place, w[0], w[1])).count().min(3))
            .sum()
    }

    /// Writes `name` on curve number `curve` (in the order of [`LabelPlacer::add_curve`]), as near to the part that is
    /// preferred as there is room inside `window`; where every place meets another curve, at the place that meets fewest.
    /// False when every place meets other text or too many curves.
    pub(super) fn name_curve(
        &mut self,
        canvas: &mut Canvas,
        curve: usize,
        name: &str,
        style: &TextStyle,
        preferred: Preference,
        window: &Rectangle,
    ) -> bool {
        const PLACES: usize = 160;
        let style = TextStyle { anchor: Anchor::Middle, ..*style };
        let path = Path::new(&self.curves[curve]);
        let width = Canvas::text_place([0.0, 0.0], name, &style).width();
        let aside = 0.5 * width + 0.8 * style.size;
        let offsets: &[f64] = if preferred.beside { &[0.0, -1.0, 1.0] } else { &[0.0] };
        let mut best: Option<(f64, [f64; 2], Rectangle)> = None;
        for (k, &offset) in (0..=PLACES).flat_map(|k| offsets.iter().map(move |offset| (k, offset))) {
            let part = k as f64 / PLACES as f64;
            let Some(on) = path.point(part) else { continue };
            let at = [on[0] + offset * aside, on[1]];
            let place = Canvas::text_place(at, name, &style).grown(0.25 * style.size);
            if !window.contains(&place) || self.taken.iter().any(|taken| taken.overlaps(&place)) {
                continue;
            }
            let crossings = self.crossings(&place, (offset.abs() < 0.5).then_some(curve));
            let cost = crossings as f64 + 0.9 * (part - preferred.part).abs() + 0.6 * offset.abs();
            if crossings <= preferred.crossings && best.is_none_or(|(least, _, _)| cost < least) {
                best = Some((cost, at, place));
            }
        }
        let Some((_, at, place)) = best else { return false };
        self.take(place);
        canvas.text(at, name, &style.halo());
        true
    }

    /// Writes `name` at that of `places` inside `window` and off other text where it meets fewest curves.
    pub(super) fn name_clear(
        &mut self,
        canvas: &mut Canvas,
        name: &str,
        style: &TextStyle,
        places: &[[f64; 2]],
        window: &Rectangle,
    ) {
        let free = places.iter().filter_map(|&at| {
            let place = Canvas::text_place(at, name, style).grown(0.1 * style.size);
            let blocked = !window.contains(&place) || self.taken.iter().any(|taken| taken.overlaps(&place));
            (!blocked).then(|| (self.crossings(&place, None), at, place))
        });
        if let Some((_, at, place)) = free.min_by_key(|(crossings, _, _)| *crossings) {
            self.take(place);
            canvas.text(at, name, style);
        }
    }

    /// Writes `name` at the first of `places` that keeps off other text and stays inside `window`, and returns
    /// which; none when none does.
    pub(super) fn name_point(
        &mut self,
        canvas: &mut Canvas,
        name: &str,
        style: &TextStyle,
        places: &[[f64; 2]],
        window: &Rectangle,
    ) -> Option<usize> {
        for (k, &at) in places.iter().enumerate() {
            let place = Canvas::text_place(at, name, style);
            if window.contains(&place) && !self.taken.iter().any(|taken| taken.overlaps(&place)) {
                // Names side by side need more room between them than names in rows.
                let (beside, above) = (0.35 * style.size, 0.08 * style.size);
                self.take(Rectangle::new(
                    place.left - beside,
                    place.top - above,
                    place.right + beside,
                    place.bottom + above,
                ));
                canvas.text(at, name, style);
                return Some(k);
            }
        }
        None
    }
}

/// Length of a polyline [mm].
pub(super) fn length(points: &[[f64; 2]]) -> f64 {
    points.windows(2).map(|w| (w[1][0] - w[0][0]).hypot(w[1][1] - w[0][1])).sum()
}

/// A polyline by the parts of its length.
struct Path<'a> {
    points: &'a [[f64; 2]],
    lengths: Vec<f64>,
}

impl<'a> Path<'a> {
    fn new(points: &'a [[f64; 2]]) -> Self {
        let mut lengths = vec![0.0];
        let mut sum = 0.0;
        for w in points.windows(2) {
            sum += (w[1][0] - w[0][0]).hypot(w[1][1] - w[0][1]);
            lengths.push(sum);
        }
        Self { points, lengths }
    }

    fn point(&self, part: f64) -> Option<[f64; 2]> {
        let target = part * self.lengths.last()?;
        let k = self.lengths.partition_point(|&length| length < target).clamp(1, self.points.len().max(2) - 1);
        let (a, b) = (self.points.get(k - 1)?, self.points.get(k)?);
        let step = self.lengths[k] - self.lengths[k - 1];
        let t = if step > 0.0 { (target - self.lengths[k - 1]) / step } else { 0.0 };
        Some([a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_segment_that_passes_a_corner_does_not_cross() {
        let r = Rectangle::new(0.0, 0.0, 2.0, 1.0);
        assert!(crosses(&r, [-1.0, 0.5], [3.0, 0.5]));
        assert!(crosses(&r, [0.5, 0.5], [0.6, 0.6]));
        assert!(!crosses(&r, [-1.0, 0.5], [0.5, -1.0]));
        assert!(!crosses(&r, [3.0, 0.0], [3.0, 1.0]));
    }

    #[test]
    fn names_keep_apart() {
        let mut canvas = Canvas::new(100.0, 50.0);
        let mut placer = LabelPlacer::default();
        placer.add_curve(&[[0.0, 25.0], [100.0, 25.0]]);
        placer.add_curve(&[[0.0, 26.0], [100.0, 26.0]]);
        let style = TextStyle::new(3.0, Anchor::Start);
        let sheet = canvas.sheet();
        assert!(placer.name_curve(
            &mut canvas,
            0,
            "first",
            &style,
            Preference { part: 0.5, crossings: 9, beside: false },
            &sheet
        ));
        assert!(placer.name_curve(
            &mut canvas,
            1,
            "second",
            &style,
            Preference { part: 0.5, crossings: 9, beside: false },
            &sheet
        ));
        let texts = canvas.texts();
        assert!(!texts[0].place.overlaps(&texts[1].place));
    }

    #[test]
    fn a_name_without_room_is_left_out() {
        let mut canvas = Canvas::new(10.0, 10.0);
        let mut placer = LabelPlacer::default();
        placer.add_curve(&[[0.0, 5.0], [10.0, 5.0]]);
        let style = TextStyle::new(3.0, Anchor::Start);
        let sheet = canvas.sheet();
        assert!(!placer.name_curve(
            &mut canvas,
            0,
            "a name too long for it",
            &style,
            Preference { part: 0.5, crossings: 9, beside: false },
            &sheet
        ));
        assert!(canvas.texts().is_empty());
    }
}
