//! Files that other programs, or this one, read and write: one file a format. Text in, values out, and back; the file
//! system is the business of whoever calls.

mod blend;
mod cad;
mod compare;
mod curve;
mod derive;
mod fairing;
mod fairing_read;
mod fault;
mod grades;
mod hgf;
mod hull_json;
mod hydrostatics;
#[cfg(feature = "workbooks")]
mod hydrostatics_workbook;
mod manifest;
mod mesh;
mod number;
mod offsets;
mod report_tables;
mod residuals;
mod resistance;
mod scene;
mod section;
mod subdivision;
mod summary;
mod table;
mod waves;

pub use blend::{BlendPart, BlendReport, blend_json};
pub use cad::{CadUnit, DxfLine, DxfVersion, write_3dm, write_dxf, write_iges, write_step};
pub use compare::{CompareFile, ComparedValue, compare_csv, compare_json, per_cent};
pub use curve::{CurveProblem, CurveTable, curve_csv, curve_json, read_curve};
pub use derive::{DeriveReport, DerivedTarget, derive_json};
pub use fairing::{
    COMPROMISE_LINE, NO_MOVE, RoundingEffect, changes_csv, control_polygon_csv, fairing_json, priced, reached,
    status_word,
};
pub use fairing_read::{FairingFile, FairingFileError, read_changes, read_fairing, read_texts};
pub use grades::{grades_csv, result_word};
pub use hgf::{HgfError, HgfShip, read_hgf};
pub use hull_json::{HullFile, HullFileError, LARGEST_HULL_FILE, json_message, read_hull, write_hull};
pub use hydrostatics::{conventions_json, hydrostatics_csv, hydrostatics_json, row_json};
#[cfg(feature = "workbooks")]
pub use hydrostatics_workbook::hydrostatics_workbook;
pub use manifest::{Manifest, ManifestEntry, read_manifest_input, read_manifest_outputs, sha256};
pub use mesh::{
    with_buffers, write_gdf, write_glb, write_msh, write_nemoh, write_obj, write_ply, write_pnl, write_stl,
    write_stl_ascii, write_threemf, write_vtk,
};
pub use offsets::{bevels_csv, conventions_toml, heights_csv, offsets_csv};
pub use report_tables::{diagonals_csv, micrometres, section_areas_csv};
pub use residuals::residuals_csv;
pub use resistance::{ResistanceFile, resistance_csv, resistance_json};
pub use scene::scene_json;
pub use section::{section_csv, section_json};
pub use subdivision::{SubdivisionProject, read_subdivision, write_ftm};
pub use summary::{Particulars, SummaryFile, TargetLine, ValueLine};
pub use table::{
    LARGEST_TABLE, LONGEST_FIELD, MOST_CELLS, MOST_COLUMNS, MOST_LINES, MOST_ROWS, MOST_UNPACKED, ReadBody, ReadTable,
    Rounding, Severity, TableProblem, TableWriting, WrittenTable, only_sections, read_body, read_fractions,
    read_particulars, read_table, read_table_with, section_of, workbook, write_britfair, write_delftship,
    write_freeship, write_ghs, write_michlet, write_pdstrip, write_pias, write_table,
};
