//! The mould loft: frames at full size, with their ordinates and bevels.

use crate::exchange::{CadUnit, DxfLine, DxfVersion, bevels_csv, heights_csv, offsets_csv, write_dxf};
use crate::hull::{Cell, FramePoint, Hull, LoftedFrame, OffsetTable, StationOffsets};
use crate::plot::{Heading, LoftSheet, Page, PlotError, Sheet, loft_frame, loft_tile_count, loft_tiles, write_pdf};
use crate::report::failure::Failure;
use crate::report::output::files::OutputFile;
use crate::units::{Notation, counted};

/// Most tiles of paper.
const MOST_TILES: usize = 600;

/// Chords of frames, at most, where ordinates are read off them \[m\].
const ORDINATES: f64 = 2e-5;

/// How frames are drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LoftFormat {
    /// A drawing a frame.
    Svg,
    /// All frames as polylines on layers.
    Dxf,
    /// All frames on tiles of A3.
    Pdf,
}

impl LoftFormat {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Svg, Self::Dxf, Self::Pdf];

    /// Its name on the command line.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Svg => "svg",
            Self::Dxf => "dxf",
            Self::Pdf => "pdf",
        }
    }
}

/// The face of the skin that is lofted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum SkinSide {
    /// Inside of the moulded surface, as the frames of a planked boat whose lines are to the outside of the planking.
    #[default]
    Inside,
    /// Outside of it, as the outside of the plating of a steel ship.
    Outside,
}

/// What is lofted.
#[derive(Debug, Clone, PartialEq)]
pub struct LoftSettings {
    /// Positions of frames forward of AP \[m\].
    pub frames: Vec<f64>,
    /// Thickness of the skin \[m\]; 0: the moulded surface.
    pub thickness: f64,
    /// On which side of the moulded surface.
    pub side: SkinSide,
    /// What chords leave a frame by at most \[m\].
    pub deviation: f64,
    /// Heights of waterlines \[m\].
    pub waterlines: Vec<f64>,
    /// Distances of buttocks from the centreplane \[m\].
    pub buttocks: Vec<f64>,
    /// How lengths are written.
    pub notation: Notation,
    /// Unit of the DXF file.
    pub unit: CadUnit,
}

/// The files, with what is printed about them.
#[derive(Debug, Clone, PartialEq)]
pub struct Lofted {
    /// The files.
    pub files: Vec<OutputFile>,
    /// Lines for the user.
    pub page: String,
    /// Warnings.
    pub warnings: Vec<String>,
    /// Formats of several that cannot be written, with the reason.
    pub failed: Vec<String>,
}

fn not_drawn(error: &PlotError) -> Failure {
    Failure::Internal(error.to_string())
}

/// All frames on tiles of A3, and how many there are.
fn tiles_of(sheets: &[LoftSheet<'_>], ship: &str) -> Result<(OutputFile, usize), Failure> {
    let count: usize = sheets.iter().map(loft_tile_count).sum();
    if count > MOST_TILES {
        return Err(Failure::Usage(format!(
            "the frames take {} of A3, expected at most {MOST_TILES}: give fewer --frames, or --format dxf",
            counted(count, "tile")
        )));
    }
    let tiles: Vec<(String, _)> = sheets.iter().flat_map(loft_tiles).collect();
    let heading = Heading { ship, source: "", date: None };
    let list: Vec<Page<'_>> = tiles.iter().map(|(title, svg)| Page { title, caption: "", svg }).collect();
    let contents = write_pdf(&heading, &list, Sheet::A3).map_err(|error| not_drawn(&error))?;
    Ok((OutputFile { name: "frames.pdf".to_owned(), contents }, tiles.len()))
}

/// Where a frame meets the deck.
fn top(frame: &LoftedFrame) -> Option<&FramePoint> {
    frame.branches.last().and_then(|branch| branch.last())
}

/// The ordinates of frames as a table of offsets.
fn ordinates(frames: &[LoftedFrame], settings: &LoftSettings) -> OffsetTable {
    let cells = |values: Vec<Option<f64>>| values.into_iter().map(Cell::from).collect();
    let station = |frame: &LoftedFrame| StationOffsets {
        half_breadths: cells(settings.waterlines.iter().map(|z| frame.at_height(*z).map(|p| p.y)).collect()),
        heights: cells(settings.buttocks.iter().map(|y| frame.at_breadth(*y).map(|p| p.z)).collect()),
        keel_height: frame.branches.first().and_then(|branch| branch.first()).map(|point| point.z),
        deck_height: top(frame).map(|point| point.z),
        deck_half_breadth: top(frame).map(|point| point.y),
        ..StationOffsets::new(format!("{:.3}", frame.x), frame.x)
    };
    OffsetTable {
        waterlines: settings.waterlines.clone(),
        buttocks: settings.buttocks.clone(),
        stations: frames.iter().map(station).collect(),
        ..OffsetTable::default()
    }
}

/// Frames as polylines from the centreplane out, each on a layer of its own, with the grid.
fn dxf_lines(frames: &[LoftedFrame], settings: &LoftSettings) -> Vec<DxfLine> {
    let flat = |layer: &str, points: Vec<[f64; 2]>| DxfLine {
        layer: layer.to_owned(),
        points: points.into_iter().map(|[y, z]| [y, z, 0.0]).collect(),
        flat: true,
    };
    let all = || frames.iter().flat_map(LoftedFrame::points);
    let breadth = all().map(|p| p.y).fold(0.0, f64::max);
    let [low, high] = all().fold([0.0_f64, 0.0], |[a, b], p| [a.min(p.z), b.max(p.z)]);
    let mut lines: Vec<DxfLine> =
        settings.waterlines.iter().map(|&z| flat("GRID", vec![[0.0, z], [breadth, z]])).collect();
    lines.extend(settings.buttocks.iter().map(|&y| flat("GRID", vec![[y, low], [y, high]])));
    lines.push(flat("CENTRELINE", vec![[0.0, low], [0.0, high]]));
    lines.push(flat("BASELINE", vec![[0.0, 0.0], [breadth, 0.0]]));
    for frame in frames {
        let layer = format!("FRAME_{:.3}", frame.x);
        lines.extend(frame.branches.iter().map(|branch| flat(&layer, branch.iter().map(|p| [p.y, p.z]).collect())));
    }
    lines
}

/// Lofts frames of a hull.
///
/// # Errors
/// [`Failure::Usage`] when no frame is reached, or the tiles of the one format are too many; [`Failure::Internal`] when a drawing cannot be made.
pub fn loft(hull: &Hull, ship: &str, settings: &LoftSettings, formats: &[LoftFormat]) -> Result<Lofted, Failure> {
    let offset = match settings.side {
        SkinSide::Inside => -settings.thickness,
        SkinSide::Outside => settings.thickness,
    };
    let reached = |deviation: f64| -> Vec<LoftedFrame> {
        settings.frames.iter().filter_map(|x| hull.lofted_frame(*x, offset, deviation)).collect()
    };
    let frames = reached(settings.deviation);
    if frames.is_empty() {
        return Err(Failure::Usage("none of the frames cuts the hull".to_owned()));
    }
    let missed: Vec<String> = settings
        .frames
        .iter()
        .filter(|x| !frames.iter().any(|frame| (frame.x - **x).abs() <= 0.0))
        .map(|x| format!("{x:.3} m"))
        .collect();
    let mut warnings = Vec::new();
    if !missed.is_empty() {
        warnings.push(format!("W515 frames that do not cut the surface are left out: x = {}", missed.join(", ")));
    }
    let thickness = format!("{} {}", settings.notation.write(settings.thickness), settings.notation.as_str());
    let face = match (settings.thickness > 0.0, settings.side) {
        (false, _) => "moulded surface".to_owned(),
        (true, SkinSide::Inside) => format!("face {thickness} inside the moulded surface"),
        (true, SkinSide::Outside) => format!("face {thickness} outside the moulded surface"),
    };
    let fine = reached(settings.deviation.min(ORDINATES));
    let table = ordinates(&fine, settings);
    let bevels: Vec<Vec<Option<f64>>> = fine
        .iter()
        .map(|frame| settings.waterlines.iter().map(|z| frame.at_height(*z).map(|p| p.bevel.to_degrees())).collect())
        .collect();
    let mut files = vec![
        OutputFile::text("half-breadths.csv", offsets_csv(&table, settings.notation, false)),
        OutputFile::text("heights.csv", heights_csv(&table, settings.notation)),
        OutputFile::text("bevels.csv", bevels_csv(&table, &bevels, settings.notation)),
    ];
    let titles: Vec<String> = frames.iter().map(|frame| format!("frame at x = {:.3} m", frame.x)).collect();
    let sheets: Vec<LoftSheet<'_>> = frames
        .iter()
        .zip(&titles)
        .map(|(frame, title)| LoftSheet {
            ship,
            title,
            face: &face,
            frame,
            waterlines: &settings.waterlines,
            buttocks: &settings.buttocks,
        })
        .collect();
    if formats.contains(&LoftFormat::Svg) {
        for sheet in &sheets {
            let name = format!("frame-{:.3}.svg", sheet.frame.x);
            files.push(OutputFile::text(&name, loft_frame(sheet).as_str().to_owned()));
        }
    }
    if formats.contains(&LoftFormat::Dxf) {
        let text = write_dxf(&dxf_lines(&frames, settings), settings.unit, DxfVersion::R12);
        files.push(OutputFile::text("frames.dxf", text));
    }
    let (mut pages, mut failed) = (String::new(), Vec::new());
    if formats.contains(&LoftFormat::Pdf) {
        match tiles_of(&sheets, ship) {
            Ok((file, count)) => {
                files.push(file);
                pages = format!("; {} of A3", counted(count, "tile"));
            }
            Err(Failure::Usage(why)) if formats.len() > 1 => failed.push(format!("pdf: {why}")),
            Err(failure) => return Err(failure),
        }
    }
    let all = || bevels.iter().flatten().flatten().copied();
    let [least, greatest] = all().fold([0.0_f64, 0.0], |[a, b], angle| [a.min(angle), b.max(angle)]);
    let page = format!(
        "{} of the {face}; chords within {} m; bevels from {least:+.1} to {greatest:+.1} degrees{pages}",
        counted(frames.len(), "frame"),
        settings.deviation
    );
    Ok(Lofted { files, page, warnings, failed })
}
