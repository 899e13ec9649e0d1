//! Places for names on curves: on the curve itself, clear of other curves and of other text, or beside it with a leader.

mod geometry;

use geometry::{Path, bounds, crosses};
pub(in crate::plot) use geometry::{length, meet, places_over};

use super::canvas::{Anchor, Canvas, Pen, Rectangle, TextStyle};

/// How many times farther aside than up a name may stand that has no place over its end.
pub(in crate::plot) const FLAT: f64 = 4.0;
/// Height of the foot of a thread over the end of its line, of the unit of [`places_over`].
const THREAD_FOOT: f64 = 0.25;

/// Where a name is wanted on its curve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::plot) struct Preference {
    /// Part of the length of the curve.
    pub(in crate::plot) part: f64,
    /// Crossings with other curves that it may cover at most.
    pub(in crate::plot) crossings: usize,
    /// Whether it may stand beside its curve, where there is no clear place on it.
    pub(in crate::plot) beside: bool,
}

/// Length of the heads of arrows, and what stays free around them \[mm\].
const HEAD: f64 = 1.6;
const AROUND_HEAD: f64 = 0.5;

/// Chords of a curve that are looked at together.
const PIECE: usize = 16;

/// Keeps the text of a drawing apart, and off the curves.
#[derive(Debug, Default)]
pub(in crate::plot) struct LabelPlacer {
    curves: Vec<Vec<[f64; 2]>>,
    /// Whether a name may cross the curve where there is no other place.
    faint: Vec<bool>,
    /// The rectangles around the curves.
    bounds: Vec<Rectangle>,
    /// The rectangles around every [`PIECE`] chords of them.
    pieces: Vec<Vec<Rectangle>>,
    /// Teeth of combs, which names keep off where they can.
    teeth: Vec<[[f64; 2]; 2]>,
    taken: Vec<Rectangle>,
    leaders: Vec<[[f64; 2]; 2]>,
    /// Ends of lines over which no other name stands.
    ends: Vec<[f64; 2]>,
    /// Both sides of the heads of arrows.
    heads: Vec<[[f64; 2]; 2]>,
}

impl LabelPlacer {
    /// Curves that names keep off.
    pub(in crate::plot) fn add_curve(&mut self, points: &[[f64; 2]]) {
        let around = |part: &[[f64; 2]]| bounds(part).grown(1e-6);
        let parts = (0..points.len().saturating_sub(1)).step_by(PIECE);
        self.pieces.push(parts.map(|k| around(&points[k..(k + PIECE + 1).min(points.len())])).collect());
        self.bounds.push(around(points));
        self.curves.push(points.to_vec());
        self.faint.push(false);
    }

    /// Curves that names keep off where they can, as the tips of combs.
    pub(in crate::plot) fn add_faint(&mut self, points: &[[f64; 2]]) {
        self.add_curve(points);
        if let Some(last) = self.faint.last_mut() {
            *last = true;
        }
    }

    /// Teeth of a comb, foot and tip.
    pub(in crate::plot) fn add_teeth(&mut self, teeth: &[[[f64; 2]; 2]]) {
        self.teeth.extend_from_slice(teeth);
    }

    /// A place that is taken.
    pub(in crate::plot) fn take(&mut self, place: Rectangle) {
        self.taken.push(place);
    }

    /// The end of a line, over which only its own name stands: [`LabelPlacer::name_off_curves`].
    pub(in crate::plot) fn add_end(&mut self, end: [f64; 2]) {
        self.ends.push(end);
    }

    /// An arrow, foot and tip, which no name crosses.
    pub(in crate::plot) fn add_arrow(&mut self, arrow: [[f64; 2]; 2]) {
        self.leaders.push(arrow);
        let [foot, tip] = arrow;
        let along = [tip[0] - foot[0], tip[1] - foot[1]];
        let length = along[0].hypot(along[1]).max(1e-9);
        let [x, y] = along.map(|c| HEAD.min(length) * c / length);
        let corner = |side: f64| [tip[0] - x - 0.4 * side * y, tip[1] - y + 0.4 * side * x];
        self.heads.extend([-1.0, 1.0].map(|side| [tip, corner(side)]));
    }

    /// Writes `name` beside an arrow of [`LabelPlacer::add_arrow`], inside `window` and off every text and arrow, where
    /// it meets fewest curves; where there is no room beside it, farther off with a thread of `pen`. False when there is
    /// no place at all.
    pub(in crate::plot) fn name_arrow(
        &mut self,
        canvas: &mut Canvas,
        name: &str,
        style: &TextStyle,
        [foot, tip]: [[f64; 2]; 2],
        window: &Rectangle,
        pen: &Pen,
    ) -> bool {
        const FAR: [f64; 9] = [4.0, 6.5, 9.0, 12.0, 16.0, 21.0, 28.0, 36.0, 46.0];
        let style = TextStyle { anchor: Anchor::Middle, ..*style };
        let size = Canvas::text_place([0.0, 0.0], name, &style);
        let along = [tip[0] - foot[0], tip[1] - foot[1]];
        let length = along[0].hypot(along[1]).max(1e-9);
        let along = along.map(|c| c / length);
        // From the middle of the name to a line in the direction `way` past its rectangle.
        let clear = |way: [f64; 2]| 0.5 * (size.width() * way[0].abs() + size.height() * way[1].abs());
        let mut places: Vec<(f64, [f64; 2], bool)> =
            vec![(0.0, [0, 1].map(|d| tip[d] + (clear(along) + 1.5) * along[d]), false)];
        for (k, part) in [1.0, 0.75, 0.5, 0.25].into_iter().enumerate() {
            for way in [[-along[1], along[0]], [along[1], -along[0]]] {
                let at = [0, 1].map(|d| foot[d] + part * length * along[d] + (clear(way) + 1.3) * way[d]);
                places.push((0.1 * (k + 1) as f64, at, false));
            }
        }
        for k in 0..24 {
            let (s, c) = (std::f64::consts::PI * (f64::from(k) + 0.5) / 12.0).sin_cos();
            for far in FAR {
                let at = [tip[0] + (far + clear([c, s])) * c, tip[1] + (far + clear([c, s])) * s];
                places.push((1.0 + 0.15 * far, at, true));
            }
        }
        let mut best: Option<Arrowed> = None;
        for (price, at, led) in places {
            let place = Canvas::text_place(at, name, &style).grown(0.1 * style.size);
            if best.as_ref().is_some_and(|(least, ..)| *least <= price)
                || !window.contains(&place)
                || !self.is_free(&place)
            {
                continue;
            }
            let thread = led.then(|| {
                let way = [at[0] - tip[0], at[1] - tip[1]];
                let far = way[0].hypot(way[1]).max(1e-9);
                let end = (far - clear(way.map(|c| c / far)) - 0.4).max(0.0) / far;
                [tip, [tip[0] + end * way[0], tip[1] + end * way[1]]]
            });
            let off = |thread: [[f64; 2]; 2]| {
                [0.05, 1.0].map(|t| [0, 1].map(|d| thread[0][d] + t * (thread[1][d] - thread[0][d])))
            };
            if thread.is_some_and(|thread| {
                self.taken.iter().any(|taken| crosses(taken, thread[0], thread[1]))
                    || self.leaders.iter().any(|&other| meet(off(thread), other))
            }) {
                continue;
            }
            let crossed = self.crossings(&place, &[]) + self.crossings_of(&place, &[], true);
            let cost = price + crossed as f64 + 0.7 * self.teeth_in(&place) as f64;
            if best.as_ref().is_none_or(|(least, ..)| cost < *least) {
                best = Some((cost, at, place, thread));
            }
        }
        let Some((_, at, place, thread)) = best else { return false };
        self.take(place);
        if let Some([from, to]) = thread {
            canvas.line(from, to, pen);
            self.leaders.push([from, to]);
        }
        canvas.text(at, name, &style);
        true
    }

    /// How many curves there are.
    pub(in crate::plot) fn curve_count(&self) -> usize {
        self.curves.len()
    }

    /// The chords of a curve that may be in `place`.
    fn chords(&self, curve: usize, place: &Rectangle) -> impl Iterator<Item = [[f64; 2]; 2]> {
        let points = &self.curves[curve];
        let near = self.bounds[curve].overlaps(place).then(|| self.pieces[curve].iter().enumerate());
        let near = near.into_iter().flatten().filter(|(_, around)| around.overlaps(place));
        near.flat_map(move |(k, _)| {
            points[PIECE * k..(PIECE * (k + 1) + 1).min(points.len())].windows(2).map(|w| [w[0], w[1]])
        })
    }

    fn crossings(&self, place: &Rectangle, own: &[usize]) -> usize {
        self.crossings_of(place, own, false)
    }

    /// Crossings with curves that are faint, or with all others.
    fn crossings_of(&self, place: &Rectangle, own: &[usize], faint: bool) -> usize {
        (0..self.curves.len())
            .filter(|k| !own.contains(k) && self.faint[*k] == faint)
            .map(|k| self.chords(k, place).filter(|[a, b]| crosses(place, *a, *b)).take(3).count())
            .sum()
    }

    /// Teeth of combs in a place; many are as bad as three.
    fn teeth_in(&self, place: &Rectangle) -> usize {
        let near = |[a, b]: &&[[f64; 2]; 2]| {
            a[0].min(b[0]) < place.right
                && a[0].max(b[0]) > place.left
                && a[1].min(b[1]) < place.bottom
                && a[1].max(b[1]) > place.top
        };
        self.teeth.iter().filter(near).filter(|[a, b]| crosses(place, *a, *b)).take(3).count()
    }

    /// Curves, tips and teeth of combs in a place.
    fn lines_in(&self, place: &Rectangle) -> usize {
        self.crossings(place, &[]) + self.crossings_of(place, &[], true) + self.teeth_in(place)
    }

    /// How far to the left `places` have to be moved, all by the same and at most by `farthest` \[mm\], to stand clear of
    /// lines, combs, arrows and text; where none of them is clear, the shift at which fewest lines are met.
    pub(in crate::plot) fn clear_shift(&self, places: &[Rectangle], farthest: f64) -> f64 {
        const STEP: f64 = 0.5;
        let met = |shift: f64| {
            let moved = places.iter().map(|r| Rectangle { left: r.left - shift, right: r.right - shift, ..*r });
            moved.map(|place| if self.is_free(&place) { self.lines_in(&place) } else { 10 }).sum::<usize>()
        };
        let shifts = (0..=(farthest.max(0.0) / STEP).floor() as i32).map(|k| STEP * f64::from(k));
        shifts.min_by_key(|shift| met(*shift)).unwrap_or(0.0)
    }

    /// Whether an arrow passes through a place.
    pub(in crate::plot) fn has_arrow(&self, place: &Rectangle) -> bool {
        self.leaders.iter().any(|&[a, b]| crosses(place, a, b)) || self.has_head(place)
    }

    /// Whether the head of an arrow stands in a place.
    fn has_head(&self, place: &Rectangle) -> bool {
        let around = place.grown(AROUND_HEAD);
        self.heads.iter().any(|&[a, b]| crosses(&around, a, b))
    }

    /// Writes `name` on curve number `curve` (in the order of [`LabelPlacer::add_curve`]), as near to the part that is
    /// preferred as there is room inside `window`; where every place meets another curve, at the place that meets fewest.
    /// False when every place meets other text or too many curves.
    pub(in crate::plot) fn name_curve(
        &mut self,
        canvas: &mut Canvas,
        curve: usize,
        name: &str,
        style: &TextStyle,
        preferred: Preference,
        window: &Rectangle,
    ) -> bool {
        self.name_curves(canvas, &[curve], name, style, preferred, window)
    }

    /// The same for curves that lie on each other: the name stands on the first of them, and may cover the others.
    pub(in crate::plot) fn name_curves(
        &mut self,
        canvas: &mut Canvas,
        curves: &[usize],
        name: &str,
        style: &TextStyle,
        preferred: Preference,
        window: &Rectangle,
    ) -> bool {
        const PLACES: usize = 160;
        let style = TextStyle { anchor: Anchor::Middle, ..*style };
        let Some(curve) = curves.first() else { return false };
        let path = Path::new(&self.curves[*curve]);
        let width = Canvas::text_place([0.0, 0.0], name, &style).width();
        let aside = 0.5 * width + 0.8 * style.size;
        let offsets: &[f64] = if preferred.beside { &[0.0, -1.0, 1.0] } else { &[0.0] };
        let mut best: Option<(f64, [f64; 2], Rectangle)> = None;
        for (k, &offset) in (0..=PLACES).flat_map(|k| offsets.iter().map(move |offset| (k, offset))) {
            let part = k as f64 / PLACES as f64;
            let Some(on) = path.point(part) else { continue };
            let at = [on[0] + offset * aside, on[1]];
            let place = Canvas::text_place(at, name, &style).grown(0.25 * style.size);
            if !window.contains(&place) || !self.is_free(&place) {
                continue;
            }
            let crossings = self.crossings(&place, if offset.abs() < 0.5 { curves } else { &[] });
            let faint = 0.7 * self.crossings_of(&place, &[], true) as f64 + 0.15 * self.teeth_in(&place) as f64;
            let cost = faint + crossings as f64 + 0.9 * (part - preferred.part).abs() + 0.6 * offset.abs();
            if crossings <= preferred.crossings && best.is_none_or(|(least, _, _)| cost < least) {
                best = Some((cost, at, place));
            }
        }
        let Some((_, at, place)) = best else { return false };
        self.take(place);
        canvas.text(at, name, &style.halo());
        true
    }

    /// Whether neither text nor a leader nor an arrow stands in `place`.
    fn is_free(&self, place: &Rectangle) -> bool {
        !self.taken.iter().any(|taken| taken.overlaps(place)) && !self.has_arrow(place)
    }

    /// Writes `name` off every curve and text inside `window`, with a leader of `pen` to curve number `curve`; the
    /// shortest leader that crosses fewest curves. False when there is no place.
    pub(in crate::plot) fn name_by_leader(
        &mut self,
        canvas: &mut Canvas,
        curve: usize,
        name: &str,
        style: &TextStyle,
        pen: &Pen,
        window: &Rectangle,
    ) -> bool {
        const PLACES: usize = 48;
        const LENGTHS: [f64; 7] = [3.0, 5.0, 7.5, 11.0, 15.0, 20.0, 26.0];
        /// Length of leader that is worth a curve not crossed [mm].
        const CROSSING: f64 = 2.5;
        let style = TextStyle { anchor: Anchor::Middle, ..*style };
        let path = Path::new(&self.curves[curve]);
        let width = Canvas::text_place([0.0, 0.0], name, &style).width();
        let directions: Vec<[f64; 2]> = (0..12)
            .map(|k| (std::f64::consts::PI * (f64::from(k) + 0.5) / 6.0).sin_cos())
            .map(|(s, c)| [c, s])
            .collect();
        let mut best: Option<Led> = None;
        for k in 1..PLACES {
            let Some(on) = path.point(k as f64 / PLACES as f64) else { continue };
            for [dx, dy] in &directions {
                for length in LENGTHS {
                    let tip = [on[0] + length * dx, on[1] + length * dy];
                    let at = [tip[0] + dx * (0.5 * width + 0.6), tip[1] + dy * 0.75 * style.size];
                    let place = Canvas::text_place(at, name, &style).grown(0.15 * style.size);
                    if best.as_ref().is_some_and(|(least, ..)| *least <= length)
                        || !window.contains(&place)
                        || !self.is_free(&place)
                        || self.crossings(&place, &[]) > 0
                    {
                        continue;
                    }
                    let leader = [on, tip];
                    if self.taken.iter().any(|taken| crosses(taken, on, tip))
                        || self.leaders.iter().any(|&other| meet(leader, other))
                    {
                        continue;
                    }
                    let around = bounds(&leader);
                    let crossed = (0..self.curves.len())
                        .filter(|&k| k != curve && self.chords(k, &around).any(|chord| meet(leader, chord)))
                        .count();
                    let combs = self.crossings_of(&place, &[], true) + self.teeth_in(&place);
                    let cost = length + CROSSING * crossed as f64 + combs as f64;
                    if best.as_ref().is_none_or(|(least, ..)| cost < *least) {
                        best = Some((cost, leader, at, place));
                    }
                }
            }
        }
        let Some((_, [on, tip], at, place)) = best else { return false };
        self.take(place);
        self.leaders.push([on, tip]);
        canvas.line(on, tip, pen);
        canvas.fill(&Rectangle::new(on[0], on[1], on[0], on[1]).grown(0.35), style.colour);
        canvas.text(at, name, &style);
        true
    }

    /// Writes `name` at the first of `places` inside `window` that is off every text, leader and curve, or else at that
    /// of them off text which meets fewest curves, a thread over other text counting as eight; with a thread of `pen`
    /// from `from` unless it is the first place. False when there is none.
    #[allow(clippy::too_many_arguments, reason = "all of them are the drawing in hand")]
    pub(in crate::plot) fn name_off_curves(
        &mut self,
        canvas: &mut Canvas,
        name: &str,
        style: &TextStyle,
        places: &[[f64; 2]],
        window: &Rectangle,
        (from, pen): ([f64; 2], &Pen),
    ) -> bool {
        let foot = |at: [f64; 2]| [at[0], at[1] + 0.5 * style.size];
        let over = |[x, y]: [f64; 2]| Rectangle::new(x - 0.6, y - 0.6 * style.size, x + 0.6, y + 0.6);
        let is_own = |end: [f64; 2]| (end[0] - from[0]).hypot(end[1] - from[1]) < 1e-6;
        let others: Vec<Rectangle> = self.ends.iter().filter(|end| !is_own(**end)).map(|end| over(*end)).collect();
        type Found = ((usize, usize), [f64; 2], Rectangle);
        let mut best: Option<Found> = None;
        for (k, &at) in places.iter().enumerate() {
            let place = Canvas::text_place(at, name, style).grown(0.12 * style.size);
            let apart =
                Rectangle { left: place.left - 0.3 * style.size, right: place.right + 0.3 * style.size, ..place };
            if !window.contains(&place) || !self.is_free(&apart) || others.iter().any(|end| end.overlaps(&place)) {
                continue;
            }
            let thread = [from, foot(at)];
            let clear = k == 0
                || !self.taken.iter().any(|taken| crosses(taken, thread[0], thread[1]))
                    && !self.leaders.iter().any(|&other| meet(thread, other));
            let crossed = self.lines_in(&place);
            let order = (crossed + 8 * usize::from(!clear), k);
            if best.as_ref().is_none_or(|(least, ..)| order < *least) {
                best = Some((order, at, apart));
            }
            if order.0 == 0 {
                break;
            }
        }
        let Some(((_, k), at, place)) = best else { return false };
        self.take(place);
        if k > 0 {
            canvas.line(from, foot(at), pen);
            self.leaders.push([from, foot(at)]);
        }
        canvas.text(at, name, style);
        true
    }

    /// Writes `name` at that of `places` inside `window` and off other text where it meets fewest curves.
    pub(in crate::plot) fn name_clear(
        &mut self,
        canvas: &mut Canvas,
        name: &str,
        style: &TextStyle,
        places: &[[f64; 2]],
        window: &Rectangle,
    ) {
        let free = places.iter().filter_map(|&at| {
            let place = Canvas::text_place(at, name, style).grown(0.1 * style.size);
            let blocked = !window.contains(&place) || !self.is_free(&place);
            (!blocked).then(|| (self.lines_in(&place), at, place))
        });
        if let Some((_, at, place)) = free.min_by_key(|(crossings, _, _)| *crossings) {
            self.take(place);
            canvas.text(at, name, style);
        }
    }

    /// Writes `name` at that of `places` off other text and heads of arrows and inside `window` where it meets fewest
    /// arrows, curves and combs, at the first of several, and returns which; none when there is none.
    pub(in crate::plot) fn name_point(
        &mut self,
        canvas: &mut Canvas,
        name: &str,
        style: &TextStyle,
        places: &[[f64; 2]],
        window: &Rectangle,
    ) -> Option<usize> {
        /// What an arrow that is crossed counts, in curves.
        const ARROW: usize = 4;
        let mut best: Option<(usize, usize, Rectangle)> = None;
        for (k, &at) in places.iter().enumerate() {
            let place = Canvas::text_place(at, name, style);
            if !window.contains(&place)
                || self.taken.iter().any(|taken| taken.overlaps(&place))
                || self.has_head(&place)
            {
                continue;
            }
            let met = if self.has_arrow(&place) { ARROW } else { 0 } + self.lines_in(&place);
            if best.as_ref().is_none_or(|(least, ..)| met < *least) {
                best = Some((met, k, place));
            }
            if met == 0 {
                break;
            }
        }
        let (_, k, place) = best?;
        // Names side by side need more room between them than names in rows.
        let (beside, above) = (0.5 * style.size, 0.08 * style.size);
        self.take(Rectangle::new(place.left - beside, place.top - above, place.right + beside, place.bottom + above));
        canvas.text(places[k], name, style);
        Some(k)
    }
}

/// Cost, position and place of a name beside an arrow, and its thread where it has one.
type Arrowed = (f64, [f64; 2], Rectangle, Option<[[f64; 2]; 2]>);

/// Cost, leader, position and place of a name with a leader.
type Led = (f64, [[f64; 2]; 2], [f64; 2], Rectangle);

#[cfg(test)]
mod tests;
