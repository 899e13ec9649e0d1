//! What sentences beside a table say: from where stations count, how far apart lines are, and main dimensions.

use super::{Settings, StationScale, metres};
use crate::exchange::table::header::{From, plain_number};
use crate::exchange::table::problem::Problems;
use crate::exchange::table::ratio::slot;
use crate::hull::StatedParticulars;
use crate::units::{Notation, parse_length};

/// What sentences say of lines, each with its words.
#[derive(Debug, Clone, PartialEq, Default)]
pub(in crate::exchange::table) struct Sentences {
    /// Distance from one station number to the next \[m\].
    pub(in crate::exchange::table) spacing: Option<(f64, String)>,
    /// Distance from one frame to the next \[m\].
    pub(in crate::exchange::table) frames: Option<(f64, String)>,
    /// Distance from one number of a waterline to the next \[m\].
    pub(in crate::exchange::table) waterlines: Option<(f64, String)>,
    /// Distance from one number of a buttock to the next \[m\].
    pub(in crate::exchange::table) buttocks: Option<(f64, String)>,
    pub(in crate::exchange::table) stations: Option<(StationScale, String)>,
    /// The end from which stations count, by numbers or by distances.
    pub(in crate::exchange::table) end: Option<(From, String)>,
    /// The number of the station at the other end.
    pub(in crate::exchange::table) spaces: Option<f64>,
}

impl Sentences {
    /// Whether a sentence says from where stations count.
    pub(in crate::exchange::table) fn names_end(&self) -> bool {
        self.stations.is_some() || self.end.is_some()
    }
}

impl Settings {
    /// Takes what sentences say of lines: "Stations 3 ft apart", "Station spacing: 5 m", "Stations are numbered from the forward
    /// perpendicular", "station 0 is at FP", "x from FP", "Stations measured from the stem", "Waterline spacing 0.5 m".
    pub(in crate::exchange::table) fn prose(&mut self, comment: &str) {
        for sentence in sentences(comment) {
            let lower = spoken(sentence);
            let words = || comment.trim().to_owned();
            let known = &mut self.sentences;
            let apart = |names: &[&str]| spacing(&lower, names).map(|found| (found, words()));
            known.spacing = known.spacing.take().or_else(|| apart(&STATION_NAMES));
            known.frames = known.frames.take().or_else(|| apart(&["frame", "frames"]));
            known.waterlines = known.waterlines.take().or_else(|| apart(&["waterline", "waterlines", "wl", "wls"]));
            known.buttocks = known.buttocks.take().or_else(|| apart(&["buttock", "buttocks", "butt", "butts"]));
            if let Some((number, end)) = numbered_end(&lower).filter(|(number, _)| *number > 0.0) {
                known.spaces = known.spaces.or(Some(number));
                let from =
                    if end == From::ForePerpendicular { From::AftPerpendicular } else { From::ForePerpendicular };
                let scale = StationScale { from, numbers: true };
                known.stations = known.stations.take().or_else(|| Some((scale, words())));
            }
            known.stations = known.stations.take().or_else(|| Some((counted_from(&lower)?, words())));
            known.end = known.end.take().or_else(|| Some((stations_from(&lower)?, words())));
        }
    }

    /// Takes the main dimensions that a text states: `Lpp: 100 m, B = 16 m`.
    pub(in crate::exchange::table) fn dimensions(&mut self, text: &str, problems: &mut Problems) {
        for (name, length) in dimensions(text) {
            if let Some(slot @ None) = slot(&mut self.stated, &name) {
                *slot = Some(length);
                problems.note(format!("{name} is {} m by '{}'", metres(length), text.trim()));
            }
        }
    }
}

/// A sentence in small letters, with the perpendiculars in one writing.
fn spoken(sentence: &str) -> String {
    let writings =
        [("f.p.", "fp"), ("a.p.", "ap"), ("f. p.", "fp"), ("a. p.", "ap"), ("lpp/2", "midship"), ("l/2", "midship")];
    writings.iter().fold(sentence.to_lowercase(), |text, (written, plain)| text.replace(written, plain))
}

/// The sentences of a text: they end with semicolons, and with points before capital letters.
fn sentences(text: &str) -> Vec<&str> {
    let mut list = Vec::new();
    let mut from = 0;
    for (at, c) in text.char_indices() {
        let capital =
            text[at + c.len_utf8()..].strip_prefix(' ').is_some_and(|rest| rest.starts_with(char::is_uppercase));
        // `F. P.` and `M.V. ANNA` are no ends of sentences.
        let is_initial = text[from..at].rsplit([' ', '.']).next().is_some_and(|word| word.chars().count() < 2);
        if c == ';' || c == '.' && capital && !is_initial {
            list.push(&text[from..at]);
            from = at + 1;
        }
    }
    list.push(&text[from..]);
    list
}

/// Main dimensions with their lengths \[m\] in a text: `Lpp 100 m, B = 16 m`. Bare numbers and single letters count behind a
/// sign alone, and a bare length may be any.
pub(in crate::exchange::table) fn dimensions(text: &str) -> Vec<(String, f64)> {
    let parts = text
        .split(';')
        .flat_map(|part| part.split(", "))
        .flat_map(|part| part.split(" x "))
        .flat_map(|part| part.split(" / "));
    let found: Vec<NamedLength<'_>> = parts.filter_map(NamedLength::of).collect();
    // A letter with a unit is a dimension beside another that is named: `Lpp 120 m, B 18 m, T 7 m`; of three names bare
    // numbers are such too.
    let is_list = found.iter().filter(|part| part.has_unit).count() > 1;
    let is_long = found.len() > 2;
    let is_dimension = |part: &&NamedLength<'_>| {
        let is_named = part.has_sign || is_long || part.has_unit && (is_list || part.name.chars().count() > 1);
        let is_open = matches!(part.name.to_lowercase().as_str(), "l" | "length");
        is_named && !is_open && part.length > 0.0 && part.length < 1e5
    };
    found.iter().filter(is_dimension).map(|part| (part.name.to_owned(), part.length)).collect()
}

/// A part of a text that is the name of a main dimension and a length.
struct NamedLength<'t> {
    name: &'t str,
    /// A colon or a sign of equality stands between them.
    has_sign: bool,
    has_unit: bool,
    /// In metres, or as the bare number.
    length: f64,
}

impl<'t> NamedLength<'t> {
    fn of(part: &'t str) -> Option<Self> {
        let at = part.find(|c: char| c.is_ascii_digit())?;
        let (key, value) = (part[..at].trim(), part[at..].trim().trim_end_matches('.'));
        let name = key.trim_end_matches([':', '=', ' ']);
        slot(&mut StatedParticulars::default(), name)?;
        let bare = plain_number(value);
        let length = bare.or_else(|| parse_length(value).ok())?;
        Some(Self { name, has_sign: key.ends_with([':', '=']), has_unit: bare.is_none(), length })
    }
}

/// Words of a text: runs of letters and digits with decimal points.
fn words(text: &str) -> Vec<&str> {
    let words = text.split(|c: char| !c.is_alphanumeric() && c != '.').map(|word| word.trim_matches('.'));
    words.filter(|word| !word.is_empty()).collect()
}

/// The end of the hull, or midship, that the first word names, or the one behind an article.
fn end(words: &[&str]) -> Option<From> {
    let at = words.iter().position(|word| *word != "the")?;
    let word = words.get(at).filter(|_| at < 2)?;
    if *word == "transom" {
        return Some(From::AftPerpendicular);
    }
    From::of(word).or_else(|| From::end_of(word))
}

/// Words for stations, which have numbers or distances.
const STATIONS: [&str; 11] =
    ["station", "stations", "ordinate", "ordinates", "section", "sections", "stn", "sta", "st", "frame", "frames"];

/// Words for distances: these anywhere in a sentence, and others at its beginning.
const DISTANCES: [&str; 4] = ["x", "distances", "positions", "abscissae"];
const DISTANCE: [&str; 2] = ["distance", "position"];

/// Words between what counts and the point from which it does: "Stations are measured in metres from".
const FILLING: [&str; 31] = [
    "is",
    "are",
    "as",
    "in",
    "the",
    "of",
    "and",
    "m",
    "mm",
    "ft",
    "metres",
    "meters",
    "millimetres",
    "feet",
    "measured",
    "given",
    "taken",
    "counted",
    "reckoned",
    "counting",
    "count",
    "run",
    "positive",
    "longitudinal",
    "distances",
    "positions",
    "stations",
    "sections",
    "frames",
    "along",
    "ship",
];

/// The number of a station and the perpendicular at which a sentence puts it: "station 0 is at FP", "Station 20 = AP".
fn numbered_end(lower: &str) -> Option<(f64, From)> {
    let words = words(lower);
    let at = words.windows(2).position(|pair| STATIONS.contains(&pair[0]) && pair[1].parse::<f64>().is_ok())?;
    let rest = &words[at + 2..];
    let filling = rest.iter().take(3).take_while(|word| matches!(**word, "is" | "at" | "the" | "on" | "lies")).count();
    let end = end(&rest[filling..])?;
    Some((words[at + 1].parse().ok()?, end)).filter(|(number, end)| *number <= 0.0 || *end != From::Midship)
}

/// From where a sentence says that stations count, and whether they are numbers.
fn counted_from(lower: &str) -> Option<StationScale> {
    if let Some((number, from)) = numbered_end(lower) {
        return (number <= 0.0).then_some(StationScale { from, numbers: true });
    }
    let words = words(lower);
    let after = |word: &str| words.iter().position(|own| *own == word).map(|at| &words[at + 1..]);
    let has = |any: &[&str]| words.iter().any(|word| any.contains(word));
    if has(&STATIONS) && has(&["numbered"]) {
        let from = after("from").and_then(end)?;
        return Some(StationScale { from, numbers: true });
    }
    // "Stations in metres from AP".
    if let Some(from) = lengths_from(&words) {
        return Some(StationScale { from, numbers: false });
    }
    // "x from FP, positive aft", "Distances from the stem", "Distance aft of FP", "Origin at FP"; not "Distance from FP to AP".
    let is_distance = |at: usize| DISTANCES.contains(&words[at]) || at == 0 && DISTANCE.contains(&words[0]);
    let from = behind(&words, is_distance).or_else(|| origin(&words))?;
    Some(StationScale { from, numbers: false })
}

/// The end in "stations in metres from AP": a unit says that they are distances.
fn lengths_from(words: &[&str]) -> Option<From> {
    let after = |at: usize| {
        let rest = &words[at + 1..];
        let filling = rest.iter().take_while(|word| FILLING.contains(*word)).count();
        let has_unit =
            rest.windows(2).take(filling).any(|pair| pair[0] == "in" && Notation::from_word(pair[1]).is_some());
        if has_unit { (0..=filling).find_map(|k| from_end(&rest[k..])) } else { None }
    };
    (0..words.len()).filter(|at| STATIONS.contains(&words[*at])).find_map(after)
}

/// The point in "Origin at FP", "origin of x: FP", "x = 0 at FP".
fn origin(words: &[&str]) -> Option<From> {
    let is_zero = |pair: &[&str]| pair[0] == "x" && pair[1] == "0";
    let origin = words.iter().position(|word| *word == "origin").map(|at| at + 1);
    let at = origin.or_else(|| words.windows(2).position(is_zero).map(|at| at + 2))?;
    let filling = ["of", "x", "is", "at", "stations", "for", "distances"];
    let rest = &words[at..];
    end(&rest[rest.iter().take_while(|word| filling.contains(*word)).count()..])
}

/// The end of the hull from which words count that `is_subject` finds, with nothing but filling words between.
fn behind(words: &[&str], is_subject: impl Fn(usize) -> bool) -> Option<From> {
    let after = |at: usize| {
        let rest = &words[at + 1..];
        let filling = rest.iter().take_while(|word| FILLING.contains(*word)).count();
        (0..=filling).find_map(|k| from_end(&rest[k..]))
    };
    (0..words.len()).filter(|&at| is_subject(at)).find_map(after)
}

/// The end of the hull in "from FP", "aft of midship"; none in "from FP to AP".
fn from_end(words: &[&str]) -> Option<From> {
    let rest = match words {
        ["from" | "abaft", rest @ ..] | ["aft" | "forward" | "fwd", "of" | "from", rest @ ..] => rest,
        _ => return None,
    };
    end(rest).filter(|_| !rest.iter().take(4).any(|word| *word == "to"))
}

/// The end in "Stations from FP", which may be distances or numbers.
fn stations_from(lower: &str) -> Option<From> {
    let words = words(lower);
    let starts = words.first().is_some_and(|word| matches!(*word, "measured" | "counted"));
    let from = if starts { from_end(&words[1..]) } else { None };
    from.or_else(|| behind(&words, |at| STATIONS.contains(&words[at])))
}

/// Lines are no farther apart \[m\]; larger bare numbers are millimetres.
const FARTHEST: f64 = 40.0;

/// Names of stations in sentences.
const STATION_NAMES: [&str; 9] =
    ["station", "stations", "sta", "stn", "stns", "section", "sections", "ordinate", "ordinates"];

/// Names of other lines in sentences.
const OTHER_NAMES: [&str; 10] =
    ["frame", "frames", "waterline", "waterlines", "wl", "wls", "buttock", "buttocks", "butt", "butts"];

/// Words for the distance between lines.
const SPACED: [&str; 7] = ["apart", "spacing", "spacings", "spaced", "interval", "intervals", "every"];

/// The parts of a sentence that speak of lines of one kind: "Stations 6 m apart, waterlines 1.5 m apart".
fn clauses(lower: &str) -> Vec<String> {
    let names_lines =
        |text: &str| words(text).iter().any(|word| STATION_NAMES.contains(word) || OTHER_NAMES.contains(word));
    let mut list: Vec<String> = Vec::new();
    for part in lower.split(';').flat_map(|part| part.split(" and ")).flat_map(|part| part.split(" / ")) {
        list.push(String::new());
        for piece in part.split(", ") {
            match list.last_mut() {
                Some(last) if !(names_lines(last) && names_lines(piece)) => {
                    last.push(' ');
                    last.push_str(piece);
                }
                _ => list.push(piece.to_owned()),
            }
        }
    }
    list
}

/// The distance \[m\] between lines of these names in "stations 3 ft apart", "station spacing: 5 m", "spacing of stations 16 ft 5 in",
/// "stations every 6 m", "distance between stations 6 m", "6 m station interval".
pub(in super::super) fn spacing(lower: &str, names: &[&str]) -> Option<f64> {
    let length = |words: &[&str]| {
        let text = words.join(" ");
        let text = text.trim_end_matches('.');
        let in_millimetres = plain_number(text).is_some_and(|number| number > FARTHEST);
        let length = parse_length(text).ok().filter(|l| *l > 0.0 && l.is_finite());
        length.map(|length| if in_millimetres { 1e-3 * length } else { length })
    };
    let is_number = |word: &str| word.starts_with(|c: char| c.is_ascii_digit());
    let bare = |word: &str| word.trim_end_matches(['.', ',']).to_owned();
    // A number alone is all that is left before the end, or before the word for the distance.
    let first_length = |words: &[&str]| {
        let starts = (0..words.len()).filter(|at| is_number(words[*at]));
        starts
            .flat_map(|at| (1..=4).rev().filter_map(move |count| Some((at, words.get(at..at + count)?))))
            .filter(|(at, list)| list.len() > 1 || words.len() == at + 1)
            .find_map(|(_, list)| length(list))
    };
    clauses(lower).iter().find_map(|clause| {
        let words: Vec<&str> =
            clause.split([' ', ':', '=', '(', ')', '\t']).filter(|word| !word.trim_matches(',').is_empty()).collect();
        let at = words.iter().position(|word| names.contains(&bare(word).as_str()))?;
        let is_between = words.windows(2).any(|pair| pair == ["distance", "between"]);
        let is_spacing = |word: &&str| SPACED.contains(&bare(word).as_str());
        if !is_between && !words.iter().any(is_spacing) {
            return None;
        }
        let rest = &words[at + 1..];
        let end = rest.iter().rposition(is_spacing).filter(|end| rest[..*end].iter().any(|word| is_number(word)));
        first_length(&rest[..end.unwrap_or(rest.len())]).or_else(|| {
            let before = &words[..at];
            first_length(&before[before.iter().position(|word| is_number(word))?..])
        })
    })
}
