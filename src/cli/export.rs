//! `loftsman export HULL`

use std::path::{Path, PathBuf};

use clap::Args;

use super::run_files::stem;
use super::{length, positive, stream};
use crate::exchange::{CadUnit, DxfVersion};
use crate::hull::Hull;
use crate::report::{
    Destination, ExportFormat, ExportSettings, Exported, Failure, Inputs, draught_of, export, read_source_with,
    source_files,
};

#[derive(Debug, Args)]
#[command(after_help = AFTER)]
pub(super) struct Arguments {
    /// hull.json, a folder that holds one, a design file, or a table of offsets, a mesh or a CAD file (fitted first)
    hull: PathBuf,
    /// Formats, with commas between them: step, iges, 3dm, dxf, stl, stl-ascii, obj, ply, glb, 3mf, vtk,
    /// msh, gdf, nemoh, pnl, ghs, britfair, pias, pdstrip, freeship, delftship, ftm, michlet, csv, xlsx, dxf-plan
    #[arg(short, long, value_delimiter = ',', value_parser = format, value_name = "LIST", required_unless_present = "output")]
    format: Vec<ExportFormat>,
    /// Folder for the files, or one file whose ending says the format, as hull.step [default: out/<name of the input>]
    #[arg(short, long, value_name = "PATH")]
    output: Option<PathBuf>,
    /// Unit of STEP, IGES, 3DM, DXF and meshes: m or mm; GLB is in metres always
    #[arg(long, value_parser = unit, value_name = "UNIT", default_value = "m")]
    unit: CadUnit,
    #[command(flatten)]
    conventions: super::BodyFlags,
    #[command(flatten)]
    stations: super::StationFlags,
    /// Lengths of meshes over those of the hull, as 1:50 or 0.02
    #[arg(long, value_parser = scale, value_name = "RATIO", default_value = "1")]
    scale: f64,
    /// Meshes of the half y >= 0, closed on the centreplane
    #[arg(long)]
    half: bool,
    /// Version of DXF files: r12 or r2000
    #[arg(long, value_parser = dxf_version, value_name = "VERSION", default_value = "r12")]
    dxf: DxfVersion,
    /// What meshes, polylines and sections leave the surface by at most, no less than a millionth of the breadth and
    /// no more than a tenth of the lesser of breadth and depth; without it a thousandth of the breadth
    #[arg(long, value_parser = positive, value_name = "LENGTH", allow_hyphen_values = true)]
    deviation: Option<f64>,
    /// Edges of a mesh across deck, bottom and transom, about
    #[arg(long, alias = "across", value_parser = clap::value_parser!(u16).range(1..=1000), value_name = "N", default_value_t = 8)]
    divisions_across: u16,
    /// Height above the base line that is z = 0 in the files: a length up to a hundred depths, or `waterline` for the
    /// design draught
    #[arg(long, value_parser = datum, value_name = "HEIGHT", default_value = "0 m", allow_hyphen_values = true)]
    datum: Datum,
    /// Draught of panels, and of the files for Michlet, PDSTRIP and DELFTship, above the base line [default: of the hull,
    /// where one is stated]
    #[arg(long, alias = "draft", value_parser = positive, value_name = "LENGTH", allow_hyphen_values = true)]
    draught: Option<f64>,
    /// Length of the sides of panels; without it a fiftieth of Lpp, or as much less, down to a quarter of that, as
    /// brings the volume of the panels within 0.5 % of the hull's
    #[arg(long, value_parser = positive, value_name = "LENGTH", allow_hyphen_values = true)]
    panel: Option<f64>,
    /// What corners of a quadrilateral panel may leave their mean plane by, over its longer diagonal; others become two
    /// triangles. With 0 all panels are planar; 0.01 makes about half as many
    #[arg(long, value_parser = flatness, value_name = "RATIO", default_value_t = 0.0, allow_hyphen_values = true)]
    flatness: f64,
    /// Overwrite files that are there already
    #[arg(long)]
    force: bool,
    /// Print nothing but errors
    #[arg(short, long)]
    quiet: bool,
}

const AFTER: &str = "\
step: AP214, a closed solid of untrimmed B-spline faces with the exact net and knots of the hull; iges: 5.3, the same solid \
as entity 186 of entities 128; 3dm: Rhino 5 and later, the same solid as one closed polysurface on the layer hull. Where the deck at side or the \
centreplane cuts the surface, the faces follow it within a distance that the page says.
dxf: polylines in space on the layers STATIONS, WATERLINES, BUTTOCKS, STEM, STERN, KEEL, SHEER and KNUCKLES; dxf-plan: the three views of the lines plan in one \
plane at full size, on layers BODY_..., PROFILE_... and PLAN_... .
stl, stl-ascii, obj, ply, glb, 3mf, vtk, msh: one closed mesh of the body up to its deck, normals outward; with --half that of the side \
to port, closed on the centreplane. Its regions are hull, bottom, transom, bow, deck and centreplane: named in stl-ascii, obj, glb and msh, numbered in vtk. \
No triangle has an angle of less than 15 degrees but at a corner of the body that is \
sharper (the end of a flat bottom, a deck to a point); the page tells whether the mesh is closed, its edges, its least angle, those corners, \
how many triangles are below the bound elsewhere (where a face is narrower than the deviation over a length), and its volume against the hull's.
gdf (WAMIT), nemoh, pnl (HAMS): panels of the wetted surface below --draught, the half y >= 0 with its plane of symmetry, z = 0 on \
the waterline, normals into the water, no lid; every panel is planar unless --flatness allows more. The page tells how even they are, and their volume and area against the hull's.
ghs, britfair, pias, pdstrip (below the draught), freeship (text that FREE!ship and DELFTship import): sections at the default \
stations as points within the deviation. ftm (FREE!ship, DELFTship): the control net of a subdivision surface through points of the \
hull, with its knuckles as creases; michlet: half-breadths below --draught, from the bow aft, from the lowest point up. csv, xlsx, delftship (table of DELFTship): half-breadths over stations and waterlines, with the ends of the waterlines. These, in \
their own frames, have z = 0 on the base line.
x forward from AP, y to port, z up; glb has y up: X = x, Y = z, Z = -y.";

#[derive(Debug, Clone, Copy)]
enum Datum {
    Height(f64),
    Waterline,
}

pub(super) fn format(text: &str) -> Result<ExportFormat, String> {
    // `gf` was the name of `ghs`.
    let name = if text.trim() == "gf" { "ghs" } else { text.trim() };
    let found = ExportFormat::ALL.into_iter().find(|format| format.name() == name);
    found.ok_or_else(|| {
        let names: Vec<&str> = ExportFormat::ALL.iter().map(|format| format.name()).collect();
        format!("expected one of {}", names.join(", "))
    })
}

fn flatness(text: &str) -> Result<f64, String> {
    let ratio: f64 = text.parse().map_err(|_| "expected a number".to_owned())?;
    if (0.0..=1.0).contains(&ratio) { Ok(ratio) } else { Err("expected 0 to 1".to_owned()) }
}

fn scale(text: &str) -> Result<f64, String> {
    let number = |text: &str| text.trim().parse::<f64>().ok();
    let ratio = match text.split_once([':', '/']) {
        Some((over, under)) => number(over).zip(number(under)).map(|(over, under)| over / under),
        None => number(text),
    };
    ratio.filter(|ratio| (1e-6..=1e6).contains(ratio)).ok_or_else(|| "expected a ratio, as 1:50 or 0.02".to_owned())
}

pub(super) fn unit(text: &str) -> Result<CadUnit, String> {
    match text {
        "m" => Ok(CadUnit::Metre),
        "mm" => Ok(CadUnit::Millimetre),
        _ => Err("expected m or mm".to_owned()),
    }
}

fn dxf_version(text: &str) -> Result<DxfVersion, String> {
    match text {
        "r12" => Ok(DxfVersion::R12),
        "r2000" => Ok(DxfVersion::R2000),
        _ => Err("expected r12 or r2000".to_owned()),
    }
}

fn datum(text: &str) -> Result<Datum, String> {
    if text == "waterline" { Ok(Datum::Waterline) } else { length(text).map(Datum::Height) }
}

/// Where the files go: a folder, and the name of the one file that `--output` may name.
struct Output {
    folder: PathBuf,
    file: Option<String>,
    formats: Vec<ExportFormat>,
}

impl Output {
    fn of(arguments: &Arguments, stem: &str) -> Result<Self, Failure> {
        let formats = arguments.format.clone();
        let folder = || Path::new("out").join(stem);
        let Some(output) = &arguments.output else { return Ok(Self { folder: folder(), file: None, formats }) };
        let name = output.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
        let by_ending = ExportFormat::from_ending(&name).filter(|_| !output.is_dir());
        match (by_ending, formats.as_slice()) {
            (None, []) => Err(Failure::Usage(format!(
                "--output {}: no format has this ending, and --format names none",
                output.display()
            ))),
            (Some(found), []) => Ok(Self::file(output, name, found)),
            (Some(found), [format]) if found == *format => Ok(Self::file(output, name, found)),
            (Some(ExportFormat::Stl), [ExportFormat::StlAscii]) => Ok(Self::file(output, name, ExportFormat::StlAscii)),
            _ => Ok(Self { folder: output.clone(), file: None, formats }),
        }
    }

    fn file(path: &Path, name: String, format: ExportFormat) -> Self {
        let parent = path.parent().filter(|parent| !parent.as_os_str().is_empty());
        let folder = parent.map_or_else(|| PathBuf::from("."), Path::to_path_buf);
        Self { folder, file: Some(name), formats: vec![format] }
    }
}

/// The files of all formats; where one of several cannot be written, those of the others, and what is wrong with each.
fn each(
    hull: &Hull,
    stem: &str,
    formats: &[ExportFormat],
    settings: &ExportSettings,
) -> Result<(Exported, Vec<String>), Failure> {
    let whole = match export(hull, stem, formats, settings) {
        Ok(exported) => return Ok((exported, Vec::new())),
        Err(failure) => failure,
    };
    let (mut written, mut pages, mut failed) = (Vec::new(), Vec::new(), Vec::new());
    for format in formats.iter().filter(|_| formats.len() > 1) {
        match export(hull, stem, &[*format], settings) {
            Ok(exported) => {
                written.extend(exported.files);
                pages.push(exported.page);
            }
            Err(failure) => failed.push(format!("{}: {failure}", format.name())),
        }
    }
    let is_twice = formats.iter().enumerate().any(|(k, format)| formats[..k].contains(format));
    if written.is_empty() || is_twice {
        return Err(whole);
    }
    Ok((Exported { files: written, page: pages.join("\n") }, failed))
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let source = read_source_with(&arguments.hull, &arguments.stations.with(&arguments.conventions))?;
    let stem = stem(&arguments.hull).to_string_lossy().into_owned();
    let Output { folder, file, formats } = Output::of(arguments, &stem)?;
    let datum = match arguments.datum {
        Datum::Height(height) => height,
        Datum::Waterline => draught_of(&source.hull, arguments.draught, "--datum waterline")?,
    };
    let settings = ExportSettings {
        unit: arguments.unit,
        scale: arguments.scale,
        half: arguments.half,
        dxf: arguments.dxf,
        deviation: arguments.deviation,
        across: usize::from(arguments.divisions_across),
        datum,
        draught: arguments.draught,
        panel: arguments.panel,
        stations: source.conventions.stations,
        flatness: arguments.flatness,
    };
    let (mut exported, failed) = each(&source.hull, &stem, &formats, &settings)?;
    if let (Some(name), [only]) = (file, exported.files.as_mut_slice()) {
        only.name = name;
    }
    let inputs = Inputs::of(&source_files(&arguments.hull));
    Destination { folder: &folder, inputs: &inputs, force: arguments.force }.write(&exported.files)?;
    let verdict = if failed.is_empty() {
        Ok(())
    } else {
        Err(Failure::Check(format!("E504 not written: {}", failed.join("; "))))
    };
    if arguments.quiet {
        return verdict;
    }
    for note in &source.notes {
        stream::message(note);
    }
    let names: Vec<&str> = exported.files.iter().map(|file| file.name.as_str()).collect();
    stream::data(&format!("{}\nWritten to {}: {}\n", exported.page, folder.display(), names.join(", ")))?;
    verdict
}
