//! A hull for other programs: the files, and what the page reports of them.

mod format;

use std::borrow::Cow;
use std::f64::consts::PI;

pub use format::ExportFormat;

use super::lines_plan::{drawn_plan, lines_in_space};
use crate::exchange::{
    CadUnit, DxfVersion, SubdivisionProject, offsets_csv, write_3dm, write_britfair, write_delftship, write_dxf,
    write_freeship, write_ftm, write_gdf, write_ghs, write_glb, write_iges, write_michlet, write_msh, write_nemoh,
    write_obj, write_pdstrip, write_pias, write_ply, write_pnl, write_step, write_stl, write_stl_ascii, write_threemf,
    write_vtk,
};
use crate::hull::{
    Hull, HullMesh, LEAST_ANGLE, MeshReport, OffsetTable, PanelMesh, PanelReport, PanelSettings, Region,
    SectionalAreaCurve, SharpCorner, Solid, StationNumbers, StationOffsets, SubdivisionNet, TableForm, enclosed,
    floats_at, section_stations, whole_volume,
};
use crate::hydrostatics::{Conventions, CurvesOfForm};
use crate::numeric::trapezoids;
use crate::report::failure::Failure;
use crate::report::output::files::OutputFile;
use crate::units::{Notation, counted};

/// How it is exported.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ExportSettings {
    /// Unit of CAD files and meshes; GLB is in metres always.
    pub unit: CadUnit,
    /// Lengths of meshes over those of the hull.
    pub scale: f64,
    /// Whether meshes are of the half y >= 0, closed on the centreplane.
    pub half: bool,
    /// Version of DXF files.
    pub dxf: DxfVersion,
    /// What a mesh, or a polyline of a DXF file, leaves the surface by at most \[m\]; none: 1e-3 of the breadth.
    pub deviation: Option<f64>,
    /// Edges of a mesh across deck, bottom and transom where these are broadest, about; the least angle may ask for
    /// others.
    pub across: usize,
    /// Height that is z = 0 in the files, above the base line \[m\]; in panels it is the waterline.
    pub datum: f64,
    /// Draught of panels, and of files for Michlet and PDSTRIP, above the base line \[m\]; none: that of the hull.
    pub draught: Option<f64>,
    /// Length of the sides of panels \[m\]; none: a fiftieth of the length between perpendiculars, or less, down to a
    /// quarter of that, until the volume of the panels is within half a per cent of the hull's.
    pub panel: Option<f64>,
    /// How stations are numbered.
    pub stations: StationNumbers,
    /// What corners of a quadrilateral panel leave their mean plane by at most, over its longer diagonal; 0: all panels
    /// are planar.
    pub flatness: f64,
}

impl Default for ExportSettings {
    fn default() -> Self {
        Self {
            unit: CadUnit::Metre,
            scale: 1.0,
            half: false,
            dxf: DxfVersion::R12,
            deviation: None,
            across: 8,
            datum: 0.0,
            draught: None,
            panel: None,
            stations: StationNumbers::default(),
            flatness: 0.0,
        }
    }
}

/// The files with what is printed about them.
#[derive(Debug, Clone, PartialEq)]
pub struct Exported {
    /// The files.
    pub files: Vec<OutputFile>,
    /// Lines for the user.
    pub page: String,
}

/// Deviation of meshes, polylines and sections over the breadth.
const DEVIATION: f64 = 1e-3;

/// The least deviation over the breadth.
const LEAST_DEVIATION: f64 = 1e-6;

/// The greatest deviation over the lesser of breadth and depth: beyond it faces are left out, and at last all of them.
const MOST_DEVIATION: f64 = 0.1;

/// The farthest that z = 0 of the files may be from the base line, over the depth.
const FARTHEST_DATUM: f64 = 100.0;

/// Stations, and waterlines, for Michlet.
const MICHLET: usize = 41;

/// Panels over the length between perpendiculars, at least, where their size is not given.
const PANELS: f64 = 50.0;

/// Most panels over the length between perpendiculars where their size is not given.
const MOST_ALONG: f64 = 200.0;

/// What the volume of panels whose size is not given leaves that of the hull by, over it.
const PANEL_VOLUME: f64 = 5e-3;

/// What the volume of sections leaves that of the hull by, over it, before it is a warning.
const SECTION_VOLUME: f64 = 3e-3;

/// What the page says then.
const SECTIONS_OFF: &str =
    "W514 the volume between the sections is more than 0.3 % off that of the hull. Take a smaller --deviation";

/// What the page says of offsets then.
const OFFSETS_OFF: &str = "W514 the offsets leave out more than 0.3 % of the volume of the hull: its bottom or deck lies between waterlines. Take a \
     format of sections or surfaces";

/// What it says of a control net then, and faces and steps at which its subdivision ends.
const NET_OFF: &str = "W514 the surface of the control net is more than 0.3 % off the volume of the hull. Take a format of surfaces or sections";
const NET_FACES: usize = 20_000;
const NET_STEPS: usize = 3;

/// Corners of the body that the page names.
const NAMED_CORNERS: usize = 4;

fn lowered(points: &mut [[f64; 3]], datum: f64) {
    points.iter_mut().for_each(|point| point[2] -= datum);
}

/// Measures of the angles of a mesh.
fn angles(mesh: &HullMesh, report: &MeshReport) -> String {
    let degrees = 180.0 / PI;
    let mut text = format!(
        "least angle {:.2} degrees (bound {:.0}, {} below it",
        report.least_angle * degrees,
        LEAST_ANGLE * degrees,
        counted(mesh.slivers(), "triangle")
    );
    if mesh.sharp_corners.is_empty() {
        text.push(')');
        return text;
    }
    text.push_str(&format!(" but at {} of the body: ", counted(mesh.sharp_corners.len(), "sharper corner")));
    let corner = |corner: &SharpCorner| {
        let [x, y, z] = mesh.vertices[corner.vertex];
        format!("{} {:.2} degrees at ({x:.3}, {y:.3}, {z:.3}) m", corner.region.name(), corner.angle * degrees)
    };
    let named: Vec<String> = mesh.sharp_corners.iter().take(NAMED_CORNERS).map(corner).collect();
    text.push_str(&named.join(", "));
    text.push_str(if mesh.sharp_corners.len() > NAMED_CORNERS { " ...)" } else { ")" });
    text
}

/// A mesh and its line on the page.
fn mesh_line(mesh: &HullMesh, report: &MeshReport, volume: f64) -> String {
    format!(
        "mesh: {} vertices, {} triangles, {} edges, {}; {}; volume {:.6e} m3, {:+.2e} of the hull's {:.6e} m3",
        mesh.vertices.len(),
        mesh.triangles.len(),
        report.edges,
        if report.closed {
            "closed".to_owned()
        } else {
            format!("NOT closed ({})", counted(report.open_edges, "open edge"))
        },
        angles(mesh, report),
        report.volume,
        report.volume / volume - 1.0,
        volume,
    )
}

/// What sections are on the page: how many, and the volume between them, with linear areas, against that of the hull.
fn sections_lines(table: &OffsetTable, volume: f64) -> Vec<String> {
    let area = |station: &StationOffsets| {
        [station.station.x, 2.0 * station.outlines.iter().map(|line| enclosed(line)).sum::<f64>()]
    };
    let areas: Vec<[f64; 2]> = table.stations.iter().map(area).collect();
    let written = trapezoids(&areas);
    let off = written / volume - 1.0;
    let mut lines = vec![format!(
        "sections: {} with {} points, from x = {:.3} to {:.3} m, z from the base line; volume {written:.6e} m3, {off:+.2e} of the \
         hull's",
        table.stations.len(),
        table.point_count(),
        areas.first().map_or(0.0, |[x, _]| *x),
        areas.last().map_or(0.0, |[x, _]| *x)
    )];
    if off.abs() > SECTION_VOLUME {
        lines.push(SECTIONS_OFF.to_owned());
    }
    lines
}

/// What half-breadths at waterlines are on the page: how many, and the volume of the hull below the lowest and above the
/// highest of each station, which they do not hold.
fn offsets_lines(table: &OffsetTable, hull: &Hull, volume: f64) -> Vec<String> {
    let outside = |station: &StationOffsets| {
        let held = table.waterlines.iter().zip(&station.half_breadths).filter(|(_, cell)| cell.value().is_some());
        let held: Vec<f64> = held.map(|(z, _)| *z).collect();
        let heights = [held[0], held[held.len() - 1], hull.top()];
        let areas = SectionalAreaCurve::areas(hull, &heights, &[station.station.x]).remove(0);
        [station.station.x, areas[0] + areas[2] - areas[1]]
    };
    let holding = |station: &&StationOffsets| station.half_breadths.iter().any(|cell| cell.value().is_some());
    let areas: Vec<[f64; 2]> = table.stations.iter().filter(holding).map(outside).collect();
    let left_out = trapezoids(&areas);
    let share = left_out / volume;
    let mut lines = vec![format!(
        "offsets: {} at {}; below the lowest and above the highest of each: {left_out:.4e} m3, {:+.2e} of the hull's {volume:.6e} m3",
        counted(areas.len(), "station"),
        counted(table.waterlines.len(), "waterline"),
        -share
    )];
    if share > SECTION_VOLUME {
        lines.push(OFFSETS_OFF.to_owned());
    }
    lines
}

/// The panels and their line on the page.
fn panels(hull: &Hull, settings: &ExportSettings) -> Result<(PanelMesh, String), Failure> {
    let particulars = hull.particulars();
    let draught = draught_of(hull, settings.draught, "the format")?;
    let row = CurvesOfForm::new(hull, &[draught], &Conventions::default()).rows.remove(0);
    let of_size = |size: f64| {
        let asked = PanelSettings { draught, size, flatness: settings.flatness };
        let mesh = PanelMesh::new(hull, &asked).map_err(|error| Failure::Usage(error.to_string()))?;
        let report = mesh.report();
        Ok::<_, Failure>((mesh, report, report.volume / row.displacement_volume - 1.0))
    };
    let long = particulars.length_between_perpendiculars;
    let (largest, smallest) = (long / PANELS, long / MOST_ALONG);
    let mut size = settings.panel.unwrap_or(largest);
    let (mut mesh, mut report, mut off) = of_size(size)?;
    let mut left_off = "";
    while settings.panel.is_none() && (off.is_nan() || off.abs() > PANEL_VOLUME) {
        if size <= smallest {
            left_off = " (take a smaller --panel)";
            break;
        }
        // The error is of second order in the size; a little less, to be there at once.
        let share = (0.9 * PANEL_VOLUME / off.abs()).sqrt();
        size = (size * if share.is_finite() { share.clamp(0.5, 0.95) } else { 0.5 }).max(smallest);
        let Ok(finer) = of_size(size) else { break };
        (mesh, report, off) = finer;
    }
    let PanelReport { panels, triangles, unevenness, longest, volume, area } = report;
    let line = format!(
        "panels: {panels} on one side, {triangles} of them triangles, sides of {size:.3} m, the longest {longest:.3} m, corners within \
         {unevenness:.2e} m of their planes; z = 0 at draught {draught:.3} m; volume {volume:.6e} m3, {off:+.2e} of the hull's {:.6e} \
         m3{left_off}; area {area:.5e} m2, {:+.2e} of the wetted surface",
        row.displacement_volume,
        area / row.wetted_surface - 1.0,
    );
    Ok((mesh, line))
}

/// The control net of a hull and its lines on the page.
fn subdivision(hull: &Hull, title: &str, deviation: f64, volume: f64) -> (String, Vec<String>) {
    let (net, reached) = SubdivisionNet::of_hull(hull, deviation);
    let [coarse, fine] = net.meshes(NET_FACES, NET_STEPS).map(|mesh| mesh.enclosed_and_skin()[0]);
    // What a mesh leaves the surface by falls by four with each step.
    let written = (4.0 * fine - coarse) / 3.0;
    let off = written / volume - 1.0;
    let mut line = vec![format!(
        "control net: {} points, {} faces; its surface is within {reached:.2e} m of the hull, z from the base line; volume \
         {written:.6e} m3, {off:+.2e} of the hull's",
        net.points.len(),
        net.faces.len()
    )];
    if off.abs() > SECTION_VOLUME {
        line.push(NET_OFF.to_owned());
    }
    let stated = hull.particulars().into();
    (write_ftm(&SubdivisionProject { name: title.to_owned(), stated, unit: 1.0, net }), line)
}

/// Half-breadths of the immersed hull for Michlet, and their line on the page.
fn michlet(hull: &Hull, title: &str, settings: &ExportSettings) -> Result<(String, String), Failure> {
    let draught = draught_of(hull, settings.draught, "the format")?;
    let table = OffsetTable::of_immersed(hull, draught, MICHLET)
        .ok_or_else(|| Failure::Usage(format!("nothing of the hull is below the draught of {draught} m")))?;
    let row = CurvesOfForm::new(hull, &[draught], &Conventions::default()).rows.remove(0);
    let first = table.stations.first().map_or(0.0, |station| station.station.x);
    let last = table.stations.last().map_or(0.0, |station| station.station.x);
    let line = format!(
        "offsets for Michlet: {0} stations from x = {last:.3} m aft to {first:.3} m, {0} waterlines up to {draught:.3} m",
        MICHLET
    );
    Ok((write_michlet(&table, title, row.displacement_volume), line))
}

/// The draught \[m\] of what goes up to a waterline, or counts from it: `given` by the command, else that of the hull.
///
/// # Errors
/// [`Failure::Usage`] where there is none, which names `what` needs it, and where the given one is none of the hull.
pub fn draught_of(hull: &Hull, given: Option<f64>, what: &str) -> Result<f64, Failure> {
    if let Some(draught) = given {
        hull.takes_draught(draught).map_err(|error| Failure::of_draught(&error))?;
    }
    given.or(hull.particulars().draught).ok_or_else(|| Failure::without_draught(what, 1))
}

/// Whether formats and settings are such as can be meant.
fn sensible(hull: &Hull, formats: &[ExportFormat], settings: &ExportSettings) -> Result<(), Failure> {
    if let Some((_, twice)) = formats.iter().enumerate().find(|(k, format)| formats[..*k].contains(format)) {
        return Err(Failure::Usage(format!("--format names {} twice, expected each format once", twice.name())));
    }
    if let Some(draught) = settings.draught {
        draught_of(hull, Some(draught), "the format")?;
    } else if hull.particulars().draught.is_none() {
        let needy: Vec<&str> = formats.iter().filter(|f| f.needs_draught()).map(|f| f.name()).collect();
        if !needy.is_empty() {
            return Err(Failure::without_draught(&format!("--format {}", needy.join(",")), needy.len()));
        }
    }
    let is_changed = settings.half || (settings.scale - 1.0).abs() > 0.0;
    if let Some(other) = formats.iter().find(|format| is_changed && !format.is_mesh()) {
        return Err(Failure::Usage(format!("--half and --scale are of meshes, and {} is none", other.name())));
    }
    let (breadth, depth) = (hull.particulars().breadth, hull.particulars().depth);
    let least = LEAST_DEVIATION * breadth;
    if let Some(deviation) = settings.deviation.filter(|deviation| *deviation < least) {
        return Err(Failure::Usage(format!(
            "--deviation {deviation} m: expected at least {least:.1e} m, a millionth of the breadth; step, iges and 3dm have the surface itself"
        )));
    }
    // What is printed is taken.
    let most = (1e4 * MOST_DEVIATION * breadth.min(depth)).floor() / 1e4;
    if let Some(deviation) = settings.deviation.filter(|deviation| *deviation > most) {
        return Err(Failure::Usage(format!(
            "--deviation {deviation} m: expected at most {most} m, a tenth of the lesser of breadth and depth; a coarser mesh is no \
             longer this hull"
        )));
    }
    let most = FARTHEST_DATUM * depth;
    if settings.datum.is_nan() || settings.datum.abs() > most {
        return Err(Failure::Usage(format!(
            "--datum {} m: expected at most {most} m from the base line, {FARTHEST_DATUM} times the depth",
            settings.datum
        )));
    }
    Ok(())
}

/// The extent of a mesh along x.
fn length_of(mesh: &HullMesh) -> f64 {
    let ends = mesh.vertices.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], [x, ..]| [a.min(*x), b.max(*x)]);
    ends[1] - ends[0]
}

/// The file of a mesh \[m\] in a format of meshes.
///
/// # Errors
/// [`Failure::Usage`] where the library was built without the format.
pub(in crate::report) fn mesh_file(
    mesh: &HullMesh,
    title: &str,
    format: ExportFormat,
    unit: CadUnit,
) -> Result<Vec<u8>, Failure> {
    let mut mesh = Cow::Borrowed(mesh);
    if unit != CadUnit::Metre && format != ExportFormat::Glb {
        mesh.to_mut().vertices.as_flattened_mut().iter_mut().for_each(|c| *c *= unit.in_a_metre());
    }
    Ok(match format {
        ExportFormat::StlAscii => write_stl_ascii(&mesh).into_bytes(),
        ExportFormat::Obj => write_obj(&mesh, title).into_bytes(),
        ExportFormat::Ply => write_ply(&mesh, title).into_bytes(),
        ExportFormat::Glb => write_glb(&mesh, title),
        ExportFormat::ThreeMf => write_threemf(&mesh, 1.0 / unit.in_a_metre()).map_err(Failure::Usage)?,
        ExportFormat::Vtk => write_vtk(&mesh, title).into_bytes(),
        ExportFormat::Msh => write_msh(&mesh).into_bytes(),
        _ => write_stl(&mesh, title),
    })
}

/// Writes a hull in the formats; `name` begins the names of the files.
///
/// # Errors
/// [`Failure::Internal`] when the solid is not closed. [`Failure::Usage`] in these cases:
/// * nothing or the deck is immersed at the draught, the given draught lies above D, or a format lacks its draught.
/// * a format is named twice.
/// * the deviation is less than a millionth of the breadth or more than a tenth of the lesser of breadth and depth.
/// * the deviation asks for too many triangles.
/// * the datum is a hundred depths away.
pub fn export(
    hull: &Hull,
    name: &str,
    formats: &[ExportFormat],
    settings: &ExportSettings,
) -> Result<Exported, Failure> {
    sensible(hull, formats, settings)?;
    let deviation = settings.deviation.unwrap_or(DEVIATION * hull.particulars().breadth);
    let volume = whole_volume(hull);
    let (mut files, mut page) = (Vec::new(), Vec::new());
    let title = if hull.name().is_empty() { name } else { hull.name() };
    let mesh = if formats.iter().any(|format| format.is_mesh()) {
        let make = if settings.half { HullMesh::half } else { HullMesh::new };
        let mut mesh = make(hull, deviation, settings.across)
            .map_err(|error| Failure::Usage(format!("--deviation {deviation} m: {error}; take a larger one")))?;
        let report = mesh.report();
        page.push(mesh_line(&mesh, &report, if settings.half { 0.5 * volume } else { volume }));
        if settings.half {
            page.push("half of the body: y >= 0, closed on the centreplane; volumes are of the half".to_owned());
        }
        lowered(&mut mesh.vertices, settings.datum);
        if (settings.scale - 1.0).abs() > 0.0 {
            mesh.vertices.as_flattened_mut().iter_mut().for_each(|c| *c *= settings.scale);
            page.push(format!("scale of the mesh: {}, a length of {:.4} m", settings.scale, length_of(&mesh)));
        }
        Some(mesh)
    } else {
        None
    };
    let solid = if formats.iter().any(|format| format.is_solid()) {
        let solid = Solid::new(hull).map_err(|error| Failure::Internal(format!("solid of the hull: {error}")))?;
        if !solid.is_closed() {
            return Err(Failure::Internal("the faces of the solid do not share their edges".to_owned()));
        }
        let faces: Vec<&str> = solid.faces.iter().map(|face| face.name.as_str()).collect();
        let own = solid.volume();
        page.push(format!(
            "solid: {} edges, faces {}; volume {own:.12e} m3, {:+.1e} of the hull's; area {:.10e} m2",
            solid.edges.len(),
            faces.join(", "),
            own / volume - 1.0,
            solid.area(),
        ));
        if solid.deviation > 0.0 {
            page.push(format!(
                "the deck or the centreplane cuts the surface: the faces are within {:.2e} m of the hull",
                solid.deviation
            ));
        }
        Some(solid.lowered(settings.datum).map_err(|error| Failure::Internal(error.to_string()))?)
    } else {
        None
    };
    let panels = if formats.iter().any(|format| format.is_panels()) {
        let (panels, line) = panels(hull, settings)?;
        page.push(line);
        panels
    } else {
        PanelMesh::default()
    };
    let sections = if formats.iter().any(|format| format.is_sections()) {
        let draught = settings.draught.or(hull.particulars().draught);
        let heights: Vec<f64> =
            [Some(hull.reference_height()), draught, Some((1.0 - 1e-9) * hull.top())].into_iter().flatten().collect();
        let table = OffsetTable::of_sections(hull, &section_stations(hull, &heights), deviation);
        page.extend(sections_lines(&table, volume));
        table
    } else {
        OffsetTable::default()
    };
    if formats.iter().any(|format| matches!(format, ExportFormat::Pdstrip | ExportFormat::Michlet)) {
        floats_at(hull, draught_of(hull, settings.draught, "the format")?)
            .map_err(|error| Failure::Usage(error.to_string()))?;
    }
    let is_table =
        |format: &ExportFormat| matches!(format, ExportFormat::Csv | ExportFormat::Xlsx | ExportFormat::Delftship);
    if formats.iter().any(is_table) {
        page.extend(offsets_lines(&OffsetTable::with_defaults(hull), hull, volume));
    }
    for &format in formats {
        let file = format!("{name}{}", format.ending());
        let contents = match (format, &mesh, &solid) {
            (ExportFormat::Ghs, ..) => write_ghs(&sections).into_bytes(),
            (ExportFormat::Britfair, ..) => write_britfair(&sections).into_bytes(),
            (ExportFormat::Pias, ..) => write_pias(&sections).into_bytes(),
            (ExportFormat::Pdstrip, ..) => {
                let mut below = sections.clone();
                below.stated.draught = Some(draught_of(hull, settings.draught, "the format")?);
                write_pdstrip(&below).into_bytes()
            }
            (ExportFormat::Freeship, ..) => write_freeship(&sections).into_bytes(),
            (ExportFormat::Delftship, ..) => {
                let mut table = OffsetTable::with_defaults(hull);
                table.stated.draught = settings.draught.or(table.stated.draught);
                write_delftship(&table).into_bytes()
            }
            (ExportFormat::Ftm, ..) => {
                let (text, lines) = subdivision(hull, title, deviation, volume);
                page.extend(lines);
                text.into_bytes()
            }
            (ExportFormat::Michlet, ..) => {
                let (text, line) = michlet(hull, title, settings)?;
                page.push(line);
                text.into_bytes()
            }
            (ExportFormat::DxfPlan, ..) => {
                write_dxf(&drawn_plan(hull, settings.stations, deviation, settings.datum), settings.unit, settings.dxf)
                    .into_bytes()
            }
            (ExportFormat::Csv | ExportFormat::Xlsx, ..) => {
                let text = offsets_csv(&OffsetTable::with_defaults(hull), Notation::Metres, true);
                OutputFile::table(&file, text, &TableForm::default())?.contents
            }
            (ExportFormat::Gdf, ..) => write_gdf(&panels, title).into_bytes(),
            (ExportFormat::Nemoh, ..) => write_nemoh(&panels).into_bytes(),
            (ExportFormat::Pnl, ..) => write_pnl(&panels).into_bytes(),
            (format, Some(mesh), _) if format.is_mesh() => mesh_file(mesh, title, format, settings.unit)?,
            (ExportFormat::Step, _, Some(solid)) => write_step(solid, title, settings.unit).into_bytes(),
            (ExportFormat::Iges, _, Some(solid)) => write_iges(solid, title, settings.unit).into_bytes(),
            (ExportFormat::Rhino, _, Some(solid)) => write_3dm(solid, title, settings.unit)
                .map_err(|error| Failure::Internal(format!("3DM file of the solid: {error}")))?,
            (ExportFormat::Dxf, ..) => write_dxf(
                &lines_in_space(hull, settings.stations, deviation, settings.datum),
                settings.unit,
                settings.dxf,
            )
            .into_bytes(),
            _ => continue,
        };
        files.push(OutputFile { name: file, contents });
    }
    if let Some(mesh) = &mesh {
        let named: Vec<&str> = Region::ALL
            .into_iter()
            .filter(|region| mesh.triangles.iter().any(|(other, _)| other == region))
            .map(Region::name)
            .collect();
        page.push(format!("regions: {}", named.join(", ")));
    }
    Ok(Exported { files, page: page.join("\n") })
}
