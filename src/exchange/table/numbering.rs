//! Where stations are counted from, and how far apart they are: distances, or numbers with AP and FP among them.

use super::header::{Axis, Coordinate, Corner, From, Position, is_aftward};
use super::problem::{FilePosition, Problems};
use super::settings::{Settings, StationScale, metres};
use crate::hull::StationDatum;
use crate::units::Notation;

/// Spaces between perpendiculars that drawings have.
const USUAL_SPACES: [f64; 2] = [20.0, 10.0];

/// A distance from the last station to a perpendicular of so many usual ones shows that the stations are numbered.
const JUMP: f64 = 3.0;

/// The half-breadth of a full end, over the largest, at least, and that of a fine one, over that of the full, at most.
/// Where no other is larger, the hull goes on there.
const FULL_END: std::ops::RangeInclusive<f64> = 0.2..=0.97;
const FINE_END: f64 = 0.25;

/// What settles from where stations count.
pub(super) const ORIGINS: &str =
    "Give stations = \"from FP\", \"from AP\", \"from midship\" or \"numbers from FP\" in the conventions";

/// Hulls end within this part of their length beyond the perpendiculars.
pub(super) const OVERHANG: f64 = 0.25;

/// Hulls whose length would be less than this many breadths may have numbers for stations.
const SHORT: f64 = 4.0;

/// Where positions of stations count from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Datum {
    pub(super) datum: StationDatum,
    /// The point from which distances count, where L_PP is not known and its place has to be assumed.
    pub(super) open: Option<From>,
}

impl std::convert::From<StationDatum> for Datum {
    fn from(datum: StationDatum) -> Self {
        Self { datum, open: None }
    }
}

/// No ship has more frames; what extends farther are distances.
const MOST_NUMBERS: f64 = 1000.0;

/// The positions of the stations of a table.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Origin {
    pub(super) datum: Datum,
    /// Whether they are numbers, and no distances.
    pub(super) numbers: bool,
    /// Distance between perpendiculars by the numbers of these \[m\].
    pub(super) length: Option<f64>,
}

/// Half-breadths that tell stations from lengths, and bow from stern.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Breadths {
    /// The largest \[m\].
    pub(super) largest: f64,
    /// The largest of the first station, and of the last, over the largest of all.
    pub(super) ends: [f64; 2],
    /// Whether the profile of the stem has greater distances than that of the stern, where both are given.
    pub(super) stem_is_beyond: Option<bool>,
}

impl Breadths {
    /// Whether the first station is at the fuller end, where one end is full and the other fine.
    pub(super) fn begins_full(&self) -> Option<bool> {
        let [first, last] = self.ends;
        let is_full = |full: f64, fine: f64| FULL_END.contains(&full) && fine <= FINE_END * full;
        if is_full(first, last) { Some(true) } else { is_full(last, first).then_some(false) }
    }

    /// Whether distances rise toward the bow, with the reason; `rises` where they rise in the order of the file.
    fn forward(&self, rises: bool) -> Option<(bool, &'static str)> {
        let by_profiles = self.stem_is_beyond.map(|beyond| (beyond, "by the profiles of stem and stern"));
        by_profiles.or_else(|| Some((self.begins_full()? == rises, "because the fuller end is the stern")))
    }
}

/// Positions in the order of the file, each once.
fn distinct(heads: &[Position]) -> Vec<Position> {
    let mut found: Vec<Position> = Vec::new();
    for head in heads {
        if !found.iter().any(|known| known.place == head.place) {
            found.push(*head);
        }
    }
    found
}

/// The number of a perpendicular among numbered stations: the one beside its name, else the whole number between its
/// neighbours, or beyond its only one.
fn number_of(heads: &[Position], end: From) -> Option<f64> {
    let at = heads.iter().position(|head| head.end == Some(end))?;
    if let Some(number) = heads[at].number() {
        return Some(number);
    }
    // A neighbour, and the one beyond it.
    let pair = |numbers: &mut dyn Iterator<Item = f64>| numbers.next().map(|near| (near, numbers.next()));
    let before = pair(&mut heads[..at].iter().rev().filter_map(Position::number));
    let after = pair(&mut heads[at + 1..].iter().filter_map(Position::number));
    let beyond = |(near, far): (f64, Option<f64>)| {
        let rises = near > far?;
        Some(if rises { (near + 1e-9).floor() + 1.0 } else { (near - 1e-9).ceil() - 1.0 })
    };
    match (before, after) {
        (Some((a, _)), Some((b, _))) => {
            let whole = (0.5 * (a + b)).round();
            (a.min(b) < whole && whole < a.max(b)).then_some(whole)
        }
        (Some(only), None) | (None, Some(only)) => beyond(only),
        (None, None) => None,
    }
}

/// Whether AP and FP stand among numbers: as distances one of them would be far from its neighbours, or nowhere.
fn shows_numbers(heads: &[Position], length: Option<f64>) -> bool {
    let [aft, fore] = [From::AftPerpendicular, From::ForePerpendicular].map(|end| number_of(heads, end));
    let unwritten = |end: Coordinate| heads.iter().any(|head| head.place == end);
    let (Some(aft), Some(fore)) = (aft, fore) else { return false };
    if !unwritten(Coordinate::ForePerpendicular) {
        return false;
    }
    let mut numbers: Vec<f64> = heads.iter().filter_map(Position::number).collect();
    numbers.sort_by(f64::total_cmp);
    let Some(usual) = usual_step(&numbers) else { return false };
    match length {
        Some(length) => {
            let gap = numbers.iter().map(|number| (length - number).abs()).fold(f64::INFINITY, f64::min);
            gap > JUMP * usual && (fore - aft).abs() < length
        }
        None => usual <= 1.0 && numbers.iter().all(|number| (4.0 * number).fract().abs() < 1e-9),
    }
}

/// From where stations count where nobody states it: by the numbers of the perpendiculars.
fn counted_from(aft: Option<f64>, fore: Option<f64>, [low, high]: [f64; 2]) -> Option<From> {
    let near_low = |number: f64| number - low < high - number;
    match (aft, fore) {
        (Some(aft), Some(fore)) => Some(aft < fore),
        (Some(aft), None) => Some(near_low(aft)),
        (None, Some(fore)) => Some(!near_low(fore)),
        (None, None) => None,
    }
    .map(|from_aft| if from_aft { From::AftPerpendicular } else { From::ForePerpendicular })
}

/// Where stations are counted from, and how far apart they are.
pub(super) fn origin(
    settings: &Settings,
    corner: Corner,
    heads: &[Position],
    breadths: Breadths,
    problems: &mut Problems,
) -> Origin {
    let length = settings.stated.length_between_perpendiculars;
    let heads = distinct(heads);
    let numbers: Vec<f64> = heads.iter().filter_map(Position::number).collect();
    let (low, high) = numbers.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), &n| (a.min(n), b.max(n)));
    let named = heads.iter().filter(|p| p.named || matches!(p.axis, Some(Axis::Station | Axis::Frame))).count();
    let says = if corner.rows.is_some_and(Axis::is_station) { corner.rows } else { corner.columns };
    let own_unit = corner.x_unit.or(corner.unit);
    // A sentence counts where no key and no header says it.
    let said = settings.sentences.stations.as_ref().filter(|(scale, _)| {
        let is_open = settings.stations.is_none() && corner.from.is_none();
        is_open && (!scale.numbers || says != Some(Axis::X))
    });
    if let Some((scale, words)) = said.filter(|(scale, _)| scale.numbers || scale.from != From::AftPerpendicular) {
        let what = if scale.numbers { "numbered" } else { "given by their distances" };
        let message = format!("'{words}' says that stations are {what} from {}", scale.from.as_str());
        problems.warning("W320", FilePosition::FILE, message, "Give stations in the conventions if it does not");
    }
    let stated = settings.stations.or(said.map(|(scale, _)| *scale));
    let end = settings.sentences.end.as_ref().filter(|_| stated.is_none() && corner.from.is_none());
    if let Some((from, words)) = end {
        let message = format!("'{words}' says that stations count from {}", from.as_str());
        problems.warning("W320", FilePosition::FILE, message, "Give stations in the conventions if it does not");
    }
    let corner = Corner { from: corner.from.or(end.map(|(from, _)| *from)), ..corner };
    let scale = stated.unwrap_or_else(|| {
        let are_numbers = match says {
            Some(Axis::Station) if own_unit.is_none() && are_distances(&numbers, settings) => {
                let message = format!(
                    "stations {low} to {high} are taken as distances, and not as numbers: they are not what stations are \
                     numbered by"
                );
                let remedy = "Give station_spacing in the conventions if they are numbers, or x_units";
                problems.warning("W320", FilePosition::FILE, message, remedy);
                false
            }
            Some(Axis::Station | Axis::Frame) if own_unit.is_none() && high - low <= MOST_NUMBERS => true,
            Some(Axis::X) => false,
            _ if 2 * named > heads.len() && high - low <= MOST_NUMBERS => true,
            // Numbers count a spacing that is stated, and L_PP where they reach far less than it.
            _ if own_unit.is_none() && counts(&numbers, [low, high]) && is_shorter(high - low, length, settings) => true,
            _ if own_unit.is_none() && is_spaced(&numbers, settings) => true,
            // Without words, or with a unit beside them: a hull that would be shorter than it is broad counts its
            // stations.
            _ => {
                let length = corner.x_unit.or(corner.unit).map_or(high - low, |unit| unit.metres(high - low));
                numbers.len() > 1 && length < 2.0 * breadths.largest
            }
        };
        let are_numbers = are_numbers || shows_numbers(&heads, length);
        StationScale { from: corner.from.unwrap_or(From::AftPerpendicular), numbers: are_numbers }
    });
    if !scale.numbers
        && let Some(spacing) = settings.station_spacing.filter(|_| !numbers.is_empty())
        && usual_step(&numbers).is_none_or(|step| {
            let unit = own_unit.or(settings.units).unwrap_or(Notation::Metres);
            (unit.metres(step) / spacing - 1.0).abs() > 1e-3
        })
    {
        let message = format!("station_spacing {} m is not used: stations stand at distances", metres(spacing));
        let remedy = "Give stations = \"numbers from AP\" in the conventions if they are numbers, or leave the key out";
        problems.warning("W332", FilePosition::FILE, message, remedy);
    }
    let is_stated = stated.is_some() || settings.units.or(settings.x_units).or(corner.unit).or(corner.x_unit).is_some();
    let is_short = high - low < 2.0 * SHORT * breadths.largest;
    if !scale.numbers && !is_stated && says != Some(Axis::X) && is_short && counts(&numbers, [low, high]) {
        let message = format!(
            "stations {low} to {high} are taken as distances, and may be numbers: the hull is {} long and {} broad",
            high - low,
            2.0 * breadths.largest
        );
        let remedy = "Give stations = \"from AP\", or \"numbers from FP\" with Lpp, in the conventions";
        problems.warning("W320", FilePosition::FILE, message, remedy);
    }
    // Labels with a unit are distances.
    if !scale.numbers || numbers.is_empty() {
        let aftward = corner.aftward
            || said.map(|(_, words)| words).or(end.map(|(_, words)| words)).is_some_and(|words| is_aftward(words));
        let is_open = stated.is_none() && corner.from.is_none();
        let (from, aftward) = match is_open {
            false => (Some(scale.from), aftward),
            true => by_signs(&heads, breadths, problems).map_or((None, false), |(from, aft)| (Some(from), aft)),
        };
        let datum = distances(from, aftward, extremes(&heads), length, problems);
        return Origin { datum, numbers: scale.numbers, length: None };
    }
    let [aft, fore] = [From::AftPerpendicular, From::ForePerpendicular].map(|end| number_of(&heads, end));
    let between = aft.zip(fore).map(|(aft, fore)| (fore - aft).abs()).filter(|spaces| *spaces > 0.0);
    let of_frames = heads.iter().filter(|p| p.axis == Some(Axis::Frame)).count();
    let are_frames = says == Some(Axis::Frame) || 2 * of_frames > heads.len();
    let said = settings.sentences.frames.as_ref().filter(|_| are_frames).or(settings.sentences.spacing.as_ref());
    let spacing = spacing(settings, corner, said, (between, [low, high]), problems);
    let is_open = stated.is_none() && corner.from.is_none();
    if let Some((from, aftward)) =
        Some(breadths).filter(|_| is_open).and_then(|known| by_signs(&heads, known, problems))
    {
        let offset = match from {
            From::AftPerpendicular => 0.0,
            From::ForePerpendicular => length.unwrap_or(-low * spacing),
            From::Midship => 0.5 * length.unwrap_or((high - low) * spacing),
        };
        let datum = StationDatum::Numbers { offset, spacing: if aftward { -spacing } else { spacing } };
        return Origin { datum: datum.into(), numbers: true, length: None };
    }
    let by_ends = counted_from(aft, fore, [low, high]).filter(|_| is_open);
    let rises = numbers.first() < numbers.last();
    let by_breadths = breadths
        .begins_full()
        .filter(|_| is_open && by_ends.is_none())
        .map(|begins_full| if begins_full == rises { From::AftPerpendicular } else { From::ForePerpendicular });
    if is_open && by_ends.is_none() {
        let end = if by_breadths == Some(From::ForePerpendicular) { "FP" } else { "AP" };
        let zero = if begins_with_one([low, high]) { 1 } else { 0 };
        let why = by_breadths.map_or("", |_| ", because the fuller end is the stern");
        let message = format!(
            "stations are numbered, and nothing says from which end: {zero} is taken as {end}{why}. From the other end the hull is \
             turned about, and LCB changes its sign"
        );
        let remedy = "Give stations = \"numbers from AP\" or \"numbers from FP\" in the conventions";
        problems.warning("W320", FilePosition::FILE, message, remedy);
    }
    let by_ends = by_ends.or(by_breadths);
    let from = by_ends.unwrap_or(scale.from);
    // Numbers may begin with 1, not with 0.
    let first = begins_with_one([low, high]).then_some(1.0);
    if first.is_some() && !is_open && aft.or(fore).is_none() {
        let message = format!("stations are numbered 1 to {high}: 1 is taken as {}", from.as_str());
        problems.warning(
            "W320",
            FilePosition::FILE,
            message,
            "Give 0 for the station at the perpendicular if it is not",
        );
    }
    let (aft, fore) = match from {
        From::AftPerpendicular => (aft.or(first), fore),
        From::ForePerpendicular => (aft, fore.or(first)),
        From::Midship => (aft, fore),
    };
    let spaces = settings.spaces.or(corner.spaces).or(between).or(settings.sentences.spaces).or(usual([low, high]));
    let length = length.or(spaces.filter(|_| between.is_some()).map(|spaces| spaces * spacing));
    let datum = match from {
        From::ForePerpendicular => {
            // Without L_PP the last number is AP.
            let known = length.or(spaces.map(|n| n * spacing)).unwrap_or(high * spacing);
            let offset = known + fore.unwrap_or(0.0) * spacing;
            problems.note(format!("station {} is FP, {} m forward of AP", fore.unwrap_or(0.0), metres(known)));
            StationDatum::Numbers { offset, spacing: -spacing }
        }
        From::Midship => StationDatum::Numbers { offset: 0.5 * length.unwrap_or(0.0), spacing },
        From::AftPerpendicular => StationDatum::Numbers { offset: -aft.unwrap_or(0.0) * spacing, spacing },
    };
    Origin { datum: datum.into(), numbers: true, length: between.map(|spaces| spaces * spacing) }
}

/// Whether numbers in a column of stations are distances: such as no station is numbered by, and where a unit is declared,
/// in steps that no numbers of stations have.
fn are_distances(numbers: &[f64], settings: &Settings) -> bool {
    let is_written = |number: &f64| ((20.0 * number) - (20.0 * number).round()).abs() < 1e-6;
    if settings.station_spacing.or(settings.spaces).is_some() || settings.sentences.spacing.is_some() {
        return false;
    }
    let length = settings.stated.length_between_perpendiculars;
    let unit = settings.units.unwrap_or(Notation::Metres);
    let extent = numbers.last().zip(numbers.first()).map_or(0.0, |(a, b)| (a - b).abs());
    let is_length = length.is_none_or(|length| (unit.metres(extent) / length - 1.0).abs() < OVERHANG);
    let strides = usual_step(numbers).is_some_and(|step| step > LARGEST_COUNT);
    is_length && (numbers.iter().any(|number| !is_written(number)) || settings.units.is_some() && strides)
}

/// Numbers of stations are no farther apart.
const LARGEST_COUNT: f64 = 2.5;

/// The step that is in the middle of all between neighbours.
fn usual_step(numbers: &[f64]) -> Option<f64> {
    let mut steps: Vec<f64> = numbers.windows(2).map(|pair| (pair[1] - pair[0]).abs()).collect();
    steps.sort_by(f64::total_cmp);
    steps.get(steps.len() / 2).copied()
}

/// Whether numbers of metres, or of the unit of the table, extend over less than half of L_PP.
fn is_shorter(extent: f64, length: Option<f64>, settings: &Settings) -> bool {
    let unit = settings.units.unwrap_or(Notation::Metres);
    length.is_some_and(|length| unit.metres(extent) < 0.5 * length)
}

/// Whether a spacing of stations is stated that numbers count, and do not have already.
fn is_spaced(numbers: &[f64], settings: &Settings) -> bool {
    let said = settings.sentences.spacing.as_ref().map(|(spacing, _)| *spacing);
    let Some(step) = usual_step(numbers) else { return false };
    let unit = settings.units.unwrap_or(Notation::Metres);
    let quarters = numbers.iter().all(|number| (4.0 * number).fract().abs() < 1e-9);
    match settings.station_spacing.or(said) {
        Some(spacing) => quarters && (unit.metres(step) / spacing - 1.0).abs() > 1e-3,
        None => quarters && settings.spaces.is_some(),
    }
}

/// Distances among positions, in units of the table and in metres alike.
fn lengths(heads: &[Position]) -> impl Iterator<Item = f64> {
    heads.iter().filter_map(|head| match head.place {
        Coordinate::Number(distance) | Coordinate::Length(distance) => Some(distance),
        _ => None,
    })
}

/// The point from which distances of both signs, or negative ones, count where no word states it, and whether those from
/// midship are positive aft. No hull goes on farther beyond a perpendicular than [`OVERHANG`] of its length.
fn by_signs(heads: &[Position], breadths: Breadths, problems: &mut Problems) -> Option<(From, bool)> {
    let [low, high] = extremes(heads);
    let overhang = OVERHANG * (high - low);
    if -low <= overhang || heads.iter().any(|head| head.end.is_some()) {
        return None;
    }
    let rises = lengths(heads).next() < lengths(heads).last();
    let known = breadths.forward(rises);
    let (forward, why) = known.unwrap_or((true, "and nothing tells which end is the bow"));
    let from = match (high > overhang, forward) {
        (true, _) => From::Midship,
        (false, true) => From::ForePerpendicular,
        (false, false) => From::AftPerpendicular,
    };
    let way = if forward { "forward" } else { "aft" };
    let message = format!(
        "stations from {} to {}, and no word says from where: taken from {}, positive {way}, {why}. The other way the hull is \
         turned about, and LCB changes its sign",
        metres(low),
        metres(high),
        from.as_str()
    );
    problems.warning("W320", FilePosition::FILE, message, ORIGINS);
    Some((from, !forward))
}

/// The least and the greatest distance among positions.
fn extremes(heads: &[Position]) -> [f64; 2] {
    let distances = lengths(heads);
    distances.fold([0.0, 0.0], |[low, high], distance| [low.min(distance), high.max(distance)])
}

/// Distances from the point that is stated, or from AP. A hull lies forward of AP and aft of FP, so that the numbers tell their
/// direction there.
fn distances(
    from: Option<From>,
    aftward: bool,
    [low, high]: [f64; 2],
    length: Option<f64>,
    problems: &mut Problems,
) -> Datum {
    let is_negative = -low > high;
    let (from, sign) = match from {
        None => return StationDatum::Lengths.into(),
        Some(From::AftPerpendicular) if !is_negative => return StationDatum::Lengths.into(),
        Some(from @ From::Midship) => (from, if aftward { -1.0 } else { 1.0 }),
        Some(from @ From::AftPerpendicular) => (from, -1.0),
        Some(from @ From::ForePerpendicular) => (from, if is_negative { 1.0 } else { -1.0 }),
    };
    if is_negative && from != From::Midship {
        let word = if from == From::AftPerpendicular { "forward of AP" } else { "aft of FP" };
        problems.note(format!("distances are negative {word}"));
    }
    let offset = match (from, length) {
        (From::AftPerpendicular, _) => Some(0.0),
        (From::Midship, Some(length)) => Some(0.5 * length),
        (From::ForePerpendicular, length) => length,
        (From::Midship, None) => None,
    };
    if let Some(offset) = offset.filter(|_| from != From::AftPerpendicular) {
        problems.note(format!("distances count from {}, which is {} m forward of AP", from.as_str(), metres(offset)));
    }
    let datum = StationDatum::Shifted { offset: offset.unwrap_or(0.0), sign };
    Datum { datum, open: Some(from).filter(|_| offset.is_none()) }
}

/// Twenty or ten spaces where the numbers end there, or one before with the other end one after 0; others have to be stated.
fn usual([low, high]: [f64; 2]) -> Option<f64> {
    let is = |a: f64, b: f64| (a - b).abs() < 1e-9;
    // -10 to 10 from midship are twenty spaces.
    let overhang = OVERHANG * (high - low);
    if -low > overhang && high > overhang {
        let spaces = 2.0 * (-low).min(high).floor();
        return USUAL_SPACES.into_iter().find(|&n| is(n, spaces));
    }
    USUAL_SPACES.into_iter().find(|&n| high >= n - 1e-9 && high < n + 2.0 || is(high, n - 1.0) && is(low, 1.0))
}

/// Whether stations are numbered from 1 at one perpendicular to one more than the usual spaces at the other.
fn begins_with_one([low, high]: [f64; 2]) -> bool {
    let is = |a: f64, b: f64| (a - b).abs() < 1e-9;
    is(low, 1.0) && USUAL_SPACES.into_iter().any(|n| is(high, n + 1.0))
}

/// Whether positions are such as numbers of stations are: quarters, mostly one apart, up to a usual number of spaces.
fn counts(numbers: &[f64], ends: [f64; 2]) -> bool {
    let mut sorted = numbers.to_vec();
    sorted.sort_by(f64::total_cmp);
    usual_step(&sorted).is_some_and(|step| (step - 1.0).abs() < 1e-9)
        && usual(ends).is_some()
        && numbers.iter().all(|number| (4.0 * number).fract().abs() < 1e-9)
}

/// The distance from one number to the next \[m\], perhaps as a sentence says it; `between` are the spaces between AP and FP,
/// where both are named.
fn spacing(
    settings: &Settings,
    corner: Corner,
    said: Option<&(f64, String)>,
    (between, [low, high]): (Option<f64>, [f64; 2]),
    problems: &mut Problems,
) -> f64 {
    let stated = settings.spaces.or(corner.spaces).or(between).or(settings.sentences.spaces);
    let spaces = stated.or(usual([low, high]));
    match (settings.station_spacing, settings.stated.length_between_perpendiculars, spaces) {
        (Some(spacing), _, _) => {
            problems.note(format!("stations are numbered; {} m from one number to the next", metres(spacing)));
            spacing
        }
        (None, length, _)
            if (length.is_none() || stated.is_none())
                && let Some((spacing, words)) = said =>
        {
            let message = format!("'{words}' says that stations are {} m apart", metres(*spacing));
            problems.warning(
                "W320",
                FilePosition::FILE,
                message,
                "Give station_spacing in the conventions if it does not",
            );
            *spacing
        }
        (None, Some(length), Some(spaces)) => {
            problems.note(format!("stations are numbered; {spaces} spaces in L_PP of {} m", metres(length)));
            length / spaces
        }
        (None, Some(length), None) => {
            let spaces = high - low.min(0.0);
            let message = format!(
                "stations are numbered {low} to {high}, and the number of spaces in L_PP of {} m is not known: taken as {spaces}",
                metres(length)
            );
            problems.warning(
                "W320",
                FilePosition::FILE,
                message,
                "Give spaces, or station_spacing, in the conventions",
            );
            if spaces > 0.0 { length / spaces } else { 1.0 }
        }
        _ => {
            let message =
                "stations are numbered and neither L_PP nor their spacing is known: taken as 1 m apart".to_owned();
            problems.warning("W320", FilePosition::FILE, message, "Give Lpp, or station_spacing, in the conventions");
            1.0
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::header::position;
    use super::*;

    fn heads(text: &str) -> Vec<Position> {
        text.split(',').map(|head| position(head, false).unwrap()).collect()
    }

    #[test]
    fn numbers_of_perpendiculars() {
        for (text, aft, fore) in [
            ("AP,1,2,3,FP", Some(0.0), Some(4.0)),
            ("FP,1,2,3,AP", Some(4.0), Some(0.0)),
            ("-1,AP,1,2,19.5,FP,20.5", Some(0.0), Some(20.0)),
            ("AP,0.25,0.5,1,9.75,FP", Some(0.0), Some(10.0)),
            ("0 (FP),1,2,20 (AP)", Some(20.0), Some(0.0)),
            ("0,1,2,3", None, None),
        ] {
            let heads = heads(text);
            let found = [From::AftPerpendicular, From::ForePerpendicular].map(|end| number_of(&heads, end));
            assert_eq!(found, [aft, fore], "{text}");
        }
    }

    #[test]
    fn distances_between_perpendiculars_are_no_numbers() {
        let of = |text: &str, length| shows_numbers(&heads(text), length);
        assert!(of("AP,1,2,3,4,5,6,7,8,9,FP", Some(100.0)) && of("AP,1,2,3,FP", None));
        assert!(!of("AP,10,20,30,40,50,60,70,80,90,FP", Some(100.0)) && !of("AP,10,20,30,FP", None));
        assert!(!of("0,1,2,3", Some(100.0)));
    }
}
