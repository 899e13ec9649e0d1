//! `loftsman fair TABLE|JOB`

use std::path::PathBuf;
use std::time::{Duration, Instant, SystemTime};

use clap::error::ErrorKind;
use clap::parser::ValueSource;
use clap::{Arg, ArgAction, ArgMatches, Args, Command, FromArgMatches};

use super::run_files::RunFiles;
use super::stream;
use crate::report::{
    Destination, Failure, FairJob, FairOutputs, Inputs, fair_line, fair_outputs_with_progress, fair_page, fair_summary,
    read_fair_with,
};
use crate::units::counted;

#[derive(Debug, Args)]
#[command(after_help = AFTER)]
pub(super) struct Arguments {
    /// A table of offsets, or a job file (TOML) that names one
    #[arg(value_name = "TABLE|JOB")]
    input: PathBuf,
    #[command(flatten)]
    conventions: super::BodyFlags,
    #[command(flatten)]
    stations: super::StationFlags,
    /// Displacement to hold, "4050 t" or "3951 m3"; "table" for that of the table, "free" for none [default: table]
    #[arg(long, value_name = "MASS|VOLUME", allow_hyphen_values = true)]
    displacement: Option<String>,
    /// Block coefficient to hold, instead of the displacement
    #[arg(long, value_name = "CB", allow_hyphen_values = true)]
    cb: Option<String>,
    /// Longitudinal centre of buoyancy, "+0.8 %" (of Lpp from midship, + forward) or "41.0 m AP" [default: table]
    #[arg(long, value_name = "LCB", allow_hyphen_values = true)]
    lcb: Option<String>,
    /// Midship section coefficient [default: table]
    #[arg(long, value_name = "CM", allow_hyphen_values = true)]
    cm: Option<String>,
    /// Height of the centre of buoyancy above the base line [default: free]
    #[arg(long, value_name = "KB", allow_hyphen_values = true)]
    kb: Option<String>,
    /// Longitudinal centre of flotation, as --lcb [default: free]
    #[arg(long, value_name = "LCF", allow_hyphen_values = true)]
    lcf: Option<String>,
    /// Waterplane coefficient [default: free]
    #[arg(long, value_name = "CWP", allow_hyphen_values = true, conflicts_with = "waterplane_area")]
    cwp: Option<String>,
    /// Waterplane area [m2], instead of the coefficient
    #[arg(long, value_name = "AREA", allow_hyphen_values = true)]
    waterplane_area: Option<String>,
    /// Height of the transverse metacentre above the base line [default: free]
    #[arg(long, value_name = "KM", allow_hyphen_values = true, conflicts_with = "gm")]
    km: Option<String>,
    /// Transverse metacentric height, for the centre of gravity of --kg [default: free]
    #[arg(long, value_name = "GM", allow_hyphen_values = true)]
    gm: Option<String>,
    /// Height of the centre of gravity above the base line
    #[arg(long, value_name = "KG", allow_hyphen_values = true)]
    kg: Option<String>,
    /// Wetted surface [m2] at the design draught [default: free]
    #[arg(long, value_name = "AREA", allow_hyphen_values = true)]
    wetted_surface: Option<String>,
    /// Design draught: what is held holds there [default: of the table, where it states one]
    #[arg(long, alias = "draft", value_name = "T", allow_hyphen_values = true)]
    draught: Option<String>,
    /// How strongly the table is faired, from 0, the surface through it, to 10; or raw (0), light (3), fair (5), smooth (8)
    /// [default: 5]
    #[arg(long, value_name = "GRADE", allow_hyphen_values = true, conflicts_with_all = ["weight", "inflection_cost"])]
    fairness: Option<String>,
    /// Fair the table at grades 0 to 10 besides: grades.csv, grades/N/hull.json and a figure of deviation against fairness
    #[arg(long)]
    grades: bool,
    /// Greatest move of an offset [default: three times the noise about it, at least twice the resolution of the table; on
    /// the net of the surface through the table at most B/1000 or 15 mm, unless that is three times as rough]
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true)]
    tolerance: Option<String>,
    /// What must not move: a cell "station@waterline", "station 5", "waterline 2.0", or a line between the offsets too:
    /// "stem", "stern", "keel", "deck", "line NAME" of the table; may be repeated
    #[arg(long, value_name = "NAME")]
    lock: Vec<String>,
    /// Smoothing weight, or "auto": of a field by its likelihood, on the net of the surface through the table by the errors of
    /// the table (Mallows) [default: auto]
    #[arg(long, value_name = "NUMBER", allow_hyphen_values = true)]
    weight: Option<String>,
    /// Take suspected typing errors as they are
    #[arg(long)]
    keep_suspects: bool,
    /// Take knuckles and tangent lines that are proposed: "L1,L2", or "all"
    #[arg(long, value_name = "L1,L2|all")]
    accept_lines: Option<String>,
    /// Greatest cost of removing an inflection: the sum of squared moves that it adds, over the noise squared [default: 12, and more while changes of sign are far above the least]
    #[arg(long, alias = "sign-price", value_name = "NUMBER", allow_hyphen_values = true)]
    inflection_cost: Option<String>,
    /// Froude numbers of L_PP at which the wave resistance is made small within the tolerances, as 0.25:0.30:0.01
    #[arg(long, value_name = "FN")]
    wave_resistance: Option<String>,
    /// Weight of the wave resistance against the energy of the move, m2 [default: the knee of seven weights]
    #[arg(long, value_name = "NUMBER", allow_hyphen_values = true)]
    wave_weight: Option<String>,
    #[command(flatten)]
    _removed: Removed,
    #[command(flatten)]
    files: RunFiles,
    /// Print everything: prices, every move and remark, the proof, names of the files
    #[arg(long, conflicts_with = "quiet")]
    verbose: bool,
    /// Run again whenever one of the files that were read changes; files of the run before are overwritten
    #[arg(long)]
    watch: bool,
}

const AFTER: &str = "\
By default displacement, LCB and CM are held: within two standard errors of the smoothed table, or at the values of the surface \
through the table where the job has locks, rules, lines or a tolerance below half the noise. A given target replaces one of them. \
Without a draught, volume and centre of volume are held below the highest waterline that every station between the ends has; \
targets then need --draught. A job file has the same in [hold], and [tolerance], [lock], [tangent], [flat], \
[shape], [energy], [suspects], [inflections]: `loftsman schema job`.
Files: hull.json, fitted-hull.json (the surface through the table), offsets.csv (in the notation of the table), offsets.toml (the dimensions and \
conventions that were stated, to read it again), changes.csv, control-polygon.csv (its signs), fairing.json (the certificate), summary.json, \
manifest.json, figures; with --grades: grades.csv, grades/N/hull.json.
The first line says whether the hull is fairer: changes of sign and monotone pieces of the curvature of stations and \
waterlines before > after, with the proved least number of changes of sign. Eight lines follow; --verbose prints the rest.
Exit code 4 when the targets cannot all be met within the tolerances; the best compromise is written, marked. Exit code 5 when \
they are met and stations and waterlines have more changes of sign or more monotone pieces than before. From --fairness 5 on also \
where they have no fewer changes of sign and more than 1.5 times the least and 2. With --fairness 0 exit code 0.
Tables of offsets are all that `loftsman fit --help` lists.";

/// Options that were removed, all of which --fairness serves, and whether they took a value.
pub(super) const REMOVED: [(&str, bool); 7] = [
    ("order", true),
    ("anisotropy", true),
    ("allow-inflections", false),
    ("no-signs", false),
    ("true-curvature", false),
    ("exact-bending-energy", false),
    ("bending", false),
];

/// Refuses the options that were removed, and names the one that serves instead.
#[derive(Debug)]
struct Removed;

impl Args for Removed {
    fn augment_args(command: Command) -> Command {
        command.args(REMOVED.map(|(name, takes_value)| {
            let argument = Arg::new(name).long(name).hide(true);
            if takes_value {
                argument.num_args(0..=1).allow_negative_numbers(true)
            } else {
                argument.action(ArgAction::SetTrue)
            }
        }))
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}

impl FromArgMatches for Removed {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, clap::Error> {
        let given = |(name, _): &&(&str, bool)| matches.value_source(name) == Some(ValueSource::CommandLine);
        let Some((name, _)) = REMOVED.iter().find(given) else { return Ok(Self) };
        let text = format!(
            "--{name} was removed: --fairness serves instead, from 0, the surface through the table, to 10, the smoothest"
        );
        Err(clap::Error::raw(ErrorKind::UnknownArgument, text))
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), clap::Error> {
        Self::from_arg_matches(matches).map(|_| ())
    }
}

/// How often the files are looked at.
const LOOK: Duration = Duration::from_millis(200);

impl Arguments {
    /// What the options say, in the words of the job file.
    fn options(&self) -> Vec<(&'static str, &'static str, String)> {
        let named = [
            ("--displacement", "hold.displacement", &self.displacement),
            ("--cb", "hold.Cb", &self.cb),
            ("--lcb", "hold.LCB", &self.lcb),
            ("--cm", "hold.Cm", &self.cm),
            ("--kb", "hold.KB", &self.kb),
            ("--lcf", "hold.LCF", &self.lcf),
            ("--cwp", "hold.Cwp", &self.cwp),
            ("--waterplane-area", "hold.waterplane_area", &self.waterplane_area),
            ("--km", "hold.KM", &self.km),
            ("--gm", "hold.GM", &self.gm),
            ("--kg", "hold.KG", &self.kg),
            ("--wetted-surface", "hold.wetted_surface", &self.wetted_surface),
            ("--draught", "dimensions.T", &self.draught),
            ("--tolerance", "tolerance.table", &self.tolerance),
            ("--fairness", "fairness", &self.fairness),
            ("--weight", "energy.weight", &self.weight),
            ("--inflection-cost", "inflections.cost", &self.inflection_cost),
            ("--wave-resistance", "waves.froude_numbers", &self.wave_resistance),
            ("--wave-weight", "waves.weight", &self.wave_weight),
            ("--accept-lines", "lines.accept", &self.accept_lines),
        ];
        let given = |(option, key, value): (&'static str, &'static str, &Option<String>)| {
            value.as_ref().map(|value| (option, key, value.clone()))
        };
        let mut options: Vec<_> = named.into_iter().filter_map(given).collect();
        for lock in &self.lock {
            let (key, name) = match lock.trim().split_once(char::is_whitespace) {
                Some(("station", name)) => ("lock.stations", name),
                Some(("waterline", name)) => ("lock.waterlines", name),
                Some(("line", _)) => ("lock.lines", lock.as_str()),
                None if ["stem", "stern", "keel", "deck"].contains(&lock.trim()) => ("lock.lines", lock.as_str()),
                _ => ("lock.cells", lock.as_str()),
            };
            options.push(("--lock", key, name.trim().to_owned()));
        }
        if self.keep_suspects {
            options.push(("--keep-suspects", "suspects.exclude", "false".to_owned()));
        }
        options
    }
}

/// Reads, fairs and writes once; the job, when it could be read, tells which files to watch.
fn once(arguments: &Arguments, force: bool) -> (Option<FairJob>, Result<FairOutputs, Failure>) {
    let progress = |text: String| {
        if !arguments.files.quiet {
            stream::message(&text);
        }
    };
    let start = Instant::now();
    let conventions = arguments.stations.with(&arguments.conventions);
    let mut job = match read_fair_with(&arguments.input, &arguments.options(), &conventions) {
        Ok(job) => job,
        Err(failure) => return (None, Err(failure)),
    };
    job.grades = arguments.grades;
    let folder = arguments.files.folder(&arguments.input, false);
    let inputs = Inputs::of(job.files());
    let destination = Destination { folder: &folder, inputs: &inputs, force };
    if let Err(failure) = destination.check(job.outputs().iter().map(String::as_str)) {
        return (Some(job), Err(failure));
    }
    let [stations, waterlines, offsets, points] = job.size();
    let of = [(waterlines, "waterline"), (offsets, "offset"), (points, "point")];
    let of = of.iter().filter(|(count, _)| *count > 0).map(|(count, what)| format!(", {}", counted(*count, what)));
    progress(format!("{}: {}{}", job.table.name, counted(stations, "station"), of.collect::<String>()));
    let shown = |code: &str| code == "W320" || !arguments.files.quiet;
    job.warnings().filter(|warning| shown(warning.code)).for_each(|warning| stream::message(&warning.to_string()));
    let told = |text: &str| progress(format!("{:6.1} s  {text}", start.elapsed().as_secs_f64()));
    let outputs = match fair_outputs_with_progress(&job, !arguments.files.no_figures, &told) {
        Ok(outputs) => outputs,
        Err(failure) => return (Some(job), Err(failure)),
    };
    progress(format!("faired in {:.2} s", start.elapsed().as_secs_f64()));
    outputs.warning().iter().for_each(|warning| stream::message(warning));
    let written = destination.write_run(&outputs.files).map(|()| outputs);
    (Some(job), written)
}

/// When the files were written last; a file that is not there has no time.
fn stamps(files: &[PathBuf]) -> Vec<Option<SystemTime>> {
    files.iter().map(|file| file.metadata().and_then(|data| data.modified()).ok()).collect()
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let started = SystemTime::now();
    let (job, done) = once(arguments, arguments.files.force);
    if arguments.watch {
        return watch(arguments, job, done, started);
    }
    let outputs = done?;
    if let Some(job) = job {
        print(arguments, &job, &outputs)?;
    }
    outputs.verdict()
}

fn print(arguments: &Arguments, job: &FairJob, outputs: &FairOutputs) -> Result<(), Failure> {
    if arguments.files.json {
        return stream::data(&stream::json_judged(outputs.certificate.clone(), &outputs.verdict())?);
    }
    if arguments.files.quiet {
        return Ok(());
    }
    let page = if arguments.verbose { fair_page } else { fair_summary };
    stream::data(&page(job, outputs, &arguments.files.folder(&arguments.input, false).display().to_string()))
}

/// Runs again when a file changes, until the program is ended; what goes wrong is reported and does not end it, but for a
/// first run that could not write.
fn watch(
    arguments: &Arguments,
    job: Option<FairJob>,
    done: Result<FairOutputs, Failure>,
    started: SystemTime,
) -> Result<(), Failure> {
    let mut files = job.as_ref().map_or_else(|| vec![arguments.input.clone()], |job| job.files().to_vec());
    match (done, &job) {
        (Ok(outputs), Some(job)) => {
            print(arguments, job, &outputs)?;
            report(&outputs.verdict());
        }
        (
            Err(failure @ (Failure::Usage(_) | Failure::Options(_) | Failure::Exists(_) | Failure::FileSystem { .. })),
            _,
        ) => {
            return Err(failure);
        }
        (done, _) => report(&done.map(|_| ())),
    }
    // What was written since the first run began has not been seen.
    let mut seen: Vec<_> = stamps(&files).into_iter().map(|time| time.filter(|&time| time <= started)).collect();
    loop {
        std::thread::sleep(LOOK);
        let now = stamps(&files);
        if now == seen {
            continue;
        }
        // An editor may still be writing: the second look must see the same.
        std::thread::sleep(LOOK / 4);
        if stamps(&files) != now {
            continue;
        }
        seen = now;
        let (job, done) = once(arguments, true);
        if let Some(job) = &job
            && job.files() != files
        {
            files = job.files().to_vec();
            seen = stamps(&files);
        }
        match done {
            Ok(outputs) => {
                stream::data(&fair_line(&outputs))?;
                report(&outputs.verdict());
            }
            Err(failure) => stream::message(&failure.to_string()),
        }
    }
}

fn report(verdict: &Result<(), Failure>) {
    if let Err(failure) = verdict {
        stream::message(&failure.to_string());
    }
}
