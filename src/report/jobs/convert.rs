//! Tables of offsets read and written back, in their own notation or in another.

pub(crate) use crate::report::input::source::is_hull;
use std::path::Path;

use super::export::{ExportFormat, ExportSettings, export, mesh_file};
use crate::exchange::{
    CadUnit, Severity, TableWriting, WrittenTable, only_sections, read_body, read_subdivision, section_of,
    write_britfair, write_delftship, write_freeship, write_ftm, write_ghs, write_pdstrip, write_pias, write_table,
};
use crate::hull::{AFLOAT, AT_EDGE, HullError, HullMesh, OffsetTable, OutlinePoint, Region, TableForm, TableLayout};
use crate::report::failure::{Failure, problem};
use crate::report::input::source::{
    Overrides, conventions_beside, read_bytes, read_source_with, read_table_file_with, sidecar,
};
use crate::report::output::files::OutputFile;
use crate::units::counted;

/// A converted table, and what should be known about it.
#[derive(Debug, Clone, PartialEq)]
pub struct Converted {
    /// The file with what rounding did.
    pub written: WrittenTable,
    /// How the table was written.
    pub form: TableForm,
    /// The TOML file that goes beside the table: the conventions of the one that was read, or its dimensions alone where
    /// units, layout or positions are others.
    pub conventions: Option<String>,
    /// Messages for the user: warnings and notes of the reading, effect of rounding.
    pub messages: Vec<String>,
}

/// Reads the table of a file and writes it in the notation and layout that are asked for, its own where none is.
///
/// # Errors
/// [`Failure::FileSystem`]; [`Failure::Input`] with every problem of the table; [`Failure::Usage`] when the layout that
/// is asked for cannot hold the table.
pub fn convert_table(path: &Path, overrides: &Overrides, writing: TableWriting) -> Result<Converted, Failure> {
    let (table, notes) = read_table_file_with(path, overrides)?;
    let sections = only_sections(&table);
    if sections && writing.layout.is_some_and(|layout| layout != TableLayout::Tidy) {
        return Err(Failure::Usage(
            "the table gives sections as points, which a matrix cannot hold; write a tidy table (--layout tidy)"
                .to_owned(),
        ));
    }
    let written = write_table(&table, writing);
    // A missing profile does not matter to a table that stays a table.
    let mut messages: Vec<String> =
        notes.iter().filter(|n| n.severity != Severity::Warning || n.code == "W320").map(ToString::to_string).collect();
    let r = written.rounding;
    messages.push(format!(
        "rounding: {}, {} as they were written; largest change {:.3} mm, RMS {:.3} mm; of positions {:.3} mm",
        counted(r.cells, "offset"),
        r.kept,
        1e3 * r.largest,
        1e3 * r.root_mean_square,
        1e3 * r.largest_of_positions
    ));
    if !table.lines.is_empty() && written.text.matches(",KN,").count() + written.text.matches(",TL,").count() == 0 {
        messages.push(format!(
            "not written: {}; a tidy table holds lines (--layout tidy)",
            counted(table.lines.len(), "line")
        ));
    }
    let points = table.point_count();
    let tidy = sections || writing.layout.unwrap_or(table.form.layout) == TableLayout::Tidy;
    // Every tidy table has this column; none of the other programs' formats has it.
    let own = sections && !written.text.contains("curve");
    if sections && !own && writing.layout.is_none() && table.form.layout != TableLayout::Tidy {
        messages.push(format!("sections as points: a tidy table of {}", counted(points, "point")));
    } else if points > 0 && !tidy && !own {
        messages.push("sections given as points are not written; a tidy table holds them (--layout tidy)".to_owned());
    }
    let beside = conventions_beside(path, overrides)?;
    let conventions = if written.is_alike { beside } else { beside.and_then(|text| for_other_form(&text, tidy)) };
    Ok(Converted { written, form: table.form, conventions, messages })
}

/// What conventions say of the hull, and not of how a table of it is written; the profiles of stern and stem are written in the
/// table, and a tidy one holds lines. None where nothing is left.
fn for_other_form(text: &str, tidy: bool) -> Option<String> {
    const OF_HULL: [&str; 5] = ["name", "lpp", "b", "t", "d"];
    let mut all: toml::Table = text.parse().ok()?;
    all.retain(|name, value| match value {
        toml::Value::Table(keys) if name != "transom" => {
            keys.retain(|key, _| OF_HULL.contains(&key.to_lowercase().as_str()));
            !keys.is_empty()
        }
        _ => name != "line" || !tidy,
    });
    toml::to_string(&all).ok().filter(|text| !text.trim().is_empty())
}

/// The writer of tables in a format, where one takes tables that are nothing but `sections` or other tables; none of
/// other formats.
fn of_table_in(format: ExportFormat, sections: bool) -> Option<fn(&OffsetTable) -> String> {
    Some(match format {
        ExportFormat::Ghs => write_ghs,
        ExportFormat::Britfair => write_britfair,
        ExportFormat::Pias => write_pias,
        ExportFormat::Pdstrip => write_pdstrip,
        ExportFormat::Freeship => write_freeship,
        ExportFormat::Delftship if !sections => write_delftship,
        _ => return None,
    })
}

/// The contents of a file and messages for the user.
type WithMessages = (Vec<u8>, Vec<String>);

/// The file of a body of triangles in a format of meshes; none of other formats.
fn of_triangles(path: &Path, overrides: &Overrides, format: ExportFormat) -> Result<Option<WithMessages>, Failure> {
    if !format.is_mesh() {
        return Ok(None);
    }
    let (bytes, list) = (read_bytes(path)?, sidecar(path, overrides)?);
    let list = list.iter().map(|(name, text)| (name.as_str(), text.as_str()));
    let Some(body) = read_body(&path.display().to_string(), &bytes, list) else { return Ok(None) };
    let body = body.map_err(|problems| overrides.refused(problems))?;
    let triangles = body.meshes.first().cloned().unwrap_or_default();
    let mesh = HullMesh {
        vertices: triangles.vertices,
        triangles: triangles.triangles.into_iter().map(|corners| (Region::Hull, corners)).collect(),
        sharp_corners: Vec::new(),
    };
    let contents = mesh_file(&mesh, &body.name, format, CadUnit::Metre)?;
    Ok(Some((contents, body.notes.iter().map(ToString::to_string).collect())))
}

/// Why a table has no sections up to a draught \[m\]; none where it has.
fn draught_fault(table: &OffsetTable, draught: f64) -> Option<String> {
    let sections: Vec<(f64, Vec<OutlinePoint>)> =
        table.stations.iter().map(|s| (s.station.x, section_of(s, &table.waterlines).concat())).collect();
    let heights = || sections.iter().flat_map(|(_, points)| points).map(|point| point.z);
    let (bottom, top) = (heights().reduce(f64::min)?, heights().reduce(f64::max)?);
    let depth = table.stated.depth.unwrap_or(top);
    if draught > (1.0 + AT_EDGE) * depth {
        return Some(HullError::Draught { draught, depth }.to_string());
    }
    if draught <= bottom + AFLOAT * (top - bottom) {
        return Some(HullError::Aground { draught, bottom }.to_string());
    }
    // Sections of a bulb close below the waterline.
    let open = |points: &[OutlinePoint]| {
        let highest = points.iter().max_by(|a, b| a.z.total_cmp(&b.z))?;
        (highest.y > 0.0 && highest.z < draught - AT_EDGE * depth).then_some(highest.z)
    };
    let (x, z) = sections.iter().find_map(|(x, points)| Some((x, open(points)?)))?;
    Some(format!(
        "the section at x = {x:.3} m ends at z = {z:.3} m, below the draught of {draught:.3} m: complete it, or state a draught within it"
    ))
}

/// Reads a table, a body, a hull or a design and writes it as `format` in one file; messages for the user beside it.
///
/// Sections of a table or a body become sections of another program as they are, triangles stay triangles, a control
/// net stays a control net; everything else goes over a hull, which is laid through tables and bodies.
///
/// # Errors
/// [`Failure::FileSystem`]; [`Failure::Input`] with every problem of what is read; [`Failure::Usage`] when the draught is none
/// of a table; those of [`export`].
pub fn convert_file(
    path: &Path,
    overrides: &Overrides,
    name: &str,
    format: ExportFormat,
    settings: &ExportSettings,
) -> Result<(OutputFile, Vec<String>), Failure> {
    let file = |contents: Vec<u8>| OutputFile { name: name.to_owned(), contents };
    if !is_hull(path) {
        let takes = |sections| of_table_in(format, sections);
        if takes(false).is_some()
            && let (table, notes) = read_table_file_with(path, overrides)?
            && let Some(write) = takes(only_sections(&table))
        {
            let mut table = table;
            table.stated.draught = settings.draught.or(table.stated.draught);
            if format.needs_draught() && !table.stated.states_draught() {
                return Err(Failure::without_draught(&format!("--format {}", format.name()), 1));
            }
            let draught = table.stated.draught.filter(|_| settings.draught.is_some() || format.needs_draught());
            if let Some(fault) = draught.and_then(|draught| draught_fault(&table, draught)) {
                return Err(match settings.draught {
                    Some(_) => Failure::of_draught(&fault),
                    None => Failure::Input(vec![problem("E314", path, fault, "")]),
                });
            }
            return Ok((file(write(&table).into_bytes()), notes.iter().map(ToString::to_string).collect()));
        }
        if let (ExportFormat::Ftm, true) = (format, overrides.keys.is_empty())
            && let Some(read) = read_subdivision(&path.display().to_string(), &read_bytes(path)?)
        {
            let project = read.map_err(|problems| overrides.refused(problems))?;
            return Ok((file(write_ftm(&project).into_bytes()), Vec::new()));
        }
        if let Some((contents, notes)) = of_triangles(path, overrides, format)? {
            return Ok((file(contents), notes));
        }
    }
    let source = read_source_with(path, overrides)?;
    let stem = Path::new(name).file_stem().unwrap_or_else(|| "hull".as_ref()).to_string_lossy().into_owned();
    let mut exported = export(&source.hull, &stem, &[format], settings)?;
    let contents = exported.files.pop().map(|file| file.contents).unwrap_or_default();
    Ok((file(contents), source.notes.into_iter().chain(exported.page.lines().map(str::to_owned)).collect()))
}
