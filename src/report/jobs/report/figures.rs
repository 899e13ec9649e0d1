//! The figures of a report: what is drawn of a result, in the order of its pages, with captions that say what to look
//! for.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, OnceLock, PoisonError};
use std::thread;

use serde_json::Value;

use super::cells::{PRICES, Table, condition, constraints, hydrostatics, inflections, inflections_words, list, text};
use super::settings::ReportSettings;
use super::verdict::{accuracy_words, verdict};
use crate::exchange::read_texts;
use crate::fairing::record::FairRecord;
use crate::hydrostatics::Hydrostatics;
use crate::plot::{
    FairingCombs, Figure, FigureInputs, PlotError, Sheet, SurfaceMapKind, SurfaceMaps, Svg, bonjean_figure,
    convergence_figure, deviation_figure, fairing_arrows, fairing_arrows_long, fairing_body_plan, fairing_buttocks,
    fairing_diagonals, fairing_half_breadth_plan, fairing_moves, fairing_stations, fairing_suspects, fairing_table,
    fairing_waterlines, pareto_figure, smoothing_figure, surface_map, table_figure, table_sheets,
};
use crate::report::failure::Failure;
use crate::report::input::result::JobResult;
use crate::report::words::page::conventions_line;

/// A figure of a report.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::report) struct ReportFigure {
    /// Stem of its files.
    pub(in crate::report) key: String,
    /// Heading.
    pub(in crate::report) title: String,
    /// What to look for.
    pub(in crate::report) caption: &'static str,
    /// The drawing, on A3.
    pub(in crate::report) svg: Svg,
    /// The drawing on the sheet of the PDF, where it is another.
    pub(in crate::report) large: Option<Svg>,
    /// The picture.
    pub(in crate::report) png: Vec<u8>,
}

impl ReportFigure {
    /// Whether it is a table, which the page has as text that can be sorted.
    pub(in crate::report) fn is_table(&self) -> bool {
        TABLES.iter().any(|key| self.key.starts_with(key))
    }
}

/// What their keys begin with.
const TABLES: [&str; 7] =
    ["verdict", "constraints", "design-condition", "hydrostatic-table", "faired-offsets", "inflections", "notes"];

/// The sheets of a figure; none where there is nothing to draw.
type Draw<'a> = Box<dyn Fn(Sheet) -> Result<Vec<Svg>, PlotError> + Sync + 'a>;

/// A figure of one sheet, or of none.
fn one<'a>(draw: impl Fn(Sheet) -> Result<Option<Svg>, PlotError> + Sync + 'a) -> Draw<'a> {
    Box::new(move |sheet| Ok(draw(sheet)?.into_iter().collect()))
}

/// Key, heading, caption and drawing of a figure.
struct Job<'a> {
    words: [&'static str; 3],
    draw: Draw<'a>,
    /// Whether it has a scale, and becomes larger on larger sheets.
    scaled: bool,
}

/// `designed`: whether a design draught is stated, whose waterline is drawn.
fn words(figure: Figure, designed: bool) -> [&'static str; 3] {
    let key = figure.key();
    match figure {
        Figure::Lines => [
            key,
            "Lines plan",
            "Sight along every line: waterlines, buttocks and diagonals run without humps, and neighbours keep their \
             distances. Diagonals cross the hull most squarely and are the judge.",
        ],
        Figure::Sections => [
            key,
            "Body plan",
            "Aft sections on the left, forward sections on the right. The gaps between neighbouring sections grow and \
             shrink evenly towards the ends.",
        ],
        Figure::SectionalArea => [
            key,
            "Sectional-area curve",
            "Its area is the displacement and its centroid the LCB. Shoulders should be no sharper than the hull needs; \
             hollows stand at the ends alone.",
        ],
        Figure::Hydrostatics if designed => [
            key,
            "Hydrostatic curves",
            "All curves over one axis of draught; the dash-dot line is the design draught. Curves end where the deck edge first goes \
                 under: beyond it the hull without its superstructure says nothing. A bend of TPC or KM tells of a shoulder or a flare.",
        ],
        Figure::Hydrostatics => [
            key,
            "Hydrostatic curves",
            "All curves over one axis of draught. Curves end where the deck edge first goes under: beyond it the hull without its \
                 superstructure says nothing. A bend of TPC or KM tells of a shoulder or a flare.",
        ],
        Figure::DiagramSheet => [
            key,
            "Diagram sheet",
            "The classic sheet: measure from the axis that the foot names and multiply by the scale of the curve. Curves end where the deck \
             edge first goes under.",
        ],
    }
}

/// What is drawn of a faired table, before the hull: what is doubted, what moved and where, the curves, what holding costs.
fn fairing_jobs<'a>(record: &'a FairRecord, fairing: &'a Value, combs: &'a FairingCombs) -> Vec<Job<'a>> {
    let job = |words: [&'static str; 3], draw: Draw<'a>| Job { words, draw, scaled: false };
    let scaled = |words: [&'static str; 3], draw: Draw<'a>| Job { words, draw, scaled: true };
    vec![
        scaled(
            [
                "suspects",
                "Suspects",
                "Rings are offsets as the table has them, bars run to what is proposed. A slip that explains itself (two digits \
                 changed over, a foot too much) is a slip; one that does not wants a look at the drawing. The score is the distance from what \
                 the neighbours expect over what they are sure of, as standard deviations of a normal law.",
            ],
            one(|sheet| fairing_suspects(record, sheet)),
        ),
        job(
            [
                "fairing-moves",
                "What moved",
                "Every offset with its move, outward positive. Look for runs of one sign along a line: they are a change of shape, not \
                 noise. Locked cells are framed, cells at their tolerance underlined, knuckles and tangent lines have diamonds.",
            ],
            one(|_| fairing_moves(record).map(Some)),
        ),
        scaled(
            [
                "fairing-arrows",
                "Where the offsets moved",
                "Before in grey, after in black; an arrow for every offset, exaggerated as the sheet says. Arrows that turn from \
                 point to point take noise out; a field of one direction is a change of form.",
            ],
            one(|sheet| fairing_arrows(record, sheet).map(Some)),
        ),
        scaled(
            [
                "fairing-arrows-long",
                "Where the offsets moved, along the ship",
                "Half-breadths move, heights do not: the arrows of the profile are what the buttocks make of it. A field of one \
                 direction along a line is a change of form; arrows that turn from station to station take noise out.",
            ],
            one(|sheet| fairing_arrows_long(record, sheet).map(Some)),
        ),
        scaled(
            [
                "fairing-waterlines",
                "Waterlines that moved most",
                "Above the line with its combs, below the offsets less the fair line with the bars of their tolerances: the fair line, 0, \
                 leaves no bar. Dots that lie on one side over several stations are a change of form.",
            ],
            one(move |sheet| fairing_waterlines(record, combs, sheet)),
        ),
        scaled(
            [
                "fairing-stations",
                "Stations that moved most",
                "The same for stations, laid on their side with the keel on the left.",
            ],
            one(move |sheet| fairing_stations(record, combs, sheet)),
        ),
        scaled(
            [
                "fairing-body-plan",
                "Body plan before and after",
                "Combs stand on the convex side at one scale before (grey) and after (blue); their tips should run smoothly. Rings \
                 mark inflections: those that are left should be meant.",
            ],
            one(move |sheet| fairing_body_plan(record, combs, sheet).map(Some)),
        ),
        scaled(
            [
                "fairing-half-breadth-plan",
                "Half-breadth plan before and after",
                "The same for the waterlines. Curvatures are those of the ship, also where breadths are stretched.",
            ],
            Box::new(move |sheet| fairing_half_breadth_plan(record, combs, sheet)),
        ),
        scaled(
            [
                "fairing-buttocks",
                "Buttocks before and after",
                "Buttocks were not used in the fit, a strip each: humps of the combs that show here alone are humps of the surface between \
                 the lines.",
            ],
            Box::new(move |sheet| some(fairing_buttocks(record, combs, sheet))),
        ),
        scaled(
            [
                "fairing-diagonals",
                "Diagonals before and after",
                "Diagonals cross the hull most squarely and were not used in the fit: the judge of all that went before. Their combs should \
                 run smoothly from end to end.",
            ],
            Box::new(move |sheet| some(fairing_diagonals(record, combs, sheet))),
        ),
        job(
            [
                "constraints",
                "What is held, and at which price",
                "The price is the RMS of the moves that dropping the target would save. Relax the target with the highest price first.",
            ],
            one(move |_| {
                let whole = fairing["status"].as_str() == Some("optimal");
                let name = text(&fairing["name"]).replace('_', " ");
                let mark = if whole { "" } else { " (a compromise: not all targets are met)" };
                Ok(sheet(&format!("CONSTRAINTS AND PRICES – {name}{mark}"), PRICES, constraints(fairing)))
            }),
        ),
        job(
            [
                "deviation",
                "Moves against the assumed noise",
                "If the moves are the noise of the table the steps follow the bell. Long tails are wrong readings; a middle off zero \
                 is a change of shape.",
            ],
            one(|_| deviation_figure(record)),
        ),
        job(
            [
                "lcurve",
                "Search for the smoothing weight",
                "A point for each smoothing weight that was tried. The one taken has the greatest likelihood, or the least expected error to the hull \
                 (cross-validation, or Mallows' criterion at the errors of the table). It need not be a bend of the line: further right the \
                 offsets move more, for less energy.",
            ],
            one(|_| smoothing_figure(record)),
        ),
        job(
            [
                "pareto",
                "Deviation against fairness",
                "No point of the curve can be bettered in both. The fair hull lies above it by what its targets cost.",
            ],
            one(|_| pareto_figure(record)),
        ),
        job(
            [
                "convergence",
                "Convergence",
                "All three lines fall to rounding where the program was solved; lines that level off above it are a program that \
                 was not.",
            ],
            one(|_| convergence_figure(record)),
        ),
    ]
}

/// A figure that hulls without such planes do not have.
fn some(drawn: Result<Vec<Svg>, PlotError>) -> Result<Vec<Svg>, PlotError> {
    match drawn {
        Err(PlotError::Chart(_)) => Ok(Vec::new()),
        drawn => drawn,
    }
}

/// What stands after the drawings of a faired table: its offsets as they are written, the inflections of every line, and
/// what was found and assumed.
fn appendix<'a>(result: &'a JobResult, (record, fairing): (&'a FairRecord, &'a Value)) -> [Job<'a>; 3] {
    let job = |words: [&'static str; 3], draw: Draw<'a>| Job { words, draw, scaled: false };
    let name = result.hull.name().replace('_', " ");
    let [heading, notes_title] = ["INFLECTIONS", "NOTES OF THE RUN"].map(|title| format!("{title} – {name}"));
    [
        job(
            [
                "faired-offsets",
                "Faired offsets",
                "The fair table in the notation of the table it was made from. Look at what is shaded first, then at what was left out: it stands \
                 in the table as the fair hull has it.",
            ],
            Box::new(move |_| {
                let (limit, words) = accuracy_words(record);
                let texts = result.changes.as_deref().map(read_texts).unwrap_or_default();
                Ok(fairing_table(record, &texts, limit, &words))
            }),
        ),
        job(
            [
                "inflections",
                "Inflections",
                "How often each line bends the other way. Lines that bend more often than at least they must are those to look at; diagonals \
                 and buttocks judge the lines that were used.",
            ],
            Box::new(move |_| {
                Ok(sheets(&heading, &inflections_words(record, fairing, true), inflections(record, fairing, true)))
            }),
        ),
        job(
            [
                "notes",
                "Notes of the run",
                "What was found in the table and assumed where it says nothing: read it before the numbers.",
            ],
            Box::new(move |_| Ok(sheets(&notes_title, "what was found and assumed", notes(result, fairing)))),
        ),
    ]
}

/// What should be known about the files, and what the run found and assumed, in lines.
fn notes(result: &JobResult, fairing: &Value) -> Table {
    let all = result.notes.iter().cloned().chain(list(&fairing["notes"]).map(text));
    let rows = all.flat_map(|note| lines(&note)).map(|line| (false, vec![line])).collect();
    Table { heads: vec!["note".to_owned()], words: 1, rows }
}

/// A table on as many sheets as it takes; none where it has no rows.
fn sheets(title: &str, note: &str, table: Table) -> Vec<Svg> {
    let heads: Vec<&str> = table.heads.iter().map(String::as_str).collect();
    let rows: Vec<Vec<String>> = table.rows.into_iter().map(|(_, cells)| cells).collect();
    table_sheets(title, note, &heads, table.words, &rows)
}

/// A table on a sheet; none where it has no rows.
fn sheet(title: &str, note: &str, table: Table) -> Option<Svg> {
    let heads: Vec<&str> = table.heads.iter().map(String::as_str).collect();
    let rows: Vec<Vec<String>> = table.rows.into_iter().map(|(_, cells)| cells).collect();
    (!rows.is_empty()).then(|| table_figure(title, note, &heads, table.words, &rows))
}

/// Most quantities on a sheet of the hydrostatic table.
const COLUMNS: usize = 15;

/// Most letters of a line of the verdict.
const LINE: usize = 165;

/// Words in lines of at most [`LINE`] letters where they have spaces, the second and all further ones set in.
fn lines(text: &str) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split(' ') {
        match lines.last_mut() {
            Some(line) if line.chars().count() + word.chars().count() < LINE => {
                line.push(' ');
                line.push_str(word);
            }
            Some(_) => lines.push(format!("      {word}")),
            None => lines.push(word.to_owned()),
        }
    }
    lines
}

/// What the fairing came to, in sentences; none of other results.
fn verdict_figure(result: &JobResult, conditions: [Option<&Hydrostatics>; 2]) -> Option<Svg> {
    let found = verdict(result, conditions);
    let rows = found.iter().flat_map(|(bad, text)| lines(text).into_iter().map(|line| (*bad, vec![line]))).collect();
    let table = Table { heads: vec![result.hull.name().replace('_', " ")], words: 1, rows };
    sheet("WHAT THE FAIRING CAME TO", "all of it in fairing.json and on report.html", table)
}

/// The design condition, that before fairing beside it.
fn condition_figure(result: &JobResult, inputs: &FigureInputs, before: Option<&Hydrostatics>) -> Option<Svg> {
    let title = format!("DESIGN CONDITION – {}", result.hull.name().replace('_', " "));
    sheet(&title, &printed_conventions(inputs), condition(result, inputs.design?, before))
}

/// The conventions with symbols as they are printed.
fn printed_conventions(inputs: &FigureInputs) -> String {
    let symbols =
        [("Lpp", "L_PP"), ("Lwl", "L_WL"), ("CP on", "C_P on"), ("t/m3", "t/m³"), ("BML", "BM_L"), ("GML", "GM_L")];
    let words = conventions_line(&inputs.curves.conventions);
    symbols.iter().fold(words, |words, (plain, printed)| words.replace(plain, printed))
}

/// The quantities over the draughts, as many columns a sheet as are read easily, the draught first on each.
fn hydrostatic_sheets(result: &JobResult, inputs: &FigureInputs) -> Vec<Svg> {
    let table = hydrostatics(inputs.curves, inputs.design.map(|design| design.draught));
    let count = table.heads.len().saturating_sub(1);
    let each = count.div_ceil(count.div_ceil(COLUMNS).max(1)).max(1);
    let name = result.hull.name().replace('_', " ");
    let part = |first: usize| {
        let columns = std::iter::once(0).chain(first..(first + each).min(count + 1));
        let of = |cells: &[String]| columns.clone().filter_map(|k| cells.get(k).cloned()).collect::<Vec<_>>();
        let rows = table.rows.iter().map(|(marked, cells)| (*marked, of(cells))).collect();
        let title = format!("HYDROSTATIC TABLE – {name}");
        sheets(&title, &printed_conventions(inputs), Table { heads: of(&table.heads), words: 0, rows })
    };
    (1..=count).step_by(each).flat_map(part).collect()
}

/// What is drawn of a result.
fn jobs<'a>(
    result: &'a JobResult,
    (inputs, before): (&'a FigureInputs<'a>, Option<&'a Hydrostatics>),
    combs: Option<&'a FairingCombs>,
    maps: &'a OnceLock<SurfaceMaps>,
) -> Vec<Job<'a>> {
    // Made when the first figure asks for them.
    let maps = move || maps.get_or_init(|| SurfaceMaps::new(inputs.hull, inputs.before));
    let mut jobs: Vec<Job<'a>> = result
        .fairing
        .iter()
        .zip(combs)
        .flat_map(|((record, fairing), combs)| fairing_jobs(record, fairing, combs))
        .collect();
    let came = [
        "verdict",
        "What the fairing came to",
        "Moves, settings, inflections and prices in one look; the sheets that follow prove them.",
    ];
    jobs.insert(
        0,
        Job { words: came, draw: one(move |_| Ok(verdict_figure(result, [before, inputs.design]))), scaled: false },
    );
    let standard = |figure: Figure| Job {
        words: words(figure, inputs.design.is_some()),
        draw: one(move |sheet| figure.draw_on(inputs, sheet).map(Some)),
        scaled: matches!(figure, Figure::Lines | Figure::Sections),
    };
    let there = |figure: &Figure| inputs.design.is_some() || !figure.needs_draught();
    jobs.extend(Figure::ALL.into_iter().filter(there).map(standard));
    jobs.push(Job {
        words: ["design-condition", "Design condition", "Every hydrostatic quantity at the design draught, and what was asked for where something was: value and target agree in all digits (coefficients that are asked for on L_PP are on the length of the others here)."],
        draw: one(move |_| Ok(condition_figure(result, inputs, before))),
        scaled: false,
    });
    jobs.push(Job {
        words: [
            "hydrostatic-table",
            "Hydrostatic table",
            "Every quantity at every draught, with the keys of hydrostatics.csv; the sheet of the design condition names them. What is not \
             defined at a draught is left open.",
        ],
        draw: Box::new(move |_| Ok(hydrostatic_sheets(result, inputs))),
        scaled: false,
    });
    jobs.push(Job {
        words: [
            "bonjean",
            "Bonjean curves",
            "At each station the area below a waterline is drawn forward of its line: draw a waterline at any trim and read the areas \
             that it cuts off.",
        ],
        draw: one(|_| bonjean_figure(inputs).map(Some)),
        scaled: false,
    });
    jobs.extend(SurfaceMapKind::ALL.map(|kind| {
        let words = match kind {
            SurfaceMapKind::Gaussian => [
                kind.key(),
                "Gaussian curvature",
                "Fields of one colour with quiet borders are fair; islands and specks are bumps. White is developable, black lines are 0, hatched is \
                 no side. Along a dashed line the surface has a tangent plane and no more: a step of colour there is hers.",
            ],
            SurfaceMapKind::Mean => [
                kind.key(),
                "Mean curvature",
                "Bands across the run of the lines are shoulders; specks are bumps that a batten would not follow. Black lines are 0, hatched is no side. \
                 Along a dashed line the surface has a tangent plane and no more: a step of colour there is hers.",
            ],
            SurfaceMapKind::Zebra => [
                kind.key(),
                "Zebra stripes",
                "Stripes swing evenly over a fair surface. A kink along a dashed line is a jump of curvature the surface is made with, a step \
                 along a heavy line a knuckle; where the keel ends (dotted) girths begin at the profile, and stripes step though the \
                 surface does not. Any other kink is a bump.",
            ],
        };
        let draw = one(move |_| surface_map(maps(), kind).map(Some));
        Job { words, draw, scaled: false }
    }));
    jobs.extend(result.fairing.iter().flat_map(|(record, fairing)| appendix(result, (record, fairing))));
    jobs
}

/// The sheets of a figure with its place in the order; none where there is nothing to draw.
type Drawn = (usize, Result<Vec<ReportFigure>, Failure>);

/// Draws the figures of a result; on as many threads as there are cores, in one order.
pub(in crate::report) fn report_figures(
    result: &JobResult,
    inputs: &FigureInputs<'_>,
    before: Option<&Hydrostatics>,
    combs: Option<&FairingCombs>,
    settings: &ReportSettings,
) -> Result<Vec<ReportFigure>, Failure> {
    let maps = OnceLock::new();
    let jobs = jobs(result, (inputs, before), combs, &maps);
    let next = AtomicUsize::new(0);
    let drawn: Mutex<Vec<Drawn>> = Mutex::new(Vec::new());
    // Neighbours are drawn from the same and would wait for each other: one from the second half of the list, then one
    // from the first. The maps, which take longest, come first.
    let half = jobs.len().div_ceil(2);
    let order: Vec<usize> = (0..half).rev().flat_map(|k| [half + k, k]).filter(|k| *k < jobs.len()).collect();
    let work = || {
        while let Some(index) = order.get(next.fetch_add(1, Ordering::Relaxed)) {
            let (index, job) = (*index, &jobs[*index]);
            let one = figure(job, settings);
            drawn.lock().unwrap_or_else(PoisonError::into_inner).push((index, one));
        }
    };
    let threads = thread::available_parallelism().map_or(1, usize::from).min(jobs.len());
    thread::scope(|scope| (0..threads).for_each(|_| drop(scope.spawn(work))));
    let mut drawn = drawn.into_inner().unwrap_or_else(PoisonError::into_inner);
    drawn.sort_by_key(|(index, _)| *index);
    let sheets = drawn.into_iter().map(|(_, figures)| figures).collect::<Result<Vec<_>, _>>()?;
    Ok(sheets.into_iter().flatten().collect())
}

/// The sheets of a figure; the second has the number 2 behind its key.
fn figure(job: &Job<'_>, settings: &ReportSettings) -> Result<Vec<ReportFigure>, Failure> {
    let [key, title, caption] = job.words;
    let failure = |error: PlotError| match error {
        PlotError::PictureSize { .. } => Failure::Usage(format!("{key}: {error}")),
        error => Failure::Internal(format!("{key}: {error}")),
    };
    let drawn = (job.draw)(Sheet::A3).map_err(failure)?;
    let mut large = match settings.sheet {
        sheet if job.scaled && sheet != Sheet::A3 => (job.draw)(sheet).map_err(failure)?,
        _ => Vec::new(),
    };
    let count = drawn.len();
    let sheet = |(k, svg): (usize, Svg)| {
        let [number, of] = if k == 0 {
            [String::new(), String::new()]
        } else {
            [format!("-{}", k + 1), format!(", sheet {} of {count}", k + 1)]
        };
        let png = svg.to_png(settings.dots_per_inch).map_err(failure)?;
        let (key, title) = (format!("{key}{number}"), format!("{title}{of}"));
        Ok(ReportFigure {
            key,
            title,
            caption,
            svg,
            large: if large.is_empty() { None } else { Some(large.remove(0)) },
            png,
        })
    };
    drawn.into_iter().enumerate().map(sheet).collect()
}
